"""The camera's and the hand-eye's sections: figures, tables and charts from what intrinsics and hand-eye found."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.camera import Camera, CameraSolution, ViewVerdict
from lpcal.records.evidence import CameraEvidence, HandEyeEvidence, ProjectionUncertainty
from lpcal.records.observations import BoardPoses
from lpcal.report import charts
from lpcal.report.charts import Drawing
from lpcal.report.rig_report import RigReport, origin_sigmas
from lpcal.report.time_lines import time_lines
from lpcal.report.wording import NOTHING, fixed, grouped, number, plural, with_sigma

type Row = tuple[str, str]
"""A label and a figure."""

CELLS = (9, 6)
FEWEST_CORNERS = 8
MOST_VECTORS = 3000
"""Lines of a drawing of residuals: more are a blot, and a page of megabytes."""
CORE = {"focal length x": "fx", "focal length y": "fy", "principal point x": "cx", "principal point y": "cy"}


@dataclass(frozen=True)
class LensChoice:
    """The lens models and boards that were tried: rows of a model and, a board, the figure and whether it was taken."""

    why: str | None
    boards: list[str]
    rows: list[tuple[str, list[tuple[str, bool]]]]


@dataclass(frozen=True)
class CameraPart:
    """Intrinsics with their sigmas, residuals a view, coverage of the image, the board's shape."""

    rows: list[Row]
    parameters: list[Row]
    residuals: str | None
    coverage: Drawing | None
    histogram: Drawing | None
    choice: LensChoice | None
    warp: str | None
    warp_mm: str | None
    uncertainty: Drawing | None
    """How sure the projection is over the image, and where the lens is known."""
    vectors: Drawing | None
    """The residual of every corner."""
    checks: list[Row]
    """What other programs and other boards make of the same corners, the views that matter, and the next one."""
    views: str
    left_out: list[Row]


@dataclass(frozen=True)
class TransformFigures:
    """A transform as a matrix, a quaternion, a rotation vector and millimetres."""

    name: str
    matrix: list[list[str]]
    quaternion: str
    rotation: list[str]
    position: list[str]


@dataclass(frozen=True)
class HandEyePart:
    """H_PC with its sigmas, the views used and why not, the clock."""

    transforms: list[TransformFigures]
    board_carried: bool
    clock: str | None
    used: str
    evidence: list[Row]
    weakest: str | None
    """The direction that is known worst, and the motion that improves it."""
    rms: list[Row]
    residuals: list[Row]
    """Titles and charts of those residuals that there are."""
    times: Drawing | None
    """Body, gaps, flips and views over the recording."""
    left_out: list[Row]


@dataclass(frozen=True)
class Measure:
    """A residual of a view: its name, its unit, and where it stands in the verdict, in that unit."""

    name: str
    unit: str
    of: Callable[[ViewVerdict], float | None]


MEASURES = (
    Measure("corners", "px", lambda view: view.residual_px),
    Measure("the board misses its place", "mm", lambda view: _scaled(view.residual_m, 1000)),
    Measure("the board is turned", "°", lambda view: _scaled(view.residual_rad, 180 / np.pi)),
)


def camera_section(report: RigReport) -> CameraPart | None:
    """The camera's section; None where there is no camera."""
    camera, solution = report.lens, report.camera
    if camera is None:
        return None
    points_B = None if report.boards is None else report.boards.points_B
    views = () if solution is None else solution.views
    seen = None if solution is None or report.boards is None else _corners(report.boards, solution)
    return CameraPart(
        rows=_intrinsics(camera, solution),
        parameters=[(name, with_sigma(camera.value_of(name), camera.std_of(name))) for name in camera.parameters],
        residuals=_view_bars(views, MEASURES[0]) if views else None,
        coverage=None if seen is None else _coverage(*seen, camera.image_size),
        histogram=None if seen is None else _histogram(seen[1]),
        choice=None if solution is None else lens_choice(solution.evidence),
        warp=_warp(points_B),
        warp_mm=None if points_B is None else fixed(1000 * float(np.ptp(points_B[:, 2])), 2, "mm"),
        uncertainty=None if solution is None else _uncertainty(solution.evidence.projection_uncertainty, camera.image_size),
        vectors=None if seen is None else _vectors(*seen, camera.image_size),
        checks=[] if solution is None else _checks(solution.evidence),
        views=plural(len(views), "view"),
        left_out=_left_out(views),
    )


def handeye_section(report: RigReport) -> HandEyePart | None:
    """The hand-eye's section; None where it has not run."""
    found = report.handeye
    if found is None:
        return None
    used = [view for view in found.views if view.used]
    camera, board = found.names
    offset, std = found.clock_offset_s, found.clock_offset_std_s
    return HandEyePart(
        transforms=[_transform(camera, found.H_PC, found.H_PC_covariance), _transform(board, found.H_OB, found.H_OB_covariance)],
        board_carried=found.carries == "board",
        clock=with_sigma(1000 * offset, None if std is None else 1000 * std, "ms") if offset is not None else None,
        used=f"{len(used)} of {plural(len(found.views), 'view')}",
        evidence=[] if found.evidence is None else _evidence(found.evidence),
        weakest=None if found.evidence is None else found.evidence.weakest,
        rms=[(measure.name, number(_rms(used, measure), 3, measure.unit)) for measure in MEASURES],
        residuals=[
            (measure.name, _view_bars(found.views, measure))
            for measure in MEASURES
            if any(measure.of(view) is not None for view in found.views)
        ],
        times=None if report.course is None else time_lines(report.course, found, report.image_times_s),
        left_out=_left_out(found.views),
    )


def _evidence(found: HandEyeEvidence) -> list[Row]:
    """What the solve rests on, as far as it is said."""
    named = (
        ("the panel turned by, rms about three axes", ", ".join(fixed(angle, 1, "°") for angle in found.rotation_spread_deg.tolist())),
        ("mocap noise, rotation", fixed(found.mocap_sigma_deg, 3, "°")),
        ("mocap noise, position", fixed(1000 * found.mocap_sigma_m, 2, "mm")),
        ("corner noise", number(found.corner_sigma_px, 2, "px")),
        ("the board's size by the mocap", _board_size(found)),
        ("moved from the closed-form solution by", fixed(1000 * found.moved_from_closed_form_m, 2, "mm")),
        ("turned from the closed-form solution by", fixed(found.moved_from_closed_form_deg, 3, "°")),
    )
    return [(label, value) for label, value in named if value not in {"", NOTHING}]


def _board_size(found: HandEyeEvidence) -> str:
    """The board's size by the mocap's metres over the stated one."""
    size, std = found.board_size_by_mocap, found.board_size_by_mocap_std
    return with_sigma(size, std) + " of the stated one" if np.isfinite(size) and np.isfinite(std) else NOTHING


def _scaled(value: float | None, factor: float) -> float | None:
    return None if value is None else factor * value


def _rms(views: Sequence[ViewVerdict], measure: Measure) -> float:
    values = [value for view in views if (value := measure.of(view)) is not None]
    return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")


def _intrinsics(camera: Camera, solution: CameraSolution | None) -> list[Row]:
    (w, h), K = camera.image_size, camera.K
    field = 2 * np.degrees(np.arctan2(np.array([w, h]) / 2, [K[0, 0], K[1, 1]]))
    rows = [
        ("model", camera.model),
        ("image", f"{w} × {h} px, {field[0]:.1f}° × {field[1]:.1f}°"),
        *((label, with_sigma(camera.value_of(name), camera.std_of(name), "px")) for label, name in CORE.items()),
    ]
    rows += [("rms a coordinate", number(camera.rms_px, 3, "px"))] if camera.rms_px > 0 else []
    if solution is None:
        return rows
    note = solution.evidence.solver_note
    rows += [("corner noise", number(solution.corner_sigma_px, 3, "px"))] if solution.corner_sigma_px > 0 else []
    return rows + ([("solver", f"{solution.solver}{f' ({note})' if note else ''}")] if solution.solver else [])


def _short(image: str) -> str:
    """What of a view stands under its bar: the image's name without its folder and ending, or the time of a pose that has no image."""
    name = image.rpartition("/")[2]
    _, at, time = name.rpartition(" at ")
    return time if at else name.rpartition(".")[0] or name


def _view_bars(views: Sequence[ViewVerdict], measure: Measure) -> str:
    drawn = []
    for view in views:
        value = measure.of(view)
        label = f"{view.image}: {number(value, 3, measure.unit)}" + ("" if view.used else f" left out, {view.why or 'no reason given'}")
        drawn.append(charts.Bar(value, label, "accent" if view.used else "fair", name=_short(view.image)))
    return charts.bars(drawn, unit=measure.unit, across="views in order; amber: left out")


def _left_out(views: Sequence[ViewVerdict]) -> list[Row]:
    return [(view.image, view.why or "no reason given") for view in views if not view.used]


def _coverage(pixels: Array, left: Array, image_size: tuple[int, int]) -> Drawing:
    """The corners of the views that the intrinsics used, over the image, and the mean residual in each cell."""
    w, h = image_size
    arrows, noise = _cell_means(pixels, left, w, h)
    if not len(arrows):
        return Drawing(charts.over_image(pixels, (w, h)), "where the board's corners fell")
    longest = float(np.linalg.norm(arrows[:, 2:], axis=1).max())
    factor = _round_down(0.8 * w / CELLS[0] / max(longest, 1e-9))
    note = f"where the board's corners fell; arrows: mean residual in a cell, × {_times(factor)}"
    note += f"; the longest is {number(longest, 2, 'px')}"
    note += f", noise alone leaves {number(noise, 2, 'px')}" if np.isfinite(noise) else ""
    return Drawing(charts.over_image(pixels, (w, h), arrows * [1, 1, factor, factor]), note)


def _uncertainty(found: ProjectionUncertainty | None, image_size: tuple[int, int]) -> Drawing | None:
    """How sure the projection is over the image, with a line round where the lens is known."""
    if found is None or not np.isfinite(found.worst_direction_std_px).any():
        return None
    trusted = np.where(found.trusted, found.worst_direction_std_px, np.nan)
    inside = float(np.nanmax(trusted)) if np.isfinite(trusted).any() else float("nan")
    share = fixed(100 * found.trusted_share, 0, "%")
    note = f"one standard deviation, in its worst direction; the line: where the lens is known, {share} of the image"
    note += f", at most {number(inside, 2, 'px')} there" if np.isfinite(inside) else ""
    drawn = charts.heat_map(
        found.worst_direction_std_px,
        unit="px",
        aspect=image_size[0] / image_size[1],
        outline=np.asarray(found.trusted, bool),
        what="standard deviation of projection over the image",
    )
    return Drawing(drawn, f"{note}. Outside the line, show the board there too or measure nothing there.")


def _vectors(pixels: Array, left: Array, image_size: tuple[int, int]) -> Drawing | None:
    """The residuals of the corners, or of every n-th where there are many."""
    kept = np.isfinite(left).all(axis=1)
    pixels, left = pixels[kept], left[kept]
    if len(pixels) < FEWEST_CORNERS:
        return None
    step = -(-len(pixels) // MOST_VECTORS)
    pixels, left = pixels[::step], left[::step]
    usual = float(np.percentile(np.linalg.norm(left, axis=1), 90))
    factor = _round_down(0.03 * image_size[0] / max(usual, 1e-9))
    note = f"residuals of {'every corner' if step == 1 else f'one corner in {step}'}, × {_times(factor)}. "
    note += "Lines that lie side by side and point alike are no noise: the lens model, the board or one view is wrong there."
    return Drawing(charts.vectors(pixels, factor * left, image_size), note)


def _checks(found: CameraEvidence) -> list[Row]:
    """Rows of what else was made of the same corners."""
    rows: list[Row] = []
    for other in (found.independent_check, found.free_board_check):
        if other is None:
            continue
        apart = f"{number(other.difference_rms_px, 2, 'px')} rms, {number(other.difference_worst_px, 2, 'px')} at most apart"
        rows.append((f"the same corners by {other.by}", f"failed: {other.failed}" if other.failed else apart))
    if found.coverage is not None:
        rows.append(("coverage", found.coverage.in_words))
    if found.views_that_matter:
        worth = ", ".join(f"{one.image} ({100 * (one.without_it - 1):.0f} %)" for one in found.views_that_matter[:3])
        rows.append(("without it the camera is less sure by", worth))
    if found.next_view is not None:
        then = f"{number(found.next_view.std_now_px, 2)} → {number(found.next_view.std_then_px, 2, 'px')}"
        rows.append(("the next view", f"{found.next_view.hold_the_board} ({then})"))
    return rows


def _histogram(left: Array) -> Drawing | None:
    """The residuals of the corners' coordinates, with the normal curve of the same rms."""
    left = left[np.isfinite(left)]
    if left.size < FEWEST_CORNERS:
        return None
    sigma = float(np.sqrt(np.mean(left**2)))
    beyond = 100 * float(np.mean(np.abs(left) > 3 * sigma))
    note = (
        f"residuals of {grouped(left.size)} coordinates, and the normal curve; {fixed(beyond, 1, '%')} are beyond 3 sigma, 0.3 % expected"
    )
    return Drawing(charts.histogram(left, unit="px", sigma=sigma), note)


def _corners(boards: BoardPoses, solution: CameraSolution) -> tuple[Array, Array] | None:
    """Corners (N, 2) of the used views and their residuals (N, 2), seen less expected; a splined lens is not projected here: NaN."""
    used = {view.image for view in solution.views if view.used}
    rows = [row for row, image in enumerate(boards.images) if image in used]
    if not rows or boards.corners_px is None or boards.points_B is None:
        return None
    camera, pixels = solution.camera, boards.corners_px[rows]
    if camera.model == "splined":
        expected = np.full_like(pixels, np.nan)
    else:
        expected = central.project(se3.apply(boards.H_CB[rows], boards.points_B), camera.K, camera.distortion)
    seen = np.isfinite(pixels).all(axis=-1)
    return pixels[seen], (pixels - expected)[seen]


def _cell_means(pixels: Array, left: Array, w: int, h: int) -> tuple[Array, float]:
    """Arrows (M, 4) at the cells' middles with the mean residual, and the length that noise alone would give them."""
    cell = np.floor(pixels / [w, h] * CELLS).astype(int)
    arrows, counts = [], []
    for i, j in np.ndindex(*CELLS):
        inside = (cell == [i, j]).all(axis=1) & np.isfinite(left).all(axis=1)
        if inside.sum() >= FEWEST_CORNERS:
            arrows.append([(i + 0.5) * w / CELLS[0], (j + 0.5) * h / CELLS[1], *left[inside].mean(axis=0)])
            counts.append(int(inside.sum()))
    noise = float(np.nanstd(left) * np.sqrt(2 / np.median(counts))) if counts else float("nan")
    return np.array(arrows).reshape(-1, 4), noise


def _times(factor: float) -> str:
    """How many times as long as they are the lines of a drawing are, in words."""
    return grouped(round(factor)) if factor >= 1 else f"{factor:g}"


def _round_down(value: float) -> float:
    """1, 2 or 5 times a power of ten at or under a value."""
    power = 10 ** np.floor(np.log10(value))
    return float(max(step for step in (1, 2, 5) if step * power <= value * 1.0001) * power)


def lens_choice(evidence: CameraEvidence) -> LensChoice | None:
    """How the lens model was chosen: the difference between the halves of the views, for each model and each board that was tried."""
    tried, chosen = evidence.cross_validation, evidence.chosen
    if not any(np.isfinite(one.cross_validation_px) for one in tried):
        return None
    boards = list(dict.fromkeys(one.board for one in tried))
    score = {(one.model, one.board): one.cross_validation_px for one in tried}
    taken = None if chosen is None else (chosen.model, chosen.board)
    rows = [
        (model, [(number(score.get((model, board)), 3), (model, board) == taken) for board in boards])
        for model in dict.fromkeys(one.model for one in tried)
    ]
    return LensChoice(None if chosen is None else chosen.why, boards, rows)


def _warp(points_B: Array | None) -> str | None:
    if points_B is None or float(np.ptp(points_B[:, 2])) < 1e-7:
        return None
    return charts.signed_grid(points_B[:, :2], 1000 * points_B[:, 2], unit="mm")


def _transform(name: str, H: Array, covariance: Array) -> TransformFigures:
    sigma = origin_sigmas(H, covariance)
    turn, shift = np.degrees(sigma[:3]), 1000 * sigma[3:]
    rotation = zip(np.degrees(se3.rotation_vector(H[:3, :3])), turn, strict=True)
    return TransformFigures(
        name=name,
        matrix=[[fixed(value, 6 if column < 3 else 5) for column, value in enumerate(row)] for row in H],
        quaternion=", ".join(fixed(value, 6) for value in se3.quaternion(H[:3, :3])),
        rotation=[with_sigma(value, spread, "°") for value, spread in rotation],
        position=[with_sigma(value, spread, "mm") for value, spread in zip(1000 * H[:3, 3], shift, strict=True)],
    )

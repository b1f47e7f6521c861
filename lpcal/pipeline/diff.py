"""``lpcal diff``: two calibrations read, compared, said in a table, and drawn over each other.

A surface's folder, or another method's normals, compared with a file of the truth.

``lpcal intrinsics --compare OTHER``: how far another calibration projects from this one, in pixels.

Symbols: p a pixel of this camera, d(p) how far the other camera puts the ray of p from p, a turn of the camera taken out or not. The turn
is fitted over the part of the imager that is looked at; rays are at infinity. See `geometry.camera_difference`.
"""

from __future__ import annotations

from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.comparison import compare_calibrations
from lpcal.api.evaluation import evaluate
from lpcal.api.surfaces import integrate
from lpcal.errors import DisagreementError, LpcalError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import read_camera, read_camera_solution
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.lights_yaml import read_lights
from lpcal.formats.mask_files import read_mask
from lpcal.formats.normal_map import read_depth, read_normals
from lpcal.formats.outputs import marked, refuse_place, write_text
from lpcal.formats.surface_files import read_surface
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Calibration, Camera, LightsSolution
from lpcal.records.comparison import SEEN_SIGMAS, CalibrationChange, LightChange, PartChange
from lpcal.records.outcome import Outcome
from lpcal.records.surface import Surface
from lpcal.report.side_pages import DIFF_MARK, diff_html

CALIBRATION = "calibration.yaml"
PAGE = marked("a page of two rigs", DIFF_MARK)


def diff(one: Path, other: Path, page: Path) -> Outcome:
    """Compare two calibrations and write the page.

    Raises
    ------
    InputError, DisagreementError, DegenerateError
        One cannot be read, or they have too little in common.
    """
    files = [_file(path) for path in (one, other)]
    refuse_place(page, PAGE, files)
    before, after = (read_calibration(path) for path in files)
    change = compare_calibrations(
        before,
        after,
        H_PC_covariances=(_covariance(files[0], before.H_PC), _covariance(files[1], after.H_PC)),
        solutions=(_solution(files[0], before), _solution(files[1], after)),
    )
    lines = lines_of(change)
    write_text(page, diff_html((str(one), str(other)), (before, after), change, remarks_of(change), verdict(change)), PAGE)
    document = {"before": str(files[0]), "after": str(files[1]), "changed": list(change.changed), **asdict(change)}
    document["least"] = {light.name: asdict(light.least) for light in change.lights}
    return Outcome([*lines, verdict(change), f"written {page}"], document, list(change.notes))


def _file(path: Path) -> Path:
    """The calibration that a path names: itself, or that of a rig's folder."""
    inside = [path / CALIBRATION, path / "calib" / CALIBRATION]
    return next((each for each in inside if each.is_file()), path)


def _covariance(path: Path, H_PC: Array | None) -> Array | None:
    """That of the hand-eye, of the file beside the calibration, where it holds the same hand-eye."""
    try:
        found = read_handeye(path.with_name("handeye.yaml"))
    except LpcalError:
        return None
    same = H_PC is not None and found.carries == "camera" and np.allclose(found.H_PC, H_PC, atol=1e-9)
    return found.H_PC_covariance if same else None


def _solution(path: Path, calibration: Calibration) -> LightsSolution | None:
    """What the lights rest on, of the file beside the calibration, where it holds the same lights."""
    try:
        found = read_lights(path.with_name("lights.yaml"))
    except LpcalError:
        return None
    own = {light.name: light.direction_C for light in found.lights}
    same = all(light.name in own and np.allclose(own[light.name], light.direction_C, atol=1e-6) for light in calibration.lights)
    return found if same else None


def verdict(change: CalibrationChange) -> str:
    """The one sentence; where nothing has changed, with how small a move would have shown."""
    if change.changed:
        return f"changed beyond chance: {'; '.join(change.changed)}"
    least = [by for light in change.lights if np.isfinite(by := _least_across(light))]
    if not least:
        return "nothing has changed beyond chance"
    low, high = (f"{_length(by, change.distant):.2f}" for by in (min(least), max(least)))
    span = (low if low == high else f"{low} to {high}") + (" deg" if change.distant else " mm")
    how = "moved across" if np.isfinite(change.highlight_px) else "moved"
    return f"nothing has changed beyond chance; a light {how} by less than {span} would not have shown"


def _length(moved: float, distant: bool) -> float:
    """A move in mm; of a distant light's direction, in degrees."""
    return float(np.degrees(moved)) if distant else 1e3 * moved


def _least_across(light: LightChange) -> float:
    """The larger of what would have shown along its arm and sideways; in any direction where its own frame is not known."""
    across = light.least.moved_L[:2]
    return float(across.max()) if np.isfinite(across).all() else light.least.moved


def lines_of(change: CalibrationChange) -> list[str]:
    """The table, for people: each figure with what an unmoved rig shows."""
    moved = "direction, deg" if change.distant else "moved, mm"
    lines = [f"{'light':<12} {moved:>18} {'axis turned, deg':>20} {'power, %':>18}"]
    lines += [_light_line(light, change.distant) for light in change.lights]
    return [*lines, *_moves(change), *_least_lines(change), *_parts(change)]


def remarks_of(change: CalibrationChange) -> list[str]:
    """What stands beside the tables."""
    return [*_moves(change), *_parts(change)]


def _moves(change: CalibrationChange) -> list[str]:
    """What the moves rest on, and how each light that has moved did."""
    if not np.isfinite(change.highlight_px):
        return []
    lines = [f"moves are by the chrome spheres of both days, whose highlights scatter by {change.highlight_px:.4f} px"]
    return lines + [_own_line(light) for light in change.lights if "moved" in light.says and np.isfinite(light.moved_L).all()]


def _parts(change: CalibrationChange) -> list[str]:
    """The lights together, the hand-eye and the camera."""
    lines = [_part_line("all lights", change.together) + f", distances {100 * change.scale:+.2f} %"]
    if np.isfinite(change.handeye.moved):
        lines.append(_part_line("hand-eye", change.handeye))
    if np.isfinite(change.camera.moved):
        turned = float(np.degrees(change.camera.turned_rad))
        lines.append(
            f"{'camera':<12} {change.camera.moved:.3f} px rms over the image, after a turn of {turned:.3f} deg" + _odds(change.camera)
        )
    return lines


def _light_line(light: LightChange, distant: bool) -> str:
    across = _length(light.moved, distant), _length(light.moved_std, distant)
    turned = float(np.degrees(light.turned_rad)), float(np.degrees(light.turned_std_rad))
    cells = [f"{value:.2f} ({std:.2f})" if np.isfinite(value) else "-" for value, std in (across, turned)]
    power = f"{100 * light.power:+.2f} ({100 * light.power_std:.2f})"
    return f"{light.name:<12} {cells[0]:>18} {cells[1]:>20} {power:>18}" + (f"   <- {', '.join(light.says)}" if light.says else "")


def _own_line(light: LightChange) -> str:
    """How a light that has moved did, in its own frame."""
    by = [f"{1e3 * moved:+.2f} ({1e3 * std:.2f}) mm" for moved, std in zip(light.moved_L, light.moved_L_std, strict=True)]
    if np.isfinite(light.by_azimuth_rad):
        by[1] += f" ({np.degrees(light.by_azimuth_rad):+.2f} deg of azimuth)"
        by[2] += f" ({np.degrees(light.by_joint_rad):+.2f} deg of its joint)"
    return f"  {light.name}: along its arm {by[0]}, sideways {by[1]}, along its emission {by[2]}"


def _least_lines(change: CalibrationChange) -> list[str]:
    """How small a change of each light would have shown; a dash where the comparison does not see that kind of change."""
    in_own_frame = any(np.isfinite(light.moved_L_std).all() for light in change.lights)
    if in_own_frame:
        heads = ["along arm, mm", "sideways, mm (azimuth, deg)", "along emission, mm (joint, deg)"]
    else:
        heads = ["direction, deg" if change.distant else "moved, mm"]
    heads += ["axis turned, deg", "power, %"]
    said = f"smallest changes that would have shown, at {SEEN_SIGMAS:.0f} sigma; smaller ones are not excluded:"
    lines = [said, f"{'light':<12}" + "".join(f"{head:>{len(head) + 2}}" for head in heads)]
    for light in change.lights:
        least = light.least
        turns = [float("nan"), least.azimuth_rad, least.joint_rad]
        cells = [
            _figure(1e3 * by) + (f" ({np.degrees(turn):.2f})" if np.isfinite(turn) else "")
            for by, turn in zip(least.moved_L, turns, strict=True)
        ]
        cells = cells if in_own_frame else [_figure(_length(least.moved, change.distant))]
        cells += [_figure(float(np.degrees(least.turned_rad))), _figure(100 * least.power)]
        lines.append(f"{light.name:<12}" + "".join(f"{cell:>{len(head) + 2}}" for cell, head in zip(cells, heads, strict=True)))
    return lines


def _figure(value: float) -> str:
    return f"{value:.2f}" if np.isfinite(value) else "-"


def _part_line(name: str, part: PartChange) -> str:
    turned, turned_std = float(np.degrees(part.turned_rad)), float(np.degrees(part.turned_std_rad))
    stds = (f" ({1e3 * part.moved_std:.2f})", f" ({turned_std:.3f})") if np.isfinite(part.moved_std) else ("", "")
    return f"{name:<12} {1e3 * part.moved:.2f}{stds[0]} mm, {turned:.3f}{stds[1]} deg" + _odds(part)


def _odds(part: PartChange) -> str:
    return f"; chance of as much in an unmoved rig {part.chance:.2g}" if np.isfinite(part.chance) else ""


def evaluate_files(surface: Path, truth: Path, mask: Path | None) -> Outcome:
    """Compare the two, over the pixels of a mask where one is given.

    Normals without a surface are compared as normals alone: their depth is not theirs.

    Raises
    ------
    LpcalError
        One of the files cannot be read, or they disagree.
    """
    found = read_surface(surface) if surface.is_dir() else _of_normals(surface)
    asked = None if mask is None else read_mask(mask, found.mask.shape)
    said: list[str] = []
    if truth.is_dir():
        result = evaluate(found, read_surface(truth), mask=asked)
    else:
        normals, good = read_normals(truth)
        depth = read_depth(truth) if surface.is_dir() else None
        normals[~good] = 0.0
        result = evaluate(found, normals, depth=depth, mask=asked)
        said = _other_axes(found, normals, asked, result.normal_mean_deg)
    figures = {one.name: getattr(result, one.name) for one in fields(result) if one.name != "angle_deg"}
    return Outcome([*repr(result).splitlines(), *said], {"surface": str(surface), "truth": str(truth), **figures})


TURNED_OVER, CONVENTION_DEG = 0.3, 5.0
"""Share of the mean angle that is left once an axis is turned over, and the least mean angle, from which two maps differ by convention."""


def _other_axes(surface: Surface, normals_C: Image, mask: Mask | None, mean_deg: float) -> list[str]:
    """In words, where the truth's normals agree far better with x or y turned over."""
    if mean_deg < CONVENTION_DEG:
        return []
    turned = {axis: normals_C * np.array(signs, np.float32) for axis, signs in (("x", (-1, 1, 1)), ("y", (1, -1, 1)))}
    left = {axis: evaluate(surface, other, mask=mask).normal_mean_deg for axis, other in turned.items()}
    axis = min(left, key=lambda each: left[each])
    if left[axis] > TURNED_OVER * mean_deg:
        return []
    return [f"  with {axis} of one of them turned over it would be {left[axis]:.3f} deg mean: are they of one convention?"]


def _of_normals(path: Path) -> Surface:
    """Another method's normals, as they are."""
    values, good = read_normals(path)
    return integrate(values, None, good, green="as-is", name=path.stem)


INVERTED_PX = 1e-3
"""A pixel whose ray does not project back to it this closely lies where the lens cannot be inverted, and is left out; so is one
that the other camera puts outside all bounds."""


def compare(workspace: Workspace, other: Path) -> Outcome:
    """The rig's camera.yaml against a camera in any format that lpcal reads.

    Raises
    ------
    InputError
        Either is not there or cannot be read.
    DisagreementError
        Their images are of two sizes.
    """
    path = workspace.calib("camera.yaml")
    own, foreign = read_camera(path), read_camera_file(other)
    if own.image_size != foreign.image_size:
        raise DisagreementError(
            "a camera of {}x{} pixels; this rig's has {}x{}".format(*foreign.image_size, *own.image_size),
            where=str(other),
            needed="two calibrations of one camera, at one image size",
            todo="compare with the calibration of the same images",
        )
    pixels = pixel_grid(own.image_size)
    covered = _covered(path, pixels)
    document: dict[str, Any] = {"other": str(other), "imager": _measures(own, foreign, pixels)}
    if covered.any() and not covered.all():
        document["where_corners_are"] = _measures(own, foreign, pixels[covered])
    document["expected_px"] = _expected(path)
    return Outcome(summary=_lines(document, other), document=document)


def _measures(own: Camera, foreign: Camera, pixels: Array) -> dict[str, Any]:
    """Rms and worst (px), the turn taken out (deg), and both without that turn, over pixels (N, 2)."""
    rays_C = own.unproject(pixels)
    good = np.linalg.norm(own.project(rays_C) - pixels, axis=1) < INVERTED_PX
    good &= np.linalg.norm(foreign.project(rays_C) - pixels, axis=1) < float(np.hypot(*own.image_size))
    if not good.any():
        raise DisagreementError(
            "no ray of this rig's camera lands in the other's image",
            where="--compare",
            needed="two calibrations of one camera",
            todo="compare with the calibration of the same images",
        )
    pixels, rays_C = pixels[good], rays_C[good]
    straight = np.linalg.norm(foreign.project(rays_C) - pixels, axis=1)
    difference, turn = projection_difference(pixels, rays_C, foreign.project)
    apart = np.linalg.norm(difference, axis=1)
    worst = int(apart.argmax())
    return {
        "rms_px": float(np.sqrt(np.mean(apart**2))),
        "worst_px": float(apart[worst]),
        "worst_at_px": pixels[worst],
        "turn_deg": float(np.degrees(np.linalg.norm(turn))),
        "rms_without_turn_px": float(np.sqrt(np.mean(straight**2))),
        "worst_without_turn_px": float(straight.max()),
        "left_out_share": float(1 - good.mean()),
    }


def _covered(path: Path, pixels: Array) -> Mask:
    """The pixels near a place of camera.yaml's grid that corners cover; none where it has no grid."""
    sure = read_camera_solution(path).evidence.projection_uncertainty
    if sure is None:
        return np.zeros(len(pixels), dtype=bool)
    column = np.abs(pixels[:, :1] - sure.columns_px).argmin(axis=1)
    row = np.abs(pixels[:, 1:] - sure.rows_px).argmin(axis=1)
    return np.asarray(sure.covered[row, column])


def _expected(path: Path) -> float | None:
    """What this camera's own sigma makes of it, rms where corners are."""
    sure = read_camera_solution(path).evidence.projection_uncertainty
    return None if sure is None else sure.rms_px


def _lines(document: dict[str, Any], other: Path) -> list[str]:
    lines = [f"compared    calib/camera.yaml with {other}"]
    for key, label in (("imager", "imager"), ("where_corners_are", "corners")):
        if key in document:
            found = document[key]
            at = "({:.0f}, {:.0f})".format(*found["worst_at_px"])
            lines.append(f"{label:<12}{found['rms_px']:.4f} px rms, {found['worst_px']:.4f} px worst at {at}")
            lines.append(
                f"            after a turn of {found['turn_deg']:.4f} deg; without it {found['rms_without_turn_px']:.3f} px rms, "
                f"{found['worst_without_turn_px']:.3f} px worst"
            )
    if document["expected_px"] is not None:
        where = document.get("where_corners_are") or document["imager"]
        ratio = where["rms_px"] / max(document["expected_px"], 1e-12)
        lines.append(
            f"expected    {document['expected_px']:.4f} px rms where corners are, by its own sigma: it is there {ratio:.1f} times it"
        )
    return lines

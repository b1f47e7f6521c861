"""What each record shows of itself: a title, rows of a label and figures, its warnings, and a picture where there is one.

A screen is 24 lines of 100 columns at most: long lists are cut with a count of what is left out. Lengths in mm, angles in degrees.
"""

from __future__ import annotations

import html as escaping
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import singledispatch

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Image
from lpcal.records import pictures
from lpcal.records.calibration import NAMES, Calibration, Camera, CameraSolution, HandEye, Light, LightsSolution, ViewVerdict, Wings
from lpcal.records.digits import fine, fine_each
from lpcal.records.distance import DistanceSensor, SensorSolution
from lpcal.records.evaluation import Evaluation
from lpcal.records.light_field import LightField
from lpcal.records.observations import BoardPoses, BoardViews, PoseStream, RawCapture, SphereView
from lpcal.records.placement import Placement
from lpcal.records.rig import RigFile
from lpcal.records.surface import Surface

COLUMNS, LINES = 100, 24
"""Characters of a line and lines of a screen, of a console as it opens."""
LISTED, WARNED = 12, 3
"""Items of a list, and warnings, that are shown before the rest is counted."""


@dataclass(frozen=True)
class RecordScreen:
    """What a record shows."""

    title: str
    rows: Sequence[tuple[str, str]]
    warnings: Sequence[str] = ()
    picture: Callable[[], str] | None = None
    """HTML of a picture."""


def text(record: object) -> str:
    """A record as lines of text."""
    screen = screen_of(record)
    rows = [*screen.rows, *(("warning", one) for one in screen.warnings[:WARNED])]
    rows += [("", f"and {len(screen.warnings) - WARNED} more warnings")] * (len(screen.warnings) > WARNED)
    width = max((len(label) for label, _ in rows), default=0)
    lines = [screen.title] + [f"  {label:<{width}}  {figures}".rstrip() for label, figures in rows]
    lines = [_cut(line) for line in lines]
    return "\n".join(lines if len(lines) <= LINES else [*lines[: LINES - 1], f"  and {len(lines) - LINES + 1} lines more"])


def html(record: object) -> str:
    """A record as a table for a notebook, with its picture."""
    screen = screen_of(record)
    say = escaping.escape
    rows = [*screen.rows, *(("warning", one) for one in screen.warnings)]
    left = "style='text-align:left'"
    cells = "".join(f"<tr><th {left}>{say(label)}</th><td {left}>{say(figures)}</td></tr>" for label, figures in rows)
    picture = screen.picture() if screen.picture is not None else ""
    return f"<div><b>{say(screen.title)}</b><table>{cells}</table>{picture}</div>"


def _cut(line: str) -> str:
    return line if len(line) <= COLUMNS else line[: COLUMNS - 4].rstrip() + " ..."


@singledispatch
def screen_of(record: object) -> RecordScreen:
    """What a record shows."""
    raise TypeError(type(record).__name__)


@screen_of.register
def _camera(camera: Camera) -> RecordScreen:
    return RecordScreen(f"Camera {camera.model}, {camera.image_size[0]} x {camera.image_size[1]} px", _lens(camera))


def _lens(camera: Camera) -> list[tuple[str, str]]:
    K, names = camera.K, list(camera.parameters)
    sigma = {} if camera.covariance is None else dict(zip(names, np.sqrt(np.abs(np.diag(camera.covariance))), strict=False))

    def figure(value: float, name: str) -> str:
        return f"{value:.3f}{_sigma(sigma.get(name))}"

    rows = [
        ("focal length", f"{figure(K[0, 0], 'fx')}, {figure(K[1, 1], 'fy')} px"),
        ("centre", f"{figure(K[0, 2], 'cx')}, {figure(K[1, 2], 'cy')} px"),
    ]
    if camera.distortion.size:
        rows.append(("distortion", _numbers(camera.distortion, 5)))
    if np.isfinite(camera.rms_px):
        rows.append(("residual", f"{camera.rms_px:.3f} px rms, a coordinate"))
    levels = [f"gamma {camera.gamma}"] * (camera.gamma != 1.0)
    levels += [f"black {100 * camera.black_level:.3g} %"] * (camera.black_level != 0)
    levels += [f"white {100 * camera.white_level:.4g} %"] * (camera.white_level != 1) + ["flat field"] * (camera.flat_field is not None)
    return [*rows, ("sensor", ", ".join(levels) or "linear, black at 0")]


@screen_of.register
def _camera_solution(found: CameraSolution) -> RecordScreen:
    size = found.camera.image_size
    rows = [*_lens(found.camera), ("corners", f"{fine(found.corner_sigma_px, 3)} px, one sigma"), *_views(found.views)]
    return RecordScreen(f"CameraSolution {found.camera.model}, {size[0]} x {size[1]} px, by {found.solver}", rows, found.warnings)


@screen_of.register
def _beam(found: DistanceSensor) -> RecordScreen:
    std = np.sqrt(np.abs(np.diag(found.covariance)))
    rows = [
        ("position", f"{_numbers(1e3 * found.position_C, 2)} +- {fine_each(1e3 * std[:3])} mm"),
        ("direction", f"{_numbers(found.direction_C, 5)} +- {fine_each(np.degrees(std[3:6]), 3)} deg"),
        (
            "reading",
            f"{1e3 * found.bias_m:+.2f}{_sigma(std[6], 1e3)} mm + {found.scale:.4f}{_sigma(std[7])} t, noise {1e3 * found.noise_m:.2f} mm",
        ),
    ]
    return RecordScreen("DistanceSensor: a beam in C", rows)


@screen_of.register
def _sensor_solution(found: SensorSolution) -> RecordScreen:
    left = [f"{one.name}: {one.why}" for one in found.readings if not one.used]
    rows = [*screen_of(found.sensor).rows, ("readings", f"{found.evidence.readings_used} of {len(found.readings)} used")]
    rows += [("residual", f"{1e3 * found.evidence.residual_rms_m:.2f} mm rms"), *(("left out", one) for one in left[:LISTED])]
    return RecordScreen("SensorSolution: the distance sensor", rows, found.warnings)


@screen_of.register
def _placement(found: Placement) -> RecordScreen:
    rows = [*_pose(found.name, found.H_AC, found.covariance), ("from", found.source or "the caller")]
    return RecordScreen(f"Placement: the camera in {found.frame}", rows, found.notes)


@screen_of.register
def _hand_eye(found: HandEye) -> RecordScreen:
    camera, board = found.names
    clock = "none, or the data do not show it"
    if found.clock_offset_s is not None:
        clock = f"t_camera = t_mocap {1e3 * found.clock_offset_s:+.2f}{_sigma(found.clock_offset_std_s, 1e3)} ms"
    rows = [
        *_pose(camera, found.H_PC, found.H_PC_covariance),
        *_pose(board, found.H_OB, found.H_OB_covariance),
        ("clock", clock),
        *_views(found.views),
    ]
    return RecordScreen(f"HandEye: the tracked body carries the {found.carries}", rows, found.warnings)


def _pose(name: str, H_AB: Array, covariance: Array) -> list[tuple[str, str]]:
    """A transform: where its origin is and how it is turned, with one sigma an axis."""
    turn_deg = np.degrees(se3.log(H_AB)[:3])
    sigma_deg = np.degrees(np.sqrt(np.abs(np.diag(covariance)))[:3])
    return [
        (name, f"at {_numbers(1e3 * H_AB[:3, 3], 2)} +- {fine_each(1e3 * se3.origin_sigmas(H_AB, covariance))} mm"),
        ("", f"turned by {_numbers(turn_deg, 3)} +- {fine_each(sigma_deg, 3)} deg (rotation vector)"),
    ]


def _views(views: Sequence[ViewVerdict]) -> list[tuple[str, str]]:
    """How many views were used, how well they fit, and why others were left out."""
    if not views:
        return []
    used = [view for view in views if view.used]
    parts = [f"{len(used)} of {len(views)} used"]
    for key, scale, unit in (("residual_px", 1.0, "px"), ("residual_m", 1e3, "mm"), ("residual_rad", 180 / np.pi, "deg")):
        values = [getattr(view, key) for view in used if getattr(view, key) is not None]
        parts += [f"{fine(scale * float(np.sqrt(np.mean(np.square(values)))), 3)} {unit} rms"] if values else []
    left = [f"{view.image}: {view.why}" for view in views if not view.used]
    rows = [("views", ", ".join(parts))]
    return rows + ([("left out", left[0] + (f"; and {len(left) - 1} more" if len(left) > 1 else ""))] if left else [])


@screen_of.register
def _wings(wings: Wings) -> RecordScreen:
    sigma_mm = [1e3 * se3.origin_sigmas(H, wings.covariance[6 * k : 6 * k + 6, 6 * k : 6 * k + 6]) for k, H in enumerate(wings.H_CL)]
    rows = [
        (wing.name, f"at {_numbers(1e3 * H_CL[:3, 3], 1)} +- {fine_each(sigma)} mm, joint {np.degrees(wing.joint_angle_rad):.1f} deg")
        for wing, H_CL, sigma in zip(wings.wings, wings.H_CL, sigma_mm, strict=True)
    ]
    places_C = {wing.name: H_CL[:3, 3] for wing, H_CL in zip(wings.wings, wings.H_CL, strict=True)}
    title = f"Wings: {len(wings.wings)} lights as designed, axes meet {1e3 * wings.d_object_m:.1f} mm before the disc"
    return RecordScreen(title, _some(rows), picture=lambda: pictures.lights(places_C))


@screen_of.register
def _light(light: Light) -> RecordScreen:
    return RecordScreen(f"Light {light.name}", [*_place(light), ("lobe", light.lobe.kind)])


def _place(light: Light) -> list[tuple[str, str]]:
    """Where a light is, from where it shines, how strong it is."""
    turn = _sigma(np.degrees(light.direction_std_rad))
    rows = [("direction", f"{_numbers(light.direction_C, 3)}{turn}{' deg' if turn else ''}")]
    if light.source_C is not None:
        rows.insert(0, ("source", f"{_numbers(1e3 * light.source_C, 1)}{_sigma(1e3 * light.position_std_m)} mm"))
    return [*rows, ("intensity", f"{_numbers(light.intensity, 3)}{_sigma(light.intensity_std)}")]


def _lights(lights: Sequence[Light]) -> list[tuple[str, str]]:
    return _some([(light.name, "  ".join(figures for _, figures in _place(light))) for light in lights])


def _places(lights: Sequence[Light]) -> dict[str, Array]:
    return {light.name: light.direction_C if light.source_C is None else light.source_C for light in lights}


@screen_of.register
def _lights_solution(found: LightsSolution) -> RecordScreen:
    used = sum(sphere.used for sphere in found.spheres)
    title = f"LightsSolution: {len(found.lights)} lights from {used} of {len(found.spheres)} spheres"
    return RecordScreen(title, _lights(found.lights), found.warnings, lambda: pictures.lights(_places(found.lights)))


@screen_of.register
def _calibration(found: Calibration) -> RecordScreen:
    camera = (
        "none: parallel rays"
        if found.camera is None
        else f"{found.camera.model}, {found.camera.image_size[0]} x {found.camera.image_size[1]} px"
    )
    rows = [("camera", camera)]
    rows += [("distance", f"{1e3 * found.d_object_m:.1f} mm, where the lights' axes meet")] if found.d_object_m is not None else []
    if not found.lights:
        rows += [] if found.H_PC is None else [(NAMES[found.carries][0], f"origin at {_numbers(1e3 * found.H_PC[:3, 3], 2)} mm")]
        return RecordScreen(f"Calibration {found.name}: no lights", rows, found.warnings)
    rows += _lights(found.lights)
    title = f"Calibration {found.name}: {len(found.lights)} lights (source in mm, direction, intensity)"
    return RecordScreen(title, rows, found.warnings, lambda: pictures.lights(_places(found.lights)))


@screen_of.register
def _light_field(field: LightField) -> RecordScreen:
    shape = field.irradiance.shape
    rows = [
        (name, f"irradiance {one.min():.4g} to {one.max():.4g}, {int(beyond.sum())} points extrapolated")
        for name, one, beyond in zip(field.names, field.irradiance, field.extrapolated, strict=True)
    ]
    return RecordScreen(
        f"LightField: {len(field.names)} lights at {int(np.prod(shape[1:-1]))} points, {shape[-1]} channels", _some(rows), field.warnings
    )


@screen_of.register
def _surface(surface: Surface) -> RecordScreen:
    unit, scale = ("mm", 1e3) if surface.metric else ("px", 1.0)
    inside = surface.mask & np.isfinite(surface.depth)
    height, width = surface.mask.shape
    rows = [("pixels", f"{int(surface.mask.sum())} of {width} x {height}")]
    if inside.any():
        low, high = np.percentile(surface.depth[inside], [1, 99])
        sigma = _sigma(_median(surface.depth_std[inside]), scale)
        rows.append(("depth", f"{scale * low:.2f} to {scale * high:.2f} {unit} (1 % to 99 %){sigma}"))
        rows.append(("albedo", f"{np.nanmedian(surface.albedo[inside]):.4g} (median)"))
        used = int(np.median(surface.lights_used[inside]))
        rows += [("lights", f"{used} used a pixel (median)")] * (used > 0)
    for piece in surface.components[:LISTED]:
        sigma = _sigma(piece.scale_std * piece.mean_depth_m, scale) if surface.metric else ""
        place = f"at {scale * piece.mean_depth_m:.1f}{sigma} {unit}"
        others = "".join(f", or {scale * one.mean_depth_m:.1f} {unit} (odds {100 * one.odds:.0f} %)" for one in piece.alternatives)
        rows.append((f"piece {piece.label}", f"{piece.pixels} pixels {place}{others}"))
    return RecordScreen(f"Surface {surface.name}", rows, surface.warnings, lambda: pictures.surface(surface))


@screen_of.register
def _evaluation(found: Evaluation) -> RecordScreen:
    rows = [
        ("pixels", str(found.pixels)),
        ("normals", f"{found.normal_mean_deg:.3f} deg mean, {found.normal_median_deg:.3f} median, {found.normal_p95_deg:.3f} at 95 %"),
    ]
    rows += [("sigmas", f"the angles are {found.normal_z_rms:.2f} times as large as predicted")] * bool(np.isfinite(found.normal_z_rms))
    if np.isfinite(found.depth_rms_m):
        unit, scale = ("mm", 1e3) if found.metric else ("px", 1.0)
        shape, whole = (f"{scale * rms:.3f} {unit}" for rms in (found.depth_rms_m, found.depth_absolute_rms_m))
        ratio = f", scale {found.scale:.4f}" if np.isfinite(found.scale) else ""
        rows.append(("depth", f"{shape} rms of the shape, {whole} as it is{ratio}"))
    rows += [("mask", f"{100 * found.mask_iou:.1f} % in common")] * bool(np.isfinite(found.mask_iou))
    return RecordScreen(
        f"Evaluation of {found.name}", rows, picture=lambda: pictures.heat(found.angle_deg, "angle between the normals, deg")
    )


@screen_of.register
def _pose_stream(stream: PoseStream) -> RecordScreen:
    t_s, x_mm = stream.t_s, 1e3 * stream.H_OP[:, :3, 3]
    rate = f" at {stream.rate_hz:.4g} Hz" if np.isfinite(stream.rate_hz) else ""
    rows = [
        ("samples", f"{len(t_s)}{rate}, {stream.lost} lost"),
        ("time", f"{t_s[0]:.3f} to {t_s[-1]:.3f} s" if len(t_s) else "none"),
        ("moves over", f"{_numbers(np.ptp(x_mm, axis=0), 1)} mm along x, y, z of O" if len(t_s) else "nothing"),
        ("markers", ", ".join(list(stream.markers_O)[:LISTED]) or "none"),
        *([("format", stream.format)] if stream.format else []),
    ]
    return RecordScreen(f"PoseStream of {stream.body or 'a body'}", rows, stream.notes)


@screen_of.register
def _raw_capture(raw: RawCapture) -> RecordScreen:
    shape, t_s = raw.images.shape, raw.exposure_s
    kind = "RGB" if len(shape) == 4 else "grey"
    rows = [
        ("lights", ", ".join(raw.lights[:LISTED]) + _more(len(raw.lights))),
        ("images", f"{shape[2]} x {shape[1]} px, {kind}, {100 * raw.images.max():.1f} % of full scale at most"),
        ("exposure", f"{t_s.min():.4g} to {t_s.max():.4g} s" if np.ptp(t_s) else f"{t_s[0]:.4g} s"),
        ("ambient", "none" if raw.ambient is None else f"{len(raw.ambient)} images"),
        ("short", ", ".join(list(raw.short)[:LISTED]) or "none"),
        ("mask", "none" if raw.mask is None else f"{int(raw.mask.sum())} pixels"),
    ]
    return RecordScreen(f"RawCapture {raw.name}: {len(raw.lights)} lights", rows, raw.notes, lambda: pictures.grey(raw.images.mean(axis=0)))


@screen_of.register
def _sphere_view(view: SphereView) -> RecordScreen:
    centre = view.outline_px.mean(axis=0) if len(view.outline_px) else np.full(2, np.nan)
    radius = np.linalg.norm(view.outline_px - centre, axis=1).mean() if len(view.outline_px) else np.nan
    rows = [
        (
            "outline",
            f"{len(view.outline_px)} points about {_numbers(centre, 1)} px, {radius:.1f} px in radius, +- {fine(view.outline_sigma_px, 3)}",
        )
    ]
    rows += _some([(name, f"highlight at {_numbers(at, 2)} px") for name, at in view.highlights_px.items()])
    return RecordScreen(f"SphereView {view.name}, {view.kind}", rows, view.notes)


@screen_of.register
def _rig_file(found: RigFile) -> RecordScreen:
    rig = found.rig
    named = {"lights": [*rig.lights], "spheres": [*rig.spheres], "objects": [*rig.objects]}
    rows = [("file", str(found.file))]
    if rig.board is not None:
        squares = " x ".join(f"{1e3 * side:g}" for side in rig.board.square)
        rows.append(("board", f"{rig.board.kind}, {rig.board.corners[0]} x {rig.board.corners[1]} inner corners, squares of {squares} mm"))
    rows += [("mocap", str(rig.mocap.file or rig.mocap.poses))] if rig.mocap is not None else []
    rows += [(key, ", ".join(names[:LISTED]) + _more(len(names))) for key, names in named.items() if names]
    return RecordScreen(f"RigFile {rig.name}", rows)


@screen_of.register
def _board_views(boards: BoardViews) -> RecordScreen:
    found = [view for view in boards.views if view.corners_px is not None]
    rows = [("boards", f"found in {len(found)} of {len(boards.views)} images of {boards.image_size[0]} x {boards.image_size[1]} px")]
    blurs = [view.blur_px for view in found if np.isfinite(view.blur_px)]
    rows += [("blur", f"{np.median(blurs):.2f} px, one sigma (median)")] if blurs else []
    rows += _some([(view.image, str(view.why)) for view in boards.views if view.corners_px is None])
    corners = [view.corners_px for view in found if view.corners_px is not None]
    return RecordScreen("BoardViews", rows, picture=lambda: pictures.points(corners, boards.image_size))


@screen_of.register
def _board_poses(poses: BoardPoses) -> RecordScreen:
    z_mm = 1e3 * poses.H_CB[:, 2, 3]
    rows = [("poses", f"{len(poses.images)} of {len(poses.images) + len(poses.without)} images")]
    rows += [("distance", f"{z_mm.min():.1f} to {z_mm.max():.1f} mm")] if len(z_mm) else []
    if poses.covariance is not None and len(z_mm):
        sigma = np.median([1e3 * se3.origin_sigmas(H, C) for H, C in zip(poses.H_CB, poses.covariance, strict=True)], axis=0)
        rows.append(("sigma", f"{fine_each(sigma)} mm along x, y, z of C (median)"))
    rows += [("residual", f"{np.median(poses.rms_px):.3f} px rms, a coordinate (median)")] if poses.rms_px is not None and len(z_mm) else []
    return RecordScreen("BoardPoses", rows + _some(list(poses.without.items())))


def _more(count: int) -> str:
    return f" and {count - LISTED} more" if count > LISTED else ""


def _median(values: Array | Image) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if known.size else float("nan")


def _sigma(value: float | None, scale: float = 1.0) -> str:
    """`` +- sigma``, or nothing where none is known."""
    return "" if value is None or not np.isfinite(value) else f" +- {fine(scale * float(value), 3)}"


def _numbers(values: Array, digits: int) -> str:
    return "[" + " ".join(f"{value:.{digits}f}" for value in np.ravel(values).round(digits) + 0.0) + "]"  # no minus before zero


def _some(rows: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """The first of many rows, and how many are left out."""
    return rows if len(rows) <= LISTED else [*rows[:LISTED], ("", f"and {len(rows) - LISTED} more")]

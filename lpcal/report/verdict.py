"""What each stage found, in a line, and whether it is fit for use: good, fair, poor, or not judged.

The gates are those of lpcal's own aims: one standard deviation at or under the first figure is good, at or under the second fair.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.records.calibration import HandEye, Wings
from lpcal.records.camera import ViewVerdict
from lpcal.records.distance import SensorSolution
from lpcal.report.rig_report import RigReport, SurfaceReport, origin_sigmas, sigmas
from lpcal.report.wording import fixed, grouped, listed, number, plural, sigma_of, with_sigma

GATES = {
    "camera_rms_px": (0.3, 0.7),
    "camera_focal_percent": (0.2, 1.0),
    "handeye_deg": (0.08, 0.25),
    "handeye_mm": (0.8, 2.5),
    "clock_ms": (0.5, 2.0),
    "distance_mm": (5.0, 15.0),
    "light_deg": (0.2, 0.6),
    "light_percent": (2.0, 5.0),
    "surface_percent": (1.5, 5.0),
}
GATE_WORDS = {
    "camera_rms_px": "rms ≤ {:g} px",
    "camera_focal_percent": "focal length ≤ {:g} %",
    "handeye_deg": "rotation ≤ {:g}°",
    "handeye_mm": "position ≤ {:g} mm",
    "clock_ms": "clock ≤ {:g} ms",
    "distance_mm": "point ≤ {:g} mm",
    "light_deg": "direction ≤ {:g}°",
    "light_percent": "intensity ≤ {:g} %",
    "surface_percent": "distance ≤ {:g} %",
}
UNREFINED = "As the calibration states them: whether spheres refined them it does not say."
type Level = Literal["good", "fair", "poor"]
type Tone = Literal["good", "fair", "poor", "none", "absent"]
"""A level; or none where nothing is judged, absent where a stage is not there."""
LEVELS: tuple[Level, ...] = ("good", "fair", "poor")
WORDS: dict[Tone, str] = {"good": "good", "fair": "fair", "poor": "poor", "none": "not judged", "absent": "not there"}


@dataclass(frozen=True)
class Verdict:
    """One stage's line."""

    stage: str
    title: str
    tone: Tone
    found: str
    gate: str = ""
    notes: tuple[str, ...] = ()

    @property
    def word(self) -> str:
        """The tone in words."""
        return WORDS[self.tone]


def verdicts(report: RigReport) -> list[Verdict]:
    """A line a stage, in the chain's order; of parts that the rig does not have the camera alone: without it rays are parallel."""
    lines = [_camera(report), _handeye(report.handeye), _wings(report.wings), *_distance(report.distance), _lights(report)]
    needless = {part for part in ("handeye", "wings", "lights") if report.left_out(part)}
    if report.left_out("camera") and "lights" in needless:
        needless.add("camera")  # a hand-eye alone: no rays are taken
    lines = [line for line in lines if line.stage not in needless]
    return [*lines, *(_surface(surface) for surface in report.surfaces)]


def headline(lines: list[Verdict]) -> tuple[Tone, str]:
    """The worst tone of all, and a sentence for it."""
    tones = [line.tone for line in lines]
    judged = [level for level in LEVELS if level in tones]
    if not judged:
        return "none", "Nothing here has been judged yet."
    worst = judged[-1]
    weak = [line.title.lower() if line.stage != "surface" else line.title for line in lines if line.tone == worst]
    return worst, {
        "good": "Fit for use: every stage that has run passes its gate.",
        "fair": f"Usable with care: look at {_few(weak)}.",
        "poor": f"Not to be relied on: {_few(weak)} failed the gate.",
    }[worst]


def _few(names: list[str]) -> str:
    return listed(names) if len(names) <= 3 else f"{', '.join(names[:3])} and {len(names) - 3} more"


def _level(*measured: tuple[float, str]) -> Tone:
    """The worst level of some figures against their gates; NaN is not judged."""
    found = [np.searchsorted(GATES[gate], value, side="left") for value, gate in measured if np.isfinite(value)]
    return LEVELS[int(max(found))] if found else "none"


def _gate(*measured: tuple[float, str]) -> str:
    """The gates for good of the figures that there are, in words."""
    return ", ".join(GATE_WORDS[gate].format(GATES[gate][0]) for value, gate in measured if np.isfinite(value))


def _lower(tone: Tone, notes: tuple[str, ...]) -> Tone:
    return "fair" if notes and tone == "good" else tone


def _used(views: Sequence[ViewVerdict]) -> str:
    return f", {sum(view.used for view in views)} of {plural(len(views), 'view')}" if views else ""


def _camera(report: RigReport) -> Verdict:
    camera = report.lens
    if camera is None and report.calibration is not None:
        return Verdict("camera", "Camera", "absent", "No camera: rays are taken as parallel, and no distance is known.")
    if camera is None:
        return Verdict("camera", "Camera", "absent", "No intrinsics: lpcal intrinsics, or camera.cameramodel in panel.yaml.")
    focal, sigma = float(camera.K[0, 0]), camera.std_of("fx")
    found = f"{camera.model}, fx {with_sigma(focal, sigma, 'px')}"
    found += f", rms {number(camera.rms_px, 2, 'px')} a coordinate" if np.isfinite(camera.rms_px) else ", as given"
    found += "" if report.camera is None else _used(report.camera.views)
    measured = ((camera.rms_px, "camera_rms_px"), (100 * sigma / focal, "camera_focal_percent"))
    notes = () if report.camera is None else report.camera.warnings
    return Verdict("camera", "Camera", _lower(_level(*measured), notes), found, _gate(*measured), notes)


def _handeye(handeye: HandEye | None) -> Verdict:
    if handeye is None:
        return Verdict("handeye", "Hand-eye", "absent", "No hand-eye: lpcal handeye. A rig without motion capture needs none.")
    sigma = origin_sigmas(handeye.H_PC, handeye.H_PC_covariance)
    turn, shift = float(np.degrees(sigma[:3].max())), float(1000 * sigma[3:].max())
    offset, clock = handeye.clock_offset_s, 1000 * (handeye.clock_offset_std_s or float("nan"))
    found = f"{handeye.names[0]} within {sigma_of(turn, 3, '°')} and {sigma_of(shift, 2, 'mm')} an axis"
    found += f", clock offset {with_sigma(1000 * offset, clock, 'ms')}" if offset is not None else ", no clock offset"
    found += _used(handeye.views)
    measured = ((turn, "handeye_deg"), (shift, "handeye_mm"), (clock if offset is not None else float("nan"), "clock_ms"))
    notes = handeye.warnings
    return Verdict("handeye", "Hand-eye", _lower(_level(*measured), notes), found, _gate(*measured), notes)


def _distance(found: SensorSolution | None) -> list[Verdict]:
    """The distance sensor's line, for a rig that has one."""
    if found is None:
        return []
    sensor, evidence = found.sensor, found.evidence
    at_m = sensor.bias_m + sensor.scale * float(np.mean(evidence.span_m))
    known_mm = 1000 * float(np.hypot(np.sqrt(max(sensor.std_m(at_m) ** 2 - sensor.noise_m**2, 0.0)), sensor.across_std_m(at_m)))
    said = f"{evidence.readings_used} of {plural(len(found.readings), 'reading')}, {fixed(1000 * evidence.residual_rms_m, 2, 'mm')} rms"
    said += f"; bias {with_sigma(1000 * sensor.bias_m, 1000 * sigmas(sensor.covariance, 8)[6], 'mm')}"
    said += f", the point that is meant within {fixed(known_mm, 1, 'mm')}"
    measured = (known_mm, "distance_mm")
    return [Verdict("distance", "Distance sensor", _lower(_level(measured), found.warnings), said, _gate(measured), found.warnings)]


def _wings(wings: Wings | None) -> Verdict:
    if wings is None:
        return Verdict("wings", "Wings", "absent", "No wings: a rig whose lights are not described has no prior.")
    found = f"{plural(len(wings.wings), 'light')} as designed"
    found += f", axes meet at {fixed(1000 * wings.d_object_m, 1, 'mm')}" if np.isfinite(wings.d_object_m) else ""
    position, axis = 1000 * _worst(wings.position_std_m), float(np.degrees(_worst(wings.axis_std_rad)))
    found += f", known to {fixed(position, 1, 'mm')} and {fixed(axis, 1, '°')} an axis" if np.isfinite(position) else ""
    return Verdict("wings", "Wings", "none", found, "the prior: refined by the spheres")


def _lights(report: RigReport) -> Verdict:
    placed = report.placed
    if placed is None or not placed.lights:
        said = "No lights: lpcal refine, or lpcal export." if placed is None else "No lights: the rig states none."
        return Verdict("lights", "Lights", "absent", said)
    lights, spheres = placed.lights, () if report.lights is None else report.lights.spheres
    direction = float(np.degrees(_worst([light.direction_std_rad for light in lights])))
    position = 1000 * _worst([light.position_std_m for light in lights])
    intensity = 100 * _worst([light.intensity_std for light in lights]) if report.intensities_measured else float("nan")
    found = plural(len(lights), "light")
    found += f", worst direction {sigma_of(direction, 2, '°')} an axis" if np.isfinite(direction) else ""
    found += f", position {sigma_of(position, 1, 'mm')}" if np.isfinite(position) else ""
    found += f", intensity {sigma_of(intensity, 1, '%')}" if np.isfinite(intensity) else ""
    found += "" if report.intensities_measured else ", intensity not measured"
    found += f", {sum(sphere.used for sphere in spheres)} of {plural(len(spheres), 'sphere')}" if spheres else ""
    measured = ((direction, "light_deg"), (intensity, "light_percent"))
    level = _lower(_level(*measured), placed.warnings)
    notes = placed.warnings if report.lights is not None else (UNREFINED, *placed.warnings)
    return Verdict("lights", "Lights", level, found, _gate(*measured), notes)


def _worst(values: Sequence[float] | Array) -> float:
    """The largest of those that are known; NaN where none is."""
    return max((float(value) for value in values if np.isfinite(value)), default=float("nan"))


def _surface(surface: SurfaceReport) -> Verdict:
    """The line of a surface: its level is that of most of its pixels, and no better than fair where a smaller piece is less sure."""
    summary = surface.summary
    pieces = summary.components
    known = [piece for piece in pieces if summary.metric and np.isfinite(piece.scale_std)]
    measured = [(100 * piece.scale_std, "surface_percent") for piece in known]
    levels = [_level(one) for one in measured]
    pixels = sum(piece.pixels for piece in pieces)
    found = f"{grouped(pixels)} pixels in {plural(len(pieces), 'piece')}" if pieces else "a surface"
    if not known:
        return Verdict("surface", surface.name, "none", found)
    if known[0] is pieces[0] and np.isfinite(depth := pieces[0].mean_depth_m):
        spread = 100 * pieces[0].scale_std
        found += f", {with_sigma(1000 * depth, 10 * spread * depth, 'mm')} away ({fixed(spread, 1, '%')})"
    level = _of_most(levels, [piece.pixels for piece in known])
    unsure = [piece for piece, one in zip(known, levels, strict=True) if one != "good" and piece is not pieces[0]]
    if unsure:
        level = "fair" if level == "good" else level
        worst = max(unsure, key=lambda piece: piece.scale_std)
        found += f"; its piece {worst.label} of {grouped(worst.pixels)} pixels is known to {fixed(100 * worst.scale_std, 1, '%')} only"
    return Verdict("surface", surface.name, level, found, _gate(measured[0]))


def _of_most(levels: Sequence[Tone], pixels: Sequence[int]) -> Tone:
    """The best level that pieces with half of all pixels reach."""
    order = sorted(zip(levels, pixels, strict=True), key=lambda one: LEVELS.index(one[0]))
    reached = np.cumsum([count for _, count in order])
    return order[int(np.searchsorted(reached, reached[-1] / 2))][0]

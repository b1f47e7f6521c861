"""What each stage found, in a line, and whether it is fit for use: good, fair, poor, or not judged.

The gates are those of lpcal's own aims: one standard deviation at or under the first figure is good, at or under the second fair.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.report.rig_report import RigReport, SurfaceReport, array, items, origin_sigmas, sigmas
from lpcal.report.wording import Document, fixed, number, plural, sigma_of, with_sigma

GATES = {
    "camera_rms_px": (0.3, 0.7),
    "camera_focal_percent": (0.2, 1.0),
    "handeye_deg": (0.08, 0.25),
    "handeye_mm": (0.8, 2.5),
    "clock_ms": (0.5, 2.0),
    "light_deg": (0.2, 0.6),
    "light_percent": (2.0, 5.0),
    "surface_percent": (1.0, 3.0),
}
GATE_WORDS = {
    "camera_rms_px": "rms ≤ {:g} px",
    "camera_focal_percent": "focal length ≤ {:g} %",
    "handeye_deg": "hand-eye ≤ {:g}°",
    "handeye_mm": "hand-eye ≤ {:g} mm",
    "clock_ms": "clock ≤ {:g} ms",
    "light_deg": "direction ≤ {:g}°",
    "light_percent": "intensity ≤ {:g} %",
    "surface_percent": "distance ≤ {:g} %",
}
LEVELS = ("good", "fair", "poor")
WORDS = {"good": "good", "fair": "fair", "poor": "poor", "none": "not judged", "absent": "not there"}


@dataclass(frozen=True)
class Verdict:
    """One stage's line: tone is good | fair | poor | none | absent."""

    stage: str
    title: str
    tone: str
    found: str
    gate: str = ""
    notes: tuple[str, ...] = ()

    @property
    def word(self) -> str:
        """The tone in words."""
        return WORDS[self.tone]


def verdicts(report: RigReport) -> list[Verdict]:
    """A line a stage, in the chain's order."""
    lines = [
        _camera(report.camera, lights=bool(report.get("calibration"))),
        _handeye(report.get("handeye")),
        _wings(report.get("wings")),
        _lights(report),
    ]
    return [*lines, *(_surface(surface) for surface in report.surfaces)]


def headline(lines: list[Verdict]) -> tuple[str, str]:
    """The worst tone of all, and a sentence for it."""
    tones = [line.tone for line in lines]
    judged = [tone for tone in tones if tone in LEVELS]
    if not judged:
        return "none", "Nothing here has been judged yet."
    worst = max(judged, key=LEVELS.index)
    weak = [line.title.lower() if line.stage != "surface" else line.title for line in lines if line.tone == worst]
    return worst, {
        "good": "Fit for use: every stage that has run passes its gate.",
        "fair": f"Usable with care: look at {_few(weak)}.",
        "poor": f"Not to be relied on: {_few(weak)} failed the gate.",
    }[worst]


def _few(names: list[str]) -> str:
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _level(*measured: tuple[float, str]) -> str:
    """The worst level of some figures against their gates; NaN is not judged."""
    found = [np.searchsorted(GATES[gate], value, side="left") for value, gate in measured if np.isfinite(value)]
    return LEVELS[int(max(found))] if found else "none"


def _gate(*measured: tuple[float, str]) -> str:
    """The gates for good of the figures that there are, in words."""
    return ", ".join(GATE_WORDS[gate].format(GATES[gate][0]) for value, gate in measured if np.isfinite(value))


def _lower(tone: str, notes: tuple[str, ...]) -> str:
    return "fair" if notes and tone == "good" else tone


def _warnings(document: Document) -> tuple[str, ...]:
    return tuple(str(line) for line in document.get("warnings") or ())


def _camera(document: Document, *, lights: bool) -> Verdict:
    if not document and lights:
        return Verdict("camera", "Camera", "absent", "No camera: rays are taken as parallel, and no distance is known.")
    if not document:
        return Verdict("camera", "Camera", "absent", "No intrinsics: lpcal intrinsics, or camera.cameramodel in panel.yaml.")
    K = document.get("K")
    names = list(document.get("parameters") or [])
    sigma = dict(zip(names, sigmas(document.get("covariance"), len(names)), strict=True)).get("fx", float("nan"))
    focal = float(K[0][0]) if K else float("nan")
    rms = float(document.get("rms_px") or "nan")
    views = items(document, "views")
    used = sum(bool(view.get("used")) for view in views)
    found = f"{document.get('model', 'a camera')}, fx {with_sigma(focal, sigma, 'px')}"
    found += f", rms {number(rms, 2, 'px')} a coordinate" if np.isfinite(rms) else ", as given"
    found += f", {used} of {plural(len(views), 'view')}" if views else ""
    measured = ((rms, "camera_rms_px"), (100 * sigma / focal, "camera_focal_percent"))
    notes = _warnings(document)
    return Verdict("camera", "Camera", _lower(_level(*measured), notes), found, _gate(*measured), notes)


def _handeye(document: Document) -> Verdict:
    if not document:
        return Verdict("handeye", "Hand-eye", "absent", "No hand-eye: lpcal handeye. A rig without motion capture needs none.")
    name = "H_OC" if document.get("H_OC") else "H_PC"
    sigma = origin_sigmas(array(document[name]), document.get(f"{name}_covariance"))
    turn, shift = np.degrees(sigma[:3].max()), 1000 * sigma[3:].max()
    offset, offset_std = document.get("clock_offset_s"), document.get("clock_offset_std_s")
    offset_ms, clock = (None, float("nan")) if offset is None else (1000 * offset, 1000 * (offset_std or float("nan")))
    views = items(document, "views")
    used = sum(bool(view.get("used")) for view in views)
    found = f"{name} within {sigma_of(turn, 3, '°')} and {sigma_of(shift, 2, 'mm')} an axis"
    found += f", clock offset {with_sigma(offset_ms, clock, 'ms')}" if offset_ms is not None else ", no clock offset"
    found += f", {used} of {plural(len(views), 'view')}" if views else ""
    measured = ((turn, "handeye_deg"), (shift, "handeye_mm"), (clock, "clock_ms"))
    notes = _warnings(document)
    return Verdict("handeye", "Hand-eye", _lower(_level(*measured), notes), found, _gate(*measured), notes)


def _wings(document: Document) -> Verdict:
    if not document:
        return Verdict("wings", "Wings", "absent", "No wings: a rig whose lights are not described has no prior.")
    lights = items(document, "lights")
    found = f"{plural(len(lights), 'light')} as designed"
    found += f", axes meet at {fixed(1000 * document['d_object_m'], 1, 'mm')}" if document.get("d_object_m") else ""
    position, axis = 1000 * _worst(lights, "position_std_m"), _worst(lights, "axis_std_deg")
    found += f", known to {fixed(position, 1, 'mm')} and {fixed(axis, 1, '°')} an axis" if np.isfinite(position) else ""
    return Verdict("wings", "Wings", "none", found, "the prior: refined by the spheres", _warnings(document))


def _lights(report: RigReport) -> Verdict:
    document, refined = report.lights, bool(report.get("lights"))
    if not document:
        return Verdict("lights", "Lights", "absent", "No lights: lpcal refine, or lpcal export.")
    lights = items(document, "lights")
    direction = _worst(lights, "direction_std_deg")
    position = 1000 * _worst(lights, "position_std_m")
    intensity = 100 * _worst(lights, "intensity_std") if report.intensities_measured else float("nan")
    spheres = items(document, "spheres")
    used = sum(bool(sphere.get("used")) for sphere in spheres)
    found = plural(len(lights), "light")
    found += f", worst direction {sigma_of(direction, 2, '°')} an axis" if np.isfinite(direction) else ""
    found += f", position {sigma_of(position, 1, 'mm')}" if np.isfinite(position) else ""
    found += f", intensity {sigma_of(intensity, 1, '%')}" if np.isfinite(intensity) else ""
    found += "" if report.intensities_measured else ", intensity not measured"
    found += f", {used} of {plural(len(spheres), 'sphere')}" if spheres else ""
    measured = ((direction, "light_deg"), (intensity, "light_percent"))
    notes = _warnings(document) if refined else ("The lights stand as designed or imported; no spheres refined them.", *_warnings(document))
    return Verdict("lights", "Lights", _lower(_level(*measured), notes), found, _gate(*measured), notes)


def _worst(lights: list[dict[str, object]], key: str) -> float:
    values = [float(value) for light in lights if isinstance(value := light.get(key), (int, float))]
    return max(values, default=float("nan"))


def _surface(surface: SurfaceReport) -> Verdict:
    summary = surface.summary
    pieces = items(summary, "components")
    metric = summary.get("units") != "pixels"
    spread = [100 * float(piece["scale_std"]) for piece in pieces if metric and isinstance(piece.get("scale_std"), (int, float))]
    pixels = sum(int(piece.get("pixels") or 0) for piece in pieces)
    found = f"{pixels:,} pixels in {plural(len(pieces), 'piece')}".replace(",", "\N{NARROW NO-BREAK SPACE}") if pieces else "a surface"
    measured = (max(spread, default=float("nan")), "surface_percent")
    if spread and pieces[0].get("mean_depth_m") is not None:
        depth = float(pieces[0]["mean_depth_m"])
        found += f", {with_sigma(1000 * depth, 10 * spread[0] * depth, 'mm')} away"
    return Verdict("surface", surface.name, _level(measured), found, _gate(measured))

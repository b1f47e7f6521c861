"""model/model.html: the model in space with its views, their way and the stops to come, in one file that opens offline.

What is missing of the model and what its views show of the rig, in words, is also for the terminal and for `lpcal watch`.

The page shows albedo, normals, sigma, disagreement and coverage of every vertex, and measures distances and sections with sigma. The mesh
comes deflated: positions in 16 bits over its bounds, some micrometres of an object, normals in 8 bits an axis, sigma and disagreement as
bytes of a logarithm.
"""

from __future__ import annotations

import base64
import zlib
from math import degrees
from typing import Any

import numpy as np

from lpcal import __version__
from lpcal.geometry.arrays import Array
from lpcal.records.model import Missing, NextStop, ObjectModel, RigEvidence, ViewInModel
from lpcal.report.page_data import ModelData, ViewData
from lpcal.report.templates import environment, packed_three, script_json

STEPS = 16.0
"""Steps of a byte for a factor of two of a sigma: 4 % each."""
MOST_FACES = 600_000
"""Triangles that the page is given: a slow machine turns them at some ten frames a second; of more, some are left out."""
HALF_VIEW = (0.42, 0.27)
"""Half width and height over the distance of the pyramids that stand for cameras."""


def model_html(model: ObjectModel) -> str:
    """The page."""
    thinned = max(-(-len(model.faces) // MOST_FACES), 1)
    missing = [] if model.missing is None else missing_words(model.missing, model.frame)
    return (
        environment()
        .get_template("model.html")
        .render(
            name=model.name,
            frame=model.frame,
            version=__version__,
            data=script_json(pack(model, thinned)),
            three=packed_three(),
            missing=missing,
            views=[_line(view) for view in model.views],
            notes=model.warnings,
            thinned=thinned if thinned > 1 else 0,
        )
    )


def pack(model: ObjectModel, thinned: int = 1) -> ModelData:
    """What the page's script reads."""
    v, faces = model.vertices_A, model.faces[::thinned]
    low, high = v.min(axis=0), v.max(axis=0)
    span = np.maximum(high - low, 1e-9)
    known = model.sigma_m[model.sigma_m > 0]
    least = float(np.percentile(known, 1)) if len(known) else 1e-6
    most = float(np.percentile(known, 99)) if len(known) else 1e-3
    parts = [
        np.rint(65535 * (v - low) / span).astype("<u2"),
        faces.astype("<u4"),
        np.rint(127 * np.nan_to_num(model.normals_A)).astype(np.int8),
        np.rint(255 * np.sqrt(model.colours)).astype(np.uint8),
        _logarithm(model.sigma_m, least),
        _logarithm(model.disagreement_m, least),
        np.minimum(model.seen_by, 255).astype(np.uint8),
    ]
    centre = (low + high) / 2
    packer = zlib.compressobj(6)
    packed = b"".join([*(packer.compress(np.ascontiguousarray(part).tobytes()) for part in parts), packer.flush()])
    cameras = [view.H_AC for view in model.views if view.H_AC is not None]
    return {
        "name": model.name,
        "vertices": len(v),
        "faces": len(faces),
        "mesh": base64.b64encode(packed).decode("ascii"),
        "low": low.tolist(),
        "span": span.tolist(),
        "centre": centre.tolist(),
        "radius": float(np.linalg.norm(span) / 2),
        "least": least,
        "steps": STEPS,
        "top": int(np.clip(2 + STEPS * np.log2(max(most / least, 1.0)), 3, 255)),
        "scale": model.figures.distance_scale_std,
        "half": HALF_VIEW,
        "up": _up(cameras).tolist(),
        "from": _from(cameras, centre).tolist(),
        "views": [
            ViewData(name=view.name, used=view.used, H=np.round(view.H_AC, 6).tolist()) for view in model.views if view.H_AC is not None
        ],
        "next": [] if model.missing is None else [ViewData(name="next", H=np.round(stop.H_AC, 6).tolist()) for stop in model.missing.stops],
    }


def _logarithm(values_m: Array, least: float) -> Any:
    """Bytes of lengths: 0 for none, else 1 and up in steps of a logarithm."""
    code = 1 + STEPS * np.log2(np.maximum(np.nan_to_num(values_m), least) / least)
    return np.where(values_m > 0, np.clip(np.rint(code), 1, 255), 0).astype(np.uint8)


def _up(cameras: list[Array]) -> Array:
    """Which way is up: what is up in the images, on the mean."""
    up = -np.mean([H[:3, 1] for H in cameras], axis=0) if cameras else np.array([0, 0, 1.0])
    return up / max(float(np.linalg.norm(up)), 1e-9)


def _from(cameras: list[Array], centre: Array) -> Array:
    """From where the model is seen at first: the first camera's side, halfway to the nearest other, so that neither stands before it."""
    if not cameras:
        return np.array([1.0, 0, 0])
    sides = np.array([H_AC[:3, 3] - centre for H_AC in cameras])
    sides /= np.maximum(np.linalg.norm(sides, axis=1, keepdims=True), 1e-9)
    cosine = sides[1:] @ sides[0]
    beside = np.flatnonzero((cosine > -0.9) & (cosine < 0.99))
    if len(beside):
        middle = sides[0] + sides[1 + beside[np.argmax(cosine[beside])]]
        return np.asarray(middle / np.linalg.norm(middle))
    return np.asarray(sides[0])


def _line(view: ViewInModel) -> str:
    if not view.used:
        return f"{view.name}: left out, {view.why}"
    changed = f"distance {1e3 * (view.distance_change_m or 0):+.2f} mm"
    changed += "" if view.distance_sigmas is None else f" ({view.distance_sigmas:.1f} sigmas from the others')"
    return f"{view.name}: moved {1e3 * (view.moved_m or 0):.2f} mm, {changed}, within {1e3 * (view.residual_m or 0):.2f} mm of the others"


def missing_words(missing: Missing, frame: str) -> list[str]:
    """What no view has seen well, and where the panel should stand next, a line each."""
    parts = [f"some {1e4 * missing.open_m2:.1f} cm2 that no view has seen", f"{1e4 * missing.once_m2:.1f} cm2 that one view alone has"]
    if missing.loose_m2 > 0:
        parts.append(f"{1e4 * missing.loose_m2:.1f} cm2 left out, seen by one view alone at a distance that is not known well")
    lines = [f"missing, of {1e4 * missing.area_m2:.1f} cm2: {'; '.join(parts)}"]
    return lines + ([_stop_words(stop, k, frame) for k, stop in enumerate(missing.stops)] or ["no further stop would show much more"])


def _stop_words(stop: NextStop, number: int, frame: str) -> str:
    H, what = (stop.H_AC, "the camera") if stop.H_AP is None else (stop.H_AP, "the panel")
    place = ", ".join(f"{1e3 * value:.0f}" for value in H[:3, 3])
    shows = f"shows {1e4 * stop.unseen_m2:.1f} cm2 of the first and {1e4 * stop.once_m2:.1f} cm2 of the second"
    wings = (
        f"the wings set again (lpcal design --distance {1e3 * stop.distance_m:.0f}mm) and calibrated" if stop.reset else "wings as they are"
    )
    begins = "next:" if number == 0 else "then:"
    return (
        f"{begins} {what} at {place} mm in {frame}, {degrees(stop.turn_rad):.0f} deg from {stop.beside}, "
        f"{1e3 * stop.distance_m:.0f} mm from the object, {wings}: {shows}"
    )


NAMED_SIGMAS = 1.0
"""Lights whose favoured change is at least so many sigmas of the calibration are named."""


def rig_words(rig: RigEvidence) -> list[str]:
    """What the views show of the rig's calibration, a line each."""
    shift_m, turn_rad = (float((part @ part) ** 0.5) for part in (rig.H_PC_change[3:], rig.H_PC_change[:3]))
    lines = [
        f"rig: the views favour a change of H_PC by {1e3 * shift_m:.2f} mm and {degrees(turn_rad):.3f} deg "
        f"({rig.H_PC_sigmas:.1f} sigmas), all distances by {100 * rig.distance_scale:+.2f} +- {100 * rig.distance_scale_std:.2f} %"
    ]
    if rig.lights:
        lines.append(
            f"     normals of two views differ by {degrees(rig.normals_before_rad):.2f} deg a view, "
            f"{degrees(rig.normals_after_rad):.2f} with the lights changed as the views favour"
        )
    for light in rig.lights:
        if light.sigmas >= NAMED_SIGMAS:
            place = ", ".join(f"{1e3 * value:+.1f}" for value in light.source_change_C)
            lines.append(
                f"     {light.name}: intensity {100 * light.intensity_change:+.2f} +- {100 * light.intensity_std:.2f} %, "
                f"source {place} mm ({light.sigmas:.1f} sigmas)"
            )
    return lines + ([f"the rig has moved: {'; '.join(rig.moved)}"] if rig.moved else ["nothing says that the rig has moved"])

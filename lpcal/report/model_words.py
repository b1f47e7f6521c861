"""What a model says of itself in words: what is missing, what its views tell of the rig; for the terminal, its page and `lpcal watch`."""

from __future__ import annotations

from math import degrees

from lpcal.records.model import Missing, NextStop, RigEvidence


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
    shows = f"shows {1e4 * stop.unseen_m2:.1f} cm2 of the first and {1e4 * stop.once_m2:.1f} of the second"
    wings = (
        f"the wings set anew (lpcal design --distance {1e3 * stop.distance_m:.0f}mm) and calibrated" if stop.reset else "wings as they are"
    )
    begins = "next:" if number == 0 else "then:"
    return (
        f"{begins} {what} at {place} mm in {frame}, {degrees(stop.turn_rad):.0f} deg from {stop.beside}, "
        f"{1e3 * stop.distance_m:.0f} mm from the object, {wings}: {shows}"
    )


NAMED_SIGMAS = 1.0
"""Lights that the views would have other by at least so many sigmas of the calibration are named."""


def rig_words(rig: RigEvidence) -> list[str]:
    """What the views tell of the rig's calibration, a line each."""
    shift_m, turn_rad = (float((part @ part) ** 0.5) for part in (rig.H_PC_change[3:], rig.H_PC_change[:3]))
    lines = [
        f"rig: the views would have H_PC other by {1e3 * shift_m:.2f} mm and {degrees(turn_rad):.3f} deg "
        f"({rig.H_PC_sigmas:.1f} sigmas), all distances by {100 * rig.distance_scale:+.2f} +- {100 * rig.distance_scale_std:.2f} %"
    ]
    if rig.lights:
        lines.append(
            f"     normals of two views differ by {degrees(rig.normals_before_rad):.2f} deg a view, "
            f"{degrees(rig.normals_after_rad):.2f} with the lights as the views would have them"
        )
    for light in rig.lights:
        if light.sigmas >= NAMED_SIGMAS:
            place = ", ".join(f"{1e3 * value:+.1f}" for value in light.source_change_C)
            lines.append(
                f"     {light.name}: intensity {100 * light.intensity_change:+.2f} +- {100 * light.intensity_std:.2f} %, "
                f"source {place} mm ({light.sigmas:.1f} sigmas)"
            )
    return lines + ([f"the rig has moved: {'; '.join(rig.moved)}"] if rig.moved else ["nothing says that the rig has moved"])

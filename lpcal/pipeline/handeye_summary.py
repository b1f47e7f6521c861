"""What ``lpcal handeye`` says: the transforms as people paste them, how sure they are, and which views were left out."""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.formats.pasted_transforms import CAMERA, both_ways, numbers, paste_lines
from lpcal.geometry import se3
from lpcal.pipeline.handeye_inputs import HandEyeInputs
from lpcal.records.calibration import HandEye
from lpcal.records.outcome import Outcome
from lpcal.records.rig import Rig

NAMED_VIEWS = 6
EASY_HANDEYE = "handeye.easy_handeye.yaml"


def body_name(given: HandEyeInputs) -> str:
    """The tracked body's name, ``panel`` where nothing names it."""
    return given.body or "panel"


def summarise(handeye: HandEye, given: HandEyeInputs, rig: Rig) -> Outcome:
    """The outcome of the stage."""
    used = [view for view in handeye.views if view.used]
    sigma = np.sqrt(np.diag(handeye.H_PC_covariance))
    body = body_name(given)
    lines = [
        f"H_PC        camera coordinates to those of {body}; position is the camera's centre in it:",
        *paste_lines(handeye.H_PC, body, CAMERA),
        f"H_CP        its inverse: coordinates of {body} to the camera's:",
        *paste_lines(se3.inv(handeye.H_PC), CAMERA, body),
        f"sigma       {numbers(np.degrees(sigma[:3]), 3)} deg, {numbers(1e3 * sigma[3:], 2)} mm, an axis",
        f"            {handeye.evidence['weakest']}",
        f"H_OB        board in the room at {numbers(handeye.H_OB[:3, 3], 4)} m; all forms of it and of H_BO: handeye.yaml, transforms",
        _clock(handeye, given),
        f"views       {len(used)} of {len(handeye.views)} used; the board misses its place by {_rms_words(handeye)}",
        *_held_out(handeye),
        *_left_out(handeye),
        *_noise(handeye),
        *([f"mocap file  {'; '.join(given.notes)}"] if given.notes else []),
        f"written     calib/handeye.yaml, calib/H_OP.yaml, calib/{EASY_HANDEYE}",
    ]
    return Outcome(
        summary=lines,
        document=_document(handeye, body),
        warnings=list(handeye.warnings),
        next_command="lpcal wings" if rig.lights else "lpcal report",
    )


def _clock(handeye: HandEye, given: HandEyeInputs) -> str:
    if given.stream is None:
        return "clock       none: one pose an image"
    if handeye.clock_offset_s is None:
        return "clock       the offset does not show in these data"
    if not handeye.clock_offset_std_s:
        return f"clock       t_camera = t_mocap {1e3 * handeye.clock_offset_s:+.2f} ms, as given"
    drift = f" {1e6 * handeye.clock_drift:+.0f} ppm (t_camera - {handeye.clock_middle_s:.1f} s)" if handeye.clock_drift else ""
    return f"clock       t_camera = t_mocap {1e3 * handeye.clock_offset_s:+.2f} +- {1e3 * handeye.clock_offset_std_s:.2f} ms{drift}"


def _rms_words(handeye: HandEye) -> str:
    used = [view for view in handeye.views if view.used]
    metre = np.sqrt(np.mean([(view.residual_m or 0.0) ** 2 for view in used]))
    rad = np.sqrt(np.mean([(view.residual_rad or 0.0) ** 2 for view in used]))
    px = [view.residual_px for view in used if view.residual_px is not None]
    corners = f", corners {np.sqrt(np.mean(np.square(px))):.3f} px" if px else ""
    return f"{1e3 * metre:.2f} mm, {np.degrees(rad):.3f} deg rms{corners}"


def _left_out(handeye: HandEye) -> list[str]:
    lines: dict[str, list[str]] = {}
    for view in handeye.views:
        if not view.used:
            lines.setdefault(str(view.why), []).append(view.image)
    texts = []
    for why, images in list(lines.items())[:NAMED_VIEWS]:
        more = f" and {len(images) - NAMED_VIEWS} more" if len(images) > NAMED_VIEWS else ""
        texts.append(f"  without:  {why}: {', '.join(images[:NAMED_VIEWS])}{more}")
    rest = list(lines.values())[NAMED_VIEWS:]
    return texts + [f"  without:  {sum(map(len, rest))} more, see handeye.yaml"] * bool(rest)


def _noise(handeye: HandEye) -> list[str]:
    found: dict[str, Any] = handeye.evidence
    if "corner_sigma_px" in found:
        return [
            f"noise       mocap {found['mocap_sigma_deg']:.3f} deg, {1e3 * float(found['mocap_sigma_m']):.2f} mm; corners "
            f"{found['corner_sigma_px']:.3f} px"
        ]
    across, depth = 1e3 * float(found["board_sigma_m"][0]), 1e3 * float(found["board_sigma_m"][2])
    return [f"noise       {found['board_sigma_deg']:.3f} deg, {across:.2f} mm across, {depth:.2f} mm in depth, both sensors together"]


def _held_out(handeye: HandEye) -> list[str]:
    errors = [1e3 * view.held_out_m for view in handeye.views if view.held_out_m is not None]
    if not errors:
        return []
    worst = max((view for view in handeye.views if view.held_out_m is not None), key=lambda view: view.held_out_m or 0.0)
    return [f"left out    a view that the solve did not see: median {np.median(errors):.2f}, worst {max(errors):.2f} mm ({worst.image})"]


def _document(handeye: HandEye, body: str) -> dict[str, Any]:
    return {
        "body": body,
        **both_ways(handeye.H_PC, handeye.H_OB, body),
        "H_PC_covariance": handeye.H_PC_covariance,
        "H_OB_covariance": handeye.H_OB_covariance,
        "clock_offset_s": handeye.clock_offset_s,
        "clock_offset_std_s": handeye.clock_offset_std_s,
        "clock_drift_ppm": 1e6 * handeye.clock_drift,
        "views_used": sum(view.used for view in handeye.views),
        "views_left_out": {view.image: view.why for view in handeye.views if not view.used},
        "held_out_m": {view.image: view.held_out_m for view in handeye.views if view.held_out_m is not None},
        "evidence": handeye.evidence,
    }

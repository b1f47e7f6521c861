"""What ``lpcal handeye`` says: the transforms as people paste them, how sure they are, and which views were left out."""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.pipeline.handeye_inputs import HandEyeInputs
from lpcal.records.calibration import HandEye
from lpcal.records.outcome import Outcome
from lpcal.records.rig import Rig

NAMED_VIEWS = 6


def summarise(handeye: HandEye, given: HandEyeInputs, rig: Rig) -> Outcome:
    """The outcome of the stage."""
    used = [view for view in handeye.views if view.used]
    sigma = np.sqrt(np.diag(handeye.H_PC_covariance))
    body = (given.stream.body if given.stream is not None else "") or "panel"
    lines = [
        f"H_PC        camera coordinates to those of {body}; the camera's centre in it, and its axes:",
        *paste(handeye.H_PC, body),
        f"sigma       {_numbers(np.degrees(sigma[:3]), 3)} deg, {_numbers(1e3 * sigma[3:], 2)} mm, an axis",
        f"H_OB        board in the room at {_numbers(handeye.H_OB[:3, 3], 4)} m",
        _clock(handeye, given),
        f"views       {len(used)} of {len(handeye.views)} used; the board misses its place by {_rms_words(handeye)}",
        *_left_out(handeye),
        *_noise(handeye),
        *([f"mocap file  {'; '.join(given.stream.notes)}"] if given.stream is not None and given.stream.notes else []),
        "written     calib/handeye.yaml, calib/H_OP.yaml",
    ]
    return Outcome(
        summary=lines,
        document=_document(handeye, body),
        warnings=list(handeye.warnings),
        next_command="lpcal wings" if rig.lights else "lpcal report",
    )


def paste(H_AB: Array, parent: str, child: str = "camera") -> list[str]:
    """A transform in the forms that other programs take."""
    x, q = H_AB[:3, 3], se3.quaternion(H_AB[:3, :3])
    return [
        f"  position        {_numbers(1e3 * x, 2)} mm",
        f"  quaternion      {_numbers(q, 6)} (x, y, z, w)",
        f'  URDF            xyz="{_numbers(x, 6, " ")}" rpy="{_numbers(rpy(H_AB), 6, " ")}"',
        f"  ROS             static_transform_publisher --x {x[0]:.6f} --y {x[1]:.6f} --z {x[2]:.6f} --qx {q[0]:.6f} --qy {q[1]:.6f} "
        f"--qz {q[2]:.6f} --qw {q[3]:.6f} --frame-id {parent} --child-frame-id {child}",
    ]


def rpy(H_AB: Array) -> Array:
    """Roll, pitch, yaw (rad) about fixed axes x, y, z in this order: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    R = H_AB[:3, :3]
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


def _clock(handeye: HandEye, given: HandEyeInputs) -> str:
    if given.stream is None:
        return "clock       none: one pose an image"
    if handeye.clock_offset_s is None:
        return "clock       the offset does not show in these data"
    if not handeye.clock_offset_std_s:
        return f"clock       t_camera = t_mocap {1e3 * handeye.clock_offset_s:+.2f} ms, as given"
    return f"clock       t_camera = t_mocap {1e3 * handeye.clock_offset_s:+.2f} +- {1e3 * handeye.clock_offset_std_s:.2f} ms"


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


def _document(handeye: HandEye, body: str) -> dict[str, Any]:
    def both(H_AB: Array) -> dict[str, Any]:
        return {
            "matrix": H_AB,
            "translation_m": H_AB[:3, 3],
            "quaternion_xyzw": se3.quaternion(H_AB[:3, :3]),
            "rotation_vector_rad": se3.rotation_vector(H_AB[:3, :3]),
            "rpy_rad": rpy(H_AB),
        }

    return {
        "body": body,
        "H_PC": both(handeye.H_PC),
        "H_CP": both(se3.inv(handeye.H_PC)),
        "H_OB": both(handeye.H_OB),
        "H_PC_covariance": handeye.H_PC_covariance,
        "H_OB_covariance": handeye.H_OB_covariance,
        "clock_offset_s": handeye.clock_offset_s,
        "clock_offset_std_s": handeye.clock_offset_std_s,
        "views_used": sum(view.used for view in handeye.views),
        "views_left_out": {view.image: view.why for view in handeye.views if not view.used},
        "evidence": handeye.evidence,
    }


def _numbers(values: Array, digits: int, between: str = ", ") -> str:
    return between.join(f"{value:.{digits}f}" for value in values)

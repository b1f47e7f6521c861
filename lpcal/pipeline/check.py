"""Before any solve: what is wrong with mocap and images, in words, with the key or the command that mends it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import clock, congruence, observability, set_up
from lpcal.chain.h_pc_handeye.advice import advise
from lpcal.chain.h_pc_handeye.ends import all_ends
from lpcal.chain.h_pc_handeye.moved import find_step
from lpcal.chain.h_pc_handeye.state import Options
from lpcal.errors import DegenerateError, DisagreementError, LpcalError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.pose_track import PoseTrack, TrackPoses, poses_at
from lpcal.pipeline.handeye_inputs import HandEyeInputs, gather, section_of, with_recording
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Carries
from lpcal.records.observations import PoseStream
from lpcal.records.outcome import Outcome, Progress

NAMED = 6
STEP_SHARE = 0.2
"""Share of the misplacement that two parts leave, up to which a step is what is wrong where the whole is no rigid motion."""
WIDE_S = 0.2
"""A clock offset that shows no better than this is said to be vague."""


@dataclass
class _Findings:
    """Lines as they come, what is wrong, and the figures."""

    lines: list[str] = field(default_factory=list)
    wrong: list[LpcalError] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    figures: dict[str, Any] = field(default_factory=dict)

    def say(self, topic: str, text: str) -> None:
        self.lines.append(f"{topic:<12}{text}")


def run(workspace: Workspace, progress: Progress, recording: Path | None = None) -> Outcome:
    """Look at the data; the exit code is that of the first thing that is wrong, 0 where nothing is.

    Raises
    ------
    LpcalError
        The data cannot be read.
    """
    workspace = with_recording(workspace, recording)
    given = gather(workspace, progress)
    findings = _Findings()
    findings.say("boards", f"found in {len(given.boards.images)} of {len(given.images)} views")
    _boards(given, findings)
    pairs = _panel(workspace, given, findings)
    if pairs is not None:
        section = section_of(workspace)
        _motion(given, *pairs, findings, Options(inverted=section.direction == "H_PO", carries=section.carries))
    for error in findings.wrong:
        findings.lines += [f"WRONG       {line}" if k == 0 else f"          {line}" for k, line in enumerate(error.message().splitlines())]
    if not findings.wrong:
        findings.say("verdict", "nothing wrong found")
    return Outcome(
        summary=findings.lines,
        document=findings.figures | {"wrong": [{"message": e.message(), "exit_code": e.exit_code, "do": e.todo} for e in findings.wrong]},
        warnings=findings.warnings,
        next_command=None if findings.wrong else "lpcal handeye",
        exit_code=findings.wrong[0].exit_code if findings.wrong else 0,
    )


def _boards(given: HandEyeInputs, findings: _Findings) -> None:
    without = given.without_board | given.without_pose
    for why in dict.fromkeys(without.values()):
        images = [image for image, reason in without.items() if reason == why]
        more = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
        findings.say("", f"{len(images)} without: {why}: {', '.join(images[:NAMED])}{more}")


def _panel(workspace: Workspace, given: HandEyeInputs, findings: _Findings) -> tuple[Array, Mask] | None:
    """Panel pose of each board view, and whether it is to be trusted; None where there is none."""
    if given.stream is None:
        assert given.H_OP is not None
        findings.say("poses", f"{len(given.H_OP)}, one a view, no clock")
        for note in given.notes:
            findings.say("", note)
        return given.H_OP, np.ones(len(given.H_OP), dtype=bool)
    track = track_of(given.stream)
    _stream(given.stream, track, findings)
    t_camera_s, rate = clock.without_rate(track, np.asarray(given.boards.t_camera_s), given.boards.H_CB)
    if rate:
        findings.warnings.append(
            f"the clocks' rates differ by about {1e6 * rate:+.0f} ppm{_ntsc(rate)}: hand-eye finds the rate and uses it"
        )
    try:
        offset = _clock(workspace, track, t_camera_s, given.boards.H_CB, findings)
    except LpcalError as error:
        findings.wrong.append(error)
        return None
    panel = poses_at(track, t_camera_s - offset)
    _lost_views(given, panel, findings)
    return panel.H, panel.trusted


def _ntsc(rate: float) -> str:
    return " (29.97 frames a second counted as 30?)" if abs(abs(rate) - 1e-3) < 2e-4 else ""


def _stream(stream: PoseStream, track: PoseTrack, findings: _Findings) -> None:
    name = f"{stream.body}: " if stream.body else ""
    length = float(np.ptp(stream.t_s))
    findings.say(
        "mocap", f"{name}{len(stream.t_s)} poses in {length:.1f} s, {stream.rate_hz:.1f} Hz; the body lost in {stream.lost} samples"
    )
    for why, count in track.dropped.items():
        if count:
            findings.say("", f"{count} samples {why}: left out")
    for note in stream.notes:
        findings.say("", note)
    findings.figures |= {
        "mocap_samples": len(stream.t_s),
        "mocap_lost": stream.lost,
        "mocap_rate_hz": stream.rate_hz,
        "dropped": track.dropped,
    }


def _clock(workspace: Workspace, track: PoseTrack, t_camera_s: Array, H_CB: Array, findings: _Findings) -> float:
    stated = section_of(workspace).clock_offset
    known_s = 0.0 if stated == "estimate" else float(stated)
    candidates = [replace(each, offset_s=each.offset_s + known_s) for each in clock.offset_candidates(track, t_camera_s - known_s, H_CB)]
    apart = clock.epochs(track, t_camera_s - known_s)
    if apart:
        findings.say("", apart)
    if not candidates:
        raise DegenerateError(
            "no clock offset at which a third of the views fall into the recording", needed="recordings of the same minutes"
        )
    best = candidates[0]
    precision = f", no better than +- {0.5 * best.width_s:.2f} s: the panel stood still" if best.width_s > WIDE_S else ""
    if rests := _rests(track, t_camera_s, H_CB, best):
        low, high = rests
        precision = (
            f", anywhere from {1e3 * low:+.0f} to {1e3 * high:+.0f} ms: the panel stood still in every view, the offset does not show"
        )
        best = replace(best, offset_s=(low + high) / 2, width_s=max(best.width_s, high - low))
    findings.say("clock", f"t_camera = t_mocap {1e3 * best.offset_s:+.0f} ms by relative angles{precision}")
    findings.figures |= {"clock_offset_s": best.offset_s, "clock_offset_width_s": best.width_s}
    if stated == "estimate":
        return best.offset_s
    alike = clock.fits_as_well(track, t_camera_s, H_CB, known_s, best)
    if not alike and abs(best.offset_s - known_s) > max(WIDE_S, best.width_s):
        findings.wrong.append(
            DisagreementError(
                f"the stated clock offset is {1e3 * float(stated):.0f} ms, the angles say {1e3 * best.offset_s:.0f} ms",
                where=workspace.rig_file.where("mocap.clock_offset"),
                needed="t_camera = t_mocap + offset",
                todo="write clock_offset: estimate",
            )
        )
        return best.offset_s
    return float(stated)


def _rests(track: PoseTrack, t_camera_s: Array, H_CB: Array, best: clock.OffsetCandidate) -> tuple[float, float] | None:
    """The offsets between which all views fall into rests of the panel, so that none is better than another; None where it moved."""
    low, high = clock.as_good(track, t_camera_s, H_CB, best)
    panel = poses_at(track, t_camera_s - (low + high) / 2)
    return (low, high) if panel.trusted.any() and panel.steady[panel.trusted].all() else None


def _lost_views(given: HandEyeInputs, panel: TrackPoses, findings: _Findings) -> None:
    for why in dict.fromkeys(each for each in panel.why if each is not None):
        images = [image for image, each in zip(given.boards.images, panel.why, strict=True) if each == why]
        more = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
        findings.say("", f"{len(images)} views without a pose, {why}: {', '.join(images[:NAMED])}{more}")


def _motion(given: HandEyeInputs, H_OP: Array, trusted: Mask, findings: _Findings, options: Options) -> None:
    found = set_up.of_pairs(H_OP[trusted], given.boards.H_CB[trusted], options, from_images=given.boards.corners_px is not None)
    if found.board_carried:
        findings.say("set-up", "the camera stands still in the room, the tracked body carries the board")
    findings.warnings += found.warnings()
    H_OP = found.mover(H_OP)
    boards, turned = all_ends(given.boards, H_OP, trusted)
    if turned.any():
        images = [image for image, other in zip(boards.images, turned, strict=True) if other]
        more_images = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
        findings.say(
            "ends", f"{len(images)} boards were found by their other end, and are turned: {', '.join(images[:NAMED])}{more_images}"
        )
    H_OP, H_CB = H_OP[trusted], boards.H_CB[trusted]
    names = [image for image, ok in zip(given.boards.images, trusted, strict=True) if ok]
    agreed = None
    try:
        measured = se3.inv(H_OP) if found.board_carried else H_OP
        spread, more = observability.refuse_what_cannot_show_it(measured)
        agreed = park.consensus(H_OP, H_CB)
        spread, more = observability.refuse_what_cannot_show_it(measured[agreed.inliers])
    except DegenerateError as error:
        off = [] if agreed is None else [name for name, inlier in zip(names, agreed.inliers, strict=True) if not inlier]
        if off:
            findings.say("", f"{len(off)} views off, their poses lost or flipped: {', '.join(off[:NAMED])}")
        findings.wrong.append(error)
        return
    findings.say("motion", f"the panel's turns spread by {spread.words()} about its principal axes")
    findings.figures["rotation_spread_deg"] = np.degrees(spread.sigma_rad)
    findings.warnings += more
    step = find_step(H_OP, H_CB, names, board_carried=found.board_carried)
    try:
        congruence.refuse(H_OP, H_CB, agreed, from_images=given.boards.corners_px is not None)
    except DisagreementError as error:
        findings.wrong.append(step.refusal() if step is not None and step.parted_m < STEP_SHARE * step.misplaced_m else error)
        return
    if step is not None:
        findings.wrong.append(step.refusal())
    off = [name for name, inlier in zip(names, agreed.inliers, strict=True) if not inlier]
    findings.say("rigid", f"body and camera move as one; the board is misplaced by {1e3 * agreed.scatter_m:.1f} mm (median, closed form)")
    if off:
        more_text = f" and {len(off) - NAMED} more" if len(off) > NAMED else ""
        findings.say("", f"{len(off)} views off, flipped or blurred: {', '.join(off[:NAMED])}{more_text}")
    carries: Carries = "board" if found.board_carried else "camera"
    findings.figures |= {"misplaced_m": agreed.scatter_m, "views_off": off, "carries": carries}
    size = congruence.closed_form_size_warning(H_OP[agreed.inliers], H_CB[agreed.inliers], agreed.H_PC, carries)
    findings.warnings += [size] if size else []
    if carries == "camera":
        roles = congruence.swapped_roles_warning(agreed.H_PC, agreed.H_OB)
        findings.warnings += [roles] if roles else []
        advised = advise(H_OP[agreed.inliers], H_CB[agreed.inliers], agreed.H_PC, agreed.H_OB)
        findings.say("expected", f"by the scatter of these views H_PC is known {advised.words()}")
        findings.figures["expected_sigma_m"] = advised.sigma_m

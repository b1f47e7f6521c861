"""Boards and tracked body -> handeye.yaml (H_PC, H_OB, clock offset), H_OP.yaml (the body at every image).

What ``lpcal handeye`` says: H_PC, how sure it is, and which views were left out; all else stands in handeye.yaml.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.handeye import solve_handeye
from lpcal.chain.h_op_panel import course_of, track_of
from lpcal.formats.h_op_yaml import ImagePanelPoses, write_h_op
from lpcal.formats.handeye_yaml import write_handeye
from lpcal.formats.pasted_transforms import EASY_HANDEYE, both_ways, matrix_lines, numbers, write_easy_handeye
from lpcal.formats.record_documents import document_of
from lpcal.geometry import se3
from lpcal.geometry.pose_track import poses_at
from lpcal.pipeline.handeye_inputs import HandEyeInputs, gather, input_files, section_of, with_recording
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import HandEye, ViewVerdict
from lpcal.records.digits import fine, fine_each
from lpcal.records.evidence import HandEyeEvidence
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import Rig

NAMED_VIEWS, NAMED_REASONS = 6, 3
EASY_HANDEYE_FILE = "handeye.easy_handeye.yaml"


def run(workspace: Workspace, progress: Progress, recording: Path | None = None) -> Outcome:
    """Find H_PC, H_OB and the clock offset; `recording` stands in for ``mocap.file``.

    Raises
    ------
    InputError, DegenerateError, ConvergenceError, DisagreementError
        As the steps raise them.
    """
    workspace = with_recording(workspace, recording)
    STAGE.look(workspace)
    given = gather(workspace, progress)
    solved = _solved(workspace, given, progress)
    handeye = _with_all_images(solved, given)
    provenance = workspace.provenance(input_files(workspace), settings(workspace))
    write_easy_handeye(workspace.calib(EASY_HANDEYE_FILE), handeye.H_PC, body_name(given), handeye.carries)
    write_h_op(workspace.calib("H_OP.yaml"), _panel_at_all_images(given, solved), provenance)
    write_handeye(workspace.calib("handeye.yaml"), handeye, provenance, body_name(given))
    return summarise(handeye, given, workspace.rig_file.rig)


def settings(workspace: Workspace) -> dict[str, Any]:
    """The section that the stage depends on."""
    section = workspace.rig_file.rig.mocap
    return {"mocap": section.model_dump() if section else None}


def _solved(workspace: Workspace, given: HandEyeInputs, progress: Progress) -> HandEye:
    section = section_of(workspace)
    offset = section.clock_offset
    poses = given.H_OP if given.stream is None else given.stream
    assert poses is not None
    return solve_handeye(
        poses,
        given.boards,
        camera=given.camera,
        clock_offset_s=None if offset == "estimate" else float(offset),
        carries=section.carries,
        inverted=section.direction == "H_PO",
        camera_share=given.camera_share,
        progress=progress,
    )


def _with_all_images(handeye: HandEye, given: HandEyeInputs) -> HandEye:
    """The verdicts of all images asked for, in their order."""
    verdicts = {view.image: view for view in handeye.views}
    verdicts |= {image: ViewVerdict(image, False, why) for image, why in (given.without_board | given.without_pose).items()}
    return replace(handeye, views=tuple(verdicts[image] for image in given.images))


def _panel_at_all_images(given: HandEyeInputs, solved: HandEye) -> ImagePanelPoses:
    """The body's pose at every image, those without a board too."""
    course = None
    if given.stream is not None and given.t_camera_s is not None:
        track = track_of(given.stream)
        course = course_of(given.stream, track, inverse=solved.misread)
        panel = poses_at(track, solved.mocap_times(given.t_camera_s))
        H_OP = np.where(panel.trusted[:, None, None], panel.H, np.nan)
        why, steady = panel.why, panel.steady
    else:
        assert given.H_OP is not None
        pose_of = dict(zip(given.boards.images, given.H_OP, strict=True))
        nothing = np.full((4, 4), np.nan)
        H_OP = np.array([pose_of.get(image, nothing) for image in given.images])
        why = tuple(None if image in pose_of else given.without_pose.get(image, "no pose kept: no board") for image in given.images)
        steady = np.zeros(len(given.images), dtype=bool)
    H_OP = se3.inv(H_OP) if solved.misread else H_OP
    refused = {view.image: view.why for view in solved.views if not view.used}
    verdict = tuple(each if each is not None else refused.get(image) for image, each in zip(given.images, why, strict=True))
    return ImagePanelPoses(given.body, given.images, given.t_camera_s, H_OP, verdict, steady, solved.clock_offset_s, course)


STAGE = Stage(
    name="handeye",
    kinds={"H_OP.yaml": "H_OP", "handeye.yaml": "handeye"},
    wanted=lambda workspace: workspace.rig_file.rig.mocap is not None,
    inputs=input_files,
    settings=settings,
    run=run,
    beside={EASY_HANDEYE_FILE: EASY_HANDEYE},
)


def body_name(given: HandEyeInputs) -> str:
    """The tracked body's name, ``panel`` where nothing names it."""
    return given.body or "panel"


def summarise(handeye: HandEye, given: HandEyeInputs, rig: Rig) -> Outcome:
    """The outcome of the stage."""
    used = [view for view in handeye.views if view.used]
    sigma = np.concatenate([np.sqrt(np.diag(handeye.H_PC_covariance))[:3], se3.origin_sigmas(handeye.H_PC, handeye.H_PC_covariance)])
    body = body_name(given)
    H_PC = handeye.H_PC
    q = se3.quaternion(H_PC[:3, :3])
    camera, board = handeye.names
    still, at = ("the room", body) if handeye.carries == "board" else (body, "the room")
    lines = [
        *(["set-up      the camera stands still in the room, the tracked body carries the board"] if handeye.carries == "board" else []),
        f"{camera}        camera in {still}: position {numbers(1e3 * H_PC[:3, 3], 2)} mm, quaternion {numbers(q, 6)} xyzw",
        *(f"            {line}" for line in matrix_lines(H_PC)),
        f"sigma       {fine_each(np.degrees(sigma[:3]), 3)} deg, {fine_each(1e3 * sigma[3:])} mm, an axis",
        f"{board}        board in {at} at {numbers(handeye.H_OB[:3, 3], 4)} m",
        *_size(handeye),
        _clock(handeye, given),
        f"views       {len(used)} of {len(handeye.views)} used; the board misses its place by {_rms_words(handeye)}{_held_out(handeye)}",
        *_left_out(handeye),
        *_noise(handeye.evidence),
        *([f"mocap file  {'; '.join(given.notes)}"] if given.notes else []),
        f"written     calib/handeye.yaml (all forms, both ways; what would sharpen it), calib/H_OP.yaml, calib/{EASY_HANDEYE_FILE}",
    ]
    return Outcome(
        summary=lines,
        document=_document(handeye, body),
        warnings=list(handeye.warnings),
        next_command="lpcal wings" if rig.lights else "lpcal report",
    )


def _size(handeye: HandEye) -> list[str]:
    """How large the mocap finds the board, and that H_PC is in the mocap's metres."""
    if handeye.evidence is None:
        return []
    share, std = 100 * handeye.evidence.board_size_by_mocap, 100 * handeye.evidence.board_size_by_mocap_std
    return [f"scale       the board is {share:.2f} +- {fine(std)} % of its stated size by the mocap, in whose metres {handeye.names[0]} is"]


def _clock(handeye: HandEye, given: HandEyeInputs) -> str:
    if given.stream is None:
        return f"clock       none: {'no times of the images' if given.body else 'one pose an image'}"
    if handeye.clock_offset_s is None:
        return "clock       the offset does not show in these data"
    if not handeye.clock_offset_std_s:
        return f"clock       t_camera = t_mocap {1e3 * handeye.clock_offset_s:+.2f} ms, as given"
    drift = f" {1e6 * handeye.clock_drift:+.0f} ppm (t_camera - {handeye.clock_middle_s:.1f} s)" if handeye.clock_drift else ""
    return f"clock       t_camera = t_mocap {1e3 * handeye.clock_offset_s:+.2f} +- {fine(1e3 * handeye.clock_offset_std_s)} ms{drift}"


def _rms_words(handeye: HandEye) -> str:
    used = [view for view in handeye.views if view.used]
    metre = np.sqrt(np.mean([(view.residual_m or 0.0) ** 2 for view in used]))
    rad = np.sqrt(np.mean([(view.residual_rad or 0.0) ** 2 for view in used]))
    px = [view.residual_px for view in used if view.residual_px is not None]
    corners = f", corners {np.sqrt(np.mean(np.square(px))):.3f} px" if px else ""
    return f"{fine(1e3 * metre)} mm, {fine(np.degrees(rad), 3)} deg rms{corners}"


def _left_out(handeye: HandEye) -> list[str]:
    """The views that were not used, in one line; handeye.yaml says why of each."""
    why: dict[str, list[str]] = {}
    for view in handeye.views:
        if not view.used:
            why.setdefault(view.reason or view.why or "no reason given", []).append(view.image)
    if not why:
        return []
    texts = [f"{reason}: {', '.join(images[:NAMED_VIEWS])}{_more(len(images) - NAMED_VIEWS)}" for reason, images in why.items()]
    return [f"  without:  {'; '.join(texts[:NAMED_REASONS])}{'; and others' if len(texts) > NAMED_REASONS else ''}"]


def _more(count: int) -> str:
    return f" and {count} more" if count > 0 else ""


def _noise(found: HandEyeEvidence | None) -> list[str]:
    if found is None:
        return []
    if found.corner_sigma_px is not None:
        mocap = f"mocap {fine(found.mocap_sigma_deg, 3)} deg, {fine(1e3 * found.mocap_sigma_m)} mm"
        return [f"noise       {mocap}; corners {fine(found.corner_sigma_px, 3)} px"]
    across, _, depth = (1e3 * sigma_m for sigma_m in found.board_sigma_m or (np.nan,) * 3)
    turn = fine(found.board_sigma_deg or np.nan, 3)
    return [f"noise       {turn} deg, {fine(across)} mm across, {fine(depth)} mm in depth, both sensors together"]


def _held_out(handeye: HandEye) -> str:
    errors = [1e3 * view.held_out_m for view in handeye.views if view.held_out_m is not None]
    return f"; left out of the solve by {fine(float(np.median(errors)))} (median), {fine(max(errors))} mm" if errors else ""


def _document(handeye: HandEye, body: str) -> dict[str, Any]:
    return {
        "body": body,
        **both_ways(handeye.H_PC, handeye.H_OB, body, handeye.carries),
        f"{handeye.names[0]}_covariance": handeye.H_PC_covariance,
        f"{handeye.names[1]}_covariance": handeye.H_OB_covariance,
        "clock_offset_s": handeye.clock_offset_s,
        "clock_offset_std_s": handeye.clock_offset_std_s,
        "clock_drift_ppm": 1e6 * handeye.clock_drift,
        "views_used": sum(view.used for view in handeye.views),
        "views_left_out": {view.image: view.why for view in handeye.views if not view.used},
        "held_out_m": {view.image: view.held_out_m for view in handeye.views if view.held_out_m is not None},
        "evidence": {} if handeye.evidence is None else document_of(handeye.evidence),
    }

"""Boards and tracked body -> handeye.yaml (H_PC, H_OB, clock offset), H_OP.yaml (the body at every image)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.handeye import solve_handeye
from lpcal.chain.h_op_panel import track_of
from lpcal.formats.h_op_yaml import ImagePanelPoses, write_h_op
from lpcal.formats.handeye_yaml import write_handeye
from lpcal.formats.pasted_transforms import EASY_HANDEYE, write_easy_handeye
from lpcal.geometry import se3
from lpcal.geometry.pose_track import poses_at
from lpcal.pipeline.handeye_inputs import HandEyeInputs, gather, input_files, section_of, with_recording
from lpcal.pipeline.handeye_summary import EASY_HANDEYE_FILE, body_name, summarise
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import HandEye, ViewVerdict
from lpcal.records.outcome import Outcome, Progress


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
    if given.stream is not None and given.t_camera_s is not None:
        panel = poses_at(track_of(given.stream), solved.mocap_times(given.t_camera_s))
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
    return ImagePanelPoses(given.body, given.images, given.t_camera_s, H_OP, verdict, steady, solved.clock_offset_s)


STAGE = Stage(
    name="handeye",
    kinds={"H_OP.yaml": "H_OP", "handeye.yaml": "handeye"},
    wanted=lambda workspace: workspace.rig_file.rig.mocap is not None,
    inputs=input_files,
    settings=settings,
    run=run,
    beside={EASY_HANDEYE_FILE: EASY_HANDEYE},
)

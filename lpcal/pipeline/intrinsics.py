"""Images of the board -> camera.yaml, camera.cameramodel, H_CB.yaml.

The camera is solved from ``camera.images`` alone; H_CB is found for those and for the images of ``mocap.images``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.chain.h_cb_board import BoardPose, fit_board_pose
from lpcal.chain.k_camera import board_shape, solve_camera
from lpcal.detect.radiometry import Sensor, fit_flat_field
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import write_camera
from lpcal.formats.cameramodel import MARK, MODEL_FILE, cameramodel_text
from lpcal.formats.corners_vnl import write_corners
from lpcal.formats.documents import Provenance
from lpcal.formats.h_cb_yaml import write_h_cb
from lpcal.formats.image_times import read_image_times
from lpcal.formats.images import read_image
from lpcal.formats.outputs import write_text
from lpcal.geometry.arrays import Array
from lpcal.pipeline.board_search import recall, refuse_another_board, refuse_two_sizes, search
from lpcal.pipeline.intrinsics_summary import summarise
from lpcal.pipeline.sensor import has_lens
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import CameraSolution
from lpcal.records.observations import Board, BoardPoses, BoardViews
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import BoardSection, CameraSection

CAMERAMODEL = "camera.cameramodel"
ASSUMED_SIGMA_PX = 0.1
"""Of a corner coordinate, where the camera was not solved here."""


def run(workspace: Workspace, progress: Progress, images: Sequence[Path] | None = None, corners: Path | None = None) -> Outcome:
    """Solve the camera, or take it from ``camera.cameramodel``, and find the board in every image.

    `images` stand in for ``camera.images``; `corners` is a vnlog to read their corners from, or to write them to where it is not there.

    Raises
    ------
    InputError, DegenerateError, DisagreementError, ConvergenceError
        As the steps raise them.
    """
    section: CameraSection = workspace.need("camera")
    board = board_of(workspace.rig_file.rig.board)
    own = list(images) if images is not None else camera_images(workspace)
    others = [image for image in mocap_images(workspace) if image not in set(own)]
    if section.cameramodel is None:
        _refuse_nothing(workspace, own, board)
    STAGE.refuse_places(workspace, _inputs(workspace, own, others))
    views = BoardViews((0, 0), ())
    if board is not None and (own or others):
        known = recall(workspace, corners, own, board) if corners is not None and corners.is_file() else {}
        views = search(workspace, [*own, *others], board, progress, known)
        if corners is not None and not known:
            write_corners(corners, views.views[: len(own)])
        refuse_another_board([*own, *others][: len(own) or None], replace(views, views=views.views[: len(own) or None]), board)
    solution = _solution(workspace, section, board, replace(views, views=views.views[: len(own)]), progress)
    solution = replace(solution, camera=_with_radiometry(workspace, section, solution))
    poses, left_out = board_poses(views, solution, progress)
    if section.cameramodel is not None and board is not None and board.warp and poses.images:
        solution = replace(solution, points_B=board_shape(views, board, solution.camera, dict(zip(poses.images, poses.H_CB, strict=True))))
        poses, left_out = board_poses(views, solution, progress)
    provenance = workspace.provenance(_inputs(workspace, own, others), settings(workspace))
    _write(workspace, solution, poses, left_out, board, provenance)
    return summarise(solution, poses, left_out, workspace.rig_file.rig)


def board_of(section: BoardSection | None) -> Board | None:
    """The board that a section of panel.yaml describes."""
    if section is None:
        return None
    marker_m = float("nan") if section.marker is None else section.marker
    return Board(
        section.corners, section.square, section.warp == "auto", section.kind, marker_m, section.dictionary or "", section.corner_fit
    )


def camera_images(workspace: Workspace) -> list[Path]:
    """The images of ``camera.images``."""
    section = workspace.rig_file.rig.camera
    return workspace.images(section.images, "camera.images") if section and section.images else []


def mocap_images(workspace: Workspace) -> list[Path]:
    """The images of ``mocap.images``: those that its csv files list, or that a pattern names."""
    section = workspace.rig_file.rig.mocap
    found: dict[Path, None] = {}
    for name in section.images if section else []:
        if name.lower().endswith(".csv"):
            listed = [image for image, _ in read_image_times(workspace.path(name, "mocap.images"))]
        else:
            listed = workspace.images([name], "mocap.images")
        found |= dict.fromkeys(listed)
    return list(found)


def board_poses(views: BoardViews, solution: CameraSolution, progress: Progress) -> tuple[BoardPoses, dict[str, str]]:
    """H_CB of every view with a board, by the final camera; and why the others have none."""
    poses: dict[str, BoardPose] = {}
    left_out: dict[str, str] = {}
    corners: dict[str, Array] = {}
    sigma_px = solution.corner_sigma_px
    for done, view in enumerate(views.views, start=1):
        if view.corners_px is None:
            left_out[view.image] = view.why or "no board found"
            continue
        try:
            pose = fit_board_pose(view.corners_px, solution.points_B, solution.camera, sigma_px, solution.H_CB.get(view.image))
        except (DegenerateError, np.linalg.LinAlgError) as error:
            left_out[view.image] = f"no pose: {error}"
            continue
        poses[view.image] = pose
        corners[view.image] = np.where(pose.inlier[:, None], view.corners_px, np.nan)
        progress("board poses", done, len(views.views))
    count = len(poses)
    found = BoardPoses(
        images=tuple(poses),
        t_camera_s=None,
        H_CB=np.array([pose.H_CB for pose in poses.values()]).reshape(count, 4, 4),
        corners_px=np.array(list(corners.values())).reshape(count, len(solution.points_B), 2),
        points_B=solution.points_B,
        covariance=np.array([pose.covariance for pose in poses.values()]).reshape(count, 6, 6),
        rms_px=np.array([pose.rms_px for pose in poses.values()]),
        corner_sigma_px=sigma_px,
    )
    return found, left_out


def settings(workspace: Workspace) -> dict[str, Any]:
    """The sections that the stage depends on."""
    rig = workspace.rig_file.rig
    return {
        "camera": rig.camera.model_dump() if rig.camera else None,
        "board": rig.board.model_dump() if rig.board else None,
        "mocap_images": list(rig.mocap.images) if rig.mocap else [],
    }


def _refuse_nothing(workspace: Workspace, own: Sequence[Path], board: Board | None) -> None:
    """Without ``camera.cameramodel`` there must be images and a board."""
    workspace.need("board")
    if not own or board is None:
        raise InputError(
            "no images to solve the camera from",
            where=workspace.rig_file.where("camera"),
            needed="camera.images, or camera.cameramodel",
            todo="name the images of the board there, or on the command line: lpcal intrinsics boards/*.png",
        )


def _solution(workspace: Workspace, section: CameraSection, board: Board | None, views: BoardViews, progress: Progress) -> CameraSolution:
    """Solved from the views, or as a file gives it."""
    if section.cameramodel is None:
        assert board is not None
        progress("camera", 0, 1)
        solution = solve_camera(views, board, model=section.model)
        progress("camera", 1, 1)
        return solution
    path = workspace.path(section.cameramodel, "camera.cameramodel")
    camera = read_camera_file(path)
    if views.views and camera.image_size != views.image_size:
        raise DisagreementError(
            "a camera of {}x{} pixels; the images have {}x{}".format(*camera.image_size, *views.image_size),
            where=str(path),
            needed="the camera that took the images, at their size",
            todo="name the right file, or leave camera.cameramodel out to solve the camera anew",
        )
    points_B = board.points_B() if board is not None else np.zeros((0, 3))
    return CameraSolution(camera, points_B, (), f"given: {section.cameramodel}", ASSUMED_SIGMA_PX)


def _with_radiometry(workspace: Workspace, section: CameraSection, solution: CameraSolution) -> Any:
    """The camera with what its section says of the sensor."""
    sensor = Sensor(section.black_level, section.white_level, section.gamma)
    flat_field = None
    if section.flat_field is not None:
        stored = read_image(workspace.path(section.flat_field, "camera.flat_field"))
        refuse_two_sizes(["the camera", section.flat_field], [solution.camera.image_size, stored.size])
        flat_field = fit_flat_field(stored.pixels, sensor)
    return replace(
        solution.camera,
        black_level=section.black_level,
        white_level=section.white_level,
        gamma=section.gamma,
        flat_field=flat_field,
    )


def _inputs(workspace: Workspace, own: Sequence[Path], others: Sequence[Path]) -> list[Path]:
    rig = workspace.rig_file.rig
    named = [("camera.flat_field", rig.camera.flat_field), ("camera.cameramodel", rig.camera.cameramodel)] if rig.camera else []
    named += [("mocap.images", name) for name in (rig.mocap.images if rig.mocap else []) if name.lower().endswith(".csv")]
    return [*own, *others, *(workspace.path(name, key) for key, name in named if name)]


def _write(
    workspace: Workspace,
    solution: CameraSolution,
    poses: BoardPoses,
    left_out: dict[str, str],
    board: Board | None,
    provenance: Provenance,
) -> None:
    write_text(workspace.calib(CAMERAMODEL), MARK + (solution.cameramodel or cameramodel_text(solution.camera)), MODEL_FILE)
    write_h_cb(workspace.calib("H_CB.yaml"), poses, left_out, board.corners if board else (0, 0), provenance)
    write_camera(workspace.calib("camera.yaml"), solution, provenance)


STAGE = Stage(
    name="intrinsics",
    kinds={"camera.yaml": "camera", "H_CB.yaml": "H_CB"},
    wanted=has_lens,
    inputs=lambda workspace: _inputs(workspace, camera_images(workspace), _others(workspace)),
    settings=settings,
    run=run,
    beside={CAMERAMODEL: MODEL_FILE},
)


def _others(workspace: Workspace) -> list[Path]:
    own = set(camera_images(workspace))
    return [image for image in mocap_images(workspace) if image not in own]

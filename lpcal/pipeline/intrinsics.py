"""Images of the board -> camera.yaml, camera.cameramodel, H_CB.yaml.

The camera is solved from ``camera.images`` alone; H_CB is found for those and for the images of ``mocap.images``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from lpcal.api.board_search import refuse_another_board, refuse_two_sizes
from lpcal.api.boards import as_given, board_of, calibrate_camera, locate_boards
from lpcal.detect.radiometry import fit_flat_field
from lpcal.errors import InputError
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import write_camera
from lpcal.formats.cameramodel import MARK, MODEL_FILE, cameramodel_text
from lpcal.formats.corners_vnl import write_corners
from lpcal.formats.h_cb_yaml import write_h_cb
from lpcal.formats.image_times import read_image_times
from lpcal.formats.images import read_image
from lpcal.formats.outputs import write_text
from lpcal.pipeline.board_search import recall, search, shown_in
from lpcal.pipeline.intrinsics_summary import summarise
from lpcal.pipeline.sensor import has_lens
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import CameraSolution
from lpcal.records.observations import Board, BoardPoses, BoardViews
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.provenance import Provenance
from lpcal.records.rig import CameraSection
from lpcal.records.sensor import Sensor

CAMERAMODEL = "camera.cameramodel"


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
        refuse_another_board(shown_in([*own, *others]), replace(views, views=views.views[: len(own) or None]), board)
    solution = _solution(workspace, section, board, replace(views, views=views.views[: len(own)]), progress)
    solution = replace(solution, camera=_with_radiometry(workspace, section, solution))
    solved = section.cameramodel is None or board is None
    poses = locate_boards(views, solution if solved else solution.camera, board, progress=progress)
    if poses.points_B is not None:
        solution = replace(solution, points_B=poses.points_B)
    provenance = workspace.provenance(_inputs(workspace, own, others), settings(workspace))
    _write(workspace, solution, poses, board, provenance)
    return summarise(solution, poses, poses.without, workspace.rig_file.rig)


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
        return calibrate_camera(views, board, model=section.model, progress=progress)
    path = workspace.path(section.cameramodel, "camera.cameramodel")
    return as_given(read_camera_file(path), board, section.cameramodel, str(path), views.image_size if views.views else None)


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
    board: Board | None,
    provenance: Provenance,
) -> None:
    write_text(workspace.calib(CAMERAMODEL), MARK + (solution.cameramodel or cameramodel_text(solution.camera)), MODEL_FILE)
    write_h_cb(workspace.calib("H_CB.yaml"), poses, poses.without, board.corners if board else (0, 0), provenance)
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

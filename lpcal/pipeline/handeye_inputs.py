"""What the hand-eye stage and its check work on: boards with their times, and the tracked body, from whatever panel.yaml names."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lpcal.chain.h_op_body import body_of
from lpcal.chain.h_op_panel import match_rests, rests_of, track_of
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.h_cb_yaml import read_h_cb
from lpcal.formats.image_times import read_image_times
from lpcal.formats.mocap import read_mocap, read_pose_csv
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.pose_table import timed_poses
from lpcal.formats.robot_poses import ImagePoses, Stated, read_robot_poses
from lpcal.geometry.arrays import Array
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Camera
from lpcal.records.observations import BoardPoses, PoseStream
from lpcal.records.outcome import Progress
from lpcal.records.rig import MocapSection


@dataclass(frozen=True)
class HandEyeInputs:
    """Row k of `boards` is one view; either `stream`, or `H_OP` with one pose a view."""

    boards: BoardPoses
    camera: Camera | None
    camera_share: float
    """Share of the views from which the camera was solved too."""
    stream: PoseStream | None
    H_OP: Array | None
    without_board: dict[str, str]
    """Images that the stage was asked for and that show no board, and why."""
    images: tuple[str, ...]
    """All images asked for, in order."""
    t_camera_s: Array | None
    """Times of all images."""
    without_pose: dict[str, str]
    """Images with a board that `mocap.poses` does not name, or that match no rest of the recording, and why."""
    body: str = ""
    """The tracked body's name."""
    notes: tuple[str, ...] = ()
    """What was repaired or matched in the recording, in words."""
    format: str = ""
    """The format that the recording, or the file of poses, was recognised as."""


def section_of(workspace: Workspace) -> MocapSection:
    """``mocap:``, which must say where the panel was and where its images are.

    Raises
    ------
    InputError
        It is not there, or names neither a recording nor poses, or no images.
    """
    section: MocapSection = workspace.need("mocap")
    where = workspace.rig_file.where("mocap")
    if section.poses is None and section.file is None:
        raise InputError("neither file nor poses", where=where, needed="mocap.file: a recording, or mocap.poses", todo="name one")
    camera = workspace.rig_file.rig.camera
    if section.poses is None and not section.images and section.board_poses is None and not (camera and camera.images):
        raise InputError("no images", where=where, needed="mocap.images: csv files of file,time_s; or mocap.board_poses", todo="name them")
    return section


def with_recording(workspace: Workspace, recording: Path | None) -> Workspace:
    """The workspace with another recording in place of ``mocap.file``.

    Raises
    ------
    InputError
        The recording is not there.
    """
    if recording is None:
        return workspace
    if not recording.exists():
        todo = did_you_mean(recording, "correct the name")
        raise InputError("no such file", where=str(recording), needed="a motion-capture recording", todo=todo)
    rig = workspace.rig_file.rig
    section = (rig.mocap or MocapSection()).model_copy(update={"file": workspace.relative(recording), "poses": None})
    return Workspace(replace(workspace.rig_file, rig=rig.model_copy(update={"mocap": section})))


def input_files(workspace: Workspace) -> list[Path]:
    """The files that the stage reads."""
    section = section_of(workspace)
    board_poses = section.board_poses.file if section.board_poses else None
    named = [("mocap.file", section.file)] if section.poses is None else [("mocap.poses", section.poses)]
    named += [("mocap.board_poses", board_poses), *(("mocap.images", name) for name in section.images if name.lower().endswith(".csv"))]
    found = [each for key, name in named if name for each in workspace.files(name, key)]  # a ROS 2 bag is a folder
    return found if board_poses else [*found, workspace.calib("camera.yaml"), workspace.calib("H_CB.yaml")]


def gather(workspace: Workspace, progress: Progress) -> HandEyeInputs:
    """Read it all; the intrinsics stage runs first where its files are not there.

    Raises
    ------
    InputError, DisagreementError, DegenerateError
        As the readers raise them; an image without a board is no error.
    """
    section = section_of(workspace)
    if section.board_poses is not None:
        return _from_board_poses(workspace, section)
    if not (workspace.calib("H_CB.yaml").is_file() and workspace.calib("camera.yaml").is_file()):
        from lpcal.pipeline import intrinsics

        intrinsics.STAGE.run(workspace, progress)
    known, camera = read_h_cb(workspace.calib("H_CB.yaml")), read_camera(workspace.calib("camera.yaml"))
    if section.poses is not None:
        return _from_poses(workspace, section, known, camera)
    if not any(name.lower().endswith(".csv") for name in section.images):
        return _from_rests(workspace, section, known, camera)
    listed = _timed_images(workspace, section)
    stream = recording(workspace, section)
    boards, without = _chosen(known, list(listed))
    boards = replace(boards, t_camera_s=np.array([listed[image] for image in boards.images]))
    times = np.array(list(listed.values()))
    share = _share(workspace, boards)
    return HandEyeInputs(boards, camera, share, stream, None, without, tuple(listed), times, {}, stream.body, stream.notes, stream.format)


def recording(workspace: Workspace, section: MocapSection) -> PoseStream:
    """The body's stream of ``mocap.file``; bare markers are made a body, in the frame of ``panel.markers`` where they are named there.

    Raises
    ------
    InputError, DisagreementError, DegenerateError
        As `read_mocap` and `body_of`.
    """
    path = workspace.path(str(section.file), "mocap.file")
    found = read_mocap(path, section.body, quaternion=section.quaternion, units=section.units, direction=section.direction)
    panel = workspace.rig_file.rig.panel
    return found if isinstance(found, PoseStream) else body_of(found, panel.markers if panel else None)


def _timed_images(workspace: Workspace, section: MocapSection) -> dict[str, float]:
    listed: dict[str, float] = {}
    for name in section.images:
        if not name.lower().endswith(".csv"):
            raise InputError(
                f"{name} is no csv",
                where=workspace.rig_file.where("mocap.images"),
                needed="csv files of file,time_s: a recording with a clock needs the images' times",
                todo="write them, or give one pose an image: mocap.poses",
            )
        for image, time in read_image_times(workspace.path(name, "mocap.images")):
            listed[workspace.relative(image)] = time
    return listed


def _chosen(known: BoardPoses, images: list[str]) -> tuple[BoardPoses, dict[str, str]]:
    """The boards of some images, in their order, and the images without one."""
    place = {image: k for k, image in enumerate(known.images)}
    rows = np.array([place[image] for image in images if image in place], dtype=np.intp)
    without = {image: "no board found" for image in images if image not in place}
    if not rows.size:
        raise DegenerateError(f"no board in any of {len(images)} images", needed="board views", todo="look at: lpcal intrinsics")
    return known.of(rows), without


def _share(workspace: Workspace, boards: BoardPoses) -> float:
    from lpcal.pipeline.intrinsics import camera_images

    own = {workspace.relative(image) for image in camera_images(workspace)}
    return float(np.mean([image in own for image in boards.images])) if own else 0.0


def _from_poses(workspace: Workspace, section: MocapSection, known: BoardPoses, camera: Camera) -> HandEyeInputs:
    from lpcal.pipeline.intrinsics import camera_images, mocap_images

    path = workspace.path(str(section.poses), "mocap.poses")
    poses = read_robot_poses(path, Stated(section.quaternion, section.units, section.direction, section.rotation))
    images = [workspace.relative(image) for image in (mocap_images(workspace) or camera_images(workspace))]
    paired = _paired(poses, images, path)
    lost = [poses.H[row] for row in poses.lost]
    pose_of = {image: H for image, H in paired.items() if not any(np.array_equal(H, each) for each in lost)}
    boards, without = _chosen(known, images)
    why = {True: "its pose is the identity, the body was lost", False: "no pose of it in mocap.poses"}
    unposed = {image: why[image in paired] for image in boards.images if image not in pose_of}
    if len(unposed) == len(boards.images):
        raise DisagreementError(
            "its names are no image's", where=str(path), needed=f"names such as {images[0]}", todo="correct the names in mocap.poses"
        )
    boards = boards.of(np.array([k for k, image in enumerate(boards.images) if image in pose_of], dtype=np.intp))
    H_OP = np.array([pose_of[image] for image in boards.images])
    share = _share(workspace, boards)
    return HandEyeInputs(boards, camera, share, None, H_OP, without, tuple(images), None, unposed, notes=poses.notes, format=poses.format)


def _from_rests(workspace: Workspace, section: MocapSection, known: BoardPoses, camera: Camera) -> HandEyeInputs:
    """A recording and images without times: the body's rests matched to the images in order."""
    from lpcal.pipeline.intrinsics import camera_images, mocap_images

    stream = recording(workspace, section)
    images = [workspace.relative(image) for image in (mocap_images(workspace) or camera_images(workspace))]
    boards, without = _chosen(known, images)
    rests = rests_of(track_of(stream))
    match = match_rests(rests, boards.H_CB)
    rows = np.flatnonzero(match >= 0)
    unposed = {boards.images[k]: "matches no rest of the body in the recording" for k in np.flatnonzero(match < 0)}
    notes = (
        *stream.notes,
        f"no images' times: {len(rows)} of {len(match)} views matched to the body's rests, in order, of {len(rests.t_s)}; the angles agree",
    )
    H_OP = rests.H_OP[match[rows]]
    boards = boards.of(rows)
    share = _share(workspace, boards)
    return HandEyeInputs(boards, camera, share, None, H_OP, without, tuple(images), None, unposed, stream.body, notes, format=stream.format)


def _paired(poses: ImagePoses, images: list[str], path: Path) -> dict[str, Array]:
    """Pose by image: by name where the file has names (whole, its last part, or that without its ending), else by order.

    Names that only count, from 0 or 1, and as many as there are images, are an order, too.
    """
    counted = poses.files is not None and any(tuple(map(str, range(k, k + len(images)))) == poses.files for k in (0, 1))
    if poses.files is None or counted:
        if len(poses.H) != len(images):
            raise DisagreementError(
                f"{len(poses.H)} poses for {len(images)} images",
                where=str(path),
                needed="as many, in the same order",
                todo="name the images in a csv: file,x_m,y_m,z_m,qx,qy,qz,qw",
            )
        return dict(zip(images, poses.H, strict=True))
    named = dict(zip(poses.files, poses.H, strict=True))
    last = {Path(name).name: H for name, H in named.items()}
    once = Counter(Path(image).stem for image in images)
    bare = {image: last.get(Path(image).stem) if once[Path(image).stem] == 1 else None for image in images}
    found = {image: named.get(image, last.get(Path(image).name, bare[image])) for image in images}
    return {image: H for image, H in found.items() if H is not None}


def _from_board_poses(workspace: Workspace, section: MocapSection) -> HandEyeInputs:
    """Board poses found elsewhere: no images, no corners, no camera."""
    assert section.board_poses is not None
    path = workspace.path(section.board_poses.file, "mocap.board_poses")
    rows = timed_poses(read_pose_csv(path), path, inverse=section.board_poses.direction == "H_BC")
    names = tuple(f"{path.name} at {t:.4f} s" for t in rows.t_s)
    found = BoardPoses(names, rows.t_s, rows.H)
    if section.file is None:
        raise InputError("no file", where=workspace.rig_file.where("mocap"), needed="mocap.file: a recording", todo="name it")
    stream = recording(workspace, section)
    return HandEyeInputs(found, None, 0.0, stream, None, {}, names, rows.t_s, {}, stream.body, stream.notes, stream.format)

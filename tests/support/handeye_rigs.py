"""Rig folders made of simulated hand-eye sessions: two streams, or images with their times or one pose each."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from handeye_scene import TYPICAL, Session
from lpcal.formats.camera_yaml import write_camera
from lpcal.formats.h_cb_yaml import write_h_cb
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import CameraSolution
from lpcal.records.provenance import Provenance

FLIP = se3.exp(np.array([0.0, 0.0, 2.1, 0.03, -0.02, 0.01]))


def poses_csv(path: Path, t_s: Array, H: Array, order: str = "xyzw", scale: float = 1.0) -> None:
    q = se3.quaternion(H[:, :3, :3])
    q = q[:, [3, 0, 1, 2]] if order == "wxyz" else q
    rows = (f"{t:.7f}," + ",".join(f"{v:.9f}" for v in (*(scale * x), *each)) for t, x, each in zip(t_s, H[:, :3, 3], q, strict=True))
    path.write_text("\n".join(rows) + "\n")


def moving_rig(
    folder: Path,
    session: Session,
    *,
    H_OP: Array | None = None,
    H_CB: Array | None = None,
    t_s: Array | None = None,
    t_camera_s: Array | None = None,
    mocap: str = "",
    direction: str = "H_CB",
    **kwargs: Any,
) -> None:
    """A rig folder of two streams: mocap, and board poses found elsewhere."""
    stream, boards = session.stream, session.boards
    assert stream is not None
    assert boards.t_camera_s is not None
    poses_csv(folder / "mocap.csv", stream.t_s if t_s is None else t_s, stream.H_OP if H_OP is None else H_OP, **kwargs)
    poses_csv(folder / "boards.csv", boards.t_camera_s if t_camera_s is None else t_camera_s, boards.H_CB if H_CB is None else H_CB)
    (folder / "panel.yaml").write_text(
        f"lpcal: 1\nmocap:\n  file: mocap.csv\n  board_poses: {{file: boards.csv, direction: {direction}}}\n{mocap}"
    )


def image_rig(folder: Path, session: Session, H_OP: Array | None = None, *, names: list[str] | None = None) -> None:
    """A rig folder whose intrinsics stage has run: images, camera.yaml, H_CB.yaml; a recording with image times, or one pose an image."""
    count = len(session.boards.images)
    covariance, rms_px = np.tile(1e-8 * np.eye(6), (count, 1, 1)), np.full(count, TYPICAL.px)
    boards = replace(session.boards, covariance=covariance, rms_px=rms_px, corner_sigma_px=TYPICAL.px)
    for name in boards.images:
        (folder / name).write_bytes(b"")
    assert boards.points_B is not None
    if H_OP is None:
        assert session.stream is not None
        assert boards.t_camera_s is not None
        poses_csv(folder / "mocap.csv", session.stream.t_s, session.stream.H_OP)
        times = "\n".join(f"{name},{t:.7f}" for name, t in zip(boards.images, boards.t_camera_s, strict=True))
        (folder / "times.csv").write_text(f"file,time_s\n{times}\n")
        mocap = "{file: mocap.csv, images: times.csv}"
    elif names is None:
        np.savetxt(folder / "robot.txt", H_OP.reshape(-1, 16), fmt="%.10f")
        mocap = "{poses: robot.txt}"
    else:
        q = se3.quaternion(H_OP[:, :3, :3])
        rows = [f"{name}," + ",".join(f"{v:.9f}" for v in (*H_OP[k, :3, 3], *q[k])) for k, name in enumerate(names)]
        (folder / "robot.csv").write_text("\n".join(["file,x_m,y_m,z_m,qx,qy,qz,qw", *rows]) + "\n")
        mocap = "{poses: robot.csv}"
    solution = CameraSolution(session.camera, boards.points_B, (), "mrcal", TYPICAL.px)
    (folder / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{images: view_*.png}}\nmocap: {mocap}\n")
    write_camera(folder / "calib" / "camera.yaml", solution, Provenance())
    write_h_cb(folder / "calib" / "H_CB.yaml", boards, {}, (9, 6), Provenance())

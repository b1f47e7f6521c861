"""``lpcal handeye`` and ``lpcal check`` on rig folders: what is planted is named by both, with the exit code, and nothing is written."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from lpcal.formats.camera_yaml import write_camera
from lpcal.formats.documents import Provenance
from lpcal.formats.h_cb_yaml import write_h_cb
from lpcal.formats.h_op_yaml import read_h_op
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.geometry import se3
from lpcal.records.calibration import CameraSolution

from handeye_scene import TYPICAL, moving_session, static_session

MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])


def poses_csv(path: Path, t_s, H, order="xyzw", scale=1.0) -> None:
    q = se3.quaternion(H[:, :3, :3])
    q = q[:, [3, 0, 1, 2]] if order == "wxyz" else q
    rows = (f"{t:.7f}," + ",".join(f"{v:.9f}" for v in (*(scale * x), *each)) for t, x, each in zip(t_s, H[:, :3, 3], q, strict=True))
    path.write_text("\n".join(rows) + "\n")


@pytest.fixture
def session():
    return moving_session(np.random.default_rng(11), 60)


def moving_rig(folder: Path, session, *, H_OP=None, H_CB=None, t_camera_s=None, mocap="", **kwargs) -> Path:
    """A rig folder of two streams: mocap, and board poses found elsewhere."""
    stream, boards = session.stream, session.boards
    poses_csv(folder / "mocap.csv", stream.t_s, stream.H_OP if H_OP is None else H_OP, **kwargs)
    poses_csv(folder / "boards.csv", boards.t_camera_s if t_camera_s is None else t_camera_s, boards.H_CB if H_CB is None else H_CB)
    (folder / "panel.yaml").write_text(f"lpcal: 1\nmocap:\n  file: mocap.csv\n  board_poses: {{file: boards.csv}}\n{mocap}")
    return folder


def image_rig(folder: Path, session, poses) -> Path:
    """A rig folder whose intrinsics stage has run: images, camera.yaml, H_CB.yaml, and one pose an image."""
    count = len(session.boards.images)
    covariance, rms_px = np.tile(1e-8 * np.eye(6), (count, 1, 1)), np.full(count, TYPICAL.px)
    boards = replace(session.boards, covariance=covariance, rms_px=rms_px, corner_sigma_px=TYPICAL.px)
    for name in boards.images:
        (folder / name).write_bytes(b"")
    np.savetxt(folder / "robot.txt", poses.reshape(-1, 16), fmt="%.10f")
    solution = CameraSolution(session.camera, boards.points_B, (), "mrcal", TYPICAL.px)
    (folder / "panel.yaml").write_text("lpcal: 1\ncamera: {images: view_*.png}\nmocap: {poses: robot.txt}\n")
    write_camera(folder / "calib" / "camera.yaml", solution, Provenance())
    write_h_cb(folder / "calib" / "H_CB.yaml", boards, {}, (9, 6), Provenance())
    return folder


def test_both_streams(tmp_path, session, lpcal):
    folder = moving_rig(tmp_path, session)
    code, out, err = lpcal("handeye", cwd=folder)
    assert code == 0, err
    assert "static_transform_publisher" in out
    assert "(x, y, z, w)" in out
    found = read_handeye(folder / "calib" / "handeye.yaml")
    assert np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3]) < 4e-3
    assert abs(found.clock_offset_s - session.offset_s) < 2e-3
    assert len(found.views) == 60
    poses = read_h_op(folder / "calib" / "H_OP.yaml")
    assert np.isfinite(poses.H_OP[0]).all()
    document = yaml.safe_load((folder / "calib" / "handeye.yaml").read_text())
    assert set(document["views"][0]) == {"image", "used", "why", "residual_px", "residual_m", "residual_deg", "held_out_m"}
    code, out, _ = lpcal("check", cwd=folder)
    assert (code, "nothing wrong found" in out) == (0, True)


def test_one_pose_an_image(tmp_path, lpcal):
    session = static_session(np.random.default_rng(1), 24, flips=0.1)
    folder = image_rig(tmp_path, session, session.H_OP)
    code, _, err = lpcal("handeye", "--json", cwd=folder)
    assert code == 0, err
    found = read_handeye(folder / "calib" / "handeye.yaml")
    assert found.clock_offset_s is None
    assert [view.used for view in found.views] == (~session.flipped).tolist()
    xi = se3.log(session.H_PC @ se3.inv(found.H_PC))
    assert xi @ np.linalg.solve(found.H_PC_covariance, xi) < 25
    np.savetxt(folder / "robot.txt", session.H_OP[:-1].reshape(-1, 16))
    code, _, err = lpcal("handeye", cwd=folder)
    assert (code, "23 poses for 24 images" in err) == (6, True)


def _reordered(H):
    H = H.copy()
    H[:, :3, :3] = se3.rotation_from_quaternion(se3.quaternion(H[:, :3, :3])[:, [3, 0, 1, 2]])
    return H


def _mirrored(H):
    H = H.copy()
    H[:, 1, 3] *= -1
    return H


PLANTED = {
    "mocap inverted": (lambda s: {"H_OP": se3.inv(s.stream.H_OP)}, 6, "mocap poses are inverted", "mocap.direction: H_PO"),
    "boards inverted": (lambda s: {"H_CB": se3.inv(s.boards.H_CB)}, 6, "board poses are inverted", "mocap.board_poses.direction: H_BC"),
    "wxyz for xyzw": (lambda s: {"H_OP": _reordered(s.stream.H_OP)}, 6, "they are w, x, y, z", "mocap.quaternion: wxyz"),
    "mirrored y": (lambda s: {"H_OP": _mirrored(s.stream.H_OP)}, 6, "mirrored along y", "right-handed frame"),
    "mirrored": (lambda s: {"H_OP": MIRROR @ s.stream.H_OP @ MIRROR}, 6, "left-handed", "right-handed frame"),
    "mm for m": (lambda s: {"scale": 1000.0}, 6, "in mm, not in metres", "mocap.units: mm"),
    "a year apart": (lambda s: {"t_camera_s": s.boards.t_camera_s + 3.15e7}, 6, "the clocks do not meet", "mocap.clock_offset"),
}


@pytest.mark.parametrize("name", PLANTED)
@pytest.mark.parametrize("command", ["handeye", "check"])
def test_planted_mistakes_are_named(tmp_path, session, lpcal, name, command):
    make, exit_code, words, todo = PLANTED[name]
    folder = moving_rig(tmp_path, session, **make(session))
    code, out, err = lpcal(command, cwd=folder)
    assert code == exit_code, out + err
    assert words in out + err
    assert todo in out + err
    assert not (folder / "calib").exists()


def test_what_mends_it_mends_it(tmp_path, session, lpcal):
    for keys, planted in (
        ("  direction: H_PO\n", {"H_OP": se3.inv(session.stream.H_OP)}),
        ("  quaternion: wxyz\n", {"order": "wxyz"}),
        ("  units: mm\n", {"scale": 1000.0}),
    ):
        folder = moving_rig(tmp_path, session, mocap=keys, **planted)
        code, out, err = lpcal("check", cwd=folder)
        assert code == 0, keys + out + err


@pytest.mark.parametrize("command", ["handeye", "check"])
def test_shifted_pairing_and_board_size(tmp_path, lpcal, command):
    session = static_session(np.random.default_rng(2), 20)
    folder = image_rig(tmp_path, session, np.roll(session.H_OP, 1, axis=0))
    code, out, err = lpcal(command, cwd=folder)
    assert code == 6
    assert "the pairing is shifted by 1" in out + err
    (folder / "inch").mkdir()
    scaled = session.H_OP.copy()
    scaled[:, :3, 3] /= 25.4
    code, out, err = lpcal(command, cwd=image_rig(folder / "inch", session, scaled))
    assert code == 6
    assert "board.square" in out + err
    assert not (folder / "inch" / "calib" / "handeye.yaml").exists()


def test_a_board_one_percent_off_is_solved_and_said(tmp_path, lpcal):
    session = static_session(np.random.default_rng(3), 60)
    scaled = session.H_OP.copy()
    scaled[:, :3, 3] *= 1.012
    scaled_boards = image_rig(tmp_path, session, scaled)
    code, _, err = lpcal("handeye", cwd=scaled_boards)
    assert code == 0
    assert "the mocap measures the board as 101." in err


def test_missing_pieces(tmp_path, session, lpcal):
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nname: nothing\n")
    assert lpcal("handeye", cwd=tmp_path)[0] == 3
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nmocap: {file: absent.csv, board_poses: {file: absent.csv}}\n")
    code, _, err = lpcal("handeye", cwd=tmp_path)
    assert (code, "absent.csv" in err, "panel.yaml:2" in err) == (3, True, True)
    folder = moving_rig(tmp_path, session)
    assert lpcal("handeye", "other.csv", cwd=folder)[0] == 3
    text = (folder / "mocap.csv").read_text()
    (folder / "mocap.csv").write_text(text[: len(text) // 2 - 12])
    code, _, err = lpcal("check", cwd=folder)
    assert code == 3
    assert "cut off" in err
    (folder / "mocap.csv").write_text("")
    assert lpcal("handeye", cwd=folder)[0] == 3
    assert not (folder / "calib").exists()


@pytest.mark.slow
def test_rig_a_from_the_true_camera(data, tmp_path, lpcal):
    import shutil

    folder = tmp_path / "rig"
    shutil.copytree(data("rig_a"), folder, ignore=shutil.ignore_patterns("objects", "spheres"))
    for path in folder.rglob("*"):
        path.chmod(0o755)
    assert lpcal("intrinsics", cwd=folder)[0] == 0
    assert lpcal("handeye", "mocap.csv", cwd=folder)[0] == 0
    found = read_handeye(folder / "calib" / "handeye.yaml")
    true = yaml.safe_load((folder / "truth" / "handeye.yaml").read_text())
    error = se3.log(np.array(true["H_PC"]) @ se3.inv(found.H_PC))
    assert np.degrees(np.linalg.norm(error[:3])) < 0.04
    assert np.linalg.norm(found.H_PC[:3, 3] - np.array(true["H_PC"])[:3, 3]) < 0.35e-3
    assert error @ np.linalg.solve(found.H_PC_covariance, error) < 16.8
    assert abs(found.clock_offset_s - true["clock_offset_s"]) < min(5e-4, 3 * found.clock_offset_std_s)
    used = {view.image for view in found.views if view.used}
    assert not used & {f"stations/station_{k:02d}.png" for k in (6, 9, 22, 31)}


def test_eth_vicon(data, tmp_path, lpcal):
    folder = data("handeye/eth_vicon_1")
    mocap, boards = (next(folder.glob(f"*_{name}*.csv")) for name in ("vicon", "W_camera"))
    lines = boards.read_text().splitlines()
    (tmp_path / "boards.csv").write_text("\n".join(lines[::4]))
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nmocap: {{file: {mocap}, board_poses: {{file: boards.csv, direction: H_BC}}}}\n")
    code, _, err = lpcal("handeye", cwd=tmp_path)
    assert code == 0, err
    found = read_handeye(tmp_path / "calib" / "handeye.yaml")
    assert found.clock_offset_s == pytest.approx(-0.020, abs=4e-3)
    assert np.linalg.norm(found.H_PC[:3, 3] - [0.07549, 0.04086, 0.02567]) < 6e-3

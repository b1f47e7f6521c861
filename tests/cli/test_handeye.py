"""``lpcal handeye`` and ``lpcal check`` on rig folders: what is planted is named by both, with the exit code, and nothing is written."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml

from handeye_rigs import image_rig, moving_rig
from handeye_scene import Session, moving_session, static_session
from lpcal.formats.h_op_yaml import read_h_op
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.geometry import se3


@pytest.fixture
def session() -> Session:
    return moving_session(np.random.default_rng(11), 60)


def test_both_streams(tmp_path: Path, session: Session, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    folder = tmp_path
    moving_rig(folder, session)
    code, out, err = lpcal("handeye", cwd=folder)
    assert code == 0, err
    assert len(out.splitlines()) <= 13
    assert "xyzw" in out
    found = read_handeye(folder / "calib" / "handeye.yaml")
    assert np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3]) < 4e-3
    assert abs(found.clock_offset_s - session.offset_s) < 2e-3
    assert len(found.views) == 60
    poses = read_h_op(folder / "calib" / "H_OP.yaml")
    assert np.isfinite(poses.H_OP[0]).all()
    document = yaml.safe_load((folder / "calib" / "handeye.yaml").read_text())
    assert all("static_transform_publisher" in document["transforms"][name]["ros"] for name in ("H_PC", "H_CP", "H_OB", "H_BO"))
    assert "of the panel" in document["evidence"]["weakest"]
    assert set(document["views"][0]) == {"image", "used", "why", "residual_px", "residual_m", "residual_deg", "held_out_m"}
    code, out, _ = lpcal("check", cwd=folder)
    assert (code, "nothing wrong found" in out) == (0, True)
    assert "\nformat      mocap.csv read as: csv of poses\n" in out
    assert json.loads(lpcal("check", "--json", cwd=folder)[1])["format"] == "csv of poses"


def test_one_pose_an_image(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    session = static_session(np.random.default_rng(1), 24, flips=0.1)
    folder = tmp_path
    image_rig(folder, session, session.H_OP)
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
    image_rig(folder, session, session.H_OP)
    assert "\nformat      robot.txt read as: matrices, in the images' order\n" in lpcal("check", cwd=folder)[1]


@pytest.mark.parametrize("lost", ["handeye.easy_handeye.yaml", "H_OP.yaml", "handeye.yaml"])
def test_what_a_killed_run_did_not_write_is_written_by_the_next(
    tmp_path: Path, session: Session, lpcal: Callable[..., tuple[int, str, str]], lost: str
) -> None:
    moving_rig(tmp_path, session)
    assert lpcal("run", cwd=tmp_path)[0] == 0
    before = {path.name for path in (tmp_path / "calib").glob("*.yaml")}
    (tmp_path / "calib" / lost).unlink()
    assert lpcal("run", cwd=tmp_path)[0] == 0
    assert {path.name for path in (tmp_path / "calib").glob("*.yaml")} == before


def test_missing_pieces(tmp_path: Path, session: Session, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nname: nothing\n")
    assert lpcal("handeye", cwd=tmp_path)[0] == 3
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nmocap: {file: absent.csv, board_poses: {file: absent.csv}}\n")
    code, _, err = lpcal("handeye", cwd=tmp_path)
    assert (code, "absent.csv" in err, "panel.yaml:2" in err) == (3, True, True)
    folder = tmp_path
    moving_rig(folder, session)
    assert lpcal("handeye", "other.csv", cwd=folder)[0] == 3
    assert not (folder / "calib").exists()


@pytest.mark.slow
def test_rig_a(data: Callable[[str], Path], tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    """Every board found, the camera and the hand-eye within the contract's figures of the truth."""
    import shutil

    from lpcal.formats.camera_yaml import read_camera
    from lpcal.formats.h_cb_yaml import read_h_cb
    from lpcal.geometry import camera as central
    from lpcal.geometry.camera_difference import pixel_grid, projection_difference

    folder = tmp_path / "rig"
    shutil.copytree(data("rig_a"), folder, ignore=shutil.ignore_patterns("objects", "spheres"))
    for path in folder.rglob("*"):
        path.chmod(0o755)
    assert lpcal("intrinsics", cwd=folder)[0] == 0
    lens, of_lens = read_camera(folder / "calib" / "camera.yaml"), yaml.safe_load((folder / "truth" / "camera.yaml").read_text())
    pixels = pixel_grid(lens.image_size)
    rays = central.unproject(pixels, np.array(of_lens["K"]), np.array(of_lens["distortion"]))
    apart, _ = projection_difference(pixels, rays, lens.project)
    assert np.sqrt(np.mean(np.sum(apart**2, axis=1))) < 0.01
    assert np.linalg.norm(apart, axis=1).max() < 0.02
    assert len(read_h_cb(folder / "calib" / "H_CB.yaml").images) == 160
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


def test_eth_vicon(data: Callable[[str], Path], tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
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

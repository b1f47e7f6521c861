"""lpcal new: a folder to start from, and never a file overwritten."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ball_scenes import LIGHTS, picture, vase
from lpcal.formats.bundled import rig_names
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.panel_yaml import read_rig


@pytest.mark.parametrize("name", ["dome", "lightpanel-12", "lightpanel-6", "robot-camera"])
def test_a_rig_is_copied_with_its_folders(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, name: str) -> None:
    assert name in rig_names()
    code, out, _ = lpcal("new", tmp_path / "mine", "--from", name)
    assert code == 0
    rig = read_rig(tmp_path / "mine" / "panel.yaml").rig
    assert rig.name == name
    for sphere in rig.spheres.values():
        assert (tmp_path / "mine" / sphere.images).is_dir()
    for capture in rig.objects.values():
        assert (tmp_path / "mine" / capture).is_dir()
    assert (tmp_path / "mine" / rig.camera.images[0]).parent.is_dir()
    assert "next: cd" in out


def test_the_default_is_the_papers_panel(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    assert lpcal("new", tmp_path / "mine")[0] == 0
    assert read_rig(tmp_path / "mine" / "panel.yaml").rig.name == "lightpanel-6"


def test_a_panel_that_is_there_is_kept(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text("lpcal: 1\n")
    code, _, err = lpcal("new", tmp_path)
    assert code == 3
    assert "panel.yaml: is there already" in err
    assert (tmp_path / "panel.yaml").read_text() == "lpcal: 1\n"


def test_an_empty_or_unrelated_folder_is_welcome(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("x")
    assert lpcal("new", tmp_path, "--from", "dome")[0] == 0
    assert (tmp_path / "notes.txt").read_text() == "x"


def test_a_file_in_the_folders_place_is_an_error(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "mine").write_text("x")
    code, _, err = lpcal("new", tmp_path / "mine")
    assert (code, "is a file" in err) == (3, True)


def test_from_another_rig_of_ones_own(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "panel.yaml").write_text("lpcal: 1\nname: own\nobjects: {a: objects/a, far: ../elsewhere, b: /somewhere}\n")
    code, _, _ = lpcal("new", tmp_path / "mine", "--from", tmp_path / "old")
    assert code == 0
    assert read_rig(tmp_path / "mine" / "panel.yaml").rig.name == "own"
    assert [path.name for path in (tmp_path / "mine" / "objects").iterdir()] == ["a"]
    assert not (tmp_path / "elsewhere").exists()


def test_an_unknown_rig_and_a_broken_one(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, _, err = lpcal("new", tmp_path / "mine", "--from", "lightpanel-7")
    assert code == 3
    assert "lightpanel-12" in err
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nboard: {corners: [9, 6], square: 25}\n")
    code, _, err = lpcal("new", tmp_path / "mine", "--from", tmp_path)
    assert code == 3
    assert "panel.yaml:2" in err
    assert not (tmp_path / "mine").exists()


def test_an_rti_folder_takes_numbered_photographs(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, out, err = lpcal("new", tmp_path / "mine", "--from", "rti")
    assert code == 0, err
    assert "lpcal board" not in out, "it has none"
    assert "as capture.yaml there says" in out
    assert "ball/capture.yaml: a sample" in out
    assert "lightpanel-6, robot-camera, mocap, rti-with-ball\n" in out, "the others"
    rig = read_rig(tmp_path / "mine" / "panel.yaml").rig
    assert rig.camera is None
    for capture in ("ball", "objects/tablet"):
        assert "lights: IMG_*.jpg" in (tmp_path / "mine" / capture / "capture.yaml").read_text()
    code, _, err = lpcal("run", cwd=tmp_path / "mine")
    assert code == 6
    assert "0 images match IMG_*.jpg" in err
    assert "24, one a light" in err


def test_photographs_of_ball_and_object_give_the_lights_and_the_object_alone(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    """The template as it is, but for its count of lights: numbered photographs of a vase and a chrome ball beside it."""
    folder, (x, y, radius) = tmp_path / "mine", (270.0, 120.0, 55.0)
    code, out, _ = lpcal("new", folder, "--from", "rti-with-ball")
    assert code == 0
    assert "objects/tablet/capture.yaml: a sample" in out
    text = (folder / "panel.yaml").read_text()
    for light in range(len(LIGHTS), 24):
        text = text.replace(f"  L{light:02d}: {{}}\n", "")
    (folder / "panel.yaml").write_text(text)
    seen = picture([vase(110, 120, 80)], chrome=(x, y, radius))
    white = float(seen.signal.max())
    for k, image in enumerate((*seen.signal, seen.ambient)):
        name = f"IMG_{k:04d}.jpg" if k < len(LIGHTS) else "ambient.jpg"
        stored = np.clip(image / white, 0, 1)
        srgb = np.where(stored < 0.0031308, 12.92 * stored, 1.055 * stored ** (1 / 2.4) - 0.055)
        Image.fromarray(np.rint(255 * srgb).astype(np.uint8)).save(folder / "objects/tablet" / name, quality=97)
    code, out, err = lpcal("run", cwd=folder)
    assert code == 0, err
    found = read_calibration(folder / "calib" / "calibration.yaml")
    for light, true in zip(found.lights, LIGHTS, strict=True):
        assert light.direction_C @ np.array(true) / np.linalg.norm(true) > np.cos(np.radians(1.5))
    mask = np.asarray(Image.open(folder / "surfaces/tablet/mask.png")) > 0
    row, column = np.indices(mask.shape)
    assert mask[120, 110]
    assert not mask[np.hypot(column - x, row - y) < radius].any()


def test_a_mocap_folder_says_what_it_lacks(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, out, err = lpcal("new", tmp_path / "mine", "--from", "mocap")
    assert code == 0, err
    assert "mocap" in out
    assert (tmp_path / "mine" / "times.csv.example").read_text().startswith("file,time_s")
    code, _, err = lpcal("run", cwd=tmp_path / "mine")
    assert code == 3
    assert "Traceback" not in err


def test_a_robots_table_has_a_sample(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    from lpcal.formats.robot_poses import read_robot_poses

    code, out, _ = lpcal("new", tmp_path / "mine", "--from", "robot-camera")
    assert code == 0
    assert "robot.csv.example: a sample" in out
    assert "&& lpcal board; after the images are there, lpcal intrinsics" in out
    sample = tmp_path / "mine" / "robot.csv.example"
    assert read_robot_poses(sample.rename(sample.with_suffix(""))).H.shape == (3, 4, 4)

"""``lpcal intrinsics`` as a user types it: what it writes, what it says, and what a user can get wrong."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.h_cb_yaml import read_h_cb
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3
from lpcal.pipeline.intrinsics import STAGE
from lpcal.pipeline.workspace import Workspace

from board_pictures import LENS, K, Pattern, Studio, exposed, poses

type Run = Callable[..., tuple[int, str, str]]
PATTERN, STUDIO = Pattern(bow_m=(0.0003, 0.0002)), Studio()
PANEL = "lpcal: 1\ncamera: {images: boards/*.png, black_level: 0.8 %}\nboard: {corners: [9, 6], square: 25 mm}\n"
OWN, OTHERS = 10, 2


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten board views, and two more that only mocap.images names."""
    folder, rays = tmp_path_factory.mktemp("pictures"), STUDIO.rays()
    for k, H_CB in enumerate(poses(OWN + OTHERS, 23, PATTERN)):
        place = folder / ("boards" if k < OWN else "sweep") / f"view_{k}.png"
        place.parent.mkdir(exist_ok=True)
        cv2.imwrite(str(place), exposed(STUDIO.picture(H_CB, PATTERN, rays=rays), k))
    (folder / "sweep.csv").write_text("file,time_s\nsweep/view_10.png,1.0\nsweep/view_11.png,1.1\nboards/view_3.png,2.0\n")
    (folder / "panel.yaml").write_text(PANEL)
    return folder


@pytest.fixture
def rig(pictures: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(pictures, tmp_path / "rig"))


def refused(lpcal: Run, rig: Path, code: int, *words: str, options: tuple[object, ...] = ()) -> None:
    """The command ends with a code and says the words, without a traceback; nothing stands in calib/ under a final name."""
    found, _, said = lpcal("intrinsics", *options, "--rig", rig)
    assert found == code, said
    assert "Traceback" not in said
    for word in words:
        assert word in said, said
    assert not list((rig / "calib").glob("*.yaml"))


def test_the_files_and_the_summary(lpcal: Run, rig: Path) -> None:
    (rig / "panel.yaml").write_text(PANEL + "mocap: {images: sweep.csv}\n")
    code, out, err = lpcal("intrinsics", cwd=rig / "boards")
    assert code == 0, err
    assert "board found in 10 of 10" in out
    assert "next: lpcal handeye" in out
    camera = read_camera(rig / "calib" / "camera.yaml")
    assert camera.covariance is not None
    sigma = np.sqrt(np.diag(camera.covariance))
    assert np.all(np.abs(camera.K[[0, 1, 0, 1], [0, 1, 2, 2]] - K[[0, 1, 0, 1], [0, 1, 2, 2]]) < 4 * sigma[:4])
    assert camera.black_level == 0.008
    document = yaml.safe_load((rig / "calib" / "camera.yaml").read_text())
    assert {"image", "used", "why", "corners", "rms_px"} <= document["views"][0].keys()
    assert len(document["views"]) == OWN
    assert len(document["evidence"]["cross_validation"]) == 6
    boards = read_h_cb(rig / "calib" / "H_CB.yaml")
    assert boards.images == (*(f"boards/view_{k}.png" for k in range(OWN)), "sweep/view_10.png", "sweep/view_11.png")
    assert boards.points_B is not None
    assert boards.covariance is not None
    for H_CB, found, covariance in zip(poses(OWN + OTHERS, 23, PATTERN), boards.H_CB, boards.covariance, strict=True):
        true = H_CB @ se3.transform(np.eye(3), np.array([0, 0, PATTERN.points()[:, 2].mean()]))
        xi = se3.log(true @ se3.inv(found))
        assert np.linalg.norm(xi[:3]) < 2e-3
        assert np.linalg.norm(xi[3:]) < 3e-3
        assert np.all(np.linalg.eigvalsh(covariance) > 0)


@pytest.mark.parametrize("square", ["25 mm", "[25 mm, 25.01 mm]"])
def test_the_cameramodel_holds_the_same_camera(lpcal: Run, rig: Path, square: str) -> None:
    """With mrcal's solve and, for squares that mrcal does not know, with lpcal's own; pictures in colour make no difference."""
    for path in (rig / "boards").glob("*.png"):
        cv2.imwrite(str(path), cv2.cvtColor(cv2.imread(str(path), cv2.IMREAD_GRAYSCALE), cv2.COLOR_GRAY2BGR))
    (rig / "panel.yaml").write_text(PANEL.replace("25 mm", square).replace("black_level", "model: opencv5, black_level"))
    code, _, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, err
    camera, model = read_camera(rig / "calib" / "camera.yaml"), read_camera_file(rig / "calib" / "camera.cameramodel")
    np.testing.assert_allclose(model.K, camera.K, rtol=1e-9)
    np.testing.assert_allclose(model.distortion, camera.distortion, rtol=1e-6, atol=1e-9)


def test_a_second_run_recalls_the_corners_and_the_stage_knows_it_is_up_to_date(lpcal: Run, rig: Path) -> None:
    assert lpcal("intrinsics", "--rig", rig)[0] == 0
    workspace = Workspace(read_rig(rig / "panel.yaml"))
    assert STAGE.up_to_date(workspace)
    first = (rig / "calib" / "H_CB.yaml").read_text().partition("provenance")[0]
    code, out, err = lpcal("intrinsics", "--json", "--rig", rig)
    assert code == 0
    assert "board: " not in err
    assert json.loads(out)["boards_found"] == OWN
    assert (rig / "calib" / "H_CB.yaml").read_text().partition("provenance")[0] == first
    shutil.copy(rig / "boards" / "view_1.png", rig / "boards" / "view_2.png")
    assert not STAGE.up_to_date(workspace)


def test_images_on_the_command_line_stand_in(lpcal: Run, rig: Path) -> None:
    (rig / "panel.yaml").write_text("lpcal: 1\nboard: {corners: [9, 6], square: 25 mm}\ncamera: {model: opencv4}\n")
    code, out, err = lpcal("intrinsics", *sorted((rig / "boards").glob("*.png"))[:8], cwd=rig)
    assert code == 0, err
    assert "in 8 of 8" in out
    refused(lpcal, Path(shutil.copytree(rig, rig.parent / "other", ignore=lambda *_: ["calib"])), 3, "camera.images")


def test_a_camera_given_as_a_file(lpcal: Run, rig: Path) -> None:
    vector = ", ".join(str(float(number)) for number in [K[0, 0], K[1, 1], K[0, 2], K[1, 2], *LENS])
    text = f"{{'lensmodel': 'LENSMODEL_OPENCV5', 'intrinsics': [{vector}], 'imagersize': [640, 480]}}"
    (rig / "own.cameramodel").write_text(text)
    (rig / "panel.yaml").write_text(PANEL.replace("black_level", "cameramodel: own.cameramodel, black_level"))
    code, out, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, err
    assert "as given" in out
    np.testing.assert_allclose(read_camera(rig / "calib" / "camera.yaml").K, K)
    boards = read_h_cb(rig / "calib" / "H_CB.yaml")
    assert boards.points_B is not None
    truth = PATTERN.points()[:, 2]
    np.testing.assert_allclose(boards.points_B[:, 2], truth - truth.mean(), atol=5e-5)
    (rig / "panel.yaml").write_text("lpcal: 1\ncamera: {cameramodel: own.cameramodel}\n")
    code, out, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, err
    assert read_h_cb(rig / "calib" / "H_CB.yaml").images == ()


def test_a_camera_file_of_another_image_size(lpcal: Run, rig: Path) -> None:
    (rig / "own.cameramodel").write_text(
        "{'lensmodel': 'LENSMODEL_PINHOLE', 'intrinsics': [900, 900, 512, 384], 'imagersize': [1024, 768]}"
    )
    (rig / "panel.yaml").write_text(PANEL.replace("black_level", "cameramodel: own.cameramodel, black_level"))
    refused(lpcal, rig, 6, "1024x768", "640x480")


def test_another_corner_count_is_named(lpcal: Run, rig: Path) -> None:
    (rig / "panel.yaml").write_text(PANEL.replace("[9, 6]", "[8, 6]"))
    refused(lpcal, rig, 6, "9x6", "8x6")


def test_no_board_in_any_image(lpcal: Run, rig: Path) -> None:
    for path in (rig / "boards").glob("*.png"):
        cv2.imwrite(str(path), np.full((480, 640), 80, np.uint8))
    refused(lpcal, rig, 4, "no board of 9x6", "contrast")


def test_images_of_two_sizes(lpcal: Run, rig: Path) -> None:
    path = rig / "boards" / "view_4.png"
    cv2.imwrite(str(path), cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)[:400])
    refused(lpcal, rig, 6, "view_4.png", "640x480", "640x400")


def test_images_that_cannot_be_read(lpcal: Run, rig: Path) -> None:
    path = rig / "boards" / "view_4.png"
    path.write_bytes(path.read_bytes()[:20000])
    refused(lpcal, rig, 3, "view_4.png", "cut off")
    path.write_text("no image")
    refused(lpcal, rig, 3, "view_4.png")
    refused(lpcal, rig, 3, "none.png", options=("none.png",))


def test_a_missing_section_is_named(lpcal: Run, rig: Path) -> None:
    (rig / "panel.yaml").write_text("lpcal: 1\nname: bare\n")
    refused(lpcal, rig, 3, "camera:")
    (rig / "panel.yaml").write_text("lpcal: 1\ncamera: {images: boards/*.png}\n")
    refused(lpcal, rig, 3, "board:")


def test_too_few_views(lpcal: Run, rig: Path) -> None:
    refused(lpcal, rig, 4, "2 of 2 images", options=tuple(sorted((rig / "boards").glob("*.png"))[:2]))


@pytest.mark.slow
def test_rig_a(data: Callable[[str], Path], lpcal: Run, tmp_path: Path) -> None:
    """Every board found, and the camera within the contract's figure of the truth."""
    rig = Path(shutil.copytree(data("rig_a"), tmp_path / "rig_a", ignore=shutil.ignore_patterns("objects", "spheres")))
    assert lpcal("intrinsics", "--rig", rig)[0] == 0
    truth = yaml.safe_load((rig / "truth" / "camera.yaml").read_text())
    from lpcal.geometry import camera as central
    from lpcal.geometry.camera_difference import pixel_grid, projection_difference

    found = read_camera(rig / "calib" / "camera.yaml")
    pixels = pixel_grid(found.image_size)
    error, _ = projection_difference(pixels, central.unproject(pixels, np.array(truth["K"]), np.array(truth["distortion"])), found.project)
    assert np.sqrt(np.mean(np.sum(error**2, axis=1))) < 0.05
    assert len(read_h_cb(rig / "calib" / "H_CB.yaml").images) == 160


@pytest.mark.slow
def test_bouguet_example_1(data: Callable[[str], Path], lpcal: Run, tmp_path: Path) -> None:
    """Published: a flat board, k3 = 0; its errors are three sigmas."""
    folder = data("intrinsics/bouguet_ex1")
    images = ", ".join(str(folder / f"Image{k}.tif") for k in range(1, 21))
    board = "board: {corners: [13, 12], square: 30 mm, warp: none}"
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{images: [{images}], model: opencv4}}\n{board}\n")
    assert lpcal("intrinsics", "--rig", tmp_path)[0] == 0
    K_found = read_camera(tmp_path / "calib" / "camera.yaml").K
    published, sigma = np.array([657.644, 658.041, 303.192, 242.556]), np.array([0.40, 0.43, 0.82, 0.75]) / 3
    assert np.all(np.abs(K_found[[0, 1, 0, 1], [0, 1, 2, 2]] - published) < 1.5 * sigma)

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

from board_pictures import LENS, K, Pattern, Studio, exposed, poses
from lpcal.cli.main import main
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.h_cb_yaml import read_h_cb
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3
from lpcal.pipeline.intrinsics import STAGE
from lpcal.pipeline.workspace import Workspace

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


@pytest.fixture(scope="module")
def solved_pictures(pictures: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The board views with the stage done, once for all tests that begin there."""
    folder = Path(shutil.copytree(pictures, tmp_path_factory.mktemp("solved") / "rig"))
    assert main(["intrinsics", "--rig", str(folder)]) == 0
    return folder


@pytest.fixture
def solved_rig(solved_pictures: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(solved_pictures, tmp_path / "rig"))


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
    assert len(document["evidence"]["cross_validation"]) == 5
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


def test_a_second_run_recalls_the_corners_and_the_stage_knows_it_is_up_to_date(lpcal: Run, solved_rig: Path) -> None:
    rig = solved_rig
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
def test_bouguet_example_1(data: Callable[[str], Path], lpcal: Run, tmp_path: Path) -> None:
    """Published: a flat board, k3 = 0; its errors are three sigmas. Its corners are saddles, which lie 0.2 px from the edges' crossings."""
    folder = data("intrinsics/bouguet_ex1")
    images = ", ".join(str(folder / f"Image{k}.tif") for k in range(1, 21))
    board = "board: {corners: [13, 12], square: 30 mm, warp: none}"
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{images: [{images}], model: opencv4}}\n{board}\n")
    assert lpcal("intrinsics", "--rig", tmp_path)[0] == 0
    K_found = read_camera(tmp_path / "calib" / "camera.yaml").K
    published, sigma = np.array([657.644, 658.041, 303.192, 242.556]), np.array([0.40, 0.43, 0.82, 0.75]) / 3
    assert np.all(np.abs(K_found[[0, 1, 0, 1], [0, 1, 2, 2]] - published) < 2.5 * sigma)


def solved(lpcal: Run, rig: Path) -> None:
    code, _, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, err


def test_how_sure_it_is_stands_in_camera_yaml(lpcal: Run, rig: Path) -> None:
    code, out, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, err
    assert "sure to" in out
    assert "next view" in out
    document = yaml.safe_load((rig / "calib" / "camera.yaml").read_text())
    sure = document["evidence"]["projection_uncertainty"]
    worst = np.array(sure["worst_direction_std_px"], dtype=float)
    assert worst.shape == (len(sure["rows_px"]), len(sure["columns_px"]))
    assert np.isfinite(worst).all()
    assert np.array(sure["trusted"]).shape == worst.shape
    view = document["evidence"]["next_view"]
    assert view["std_then_px"] < view["std_now_px"]
    assert {"image", "without_it"} == document["evidence"]["views_that_matter"][0].keys()
    assert 0.4 < document["views"][0]["blur_px"] < 1.2
    assert document["views"][0]["glare"] == 0


def test_two_calibrations_are_compared(lpcal: Run, solved_rig: Path) -> None:
    rig = solved_rig
    other = rig / "other.yaml"
    camera = read_camera(rig / "calib" / "camera.yaml")
    focal, coefficients = 1.01 * camera.K[0, 0], ", ".join(str(float(one)) for one in camera.distortion[:4])
    other.write_text(
        f"cam0:\n  camera_model: pinhole\n  distortion_model: radtan\n  distortion_coeffs: [{coefficients}]\n"
        f"  intrinsics: [{focal}, {1.01 * camera.K[1, 1]}, {camera.K[0, 2]}, {camera.K[1, 2]}]\n  resolution: [640, 480]\n"
    )
    code, out, err = lpcal("intrinsics", "--rig", rig, "--compare", rig / "calib" / "camera.cameramodel")
    assert code == 0, err
    assert "0.0000 px rms" in out
    code, out, err = lpcal("intrinsics", "--json", "--rig", rig, "--compare", other)
    assert code == 0, err
    found = json.loads(out)
    assert 1 < found["imager"]["rms_px"] < found["imager"]["worst_px"] < 6
    assert found["imager"]["rms_px"] <= found["imager"]["rms_without_turn_px"] + 1e-9
    assert found["where_corners_are"]["rms_px"] < found["imager"]["rms_px"]
    assert found["expected_px"] < 0.5


def test_what_cannot_be_compared(lpcal: Run, rig: Path) -> None:
    assert lpcal("intrinsics", "--rig", rig, "--compare", rig / "panel.yaml")[0] == 3
    solved(lpcal, rig)
    code, _, err = lpcal("intrinsics", "--rig", rig, "--compare", rig / "none.yaml")
    assert (code, "no such camera file" in err) == (3, True)
    (rig / "big.cameramodel").write_text(
        "{'lensmodel': 'LENSMODEL_PINHOLE', 'intrinsics': [900, 900, 511, 383], 'imagersize': [1024, 768]}"
    )
    code, _, err = lpcal("intrinsics", "--rig", rig, "--compare", rig / "big.cameramodel")
    assert (code, "1024x768" in err) == (6, True)
    assert lpcal("intrinsics", "one.png", "--rig", rig, "--compare", rig / "big.cameramodel")[0] == 2


def test_corners_are_kept_as_mrcal_keeps_them(lpcal: Run, rig: Path) -> None:
    cache = rig / "corners.vnl"
    code, _, err = lpcal("intrinsics", "--rig", rig, "--corners-cache", cache)
    assert code == 0, err
    assert cache.read_text().startswith("# filename x y level\nboards/view_0.png ")
    first = read_camera(rig / "calib" / "camera.yaml")
    text = cache.read_text().replace("boards/view_3.png", "elsewhere/view_3.png")
    cache.write_text("\n".join(line for line in text.splitlines() if "view_5" not in line) + "\nboards/view_5.png - - -\n")
    code, out, err = lpcal("intrinsics", "--rig", rig, "--corners-cache", cache)
    assert code == 0, err
    assert "found in 9 of 10" in out
    again = read_camera(rig / "calib" / "camera.yaml")
    assert first.covariance is not None
    assert abs(again.K[0, 0] - first.K[0, 0]) < 4 * np.sqrt(first.covariance[0, 0])


@pytest.mark.parametrize(
    ("text", "code", "word"),
    [
        ("boards/view_0.png 1 2 0\n", 3, "no line that names the columns"),
        ("# filename x y level\nboards/view_0.png 1\n", 3, "corners.vnl:2"),
        ("# filename x y level\nboards/view_0.png 1 2 0\nboards/view_0.png 3 4 0\n", 6, "2 corners"),
        ("# filename x y level\nother.png - - -\n", 6, "none of the 10 images"),
    ],
)
def test_corners_that_are_none(lpcal: Run, rig: Path, text: str, code: int, word: str) -> None:
    (rig / "corners.vnl").write_text(text)
    refused(lpcal, rig, code, word, options=("--corners-cache", rig / "corners.vnl"))


def test_rows_and_columns_swapped_give_the_same_lens(lpcal: Run, solved_rig: Path) -> None:
    rig = solved_rig
    usual = read_camera(rig / "calib" / "camera.yaml")
    (rig / "panel.yaml").write_text(PANEL.replace("[9, 6]", "[6, 9]"))
    solved(lpcal, rig)
    assert usual.covariance is not None
    sigma = np.sqrt(np.diag(usual.covariance))[:4]
    core = [0, 1, 0, 1], [0, 1, 2, 2]
    assert np.all(np.abs(read_camera(rig / "calib" / "camera.yaml").K[core] - usual.K[core]) < 2 * sigma)


def test_three_views_are_enough_to_start_and_said_to_be_few(lpcal: Run, rig: Path) -> None:
    code, out, err = lpcal("intrinsics", *sorted((rig / "boards").glob("*.png"))[:3], "--rig", rig)
    assert code in {0, 4}, err
    if code == 0:
        assert "too few views to cross-validate" in out
    else:
        assert "do not determine the" in err


def test_a_square_in_inches_is_asked_about(lpcal: Run, rig: Path) -> None:
    (rig / "panel.yaml").write_text(PANEL.replace("25 mm", "635 mm"))
    code, out, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, err
    assert "25.4" in out + err


def test_pictures_of_16_bit_tell_the_same(lpcal: Run, solved_rig: Path) -> None:
    rig = solved_rig
    before = read_camera(rig / "calib" / "camera.yaml")
    for path in (rig / "boards").glob("*.png"):
        cv2.imwrite(str(path), cv2.imread(str(path), cv2.IMREAD_GRAYSCALE).astype(np.uint16) * 16)
    solved(lpcal, rig)
    np.testing.assert_allclose(read_camera(rig / "calib" / "camera.yaml").K, before.K, atol=0.02)


def test_a_jpeg_cut_in_half_and_a_turned_one(lpcal: Run, rig: Path) -> None:
    (rig / "panel.yaml").write_text(PANEL.replace("boards/*.png", "boards/*"))
    path = rig / "boards" / "view_4.jpg"
    cv2.imwrite(str(path), cv2.imread(str(rig / "boards" / "view_4.png"), cv2.IMREAD_GRAYSCALE))
    (rig / "boards" / "view_4.png").unlink()
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    refused(lpcal, rig, 3, "view_4.jpg", "cut off")
    tag = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"
    path.write_bytes(whole[:2] + b"\xff\xe1" + (len(tag) + 2).to_bytes(2, "big") + tag + whole[2:])
    code, _, err = lpcal("intrinsics", "--rig", rig)
    assert code == 0, "a tag does not turn stored pixels, and these are as large as the others" + err

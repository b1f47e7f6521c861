"""Cameras of other systems' files: each format read back as the camera it was, and garbled ones refused in words."""

from __future__ import annotations

import base64
import struct
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml

from lpcal.errors import InputError
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import read_camera, write_camera
from lpcal.formats.cameramodel import cameramodel_text
from lpcal.records.calibration import Camera, CameraSolution
from lpcal.records.provenance import Provenance

K = np.array([[712.4, 0, 385.1], [0, 713.1, 230.6], [0, 0, 1.0]])
LENSES = {"opencv4": [-0.3, 0.12, 0.0007, -0.0005], "opencv5": [-0.3, 0.12, 0.0007, -0.0005, 0.01]}
LENSES["opencv8"] = [*LENSES["opencv5"], 0.02, -0.01, 0.004]


def camera(model: str) -> Camera:
    return Camera((752, 480), model, K, np.array(LENSES[model]))


def to_opencv(path: Path, camera: Camera) -> None:
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    storage.write("image_width", camera.image_size[0])
    storage.write("image_height", camera.image_size[1])
    storage.write("camera_matrix", camera.K)
    storage.write("distortion_coefficients", camera.distortion.reshape(-1, 1))
    storage.release()


def to_ros(path: Path, camera: Camera) -> None:
    lens = "plumb_bob" if camera.distortion.size <= 5 else "rational_polynomial"
    document = {
        "image_width": camera.image_size[0],
        "image_height": camera.image_size[1],
        "camera_name": "left",
        "camera_matrix": {"rows": 3, "cols": 3, "data": camera.K.ravel().tolist()},
        "distortion_model": lens,
        "distortion_coefficients": {"rows": 1, "cols": camera.distortion.size, "data": camera.distortion.tolist()},
        "projection_matrix": {"rows": 3, "cols": 4, "data": [1.0] * 12},
    }
    path.write_text(yaml.safe_dump(document))


def to_ros_message(path: Path, camera: Camera) -> None:
    document = {
        "height": 480,
        "width": 752,
        "distortion_model": "plumb_bob",
        "d": camera.distortion.tolist(),
        "k": camera.K.ravel().tolist(),
    }
    path.write_text(yaml.safe_dump(document))


def to_kalibr(path: Path, camera: Camera) -> None:
    document = {
        "cam0": {
            "camera_model": "pinhole",
            "distortion_model": "radtan",
            "distortion_coeffs": camera.distortion.tolist(),
            "intrinsics": [K[0, 0].item(), K[1, 1].item(), K[0, 2].item(), K[1, 2].item()],
            "resolution": list(camera.image_size),
        }
    }
    path.write_text(yaml.safe_dump(document))


def colmap_params(camera: Camera) -> list[float]:
    return [K[0, 0], K[1, 1], K[0, 2] + 0.5, K[1, 2] + 0.5, *np.pad(camera.distortion, (0, 8 if camera.distortion.size > 4 else 4))]


def to_colmap(path: Path, camera: Camera) -> None:
    count, name = (8, "OPENCV") if camera.model == "opencv4" else (12, "FULL_OPENCV")
    words = " ".join(repr(float(number)) for number in colmap_params(camera)[:count])
    path.write_text(f"# Camera list with one line of data per camera:\n# Number of cameras: 1\n1 {name} 752 480 {words}\n")


def to_colmap_binary(path: Path, camera: Camera) -> None:
    path.write_bytes(struct.pack("<QiiQQ8d", 1, 1, 4, 752, 480, *colmap_params(camera)[:8]))


def to_mrcal(path: Path, camera: Camera) -> None:
    path.write_text("# a comment, as mrcal writes\n" + cameramodel_text(camera))


def to_lpcal(path: Path, camera: Camera) -> None:
    write_camera(path, CameraSolution(camera, np.zeros((0, 3)), (), "mrcal", 0.1), Provenance())


WRITERS: list[tuple[str, Callable[[Path, Camera], None], list[str]]] = [
    ("cv.yaml", to_opencv, ["opencv4", "opencv5", "opencv8"]),
    ("cv.xml", to_opencv, ["opencv5"]),
    ("cv.json", to_opencv, ["opencv5"]),
    ("ros.yaml", to_ros, ["opencv5", "opencv8"]),
    ("message.yaml", to_ros_message, ["opencv5"]),
    ("camchain.yaml", to_kalibr, ["opencv4"]),
    ("cameras.txt", to_colmap, ["opencv4", "opencv8"]),
    ("cameras.bin", to_colmap_binary, ["opencv4"]),
    ("c.cameramodel", to_mrcal, ["opencv4", "opencv5", "opencv8"]),
    ("camera.yaml", to_lpcal, ["opencv4", "opencv5", "opencv8"]),
]
CASES = [pytest.param(name, write, model, id=f"{name}-{model}") for name, write, models in WRITERS for model in models]


@pytest.mark.parametrize(("name", "write", "model"), CASES)
def test_a_file_is_read_as_the_camera_it_holds(tmp_path: Path, name: str, write: Callable[[Path, Camera], None], model: str) -> None:
    path, meant = tmp_path / name, camera(model)
    write(path, meant)
    found = read_camera_file(path)
    assert (found.image_size, found.model) == (meant.image_size, meant.model)
    np.testing.assert_allclose(found.K, meant.K, atol=1e-9)
    np.testing.assert_allclose(found.distortion, meant.distortion, atol=1e-12)


@pytest.mark.parametrize(("name", "write", "model"), CASES)
def test_half_a_file_is_refused(tmp_path: Path, name: str, write: Callable[[Path, Camera], None], model: str) -> None:
    path = tmp_path / name
    write(path, camera(model))
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(InputError):
        read_camera_file(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("cam0: {camera_model: omni, intrinsics: [1, 2, 3, 4, 5], distortion_model: radtan, resolution: [2, 2]}", "omni"),
        ("cam0: {camera_model: pinhole, distortion_model: equidistant, intrinsics: [1, 2, 3, 4], resolution: [2, 2]}", "equidistant"),
        ("cam0: {camera_model: pinhole}\ncam1: {camera_model: pinhole}", "2 cameras"),
        ("width: 4\nheight: 4\nK: [0, 0, 0, 0, 0, 0, 0, 0, 0]\nD: []", "above zero"),
        ("1 OPENCV_FISHEYE 752 480 1 1 1 1 0 0 0 0", "OPENCV_FISHEYE"),
        ("1 PINHOLE 752 480 1 1 1 1\n2 PINHOLE 752 480 1 1 1 1", "2 cameras"),
        ("{'lensmodel': 'LENSMODEL_CAHVOR', 'intrinsics': [1, 1, 1, 1], 'imagersize': [4, 4]}", "LENSMODEL_CAHVOR"),
        ("apples: 3", "no format known"),
        ("just words", "no format known"),
    ],
)
def test_what_cannot_be_projected_with_is_named(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "some.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        read_camera_file(path)


def test_a_camera_comes_back_from_its_own_file_whole(tmp_path: Path) -> None:
    names = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2")
    meant = Camera((752, 480), "opencv4", K, np.array(LENSES["opencv4"]), 0.008, 0.9, 2.2, None, 0.05, names, np.eye(8) * 0.1)
    write_camera(tmp_path / "camera.yaml", CameraSolution(meant, np.zeros((0, 3)), (), "mrcal", 0.1), Provenance())
    found = read_camera(tmp_path / "camera.yaml")
    assert (found.black_level, found.white_level, found.gamma, found.rms_px, found.parameters) == (0.008, 0.9, 2.2, 0.05, names)
    np.testing.assert_array_equal(found.covariance, meant.covariance)


@pytest.mark.parametrize(
    "more",
    [
        f"    'optimization_inputs': b'{base64.b85encode(bytes.fromhex('fdce53b1') * 400).decode()}',\n",
        "    'note': '" + "{" * 200 + "',\n",
        '    "it\'s": "' + "[" * 200 + '",\n',
        "    # don't count these: " + "{[" * 100 + "\n",
    ],
    ids=["mrcal's inputs", "a string", "a string in double quotes", "a comment"],
)
def test_strings_of_a_cameramodel_open_no_sections(tmp_path: Path, more: str) -> None:
    text = cameramodel_text(camera("opencv4"))
    path = tmp_path / "c.cameramodel"
    path.write_text(text.replace("{\n", "{\n" + more, 1))
    assert max(path.read_text().count(sign) for sign in "{[") > 64
    np.testing.assert_allclose(read_camera_file(path).K, K)
    path.write_text(text.replace("{\n", "{\n" + more + "    'deep': '' " + "[" * 200 + "]" * 200 + ",\n", 1))
    with pytest.raises(InputError, match="sections within sections"):
        read_camera_file(path)

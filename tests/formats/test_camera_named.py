"""Cameras whose numbers stand by name, and in Metashape's, numpy's and MATLAB's files; numbers that are another thing than they seem."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import savemat

from lpcal.errors import InputError
from lpcal.formats.camera_files import read_camera_file
from lpcal.records.calibration import Camera

K = np.array([[900.0, 0, 640.5], [0, 905, 400.2], [0, 0, 1]])
CX, CY, SKEW = (np.eye(3)[[row]].T @ np.eye(3)[[column]] for row, column in ((0, 2), (1, 2), (0, 1)))
LENS = [-0.2, 0.05, 0.001, -0.002, 0.01]
OPENCV = """%YAML:1.0
---
image_width: {size[0]}
image_height: {size[1]}
{more}camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: {K}
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: {count}
   dt: d
   data: {lens}
"""
INFO = """header:
  seq: {seq}
  frame_id: cam
height: 800
width: 1280
distortion_model: plumb_bob
D: {lens}
K: {K}
binning_x: {bins[0]}
binning_y: {bins[1]}
roi:
  x_offset: {roi[0]}
  y_offset: {roi[1]}
  height: {roi[3]}
  width: {roi[2]}
"""


def opencv(path: Path, matrix: np.ndarray = K, lens: list[float] = LENS, size: tuple[int, int] = (1280, 800), more: str = "") -> Path:
    path.write_text(OPENCV.format(size=size, more=more, K=matrix.ravel().tolist(), count=len(lens), lens=lens))
    return path


def info(path: Path, bins: tuple[int, int] = (0, 0), roi: tuple[int, int, int, int] = (0, 0, 0, 0), messages: int = 1) -> Path:
    said = [INFO.format(seq=k, lens=LENS, K=K.ravel().tolist(), bins=bins, roi=roi) for k in range(messages)]
    path.write_text("---\n".join(said) + "---\n")
    return path


def is_the_camera(found: Camera, lens: list[float] = LENS, shift: float = 0.0) -> None:
    assert found.image_size == (1280, 800)
    np.testing.assert_allclose(found.K, K + shift * (CX + CY), atol=1e-9)
    np.testing.assert_allclose(found.distortion, lens, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"matrix": K.T}, "the camera matrix is transposed"),
        ({"matrix": K + 3.5 * SKEW}, "a skew of 3.5 px"),
        ({"matrix": K / [[112.5], [112.5], [1]]}, "less than any lens has, in pixels"),  # millimetres
        ({"matrix": K / [[1280.0], [800], [1]]}, "less than any lens has, in pixels"),  # shares of the sides
        ({"matrix": K * [[2.0], [2], [1]]}, "a principal point at 1281, 800.4 in an image of 1280x800"),
        ({"size": (800, 1280)}, "exchange width and height"),
        ({"lens": LENS[:3]}, "3 numbers of distortion"),
        ({"lens": LENS[:4], "more": "fisheye_model: 1\n"}, "lens model 'fisheye_model'"),
        ({"more": "camera_model: equidistant\n"}, "lens model 'equidistant'"),
    ],
)
def test_numbers_that_are_another_thing_are_named(tmp_path: Path, change: dict[str, Any], words: str) -> None:
    is_the_camera(read_camera_file(opencv(tmp_path / "right.yml", more="fisheye_model: 0\n")))
    with pytest.raises(InputError) as caught:
        read_camera_file(opencv(tmp_path / "camera.yml", **change))
    assert words in str(caught.value)


def test_a_transposed_matrix_is_named_in_a_ros_file_too(tmp_path: Path) -> None:
    text = info(tmp_path / "info.yaml").read_text().replace(str(K.ravel().tolist()), str(K.T.ravel().tolist()))
    (tmp_path / "info.yaml").write_text(text)
    with pytest.raises(InputError, match="transposed"):
        read_camera_file(tmp_path / "info.yaml")


def test_principal_points_off_the_middle_are_taken(tmp_path: Path) -> None:
    off = K - 300 * CX - 150 * CY
    assert read_camera_file(opencv(tmp_path / "camera.yml", off)).K[0, 2] == 340.5
    square = opencv(tmp_path / "square.yml", K - 240.5 * CX, size=(800, 800))
    assert read_camera_file(square).image_size == (800, 800)


def test_a_distortion_of_an_unknown_name_is_not_left_out(tmp_path: Path) -> None:
    path = tmp_path / "camera.json"
    whole = {"camera_matrix": K.tolist(), "image_size": [1280, 800]}
    path.write_text(json.dumps(whole | {"dist_coeff": [LENS]}))
    is_the_camera(read_camera_file(path))
    path.write_text(json.dumps(whole | {"lens_distortion_of_mine": [LENS]}))
    with pytest.raises(InputError, match="lens_distortion_of_mine"):
        read_camera_file(path)


def test_a_region_and_bins_of_the_sensor_are_those_of_the_images(tmp_path: Path) -> None:
    is_the_camera(read_camera_file(info(tmp_path / "whole.yaml")))
    cut = read_camera_file(info(tmp_path / "cut.yaml", roi=(100, 50, 1000, 600)))
    assert (cut.image_size, cut.K[0, 2], cut.K[1, 2], cut.K[0, 0]) == ((1000, 600), 540.5, pytest.approx(350.2), 900)
    binned = read_camera_file(info(tmp_path / "binned.yaml", bins=(2, 2)))
    assert binned.image_size == (640, 400)
    x = np.array([[0.3, -0.2, 1.0]])
    whole_px, binned_px = (one.K @ x[0] for one in (read_camera_file(tmp_path / "whole.yaml"), binned))
    np.testing.assert_allclose(binned_px[:2] + 0.5, (whole_px[:2] + 0.5) / 2)  # corners of pixels are at halves


def test_a_printed_topic_is_one_camera_and_two_cameras_are_not(tmp_path: Path) -> None:
    path = info(tmp_path / "topic.yaml", messages=3)
    is_the_camera(read_camera_file(path))
    path.write_text(path.read_text().replace("width: 1280", "width: 1282", 1))
    with pytest.raises(InputError, match="several cameras"):
        read_camera_file(path)


@pytest.mark.parametrize(
    ("document", "shift"),
    [
        ({"fx": 900, "fy": 905, "cx": 640.5, "cy": 400.2, "width": 1280, "height": 800}, 0.0),
        ({"fl_x": 900, "fl_y": 905, "cx": 640.5, "cy": 400.2, "w": 1280.0, "h": 800.0, "camera_angle_x": 0.6}, -0.5),
        ({"fx": 900, "fy": 905, "ppx": 640.5, "ppy": 400.2, "width": 1280, "height": 800, "model": "brown_conrady"}, 0.0),
    ],
)
@pytest.mark.parametrize("suffix", [".json", ".yaml"])
def test_numbers_by_name(tmp_path: Path, document: dict[str, Any], shift: float, suffix: str) -> None:
    path = tmp_path / f"camera{suffix}"
    by_name = dict(zip(("k1", "k2", "p1", "p2", "k3"), LENS, strict=True))
    path.write_text(json.dumps(document | ({"coeffs": LENS} if "ppx" in document else by_name)))
    is_the_camera(read_camera_file(path), shift=shift)


def test_an_inverse_lens_is_refused_unless_it_does_not_distort(tmp_path: Path) -> None:
    path = tmp_path / "realsense.json"
    held = {"width": 1280, "height": 800, "ppx": 640.5, "ppy": 400.2, "fx": 900, "fy": 905, "model": "inverse_brown_conrady"}
    path.write_text(json.dumps(held | {"coeffs": [0, 0, 0, 0, 0]}))
    is_the_camera(read_camera_file(path), [0.0] * 5)
    path.write_text(json.dumps(held | {"coeffs": LENS}))
    with pytest.raises(InputError, match="inverse_brown_conrady"):
        read_camera_file(path)


METASHAPE = "<f>905</f><cx>1.0</cx><cy>0.7</cy><b1>-5</b1><k1>-0.2</k1><k2>0.05</k2><k3>0.01</k3><p1>-0.002</p1><p2>0.001</p2>"


def test_metashape_alone_and_in_a_project(tmp_path: Path) -> None:
    path = tmp_path / "camera.xml"
    path.write_text(f"<calibration><projection>frame</projection><width>1280</width><height>800</height>{METASHAPE}</calibration>")
    is_the_camera(read_camera_file(path))
    held = '<calibration type="frame" class="{}"><resolution width="1280" height="800"/>{}</calibration>'
    one = f'<sensor id="0" label="a">{held.format("initial", "<f>800</f>")}{held.format("adjusted", METASHAPE)}</sensor>'
    path.write_text(f'<?xml version="1.0" encoding="UTF-8"?><document><chunk><sensors>{one}</sensors></chunk></document>')
    is_the_camera(read_camera_file(path))
    path.write_text(f"<document><chunk><sensors>{one}{one.replace('label="a"', 'label="b"')}</sensors></chunk></document>")
    with pytest.raises(InputError, match="2 cameras: a, b"):
        read_camera_file(path)
    path.write_text(f"<calibration><projection>fisheye</projection><width>1280</width><height>800</height>{METASHAPE}</calibration>")
    with pytest.raises(InputError, match="fisheye"):
        read_camera_file(path)


def test_numpys_arrays(tmp_path: Path) -> None:
    path = tmp_path / "calib.npz"
    np.savez(path, mtx=K, dist=np.array([LENS]), image_size=np.array([1280, 800]), rvecs=np.zeros((3, 1)))
    is_the_camera(read_camera_file(path))
    np.savez(path, mtx=K, dist=np.array([LENS]))
    with pytest.raises(InputError, match="no image size"):
        read_camera_file(path)
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(InputError, match="cannot be read as arrays"):
        read_camera_file(path)


def test_matlabs_arrays(tmp_path: Path) -> None:
    path = tmp_path / "Calib_Results.mat"
    toolbox = {"fc": [[900.0], [905]], "cc": [[640.5], [400.2]], "kc": np.array(LENS)[:, None], "alpha_c": 0.0, "nx": 1280.0, "ny": 800.0}
    savemat(path, toolbox)
    is_the_camera(read_camera_file(path))
    savemat(path, toolbox | {"alpha_c": 0.01})
    with pytest.raises(InputError, match="a skew of 9 px"):
        read_camera_file(path)
    own = {"RadialDistortion": [*LENS[:2], LENS[4]], "TangentialDistortion": LENS[2:4], "ImageSize": [800.0, 1280.0]}
    one_based = K + CX + CY
    for matrix in ({"IntrinsicMatrix": one_based.T}, {"K": one_based}):
        savemat(path, own | matrix)
        is_the_camera(read_camera_file(path))

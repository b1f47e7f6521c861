"""What a program hands over that is not what it should be: said with its place and what to do, never a wrong surface or a traceback."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal
from lpcal.errors import DisagreementError, InputError, LpcalError

Y, X = np.mgrid[-16:17, -20:21] / 24.0
NORMALS = np.stack([X, Y, -np.sqrt(1 - np.clip(X**2 + Y**2, 0, 0.9))], axis=-1)
NORMALS /= np.linalg.norm(NORMALS, axis=-1, keepdims=True)
TURN = np.arange(8) * np.pi / 4
DIRECTIONS = np.stack([0.5 * np.cos(TURN), 0.5 * np.sin(TURN), np.full(8, -np.sqrt(0.75))], axis=1)
IMAGES = np.clip(np.einsum("lc,hwc->lhw", DIRECTIONS, NORMALS), 0, None) * 0.8
MASK = X**2 + Y**2 < 0.6
K = [[500.0, 0, 200], [0, 500, 130], [0, 0, 1]]


def dome(directions: Any = DIRECTIONS, intensity: Any = 1.0) -> lpcal.Calibration:
    return lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", each, intensity) for k, each in enumerate(directions)))


def solved(calibration: Any, images: Any = IMAGES, **more: Any) -> lpcal.Surface:
    return lpcal.reconstruct(images, calibration, mask=MASK, **more)


@pytest.mark.parametrize("calibration", [dome(), dome(DIRECTIONS.tolist()), replace(dome(), lights=list(dome().lights))])  # type: ignore[arg-type]
def test_lists_and_numbers_do_for_arrays(calibration: lpcal.Calibration) -> None:
    assert lpcal.evaluate(solved(calibration), NORMALS, mask=MASK).normal_median_deg < 1.0


WRONG: dict[str, tuple[Callable[[], Any], type[LpcalError], str]] = {
    "x right, y up": (
        lambda: solved(dome(DIRECTIONS * [1, -1, -1])),
        DisagreementError,
        r"every light stands behind(?s:.*)signs of y and z",
    ),
    "not of length 1": (lambda: solved(dome(5 * DIRECTIONS)), InputError, r"calibration\.lights\[0\]\.direction_C: a vector of length 5"),
    "not a number": (lambda: solved(dome(DIRECTIONS * [1, 1, np.nan])), InputError, r"direction_C: 1 numbers that are not finite"),
    "two numbers": (lambda: solved(dome(DIRECTIONS[:, :2])), InputError, r"direction_C: an array of \(2\)"),
    "dark lights": (lambda: solved(dome(intensity=0.0)), InputError, r"intensity: \[0\.0\]"),
    "a path": (lambda: solved("calibration.yaml"), InputError, r"calibration: a str(?s:.*)lpcal\.read_calibration"),
    "lights alone": (lambda: solved(dome().lights), InputError, "calibration: a tuple"),
    "a folder of images": (
        lambda: solved(dome(), "objects/bust"),
        InputError,
        r"images: holds no numbers, but a path(?s:.*)lpcal\.read_capture",
    ),
    "a word for the sensor": (lambda: solved(dome(), sensor="srgb"), InputError, r"sensor: 'srgb'(?s:.*)StatedSensor"),
    "a gamma that is none": (lambda: solved(dome(), sensor=lpcal.StatedSensor(gamma=-2.2)), InputError, r"sensor\.gamma: -2\.2"),
    "paths of boards": (lambda: lpcal.find_boards(["a.png"], lpcal.Board((9, 6), 0.025)), InputError, r"images\[0\]: a path(?s:.*)read it"),  # type: ignore[arg-type,list-item]
    "squares in mm": (lambda: lpcal.Board((9, 6), (25, 25)), InputError, r"squares of 25 x 25 m(?s:.*)0\.025 for 25 mm"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said_with_its_place(name: str) -> None:
    call, error, words = WRONG[name]
    with pytest.raises(error, match=words):
        call()


def camera(model: str = "opencv5", matrix: Any = K, distortion: Any = (0, 0, 0, 0, 0)) -> lpcal.Camera:
    return lpcal.Camera([400, 260], model, matrix, distortion)  # type: ignore[arg-type]


def test_a_camera_of_lists_is_a_camera() -> None:
    found = camera()
    assert found.image_size == (400, 260)
    assert "500" in repr(found)
    assert np.allclose(found.project(np.array([0.1, 0, 1.0])), [250, 130])


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (camera("fisheye"), r"camera\.model: 'fisheye'(?s:.*)undistorted first"),
        (camera(matrix=np.array(K).T), r"camera\.K(?s:.*)transpose it"),
        (camera(matrix=np.diag([-500.0, 500, 1])), r"camera\.K(?s:.*)focal lengths are above 0"),
        (camera(distortion=[0.1, 0.2, 0]), "3 coefficients(?s:.*)none, 4, 5 or 8"),
        (camera(distortion=[0.1, 0.2, 0, 0, np.nan]), "1 numbers that are not finite"),
    ],
)
def test_a_camera_that_cannot_be_is_refused(wrong: lpcal.Camera, words: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=words):
        lpcal.integrate(np.broadcast_to([0, 0, -1.0], (260, 400, 3)), wrong)
    with pytest.raises(InputError, match=words):
        lpcal.write_camera(tmp_path / "camera.yaml", wrong)
    assert not (tmp_path / "camera.yaml").exists()


def test_one_number_for_squares_is_both_sides() -> None:
    assert np.allclose(lpcal.Board((3, 2), 0.025).points_B(), lpcal.Board((3, 2), (0.025, 0.025)).points_B())  # type: ignore[arg-type]


@pytest.mark.parametrize(("model", "count", "meant"), [("pinhole", 0, "opencv4"), ("opencv4", 5, "opencv5"), ("opencv5", 4, "opencv4")])
def test_the_count_of_coefficients_says_the_model(model: str, count: int, meant: str, tmp_path: Path) -> None:
    lpcal.write_camera(tmp_path / "camera.yaml", camera(model, distortion=[0.0] * count))
    assert lpcal.read_camera(tmp_path / "camera.yaml").model == meant

"""lpcal's projection against OpenCV's, and its inverse and derivative against itself."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from lpcal.geometry import camera

K = np.array([[712.4, 0, 385.1], [0, 713.1, 230.6], [0, 0, 1.0]])
LENSES = [np.zeros(4), np.array([-0.302, 0.121, 0.0007, -0.0005]), np.array([-0.3, 0.12, 0.0007, -0.0005, 0.01, 0.01, 0.02, 0.003])]


def points(count: int = 60) -> np.ndarray:
    rng = np.random.default_rng(1)
    return np.column_stack([rng.uniform(-0.5, 0.5, (count, 2)), np.ones(count)]) * rng.uniform(0.2, 3, (count, 1))


@pytest.mark.parametrize("distortion", LENSES)
def test_projects_as_opencv_does(distortion: np.ndarray) -> None:
    x_C = points()
    peer = cv2.projectPoints(x_C.reshape(-1, 1, 3), np.zeros(3), np.zeros(3), K, distortion)[0].reshape(-1, 2)
    np.testing.assert_allclose(camera.project(x_C, K, distortion), peer, atol=1e-9)


@pytest.mark.parametrize("distortion", LENSES)
def test_unproject_undoes_project(distortion: np.ndarray) -> None:
    x_C = points()
    rays = camera.unproject(camera.project(x_C, K, distortion), K, distortion)
    np.testing.assert_allclose(rays, x_C / np.linalg.norm(x_C, axis=1, keepdims=True), atol=1e-12)


@pytest.mark.parametrize("distortion", LENSES)
def test_jacobian_is_the_derivative(distortion: np.ndarray) -> None:
    x_C, J = points(), camera.projection_jacobian(points(), K, distortion)
    for axis in range(3):
        step = np.eye(3)[axis] * 1e-6
        slope = (camera.project(x_C + step, K, distortion) - camera.project(x_C - step, K, distortion)) / 2e-6
        np.testing.assert_allclose(J[..., axis], slope, rtol=1e-5, atol=1e-4)

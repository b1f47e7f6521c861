"""Methods to compare: each does what its paper says, and a user's own is taken as they are."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
import pytest

import lpcal
from lpcal.api.compared import slopes_of
from lpcal.methods import Shading
from lpcal.view.pixel_list import ray_map

Y, X = np.mgrid[-1.1:1.1:60j, -1.1:1.1:60j]
BALL = X**2 + Y**2 < 0.9
N = np.stack([X, Y, -np.sqrt(np.maximum(1 - X**2 - Y**2, 0.05))], axis=-1)
ROUND = np.radians(np.arange(0, 360, 45))
DOME = np.stack([0.6 * np.cos(ROUND), 0.6 * np.sin(ROUND), -0.8 * np.ones(8)], axis=1)
CALIBRATION = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(DOME)))
SHADED = np.clip(np.einsum("lc,hwc->lhw", DOME, N), 0, 1) * np.where(BALL, 0.6, 0)


def glossy() -> np.ndarray:
    """The ball with a highlight of each light, under 4 % of its pixels."""
    half = DOME - [0, 0, 1]
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    return np.clip(SHADED + np.where(BALL, 0.3 * np.maximum(np.einsum("lc,hwc->lhw", half, N), 0) ** 120, 0), 0, 0.99)


def error_deg(surface: lpcal.Surface) -> float:
    return lpcal.evaluate(surface, np.where(BALL[..., None], N, 0)).normal_mean_deg


@pytest.mark.parametrize(
    ("method", "integrator"),
    [("least-squares", "lpcal"), ("least-squares", "poisson"), ("least-squares", "cosines"), ("l1", "poisson"), ("ranks", "poisson")],
)
def test_every_name_gives_a_surface(method: str, integrator: str) -> None:
    found = lpcal.reconstruct(SHADED, CALIBRATION, ambient=np.zeros_like(X), mask=BALL, method=method, integrator=integrator)
    assert error_deg(found) < 12
    assert np.isnan(found.normal_std_deg).all()
    height = np.sqrt(np.maximum(1 - X**2 - Y**2, 0)) * 59 / 2.2
    inner = X**2 + Y**2 < 0.4
    apart = (found.depth + height)[inner]
    assert np.std(apart) < 2.5  # pixels, of a ball of 27 pixels' radius
    assert "standard deviations" in found.warnings[-1]
    assert len(found.components) == 1


def test_l1_and_ranks_leave_out_shadows_and_highlights() -> None:
    error = {
        name: error_deg(lpcal.reconstruct(glossy(), CALIBRATION, ambient=np.zeros_like(X), mask=BALL, method=name))
        for name in ("least-squares", "l1", "ranks", "near")
    }
    assert error["l1"] < 0.8 * error["least-squares"]
    assert error["ranks"] < error["least-squares"]
    assert error["near"] < error["least-squares"]


@pytest.fixture
def own_names() -> Iterator[None]:
    yield
    lpcal.methods.NORMALS.pop("mine", None)
    lpcal.methods.INTEGRATORS.pop("mine", None)


@pytest.mark.usefixtures("own_names")
def test_a_users_own_is_taken_by_its_name() -> None:
    seen: list[Shading] = []

    def facing(shading: Shading) -> np.ndarray:
        seen.append(shading)
        return np.tile([0.0, 0.0, -2.0], (shading.signal.shape[1], 1))

    lpcal.methods.NORMALS["mine"] = facing
    lpcal.methods.INTEGRATORS["mine"] = lambda slopes, mask: np.where(mask, 7.0, np.nan) + slopes[..., 0] * 0
    found = lpcal.reconstruct(SHADED, CALIBRATION, ambient=np.zeros_like(X), mask=BALL, method="mine", integrator="mine")
    assert seen[0].B.shape == (8, BALL.sum(), 3)
    assert np.all(found.albedo[BALL] == 2)
    assert np.all(found.normals[BALL] == [0, 0, -1])
    assert np.all(found.depth[BALL] == 0)


@pytest.mark.parametrize(
    ("method", "integrator", "said"),
    [
        ("phong", "lpcal", "'phong'.*needed: near, distant, least-squares, l1, ranks"),
        ("l1", "fft", "'fft'.*needed: lpcal, poisson, cosines"),
        ("near", "poisson", "finds the depth with the normals"),
    ],
)
def test_a_name_that_is_none_is_refused(method: str, integrator: str, said: str) -> None:
    with pytest.raises(lpcal.errors.InputError) as caught:
        lpcal.reconstruct(SHADED, CALIBRATION, ambient=np.zeros_like(X), mask=BALL, method=method, integrator=integrator)
    assert re.search(said, caught.value.message(), re.DOTALL)


@pytest.mark.usefixtures("own_names")
@pytest.mark.parametrize(
    ("method", "integrator", "said"), [("mine", "lpcal", "(2, 3) from the method mine"), ("l1", "mine", "integrator mine")]
)
def test_what_a_users_own_returns_is_checked(method: str, integrator: str, said: str) -> None:
    lpcal.methods.NORMALS["mine"] = lambda _shading: np.zeros((2, 3))
    lpcal.methods.INTEGRATORS["mine"] = lambda _slopes, mask: np.full(mask.shape, np.nan)
    with pytest.raises(lpcal.errors.InputError) as caught:
        lpcal.reconstruct(SHADED, CALIBRATION, ambient=np.zeros_like(X), mask=BALL, method=method, integrator=integrator)
    assert said in caught.value.message()


@pytest.mark.parametrize("integrator", ["lpcal", "poisson", "cosines"])
def test_a_tilted_plane_before_a_camera_comes_out_plane(integrator: str) -> None:
    camera = lpcal.Camera((64, 48), "opencv4", np.array([[90.0, 0, 32], [0, 90, 24], [0, 0, 1]]), np.zeros(4))
    n = np.array([0.3, -0.2, -1.0]) / np.linalg.norm([0.3, -0.2, -1.0])
    found = lpcal.integrate(np.tile(n, (48, 64, 1)), camera, integrator=integrator, green="as-is")
    points = (found.rays_C * found.depth[..., None]).reshape(-1, 3).astype(float)
    off = (points - points.mean(axis=0)) @ n
    assert off.std() < 1e-3 * np.linalg.norm(points.std(axis=0))


def test_slopes_are_those_of_the_depth() -> None:
    camera = lpcal.Camera((64, 48), "opencv4", np.array([[90.0, 0, 32], [0, 90, 24], [0, 0, 1]]), np.zeros(4))
    rays_C = ray_map((48, 64), camera)
    n = np.array([0.3, -0.2, -1.0])
    depth = -0.4 / (rays_C @ n)  # the plane n . x = -0.4
    slopes = slopes_of(np.tile((n / np.linalg.norm(n)).astype(np.float32), (48, 64, 1)), rays_C, central=True)
    np.testing.assert_allclose(slopes[5:-5, 5:-5, 0], np.gradient(np.log(depth), axis=1)[5:-5, 5:-5], atol=1e-4)
    np.testing.assert_allclose(slopes[5:-5, 5:-5, 1], np.gradient(np.log(depth), axis=0)[5:-5, 5:-5], atol=1e-4)

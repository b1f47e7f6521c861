"""Steps of depth by normals, each as sure as its normals are."""

import numpy as np

from lpcal.integration.integrate import NORMAL_ERROR_RAD, Grid, Own, integrate, settle, steps
from lpcal.integration.pieces import BREAK_WEIGHT

SIDE = 40
MASK = np.ones((SIDE, SIDE), bool)


def rays() -> np.ndarray:
    row, column = np.nonzero(MASK)
    return np.stack([(column - SIDE / 2) / 400, (row - SIDE / 2) / 400, np.ones(len(row))], axis=1)


def test_sigma_grows_with_what_the_normals_leave_open() -> None:
    grid, rays_C = Grid.of(MASK), rays()
    n = np.tile([0.0, 0.0, -1.0], (len(rays_C), 1))
    _, plain = steps(grid, n, rays_C, central=True)
    _, open_ = steps(grid, n, rays_C, central=True, tilt_rad=np.full(len(n), 0.3))
    assert np.allclose(open_ / plain, np.hypot(1, 0.3 / NORMAL_ERROR_RAD), rtol=1e-9)


def test_wrong_normals_that_are_known_to_be_unsure_do_not_break_the_surface() -> None:
    """A flat front with a patch in the dark whose normals are 30 degrees off: no edge breaks, and the lit rest stays flat."""
    grid, rays_C = Grid.of(MASK), rays()
    row, column = np.nonzero(MASK)
    dark = (abs(row - SIDE / 2) < 8) & (abs(column - SIDE / 2) < 8)
    n = np.tile([0.0, 0.0, -1.0], (len(rays_C), 1))
    n[dark] = [0.0, np.sin(np.radians(30)), -np.cos(np.radians(30))]
    own = Own(np.where(dark, 1e-6, 20.0), np.zeros(len(rays_C)))

    def solved(tilt: np.ndarray | None) -> tuple[float, int]:
        step, sigma = steps(grid, n, rays_C, central=True, tilt_rad=tilt)
        u, weight = integrate(grid, step, sigma, own, np.zeros(len(rays_C)), graduated=True)
        u = settle(grid, step, sigma, own, u, weight)
        return float(np.std(u[~dark])), int(np.sum(weight < BREAK_WEIGHT))

    _, broken = solved(None)
    bent, count = solved(np.where(dark, 0.12, 0.0))
    assert broken > 5
    assert count == 0
    assert bent < 1e-4

"""Steps of depth by normals, each as sure as its normals are."""

import numpy as np

from lpcal.integration.integrate import NORMAL_ERROR_RAD, Grid, Own, integrate, settle, steps
from lpcal.integration.pieces import BREAK_WEIGHT
from lpcal.view.constants import REGULARISATION

SIDE = 40
MASK = np.ones((SIDE, SIDE), bool)


def rays() -> np.ndarray:
    row, column = np.nonzero(MASK)
    return np.stack([(column - SIDE / 2) / 400, (row - SIDE / 2) / 400, np.ones(len(row))], axis=1)


def test_sigma_grows_with_what_the_normals_leave_open() -> None:
    grid, rays_C = Grid.of(MASK), rays()
    n = np.tile([0.0, 0.0, -1.0], (len(rays_C), 1))
    plain = steps(grid, n, rays_C, central=True).sigma
    open_ = steps(grid, n, rays_C, central=True, tilt_rad=np.full(len(n), 0.3)).sigma
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
        step = steps(grid, n, rays_C, central=True, tilt_rad=tilt)
        u, weight = integrate(grid, step, own, np.zeros(len(rays_C)), graduated=True)
        u = settle(grid, step, own, u, weight)
        return float(np.std(u[~dark])), int(np.sum(weight < BREAK_WEIGHT))

    _, broken = solved(None)
    bent, count = solved(np.where(dark, 0.12, 0.0))
    assert broken > 5
    assert count == 0
    assert bent < 1e-4


def test_a_large_front_without_distances_of_its_own_stays_where_it_began() -> None:
    """What all pixels share is held by next to nothing: by the precision of the solve alone the front wanders by 3 %."""
    side = 500
    y, x = np.mgrid[:side, :side] / side - 0.5
    grid, rays_C = Grid.of(np.ones((side, side), bool)), np.stack([x, y, np.ones_like(x)], axis=-1).reshape(-1, 3)
    rough = 0.02 * np.random.default_rng(1).standard_normal(x.shape)
    n = np.stack([0.3 * np.sin(9 * x) + rough, 0.3 * np.cos(7 * y), -np.ones_like(x)], axis=-1).reshape(-1, 3)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    step = steps(grid, n, rays_C, central=True)
    begin = np.full(len(n), -1.0)
    own = Own(np.full(len(n), REGULARISATION), begin)
    u, weight = integrate(grid, step, own, begin, graduated=False)
    u = settle(grid, step, own, u, weight)
    assert abs(u.mean() - begin.mean()) < 1e-6
    assert 0.01 < u.std() < 1.0

"""The splines by which a coarse picture's field of light is spread from its lattice, beside scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, make_interp_spline

from lpcal.view import coarse


@pytest.mark.parametrize(("nodes", "places"), [(19, 19), (19, 60), (25, 7), (25, 240), (19, 1)])
@pytest.mark.parametrize("order", [1, 3])
def test_a_spline_between_nodes_is_that_of_scipy(nodes: int, places: int, order: int) -> None:
    at, every = np.arange(nodes), np.eye(nodes)
    spline = CubicSpline(at, every, bc_type="natural") if order == 3 else make_interp_spline(at, every, k=1)
    np.testing.assert_allclose(coarse._spline(nodes, places, order), spline(np.linspace(0, nodes - 1, places)), atol=1e-13)

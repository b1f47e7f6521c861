"""The splines by which a coarse picture's field of light is spread from its lattice, beside scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lpcal.view import coarse


@pytest.mark.parametrize(("nodes", "places"), [(19, 19), (19, 60), (25, 7), (25, 240), (19, 1)])
@pytest.mark.parametrize("order", [1, 3])
def test_a_spline_between_nodes_is_that_of_scipy(nodes: int, places: int, order: int) -> None:
    at = np.linspace(0, nodes - 1, places)[None]
    expected = [ndimage.map_coordinates(one, at, order=order, mode="nearest") for one in np.eye(nodes)]
    np.testing.assert_allclose(coarse._spline(nodes, places, order), np.stack(expected, axis=1), atol=1e-13)

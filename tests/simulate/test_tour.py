"""A robot's path round an object: what it looks at, how it rests, the true mesh."""

from __future__ import annotations

import numpy as np
import pytest

import lpcal
from lpcal.geometry import se3
from lpcal.simulate import motion, tour


def test_every_stop_looks_at_the_whole_object() -> None:
    """From all sides, from above and below."""
    rig = lpcal.simulate_rig(lpcal.read_rig("lightpanel-6"), image_size=(320, 200))
    path = tour.plan(rig.built, "vase", 16, 1)
    middle = path.H_CS[:, :3, 3]
    assert np.all(np.abs(middle - rig.built.focus_C) < 0.03)
    for H_CS in path.H_CS:
        reach = 0.7 * path.shape.bound_m * np.concatenate([np.eye(3), -np.eye(3)])
        assert rig.built.lens.inside(se3.apply(H_CS, reach), 0)
    ahead_S = path.H_CS[:, 2, :3]
    assert ahead_S.mean(axis=0)[0] ** 2 + ahead_S.mean(axis=0)[2] ** 2 < 0.05
    assert ahead_S[:, 1].min() < -0.3
    assert ahead_S[:, 1].max() > 0.5


def test_the_panel_rests_at_every_stop() -> None:
    """The camera looks while it rests; the recording begins before and ends after."""
    rig = lpcal.simulate_rig(lpcal.read_rig("lightpanel-6"), image_size=(320, 200))
    path = tour.plan(rig.built, "bust", 6, 1)
    stops = path.H_OC @ se3.inv(rig.built.H_PC)
    trip = motion.round_trip(stops, rig.recipe, np.random.default_rng(1))
    assert trip.t_s[0] < trip.dwells_s[0, 0]
    assert trip.t_s[-1] > trip.dwells_s[-1, 1] + 0.5
    assert np.all(trip.station_s == trip.dwells_s.mean(axis=1))
    assert np.abs(trip.station_H_OP[:, :3, 3] - stops[:, :3, 3]).max() < 1e-4
    speed = np.linalg.norm(np.diff(trip.H_OP[:, :3, 3], axis=0), axis=1) / np.diff(trip.t_s)
    assert speed.max() < 4


@pytest.mark.parametrize("name", tour.SHAPES)
def test_the_true_mesh_lies_on_the_object(name: str) -> None:
    """Closed or not, its vertices are where the signed distance is nothing, its faces look outward."""
    pytest.importorskip("skimage")
    shape = tour.SHAPES[name](0.05)
    x_S, faces = tour.solid(shape, 0.004)
    assert np.percentile(np.abs(shape.distance(x_S)), 99) < 2e-5
    a, b, c = (x_S[faces[:, k]] for k in range(3))
    outward = (np.cross(b - a, c - a) * shape.normal((a + b + c) / 3)).sum(axis=1) > 0
    assert outward.mean() > 0.98

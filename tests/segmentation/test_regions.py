"""Regions cut along edges of brightness, and the clues by the likely object about a region, on labels whose right answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.segmentation import regions
from lpcal.segmentation.regions import Pictures, Regions

SHAPE = (40, 60)
WALL, SUPPORT = np.array([0.0, 0.0, 1 / 0.5]), np.array([0.0, 0.8, 0.6]) / 0.3
OBJECT = (slice(10, 30), slice(20, 40))


def pictures(labels: np.ndarray, planes: list[np.ndarray], u_object: float = np.log(0.4)) -> Pictures:
    """Rays straight ahead; matter of any normal costs least at `u_object`."""
    facing = np.stack([np.array([0.0, 0.0, -1.0]), *(-q / np.linalg.norm(q) for q in planes), np.zeros(3), np.zeros(3)])[labels]
    u = np.log(np.array([0.3, 0.4, 0.5]))
    cost = np.abs(u - u_object)[:, None, None] * np.ones(labels.shape)
    rays = np.tile([0.0, 0.0, 1.0], (*labels.shape, 1))
    none = np.zeros(labels.shape)
    return Pictures(labels, planes, none, none, facing, rays, (u, cost), none, none, facing, none)


def clue(name: str, labels: np.ndarray, planes: list[np.ndarray], u_object: float = np.log(0.4)) -> np.ndarray:
    """A clue as a picture, label 0 being likely the object."""
    found = Regions.of(labels, np.zeros(labels.shape))
    logit = np.where(found.label == 0, 4.0, -4.0)
    return regions.beside(pictures(labels, planes, u_object), found, logit)[name][found.number]


def test_an_edge_of_brightness_parts_what_a_label_joins_and_a_gradual_change_does_not() -> None:
    labels = np.zeros(SHAPE, int)
    step = np.where(np.indices(SHAPE)[1] < 25, 0.0, 1.0)
    assert len(Regions.of(labels, step).label) == 2
    slope = np.indices(SHAPE)[1] * (0.4 * regions.EDGE / 2)
    assert len(Regions.of(labels, slope).label) == 1
    assert np.array_equal(np.sort(Regions.of(labels, step).area), [25 * 40, 35 * 40]), "every pixel belongs to the nearer part"


def test_parts_that_are_small_do_not_come_off() -> None:
    labels, bright = np.zeros(SHAPE, int), np.zeros(SHAPE)
    bright[10:13, 10:13] = 1.0
    assert len(Regions.of(labels, bright).label) == 1
    bright[10:20, 10:20] = 1.0
    assert len(Regions.of(labels, bright).label) == 2


def test_labels_stay_apart_whatever_their_brightness() -> None:
    labels = np.zeros(SHAPE, int)
    labels[:, 30:] = 1
    noisy = np.random.default_rng(0).normal(0, 1.0, SHAPE)
    for bright in (np.zeros(SHAPE), noisy):
        found = Regions.of(labels, bright)
        assert all(len(np.unique(labels[found.number == k])) == 1 for k in range(len(found.label)))
        assert found.area.sum() == labels.size


def test_what_faces_up_and_lies_above_the_object_is_told_from_what_lies_under_it() -> None:
    labels = np.full(SHAPE, 1)
    labels[OBJECT] = 0
    labels[6:10, 20:40], labels[30:34, 20:40] = 2, 2
    found = clue("above, facing up", labels, [WALL, SUPPORT])
    assert found[8, 30] > 0.5
    assert found[32, 30] < -0.5
    assert found[2, 2] == pytest.approx(0, abs=0.05), "a wall faces the camera"


@pytest.mark.parametrize(("depth_m", "least", "most"), [(0.4, 0.4, 1.0), (0.5, 0.0, 0.02)])
def test_a_plane_at_the_objects_own_depth_goes_on_from_it(depth_m: float, least: float, most: float) -> None:
    labels = np.full(SHAPE, 1)
    labels[OBJECT] = 0
    labels[6:10, 20:40] = 2
    found = clue("goes on, a plane", labels, [WALL, np.array([0.0, 0.0, 1 / depth_m])])
    assert least <= found[8, 30] <= most
    assert found[15, 30] == 0, "matter of any normal is no plane"


def test_the_dark_between_parts_of_the_object_lies_in_its_hull() -> None:
    labels = np.full(SHAPE, 2)  # nothing, beside one plane
    labels[10:30, 20:25], labels[10:30, 35:40] = 0, 0
    labels[9:31, 25:35] = 1
    labels[12:28, 26:34] = 2
    found = clue("in the hull, dark", labels, [WALL])
    assert found[20, 30] == pytest.approx(1)
    assert found[2, 2] < 0.2
    parts = Regions.of(labels, np.zeros(SHAPE))
    nowhere = regions.beside(pictures(labels, [WALL]), parts, np.full(len(parts.label), -4.0))
    assert not nowhere["in the hull, dark"].any(), "no object, no hull"

"""What the mask's network is fitted to: holes, dark rooms, crops and mirrors of drawn scenes."""

from __future__ import annotations

import numpy as np
import pytest

from fit_mask import SIDES, Example, crop, darkened, pierced, sampled

NAMES = ["bright", "room", "has room", "nothing", "normal x", "size", "frame"]


def scene(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Channels (C, 60, 80) of a bright object, which faces aside, before a dark wall that no light reaches; the object's share."""
    share = np.zeros((60, 80))
    share[15:45, 20:60] = 1.0
    x = rng.normal(0, 0.01, (len(NAMES), *share.shape))
    for name, inside, outside in (("bright", 1, -1), ("nothing", 0, 1), ("normal x", 0.5, 0), ("frame", 0, 1), ("size", 0.5, 0.9)):
        x[NAMES.index(name)] += np.where(share > 0.5, inside, outside)
    x[NAMES.index("has room")] = 1
    return x, share


def test_a_hole_shows_the_background_and_nothing_else_changes() -> None:
    rng = np.random.default_rng(0)
    x, share = scene(rng)
    areas = []
    for _ in range(40):
        y, left = pierced(x, share, NAMES, rng)
        hole = (share > 0.5) & (left < 0.5)
        areas.append(hole.sum() / share.sum())
        np.testing.assert_array_equal(y[:, ~hole], x[:, ~hole])
        np.testing.assert_array_equal(left[~hole], share[~hole])
        if hole.any():
            assert y[NAMES.index("bright")][hole].max() < -0.9
            assert not y[NAMES.index("frame")][hole].any(), "it does not touch the image's frame"
            assert y[NAMES.index("size")][hole] == pytest.approx(np.sqrt(hole.mean()))
    assert 0 < min(filter(None, areas)) < 0.02
    assert 0.08 < max(areas) < 0.17


def test_a_dark_room_is_dark_where_no_light_reaches_it_alone() -> None:
    rng = np.random.default_rng(1)
    x, share = scene(rng)
    y = darkened(x, share, NAMES, rng)
    room = y[NAMES.index("room")]
    assert np.median(room[share < 0.5]) < np.median(room[share > 0.5]) - 0.25
    assert np.median(room) == pytest.approx(0)
    np.testing.assert_array_equal(np.delete(y, NAMES.index("room"), axis=0), np.delete(x, NAMES.index("room"), axis=0))
    x[NAMES.index("has room")] = 0
    np.testing.assert_array_equal(darkened(x, share, NAMES, rng), x)


def test_crops_hold_the_object_and_mirrors_turn_normals() -> None:
    rng = np.random.default_rng(2)
    x, share = scene(rng)
    one = Example("scene", dict(zip(NAMES, x, strict=True)), share, True)
    turned = []
    for _ in range(60):
        rows, columns = crop(share > 0.5, rng)
        assert share[rows, columns].sum() == share.sum()
        y, kept = sampled(one, NAMES, rng)
        assert kept.shape == SIDES == y.shape[1:]
        turned.append(float(np.median(y[NAMES.index("normal x")][kept > 0.5])))
    assert {round(value, 1) for value in turned} == {0.5, -0.5}

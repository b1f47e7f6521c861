"""What the outline's network is fitted to beside scenes as they were drawn: straight cuts, holes, and sides that no light reaches."""

from __future__ import annotations

import numpy as np
import pytest

from fit_outline import CUT_OFF, SIDES, Example, beyond_a_line, dimmed, drawn, hole, replaced
from lpcal.segmentation import outline

NAMES = ["odds", "shading", "bright", "room", "has room", "leaning x", "leaning y", "second darkest", "darkest", "over noise"]


def scene(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Channels (C, 90, 120) of a bright object before a dark wall, and the object's share."""
    share = np.zeros((90, 120))
    share[25:65, 30:80] = 1.0
    x = rng.normal(0, 0.01, (len(NAMES), *share.shape))
    for name, inside, outside in (("odds", 8, -8), ("shading", 0, -2), ("bright", 0, -2), ("room", 0, 1), ("leaning x", 0.3, 0)):
        x[NAMES.index(name)] += np.where(share > 0.5, inside, outside)
    x[NAMES.index("has room")] = 1
    return x, share


@pytest.mark.parametrize("part", CUT_OFF)
def test_what_is_cut_off_lies_beyond_a_line_and_shows_the_background(part: float) -> None:
    rng = np.random.default_rng(0)
    x, share = scene(rng)
    for _ in range(8):
        beyond = beyond_a_line(share, part, rng)
        assert beyond.sum() == pytest.approx(part * share.sum(), rel=0.15)
        y, left = replaced(x, share, beyond, NAMES, rng)
        if np.array_equal(left, share):
            continue
        assert y[NAMES.index("bright")][beyond].max() < -1.9
        assert not left[beyond].any()
        assert y[NAMES.index("odds")][beyond].mean() < 0
        rest = ~beyond
        rest_of = np.delete(y, NAMES.index("odds"), axis=0)[:, rest], np.delete(x, NAMES.index("odds"), axis=0)[:, rest]
        np.testing.assert_array_equal(*rest_of)
        np.testing.assert_array_equal(left[rest], share[rest])


def test_a_hole_lies_in_the_object_and_is_as_large_as_asked() -> None:
    rng = np.random.default_rng(1)
    _, share = scene(rng)
    for part in (0.01, 0.1):
        size = [hole(share, part, rng).sum() / share.sum() for _ in range(30)]
        assert 0.2 * part < np.median(size) < 1.2 * part
        assert max(size) < 1.3 * part
    assert not hole(np.zeros_like(share), 0.1, rng).any()


def test_a_side_without_light_keeps_what_the_room_shows() -> None:
    rng = np.random.default_rng(2)
    x, share = scene(rng)
    part = beyond_a_line(share, 0.2, rng)
    y = dimmed(x, part, NAMES, rng)
    assert np.all(y[NAMES.index("bright")][part] < -2.9)
    for name in ("room", "has room"):
        np.testing.assert_array_equal(y[NAMES.index(name)], x[NAMES.index(name)])
    x[NAMES.index("has room")] = 0
    np.testing.assert_array_equal(dimmed(x, part, NAMES, rng), x)


def test_windows_lie_about_the_outline_and_mirrors_turn_what_leans() -> None:
    rng = np.random.default_rng(3)
    x, share = scene(rng)
    share[25, 30:80] = 0.5
    one = Example("scene", True, dict(zip(NAMES, x, strict=True)), share, 1.0, 1.0, 0.0)
    leaning = []
    for _ in range(40):
        found, of_object, there = drawn(one, x, NAMES, rng)
        assert found.shape == (len(NAMES), *SIDES)
        assert there.sum() == 90 * 120, "all of a picture that is smaller than the window"
        assert (of_object > 0.5).any()
        assert not found[:, there == 0].any()
        leaning.append(found[NAMES.index("leaning x")].max() > 0.2)
    assert 5 < sum(leaning) < 35
    assert outline.MIRRORED == ("leaning x",)

"""A ball beside something else in the picture: the ball is found, or what is taken for it is said with its place and the cure."""

from __future__ import annotations

import re

import numpy as np
import pytest

from ball_scenes import Painter, before, box, disc, framed, matte, mug, picture, turned, vase
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.errors import DegenerateError
from lpcal.records.observations import Radiance, SphereView

BALL = (110, 120, 42)
BESIDE: dict[str, Painter] = {
    "box": box(260, 120, 45),
    "vase": vase(260, 120, 80),
    "mug": mug(265, 110, 50),
    "picture frame": framed(265, 120, 60),
    "round picture": disc(265, 120, 55),
    "larger round picture": disc(255, 120, 85),
    "can": turned(265, 120, 60, np.ones_like),
}


def place_of(view: SphereView) -> tuple[float, float, float]:
    """Centre and radius of the circle through the outline's points, which may lack a side."""
    points = view.outline_px
    x, y, c = np.linalg.lstsq(np.column_stack([2 * points, np.ones(len(points))]), np.sum(points**2, axis=1), rcond=None)[0]
    return float(x), float(y), float(np.sqrt(c + x * x + y * y))


def attempt(seen: Radiance, kind: str) -> tuple[tuple[float, float, float] | None, str]:
    """Where the ball is found, or what is said instead."""
    try:
        return place_of(observe_sphere(seen, Expected(kind, None), None)), ""
    except DegenerateError as refused:
        return None, str(refused)


SOON = {("matte", "round picture"), ("chrome", "mug")}
"""A thing for each kind of ball; the others are among the slow."""


@pytest.mark.parametrize(
    ("kind", "thing"),
    [pytest.param(kind, name, marks=[pytest.mark.slow] * ((kind, name) not in SOON)) for kind in ("matte", "chrome") for name in BESIDE],
)
def test_the_ball_is_found_beside(kind: str, thing: str) -> None:
    things = [BESIDE[thing], *([matte(*BALL)] if kind == "matte" else [])]
    seen = picture(things, BALL if kind == "chrome" else None)
    np.testing.assert_allclose(place_of(observe_sphere(seen, Expected(kind, None), None)), BALL, atol=1.2)


@pytest.mark.slow
def test_a_chrome_ball_is_told_from_a_matte_one() -> None:
    seen = picture([matte(265, 120, 50)], BALL)
    np.testing.assert_allclose(place_of(observe_sphere(seen, Expected("chrome", None), None)), BALL, atol=1.2)
    np.testing.assert_allclose(place_of(observe_sphere(seen, Expected("matte", None), None)), (265, 120, 50), atol=1.2)


@pytest.mark.slow
@pytest.mark.parametrize("other", [(265, 120, 50), (265, 100, 33), (240, 150, 42)])
def test_two_balls_of_a_kind_are_refused_and_a_hint_says_which(other: tuple[float, float, float]) -> None:
    seen = picture([matte(*BALL), matte(*other)])
    with pytest.raises(DegenerateError, match="two spheres in the picture") as refused:
        observe_sphere(seen, Expected("matte", None), None)
    hints = [np.array(list(map(float, found))) for found in re.findall(r"hint: \[(\d+) px, (\d+) px, (\d+) px\]", str(refused.value))]
    assert sorted(np.round(hints, -1).tolist()) == sorted(np.round([BALL, other], -1).tolist())
    for hint in hints:
        np.testing.assert_allclose(place_of(observe_sphere(seen, Expected("matte", None, hint), None)), hint, atol=1.5)


@pytest.mark.parametrize("thing", ["round picture", *(pytest.param(name, marks=pytest.mark.slow) for name in ("picture frame", "mug"))])
def test_a_ball_cut_by_the_border_is_not_replaced_by_another_thing(thing: str) -> None:
    for kind, things, chrome in (("matte", [BESIDE[thing], matte(20, 120, 42)], None), ("chrome", [BESIDE[thing]], (20, 120, 42))):
        with pytest.raises(DegenerateError) as refused:
            observe_sphere(picture(things, chrome), Expected(kind, None), None)
        assert "border" in str(refused.value) or "hint: [x px, y px, r px]" in str(refused.value)


@pytest.mark.parametrize("thing", [pytest.param(name, marks=pytest.mark.slow) for name in ("round picture", "larger round picture")])
def test_a_ball_partly_hidden_is_not_replaced_and_a_hint_solves_it(thing: str) -> None:
    seen = picture([BESIDE[thing], matte(*BALL), before(140, 165, 60, 180)])
    found, refused = attempt(seen, "matte")
    assert found is not None or ("hint: [x px, y px, r px]" in refused and len(refused) < 600)
    if found is not None:
        np.testing.assert_allclose(found, BALL, atol=3)
    hinted = place_of(observe_sphere(seen, Expected("matte", None, np.array([112.0, 118.0, 41.0])), None))
    np.testing.assert_allclose(hinted, BALL, atol=3)


@pytest.mark.parametrize(
    "thing", ["round picture", *(pytest.param(name, marks=pytest.mark.slow) for name in ("mug", "picture frame", "can"))]
)
def test_without_a_ball_what_is_round_is_refused_with_its_place_and_the_cure(thing: str) -> None:
    for kind in ("matte", "chrome"):
        with pytest.raises(DegenerateError, match=r"hint: \[x px, y px, r px\]"):
            observe_sphere(picture([BESIDE[thing]]), Expected(kind, None), None)

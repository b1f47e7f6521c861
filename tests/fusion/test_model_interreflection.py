"""Light between the parts of a model, against closed forms; what stands in the way."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import trimesh

from lpcal.fusion.model_interreflection import Body, Cells, at_points
from lpcal.fusion.second_solve import ViewSamples, reflectance_of
from lpcal.fusion.volume import Triangles


@cache
def hollow() -> Triangles:
    """A sphere of radius 50 mm seen from within."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.05)
    x = np.asarray(ball.vertices)
    return Triangles(x, -x / 0.05, np.asarray(ball.faces)[:, ::-1])


def body_of(model: Triangles) -> Body:
    return Body.of(model, np.ones((len(model.vertices_A), 3)))


def test_a_hollow_sphere_sees_itself_alone() -> None:
    """Form factors of every patch sum to 1, and with even light D every bounce together is a D / (1 - a): the integrating sphere."""
    body = body_of(hollow())
    assert np.allclose(body.each_other.sum(axis=1), 1, atol=0.06)
    assert np.isclose(body.area.sum(), 4 * np.pi * 0.05**2, rtol=0.01)
    for a in (0.3, 0.7):
        thrown = body.thrown(np.full((2, len(body.x_A)), 3.0), a)
        irradiance = np.einsum("lqi,qi->lq", thrown, body.n_A)
        assert np.median(np.abs(irradiance / (3 * a / (1 - a)) - 1)) < 0.1


def test_a_ball_throws_no_light_on_itself() -> None:
    """Convex: no patch sees another, and its far side is hidden from a light."""
    inside = hollow()
    model = Triangles(inside.vertices_A, -inside.normals_A, inside.faces[:, ::-1])
    body = body_of(model)
    assert not body.G.any()
    start, end = np.array([[0.0, 0, 0.06], [0.0, 0.06, 0.06]]), np.array([[0.0, 0, -0.06], [0.0, 0.06, -0.06]])
    assert body.cells.between(start, end).tolist() == [True, False]


def test_a_plate_between_two_others_hides_them_from_each_other() -> None:
    """Two plates 40 mm apart see each other by the known form factor of equal parallel squares, and not with a third between them."""
    low, high = plate(0.0, up=True), plate(0.04, up=False)
    found = body_of(joined(low, high))
    bottom = found.x_A[:, 2] < 0.01
    share = np.average(found.each_other[np.ix_(bottom, ~bottom)].sum(axis=1), weights=found.area[bottom])
    assert np.isclose(share, opposite_squares(0.06 / 0.04), atol=0.02)
    between = body_of(joined(low, high, plate(0.02, up=True)))
    bottom, top = between.x_A[:, 2] < 0.01, between.x_A[:, 2] > 0.03
    assert not between.G[:, bottom][:, :, top].any()


def test_light_at_a_point_is_that_of_patches_that_face_its_way() -> None:
    """Between two plates back to back each side has its own."""
    body = body_of(joined(plate(0.0, up=False), plate(0.004, up=True)))
    up = body.n_A[:, 2] > 0
    thrown = np.where(up[:, None], [0, 0, 1.0], [0, 0, -5.0])[None]
    x = np.array([[0.0, 0, 0.004], [0.0, 0, 0.0]])
    light = at_points(thrown, body.shares(x, np.array([[0, 0, 1.0], [0, 0, -1.0]])))
    assert np.allclose(light[0, :, 2], [1, -5], atol=0.05)


def test_no_reflectance_without_images() -> None:
    assert reflectance_of(body_of(hollow()), []) is None


@pytest.mark.parametrize("reflectance", [0.3, 0.7])
def test_the_reflectance_is_that_with_which_one_normal_explains_all_views(reflectance: float) -> None:
    """Of a corner that four views see, each with its lights elsewhere: with noise, and places in a shadow that the model does not have.

    How bright each capture came out is 4 % off, one standard deviation.
    """
    body, rng = body_of(corner()), np.random.default_rng(2)
    found = reflectance_of(body, [of_corner(body, reflectance, k, rng) for k in range(4)])
    assert found == pytest.approx(reflectance, abs=0.05)
    assert reflectance_of(body, [of_corner(body, reflectance, 0, rng)]) is None  # of one view alone nothing is asked


def corner() -> Triangles:
    """A square plate and another that stands at its edge, both facing the space between."""
    flat = plate(0.0, up=True)
    x, n = (one[:, [2, 1, 0]] for one in (flat.vertices_A, flat.normals_A))
    return joined(flat, Triangles(x + np.array([-0.03, 0, 0.03]), n, flat.faces[:, ::-1]))


def of_corner(body: Body, reflectance: float, view: int, rng: np.random.Generator) -> ViewSamples:
    """What a view of the corner shows at places of both plates, six lights about it."""
    model = corner()
    place = np.arange(0, len(model.vertices_A), 4)
    x, n = model.vertices_A[place], model.normals_A[place]
    turn = 2 * np.pi * np.arange(6) / 6
    camera = np.array([0.2, -0.15 + 0.1 * view, 0.25])
    sources = camera + 0.12 * np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    lit, direct = (_field(sources, at) for at in (x, body.x_A))
    direct = np.maximum(np.einsum("lqi,qi->lq", direct, body.n_A), 0)
    shares = body.shares(x, n)
    signal = 0.2 * np.einsum("lni,ni->ln", lit + at_points(body.thrown(direct, reflectance), shares), n)
    signal = (1 + 0.04 * rng.standard_normal()) * signal + 1e-3 * signal.max() * rng.standard_normal(signal.shape)
    reached = np.einsum("lni,ni->ln", lit, n) > 0
    signal[view, ::7] *= 0.3
    return ViewSamples(place, signal, np.full(signal.shape, 1e-3 * signal.max()), reached, lit, direct, shares)


def _field(sources: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Light vectors (L, N, 3) at points of sources of intensity 1."""
    to = sources[:, None] - x
    return np.asarray(to / np.linalg.norm(to, axis=2, keepdims=True) ** 3)


def test_cells_hold_the_surface_without_holes() -> None:
    """Of rays from the middle of a sphere one in a hundred slips past the corners of cells at most."""
    rng = np.random.default_rng(0)
    out = rng.standard_normal((500, 3))
    out *= 0.08 / np.linalg.norm(out, axis=1, keepdims=True)
    met = Cells.of(hollow()).between(np.zeros((500, 3)), out)
    assert met.mean() > 0.99


def plate(z: float, *, up: bool) -> Triangles:
    """A square plate of 60 mm at a height, of 2 mm squares."""
    side = np.linspace(-0.03, 0.03, 31)
    x, y = np.meshgrid(side, side, indexing="ij")
    number = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (one.ravel() for one in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    n = np.tile([0.0, 0, 1.0 if up else -1.0], (x.size, 1))
    return Triangles(np.stack([x.ravel(), y.ravel(), np.full(x.size, z)], axis=1), n, faces if up else faces[:, ::-1])


def joined(*some: Triangles) -> Triangles:
    ends = np.cumsum([0, *(len(one.vertices_A) for one in some)])
    return Triangles(
        np.concatenate([one.vertices_A for one in some]),
        np.concatenate([one.normals_A for one in some]),
        np.concatenate([one.faces + first for one, first in zip(some, ends, strict=False)]),
    )


def opposite_squares(x: float) -> float:
    """The form factor of two equal parallel squares of side x times their distance (Howell's catalogue, C-11)."""
    q = np.sqrt(1 + x * x)
    return float(2 / (np.pi * x * x) * (np.log(q * q / np.sqrt(1 + 2 * x * x)) + 2 * x * q * np.arctan(x / q) - 2 * x * np.arctan(x)))

"""What a surface does to its own light: hides it, throws it on, and misleads the distance where nobody sees why."""

from __future__ import annotations

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light
from lpcal.surface import bounce, distance, normals, rounds
from lpcal.surface.integrate import Grid, Own
from lpcal.surface.relief import Relief
from lpcal.surface.sight import Lit, Sight

FOCAL = 260.0


def sight_of(mask: Mask, signal: Array) -> Sight:
    row, column = np.nonzero(mask)
    height, width = mask.shape
    rays = np.stack([(column - (width - 1) / 2) / FOCAL, (row - (height - 1) / 2) / FOCAL, np.ones(len(row))], axis=1)
    return Sight(mask, rays, signal, np.full(signal.shape, 1e-3), np.ones(signal.shape, bool), True)


def bowl(half_angle_deg: float = 55.0) -> tuple[Sight, Array, Array, float]:
    """A bowl, part of a sphere seen from inside: its pixels, depths (P,), normals (P, 3) and the cap's share of the sphere."""
    centre, radius = np.array([0.0, 0.0, 0.30]), 0.06
    edge_z = centre[2] + radius * np.cos(np.radians(half_angle_deg))
    rays = sight_of(np.ones((110, 110), bool), np.zeros((1, 12100))).rays_C
    a, b = np.sum(rays**2, axis=1), rays @ centre
    depth = (b + np.sqrt(np.maximum(b**2 - a * (centre @ centre - radius**2), 0))) / a
    x_C = depth[:, None] * rays
    mask = ((x_C[:, 2] > edge_z) & (np.abs(np.linalg.norm(x_C - centre, axis=1) - radius) < 1e-9)).reshape(110, 110)
    n = ((centre - x_C) / radius)[mask.ravel()]
    return sight_of(mask, np.ones((1, int(mask.sum())))), depth[mask.ravel()], n, (1 - np.cos(np.radians(half_angle_deg))) / 2


def test_inside_a_sphere_every_place_gets_the_same_light_from_the_rest():
    seen, depth, n, share = bowl()
    J = bounce.thrown(seen, depth, n, seen.signal)
    got = np.einsum("pi,pi->p", J[0], n)
    assert abs(np.median(got) / share - 1) < 0.07
    assert np.mean(np.abs(got / share - 1) < 0.15) > 0.9


def bowl_under_lights(reflectance: float) -> tuple[Sight, Lit, Array, Array]:
    """The bowl under six near lights, all bounces in it counted: what bounces inside a sphere is the same everywhere."""
    seen, depth, n, share = bowl()
    x_C, angle = seen.points_C(depth), np.arange(6) * np.pi / 3
    sources = np.stack([0.1 * np.cos(angle), 0.1 * np.sin(angle), np.full(6, 0.05)], axis=1)
    to = sources[:, None] - x_C
    r = np.linalg.norm(to, axis=2)
    lit = Lit(to / r[..., None], 0.07 / r**2)
    direct = reflectance * lambert.predicted(lit.B, n)
    bounced = reflectance * share * direct.mean(axis=1, keepdims=True) / (1 - reflectance * share)
    rng = np.random.default_rng(3)
    return sight_of(seen.mask, direct + bounced + 2e-3 * rng.standard_normal(direct.shape)), lit, depth, n


def error_deg(b: Array, n: Array) -> float:
    return float(np.degrees(np.nanmedian(np.linalg.norm(lambert.unit(b)[0] - n, axis=1))))


def test_light_that_bounces_no_longer_flattens_a_bowl():
    seen, lit, depth, n = bowl_under_lights(0.8)
    usable, variance = normals.candidates(seen, lit.E), normals.variances(seen)
    plain = normals.estimate(seen, lit.B, usable, variance)
    J = bounce.thrown(seen, depth, n, seen.signal)
    found, albedo = bounce.reflectance(seen, lit, J, usable, plain)
    assert 0.5 <= found <= 0.9
    better = normals.estimate(seen, lit.B + found / albedo * J, usable, variance)
    assert error_deg(plain.b, n) > 1.5
    assert error_deg(better.b, n) < 0.5 * error_deg(plain.b, n)


def test_a_step_hides_a_light_where_its_shadow_falls():
    mask = np.ones((60, 120), bool)
    seen = sight_of(mask, np.zeros((1, mask.size)))
    near = seen.rays_C[:, 0] * 0.30 < 0
    depth = np.where(near, 0.30, 0.35)
    x_C, source_C = seen.points_C(depth), np.array([-0.18, 0.0, 0.03])
    found = Relief.of(seen, depth).hidden_from(x_C, source_C, 64)
    at_step = x_C + ((x_C[:, 2] - 0.30) / (x_C[:, 2] - source_C[2]))[:, None] * (source_C - x_C)
    shadow = ~near & (at_step[:, 0] < 0)
    beside = np.abs(at_step[:, 0]) < 0.004
    assert shadow.sum() > 500
    assert np.mean(found[~beside] == shadow[~beside]) > 0.99
    assert not found[near].any()


def test_a_light_that_the_depth_hides_is_left_out():
    mask = np.ones((60, 120), bool)
    bare = sight_of(mask, np.zeros((4, mask.size)))
    depth = np.where(bare.rays_C[:, 0] < 0, 0.30, 0.35)
    x_C, n = bare.points_C(depth), np.tile([0.0, 0.0, -1.0], (mask.size, 1))
    sources = [np.array([0.18 * np.cos(a), 0.18 * np.sin(a), 0.03]) for a in np.pi + np.arange(4) * np.pi / 2]
    lights = tuple(Light(f"L{k}", -source, np.ones(1), None, source, -source) for k, source in enumerate(sources))
    lit = rounds.Scene("step", bare, Grid.of(mask), lights, None).lit_at(depth)
    shadow = Relief.of(bare, depth).hidden_from(x_C, sources[0], 64)
    signal = 0.6 * lambert.predicted(lit.B, n)
    signal[0, shadow] *= 0.4  # what bounces there keeps it from being dark
    seen = sight_of(mask, signal)
    scene = rounds.Scene("step", seen, Grid.of(mask), lights, None)
    plain = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E), normals.variances(seen))
    before = rounds.State(np.log(depth), np.ones(len(scene.grid.a)), n, plain, Own(np.ones(mask.size), np.log(depth)), lit)
    hidden = rounds.hidden_lights(scene, depth, before, lit)
    assert np.mean(hidden[0] == shadow) > 0.95
    assert not hidden[1:].any()
    better = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E, hidden), normals.variances(seen))
    dark = shadow & hidden[0]
    assert error_deg(plain.b[dark], n[dark]) > 5
    assert error_deg(better.b[dark], n[dark]) < 0.1


def test_patches_that_light_from_elsewhere_misleads_do_not_move_the_piece():
    mask = np.ones((90, 120), bool)
    row, column = np.nonzero(mask)
    misled = (row < 40) & (column < 50)  # almost a fifth
    for seed in range(8):
        rng = np.random.default_rng(seed)
        u = np.full(mask.size, np.log(0.35))
        own = Own(np.full(mask.size, 1 / 0.1**2), u + 0.1 * rng.standard_normal(mask.size) - 0.08 * misled)
        held = distance.of_one_mind(own, u, mask, np.ones(mask.size, np.uint8))
        before, after = (np.average(one.optimum - u, weights=one.curvature) for one in (own, held))
        assert before < -0.01
        assert abs(after) < 0.5 * abs(before)

"""What a surface does to its own light: hides it, throws it on, and misleads the distance where nobody sees why."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration.integrate import Grid, Own
from lpcal.records.calibration import Light
from lpcal.segmentation.planes import Plane, predicted
from lpcal.shading import field, normals
from lpcal.shading.field import Field
from lpcal.surface import interreflection, rounds
from lpcal.surface.relief import Relief, interreflected_by_sides
from lpcal.surface.surroundings import Around, Patches, Whole, patches
from lpcal.view.constants import SHADOW_STEPS
from lpcal.view.pixel_list import Illumination, PixelList

FOCAL = 260.0


def lamp(name: str, source: list[float]) -> Light:
    source_C = np.array(source)
    return Light(name, source_C / np.linalg.norm(source_C), np.ones(1), None, source_C, -source_C)


HIGH = lamp("high", [0.0, 0.0, 0.01])
EMPTY = Relief(np.full((2, 2), np.inf), np.zeros((6, 2)))


def sight_of(mask: Mask, signal: Array) -> PixelList:
    row, column = np.nonzero(mask)
    height, width = mask.shape
    rays = np.stack([(column - (width - 1) / 2) / FOCAL, (row - (height - 1) / 2) / FOCAL, np.ones(len(row))], axis=1)
    return PixelList(mask, rays, signal, np.full(signal.shape, 1e-3), np.ones(signal.shape, bool), True)


def bowl(half_angle_deg: float = 55.0) -> tuple[PixelList, Array, Array, float]:
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


def test_inside_a_sphere_every_place_gets_the_same_light_from_the_rest() -> None:
    seen, depth, n, share = bowl()
    found = interreflection.interreflected(seen, depth, shown(n), n, [HIGH])
    got = np.einsum("pi,pi->p", found.seen[0], n)
    assert found.unseen.mean() < 0.01
    assert abs(np.median(got) / share - 1) < 0.07
    assert np.mean(np.abs(got / share - 1) < 0.15) > 0.9


def shown(n: Array, lights: int = 1) -> normals.Estimate:
    """An estimate of albedo 1 everywhere, without gloss."""
    none = np.zeros(len(n))
    return normals.Estimate(n, np.ones((lights, len(n)), bool), np.zeros((len(n), 3, 3)), none, none)


@pytest.mark.slow
def test_a_wall_behind_lights_what_is_turned_away_from_the_camera() -> None:
    tilt = np.radians(60.0)
    seen = sight_of(np.ones((40, 40), bool), np.zeros((1, 1600)))
    n = np.tile([np.sin(tilt), 0.0, -np.cos(tilt)], (1600, 1))
    depth = 0.30 * n[:, 2] / lambert.dot(n, seen.rays_C)
    side, spacing = np.meshgrid(np.linspace(-4.0, 4.0, 161), np.linspace(-4.0, 4.0, 161)), 0.05
    x_C = np.stack([side[0].ravel(), side[1].ravel(), np.full(161**2, 0.5)], axis=1)
    wall = Patches(x_C, np.tile([0.0, 0.0, -1.0], (len(x_C), 1)), np.full(len(x_C), spacing**2), np.ones((1, len(x_C))))
    alone = interreflection.interreflected(seen, depth, shown(n), n, [HIGH]).seen
    both = interreflection.interreflected(seen, depth, shown(n), n, [HIGH], Around(wall, None, EMPTY)).seen
    out_of_sight = interreflection.interreflected(seen, depth, shown(n), n, [HIGH], Around(replace(wall, area=0 * wall.area), wall, EMPTY))
    assert np.allclose(out_of_sight.J(beyond=1.0), both)
    assert np.allclose(out_of_sight.J(beyond=0.0), alone)
    got = lambert.dot(both[0] - alone[0], n)
    assert abs(np.median(got) / ((1 - np.cos(tilt)) / 2) - 1) < 0.15  # of a plane without end, seen under that angle
    assert np.abs(lambert.dot(alone[0], n)).max() < 1e-9


def test_the_wall_is_taken_up_as_it_is_seen() -> None:
    mask = np.ones((90, 120), bool)
    plane = Plane(np.array([0.1, 0.0, 1.0]) / 0.45, 1.0)
    bare = sight_of(mask, np.zeros((3, mask.size)))
    lights = [lamp(f"L{k}", [0.2 * np.cos(a), 0.2 * np.sin(a), 0.03]) for k, a in enumerate(np.arange(3) * 2 * np.pi / 3)]
    signal = 0.5 * predicted(plane.q, bare.rays_C, lights)
    hidden = np.zeros((90, 120), bool)
    hidden[30:60, 40:80] = True
    around = patches(Whole(sight_of(mask, signal), hidden, 1), [plane], lights)
    assert around is not None
    found = around.seen
    assert np.allclose(found.x_C @ plane.q, 1, atol=1e-3)
    corners = np.array([[-59.5, -44.5, FOCAL], [60.5, -44.5, FOCAL], [60.5, 45.5, FOCAL], [-59.5, 45.5, FOCAL]]) / FOCAL
    at = corners / (corners @ plane.q)[:, None]
    whole_area = 0.5 * np.linalg.norm(np.cross(at[2] - at[0], at[3] - at[1]))
    left_out = 30 * 40 / (90 * 120)  # the margin about the object counts as the plane beside it
    assert abs(found.area.sum() / whole_area - (1 - left_out)) < 0.03
    assert np.allclose(found.signal, 0.5 * predicted(plane.q, found.x_C / found.x_C[:, 2:], lights), rtol=0.08)
    beyond = around.unseen
    assert beyond is not None  # what the object hides, and what goes on outside the image, lit as the rest
    assert np.allclose(beyond.x_C @ plane.q, 1, atol=1e-3)
    assert np.allclose(beyond.signal, 0.5 * predicted(plane.q, beyond.x_C / beyond.x_C[:, 2:], lights), rtol=0.05)
    pixel = beyond.x_C[:, :2] / beyond.x_C[:, 2:] * FOCAL + [59.5, 44.5]
    inside = np.all((pixel > [-0.5, -0.5]) & (pixel < [119.5, 89.5]), axis=1)
    assert inside.any()
    assert np.all(np.abs(pixel[inside] - [59.5, 44.5]) < 24)
    assert beyond.area[~inside].sum() > found.area.sum()


def test_what_a_bright_wall_shows_beyond_saturation_is_told_by_its_other_lights() -> None:
    mask = np.ones((90, 120), bool)
    plane = Plane(np.array([0.1, 0.0, 1.0]) / 0.45, 1.0)
    bare = sight_of(mask, np.zeros((3, mask.size)))
    lights = [lamp(f"L{k}", [0.2 * np.cos(a), 0.2 * np.sin(a), 0.03]) for k, a in enumerate(np.arange(3) * 2 * np.pi / 3)]
    full = 0.5 * predicted(plane.q, bare.rays_C, lights)
    clipped = full[0] > np.quantile(full[0], 0.4)
    signal = full.copy()
    signal[0, clipped] = np.quantile(full[0], 0.4)
    seen = replace(sight_of(mask, signal), usable=np.stack([~clipped, *np.ones((2, mask.size), bool)]))
    around = patches(Whole(seen, np.zeros((90, 120), bool), 1), [plane], lights)
    assert around is not None
    at = around.seen.x_C / around.seen.x_C[:, 2:]
    assert np.allclose(around.seen.signal, 0.5 * predicted(plane.q, at, lights), rtol=0.05)


def test_a_plane_by_its_layer_throws_its_light_where_no_sample_fits_it() -> None:
    """Half of a wall is saturated in all lights or shows light from elsewhere besides: by its fit it is none, by its layer it is."""
    mask = np.ones((90, 120), bool)
    plane = Plane(np.array([0.1, 0.0, 1.0]) / 0.45, 1.0)
    bare = sight_of(mask, np.zeros((3, mask.size)))
    lights = [lamp(f"L{k}", [0.2 * np.cos(a), 0.2 * np.sin(a), 0.03]) for k, a in enumerate(np.arange(3) * 2 * np.pi / 3)]
    signal = 0.5 * predicted(plane.q, bare.rays_C, lights)
    row, column = np.indices(mask.shape).reshape(2, -1)
    left, lower = column < 40, (column >= 40) & (row >= 60)
    signal[0, lower] *= 2.0
    seen = replace(sight_of(mask, signal), usable=np.broadcast_to(~left, signal.shape).copy())
    whole = Whole(seen, np.zeros(mask.shape, bool), 1)
    by_fit, by_layer = patches(whole, [plane], lights), patches(whole, [plane], lights, np.zeros(mask.size, int))
    assert by_fit is not None
    assert by_layer is not None
    area = float(by_layer.seen.area.sum())
    assert 0.35 < by_fit.seen.area.sum() / area < 0.55
    at = by_layer.seen.x_C / by_layer.seen.x_C[:, 2:]
    pixel = at[:, :2] * FOCAL + [59.5, 44.5]
    saturated = pixel[:, 0] < 36
    assert np.allclose(by_layer.seen.signal[:, saturated], 0.5 * predicted(plane.q, at[saturated], lights), rtol=0.05)


def test_a_table_hides_a_light_below_it() -> None:
    """A table 6 cm under the camera's axis, seen along it: points above its top, lights over and under it."""
    mask = np.ones((90, 120), bool)
    plane = Plane(np.array([0.0, 1.0, 0.02]) / 0.06, 1.0)
    bare = sight_of(mask, np.zeros((3, mask.size)))
    lights = [lamp("left", [-0.2, -0.05, 0.03]), lamp("right", [0.2, -0.05, 0.03]), lamp("under", [0.0, 0.25, 0.03])]
    depth = 1 / np.maximum(bare.rays_C @ plane.q, 1e-9)
    table = (depth > 0.36) & (depth < 0.8)
    signal = np.where(table, 0.5 * np.maximum(predicted(plane.q, bare.rays_C, lights), 0.0), 0.0)
    around = patches(Whole(sight_of(mask, signal), np.zeros((90, 120), bool), 1), [plane], lights)
    assert around is not None
    up = np.linspace(0.003, 0.08, 40)
    x_C = np.stack([np.zeros(40), 0.06 - 0.02 * 0.45 - up, np.full(40, 0.45)], axis=1)
    source_C = lights[2].source_C
    assert source_C is not None
    over = (1 / 0.06) * (x_C @ [0.0, 1.0, 0.02])
    under = (1 / 0.06) * (source_C @ np.array([0.0, 1.0, 0.02]))
    met = x_C + ((1 - over) / (under - over))[:, None] * (source_C - x_C)
    beside = np.abs(met[:, 2] - 0.36) < 0.02
    hidden = around.front.hidden_from(x_C, source_C, SHADOW_STEPS)
    assert np.all(hidden[~beside] == (met[:, 2] > 0.36)[~beside])
    assert hidden.any()
    assert not hidden.all()
    assert not around.front.hidden_from(x_C, np.array([-0.2, -0.05, 0.03]), SHADOW_STEPS).any()


def test_the_side_of_a_step_that_nobody_sees_throws_light_on_what_lies_behind() -> None:
    mask, albedo = np.ones((80, 160), bool), 0.6
    seen = sight_of(mask, np.zeros((2, mask.size)))
    near = seen.rays_C[:, 0] < 0
    depth = np.where(near, 0.30, 0.35)
    x_C, n = seen.points_C(depth), np.array([[0.0, 0.0, -1.0]])
    lights = [lamp("right", [0.18, 0.0, 0.03]), lamp("left", [-0.18, 0.0, 0.03])]
    beside = np.flatnonzero(~near & (x_C[:, 0] > 0.012) & (x_C[:, 0] < 0.030) & (np.abs(x_C[:, 1]) < 0.01))
    J, share = interreflected_by_sides(
        x_C[beside], np.repeat(n, len(beside), axis=0), Relief.of(seen, depth), np.full(mask.shape, albedo), lights
    )
    z, y = np.meshgrid(np.linspace(0.30, 0.35, 201), np.linspace(-0.045, 0.045, 361), indexing="ij")
    side_C = np.stack([np.zeros(z.size), y.ravel(), z.ravel()], axis=1)  # the true side of the step, at x = 0, seen edge on by the camera
    to_light = lights[0].source_C - side_C
    shines = albedo * to_light[:, 0] / np.linalg.norm(to_light, axis=1) ** 3
    area = (0.05 / 200) * (0.09 / 360)
    ratios = []
    for p, got, part in zip(x_C[beside], J[0], share, strict=True):
        e = side_C - p
        r = np.linalg.norm(e, axis=1)
        form = np.maximum(-e[:, 2], 0) / r * p[0] / r * area / (np.pi * r**2)
        ratios.append([-got[2] / np.sum(shines * form), part / form.sum()])
    light, blocked = np.mean(ratios, axis=0)
    assert 0.55 < light < 1.2  # which way a side faces is guessed
    assert 0.75 < blocked < 1.1
    assert not J[1].any()  # the left light does not reach it


def bowl_under_lights(reflectance: float) -> tuple[PixelList, Illumination, Array, Array, Mask]:
    """The bowl under six low lights, all bounces in it counted, and the samples that its rim hides: what bounces inside a sphere is the
    same everywhere."""
    seen, depth, n, share = bowl(75.0)
    x_C, angle = seen.points_C(depth), np.arange(6) * np.pi / 3
    sources = np.stack([0.16 * np.cos(angle), 0.16 * np.sin(angle), np.full(6, 0.24)], axis=1)
    to = sources[:, None] - x_C
    r = np.linalg.norm(to, axis=2)
    lit = Illumination(to / r[..., None], 0.07 / r**2)
    at_rim = x_C + ((x_C[:, 2] - x_C[:, 2].min()) / (x_C[:, 2] - 0.24))[None, :, None] * to
    hidden = np.hypot(at_rim[..., 0], at_rim[..., 1]) > 0.06 * np.sin(np.radians(75.0))
    direct = np.where(hidden, 0.0, reflectance * lambert.predicted(lit.B, n))
    received = np.average(direct, axis=1, weights=interreflection._areas(seen, depth, n))[:, None]
    bounced = reflectance * share * received / (1 - reflectance * share)
    rng = np.random.default_rng(3)
    return sight_of(seen.mask, direct + bounced + 2e-3 * rng.standard_normal(direct.shape)), lit, depth, n, hidden


def error_deg(b: Array, n: Array) -> float:
    return float(np.degrees(np.nanmedian(np.linalg.norm(lambert.unit(b)[0] - n, axis=1))))


@pytest.mark.parametrize("reflectance", [0.25, 0.5, 0.8])
def test_shadows_tell_the_reflectance_and_a_bowl_is_no_longer_flattened(reflectance: float) -> None:
    seen, lit, depth, n, hidden = bowl_under_lights(reflectance)
    usable, variance = normals.candidates(seen, lit.E) & ~hidden, normals.variances(seen)
    plain = normals.estimate(seen, lit.B, usable, variance)
    by = interreflection.interreflected(seen, depth, plain, n, [HIGH] * 6)
    found = interreflection.reflectance(seen, by, np.nan_to_num(plain.b), interreflection.in_shadow(seen, lit, n, hidden))
    assert abs(found.median - reflectance) < 0.1
    better = normals.estimate(seen, lit.B + found.per_unit * by.seen, usable, variance)
    assert error_deg(better.b, n) < 0.6 * error_deg(plain.b, n)


def ball_over_a_bright_floor(reflectance: float) -> tuple[PixelList, Illumination, Array, Array, Mask, Patches]:
    """A ball under six near lights, three of which something hides from its lower half; a floor of known radiance throws light on it."""
    row, column = np.indices((70, 70)).reshape(2, -1)
    rays = np.stack([(column - 34.5) / FOCAL, (row - 34.5) / FOCAL, np.ones(len(row))], axis=1)
    centre, radius = np.array([0.0, 0.0, 0.40]), 0.045
    a, b = np.sum(rays**2, axis=1), rays @ centre
    root = b**2 - a * (centre @ centre - radius**2)
    mask = (root > 0.1 * a * radius**2).reshape(70, 70)
    depth = ((b - np.sqrt(np.maximum(root, 0))) / a)[mask.ravel()]
    x_C = depth[:, None] * rays[mask.ravel()]
    n = (x_C - centre) / radius
    angle = np.arange(6) * np.pi / 3 + np.pi / 6
    sources = np.stack([0.16 * np.cos(angle), 0.16 * np.sin(angle), np.full(6, 0.02)], axis=1)
    to = sources[:, None] - x_C
    r = np.linalg.norm(to, axis=2)
    lit = Illumination(to / r[..., None], 0.15 / r**2)
    hidden = np.tile(x_C[:, 1] > 0.005, (6, 1)) & (sources[:, 1] > 0)[:, None]
    radiance = np.where(sources[:, 1] > 0, 0.0, 1.0)  # the lights above shine on the floor, in the units of a signal
    side, spacing = np.linspace(-0.3, 0.3, 121), 0.005
    z, x = np.meshgrid(side + 0.45, side, indexing="ij")
    floor_C = np.stack([x.ravel(), np.full(x.size, 0.06), z.ravel()], axis=1)
    e = floor_C[None] - x_C[:, None]
    far = np.linalg.norm(e, axis=2)
    form = np.maximum(np.einsum("pqi,pi->pq", e, n) / far, 0) * (0.06 - x_C[:, 1])[:, None] / far * spacing**2 / (np.pi * far**2)
    interreflected = radiance[:, None] * form.sum(axis=1)
    clean = reflectance * (np.where(hidden, 0.0, lambert.predicted(lit.B, n)) + interreflected)
    signal = clean + 2e-3 * np.random.default_rng(5).standard_normal(clean.shape)
    up = np.tile([0.0, -1.0, 0.0], (len(floor_C), 1))
    floor = Patches(floor_C, up, np.full(len(floor_C), spacing**2), np.repeat(radiance[:, None], len(floor_C), axis=1))
    return sight_of(mask, signal), lit, depth, n, hidden, floor


@pytest.mark.parametrize("reflectance", [0.2, 0.5, 0.8])
def test_lit_samples_and_a_smooth_surface_tell_the_reflectance(reflectance: float) -> None:
    """Where a shadow ends on a ball, normals would turn by what is not known to be thrown."""
    seen, lit, depth, n, hidden, floor = ball_over_a_bright_floor(reflectance)
    grid, around = Grid.of(seen.mask), Around(floor, None, EMPTY)
    plain = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E) & ~hidden, normals.variances(seen))
    found = alone = field.solve(seen, grid, lit, hidden, plain)
    dark = np.zeros_like(hidden)
    reflects = interreflection.Reflectance(
        interreflection.COMMON, interreflection.COMMON / float(np.median(np.linalg.norm(found.b, axis=1))), 0.0, 0.0
    )
    for _ in range(3):
        by = interreflection.interreflected(seen, depth, replace(plain, b=found.b), n, [HIGH] * 6, around)
        begin = replace(lit, interreflected=reflects.per_unit * by.J(reflects.sides, reflects.beyond))
        evidence = interreflection.LitEvidence(reflects.strengths, *field.strengths_seen(seen, grid, begin, hidden, found, by.parts))
        reflects = interreflection.reflectance(seen, by, found.b, dark, evidence)
        interreflected = reflects.per_unit * by.J(reflects.sides, reflects.beyond)
        found = field.solve(seen, grid, replace(lit, interreflected=interreflected), hidden, found)
    assert abs(reflects.median - reflectance) < 0.12
    assert error_deg(alone.b, n) > 10
    assert error_deg(found.b, n) < 6.2


def test_without_shadows_the_reflectance_is_that_of_common_matter() -> None:
    seen, lit, depth, n, _ = bowl_under_lights(0.8)
    plain = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E), normals.variances(seen))
    by = interreflection.interreflected(seen, depth, plain, n, [HIGH] * 6)
    found = interreflection.reflectance(seen, by, np.nan_to_num(plain.b), np.zeros(seen.signal.shape, bool))
    assert abs(found.median - interreflection.COMMON) < 0.05


def test_a_step_hides_a_light_where_its_shadow_falls() -> None:
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


def test_a_light_that_the_depth_hides_is_left_out() -> None:
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
    whole = Field(np.nan_to_num(plain.b), plain, None)
    before = rounds.State(np.log(depth), np.ones(len(scene.grid.a)), n, plain, Own(np.ones(mask.size), np.log(depth)), lit, whole)
    hidden, _ = rounds.hidden_lights(scene, depth, before, lit)
    assert np.mean(hidden[0] == shadow) > 0.95
    assert not hidden[1:].any()
    better = normals.estimate(seen, lit.B, normals.candidates(seen, lit.E, hidden), normals.variances(seen))
    dark = shadow & hidden[0]
    assert error_deg(plain.b[dark], n[dark]) > 5
    assert error_deg(better.b[dark], n[dark]) < 0.1

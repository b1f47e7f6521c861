"""The compiled kernels beside their twins in numpy: equal to rounding, and the same bytes from any number of threads."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import ndimage

from lpcal.detect import edge_profile, saddle
from lpcal.geometry import camera, lambert, led_cluster, park, raster, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import cuts, integrate, multigrid, pieces
from lpcal.integration.integrate import Grid, system
from lpcal.integration.multigrid import Matrix, Pyramid
from lpcal.kernels import library
from lpcal.kernels.library import SWITCH, kernel
from lpcal.segmentation import ambient_sample_costs, cut, layers, plane_hough, planes, sample_costs
from lpcal.shading import field, gloss, normals
from lpcal.shading.normals import Estimate
from lpcal.surface import distance, interreflection
from lpcal.surface.relief import Relief, _entries
from lpcal.surface.surroundings import Patches
from lpcal.view.coarse import LightTable, RoomPrior, coarse_of
from lpcal.view.pixel_list import Illumination, PixelList, SignalMaps

PIXEL_OF_RAY = np.array([[40.0, 30.0], [100.0, 2.0], [-1.0, 100.0], [0.1, 0.2], [0.3, 0.1], [0.2, 0.1]])


def points(rng: np.random.Generator, count: int) -> Array:
    z = 0.3 + 0.05 * rng.random(count)
    return np.stack([z * 0.9 * (rng.random(count) - 0.5), z * 0.7 * (rng.random(count) - 0.5), z], axis=1)


def relief(rng: np.random.Generator) -> Relief:
    front = 0.3 + 0.02 * rng.random((60, 80))
    front[:10] = np.inf
    return Relief(front, PIXEL_OF_RAY)


def patches(rng: np.random.Generator, count: int) -> Patches:
    return Patches(points(rng, count), lambert.unit(rng.normal(size=(count, 3)))[0], 1e-5 * rng.random(count), rng.random((5, count)))


def hidden(rng: np.random.Generator) -> Array:
    return relief(rng).hidden(points(rng, 4000), 1.2 * points(rng, 4000), 24).astype(float)


def behind(rng: np.random.Generator) -> Array:
    return relief(rng).behind(np.concatenate([points(rng, 4000), [[0.0, 0.0, 0.0], [1e30, 0.0, 1.0], [np.nan, 0.0, 1.0]]]))


def entries(rng: np.random.Generator) -> Array:
    places = np.concatenate([points(rng, 3000), points(rng, 1000) * [1, 1, 1.1]])
    at, y_C = _entries(places, lambert.unit(rng.normal(size=(4000, 3)))[0], relief(rng))
    return np.concatenate([at.astype(float), y_C.ravel()])


def received(rng: np.random.Generator) -> Array:
    return interreflection._received(patches(rng, 200), patches(rng, 150), relief(rng))


def shading(rng: np.random.Generator, lights: int = 6, pixels: int = 800) -> tuple[Array, Array, Mask, Array]:
    B = rng.normal(size=(lights, pixels, 3))
    B[:, :50] = B[:1, :50]  # lights of one direction span nothing
    signal = lambert.predicted(B, rng.normal(size=(pixels, 3))) + 0.02 * rng.normal(size=(lights, pixels))
    return signal, B, rng.random((lights, pixels)) < 0.8, 4e-4 * (1 + rng.random((lights, pixels)))


def weighted(rng: np.random.Generator) -> Array:
    signal, B, usable, variance = shading(rng)
    b, inverse = lambert.weighted(B, signal, usable / variance)
    return np.concatenate([b.ravel(), inverse.ravel()])


def few(rng: np.random.Generator) -> Array:
    found = []
    for lights in (3, 5, 8):
        signal, B, usable, variance = shading(rng, lights)
        of = normals._few(signal, B, usable, variance, np.concatenate([0.3 * rng.normal(size=(800, 2)), np.ones((800, 1))], axis=1))
        good = np.isfinite(of.b[:, :1])
        found += [of.b, np.where(good, of.inliers.T, 0.0), np.where(good, of.covariance.reshape(-1, 9), 0.0), of.chi2, of.cost]
    return np.concatenate([each.ravel() for each in found])


def field_cases(rng: np.random.Generator) -> tuple[PixelList, Array, list[tuple[Illumination, Mask | None, gloss.Gloss | None]]]:
    """Samples and b (P, 3), and light with what hides it and gloss: near and distant, with and without light of other surfaces."""
    signal, B, usable, variance = shading(rng, pixels=500)
    d, E = lambert.unit(B)
    b, v, dark = rng.normal(size=(500, 3)), lambert.unit(rng.normal(size=(500, 3)))[0], rng.random(signal.shape) < 0.2
    seen = PixelList(np.ones((20, 25), bool), -v, signal, np.sqrt(variance), usable, True)
    plain, more = Illumination(d, E), Illumination(d, E, 0.1 * rng.normal(size=d.shape))
    far = Illumination(np.broadcast_to(d[:, 60:61], d.shape), np.broadcast_to(E[:, 60:61], E.shape), more.interreflected)
    cases: list[tuple[Illumination, Mask | None, gloss.Gloss | None]] = [(plain, None, None), (more, dark, None)]
    cases += [(plain, dark, gloss.Gloss(0.3, 0.2, 0.5)), (more, None, gloss.Gloss(0.1, 0.4, 0.5)), (far, dark, gloss.Gloss(0.1, 0.4, 0.5))]
    return seen, b, cases


def gathered(rng: np.random.Generator) -> Array:
    seen, b, cases = field_cases(rng)
    found = [field._gathered(seen, lit, b, -seen.rays_C, dark, shine, warm) for lit, dark, shine in cases for warm in (1.0, 4.0)]
    return np.concatenate([part.ravel() for each in found for part in each])


def agreeing(rng: np.random.Generator) -> Array:
    seen, b, cases = field_cases(rng)
    b = b + 0.05 * rng.normal(size=b.shape)
    of_case = [field._by_pixels(seen, lit, b, -seen.rays_C, dark, shine) for lit, dark, shine in cases]
    found = []
    for of in of_case:
        good = np.isfinite(of.b[:, :1])
        shown = np.zeros_like(seen.signal) if of.gloss is None else of.gloss
        found += [of.b, of.inliers.T, np.where(good, of.covariance.reshape(-1, 9), 0.0), np.where(good[:, 0], of.chi2, 0.0), of.cost, shown]
    return np.concatenate([each.ravel() for each in found])


def evidence(rng: np.random.Generator) -> Array:
    seen, b, cases = field_cases(rng)
    parts = 0.1 * rng.normal(size=(3, *seen.signal.shape, 3))
    found = [field._evidence(seen, lit, dark, field.Field(b, Estimate.nothing(), shine), parts) for lit, dark, shine in cases]
    return np.concatenate([part.ravel() for each in found for part in each])


def links(rng: np.random.Generator) -> Array:
    grid, b = Grid.of(rng.random((30, 40)) < 0.9), rng.normal(size=(1200, 3))
    b = b[: len(grid.rows)]
    b[::3] = b[0]  # alike, and b of nothing
    b[::50] = 0.0
    system = field._System.at(grid, b, rng.normal(size=(len(b), 3, 3)))
    return np.concatenate([np.minimum(each.ravel(), 1e6) for each in (system.link, system.block)])


def lobe(rng: np.random.Generator) -> Array:
    d, n, v = (lambert.unit(rng.normal(size=(*shape, 3)))[0] for shape in ((5, 300), (300,), (300,)))
    return np.concatenate([gloss.lobe(d, n, v, roughness).ravel() for roughness in (0.06, 0.5)])


def unexplained(rng: np.random.Generator) -> Array:
    signal, B, usable, variance = shading(rng, 9, 300)
    return np.concatenate([each.ravel() for each in gloss._unexplained(signal, rng.random(signal.shape), usable + 0.0, variance, B)])


def lobe_costs(rng: np.random.Generator) -> Array:
    left, own = 1e-3 * rng.normal(size=(2, 19, 300))
    weight, spread2 = (rng.random(left.shape) < 0.9) + 0.0, 10.0 ** rng.uniform(-12, -4, left.shape)
    return np.concatenate([gloss._costs(left, own, np.geomspace(0.01, 1, 7), weight, spread2, doubt).ravel() for doubt in (0.0, 0.2)])


def two_labels(rng: np.random.Generator) -> Array:
    said = np.clip(3 * rng.normal(size=(70, 90)), -2, 2).astype(np.float32)
    said[20:40, 30:70], said[45:60] = 5.0, -5.0  # nothing moves what is as sure
    free = ndimage.binary_dilation(np.abs(said) < 5, np.ones((3, 3)), iterations=2)
    return cut._relaxed(said, rng.random((70, 89), np.float32), rng.random((69, 90), np.float32), free).astype(float)


def many_labels(rng: np.random.Generator) -> Array:
    return layers._relaxed(60 * rng.random((5, 40, 70)), *layers.boundary(rng.random((40, 70))))


def many(rng: np.random.Generator) -> Array:
    rays_C = rng.normal(loc=[0, 0, 1], scale=0.3, size=(203, 3))
    found = [normals._many(*shading(rng, lights, 203), rays_C) for lights in (9, 24, 96)]
    return np.concatenate([part.ravel() for one in found for part in (one.b, one.inliers, one.covariance, one.chi2, one.cost)])


def connected(rng: np.random.Generator) -> Array:
    mask = rng.random((60, 70)) < 0.8
    grid = Grid.of(mask)
    return pieces.connected(grid, rng.random(len(grid.a)) > 0.37).astype(float)


def cheapest_cut(rng: np.random.Generator) -> Array:
    found = []
    for strength in (0.1, 1.0):
        grid = Grid.of(rng.random((60, 70)) < 0.8)
        found.append(cuts.cheapest(grid, strength * rng.standard_normal(len(grid.rows)), rng.exponential(size=len(grid.a))))
    return np.concatenate(found).astype(float)


def masks(rng: np.random.Generator) -> list[Mask]:
    lines = ndimage.binary_dilation(rng.random((50, 60)) < 0.01, np.ones((1, 9)))
    return [rng.random((50, 60)) < share for share in (0.0, 0.003, 0.5, 0.7, 1.0)] + [lines, lines.T, lines[:, :1], lines[:1]]


def labelled(rng: np.random.Generator) -> Array:
    return np.concatenate([np.append(label.ravel(), count) for label, count in map(raster.connected_components, masks(rng))]).astype(float)


def nearest(rng: np.random.Generator) -> Array:
    some = masks(rng)
    return np.concatenate(
        [each.ravel() for one in some for each in (raster.nearest(one).astype(float), np.minimum(raster.distance_to(one), 99))]
    )


def blurred(rng: np.random.Generator) -> Array:
    pictures = [rng.random(shape) for shape in ((40, 300), (3, 2), (1, 1), (7,), (9, 8, 5))]
    found = [raster.gaussian_filtered(one, by, border) for one in pictures for by in (0.0, 0.4, 3.0) for border in raster.BORDERS]
    uneven = raster.gaussian_filtered(pictures[-1], (0.5, 2.0, 1.0))
    return np.concatenate([each.ravel() for each in (*found, uneven, *(raster.box_filtered(one, 5) for one in pictures))])


def blurred_singles(rng: np.random.Generator) -> Array:
    return np.concatenate([raster.gaussian_filtered(rng.random((60, 270), np.float32), by, "nearest").ravel() for by in (0.5, 20.0)])


def thrown_fits(rng: np.random.Generator) -> Array:
    parts, signal = rng.random((3, 900)), rng.random(900)
    return interreflection._fits(rng.random((30, 3)), parts, signal, 1e-3 * (0.1 + rng.random(900)), 1 + rng.random(900))


def between(rng: np.random.Generator) -> Array:
    return planes.between(rng.random((12, 12, 5)), 11 * rng.random((300, 2))).ravel()


def misfit(rng: np.random.Generator) -> Array:
    found = []
    for lights in (2, 3, 6, 9):
        signal, _, usable, variance = shading(rng, lights)
        seen = PixelList(np.ones((20, 40), bool), rays(rng, 800), signal, np.sqrt(variance), usable, True)
        m = np.where(rng.random(800) < 0.1, np.nan, np.maximum(signal * rng.uniform(0.6, 1.2, signal.shape), 0.0))
        found += [np.minimum(each, 1e3) for shaded in (True, False) for each in planes.misfit(seen, m, shaded=shaded)]
    return np.concatenate(found)


def own_distance(rng: np.random.Generator) -> Array:
    signal, B, usable, variance = shading(rng, 9)  # of three lights alone rounding is all that is left
    slope, b = 0.3 * B + 0.1 * rng.normal(size=B.shape), lambert.weighted(B, signal, usable / variance)[0]
    found = Estimate(b, usable, np.empty((800, 3, 3)), np.empty(800), np.empty(800))
    seen = PixelList(np.ones((20, 40), bool), rays(rng, 800), signal, np.sqrt(variance), usable, True)
    depth, shine = rng.uniform(0.2, 0.5, 800), 0.1 * rng.random(signal.shape)
    owns = [distance._own(B, slope, depth, seen, one) for one in (found, replace(found, gloss=shine))]
    return np.concatenate([each.ravel() for own in owns for each in (np.log(own.curvature), own.optimum)])


def field_table(rng: np.random.Generator) -> LightTable:
    smooth = 1 + 0.1 * np.sin(np.arange(40)[:, None, None] * 0.1 + 6 * rng.random((700, 1, 5, 3)))
    return LightTable(np.log(0.1), 0.05, (smooth * [0.2, -0.3, -1.0]).astype(np.float32), 0.1 * rng.random((700, 40, 5), np.float32))


def explained(rng: np.random.Generator) -> tuple[Any, ...]:
    signal, B, usable, variance = shading(rng, 5, 700)
    return np.abs(signal), np.sqrt(variance), usable, B, 0.1 * rng.random(signal.shape, np.float32)


def free(rng: np.random.Generator) -> Array:
    return np.concatenate([each.ravel() for each in sample_costs.free(*explained(rng))])


def planar(rng: np.random.Generator) -> Array:
    signal, sigma, usable, _, doubt = explained(rng)
    m = np.maximum(signal * rng.uniform(0.7, 1.4, signal.shape) - 0.1, 0.0)
    return np.concatenate([each.ravel() for each in sample_costs.planar(signal, sigma, usable, m, doubt)])


def in_room(rng: np.random.Generator) -> tuple[tuple[Any, ...], RoomPrior]:
    """Samples of lights from the viewer's side: of fewer that reach a pixel rounding is all that the solves leave."""
    B = lambert.unit(rng.normal(size=(9, 700, 3)) - [0, 0, 2.5])[0]
    b = rng.uniform(0.2, 1.0, (700, 1)) * lambert.unit(0.4 * rng.normal(size=(700, 3)) - [0, 0, 1])[0]
    room = RoomPrior(rng.uniform(0.8, 1.2, 9), 0.4)
    signal = lambert.predicted(B, b) + 0.3 * room.share[:, None] * rng.random(700) + 0.01 * rng.normal(size=(9, 700))
    return (signal, np.full(signal.shape, 0.01), rng.random(signal.shape) < 0.95, B, 0.1 * rng.random(signal.shape, np.float32)), room


def room_free(rng: np.random.Generator) -> Array:
    given, room = in_room(rng)
    found = ambient_sample_costs.free(*given, room)
    return np.concatenate([each.ravel() for each in (found.b, found.A, found.cost / 10, found.information)])


def room_planar(rng: np.random.Generator) -> Array:
    (signal, sigma, usable, _, doubt), room = in_room(rng)
    m = np.maximum(signal * rng.uniform(0.7, 1.4, signal.shape) - 0.1, 0.0)
    return np.concatenate([each.ravel() for each in ambient_sample_costs.planar(signal, sigma, usable, m, doubt, room)])


def rays(rng: np.random.Generator, count: int) -> Array:
    return np.concatenate([0.3 * rng.normal(size=(count, 2)), np.ones((count, 1))], axis=1)


def white(rng: np.random.Generator) -> Array:
    found = [
        plane_hough.white(np.array(q), rays(rng, 500), rng.permutation(700)[:500], field_table(rng)) for q in ([1, 0.5, 4], [9, 0, 3.0])
    ]
    return np.concatenate([each.ravel() for pair in found for each in pair])


def plane(rng: np.random.Generator) -> Array:
    table, signal = field_table(rng), 5 * rng.random((5, 400))
    weight = np.where(rng.random((5, 400)) < 0.8, 1 / (0.1 + signal), 0.0)
    fit = plane_hough._Fit(rays(rng, 400), rng.permutation(700)[:400], table, signal, weight, None, np.ones(400))
    found = [fit.equations(np.array(q)) for q in ([1, 0.5, 4], [9, 0, 3.0])]
    return np.concatenate([np.ravel(each) for one in found for each in (one.loss / 100, one.gradient / 1e3, one.curvature / 1e3)])


def cubic(rng: np.random.Generator) -> Array:
    table = LightTable(np.log(0.1), 0.05, rng.random((700, 40, 5, 3), np.float32), rng.random((700, 40, 5), np.float32))
    some = rng.permutation(700)[:500]
    B, doubt = table.at(np.log(0.08) + 2.5 * rng.random(500), some)
    of_some = table.at_pixels(some).at(np.full(250, -1.0), np.arange(500)[::2])[0]
    rising = table.slope(np.log(0.08) + 2.5 * rng.random(500), some)
    return np.concatenate([B.ravel(), doubt.ravel(), of_some.ravel(), rising.ravel() / 20])


def solved(rng: np.random.Generator) -> Array:
    y, x = np.indices((90, 100))
    grid = Grid.of((x - 50) ** 2 + (y - 45) ** 2 < 40**2 + 200 * np.sin(x))
    weight = rng.random(len(grid.a)) ** 4 + 1e-6
    pixels = len(grid.rows)
    A, right = system(grid, weight, rng.normal(size=len(weight)), np.full(pixels, 1e-3), rng.normal(size=pixels))
    one_level = Matrix(Pyramid.of(grid.rows[:150], grid.columns[:150]), np.ones(150), np.ones(0))
    one_level = replace(one_level, weight=weight[: len(one_level.pyramid.levels[0].a)])
    few = multigrid.solve(one_level, right[:150], np.zeros(150), precision=1e-13)
    alone = Matrix(Pyramid.of(np.arange(0, 1800, 2), np.arange(0, 1800, 2)), 1 + rng.random(900), np.ones(0))  # nothing touches
    found = [multigrid.solve(A, right, np.zeros(pixels), precision=1e-12), few]
    return np.concatenate([*found, multigrid.solve(alone, right[:900], np.zeros(900), precision=1e-13)])


def integrated(rng: np.random.Generator) -> Array:
    y, x = np.indices((60, 70))
    grid = Grid.of((x - 35) ** 2 + (y - 30) ** 2 < 27**2 + 200 * np.sin(x / 3))
    rays = np.stack([(grid.columns - 35) / 300, (grid.rows - 30) / 300, np.ones(len(grid.rows))], axis=1)
    n = lambert.unit(np.stack([*rng.normal(scale=0.3, size=(2, len(rays))), np.full(len(rays), -1.0)], axis=1))[0]
    step = integrate.steps(grid, n, rays, central=True, tilt_rad=0.1 * rng.random(len(rays)))
    behind = 0.1 * (grid.columns > 40)
    own = integrate.Own(1e4 * (1 + rng.random(len(rays))), behind + rng.normal(scale=0.01, size=len(rays)))
    start = rng.normal(scale=0.02, size=len(rays))
    step = replace(step, break_cost=1 + 20 * rng.random(len(grid.a)))
    sure = replace(step, sigma=1e-3 * step.sigma)
    found = [integrate.integrate(grid, one, own, start, graduated=fresh) for fresh, one in ((True, step), (False, sure))]
    return np.concatenate([step.value, np.log(step.sigma), *(each for pair in found for each in pair)])


def coupled(rng: np.random.Generator) -> Array:
    y, x = np.indices((40, 50))
    grid = Grid.of((x - 25) ** 2 + (y - 20) ** 2 < 18**2 + 100 * np.sin(x))
    b = rng.normal(size=(len(grid.rows), 3))
    own = np.einsum("pki,pkj->pij", *[rng.normal(size=(len(b), 4, 3))] * 2)
    return field._System.at(grid, b, own).solved(rng.normal(size=b.shape), b).ravel()


def cluster(rng: np.random.Generator) -> Array:
    axes = led_cluster.led_axes(19)
    x_L = np.concatenate([rng.normal(size=(997, 3)) * 0.2 + [0, 0, 0.3], [[0.2, 0.1, -0.3]]])  # all round it, and one behind
    power = rng.uniform(0.9, 1.1, 19)
    m = led_cluster.exponent(led_cluster.HALF_POWER_RAD)
    found = [led_cluster.cluster_field(at, 0.01 * axes, axes, power, m) for at in (x_L, x_L[:5])]
    return np.concatenate([each.ravel() for d, E in found for each in (d, np.log(np.maximum(E, 1e-280)) / 600)])


def cluster_single(rng: np.random.Generator) -> Array:
    axes = led_cluster.led_axes(19)
    x_L = rng.normal(size=(997, 3)) * [0.2, 0.2, 0.1] + [0, 0, 0.4]
    m = led_cluster.exponent(led_cluster.HALF_POWER_RAD)
    d, E = led_cluster.cluster_field(x_L, 0.01 * axes, axes, rng.uniform(0.9, 1.1, 19), m, single=True)
    return np.concatenate([d.ravel(), np.log(E + 1e-3)])  # of the light, not of the brightest: log


def cluster_slope(rng: np.random.Generator) -> Array:
    axes = led_cluster.led_axes(19)
    x_L = np.concatenate([rng.normal(size=(997, 3)) * 0.05 + [0, 0, 0.3], [[0.2, 0.1, -0.3]]])
    return led_cluster.cluster_slope(x_L, 0.01 * axes, axes, rng.uniform(0.9, 1.1, 19), 40.0).ravel()


def undistort(rng: np.random.Generator) -> Array:
    lens = np.array([-0.3, 0.12, 1e-3, -2e-3, 0.01])
    return camera.undistort(rng.uniform(-0.4, 0.4, (20, 30, 2)), lens).ravel()


def rotations(rng: np.random.Generator, *shape: Any) -> Array:
    return se3.exp(np.concatenate([rng.normal(size=(*shape, 3)), np.zeros((*shape, 3))], axis=-1))


def turns(rng: np.random.Generator) -> Array:
    one, other = (rotations(rng, 40, 9)[..., :3, :3] for _ in range(2))
    one[0] = one[0, 0]  # no turn at all
    other[1, 0] = other[1, 1] @ np.diag([1.0, -1.0, -1.0])  # half a turn
    return np.concatenate([park._rotations(one, other).ravel(), park._rotations(one[3], other[3]).ravel()])


def misses(rng: np.random.Generator) -> Array:
    return np.concatenate([each.ravel() for each in park._misses(*(rotations(rng, count) for count in (30, 30, 20, 20)))])


def distort(rng: np.random.Generator) -> Array:
    found, J = camera._distort_with_jacobian(rng.normal(size=(2, 500, 2)), np.array([-0.3, 0.12, 1e-3, -2e-3, 0.01, 0.02, 0.03, 0.001]))
    return np.concatenate([found.ravel(), J.ravel()])


def blocks(rng: np.random.Generator) -> Array:
    shape = (3, 45, 61)
    signal, sigma = rng.random(shape, np.float32), 0.1 + rng.random(shape, np.float32)
    maps = SignalMaps(signal, sigma, rng.random(shape) > 0.02)
    images = [coarse_of(maps, rng.random((*shape[1:], 3)), factor) for factor in (1, 4)]
    return np.concatenate([each.ravel() for one in images for each in (one.signal, one.sigma, one.usable, one.rays_C)])


def crossing(rng: np.random.Generator, count: int) -> tuple[Array, Array]:
    """A picture of blurred squares' corners, in steps of 255, and where they are."""
    places = np.stack([20.0 + 25 * (np.arange(count) % 10), 20.0 + 25 * (np.arange(count) // 10)], axis=1) + rng.random((count, 2))
    y, x = np.indices((int(places[:, 1].max()) + 20, 270))
    near = np.hypot(x[..., None] - places[:, 0], y[..., None] - places[:, 1]).argmin(axis=-1)
    u, v = x - places[near, 0], y - places[near, 1]
    light = 120 + 80 * np.tanh((u + 0.2 * v) / 1.5) * np.tanh((v - 0.1 * u) / 1.5) + rng.normal(size=x.shape)
    return light.astype(np.float32), places


def ring(rng: np.random.Generator) -> Array:
    light, places = crossing(rng, 40)
    asked = np.concatenate([places, [[270.0, 100.0], [-3.0, 5.0], [np.nan, 4.0]], rng.random((300, 2)) * [269, 100]])
    return np.concatenate(saddle.likeness(light, asked, np.full(len(asked), 3.5)))


def curved(rng: np.random.Generator) -> Array:
    light = np.rint(crossing(rng, 40)[0])
    at, strength = saddle._greatest(light)
    inner = strength.reshape(light.shape)[1:-1, 1:-1]
    return np.concatenate([at.astype(float), inner.ravel()])


def moved(rng: np.random.Generator) -> Array:
    light = np.rint(crossing(rng, 40)[0])
    return np.concatenate([each.ravel() for each in saddle._moved(light, saddle._greatest(light)[0])])


def saddles(rng: np.random.Generator) -> Array:
    light, places = crossing(rng, 60)
    start, angles = places + 0.4 * (rng.random(places.shape) - 0.5), np.tile([0.1, 1.75], (len(places), 1))
    return np.concatenate([each.ravel() for each in saddle._fit(light, start, angles, 7)])


def slid(rng: np.random.Generator) -> Array:
    step, radius = edge_profile.STEP_PX, 40.0
    s = np.arange(-8.5, 8.5 + step / 2, step)
    edges = np.tanh((s - rng.uniform(-1.5, 1.5, (50, 1))) / 0.8) + 0.1 * rng.normal(size=(50, len(s)))
    window = edge_profile._Window(edges, s, np.linspace(-2.5, 2.5, 51), 2.8 + step / 2, 6.0 + step / 2)
    assert window._slid is not None
    assert edge_profile._Window(edges, s, np.linspace(-2.5, 2.5, 48), 2.8 + step / 2, 6.0 + step / 2)._slid is None
    kinds = [window.misfits(lambda at, kind=kind: edge_profile._edge_terms(at, 0.9, kind, radius, step)) for kind in ("chrome", "matte")]
    return np.concatenate([each.ravel() for each in (*kinds, window.misfits(edge_profile._smooth_terms))])


CASES: dict[Callable, tuple[float, set[str]]] = {
    hidden: (0.0, {"hidden"}),
    behind: (1e-13, {"behind"}),
    entries: (0.0, {"behind", "entries"}),
    received: (1e-13, {"received"}),
    weighted: (1e-9, {"weighted"}),
    few: (1e-9, {"few"}),
    lobe: (1e-12, {"lobe"}),
    two_labels: (0.0, {"two_labels"}),
    many_labels: (0.0, {"many_labels"}),
    unexplained: (1e-8, {"unexplained"}),
    lobe_costs: (1e-12, {"lobe_costs"}),
    many: (1e-8, {"many", "weighted"}),
    gathered: (1e-10, {"gathered"}),
    agreeing: (1e-7, {"agreeing", "lobe", "weighted"}),
    evidence: (1e-10, {"evidence", "lobe"}),
    links: (1e-12, {"links"}),
    coupled: (1e-9, {"coupled"}),
    cubic: (1e-13, {"cubic"}),
    between: (1e-12, {"lattice"}),
    thrown_fits: (1e-12, {"thrown_fits"}),
    connected: (0.0, {"connected"}),
    cheapest_cut: (0.0, {"cheapest_cut"}),
    labelled: (0.0, {"labelled"}),
    nearest: (0.0, {"nearest"}),
    blurred: (1e-14, {"joined"}),
    blurred_singles: (0.0, {"joined_singles"}),
    misfit: (1e-12, {"misfit"}),
    own_distance: (1e-7, {"own_distance", "weighted"}),
    free: (1e-8, {"free"}),
    planar: (1e-9, {"planar"}),
    room_free: (1e-6, {"room_free"}),
    room_planar: (1e-9, {"room_planar"}),
    white: (1e-12, {"white"}),
    plane: (1e-9, {"plane"}),
    cluster: (1e-12, {"cluster"}),
    turns: (1e-10, {"turns"}),
    misses: (1e-13, {"misses"}),
    distort: (1e-13, {"distort"}),
    undistort: (0.0, {"distort", "undistort"}),
    cluster_single: (1e-5, {"cluster_single"}),
    cluster_slope: (1e-5, {"cluster_slope"}),
    blocks: (0.0, {"blocks", "block_means"}),
    slid: (1e-12, {"slid"}),
    curved: (0.0, {"curved"}),
    moved: (1e-13, {"curved", "moved"}),
    ring: (1e-12, {"ring"}),
    saddles: (1e-6, {"saddles"}),
    solved: (1e-8, {"multigrid"}),
    integrated: (1e-4, {"integrated", "steps"}),
}
"""Each kernel's work, the share of the largest value by which the twin may differ (of badly conditioned sums rounding makes more), and the
kernels that it calls."""


def test_every_kernel_is_held_against_its_twin() -> None:
    assert set.union(*(names for _, names in CASES.values())) == set(library.SIGNATURES)


@pytest.mark.parametrize("work", CASES, ids=lambda work: work.__name__)
@pytest.mark.filterwarnings("ignore:(divide|invalid|overflow)")
def test_a_kernel_does_what_its_twin_does(work: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    assert all(kernel(name) for name in CASES[work][1]), "the library is not built: uv sync --reinstall-package lpcal"
    compiled = work(np.random.default_rng(3))
    monkeypatch.setenv(SWITCH, "numpy")
    assert kernel("hidden") is None
    twin = work(np.random.default_rng(3))
    np.testing.assert_allclose(compiled, twin, rtol=0, atol=CASES[work][0] * np.nanmax(np.abs(twin)))
    assert np.isfinite(twin).mean() > 0.7
    assert np.ptp(twin[np.isfinite(twin)]) > 0


@pytest.mark.parametrize("work", CASES, ids=lambda work: work.__name__)
def test_threads_change_no_byte(work: Callable[..., Any]) -> None:
    with ThreadPoolExecutor(4) as pool:
        found = {one.tobytes() for one in pool.map(lambda _: work(np.random.default_rng(3)), range(4))}
    assert found == {work(np.random.default_rng(3)).tobytes()}


@pytest.mark.parametrize("work", CASES, ids=lambda work: work.__name__)
def test_wider_vectors_change_no_byte(work: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    if not library.built(library.WIDE).exists():
        pytest.skip("no library for wider vectors on this machine")
    found = work(np.random.default_rng(3))
    monkeypatch.setattr(library, "WIDE", "-none")
    monkeypatch.setattr(library, "_loaded", library._loaded.__wrapped__)
    assert work(np.random.default_rng(3)).tobytes() == found.tobytes()


@pytest.mark.parametrize(
    "wrong",
    [
        lambda a: (4, a.astype(np.float32), a, 1),
        lambda a: (4, a[:, ::2], a, 1),
        lambda a: (4.5, a, a, 1),
        lambda a: (4, a.tolist(), a, 1),
    ],
    ids=["type", "strides", "number", "list"],
)
def test_what_a_kernel_is_given_is_checked(wrong: Callable[..., Any]) -> None:
    found = np.zeros(4, bool)
    with pytest.raises(ctypes.ArgumentError):
        kernel("hidden")(*wrong(np.ones((4, 6))), 2, 2, np.ones((2, 2)), PIXEL_OF_RAY, 0.1, 0.2, found)


def test_a_library_of_other_sources_is_not_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for path in library.sources():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / library.built().name).write_bytes(library.built().read_bytes())
    monkeypatch.setattr(library, "FOLDER", tmp_path)
    assert library._loaded.__wrapped__()
    (tmp_path / "relief.c").write_text("/* another */", encoding="utf-8")
    assert not library._loaded.__wrapped__()


def test_a_system_of_nothing_is_solved_by_nothing() -> None:
    grid = Grid.of(np.ones((6, 7), bool))
    b, nothing = np.ones((42, 3)), np.zeros((42, 3))
    assert not field._System.at(grid, b, np.tile(np.eye(3), (42, 1, 1))).solved(nothing, nothing).any()

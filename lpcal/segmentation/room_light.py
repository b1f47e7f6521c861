r"""How much light of the room a capture holds that has no image without lights: over wall, support and object alike.

At a coarse scale all that is seen is explained as matter of any normal, as planes or as a place that no lamp reaches, at one level of the
room's light after another (see segmentation.room_samples); the level at which all together cost least is that of the room, and each pixel's
best explanation says what it holds of it. What is left without it is seen as a capture whose room light was taken away.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry.arrays import Array, Image
from lpcal.records.calibration import Light
from lpcal.segmentation import flats, layers, room_samples
from lpcal.segmentation.samples import LIT_SIGMAS
from lpcal.view.coarse import Coarse, LightTable, RoomPrior, coarse_of, factor_of
from lpcal.view.sight import Grey, second, strength

FEW_PIXELS, PIXELS = 1300, 5200
"""Coarse pixels at which levels are tried, and at which the room's light is mapped."""
LEVELS = (0.005, 0.015, 0.045, 0.13, 0.4, 1.2)
"""Levels tried, in units of a lamp's irradiance at the working distance: from one that no camera sees to a lit room."""
RARE_ROUNDS = 2
"""Times that the cost of each explanation is set by how rare it is: a plane that holds a few pixels by chance then spares nothing."""
USUAL, USUAL_STD = 0.1, 1.3
"""The level of common rooms in these units and the standard deviation of its logarithm: the prior, where pictures show next to nothing."""
SHARED = 60.0
"""Pixels or samples whose errors are alike: what the explanations of the room's light lack is smooth over a surface."""
UNSURE = 0.1
"""Share of the room's light at a pixel that is left in doubt: how far it was off on simulated scenes, besides level and albedo."""


@dataclass(frozen=True)
class RoomLight:
    """The room's light in a picture."""

    room: RoomPrior
    level_std: float
    """Standard deviation of the logarithm of the level."""
    A: Image
    """(H, W) of every pixel, in units of the signals."""


def found(maps: Grey, rays_C: Array, lights: Sequence[Light], distance_m: float) -> RoomLight:
    """The room's light of a picture with lights near the object, which is at about a distance."""
    share = np.array([1 / light.intensity.mean() for light in lights])
    few = coarse_of(maps, rays_C, factor_of(maps, FEW_PIXELS))
    table = LightTable.of(few, lights, distance_m)
    unit = float(np.median(np.linalg.norm(table.at(np.full(len(few.rays_C), np.log(distance_m)), np.arange(len(few.rays_C)))[0], axis=2)))

    def cost(level: float) -> float:
        each = _explained(few, RoomPrior(share, level * unit), table, distance_m, drawn=False)[0]
        return each * len(few.rays_C) / SHARED + (np.log(level / USUAL) / USUAL_STD) ** 2

    level, level_std = _cheapest(cost)
    room = RoomPrior(share, unit * level)
    image = coarse_of(maps, rays_C, factor_of(maps, PIXELS))
    _, A = _explained(image, room, LightTable.of(image, lights, distance_m), distance_m, drawn=True)
    return RoomLight(room, level_std, _spread(A, image, share, maps))


def taken_away(maps: Grey, light: RoomLight) -> Grey:
    """The maps without a room's light, its doubt counted as noise."""
    ambient = light.room.share[:, None, None].astype(np.float32) * light.A
    return Grey(maps.signal - ambient, np.hypot(maps.sigma, np.float32(UNSURE) * ambient), maps.usable)


def _explained(seen: Coarse, room: RoomPrior, table: LightTable, distance_m: float, *, drawn: bool) -> tuple[float, Array]:
    """Mean cost of the coarse pixels at the room's level, and A (P,) by each pixel's best explanation.

    `drawn`: by that which a map of labels drawn with few boundaries gives it, of all depths; else by half the depths.
    """
    image = replace(seen, room=room)
    everywhere = np.arange(len(image.rays_C))
    swept = flats.sweep(image, table, distance_m, 1 if drawn else 2)
    least = room_samples.lowest(image.signal, image.usable, room)
    over = image.signal - room.share[:, None] * least > LIT_SIGMAS * image.sigma
    lit = np.sum(over & image.usable, axis=0) >= 2
    best = np.argmin(swept.cost, axis=0)
    B, doubt = table.at(swept.u[best], everywhere)
    free = room_samples.free(image.signal, image.sigma, image.usable, B, doubt, room)
    costs, ambient = [free.cost + layers.FREE_PRICE], [free.A]
    for q in flats.find(image, table, swept, lit, distance_m):
        m, doubt = flats.white(q, image.rays_C, everywhere, table)
        cost, _, _, A = room_samples.planar(image.signal, image.sigma, image.usable, m, doubt, room)
        costs.append(cost)
        ambient.append(A)
    E = np.linalg.norm(table.at(np.full(len(everywhere), np.log(distance_m)), everywhere)[0], axis=2)
    bright = np.max(np.where(image.usable, image.signal / np.maximum(E, 1e-12), 0.0), axis=0)
    around = np.median(bright[lit]) * E if lit.any() else np.median(bright) * E
    cost, A = room_samples.nothing(image.signal, image.sigma, image.usable, around, room)
    every, each = np.stack([*costs, cost]), np.stack([*ambient, A])
    for _ in range(RARE_ROUNDS):
        part = np.bincount(np.argmin(every, axis=0), minlength=len(every)) / every.shape[1]
        every = np.stack([*costs, cost]) - 2 * np.log(np.maximum(part, 1 / every.shape[1]))[:, None]
    bounded = np.minimum(every, every.min(axis=0) + layers.CEILING).reshape(-1, *image.shape)
    labels = layers.cheapest(bounded, *layers.boundary(strength(image.maps))) if drawn else np.argmin(bounded, axis=0)
    return float(every.min(axis=0).mean()), each[labels.ravel(), everywhere]


def _cheapest(cost: Callable[[float], float]) -> tuple[float, float]:
    """The level of least cost, twice a negative log likelihood, and the standard deviation of its logarithm.

    Of LEVELS first, then half way to the neighbours of the best, then by the parabola through the best and its neighbours.
    """
    tried = {level: cost(level) for level in LEVELS}
    for again in (True, False):
        levels = sorted(tried)
        k = min(max(levels.index(min(levels, key=tried.__getitem__)), 1), len(levels) - 2)
        below, best, above = levels[k - 1 : k + 2]
        if again:
            tried |= {level: cost(level) for level in (float(np.sqrt(below * best)), float(np.sqrt(best * above)))}
    x = np.log([below, best, above])
    curve, slope, _ = np.polyfit(x, [tried[level] for level in (below, best, above)], 2)
    if curve * USUAL_STD**2 < 1:  # no more than the prior says
        return min(tried, key=tried.__getitem__), USUAL_STD
    return float(np.exp(np.clip(-slope / (2 * curve), x[0], x[2]))), float(1 / np.sqrt(curve))


def _spread(A: Array, image: Coarse, share: Array, maps: Grey) -> Image:
    """A (P,) of coarse pixels carried to full size by the brightness of their pixels, and no more than their least sample."""
    part = np.clip(A / np.maximum(_bright(image.signal, share), 1e-12), 0, 1)
    row, column = (
        np.minimum(np.arange(side) // image.factor, most - 1) for side, most in zip(maps.signal.shape[1:], image.shape, strict=True)
    )
    by_light = maps.signal.reshape(len(share), -1).astype(float)
    whole = image.image(part)[np.ix_(row, column)].ravel() * _bright(by_light, share)
    least = room_samples.lowest(by_light, maps.usable.reshape(by_light.shape), RoomPrior(share, 0.0))
    return np.asarray(np.minimum(np.maximum(whole, 0), least).reshape(maps.signal.shape[1:]), np.float32)


def _bright(signal: Array, share: Array) -> Array:
    """The second brightest sample (P,), as if all of it were the room's."""
    return second(signal / share[:, None])

r"""The ambient (room) light of a capture without an ambient image, estimated over wall, support and object alike.

The binned image is explained as surfaces of any normal, as planes, or as places that no lamp reaches, for one ambient level after another
(see segmentation.ambient_sample_costs). The level of least total cost is the room's, and each pixel's best explanation gives its ambient
part A. The capture without A is then treated as one whose ambient image was subtracted.

Model errors are smooth over a surface and change the cost by more than noise does, so the curvature of the cost says little about the
uncertainty of the level; the disagreement between parts of the image does. It is measured by the block bootstrap (Kunsch 1989, Ann.
Statist. 17; of posteriors, Buhlmann 2014, Statist. Sci. 29). There are two priors: usual levels of rooms, and that a place which no lamp
reaches is matter under the same ambient light, which reflects about as much of it as the object does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Light
from lpcal.segmentation import ambient_sample_costs, layers, plane_hough
from lpcal.segmentation.features import SPARED
from lpcal.view.coarse import Coarse, LightTable, RoomPrior, coarse_of, factor_of
from lpcal.view.constants import CERTAIN, COARSE_PIXELS, FEWEST_PIXELS
from lpcal.view.pixel_list import SignalMaps, second, strength

FEW_PIXELS = COARSE_PIXELS // 4
"""Coarse pixels at which levels are tried: half as many along a side as its map has."""
LEVELS = (0.005, 0.015, 0.045, 0.13, 0.4, 1.2)
"""Levels tried, in units of a lamp's irradiance at the working distance: from one that no camera sees to a lit room."""
RARE_ROUNDS = 2
"""Times that the cost of each explanation is set by how rare it is: a plane that holds a few pixels by chance then spares nothing."""
USUAL, USUAL_STD = 0.1, 1.3
"""The level of common rooms in these units and the standard deviation of its logarithm: the prior, where pictures show next to nothing."""
FAR_STD = 0.8
"""Standard deviation of the logarithm of a distant wall's albedo over the object's, each from 0.2 to 0.8; some are as dark as cloth."""
DRAWS = 100
"""Times that the picture's blocks are drawn again: their spread is then right to a tenth."""
SHARED = 60.0
"""Pixels or samples whose errors are alike: what the explanations of the room's light lack is smooth over a surface."""
UNSURE = 0.1
"""Share of the room's light that is left in doubt besides: of a pixel, how far it was off on simulated scenes; of the level at least."""


@dataclass(frozen=True)
class RoomLight:
    """The room's light in a picture."""

    room: RoomPrior
    level_std: float
    """Standard deviation of the logarithm of the level."""
    A: Image
    """(H, W) of every pixel, in units of the signals."""


@dataclass(frozen=True)
class Explained:
    """P coarse pixels by their best explanations at a level of the room's light."""

    cost: Array
    """(P,)."""
    A: Array
    """(P,)."""
    far: Mask
    """(P,) places that no lamp reaches."""
    matter: Mask
    """(P,) matter of any normal."""
    size: Array
    """(P,) |b| as such matter."""

    def as_far(self) -> float | None:
        """What matter of |b| = 1 sends back of the room's light if the object does so as the places do that no lamp reaches.

        None where too little is seen of either.
        """
        if min(self.far.sum(), self.matter.sum()) < FEWEST_PIXELS:
            return None
        return float(np.median(self.A[self.far]) / max(np.median(self.size[self.matter]), 1e-20))


def found(maps: SignalMaps, rays_C: Array, lights: Sequence[Light], distance_m: float) -> RoomLight:
    """The room's light of a picture with lights near the object, which is at about a distance."""
    share = np.array([1 / light.intensity.mean() for light in lights])
    few = coarse_of(maps, rays_C, factor_of(maps, FEW_PIXELS))
    table = LightTable.of(few, lights, distance_m)
    unit = float(np.median(lambert.length(table.at(np.full(len(few.rays_C), np.log(distance_m)), np.arange(len(few.rays_C)))[0])))

    def explained(level: float) -> Explained:
        return _explained(few, RoomPrior(share, level * unit), table, distance_m, drawn=False)

    level, level_std = _level(explained, few.shape, unit)
    room = RoomPrior(share, unit * level)
    image = coarse_of(maps, rays_C, factor_of(maps, COARSE_PIXELS))
    A = _explained(image, room, LightTable.of(image, lights, distance_m), distance_m, drawn=True).A
    return RoomLight(room, level_std, _spread(A, image, share, maps))


def taken_away(maps: SignalMaps, light: RoomLight) -> SignalMaps:
    """The maps without a room's light, its doubt counted as noise."""
    ambient = light.room.share[:, None, None].astype(np.float32) * light.A
    return SignalMaps(maps.signal - ambient, np.hypot(maps.sigma, np.float32(UNSURE) * ambient), maps.usable)


def _explained(seen: Coarse, room: RoomPrior, table: LightTable, distance_m: float, *, drawn: bool) -> Explained:
    """The coarse pixels at the room's level.

    `drawn`: by what a map of labels drawn with few boundaries gives each, of all depths; else by half the depths.
    """
    image = replace(seen, room=room)
    everywhere = np.arange(len(image.rays_C))
    swept = plane_hough.sweep(image, table, distance_m, 1 if drawn else 2)
    least = ambient_sample_costs.lowest(image.signal, image.usable, room)
    over = image.signal - room.share[:, None] * least > CERTAIN * image.sigma
    lit = np.sum(over & image.usable, axis=0) >= 2
    best = np.argmin(swept.cost, axis=0)
    B, doubt = table.at(swept.u[best], everywhere)
    free = ambient_sample_costs.free(image.signal, image.sigma, image.usable, B, doubt, room)
    costs, ambient = [free.cost + layers.FREE_PRICE], [free.A]
    for q in plane_hough.find(image, table, swept, lit, distance_m):
        m, doubt = plane_hough.white(q, image.rays_C, everywhere, table)
        cost, _, _, A = ambient_sample_costs.planar(image.signal, image.sigma, image.usable, m, doubt, room)
        costs.append(cost)
        ambient.append(A)
    E = lambert.length(table.at(np.full(len(everywhere), np.log(distance_m)), everywhere)[0])
    bright = np.max(np.where(image.usable, image.signal / np.maximum(E, 1e-12), 0.0), axis=0)
    around = np.median(bright[lit]) * E if lit.any() else np.median(bright) * E
    cost, A = ambient_sample_costs.nothing(image.signal, image.sigma, image.usable, around, room)
    every, each = np.stack([*costs, cost]), np.stack([*ambient, A])
    for _ in range(RARE_ROUNDS):
        part = np.bincount(np.argmin(every, axis=0), minlength=len(every)) / every.shape[1]
        every = np.stack([*costs, cost]) - 2 * np.log(np.maximum(part, 1 / every.shape[1]))[:, None]
    bounded = np.minimum(every, every.min(axis=0) + SPARED).reshape(-1, *image.shape)
    labels = (layers.cheapest(bounded, *layers.boundary(strength(image.maps))) if drawn else np.argmin(bounded, axis=0)).ravel()
    size = lambert.length(free.b)
    return Explained(every.min(axis=0), each[labels, everywhere], labels == len(every) - 1, labels == 0, size)


def _level(explained: Callable[[float], Explained], shape: tuple[int, int], unit: float) -> tuple[float, float]:
    """The level, and the standard deviation of its logarithm, of a picture of a shape that is explained at a level.

    LEVELS are tried first, then half way to the neighbours of the best. `unit` is a lamp's irradiance.
    """
    tried = {level: explained(level) for level in LEVELS}
    cost = {level: float(one.cost.sum()) / SHARED + (np.log(level / USUAL) / USUAL_STD) ** 2 for level, one in tried.items()}
    k = min(max(LEVELS.index(min(cost, key=cost.__getitem__)), 1), len(LEVELS) - 2)
    tried |= {level: explained(level) for level in np.sqrt(np.multiply(LEVELS[k - 1 : k + 1], LEVELS[k : k + 2])).tolist()}
    levels = sorted(tried)
    x = np.log(levels)
    middle, std = _by_blocks(x, np.stack([tried[level].cost for level in levels]).reshape(-1, *shape))
    std = float(np.hypot(std, UNSURE))
    as_far = tried[levels[int(np.argmin(np.abs(x - middle)))]].as_far()
    if as_far is None or as_far <= 0:
        return float(np.exp(middle)), std
    at = np.linspace(x[0] - USUAL_STD, x[-1] + USUAL_STD, 500)
    over2 = ((at - np.log(as_far / unit)) / FAR_STD) ** 2
    far = np.where(at < np.log(as_far / unit), over2, 2 * np.log1p(over2 / 2))
    middle, std = _moments(at, ((at - middle) / std) ** 2 + far)
    return float(np.exp(middle)), std


def _by_blocks(x: Array, cost: Array) -> tuple[float, float]:
    """Mean and standard deviation of x (N,), of which pixels say costs (N, rows, columns) and common rooms the rest.

    Of each draw of the picture's blocks, the parabola through the least cost and its neighbours: the mean and the variance of what all
    draws say together.
    """
    side = round(SHARED**0.5)
    row, column = (np.arange(length) // side for length in cost.shape[1:])
    block = (row[:, None] * (column[-1] + 1) + column).ravel()
    by_block = np.stack([np.bincount(block, one.ravel()) for one in cost]) / SHARED
    count = by_block.shape[1]
    drawn = np.random.default_rng(0).multinomial(count, np.full(count, 1 / count), DRAWS)
    said = np.array([_said(x, one) for one in drawn @ by_block.T])
    return float(said[:, 0].mean()), float(np.sqrt(said[:, 0].var() + said[:, 1].mean()))


def _said(x: Array, cost: Array) -> tuple[float, float]:
    """Mean and variance of x (N,) by costs (N,), twice a negative log likelihood, and by what common rooms are."""
    k = min(max(int(np.argmin(cost)), 1), len(x) - 2)
    usual = np.log(USUAL) - x[k]
    curve, slope, _ = np.polyfit(x[k - 1 : k + 2] - x[k], cost[k - 1 : k + 2], 2)
    information = max(float(curve), 0.0) + USUAL_STD**-2
    mean = x[k] + (usual * USUAL_STD**-2 - slope / 2) / information
    return float(np.clip(mean, x[0] - USUAL_STD, x[-1] + USUAL_STD)), 1 / information


def _moments(at: Array, energy: Array) -> tuple[float, float]:
    """Mean and standard deviation of places (N,) under an energy (N,), twice a negative log likelihood."""
    weight = np.exp((energy.min() - energy) / 2)
    middle = float(np.average(at, weights=weight))
    return middle, float(np.sqrt(np.average((at - middle) ** 2, weights=weight)))


def _spread(A: Array, image: Coarse, share: Array, maps: SignalMaps) -> Image:
    """A (P,) of coarse pixels carried to full size by the brightness of their pixels, and no more than their least sample."""
    part = np.clip(A / np.maximum(_bright(image.signal, share), 1e-12), 0, 1)
    row, column = (
        np.minimum(np.arange(side) // image.factor, most - 1) for side, most in zip(maps.signal.shape[1:], image.shape, strict=True)
    )
    by_light = maps.signal.reshape(len(share), -1).astype(float)
    whole = image.image(part)[np.ix_(row, column)].ravel() * _bright(by_light, share)
    least = ambient_sample_costs.lowest(by_light, maps.usable.reshape(by_light.shape), RoomPrior(share, 0.0))
    return np.asarray(np.minimum(np.maximum(whole, 0), least).reshape(maps.signal.shape[1:]), np.float32)


def _bright(signal: Array, share: Array) -> Array:
    """The second brightest sample (P,), as if all of it were the room's."""
    return second(signal / share[:, None])

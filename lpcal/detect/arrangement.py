r"""Whether the images fit their lights better in another order, or turned, than as they are stated.

Symbols: signal I_k of the image that is taken for light k's, light vectors B_k, a factor g_k of each image, whose lamp's power is not of
its place. At a flat front of one distance a pixel misses the lights by::

    c = mean over k of  r_k^2 / (1 + r_k^2 / OUTLIER^2)        r_k = (g_k I_k - B_k . b) / s_k,  b of least squares, weighed again

and an arrangement is as good as the mean of c at its best distance. Arrangements differ by

    t = (mean of c as stated - mean of c otherwise) / its standard error, from how far blocks of the picture disagree

Near lights tell them all apart, since their light falls off across the picture; distant ones only as far as their directions do not look
alike from another side. What matter the object is of, shadows and its shape make all arrangements miss more, and none of them less.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import erf, sqrt
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import DisagreementError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Calibration, Camera, Light
from lpcal.records.observations import Radiance
from lpcal.view import pixel_list
from lpcal.view.constants import CERTAIN, COARSE_PIXELS, FEWEST_PIXELS, OUTLIER, OUTLIER2, OUTLIER_RATE, SHADOW
from lpcal.view.pixel_list import Indices

LIGHTS_NEEDED = 4
"""Lights from which a pixel's signals can contradict them."""
MOST_LIGHTS = 16
"""Lights that are asked, spread over all: more say no more."""
SPAN, STEPS = (0.5, 20.0), 10
"""Nearest and furthest front that is tried, from the lights on as shares of their spread, and how many between: half as far again each."""
MODEL = 0.05
"""What the model lacks, a standard deviation as a share of a sample: a flat front at one distance is no object."""
WEIGHED = 3
"""Rounds of weights."""
FACTORS = (0.5, 2.0)
"""Between what a lamp's or an exposure's factor may lie."""
BLOCKS = 12
"""Blocks down and across the pixels that are asked, each of which counts as one that knows nothing of the others."""
BLOCKS_NEEDED = 10
"""Blocks from which their disagreement is known."""
SAID = 4.0
"""Standard errors from which another arrangement is spoken of: of 85 drawn scenes that are right it came to 3.7 at most."""
SEVERAL = 4
"""Arrangements that are looked at closely: those that some pixels like best."""
ARRANGEMENT = "arrangement: stated"
"""What capture.yaml says, or --arrangement stated, where the images are as their names say, whatever they themselves show."""
IN_ORDER = "rename the images, put the light list's lines right, or say in capture.yaml, under images:, which is which light's"
TEXT_ORDER = 10
"""Lights over which an order by name as text (1, 10, 11, 2) is another than by number."""
TURNS: dict[str, Callable[[npt.NDArray[Any]], npt.NDArray[Any]]] = {
    "turned by 180 degrees": lambda at: at[::-1, ::-1],
    "mirrored left to right": lambda at: at[:, ::-1],
    "mirrored top to bottom": lambda at: at[::-1],
    "turned by 90 degrees to the left": np.rot90,
    "turned by 90 degrees to the right": lambda at: np.rot90(at, -1),
}
"""What may have to be done to pictures, and where a picture's pixel (row and column of a map of places) is then."""


@dataclass(frozen=True, eq=False)
class Arrangement:
    """Which image is taken for each light's, and how pictures are turned."""

    images: Indices
    """(L,) image k's place in the capture."""
    turn: str | None = None
    """One of TURNS."""

    def said(self, names: Sequence[str]) -> str:
        """In words, by the names of the images."""
        if self.turn is not None:
            return f"if they are {self.turn}"
        pairs = [f"{names[image]} is of the light {names[k]}" for k, image in enumerate(self.images) if image != k]
        return f"if the image {', '.join(pairs[:3])}{', and so on' if len(pairs) > 3 else ''}"


@dataclass(frozen=True)
class Rearranged:
    """An arrangement that the images fit better than the stated one."""

    arrangement: Arrangement
    t: float
    """By how many standard errors."""
    alike: tuple[Arrangement, ...] = ()
    """Others that fit as well."""

    @property
    def odds(self) -> float:
        """Odds of being better, the errors of neighbouring blocks taken to be alike."""
        return 0.5 * (1 + erf(self.t * OUTLIER / CERTAIN / sqrt(2)))


def refuse_rearranged(radiance: Radiance, calibration: Calibration, mask: Mask | None = None, *, stated: bool = False) -> tuple[str, ...]:
    """Stop where the images clearly fit their lights in another arrangement; a note where that is less clear.

    Parameters
    ----------
    mask : (H, W) the object's pixels, where they are known; else all that are lit
    stated : the user says that the images are as their names say, so that a contradiction is a note alone

    Raises
    ------
    DisagreementError
        They do, by more than CERTAIN standard errors, and nobody states otherwise; or their size is not the calibrated camera's.
    DegenerateError
        Fewer than three lights, or all in a plane.
    """
    pixel_list.agree_on_size(radiance.name, radiance.signal.shape[1:3], calibration.camera)
    lights = pixel_list.lights_of(calibration, radiance)
    found = better(radiance, lights, calibration.camera, mask)
    if found is None:
        return ()
    ways = " or ".join(one.said(radiance.lights) for one in (found.arrangement, *found.alike[:1]))
    fits = f"the images fit the lights better {ways}: odds {min(100 * found.odds, 99.9):.3g} %"
    if stated:
        return (f"{fits}; taken as they are, as {ARRANGEMENT} says",)
    if found.t < CERTAIN:
        return (f"{fits}; are their names and order those of the lights, and the pictures the right way up?",)
    turned = found.arrangement.turn is not None
    raise DisagreementError(
        fits,
        where=radiance.name,
        needed="pictures as the calibrated camera gives them, not turned or mirrored"
        if turned
        else "each image under its own light's name",
        todo=("export the images anew without turning them" if turned else IN_ORDER) + f"; if they are right, state {ARRANGEMENT}",
    )


def better(radiance: Radiance, lights: Sequence[Light], camera: Camera | None, mask: Mask | None = None) -> Rearranged | None:
    """The arrangement that the images fit better than the stated one, by more than SAID standard errors; None where none is."""
    if len(lights) < LIGHTS_NEEDED:
        return None
    near = camera is not None and any(light.source_C is not None for light in lights)
    picture = _Picture.of(radiance, lights, camera, mask, near=near)
    if picture is None:
        return None
    fronts_m = pixel_list.fronts_m(lights, SPAN, STEPS) if near else np.ones(1)
    arrangements = _arrangements(len(lights), picture.turns if near else [])
    costs = [cost.mean() for cost in picture.some(4 * FEWEST_PIXELS).costs(arrangements, lights, fronts_m)]
    liked = [arrangements[k] for k in np.argsort(costs, kind="stable")[:SEVERAL] if costs[k] < costs[0]]
    if not liked:
        return None
    stated, *others = picture.costs([arrangements[0], *liked], lights, fronts_m)
    t = [picture.standard_errors(stated - cost) for cost in others]
    better_ones = [k for k in np.argsort([cost.mean() for cost in others], kind="stable") if t[k] > SAID]
    if not better_ones:
        return None
    best = better_ones[0]
    alike = [k for k in better_ones if k == best or picture.standard_errors(others[k] - others[best]) < OUTLIER]
    first, *rest = sorted(alike, key=lambda k: arrangements.index(liked[k]))  # those that happen more often come first
    return Rearranged(liked[first], t[best], tuple(liked[k] for k in rest))


def _arrangements(count: int, turns: Sequence[str]) -> list[Arrangement]:
    """The stated one, then the others, by how often they happen: lists off by one or backwards, turned pictures, names as text, others."""
    own = np.arange(count)
    orders = [own, (own + 1) % count, (own - 1) % count, own[::-1], -own % count]
    if count > TEXT_ORDER:
        for first in (0, 1):
            by_text = np.argsort([str(k + first) for k in range(count)], kind="stable")
            orders += [by_text, np.argsort(by_text)]
    known = len(orders)
    orders += [(way * own + shift) % count for way in (1, -1) for shift in range(count)]
    different: dict[bytes, Arrangement] = {}
    for k, order in enumerate(orders):
        if k == known:
            different |= {turn.encode(): Arrangement(own, turn) for turn in turns}
        different.setdefault(order.astype(np.int64).tobytes(), Arrangement(order))
    return list(different.values())


@dataclass(frozen=True)
class _Picture:
    """Pixels of a capture, P of a lattice of them, and L of its lights."""

    seen: pixel_list.PixelList
    lattice: Array
    """(rows, columns, 3) rays of the lattice."""
    at: Indices
    """(P,) places in the lattice, row by row."""
    turns: list[str]
    near: bool

    @staticmethod
    def of(radiance: Radiance, lights: Sequence[Light], camera: Camera | None, mask: Mask | None, *, near: bool) -> _Picture | None:
        """The pixels that are asked; None where they are too few."""
        height, width = radiance.signal.shape[1:3]
        rows, columns = _lattice(height, width)
        some = (slice(None), *np.ix_(rows, columns))
        thin = replace(radiance, signal=radiance.signal[some], sigma=radiance.sigma[some], saturated=radiance.saturated[some], mask=None)
        maps = pixel_list.grey(thin, lights)
        bright = pixel_list.strength(maps)
        asked = mask[some[1:]] if mask is not None else bright > OUTLIER_RATE * np.percentile(bright, 99)
        asked = asked & (bright > 0)
        if asked.sum() < FEWEST_PIXELS:
            return None
        pixels = np.stack(np.broadcast_arrays(*np.ix_(rows, columns))[::-1], axis=-1).reshape(-1, 2)
        rays_C = pixel_list.rays_at(pixels, camera)
        seen = pixel_list.list_pixels(maps, rays_C, asked, central=camera is not None)
        turns = [turn for turn, to in TURNS.items() if to(asked).shape == asked.shape]
        return _Picture(seen, rays_C.reshape(*asked.shape, 3), np.flatnonzero(asked), turns, near)

    def some(self, most: int) -> _Picture:
        """Some of the pixels, spread over all."""
        few = np.unique(np.linspace(0, self.seen.pixels - 1, min(most, self.seen.pixels)).astype(int))
        return replace(self, seen=self.seen.at(few), at=self.at[few])

    def costs(self, arrangements: Sequence[Arrangement], lights: Sequence[Light], fronts_m: Array) -> list[Array]:
        """c (P,) of each arrangement, at the distance where it fits best."""
        asked = np.unique(np.linspace(0, len(lights) - 1, min(len(lights), MOST_LIGHTS)).astype(int))
        shown = [lights[k] for k in asked]
        turns = {one.turn for one in arrangements}
        fields = {turn: np.stack([self._light(shown, turn, front_m) for front_m in fronts_m], axis=1) for turn in turns}
        found = []
        for one in arrangements:
            images = one.images[asked]
            missed = _misses(self.seen.signal[images], self.seen.sigma[images], self.seen.usable[images], fields[one.turn])
            found.append(missed[np.argmin(missed.mean(axis=1))])
        return found

    def _light(self, lights: Sequence[Light], turn: str | None, front_m: float) -> Array:
        """Light vectors (L, P, 3) at the pixels, of pictures turned so, on a front at a distance."""
        rays_C = self.lattice.reshape(-1, 3)
        if turn is not None:
            to = TURNS[turn](np.arange(len(rays_C)).reshape(self.lattice.shape[:2]))
            rays_C = rays_C[np.argsort(to.ravel())]
        focus_C = None if self.near else np.array([0.0, 0.0, front_m])
        d, E = pixel_list.light_vectors(lights, rays_C[self.at] * front_m, focus_C)
        return np.ascontiguousarray(d * E[..., None])

    def standard_errors(self, values: Array) -> float:
        """The mean of values (P,) by its standard error, blocks of pixels standing for themselves; 0 where these are too few."""
        place = np.stack(np.unravel_index(self.at, self.lattice.shape[:2]))
        low, size = place.min(axis=1, keepdims=True), np.ptp(place, axis=1, keepdims=True) + 1
        row, column = (place - low) * BLOCKS // size
        _, block = np.unique(row * BLOCKS + column, return_inverse=True)
        if block.max() + 1 < BLOCKS_NEEDED:
            return 0.0
        mean = values.mean()
        error = np.sqrt(np.sum(np.bincount(block, values - mean) ** 2)) / len(values)
        return float(mean / error) if error > 0 else 0.0


def _lattice(height: int, width: int) -> tuple[Indices, Indices]:
    """Rows and columns of pixels, COARSE_PIXELS in all at most, that lie alike from either end."""
    step = int(np.ceil(np.sqrt(height * width / COARSE_PIXELS)))
    rows, columns = (np.arange((side - 1) % step // 2, side, step) for side in (height, width))
    return rows, columns


def _misses(signal: Array, sigma: Array, usable: Mask, B: Array) -> Array:
    """c (N, P) of signals (L, P) under light vectors B (L, N, P, 3) of N fronts."""
    signal, sigma, usable = signal[:, None], sigma[:, None], usable[:, None]

    def fitted(signal: Array, weight: Array) -> Array:
        flat = (np.reshape(one, (len(B), -1)) for one in (np.broadcast_to(signal, weight.shape), weight))
        return lambert.weighted(B.reshape(len(B), -1, 3), *flat)[0].reshape(B.shape[1:])

    variance = np.maximum(sigma**2 + (MODEL * signal) ** 2, 1e-300)
    shading = np.where(usable, signal / np.maximum(lambert.length(B), 1e-300), 0.0)
    reached = usable & (shading > SHADOW * np.partition(shading, -2, axis=0)[-2]) & (signal > OUTLIER * sigma)
    plain = reached / variance
    g = np.ones((*B.shape[:2], 1))
    b = np.nan_to_num(fitted(signal, plain))
    for _ in range(WEIGHED):
        shown = lambert.predicted(B, b)
        square = (signal - shown / g) ** 2 / variance
        weight = plain / (1 + square / OUTLIER2) ** 2
        g = np.sum(weight * shown * signal, axis=2, keepdims=True) / np.maximum(np.sum(weight * signal**2, axis=2, keepdims=True), 1e-300)
        g = np.clip(g / np.exp(np.mean(np.log(np.maximum(g, FACTORS[0] ** 2)), axis=0)), *FACTORS)
        again = fitted(g * signal, weight / g**2)
        b = np.where(np.isfinite(again), again, b)
    square = (signal - lambert.predicted(B, b) / g) ** 2 / variance
    return np.asarray(np.sum(np.where(usable, square / (1 + square / OUTLIER2), 0.0), axis=0) / np.maximum(usable.sum(axis=0), 1))

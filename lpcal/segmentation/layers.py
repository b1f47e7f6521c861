r"""Multi-label segmentation of coarse pixels: surface of free normal, one of the planes, other matter like theirs, or nothing.

Each layer l has a data cost (see segmentation.sample_costs) and an appearance model, the histogram of log albedo over its pixels. The
labels minimise a Potts energy::

    sum_p  cost_l(p) - 2 log(appearance_l(p))   +   sum_ab  w_ab [l_a != l_b]

with w low across edges of the image, by a convex relaxation with indicators on the simplex. Appearances and planes are re-estimated from
the labels in alternation. Sources: Zach, Gallup, Frahm and Niethammer 2008, Vision, Modeling and Visualization (the relaxation); Isack and
Boykov 2012 (alternation of planes and labels); Rother, Kolmogorov and Blake 2004, ACM Transactions on Graphics 23 (appearance models).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.kernels.library import kernel
from lpcal.segmentation import background, plane_hough, sample_costs
from lpcal.segmentation.features import SPARED, View
from lpcal.view import parallel
from lpcal.view.coarse import LightTable
from lpcal.view.constants import UNLIKELY
from lpcal.view.pixel_list import Indices, strength

FREE_PRICE = 10.0
"""Cost of a free normal for its degrees of freedom: twice the log of the number of normals that the samples can distinguish."""
OTHER_PRICE = 2.0
"""Cost of the label for matter like a plane's that lies in none of the planes, in excess of the object's."""
NOTHING_PRICE = 6.0
"""Cost of labelling a pixel without a signal as matter."""
LEAST_NOTHING = 0.003
"""Lower bound of the share of the image border that is assumed to show nothing."""
BOUNDARY = 10.0
"""Boundary cost between two layers per pixel of length where the image has no edge."""
EDGE = 6.0
"""Step of the log image, in medians of all such steps, that halves the boundary cost."""
PLANE_SAYS, OBJECT_SAYS = 4.0, 8.0
"""Bounds of an appearance's contribution to the cost: by the albedo in a plane, and by the brightest shading for and against the object."""
ROUNDS = 4
"""Alternations of labelling and re-estimation of planes and appearances: further ones change almost nothing."""
STEPS = 250
"""Steps of the primal-dual method, after which the labels no longer change."""
BINS = 40
"""Bins of an appearance histogram."""
BRIGHTEST = 75
"""Percentile of the object's brightest shading that represents its matter in full light; initially the median over all lit pixels does."""
FEWEST = 30
"""Least number of pixels from which an appearance is estimated."""


@dataclass(frozen=True)
class Appearance:
    """A smoothed histogram of log values."""

    low: float
    high: float
    density: Array
    """(BINS,) density relative to a uniform one."""

    @staticmethod
    def of(values: Array, low: float, high: float) -> Appearance:
        """The appearance of log values (N,), smoothed over a bin."""
        count, _ = np.histogram(np.clip(values, low, high), BINS, (low, high))
        smooth = raster.gaussian_filtered(count.astype(float), 1.0)
        return Appearance(low, high, (1 - UNLIKELY) * BINS * smooth / max(smooth.sum(), 1e-12) + UNLIKELY)  # no albedo is impossible

    def at(self, values: Array) -> Array:
        """Density at log values (P,)."""
        k = (np.clip(values, self.low, self.high) - self.low) / (self.high - self.low) * BINS
        return self.density[np.minimum(k.astype(int), BINS - 1)]


@dataclass(frozen=True)
class Layers:
    """Models of the layers of an image."""

    planes: list[Array]
    """q (3,) each."""
    of_plane: list[Appearance | None]
    """Appearance of each plane over log albedo; None where too few pixels show it."""
    brightest: float
    """Log shading of the brightest matter."""
    of_object: Appearance | None = None
    of_rest: list[Appearance] | None = None
    """Appearances of the planes over the log of the brightest shading, as the object's."""
    nothing: float = 0.0
    """Prior cost of the label nothing: minus twice the log of its share of the image border."""


@dataclass(frozen=True)
class Pixels:
    """Q pixels whose costs are evaluated, each in a coarse pixel."""

    signal: Array
    sigma: Array
    usable: Mask
    rays_C: Array
    coarse: Indices
    """(Q,) number of the coarse pixel."""


def shine(at: Pixels, E: Array) -> Array:
    """Log (Q,) of the brightest shading, signal over irradiance E (L, Q)."""
    return np.asarray(np.log(np.maximum(np.max(np.where(at.usable, at.signal, 0.0) / np.maximum(E, 1e-12), axis=0), 1e-12)))


def with_planes(layers: Layers, at: Pixels, table: LightTable, free: Array, E: Array) -> Array:
    """Costs (layers, Q) of all labels, from those of a free normal (Q,) and irradiances E (L, Q) at the working distance."""
    bright = shine(at, E)
    nothing = sample_costs.nothing(at.signal, at.sigma, at.usable, np.exp(layers.brightest) * E)
    matter = NOTHING_PRICE * (nothing < sample_costs.DARK)
    ratio = np.zeros(len(free))
    if layers.of_object is not None and layers.of_rest:
        rest = np.max([one.at(bright) for one in layers.of_rest], axis=0)
        ratio = np.clip(2 * np.log(layers.of_object.at(bright) / rest), -OBJECT_SAYS, OBJECT_SAYS)
    found = [free + FREE_PRICE + matter - ratio]

    def in_plane(k: int) -> Array:
        q, appearance = layers.planes[k], layers.of_plane[k]
        m, doubt = plane_hough.white(q, at.rays_C, at.coarse, table)
        cost, albedo, _ = sample_costs.planar(at.signal, at.sigma, at.usable, m, doubt)
        if appearance is not None:
            cost = cost - np.clip(2 * np.log(appearance.at(np.log(np.maximum(albedo, 1e-12)))), -PLANE_SAYS, PLANE_SAYS)
        return np.asarray(cost + matter)

    found += parallel.run_all(in_plane, range(len(layers.planes)))
    other = free + FREE_PRICE + matter + OTHER_PRICE + np.maximum(ratio, 0) if layers.of_rest else np.full(len(free), np.inf)
    total = np.stack([*found, nothing + layers.nothing, other])
    blind = at.usable.sum(axis=0) < 3
    total[:, blind], total[-2, blind] = NOTHING_PRICE, 0.0  # fewer than three unsaturated lights: not the object
    return np.asarray(np.minimum(total, total.min(axis=0) + SPARED))


def label(view: View, planes: list[Array], lit: Mask, u_free: float) -> tuple[Labels, Layers, Array]:
    """Labels (rows, columns), the models of the layers, and the final costs (layers, rows, columns).

    Label 0 is a surface of free normal, 1.. the remaining planes, then nothing, then other matter.
    """
    image, table = view.image, view.table
    everywhere = np.arange(len(image.rays_C))
    at = Pixels(image.signal, image.sigma, image.usable, image.rays_C, everywhere)
    E = lambert.length(table.at(np.full(len(everywhere), u_free), everywhere)[0])
    bright = shine(at, E)
    weights = boundary(strength(image.maps))
    cost = np.empty((0, *image.shape))
    layers, labels = Layers(planes, [None] * len(planes), float(np.median(bright[lit]))), np.zeros(image.shape, int)
    for k in range(ROUNDS):
        cost = with_planes(layers, at, table, view.swept.least, E).reshape(-1, *image.shape)
        labels = cheapest(cost, *weights)
        if k + 1 < ROUNDS:
            labels, layers = _learnt(view, layers, labels, cost, lit, bright)
    return labels, layers, cost


def _learnt(view: View, layers: Layers, labels: Labels, cost: Array, lit: Mask, bright: Array) -> tuple[Labels, Layers]:
    """Re-estimate planes and appearances from the labels (rows, columns), and drop planes with too few pixels from the labels."""
    image, table = view.image, view.table
    flat, count = labels.ravel(), len(layers.planes)
    kept = [k for k in range(count) if np.sum(flat == k + 1) >= plane_hough.SMALLEST * flat.size]

    def again(k: int) -> tuple[Array, Appearance | None]:
        own = (flat == k + 1) & lit
        q = plane_hough.fitted(image, table, layers.planes[k], own, rounds=2)
        albedo = np.log(np.maximum(plane_hough.explained(image, table, q)[1][own], 1e-12))
        return q, _appearance(albedo, albedo)

    both = parallel.run_all(again, kept)
    planes, of_plane = [q for q, _ in both], [appearance for _, appearance in both]
    new = np.full(count + 3, 0)
    new[[k + 1 for k in kept]] = np.arange(1, len(kept) + 1)
    new[count + 1], new[count + 2] = len(kept) + 1, len(kept) + 2
    labels = new[labels]
    of_object, of_rest = None, None
    of_kept = cost[[0, *(k + 1 for k in kept), -2, -1]]
    mine = background.judged(view, labels, planes, of_kept).mask.ravel()
    free, rest = mine & (labels.ravel() == 0) & lit, ~mine & (labels.ravel() > 0) & (labels.ravel() <= len(kept)) & lit
    if free.sum() > FEWEST and rest.sum() > FEWEST:
        over = bright[free | rest]
        of_object = _appearance(bright[free], over)
        each = [_appearance(bright[rest & (labels.ravel() == k + 1)], over) for k in range(len(kept))]
        of_rest = [one for one in each if one is not None]
    brightest = float(np.percentile(bright[free], BRIGHTEST)) if free.sum() > FEWEST else layers.brightest
    rim = labels[background.rim_of(labels.shape)]
    nothing = -2 * np.log(max(float(np.mean(rim == len(kept) + 1)), LEAST_NOTHING))
    return labels, Layers(planes, of_plane, brightest, of_object, of_rest, nothing)


def _appearance(values: Array, over: Array) -> Appearance | None:
    if len(values) <= FEWEST:
        return None
    low, high = np.percentile(over, [0.5, 99.5])
    return Appearance.of(values, float(low) - 1.5, float(high) + 1.5)


def boundary(bright: Image) -> tuple[Image, Image]:
    """Boundary costs between each pixel and its right and lower neighbours, from the edges of image `bright` (rows, columns)."""
    picture = np.log(np.maximum(bright, 1e-3 * np.percentile(bright, 99)))
    steps = [np.abs(np.diff(picture, axis=axis)) for axis in (1, 0)]
    middle = np.median(np.concatenate([one.ravel() for one in steps])) + 1e-6
    across, down = (1 + BOUNDARY / (1 + (one / (EDGE * middle)) ** 2) for one in steps)
    return across, down


def cheapest(cost: Array, across: Image, down: Image) -> Labels:
    """Labels (rows, columns) that minimise cost (layers, rows, columns) and boundary cost: primal-dual method (Chambolle and Pock 2011)."""
    return np.asarray(np.argmax(_relaxed(cost, across, down), axis=0))


def _relaxed(cost: Array, across: Image, down: Image) -> Array:
    """Indicators (layers, rows, columns) of the labels, on the simplex."""
    layers, rows, columns = cost.shape
    x = (np.argmin(cost, axis=0) == np.arange(layers)[:, None, None]).astype(float)
    step, scale = 1 / np.sqrt(8), float(np.median(across))
    if run := kernel("many_labels"):
        half = (np.ascontiguousarray(one / 2, float) for one in (across, down))
        run(*cost.shape, np.ascontiguousarray(cost, float), *half, STEPS, step * scale, step / scale, np.empty(3 * cost.size + 1), x)
        return x
    ahead, right, below = x.copy(), np.zeros((layers, rows, columns - 1)), np.zeros((layers, rows - 1, columns))
    share = 1 / np.arange(1, layers + 1)[:, None, None]
    for _ in range(STEPS):
        right = np.clip(right + step * scale * np.diff(ahead, axis=2), -across / 2, across / 2)
        below = np.clip(below + step * scale * np.diff(ahead, axis=1), -down / 2, down / 2)
        pull = -cost
        pull[:, :, :-1] += right
        pull[:, :, 1:] -= right
        pull[:, :-1] += below
        pull[:, 1:] -= below
        moved = x + step / scale * pull
        ordered = -np.sort(-moved, axis=0)
        over = np.max((np.cumsum(ordered, axis=0) - 1) * share, axis=0)
        before, x = x, np.maximum(moved - over, 0)
        ahead = 2 * x - before
    return x

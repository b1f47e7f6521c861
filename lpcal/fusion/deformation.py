r"""Error model of a view's log depth: a scale of each piece, and a smooth deformation field.

Symbols: s a piece's scale, b the knots of a grid over it, w_k the tents of the four knots about a pixel::

    delta(pixel) = s + sum_k w_k(pixel) b_k

To both comes what all views share, polynomials of a pixel's ray in C: their normals are off together where lights are not quite where they
were calibrated, which tilts and bends all depths alike.

    s ~ N(0, scale_std^2),   b ~ N(0, (depth_std / z)^2),   b_k - b_l ~ N(0, m (e h / cos^2)^2)      k, l neighbours

h is the angle between neighbouring knots, e how far normals are off, m the knots over which they are off together, cos that between normal
and line of sight: a depth whose slope is off by more would contradict its own measured normals. Where the surface breaks between two
knots, normals say nothing of the step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.fusion.views import PlacedView
from lpcal.geometry.arrays import Array, Index, Labels, Mask

COMMON = 6
"""Errors of log depth that all views share: a scale, a tilt about either axis, and three bendings."""
TOGETHER_SHARE = 0.25
"""Length over which normals are off together, as a share of the side of a square as large as the object: light between surfaces and wrong
lights turn whole regions. The autocorrelation of their errors, summed along a row, is 22 to 40 pixels of objects of some 120 in six
simulated sessions. Steps between knots nearer than that are not independent, and add up to more than if they were."""
SHAPE_DOUBT = 5.0
"""Multiples of a view's own depth_std that its knots may be off: it was seen to be short by so much where pieces hide each other."""
LEAST_DEPTH_STD_M = 1e-4
"""Least standard deviation of a knot, metres: no single view is nearer."""
STEP = 3.0
"""Scale of the loss of steps between knots, in their standard deviations: a break that the view missed may be found here."""
OPEN_STEP = 0.01
"""Standard deviation of a step between knots across a break, of log depth: 3 mm at the working distance."""


@dataclass(frozen=True)
class Bending:
    """The parameters of one view's field, in order: a scale a piece, then its knots."""

    step_px: int
    number: Index
    """(pieces, rows, columns) place of each knot among the parameters; -1: no pixel of that piece is near."""
    place: Index
    """(256,) place of the scale of each piece, by its label."""
    size: int
    sd: Array
    """(size,) standard deviation of each."""
    links: Index
    """(M, 2) neighbouring knots."""
    links_sd: Array
    """(M,) standard deviation of the step between them."""
    common: Array
    """(size, COMMON) what a unit of each error that all views share adds to each parameter."""

    def basis(self, pixel: Array, component: Labels) -> tuple[Index, Array]:
        """Places (N, 5) of the parameters that act at pixels (N, 2), and by how much."""
        piece = self.place[component]
        x, y = pixel[:, 0] / self.step_px, pixel[:, 1] / self.step_px
        i, j = np.floor(y).astype(int), np.floor(x).astype(int)
        fy, fx = y - i, x - j
        places, weights = [piece], [np.ones(len(pixel))]
        for di, dj, w in ((0, 0, (1 - fx) * (1 - fy)), (0, 1, fx * (1 - fy)), (1, 0, (1 - fx) * fy), (1, 1, fx * fy)):
            found = self.number[piece, i + di, j + dj]
            places.append(np.maximum(found, 0))
            weights.append(np.where(found < 0, 0.0, w))
        return np.stack(places, axis=1), np.stack(weights, axis=1)

    def at(self, parameters: Array, pixel: Array, component: Labels) -> Array:
        """Delta (N,) at pixels (N, 2)."""
        places, weights = self.basis(pixel, component)
        return np.asarray((parameters[places] * weights).sum(axis=1))

    def information(self, parameters: Array) -> tuple[Index, Index, Array]:
        """Rows, columns and values of the priors' information matrix; a step that the views insist on is held less."""
        a, b = self.links[:, 0], self.links[:, 1]
        step = (parameters[a] - parameters[b]) / self.links_sd
        w = (1 + (step / STEP) ** 2) ** -2.0 * self.links_sd**-2.0
        every = np.arange(self.size)
        rows = np.concatenate([every, a, b, a, b])
        columns = np.concatenate([every, a, b, b, a])
        return rows, columns, np.concatenate([self.sd**-2.0, w, w, -w, -w])


def bending_of(view: PlacedView, step_px: int) -> Bending:
    """The field of a view with knots every so many pixels."""
    height, width = view.depth.shape
    rows, columns = height // step_px + 2, width // step_px + 2
    labels = [label for label, _ in view.pieces]
    number = np.full((len(labels), rows, columns), -1, dtype=np.intp)
    sd, size = [scale_std for _, scale_std in view.pieces], len(labels)
    together = float(np.sqrt(max(TOGETHER_SHARE * np.sqrt(np.count_nonzero(view.component)) / step_px, 1.0)))
    links, links_sd = [], []
    for piece, label in enumerate(labels):
        mean = _means(view, label, step_px, (rows, columns))
        used = mean.count > 0
        number[piece][used] = size + np.arange(used.sum())
        size += int(used.sum())
        sd += (np.maximum(SHAPE_DOUBT * mean.depth_std_m[used], LEAST_DEPTH_STD_M) / mean.depth[used]).tolist()
        for a, b, open_share in _neighbours(used, mean.broken):
            slope = together * (mean.normal_std_rad[a] + mean.normal_std_rad[b]) / 2 * step_px * view.pixel_rad
            slope = slope / ((mean.cosine[a] + mean.cosine[b]) / 2) ** 2
            links.append(np.stack([number[piece][a], number[piece][b]], axis=1))
            links_sd.append(np.sqrt(slope**2 + (open_share * OPEN_STEP) ** 2))
    place_of = np.zeros(256, np.intp)
    place_of[labels] = np.arange(len(labels))
    return Bending(
        step_px,
        number,
        place_of,
        size,
        np.array(sd),
        np.concatenate(links) if links else np.zeros((0, 2), np.intp),
        np.concatenate(links_sd) if links_sd else np.zeros(0),
        _common(view, number, size, step_px),
    )


def _common(view: PlacedView, number: Index, size: int, step_px: int) -> Array:
    """What all views share, at the scales and knots (size, COMMON): 1 at scales, else x, y, x^2, x y, y^2 of the knots' rays in C."""
    found = np.zeros((size, COMMON))
    found[: len(number), 0] = 1.0
    piece, row, column = np.nonzero(number >= 0)
    x, y = (_line(view.plane[..., k].mean(axis=k), step_px * at) for k, at in ((0, column), (1, row)))
    found[number[piece, row, column], 1:] = np.stack([x, y, x * x, x * y, y * y], axis=1)
    return found


def _line(values: Array, at: Index) -> Array:
    """The straight line through values of pixels 0, 1, ..., at places that may lie beside them."""
    return np.asarray(np.polynomial.Polynomial.fit(np.arange(len(values)), values, 1)(at))


@dataclass(frozen=True)
class _Means:
    """Means over the pixels about each knot (rows, columns)."""

    count: Array
    depth: Array
    depth_std_m: Array
    normal_std_rad: Array
    cosine: Array
    broken: Array
    """Share of the pixels that lie at a break."""


def _means(view: PlacedView, label: int, step_px: int, size: tuple[int, int]) -> _Means:
    inside = view.component == label
    row, column = np.nonzero(inside)
    sight = np.column_stack([view.plane[row, column], np.ones(len(row))])
    cosine = -np.einsum("ij,ij->i", view.normals_C[row, column], sight) / np.linalg.norm(sight, axis=1)
    open_square = np.ones(inside.shape, bool)
    open_square[:-1, :-1] = ~view.whole & inside[:-1, :-1] & inside[:-1, 1:] & inside[1:, :-1] & inside[1:, 1:]
    values = {
        "depth": view.depth[row, column],
        "depth_std_m": view.depth_std_m[row, column],
        "normal_std_rad": np.minimum(view.normal_std_rad[row, column], 0.1),
        "cosine": np.maximum(cosine, 0.2),
        "broken": open_square[row, column].astype(float),
    }
    count, sums = np.zeros(size), {name: np.zeros(size) for name in values}
    for di in (0, 1):
        for dj in (0, 1):
            at = row // step_px + di, column // step_px + dj
            good = np.isfinite(values["depth"])
            np.add.at(count, (at[0][good], at[1][good]), 1)
            for name, value in values.items():
                np.add.at(sums[name], (at[0][good], at[1][good]), np.nan_to_num(value[good]))
    return _Means(count, **{name: total / np.maximum(count, 1) for name, total in sums.items()})


def _neighbours(used: Mask, broken: Array) -> list[tuple[tuple[Index, Index], tuple[Index, Index], Array]]:
    """Pairs of used knots beside each other, and how far the surface is broken between them: 1 where a break runs all the way."""
    found = []
    for di, dj in ((0, 1), (1, 0)):
        both = used[: used.shape[0] - di, : used.shape[1] - dj] & used[di:, dj:]
        i, j = np.nonzero(both)
        share = (broken[i, j] + broken[i + di, j + dj]) / 2
        found.append(((i, j), (i + di, j + dj), np.clip(share / 0.03, 0, 1)))
    return found

"""Images as a table over the light's direction: Lambert's law, its residuals between the lights, few components.

Symbols: unit directions d_l (u, v, w) of L lights, u right, v up, w to the camera; display-encoded images S_l (N,), gamma g; per value
b (3,)::

    b       least squares of S_l^g = b . d_l over the samples that are lit,      M(d) = clip(b . d, 0, 1)^(1/g)
    S(d)  = M(d) + sum_l W_l(d) (S_l - M(d_l))

The law carries the edge of the attached shadow, which no smooth function of d follows; W interpolates the rest, which is smooth, by
thin-plate splines in (u, v) with a polynomial of second order.

Nodes: R x R places of the octahedral map of the hemisphere, turned by 45 degrees so that they fill the square; between nodes S is
bilinear. A pixel's 3 R^2 values are then a mean and few principal components over the pixels, nodes far from all lights counting less.
Sources: Duchon 1977 (splines); Engelhardt
and Dachsbacher 2008 (octahedral maps); Ponchio et al. 2018, A compact representation of relightable images (table and components).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Image, Mask

RESOLUTION = 24
"""Nodes along a side: some six degrees apart, finer than the lights of a good dome, so that bilinear lines follow what is between them."""
FEWEST_LIGHTS = 12
"""Lights from which a table is worth more than harmonics: twice the terms of its polynomial."""
SAMPLED, HELD_OUT = 6000, 1500
"""Pixels from which the components are taken, and on which images are held out."""
MOST_HELD_OUT = 24
"""Lights held out in turn, evenly over those that there are: each costs a fit."""
ROUNDS = 6
"""Fits of b, each to the samples that the one before calls lit: the set stands after four."""
DARK = 1e-3
"""Linear value under which a sample is in shadow."""
AFAR = 0.1
"""Weight of a node that is farther from all lights than they are from one another: what is extrapolated there earns few components."""
BLOCK = 6_000
"""Pixels at a time."""


@dataclass(frozen=True)
class RelightTable:
    """A mean and components over nodes and channels, every pixel's share of each, and how well held-out images are predicted."""

    basis: Array
    """(P + 1, R^2, 3): the mean, then the components."""
    planes: Image
    """(P, H, W)."""
    held_out: Array
    """(K,) rms of held-out images that the table predicts, as a share of full scale, before the components are cut off."""
    cut_off: float
    """Rms of what the components leave out, as a share of full scale."""


def nodes(resolution: int) -> Array:
    """Directions (R^2, 3) of the nodes, x first."""
    x, y = np.meshgrid(np.linspace(-1, 1, resolution), np.linspace(-1, 1, resolution))
    u, v = (x - y) / 2, (x + y) / 2
    found = np.stack([u, v, np.maximum(1 - np.abs(u) - np.abs(v), 0)], axis=-1).reshape(-1, 3)
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


def table(directions: Array, images: Image, gamma: float, components: int, inside: Mask | None = None) -> RelightTable:
    """Tabulate display-encoded images (L, H, W, 3) of lights (L, 3); `inside` (H, W) says from which pixels the components are taken."""
    height, width = images.shape[1:3]
    flat = images.reshape(len(images), -1, 3)
    rows = np.arange(height * width) if inside is None or not inside.any() else np.flatnonzero(inside)
    law = _Law(directions, nodes(RESOLUTION), gamma)
    sample = rows[np.linspace(0, len(rows) - 1, min(SAMPLED, len(rows))).astype(int)]
    at_nodes = law.at_nodes(flat[:, sample])
    weight = np.repeat(_nearness(nodes(RESOLUTION), directions), 3)
    mean = at_nodes.mean(axis=0)
    apart = weight * (at_nodes - mean)
    V = _strongest(apart.T @ apart, components)
    planes = np.repeat((-V @ (weight * mean)).astype(np.float32)[:, None], height * width, axis=1)
    shares = (weight * V).astype(np.float32).reshape(components, -1, 3)
    for first in range(0, height * width, BLOCK):
        part = slice(first, first + BLOCK)
        for c in range(3):
            planes[:, part] += shares[:, :, c] @ law.one_channel(flat[:, part, c])
    left = (apart - apart @ V.T @ V)[:, weight == 1]
    basis = np.concatenate([mean[None], V / weight]).reshape(components + 1, -1, 3)
    held = rows[np.linspace(0, len(rows) - 1, min(HELD_OUT, len(rows))).astype(int)]
    return RelightTable(
        np.asarray(basis, float),
        planes.reshape(components, height, width),
        _held_out(directions, flat[:, held], gamma),
        float(np.sqrt(np.mean(left**2))),
    )


def _nearness(asked: Array, directions: Array) -> Array:
    """Weights (M,) of directions (M, 3): 1 where lights (L, 3) are as near as they are to one another, else less."""
    between = np.sort(np.arccos(np.clip(directions @ directions.T, -1, 1)), axis=1)[:, 1]
    apart = np.arccos(np.clip(asked @ directions.T, -1, 1)).min(axis=1)
    return np.where(apart <= float(between.max()), 1.0, AFAR)


def _strongest(moments: Array, count: int) -> Array:
    """The eigenvectors (count, M) of the largest eigenvalues of symmetric moments (M, M), largest first."""
    from scipy.linalg import eigh

    size = len(moments)
    return np.asarray(eigh(moments, subset_by_index=[size - count, size - 1])[1][:, ::-1].T)


class _Law:
    """Predicts the images under other lights (M, 3) from images under lights (L, 3), in single precision: they become bytes."""

    def __init__(self, directions: Array, asked: Array, gamma: float) -> None:
        self.directions, self.asked = directions.astype(np.float32), asked.astype(np.float32)
        self.gamma = np.float32(gamma)
        self.weights = _spline(directions[:, :2], asked[:, :2]).astype(np.float32)

    def at_nodes(self, images: Image) -> Array:
        """Encoded values (N, 3 M) of pixels (L, N, 3), a pixel a row, nodes first."""
        shown = np.stack([self.one_channel(images[..., c]) for c in range(3)], axis=-1)
        return np.asarray(shown.transpose(1, 0, 2).reshape(images.shape[1], -1), float)

    def one_channel(self, values: Image) -> Image:
        """Encoded values (M, N) of a channel's (L, N)."""
        values = np.ascontiguousarray(values, np.float32)
        b = _lambert(self.directions, values**self.gamma)
        shown = self._shown(self.asked, b)
        shown += self.weights @ (values - self._shown(self.directions, b))
        return np.clip(shown, 0, 1, out=shown)

    def _shown(self, directions: Image, b: Image) -> Image:
        linear = directions @ b
        np.clip(linear, 0, 1, out=linear)
        return np.power(linear, 1 / self.gamma, out=linear)


def _lambert(directions: Image, linear: Image) -> Image:
    """b (3, N) of linear values (L, N), from those that are lit."""
    b = np.linalg.pinv(directions) @ linear
    squares = (directions[:, :, None] * directions[:, None, :]).reshape(len(directions), 9)
    for _ in range(ROUNDS):
        lit = ((directions @ b > 0) & (linear > DARK)).astype(np.float32)
        normal = (lit.T @ squares).reshape(-1, 3, 3).astype(float) + 1e-6 * np.eye(3)
        b = np.linalg.solve(normal, ((linear * lit).T @ directions)[..., None])[..., 0].T.astype(np.float32)
    return b


def _spline(places: Array, asked: Array) -> Array:
    """Weights (M, L) of values at places (L, 2) for the values at asked ones (M, 2)."""

    def bent(a: Array, b: Array) -> Array:
        r2 = np.sum((a[:, None] - b[None]) ** 2, axis=-1)
        return np.asarray(0.5 * r2 * np.log(np.maximum(r2, 1e-24)))

    def flat(xy: Array) -> Array:
        u, v = xy.T
        return np.stack([np.ones_like(u), u, v, u * u, u * v, v * v], axis=1)

    P = flat(places)
    system = np.block([[bent(places, places), P], [P.T, np.zeros((6, 6))]])
    return np.asarray((np.hstack([bent(asked, places), flat(asked)]) @ np.linalg.pinv(system))[:, : len(places)])


def _about(direction: Array) -> tuple[Array, Array]:
    """The four nodes (4, 3) about a direction (3,), and their bilinear weights (4,)."""
    u, v, _ = direction / np.abs(direction).sum()
    place = (np.array([u + v, v - u]) + 1) / 2 * (RESOLUTION - 1)
    corner = np.clip(np.floor(place).astype(int), 0, RESOLUTION - 2)
    (dx, dy), first = place - corner, int(corner[0] + corner[1] * RESOLUTION)
    weights = np.array([(1 - dx) * (1 - dy), dx * (1 - dy), (1 - dx) * dy, dx * dy])
    return nodes(RESOLUTION)[[first, first + 1, first + RESOLUTION, first + RESOLUTION + 1]], weights


def _held_out(directions: Array, images: Image, gamma: float) -> Array:
    """Rms (K,) of images (L, N, 3) that are predicted without themselves."""
    count, missed = len(directions), []
    for k in np.unique(np.linspace(0, count - 1, min(count, MOST_HELD_OUT)).astype(int)):
        others = np.arange(count) != k
        at, weights = _about(directions[k])
        at_nodes = _Law(directions[others], at, gamma).at_nodes(images[others]).reshape(-1, len(at), 3)
        missed.append(float(np.sqrt(np.mean((np.einsum("n,pnc->pc", weights, at_nodes) - images[k]) ** 2))))
    return np.array(missed)

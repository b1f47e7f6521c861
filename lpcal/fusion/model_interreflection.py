r"""Interreflection on the whole model, which includes the parts that a single view does not see.

Symbols: patches p, j of the model of area A, normal n and reflectance a; e_pj the unit vector from p to j at the distance r; V whether they
see each other; D_k(p) the irradiance of light k at p, 0 where the model hides it::

    T_k(p) = sum_j V_pj  e_pj  (e_jp . n_j) A_j / (pi r^2 + A_j)  I_k(j)             light vectors, those of lights being B_k
    I_k(j) = a_j (D_k(j) + n_j . T_k(j))                                             every bounce: one linear system for all lights

What stands in the way is a grid of cells that hold the model's surface. The geometry is the same for all views and all their lights, so it
is computed once. Sources: Goral, Torrance, Greenberg and Battaile 1984 (radiosity); Nayar, Ikeuchi and Kanade 1991.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lpcal.fusion.volume import Triangles
from lpcal.geometry import lambert, se3
from lpcal.geometry.arrays import Array, Image, Index, Mask
from lpcal.records.calibration import Light
from lpcal.view.pixel_list import light_vectors

PATCHES = 700
"""Cells of the model's surface, about; one in which it faces several ways makes more patches. The form factors take the square of these,
the system of the bounces their cube."""
LEAST_SHARE = 0.02
"""Least area of a patch, as a share of the usual one: a smaller one is the corner of a cell, and its normal is that of a few vertices."""
CELL = 1.3
"""Side of a cell that the surface fills, in edges of the model: no ray between neighbouring vertices slips through."""
OFF = 1.8
"""How far off the surface a ray begins and ends, in cells: so that a patch does not hide itself."""
NEAR = 3.0
"""Patches nearer to each other than so many times that see each other: between them no ray can be followed."""
STEP = 0.5
"""Steps along a ray, in cells."""
LEAST_COSINE = 0.05
"""Cosine under which patches say nothing of each other: their own normals are not that good."""
AT_ONCE = 128
"""Patches whose light is gathered at a time."""
AROUND = 6
"""Patches that the light at a point is a mean of: those nearest to it that face its way."""
MOST = 0.98
"""Greatest reflectance of a patch: more would be more light than it gets."""


@dataclass(frozen=True)
class Cells:
    """Cells of space that hold the model's surface."""

    origin_A: Array
    side_m: float
    filled: Mask
    """(I, J, K)."""

    @staticmethod
    def of(model: Triangles) -> Cells:
        """Those that vertices lie in, and middles of edges and faces."""
        v, faces = model.vertices_A, model.faces
        side_m = CELL * float(np.median(np.linalg.norm(v[faces[:, 1]] - v[faces[:, 0]], axis=1)))
        origin_A = v.min(axis=0) - 2 * side_m
        middles = [(v[faces[:, k]] + v[faces[:, k - 1]]) / 2 for k in range(3)]
        at = np.floor((np.concatenate([v, v[faces].mean(axis=1), *middles]) - origin_A) / side_m).astype(int)
        filled = np.zeros(at.max(axis=0) + 3, bool)
        filled[tuple(at.T)] = True
        return Cells(origin_A, side_m, filled)

    def between(self, start_A: Array, end_A: Array) -> Mask:
        """Whether the surface stands between points (N, 3) and (N, 3)."""
        way, size = end_A - start_A, np.array(self.filled.shape)
        entry, leave = _box(start_A, way, self.origin_A, self.origin_A + self.side_m * size)
        count = np.ceil((leave - entry) * np.linalg.norm(way, axis=1) / (STEP * self.side_m)).astype(int)
        found, live, k = np.zeros(len(way), bool), np.flatnonzero(count > 0), 0
        while live.size:
            t = entry[live] + (k + 0.5) / count[live] * (leave - entry)[live]
            at = np.floor((start_A[live] + t[:, None] * way[live] - self.origin_A) / self.side_m).astype(int)
            met = self.filled[tuple(np.clip(at, 0, size - 1).T)]
            found[live[met]] = True
            k += 1
            live = live[~met & (k < count[live])]
        return found


def _box(start: Array, way: Array, low: Array, high: Array) -> tuple[Array, Array]:
    """Where rays (N, 3) enter a box and leave it, as shares of their way (0..1); none of it lies in the box where the first is larger."""
    some = np.where(np.abs(way) < 1e-12, 1e-12, way)
    one, other = (low - start) / some, (high - start) / some
    entry, leave = np.minimum(one, other).max(axis=1), np.maximum(one, other).min(axis=1)
    return np.clip(entry, 0, 1), np.clip(leave, 0, 1)


@dataclass(frozen=True)
class Body:
    """A model as patches that throw light on each other."""

    x_A: Array
    """(Q, 3)."""
    n_A: Array
    area: Array
    albedo: Array
    """(Q,) relative, of median 1."""
    cells: Cells
    G: Image
    """(3, Q, Q) light vectors at each patch by the radiance of every other."""

    @staticmethod
    def of(model: Triangles, albedo: Array) -> Body:
        """The body of a model with the albedo (V, 3) of its vertices, NaN where it is not known."""
        cells = Cells.of(model)
        x_A, n_A, area, grey = _patches(model, albedo)
        return Body(x_A, n_A, area, grey / np.median(grey), cells, _factors(x_A, n_A, area, cells))

    @cached_property
    def reach_m(self) -> float:
        """Side of the usual patch."""
        return float(np.sqrt(np.median(self.area)))

    @cached_property
    def nearest(self):  # type: ignore[no-untyped-def]  # noqa: ANN201 -- scipy has no types
        """Where patches lie, to be asked which are nearest."""
        from scipy.spatial import cKDTree

        return cKDTree(self.x_A)

    def direct(self, H_AC: Array, lights: Sequence[Light]) -> Array:
        """Irradiance (L, Q) of lights of a view whose camera stands at H_AC, a unit of intensity."""
        d_C, E = light_vectors(lights, se3.apply(se3.inv(H_AC), self.x_A))
        found = E * np.maximum(np.einsum("lqi,qi->lq", d_C @ H_AC[:3, :3].T, self.n_A), 0.0)
        for k, light in enumerate(lights):
            on = np.flatnonzero(found[k] > 0)
            found[k, on[self.hidden(self.x_A[on], self.n_A[on], H_AC, light)]] = 0.0
        return found

    def hidden(self, x_A: Array, n_A: Array, H_AC: Array, light: Light) -> Mask:
        """Whether the model hides a view's light from points (N, 3) of normals (N, 3)."""
        assert light.source_C is not None
        source_A = np.broadcast_to(se3.apply(H_AC, light.source_C[None]), x_A.shape)
        return self.cells.between(x_A + OFF * self.cells.side_m * n_A, source_A)

    @cached_property
    def each_other(self) -> Array:
        """(Q, Q) irradiance of each patch by the radiance of every other."""
        return np.einsum("qi,iqj->qj", self.n_A, self.G)

    def thrown(self, direct: Array, reflectance: float) -> Array:
        """Light vectors T (L, Q, 3) in A at the patches, of their direct light (L, Q) and the reflectance of the median patch."""
        a = np.clip(reflectance * self.albedo, 0, MOST)
        radiance = np.linalg.solve(np.eye(len(a)) - a[:, None] * self.each_other, (a * direct).T)
        return np.stack([(G @ radiance).T for G in self.G], axis=-1)

    def shares(self, x_A: Array, n_A: Array) -> tuple[Index, Array]:
        """Patches (N, AROUND) that the light at points (N, 3) of normals (N, 3) is a mean of, and their shares."""
        away, near = self.nearest.query(x_A, k=min(AROUND, len(self.x_A)))
        alike = np.maximum(np.einsum("nki,ni->nk", self.n_A[near], n_A), 0.02)
        share = alike**2 / (away**2 + (0.3 * self.reach_m) ** 2)
        return near, share / share.sum(axis=1, keepdims=True)


def at_points(thrown: Array, shares: tuple[Index, Array]) -> Array:
    """Light vectors (L, N, 3) at points, by those of the patches (L, Q, 3) and the points' shares in them."""
    near, share = shares
    found = np.zeros((len(thrown), len(near), 3))
    for k in range(near.shape[1]):
        found += share[:, k, None] * thrown[:, near[:, k]]
    return found


def _patches(model: Triangles, albedo: Array) -> tuple[Array, Array, Array, Array]:
    """Places, normals, areas and grey albedo of patches: vertices of one cell that face the same octant."""
    v, n, faces = model.vertices_A, model.normals_A, model.faces
    a, b, c = (v[faces[:, k]] for k in range(3))
    of_face = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    area = np.bincount(faces.ravel(), np.repeat(of_face, 3), len(v))
    side_m = np.sqrt(area.sum() / PATCHES)
    key = np.column_stack([np.floor((v - v.min(axis=0)) / side_m), n > 0]).astype(int)
    _, of = np.unique(key, axis=0, return_inverse=True)
    total = np.bincount(of.ravel(), area)
    known = np.isfinite(albedo).all(axis=1)
    grey = np.full(len(v), np.median(albedo[known]) if known.any() else 1.0)
    grey[known] = np.maximum(albedo[known].mean(axis=1), 1e-6)
    columns = [np.bincount(of.ravel(), area * column) / np.maximum(total, 1e-30) for column in (*v.T, *n.T, grey)]
    large = total > LEAST_SHARE * side_m**2
    x_A, n_A = np.stack(columns[:3], axis=1)[large], np.stack(columns[3:6], axis=1)[large]
    return x_A, lambert.unit(n_A)[0], total[large], columns[6][large]


def _factors(x_A: Array, n_A: Array, area: Array, cells: Cells) -> Image:
    """G (3, Q, Q)."""
    found: Image = np.zeros((3, len(x_A), len(x_A)), np.float32)
    off_m = OFF * cells.side_m
    out_A = x_A + off_m * n_A
    for first in range(0, len(x_A), AT_ONCE):
        some = slice(first, first + AT_ONCE)
        e = x_A[None] - x_A[some, None]
        square = np.maximum(lambert.dot(e, e), 1e-18)
        e /= np.sqrt(square)[..., None]
        leaving = -np.einsum("pqi,qi->pq", e, n_A)
        p, q = np.nonzero((leaving > LEAST_COSINE) & (np.einsum("pqi,pi->pq", e, n_A[some]) > LEAST_COSINE))
        far = np.flatnonzero(square[p, q] > (NEAR * off_m) ** 2)
        blocked = np.zeros(len(p), bool)
        blocked[far] = cells.between(out_A[some][p[far]], out_A[q[far]])
        p, q = p[~blocked], q[~blocked]
        factor = leaving[p, q] * area[q] / (np.pi * square[p, q] + area[q])
        found[:, first + p, q] = factor * e[p, q].T
    return found

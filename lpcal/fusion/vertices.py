r"""Evidence at each vertex of a model: the views that see it, and the surface, normal and albedo of each there.

Symbols: v a vertex, n its normal, q_i what view i shows in its direction, n_i the view's normal there, w_i its weight::

    r_i = n_i . (q_i - v)               how far outside v the view puts the surface
    v  += n sum_i a_i r_i,   a_i = w_i rho_i / sum w rho        rho: Geman and McClure's weight of (r_i - mean)
    n   = sum_i w_i n_i / |..|,   log albedo = sum_i f_i (log albedo_i - g_i) / sum f_i

f_i fades to nothing at a view's edges, so no seam shows; g_i is how bright a capture came out against the others. Where views differ by
more than their doubt, the difference stays in the vertex's disagreement and in its standard deviation.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields

import numpy as np

from lpcal.fusion.align import SHARED, Aligned
from lpcal.fusion.correspondences import Placed, background
from lpcal.fusion.detail import with_detail
from lpcal.fusion.factor import columns_of
from lpcal.fusion.views import look, may_see
from lpcal.fusion.volume import Triangles, area_of, held_together, normals_of, rested, weight_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Image, Index, Mask

FACING = 0.3
"""Least cosine between a vertex's normal and the line of sight of a view that counts."""
GATE_PX = 4.0
"""How far from a vertex a view may put the surface and still mean the same one, in footprints of a pixel."""
FADE_PX = 16.0
"""Over how many pixels from its edges a view's albedo comes in."""
SCALE_PX = 0.5
"""Scale of the robust mean over views, in footprints of a pixel: about what aligned views scatter by."""
PASSES = 2
"""How often vertices are moved onto the views' mean."""
SIGMA_VERTICES = 800
"""Vertices, of those that several views see, at which the covariance of the views' places is carried over; between them it is the nearest
one's. Where one view alone sees a vertex it is that vertex's own: a patch beside an edge is known far less well than what is next to it."""
SHARED_VERTICES = 300
"""Vertices, spread over the model, from which the error that all of them share is estimated: seven numbers need no more."""
LONE = 2
"""Views that see a vertex of which no other view tells: fewer than these."""
HELD = 4_000_000
"""Vertices times views of which all is held at once: some 250 MB, whatever their number."""
LOOSE = 0.006
"""Sigma, as a share of the distance, from which a vertex that one view alone sees is left out: a piece that the light puts there, known to
a hundredth of its distance and tied to nothing, stood 10 mm beside the surface; where a view holds on to others, sigma is a thousandth."""

OUTVOTED = 1
"""Views that see through a vertex which one view alone shows, from which on it is left out: of the two nobody knows which is wrong."""


@dataclass(frozen=True)
class Evidence:
    """What views (N) say of vertices (V), each (N, V); 0 or NaN where a view does not see a vertex."""

    weight: Array
    residual_m: Array
    normals_A: Image
    """(N, V, 3)."""
    row: Index
    column: Index
    bent_m: Image
    """How far off along its normal a view may be there against its own mean about the place, a standard deviation: see `_bent_m`."""
    normal_std_rad: Image
    """Standard deviation of the view's normal there, an axis."""


@dataclass(frozen=True)
class Vertices:
    """The model's vertices."""

    triangles: Triangles
    normals_A: Array
    """(V, 3) photometric, the mean over views."""
    albedo: Array
    """(V, 3) linear, relative."""
    sigma_m: Array
    """Standard deviation of each vertex along its normal."""
    disagreement_m: Array
    """Robust rms of what views say of it; 0 where one alone sees it."""
    views: Index
    """How many see it."""
    normal_sigma_rad: Array
    """Standard deviation of each photometric normal, an axis."""
    shared_sigma_m: float
    """What of sigma all vertices share, rms: see `shared`."""
    loose_m2: float
    """Area that was left out: one view alone sees it, and its distance is not known well enough."""


def on_the_views(aligned: Aligned, rough: Triangles) -> Vertices:
    """The vertices moved onto the weighted mean of the views, with what they rest on."""
    state, faces = aligned.placed, rough.faces
    v, n = rough.vertices_A, rough.normals_A
    footprint_m = float(np.median([one.view.footprint_m for one in state]))
    for _ in range(PASSES):
        rest = _resting(state, v, n, footprint_m)
        v = v + n * rest.off_m[:, None]
        n = normals_of(v, faces)
    v, n_photometric = with_detail(v, n, faces, rest.mean_normal_A, rest.effective, footprint_m)
    rest = _resting(state, v, n, footprint_m)
    seen, faces = rested(rest.count > 0, faces)
    v, n, n_photometric, rest = v[seen], n[seen], n_photometric[seen], rest.of(seen)
    sigma = _sigma(aligned, rest, v, n, footprint_m)
    distance_m = float(np.median([one.view.distance_m for one in state]))
    lone = np.flatnonzero(rest.count == 1)
    loose = np.zeros(len(v), bool)
    loose[lone] = (sigma[lone] > LOOSE * distance_m) | (through(state, v[lone], LOOSE * distance_m) >= OUTVOTED)
    tied, held = held_together(faces, loose)
    loose_m2 = area_of(v, faces) - area_of(v[tied], held)
    v, n, rest = v[tied], n[tied], rest.of(tied)
    albedo = albedo_of(state, v, n, footprint_m)
    return Vertices(
        Triangles(v, n, held),
        n_photometric[tied],
        albedo,
        sigma[tied],
        rest.disagreement_m,
        rest.count,
        rest.normal_sigma_rad,
        _shared_m(aligned, v, n, rest.count),
        loose_m2,
    )


@dataclass(frozen=True)
class Resting:
    """What views say together of vertices (V)."""

    off_m: Array
    """How far outside them the views' weighted mean lies."""
    mean_normal_A: Array
    """(V, 3) the weighted mean of the views' normals: shorter where they differ."""
    effective: Array
    """How many views of equal weight it is worth."""
    count: Index
    """How many see it."""
    disagreement_m: Array
    bent_m2: Array
    """Variance of their mean by what each view's normals may bend it within a cell of knots."""
    turned_rad2: Array
    """Variance of their mean normal, an axis, by the standard deviations that the views state."""

    @property
    def normal_sigma_rad(self) -> Array:
        """Standard deviation of the mean normal, an axis: what views state, or what they differ by where that is more.

        Each view has its lights elsewhere, so the views' errors are taken for independent. Where none sees a vertex nothing is known.
        """
        differ = 1 - np.minimum(np.linalg.norm(self.mean_normal_A, axis=1), 1)
        return np.asarray(np.sqrt(np.maximum(self.turned_rad2, differ / np.where(self.count > 0, self.effective, 1))))

    def of(self, some: Index) -> Resting:
        """What they say of some of the vertices."""
        return Resting(*(getattr(self, field.name)[some] for field in fields(self)))


def blocks(views: int, vertices: int) -> Iterator[slice]:
    """Runs of vertices, slabs of space, of which what all views say is held at once."""
    size = max(HELD // max(views, 1), 1000)
    for first in range(0, vertices, size):
        yield slice(first, min(first + size, vertices))


def _resting(state: Sequence[Placed], v: Array, n: Array, footprint_m: float) -> Resting:
    parts = []
    for some in blocks(len(state), len(v)):
        near = [one for one in state if may_see(one.view, one.H_AC, v[some])]
        found = evidence(near, v[some], n[some], GATE_PX * footprint_m)
        share = _robust(found, SCALE_PX * footprint_m)
        mean = np.einsum("nv,nv->v", share, found.residual_m)
        off = np.where(found.weight > 0, found.residual_m - mean, 0.0)
        count = (found.weight > 0).sum(axis=0)
        disagreement = np.sqrt((off**2).sum(axis=0) / np.maximum(count - 1, 1))
        effective = np.maximum((share**2).sum(axis=0), 1e-3) ** -1
        bent = ((share * found.bent_m) ** 2).sum(axis=0)
        turned = ((share * found.normal_std_rad) ** 2).sum(axis=0)
        parts.append((mean, np.einsum("nv,nvk->vk", share, found.normals_A), effective, count, disagreement, bent, turned))
    return Resting(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def evidence(state: Sequence[Placed], v_A: Array, n_A: Array, gate_m: float) -> Evidence:
    """What every view says of vertices with normals (V, 3)."""
    shape = len(state), len(v_A)
    weight, residual, normals = np.zeros(shape), np.zeros(shape), np.zeros((*shape, 3), np.float32)
    row, column = np.zeros(shape, np.intp), np.zeros(shape, np.intp)
    bent, normal_std = np.zeros(shape, np.float32), np.zeros(shape, np.float32)
    for k, one in enumerate(state):
        if not may_see(one.view, one.H_AC, v_A):
            continue
        to_camera = one.H_AC[:3, 3] - v_A
        cosine = np.einsum("ij,ij->i", to_camera, n_A) / np.linalg.norm(to_camera, axis=1)
        some = np.flatnonzero(cosine > FACING)
        x_C = se3.apply(se3.inv(one.H_AC), v_A[some])
        seen = look(one.view, x_C)
        ok = np.flatnonzero(seen.ok)
        x_C, n_C = x_C[ok], seen.normal_C[ok]
        z = seen.depth[ok] * np.exp(one.bending.at(one.field, seen.pixel[ok], seen.component[ok]))
        r = np.einsum("ij,ij->i", n_C, x_C) * (z / x_C[:, 2] - 1)
        n_view = se3.rotate(one.H_AC, n_C)
        same = (np.abs(r) < gate_m) & (np.einsum("ij,ij->i", n_view, n_A[some[ok]]) > 0.7)
        at, kept = some[ok][same], ok[same]
        row[k, at], column[k, at] = np.rint(seen.pixel[kept, 1]), np.rint(seen.pixel[kept, 0])
        weight[k, at] = weight_of(one, row[k, at], column[k, at], cosine[at])
        residual[k, at], normals[k, at] = r[same], n_view[same]
        bent[k, at] = _bent_m(one, row[k, at], column[k, at], cosine[at])
        normal_std[k, at] = one.view.normal_std_rad[row[k, at], column[k, at]]
    return Evidence(weight, residual, normals, row, column, bent, normal_std)


def _bent_m(one: Placed, row: Index, column: Index, cosine: Array) -> Array:
    """How far off along its normal a view may be at pixels (N,) against its own mean about them, a standard deviation.

    Its bending follows what other views say from knot to knot. Over half a step between knots the depth rests on the view's own normals
    alone, which are off together there: at a rim, or in a crease, by degrees.
    """
    return np.asarray(one.view.normal_std_rad[row, column] * one.bending.step_px / 2 * one.view.footprint_m / cosine)


def through(state: Sequence[Placed], v_A: Array, margin_m: float) -> Index:
    """How many views see through each vertex (V,): it stands before what they show, by more than a margin, or before the background."""
    count = np.zeros(len(v_A), np.intp)
    for some in blocks(1, len(v_A)):
        for one in state:
            if not may_see(one.view, one.H_AC, v_A[some]):
                continue
            x_C = se3.apply(se3.inv(one.H_AC), v_A[some])
            seen = look(one.view, x_C)
            ok = np.flatnonzero(seen.ok)
            z = seen.depth[ok] * np.exp(one.bending.at(one.field, seen.pixel[ok], seen.component[ok]))
            before = seen.in_image & background(one.view, seen.pixel)
            before[ok] |= x_C[ok, 2] < z - margin_m
            count[some] += before
    return count


def _robust(found: Evidence, scale_m: float) -> Array:
    """Share (N, V) of each view in a vertex; they sum to 1 where any sees it."""
    share = found.weight / np.maximum(found.weight.sum(axis=0), 1e-30)
    for _ in range(4):
        off = found.residual_m - np.einsum("nv,nv->v", share, found.residual_m)
        w = found.weight / (1 + (off / scale_m) ** 2) ** 2
        share = w / np.maximum(w.sum(axis=0), 1e-30)
    return np.asarray(share)


def _sigma(aligned: Aligned, rest: Resting, v: Array, n: Array, footprint_m: float) -> Array:
    """Standard deviation of each vertex along its normal: the views' places, what they still differ by, and their normals between knots."""
    lone = rest.count < LONE
    places = np.zeros(len(v))
    for which, step in ((lone, 1), (~lone, max(int((~lone).sum()) // SIGMA_VERTICES, 1))):
        held = np.flatnonzero(which)
        if len(held):
            at, variance = _places(aligned, v, n, held[::step], footprint_m)
            places[held] = variance[_nearest(v[at], v[held])]
    alone = np.where(lone, aligned.sigma_m**2, 0.0) + np.where(rest.count < 1, (GATE_PX * footprint_m) ** 2, 0.0)
    left = rest.disagreement_m**2 / np.maximum(rest.effective, 1) + rest.bent_m2
    return np.asarray(np.sqrt(places + left + alone))


def _nearest(x: Array, of: Array) -> Index:
    """Which of points x (N, 3) is nearest to each of others (M, 3)."""
    from scipy.spatial import cKDTree

    return np.asarray(cKDTree(x).query(of)[1])


def _places(aligned: Aligned, v: Array, n: Array, some: Index, footprint_m: float) -> tuple[Index, Array]:
    """Variance, along the normal, of the views' places at some vertices; those that no view sees are left out where any is seen."""
    variance, seen = np.zeros(len(some)), np.zeros(len(some), bool)
    for part in blocks(len(aligned.placed), len(some)):
        found, rows = _rows(aligned, v[some[part]], n[some[part]], footprint_m)
        seen[part] = found.weight.any(axis=0)
        variance[part] = aligned.information.variances(rows)
    return (some[seen], variance[seen]) if seen.any() else (some, variance)


def carried(aligned: Aligned, v: Array, n: Array) -> Array:
    """Covariance (V, V), along their normals, of vertices (V, 3) by the places of the views that see them."""
    _, rows = _rows(aligned, v, n, float(np.median([one.view.footprint_m for one in aligned.placed])))
    half = aligned.information.half(columns_of(rows, len(aligned.parameters)))
    return np.asarray(half.T @ half)


def shared(v: Array, n: Array) -> Array:
    """Orthonormal basis (V, 7) of the moves of vertices along their normals that one motion and one growth of the whole make."""
    away = v - v.mean(axis=0)
    return np.asarray(np.linalg.qr(np.column_stack([n, np.cross(away, n), (away * n).sum(axis=1)]))[0])


def _shared_m(aligned: Aligned, v: Array, n: Array, count: Index) -> float:
    """Standard deviation, rms over the vertices, of what they all share."""
    some = np.flatnonzero(count >= LONE)
    some = some[:: max(len(some) // SHARED_VERTICES, 1)]
    if len(some) < 8:
        return 0.0
    Q = shared(v[some], n[some])
    return float(np.sqrt(max(np.trace(Q.T @ carried(aligned, v[some], n[some]) @ Q), 0.0) / len(some)))


def _rows(aligned: Aligned, v: Array, n: Array, footprint_m: float) -> tuple[Evidence, list[tuple[Index, Array]]]:
    """What views say of vertices, and which parameters of the alignment move each, by how much."""
    found = evidence(aligned.placed, v, n, GATE_PX * footprint_m)
    share, rows = _robust(found, SCALE_PX * footprint_m), []
    for k in range(len(v)):
        columns, values = _row(aligned, found, share, k, v[k], n[k])
        used, local = np.unique(columns, return_inverse=True)
        rows.append((used, np.bincount(local, values, len(used))))
    return found, rows


def _row(aligned: Aligned, found: Evidence, share: Array, vertex: int, v: Array, n: Array) -> tuple[Index, Array]:
    """Derivative of a vertex's place along its normal by the parameters of the alignment."""
    columns, values = [np.arange(SHARED)], [np.zeros(SHARED)]
    by = np.concatenate([np.cross(v, n), n])
    for k in np.flatnonzero(share[:, vertex] > 0.01):
        one, a, start = aligned.placed[k], share[k, vertex], aligned.starts[k]
        grow = float(n @ (v - one.H_AC[:3, 3]))
        row, column = found.row[k, vertex], found.column[k, vertex]
        place, weight = one.bending.basis(np.array([[column, row]], dtype=float), one.view.component[row, column][None])
        columns += [start + np.arange(6), start + 6 + place[0]]
        values += [a * by, a * grow * weight[0]]
        common = grow * (weight[0] @ one.bending.common[place[0]])
        values[0] = values[0] + a * np.concatenate([by @ one.view.placement.by_handeye, common])
    return np.concatenate(columns), np.concatenate(values)


def albedo_of(state: Sequence[Placed], v: Array, n: Array, footprint_m: float) -> Array:
    """Albedo (V, 3) of the vertices, without seams; NaN where none saw it."""
    from scipy.ndimage import distance_transform_edt

    inside = [np.clip(distance_transform_edt(one.view.witness) / FADE_PX, 0.02, 1).astype(np.float32) ** 2 for one in state]
    step = max(len(v) * len(state) // HELD, 1)
    gain = _gains(*_log_albedo(state, inside, evidence(state, v[::step], n[::step], GATE_PX * footprint_m)))
    parts = []
    for some in blocks(len(state), len(v)):
        log, fade = _log_albedo(state, inside, evidence(state, v[some], n[some], GATE_PX * footprint_m))
        total = fade.sum(axis=0)
        blended = np.einsum("nv,nvc->vc", fade, log - gain[:, None, None]) / np.maximum(total, 1e-30)[:, None]
        parts.append(np.where((total > 0)[:, None], np.exp(blended), np.nan))
    return np.concatenate(parts)


def _log_albedo(state: Sequence[Placed], inside: Sequence[Image], found: Evidence) -> tuple[Image, Image]:
    """What every view says of the vertices' albedo: its logarithm (N, V, 3), and how much it counts (N, V)."""
    log: Image = np.zeros((*found.weight.shape, 3), np.float32)
    fade: Image = np.zeros(found.weight.shape, np.float32)
    for k, one in enumerate(state):
        at = np.flatnonzero(found.weight[k] > 0)
        row, column = found.row[k, at], found.column[k, at]
        log[k, at] = np.log(np.maximum(one.view.albedo[row, column], 1e-4))
        fade[k, at] = found.weight[k, at] * inside[k][row, column]
    return log, fade


def _gains(log: Image, fade: Image) -> Array:
    """How bright each capture came out (N,), logarithms, 0 on the mean."""
    gain = np.zeros(len(log))
    both: Mask = (fade > 0).sum(axis=0) >= 2
    for _ in range(6 if both.any() else 0):
        mean = np.einsum("nv,nvc->vc", fade[:, both], log[:, both] - gain[:, None, None]) / fade[:, both].sum(axis=0)[:, None]
        for k in range(len(log)):
            seen = fade[k, both] > 0
            if seen.any():
                gain[k] = float(np.median(log[k, both][seen] - mean[seen]))
        gain -= gain.mean()
    return gain

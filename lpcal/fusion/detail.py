r"""Photometric detail of the model: normals corrected by the common surface, then the surface by the normals.

Symbols: n the surface's normals, m the views' mean of measured ones, S smoothing along the surface, w falling where the two differ much::

    m' = m + S w (n - m) / S w
    min over h   sum (h / sigma_h)^2 + sum_edges (m'_ab . (e + h_b n_b - h_a n_a) / (|e| sigma_n))^2

All views' normals are off together where a light's place or what neighbours reflect is: slowly along the surface. Distances that views from
all sides agree on are right there, and rough in detail. Source: D. Nehab et al., Efficiently combining positions and normals (2005).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Index

BIAS_RAD = float(np.radians(1.0))
"""Least standard deviation, radians, with which a normal pulls at vertices: light between surfaces turns neighbours together."""
HOLD_PX = 0.25
"""How far normals may pull a vertex off the views' mean, one standard deviation, in footprints of a pixel."""
SLOW_PX = 8.0
"""Length over which the surface corrects the normals, in footprints of a pixel: half of it or twice gives the same to a twentieth."""
LIKE_RAD = float(np.radians(5.0))
"""By how much a normal and the surface may differ and still tell of a slow error: some degrees; at steps and edges they differ by tens."""


def with_detail(v: Array, n: Array, faces: Index, mean: Array, effective: Array, footprint_m: float) -> tuple[Array, Array]:
    """Vertices (V, 3) whose faces lie as the photometric normals say, and those normals (V, 3).

    `mean` (V, 3) is the views' weighted mean of normals, shorter where they differ, `effective` (V,) how many views it is worth.
    """
    from scipy.sparse import coo_array, diags_array
    from scipy.sparse.linalg import cg

    length = np.linalg.norm(mean, axis=1)
    lit = length > 0.3
    edges = np.unique(np.sort(np.concatenate([faces[:, :2], faces[:, 1:], faces[:, ::2]]), axis=1), axis=0)
    m = np.where(lit[:, None], mean / np.maximum(length, 1e-12)[:, None], n)
    m = corrected(m, n, edges, float(np.median(np.linalg.norm(v[edges[:, 1]] - v[edges[:, 0]], axis=1))), footprint_m)
    sigma_n = np.sqrt(BIAS_RAD**2 + (2 * np.maximum(1 - length, 0)) / np.maximum(effective, 1))
    a, b = edges.T
    e = v[b] - v[a]
    me = m[a] + m[b]
    me /= np.maximum(np.linalg.norm(me, axis=1, keepdims=True), 1e-12)
    w = (
        np.where(lit[a] & lit[b], 1.0, 0.05)
        / (np.maximum(np.linalg.norm(e, axis=1), 0.1 * footprint_m) * np.hypot(sigma_n[a], sigma_n[b])) ** 2
    )
    ja, jb, r = -np.einsum("ij,ij->i", me, n[a]), np.einsum("ij,ij->i", me, n[b]), np.einsum("ij,ij->i", me, e)
    count_v = len(v)
    rows, columns = np.concatenate([a, b, a, b]), np.concatenate([a, b, b, a])
    values = np.concatenate([w * ja * ja, w * jb * jb, w * ja * jb, w * ja * jb])
    A = coo_array((values, (rows, columns)), shape=(count_v, count_v)).tocsr()
    A = A + diags_array(np.full(count_v, (HOLD_PX * footprint_m) ** -2.0))
    g = np.bincount(a, w * ja * r, count_v) + np.bincount(b, w * jb * r, count_v)
    h, _ = cg(A, -g, rtol=1e-3, maxiter=300, M=diags_array(1 / A.diagonal()))
    return v + n * h[:, None], m


def corrected(m: Array, n: Array, edges: Index, edge_m: float, footprint_m: float) -> Array:
    """Measured normals m (V, 3) without what they are off slowly from the surface's own n (V, 3).

    `edges` (E, 2) are smoothed along; a step halfway to the neighbours' mean spreads by half an edge, one standard deviation an axis.
    """
    from scipy.sparse import coo_array, diags_array, eye_array

    count, (a, b) = len(m), edges.T
    beside = coo_array((np.ones(2 * len(a)), (np.concatenate([a, b]), np.concatenate([b, a]))), shape=(count, count)).tocsr()
    step = (eye_array(count) + diags_array(1 / np.maximum(beside.sum(axis=1), 1)) @ beside).tocsr() / 2
    off = n - m
    w = (1 + (off**2).sum(axis=1) / LIKE_RAD**2) ** -2.0
    slow = np.column_stack([w[:, None] * off, w])
    for _ in range(max(round(4 * (SLOW_PX * footprint_m / edge_m) ** 2), 1)):
        slow = step @ slow
    found = m + slow[:, :3] / np.maximum(slow[:, 3:], 1e-9)
    return np.asarray(found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-12))

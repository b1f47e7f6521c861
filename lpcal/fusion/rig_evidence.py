r"""Evidence of many views of one object on their common calibration: lights, H_PC, and whether the rig has moved.

Symbols: D the directions (L, 3) of the lights that a place faces, n its normal in C, e_l the relative error of a light's intensity, s_l
that of its source (m), r_l its distance, P = I - n n^T::

    M = (D^T D)^-1 D^T                                          normals by least squares over the lights
    dn = P M [(e_l - 2 d_l.s_l / r_l) (d_l.n) + ((I - d_l d_l^T) s_l / r_l).n]
    n_i - n_j = R_i dn_i - R_j dn_j + noise                     the same place seen by views i and j

A wrong light turns the normals of all views alike in C, and so differently in the room: what views differ by is linear in the errors. With
the calibration's own standard deviations as prior it is one linear least-squares problem. H_PC's error and a scale of all distances come
from the alignment. An error by many of its prior's sigmas says that the rig is no longer what was calibrated.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from lpcal.fusion.align import SHARED_SCALE_STD, Aligned
from lpcal.fusion.correspondences import Placed
from lpcal.fusion.vertices import GATE_PX, Evidence, Vertices, evidence
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.records.model import LightEvidence, RigEvidence

VERTICES = 2500
"""Vertices at which views' normals are compared, about: a hundred for each number that is found."""
COMPARISONS = 300_000
"""Vertices times pairs of views at most: of very many views fewer vertices are compared, which are as many comparisons."""
TOGETHER = 12.0
"""Comparisons that share one error: normals' errors reach over some vertices, and a view takes part in several pairs."""
LEAST_NORMAL_STD_RAD = float(np.radians(0.7))
"""Least standard deviation of a normal: light between surfaces shows in no sigma of one view."""
FACES_LIGHT = 0.15
"""Least cosine between a normal and a light that lights it."""
UNKNOWN_INTENSITY, UNKNOWN_PLACE_M = 0.02, 0.003
"""Standard deviations of an intensity and of a source of which the calibration states none."""
ROBUST = 2.5
"""Scale of the loss, in standard deviations of a difference."""
RELAXED = 30.0
"""By how much the prior is widened for the fit that estimates the noise."""
USUAL_SIZE = 1.18
"""The median length of a difference across a normal, of two directions with a standard deviation of 1: the square root of 2 ln 2."""
MOVED_SIGMAS = 5.0
"""Surprise from which on the rig is said to have moved: of six lights and H_PC one in a million does so by chance."""
GAINED = 0.02
"""Share of a prior's variance that the data must take away along a direction for it to count: less is rounding."""


def rig_evidence(aligned: Aligned, found: Vertices, lights: Sequence[Light]) -> RigEvidence:
    """What the views show of H_PC, of a scale of all distances, and of near lights."""
    H_PC_change, covariance = aligned.parameters[:6], aligned.shared_covariance[:6, :6]
    prior = aligned.H_PC_covariance
    handeye_sigmas = surprise(H_PC_change, prior, covariance)
    near = [light for light in lights if light.source_C is not None]
    said, before, after = _lights(aligned, found, near) if len(near) >= 3 else ((), float("nan"), float("nan"))
    scale, scale_std = float(aligned.parameters[6]), float(np.sqrt(aligned.shared_covariance[6, 6]))
    moved = [f"{one.name} differs by {one.sigmas:.0f} sigmas from its calibration" for one in said if one.sigmas > MOVED_SIGMAS]
    if handeye_sigmas > MOVED_SIGMAS:
        shift, turn = 1e3 * np.linalg.norm(H_PC_change[3:]), np.degrees(np.linalg.norm(H_PC_change[:3]))
        moved.append(f"H_PC differs by {shift:.1f} mm and {turn:.2f} deg, {handeye_sigmas:.0f} sigmas, from its calibration")
    if abs(scale) > MOVED_SIGMAS * SHARED_SCALE_STD:
        moved.append(
            f"all distances are {100 * abs(scale):.1f} % too {'short' if scale > 0 else 'long'}: intensities or lights have changed"
        )
    return RigEvidence(H_PC_change, covariance, handeye_sigmas, scale, scale_std, said, before, after, tuple(moved))


def surprise(change: Array, prior: Array, posterior: Array) -> float:
    """Size of a change (n,) in standard deviations of its prior (n, n), rms over the directions that the data determine.

    The change scatters by ``prior - posterior``: little where the data are weak, so that a small change may be a large surprise.
    """
    if not prior.any():
        return 0.0
    L = np.linalg.cholesky(prior + 1e-12 * np.trace(prior) / len(prior) * np.eye(len(prior)))
    gained, axes = np.linalg.eigh(np.eye(len(prior)) - np.linalg.solve(L, np.linalg.solve(L, posterior).T))
    some = gained > GAINED
    y = (axes.T @ np.linalg.solve(L, change))[some]
    return float(np.sqrt(np.mean(y**2 / gained[some]))) if some.any() else 0.0


def _lights(aligned: Aligned, found: Vertices, lights: Sequence[Light]) -> tuple[tuple[LightEvidence, ...], float, float]:
    """Each light's change with its sigma, and the rms of what views' normals differ by, before and after, radians an axis."""
    v, n = found.triangles.vertices_A, found.triangles.normals_A
    state = aligned.placed
    step = max(len(v) // min(VERTICES, max(2 * COMPARISONS // len(state) ** 2, 10)), 1)
    footprint_m = float(np.median([one.view.footprint_m for one in state]))
    seen = evidence(state, v[::step], n[::step], GATE_PX * footprint_m)
    turned = [_turns(one, seen, k, v[::step], lights) for k, one in enumerate(state)]
    sd = np.array([_normal_std(one, seen, k) for k, one in enumerate(state)])
    prior_std = _prior_std(lights)
    rows, differences, weights = [], [], []
    for i, j in combinations(range(len(state)), 2):
        both = np.flatnonzero(
            (seen.weight[i] > 0) & (seen.weight[j] > 0) & np.isfinite(turned[i]).all((1, 2)) & np.isfinite(turned[j]).all((1, 2))
        )
        if len(both):
            rows.append(turned[i][both] - turned[j][both])
            differences.append(seen.normals_A[i, both].astype(float) - seen.normals_A[j, both])
            weights.append(1 / (sd[i, both] ** 2 + sd[j, both] ** 2))
    if not rows:
        return (), float("nan"), float("nan")
    J, d, w = np.concatenate(rows), np.concatenate(differences), np.concatenate(weights)
    x, covariance = _solved(J, d, w, prior_std)
    left = d - J @ x
    said = []
    for k, light in enumerate(lights):
        at = slice(4 * k, 4 * k + 4)
        sigmas = surprise(x[at], np.diag(prior_std[at] ** 2), covariance[at, at])
        std = np.sqrt(np.diag(covariance)[at])
        said.append(LightEvidence(light.name, float(x[at][0]), float(std[0]), x[at][1:], std[1:], sigmas))
    robust = [float(1.4826 * np.median(np.abs(one))) / np.sqrt(2) for one in (d, left)]
    return tuple(said), robust[0], robust[1]


def _solved(J: Array, d: Array, w: Array, prior_std: Array) -> tuple[Array, Array]:
    """Errors (4 L,) of the lights and their covariance, of differences (N, 3), robustly.

    How large the noise is, a shape's own errors among it, is what a fit leaves that the prior hardly holds: by a fit that it holds, lights
    that have moved would pass for noise.
    """
    x, prior = np.zeros(len(prior_std)), np.diag((RELAXED * prior_std) ** -2.0)
    u = w / TOGETHER
    for _ in range(5):
        N, g = _normal_equations(J, d, u)
        x = np.linalg.solve(N + prior, g)
        size = np.sqrt(w) * np.linalg.norm(d - J @ x, axis=1)
        unit = max(float(np.median(size)) / USUAL_SIZE, 1.0)
        u = w / unit**2 / (1 + (size / unit / ROBUST) ** 2) ** 2 / TOGETHER
    N, g = _normal_equations(J, d, u)
    N = N + np.diag(prior_std**-2.0)
    return np.linalg.solve(N, g), np.linalg.inv(N)


def _normal_equations(J: Array, d: Array, u: Array) -> tuple[Array, Array]:
    wide = (J * u[:, None, None]).reshape(-1, J.shape[2])
    return J.reshape(-1, J.shape[2]).T @ wide, wide.T @ d.ravel()


def _turns(one: Placed, seen: Evidence, k: int, v_A: Array, lights: Sequence[Light]) -> Array:
    """By how much each number of the lights turns a view's normals in A: (V, 3, 4 L); NaN where it does not see a vertex."""
    found = np.full((len(v_A), 3, 4 * len(lights)), np.nan)
    at = np.flatnonzero(seen.weight[k] > 0)
    R = one.H_AC[:3, :3]
    x_C, n_C = se3.apply(se3.inv(one.H_AC), v_A[at]), seen.normals_A[k, at].astype(float) @ R
    found[at] = np.einsum("ab,nbc->nac", R, normal_turns(x_C, n_C, lights))
    return found


def normal_turns(x_C: Array, n_C: Array, lights: Sequence[Light]) -> Array:
    """Derivative (N, 3, 4 L) of measured normals at points (N, 3) by each light's relative intensity and its source's place."""
    sources = np.array([light.source_C for light in lights])
    to = sources[None] - x_C[:, None]
    r = np.linalg.norm(to, axis=2)
    d = to / r[..., None]
    cosine = np.einsum("nlk,nk->nl", d, n_C)
    lit = cosine > FACES_LIGHT
    A = np.einsum("nl,nla,nlb->nab", lit.astype(float), d, d)
    good = lit.sum(axis=1) >= 3
    A[~good] = np.eye(3)
    M = np.linalg.solve(A + 1e-9 * np.eye(3), np.swapaxes(d * lit[..., None], 1, 2))
    P = np.eye(3) - n_C[:, :, None] * n_C[:, None]
    PM = P @ M
    across = n_C[:, None] - cosine[..., None] * d
    by_source = (across - 2 * cosine[..., None] * d) / r[..., None]
    turns = np.concatenate([(PM * cosine[:, None])[..., None], PM[..., None] * by_source[:, None]], axis=3)
    found = turns.reshape(len(x_C), 3, 4 * len(lights))
    found[~good] = np.nan
    return np.asarray(found)


def _normal_std(one: Placed, seen: Evidence, k: int) -> Array:
    """Standard deviation (V,) of a view's normals, an axis, radians."""
    std = one.view.normal_std_rad[seen.row[k], seen.column[k]]
    return np.asarray(np.hypot(np.nan_to_num(std, nan=1.0), LEAST_NORMAL_STD_RAD))


def _prior_std(lights: Sequence[Light]) -> Array:
    """Standard deviations (4 L,) of the calibration: each light's relative intensity, and its source's place."""
    found = []
    for light in lights:
        intensity = light.intensity_std / float(np.mean(light.intensity))
        place = light.position_std_m
        found += [intensity if np.isfinite(intensity) and intensity > 0 else UNKNOWN_INTENSITY]
        found += [place if np.isfinite(place) and place > 0 else UNKNOWN_PLACE_M] * 3
    return np.array(found)

r"""The offset of the camera's clock from the mocap's, before anything else is known: ``t_camera = t_mocap + offset``.

Symbols: the board and the tracked body turn relative to each other by the same angle between any two views (screw congruence)::

    angle( R_CB,i R_CB,j^T ) = angle( R_OP(t_i - offset)^T R_OP(t_j - offset) )

so the offset is where these agree, over pairs of views next to each other in time and far apart. A plateau (a camera that only took
pictures while the panel stood still) means that the data show the offset no better than the plateau is wide.
Source: the correlation of angular speeds of Furrer et al., Evaluation of combined time-offset estimation and hand-eye calibration
(2017), in the form of angle differences, which needs no even sampling.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.pose_track import PoseTrack, poses_at

REACH_S = 60.0
"""Clocks further apart than this, beyond what their ranges overlap, are not compared."""
STEP_S = 0.02
PAIR_STRIDES = (1, 2, 3, 5, 8, 13, 21, 34)
ERROR_RAD = 0.01
"""Scale of the robust cost: angles of two views agree better than this at the right offset."""
CANDIDATES = 4
MOST_LAGS = 400_000
MOST_PAIRS = 600
PLATEAU = 1.3


@dataclass(frozen=True)
class OffsetCandidate:
    """A local minimum of the disagreement of angles."""

    offset_s: float
    cost: float
    width_s: float
    """Width of the range around it over which the cost hardly rises."""


def offset_candidates(track: PoseTrack, t_camera_s: Array, H_CB: Array) -> list[OffsetCandidate]:
    """The most likely clock offsets, best first.

    Parameters
    ----------
    track : the tracked body
    t_camera_s : times (N,) of the views
    H_CB : (N, 4, 4)

    Raises
    ------
    DisagreementError
        The clocks are further apart than the search reaches.
    """
    low, high = t_camera_s.min() - track.t_s[-1], t_camera_s.max() - track.t_s[0]
    if low > REACH_S or high < -REACH_S:
        raise DisagreementError(
            f"the clocks do not meet: images from {t_camera_s.min():.1f} to {t_camera_s.max():.1f} s, mocap from {track.t_s[0]:.1f} to "
            f"{track.t_s[-1]:.1f} s",
            needed=f"recordings of the same minutes, their clocks within {REACH_S:.0f} s",
            todo="pair the right files, or state the offset: mocap.clock_offset",
        )
    i, j = _pairs(t_camera_s)
    angle = se3.angle_rad(H_CB[i, :3, :3] @ np.swapaxes(H_CB[j, :3, :3], 1, 2))
    tried = [_scan(track, t_camera_s[i], t_camera_s[j], angle, *_range(track, t_camera_s), STEP_S)]
    lags, costs = tried[0]
    best = [k for k in _minima(costs) if np.isfinite(costs[k])][:CANDIDATES]
    found = []
    for k in best:
        fine_lags, fine = _scan(track, t_camera_s[i], t_camera_s[j], angle, lags[k] - 2 * STEP_S, lags[k] + 2 * STEP_S, STEP_S / 20)
        centre = int(np.nanargmin(fine))
        offset, width = _plateau(lags, costs, k, float(fine_lags[centre]), float(fine[centre]))
        found.append(OffsetCandidate(offset, float(fine[centre]), width))
    return sorted(found, key=lambda candidate: candidate.cost)


def refine_offset(
    track: PoseTrack, t_camera_s: Array, H_CB: Array, H_PC: Array, H_OB: Array, start_s: float, reach_s: float = 0.05
) -> float:
    """The offset near a start that makes the median misplacement of the board least, H_PC and H_OB held."""
    lags = start_s + np.linspace(-reach_s, reach_s, 41)
    costs = []
    for lag in lags:
        H_OB_k = poses_at(track, t_camera_s - lag).H @ H_PC @ H_CB
        costs.append(np.median(np.linalg.norm(H_OB_k[:, :3, 3] - H_OB[:3, 3], axis=1)))
    return float(lags[int(np.argmin(costs))])


def _range(track: PoseTrack, t_camera_s: Array) -> tuple[float, float]:
    """Offsets at which a fair part of the views falls into the recording."""
    inset = 0.3 * min(np.ptp(t_camera_s), np.ptp(track.t_s))
    low, high = t_camera_s.min() - track.t_s[-1] + inset, t_camera_s.max() - track.t_s[0] - inset
    if low <= 0 <= high:  # clocks that meet as they stand are off by their start, not by a session
        low, high = max(low, -REACH_S), min(high, REACH_S)
    return float(low), float(high)


def _pairs(t_camera_s: Array) -> tuple[Array, Array]:
    order = np.argsort(t_camera_s)
    pairs = [(order[k], order[k + stride]) for stride in PAIR_STRIDES for k in range(len(order) - stride)]
    keep = np.random.default_rng(0).permutation(len(pairs))[:MOST_PAIRS]
    i, j = np.array(pairs)[keep].T
    return i, j


def _scan(track: PoseTrack, t_i: Array, t_j: Array, angle: Array, low: float, high: float, step: float) -> tuple[Array, Array]:
    """Mean robust disagreement (L,) at offsets (L,), NaN where too few pairs fall into the recording."""
    lags = np.arange(low, high + step, step)[:MOST_LAGS]
    q = se3.quaternion(track.H[:, :3, :3])
    q *= np.concatenate([[1.0], np.cumprod(np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0))])[:, None]
    costs = np.full(len(lags), np.nan)
    for chunk in np.array_split(np.arange(len(lags)), max(1, len(lags) * len(angle) // 400_000)):
        q_i, ok_i = _quaternions(track, q, t_i[None] - lags[chunk, None])
        q_j, ok_j = _quaternions(track, q, t_j[None] - lags[chunk, None])
        found = 2 * np.arccos(np.clip(np.abs(np.sum(q_i * q_j, axis=-1)), 0, 1))
        both = ok_i & ok_j
        robust = np.log1p(((found - angle) / ERROR_RAD) ** 2)
        count = both.sum(axis=1)
        mean = np.sum(np.where(both, robust, 0), axis=1) / np.maximum(count, 1)
        costs[chunk] = np.where(count >= 0.3 * len(angle), mean, np.nan)
    return lags, costs


def _quaternions(track: PoseTrack, q: Array, t: Array) -> tuple[Array, Mask]:
    """Interpolated unit quaternions (..., 4) at times (...), and whether they lie in a run."""
    at = np.clip(np.searchsorted(track.t_s, t), 1, len(track.t_s) - 1)
    share = np.clip((t - track.t_s[at - 1]) / (track.t_s[at] - track.t_s[at - 1]), 0, 1)[..., None]
    mixed = (1 - share) * q[at - 1] + share * q[at]
    inside = (t >= track.t_s[0]) & (t <= track.t_s[-1]) & (track.run[at] == track.run[at - 1])
    return mixed / np.linalg.norm(mixed, axis=-1, keepdims=True), inside


def _minima(costs: Array) -> list[int]:
    filled = np.nan_to_num(costs, nan=np.inf)
    inner = np.concatenate([[np.inf], filled, [np.inf]])
    at = np.flatnonzero((filled <= inner[:-2]) & (filled <= inner[2:]) & np.isfinite(filled))
    chosen: list[int] = []
    for k in at[np.argsort(filled[at])]:
        if all(abs(int(k) - other) * STEP_S > 0.15 for other in chosen):
            chosen.append(int(k))
    return chosen


def _plateau(lags: Array, costs: Array, k: int, offset: float, cost: float) -> tuple[float, float]:
    """The middle and the width of the stretch around a minimum over which the cost hardly rises."""
    limit = PLATEAU * cost + 0.02
    left, right = k, k
    while left > 0 and costs[left - 1] <= limit:
        left -= 1
    while right < len(lags) - 1 and costs[right + 1] <= limit:
        right += 1
    width = float(lags[right] - lags[left])
    return (offset if width <= 4 * STEP_S else float(lags[left] + lags[right]) / 2), width

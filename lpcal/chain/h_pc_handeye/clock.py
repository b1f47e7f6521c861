r"""The offset of the camera's clock from the mocap's, before anything else is known: ``t_camera = t_mocap + offset``.

Symbols: the board and the tracked body turn relative to each other by the same angle between any two views (screw congruence)::

    angle( R_CB,i R_CB,j^T ) = angle( R_OP(t_i - offset)^T R_OP(t_j - offset) )

so the offset is where these agree, over pairs of views next to each other in time and far apart. A plateau (a camera that only took
pictures while the panel stood still) means that the data show the offset no better than the plateau is wide.
Source: the correlation of angular speeds of Furrer et al., Evaluation of combined time-offset estimation and hand-eye calibration
(2017), in the form of angle differences, which needs no even sampling.

Views left out of the solve whose pose fits at another time: images stamped late, on arrival and not at exposure.

Symbols: the pose that a view's board shows, ``H_OP = H_OB inv(H_PC H_CB)``, against the track at ``t - offset - d``; a lost or flipped pose
fits at no d, one of a wrong stamp at its own. Few views are late by chance, and in slow motion a late one cannot be distinguished from the
others, so it stays in and pulls the offset: hence a warning, though the views that show it are left out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import UTC, datetime

import numpy as np
import numpy.typing as npt

from lpcal.chain.h_pc_handeye.likelihood import Views, misfit
from lpcal.chain.h_pc_handeye.state import SolveState
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.pose_track import PoseTrack, poses_at

REACH_S = 60.0
"""Offsets of clocks that meet as they stand are looked for within this of zero; clocks of unlike epoch, wherever their ranges overlap."""
STEP_S = 0.02
PAIR_STRIDES = (1, 2, 3, 5, 8, 13, 21, 34)
ERROR_RAD = 0.01
"""Scale of the robust cost: angles of two views agree better than this at the right offset."""
CANDIDATES, APART_S = 4, 0.15
MOST_LAGS = 300_000
"""Offsets that are tried at most: two clocks of unlike epoch whose recordings last an hour and a half between them."""
MOST_PAIRS, SOME_PAIRS = 600, 150
"""Pairs that are compared near a likely offset, and those that find it."""
LEAST_INSIDE = 0.3
"""Share of the pairs that must fall into the recording."""
PLATEAU = 1.3
AS_WELL = 0.5
"""Difference of costs, in logarithms of squares, up to which two offsets explain the angles alike."""
REACH_STEPS = 150
"""Steps to either side over which a plateau is followed: three seconds, as long as anybody rests for a photograph."""
MOST_RATE, RATE_STEP_S = 2e-3, 0.1
"""Largest difference of two clocks' rates that is looked for (29.97 frames counted as 30 is half of it), and the step of the search."""
MISREAD, MISREAD_GAIN = (2.0, 3.0, 4.0, 1.2, 1.25, 1.5, 5 / 3, 2.4), 2.0
"""Ratios of rates that are taken for each other (a rate doubled, 120 for 100 or 50, 60 for 24), and how many RATE_GAINs one must bring."""
RATE_GAIN = 1.0
"""How much the cost must fall, in logarithms of squares, for a rate to be believed."""


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
    DegenerateError
        Fewer than two views.
    """
    if len(track.t_s) < 2:
        return []
    scan = _Scan.of(track, t_camera_s, H_CB)
    lags = _lags(*_range(track, t_camera_s))
    costs = scan.costs(lags, SOME_PAIRS)
    found = []
    for k in _minima(costs):
        fine_lags = lags[k] + np.linspace(-2, 2, 81) * STEP_S
        fine = scan.costs(fine_lags, MOST_PAIRS)
        if not np.isfinite(fine).any():
            continue
        centre = int(np.nanargmin(fine))
        offset, width = _plateau(lags, costs, k, float(fine_lags[centre]), float(fine[centre]))
        found.append(OffsetCandidate(offset, float(fine[centre]), width))
    return sorted(found, key=lambda candidate: candidate.cost)


@dataclass(frozen=True)
class _Scan:
    """The pairs of views, and the track's rotations as they are asked for at each offset."""

    track: PoseTrack
    q_OP: Array
    """(S, 4) of the track's samples, neighbours on one half of the sphere."""
    t_camera_s: Array
    pairs: npt.NDArray[np.intp]
    """(2, P) the views of each pair, in random order."""
    angle_rad: Array
    """(P,) by which the board turned from one to the other."""

    @classmethod
    def of(cls, track: PoseTrack, t_camera_s: Array, H_CB: Array) -> _Scan:
        """All that does not depend on the offset."""
        q = se3.quaternion(track.H[:, :3, :3])
        q *= np.concatenate([[1.0], np.cumprod(np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0))])[:, None]
        i, j = pairs = _pairs(t_camera_s)
        return cls(track, q, t_camera_s, pairs, se3.angle_rad(H_CB[i, :3, :3] @ np.swapaxes(H_CB[j, :3, :3], 1, 2)))

    def costs(self, lags: Array, most: int) -> Array:
        """Mean robust disagreement (L,) of up to `most` pairs at offsets (L,), NaN where too few pairs fall into the recording."""
        (i, j), angle = self.pairs[:, :most], self.angle_rad[:most]
        costs = np.full(len(lags), np.nan)
        for chunk in np.array_split(np.arange(len(lags)), max(1, len(lags) * len(angle) // 100_000)):
            q, inside = self._rotations(self.t_camera_s[None] - lags[chunk, None])
            found = 2 * np.arccos(np.minimum(np.abs(np.einsum("lpc,lpc->lp", q[:, i], q[:, j])), 1))
            both = inside[:, i] & inside[:, j]
            robust = np.log1p(((found - angle) / ERROR_RAD) ** 2)
            count = both.sum(axis=1)
            mean = np.sum(np.where(both, robust, 0), axis=1) / np.maximum(count, 1)
            costs[chunk] = np.where(count >= LEAST_INSIDE * len(angle), mean, np.nan)
        return costs

    def _rotations(self, t: Array) -> tuple[Array, Mask]:
        """Interpolated unit quaternions (..., 4) at times (...), and whether they lie in a run."""
        t_s, run = self.track.t_s, self.track.run
        at = np.clip(np.searchsorted(t_s, t), 1, len(t_s) - 1)
        share = np.clip((t - t_s[at - 1]) / (t_s[at] - t_s[at - 1]), 0, 1)[..., None]
        mixed = (1 - share) * self.q_OP[at - 1] + share * self.q_OP[at]
        inside = (t >= t_s[0]) & (t <= t_s[-1]) & (run[at] == run[at - 1])
        return mixed / np.sqrt(np.einsum("...c,...c->...", mixed, mixed))[..., None], inside


def fits_as_well(track: PoseTrack, t_camera_s: Array, H_CB: Array, offset_s: float, best: OffsetCandidate) -> bool:
    """Whether the angles agree at an offset as they do at the best one, within what chance lets them differ by."""
    cost = float(_Scan.of(track, t_camera_s, H_CB).costs(np.array([offset_s]), MOST_PAIRS)[0])
    return bool(cost < best.cost + AS_WELL)


def as_good(track: PoseTrack, t_camera_s: Array, H_CB: Array, best: OffsetCandidate) -> tuple[float, float]:
    """The least and the largest offset of the stretch about the best one over which the angles agree as well, within what is chance."""
    lags = np.asarray(best.offset_s + STEP_S * np.arange(-REACH_STEPS, REACH_STEPS + 1), dtype=float)
    fits = _Scan.of(track, t_camera_s, H_CB).costs(lags, MOST_PAIRS) < best.cost + AS_WELL
    fits[REACH_STEPS] = True
    below, above = np.flatnonzero(~fits[:REACH_STEPS]), np.flatnonzero(~fits[REACH_STEPS:])
    first = below[-1] + 1 if below.size else 0
    last = REACH_STEPS + above[0] - 1 if above.size else 2 * REACH_STEPS
    return float(lags[first]), float(lags[last])


def without_rate(track: PoseTrack, t_camera_s: Array, H_CB: Array) -> tuple[Array, float]:
    """The camera's times (N,) with their clock's rate put right, and the rate (s/s) by which it ran fast; 0 where none is needed.

    Over a long session even a small difference of rates moves the views off the moments they were taken at. Rates up to `MOST_RATE` are
    tried, so far apart that the times at the session's ends move by `RATE_STEP_S`; one is taken where the angles then agree far better.
    """
    middle, length = float(np.mean(t_camera_s)), float(np.ptp(t_camera_s))
    count = int(MOST_RATE * length / RATE_STEP_S)
    if count < 2 or not (candidates := offset_candidates(track, t_camera_s, H_CB)):
        return t_camera_s, 0.0
    found = {0.0: candidates[0].cost}
    for rate in np.linspace(-MOST_RATE, MOST_RATE, 2 * count + 1):
        scan = _Scan.of(track, t_camera_s - rate * (t_camera_s - middle), H_CB)
        low, high = _range(track, t_camera_s)
        costs = scan.costs(_lags(low, high), SOME_PAIRS)
        if np.isfinite(costs).any():
            found[float(rate)] = min(float(np.nanmin(costs)), found.get(float(rate), np.inf))
    best = min(found, key=lambda rate: found[rate])
    if best == 0.0 or found[best] > found[0.0] - RATE_GAIN:
        return t_camera_s, 0.0
    return t_camera_s - best * (t_camera_s - middle), best


@dataclass(frozen=True)
class MisreadRate:
    """A recording whose times are those of another rate, as of a header that misstates it."""

    factor: float
    """What its times have to be multiplied by."""
    error: DisagreementError
    """The same in words."""


def misread_rate(track: PoseTrack, t_camera_s: Array, H_CB: Array) -> MisreadRate | None:
    """The rate that a recording has, where the angles fit at that one only; None where they fit as it states, or at no other.

    Any mistake of axes, order or direction leaves the angles of relative turns as they are; a rate that is misread does not.
    """
    stated = min((one.cost for one in offset_candidates(track, t_camera_s, H_CB)), default=np.inf)
    costs = {}
    for factor in (*MISREAD, *(1 / one for one in MISREAD)):
        other = replace(track, t_s=factor * track.t_s, starts_s=factor * track.starts_s, ends_s=factor * track.ends_s)
        costs[factor] = min((one.cost for one in offset_candidates(other, t_camera_s, H_CB)), default=np.inf)
    best = min(costs, key=lambda factor: costs[factor])
    if not costs[best] < stated - MISREAD_GAIN * RATE_GAIN:
        return None
    hz = 1 / float(np.median(np.diff(track.t_s)))
    error = DisagreementError(
        f"the turns of body and camera fit only if the recording runs {best:.4g} times as long: at {hz / best:.4g} Hz, not {hz:.4g}",
        needed="times of both clocks in true seconds",
        todo="correct the recording's rate (its header's, or that of the export), or the images' times",
    )
    return MisreadRate(best, error)


def epochs(track: PoseTrack, t_camera_s: Array) -> str:
    """What the two clocks count from, in words, where they do not meet as they stand; empty where they do."""
    if t_camera_s.min() <= track.t_s[-1] + REACH_S and t_camera_s.max() >= track.t_s[0] - REACH_S:
        return ""
    words = [f"{name} {_epoch(float(t))}" for name, t in (("images", t_camera_s.min()), ("mocap", track.t_s[0]))]
    return f"the clocks count from unlike epochs ({', '.join(words)}): they are lined up by the motion alone"


def _epoch(start_s: float) -> str:
    if 9e8 < start_s < 4e9:
        return f"in Unix time, {datetime.fromtimestamp(start_s, UTC):%Y-%m-%d}"
    return f"from {start_s:.1f} s"


def _range(track: PoseTrack, t_camera_s: Array) -> tuple[float, float]:
    """Offsets at which a fair part of the views falls into the recording."""
    inset = 0.3 * min(np.ptp(t_camera_s), np.ptp(track.t_s))
    low, high = t_camera_s.min() - track.t_s[-1] + inset, t_camera_s.max() - track.t_s[0] - inset
    if low <= 0 <= high:  # clocks that meet as they stand are off by their start, not by a session
        low, high = max(low, -REACH_S), min(high, REACH_S)
    return float(low), float(high)


def _lags(low: float, high: float) -> Array:
    """Offsets from low to high, `MOST_LAGS` at most: stamps of years, as a garbled file has them, are not scanned through."""
    count = min(max((high - low) / STEP_S, 0.0), MOST_LAGS)
    return np.asarray(low + STEP_S * np.arange(int(np.ceil(count))), dtype=float)


def _pairs(t_camera_s: Array) -> npt.NDArray[np.intp]:
    if len(t_camera_s) < 2:
        raise DegenerateError(
            f"{len(t_camera_s)} view with a board", needed="two and more, at different times", todo="record more views of the board"
        )
    order = np.argsort(t_camera_s)
    pairs = [(order[k], order[k + stride]) for stride in PAIR_STRIDES for k in range(len(order) - stride)]
    keep = np.random.default_rng(0).permutation(len(pairs))[:MOST_PAIRS]
    return np.array(pairs, dtype=np.intp)[keep].T


def _minima(costs: Array) -> list[int]:
    """Local minima, least first, up to `CANDIDATES` that are apart."""
    filled = np.nan_to_num(costs, nan=np.inf)
    inner = np.concatenate([[np.inf], filled, [np.inf]])
    at = np.flatnonzero((filled <= inner[:-2]) & (filled <= inner[2:]) & np.isfinite(filled))
    at = at[np.argsort(filled[at], kind="stable")]
    chosen: list[int] = []
    while len(at) and len(chosen) < CANDIDATES:
        chosen.append(int(at[0]))
        at = at[np.abs(at - at[0]) * STEP_S > APART_S]
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


FEWEST = 3
"""Views that must fit at another time: one or two may by chance."""
MOST_OF = 0.5
"""Share of the views left out that must: where stamps are what is wrong nearly all do, while of views that are out by their noise one in
five fits somewhere."""
STAMP_REACH_S = 0.3
"""Seconds by which a stamp may be off: several images of any camera that a panel is calibrated with."""
STAMP_STEP_S = 0.0025
"""Seconds between the times that are tried: a hand moves a panel by a millimetre in it."""
LEAST_S = 0.01
"""Seconds from which a stamp is off: less is the clock's own scatter."""
FITS = 3.0
"""Times the rms misfit of the views used, within which a view fits."""
NAMED = 4


def late_stamps(state: SolveState, t_camera_s: Array) -> str | None:
    """In words, where views left out fit at other times than theirs; t_camera_s (N,) are the times of all views."""
    out = np.flatnonzero(state.panel.trusted & ~state.inliers)
    if state.track is None or len(out) < FEWEST:
        return None
    found = state.estimate()
    usual = np.array([np.sqrt(np.mean(of**2)) for of in misfit(state.views(), found)])
    tried = np.arange(-STAMP_REACH_S, STAMP_REACH_S + STAMP_STEP_S / 2, STAMP_STEP_S)
    panel = poses_at(state.track, (t_camera_s[out, None] - state.offset_s - tried).ravel())
    H_CB = np.repeat(state.boards.H_CB[out], len(tried), axis=0)
    shown = Views(H_CB, panel.H, panel.velocity, np.zeros(0, dtype=np.intp), np.zeros(0))
    off = np.max(np.stack(misfit(shown, found), axis=1) / usual, axis=1)
    off = np.where(panel.trusted, off, np.inf).reshape(len(out), len(tried))
    best = np.argmin(off, axis=1)
    late = (off[np.arange(len(out)), best] < FITS) & (np.abs(tried[best]) > LEAST_S)
    if late.sum() < max(FEWEST, MOST_OF * len(out)):
        return None
    images = [state.boards.images[row] for row in out[late]]
    more = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
    by_ms = 1e3 * float(np.median(tried[best[late]]))
    return (
        f"the stamps of {len(images)} images do not hold: {abs(by_ms):.0f} ms {'earlier' if by_ms > 0 else 'later'} (median) their views "
        f"fit as the others do: {', '.join(images[:NAMED])}{more}. They are left out; others that are as late in slow motion are not, and "
        "may bend H_PC and the clock offset beyond their sigmas: stamp the images at exposure, not on arrival"
    )

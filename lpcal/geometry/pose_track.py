"""H_AB at any time: the stream of a tracked body without its outliers, interpolated.

Symbols: samples (t_n, H_AB,n); a run is a sequence of samples without a gap or a jump; angular speed
``w_n = angle(R_n+1 R_n^T) / (t_n+1 - t_n)``. A body whose markers are swapped flips: at the transition the angular speed is beyond that of
any handheld or robot motion, and one flipped neighbour corrupts an interpolation. A lasting flip shows in the tracking system's marker
error and in the hand-eye solve, not in the speed. Thresholds were measured on real and rendered streams.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask

JUMP_RAD_S = 10.0
"""Angular speed, rad/s, above which the step between two samples is a jump."""
JUMP_M_S, JUMP_RATIO = 20.0, 50.0
"""Speed, m/s, above which a step is a jump, if it is also this many times the recording's fast steps (its unit may be misstated)."""
SHORTEST_RUN_S = 0.3
CHAIN_S = 0.5
"""Longest flip or gap, seconds, across which a run is joined to an earlier one."""
GUARD_S = 0.05
"""Time, seconds, at either end of a run that is not interpolated: 30 ms were too short, 50 ms are enough."""
GAP_SAMPLES = 3.5
"""Gap, in sampling intervals, that ends a run."""
ERROR_RATIO, ERROR_FLOOR_M = 5.0, 1e-3
"""A marker error above this many medians plus this many metres is a swap of markers."""
DWELL_S = 0.2
"""Time, seconds, to either side of an asked time over which the poses of a body at rest are averaged."""
DWELL_SAMPLES = 6
"""Smallest number of samples in each half of a dwell."""
DRIFT_SIGMAS = 1.0
"""Largest difference of the means of a dwell's halves, or of its inner and outer quarters, in standard deviations of one sample: uniform
motion gives 3.5, a turning point 1.7."""
VELOCITY_SAMPLES = 3
"""Sampling intervals to either side over which a velocity is computed."""
MOVED_SIGMAS = 6.0
"""A difference of two samples below this many standard deviations of a coordinate counts as rest, so that noise makes no velocity."""


@dataclass(frozen=True)
class PoseTrack:
    """Inlying samples of a track. Row n of all arrays is one sample."""

    t_s: Array
    H: Array
    run: npt.NDArray[np.intp]
    """(N,) index of the run that a sample belongs to; the samples of a run are consecutive."""
    starts_s: Array
    """(R,) start of the trusted interval of each run."""
    ends_s: Array
    dropped: dict[str, int]
    """Numbers of rejected samples, by reason."""
    variance: Array | None = None
    """(N, 6) variances of rotation and origin along the axes of A, relative to the usual ones; None: all equal."""
    inverse: bool = False
    """Whether `poses_at` returns H_BA instead of H_AB."""

    @cached_property
    def rows(self) -> Array:
        """(N, 12) origin and rotation of each sample minus their mean over the track."""
        return np.concatenate([self.H[:, :3, 3], self.H[:, :3, :3].reshape(-1, 9)], axis=1) - self.centre

    @cached_property
    def centre(self) -> Array:
        """(12,) mean of origin and rotation."""
        return np.concatenate([self.H[:, :3, 3].mean(axis=0), self.H[:, :3, :3].mean(axis=0).ravel()])

    @cached_property
    def sample_noise(self) -> tuple[float, float]:
        """Standard deviations of a coordinate of the origin (m) and of the rotation (rad), from second differences of the samples."""
        second = self.rows[2:] - 2 * self.rows[1:-1] + self.rows[:-2]
        if not len(second):
            return 0.0, 0.0
        noise = 1.4826 * np.median(np.abs(second), axis=0) / np.sqrt(6)
        return float(np.sqrt(np.mean(noise[:3] ** 2))), float(np.sqrt(np.sum(noise[3:] ** 2) / 6))

    @cached_property
    def running_sums(self) -> tuple[Array, Array]:
        """(N + 1, 12) sums of `rows` and of their squares over the samples before each."""
        rows = np.concatenate([np.zeros((1, 12)), self.rows])
        return np.cumsum(rows, axis=0), np.cumsum(rows**2, axis=0)


@dataclass(frozen=True)
class TrackPoses:
    """H_AB at given times. Row k is one time."""

    t_mocap_s: Array
    H: Array
    """(N, 4, 4); the nearest sample's where none can be trusted."""
    velocity: Array
    """(N, 6) velocity of the rotation (rad/s) and of the origin of B (m/s), along the axes of A."""
    why: tuple[str | None, ...]
    """(N,) reasons not to trust a pose; None where it is trusted."""
    steady: Mask
    """(N,) where the body was at rest, so that the pose is a mean over the dwell."""
    variance: Array | None = None
    """(N, 6) as `PoseTrack.variance`."""

    @property
    def trusted(self) -> Mask:
        """Mask (N,) of trusted poses."""
        return np.array([why is None for why in self.why], dtype=bool)

    def inverse(self) -> TrackPoses:
        """The inverse poses H_BA with their velocities; the variances remain those of H_AB."""
        R_BA, x_A = np.swapaxes(self.H[:, :3, :3], 1, 2), self.H[:, :3, 3]
        w, v = self.velocity[:, :3], self.velocity[:, 3:]
        turned = np.stack([-w, np.cross(w, x_A) - v], axis=1) @ np.swapaxes(R_BA, 1, 2)
        return replace(self, H=se3.inv(self.H), velocity=turned.reshape(-1, 6))


def clean(t_s: Array, H_AB: Array, error_m: Array, variance: Array | None = None) -> PoseTrack:
    """A track from samples H_AB (N, 4, 4) at increasing times (N,): swapped markers, jumps and short runs are rejected.

    `error_m` (N,) is the tracking system's own marker error, NaN where it gives none; `variance` (N, 6) as `PoseTrack`'s.
    """
    interval = float(np.median(np.diff(t_s))) if len(t_s) > 1 else 1.0
    swapped = _swapped(error_m)
    t_s, H_AB, variance = t_s[~swapped], H_AB[~swapped], None if variance is None else variance[~swapped]
    dropped = {"markers swapped, by the system's own error": int(swapped.sum())}
    if len(t_s) < 2:
        return PoseTrack(t_s, H_AB, np.zeros(len(t_s), dtype=np.intp), t_s, t_s, dropped)
    dt = np.diff(t_s)
    R, x_A = H_AB[:, :3, :3], H_AB[:, :3, 3]
    speed = np.linalg.norm(np.diff(x_A, axis=0), axis=1) / dt
    jump = (_neighbour_angle(R) > JUMP_RAD_S * dt) | (speed > max(JUMP_M_S, JUMP_RATIO * float(np.quantile(speed, 0.9))))
    run = np.concatenate([[0], np.cumsum(jump | (dt > GAP_SAMPLES * interval))])
    first, last = np.flatnonzero(np.diff(run, prepend=-1)), np.flatnonzero(np.diff(run, append=run[-1] + 1))
    chain = _chains(t_s, H_AB, first, last)
    stretch = _stretches(chain, t_s[first], t_s[last], GAP_SAMPLES * interval)
    size = np.bincount(stretch, last - first + 1)[stretch]
    kept = _lasting(chain, t_s[first], t_s[last]) & (size > 1)
    dropped["in stretches that jump away from the rest and back, or shorter than 0.3 s"] = int(np.sum((last - first + 1)[~kept]))
    of_sample, number = kept[run], np.unique(stretch[kept], return_inverse=True)
    begin, end = first[number[0]], np.zeros(len(number[0]), dtype=np.intp)
    np.maximum.at(end, number[1], last[kept])
    guard = max(GUARD_S, 1.5 * interval)
    starts_s = t_s[begin] + guard * (begin > 0)
    ends_s = t_s[end] - guard * (end < len(t_s) - 1)
    of_run = np.zeros(len(kept), dtype=np.intp)
    of_run[kept] = number[1]
    variance = None if variance is None else variance[of_sample]
    return PoseTrack(t_s[of_sample], H_AB[of_sample], of_run[run[of_sample]], starts_s, ends_s, dropped, variance)


def poses_at(track: PoseTrack, t_mocap_s: Array) -> TrackPoses:
    """Interpolated poses at times (N,) on the mocap's clock, their velocities, and reasons not to trust them.

    Rotations are interpolated along the geodesic and origins linearly between the two neighbouring samples of a run; at rest the pose is
    the mean over the dwell.
    """
    t = np.asarray(t_mocap_s, dtype=float)
    if len(track.t_s) < 2 or not len(track.starts_s):
        why_not = ("the recording holds no stretch of 0.3 s without a jump",) * len(t)
        return TrackPoses(t, np.tile(np.eye(4), (len(t), 1, 1)), np.zeros((len(t), 6)), why_not, np.zeros(len(t), dtype=bool))
    of = np.searchsorted(track.starts_s, t, side="right") - 1
    inside = (of >= 0) & (t <= track.ends_s[np.maximum(of, 0)])
    why = tuple(None if ok else _why_not(track, time) for ok, time in zip(inside, t, strict=True))
    held = np.where(inside, t, np.clip(t, track.t_s[0], track.t_s[-1]))
    H_AB = se3.interpolate(track.H, track.t_s, held)
    H_dwell, steady = _dwells(track, t, np.where(inside, of, -1))
    velocity = np.where(steady[:, None], 0.0, _velocity(track, held))
    found = TrackPoses(t, np.where(steady[:, None, None], H_dwell, H_AB), velocity, why, steady, _variance(track, held))
    return found.inverse() if track.inverse else found


def _swapped(error_m: Array) -> Mask:
    """Mask (N,) of samples whose marker error is far above the median."""
    known = error_m[np.isfinite(error_m)]
    if not known.size:
        return np.zeros(len(error_m), dtype=bool)
    return np.nan_to_num(error_m, nan=0.0) > ERROR_RATIO * np.median(known) + ERROR_FLOOR_M


def _chains(t_s: Array, H_AB: Array, first: npt.NDArray[np.intp], last: npt.NDArray[np.intp]) -> npt.NDArray[np.intp]:
    """Index (R,) of the chain of each run: a run is joined to the latest earlier one from which a plausible motion leads to it.

    A flip and its return thus become two chains, that of the true poses and that of the flipped ones.
    """
    chain = np.zeros(len(first), dtype=np.intp)
    ends: list[int] = []
    for run in range(len(first)):
        for number in sorted(range(len(ends)), key=lambda n: -ends[n]):
            end, dt = ends[number], float(t_s[first[run]] - t_s[ends[number]])
            turn = float(_neighbour_angle(H_AB[[end, first[run]], :3, :3])[0])
            if dt > CHAIN_S or (turn < JUMP_RAD_S * min(dt, 0.1) and _shift(H_AB, end, first[run]) < JUMP_M_S * dt):
                chain[run] = number if dt <= CHAIN_S else len(ends)
                break
        else:
            chain[run] = len(ends)
        if chain[run] == len(ends):
            ends.append(int(last[run]))
        ends[chain[run]] = int(last[run])
    return chain


def _stretches(chain: npt.NDArray[np.intp], start_s: Array, end_s: Array, reach_s: float) -> npt.NDArray[np.intp]:
    """First run (R,) of the stretch of each run: runs of a chain that are few samples apart form one stretch."""
    stretch = np.arange(len(chain))
    latest: dict[int, int] = {}
    for run, of in enumerate(chain.tolist()):
        before = latest.get(of)
        if before is not None and start_s[run] - end_s[before] <= reach_s:
            stretch[run] = stretch[before]
        latest[of] = run
    return stretch


def _shift(H_AB: Array, i: int, j: int) -> float:
    return float(np.linalg.norm(H_AB[j, :3, 3] - H_AB[i, :3, 3]))


def _lasting(chain: npt.NDArray[np.intp], start_s: Array, end_s: Array) -> Mask:
    """Mask (R,) of runs in chains of 0.3 s and more in total that no longer chain contradicts at the same time."""
    length = np.bincount(chain, end_s - start_s)
    begin, end = (np.array([find(of[chain == n]) for n in range(len(length))]) for find, of in ((np.min, start_s), (np.max, end_s)))
    whole = float(end_s[-1] - start_s[0])
    good = length >= min(SHORTEST_RUN_S, 0.5 * whole)
    for n in np.argsort(-length):
        over = (begin < end[n]) & (end > begin[n]) & (length < length[n])
        if good[n]:
            good &= ~over
    return np.asarray(good[chain])


def _neighbour_angle(R: Array) -> Array:
    """Angles (N-1,) between neighbouring rotations: 2 asin of half the chord, accurate enough for speeds."""
    chord = np.linalg.norm((R[1:] - R[:-1]).reshape(-1, 9), axis=1)
    return np.asarray(2 * np.arcsin(np.clip(chord / np.sqrt(8), 0, 1)))


def _velocity(track: PoseTrack, t: Array) -> Array:
    """Velocities (N, 6) over VELOCITY_SAMPLES intervals to either side within the run; zero where the motion is within the noise."""
    at = np.clip(np.searchsorted(track.t_s, t), 1, len(track.t_s) - 1)
    low, high = np.maximum(at - VELOCITY_SAMPLES, 0), np.minimum(at + VELOCITY_SAMPLES - 1, len(track.t_s) - 1)
    for _ in range(VELOCITY_SAMPLES):
        low += track.run[low] < track.run[at - 1]
        high -= track.run[high] > track.run[at]
    high = np.maximum(high, low + 1)
    high, low = np.minimum(high, len(track.t_s) - 1), np.minimum(low, len(track.t_s) - 2)
    dt = (track.t_s[high] - track.t_s[low])[:, None]
    R = track.H[:, :3, :3]
    turn = se3.rotation_vector(R[high] @ np.swapaxes(R[low], 1, 2))
    shift = track.H[high, :3, 3] - track.H[low, :3, 3]
    noise_m, noise_rad = track.sample_noise
    moved = (np.linalg.norm(shift, axis=1) > MOVED_SIGMAS * noise_m) | (np.linalg.norm(turn, axis=1) > MOVED_SIGMAS * noise_rad)
    return np.where(moved[:, None], np.concatenate([turn, shift], axis=1) / dt, 0.0)


def _variance(track: PoseTrack, t: Array) -> Array | None:
    """Variances (N, 6) at times (N,), interpolated between the samples."""
    if track.variance is None:
        return None
    return np.stack([np.interp(t, track.t_s, column) for column in track.variance.T], axis=1)


def _dwells(track: PoseTrack, t: Array, run: npt.NDArray[np.intp]) -> tuple[Array, Mask]:
    """Mean poses (M, 4, 4) over the dwells around times (M,) in runs (M,), and a mask (M,) of those at rest.

    At rest the means of the halves before and after the time agree within DRIFT_SIGMAS, and so do those of the inner and outer quarters,
    which tell a turning point from rest.
    """
    inside = run >= 0
    low, high = np.maximum(t - DWELL_S, track.starts_s[run]), np.minimum(t + DWELL_S, track.ends_s[run])
    half = np.minimum(t - low, high - t)
    edges = np.searchsorted(track.t_s, t + np.array([-1.0, -0.5, 0.0, 0.5, 1.0])[:, None] * half)
    counts = np.diff(edges, axis=0)
    enough = inside & ((counts[:2].sum(axis=0) >= DWELL_SAMPLES) & (counts[2:].sum(axis=0) >= DWELL_SAMPLES)) & (counts.min(axis=0) > 0)
    sums, squares = (np.diff(running[edges], axis=0) for running in track.running_sums)
    counts = np.maximum(counts, 1)[..., None]
    quarter = sums / counts
    in_half = counts.reshape(2, 2, -1, 1).sum(axis=1)
    means = sums.reshape(2, 2, *sums.shape[1:]).sum(axis=1) / in_half
    scatter = np.mean(np.maximum(squares.reshape(2, 2, *sums.shape[1:]).sum(axis=1) / in_half - means**2, 0), axis=0)
    drift, turning = means[1] - means[0], (quarter[0] - quarter[1] - quarter[2] + quarter[3]) / 2
    steady = enough.copy()
    for part in (slice(0, 3), slice(3, 12)):
        limit = DRIFT_SIGMAS**2 * scatter[:, part].sum(axis=1)
        steady &= ((drift[:, part] ** 2).sum(axis=1) <= limit) & ((turning[:, part] ** 2).sum(axis=1) <= limit)
    mean = track.centre + sums.sum(axis=0) / counts.sum(axis=0)
    return se3.transform(se3.nearest_rotation(mean[:, 3:].reshape(-1, 3, 3)), mean[:, :3]), steady


def _why_not(track: PoseTrack, t: float) -> str:
    if t < track.starts_s[0] or t > track.ends_s[-1]:
        return "outside the mocap recording"
    return "the body was lost, or its markers swapped, within 50 ms"

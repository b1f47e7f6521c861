r"""H_OP at any time: the tracked body's stream as a track that can be asked for a pose at a time.

The mathematics is `lpcal.geometry.pose_track`: samples that tracking got wrong are left out, poses are interpolated within runs. Poses
made of markers come with a covariance C of the left perturbation; the error of the origin t_OP is its ``rho + phi x t_OP``.

Stop and shoot without a clock: the rests of the panel, matched in order to images, by the angles between them alone.

Symbols: rests m = 1..M of the recording with mean pose H_OP,m; views k = 1..N in the order in which they were taken, H_CB,k. Body and
camera turn by equal angles (screw congruence), so that for the rest m(k) of each view, m increasing with k::

    angle( R_CB,k R_CB,l^T ) = angle( R_OP,m(k)^T R_OP,m(l) )

A view may lack its rest (a flipped body) and a rest its image (a pause): the cheapest increasing match of consecutive views is found by
dynamic programming, put through the closed form among outliers, and matched again by how far each view's board then is from its place.
The match is accepted where the angles of pairs of all views agree.
Source: the angle's invariance, Chen 1991; dynamic programming as in sequence alignment, Needleman & Wunsch (1970).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import park, pose_track, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.pose_track import PoseTrack, TrackPoses, poses_at
from lpcal.records.body_course import BodyCourse, Lapse
from lpcal.records.observations import PoseStream


def track_of(stream: PoseStream) -> pose_track.PoseTrack:
    """The trusted samples of a stream, H_OP, cut into runs without a gap or a jump.

    Raises
    ------
    DegenerateError
        No sample can be trusted.
    """
    variance = None if stream.covariance is None else _over_the_usual(stream.covariance, stream.H_OP)
    track = pose_track.clean(stream.t_s, stream.H_OP, stream.error_m, variance)
    if not len(track.t_s):
        why = ", ".join(f"{count} {reason}" for reason, count in track.dropped.items() if count)
        raise DegenerateError(
            f"none of the {len(stream.t_s)} poses of {stream.body or 'the body'} can be trusted{': ' * bool(why)}{why}",
            needed="a recording of some seconds in which the body moves as a panel can",
            todo="look at the recording: are its markers, its units and its rate right?",
        )
    return track


def _over_the_usual(covariance: Array, H_OP: Array) -> Array:
    """Variances (N, 6) of rotation and origin along the axes of O, each over its median."""
    T = se3.turn_and_origin_jacobian(H_OP)
    variance = np.einsum("nij,njk,nik->ni", T, covariance, T)
    usual = [float(np.median(variance[:, part].mean(axis=1))) for part in (slice(0, 3), slice(3, 6))]
    return np.asarray(variance / np.repeat(usual, 3))


STEP_S = 0.05
SAME_M, SAME_RAD = 3e-3, np.deg2rad(0.5)
"""How far a rest's pose may wander."""
MOMENT = 3
"""Steps to either side over which the body is to stay."""
SHORTEST_S = 0.2
"""Time over which the body is seen to rest, besides these steps."""
ERROR_RAD, ERROR_M = np.deg2rad(0.3), 3e-3
"""Scales of the robust costs."""
SKIPPED_VIEW, SKIPPED_REST = 4.0, 0.05
AGREE_RAD = np.deg2rad(1.0)
LEAST_AGREEING = 0.6
FEWEST = 4


@dataclass(frozen=True)
class Rests:
    """Stretches in which the body stood still. Row m is one."""

    t_s: Array
    """(M,) their middles."""
    length_s: Array
    H_OP: Array
    """(M, 4, 4)."""


def rests_of(track: PoseTrack) -> Rests:
    """The rests of a recording."""
    t = np.arange(track.t_s[0], track.t_s[-1], STEP_S) if len(track.t_s) > 1 else np.zeros(0)
    found = poses_at(track, t)
    spans: list[tuple[int, int]] = []
    still = _still(found)
    for k in np.flatnonzero(still):
        goes_on = spans and k == spans[-1][1] + 1 and _same(found.H[spans[-1][0]], found.H[k])
        if goes_on:
            spans[-1] = (spans[-1][0], int(k))
        else:
            spans.append((int(k), int(k)))
    merged: list[tuple[int, int]] = []
    for first, last in spans:  # noise may break a rest
        if merged and t[first] - t[merged[-1][1]] < 2 * SHORTEST_S and _same(found.H[merged[-1][1]], found.H[first]):
            merged[-1] = (merged[-1][0], last)
        else:
            merged.append((first, last))
    long = [(first, last) for first, last in merged if t[last] - t[first] >= SHORTEST_S]
    H_OP = [_mean(found.H[first : last + 1][still[first : last + 1]]) for first, last in long]
    begin, end = (np.array([t[span[side]] for span in long]) for side in (0, 1))
    return Rests((begin + end) / 2, end - begin, np.array(H_OP).reshape(-1, 4, 4))


def match_rests(rests: Rests, H_CB: Array) -> npt.NDArray[np.intp]:
    """The rest (N,) of each view H_CB (N, 4, 4), the views in the order in which they were taken; -1: none.

    Raises
    ------
    DisagreementError
        Fewer rests than make a match, or none whose angles agree with the views'.
    """
    if min(len(rests.t_s), len(H_CB)) < FEWEST:
        raise DisagreementError(
            f"{len(rests.t_s)} rests of the body in the recording for {len(H_CB)} views",
            needed="the panel held still for a second at every image, or the images' times",
            todo="give the times: mocap.images, a csv of file,time_s",
        )
    turn_seen = se3.angle_rad(H_CB[:, None, :3, :3] @ np.swapaxes(H_CB[None, :, :3, :3], -1, -2))
    R_OP = rests.H_OP[:, :3, :3]
    turn_body = se3.angle_rad(np.swapaxes(R_OP[:, None], -1, -2) @ R_OP[None])
    match = _aligned(np.zeros((len(H_CB), len(rests.t_s))), turn_seen, turn_body)
    for _ in range(3):
        rows = np.flatnonzero(match >= 0)
        if len(rows) < FEWEST:
            break
        agreed = park.consensus(rests.H_OP[match[rows]], H_CB[rows])
        again = _aligned(_placed(rests.H_OP, H_CB, agreed), None, None)
        if np.array_equal(again, match):
            break
        match = again
    rows = np.flatnonzero(match >= 0)
    pairs = np.abs(turn_seen[np.ix_(rows, rows)] - turn_body[np.ix_(match[rows], match[rows])])
    agree = np.mean(np.median(pairs, axis=1) < AGREE_RAD) if len(rows) else 0.0
    if len(rows) < max(FEWEST, LEAST_AGREEING * len(H_CB)) or agree < LEAST_AGREEING:
        raise DisagreementError(
            f"the {len(H_CB)} views do not match the {len(rests.t_s)} rests of the body in order: the angles between them differ",
            needed="images in the order in which they were taken, the panel held still for a second at each",
            todo="give the images' times: mocap.images, a csv of file,time_s; or check mocap.body and mocap.direction",
        )
    return match


def _still(found: TrackPoses) -> Mask:
    """Times (N,) about which the body is where it was a moment before and after, but for noise and a hand's tremor."""
    still = np.zeros(len(found.H), dtype=bool)
    before, after = found.H[: -2 * MOMENT], found.H[2 * MOMENT :]
    near = np.linalg.norm(after[:, :3, 3] - before[:, :3, 3], axis=1) < SAME_M
    turned = se3.angle_rad(after[:, :3, :3] @ np.swapaxes(before[:, :3, :3], 1, 2)) < SAME_RAD
    trusted = found.trusted
    still[MOMENT:-MOMENT] = near & turned & trusted[: -2 * MOMENT] & trusted[MOMENT:-MOMENT] & trusted[2 * MOMENT :]
    return still


def _same(H: Array, other: Array) -> bool:
    return bool(np.linalg.norm(H[:3, 3] - other[:3, 3]) < SAME_M and se3.angle_rad(H[:3, :3] @ other[:3, :3].T) < SAME_RAD)


def _mean(H: Array) -> Array:
    return se3.transform(se3.nearest_rotation(H[:, :3, :3].mean(axis=0)), H[:, :3, 3].mean(axis=0))


def _placed(H_OP: Array, H_CB: Array, agreed: park.Consensus) -> Array:
    """Cost (N, M) of view k at rest m by how far its board then is from H_OB."""
    H = H_OP[None] @ agreed.H_PC @ H_CB[:, None]
    angle = se3.angle_rad(H[..., :3, :3] @ agreed.H_OB[:3, :3].T)
    distance = np.linalg.norm(H[..., :3, 3] - agreed.H_OB[:3, 3], axis=-1)
    return np.asarray(np.log1p((angle / (2 * ERROR_RAD)) ** 2 + (distance / ERROR_M) ** 2))


def _aligned(own: Array, turn_seen: Array | None, turn_body: Array | None) -> npt.NDArray[np.intp]:
    """The cheapest increasing match, -1 where a view is better left out.

    `own` (N, M) is the cost of view k at rest m; with the turns (N, N) and (M, M) that of consecutive views is added. best[k, m] is the
    least cost of the views up to k with k at m.
    """
    count, rests = own.shape
    best, previous = np.full((count, rests), np.inf), np.full((count, rests, 2), -1)
    order = np.arange(rests)
    between = np.maximum(order[None] - order[:, None] - 1, 0) * SKIPPED_REST
    later = order[None] > order[:, None]
    for k in range(count):
        best[k] = own[k] + k * SKIPPED_VIEW + order * SKIPPED_REST
        for before in range(max(0, k - 4), k):
            step = between + (k - before - 1) * SKIPPED_VIEW
            if turn_seen is not None and turn_body is not None:
                step = step + np.log1p(((turn_body - turn_seen[before, k]) / ERROR_RAD) ** 2)
            through = np.where(later, best[before][:, None] + step, np.inf)
            cheapest = np.argmin(through, axis=0)
            cost = through[cheapest, order] + own[k]
            better = cost < best[k]
            best[k, better] = cost[better]
            previous[k, better] = np.stack([np.full(rests, before), cheapest], axis=1)[better]
    total = best + (count - 1 - np.arange(count))[:, None] * SKIPPED_VIEW
    k, m = (int(place) for place in np.unravel_index(int(np.argmin(total)), total.shape))
    match = np.full(count, -1, dtype=np.intp)
    while k >= 0:
        match[k] = m
        k, m = (int(place) for place in previous[k, m])
    return match


MOMENTS = 240
"""Moments of a recording that are kept for its drawing: two units of a drawing 480 wide."""
SHORT_LAPSES = 60
"""Stretches without a pose to trust that are kept, the longest ones; a recording with more is poor in any case."""


def course_of(stream: PoseStream, track: PoseTrack, *, inverse: bool = False) -> BodyCourse:
    """The body over the recording at MOMENTS even times where its pose is to be trusted, and the stretches between where it is not.

    `inverse`: the stream holds H_PO.
    """
    t_s = np.linspace(stream.t_s[0], stream.t_s[-1], MOMENTS)
    run = np.searchsorted(track.starts_s, t_s, side="right") - 1
    t_s = t_s[(run >= 0) & (t_s <= track.ends_s[np.maximum(run, 0)])]
    H_OP = track.H[np.clip(np.searchsorted(track.t_s, t_s), 0, len(track.t_s) - 1)]
    H_OP = se3.inv(H_OP) if inverse else H_OP
    x_O = H_OP[:, :3, 3]
    moved_m = np.linalg.norm(x_O - np.median(x_O, axis=0), axis=1) if len(t_s) else np.zeros(0)
    turned_rad = se3.angle_rad(np.swapaxes(H_OP[:, :3, :3], -1, -2) @ H_OP[moved_m.argmin(), :3, :3]) if len(t_s) else np.zeros(0)
    return BodyCourse(t_s, moved_m, np.asarray(turned_rad), _lapses(stream.t_s, track))


def _lapses(t_s: Array, track: PoseTrack) -> tuple[Lapse, ...]:
    """Stretches of a recording t_s (N,) outside the track's runs; the guard at a run's edge counts as the run's.

    Two runs that follow one another without a gap are parted by a jump: a stretch of next to no length.
    """
    edges = np.concatenate([[t_s[0]], np.column_stack([track.starts_s, track.ends_s]).ravel(), [t_s[-1]]]).reshape(-1, 2)
    interval = float(np.median(np.diff(t_s))) if len(t_s) > 1 else 0.0
    guard = max(pose_track.GUARD_S, 1.5 * interval)
    found = []
    for k, (end, start) in enumerate(edges.tolist()):
        outer = k in {0, len(edges) - 1}
        low, high = end + guard * (k > 0), start - guard * (k < len(edges) - 1)
        if outer and high - low <= interval:
            continue
        low, high = min(low, high), max(low, high)
        inside = int(np.sum((t_s > low + 1e-9) & (t_s < high - 1e-9)))
        found.append(Lapse(low, high, tracked=high - low <= 1.5 * interval or inside * interval > 0.5 * (high - low)))
    longest = sorted(found, key=lambda one: one.start_s - one.end_s)[:SHORT_LAPSES]
    return tuple(sorted(longest, key=lambda one: one.start_s))

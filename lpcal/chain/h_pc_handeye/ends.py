"""By which end each view's board was found, settled by the panel's poses.

A board of like counts (9x7) looks alike turned by half a turn, so each view is found by either end; only one of the two places the board
where the other views do. Both ends of every view stand as candidates in one search for what a majority agrees on.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.chain.h_pc_handeye.camera_part import turned_by_half
from lpcal.geometry import park
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.observations import BoardPoses

FITS = 0.03
"""Misplacement of the board, as a share of its distance, up to which the ends are taken as they were found."""
MENDS = 0.2
"""Share of its misplacement that the board must keep, at most, once the ends are settled, for them to be believed wrong."""
SAMPLES, SAMPLE_VIEWS, SEED = 600, 4, 0
"""Samples of views whose ends are drawn too: one in eight has all its ends alike."""
FEWEST = 6
READMIT = 5.0
"""Times the worst residual of the views that agree, up to which a board turned by half counts as agreeing."""


def settled_ends(boards: BoardPoses, H_OP: Array, trusted: Mask) -> tuple[BoardPoses, Mask]:
    """The boards, all found by the same end, and the views (N,) that were turned; as they are where that makes no more of them agree."""
    none = np.zeros(len(trusted), dtype=bool)
    if boards.corners_px is None or boards.points_B is None or trusted.sum() < FEWEST:
        return boards, none
    H_CB, poses = boards.H_CB[trusted], H_OP[trusted]
    distance = float(np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1)))
    plain = park.consensus(poses, H_CB)
    if plain.scatter_m < FITS * distance:
        return boards, none
    turned = turned_by_half(boards)
    ends = np.stack([H_CB, turned.H_CB[trusted]])
    rng = np.random.default_rng(SEED)
    picks = np.argsort(rng.random((SAMPLES, len(poses))), axis=1)[:, :SAMPLE_VIEWS]
    drawn = rng.integers(0, 2, picks.shape)
    H_PC, H_OB = park.park(poses[picks], ends[drawn, picks])
    misses = np.array([_misses(poses, ends, one_PC, one_OB, distance) for one_PC, one_OB in zip(H_PC, H_OB, strict=True)])
    best = misses[int(np.argmin(np.median(misses.min(axis=1), axis=1)))]
    second = best[1] < best[0]
    agreed = park.consensus(poses, np.where(second[:, None, None], ends[1], ends[0]))
    if not agreed.scatter_m < min(MENDS * plain.scatter_m, FITS * distance):
        return boards, none
    other = none.copy()
    other[trusted] = second if second.sum() <= len(second) / 2 else ~second  # as few as can be are turned
    return with_turned(boards, turned, other), other


def all_ends(boards: BoardPoses, H_OP: Array, trusted: Mask) -> tuple[BoardPoses, Mask]:
    """As `settled_ends`, and the few views too that a majority, found by one end, places better by their other end."""
    boards, other = settled_ends(boards, H_OP, trusted)
    if boards.corners_px is None or boards.points_B is None or trusted.sum() < FEWEST:
        return boards, other
    H_CB = boards.H_CB[trusted]
    agreed = park.consensus(H_OP[trusted], H_CB)
    _, wrong, _, _ = found_by_other_end(replace(boards, H_CB=H_CB, corners_px=boards.corners_px[trusted]), H_OP[trusted], agreed)
    more = np.zeros(len(trusted), dtype=bool)
    more[trusted] = wrong
    return with_turned(boards, turned_by_half(boards), more), other ^ more


def found_by_other_end(boards: BoardPoses, H_OP: Array, agreed: park.Consensus) -> tuple[BoardPoses, Mask, Array, Array]:
    """The boards turned by half, the views (N,) off that are so placed where the others are, and the turned ones' residuals (rad, m)."""
    turned = turned_by_half(boards)
    angle, distance = park.residuals(H_OP, turned.H_CB, agreed.H_PC, agreed.H_OB)
    if not agreed.inliers.any():
        return turned, agreed.inliers.copy(), angle, distance
    fits = (angle <= READMIT * agreed.residual_rad[agreed.inliers].max()) & (distance <= READMIT * agreed.residual_m[agreed.inliers].max())
    return turned, ~agreed.inliers & fits & (angle < 0.2 * agreed.residual_rad), angle, distance


def with_turned(boards: BoardPoses, turned: BoardPoses, which: Mask) -> BoardPoses:
    """The boards, those of the mask (N,) as they are when turned by half."""
    corners = np.where(which[:, None, None], np.asarray(turned.corners_px), np.asarray(boards.corners_px))
    return replace(boards, H_CB=np.where(which[:, None, None], turned.H_CB, boards.H_CB), corners_px=corners)


def _misses(H_OP: Array, ends: Array, H_PC: Array, H_OB: Array, distance: float) -> Array:
    """By how much (2, N) each end of each view's board misses its place, the angle acting over half its distance."""
    found = [park.residuals(H_OP, H_CB, H_PC, H_OB) for H_CB in ends]
    return np.array([metres + 0.5 * distance * angle for angle, metres in found])

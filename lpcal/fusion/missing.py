r"""Parts that no view has seen well, the next panel pose, and what it would gain.

Symbols: s a sample of the surface with area a_s and normal n_s; H_AC a camera that might stand somewhere, d its distance to the object's
middle. Samples are the model's vertices that one view alone sees, and points of the caps that close its open edges: no view saw what is
there, the cap stands for it. A candidate sees a sample that faces it within 65 degrees, lies in its image, and is not
behind the model or a cap (a depth buffer)::

    gain = sum_unseen a_s + w sum_once a_s              over the samples that it sees

Candidates look at the middle from a sphere of directions within REACH of a stop, at the views' own distance, where the wings serve as they
are; and nearer and farther, where they would have to be set again. The best is taken, what it shows counts as seen, and so on.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.fusion.align import Aligned
from lpcal.fusion.correspondences import Placed
from lpcal.fusion.vertices import Vertices
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.records.model import Missing, NextStop

DIRECTIONS = 160
"""Directions on the sphere from which the panel might look, some 16 degrees apart: a view shows as much a few degrees off."""
REACH_RAD = float(np.radians(75.0))
"""How far from the nearest stop a direction may lie: beyond it a floor or a wall is as likely as a place to stand."""
OTHER_DISTANCES = (0.7, 1.4)
"""Distances over the usual one at which the panel might stand with its wings set again."""
WORTH_A_RESET = 1.25
"""By how much more another distance must show to be named: wings that are set again are calibrated again."""
FACING = float(np.cos(np.radians(65.0)))
"""Least cosine between a sample's normal and the line of sight at which it counts as seen: beyond it normals are poor."""
ONCE = 0.35
"""What a second view of a place is worth over a first: it makes the place sure, the first one shows it."""
SAMPLES = 6000
"""Samples of what one view alone sees, about."""
STOPS = 3
"""Places that are named at most."""
LEAST_GAIN = 0.01
"""Share of the model's area that a further stop must show."""
BUFFER_PX = 72
"""Columns and rows of the depth buffer: its cells are wider than the model's edges, so that it has no holes."""
BEHIND = 0.02
"""How far behind the depth buffer, as a share of the depth, a sample may lie and still be seen."""
CAP_STEP = 2.5
"""Distance between samples of a cap, in the model's edges."""
LARGEST_LOOP = 4000
"""Edges of a loop that is closed by a cap at most."""


@dataclass(frozen=True)
class SeenOnce:
    """Samples of what was seen once or not at all, and of the whole that hides them."""

    x_A: Array
    n_A: Array
    area_m2: Array
    unseen: Mask
    """Samples of the caps; the others were seen by one view."""
    hides_A: Array
    """(H, 3) points of the model and of its caps."""


def missing(aligned: Aligned, found: Vertices) -> Missing:
    """What is missing of a model, and the stops that would show most of it, the best first."""
    v, faces = found.triangles.vertices_A, found.triangles.faces
    areas = _vertex_areas(v, faces)
    caps = caps_of(v, faces)
    once = found.views < 2
    samples = _samples(found, areas, caps)
    stops = _stops(aligned.placed, samples, float(areas.sum()))
    return Missing(float(areas.sum()), float(caps.area_m2.sum()), float(areas[once].sum()), found.loose_m2, tuple(stops))


@dataclass(frozen=True)
class Caps:
    """Points on the caps that close a surface's open edges: places (N, 3), normals (N, 3), areas (N,)."""

    x_A: Array
    n_A: Array
    area_m2: Array


def caps_of(v: Array, faces: Index) -> Caps:
    """Close each loop of open edges; see `zipped`."""
    corners = [zipped(v[loop]) for loop in loops_of(faces)]
    if not corners:
        return Caps(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
    corners_A = np.concatenate(corners)
    step = CAP_STEP * float(np.median(np.linalg.norm(v[faces[:, 0]] - v[faces[:, 1]], axis=1)))
    flat = np.cross(corners_A[:, 1] - corners_A[:, 0], corners_A[:, 2] - corners_A[:, 0]) / 2
    area = np.linalg.norm(flat, axis=1)
    some = area > 0
    corners_A, flat, area = corners_A[some], flat[some], area[some]
    each = np.maximum(np.ceil(area / step**2).astype(int), 1)
    triangle = np.repeat(np.arange(len(area)), each)
    within = np.arange(len(triangle)) - np.repeat(np.cumsum(each) - each, each)
    along, across = (within + 0.5) / each[triangle], np.mod((within + 0.5) * 0.618034, 1.0)
    root = np.sqrt(along)
    weights = np.stack([1 - root, root * (1 - across), root * across], axis=1)
    x_A = np.einsum("nk,nkc->nc", weights, corners_A[triangle])
    return Caps(x_A, flat[triangle] / area[triangle, None], area[triangle] / each[triangle])


def zipped(ring: Array) -> Array:
    """Triangles (N - 2, 3, 3) that close a ring (N, 3) of open edges, turned as what they close.

    Corners are cut off one after the other, each time where the two beside are nearest to each other: a long narrow gap is closed across,
    however it winds.
    """
    before, after = np.roll(np.arange(len(ring)), 1).tolist(), np.roll(np.arange(len(ring)), -1).tolist()
    wide = np.linalg.norm(np.roll(ring, -1, axis=0) - np.roll(ring, 1, axis=0), axis=1).tolist()
    queue = list(zip(wide, range(len(ring)), strict=True))
    heapq.heapify(queue)
    corners: list[tuple[int, int, int]] = []
    while len(corners) < len(ring) - 2:
        width, at = heapq.heappop(queue)
        if width != wide[at]:
            continue  # a neighbour of it has gone since
        a, b, wide[at] = before[at], after[at], -1.0
        corners.append((a, b, at))
        after[a], before[b] = b, a
        for one in (a, b):
            wide[one] = math.dist(ring[after[one]], ring[before[one]])
            heapq.heappush(queue, (wide[one], one))
    return np.asarray(ring[np.array(corners)])


def loops_of(faces: Index) -> list[Index]:
    """Closed loops of the edges that one face alone has, each its vertices in the faces' own order."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    following: dict[int, list[int]] = {}
    for a, b in edges[first[count == 1]].tolist():
        following.setdefault(a, []).append(b)
    loops = []
    while following:
        start = at = next(iter(following))
        ring: list[int] = []
        while at in following and len(ring) < LARGEST_LOOP:
            ring.append(at)
            after = following[at]
            step = after.pop()
            if not after:
                del following[at]
            at = step
            if at == start:
                loops.append(np.array(ring))
                break
    return [loop for loop in loops if len(loop) >= 3]


def _vertex_areas(v: Array, faces: Index) -> Array:
    a, b, c = (v[faces[:, k]] for k in range(3))
    third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    return np.asarray(sum(np.bincount(faces[:, k], third, len(v)) for k in range(3)))


def _samples(found: Vertices, areas: Array, caps: Caps) -> SeenOnce:
    v, n = found.triangles.vertices_A, found.triangles.normals_A
    once = np.flatnonzero(found.views < 2)
    step = max(len(once) // SAMPLES, 1)
    some = once[::step]
    share = areas[once].sum() / max(float(areas[some].sum()), 1e-30)
    hides = v[:: max(len(v) // (4 * SAMPLES), 1)]
    return SeenOnce(
        np.concatenate([v[some], caps.x_A]),
        np.concatenate([n[some], caps.n_A]),
        np.concatenate([areas[some] * share, caps.area_m2]),
        np.concatenate([np.zeros(len(some), bool), np.ones(len(caps.area_m2), bool)]),
        np.concatenate([hides, caps.x_A]),
    )


def _stops(state: Sequence[Placed], samples: SeenOnce, area_m2: float) -> list[NextStop]:
    """The stops that show most, one after the other, with what each adds to those before it."""
    middle_A = samples.hides_A.mean(axis=0)
    usual_m = float(np.median([np.linalg.norm(one.H_AC[:3, 3] - middle_A) for one in state]))
    cameras = candidates(state, middle_A)
    ways = [(distance, _at(cameras, middle_A, distance * usual_m)) for distance in (1.0, *OTHER_DISTANCES)]
    seen = [(distance, H, sees(state[0], H, samples)) for distance, all_H in ways for H in all_H]
    found: list[NextStop] = []
    left = samples
    for _ in range(STOPS):
        gains = np.array([_gain(left, mask) * (1 if distance == 1.0 else 1 / WORTH_A_RESET) for distance, _, mask in seen])
        best = int(np.argmax(gains)) if len(gains) else 0
        if not len(gains) or gains[best] < LEAST_GAIN * area_m2:
            break
        distance, H_AC, mask = seen[best]
        found.append(_stop(state, left, H_AC, mask, distance * usual_m, reset=distance != 1.0))
        once = mask & ~left.unseen
        left = replace(left, unseen=left.unseen & ~mask, area_m2=np.where(once, 0.0, left.area_m2))
    return found


def _gain(samples: SeenOnce, mask: Mask) -> float:
    return float(samples.area_m2[mask & samples.unseen].sum() + ONCE * samples.area_m2[mask & ~samples.unseen].sum())


def _stop(state: Sequence[Placed], samples: SeenOnce, H_AC: Array, mask: Mask, distance_m: float, *, reset: bool) -> NextStop:
    turns = [se3.angle_rad(one.H_AC[:3, :3].T @ H_AC[:3, :3]) for one in state]
    nearest = state[int(np.argmin(turns))]
    moved = H_AC @ se3.inv(nearest.H_AC)
    H_AP = carrier_of(nearest.view.placement.by_handeye)
    return NextStop(
        H_AC,
        None if H_AP is None else moved @ H_AP,
        nearest.view.name,
        float(np.min(turns)),
        distance_m,
        float(samples.area_m2[mask & samples.unseen].sum()),
        float(samples.area_m2[mask & ~samples.unseen].sum()),
        reset,
    )


def carrier_of(by_handeye: Array) -> Array | None:
    """The pose (4, 4) of the tracked body whose adjoint a placement holds (6, 6); None where no body carries the camera."""
    R = by_handeye[:3, :3]
    if not np.allclose(R @ R.T, np.eye(3), atol=1e-6) or np.allclose(by_handeye, np.eye(6)):
        return None
    W = by_handeye[3:, :3] @ R.T
    return se3.transform(R, np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2)


def candidates(state: Sequence[Placed], middle_A: Array) -> Array:
    """Rotations (N, 3, 3) of cameras in A that look at the middle, each turned about its line of sight as the nearest stop's is."""
    k = np.arange(DIRECTIONS) + 0.5
    height, azimuth = 1 - 2 * k / DIRECTIONS, np.pi * (1 + 5**0.5) * k
    level = np.sqrt(1 - height**2)
    outward = np.stack([level * np.cos(azimuth), level * np.sin(azimuth), height], axis=1)
    stood = np.stack([one.H_AC[:3, 3] - middle_A for one in state])
    stood /= np.linalg.norm(stood, axis=1, keepdims=True)
    cosine = outward @ stood.T
    nearest = np.argmax(cosine, axis=1)
    found = []
    for direction, near, c in zip(outward, nearest, cosine.max(axis=1), strict=True):
        if c < np.cos(REACH_RAD):
            continue
        R = state[near].H_AC[:3, :3]
        axis = np.cross(R[:, 2], -direction)
        sine = float(np.linalg.norm(axis))
        angle = np.arctan2(sine, -float(R[:, 2] @ direction))
        found.append(se3.rotation(axis / max(sine, 1e-12) * angle) @ R)
    return np.array(found).reshape(-1, 3, 3)


def _at(rotations: Array, middle_A: Array, distance_m: float) -> Array:
    """Cameras (N, 4, 4) of these rotations (N, 3, 3) that look at a point from a distance."""
    return np.array([se3.transform(R, middle_A - distance_m * R[:, 2]) for R in rotations]).reshape(-1, 4, 4)


def sees(like: Placed, H_AC: Array, samples: SeenOnce) -> Mask:
    """Which samples a camera like that of a view sees from a place."""
    H_CA = se3.inv(H_AC)
    low, high = like.view.field
    x_C = se3.apply(H_CA, samples.x_A)
    toward = -x_C / np.maximum(np.linalg.norm(x_C, axis=1, keepdims=True), 1e-12)
    facing = np.einsum("ij,ij->i", se3.rotate(H_CA, samples.n_A), toward) > FACING
    cell, inside = _cells(x_C, low, high)
    hides_C = se3.apply(H_CA, samples.hides_A)
    at, covered = _cells(hides_C, low, high)
    depth = np.full(BUFFER_PX * BUFFER_PX, np.inf)
    np.minimum.at(depth, at[covered], hides_C[covered, 2])
    near = depth.reshape(BUFFER_PX, BUFFER_PX)
    return np.asarray(facing & inside & (x_C[:, 2] < near.reshape(-1)[cell] * (1 + BEHIND)))


def _cells(x_C: Array, low: Array, high: Array) -> tuple[Index, Mask]:
    """The cell of the depth buffer that each point (N, 3) falls into, and whether it is in the image."""
    front = x_C[:, 2] > 1e-6
    plane = x_C[:, :2] / np.where(front, x_C[:, 2], 1.0)[:, None]
    share = (plane - low) / (high - low)
    inside = front & (share >= 0).all(axis=1) & (share < 1).all(axis=1)
    column, row = (np.where(inside, share[:, k] * BUFFER_PX, 0).astype(int) for k in range(2))
    return row * BUFFER_PX + column, inside

"""Cutting an image in two by evidence: total variation over the whole, or half way up the step.

``min over u in [0, 1] of  sum_p -e_p u_p + STIFF sum_ab w_ab abs(u_a - u_b)``, w low across edges of the picture. Sources: Chan, Esedoglu
and Nikolova 2006, SIAM J. Applied Mathematics 66 (a convex form of the cut); Chambolle and Pock 2011, J. Math. Imaging and Vision 40 (the
solver).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.kernels.library import kernel
from lpcal.view import bands
from lpcal.view.agreed import RIM_PX

STEPS = 250
"""Steps of the primal-dual method: labels then no longer change."""
BESIDE_PX = 1.5
HALF = 0.4


def total_variation(evidence: Image, picture: Image, stiffness: float) -> Mask:
    """The part (H, W) that evidence (H, W, positive for it) supports, its outline drawn to the edges of the picture (H, W).

    Evidence that outweighs the outline on three sides of a pixel stands where its neighbours' is of the same sign: what lies beyond all
    that is open need not be solved for.
    """
    difference = [np.abs(np.diff(picture, axis=axis)) for axis in (1, 0)]
    size = np.median(np.concatenate([one.ravel() for one in difference])) + 1e-6
    weight = [np.float32(stiffness) / (1 + (one / np.float32(4 * size)) ** 2) for one in difference]
    found = evidence > 0
    unsettled = np.abs(evidence) <= 3 * stiffness
    unsettled[:, 1:] |= found[:, 1:] != found[:, :-1]
    unsettled[1:] |= found[1:] != found[:-1]
    if not unsettled.any():
        return np.asarray(found)
    (top, bottom), (left, right) = ((max(at.min() - RIM_PX, 0), at.max() + RIM_PX + 1) for at in np.nonzero(unsettled))
    box = (slice(top, bottom), slice(left, right))
    rows, columns = evidence[box].shape
    free = raster.highest(unsettled[box], RIM_PX, beyond=False)
    found[box] = _relaxed(evidence[box], weight[0][box][:, : columns - 1], weight[1][box][: rows - 1], free) > 0.5
    return np.asarray(found)


def _relaxed(evidence: Image, across_most: Array | Image, down_most: Array | Image, free: Mask) -> Image:
    """The relaxed cut (H, W), 0..1, by costs of an outline between neighbours across (H, W - 1) and down (H - 1, W).

    Pixels that are not `free` (H, W) are so sure that they need not be asked: they stay as their evidence says.
    """
    if run := kernel("two_labels"):
        given = [np.ascontiguousarray(one, np.float32) for one in (evidence, across_most, down_most)]
        ends = np.diff(np.pad(free, ((0, 0), (1, 1))).astype(np.int8), axis=1)
        (row, first), (_, last) = np.nonzero(ends > 0), np.nonzero(ends < 0)
        stretches = np.stack([row, first, last], axis=1).astype(np.int64)
        u, work = np.empty(evidence.shape, np.float32), np.empty((3, *evidence.shape), np.float32)
        run(*evidence.shape, *given, len(stretches), stretches, STEPS, float(np.float32(1 / np.sqrt(8))), work, u)
        return u
    u = (evidence > 0).astype(np.float32)
    ahead, across, down = u.copy(), np.zeros_like(across_most), np.zeros_like(down_most)
    step = np.float32(1 / np.sqrt(8))
    for _ in range(STEPS):
        across = np.clip(across + step * np.diff(ahead, axis=1), -across_most, across_most)
        down = np.clip(down + step * np.diff(ahead, axis=0), -down_most, down_most)
        pull = evidence.copy()
        pull[:, :-1] += across
        pull[:, 1:] -= across
        pull[:-1] += down
        pull[1:] -= down
        before, u = u, np.clip(u + step * pull, 0, 1)
        ahead = 2 * u - before
    return u


def halfway(mask: Mask, signal: Image, sigma: Image) -> Mask:
    """The mask with pixels beside its outline decided by which side of the outline they are nearer to, in signals (L, H, W).

    A pixel that the outline crosses shows a share of both sides; HALF of a step is where it is in. Less than a half, as the rim of most
    things turns away from the light and is darker than what lies within it.
    """
    import cv2

    def near(side: Mask) -> tuple[Image, Image]:
        depth = cv2.distanceTransform(side.astype(np.uint8), cv2.DIST_L2, 3)
        return np.asarray(depth, np.float32), _near(signal, depth)

    (within, inner), (beyond, outer) = bands.shared(near, (mask, ~mask))
    step = (inner - outer) / sigma
    share = np.sum((signal - outer) / sigma * step, axis=0) / np.maximum(np.sum(step**2, axis=0), 1e-12)
    return np.asarray(np.where((within <= BESIDE_PX) & (beyond <= BESIDE_PX), share > HALF, mask))


def _near(signal: Image, depth: Image) -> Image:
    """Mean of signals (L, H, W) over the pixels nearby that lie BESIDE_PX deep in a side of the outline, or at least in it."""
    import cv2

    size = (2 * RIM_PX + 1,) * 2
    weight = (depth > BESIDE_PX) + np.float32(1e-3) * (depth > 0)
    total = np.maximum(cv2.blur(weight, size), 1e-9)
    return np.stack([cv2.blur(one * weight, size) / total for one in signal])

"""Cutting an image in two by evidence: total variation over the whole, along the seam GrabCut, or half way up the step.

``min over u in [0, 1] of  sum_p -e_p u_p + STIFF sum_ab w_ab abs(u_a - u_b)``, w low across edges of the picture. Sources: Chan, Esedoglu
and Nikolova 2006, SIAM J. Applied Mathematics 66 (a convex form of the cut); Chambolle and Pock 2011, J. Math. Imaging and Vision 40 (the
solver); Rother, Kolmogorov and Blake 2004, ACM Transactions on Graphics 23 (GrabCut).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.kernels.library import kernel
from lpcal.view import parallel
from lpcal.view.crop import Crop

STEPS = 200
MARGIN = 2
"""Pixels about what is open that are solved for with it."""
SEAM_PX = 4
GRABCUT_ROUNDS = 3
BESIDE_PX, AROUND_PX = 1.5, 2
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
    (top, bottom), (left, right) = ((max(at.min() - MARGIN, 0), at.max() + MARGIN + 1) for at in np.nonzero(unsettled))
    box = (slice(top, bottom), slice(left, right))
    rows, columns = evidence[box].shape
    free = raster.max_filtered(unsettled[box], MARGIN, beyond=False)
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


def along_the_seam(mask: Mask, picture: Image, free: Mask | None = None) -> Mask:
    """The mask with its outline moved by SEAM_PX at most, by the colours of picture (H, W, 3, 0..1) on both sides; `free`: where it may."""
    import cv2

    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * SEAM_PX + 1, 2 * SEAM_PX + 1))
    inside, outside = cv2.erode(mask.astype(np.uint8), kernel), 1 - cv2.dilate(mask.astype(np.uint8), kernel)
    if free is not None:
        inside, outside = inside | (mask & ~free), outside | (~mask & ~free)
    if not inside.any() or not outside.any():
        return mask
    labels = np.where(mask, cv2.GC_PR_FGD, cv2.GC_PR_BGD).astype(np.uint8)
    labels[inside > 0], labels[outside > 0] = cv2.GC_FGD, cv2.GC_BGD
    cv2.setRNGSeed(0)
    colours = np.ascontiguousarray(np.clip(255 * picture, 0, 255).astype(np.uint8))
    cv2.grabCut(colours, labels, None, np.zeros((1, 65)), np.zeros((1, 65)), GRABCUT_ROUNDS, cv2.GC_INIT_WITH_MASK)
    return np.asarray((labels == cv2.GC_FGD) | (labels == cv2.GC_PR_FGD))


def halfway(mask: Mask, signal: Image, sigma: Image) -> Mask:
    """The mask with pixels beside its outline decided by which side of the outline they are nearer to, in signals (L, H, W).

    A pixel that the outline crosses shows a share of both sides; HALF of a step is where it is in. Less than a half, as the rim of most
    things turns away from the light and is darker than what lies within it.
    """
    import cv2

    def near(side: Mask) -> tuple[Image, Image]:
        depth = cv2.distanceTransform(side.astype(np.uint8), cv2.DIST_L2, 3)
        return np.asarray(depth, np.float32), _near(signal, depth)

    box, found = Crop.about(mask), mask.copy()
    inside = box.of(mask)
    signal, sigma = (one[:, box.rows, box.columns] for one in (signal, sigma))
    (within, inner), (beyond, outer) = parallel.run_all(near, (inside, ~inside))
    step = (inner - outer) / sigma
    share = np.sum((signal - outer) / sigma * step, axis=0) / np.maximum(np.sum(step**2, axis=0), 1e-12)
    box.of(found)[...] = np.where((within <= BESIDE_PX) & (beyond <= BESIDE_PX), share > HALF, inside)
    return found


def _near(signal: Image, depth: Image) -> Image:
    """Mean of signals (L, H, W) over the pixels nearby that lie BESIDE_PX deep in a side of the outline, or at least in it."""
    import cv2

    size = (2 * AROUND_PX + 1,) * 2
    weight = (depth > BESIDE_PX) + np.float32(1e-3) * (depth > 0)
    total = np.maximum(cv2.blur(weight, size), 1e-9)
    return np.stack([cv2.blur(one * weight, size) / total for one in signal])

"""Two-label segmentation of an image: a total-variation cut of the whole, GrabCut along the outline, or the half height of its step.

``min over u in [0, 1] of  sum_p -e_p u_p + STIFF sum_ab w_ab abs(u_a - u_b)``, w low across edges of the image. Sources: Chan, Esedoglu
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
"""Pixels about the undecided ones that are solved for with them."""
SEAM_PX = 4
GRABCUT_ROUNDS = 3
BESIDE_PX, AROUND_PX = 1.5, 2
HALF = 0.4


def total_variation(evidence: Image, picture: Image, stiffness: float) -> Mask:
    """Foreground mask (H, W) from evidence (H, W, positive for foreground), with its outline attracted to edges of `picture` (H, W).

    A pixel whose evidence outweighs the boundary cost of three sides keeps its sign where its neighbours' evidence has the same sign, so
    only the bounding box of the other pixels is solved.
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
    """The relaxed cut (H, W), 0..1, with boundary costs between horizontal (H, W - 1) and vertical (H - 1, W) neighbours.

    Pixels that are not `free` (H, W) are certain and stay at the sign of their evidence (in the kernel; the numpy twin solves all).
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
    """The mask with its outline moved by at most SEAM_PX, by GrabCut on picture (H, W, 3), 0..1; only `free` (H, W) pixels may change."""
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
    """The mask with pixels beside its outline reassigned to the side whose mean signals (L, H, W) are nearer to theirs.

    A pixel on the outline mixes both sides and counts as inside from a share HALF of the step on: less than a half, since most objects'
    rims turn away from the light and are darker than their interior.
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
    """Local mean of signals (L, H, W) over pixels at least BESIDE_PX inside one side of the outline, or else over any of that side."""
    import cv2

    size = (2 * AROUND_PX + 1,) * 2
    weight = (depth > BESIDE_PX) + np.float32(1e-3) * (depth > 0)
    total = np.maximum(cv2.blur(weight, size), 1e-9)
    return np.stack([cv2.blur(one * weight, size) / total for one in signal])

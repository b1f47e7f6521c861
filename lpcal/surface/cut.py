"""Cutting an image in two by evidence: total variation over the whole, GrabCut along the seam.

``min over u in [0, 1] of  sum_p -e_p u_p + STIFF sum_ab w_ab abs(u_a - u_b)``, w low across edges of the picture. Sources: Chan, Esedoglu
and Nikolova 2006, SIAM J. Applied Mathematics 66 (a convex form of the cut); Chambolle and Pock 2011, J. Math. Imaging and Vision 40 (the
solver); Rother, Kolmogorov and Blake 2004, ACM Transactions on Graphics 23 (GrabCut).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Image, Mask

STEPS = 200
SEAM_PX = 4
GRABCUT_ROUNDS = 3


def total_variation(evidence: Image, picture: Image, stiffness: float) -> Mask:
    """The part (H, W) for which evidence (H, W, positive for it) speaks, its outline drawn to the edges of the picture (H, W)."""
    difference = [np.abs(np.diff(picture, axis=axis)) for axis in (1, 0)]
    size = np.median(np.concatenate([one.ravel() for one in difference])) + 1e-6
    weight = [np.float32(stiffness) / (1 + (one / np.float32(4 * size)) ** 2) for one in difference]
    u = (evidence > 0).astype(np.float32)
    ahead, across, down = u.copy(), np.zeros_like(weight[0]), np.zeros_like(weight[1])
    step = np.float32(1 / np.sqrt(8))
    for _ in range(STEPS):
        across = np.clip(across + step * np.diff(ahead, axis=1), -weight[0], weight[0])
        down = np.clip(down + step * np.diff(ahead, axis=0), -weight[1], weight[1])
        pull = evidence.copy()
        pull[:, :-1] += across
        pull[:, 1:] -= across
        pull[:-1] += down
        pull[1:] -= down
        before, u = u, np.clip(u + step * pull, 0, 1)
        ahead = 2 * u - before
    return np.asarray(u > 0.5)


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

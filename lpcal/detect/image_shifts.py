r"""Whether the images of a capture lie on each other: the shift of each, from the residuals of the reconstructed surface.

Symbols: samples ``I_k = B_k . b`` of a pixel under lights k, whitened by their standard deviations; M projects b out; d_k the shift of
image k in pixels, so that it shows ``I_k - d_k . grad I_k``::

    minimise  sum over pixels of  w |M (I + D d)|^2,      D the gradients of the images, one block of columns an image

whose mean over the images is not determined (all moved alike is no shift). It is set to 0, and shifts are counted from their median, which
one image that moved does not move. Noise in the gradients shrinks them a little. Gradients are those of texture and shading within the
object, away from its rim and from shadows. The standard deviation of d is that of a cluster-robust (sandwich) estimator, blocks of the
picture being the clusters, since errors of the model are common to neighbouring pixels. A shift is the same all over the picture and gone
once the image is put back, an error of the model is not. Sources: Lucas and Kanade 1981, IJCAI (shifts from gradients); Liang and
Zeger 1986, Biometrika 73 (the standard deviation).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.shading import normals
from lpcal.shading.normals import Estimate
from lpcal.view.constants import CERTAIN, OUTLIER2, RIM_PX
from lpcal.view.pixel_list import Illumination, Indices, PixelList

LEAST_PX = 0.25
"""Shift, pixels, from which it is spoken of: of 46 drawn scenes without any the largest that quarters agree on is 0.11."""
EXPECTED_PX = 2.0
"""Prior standard deviation of a shift, pixels: further off the gradients say nothing."""
ROUNDS = 3
"""Times that the shifts are found, the images put back by those before: gradients hold for a fraction of a pixel."""
LIGHTS_NEEDED = 4
"""Lights of a pixel from which they can contradict each other."""
MOST_LIGHTS = 16
"""Images that are compared at once: of more, every n-th with every n-th."""
MOST_PIXELS = 12_000
"""Pixels that are asked, spread over the object."""
CHUNK = 1000
"""Pixels whose equations are held at once."""
BLOCKS = 12
"""Blocks down and across the object's part of the picture."""
AGREES = (0.4, 1.6)
"""Between what each quarter's shift has to be, along the whole picture's, as a share of it."""


@dataclass(frozen=True)
class Shift:
    """By how much an image lies beside the others, pixels, x to the right and y down."""

    image: str
    px: tuple[float, float]

    def __str__(self) -> str:
        """In words."""
        return f"{self.image} by ({self.px[0]:+.1f}, {self.px[1]:+.1f}) px"


def shifted_said(seen: PixelList, lit: Illumination, found: Estimate, names: Sequence[str]) -> tuple[str, ...]:
    """A note on images that do not lie on the others; empty where all do.

    Parameters
    ----------
    seen : the object's pixels and their samples
    lit : the light at them
    found : which samples follow it, and the gloss in them
    names : (L,) of the images
    """
    shifts = shifted(seen, lit, found, names)
    if not shifts:
        return ()
    shown = ", ".join(map(str, shifts[:4])) + (", ..." if len(shifts) > 4 else "")
    return (
        f"images do not lie on the others: {shown}; did camera or object move while they were taken? Hold both still, or align the "
        "images first",
    )


def shifted(seen: PixelList, lit: Illumination, found: Estimate, names: Sequence[str]) -> tuple[Shift, ...]:
    """The images that are surely shifted, the furthest first; not those of less than half its shift, which may be its effect on them."""
    groups = -(-len(names) // MOST_LIGHTS)
    shifts: list[tuple[float, Shift]] = []
    for first in range(groups):
        some = np.arange(first, len(names), groups)
        of = _shifts(seen, lit, found, some)
        if of is None:
            continue
        for k in np.flatnonzero(of.sure()):
            x, y = map(float, of.d[k])
            shifts.append((float(np.hypot(x, y)), Shift(names[int(some[k])], (x, y))))
    least = max((size for size, _ in shifts), default=0.0) / 2
    return tuple(shift for size, shift in sorted(shifts, key=lambda one: -one[0]) if size > least)


@dataclass(frozen=True)
class _Step:
    """Shifts of L images, counted from their median, as far as gradients say them at once."""

    d: Array
    """(L, 2)."""
    t: Array
    """(L,) size in standard deviations."""
    along: Array
    """(4, L) what each quarter of the picture says along d, as a share of it."""


@dataclass(frozen=True)
class _Shifts:
    """Shifts of L images, found in steps."""

    d: Array
    """(L, 2)."""
    first: _Step
    last: _Step

    def sure(self) -> Mask:
        """(L,) which images are shifted for sure: by enough, the same in all quarters, in steps that become smaller."""
        size = np.hypot(*self.d.T)
        agree = (self.first.along.min(axis=0) > AGREES[0]) & (self.first.along.max(axis=0) < AGREES[1])
        return np.asarray((size > LEAST_PX) & (self.first.t > CERTAIN) & agree & (np.hypot(*self.last.d.T) < size / 2))


def _shifts(seen: PixelList, lit: Illumination, found: Estimate, some: Indices) -> _Shifts | None:
    """The shifts of some images, each step from images put back by those before; None where too few pixels can contradict each other."""
    signal = seen.signal[some] if found.gloss is None else seen.signal[some] - found.gloss[some]
    good, sigma, B = found.inliers[some] & seen.usable[some], np.sqrt(normals.variances(seen)[some]), lit.B[some]
    first = last = _step(seen.mask, signal, sigma, good, B)
    if first is None or last is None:
        return None
    d = first.d
    for _ in range(1, ROUNDS):
        if np.hypot(*d.T).max() < LEAST_PX:
            return None
        back = np.stack([_moved(seen.mask, values, -by) for values, by in zip(signal, d, strict=True)])
        last = _step(seen.mask, back, sigma, good, B)
        if last is None:
            return None
        d = d + last.d
    return _Shifts(d, first, last)


def _moved(mask: Mask, values: Array, d: Array) -> Array:
    """Values (P,) of a mask's pixels, the image of them shifted by d (2,) pixels; beyond the mask it is continued by its nearest pixels."""
    import cv2

    image = np.zeros(mask.shape)
    image[mask] = values
    image = image.ravel()[raster.nearest(mask)].reshape(mask.shape)
    by = np.array([[1, 0, d[0]], [0, 1, d[1]]])
    return np.asarray(cv2.warpAffine(image, by, mask.shape[::-1], flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)[mask])


def _step(mask: Mask, signal: Array, sigma: Array, good: Mask, B: Array) -> _Step | None:
    """The shifts from gradients of the `good` signals (L, P) with standard deviations `sigma`, under light vectors B (L, P, 3)."""
    gradient, counted = _gradients(mask, signal, good)
    at = np.flatnonzero(counted.sum(axis=0) >= LIGHTS_NEEDED)
    at = at[:: max(1, len(at) // MOST_PIXELS)]
    if len(at) < BLOCKS**2:
        return None
    weight = counted[:, at] / sigma[:, at]
    A = np.moveaxis(weight[..., None] * B[:, at], 0, 1)
    inverse = np.nan_to_num(lambert.inverse_3x3(np.einsum("pki,pkj->pij", A, A)))
    y, G = (weight * signal[:, at]).T, np.moveaxis(weight[..., None] * gradient[:, at], 0, 1)
    r = y - np.einsum("pki,pij,plj,pl->pk", A, inverse, A, y, optimize=True)
    width = OUTLIER2 * float(np.median(np.abs(r[r != 0]))) ** 2 if r.any() else 1.0
    robust = 1 / (1 + r**2 / width)
    rows, columns = (index[at] for index in np.nonzero(mask))
    row, column = ((index - index.min()) * BLOCKS // (np.ptp(index) + 1) for index in (rows, columns))
    block, count = row * BLOCKS + column, len(signal)
    H, g = np.zeros((BLOCKS**2, 2 * count, 2 * count)), np.zeros((BLOCKS**2, 2 * count))
    for start in range(0, len(at), CHUNK):
        part = slice(start, start + CHUNK)
        D = np.zeros((len(r[part]), count, 2 * count))
        D.reshape(-1, count, count, 2)[:, range(count), range(count)] = -G[part]
        J = D - A[part] @ (inverse[part] @ (np.swapaxes(A[part], 1, 2) @ D))
        weighted = robust[part][..., None] * J
        np.add.at(H, block[part], np.swapaxes(weighted, 1, 2) @ J)
        np.add.at(g, block[part], np.einsum("pkm,pk->pm", weighted, r[part]))
    d, inverse_H = _solved(H.sum(axis=0), g.sum(axis=0))
    left = g - H @ d
    covariance = inverse_H @ (left.T @ left + np.eye(len(d)) / EXPECTED_PX**2) @ inverse_H
    quarter = (np.arange(BLOCKS**2) // BLOCKS >= BLOCKS // 2) * 2 + (np.arange(BLOCKS**2) % BLOCKS >= BLOCKS // 2)
    quarters = np.stack([_solved(H[quarter == k].sum(axis=0), g[quarter == k].sum(axis=0))[0] for k in range(4)])
    own = np.arange(2 * count).reshape(count, 2)
    d, quarters = (one - np.median(one, axis=-2, keepdims=True) for one in (d.reshape(count, 2), quarters.reshape(4, count, 2)))
    t = np.sqrt(np.einsum("ki,kij,kj->k", d, np.linalg.inv(covariance[own[:, :, None], own[:, None]]), d))
    return _Step(d, t, np.einsum("qki,ki->qk", quarters, d) / np.maximum(np.sum(d**2, axis=1), lambert.SINGULAR))


def _solved(H: Array, g: Array) -> tuple[Array, Array]:
    """Shifts (2L,) of mean 0 from their normal equations and the prior; and the inverse matrix."""
    count = len(g)
    mean = np.tile(np.eye(2), (count // 2, count // 2))  # the sums over all images, along x and along y
    inverse = np.linalg.inv(H + np.trace(H) / count * mean + np.eye(count) / EXPECTED_PX**2)
    return inverse @ g, inverse


def _gradients(mask: Mask, signal: Array, good: Mask) -> tuple[Array, Mask]:
    """Gradients (L, P, 2) of the signals (L, P), and which of them count (L, P).

    Those do whose pixel and neighbours are all `good` (L, P), away from the rim of the mask.
    """
    import cv2

    gradient, counted = np.zeros((*signal.shape, 2)), np.zeros(signal.shape, bool)
    inner = raster.eroded(mask, RIM_PX + 1)
    for k, (values, some) in enumerate(zip(signal, good, strict=True)):
        image, whole = np.zeros(mask.shape), np.zeros(mask.shape, np.uint8)
        image[mask], whole[mask] = values, some
        for axis in range(2):
            gradient[k, :, axis] = cv2.Scharr(image, cv2.CV_64F, 1 - axis, axis, scale=1 / 32)[mask]
        counted[k] = (cv2.erode(whole, np.ones((3, 3), np.uint8)).astype(bool) & inner)[mask]
    return gradient, counted

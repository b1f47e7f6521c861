"""Pictures of rows and columns: what hangs together, what is nearest, means about each pixel, masks grown and shrunk.

Kernels do what `scipy.ndimage` does; it stands here as their twin, and is not imported where they work.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.kernels.library import kernel

BORDERS = ("constant", "nearest", "reflect")
type Border = Literal["constant", "nearest", "reflect"]
"""What stands beyond the picture: nothing; its last pixel; its mirror image, the last pixel twice."""
REACH = 4.0
"""Standard deviations of a Gaussian window beyond which nothing counts."""
BLOCK = 256
"""What the kernel wants of work space beyond a line's own."""


def connected_components(mask: Mask) -> tuple[npt.NDArray[np.int32], int]:
    """A label (H, W) from 1 for each set of pixels of a mask (H, W) that touch by their sides, in reading order, and how many there are."""
    if run := kernel("labelled"):
        of, label, count = np.empty(mask.shape, np.int32), np.empty(mask.shape, np.int32), np.zeros(1, np.int32)
        run(*mask.shape, np.ascontiguousarray(mask), of, label, count)
        return label, int(count[0])
    from scipy import ndimage

    return ndimage.label(mask)


def nearest(mask: Mask) -> Index:
    """The number (H, W), row by row, of the pixel of a mask (H, W) that is nearest to each; -1 where the mask is empty."""
    return _nearest(mask)[0]


def distance_to(mask: Mask) -> Array:
    """How far (H, W), in pixels, each pixel is from the nearest one of a mask (H, W); infinitely where it is empty."""
    return np.sqrt(_nearest(mask)[1])


def _nearest(mask: Mask) -> tuple[Index, Array]:
    """The number of the nearest pixel, and the square of its distance."""
    if run := kernel("nearest"):
        work, number, square = np.empty(3 * mask.shape[1], np.int64), np.empty(mask.shape, np.int64), np.empty(mask.shape)
        run(*mask.shape, np.ascontiguousarray(mask), work, number, square)
        return number, square
    from scipy import ndimage

    row, column = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True).astype(np.int64)
    y, x = np.ogrid[: mask.shape[0], : mask.shape[1]]
    far = ((row - y) ** 2 + (column - x) ** 2).astype(float)
    return np.where(row < 0, -1, row * mask.shape[1] + column), np.where(row < 0, np.inf, far)


def gaussian_filtered[T: np.floating](values: npt.NDArray[T], sigma: float | Sequence[float], border: Border = "reflect") -> npt.NDArray[T]:
    """Gaussian means (...) of values (...) along all axes, of a standard deviation in pixels, or one an axis."""
    if kernel("joined"):
        return _joined(values, [_gaussian(float(one)) for one in np.broadcast_to(sigma, values.ndim)], border)
    from scipy import ndimage

    return np.asarray(ndimage.gaussian_filter(values, sigma, mode=border, truncate=REACH), values.dtype)


def _gaussian(sigma: float) -> Array:
    """Weights (radius + 1) of neighbours by their distance, those of both sides of sum 1."""
    radius = int(REACH * sigma + 0.5)
    both = np.exp(-0.5 / max(sigma, 1e-9) ** 2 * np.arange(-radius, radius + 1) ** 2)
    return np.asarray((both / both.sum())[radius:])


def box_filtered[T: np.floating](values: npt.NDArray[T], side: int) -> npt.NDArray[T]:
    """Means (...) of values (...) in boxes of an odd side about each pixel; the picture is mirrored at its borders."""
    if kernel("joined"):
        return _joined(values, [np.full(side // 2 + 1, 1 / side)] * values.ndim, "reflect")
    from scipy import ndimage

    return np.asarray(ndimage.uniform_filter(values, side), values.dtype)


def _joined[T: np.floating](values: npt.NDArray[T], weights: Sequence[Array], border: Border) -> npt.NDArray[T]:
    """Values (...) joined along each axis in turn by its weights (radius + 1) of their distance."""
    run = kernel("joined" if values.dtype == np.float64 else "joined_singles")
    assert run is not None
    found = np.ascontiguousarray(values)
    for axis, (n, weight) in enumerate(zip(values.shape, weights, strict=True)):
        if len(weight) == 1:  # each value by itself
            continue
        before, found = found, np.empty(values.shape, values.dtype)
        radius, outer, inner = len(weight) - 1, int(np.prod(values.shape[:axis])), int(np.prod(values.shape[axis + 1 :]))
        run(outer, n, inner, radius, BORDERS.index(border), weight, np.empty(3 * n + 2 * radius + BLOCK), before, found)
    return values.copy() if found is values else found


def block_means(picture: npt.NDArray[np.floating], side: int) -> Array:
    """Means (h, w) of blocks of side x side pixels of a picture (H, W); what is left over at its lower and right ends is in none."""
    rows, columns = (length // side * side for length in picture.shape)
    by_row = picture[:rows:side].astype(float)
    for k in range(1, side):  # every so manyth row and column is taken as a whole: sums over short ends take four times as long
        by_row += picture[k:rows:side]
    total = by_row[:, :columns:side].copy()
    for k in range(1, side):
        total += by_row[:, k:columns:side]
    return np.asarray(total / side**2)


def dilated(mask: Mask, by: int = 1) -> Mask:
    """A mask (H, W) with the pixels that touch it by a side, `by` times."""
    for _ in range(by):
        before, mask = mask, mask.copy()
        mask[1:] |= before[:-1]
        mask[:-1] |= before[1:]
        mask[:, 1:] |= before[:, :-1]
        mask[:, :-1] |= before[:, 1:]
    return mask


def eroded(mask: Mask, by: int = 1, *, beyond: bool = False) -> Mask:
    """A mask (H, W) without the pixels that touch others by a side, `by` times; `beyond`: whether what lies beyond the picture is in it."""
    for _ in range(by):
        before, mask = mask, mask.copy()
        mask[1:] &= before[:-1]
        mask[:-1] &= before[1:]
        mask[:, 1:] &= before[:, :-1]
        mask[:, :-1] &= before[:, 1:]
        if not beyond:
            mask[[0, -1]] = False
            mask[:, [0, -1]] = False
    return mask


def opened(mask: Mask, by: int = 1) -> Mask:
    """A mask (H, W) without what is thinner than twice `by`."""
    return dilated(eroded(mask, by), by)


def closed(mask: Mask) -> Mask:
    """A mask (H, W) with its gaps of a pixel or two filled, and without the picture's border."""
    return eroded(dilated(mask))


def max_filtered[T: np.generic](values: npt.NDArray[T], reach: int, beyond: T | bool | float) -> npt.NDArray[T]:
    """The highest value in squares (H, W) that reach so far about each pixel; `beyond` is what lies beyond the picture."""
    rows, columns = values.shape
    about = np.pad(values, reach, constant_values=beyond)
    across = about[:, :columns].copy()
    for k in range(1, 2 * reach + 1):
        np.maximum(across, about[:, k : k + columns], out=across)
    found = across[:rows].copy()
    for k in range(1, 2 * reach + 1):
        np.maximum(found, across[k : k + rows], out=found)
    return found

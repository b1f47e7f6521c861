"""Image operations: connected components, distance transforms, filters and binary morphology.

The kernels do what `scipy.ndimage` does, which is their twin here and is not imported where they are compiled.
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
"""Border modes as in scipy.ndimage: zeros; the border pixel repeated; the mirror image, border pixel included."""
REACH = 4.0
"""Standard deviations at which a Gaussian window is truncated."""
BLOCK = 256
"""Work space that the kernel needs beyond a line's own length."""


def connected_components(mask: Mask) -> tuple[npt.NDArray[np.int32], int]:
    """Labels (H, W) from 1 of the 4-connected components of a mask (H, W), row by row, and their number."""
    if run := kernel("labelled"):
        of, label, count = np.empty(mask.shape, np.int32), np.empty(mask.shape, np.int32), np.zeros(1, np.int32)
        run(*mask.shape, np.ascontiguousarray(mask), of, label, count)
        return label, int(count[0])
    from scipy import ndimage

    return ndimage.label(mask)


def nearest(mask: Mask) -> Index:
    """Flat index (H, W) of the nearest pixel of a mask (H, W); -1 everywhere if the mask is empty."""
    return _nearest(mask)[0]


def distance_to(mask: Mask) -> Array:
    """Euclidean distance (H, W), pixels, to the nearest pixel of a mask (H, W); infinite if it is empty."""
    return np.sqrt(_nearest(mask)[1])


def _nearest(mask: Mask) -> tuple[Index, Array]:
    """Flat index of the nearest pixel, and its squared distance."""
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
    """Values (...) filtered by a Gaussian along all axes; `sigma` in pixels, one for all axes or one each."""
    if kernel("joined"):
        return _joined(values, [_gaussian(float(one)) for one in np.broadcast_to(sigma, values.ndim)], border)
    from scipy import ndimage

    return np.asarray(ndimage.gaussian_filter(values, sigma, mode=border, truncate=REACH), values.dtype)


def _gaussian(sigma: float) -> Array:
    """Weights (radius + 1) of a symmetric Gaussian window by distance, of sum 1 over both sides."""
    radius = int(REACH * sigma + 0.5)
    both = np.exp(-0.5 / max(sigma, 1e-9) ** 2 * np.arange(-radius, radius + 1) ** 2)
    return np.asarray((both / both.sum())[radius:])


def box_filtered[T: np.floating](values: npt.NDArray[T], side: int) -> npt.NDArray[T]:
    """Values (...) filtered by a box of an odd side; the image is mirrored at its borders."""
    if kernel("joined"):
        return _joined(values, [np.full(side // 2 + 1, 1 / side)] * values.ndim, "reflect")
    from scipy import ndimage

    return np.asarray(ndimage.uniform_filter(values, side), values.dtype)


def _joined[T: np.floating](values: npt.NDArray[T], weights: Sequence[Array], border: Border) -> npt.NDArray[T]:
    """Values (...) convolved along each axis in turn with a symmetric window (radius + 1)."""
    run = kernel("joined" if values.dtype == np.float64 else "joined_singles")
    assert run is not None
    found = np.ascontiguousarray(values)
    for axis, (n, weight) in enumerate(zip(values.shape, weights, strict=True)):
        if len(weight) == 1:  # a window of one pixel
            continue
        before, found = found, np.empty(values.shape, values.dtype)
        radius, outer, inner = len(weight) - 1, int(np.prod(values.shape[:axis])), int(np.prod(values.shape[axis + 1 :]))
        run(outer, n, inner, radius, BORDERS.index(border), weight, np.empty(3 * n + 2 * radius + BLOCK), before, found)
    return values.copy() if found is values else found


def block_means(picture: npt.NDArray[np.floating], side: int) -> Array:
    """Means (h, w) of blocks of side x side pixels of an image (H, W); incomplete blocks at the lower and right ends are dropped."""
    rows, columns = (length // side * side for length in picture.shape)
    by_row = picture[:rows:side].astype(float)
    for k in range(1, side):  # strided slices of the whole image: sums over short axes take four times as long
        by_row += picture[k:rows:side]
    total = by_row[:, :columns:side].copy()
    for k in range(1, side):
        total += by_row[:, k:columns:side]
    return np.asarray(total / side**2)


def dilated(mask: Mask, by: int = 1) -> Mask:
    """A mask (H, W) dilated `by` times by its 4-neighbours."""
    for _ in range(by):
        before, mask = mask, mask.copy()
        mask[1:] |= before[:-1]
        mask[:-1] |= before[1:]
        mask[:, 1:] |= before[:, :-1]
        mask[:, :-1] |= before[:, 1:]
    return mask


def eroded(mask: Mask, by: int = 1, *, beyond: bool = False) -> Mask:
    """A mask (H, W) eroded `by` times by its 4-neighbours; `beyond`: whether pixels outside the image count as part of the mask."""
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
    """Morphological opening of a mask (H, W): parts thinner than twice `by` pixels are removed."""
    return dilated(eroded(mask, by), by)


def closed(mask: Mask) -> Mask:
    """Morphological closing of a mask (H, W): gaps of one or two pixels are filled; the image's border pixels are dropped."""
    return eroded(dilated(mask))


def max_filtered[T: np.generic](values: npt.NDArray[T], reach: int, beyond: T | bool | float) -> npt.NDArray[T]:
    """Maximum filter of values (H, W) over squares of half-width `reach`; `beyond` is the value outside the image."""
    rows, columns = values.shape
    about = np.pad(values, reach, constant_values=beyond)
    across = about[:, :columns].copy()
    for k in range(1, 2 * reach + 1):
        np.maximum(across, about[:, k : k + columns], out=across)
    found = across[:rows].copy()
    for k in range(1, 2 * reach + 1):
        np.maximum(found, across[k : k + rows], out=found)
    return found

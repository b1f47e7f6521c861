"""Small pictures for the pages: cropping, shrinking, shading and colouring; `records.pictures` writes them as PNG."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Image, Mask

STILL_LIGHT = np.array([-0.45, -0.55, -0.7]) / np.linalg.norm([0.45, 0.55, 0.7])

RAMP = np.array([[0x17, 0x32, 0x4D], [0x2E, 0x7D, 0x86], [0x9B, 0xC2, 0x6C], [0xF0, 0xBF, 0x4A], [0xCF, 0x4F, 0x2E]]) / 255
"""Colours (5, 3) of doubt, from none to much, distinguishable to the colour-blind too, as lightness rises before it falls to red."""

BAND_BLOCKS = 16
"""Rows of a small picture that are made at once: of a large surface, several hundred of its own."""

type Bytes = npt.NDArray[np.uint8]


def bounds(mask: Mask, margin: int = 2) -> tuple[slice, slice]:
    """Rows and columns of a mask (H, W) with a margin; the whole image where nothing is set."""
    if not mask.any():
        return slice(0, mask.shape[0]), slice(0, mask.shape[1])
    spans = (np.flatnonzero(mask.any(axis=1 - axis)) for axis in (0, 1))
    low_high = [
        (max(int(span[0]) - margin, 0), min(int(span[-1]) + 1 + margin, size)) for span, size in zip(spans, mask.shape, strict=True)
    ]
    return slice(*low_high[0]), slice(*low_high[1])


def shrink(value: Image, mask: Mask, largest: int) -> Bytes:
    """Values (H, W, 3) in 0..1, cropped to the mask and averaged down to `largest` pixels, with the mask as alpha: (h, w, 4)."""
    return shrunk(lambda rows, columns: value[rows, columns], mask, largest)


def shrunk(shown: Callable[[slice, slice], Image], mask: Mask, largest: int) -> Bytes:
    """As `shrink`, of values (h, w, 3) that are made a band of rows at a time."""
    rows, columns = bounds(mask)
    step = max(1, -(-max(rows.stop - rows.start, columns.stop - columns.start) // largest))
    parts = []
    for top in range(rows.start, rows.stop, BAND_BLOCKS * step):
        some = slice(top, min(top + BAND_BLOCKS * step, rows.stop))
        weight = mask[some, columns].astype(np.float32)
        total = block_sum(weight, step)
        mean = block_sum(np.where(weight[..., None] > 0, np.nan_to_num(shown(some, columns)), 0), step) / np.maximum(total, 1)[..., None]
        parts.append(np.asarray(np.round(255 * np.dstack([np.clip(mean, 0, 1), total / step**2])), dtype=np.uint8))
    return np.concatenate(parts)


def block_sum(value: npt.NDArray[np.float32], step: int) -> npt.NDArray[np.float32]:
    """Sums (ceil(H / step), ceil(W / step), ...) over blocks of step by step pixels."""
    if step == 1:
        return value
    h, w = value.shape[:2]
    padded = np.pad(value, [(0, -h % step), (0, -w % step), *[(0, 0)] * (value.ndim - 2)])
    blocks = padded.reshape(padded.shape[0] // step, step, padded.shape[1] // step, step, *value.shape[2:])
    return np.asarray(blocks.sum(axis=(1, 3)), dtype=np.float32)


def shaded(normals: Image) -> Image:
    """Grey values (H, W, 3) in 0..1 of normals (H, W, 3) in C under one distant light from above, on the left."""
    shade = 0.06 + 0.9 * np.maximum(np.nan_to_num(normals) @ STILL_LIGHT, 0)
    return np.asarray(np.repeat((shade ** (1 / 2.2))[..., None], 3, axis=2), dtype=np.float32)


def doubtful(sigma: Image, high: float) -> Image:
    """Colours (H, W, 3) in 0..1 of standard deviations (H, W), from 0 to `high`."""
    at = np.clip(np.nan_to_num(sigma) / max(high, 1e-30), 0, 1)
    knots = np.linspace(0, 1, len(RAMP))
    return np.stack([np.interp(at, knots, RAMP[:, c]) for c in range(3)], axis=-1).astype(np.float32)

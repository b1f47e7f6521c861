"""Whether an image shows anything but its own noise.

Symbols: image I, L the difference of two Laplacians, noise n::

    n = 1.4826 median |L * I| / 6

Source: Immerkaer 1996.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry.arrays import Image, Labels

LEAST_STEPS, LEAST_NOISES = 6.0, 4.0
"""Smoothed over 3x3 pixels, light must range over so many steps of 255 and over so many sigmas of its noise in some block of the image;
pure noise reaches three sigmas."""
BLOCK_PX, SOME = 16, 99.8
"""Side of a block in px, and the percentile of the blocks' ranges that is looked at: a board may fill little of the image."""
CLEAR_STEPS = 40.0
"""Steps of 255 over which an image ranges that is not called dark or flat."""


def hardly_any_contrast(image: Image | Labels) -> str | None:
    """In words, where a grey image (H, W) of any scale holds nothing but its own noise; None: there is more in it."""
    import cv2

    light = image.astype(np.float32)
    scale = {"uint8": 1.0, "uint16": 255 / 65535}.get(image.dtype.name, 255.0 if light.max() <= 1 else None)
    noise = 1.4826 * float(np.median(np.abs(_second_differences(light)))) / 6
    smooth = cv2.blur(light, (3, 3))
    span = float(np.percentile(_over_blocks(smooth, np.maximum) - _over_blocks(smooth, np.minimum), SOME))
    least = LEAST_STEPS if image.dtype == np.uint8 else 0.0
    if span > max(least, LEAST_NOISES * noise) and span > 0:
        return None
    low, high = np.percentile(light[::4, ::4], [1, 99])
    size = f"{low:.4g} to {high:.4g}" if scale is None else f"{scale * low:.0f} to {scale * high:.0f} of 255"
    if scale is None or scale * (high - low) < CLEAR_STEPS:
        return f"the image has hardly any contrast ({size})"
    return f"the image is nothing but noise ({size})"


def _second_differences(light: Any) -> Any:
    """The second difference along x of that along y at every fourth pixel of every fourth row of an image (H, W)."""
    for axis in (0, 1):
        at = np.arange(0, light.shape[axis], 4)
        last = light.shape[axis] - 1
        before, after = np.abs(at - 1), np.where(at < last, at + 1, max(last - 1, 0))
        light = np.take(light, before, axis) - 2 * np.take(light, at, axis) + np.take(light, after, axis)
    return light


def _over_blocks(light: Any, extreme: np.ufunc) -> Any:
    """The extreme over blocks of an image (H, W), each half over the next."""
    half = BLOCK_PX // 2
    for _ in range(2):  # down the columns, then along the rows
        light = np.pad(light, ((0, -len(light) % half), (0, 0)), mode="edge").reshape(-1, half, light.shape[1])
        halves = extreme.reduce(light, axis=1)
        light = extreme(halves, halves[np.maximum(np.arange(len(halves)) - 1, 0)]).T
    return light

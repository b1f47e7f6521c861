r"""A small U-Net on a coarse image of several channels: it classifies object pixels, refines an outline, or predicts normals.

The encoder convolves and halves the image three times; at the lowest scale the channel means over the image are appended (global context).
The decoder has skip connections. A convolution takes 3 x 3 pixels, zero padded, with rectified output::

    y = max(0, b + sum_k W_k x_k)          k: the 9 positions

The image and its mirror image are both evaluated, for left-right symmetry. tools/fit_mask.py, tools/fit_outline.py and
tools/fit_normal_prior.py fit the weights. Source: Ronneberger, Fischer and Brox 2015, Medical Image Computing and Computer-Assisted
Intervention 9351.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.view import parallel
from lpcal.view.constants import CERTAIN

PLACE = 40.0
"""Pixels per unit of the two position channels."""


@dataclass(frozen=True)
class Convolution:
    """A 3 x 3 convolution from C to D channels."""

    weight: npt.NDArray[np.float32]
    """(9, D, C), row by row."""
    offset: npt.NDArray[np.float32]
    """(D,)."""

    def __call__(self, x: Image) -> Image:
        """Channels (C, rows, columns) convolved and rectified, (D, rows, columns)."""
        channels, rows, columns = x.shape
        wide = columns + 2
        padded = np.zeros((channels, (rows + 2) * wide + 2), np.float32)  # row by row: each of the 9 shifts is contiguous
        padded[:, : (rows + 2) * wide].reshape(channels, rows + 2, wide)[:, 1:-1, 1:-1] = x
        total = np.zeros((len(self.offset), rows * wide), np.float32)
        for place, weight in enumerate(self.weight):
            first = place // 3 * wide + place % 3
            total += weight @ padded[:, first : first + rows * wide]
        total += self.offset[:, None]
        return np.maximum(total, 0, out=total).reshape(-1, rows, wide)[:, :, :columns]


@dataclass(frozen=True)
class Network:
    """The fitted network."""

    channels: tuple[str, ...]
    mirrored: npt.NDArray[np.float32]
    """(C,) -1 for a channel whose sign changes in the mirror image, else 1."""
    middle: npt.NDArray[np.float32]
    spread: npt.NDArray[np.float32]
    """(C,) mean and standard deviation of each channel over the training pixels."""
    steps: Mapping[str, Convolution]
    weight: npt.NDArray[np.float32]
    """(N, D) of the output layer: N outputs from the last D channels."""
    offset: npt.NDArray[np.float32]
    """(N,)."""

    @staticmethod
    @cache
    def read(path: Path) -> Network:
        """The network in a .npz file; it is read once."""
        with np.load(path) as arrays:
            return Network.of(arrays)

    @staticmethod
    def of(arrays: Mapping[str, np.ndarray]) -> Network:
        """The network of the arrays of a file."""
        one = {name: np.asarray(value, np.float32) for name, value in arrays.items() if name != "channels"}
        names = [name.removesuffix(".weight") for name in one if name.endswith(".weight") and name != "out.weight"]
        steps = {name: Convolution(one[f"{name}.weight"], one[f"{name}.offset"]) for name in names}
        last = np.atleast_2d(one["out.weight"]), one["out.offset"]
        return Network(tuple(map(str, arrays["channels"])), one["mirrored"], one["middle"], one["spread"], steps, *last)

    def answers(self, channels: Mapping[str, Array], inside: Mask | None = None) -> tuple[Image, Image]:
        """Outputs (N, rows, columns) for the image, and for its mirror image mirrored back.

        `channels` holds a map (rows, columns) by name for each of the network's channels, and may hold more; pixels that are not `inside`
        (rows, columns) are zero in every channel.
        """
        x = np.stack([np.asarray(channels[name], np.float32) for name in self.channels])
        counted = np.ones(x.shape[1:], bool) if inside is None else inside
        mirror = self.mirrored[:, None, None] * x[:, :, ::-1]
        both = (x, counted), (mirror, counted[:, ::-1])
        own, mirrored = parallel.run_all(lambda one: self._once(*one), both)
        return own, mirrored[..., ::-1]

    def _once(self, x: Image, inside: Mask) -> Image:
        x = np.clip((x - self.middle[:, None, None]) / self.spread[:, None, None], -CERTAIN, CERTAIN)
        step, seen = self.steps, list[Image]()
        x = step["in"](np.concatenate([x, places(*inside.shape)]) * inside)
        for level in ("1", "2", "3"):
            seen.append(x)
            x = step[f"down {level}, again"](step[f"down {level}"](halved(x)))
        x = np.concatenate([x, np.broadcast_to(x.mean(axis=(1, 2), keepdims=True), x.shape)])
        for level in ("2", "1", "0"):
            before = seen.pop()
            x = step[f"up {level}"](np.concatenate([before, doubled(x, before.shape[1:])]))
        return np.asarray(np.tensordot(self.weight, x, axes=1) + self.offset[:, None, None], np.float32)


def places(rows: int, columns: int) -> Image:
    """Position channels (2, rows, columns): vertical offset from the image centre, and absolute horizontal offset."""
    y, z = ((np.arange(side) + 0.5 - side / 2) / PLACE for side in (rows, columns))
    return np.stack(np.meshgrid(y, np.abs(z), indexing="ij")).astype(np.float32)


def halved(x: Image) -> Image:
    """Means (C, rows / 2, columns / 2) of blocks of 2 x 2 pixels; the last block of an odd side is half as large."""
    for axis in (1, 2):
        first, second = (x.take(range(k, x.shape[axis], 2), axis=axis) for k in (0, 1))
        if second.shape[axis] < first.shape[axis]:
            second = np.concatenate([second, first.take([-1], axis=axis)], axis=axis)
        x = np.asarray((first + second) / 2, np.float32)
    return x


def doubled(x: Image, shape: tuple[int, ...]) -> Image:
    """Channels (C, rows, columns) enlarged by nearest neighbour to 2 x 2 pixels each, cropped to a shape."""
    return x.repeat(2, axis=1).repeat(2, axis=2)[:, : shape[0], : shape[1]]

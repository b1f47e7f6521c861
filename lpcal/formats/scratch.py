"""Images on the disk in square parts, of which one is read at a time: where a capture is larger than what memory should hold."""

from __future__ import annotations

import math
import tempfile
import threading
import weakref
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from lpcal.records.full_images import PART


class Scratch:
    """Images (N, H, W[, 3]) of one kind in a file that has no name and goes with the process; all images of a part lie together."""

    def __init__(self, shape: tuple[int, ...], dtype: npt.DTypeLike) -> None:
        """An empty file for images of a shape (N, H, W[, 3]) and a type."""
        self.shape, self.dtype = shape, np.dtype(dtype)
        self.parts = (-(-shape[1] // PART), -(-shape[2] // PART))
        self._of_part = (PART, PART, *shape[3:])
        self._bytes = math.prod(self._of_part) * self.dtype.itemsize
        self._file: IO[bytes] = tempfile.TemporaryFile(prefix="lpcal-")  # noqa: SIM115
        weakref.finalize(self, self._file.close)
        self._lock = threading.Lock()

    def keep(self, k: int, image: npt.NDArray[Any]) -> None:
        """Write image k (H, W[, 3])."""
        for row in range(self.parts[0]):
            band = image[row * PART : (row + 1) * PART]
            for column in range(self.parts[1]):
                some = band[:, column * PART : (column + 1) * PART]
                part = np.zeros(self._of_part, self.dtype)
                part[: some.shape[0], : some.shape[1]] = some
                with self._lock:
                    self._file.seek(self._place(row, column, k))
                    self._file.write(part.tobytes())

    def read(self, images: slice, rows: slice, columns: slice) -> npt.NDArray[Any]:
        """Part (N, h, w[, 3]) of some of the images."""
        first, last, _ = images.indices(self.shape[0])
        found = np.empty((last - first, rows.stop - rows.start, columns.stop - columns.start, *self.shape[3:]), self.dtype)
        for row in range(rows.start // PART, -(-rows.stop // PART)):
            for column in range(columns.start // PART, -(-columns.stop // PART)):
                with self._lock:
                    self._file.seek(self._place(row, column, first))
                    stored = self._file.read(self._bytes * (last - first))
                part = np.frombuffer(stored, self.dtype).reshape(last - first, *self._of_part)
                at, of = zip(_both(rows, row * PART), _both(columns, column * PART), strict=True)
                found[(slice(None), *at)] = part[(slice(None), *of)]
        return found

    def _place(self, row: int, column: int, k: int) -> int:
        return ((row * self.parts[1] + column) * self.shape[0] + k) * self._bytes


def _both(wanted: slice, first: int) -> tuple[slice, slice]:
    """Where a part that begins at `first` lies in what is wanted, and what of it is."""
    low, high = max(wanted.start, first), min(wanted.stop, first + PART)
    return slice(low - wanted.start, high - wanted.start), slice(low - first, high - first)

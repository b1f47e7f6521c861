"""A capture that is too large to be held: each image is read once, kept on the disk as it is stored, and in memory in coarse pixels.

One that is held, but whose object is too large to be solved at once, becomes coarse likewise, its images staying in memory.

A coarse pixel is the mean of the numbers of a square of pixels. Where one of these is as bright as the numbers get, the whole counts as
saturated, as one that is no longer a mean of light. On the disk the images lie in square parts, of which one is read at a time.
"""

from __future__ import annotations

import math
import tempfile
import threading
import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import IO, Any, Protocol

import numpy as np
import numpy.typing as npt

from lpcal.formats.full_scale import FullScale, full_scale
from lpcal.formats.images import Numbers
from lpcal.geometry.arrays import Image, Mask
from lpcal.geometry.clipping import clipped_at, clipping_level
from lpcal.records.full_images import PART, FullImages, Store
from lpcal.records.observations import RawCapture

HELD = 40_000_000
"""Samples, lights times pixels times colours, that a capture may have to be held: its maps and the solver's lists then take a gigabyte."""
COARSE_PIXELS = 160_000
"""Coarse pixels of a picture: somewhat fewer than a LightPanel's camera has, at which methods were tuned."""
CHUNK = 1 << 22
"""Numbers that are counted at once: counting copies them."""


def too_large(shape: tuple[int, ...], lights: int) -> bool:
    """Whether so many images of a shape (H, W[, 3]) are not to be held."""
    return lights * int(np.prod(shape)) > HELD


def factor_for(shape: tuple[int, ...]) -> int:
    """Pixels a coarse pixel, along a side, for images (H, W[, 3])."""
    return max(2, int(np.ceil(np.sqrt(shape[0] * shape[1] / COARSE_PIXELS))))


def blocks[T: np.generic](image: npt.NDArray[T], factor: int) -> npt.NDArray[T]:
    """An image (H, W[, 3]) as (h, factor, w, factor[, 3]); what is left at the right and below is dropped."""
    rows, columns = (side // factor for side in image.shape[:2])
    return image[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor, *image.shape[2:])


def coarse_mask(mask: Mask, factor: int) -> Mask:
    """Coarse pixels most of which lie in a mask (H, W)."""
    return np.asarray(blocks(mask, factor).mean(axis=(1, 3), dtype=np.float32) > 0.5)


class Keeper(Store, Protocol):
    """A store that images are put into."""

    def keep(self, k: int, image: npt.NDArray[Any]) -> None:
        """Keep image k (H, W[, 3])."""
        ...


@dataclass
class Sieve:
    """Takes images one by one, in any order and from several threads; what it keeps in memory is coarse."""

    store: Keeper
    full_scale: float
    step: float
    factor: int
    lights: int
    """How many of the images are those of lights."""
    counts: npt.NDArray[np.int64] = field(init=False)
    """How often each number occurs in them (whole numbers only)."""
    _coarse: dict[int, tuple[Image, Image]] = field(default_factory=dict)
    _lock: Any = field(default_factory=threading.Lock)

    def __post_init__(self) -> None:
        """Nothing has been counted."""
        self.counts = np.zeros(round(self.full_scale) + 1 if self.full_scale > 1 else 0, np.int64)

    @staticmethod
    def of(first: Numbers, images: int, lights: int, store: Keeper | None = None) -> Sieve:
        """For so many images like the first, kept in a store; by default in a file of the system's temporary ones."""
        shape = first.stored.shape
        kept = Scratch((images, *shape), first.stored.dtype) if store is None else store
        return Sieve(kept, first.full_scale, first.step, factor_for(shape), lights)

    def take(self, k: int, image: Numbers) -> None:
        """Image k."""
        stored = image.stored
        self.store.keep(k, stored)
        by = np.float32(self.full_scale)
        mean = blocks(stored, self.factor).mean(axis=(1, 3), dtype=np.float32) / by
        most = blocks(stored, self.factor).max(axis=(1, 3)).astype(np.float32) / by
        counts = np.zeros_like(self.counts)
        if k < self.lights and self.counts.size:
            flat = np.ascontiguousarray(stored).reshape(-1)
            for first in range(0, flat.size, CHUNK):
                counts += np.bincount(flat[first : first + CHUNK], minlength=counts.size)
        with self._lock:
            self.counts += counts
            self._coarse[k] = (mean, most)

    def full(self) -> FullScale:
        """What the lights' numbers are divided by."""
        if not self.counts.size:
            most = max(float(self._coarse[k][1].max()) for k in range(self.lights))
            return full_scale(np.array([most], np.float32), self.step)
        used = np.flatnonzero(self.counts)
        return full_scale((used / np.float32(self.full_scale)).astype(np.float32), self.step)

    def top(self, full: FullScale) -> float:
        """The fraction of full scale at which the lights' numbers end: the white level, or where they pile up below it."""
        white = full.white_level or 1.0
        if not self.counts.size:
            return white
        used = np.flatnonzero(self.counts)
        return clipped_at(used / self.full_scale, self.counts[used], white, self.step) or white

    def coarse(self, ks: Sequence[int], full: FullScale) -> Image:
        """Some images in coarse pixels (N, h, w[, 3]), as fractions of full scale; saturated ones are as bright as the numbers get."""
        divisor, top = np.float32(full.divisor), self.top(full)
        found = []
        for k in ks:
            mean, most = (one / divisor for one in self._coarse[k])
            found.append(np.where(most >= top - 0.5 * self.step, np.maximum(most, np.float32(top)), mean))
        return np.stack(found) if found else np.empty(0, np.float32)


def settled(raw: RawCapture, sieve: Sieve, full: FullScale, mask: Mask | None) -> RawCapture:
    """The coarse capture with its images in full size beside it; `mask` (H, W) is the user's, in full size."""
    counts = (len(raw.lights), 0 if raw.ambient is None else len(raw.ambient), len(raw.short))
    images = FullImages(sieve.store, counts, tuple(raw.short), sieve.full_scale * full.divisor, sieve.factor, mask, sieve.top(full))
    flat = None if raw.flat is None else blocks(raw.flat, sieve.factor).mean(axis=(1, 3))
    return replace(raw, mask=None if mask is None else coarse_mask(mask, sieve.factor), flat=flat, full=images)


def read_all[P](paths: Sequence[P], read: Callable[[P], Numbers], lights: int, first: Numbers, store: Keeper | None = None) -> Sieve:
    """A sieve that has taken the images of these paths, by threads that share them; they are kept in `store`, else in a file of its own."""
    from lpcal.view.parallel import run_all

    sieve = Sieve.of(first, len(paths), lights, store)
    run_all(lambda k: sieve.take(k, first if k == 0 else read(paths[k])), range(len(paths)))
    return sieve


def made_coarse(raw: RawCapture) -> RawCapture:
    """A capture that is held in coarse pixels, its images beside it in full size."""
    from lpcal.view.parallel import run_all

    ambient = [] if raw.ambient is None else [*raw.ambient]
    store = InMemory([*raw.images, *ambient, *raw.short.values()])
    sieve = Sieve(store, 1.0, raw.step, factor_for(raw.images.shape[1:]), len(raw.images))
    run_all(lambda k: sieve.take(k, Numbers(store.images[k], 1.0, raw.step)), range(len(store.images)))
    white = raw.white_level or 1.0
    full = FullScale(white_level=clipping_level(raw.images, white, raw.step) or white)
    L, K = len(raw.images), len(ambient)
    coarse = replace(
        raw,
        images=sieve.coarse(range(L), full),
        ambient=None if raw.ambient is None else sieve.coarse(range(L, L + K), full),
        short=dict(zip(raw.short, sieve.coarse(range(L + K, len(store.images)), full), strict=True)),
    )
    return settled(coarse, sieve, full, raw.mask)


class InMemory:
    """Images (H, W[, 3]) of one size in memory, as a store."""

    def __init__(self, images: Sequence[Image]) -> None:
        """One image at least."""
        self.images = images
        self.shape: tuple[int, ...] = (len(images), *images[0].shape)

    def keep(self, k: int, image: npt.NDArray[Any]) -> None:
        """They are there already."""

    def read(self, images: slice, rows: slice, columns: slice) -> npt.NDArray[Any]:
        """Part (N, h, w[, 3]) of some of the images."""
        return np.stack([image[rows, columns] for image in self.images[images]])


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

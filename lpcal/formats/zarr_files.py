"""Captures and surfaces in Zarr v3: what many write and read by chunks, on disks and in object stores.

A capture is a group whose attributes hold ``lpcal: 1, kind: capture, lights: [L0, ...]``, and where they are known ``exposure_s: [..]`` and
``ambient_exposure_s: [..]``; its arrays are ``images`` (L, H, W[, 3]) of whole numbers of 8 or 16 bits or of floats up to 1, and where
there are any ``ambient`` (K, H, W[, 3]) and ``mask`` (H, W). A surface's arrays are the maps of surface.npz, by tiles of `TILE` pixels.
A capture that is too large to be held stays where it lies: it is looked through once, image by image, and then read by tiles.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats import full_size
from lpcal.formats.full_scale import full_scale
from lpcal.formats.images import FLOAT_STEP, Numbers
from lpcal.formats.outputs import Kind, whole
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Image
from lpcal.records.observations import RawCapture
from lpcal.records.surface import Surface

MARK = "zarr.json"
"""The file that makes a folder a Zarr v3 group."""
TILE = 512
"""Pixels a side of a chunk: a MB or so of float32, which stores and disks like."""
MAPS = ("normals", "depth", "albedo", "mask", "normal_std_deg", "depth_std", "lights_used", "component")


def is_zarr(folder: Path) -> bool:
    """Whether a folder is a Zarr group."""
    return (folder / MARK).is_file()


def _zarr() -> Any:
    try:
        return importlib.import_module("zarr")
    except ImportError as error:
        raise InputError("zarr is not installed", where=MARK, needed="lpcal[zarr]", todo="uv add 'lpcal[zarr]'") from error


@reader("a capture in Zarr v3")
def read_capture_zarr(folder: Path, lights: Sequence[str], *, name: str | None = None, use: Sequence[str] | None = None) -> RawCapture:
    """Read a capture; of its images only those of the lights that are taken.

    Raises
    ------
    InputError
        It is no group of lpcal's, or an array is lacking or of another shape.
    DisagreementError
        A light has no image.
    """
    group = _opened(folder)
    held = [str(light) for light in group.attrs.get("lights") or []]
    images = _array(group, "images", folder)
    if images.ndim not in {3, 4} or images.shape[0] != len(held):
        raise InputError(f"images of {images.shape} for {len(held)} lights", where=str(folder), needed="(L, H, W) or (L, H, W, 3)")
    chosen = [light for light in lights if use is None or light in use]
    lacking = [light for light in chosen if light not in held]
    if lacking:
        raise DisagreementError(
            f"no image of {', '.join(lacking[:8])}", where=str(folder), needed="an image for each light", todo="take a subset with --use"
        )
    rows = [held.index(light) for light in chosen]
    ambient = group.get("ambient")
    if ambient is not None and (ambient.ndim != images.ndim or ambient.shape[1:] != images.shape[1:] or ambient.dtype != images.dtype):
        raise DisagreementError(
            f"ambient {ambient.shape} of {ambient.dtype}",
            where=str(folder),
            needed=f"(K, *{images.shape[1:]}) of {images.dtype}, as images",
        )
    exposures = np.array(group.attrs.get("exposure_s") or np.ones(len(held)), dtype=float)
    of_ambient = group.attrs.get("ambient_exposure_s") or np.ones(0 if ambient is None else ambient.shape[0])
    lying = _Lying(images, rows, ambient)
    sieve = _sieved(lying, len(rows)) if full_size.too_large(images.shape[1:], len(rows)) else None
    first = lying.image(0)
    if sieve is None:
        stacks = [np.stack([_shares(lying.image(k)) for k in range(*both)]) for both in lying.groups]
        full = full_scale(stacks[0], first.step)
        stacks = [np.asarray(stack / np.float32(full.divisor), np.float32) for stack in stacks]
    else:
        full = sieve.full()
        stacks = [sieve.coarse(range(*both), full) for both in lying.groups]
    mask = np.asarray(group["mask"][...]) > 0 if "mask" in group else None
    raw = RawCapture(
        name=name or folder.resolve().name.removesuffix(".zarr"),
        lights=tuple(chosen),
        images=stacks[0],
        exposure_s=exposures[rows],
        ambient=None if ambient is None else stacks[1],
        ambient_exposure_s=np.array(of_ambient, dtype=float),
        mask=mask,
        step=full.step or first.step,
        white_level=full.white_level,
        notes=full.notes,
    )
    return raw if sieve is None else full_size.settled(raw, sieve, full, mask)


class _Lying:
    """The images that are taken of a group, where they lie: those of the lights, then the ambient ones."""

    def __init__(self, images: Any, rows: Sequence[int], ambient: Any) -> None:
        """The rows that are taken of arrays (L, H, W[, 3]), and all of (K, H, W[, 3])."""
        many = 0 if ambient is None else ambient.shape[0]
        self._of = [(images, row) for row in rows] + [(ambient, row) for row in range(many)]
        self.groups = [(0, len(rows))] + ([(len(rows), len(self._of))] if many else [])
        self.shape, self.dtype = (len(self._of), *images.shape[1:]), images.dtype

    def image(self, k: int) -> Numbers:
        """One image, as it is stored."""
        array, row = self._of[k]
        full = float(np.iinfo(self.dtype).max) if self.dtype.kind in "ui" else 1.0
        return Numbers(np.asarray(array[row]), full, 1 / full if full > 1 else FLOAT_STEP)

    def keep(self, k: int, image: Any) -> None:
        """Nothing: it lies there."""

    def read(self, images: slice, rows: slice, columns: slice) -> Any:
        """Part (N, h, w[, 3]) of some of the images, by the chunks that hold it."""
        return np.stack([array[row, rows, columns] for array, row in self._of[images]])


def _sieved(lying: _Lying, lights: int) -> full_size.Sieve:
    """Look through the images once."""
    return full_size.read_all(range(lying.shape[0]), lying.image, lights, lying.image(0), lying)


def _shares(numbers: Numbers) -> Image:
    """Stored numbers as fractions of full scale."""
    return numbers.image.pixels


def tiles(folder: Path, side: int = TILE) -> Iterator[tuple[slice, slice, Any]]:
    """A capture's images tile by tile: rows, columns and the numbers (L, h, w[, 3]) as stored; only one tile is in memory.

    Raises
    ------
    InputError
        It is no group of lpcal's.
    """
    images = _array(_opened(folder), "images", folder)
    for top in range(0, images.shape[1], side):
        for left in range(0, images.shape[2], side):
            rows, columns = slice(top, min(top + side, images.shape[1])), slice(left, min(left + side, images.shape[2]))
            yield rows, columns, images[:, rows, columns]


def _opened(folder: Path) -> Any:
    zarr = _zarr()
    try:
        group = zarr.open_group(folder, mode="r")
    except Exception as error:
        raise InputError(f"cannot be read: {error}", where=str(folder), needed="a Zarr v3 group") from error
    if group.attrs.get("kind") != "capture":
        raise InputError(f"of kind {group.attrs.get('kind')!r}", where=str(folder), needed="kind: capture among its attributes")
    return group


def _array(group: Any, name: str, folder: Path) -> Any:
    if name not in group:
        raise InputError(f"no array {name}", where=str(folder), needed=f"{name} (L, H, W) or (L, H, W, 3)")
    return group[name]


def _is_ours(folder: Path) -> bool:
    return is_zarr(folder) and '"lpcal"' in (folder / MARK).read_text(encoding="utf-8", errors="replace")


def write_capture_zarr(folder: Path, raw: RawCapture) -> None:
    """Write a capture, each image in tiles; whole or not at all."""
    zarr = _zarr()
    full = round(1 / raw.step)
    kind = np.uint8 if full <= np.iinfo(np.uint8).max else np.uint16
    top = np.iinfo(kind).max
    with whole(folder, Kind("a capture in Zarr", _is_ours)) as draft:
        group = zarr.open_group(draft, mode="w", zarr_format=3)
        said = {"exposure_s": raw.exposure_s.tolist(), "ambient_exposure_s": raw.ambient_exposure_s.tolist()}
        group.attrs.update({"lpcal": 1, "kind": "capture", "lights": list(raw.lights), **said})
        stacks = {"images": raw.images} | ({} if raw.ambient is None else {"ambient": raw.ambient})
        for name, stack in stacks.items():
            tile = (1, min(TILE, stack.shape[1]), min(TILE, stack.shape[2]), *stack.shape[3:])
            array = group.create_array(name, shape=stack.shape, chunks=tile, dtype=kind)
            for k, image in enumerate(stack):
                array[k] = np.rint(top * np.clip(image, 0, 1)).astype(kind)
        if raw.mask is not None:
            group.create_array("mask", data=raw.mask.astype(np.uint8), chunks=tuple(min(TILE, size) for size in raw.mask.shape))


def write_surface_zarr(folder: Path, surface: Surface) -> None:
    """Write a surface's maps, in tiles; whole or not at all."""
    zarr = _zarr()
    with whole(folder, Kind("a surface in Zarr", _is_ours)) as draft:
        group = zarr.open_group(draft, mode="w", zarr_format=3)
        group.attrs.update({"lpcal": 1, "kind": "surface", "name": surface.name, "units": "metres" if surface.metric else "pixels"})
        for name in MAPS:
            values = np.asarray(getattr(surface, name))
            stored = values.astype(np.uint8) if values.dtype == bool else values
            chunks = (*(min(TILE, size) for size in values.shape[:2]), *values.shape[2:])
            group.create_array(name, data=stored, chunks=chunks)

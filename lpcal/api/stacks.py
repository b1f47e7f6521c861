"""Stacks of images that callers hand over, brought into the captures that are read from folders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.full_scale import FullScale, full_scale
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records import given
from lpcal.records.observations import RawCapture

FLOAT_STEP = 1e-6
"""One step of the numbers of a float image, as a fraction of full scale, as for files: finer than any sensor's."""


def capture(
    images: npt.ArrayLike | RawCapture,
    lights: Sequence[str] | None,
    *,
    name: str,
    ambient: npt.ArrayLike | None = None,
    exposure_s: npt.ArrayLike | None = None,
    ambient_exposure_s: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
) -> RawCapture:
    """A capture as it is read from a folder, of a stack of images (L, H, W) or (L, H, W, 3), one a light; a capture is left as it is.

    The lights are called L0, L1, ... where no names are given. Whole numbers count by their type's largest, floats as fractions of full
    scale.

    Raises
    ------
    InputError, DisagreementError
        Not images; not as many as lights; or ambient image, mask or exposures of another shape.
    """
    if isinstance(images, RawCapture):
        own = {"lights": lights, "ambient": ambient, "exposure_s": exposure_s, "ambient_exposure_s": ambient_exposure_s}
        beside = [key for key, value in own.items() if value is not None]
        if beside:
            raise InputError("given beside a capture, which brings its own", where=", ".join(beside), needed="one of both")
        return images if mask is None else replace(images, mask=of_image_size(mask, images.images.shape[1:3], "mask"))
    if isinstance(images, str | Path):
        needed, todo = "images (L, H, W[, 3]), or a capture that was read", "lpcal.read_capture(folder, calibration) reads a folder"
        raise InputError(f"holds no numbers, but a path: {images}", where="images", needed=needed, todo=todo)
    stack, step = _fractions(images, "images")
    if stack.ndim not in (3, 4) or (stack.ndim == 4 and stack.shape[3] != 3):
        raise InputError(f"an array of {given.shape_of(stack)}", where="images", needed="(L, H, W) or (L, H, W, 3)")
    if not stack.size:
        raise InputError(f"an array of {given.shape_of(stack)}", where="images", needed="images that hold pixels")
    lights = [f"L{k}" for k in range(len(stack))] if lights is None else lights
    if len(stack) != len(lights):
        raise DisagreementError(
            f"{len(stack)} images for {len(lights)} lights",
            where="images",
            needed="one image a light",
            todo="name those that you give: lights",
        )
    if not all(isinstance(one, str) for one in lights):
        raise InputError(repr(list(lights))[:80], where="lights", needed="names of lights of the calibration, one an image")
    full = full_scale(stack, step)
    room = None if ambient is None else _room(ambient, stack, full)
    return RawCapture(
        name=name,
        lights=tuple(lights),
        images=stack / np.float32(full.divisor),
        exposure_s=np.ones(len(stack)) if exposure_s is None else given.times(exposure_s, len(stack), "exposure_s", "the images"),
        ambient=room,
        ambient_exposure_s=_room_exposures(ambient_exposure_s, exposure_s, room),
        mask=None if mask is None else of_image_size(mask, stack.shape[1:3], "mask"),
        step=full.step or step,
        white_level=full.white_level,
        notes=full.notes,
    )


def of_image_size(mask: npt.ArrayLike, shape: tuple[int, ...], name: str) -> Mask:
    """A mask (H, W), True where a caller's is not zero.

    Raises
    ------
    InputError
        It holds no numbers, or some that are not finite.
    DisagreementError
        It is of another size than the images.
    """
    stored = given.array(mask, name)
    if stored.dtype.kind not in "bui":
        stored = given.numbers(stored, name)
    found = stored != 0
    if found.shape != tuple(shape):
        raise DisagreementError(
            f"an array of {given.shape_of(found)}", where=name, needed=f"{given.shape_of(np.empty(shape))}, the images' height and width"
        )
    return found


def fractions(images: npt.ArrayLike) -> Image:
    """Stored numbers as fractions of their type's full scale."""
    return _fractions(images, "images")[0]


def _room(ambient: npt.ArrayLike, stack: Image, full: FullScale) -> Image:
    """Ambient images (K, H, W[, 3]) of one or several."""
    room, _ = _fractions(ambient, "ambient")
    room = room[None] if room.ndim == stack.ndim - 1 else room
    if room.shape[1:] != stack.shape[1:]:
        raise DisagreementError(
            f"an array of {given.shape_of(room)}", where="ambient", needed=f"{given.shape_of(stack[0])}, as the images, or several of them"
        )
    return np.asarray(room / np.float32(full.divisor), np.float32)


def _room_exposures(stated: npt.ArrayLike | None, exposure_s: npt.ArrayLike | None, room: Image | None) -> Array:
    """Exposures (K,) of the ambient images: as stated, or that which all the lights' images share."""
    count = 0 if room is None else len(room)
    if stated is not None:
        return given.times(np.broadcast_to(np.asarray(stated), (count,)), count, "ambient_exposure_s", "the ambient images")
    own = np.ones(1) if exposure_s is None else given.numbers(exposure_s, "exposure_s").ravel()
    if count and np.ptp(own) > 0:
        raise InputError("none is stated", where="ambient_exposure_s", needed="the ambient image's exposure: those of the images differ")
    return np.full(count, own[0])


def _fractions(images: npt.ArrayLike, name: str) -> tuple[Image, float]:
    """Images as fractions of full scale, and one step of their numbers."""
    found = given.array(images, name)
    if found.dtype.kind in "ub":
        most = 1 if found.dtype.kind == "b" else np.iinfo(found.dtype).max
        return np.asarray(found / np.float32(most), np.float32), 1 / most
    return given.numbers(found, name).astype(np.float32), FLOAT_STEP

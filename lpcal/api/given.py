"""What callers hand over, checked and brought into the records that the stages take: transforms, times, stacks of images."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.full_scale import FullScale, full_scale
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.observations import RawCapture

RIGID = 0.02
"""How far the product of a rotation with its transpose may be from the identity: numbers of two digits are taken for a rotation."""
FLOAT_STEP = 1e-6
"""One step of the numbers of a float image, as a fraction of full scale, as for files: finer than any sensor's."""


def transforms(values: npt.ArrayLike, name: str) -> Array:
    """Rigid transforms (N, 4, 4) of whatever a caller gives for them.

    Raises
    ------
    InputError
        Another shape, a number that is not finite, or a matrix that turns and shifts nothing rigid; its row is named.
    """
    found = numbers(values, name)
    if found.ndim != 3 or found.shape[1:] != (4, 4):
        raise InputError(f"an array of {_shape(found)}", where=name, needed="transforms (N, 4, 4)")
    R = found[:, :3, :3]
    off = np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max(axis=(1, 2), initial=0.0) > RIGID
    off |= (np.linalg.det(R) < 0) | (np.abs(found[:, 3] - [0, 0, 0, 1]) > RIGID).any(axis=1)
    if off.any():
        row = int(np.flatnonzero(off)[0])
        raise InputError("is no rigid transform", where=f"{name}[{row}]", needed="a rotation, a shift in metres, and 0 0 0 1 below")
    return found


def numbers(values: npt.ArrayLike, name: str, *, finite: bool = True) -> Array:
    """Numbers in double precision of whatever a caller gives for them.

    Raises
    ------
    InputError
        They are none, or one is not finite.
    """
    try:
        found = np.asarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"holds no numbers ({error})", where=name, needed="an array of numbers") from error
    if finite and not np.isfinite(found).all():
        raise InputError(f"{int((~np.isfinite(found)).sum())} numbers that are not finite", where=name, needed="finite numbers")
    return found


def times(values: npt.ArrayLike, count: int, name: str, of: str) -> Array:
    """Seconds (N,), as many as there are of something.

    Raises
    ------
    InputError, DisagreementError
        They are no numbers; there are more or fewer.
    """
    found = numbers(values, name)
    if found.shape != (count,):
        raise DisagreementError(f"an array of {_shape(found)}", where=name, needed=f"({count},): one time for each of {of}")
    return found


def capture(
    images: npt.ArrayLike | RawCapture,
    lights: Sequence[str],
    *,
    name: str,
    ambient: npt.ArrayLike | None = None,
    exposure_s: npt.ArrayLike | None = None,
    ambient_exposure_s: npt.ArrayLike | None = None,
    mask: npt.ArrayLike | None = None,
) -> RawCapture:
    """A capture as it is read from a folder, of a stack of images (L, H, W) or (L, H, W, 3), one a light; a capture is left as it is.

    Whole numbers count by their type's largest, floats as fractions of full scale.

    Raises
    ------
    InputError, DisagreementError
        Not images; not as many as lights; or ambient image, mask or exposures of another shape.
    """
    if isinstance(images, RawCapture):
        return images
    stack, step = _fractions(images, "images")
    if stack.ndim not in (3, 4) or (stack.ndim == 4 and stack.shape[3] != 3):
        raise InputError(f"an array of {_shape(stack)}", where="images", needed="(L, H, W) or (L, H, W, 3)")
    if len(stack) != len(lights):
        raise DisagreementError(
            f"{len(stack)} images for {len(lights)} lights",
            where="images",
            needed="one image a light",
            todo="name those that you give: lights",
        )
    full = full_scale(stack, step)
    room = None if ambient is None else _room(ambient, stack, full)
    return RawCapture(
        name=name,
        lights=tuple(lights),
        images=stack / np.float32(full.divisor),
        exposure_s=np.ones(len(stack)) if exposure_s is None else times(exposure_s, len(stack), "exposure_s", "the images"),
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
    DisagreementError
        It is of another size than the images.
    """
    found = np.asarray(mask) != 0
    if found.shape != tuple(shape):
        raise DisagreementError(
            f"an array of {_shape(found)}", where=name, needed=f"{_shape(np.empty(shape))}, the images' height and width"
        )
    return found


def _room(ambient: npt.ArrayLike, stack: Image, full: FullScale) -> Image:
    """Ambient images (K, H, W[, 3]) of one or several."""
    room, _ = _fractions(ambient, "ambient")
    room = room[None] if room.ndim == stack.ndim - 1 else room
    if room.shape[1:] != stack.shape[1:]:
        raise DisagreementError(
            f"an array of {_shape(room)}", where="ambient", needed=f"{_shape(stack[0])}, as the images, or several of them"
        )
    return np.asarray(room / np.float32(full.divisor), np.float32)


def _room_exposures(stated: npt.ArrayLike | None, exposure_s: npt.ArrayLike | None, room: Image | None) -> Array:
    """Exposures (K,) of the ambient images: as stated, or that which all the lights' images share."""
    count = 0 if room is None else len(room)
    if stated is not None:
        return times(np.broadcast_to(np.asarray(stated), (count,)), count, "ambient_exposure_s", "the ambient images")
    own = np.ones(1) if exposure_s is None else numbers(exposure_s, "exposure_s").ravel()
    if count and np.ptp(own) > 0:
        raise InputError("none is stated", where="ambient_exposure_s", needed="the ambient image's exposure: those of the images differ")
    return np.full(count, own[0])


def _fractions(images: npt.ArrayLike, name: str) -> tuple[Image, float]:
    """Images as fractions of full scale, and one step of their numbers."""
    found: npt.NDArray[Any] = np.asarray(images)
    if found.dtype.kind in "ub":
        most = 1 if found.dtype.kind == "b" else np.iinfo(found.dtype).max
        return np.asarray(found / np.float32(most), np.float32), 1 / most
    return numbers(found, name).astype(np.float32), FLOAT_STEP


def _shape(values: npt.NDArray[Any]) -> str:
    return f"({', '.join(map(str, values.shape))})"

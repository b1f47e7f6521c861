"""Image files, read as fractions of their full scale."""

from __future__ import annotations

import io
import struct
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.named_files import exists, kind_of_other
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Image as Pixels

ENDINGS = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".webp")


@dataclass(frozen=True)
class StoredImage:
    """Pixels (H, W) or (H, W, 3) RGB as fractions of full scale, and one step of the stored numbers on that scale."""

    pixels: Pixels
    step: float

    @property
    def size(self) -> tuple[int, int]:
        """Width, height."""
        return self.pixels.shape[1], self.pixels.shape[0]


MOST_PIXELS = 250_000_000
"""Pixels of the largest image that is read: five times those of the largest cameras."""
BOMB_PIXELS, BOMB_BYTES_A_PIXEL = 60_000_000, 1 / 200
"""An image of more pixels than this, in fewer bytes a pixel than this, is taken for a bomb and not decoded."""


@reader("an image")
def read_image(path: Path) -> StoredImage:
    """Read an image of 8 or 16 bit, or of float (full scale 1); grey or RGB, an alpha channel is dropped, EXIF turns are not applied.

    Raises
    ------
    InputError
        Not there, of a kind that is not read, not an image that can be read whole, or larger than `MOST_PIXELS`.
    """
    import cv2

    if not exists(path) or not path.is_file():
        raise InputError("no such image", where=str(path), needed="an image file")
    other = kind_of_other([path])
    if other:
        raise InputError(other, where=str(path), needed=f"one of {', '.join(ENDINGS)}")
    data = path.read_bytes()
    _refuse_bomb(data, path)
    try:
        stored = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED) if data else None
    except cv2.error:
        stored = None
    if stored is None:
        raise InputError("cannot be read as an image", where=str(path), needed=f"one of {', '.join(ENDINGS)}, whole", todo="copy it anew")
    if stored.ndim == 3:
        stored = stored[:, :, 2::-1] if stored.shape[2] >= 3 else stored[:, :, 0]
    full_scale = {"uint8": 255.0, "uint16": 65535.0}.get(stored.dtype.name, 1.0)
    if full_scale == 1.0 and stored.dtype.kind != "f":
        raise InputError(f"stores {stored.dtype.name}", where=str(path), needed="8 or 16 bit, or float", todo="convert it to a 16 bit PNG")
    return StoredImage(
        np.ascontiguousarray(stored, dtype=np.float32) / np.float32(full_scale), 1.0 / full_scale if full_scale > 1 else 1e-6
    )


def _refuse_bomb(data: bytes, path: Path) -> None:
    """Refuse an image by what its head says of its size, before it is decoded."""
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of its own bound
            with Image.open(io.BytesIO(data)) as head:
                width, height = head.size
    except Image.DecompressionBombError:
        raise InputError(f"more than {MOST_PIXELS / 1e6:.0f} megapixels", where=str(path), needed="a smaller image") from None
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError, struct.error, OverflowError):
        return  # the decoder says what is wrong with it
    pixels = width * height
    if pixels > MOST_PIXELS or (pixels > BOMB_PIXELS and len(data) < BOMB_BYTES_A_PIXEL * pixels):
        found = f"says that it holds {width}x{height} pixels, in {len(data) / 1000:.0f} kB"
        raise InputError(found, where=str(path), needed=f"an image of at most {MOST_PIXELS / 1e6:.0f} megapixels", todo="is it whole?")

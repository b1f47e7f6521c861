"""Image files, read as fractions of their full scale."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry.arrays import Image

ENDINGS = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".webp")


@dataclass(frozen=True)
class StoredImage:
    """Pixels (H, W) or (H, W, 3) RGB as fractions of full scale, and one step of the stored numbers on that scale."""

    pixels: Image
    step: float

    @property
    def size(self) -> tuple[int, int]:
        """Width, height."""
        return self.pixels.shape[1], self.pixels.shape[0]


def read_image(path: Path) -> StoredImage:
    """Read an image of 8 or 16 bit, or of float (full scale 1); grey or RGB, an alpha channel is dropped, EXIF turns are not applied.

    Raises
    ------
    InputError
        Not there, or not an image that can be read whole.
    """
    import cv2

    if not path.is_file():
        raise InputError("no such image", where=str(path), needed="an image file")
    data = np.frombuffer(path.read_bytes(), np.uint8)
    try:
        stored = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if data.size else None
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

"""Image files, read as fractions of their full scale."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.image_checks import as_stored, orientation, refuse_cut, refuse_odd_head
from lpcal.formats.named_files import exists, kind_of_other
from lpcal.formats.reading import reader
from lpcal.formats.tone_claims import tone_claim
from lpcal.geometry.arrays import Image
from lpcal.records.sensor import ToneClaim

ENDINGS = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".webp")


@dataclass(frozen=True)
class StoredImage:
    """Pixels (H, W) or (H, W, 3) RGB as fractions of full scale, and one step of the stored numbers on that scale."""

    pixels: Image
    step: float
    claim: ToneClaim | None = None
    """What the file says of its tone curve."""

    @property
    def size(self) -> tuple[int, int]:
        """Width, height."""
        return self.pixels.shape[1], self.pixels.shape[0]


@reader("an image", "cv2", "PIL.Image")
def read_image(path: Path) -> StoredImage:
    """Read an image of 8 or 16 bit, or of float (full scale 1); grey or RGB, alpha is dropped; turns by tags are not applied.

    Raises
    ------
    InputError
        Not there, of a kind that is not read, not an image that can be read whole, several in one file, or larger than any camera's.
    """
    import cv2

    if not exists(path) or not path.is_file():
        raise InputError("no such image", where=str(path), needed="an image file")
    other = kind_of_other([path])
    if other:
        raise InputError(other, where=str(path), needed=f"one of {', '.join(ENDINGS)}")
    data = path.read_bytes()
    refuse_cut(data, path)
    refuse_odd_head(data, path)
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # what its decoders say is said here
    try:
        stored = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED) if data else None
    except cv2.error:
        stored = None
    if stored is None:
        raise InputError("cannot be read as an image", where=str(path), needed=f"one of {', '.join(ENDINGS)}, whole", todo="copy it anew")
    if data[:2] in {b"II", b"MM"}:
        stored = as_stored(stored, orientation(data))
    if stored.ndim == 3:
        stored = stored[:, :, 2::-1] if stored.shape[2] >= 3 else stored[:, :, 0]
    full_scale = {"uint8": 255.0, "uint16": 65535.0}.get(stored.dtype.name, 1.0)
    if full_scale == 1.0 and stored.dtype.kind != "f":
        raise InputError(f"stores {stored.dtype.name}", where=str(path), needed="8 or 16 bit, or float", todo="convert it to a 16 bit PNG")
    pixels = np.ascontiguousarray(stored, dtype=np.float32) / np.float32(full_scale)
    return StoredImage(pixels, 1.0 / full_scale if full_scale > 1 else 1e-6, tone_claim(data))

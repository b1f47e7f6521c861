"""What decoders keep to themselves: a file cut off is filled up with grey, a head that asks for all memory, a tag that turns the picture.

The pixels that count are those that the sensor has, which are the stored ones: tags that say how to hold the picture are not followed.

A JPEG ends with its end marker after its last scan, a PNG with its IEND chunk. The tag is EXIF's (and TIFF's) 274, orientation: 1 is
as stored. Source: JPEG ITU-T T.81 annex B, PNG specification, TIFF 6.0 (EXIF keeps a TIFF header in the marker APP1).
"""

from __future__ import annotations

import io
import struct
import warnings
from pathlib import Path
from typing import Any

from lpcal.errors import InputError
from lpcal.geometry.arrays import Image

MOST_PIXELS = 250_000_000
"""Pixels of the largest image that is read: five times those of the largest cameras."""
BOMB_PIXELS, BOMB_BYTES_A_PIXEL = 60_000_000, 1 / 200
"""An image of more pixels than this, in fewer bytes a pixel than this, is taken for a bomb and not decoded."""

ORIENTATION = 274
JPEG_START, JPEG_END, JPEG_SCAN, JPEG_EXIF = b"\xff\xd8", b"\xff\xd9", b"\xff\xda", b"Exif\x00\x00"
PNG_START, PNG_END = b"\x89PNG", b"IEND"
TIFF_STARTS = {b"II*\x00": "<", b"MM\x00*": ">"}


def refuse_cut(data: bytes, path: Path) -> None:
    """An image must be whole.

    Raises
    ------
    InputError
        It ends before its end marker.
    """
    if (data.startswith(JPEG_START) and data.rfind(JPEG_END) < data.rfind(JPEG_SCAN)) or (
        data.startswith(PNG_START) and PNG_END not in data[-(1 << 16) :]
    ):
        raise InputError("the image is cut off", where=str(path), needed="a whole file", todo="copy it anew")


def refuse_odd_head(data: bytes, path: Path) -> None:
    """Refuse an image by what its head says, before it is decoded: one too large to be, several in one, or damaged compression.

    Raises
    ------
    InputError
        One of these; a head that cannot be read is left to the decoder.
    """
    from PIL import Image as Picture

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of its own bound, and of tags
            with Picture.open(io.BytesIO(data)) as head:
                _refuse_bomb(*head.size, len(data), path)
                if head.format == "TIFF":
                    _refuse_pages(head, path)
                    if head.info.get("compression", "raw") != "raw":
                        head.load()
    except Picture.DecompressionBombError:
        raise InputError(f"more than {MOST_PIXELS / 1e6:.0f} megapixels", where=str(path), needed="a smaller image") from None
    except OSError as error:
        if "decoder error" in str(error):  # OpenCV fills the rest with whatever it has
            raise InputError("the image is damaged", where=str(path), needed="a whole file", todo="copy it anew") from error
    except (ValueError, SyntaxError, TypeError, KeyError, struct.error, OverflowError):
        return


def _refuse_bomb(width: int, height: int, size: int, path: Path) -> None:
    pixels = width * height
    if pixels > MOST_PIXELS or (pixels > BOMB_PIXELS and size < BOMB_BYTES_A_PIXEL * pixels):
        found = f"says that it holds {width}x{height} pixels, in {size / 1000:.0f} kB"
        raise InputError(found, where=str(path), needed=f"an image of at most {MOST_PIXELS / 1e6:.0f} megapixels", todo="is it whole?")


def _refuse_pages(head: Any, path: Path) -> None:
    """Refuse a stack of images of one size; pages of other sizes are previews of the first."""
    first = head.size
    if head.n_frames > 1:
        head.seek(1)
        if head.size == first:
            found = f"{head.n_frames} images of {first[0]}x{first[1]} in one file"
            raise InputError(found, where=str(path), needed="one image a file", todo="save each image in a file of its own")
        head.seek(0)


def as_stored(pixels: Image, turn: int) -> Image:
    """The pixels (H, W[, C]) of a TIFF as its file holds them, from the same turned as its tag 274 says, which OpenCV does.

    1 to 4 are flipped left to right (2, 3) and top to bottom (3, 4); 5 to 8 are transposed first and flipped then (6, 7 and 7, 8).
    """
    upright = pixels[:, ::-1] if turn in {2, 3, 6, 7} else pixels
    upright = upright[::-1] if turn in {3, 4, 7, 8} else upright
    return upright.swapaxes(0, 1) if turn >= 5 else upright


def orientation(data: bytes) -> int:
    """The orientation that a JPEG's or TIFF's tag states, 1 to 8; 1 where there is none."""
    if data.startswith(JPEG_START):
        start = data.find(JPEG_EXIF, 0, 1 << 16)
        header = start + len(JPEG_EXIF)
        return 1 if start < 0 else _tag(data[header : header + (1 << 16)])
    return _tag(data) if data[:4] in TIFF_STARTS else 1


def _tag(tiff: bytes) -> int:
    order = TIFF_STARTS.get(tiff[:4])
    if order is None:
        return 1
    try:
        (first,) = struct.unpack_from(f"{order}I", tiff, 4)
        (count,) = struct.unpack_from(f"{order}H", tiff, first)
        for entry in range(first + 2, first + 2 + 12 * count, 12):
            tag, _, _, value = struct.unpack_from(f"{order}HHIH", tiff, entry)
            if tag == ORIENTATION:
                return int(value) if 1 <= value <= 8 else 1
    except struct.error:
        pass
    return 1

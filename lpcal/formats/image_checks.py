"""What decoders keep to themselves: a file cut off is filled up with grey, and a tag says that the picture is to be shown turned.

A JPEG ends with its end marker after its last scan, a PNG with its IEND chunk. The tag is EXIF's (and TIFF's) 274, orientation: 1 is
as stored. Source: JPEG ITU-T T.81 annex B, PNG specification, TIFF 6.0 (EXIF keeps a TIFF header in the marker APP1).
"""

from __future__ import annotations

import struct
from pathlib import Path

from lpcal.errors import InputError

ORIENTATION = 274
JPEG_START, JPEG_END, JPEG_SCAN, JPEG_EXIF = b"\xff\xd8", b"\xff\xd9", b"\xff\xda", b"Exif\x00\x00"
PNG_START, PNG_END = b"\x89PNG", b"IEND"
TIFF_STARTS = {b"II*\x00": "<", b"MM\x00*": ">"}


def refuse_cut_or_turned(path: Path) -> None:
    """An image of a calibration must be whole, and its pixels as the sensor has them.

    Raises
    ------
    InputError
        Not there, cut off, or to be turned when shown.
    """
    if not path.is_file():
        raise InputError("no such image", where=str(path), needed="an image file")
    data = path.read_bytes()
    if (data.startswith(JPEG_START) and data.rfind(JPEG_END) < data.rfind(JPEG_SCAN)) or (
        data.startswith(PNG_START) and PNG_END not in data[-32:]
    ):
        raise InputError("the image is cut off", where=str(path), needed="a whole file", todo="copy it anew")
    turn = orientation(data)
    if turn != 1:
        raise InputError(
            f"a tag (EXIF orientation {turn}) says that this image is to be shown turned or mirrored",
            where=str(path),
            needed="images whose pixels are as the sensor has them, all alike",
            todo="turn the camera's rotation off, and remove the tag from these images",
        )


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

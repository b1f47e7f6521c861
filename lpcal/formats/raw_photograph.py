"""Cameras' raw files (CR2, CR3, NEF, ARW, RAF, DNG, ...) by rawpy: the sensor's own numbers, linear, nothing clipped but by the sensor.

The Bayer mosaic is filled in between by OpenCV's bilinear demosaicing, which keeps the numbers linear; the black level is taken off
afterwards, so that the noise of the dark keeps both signs; the white level is 1. No white balance, no matrix of colours, no turn of the
picture. A sensor of another mosaic (X-Trans) or of none is filled in by LibRaw, whose numbers below black are zero.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.exif import TakenAt
from lpcal.formats.named_files import raw_is_read
from lpcal.geometry.arrays import Image

BAYER = {"RGGB": "RG", "BGGR": "BG", "GRBG": "GR", "GBRG": "GB"}
"""OpenCV's letters for a mosaic that begins so: the pattern's first two, named by what stands there."""
IN_SIXTEEN = 65535


def read_raw_photograph(path: Path) -> tuple[Image, float, TakenAt | None]:
    """Pixels (H, W, 3) as fractions of what the sensor holds above black, one step of its numbers, and how it was exposed.

    Raises
    ------
    InputError
        rawpy is not installed, or the file cannot be read.
    """
    if not raw_is_read():
        raise InputError(
            "a camera's raw file, and rawpy is not installed",
            where=str(path),
            needed="lpcal[raw]",
            todo="uv add 'lpcal[raw]', or turn it into TIFF",
        )
    import rawpy

    try:
        with rawpy.imread(str(path)) as raw:
            return (*_pixels(raw, rawpy), _taken(raw))
    except (rawpy.LibRawError, OSError, ValueError) as error:
        raise InputError(f"cannot be read as a raw file: {error}", where=str(path), needed="a whole one", todo="copy it again") from error


def _pixels(raw: Any, rawpy: Any) -> tuple[Image, float]:
    pattern = raw.raw_pattern
    letters = "" if pattern is None or pattern.shape != (2, 2) else "".join(chr(raw.color_desc[k]) for k in pattern.ravel())
    black = float(np.mean(raw.black_level_per_channel))
    room = float(raw.white_level) - black
    if letters in BAYER and raw.raw_image_visible.ndim == 2 and room > 0:
        return _demosaiced(raw, letters, room), 1 / room
    shown = raw.postprocess(
        output_color=rawpy.ColorSpace.raw,
        gamma=(1, 1),
        no_auto_bright=True,
        user_wb=[1, 1, 1, 1],
        output_bps=16,
        user_flip=0,
    )
    shares: Image = (np.asarray(shown, np.float32) / np.float32(IN_SIXTEEN)).astype(np.float32)
    return shares, 1 / max(room, 1.0)


def _demosaiced(raw: Any, letters: str, room: float) -> Image:
    import cv2

    mosaic = raw.raw_image_visible.astype(np.int32)
    levels = np.array(raw.black_level_per_channel, np.int32)
    common = int(levels.min())
    mosaic = np.clip(mosaic - (levels - common)[raw.raw_colors_visible], 0, IN_SIXTEEN).astype(np.uint16)
    # OpenCV names a mosaic by its second row's second and third pixels: its BG begins with R
    code = {"RG": cv2.COLOR_BayerBG2RGB, "BG": cv2.COLOR_BayerRG2RGB, "GR": cv2.COLOR_BayerGB2RGB, "GB": cv2.COLOR_BayerGR2RGB}
    colours = cv2.cvtColor(mosaic, code[BAYER[letters]])
    return (colours.astype(np.float32) - np.float32(common)) / np.float32(room)


def _taken(raw: Any) -> TakenAt | None:
    """What LibRaw read of the exposure; older rawpy has none of it."""
    held = getattr(raw, "other", None)
    time = float(getattr(held, "shutter_speed", 0) or 0)
    if not time > 0:
        return None
    iso, f_number = (float(getattr(held, name, 0) or 0) or None for name in ("iso_speed", "aperture"))
    return TakenAt(time, iso, f_number)

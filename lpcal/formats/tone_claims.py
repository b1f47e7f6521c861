"""What an image file says of its tone curve: chunks sRGB, gAMA and iCCP of PNG, ICC profiles of JPEG and TIFF, cameras' marks in a JPEG.

A claim is no proof: programs write such tags to linear numbers too, and leave them out of curved ones. An ICC profile's curve is its tag
rTRC or kTRC: ``curv`` (a power, or a table) or ``para`` (the functions of ICC.1 10.18). Sources: PNG specification 11.3.2, ICC.1:2022,
EXIF 2.32 (makers' names 271 and 272).
"""

from __future__ import annotations

import io
import struct
import warnings
from typing import Any

import numpy as np

from lpcal.geometry.tone_curve import decode
from lpcal.records.quantities import LEAST_GAMMA, MOST_GAMMA
from lpcal.records.sensor import ToneClaim

MAKER, CAMERA = 271, 272
CURVES = (b"rTRC", b"kTRC", b"gTRC")
AT = np.array([0.05, 0.2, 0.5])
"""Stored numbers at which a profile's curve is read: sRGB and a power part in the dark."""
GARBLED = (OSError, ValueError, SyntaxError, TypeError, LookupError, AttributeError, ArithmeticError, struct.error)
"""What comes of tags that cannot be read."""
SAME = 0.001
"""Linear numbers within which a profile's curve is sRGB's."""


def tone_claim(data: bytes) -> ToneClaim | None:
    """What an image file's bytes claim of its curve; None where they claim nothing, or cannot be read."""
    from PIL import Image as Picture

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Picture.open(io.BytesIO(data)) as head:
                return _of_profile(head.info.get("icc_profile")) or (_of_png(head.info) if head.format == "PNG" else _of_jpeg(head))
    except (*GARBLED, Picture.DecompressionBombError):
        return None


def _of_png(info: dict[Any, Any]) -> ToneClaim | None:
    if "srgb" in info:
        return ToneClaim("carry an sRGB chunk", "srgb")
    gamma = info.get("gamma")
    return _of_exponent("a gAMA chunk", 1 / float(gamma)) if gamma else None


def _of_exponent(what: str, exponent: float) -> ToneClaim | None:
    """A claim of a power, where it is one that numbers can have."""
    gamma = round(exponent, 2)
    return ToneClaim(f"carry {what} of gamma {gamma:g}", gamma) if LEAST_GAMMA < gamma < MOST_GAMMA else None


def _of_jpeg(head: Any) -> ToneClaim | None:
    if head.format != "JPEG":
        return None
    tags = head.getexif()
    camera = " ".join(str(tags[tag]).strip("\0 ") for tag in (MAKER, CAMERA) if tag in tags)
    return ToneClaim(f"are a camera's JPEGs ({camera[:40]})", "srgb", photograph=True) if camera else ToneClaim("are JPEGs", None)


def _of_profile(profile: bytes | None) -> ToneClaim | None:
    """The curve of an ICC profile's bytes; None where there is none, or none that can be read."""
    try:
        return _curve_of_profile(profile) if profile else None
    except GARBLED:
        return None


def _curve_of_profile(profile: bytes) -> ToneClaim | None:
    (count,) = struct.unpack_from(">I", profile, 128)
    tags = {profile[at : at + 4]: struct.unpack_from(">II", profile, at + 4) for at in range(132, 132 + 12 * min(count, 100), 12)}
    place = next((tags[tag] for tag in CURVES if tag in tags), None)
    if place is None:
        return None
    linear = _curve(profile[place[0] : place[0] + place[1]])
    if np.abs(linear - decode(AT, "srgb")).max() < SAME:
        return ToneClaim("carry an ICC profile of sRGB's curve", "srgb")
    return _of_exponent("an ICC profile", float(np.log(linear[2]) / np.log(AT[2]))) if 0 < linear[2] < 1 else None


def _curve(tag: bytes) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Linear numbers at AT by the bytes of a tag ``curv`` or ``para``."""
    if tag[:4] == b"curv":
        (count,) = struct.unpack_from(">I", tag, 8)
        table = np.frombuffer(tag, ">u2", count=count, offset=12).astype(float)
        if count == 0:
            return AT
        return np.asarray(AT ** (table[0] / 256) if count == 1 else np.interp(AT, np.linspace(0, 1, count), table / 65535))
    (kind,) = struct.unpack_from(">H", tag, 8)
    g, a, b, c, d, _, f = (*np.frombuffer(tag, ">i4", count=(1, 3, 4, 5, 7)[kind], offset=12) / 65536, *[0.0] * 6)[:7]
    a, d = (1.0, -1.0) if kind == 0 else (a, -b / a if kind in {1, 2} else d)
    low = np.where(kind == 2, c, c * AT + f)
    return np.asarray(np.where(d <= AT, np.maximum(a * AT + b, 0) ** g + (c if kind == 2 else 0), low))

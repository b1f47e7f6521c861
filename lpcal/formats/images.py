"""Image files, read as fractions of their full scale.

What decoders keep to themselves: a file cut off is filled up with grey, a head that asks for all memory, a tag that turns the picture.

The pixels that count are those that the sensor has, which are the stored ones: tags that say how to hold the picture are not followed.

A JPEG ends with its end marker after its last scan, a PNG with its IEND chunk. The tag is EXIF's (and TIFF's) 274, orientation: 1 is
as stored. Source: JPEG ITU-T T.81 annex B, PNG specification, TIFF 6.0 (EXIF keeps a TIFF header in the marker APP1).

What an image file says of its tone curve: chunks sRGB, gAMA and iCCP of PNG, ICC profiles of JPEG and TIFF, cameras' marks in a JPEG.

A claim is no proof: programs write such tags to linear numbers too, and leave them out of curved ones. An ICC profile's curve is its tag
rTRC or kTRC: ``curv`` (a power, or a table) or ``para`` (the functions of ICC.1 10.18). Sources: PNG specification 11.3.2, ICC.1:2022,
EXIF 2.32 (makers' names 271 and 272).
"""

from __future__ import annotations

import io
import struct
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.errors import InputError
from lpcal.formats.exif import GARBLED, TakenAt, taken_at
from lpcal.formats.named_files import PICTURES, RAWS, did_you_mean, exists, kind_of_other, raw_is_read
from lpcal.formats.raw_photograph import read_raw_photograph
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Image
from lpcal.geometry.tone_curve import decode
from lpcal.records.quantities import LEAST_GAMMA, MOST_GAMMA
from lpcal.records.sensor import ToneClaim
from lpcal.view import parallel

RAW_NUMBERS = ToneClaim("are a camera's raw numbers", 1.0)
"""What a raw file says of its tone curve."""


@dataclass(frozen=True)
class StoredImage:
    """Pixels (H, W) or (H, W, 3) RGB as fractions of full scale, and one step of the stored numbers on that scale."""

    pixels: Image
    step: float
    claim: ToneClaim | None = None
    """What the file says of its tone curve."""
    taken: TakenAt | None = None
    """What the file says of its exposure."""

    @property
    def size(self) -> tuple[int, int]:
        """Width, height."""
        return self.pixels.shape[1], self.pixels.shape[0]


def read_image(path: Path) -> StoredImage:
    """Read an image of 8 or 16 bit, or of float (full scale 1); grey or RGB, alpha is dropped; turns by tags are not applied.

    Raises
    ------
    InputError
        Not there, of a kind that is not read, not an image that can be read whole, several in one file, or larger than any camera's.
    """
    return read_numbers(path).image


FLOAT_STEP = 1e-6
"""One step of the numbers of a float image, as a fraction of full scale: finer than any sensor's."""


@dataclass(frozen=True)
class Numbers:
    """An image as its file stores it."""

    stored: npt.NDArray[Any]
    """(H, W) or (H, W, 3)."""
    full_scale: float
    """Largest number of its type; 1 for floats."""
    step: float
    """One step of the numbers as a fraction of full scale."""
    claim: ToneClaim | None = None
    taken: TakenAt | None = None
    alpha: npt.NDArray[Any] | None = None
    """(H, W) how opaque each pixel is, where the file says it."""
    turn: int = 1
    """Orientation that a JPEG's or TIFF's tag states, 1 to 8: how a viewer turns the pixels, which stand here as the file stores them."""

    @property
    def image(self) -> StoredImage:
        """The same as fractions of full scale."""
        return StoredImage(self.fractions(np.empty(self.stored.shape, np.float32)), self.step, self.claim, self.taken)

    def fractions(self, out: Image) -> Image:
        """`out` (H, W) or (H, W, 3), filled with the numbers as fractions of full scale."""
        return np.divide(self.stored, np.float32(self.full_scale), out=out, dtype=np.float32)


@reader("an image", "cv2")
def read_numbers(path: Path) -> Numbers:
    """Read an image as `read_image` does, its numbers as they are stored.

    Raises
    ------
    InputError
        As `read_image`.
    """
    import cv2

    if not exists(path) or not path.is_file():
        raise InputError("no such image", where=str(path), needed="an image file", todo=did_you_mean(path))
    other = kind_of_other([path])
    if other:
        raise InputError(other, where=str(path), needed=f"one of {', '.join(PICTURES)}")
    if raw_is_read() and path.suffix.lower() in RAWS:
        raw, step, taken = read_raw_photograph(path)
        return Numbers(raw, 1.0, step, RAW_NUMBERS, taken)
    data = path.read_bytes()
    refuse_cut(data, path)
    refuse_odd_head(data, path)
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # what its decoders say is said here
    try:
        stored = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED) if data else None
    except cv2.error:
        stored = None
    if stored is None:
        raise InputError("cannot be read as an image", where=str(path), needed=f"one of {', '.join(PICTURES)}, whole", todo="copy it again")
    turn = orientation(data)
    if data[:2] in {b"II", b"MM"}:
        stored = as_stored(stored, turn)
    alpha = stored[..., 3] if stored.ndim == 3 and stored.shape[2] == 4 else None
    if stored.ndim == 3:
        stored = stored[:, :, 2::-1] if stored.shape[2] >= 3 else stored[:, :, 0]
    full_scale = {"uint8": 255.0, "uint16": 65535.0}.get(stored.dtype.name, 1.0)
    if full_scale == 1.0 and stored.dtype.kind != "f":
        raise InputError(f"stores {stored.dtype.name}", where=str(path), needed="8 or 16 bit, or float", todo="convert it to a 16 bit PNG")
    return Numbers(stored, full_scale, 1.0 / full_scale if full_scale > 1 else FLOAT_STEP, tone_claim(data), taken_at(data), alpha, turn)


def stacked(paths: Sequence[Path], read: Callable[[Path], Numbers], shape: tuple[int, ...]) -> Image:
    """Images of a shape (H, W[, 3]), as fractions of full scale and in their order: (N, H, W[, 3]), (0,) of none; cores share them."""
    found = np.empty((len(paths), *shape) if paths else 0, np.float32)

    def fill(k: int) -> None:
        read(paths[k]).fractions(found[k])

    parallel.run_all(fill, range(len(paths)))
    return found


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
        raise InputError("the image is cut off", where=str(path), needed="a whole file", todo="copy it again")


def refuse_odd_head(data: bytes, path: Path) -> None:
    """Refuse an image by what its head says, before it is decoded: one too large to be, several in one, or damaged compression.

    Raises
    ------
    InputError
        One of these; a head that cannot be read is left to the decoder.
    """
    if data.startswith(PNG_HEAD) and len(data) >= PNG_HEAD_BYTES:  # one image, and sound if its checksums are
        width, height = struct.unpack_from(">II", data, len(PNG_HEAD))
        return _refuse_bomb(width, height, len(data), path)
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
            raise InputError("the image is damaged", where=str(path), needed="a whole file", todo="copy it again") from error
    except (ValueError, SyntaxError, TypeError, KeyError, struct.error, OverflowError):
        return None


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


PNG_HEAD, PNG_HEAD_BYTES = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 24
"""How a PNG begins, and the bytes in which its width and height are stated: Pillow, which knows every kind, is not imported for that."""
PNG_CLAIMS = (b"sRGB", b"gAMA", b"iCCP")
"""Chunks before the pixels by which a PNG claims a curve."""
MAKER, CAMERA = 271, 272
CURVES = (b"rTRC", b"kTRC", b"gTRC")
AT = np.array([0.05, 0.2, 0.5])
"""Stored numbers at which a profile's curve is read: sRGB and a power part in the dark."""
SAME = 0.001
"""Linear numbers within which a profile's curve is sRGB's."""


def tone_claim(data: bytes) -> ToneClaim | None:
    """What an image file's bytes claim of its curve; None where they claim nothing, or cannot be read."""
    if data.startswith(PNG_HEAD) and not any(mark in data[: data.find(b"IDAT")] for mark in PNG_CLAIMS):
        return None
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

"""How long a photograph was exposed, by its EXIF tags: in JPEG, TIFF (and the raw files that are TIFF), PNG.

The exposure that counts is ``time ISO / 100 / f-number^2``: what a scene's light becomes as a number, up to a factor that all photographs
of a camera share. Cameras state rounded times (1/60 s for 1/64), so exposures of unlike times are true to some per cent.
Source: EXIF 2.32, tags 33434 ExposureTime, 33437 FNumber, 34855 PhotographicSensitivity.
"""

from __future__ import annotations

import io
import struct
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError

EXIF, TIME, F_NUMBER, ISO = 0x8769, 33434, 33437, 34855
"""Where the tags stand, and what they are."""
GARBLED = (OSError, ValueError, SyntaxError, TypeError, LookupError, AttributeError, ArithmeticError, struct.error)
"""What comes of tags that cannot be read."""
ROUNDED = 0.12
"""Relative difference of two stated exposures that cameras' rounding explains."""
PNG_START, PNG_MARKS = b"\x89PNG", (b"eXIf", b"Raw profile type")
"""How a PNG begins, and what stands in one that holds EXIF tags, as a chunk or as text: they may stand behind the pixels, and Pillow
decodes these to get there."""


@dataclass(frozen=True)
class TakenAt:
    """What a photograph says of its exposure."""

    time_s: float
    iso: float | None = None
    f_number: float | None = None

    def relative_to(self, first: TakenAt) -> float:
        """Exposure (s) of this photograph, with ISO and aperture counted as those of the first."""
        gain = self.iso / first.iso if self.iso and first.iso else 1.0
        stop = (first.f_number / self.f_number) ** 2 if self.f_number and first.f_number else 1.0
        return self.time_s * gain * stop

    def words(self) -> str:
        """As people write it: 1/60 s ISO 200 f/8."""
        time = f"1/{1 / self.time_s:.0f} s" if self.time_s < 0.4 else f"{self.time_s:g} s"
        return time + (f" ISO {self.iso:g}" if self.iso else "") + (f" f/{self.f_number:g}" if self.f_number else "")


def taken_at(data: bytes) -> TakenAt | None:
    """What an image file's bytes say of its exposure; None where they say nothing, or nothing that can be."""
    if data.startswith(PNG_START) and not any(mark in data for mark in PNG_MARKS):
        return None
    from PIL import Image as Picture

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Picture.open(io.BytesIO(data)) as head:
                tags = head.getexif()
                stored = {**tags, **tags.get_ifd(EXIF)}
        time = _positive(stored.get(TIME))
    except (*GARBLED, Picture.DecompressionBombError):
        return None
    return None if time is None else TakenAt(time, _positive(stored.get(ISO)), _positive(stored.get(F_NUMBER)))


def _positive(value: Any) -> float | None:
    """A tag as a number above zero."""
    if isinstance(value, tuple):
        value = value[0] if value else None
    try:
        number = float(value)
    except (TypeError, ValueError, ZeroDivisionError):
        return None
    return number if np.isfinite(number) and number > 0 else None


def exposures(taken: Mapping[Path, TakenAt | None], stated: Mapping[Path, float | None]) -> tuple[dict[Path, float], list[str]]:
    """Exposure of each image, and notes on it.

    What is stated counts; where nothing is, what the files say, if all of them do. Where both are there and contradict each other by more
    than cameras round, that is said.

    Raises
    ------
    InputError
        Exposures of some images are stated, and not of the others.
    """
    known = {path: one for path, one in taken.items() if one is not None}
    by_hand = {path: value for path, value in stated.items() if value is not None}
    unstated = [path for path in taken if path not in by_hand]
    if by_hand and unstated:
        raise InputError(
            f"an exposure of {next(iter(by_hand)).name} is stated, none of {', '.join(path.name for path in unstated[:6])}",
            where=str(unstated[0].parent / "capture.yaml"),
            needed="one of every image, or of none",
            todo="state exposure: for all of them, and exposures: for those that differ",
        )
    if not known:
        return {path: by_hand.get(path, 1.0) for path in taken}, []
    first = next(iter(known.values()))
    by_file = {path: one.relative_to(first) for path, one in known.items()}
    apart = max(by_file.values()) / min(by_file.values()) > 1 + ROUNDED
    said = [f"the aperture changes: {words}" for words in _apertures(known)]
    if by_hand:
        ratio = {path: by_hand[path] / by_file[path] for path in by_hand if path in by_file}
        middle = float(np.median(list(ratio.values()))) if ratio else 1.0
        odd = [path for path, value in ratio.items() if abs(value / middle - 1) > ROUNDED]
        if odd:
            names = ", ".join(f"{path.name} ({known[path].words()})" for path in odd[:3]) + (", ..." if len(odd) > 3 else "")
            said.append(f"capture.yaml's exposures count, but {names} say otherwise in their EXIF tags")
        return {path: by_hand.get(path, 1.0) for path in taken}, said
    lacking = [path.name for path in taken if path not in known]
    if lacking and apart:
        return dict.fromkeys(taken, 1.0), [
            *said,
            f"exposures differ by the EXIF tags, but {lacking[0]} has none: state them in capture.yaml",
        ]
    if lacking or not apart:
        return dict.fromkeys(taken, first.time_s), said
    words = f"{min(known.values(), key=lambda one: one.relative_to(first)).words()} to "
    words += max(known.values(), key=lambda one: one.relative_to(first)).words()
    said.append(f"exposures by the images' EXIF tags, {words}; cameras round them by some per cent")
    return by_file, said


def _apertures(known: Mapping[Path, TakenAt]) -> list[str]:
    found = sorted({one.f_number for one in known.values() if one.f_number is not None})
    return [f"f/{found[0]:g} to f/{found[-1]:g}; its rings of light and its vignetting change with it"] if len(found) > 1 else []


UPRIGHT = "one of them was turned after it was taken: copy all from the camera anew, with a program that turns none"
"""What to do about pictures of which some are turned."""


def turned_notes(turns: Mapping[Path, int]) -> list[str]:
    """A note where the orientation (tag 274, 1 to 8) of a capture's images is not one: the pixels are taken as they are stored."""
    common = max(set(turns.values()), key=list(turns.values()).count, default=1)
    odd = [path for path, turn in turns.items() if turn != common]
    if not odd:
        return []
    names = ", ".join(f"{path.name} {turns[path]}" for path in odd[:4]) + (", ..." if len(odd) > 4 else "")
    return [
        f"the EXIF orientation is not that of the other images, {common}: {names}; pixels are taken as stored, whatever the tag says: was "
        "the camera turned between the images, or some of them by a program?"
    ]

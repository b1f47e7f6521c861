"""Lights by the order of their images: ``lights: IMG_*.jpg`` in capture.yaml, for photographs that a camera numbered."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from lpcal.errors import DisagreementError
from lpcal.formats.import_lights import RESERVED, natural_stem

SHORT = "short_"


def pattern_of(lights: Sequence[str] | None) -> str | None:
    """The pattern that stands for the lights' names; None where they are names."""
    return lights[0] if lights is not None and len(lights) == 1 and any(sign in lights[0] for sign in "*?") else None


def by_order(folder: Path, pattern: str, lights: Sequence[str], files: dict[str, Path]) -> dict[str, Path]:
    """The folder's images with the lights' names for those that the pattern matches, in their natural order.

    Raises
    ------
    DisagreementError
        Another number of images than of lights, or an image of a light's own name beside them.
    """
    matched = [stem for stem, path in files.items() if fnmatchcase(path.name.lower(), pattern.lower())]
    matched = [stem for stem in matched if stem.lower() not in RESERVED and not stem.lower().startswith(("ambient", SHORT))]
    matched.sort(key=natural_stem)
    if len(matched) != len(lights):
        raise DisagreementError(
            f"{len(matched)} images match {pattern}",
            where=str(folder),
            needed=f"{len(lights)}, one a light, in the order of the calibration",
            todo="move the others away, call them ambient_0, ..., or narrow the pattern",
        )
    twice = [light for light in lights if light in files and light not in matched]
    if twice:
        raise DisagreementError(
            f"an image called {twice[0]} beside {pattern}", where=str(folder), needed="lights by name or by order", todo="not both"
        )
    others = {stem: path for stem, path in files.items() if stem not in matched}
    return {light: files[stem] for light, stem in zip(lights, matched, strict=True)} | others

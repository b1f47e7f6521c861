"""A surface's folder, or another method's normals, beside a file of the truth."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

from lpcal.api.evaluation import evaluate
from lpcal.api.surfaces import integrate
from lpcal.formats.capture import read_mask
from lpcal.formats.normal_map import read_depth, read_normals
from lpcal.formats.surface_files import read_surface
from lpcal.records.outcome import Outcome
from lpcal.records.surface import Surface


def evaluate_files(surface: Path, truth: Path, mask: Path | None) -> Outcome:
    """Compare the two, over the pixels of a mask where one is given.

    Normals without a surface are compared as normals alone: their depth is not theirs.

    Raises
    ------
    LpcalError
        One of the files cannot be read, or they disagree.
    """
    found = read_surface(surface) if surface.is_dir() else _of_normals(surface)
    asked = None if mask is None else read_mask(mask, found.mask.shape)
    if truth.is_dir():
        result = evaluate(found, read_surface(truth), mask=asked)
    else:
        normals, good = read_normals(truth)
        depth = read_depth(truth) if surface.is_dir() else None
        normals[~good] = 0.0
        result = evaluate(found, normals, depth=depth, mask=asked)
    figures = {one.name: getattr(result, one.name) for one in fields(result) if one.name != "angle_deg"}
    return Outcome(repr(result).splitlines(), {"surface": str(surface), "truth": str(truth), **figures})


def _of_normals(path: Path) -> Surface:
    """Another method's normals, as they are."""
    values, good = read_normals(path)
    return integrate(values, None, good, green="as-is", name=path.stem)

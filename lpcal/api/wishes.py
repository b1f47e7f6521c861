"""What may be asked of a reconstruction: words, lights and places of the object that there are."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Real
from typing import Any

import numpy.typing as npt

from lpcal import methods
from lpcal.api import compared
from lpcal.errors import DisagreementError, InputError
from lpcal.records.calibration import Calibration
from lpcal.records.observations import RawCapture
from lpcal.segmentation.mask import Hints

WAYS = ("near", "distant")
"""lpcal's own method, by how lights act."""


def refuse_unknown_words(
    mask: npt.ArrayLike | str, method: str, integrator: str, keep: str, distance_m: float | None, arrangement: str = "auto"
) -> None:
    """Refuse words that mean nothing, and a distance that is none."""
    refuse_no_distance(distance_m)
    if isinstance(mask, str) and mask not in {"auto", "none"}:
        raise InputError(repr(mask), where="mask", needed='an array (H, W), "auto" or "none"')
    own = compared.of_name(method, methods.NORMALS, "method", *WAYS) is None
    if compared.of_name(integrator, methods.INTEGRATORS, "integrator", compared.OWN) is not None and own:
        raise InputError(
            repr(integrator),
            where="integrator",
            needed=f"a method of {', '.join(methods.NORMALS)}",
            todo="lpcal's own method finds the depth with the normals: name a method to compare with, or leave the integrator out",
        )
    if keep not in {"object", "support", "all"}:
        raise InputError(repr(keep), where="keep", needed='"object", "support" or "all"')
    if arrangement not in {"auto", "stated"}:
        raise InputError(repr(arrangement), where="arrangement", needed='"auto" or "stated"')


def refuse_no_distance(distance_m: float | None) -> None:
    """Refuse a distance that is no number of metres above 0."""
    if distance_m is not None and not (isinstance(distance_m, Real) and 0 < distance_m < float("inf")):
        raise InputError(
            f"{distance_m} m" if isinstance(distance_m, Real) else repr(distance_m),
            where="distance_m",
            needed="metres before the camera, one number above 0",
        )


def hints_of(box: Sequence[int] | None, points: Sequence[Sequence[int]]) -> Hints:
    """A caller's box and points.

    Raises
    ------
    InputError
        The box is not four whole numbers, or a point not two.
    """
    corners = None if box is None else _whole([box], 4, "box", "x, y, width and height in pixels")[0]
    return Hints(corners, tuple(_whole(points, 2, "points", "pixels (x, y), such as [(120, 80)]")))


def _whole(rows: Sequence[Sequence[int]], count: int, name: str, needed: str) -> list[Any]:
    """Rows of so many whole numbers."""
    try:
        found = [tuple(int(value) for value in row) for row in rows if not isinstance(row, str)]
    except (TypeError, ValueError, OverflowError):
        found = []
    if len(found) != len(rows) or any(len(row) != count for row in found):
        raise InputError(repr(rows[0] if name == "box" else rows)[:80], where=name, needed=needed)
    return found


def refuse_unknown_lights(raw: RawCapture, calibration: Calibration) -> None:
    """Refuse images of lights that the calibration does not hold, or two of one light."""
    known = {light.name for light in calibration.with_lights().lights}
    strange = [name for k, name in enumerate(raw.lights) if name not in known or name in raw.lights[:k]]
    if strange:
        raise DisagreementError(
            f"no light of the calibration is called {', '.join(strange[:8])}, or two images are its",
            where=f"{raw.name}, lights",
            needed=f"some of {', '.join(sorted(known))}, each once",
        )


def refuse_hints(hints: Hints, shape: tuple[int, ...], name: str) -> None:
    """Refuse places of the object that do not lie in the images, or in the box.

    Raises
    ------
    DisagreementError
        A box or a point of the user lies beyond the images (H, W), or a point beside the box.
    """
    height, width = shape
    x, y, across, down = hints.box or (0, 0, width, height)
    if min(x, y) < 0 or min(across, down) < 1 or x + across > width or y + down > height:
        raise DisagreementError(
            f"the box {x},{y},{across},{down} goes beyond the images", where=name, needed=f"a box within {width}x{height}"
        )
    for at in hints.points:
        if not (x <= at[0] < x + across and y <= at[1] < y + down):
            inside = "the box" if hints.box else f"the images of {width}x{height}"
            raise DisagreementError(f"the point {at[0]},{at[1]} lies outside {inside}", where=name, needed=f"a pixel within {inside}")

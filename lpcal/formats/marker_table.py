"""Marker tracks as read from any file, made the `MarkerStream` of one body.

Which markers are a body's: ``Body:Name`` and ``Body_Name`` say it; names that differ in their number only (``Plate1, Plate2``) are one
body's; where no three markers share a name, the file's markers are one body. Unlabeled ones, which come and go, are left out.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.pose_table import METRES, in_order
from lpcal.geometry.arrays import Array
from lpcal.records.observations import MarkerStream

FEWEST = 3
UNLABELED = re.compile(r"(unlabel|unident|uname|unnamed|new \d|\*|c_\d+$|active \d|cent(re|er)[ _]?of[ _]?mass)", re.IGNORECASE)


@dataclass(frozen=True)
class MarkerTable:
    """Rows of a file. NaN where a marker was not seen."""

    t_s: Array
    """(N,)."""
    tracks: dict[str, Array]
    """(N, 3) each, in `units`, by the file's name."""
    units: str = "m"
    notes: tuple[str, ...] = ()


def markers_of(table: MarkerTable, path: Path, body: str | None) -> MarkerStream:
    """The markers of a body, in metres, in order of time, each time once.

    Raises
    ------
    InputError
        Several bodies and none named.
    DisagreementError
        The named body has no marker; those that there are are listed.
    DegenerateError
        Fewer than three markers, or not one sample with three of them.
    """
    name, members = _chosen(list(table.tracks), body, path)
    if len(members) < FEWEST:
        unlabeled = sum(bool(UNLABELED.match(member)) for member in table.tracks)
        found = f"{len(members)} markers of {name or 'one body'}: {', '.join(members) or 'none'}"
        found += f"; {unlabeled} unlabeled are left out" * bool(unlabeled)
        raise DegenerateError(found, where=str(path), needed=f"{FEWEST}, not on a line", todo="label the body's markers and export again")
    x_O = METRES[table.units] * np.stack([table.tracks[member] for member in members], axis=1)
    keep, notes = in_order(table.t_s, np.isfinite(table.t_s))
    t_s, x_O = table.t_s[keep], x_O[keep]
    if not np.any(np.isfinite(x_O).all(axis=2).sum(axis=1) >= FEWEST):
        raise DegenerateError(f"no sample with {FEWEST} markers of {name or 'one body'}", where=str(path), needed="markers in sight")
    rate = 1 / float(np.median(np.diff(t_s))) if len(t_s) > 1 else float("nan")
    short = tuple(re.sub(rf"^{re.escape(name)}[:_. -]?(?=.)", "", member) if name else member for member in members)
    dropped = sum(bool(UNLABELED.match(member)) for member in table.tracks)
    notes += [f"{dropped} unlabeled markers left out"] * bool(dropped)
    return MarkerStream(name, t_s, short, x_O, rate, (*table.notes, *notes))


def _chosen(names: list[str], body: str | None, path: Path) -> tuple[str, list[str]]:
    """The body's name and its markers."""
    labelled = [name for name in names if not UNLABELED.match(name)]
    if body is not None:
        for same in (str, str.lower):
            own = [name for name in labelled if _belongs(same(name), same(body))]
            if own:
                return own[0][: len(body)], own
    groups: dict[str, list[str]] = {}
    for name in labelled:
        groups.setdefault(_group(name), []).append(name)
    bodies = {key: members for key, members in groups.items() if len(members) >= FEWEST}
    listed = ", ".join(bodies) or ", ".join(labelled) or "none"
    if body is not None:
        raise DisagreementError(
            f"no marker of {body}", where=str(path), needed=f"one of those it holds: {listed}", todo="correct mocap.body in panel.yaml"
        )
    if len(bodies) > 1:
        raise InputError(f"{len(bodies)} bodies: {listed}", where=str(path), needed="one", todo="name it in panel.yaml: mocap.body")
    return next(iter(bodies.items())) if bodies else ("", labelled)


def _belongs(name: str, body: str) -> bool:
    return name.startswith(body) and (len(name) == len(body) or not name[len(body)].isalpha() or ":" in body)


def _group(name: str) -> str:
    """``Body`` of ``Body:Name``, ``Body_Marker`` of ``Body_Marker3``."""
    return name.partition(":")[0] if ":" in name else re.sub(r"[ _.-]*\d+$", "", name)

"""How a light emits by angle, from a maker's photometric file: IES (LM-63, .ies) and EULUMDAT (.ldt).

Both hold luminous intensities over the angle from the axis (gamma, "vertical") in half planes about it (C, "horizontal"). A lobe is round:
it is their mean over C, 1 on the axis. Sources: ANSI/IESNA LM-63-2002; Stockmar, EULUMDAT (1990).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.light_tables import numbers, text_of, whole_number
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.reading import reader
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Lobe

PHOTOMETRY_C = 1
"""LM-63's number for angles counted from the axis; its types A and B are for searchlights and floodlights."""
LDT_SETS, LDT_RATIOS = 25, 10
"""Line (from 0) of an .ldt file with the count of lamp sets, six lines each; direct ratios after them."""
TURN_DEG = 360.0
LARGEST_COUNT = 1e6
"""Angles beyond which a count is damage: a file of a hundredth of a degree would hold 36,000."""


@reader("a photometric file")
def read_lobe(path: Path) -> Lobe:
    """The mean lobe of a photometric file, by its ending.

    Raises
    ------
    InputError
        Not there, cut off, another format or photometry, or dark on the axis.
    """
    forms = {".ies": _ies, ".ldt": _ldt}
    form = forms.get(path.suffix.lower())
    if form is None:
        raise InputError(f"a lobe in {path.suffix or 'no'} format", where=str(path), needed="an .ies or .ldt file", todo="export it as one")
    if not path.is_file():
        raise InputError(
            "cannot be read: no such file",
            where=str(path),
            needed="a photometric file",
            todo=did_you_mean(path, "is the name in panel.yaml right?"),
        )
    text = text_of(path)
    gamma_deg, plane_deg, intensity = form(text, str(path))
    if np.any(intensity < 0) or np.any(np.diff(plane_deg) <= 0):
        what = "a negative intensity" if np.any(intensity < 0) else "half planes whose angles do not grow"
        raise InputError(what, where=str(path), needed="intensities of 0 or more, angles that grow", todo="export it again")
    mean = _mean_over_planes(plane_deg, intensity)
    front = gamma_deg <= 180
    if gamma_deg.size < 2 or gamma_deg[0] != 0 or np.any(np.diff(gamma_deg) <= 0) or mean[0] <= 0 or np.any(mean < 0):
        raise InputError(
            "its intensities are no lobe about an axis",
            where=str(path),
            needed="angles that grow from 0, intensities of 0 or more, light on the axis",
            todo="is it the file of this light?",
        )
    return Lobe("table", angle_rad=np.radians(gamma_deg[front]), value=mean[front] / mean[0])


def _mean_over_planes(plane_deg: Array, intensity: Array) -> Array:
    """Mean (G,) over half planes (C, G); planes that bound a symmetric sector count half."""
    if len(plane_deg) == 1:
        return intensity[0]
    closed = plane_deg[-1] - plane_deg[0]
    step = np.diff(plane_deg)
    if closed + step[-1] >= TURN_DEG - 1e-6 and closed < TURN_DEG - 1e-6:  # a whole turn whose last plane is not the first again
        gap = np.append(step, TURN_DEG - closed)
        weight = (gap + np.roll(gap, 1)) / 2
    else:
        weight = np.concatenate([step[:1], step[:-1] + step[1:], step[-1:]]) / 2
    return np.asarray(np.average(intensity, axis=0, weights=weight))


def _ies(text: str, where: str) -> tuple[Array, Array, Array]:
    """Angles from the axis (G,), planes (C,), intensities (C, G) of an LM-63 file."""
    lines = text.splitlines()
    tilt = next((k for k, line in enumerate(lines) if line.strip().upper().startswith("TILT=")), None)
    if tilt is None:
        raise InputError("no line TILT=", where=where, needed="an LM-63 file", todo="is it whole?")
    values = numbers(" ".join(lines[tilt + 1 :]).replace(",", " ").split(), where)
    if lines[tilt].split("=", 1)[1].strip().upper() == "INCLUDE":  # lamp's place, count of pairs, angles, factors
        pairs = _count(values, 1, where)
        _whole(values.size, 2 + 2 * pairs, where)
        values = values[2 + 2 * pairs :]
    elif lines[tilt].split("=", 1)[1].strip().upper() != "NONE":
        raise InputError(
            f"{lines[tilt].strip()[:60]}: its tilt stands in another file", where=f"{where}:{tilt + 1}", needed="TILT=NONE or TILT=INCLUDE"
        )
    vertical, horizontal = _count(values, 3, where), _count(values, 4, where)
    _whole(values.size, 13 + vertical + horizontal + vertical * horizontal, where)
    if values[5] != PHOTOMETRY_C:
        raise InputError(f"photometry of type {values[5]:g}", where=where, needed="type 1 (C): angles from the axis", todo="convert it")
    table = values[13:]
    gamma_deg, plane_deg = table[:vertical], table[vertical : vertical + horizontal]
    intensity = table[vertical + horizontal :][: vertical * horizontal].reshape(horizontal, vertical)
    return gamma_deg, plane_deg, intensity


def _ldt(text: str, where: str) -> tuple[Array, Array, Array]:
    """The same of an EULUMDAT file, one value a line."""
    lines = [line.strip().replace(",", ".") for line in text.splitlines()]
    _whole(len(lines), LDT_SETS + 1, where)
    symmetry = int(numbers(lines[2:3], f"{where}:3")[0])
    planes, angles, sets = (
        whole_number(float(numbers(lines[k : k + 1], f"{where}:{k + 1}")[0]), f"{where}:{k + 1}", what)
        for k, what in ((3, "the number of C planes"), (5, "the number of angles in a plane"), (LDT_SETS, "the number of lamp sets"))
    )
    start = LDT_SETS + 1 + 6 * sets + LDT_RATIOS
    given = {0: (0, planes), 1: (0, 1), 2: (0, planes // 2 + 1), 3: (planes // 4, 3 * planes // 4 + 1), 4: (0, planes // 4 + 1)}
    if symmetry not in given:
        raise InputError(f"symmetry {symmetry}", where=f"{where}:3", needed="0 to 4", todo="is it an EULUMDAT file?")
    first, last = given[symmetry]
    wanted = planes + angles + (last - first) * angles
    _whole(len(lines) - start, wanted, where)
    values = numbers(lines[start : start + wanted], where)
    intensity = values[planes + angles :].reshape(last - first, angles)
    # symmetry 3 runs from C270 through C0 to C90, which no slice of the planes does; they are as far apart as elsewhere
    plane_deg = np.arange(last - first) * TURN_DEG / planes if symmetry == 3 else values[first:last]
    return values[planes : planes + angles], plane_deg, intensity


def _count(values: Array, place: int, where: str) -> int:
    if values.size <= place or values[place] < 1 or values[place] > LARGEST_COUNT or values[place] % 1:
        raise InputError("its head is cut off or garbled", where=where, needed="counts of angles", todo="export it again")
    return int(values[place])


def _whole(there: int, wanted: int, where: str) -> None:
    if there < wanted:
        raise InputError(
            f"cut off: {there} values where {wanted} are announced", where=where, needed="a whole file", todo="export it again"
        )

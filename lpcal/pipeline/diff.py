"""``lpcal diff``: two calibrations read, compared, said in a table, and drawn over each other."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import numpy as np

from lpcal.api.comparison import compare_calibrations
from lpcal.errors import LpcalError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.outputs import marked, refuse_place, write_text
from lpcal.geometry.arrays import Array
from lpcal.records.comparison import CalibrationChange, LightChange, PartChange
from lpcal.records.outcome import Outcome
from lpcal.report.diff_page import MARK, render

CALIBRATION = "calibration.yaml"
PAGE = marked("a page of two rigs", MARK)


def diff(one: Path, other: Path, page: Path) -> Outcome:
    """Compare two calibrations and write the page.

    Raises
    ------
    InputError, DisagreementError, DegenerateError
        One cannot be read, or they have too little in common.
    """
    files = [_file(path) for path in (one, other)]
    refuse_place(page, PAGE, files)
    before, after = (read_calibration(path) for path in files)
    change = compare_calibrations(before, after, H_PC_covariances=(_covariance(files[0], before.H_PC), _covariance(files[1], after.H_PC)))
    lines = lines_of(change)
    write_text(page, render((str(one), str(other)), (before, after), change, lines), PAGE)
    document = {"before": str(files[0]), "after": str(files[1]), "changed": list(change.changed), **asdict(change)}
    return Outcome([*lines, verdict(change), f"written {page}"], document, list(change.notes))


def _file(path: Path) -> Path:
    """The calibration that a path names: itself, or that of a rig's folder."""
    inside = [path / CALIBRATION, path / "calib" / CALIBRATION]
    return next((each for each in inside if each.is_file()), path)


def _covariance(path: Path, H_PC: Array | None) -> Array | None:
    """That of the hand-eye, of the file beside the calibration, where it holds the same hand-eye."""
    try:
        found = read_handeye(path.with_name("handeye.yaml"))
    except LpcalError:
        return None
    same = H_PC is not None and found.carries == "camera" and np.allclose(found.H_PC, H_PC, atol=1e-9)
    return found.H_PC_covariance if same else None


def verdict(change: CalibrationChange) -> str:
    """The one sentence."""
    return f"changed beyond chance: {'; '.join(change.changed)}" if change.changed else "nothing has changed beyond chance"


def lines_of(change: CalibrationChange) -> list[str]:
    """The table, for people: each figure beside what an unmoved rig shows."""
    lines = [f"{'light':<12} {'moved, mm':>18} {'axis turned, deg':>20} {'power, %':>18}"]
    lines += [_light_line(light) for light in change.lights]
    lines.append(_part_line("all lights", change.together) + f", distances {100 * change.scale:+.2f} %")
    if np.isfinite(change.handeye.moved):
        lines.append(_part_line("hand-eye", change.handeye))
    if np.isfinite(change.camera.moved):
        turned = float(np.degrees(change.camera.turned_rad))
        lines.append(
            f"{'camera':<12} {change.camera.moved:.3f} px rms over the image, after a turn of {turned:.3f} deg" + _odds(change.camera)
        )
    return lines


def _light_line(light: LightChange) -> str:
    across = 1e3 * light.moved, 1e3 * light.moved_std
    turned = float(np.degrees(light.turned_rad)), float(np.degrees(light.turned_std_rad))
    cells = [f"{value:.2f} ({std:.2f})" if np.isfinite(value) else "-" for value, std in (across, turned)]
    power = f"{100 * light.power:+.2f} ({100 * light.power_std:.2f})"
    return f"{light.name:<12} {cells[0]:>18} {cells[1]:>20} {power:>18}" + (f"   <- {', '.join(light.says)}" if light.says else "")


def _part_line(name: str, part: PartChange) -> str:
    turned, turned_std = float(np.degrees(part.turned_rad)), float(np.degrees(part.turned_std_rad))
    stds = (f" ({1e3 * part.moved_std:.2f})", f" ({turned_std:.3f})") if np.isfinite(part.moved_std) else ("", "")
    return f"{name:<12} {1e3 * part.moved:.2f}{stds[0]} mm, {turned:.3f}{stds[1]} deg" + _odds(part)


def _odds(part: PartChange) -> str:
    return f"; chance of as much in an unmoved rig {part.chance:.2g}" if np.isfinite(part.chance) else ""

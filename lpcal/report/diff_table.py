"""The table of `lpcal diff`'s page: how each light stands against the others, and how small a change of it would have shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.records.comparison import SEEN_SIGMAS, CalibrationChange, LightChange
from lpcal.report.wording import fixed


@dataclass(frozen=True)
class ChangeRow:
    """A light: what it is called, its figures, and what has changed beyond chance."""

    name: str
    found: Sequence[str]
    least: Sequence[str]
    says: str


@dataclass(frozen=True)
class ChangeTable:
    """Heads of the columns, what was found and what would have shown, and a row a light."""

    found: Sequence[str]
    least: Sequence[str]
    sigmas: int
    rows: Sequence[ChangeRow]


def change_table(change: CalibrationChange) -> ChangeTable:
    """The table of a comparison; a dash stands where it does not see that kind of change."""
    own_frames = any(np.isfinite(light.moved_L_std).all() for light in change.lights)
    moved = "direction, °" if change.distant else "moved, mm"
    first = ("along its arm, mm", "sideways, mm (azimuth, °)", "along its emission, mm (joint, °)") if own_frames else (moved,)
    rows = [ChangeRow(light.name, _found(light, change.distant), _least(light, change.distant, own_frames), ", ".join(light.says))
            for light in change.lights]  # fmt: skip
    return ChangeTable((moved, "axis turned, °", "power, %"), (*first, "axis turned, °", "power, %"), round(SEEN_SIGMAS), rows)


def _length(moved: float, distant: bool) -> float:
    """A move in mm; of a distant light's direction, in degrees."""
    return float(np.degrees(moved)) if distant else 1e3 * moved


def _found(light: LightChange, distant: bool) -> list[str]:
    pairs = (
        (_length(light.moved, distant), _length(light.moved_std, distant)),
        (float(np.degrees(light.turned_rad)), float(np.degrees(light.turned_std_rad))),
        (100 * light.power, 100 * light.power_std),
    )
    return [f"{fixed(value, 2)} ({fixed(std, 2)})" if np.isfinite(value) else fixed(value, 2) for value, std in pairs]


def _least(light: LightChange, distant: bool, own_frames: bool) -> list[str]:
    least = light.least
    ends = [fixed(float(np.degrees(least.turned_rad)), 2), fixed(100 * least.power, 2)]
    if not own_frames:
        return [fixed(_length(least.moved, distant), 2), *ends]
    turns = (float("nan"), least.azimuth_rad, least.joint_rad)
    by = [
        fixed(1e3 * float(moved), 2) + (f" ({fixed(float(np.degrees(turn)), 2)})" if np.isfinite(turn) else "")
        for moved, turn in zip(least.moved_L, turns, strict=True)
    ]
    return [*by, *ends]

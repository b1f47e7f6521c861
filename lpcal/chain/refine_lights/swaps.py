"""Lights whose images bear each other's names: each highlight is nearest to where another wing would put it.

For every light as drawn the highlight in every chrome sphere is predicted; the assignment of names to wings with the least sum of squared
distances is found (Kuhn 1955, by scipy). Another than the stated one is believed when it explains the highlights many times better.

Wings whose joint stands one click from where the drawing has it.

A click of 10 degrees turns the direction to the light little but moves the blob by millimetres and its axis by 10 degrees; the prior would
bend that light halfway and pull the others. So joints are tried one click up and one down under the chrome highlights alone, and the
click that gains most is believed when it gains enough; then they are tried again::

    gain = 2 (cost as drawn - cost with the click)

Which ones are worth a try, the fit as drawn says to second order: joint angle g (fitted, variance S), drawn as g0 within sigma, click d::

    gain ~ 2 d (g - g0) / sigma^2 - d^2 / sigma^2 (1 - S / sigma^2)

How well the data distinguish a click from none is K = d^2 / sigma^2 (1 - S / sigma^2): without one the gain is about -K +- 2 sqrt(K), with
one K +- 2 sqrt(K). What is enough is so improbable without a click that of all joints tried none gains it: -K + 2 sqrt(K) z. Small spheres
leave K at 4 to 10 where 20 to 60 is usual.

Simulated over wings within tolerance: without a click the best of twelve tries never gained under two chrome spheres or more (-26 to -0.2),
under one it gained up to 8; a true click gains 4.5 to 70. Source: Laplace's approximation of the evidence.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from lpcal.chain.refine_lights.geometry_fit import SOURCE_OFFSET_M, GeometryFit, fit_geometry
from lpcal.chain.refine_lights.measure import CentreMeasurement
from lpcal.errors import ConvergenceError, DegenerateError, DisagreementError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Wings
from lpcal.records.observations import SphereView

BETTER = 9.0


def refuse_swapped(
    lights: Sequence[str], views: Sequence[SphereView], measured: Sequence[CentreMeasurement], camera: Camera, wings: Wings
) -> None:
    """Refuse images under each other's names.

    Raises
    ------
    DisagreementError
        Two lights or more are swapped; they are named.
    """
    names = [wing.name for wing in wings.wings if wing.name in lights]
    rows = [k for k, wing in enumerate(wings.wings) if wing.name in lights]
    cost = np.zeros((len(names), len(names)))
    seen = np.zeros(len(names))
    source_C = wings.H_CL[rows, :3, 3] + SOURCE_OFFSET_M * wings.H_CL[rows, :3, 2]
    for view, centre in zip(views, measured, strict=True):
        predicted = camera.project(sphere.mirror_point(centre.centre_C, view.radius_m, source_C))
        for k, name in enumerate(names):
            if name in view.highlights_px:
                cost[k] += np.sum((predicted - view.highlights_px[name]) ** 2, axis=1)
                seen[k] += 1
    if not seen.all() or np.array_equal(np.argmin(cost, axis=1), np.arange(len(names))):  # each nearest to its own: nothing is swapped
        return
    from scipy.optimize import linear_sum_assignment

    image, wing = linear_sum_assignment(cost)
    stated, best = float(np.trace(cost)), float(cost[image, wing].sum())
    if stated < BETTER * best or np.array_equal(image, wing):
        return
    moved = [f"{names[k]} where {names[j]} should be" for k, j in zip(image, wing, strict=True) if k != j]
    raise DisagreementError(
        f"the highlights stand as if images or cables were swapped: {', '.join(moved)}",
        where="spheres",
        needed="each image lit by the light whose name it bears",
        todo="exchange the cables, the image names, or the lights' settings in panel.yaml",
    )


CLICK_RAD = float(np.radians(10.0))
ENOUGH, ENOUGH_UNDER_ONE = 4.0, 12.0
"""With two chrome spheres or more that show a click well, and with one or less well: z squared, an error of three in 10000."""
TRIES = 4
"""The most promising of all joints and both ways."""
WORTH_A_TRY = -30.0
"""Promise under shading: simulated, it is under -50 without a click and over -10 with one."""


class _WithSettings(Protocol):
    """A fit of the wings' settings."""

    @property
    def settings(self) -> Array: ...

    @property
    def settings_std(self) -> Array: ...

    @property
    def cost(self) -> float: ...


@dataclass(frozen=True)
class Click:
    """A wing whose joint is not where it was said to be."""

    name: str
    drawn_rad: float
    found_rad: float
    gain: float
    sure: bool = True
    """If not, the wing is left as drawn."""

    def message(self) -> str:
        """In words."""
        found_deg, drawn_deg = np.degrees([self.found_rad, self.drawn_rad])
        if not self.sure:
            angles = f"{found_deg:.0f} deg, not {drawn_deg:.0f} deg"
            return f"{self.name}: its joint may be at {angles}, which these spheres hardly show: look at it"
        return f"{self.name}: joint at {found_deg:.0f} deg, not {drawn_deg:.0f} deg; correct joint_angle in panel.yaml"


def fit_with_clicks(
    lights: Sequence[str], views: Sequence[SphereView], measured: Sequence[CentreMeasurement], camera: Camera, wings: Wings
) -> tuple[GeometryFit, Wings, list[Click]]:
    """The geometry, the wings as they stand, and the clicks found; the last may be unsure."""
    fit = fit_geometry(lights, views, measured, camera, wings)
    clicks: list[Click] = []
    shown = {light for view in views for light in view.highlights_px}
    alone = sum(bool(view.highlights_px) for view in views) < 2
    rows = [row for row, wing in enumerate(wings.wings) if wing.name in shown]
    while rows:
        promising = _promising(fit, wings, rows)[:TRIES]
        trials = [(row, step, *_tried(lights, views, measured, camera, _clicked(wings, row, step))) for _, row, step in promising]
        row, step, trial, cost = min(trials, key=lambda trial: trial[3])
        gain = 2 * (fit.cost - cost)
        sure = gain >= (ENOUGH_UNDER_ONE if alone else _enough(fit, wings, row))
        if trial is None or not (sure or (gain >= ENOUGH and not alone)):
            break
        clicks.append(_click(wings, row, step, gain, sure=sure))
        if not sure:
            break
        fit, wings = trial, _clicked(wings, row, step)
        rows.remove(row)
    return fit, wings, clicks


def clicks_under_shading[Found: _WithSettings](
    solved: Found, wings: Wings, solve: Callable[[Wings], Found], rows: Sequence[int]
) -> tuple[Found, Wings, list[Click]]:
    """The same where highlights alone are too few, but shading was solved with them: a blob that emits 10 degrees off stands out.

    Parameters
    ----------
    solved : the fit of highlights and shading under the wings as they stand
    solve : the same under other wings
    rows : of the wings that were seen
    """
    clicks: list[Click] = []
    rows = list(rows)
    while rows:
        _, row, step = _promising(solved, wings, rows)[0]
        if _promise(solved, wings, row, step) < WORTH_A_TRY:
            break
        trial = solve(_clicked(wings, row, step))
        gain = 2 * (solved.cost - trial.cost)
        if gain < ENOUGH_UNDER_ONE:
            break
        clicks.append(_click(wings, row, step, gain))
        solved, wings = trial, _clicked(wings, row, step)
        rows.remove(row)
    return solved, wings, clicks


def _click(wings: Wings, row: int, step: int, gain: float, *, sure: bool = True) -> Click:
    drawn_rad = wings.wings[row].joint_angle_rad
    return Click(wings.wings[row].name, drawn_rad, drawn_rad + step * CLICK_RAD, gain, sure)


def _promising(fit: _WithSettings, wings: Wings, rows: Sequence[int]) -> list[tuple[float, int, int]]:
    """Promise, row and step of every click that may be, the best first."""
    return sorted(((_promise(fit, wings, row, step), row, step) for row in rows for step in (-1, 1)), reverse=True)


def _promise(fit: _WithSettings, wings: Wings, row: int, step: int) -> float:
    """The gain of a click to second order."""
    moved = fit.settings[row, 1] - wings.wings[row].joint_angle_rad
    return float(2 * step * CLICK_RAD * moved / wings.setting_sigma[1] ** 2) - _evidence(fit, wings, row)


def _evidence(fit: _WithSettings, wings: Wings, row: int) -> float:
    """How well the data distinguish a click of a joint from none: K."""
    sigma = wings.setting_sigma[1]
    return float((CLICK_RAD / sigma) ** 2 * (1 - fit.settings_std[row, 1] ** 2 / sigma**2))


def _enough(fit: _WithSettings, wings: Wings, row: int) -> float:
    """The gain at which a click is believed."""
    known = max(_evidence(fit, wings, row), ENOUGH_UNDER_ONE)
    return max(ENOUGH, 2 * float(np.sqrt(known * ENOUGH_UNDER_ONE)) - known)


def _clicked(wings: Wings, row: int, clicks: int) -> Wings:
    changed = replace(wings.wings[row], joint_angle_rad=wings.wings[row].joint_angle_rad + clicks * CLICK_RAD)
    return replace(wings, wings=(*wings.wings[:row], changed, *wings.wings[row + 1 :]))


def _tried(
    lights: Sequence[str], views: Sequence[SphereView], measured: Sequence[CentreMeasurement], camera: Camera, wings: Wings
) -> tuple[GeometryFit | None, float]:
    try:
        fit = fit_geometry(lights, views, measured, camera, wings)
    except (ConvergenceError, DegenerateError):
        return None, float("inf")
    return fit, fit.cost

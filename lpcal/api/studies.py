"""The two experiments of the LightPanel paper, by lpcal's own radiometry and normals.

The error of a normal is relative: the length of ``n_found - n`` for unit normals, per cent. Every pixel of the sphere but for its rim
counts; those that fewer than three lights reach are filled from their neighbours, as a reconstruction does.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np

from lpcal.api.engines import WINDOW, Engine, Lost, each
from lpcal.api.staged import staged
from lpcal.detect.radiometry import to_radiance
from lpcal.errors import DegenerateError, InputError, LpcalError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.integration import pieces
from lpcal.integration.integrate import Grid
from lpcal.records import screens
from lpcal.records.outcome import Progress, silent
from lpcal.records.sensor import Sensor
from lpcal.records.shown import Shown
from lpcal.shading import normals
from lpcal.simulate.captures import Conditions, capture, ring
from lpcal.view import pixel_list

PAPER = Conditions()
PLAIN: Final = "plain least squares"
"""Normals on all samples, shadows taken for shading, as in the paper."""
OWN: Final = "lpcal"
"""Normals as lpcal finds them."""


@dataclass(frozen=True)
class Variant:
    """A way of finding normals under conditions; `but` says in what they differ from the paper's."""

    way: Literal["plain least squares", "lpcal"]
    but: str
    conditions: Conditions

    @property
    def name(self) -> str:
        """The way, and what is different."""
        return f"{self.way}, {self.but}" if self.but else self.way


NOISY, RIM = "noise 1 %", "to the very rim"
VARIANTS = (
    Variant(PLAIN, "", PAPER),
    Variant(PLAIN, NOISY, replace(PAPER, noise=0.01)),
    Variant(PLAIN, RIM, replace(PAPER, rim=0.995)),
    Variant(OWN, "", PAPER),
    Variant(OWN, NOISY, replace(PAPER, noise=0.01)),
    Variant(OWN, RIM, replace(PAPER, rim=0.995)),
    Variant(OWN, "noise 3 %", replace(PAPER, noise=0.03)),
    Variant(OWN, "12 bit", replace(PAPER, bits=12)),
    Variant(OWN, "4 lights", replace(PAPER, lights=4)),
    Variant(OWN, "12 lights", replace(PAPER, lights=12)),
)
"""Six lights, 8 bit and no noise where nothing else is said."""
ANGLES = np.array([3, 5, 8, 11, 14, 16, 18, 20, 22, 24, 26, 28, 30, 32, 34, 36, 38, 40, 43, 48, 54, 60, 67, 74, 81, 88], float)
AMBIENT_PEAK = 0.8
"""Where the brightest sample lies without ambient light: room for a fifth of full scale."""
AMBIENT = replace(PAPER, peak=AMBIENT_PEAK, phase_deg=26.0)
TOE = 0.05
"""Share of full scale under which a sensor that shows nothing of faint light shows nothing."""
NO_TOE = f"nothing shown under {100 * TOE:.0f} %"
AMBIENTS = (
    Variant(PLAIN, "", AMBIENT),
    Variant(PLAIN, NO_TOE, replace(AMBIENT, toe=TOE)),
    Variant(PLAIN, NOISY, replace(AMBIENT, noise=0.01)),
    Variant(OWN, "", AMBIENT),
    Variant(OWN, NO_TOE, replace(AMBIENT, toe=TOE)),
    Variant(OWN, NOISY, replace(AMBIENT, noise=0.01)),
)
LEVELS = np.linspace(0, 1, 21)
FLAT = 1.1
"""Angles or levels whose error is within this factor of the least are as good."""


@dataclass(frozen=True)
class Trial:
    """Errors of one trial, per cent; NaN where nothing could be found."""

    mean: float
    median: float


def trial(conditions: Conditions, seed: int = 0, *, plain: bool = False) -> Trial:
    """One capture, its normals, their errors; `plain`: by least squares on all samples, as papers do."""
    try:
        raw, truth, mask = capture(conditions, seed)
        radiance = to_radiance(raw, Sensor())
    except DegenerateError:
        return Trial(float("nan"), float("nan"))
    lights = ring(conditions)
    seen = pixel_list.list_pixels(pixel_list.grey(radiance, lights), pixel_list.ray_map(mask.shape, None), mask, central=False)
    d, E = pixel_list.light_vectors(lights, seen.rays_C, np.array([0.0, 0.0, 1.0]))
    B = d * E[..., None]
    b = (
        lambert.weighted(B, seen.signal, np.ones(seen.signal.shape))[0]
        if plain
        else normals.estimate(seen, B, normals.candidates(seen, E), normals.variances(seen)).b
    )
    known = np.isfinite(b[:, 0])
    if not known.any():
        return Trial(float("nan"), float("nan"))
    n = lambert.unit(pieces.fill(Grid.of(mask), lambert.unit(b)[0], known))[0]
    error = 100 * np.linalg.norm(n - truth[mask], axis=1)
    return Trial(float(error.mean()), float(np.median(error)))


type Which = Literal["phase-angle", "ambient"]
ACROSS: dict[Which, str] = {"phase-angle": "phase angle, degrees", "ambient": "ambient light on the sphere, of 255"}
"""What is varied, by study: the plot's axis and the first column of the table."""


@dataclass(frozen=True)
class StudyCurve:
    """The errors of one variant over what was varied."""

    name: str
    but: str
    """In what it differs from the paper's conditions; empty: in nothing."""
    x: Array
    """(N,) degrees, or per cent of ambient light."""
    mean_percent: Array
    """(N,) mean relative error of the normals; NaN where nothing could be found."""
    median_percent: Array

    @property
    def best(self) -> float:
        """Where the mean error is least."""
        return float(self.x[np.nanargmin(self.mean_percent)])

    @property
    def best_by_median(self) -> float:
        """Where the median error is least."""
        return float(self.x[np.nanargmin(self.median_percent)])

    @property
    def as_good(self) -> tuple[float, float]:
        """The first and last places whose error is within FLAT of the least."""
        good = self.x[self.mean_percent <= FLAT * np.nanmin(self.mean_percent)]
        return float(good[0]), float(good[-1])

    @property
    def least_percent(self) -> float:
        """The least mean error."""
        return float(np.nanmin(self.mean_percent))


@dataclass(frozen=True, repr=False)
class Study(Shown):
    """What was varied, a curve a variant, and what they say."""

    which: Which
    across: str
    curves: tuple[StudyCurve, ...]
    says: str


@dataclass(frozen=True)
class _Try:
    """One trial, as it goes to a worker."""

    conditions: Conditions
    plain: bool


def _tried(one: _Try) -> Trial | LpcalError:
    """Its errors; what goes wrong is the result, for a worker raises nothing."""
    try:
        return trial(one.conditions, plain=one.plain)
    except LpcalError as error:
        return error


def _trials(tries: Sequence[_Try], engine: Engine | None, progress: Progress) -> list[Trial]:
    """All of them, here or where the engine says.

    Raises
    ------
    LpcalError
        That of a trial that failed, or InputError where the workers of one were lost.
    """
    found: dict[int, Trial] = {}
    for number, one in enumerate(map(_tried, tries)) if engine is None else each(_tried, tries, engine):
        if isinstance(one, Lost):
            raise InputError(one.why, where="study", needed="workers that live", todo="try it here: without --on")
        if isinstance(one, LpcalError):
            raise one
        found[number] = one
        progress("trials", len(found), len(tries))
    return [found[number] for number in range(len(tries))]


@staged("study")
def study(
    which: Which,
    *,
    at: Sequence[float] | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Study:
    """Repeat an experiment of the LightPanel paper on a simulated sphere: which angle of the lights, or how much ambient light, is best.

    Parameters
    ----------
    which : str
        "phase-angle" varies the angle between the lights and the axis; "ambient" the ambient light.
    at : sequence of float, optional
        Where to try: degrees from the axis, or per cent of ambient light; by default as finely as the paper's figures.
    executor : concurrent.futures.Executor, optional
        Where the trials are worked on, as of `reconstruct_many`; by default one after the other, here. The figures are the same.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    Study
        A curve a variant: the mean and median relative error of the normals, per cent, over degrees or per cent of ambient light; and a
        sentence.

    Raises
    ------
    InputError
        Another study is asked for, or the workers of a trial were lost.

    Examples
    --------
    >>> import lpcal
    >>> found = lpcal.study("phase-angle", at=[10, 26])
    >>> found.curves[0].name, found.curves[0].best
    ('plain least squares', 26.0)
    """
    return study_on(
        None if executor is None else Engine("the caller's executor", lambda: nullcontext(executor), WINDOW), which, at, progress
    )


def study_on(engine: Engine | None, which: Which, at: Sequence[float] | None = None, progress: Progress = silent) -> Study:
    """As `study`, on an engine; None: here, one trial after the other.

    Raises
    ------
    InputError
        As `study`.
    """
    if which not in ACROSS:
        raise InputError(f"{which!r}", where="which", needed=" or ".join(ACROSS))
    swept = which == "phase-angle"
    variants, usual = (VARIANTS, ANGLES) if swept else (AMBIENTS, 100 * LEVELS)
    places = usual if at is None else np.asarray(at, dtype=float)
    tries = []
    for variant in variants:
        own = variant.conditions
        varied = [replace(own, phase_deg=x) if swept else replace(own, ambient=x / 100) for x in places.tolist()]
        tries += [_Try(one, variant.way == PLAIN) for one in varied]
    trials = np.array([(one.mean, one.median) for one in _trials(tries, engine, progress)]).reshape(len(variants), len(places), 2)
    curves = [StudyCurve(one.name, one.but, places, *found.T) for one, found in zip(variants, trials, strict=True)]
    said = _phase_said(dict(zip(variants, curves, strict=True))) if swept else _ambient_said(curves)
    return Study(which, ACROSS[which], tuple(curves), said)


@screens.screen_of.register
def _study_screen(found: Study) -> screens.RecordScreen:
    rows = [(curve.name, f"best {_range(curve)}: {curve.least_percent:.2f} %") for curve in found.curves]
    return screens.RecordScreen(f"Study  mean error of the normals over {found.across}", rows)


def _phase_said(found: dict[Variant, StudyCurve]) -> str:
    by = {(variant.way, variant.but): curve for variant, curve in found.items()}
    plain, noisy, rim, own = by[PLAIN, ""], by[PLAIN, NOISY], by[PLAIN, RIM], by[OWN, ""]
    others = ", ".join(f"{variant.but} {_range(curve)}" for variant, curve in found.items() if variant.way == OWN and variant.but)
    return (
        f"Plain least squares, as in the paper, is best with lights {_range(plain)} degrees from the axis "
        f"({plain.least_percent:.2f} % mean error; {_range(noisy)} with 1 % of noise; {_range(rim)} where the rim counts too): nearer, "
        "the steps of 8 bits weigh more; wider, shadows reach into the sphere (from 90 degrees less the angle) and are taken for "
        f"shading. By the median, which shadows do not reach, it is {plain.best_by_median:.0f}. lpcal leaves shadows out, and its "
        f"best is {_range(own)} ({own.least_percent:.2f} %); it moves to: {others}"
    )


def _range(curve: StudyCurve) -> str:
    low, high = curve.as_good
    return f"{curve.best:.0f} ({low:.0f} to {high:.0f})"


def _ambient_said(curves: list[StudyCurve]) -> str:
    parts = []
    for curve in curves:
        low, high = curve.as_good
        sentence = f"{curve.name}: {curve.mean_percent[0]:.2f} % in the dark, as good as any from {low:.0f} to {high:.0f} % ambient"
        parts.append(sentence + _failure(curve))
    return (
        "; ".join(parts)
        + f". The lights alone reach {100 * AMBIENT_PEAK:.0f} % of full scale, so over {100 - 100 * AMBIENT_PEAK:.0f} % of "
        "ambient light pixels saturate: plain least squares fails there, lpcal leaves them out until three lights are no longer left. "
        "Ambient light that is subtracted adds nothing by itself; a best level such as the paper's 20 % is found with a sensor that shows "
        "nothing of faint light, which ambient light lifts over that"
    )


def _failure(curve: StudyCurve) -> str:
    failed = np.flatnonzero(~(curve.mean_percent < 2 * curve.least_percent))
    failed = failed[failed > np.nanargmin(curve.mean_percent)]
    return f", twice that from {curve.x[failed[0]]:.0f} %" if len(failed) else ""

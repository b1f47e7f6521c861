"""What explains the shading of a matte sphere that lights found without it do not: another radius, or numbers that are not light.

Symbols: data y of a light and a of the room, stored = light^(1/e); the misfit is the rms of log(data / predicted), a level a light free::

    misfit(s)  the radius s R, the centre moved along        misfit(e)  the data (y + a)^e - a^e

The lights' places come from chrome spheres, whose highlights no tone curve moves; with them an e differs from a light that is near,
which the sphere's image alone (`detect.sphere_checks`) does not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from lpcal.chain.refine_lights.diagnosis import EXPECTED_GATES, SHADING_SD, Shaded, shading_misfit
from lpcal.chain.refine_lights.explain import SCALE, scaled
from lpcal.chain.refine_lights.measure import CentreMeasurement, Measured
from lpcal.chain.refine_lights.samples import FACING_LIGHT, sample_blocks
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array
from lpcal.geometry.tone_curve import decode, not_linear
from lpcal.records.calibration import Camera, Light, LightsSolution
from lpcal.records.observations import SphereView

RADIUS_OFF, EXPONENT_OFF = 0.03, 0.3
"""Log of a radius's share, and of an exponent, within which the stated one is let stand: a rough ball has exponents up to 1.3."""
BETTER = 0.4
"""Another radius or exponent is named when it leaves this share of the squares."""
EXPONENT = 3.0
"""Exponents are tried up to this one, and down to its inverse."""


def refuse_what_explains_shading(solution: LightsSolution, used: Measured, camera: Camera) -> None:
    """Refuse a matte sphere whose shading misses by more than its lights leave, and fits many times better otherwise.

    Raises
    ------
    DisagreementError
        The radius, or the exponent, that fits is named: of the two the one that fits better.
    """
    for view, measured in used:
        if view.shading is not None:
            _refuse(view, measured, solution.lights, camera)


def _refuse(view: SphereView, measured: CentreMeasurement, lights: Sequence[Light], camera: Camera) -> None:
    def with_radius(factor: float) -> float:
        other, moved = scaled(view, measured, factor)
        return _misfit(other, moved.centre_C, lights, camera)

    def with_exponent(power: float) -> float:
        return _misfit(raised(view, power), measured.centre_C, lights, camera)

    stated = with_radius(1.0)
    if stated < EXPECTED_GATES**2 * _expected_misfit(view, measured.centre_C, lights, camera):
        return
    (radius, of_radius), (power, of_power) = _best(with_radius, SCALE), _best(with_exponent, EXPONENT)
    if abs(np.log(power)) > EXPONENT_OFF and of_power < min(BETTER * stated, of_radius):
        error = not_linear(power)
        raise DisagreementError(error.found, where=f"sphere {view.name}", needed=error.needed, todo=error.todo)
    if abs(np.log(radius)) > RADIUS_OFF and of_radius < BETTER * stated:
        raise DisagreementError(
            f"its shading fits as if its radius were {1e3 * radius * view.radius_m:.1f} mm, not {1e3 * view.radius_m:.1f}",
            where=f"sphere {view.name}",
            needed="the radius as the calipers have it",
            todo=f"correct spheres.{view.name}.radius in panel.yaml",
        )


def raised(view: SphereView, power: float) -> SphereView:
    """A matte sphere as it would be were its stored numbers, the room's light among them, raised to a power."""
    assert view.shading is not None
    room = np.maximum(view.shading.ambient, np.float32(0))
    lit = decode(np.maximum(view.shading.signal + room, np.float32(0)), power)
    dark = decode(room, power)
    return replace(view, shading=replace(view.shading, signal=np.asarray(lit - dark, np.float32), ambient=dark))


def _best(misfit: Callable[[float], float], most: float) -> tuple[float, float]:
    """The factor between 1 / most and most of the least misfit, and that misfit."""
    from scipy.optimize import minimize_scalar

    span = float(np.log(most))
    best = minimize_scalar(
        lambda x: misfit(float(np.exp(x))), bounds=(-span, span), method="bounded", options={"xatol": 0.005, "maxiter": 14}
    )
    return float(np.exp(best.x)), float(best.fun)


def _misfit(view: SphereView, centre_C: Array, lights: Sequence[Light], camera: Camera) -> float:
    """Mean square of the log shading, a level a light free; infinite where nothing of it is lit."""
    try:
        shaded = shading_misfit([(view, centre_C)], lights, camera)
    except DegenerateError:
        return float("inf")
    return float("inf") if shaded is None else float(np.mean(_levelled(shaded) ** 2))


def _expected_misfit(view: SphereView, centre_C: Array, lights: Sequence[Light], camera: Camera) -> float:
    """Mean square of a matte sphere's log shading that the lights' own uncertain directions leave, and what any shading does."""
    samples = sample_blocks([view], centre_C[None], camera, lights)
    P, n = sphere.meet(samples.ray_C, centre_C, view.radius_m)
    expected = np.full(samples.light.size, SHADING_SD**2)
    for k, light in enumerate(lights):
        own = samples.light == k
        cosine = np.sum(n[own] * light.field(P[own])[0], axis=-1)
        expected[own] += light.direction_std_rad**2 * (1 / np.maximum(cosine, FACING_LIGHT) ** 2 - 1)
    return float(expected.mean())


def _levelled(shaded: Shaded) -> Array:
    """The misfit (N,) with each light's level removed."""
    m = shaded.misfit.copy()
    for k in np.unique(shaded.samples.light):
        m[shaded.samples.light == k] -= np.median(m[shaded.samples.light == k])
    return m

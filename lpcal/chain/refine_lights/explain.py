"""Which one mistake explains highlights that do not fit: a sphere of another radius, images in another order, a camera that moved.

Each is tried in turn, the geometry solved again with it, and what it gains compared::

    gain = 2 (cost as stated - cost with the mistake undone)

An outline fixes the ratio of radius and distance: with the radius s R, the centre is s C with s^2 of its covariance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.refine_lights.distant import FACING_CAMERA, matte_direction
from lpcal.chain.refine_lights.geometry_fit import GeometryFit, fit_geometry
from lpcal.chain.refine_lights.measure import CentreMeasurement, Measured
from lpcal.chain.refine_lights.swaps import refuse_swapped
from lpcal.errors import ConvergenceError, DegenerateError, DisagreementError
from lpcal.geometry import se3, sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Wings
from lpcal.records.observations import SphereView

ENOUGH = 25.0
"""A mistake that gains less is not named."""
SCALE = 1.8
"""Radii are tried up to so many times the stated one, and down to its inverse."""
SUSPECTS = 3
LOOSE = 20.0
"""A camera that may have moved: so many times the standard deviations of its place."""
SHIFTED = 4.0
"""A camera that moved by less than so many standard deviations has not."""
DISTANCES_M = np.geomspace(0.1, 20.0, 16)
NEARER = 9.0
"""Another order of the images puts the sum of squares down by this factor."""


@dataclass(frozen=True)
class Mistake:
    """What explains the data, and how much better."""

    gain: float
    error: DisagreementError


def refuse_at_sight(lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None) -> None:
    """What the geometry alone shows, before any long solve: swapped cables, a matte sphere's images in another order, a moved camera.

    Raises
    ------
    DisagreementError
        One of them, named.
    """
    if wings is not None:
        refuse_swapped(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
    as_stated = fitted(lights, used, camera, wings) if lights else None
    if as_stated is None:
        return
    if moved_camera(lights, used, camera, wings, as_stated) is not None:
        refuse_what_explains(lights, used, camera, wings)
    for view, measured in used:
        refuse_matte_order(view, measured.centre_C, camera, dict(zip(as_stated.lights, as_stated.source_C, strict=True)))


def refuse_what_explains(lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None) -> None:
    """Refuse data that one mistake explains many times better than none.

    Raises
    ------
    DisagreementError
        The mistake, named; where none explains the data, nothing is raised.
    """
    as_stated = fitted(lights, used, camera, wings)
    found = _orders(lights, used, camera, wings, as_stated) + _radii(lights, used, camera, wings, as_stated)
    moved = moved_camera(lights, used, camera, wings, as_stated)
    found += [moved] if moved else []
    best = max(found, key=lambda mistake: mistake.gain, default=None)
    if best is not None and best.gain > ENOUGH:
        raise best.error


def moved_camera(
    lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None, as_stated: GeometryFit | None
) -> Mistake | None:
    """Whether a camera free of its prior place among the wings fits so much better that it has moved."""
    if wings is None or as_stated is None:
        return None
    loose = fitted(lights, used, camera, replace(wings, H_CD_covariance=LOOSE**2 * wings.H_CD_covariance))
    if loose is None or loose.H_CD is None:
        return None
    gain, xi = 2 * (as_stated.cost - loose.cost), se3.log(loose.H_CD @ se3.inv(wings.H_CD))
    sigmas = float(np.sqrt(xi @ np.linalg.solve(wings.H_CD_covariance, xi)))
    if gain < ENOUGH or sigmas < SHIFTED:
        return None
    where_D = se3.inv(loose.H_CD)[:3, 3] - se3.inv(wings.H_CD)[:3, 3]
    error = DisagreementError(
        f"the camera stands {1e3 * np.linalg.norm(where_D):.1f} mm and {np.degrees(np.linalg.norm(xi[:3])):.2f} deg from where "
        f"it was among the wings, {sigmas:.0f} standard deviations: has it moved since the hand-eye images?",
        where="spheres",
        needed="one camera, fixed to the panel, for boards and spheres",
        todo="fasten it and take boards and spheres again; where its place is only drawn, widen panel.camera.tolerance",
    )
    return Mistake(float(gain), error)


def fitted(lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None) -> GeometryFit | None:
    """The geometry, or None where it does not settle."""
    try:
        return fit_geometry(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
    except (ConvergenceError, DegenerateError):
        return None


def _cost(fit: GeometryFit | None) -> float:
    return float("inf") if fit is None else fit.cost


def _radii(lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None, as_stated: GeometryFit | None) -> list[Mistake]:
    """The spheres whose highlights miss most, each with the radius that fits best."""
    from scipy.optimize import minimize_scalar

    misses = {} if as_stated is None else as_stated.highlight_px
    chrome = [k for k, (view, _) in enumerate(used) if view.highlights_px]
    chrome.sort(key=lambda k: -float(np.median([px for (name, _), px in misses.items() if name == used[k][0].name] or [0.0])))
    found = []
    for k in chrome[:SUSPECTS]:

        def cost(log_scale: float, k: int = k) -> float:
            trial = [*used[:k], scaled(*used[k], float(np.exp(log_scale))), *used[k + 1 :]]
            return min(_cost(fitted(lights, trial, camera, wings)), 1e12)

        reach = float(np.log(SCALE))
        best = minimize_scalar(cost, bounds=(-reach, reach), method="bounded", options={"xatol": 2e-3, "maxiter": 16})
        view, factor = used[k][0], float(np.exp(best.x))
        error = DisagreementError(
            f"its highlights fit as if its radius were {1e3 * factor * view.radius_m:.1f} mm, not {1e3 * view.radius_m:.1f}",
            where=f"sphere {view.name}",
            needed="the radius as the calipers have it",
            todo=f"correct spheres.{view.name}.radius in panel.yaml",
        )
        found.append(Mistake(2 * (min(_cost(as_stated), 1e12) - float(best.fun)), error))
    return found


def scaled(view: SphereView, measured: CentreMeasurement, factor: float) -> tuple[SphereView, CentreMeasurement]:
    """A sphere as it would be with another radius."""
    moved = replace(
        measured, centre_C=factor * measured.centre_C, covariance=factor**2 * measured.covariance, by_bias=factor * measured.by_bias
    )
    return replace(view, radius_m=factor * view.radius_m), moved


def refuse_other_orders(used: Measured, camera: Camera) -> None:
    """Refuse chrome spheres whose highlights are in different orders, by their mirrored rays alone.

    Raises
    ------
    DisagreementError
        One of the two orders, named; with three spheres or more that of the odd one.
    """
    chrome = [(view, m) for view, m in used if len(view.highlights_px) > 1]
    for view, measured in chrome:
        names, orders = [*view.highlights_px], []
        for other in chrome:
            cost = None if other[0] is view else _rays_apart(names, (view, measured), other, camera)
            order = None if cost is None else reordered(cost)
            orders += [] if order is None else [order]
        if orders and len(orders) > (len(chrome) - 1) / 2:
            raise in_another_order(view.name, names, orders[0])


def _orders(lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None, as_stated: GeometryFit | None) -> list[Mistake]:
    """Chrome spheres whose highlights fit the other spheres' lights in another order."""
    found = []
    chrome = [k for k, (view, _) in enumerate(used) if view.highlights_px]
    for k in chrome if len(chrome) > 1 else []:
        view, measured = used[k]
        names = [light for light in lights if light in view.highlights_px]
        rest = [*used[:k], *used[k + 1 :]]
        cost = _apart_px(names, view, measured, fitted(lights, rest, camera, wings), camera) if wings or len(chrome) > 2 else None
        cost = _rays_apart(names, used[k], used[chrome[k == chrome[0]]], camera) if cost is None else cost
        order = None if cost is None else reordered(cost)
        if order is None:
            continue
        right = replace(view, highlights_px={names[order[i]]: view.highlights_px[name] for i, name in enumerate(names)})
        gain = 2 * (min(_cost(as_stated), 1e12) - _cost(fitted(lights, [*used[:k], (right, measured), *used[k + 1 :]], camera, wings)))
        found.append(Mistake(gain, in_another_order(view.name, names, order)))
    return found


def _apart_px(
    names: Sequence[str], view: SphereView, measured: CentreMeasurement, others: GeometryFit | None, camera: Camera
) -> Array | None:
    """Squares (N, N) of the distances between the highlights seen and those that the other spheres' lights predict."""
    if others is None:
        return None
    source_C = np.array([others.source_C[others.lights.index(name)] for name in names])
    predicted = camera.project(sphere.mirror_point(measured.centre_C, view.radius_m, source_C))
    seen = np.array([view.highlights_px[name] for name in names])
    return np.asarray(np.sum((seen[:, None] - predicted[None]) ** 2, axis=2))


def _rays_apart(
    names: Sequence[str], one: tuple[SphereView, CentreMeasurement], other: tuple[SphereView, CentreMeasurement], camera: Camera
) -> Array | None:
    """Squares (N, N) of the angles between what one sphere sees, at the distance that suits best, and the other; both see all lights."""
    from scipy.optimize import linear_sum_assignment

    if not all(name in view.highlights_px for view, _ in (one, other) for name in names):
        return None
    (P, r), (Q, q) = (_mirrored(view, m, names, camera) for view, m in (one, other))
    least: tuple[float, Array] | None = None
    for t in DISTANCES_M:
        toward = (P + t * r)[:, None] - Q[None]
        toward /= np.linalg.norm(toward, axis=2, keepdims=True)
        cost = np.arccos(np.clip(np.sum(toward * q[None], axis=2), -1, 1)) ** 2
        best = cost[linear_sum_assignment(cost)].sum()
        least = (best, cost) if least is None or best < least[0] else least
    return None if least is None else least[1]


def _mirrored(view: SphereView, measured: CentreMeasurement, names: Sequence[str], camera: Camera) -> tuple[Array, Array]:
    u_C = camera.unproject(np.array([view.highlights_px[name] for name in names]))
    P, n = sphere.meet(u_C, measured.centre_C, view.radius_m)
    return P, sphere.reflect(u_C, n)


def refuse_matte_order(view: SphereView, centre_C: Array, camera: Camera, source_C: dict[str, Array]) -> None:
    """Refuse a matte sphere whose images are in another order: its shading gives directions to a degree or two.

    Raises
    ------
    DisagreementError
        The lights are named.
    """
    shading = view.shading
    if shading is None:
        return
    names = [name for name in shading.lights if name in source_C]
    rows, columns = np.indices(shading.saturated.shape[1:])
    u_C = camera.unproject(np.stack([columns, rows], axis=-1).astype(float))
    n_C = sphere.meet(u_C, centre_C, view.radius_m)[1]
    seen = np.nan_to_num(-np.sum(n_C * u_C, axis=-1), nan=-1.0) > FACING_CAMERA
    n_C = np.nan_to_num(n_C)
    said = np.array([matte_direction(shading, name, n_C, seen).mean(axis=0) for name in names])
    said /= np.maximum(np.linalg.norm(said, axis=1, keepdims=True), 1e-12)
    found = np.array([source_C[name] for name in names]) - centre_C
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    order = reordered(np.arccos(np.clip(said @ found.T, -1, 1)) ** 2)
    if order is not None:
        raise in_another_order(view.name, names, order)


def reordered(cost: Array) -> list[int] | None:
    """The assignment of rows to columns of a cost (N, N) where another than the stated one is many times better; else None."""
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(cost)
    if np.array_equal(rows, columns) or np.trace(cost) < NEARER * cost[rows, columns].sum():
        return None
    return [int(column) for column in columns]


def in_another_order(name: str, lights: Sequence[str], order: Sequence[int]) -> DisagreementError:
    """The refusal of a sphere whose images are in another order; order[i] is the light that the image of light i shows."""
    moved = [f"{lights[i]}'s image shows {lights[k]}" for i, k in enumerate(order) if i != k]
    return DisagreementError(
        f"its images are in another order than the other spheres': {', '.join(moved[:6])}" + (" ..." if len(moved) > 6 else ""),
        where=f"sphere {name}",
        needed="each image lit by the light whose name it bears",
        todo="rename its images",
    )

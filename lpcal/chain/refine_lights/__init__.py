r"""The lights refined from images of spheres: `refine_judged`, or `refine` without a judgement; `as_designed` where there are none.

The lights as `refine` finds them are judged: what the spheres leave open, what contradicts them, how well they predict a sphere.

Free lights whose distance the spheres do not determine become distant ones; when the fit does not settle, or settles badly, the
mistake that explains it is looked for (`explain`); the shading and a sphere held out are compared with what the lights predict
(`diagnosis`).

Lights that spheres cannot distinguish from distant ones: directions without positions.

Symbols: x_s, r_s the place and direction in which the mirror of sphere s sees a free light, x_0 the mean of the places, d the light's
direction from x_0 and w one over its distance (0: distant)::

    r_s = d - w (x_s - x_0)   across r_s      d and w by weighted least squares, with what is known of each r_s

One sphere leaves w open: 0 +- 1 / |x_0|, the light as far from it as the camera is or farther, which sigma over the volume holds. A light
whose w is not 2 sigma over 0 is taken as distant: its direction is the mean of the r_s. One that no chrome sphere shows takes its direction
from a matte one's shading, data = g . n. Intensities are the |g| of the matte spheres.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.refine_lights.assemble import as_designed
from lpcal.chain.refine_lights.diagnosis import diagnose
from lpcal.chain.refine_lights.distant import FACING_CAMERA, matte_direction
from lpcal.chain.refine_lights.explain import refuse_at_sight, refuse_other_orders, refuse_what_explains
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX
from lpcal.chain.refine_lights.matte import refuse_what_explains_shading
from lpcal.chain.refine_lights.measure import CentreMeasurement, Measured, measured_spheres
from lpcal.chain.refine_lights.refine import DOUBTED_PX, DOUBTED_SIGMAS, refine
from lpcal.chain.refine_lights.volume import volume_points
from lpcal.errors import ConvergenceError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Light, LightsSolution, Lobe, SphereFinding, Wings
from lpcal.records.evidence import LightsEvidence
from lpcal.records.observations import SphereView

__all__ = ["as_designed", "refine", "refine_judged"]

SURE_SIGMAS = 2.0
SHADING_SIGMA_RAD = float(np.radians(1.0))
"""Standard deviation of a direction from a matte sphere's shading."""


@dataclass(frozen=True)
class FarLight:
    """Direction (3,) in C, its standard deviation an axis, and the distance under which the light hardly is; None: not known at all."""

    direction_C: Array
    direction_std_rad: float
    """As seen from `seen_from_C`."""
    beyond_m: float | None
    seen_from_C: Array
    """(3,)."""
    nearness_rms: float
    """The rms of 1 / distance, per metre: by default that of a light as far from the sphere as the camera is, or more."""
    spheres: int
    """How many spheres show it."""

    def std_over(self, points_C: Array) -> float:
        """Standard deviation a tangent axis (rad), rms over points (N, 3) about the spheres, with what the unknown distance turns it by.

        The spheres stand somewhere in the volume: their middle is off its own by the volume's spread over the root of their number.
        """
        away = points_C - self.seen_from_C
        across2 = np.sum(away**2, axis=1) - (away @ self.direction_C) ** 2
        return float(np.hypot(self.direction_std_rad, self.nearness_rms * np.sqrt((1 + 1 / self.spheres) * across2.mean() / 2)))

    def level_std_over(self, points_C: Array) -> float:
        """Standard deviation of the log irradiance likewise, which falls by the distance's square."""
        along2 = ((points_C - self.seen_from_C) @ self.direction_C) ** 2
        return float(2 * self.nearness_rms * np.sqrt((1 + 1 / self.spheres) * along2.mean()))


def far_lights(free: Sequence[str], used: Measured, camera: Camera) -> dict[str, FarLight]:
    """Those of the free lights whose distance the spheres do not determine."""
    found = {}
    for light in free:
        far = _chrome(light, used, camera) or _matte(light, used, camera)
        if far is not None:
            found[light] = far
    return found


def with_far(
    near: LightsSolution | None,
    far: dict[str, FarLight],
    lights: Sequence[str],
    views: Sequence[SphereView],
    used: Measured,
    camera: Camera,
) -> LightsSolution:
    """The near lights' solution, or none, with the far lights added; intensities by the matte spheres, mean 1."""
    known = {light.name: light for light in near.lights} if near else {}
    centre_C = np.mean([m.centre_C for _, m in used], axis=0)
    points_C = volume_points(near.focus_C if near else centre_C)
    level = _levels([*known.values()], [*far], used, camera)
    for name, one in far.items():
        intensity = level.get(name, np.ones(1))
        level_std = one.level_std_over(points_C) if name in level else float("nan")
        known[name] = Light(name, one.direction_C, intensity, direction_std_rad=one.std_over(points_C), intensity_std=level_std)
    mean = float(np.mean([known[name].intensity.mean() for name in lights]))
    remarks = _words(far, used)
    if near is not None:
        return replace(
            near,
            lights=tuple(replace(known[name], intensity=known[name].intensity / mean) for name in lights),
            warnings=(*remarks, *near.warnings),
        )
    return LightsSolution(
        lights=tuple(replace(known[name], intensity=known[name].intensity / mean) for name in lights),
        focus_C=centre_C,
        d_object_m=None,
        H_CD=None,
        spheres=tuple(_finding(view, used, camera) for view in views),
        warnings=tuple(remarks),
        evidence=LightsEvidence(model="distant lights"),
    )


def _chrome(light: str, used: Measured, camera: Camera) -> FarLight | None:
    """A light that chrome spheres show; None where there is none, or where it is near."""
    places, rays, sigmas = [], [], []
    for view, measured in used:
        if light in view.highlights_px:
            P, r = _mirrored(view, measured, camera, light)
            places.append(P)
            rays.append(r)
            sigmas.append(_ray_sigma(view, measured, camera, light))
    if not rays:
        return None
    weight = 1 / np.square(sigmas)
    mean = np.average(rays, axis=0, weights=weight)
    d = mean / np.linalg.norm(mean)
    x_0, across = np.average(places, axis=0, weights=weight), np.eye(3) - np.outer(d, d)
    if len(rays) == 1:
        return FarLight(d, sigmas[0], None, x_0, 1 / float(np.linalg.norm(x_0)), len(rays))
    shift = [across @ (place - x_0) for place in places]
    # d and w part: the shifts have mean 0 about x_0
    information = sum(w * s @ s for w, s in zip(weight, shift, strict=True))
    nearness = -sum(w * s @ r for w, s, r in zip(weight, shift, rays, strict=True)) / max(information, 1e-30)
    sigma = 1 / np.sqrt(max(information, 1e-30))
    if nearness > SURE_SIGMAS * sigma:
        return None
    own, near = float(1 / np.sqrt(weight.sum())), max(float(nearness), 0.0)
    return FarLight(d, own, float(1 / (near + SURE_SIGMAS * sigma)), x_0, float(np.hypot(near, sigma)), len(rays))


def _matte(light: str, used: Measured, camera: Camera) -> FarLight | None:
    """A light that no chrome sphere shows but a matte one does."""
    if any(light in view.highlights_px for view, _ in used):
        return None
    found = [g.mean(axis=0) for view, m in used if view.shading for g in [_shading(view, m, camera).get(light)] if g is not None]
    found = [g / np.linalg.norm(g) for g in found if np.linalg.norm(g) > 0]
    if not found:
        return None
    mean = np.mean(found, axis=0)
    x_0 = np.mean([m.centre_C for view, m in used if view.shading], axis=0)
    return FarLight(
        mean / np.linalg.norm(mean), SHADING_SIGMA_RAD / np.sqrt(len(found)), None, x_0, 1 / float(np.linalg.norm(x_0)), len(found)
    )


def _mirrored(view: SphereView, measured: CentreMeasurement, camera: Camera, light: str) -> tuple[Array, Array]:
    P, n = sphere.meet(camera.unproject(view.highlights_px[light]), measured.centre_C, view.radius_m)
    return P, sphere.reflect(P / np.linalg.norm(P), n)


def _ray_sigma(view: SphereView, measured: CentreMeasurement, camera: Camera, light: str) -> float:
    """Sigma of a mirrored ray: twice that of the normal where pixel and centre are uncertain across the line of sight."""
    distance_m = float(np.linalg.norm(measured.centre_C))
    forward = measured.centre_C / distance_m
    across = np.eye(3) - np.outer(forward, forward)
    pixel_m = distance_m / float(np.sqrt(camera.K[0, 0] * camera.K[1, 1])) * view.highlight_sigma_px[light]
    centre_m = np.sqrt(np.trace(across @ measured.covariance @ across) / 2)
    return float(2 * np.hypot(pixel_m, centre_m) / view.radius_m)


def _shading(view: SphereView, measured: CentreMeasurement, camera: Camera) -> dict[str, Array]:
    """g (C, 3) of each light that a matte sphere shows."""
    shading = view.shading
    if shading is None:
        return {}
    rows, columns = np.indices(shading.saturated.shape[1:])
    u_C = camera.unproject(np.stack([columns, rows], axis=-1).astype(float))
    n_C = sphere.meet(u_C, measured.centre_C, view.radius_m)[1]
    seen = np.nan_to_num(-np.sum(n_C * u_C, axis=-1), nan=-1.0) > FACING_CAMERA
    n_C = np.nan_to_num(n_C)
    return {light: matte_direction(shading, light, n_C, seen) for light in shading.lights}


def _levels(near: Sequence[Light], far: Sequence[str], used: Measured, camera: Camera) -> dict[str, Array]:
    """Relative irradiance (C,) of the far lights on the scale of the near ones, mean over the matte spheres."""
    found: dict[str, list[Array]] = {}
    for view, measured in used:
        size = {light: np.linalg.norm(g, axis=1) for light, g in _shading(view, measured, camera).items()}
        front = measured.centre_C * (1 - view.radius_m / np.linalg.norm(measured.centre_C))
        albedo = [size[light.name] / light.field(front[None])[1][0].mean() for light in near if light.name in size]
        scale = np.mean(albedo or [one.mean() for one in size.values()]) if size else 1.0
        for light in far:
            if light in size:
                found.setdefault(light, []).append(size[light] / scale)
    return {light: np.mean(values, axis=0) for light, values in found.items()}


def _finding(view: SphereView, used: Measured, camera: Camera) -> SphereFinding:
    for other, measured in used:
        if other.name == view.name:
            rays = {light: _mirrored(view, measured, camera, light)[1] for light in view.highlights_px}
            vectors = {light: g.mean(axis=0) for light, g in _shading(view, measured, camera).items()}
            rays |= {light: g / np.linalg.norm(g) for light, g in vectors.items() if np.linalg.norm(g) > 0}
            return SphereFinding(view.name, view.kind, measured.centre_C, view.radius_m, used=True, why=None, directions_C=rays)
    return SphereFinding(view.name, view.kind, None, view.radius_m, used=False, why="its outline is not that of such a sphere")


def _words(far: dict[str, FarLight], used: Measured) -> list[str]:
    open_, bounded = [name for name, one in far.items() if one.beyond_m is None], {n: f for n, f in far.items() if f.beyond_m is not None}
    remarks = []
    if open_:
        shown = [view.name for view, _ in used if any(name in view.highlights_px for name in open_)]
        by = f"one chrome sphere ({', '.join(shown)})" if len(shown) == 1 else "one chrome sphere each" if shown else "no chrome sphere"
        remarks.append(
            f"{', '.join(open_)}: seen in {by}: their positions cannot be found, directions only, as seen from there; "
            "needed: two chrome spheres at different places, or the wings' settings"
        )
    if bounded:
        beyond = min(one.beyond_m for one in bounded.values() if one.beyond_m is not None)
        remarks.append(
            f"{', '.join(bounded)}: the spheres cannot tell near from far, beyond {beyond:.1f} m: taken as distant, directions only; "
            "spread the spheres further apart to find positions"
        )
    return remarks


DOUBTED_SHADING = 0.01
"""Shading that agrees no better is worth a look for a mistake, as are highlights and outlines that `refine` doubts."""

STRAINED = 3.0
"""A sphere so many standard deviations from where its outline puts it is worth a look too."""


def refine_judged(
    views: Sequence[SphereView],
    lights: Sequence[str],
    camera: Camera | None,
    wings: Wings | None,
    *,
    intensity_sd: float = 0.10,
    lobes: Mapping[str, Lobe] | None = None,
    free_core: bool = False,
) -> LightsSolution:
    """The lights from spheres, as `refine`; distant where their distance is not determined; what is wrong is named.

    Raises
    ------
    DegenerateError
        No sphere; or a light that the data leave undetermined.
    DisagreementError
        Images under each other's names, a sphere of another radius, a moved camera, images that are not linear.
    ConvergenceError
        The highlights or a sphere held out are nowhere near what the lights predict, and nothing explains it.
    """
    if camera is None or not views:
        return refine(views, lights, camera, wings)
    used, _ = measured_spheres(views, camera)
    if wings is None:
        refuse_other_orders(used, camera)
    drawn = {wing.name for wing in wings.wings} if wings else set()
    far = far_lights([light for light in lights if light not in drawn], used, camera)
    near = [light for light in lights if light not in far]
    if not near:
        return with_far(None, far, lights, views, used, camera)
    refuse_at_sight(near, used, camera, wings)
    try:
        solution = refine(views, near, camera, wings, intensity_sd=intensity_sd, lobes=lobes, free_core=free_core)
    except ConvergenceError:
        refuse_what_explains(near, used, camera, wings)
        raise
    if _doubtful(solution) or _strained(solution, used):
        refuse_what_explains(near, used, camera, wings)
        chrome = [view for view in views if view.highlights_px]
        if len(chrome) < len(views) and chrome:
            refuse_what_explains_shading(refine(chrome, near, camera, wings, intensity_sd=intensity_sd), used, camera)
    solution = diagnose(solution, used, camera, wings)
    return with_far(solution, far, lights, views, used, camera) if far else solution


def _doubtful(solution: LightsSolution) -> bool:
    """Whether highlights, shading or the outlines' biases are not as they should be."""
    found = solution.evidence
    if found.highlight_rms_px is not None and found.highlight_rms_px > DOUBTED_PX:
        return True
    if found.shading_rms is not None and found.shading_rms > DOUBTED_SHADING:
        return True
    biased = found.outline_bias_px or {}
    return any(abs(biased[kind] - mean) > DOUBTED_SIGMAS * sigma for kind, (mean, sigma) in BIAS_PX.items() if kind in biased)


def _strained(solution: LightsSolution, used: Measured) -> bool:
    """Whether a sphere lies farther from where its outline puts it than the outline's own uncertainty leaves."""
    bias_px = solution.evidence.outline_bias_px or {}
    centres = {finding.name: finding.centre_C for finding in solution.spheres if finding.used}
    for view, measured in used:
        centre_C = centres.get(view.name)
        if centre_C is None:
            continue
        off = centre_C - measured.centre_C - bias_px.get(view.kind, 0.0) * measured.by_bias
        if off @ np.linalg.solve(measured.covariance, off) > STRAINED**2:
            return True
    return False

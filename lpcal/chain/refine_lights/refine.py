r"""The lights refined from spheres: geometry first, brightness after, every light with what is known of it and how surely.

Where to put the next chrome sphere: spheres are put all over the picture, in simulation, and the one that would add the most is named.

Symbols: sources s with joint covariance S; a sphere at c, its centre measured by its outline with covariance S_c; highlights h(s, c) with
standard deviation sigma::

    A = dh/ds / sigma,  B = dh/dc / sigma,   S_new = [S^-1 + A^T A - A^T B (B^T B + S_c^-1)^-1 B^T A]^-1

The gain is what it does to the mean standard deviation of the directions from the focus to the lights. Source: sequential I-optimal design,
Pukelsheim 1993.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np

from lpcal.chain.refine_lights.assemble import (
    d_object_of,
    focus_of,
    leds_of,
    near_lights,
    nearest_to_axes,
    rms,
    shading_volume,
    unit,
    with_leds,
    with_shading,
)
from lpcal.chain.refine_lights.distant import refine_distant
from lpcal.chain.refine_lights.free_camera import with_core
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX, GeometryFit, fit_geometry
from lpcal.chain.refine_lights.joint_fit import JointFit, can_fit, fit_jointly
from lpcal.chain.refine_lights.measure import Measured, measure_centre, measured_spheres
from lpcal.chain.refine_lights.samples import sample_blocks
from lpcal.chain.refine_lights.shading import ShadingFit, fit_shading, lobe_of_leds
from lpcal.chain.refine_lights.swaps import Click, clicks_under_shading, fit_with_clicks, refuse_swapped
from lpcal.errors import ConvergenceError, DegenerateError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Light, LightsSolution, Lobe, SphereFinding, Wings
from lpcal.records.evidence import LightsEvidence, NextSphere, RefinedSetting
from lpcal.records.observations import SphereView

WORST_HIGHLIGHT_PX = 1.0
REFUSED_HIGHLIGHT_PX, DOUBTED_PX, DOUBTED_SIGMAS = 2.0, 0.25, 3.0


def refine(
    views: Sequence[SphereView],
    lights: Sequence[str],
    camera: Camera | None,
    wings: Wings | None,
    *,
    intensity_sd: float = 0.10,
    lobes: Mapping[str, Lobe] | None = None,
    free_core: bool = False,
) -> LightsSolution:
    """Position, axis, intensity and lobe of every light from spheres, with the wings as prior.

    Parameters
    ----------
    views : what the spheres show
    lights : the lights' names; those that are no wing of `wings` are free
    camera : None: orthographic, distant lights
    intensity_sd : prior of a light's relative intensity
    lobes : how lights emit by angle as their makers say; the prior of what is found
    free_core : whether the camera's parameters are solved for too, their covariance as prior

    Raises
    ------
    DegenerateError
        No sphere; or a light that the data leave undetermined.
    """
    if not views:
        raise DegenerateError("no sphere could be used", needed="one chrome sphere at least", todo="add spheres: to panel.yaml")
    if camera is None:
        return refine_distant(views, lights)
    used, refused = measured_spheres(views, camera, free_core=free_core)
    if wings is not None:
        refuse_swapped(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
    fit, used, more = _fit_without_outliers(lights, used, camera, wings)
    refused |= more
    clicks: list[Click] = []
    if wings is not None and any(view.highlights_px for view, _ in used):
        fit, wings, clicks = fit_with_clicks(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
    focus_C = focus_of(fit, wings)
    kept = [view for view, _ in used]
    known = [(lobes or {}).get(name) or lobe_of_leds(leds_of(fit, k, wings)) for k, name in enumerate(lights)]
    found, warnings = near_lights(fit, lights, known, focus_C, intensity_sd)
    shaded, messages = any(view.shading for view in kept), [click.message() for click in clicks]
    if not shaded:
        return _solution(found, focus_C, fit, None, views, kept, refused, [*messages, *warnings], camera, wings)
    if wings is None or not can_fit(kept, wings, lights):
        samples = sample_blocks(kept, fit.centres_C, camera, found)
        volume = shading_volume(found, fit, samples, [view.radius_m for view in kept], focus_C)
        names, axis_known = [view.name for view in kept], [row is not None for row in fit.wing_of]
        shading = fit_shading(samples, known, names, intensity_sd, axis_known=axis_known, volume=volume)
        found = with_shading(found, shading)
        return _solution(found, focus_C, fit, shading, views, kept, refused, [*messages, *warnings], camera, wings)
    joint, messages = _joint(fit, used, known, camera, wings, intensity_sd, clicks)
    found = with_leds(joint.fit, joint.shading)
    focus_C = nearest_to_axes(np.array([light.H_CL for light in found]))
    found = [replace(light, direction_C=light.field(focus_C[None])[0][0]) for light in found]
    return _solution(found, focus_C, joint.start, joint.shading, views, kept, refused, [*messages, *warnings], camera, wings, joint.fit)


@dataclass(frozen=True)
class _Joint:
    """The joint fit, and the geometry and shading that it started from."""

    start: GeometryFit
    shading: ShadingFit
    fit: JointFit

    @property
    def settings(self) -> Array:
        return self.fit.settings

    @property
    def settings_std(self) -> Array:
        return self.fit.settings_std

    @property
    def cost(self) -> float:
        return self.fit.cost


def _joint(
    start: GeometryFit,
    used: Measured,
    known: Sequence[Lobe | None],
    camera: Camera,
    wings: Wings,
    intensity_sd: float,
    clicks: list[Click],
) -> tuple[_Joint, list[str]]:
    """Highlights and shading together, and the clicks' messages: where highlights are few or leave a click unsure, shading decides it."""
    views, measured, lights = [view for view, _ in used], [m for _, m in used], start.lights

    def solve(now: Wings, begun: GeometryFit | None = None) -> _Joint:
        fit = begun or fit_geometry(lights, views, measured, camera, now)
        focus_C = focus_of(fit, now)
        near, _ = near_lights(fit, lights, known, focus_C, intensity_sd)
        samples = sample_blocks(views, fit.centres_C, camera, near)
        shading = fit_shading(samples, known, [view.name for view in views], intensity_sd, with_maps=False)
        return _Joint(fit, shading, fit_jointly(fit, shading, samples, views, measured, camera, now, focus_C, intensity_sd))

    joint = solve(wings, start)
    sure = [click.message() for click in clicks if click.sure]
    if len(sure) == len(clicks) and sum(bool(view.highlights_px) for view in views) > 1:
        return joint, sure
    rows = [k for k, wing in enumerate(wings.wings) if wing.name in lights]
    joint, _, late = clicks_under_shading(joint, wings, solve, rows)
    return joint, [*sure, *(click.message() for click in late)]


def _fit_without_outliers(
    lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None
) -> tuple[GeometryFit, Measured, dict[str, str]]:
    """The fit without spheres whose highlights do not agree with the others'."""
    refused: dict[str, str] = {}
    while True:
        fit = fit_geometry(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
        by_sphere = {view.name: [px for (name, _), px in fit.highlight_px.items() if name == view.name] for view, _ in used}
        worst = max((name for name in by_sphere if by_sphere[name]), key=lambda name: float(np.median(by_sphere[name])), default=None)
        chrome = sum(bool(found) for found in by_sphere.values())
        if worst is None or np.median(by_sphere[worst]) < WORST_HIGHLIGHT_PX or chrome < 3:
            return fit, used, refused
        refused[worst] = (
            f"its highlights lie {np.median(by_sphere[worst]):.1f} px from where the other spheres put the lights; is its radius right?"
        )
        used = [(view, m) for view, m in used if view.name != worst]


def _solution(
    lights: Sequence[Light],
    focus_C: Array,
    fit: GeometryFit,
    shading: ShadingFit | None,
    views: Sequence[SphereView],
    kept: Sequence[SphereView],
    refused: dict[str, str],
    warnings: Sequence[str],
    camera: Camera,
    wings: Wings | None,
    joint: JointFit | None = None,
) -> LightsSolution:
    H_CD = joint.H_CD if joint else fit.H_CD
    highlights = joint.highlight_px if joint else fit.highlight_px
    misfit = joint.shading if joint else shading.residual if shading else {}
    centres_C = joint.centres_C if joint else fit.centres_C
    names = [view.name for view in kept]
    spheres = []
    for view in views:
        centre_C = centres_C[names.index(view.name)] if view.name in names else None
        spheres.append(_finding(view, centre_C, highlights, misfit, refused, camera))
    settings = joint.settings if joint else fit.settings
    offset_m = {mode: dome[0] for mode, dome in joint.dome_m.items()} if joint else fit.source_offset_m
    evidence = LightsEvidence(
        model="sum of LEDs" if joint else "round lobe" if shading else "geometry only",
        source_offset_m={str(mode): offset for mode, offset in offset_m.items()},
        outline_bias_px=joint.bias_px if joint else fit.bias_px,
        settings=_setting_report(settings, wings),
        lobe_seen_deg=dict(zip(fit.lights, np.degrees(shading.seen_rad).tolist(), strict=True)) if shading else None,
        highlight_rms_px=rms(list(highlights.values())),
        shading_rms=rms(list(misfit.values())),
        next_sphere=_next_sphere(fit, joint, focus_C, kept, camera),
    )
    remarks = (
        *(f"{name}: {why}" for name, why in refused.items()),
        *warnings,
        *_doubts(joint.bias_px if joint else fit.bias_px, highlights),
    )
    solved = joint or fit
    return LightsSolution(
        lights=tuple(lights),
        focus_C=focus_C,
        d_object_m=d_object_of(H_CD, focus_C),
        H_CD=H_CD,
        spheres=tuple(spheres),
        warnings=remarks,
        evidence=evidence,
        H_CD_covariance=solved.H_CD_covariance,
        camera=with_core(camera, solved.core) if solved.core.size else None,
    )


def _next_sphere(fit: GeometryFit, joint: JointFit | None, focus_C: Array, kept: Sequence[SphereView], camera: Camera) -> NextSphere | None:
    """Which chrome sphere would improve the directions most, as evidence."""
    source_C, covariance = (joint.source_C, joint.source_covariance) if joint else (fit.source_C, fit.source_covariance)
    radius_m = float(np.median([view.radius_m for view in kept]))
    advice = advise(source_C, covariance, focus_C, radius_m, camera)
    if advice is None:
        return None
    before, after = np.degrees([advice.before_rad, advice.after_rad])
    return NextSphere(where=advice.words, centre_m=advice.centre_C, direction_std_deg=float(before), with_it_deg=float(after))


def _doubts(bias_px: dict[str, float], highlights: dict[tuple[str, str], float]) -> list[str]:
    """What in a solution that settled is not as it should be.

    Raises
    ------
    ConvergenceError
        The highlights are nowhere near where the lights put them.
    """
    rms_px = rms(list(highlights.values()))
    if rms_px > REFUSED_HIGHLIGHT_PX:
        worst = max(highlights, key=highlights.__getitem__)
        raise ConvergenceError(
            f"the highlights lie {rms_px:.1f} px rms from where the lights put them, worst that of {worst[1]} in {worst[0]}",
            needed=f"under {REFUSED_HIGHLIGHT_PX} px",
            todo="look at the spheres' radii and outlines (a hint: [x, y, radius] helps) and at the wings' settings",
        )
    doubts = (
        [f"the highlights agree to {rms_px:.2f} px only, where 0.05 is usual: is a radius or an outline wrong?"]
        if rms_px > DOUBTED_PX
        else []
    )
    for kind, (mean, sigma) in BIAS_PX.items():
        if abs(bias_px[kind] - mean) > DOUBTED_SIGMAS * sigma:
            doubts.append(
                f"the outlines of the {kind} spheres are biased by {bias_px[kind]:.2f} px, where {mean} +- {sigma} is usual: look at them"
            )
    return doubts


def _finding(
    view: SphereView,
    centre_C: Array | None,
    highlights: dict[tuple[str, str], float],
    misfit: dict[str, float],
    refused: dict[str, str],
    camera: Camera,
) -> SphereFinding:
    seen = partial(
        SphereFinding,
        outline_px=view.outline_px,
        highlights_px=view.highlights_px,
        image_size=view.image_size,
        outline_sigma_px=view.outline_sigma_px,
        highlight_sigma_px=view.highlight_sigma_px,
    )
    if centre_C is None:
        return seen(view.name, view.kind, None, view.radius_m, used=False, why=refused.get(view.name))
    directions = {}
    for light, pixel in view.highlights_px.items():
        P, n = sphere.meet(camera.unproject(pixel), centre_C, view.radius_m)
        directions[light] = sphere.reflect(unit(P), n)
    residual = rms([px for (name, _), px in highlights.items() if name == view.name])
    residual = misfit.get(view.name, float("nan")) if view.kind == "matte" else residual
    return seen(view.name, view.kind, centre_C, view.radius_m, used=True, why=None, directions_C=directions, residual=residual)


def _setting_report(settings: Array, wings: Wings | None) -> dict[str, RefinedSetting]:
    if wings is None:
        return {}
    found = {}
    for k, wing in enumerate(wings.wings):
        azimuth_rad, joint_angle_rad, d1_m, d2_m = settings[k].tolist()
        azimuth_deg, joint_angle_deg = math.degrees(azimuth_rad), math.degrees(joint_angle_rad)
        found[wing.name] = RefinedSetting(azimuth_deg=azimuth_deg, joint_angle_deg=joint_angle_deg, d1_m=d1_m, d2_m=d2_m)
    return found


PLACES = {"left": -0.55, "": 0.0, "right": 0.55}
HEIGHTS = {"top": -0.55, "": 0.0, "bottom": 0.55}
"""Places of the sphere's middle that are proposed, in half image sides."""
DISTANCES = (0.8, 1.0, 1.2)
"""Over that of the focus."""
MARGIN_PX = 8
HIGHLIGHT_PX, OUTLINE_PX, COMMON_BIAS_PX = 0.015, 0.05, 0.05
"""Standard deviations of a highlight, of a point of the outline, and of the bias that all chrome outlines share."""
STEP = 1e-6


@dataclass(frozen=True)
class SphereAdvice:
    """A sphere to add, in words, its place in C, and the mean standard deviation of the lights' directions before and after."""

    words: str
    centre_C: Array
    before_rad: float
    after_rad: float


def advise(source_C: Array, source_covariance: Array, focus_C: Array, radius_m: float, camera: Camera) -> SphereAdvice | None:
    """The best of the places thought of; None where the sphere fits into none of them.

    Parameters
    ----------
    source_C, source_covariance : (L, 3) sources of the lights and their joint covariance (3 L, 3 L)
    focus_C : (3,) from where directions are judged
    radius_m : of the sphere
    """
    before = mean_direction_std(source_C, source_covariance, focus_C)
    found: list[SphereAdvice] = []
    half = (np.array(camera.image_size) - 1) / 2
    for (place, x), (height, y), away in product(PLACES.items(), HEIGHTS.items(), DISTANCES):
        centre_C = away * np.linalg.norm(focus_C) * camera.unproject(half * (1 + np.array([x, y])))
        gain = _information(source_C, centre_C, radius_m, camera)
        if gain is not None:
            update = np.linalg.solve(np.eye(len(gain)) + source_covariance @ gain, source_covariance)
            where = f"at the {height} {place}".replace("  ", " ").strip() if height or place else "in the middle"
            words = f"{where} of the picture, {1e3 * np.linalg.norm(centre_C):.0f} mm from the camera"
            found.append(SphereAdvice(words, centre_C, before, mean_direction_std(source_C, update, focus_C)))
    return min(found, key=lambda one: one.after_rad, default=None)


def mean_direction_std(source_C: Array, covariance: Array, focus_C: Array) -> float:
    """Root mean square, over the lights, of the standard deviation a tangent axis of the directions from the focus, in radians."""
    variance = []
    for k, away in enumerate(source_C - focus_C):
        length = np.linalg.norm(away)
        across = np.eye(3) - np.outer(away, away) / length**2
        variance.append(np.trace(across @ covariance[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] @ across) / (2 * length**2))
    return float(np.sqrt(np.mean(variance)))


def _information(source_C: Array, centre_C: Array, radius_m: float, camera: Camera) -> Array | None:
    """What a sphere at a place adds to the knowledge of the sources, (3 L, 3 L); None where it is not whole in the picture."""
    outline_px = camera.project(sphere.outline(centre_C, radius_m, np.linspace(0, 2 * np.pi, 90, endpoint=False)))
    if np.any(outline_px < MARGIN_PX) or np.any(outline_px > np.array(camera.image_size) - 1 - MARGIN_PX):
        return None
    try:
        measured = measure_centre(SphereView("", "chrome", radius_m, outline_px, OUTLINE_PX), camera)
    except DegenerateError:
        return None

    def highlights(sources: Array, centre: Array) -> Array:
        return np.asarray(camera.project(sphere.mirror_point(centre, radius_m, sources))) / HIGHLIGHT_PX

    count = len(source_C)
    by_source = np.zeros((2 * count, 3 * count))
    by_centre = np.zeros((2 * count, 3))
    for axis, step in enumerate(STEP * np.eye(3)):
        along = (highlights(source_C + step, centre_C) - highlights(source_C - step, centre_C)) / (2 * STEP)
        for k in range(count):
            by_source[2 * k : 2 * k + 2, 3 * k + axis] = along[k]
        by_centre[:, axis] = ((highlights(source_C, centre_C + step) - highlights(source_C, centre_C - step)) / (2 * STEP)).ravel()
    covariance = measured.covariance + COMMON_BIAS_PX**2 * np.outer(measured.by_bias, measured.by_bias)
    mixed = by_source.T @ by_centre
    return np.asarray(by_source.T @ by_source - mixed @ np.linalg.solve(by_centre.T @ by_centre + np.linalg.inv(covariance), mixed.T))

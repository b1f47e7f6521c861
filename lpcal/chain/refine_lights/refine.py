"""The lights refined from spheres: geometry first, brightness after, every light with what is known of it and how surely."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lpcal.chain.refine_lights.clicks import Click, fit_with_clicks
from lpcal.chain.refine_lights.distant import refine_distant
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX, SOURCE_OFFSET_M, SOURCE_OFFSET_SIGMA_M, GeometryFit, fit_geometry
from lpcal.chain.refine_lights.joint_fit import JointFit, can_fit, fit_jointly
from lpcal.chain.refine_lights.measure import CentreMeasurement, measure_centre
from lpcal.chain.refine_lights.next_sphere import advise
from lpcal.chain.refine_lights.samples import sample_blocks
from lpcal.chain.refine_lights.shading import ShadingFit, fit_shading, lobe_of_leds
from lpcal.chain.refine_lights.swaps import refuse_swapped
from lpcal.errors import ConvergenceError, DegenerateError
from lpcal.geometry import se3, sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Light, LightsSolution, Lobe, SphereFinding, Wings
from lpcal.records.observations import SphereView

DIRECTION_FLOOR_RAD = float(np.radians(0.02))
"""LEDs that stand a little askew move the source seen from different places: what a point source cannot follow."""
WORST_HIGHLIGHT_PX = 1.0
REFUSED_HIGHLIGHT_PX, DOUBTED_PX, DOUBTED_SIGMAS = 2.0, 0.25, 3.0
UNSURE = 0.3
"""A free light whose distance is less sure than this share of itself is told."""


def refine(
    views: Sequence[SphereView],
    lights: Sequence[str],
    camera: Camera | None,
    wings: Wings | None,
    *,
    intensity_sd: float = 0.10,
    lobes: Mapping[str, Lobe] | None = None,
) -> LightsSolution:
    """Position, axis, intensity and lobe of every light from spheres, with the wings as prior.

    Parameters
    ----------
    views : what the spheres show
    lights : the lights' names; those that are no wing of `wings` are free
    camera : None: orthographic, distant lights
    intensity_sd : prior of a light's relative intensity
    lobes : how lights emit by angle as their makers say; the prior of what is found

    Raises
    ------
    DegenerateError
        No sphere; or a light that the data leave undetermined.
    """
    if not views:
        raise DegenerateError("no sphere could be used", needed="one chrome sphere at least", todo="add spheres: to panel.yaml")
    if camera is None:
        return refine_distant(views, lights)
    used, refused = _measured(views, camera)
    if wings is not None:
        refuse_swapped(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
    fit, used, more = _fit_without_outliers(lights, used, camera, wings)
    refused |= more
    clicks: list[Click] = []
    if wings is not None and any(view.highlights_px for view, _ in used):
        fit, wings, clicks = fit_with_clicks(lights, [view for view, _ in used], [m for _, m in used], camera, wings)
    focus_C = _focus(fit, wings)
    kept = [view for view, _ in used]
    known = [(lobes or {}).get(name) or lobe_of_leds(_leds(fit, k, wings)) for k, name in enumerate(lights)]
    found, warnings = _near_lights(fit, lights, known, focus_C, intensity_sd)
    warnings = [*(click.message() for click in clicks), *warnings]
    samples = sample_blocks(kept, fit.centres_C, camera, found) if any(view.shading for view in kept) else None
    if samples is None:
        return _solution(found, focus_C, fit, None, views, kept, refused, warnings, camera, wings)
    shading = fit_shading(samples, known, [view.name for view in kept], intensity_sd)
    if wings is None or not can_fit(kept, wings, lights):
        found = _with_shading(found, shading)
        return _solution(found, focus_C, fit, shading, views, kept, refused, warnings, camera, wings)
    joint = fit_jointly(fit, shading, samples, kept, [m for _, m in used], camera, wings, focus_C, intensity_sd)
    found = _with_leds(joint, shading)
    focus_C = _nearest_to_axes(np.array([light.H_CL for light in found]))
    found = [replace(light, direction_C=light.field(focus_C[None])[0][0]) for light in found]
    return _solution(found, focus_C, fit, shading, views, kept, refused, warnings, camera, wings, joint)


def as_designed(wings: Wings, lights: Sequence[str], intensity_sd: float) -> LightsSolution:
    """The lights as the drawing has them, for a rig without spheres: sources where LightBlobs have theirs, give or take."""
    rows = [k for k, wing in enumerate(wings.wings) if wing.name in lights]
    focus_C = _nearest_to_axes(wings.H_CL[rows])
    found = []
    for k in rows:
        H_CL, block = wings.H_CL[k], wings.covariance[6 * k : 6 * k + 6, 6 * k : 6 * k + 6]
        axis_C = H_CL[:3, 2]
        source_C = H_CL[:3, 3] + SOURCE_OFFSET_M * axis_C
        carry = _point_by_twist(source_C)
        covariance = carry @ block @ carry.T + SOURCE_OFFSET_SIGMA_M**2 * np.outer(axis_C, axis_C)
        origin = _point_by_twist(H_CL[:3, 3])
        found.append(
            Light(
                name=wings.wings[k].name,
                direction_C=_unit(source_C - focus_C),
                intensity=np.ones(1),
                H_CL=H_CL,
                source_C=source_C,
                axis_C=axis_C,
                lobe=lobe_of_leds(wings.wings[k].leds) or Lobe(),
                position_std_m=_per_axis(origin @ block @ origin.T),
                direction_std_rad=_direction_std(source_C - focus_C, covariance),
                intensity_std=intensity_sd,
            )
        )
    return LightsSolution(
        tuple(found), focus_C, _d_object(wings.H_CD, focus_C), wings.H_CD, (), ("no spheres: the lights are as designed, not refined",)
    )


def _measured(views: Sequence[SphereView], camera: Camera) -> tuple[list[tuple[SphereView, CentreMeasurement]], dict[str, str]]:
    used, refused = [], {}
    for view in views:
        try:
            used.append((view, measure_centre(view, camera)))
        except DegenerateError as error:
            refused[view.name] = error.found
    return used, refused


def _fit_without_outliers(
    lights: Sequence[str], used: list[tuple[SphereView, CentreMeasurement]], camera: Camera, wings: Wings | None
) -> tuple[GeometryFit, list[tuple[SphereView, CentreMeasurement]], dict[str, str]]:
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


def _leds(fit: GeometryFit, k: int, wings: Wings | None) -> int | None:
    row = fit.wing_of[k]
    return None if row is None or wings is None else wings.wings[row].leds


def _near_lights(
    fit: GeometryFit, lights: Sequence[str], known: Sequence[Lobe | None], focus_C: Array, intensity_sd: float
) -> tuple[list[Light], list[str]]:
    """The lights as the geometry alone has them, each with the lobe that it is known by beforehand; and warnings."""
    found, warnings = [], []
    axes = _axes(fit, focus_C)
    for k, name in enumerate(lights):
        covariance, row, away = fit.source_covariance[3 * k : 3 * k + 3, 3 * k : 3 * k + 3], fit.wing_of[k], fit.source_C[k] - focus_C
        light = Light(
            name=name,
            direction_C=_unit(away),
            intensity=np.ones(1),
            H_CL=fit.H_CL[k] if row is not None else _frame_at(fit.source_C[k], axes[k]),
            source_C=fit.source_C[k],
            axis_C=axes[k],
            lobe=known[k] or Lobe(),
            position_std_m=_per_axis(_origin_covariance(fit, k) if row is not None else covariance),
            direction_std_rad=float(np.hypot(_direction_std(away, covariance), DIRECTION_FLOOR_RAD)),
            intensity_std=intensity_sd,
        )
        distance_std = float(np.sqrt(_unit(away) @ covariance @ _unit(away))) / float(np.linalg.norm(away))
        if row is None and distance_std > UNSURE:
            warnings.append(f"{name}: its distance is known to {100 * distance_std:.0f} % only: spread the spheres")
        found.append(light)
    return found, warnings


def _with_shading(lights: Sequence[Light], shading: ShadingFit) -> list[Light]:
    """The lights with the intensities and round lobes of the shading."""
    misfit = _rms(list(shading.residual.values()))
    return [
        replace(
            light,
            intensity=shading.intensity[k],
            lobe=replace(shading.lobes[k], seen_rad=float(shading.seen_rad[k])),
            intensity_std=float(np.hypot(shading.intensity_std[k], misfit)),
        )
        for k, light in enumerate(lights)
    ]


def _with_leds(joint: JointFit, shading: ShadingFit) -> list[Light]:
    """The lights of the joint fit with the colour of the shading, mean intensity 1."""
    colour = shading.intensity / shading.intensity.mean(axis=1, keepdims=True)
    intensity = np.array([light.intensity[0] for light in joint.lights])[:, None] * colour
    intensity /= intensity.mean()
    misfit = _rms(list(joint.shading.values()))
    return [
        replace(
            light,
            intensity=intensity[k],
            lobe=replace(light.lobe, seen_rad=float(shading.seen_rad[k])),
            position_std_m=float(joint.position_std_m[k]),
            direction_std_rad=float(np.hypot(joint.direction_std_rad[k], DIRECTION_FLOOR_RAD)),
            intensity_std=float(np.hypot(joint.intensity_std[k], misfit)),
        )
        for k, light in enumerate(joint.lights)
    ]


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
    evidence: dict[str, object] = {
        "model": "sum of LEDs" if joint else "round lobe" if shading else "geometry only",
        "source_offset_m": {str(mode): dome[0] for mode, dome in joint.dome_m.items()}
        if joint
        else {str(m): e for m, e in fit.source_offset_m.items()},
        "outline_bias_px": joint.bias_px if joint else fit.bias_px,
        "settings": _setting_report(settings, wings),
        "lobe_seen_deg": dict(zip(fit.lights, np.degrees(shading.seen_rad).tolist(), strict=True)) if shading else None,
        "highlight_rms_px": _rms(list(highlights.values())),
        "shading_rms": _rms(list(misfit.values())),
        "next_sphere": _next_sphere(fit, joint, focus_C, kept, camera),
    }
    told = (*(f"{name}: {why}" for name, why in refused.items()), *warnings, *_doubts(joint.bias_px if joint else fit.bias_px, highlights))
    return LightsSolution(tuple(lights), focus_C, _d_object(H_CD, focus_C), H_CD, tuple(spheres), told, evidence)


def _next_sphere(
    fit: GeometryFit, joint: JointFit | None, focus_C: Array, kept: Sequence[SphereView], camera: Camera
) -> dict[str, object] | None:
    """Which chrome sphere would tell the most of the directions, as evidence."""
    source_C, covariance = (joint.source_C, joint.source_covariance) if joint else (fit.source_C, fit.source_covariance)
    radius_m = float(np.median([view.radius_m for view in kept]))
    advice = advise(source_C, covariance, focus_C, radius_m, camera)
    if advice is None:
        return None
    before, after = np.degrees([advice.before_rad, advice.after_rad])
    return {"where": advice.words, "centre_m": advice.centre_C, "direction_std_deg": float(before), "with_it_deg": float(after)}


def _doubts(bias_px: dict[str, float], highlights: dict[tuple[str, str], float]) -> list[str]:
    """What in a solution that settled is not as it should be.

    Raises
    ------
    ConvergenceError
        The highlights are nowhere near where the lights put them.
    """
    rms_px = _rms(list(highlights.values()))
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
    if centre_C is None:
        return SphereFinding(view.name, view.kind, None, view.radius_m, used=False, why=refused.get(view.name))
    directions = {}
    for light, pixel in view.highlights_px.items():
        P, n = sphere.meet(camera.unproject(pixel), centre_C, view.radius_m)
        directions[light] = sphere.reflect(_unit(P), n)
    residual = _rms([px for (name, _), px in highlights.items() if name == view.name])
    residual = misfit.get(view.name, float("nan")) if view.kind == "matte" else residual
    return SphereFinding(view.name, view.kind, centre_C, view.radius_m, used=True, why=None, directions_C=directions, residual=residual)


def _axes(fit: GeometryFit, focus_C: Array) -> Array:
    """Emission axes (L, 3); a free light is taken to face the focus."""
    return np.array([fit.H_CL[k, :3, 2] if row is not None else _unit(focus_C - fit.source_C[k]) for k, row in enumerate(fit.wing_of)])


def _focus(fit: GeometryFit, wings: Wings | None) -> Array:
    """Where the wings' axes (nearly) meet; without wings, the middle of the spheres."""
    rows = [k for k, row in enumerate(fit.wing_of) if row is not None]
    return _nearest_to_axes(fit.H_CL[rows]) if wings is not None and len(rows) > 1 else np.mean(fit.centres_C, axis=0)


def _nearest_to_axes(H_CL: Array) -> Array:
    across = np.eye(3) - H_CL[:, :3, 2:3] * H_CL[:, None, :3, 2]
    return np.linalg.lstsq(across.sum(axis=0), np.sum(across @ H_CL[:, :3, 3:], axis=0)[:, 0], rcond=None)[0]


def _frame_at(source_C: Array, axis_C: Array) -> Array:
    """A frame with its origin at a source and its z along an axis, x as near to that of C as can be."""
    x = _unit(np.array([1.0, 0.0, 0.0]) - axis_C[0] * axis_C)
    return se3.transform(np.stack([x, np.cross(axis_C, x), axis_C], axis=1), source_C)


def _origin_covariance(fit: GeometryFit, k: int) -> Array:
    carry = _point_by_twist(fit.H_CL[k, :3, 3])
    return carry @ fit.frame_covariance[k] @ carry.T


def _direction_std(away: Array, covariance: Array) -> float:
    """Standard deviation a tangent axis, in radians, of the direction of a vector with this covariance."""
    d = _unit(away)
    across = np.eye(3) - np.outer(d, d)
    return float(np.sqrt(np.trace(across @ covariance @ across) / 2) / np.linalg.norm(away))


def _setting_report(settings: Array, wings: Wings | None) -> dict[str, object]:
    if wings is None:
        return {}
    names = ("azimuth_deg", "joint_angle_deg", "d1_m", "d2_m")
    scale = np.array([180 / np.pi, 180 / np.pi, 1, 1])
    return {wing.name: dict(zip(names, (settings[k] * scale).tolist(), strict=True)) for k, wing in enumerate(wings.wings)}


def _d_object(H_CD: Array | None, focus_C: Array) -> float | None:
    return float(np.linalg.norm(focus_C)) if H_CD is None else float(se3.apply(se3.inv(H_CD), focus_C[None])[0, 2])


def _point_by_twist(x: Array) -> Array:
    return np.hstack([-se3.hat(x), np.eye(3)])


def _per_axis(covariance: Array) -> float:
    return float(np.sqrt(np.trace(covariance) / 3))


def _unit(v: Array) -> Array:
    return np.asarray(v / np.linalg.norm(v))


def _rms(values: list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")

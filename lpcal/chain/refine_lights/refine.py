"""The lights refined from spheres: geometry first, brightness after, every light with what is known of it and how surely."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.chain.refine_lights.distant import refine_distant
from lpcal.chain.refine_lights.geometry_fit import SOURCE_OFFSET_M, SOURCE_OFFSET_SIGMA_M, GeometryFit, fit_geometry
from lpcal.chain.refine_lights.measure import CentreMeasurement, measure_centre
from lpcal.chain.refine_lights.shading import ShadingFit, fit_shading, nominal_lobe, sample_blocks
from lpcal.errors import DegenerateError
from lpcal.geometry import se3, sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Light, LightsSolution, SphereFinding, Wings
from lpcal.records.observations import SphereView

DIRECTION_FLOOR_RAD = float(np.radians(0.02))
"""LEDs that stand a little askew move the source seen from different places: what a point source cannot follow."""
WORST_HIGHLIGHT_PX = 1.0
FAR = 0.3
"""A free light whose distance is less sure than this share of itself is given as distant."""


def refine(
    views: Sequence[SphereView], lights: Sequence[str], camera: Camera | None, wings: Wings | None, *, intensity_sd: float = 0.10
) -> LightsSolution:
    """Position, axis, intensity and lobe of every light from spheres, with the wings as prior.

    Parameters
    ----------
    views : what the spheres show
    lights : the lights' names; those that are no wing of `wings` are free
    camera : None: orthographic, distant lights
    intensity_sd : prior of a light's relative intensity

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
    fit, used, more = _fit_without_outliers(lights, used, camera, wings)
    refused |= more
    focus_C = _focus(fit, wings)
    shading = _shading(fit, [view for view, _ in used], lights, camera, wings, focus_C, intensity_sd)
    found, warnings = _lights(fit, shading, lights, wings, focus_C)
    return LightsSolution(
        lights=found,
        focus_C=focus_C,
        d_object_m=_d_object(fit.H_CD, focus_C),
        H_CD=fit.H_CD,
        spheres=tuple(_finding(view, fit, used, refused, shading, camera) for view in views),
        warnings=tuple([f"{name}: {why}" for name, why in refused.items()] + warnings),
        evidence={
            "source_offset_m": {str(mode): value for mode, value in fit.source_offset_m.items()},
            "outline_bias_px": fit.bias_px,
            "settings": _setting_report(fit, wings),
            "lobe_seen_deg": float(np.degrees(shading.seen_rad)) if shading else None,
            "highlight_rms_px": _rms(list(fit.highlight_px.values())),
        },
    )


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
                lobe=nominal_lobe(wings.wings[k].leds),
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


def _shading(
    fit: GeometryFit,
    views: Sequence[SphereView],
    lights: Sequence[str],
    camera: Camera,
    wings: Wings | None,
    focus_C: Array,
    intensity_sd: float,
) -> ShadingFit | None:
    if not any(view.shading is not None for view in views):
        return None
    samples = sample_blocks(views, fit.centres_C, camera, lights, fit.source_C, _axes(fit, focus_C))
    leds = [None if row is None or wings is None else wings.wings[row].leds for row in fit.wing_of]
    return fit_shading(samples, len(lights), leds, [view.name for view in views], intensity_sd)


def _lights(
    fit: GeometryFit, shading: ShadingFit | None, lights: Sequence[str], wings: Wings | None, focus_C: Array
) -> tuple[tuple[Light, ...], list[str]]:
    found, warnings = [], []
    axes = _axes(fit, focus_C)
    misfit = _rms(list(shading.residual.values())) if shading else float("nan")
    for k, name in enumerate(lights):
        covariance = fit.source_covariance[3 * k : 3 * k + 3, 3 * k : 3 * k + 3]
        row = fit.wing_of[k]
        leds = wings.wings[row].leds if row is not None and wings is not None else None
        H_CL = fit.H_CL[k] if row is not None else _frame_at(fit.source_C[k], axes[k])
        light = Light(
            name=name,
            direction_C=_unit(fit.source_C[k] - focus_C),
            intensity=shading.intensity[k] if shading else np.ones(1),
            H_CL=H_CL,
            source_C=fit.source_C[k],
            axis_C=axes[k],
            lobe=shading.lobes[k] if shading else nominal_lobe(leds),
            position_std_m=_per_axis(_origin_covariance(fit, k) if row is not None else covariance),
            direction_std_rad=float(np.hypot(_direction_std(fit.source_C[k] - focus_C, covariance), DIRECTION_FLOOR_RAD)),
            intensity_std=float(np.hypot(shading.intensity_std[k], misfit)) if shading else float("nan"),
        )
        away = _unit(fit.source_C[k] - focus_C)
        distance_std = float(np.sqrt(away @ covariance @ away)) / float(np.linalg.norm(fit.source_C[k] - focus_C))
        if row is None and distance_std > FAR:
            warnings.append(
                f"{name}: its distance is known to {100 * distance_std:.0f} % only, so it is given as distant: spread the spheres"
            )
            light = replace(light, source_C=None, axis_C=None, H_CL=None, lobe=nominal_lobe(None))
        found.append(light)
    return tuple(found), warnings


def _finding(
    view: SphereView,
    fit: GeometryFit,
    used: Sequence[tuple[SphereView, CentreMeasurement]],
    refused: dict[str, str],
    shading: ShadingFit | None,
    camera: Camera,
) -> SphereFinding:
    names = [one.name for one, _ in used]
    if view.name not in names:
        return SphereFinding(view.name, view.kind, None, view.radius_m, used=False, why=refused.get(view.name))
    centre_C = fit.centres_C[names.index(view.name)]
    directions = {}
    for light, pixel in view.highlights_px.items():
        P, n = sphere.meet(camera.unproject(pixel), centre_C, view.radius_m)
        directions[light] = sphere.reflect(_unit(P), n)
    residual = _rms([px for (name, _), px in fit.highlight_px.items() if name == view.name])
    if view.kind == "matte" and shading:
        residual = shading.residual.get(view.name, float("nan"))
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


def _setting_report(fit: GeometryFit, wings: Wings | None) -> dict[str, object]:
    if wings is None:
        return {}
    names = ("azimuth_deg", "joint_angle_deg", "d1_m", "d2_m")
    scale = np.array([180 / np.pi, 180 / np.pi, 1, 1])
    return {wing.name: dict(zip(names, (fit.settings[k] * scale).tolist(), strict=True)) for k, wing in enumerate(wings.wings)}


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

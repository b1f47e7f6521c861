"""From fits to lights: place, axis, intensity and lobe of each, with their standard deviations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.chain.refine_lights.geometry_fit import SOURCE_OFFSET_M, SOURCE_OFFSET_SIGMA_M, GeometryFit
from lpcal.chain.refine_lights.joint_fit import JointFit
from lpcal.chain.refine_lights.samples import Samples
from lpcal.chain.refine_lights.shading import ShadingFit, Volume, lobe_of_leds
from lpcal.chain.refine_lights.volume import direction_std, level_by_source, shading_by_source, volume_points
from lpcal.geometry import light_field, se3, sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light, LightsSolution, Lobe, Wings

DIRECTION_FLOOR_RAD, LEDS_FLOOR_RAD = float(np.radians(0.03)), float(np.radians(0.02))
"""What a point source cannot follow: the LEDs' gaps move it by 0.02 deg as seen from different places, their scatter to 0.03 in all
(drawn from `residuals`' priors at 0.36 m); and what is left of it once the LEDs are found one by one."""
COMMON_SHARE = 0.5
"""So much of what the blocks are off by is taken as common to all blocks of a light."""
UNSURE = 0.3
"""A free light whose distance is less certain than this share of itself is reported."""


def as_designed(wings: Wings, lights: Sequence[str], intensity_sd: float) -> LightsSolution:
    """The lights as the drawing has them, for a rig without spheres: sources where LightBlobs have theirs, give or take."""
    rows = [k for k, wing in enumerate(wings.wings) if wing.name in lights]
    focus_C = nearest_to_axes(wings.H_CL[rows])
    found = []
    for k in rows:
        H_CL, block = wings.H_CL[k], wings.covariance[6 * k : 6 * k + 6, 6 * k : 6 * k + 6]
        axis_C = H_CL[:3, 2]
        source_C = H_CL[:3, 3] + SOURCE_OFFSET_M * axis_C
        carry = se3.point_jacobian(source_C)
        covariance = carry @ block @ carry.T + SOURCE_OFFSET_SIGMA_M**2 * np.outer(axis_C, axis_C)
        origin = se3.point_jacobian(H_CL[:3, 3])
        found.append(
            Light(
                name=wings.wings[k].name,
                direction_C=unit(source_C - focus_C),
                intensity=np.ones(1),
                H_CL=H_CL,
                source_C=source_C,
                axis_C=axis_C,
                lobe=lobe_of_leds(wings.wings[k].leds) or Lobe(),
                position_std_m=_per_axis(origin @ block @ origin.T),
                direction_std_rad=direction_std(source_C, covariance, volume_points(focus_C)),
                intensity_std=intensity_sd,
            )
        )
    return LightsSolution(
        tuple(found), focus_C, d_object_of(wings.H_CD, focus_C), wings.H_CD, (), ("no spheres: the lights are as designed, not refined",)
    )


def near_lights(
    fit: GeometryFit, lights: Sequence[str], known: Sequence[Lobe | None], focus_C: Array, intensity_sd: float
) -> tuple[list[Light], list[str]]:
    """The lights as the geometry alone has them, each with the lobe that it is known by beforehand; and warnings."""
    found, warnings = [], []
    axes, points_C = _axes(fit, focus_C), volume_points(focus_C)
    for k, name in enumerate(lights):
        covariance, row, away = fit.source_covariance[3 * k : 3 * k + 3, 3 * k : 3 * k + 3], fit.wing_of[k], fit.source_C[k] - focus_C
        light = Light(
            name=name,
            direction_C=unit(away),
            intensity=np.ones(1),
            H_CL=fit.H_CL[k] if row is not None else _frame_at(fit.source_C[k], axes[k]),
            source_C=fit.source_C[k],
            axis_C=axes[k],
            lobe=known[k] or Lobe(),
            position_std_m=_per_axis(se3.origin_covariance(fit.H_CL[k], fit.frame_covariance[k]) if row is not None else covariance),
            direction_std_rad=float(np.hypot(direction_std(fit.source_C[k], covariance, points_C), DIRECTION_FLOOR_RAD)),
            intensity_std=intensity_sd,
        )
        distance_std = float(np.sqrt(unit(away) @ covariance @ unit(away))) / float(np.linalg.norm(away))
        if row is None and distance_std > UNSURE:
            warnings.append(f"{name}: its distance is known to {100 * distance_std:.0f} % only: spread the spheres")
        found.append(light)
    return found, warnings


def shading_volume(lights: Sequence[Light], fit: GeometryFit, samples: Samples, radii_m: Sequence[float], focus_C: Array) -> Volume:
    """The working volume as the near lights see it; `radii_m` (S,) of the spheres."""
    points_C, angles, arounds = volume_points(focus_C), [], []
    for light in lights:
        assert light.source_C is not None
        assert light.axis_C is not None
        assert light.H_CL is not None
        x_L = se3.apply(se3.inv(light.H_CL), points_C)
        angles.append(light_field.near_light(points_C, light.source_C, light.axis_C)[2])
        arounds.append(np.arctan2(x_L[:, 1], x_L[:, 0]))
    places, normals = np.zeros((2, samples.light.size, 3))
    for s in np.unique(samples.sphere):
        own = samples.sphere == s
        places[own], normals[own] = sphere.meet(samples.ray_C[own], fit.centres_C[s], radii_m[s])
    return Volume(
        angle_rad=np.array(angles),
        around_rad=np.array(arounds),
        by_source=level_by_source(fit.source_C[:, None], points_C),
        samples_by_source=shading_by_source(fit.source_C[samples.light], places, normals),
        covariance=fit.source_covariance,
    )


def with_shading(lights: Sequence[Light], shading: ShadingFit) -> list[Light]:
    """The lights with the intensities and lobes of the shading."""
    misfit, std = rms(list(shading.residual.values())), shading.intensity_std if shading.volume_std is None else shading.volume_std
    return [
        replace(
            light,
            intensity=shading.intensity[k],
            lobe=replace(shading.lobes[k], seen_rad=float(shading.seen_rad[k])),
            intensity_std=float(np.hypot(std[k], misfit)),
        )
        for k, light in enumerate(lights)
    ]


def with_leds(joint: JointFit, shading: ShadingFit) -> list[Light]:
    """The lights of the joint fit with the colour of the shading, mean intensity 1."""
    colour = shading.intensity / shading.intensity.mean(axis=1, keepdims=True)
    intensity = np.array([light.intensity[0] for light in joint.lights])[:, None] * colour
    intensity /= intensity.mean()
    misfit = rms(list(joint.shading.values()))
    return [
        replace(
            light,
            intensity=intensity[k],
            lobe=replace(light.lobe, seen_rad=float(shading.seen_rad[k])),
            position_std_m=float(joint.position_std_m[k]),
            direction_std_rad=float(np.hypot(joint.direction_std_rad[k], LEDS_FLOOR_RAD)),
            intensity_std=float(np.hypot(joint.intensity_std[k], COMMON_SHARE * misfit)),
        )
        for k, light in enumerate(joint.lights)
    ]


def leds_of(fit: GeometryFit, k: int, wings: Wings | None) -> int | None:
    """LED mode of a light, None where it is not stated."""
    row = fit.wing_of[k]
    return None if row is None or wings is None else wings.wings[row].leds


def focus_of(fit: GeometryFit, wings: Wings | None) -> Array:
    """Where the wings' axes (nearly) meet; without wings, the middle of the spheres."""
    rows = [k for k, row in enumerate(fit.wing_of) if row is not None]
    return nearest_to_axes(fit.H_CL[rows]) if wings is not None and len(rows) > 1 else np.mean(fit.centres_C, axis=0)


def nearest_to_axes(H_CL: Array) -> Array:
    """The point (3,) nearest to the emission axes of frames (L, 4, 4)."""
    across = np.eye(3) - H_CL[:, :3, 2:3] * H_CL[:, None, :3, 2]
    return np.linalg.lstsq(across.sum(axis=0), np.sum(across @ H_CL[:, :3, 3:], axis=0)[:, 0], rcond=None)[0]


def d_object_of(H_CD: Array | None, focus_C: Array) -> float | None:
    """Distance of the focus from the disc, in metres, or from the camera where there is no disc."""
    return float(np.linalg.norm(focus_C)) if H_CD is None else float(se3.apply(se3.inv(H_CD), focus_C[None])[0, 2])


def _axes(fit: GeometryFit, focus_C: Array) -> Array:
    """Emission axes (L, 3); a free light is taken to face the focus."""
    return np.array([fit.H_CL[k, :3, 2] if row is not None else unit(focus_C - fit.source_C[k]) for k, row in enumerate(fit.wing_of)])


def _frame_at(source_C: Array, axis_C: Array) -> Array:
    """A frame with its origin at a source and its z along an axis, x as near to that of C as can be."""
    x = unit(np.array([1.0, 0.0, 0.0]) - axis_C[0] * axis_C)
    return se3.transform(np.stack([x, np.cross(axis_C, x), axis_C], axis=1), source_C)


def _per_axis(covariance: Array) -> float:
    return float(np.sqrt(np.trace(covariance) / 3))


def unit(v: Array) -> Array:
    """A vector of length 1."""
    return np.asarray(v / np.linalg.norm(v))


def rms(values: list[float]) -> float:
    """Root of the mean square; NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")

r"""Standard deviations of each pixel's normal and depth, and of each piece's distance.

Symbols, degrees per pixel: s the standard deviation due to the samples' variances, chi2 of dof; R the angle between the measured normal and
that of the depth, R5 its rms over 5x5 pixels::

    sigma^2 = sum_i factor_i clue_i^2 + calibration^2

with these indicators for distant light: s max(1, sqrt(chi2 / dof)), s as of INDEPENDENT lights at most; R5; R; whether an edge or a break
is near; whether only three lights were used; whether the normal is filled in; the interreflected light as a share of the direct light; and
the share of the pixel's surroundings that are surfaces hidden from the camera (surface.interreflection). For near light: R, and the
standard deviation that the network states for its normals (surface.normal_prior). The factors are fitted by tools/fit_normal_sigma.py on
simulated scenes. The calibration's part is common to the whole image.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.integration.integrate import Grid
from lpcal.records.calibration import Light
from lpcal.shading.normals import Estimate, interreflected_share
from lpcal.view.constants import RIM_PX
from lpcal.view.pixel_list import Illumination

FACTORS = (0.276, 0.051, 0.324, 1.31, 0.001, 252.0, 0.0045, 0.0083)
"""Factors of the squared indicators in a normal's variance, degrees^2 (dimensionless for angles), in the order of `squares`: fitted by
tools/fit_normal_sigma.py on 200 simulated scenes, the first one fixed from DiLiGenT, as simulated matter follows the model too well."""
NEAR_FACTORS = (0.388, 1.75)
"""The factors for near light, of R and of the network's stated standard deviation: fitted by tools/fit_normal_sigma.py on 70 simulated
scenes outside the network's training set. The samples' noise adds nothing to these two."""
INDEPENDENT = 4.0
"""Largest number of lights that count as independent: deviations of real matter from the model are common to neighbouring lights. From
DiLiGenT's ball and bear, whose normals have the same errors with 10 lights as with 96."""
MM_A_PERCENT = 4.0
"""Error of the distance, mm at WORKING_M, per per cent of relative intensity of one light; typical of panels of this kind."""
WORKING_M = 0.35
CORRELATION = 20.0
BROKEN_OFF = 0.2
"""Standard deviation of a separate piece's log distance, as a share of its log distance to the largest piece: parts of one object are
rarely far apart. tools/fit_distance_sigma.py gives 0.4 on 99 such pieces of 204 simulated scenes, in which truly separate objects are rare;
with half of it the errors are 1.3 standard deviations rms.
"""


@dataclass(frozen=True)
class Indicators:
    """Indicators of errors, a pixel: (P,) each."""

    noise_deg: Array
    """s, per axis, from the samples' variances."""
    misfit: Array
    """chi2 per degree of freedom, 1 where there is none."""
    bend_deg: Array
    """R."""
    bend_round_deg: Array
    """R5."""
    edge: Mask
    used: Array
    filled: Mask
    interreflected: Array
    """Ratio of interreflected to direct light."""
    unseen: Array
    """Share of hidden sides in the pixel's surroundings."""
    expected_deg: Array | None = None
    """Standard deviation that surface.normal_prior states for each normal; None without the network."""


def indicators(
    grid: Grid,
    mask: Mask,
    found: Estimate,
    lit: Illumination,
    normals: Array,
    of_depth: Array,
    whole: Mask,
    expected_rad: Array | None = None,
) -> Indicators:
    """The indicators of each pixel, from the estimate, its normals and those of the depth (P, 3), and the edges (edges,) that hold.

    `expected_rad` (P,) is what surface.normal_prior states of the normals.
    """
    noise, misfit = noise_deg(found, normals)
    unseen = np.zeros(len(normals)) if lit.unseen is None else lit.unseen
    expected_deg = None if expected_rad is None else np.degrees(expected_rad)
    return indicators_of(
        grid, mask, normals, of_depth, whole, noise, misfit, found.used, interreflected_share(lit, found), unseen, expected_deg
    )


def noise_deg(found: Estimate, normals: Array) -> tuple[Array, Array]:
    """Standard deviation (P,) of normals from the samples' variances, degrees per axis, NaN where filled in; reduced chi2 (P,)."""
    filled = ~np.isfinite(found.b[:, 0])
    b = np.where(filled[:, None], normals, found.b)
    albedo = np.maximum(lambert.length(b), 1e-12)
    across = np.eye(3) - normals[:, :, None] * normals[:, None, :]
    covariance = np.nan_to_num(across @ np.nan_to_num(found.covariance) @ across) / albedo[:, None, None] ** 2
    common = np.maximum(found.used / INDEPENDENT, 1.0)
    noise = np.degrees(np.sqrt(common * np.maximum(lambert.trace(covariance) / 2, 0)))
    freedom = found.used - 3
    misfit = np.where(freedom > 0, found.chi2 / np.maximum(freedom, 1), 1.0)
    return np.where(filled, np.nan, noise), misfit


def indicators_of(
    grid: Grid,
    mask: Mask,
    normals: Array,
    of_depth: Array,
    whole: Mask,
    noise: Array,
    misfit: Array,
    used: Array,
    interreflected: Array,
    unseen: Array,
    expected_deg: Array | None = None,
) -> Indicators:
    """The indicators of each pixel, those that come from its samples given."""
    bend = np.degrees(2 * np.arcsin(np.clip(lambert.length(normals - of_depth) / 2, 0, 1)))
    square, inside = np.zeros(mask.shape), mask.astype(float)
    square[mask] = bend**2
    bend_round = np.sqrt(np.maximum(raster.box_filtered(square, 5)[mask], 0) / np.maximum(raster.box_filtered(inside, 5)[mask], 1e-3))
    rim = np.zeros(mask.shape, bool)
    rim[mask] = np.bincount(grid.a[whole], minlength=len(bend)) + np.bincount(grid.b[whole], minlength=len(bend)) < 4
    edge = raster.distance_to(rim)[mask] < RIM_PX
    return Indicators(np.nan_to_num(noise), misfit, bend, bend_round, edge, used, np.isnan(noise), interreflected, unseen, expected_deg)


def squares(found: Indicators) -> Array:
    """The squares of the indicators: (P, 8), or (P, 2) with what surface.normal_prior states."""
    if found.expected_deg is not None:
        return np.stack([found.bend_deg, found.expected_deg], axis=1) ** 2
    noise = found.noise_deg * np.maximum(1, np.sqrt(found.misfit))
    flags = [found.edge, found.used == 3, found.filled]
    return np.stack([noise, found.bend_round_deg, found.bend_deg, *flags, found.interreflected, found.unseen], axis=1) ** 2


def normal_sigma_deg(found: Indicators, calibration_deg: float) -> Array:
    """Standard deviation (P,) of a normal per axis, degrees."""
    factors = FACTORS if found.expected_deg is None else NEAR_FACTORS
    return np.asarray(np.sqrt(squares(found) @ np.array(factors) + calibration_deg**2))


def calibration_deg(lights: Sequence[Light]) -> float:
    """Standard deviation, degrees, common to all normals, from the lights' directions and intensities, averaged over the lights."""
    direction = _mean_square([np.degrees(light.direction_std_rad) for light in lights])
    intensity = _mean_square([np.degrees(light.intensity_std / np.sqrt(2)) for light in lights])
    return float(np.sqrt((direction + intensity) / len(lights)))


def fewer_regions(pixels: int, largest: int) -> float:
    """Factor of a piece's distance error due to the model, relative to that of the largest piece, from their numbers of pixels.

    Errors of the model are correlated over regions of a surface (interreflection, shadows, gloss); a small piece averages over fewer.
    """
    return float(np.sqrt(max(largest / max(pixels, 1), 1.0)))


def scale_std(lights: Sequence[Light], curvature_total: float, distance_m: float, model: float) -> float:
    """Relative standard deviation of the distance of a whole piece, from the calibration, the noise and the `model` error.

    `curvature_total` is that of the piece's log distance.
    """
    intensity_percent = 100 * np.sqrt(_mean_square([light.intensity_std for light in lights]))
    direction = _mean_square([np.degrees(light.direction_std_rad) for light in lights])
    calibration_m = 1e-3 * (distance_m / WORKING_M) ** 2 * np.sqrt((MM_A_PERCENT * intensity_percent) ** 2 + 100 * direction)
    return float(np.sqrt((calibration_m / distance_m) ** 2 + model**2 + 1 / max(curvature_total, 1.0)))


def depth_sigma(grid: Grid, sigma_deg: Array, towards: Array, plane: Array, scale: Array, label: Labels) -> Array:
    """Standard deviation (P,) of the depth relative to its piece, from accumulated step errors, in units of `scale` times those of `plane`.

    `towards` (P,) is the cosine between normal and viewer, `plane` (P, 2) the pixels' positions at depth 1, `scale` (P,) their depth.
    Errors of normals are correlated over CORRELATION pixels, so over a path of N pixels a step's error grows as sqrt(N CORRELATION). The
    path runs from the pixel to the centre of its piece, and counts half, as the rest of the piece constrains it.
    """
    pixel = float(np.median(np.linalg.norm(plane[grid.b] - plane[grid.a], axis=1))) if len(grid.a) else 1.0
    sigma = np.zeros(len(plane))
    for one in np.unique(label):
        inside = label == one
        path = np.maximum(np.linalg.norm(plane[inside] - np.median(plane[inside], axis=0), axis=1) / pixel, 1) / 2
        typical = np.radians(float(np.median(sigma_deg[inside])))
        local = np.radians(np.minimum(sigma_deg[inside], 30)) / np.maximum(towards[inside], 0.1) ** 2
        sigma[inside] = (typical * np.sqrt(path * CORRELATION) + local) * pixel * scale[inside]
    return sigma


def _mean_square(values: Sequence[float]) -> float:
    known = [value for value in values if np.isfinite(value)]
    return float(np.mean(np.square(known))) if known else 0.0

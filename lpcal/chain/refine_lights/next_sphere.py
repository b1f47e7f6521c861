r"""Where to put the next chrome sphere: spheres are put all over the picture, in thought, and the one that would tell the most is named.

Symbols: sources s with joint covariance S; a sphere at c, its centre measured by its outline with covariance S_c; highlights h(s, c) with
standard deviation sigma::

    A = dh/ds / sigma,  B = dh/dc / sigma,   S_new = [S^-1 + A^T A - A^T B (B^T B + S_c^-1)^-1 B^T A]^-1

The gain is what it does to the mean standard deviation of the directions from the focus to the lights. Source: sequential I-optimal design,
Pukelsheim 1993.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from lpcal.chain.refine_lights.measure import measure_centre
from lpcal.errors import DegenerateError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera
from lpcal.records.observations import SphereView

PLACES = {"left": -0.55, "": 0.0, "right": 0.55}
HEIGHTS = {"top": -0.55, "": 0.0, "bottom": 0.55}
"""Of the sphere's middle, in half image sides."""
DISTANCES = (0.8, 1.0, 1.2)
"""Over that of the focus."""
MARGIN_PX = 8
HIGHLIGHT_PX, OUTLINE_PX, COMMON_BIAS_PX = 0.015, 0.05, 0.05
"""Of a highlight, of a point of the outline, and what is left of the bias that all chrome outlines share."""
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
    """What a sphere at a place tells of the sources, (3 L, 3 L); None where it is not whole in the picture."""
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

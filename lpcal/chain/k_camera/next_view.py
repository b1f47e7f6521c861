"""Where to hold the board next: boards are put all over the image, in thought, and the one that would tell the most is named.

Symbols: S the views' information, S_v that of a board put at H_CB; the gain of v is the ratio of the mean sigmas, over the imager where the
lens means something, that ``S + S_v`` and ``S`` leave. Source: sequential D- and I-optimal design, Pukelsheim 1993.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from lpcal.chain.k_camera.assess import Information, judged_pixels, mean_sigma, ray_slope, worst_direction
from lpcal.chain.k_camera.bundle import view_information
from lpcal.chain.k_camera.problem import CameraFit
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera_difference import pixel_grid

PLACES = {"at the left": -0.6, "in the middle": 0.0, "at the right": 0.6}
HEIGHTS = {"top": -0.6, "middle": 0.0, "bottom": 0.6}
"""Of the board's middle, in half image sides."""
SENSIBLE = 30.0
"""Beyond the corners' hull a place counts where its sigma is under so many times the median within: above, the lens means nothing there."""
WORTH_SAYING = 0.98
"""A view that leaves more than this share of the sigma is not worth its trouble."""
TILT_RAD = np.radians(35.0)
TILTS = {
    "facing the camera": (0.0, 0.0),
    "its right edge turned away by 35 degrees": (0.0, -1.0),
    "its left edge turned away by 35 degrees": (0.0, 1.0),
    "its top edge turned away by 35 degrees": (-1.0, 0.0),
    "its bottom edge turned away by 35 degrees": (1.0, 0.0),
}
SIZES = (0.35, 0.55, 0.8)
"""Of the board's longer side, in units of the image's width."""
LEAST_SEEN = 1.0
"""Share of the corners that must be in the image."""


@dataclass(frozen=True)
class BoardAdvice:
    """A view to add, in words, and the mean sigma over the imager before and after."""

    words: str
    before_px: float
    after_px: float


def advise(known: Information, fit: CameraFit) -> BoardAdvice | None:
    """The best of the views thought of; None where none of them has the board in the image."""
    pixels = pixel_grid(fit.camera.image_size, 12, 8)
    judged = judged_pixels(pixels, fit)
    if not judged.any():
        return None
    slope = ray_slope(known, pixels, fit, judged)
    total = known.views.sum(axis=0)
    worst = worst_direction(slope, known.covariance(total))
    slope = slope[judged | (worst < SENSIBLE * np.median(worst[judged]))]
    before = mean_sigma(slope, known.covariance(total))
    found: list[BoardAdvice] = []
    for (place, x), (height, y), (tilt, turn), size in product(PLACES.items(), HEIGHTS.items(), TILTS.items(), SIZES):
        more = _information_of(known, fit, _pose(fit, (x, y), turn, size))
        if more is not None:
            after = mean_sigma(slope, known.covariance(total + more))
            found.append(BoardAdvice(f"{_where(place, height)}, {tilt}, about {100 * size:.0f} % of the image's width long", before, after))
    return min(found, key=lambda one: one.after_px, default=None)


def _where(place: str, height: str) -> str:
    if height == "middle":
        return place
    return f"at the {height}" if place == "in the middle" else f"{place.replace('at the', f'at the {height}')}"


def _pose(fit: CameraFit, place: tuple[float, float], turn: tuple[float, float], size: float) -> Array:
    """H_CB of a board whose middle is seen at a place of the image."""
    width, height = fit.camera.image_size
    middle_B = fit.points_B.mean(axis=0)
    length_m = float(np.ptp(fit.points_B[:, :2], axis=0).max())
    distance_m = fit.camera.K[0, 0] * length_m / (size * width)
    pixel = np.array([(1 + place[0]) * (width - 1) / 2, (1 + place[1]) * (height - 1) / 2])
    ray_C = fit.camera.unproject(pixel[None])[0]
    R_CB = se3.rotation(TILT_RAD * np.array([turn[0], turn[1], 0.0]))
    return se3.transform(R_CB, distance_m * ray_C / ray_C[2] - R_CB @ middle_B)


def _information_of(known: Information, fit: CameraFit, H_CB: Array) -> Array | None:
    x_C = se3.apply(H_CB, fit.points_B)
    if np.any(x_C[:, 2] <= 0):
        return None
    corners_px = fit.camera.project(x_C)
    seen = np.all((corners_px > 4) & (corners_px < np.array(fit.camera.image_size) - 5), axis=1)
    if seen.mean() < LEAST_SEEN:
        return None
    bundle = replace(known.bundle, corners_px=corners_px[None])
    return np.asarray(view_information(bundle, replace(known.state, H_CB=H_CB[None]), seen[None])[0][0])

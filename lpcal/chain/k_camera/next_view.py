"""Where to hold the board next: boards are put all over the image, in simulation, and the one that would add the most is named.

Symbols: S the views' information, S_v that of a board put at H_CB; the gain of v is the ratio of the mean sigmas, over the imager where the
lens means something, that ``S + S_v`` and ``S`` leave. Source: sequential D- and I-optimal design, Pukelsheim 1993.

Whether the views of the board differ enough to determine a camera: what they lack is reported of them, not of the board.

Symbols: view k, its corners on the plane z = 1 by the camera found, or by one of the image's width as focal length where none was; the
homography G_k from the board to that plane; the board's tilt, from its perspective, as a vector in the image ::

    G ~ [a b c] with c_3 = 1,  m the length of a unit of the board there:   tilt_k = (a_3 x + b_3 y) / m,    x, y unit vectors along a, b

Planes that are parallel to each other say as much of a camera as one of them. Source: Zhang 2000, section 3.3 (degenerate configurations).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from lpcal.chain.k_camera.assess import Information, judged_pixels, mean_sigma, ray_slope, worst_direction
from lpcal.chain.k_camera.bundle import view_information
from lpcal.chain.k_camera.problem import CameraFit, CornerProblem
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera_difference import pixel_grid
from lpcal.geometry.hull import inside_hull
from lpcal.records.calibration import Camera

PLACES = {"at the left": -0.6, "in the middle": 0.0, "at the right": 0.6}
HEIGHTS = {"top": -0.6, "middle": 0.0, "bottom": 0.6}
"""Places of the board's middle that are proposed, in half image sides."""
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
"""Lengths of the board's longer side that are proposed, in units of the image's width."""
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


ALIKE_RAD = np.radians(5.0)
"""Boards whose tilts differ by less are of one plane: corners of 0.1 px show a tilt to a degree or so."""
FEWEST_TILTS = 3
"""Planes of so many tilts determine a camera, two with nothing to spare."""
SAME_SHARE = 0.02
"""Corners that lie this near to those of another view, in units of the image's width, are of one pose of the board."""
SMALL_SHARE = 0.15
"""Share of the imager that the corners of all views must cover."""
TODO = "tilt the board by 20 to 45 degrees, about both of its axes, and hold it all over the image"
GRID = (24, 18)


def monotony(problem: CornerProblem, camera: Camera | None) -> str | None:
    """What the views have too much in common, in words; None where they differ enough."""
    seen = np.isfinite(problem.corners_px).all(axis=-1)
    tilts = np.array([_tilt(px, mask, problem, camera) for px, mask in zip(problem.corners_px, seen, strict=True)])
    count = len(tilts)
    poses = _kinds(
        np.nan_to_num(problem.corners_px).reshape(count, -1), SAME_SHARE * problem.image_size[0] * np.sqrt(seen.sum(axis=1).max())
    )
    if poses == 1:
        return f"all {count} views show the board in one pose: move and tilt it"
    apart = float(np.degrees(np.linalg.norm(tilts - np.median(tilts, axis=0), axis=1).max()))
    kinds = _kinds(tilts, ALIKE_RAD)
    if kinds == 1:
        return f"all {count} views are within {max(1, np.ceil(apart)):.0f} deg of one plane: tilt the board"
    if kinds < FEWEST_TILTS:
        return f"the {count} views show the board at {kinds} tilts only: tilt it about both of its axes"
    if poses < FEWEST_TILTS:
        return f"the {count} views show the board in {poses} poses only: move and tilt it"
    width, height = problem.image_size
    grid = np.stack(np.meshgrid(np.linspace(0, width, GRID[0]), np.linspace(0, height, GRID[1])), axis=-1).reshape(-1, 2)
    share = float(inside_hull(grid, problem.corners_px[seen]).mean())
    if share < SMALL_SHARE:
        middle = problem.corners_px[seen].mean(axis=0)
        side = ("left", "middle", "right")[int(np.clip(3 * middle[0] / width, 0, 2))]
        level = ("top", "middle", "bottom")[int(np.clip(3 * middle[1] / height, 0, 2))]
        place = side if level == "middle" else level if side == "middle" else f"{level} {side}"
        return f"the board is always at the {place}, over {100 * share:.0f} % of the image: hold it all over the image"
    return None


def _tilt(corners_px: Array, seen: Array, problem: CornerProblem, camera: Camera | None) -> Array:
    """The tilt (2,) of one board, in rad, as a vector in the image."""
    import cv2

    if camera is None:
        width, height = problem.image_size
        plane = (corners_px[seen] - np.array([width - 1, height - 1]) / 2) / width
    else:
        rays_C = camera.unproject(corners_px[seen])
        plane = rays_C[:, :2] / rays_C[:, 2:]
    points = problem.board.points_B()[:, :2]
    middle = points.mean(axis=0)
    G = cv2.findHomography(points[seen] - middle, plane, 0)[0]
    if G is None or not np.isfinite(G).all():
        return np.zeros(2)
    G = G / G[2, 2]
    spot = G[:2, 2]
    along, across = G[:2, 0] - spot * G[2, 0], G[:2, 1] - spot * G[2, 1]
    length = max(np.linalg.norm(along), np.linalg.norm(across))
    x, y = along / np.linalg.norm(along), across / np.linalg.norm(across)
    return np.asarray(np.clip((G[2, 0] * x + G[2, 1] * y) / length, -1.5, 1.5))


def _kinds(rows: Array, near: float) -> int:
    """How many of the rows (N, D) are further than a distance from all that were counted before."""
    kept: list[Array] = []
    for row in rows:
        if all(np.linalg.norm(row - other) > near for other in kept):
            kept.append(row)
    return len(kept)

"""Whether the views of the board differ enough to tell a camera: what they lack is said of them, and not of the board.

Symbols: view k, its corners on the plane z = 1 by the camera found, or by one of the image's width as focal length where none was; the
homography G_k from the board to that plane; the board's tilt, from its perspective, as a vector in the image ::

    G ~ [a b c] with c_3 = 1,  m the length of a unit of the board there:   tilt_k = (a_3 x + b_3 y) / m,    x, y unit vectors along a, b

Planes that are parallel to each other say as much of a camera as one of them. Source: Zhang 2000, section 3.3 (degenerate configurations).
"""

from __future__ import annotations

import numpy as np

from lpcal.chain.k_camera.problem import CornerProblem
from lpcal.geometry.arrays import Array
from lpcal.geometry.hull import inside_hull
from lpcal.records.calibration import Camera

ALIKE_RAD = np.radians(5.0)
"""Boards whose tilts differ by less are of one plane: corners of 0.1 px tell a tilt to a degree or so."""
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

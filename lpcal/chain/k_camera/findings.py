"""What is worth knowing of a camera that was solved, in figures for camera.yaml and in words.

How sure it is where, what the views cover, which of them matter, where to hold the board next, and what the residuals show that is not
modelled. See `assess`, `next_view`, `patterns`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from lpcal.chain.k_camera import patterns
from lpcal.chain.k_camera.assess import Sureness, assess, assess_spline, information
from lpcal.chain.k_camera.free_board import check_with_free_board
from lpcal.chain.k_camera.independent import check
from lpcal.chain.k_camera.next_view import WORTH_SAYING, advise
from lpcal.chain.k_camera.problem import CameraFit, CornerProblem
from lpcal.geometry import se3
from lpcal.records.evidence import (
    CameraEvidence,
    Coverage,
    NextView,
    OtherSolver,
    ProjectionUncertainty,
    ResidualPattern,
    ViewThatMatters,
)
from lpcal.records.observations import BoardView

CELLS = (6, 4)
"""Of the image, in which corners are counted."""
MOST_NAMED = 5
MUCH_BLUR, LEAST_BLUR_PX, MUCH_GLARE = 2.0, 1.5, 0.03
"""A view is blurred over so many times the usual blur and so many px; it shines where more than this share of the board is white."""
USUAL_SQUARE_M = (0.002, 0.25)
UNEVEN_SHARE, UNEVEN_SIGMAS = 0.6, 2.0
"""A board is called uneven where its corners are off by this share of a corner's sigma, or move the camera by so many of its sigmas."""
FLAT_TILT_DEG = 15.0
"""Boards tilted less than this about an axis leave the focal length to chance."""


def findings(problem: CornerProblem, fit: CameraFit, names: Sequence[str], *, blame_board: bool = True) -> tuple[CameraEvidence, list[str]]:
    """Figures for camera.yaml, and warnings; `names` are those of the problem's views.

    Nothing is said of the board where `blame_board` is false: views that are too much alike cannot tell its shape from the lens.
    """
    on_board, on_image = patterns.on_board(fit), patterns.on_image(fit)
    left = {where: ResidualPattern(size_px=one.size_px, z=one.z) for where, one in (("board", on_board), ("image", on_image))}
    figures = CameraEvidence(coverage=_coverage(fit), residual_pattern=left)
    warnings = [*_unmodelled(on_board, on_image, fit, blame_board), *_odd_size(problem, fit)]
    if fit.uncertainty is not None:
        return replace(figures, projection_uncertainty=_uncertainty(assess_spline(fit))), warnings
    if fit.camera.covariance is None:
        return figures, warnings
    known = information(problem, fit)
    sure, free, advice = assess(known, fit), check_with_free_board(problem, fit), advise(known, fit)
    warnings += _uneven(free, sure, fit) if blame_board and free is not None else []
    order = np.argsort(-sure.gain)[:MOST_NAMED]
    worth = advice is not None and advice.after_px < WORTH_SAYING * advice.before_px
    figures = replace(
        figures,
        projection_uncertainty=_uncertainty(sure),
        independent_check=check(problem, fit),
        free_board_check=free,
        views_that_matter=tuple(ViewThatMatters(image=names[row], without_it=float(sure.gain[row])) for row in order),
        next_view=NextView(hold_the_board=advice.words, std_now_px=advice.before_px, std_then_px=advice.after_px)
        if advice is not None and worth
        else None,
    )
    return figures, warnings


def _uneven(free: OtherSolver, sure: Sureness, fit: CameraFit) -> list[str]:
    """A word where freeing the board's corners explains much of what is left, or moves the camera by more than its sigma allows."""
    apart_px, off_m = free.difference_rms_px, free.board_off_rms_m
    if apart_px is None or off_m is None or not sure.covered.any():
        return []
    off_px = off_m * fit.camera.K[0, 0] / float(np.median(fit.H_CB[:, 2, 3]))
    said_px = float(np.sqrt(np.mean(sure.worst_px[sure.covered] ** 2)))
    if off_px < UNEVEN_SHARE * fit.sigma_px and apart_px < UNEVEN_SIGMAS * said_px:
        return []
    return [
        f"the board's corners lie {1e3 * off_m:.2g} mm rms from where its shape says, and with them free the camera is "
        f"{apart_px:.2g} px apart (its sigma there is {said_px:.2g} px): print on a stiff board, or have one made"
    ]


def _odd_size(problem: CornerProblem, fit: CameraFit) -> list[str]:
    """A word on a board of a size that none is made in: the images alone cannot tell it."""
    square_m = float(np.mean(problem.board.square_m))
    if USUAL_SQUARE_M[0] <= square_m <= USUAL_SQUARE_M[1]:
        return []
    distance_m = float(np.median(np.linalg.norm(fit.H_CB[:, :3, 3], axis=-1)))
    return [
        f"squares of {1e3 * square_m:.4g} mm put the board {distance_m:.3g} m away: is board.square right? "
        f"Off by 25.4 (inches for millimetres) they would be {1e3 * square_m / 25.4:.3g} or {1e3 * square_m * 25.4:.3g} mm. "
        "The lens does not depend on it, every length does"
    ]


def _uncertainty(sure: Sureness) -> ProjectionUncertainty:
    inside = sure.worst_px[sure.covered] if sure.covered.any() else sure.worst_px
    return ProjectionUncertainty(
        of="one standard deviation in its worst direction, at infinity, a turn of the camera taken out; rms and most where corners are",
        columns_px=sure.pixels[0, :, 0],
        rows_px=sure.pixels[:, 0, 1],
        worst_direction_std_px=np.round(sure.worst_px, 5),
        rms_px=float(np.sqrt(np.mean(inside**2))),
        most_px=float(inside.max()),
        covered_share=float(sure.covered.mean()),
        covered=sure.covered,
        trusted=sure.trusted,
        trusted_share=float(sure.trusted.mean()),
    )


def _coverage(fit: CameraFit) -> Coverage:
    """Corners in each cell of the image, and the boards' tilts, rolls and distances."""
    places = fit.camera.project(se3.apply(fit.H_CB, fit.points_B))[fit.inlier]
    size = fit.camera.image_size
    counts = np.histogram2d(places[:, 1], places[:, 0], bins=CELLS[::-1], range=[[0, size[1]], [0, size[0]]])[0].astype(int)
    normal = fit.H_CB[:, :3, 2]
    towards = normal * np.sign(normal[:, 2:])
    about_x, about_y = np.degrees(np.arctan2(-towards[:, 1], towards[:, 2])), np.degrees(np.arctan2(towards[:, 0], towards[:, 2]))
    roll = np.degrees(np.arctan2(fit.H_CB[:, 1, 0], fit.H_CB[:, 0, 0]))
    middle = se3.apply(fit.H_CB, np.broadcast_to(fit.points_B.mean(axis=0), (len(fit.H_CB), 1, 3)))[:, 0]
    distance = np.linalg.norm(middle, axis=-1)
    return Coverage(
        corners_in_cells=counts,
        empty_cells=int((counts == 0).sum()),
        tilt_about_x_deg=(float(about_x.min()), float(about_x.max())),
        tilt_about_y_deg=(float(about_y.min()), float(about_y.max())),
        roll_deg=(float(roll.min()), float(roll.max())),
        distance_m=(float(distance.min()), float(distance.max())),
        in_words=_in_words(counts, about_x, about_y),
    )


def _in_words(counts: Any, about_x: Any, about_y: Any) -> str:
    parts = []
    empty = counts == 0
    if empty.any():
        rows = np.array_split(np.arange(counts.shape[0]), 2)
        columns = np.array_split(np.arange(counts.shape[1]), 2)
        quarters = {
            f"{v} {h}": empty[np.ix_(r, c)].mean()
            for v, r in zip(("top", "bottom"), rows, strict=True)
            for h, c in zip(("left", "right"), columns, strict=True)
        }
        bare = max(quarters, key=lambda name: float(quarters[name]))
        parts.append(f"no corner in {int(empty.sum())} of {empty.size} parts of the image, most of them at the {bare}")
    else:
        parts.append("corners in every part of the image")
    for axis, angles in (("its horizontal axis", about_x), ("its vertical axis", about_y)):
        if np.abs(angles).max() < FLAT_TILT_DEG:
            parts.append(f"the board was never tilted by more than {np.abs(angles).max():.0f} degrees about {axis}")
    return "; ".join(parts)


def _unmodelled(on_board: patterns.Pattern, on_image: patterns.Pattern, fit: CameraFit, blame_board: bool) -> list[str]:
    said = []
    if blame_board and on_board.seen(fit.sigma_px):
        allowed = "its bow, twist and cubic terms" if fit.board not in {"flat", "bowed"} else f"a {fit.board} board"
        said.append(
            f"the residuals keep a pattern of {on_board.size_px:.3f} px on the board that {allowed} cannot explain: "
            "it is bent in another way, or printed unevenly; a stiffer board (glass, aluminium) would help"
        )
    if on_image.seen(fit.sigma_px):
        richer = "a richer lens (model: opencv8 or splined) may" if fit.camera.spline is None else "the lens bends within a knot's distance"
        said.append(
            f"the residuals keep a pattern of {on_image.size_px:.3f} px in the image that {fit.camera.model} cannot explain: {richer}"
        )
    return said


def blurred_or_glaring(views: Sequence[BoardView]) -> list[str]:
    """A word on the views whose board is much more blurred than usual, or shines."""
    found = [view for view in views if view.corners_px is not None and np.isfinite(view.blur_px)]
    usual = float(np.median([view.blur_px for view in found])) if found else float("nan")
    blurred = [view.image for view in found if view.blur_px > max(MUCH_BLUR * usual, LEAST_BLUR_PX)]
    glaring = [view.image for view in found if view.glare > MUCH_GLARE]
    said = [f"blurred more than the others (usually {usual:.1f} px): {_named(blurred)}"] if blurred else []
    return said + ([f"the board shines, over {100 * MUCH_GLARE:.0f} % of it is at white: {_named(glaring)}"] if glaring else [])


def _named(images: Sequence[str]) -> str:
    more = f" and {len(images) - MOST_NAMED} more" if len(images) > MOST_NAMED else ""
    return ", ".join(images[:MOST_NAMED]) + more

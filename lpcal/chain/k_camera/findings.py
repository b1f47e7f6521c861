"""What is worth knowing of a camera that was solved, in figures for camera.yaml and in words.

How sure it is where, what the views cover, which of them matter, where to hold the board next, and what the residuals show that is not
modelled. See `assess`, `next_view`, `patterns`.

The same corners by COLMAP's bundle adjustment, in which every corner of the board is a free point of space.

It knows no shape of a board, shares no code with the solve, and so shows the effect of a board that is printed or bent in a way that no
smooth shape follows: the camera moves, and the points found lie off the board's. Two cameras hold the frame and its scale, which moves no
lens. COLMAP's first pixel is centred at (0.5, 0.5). Source: COLMAP (pycolmap), bundle adjustment; Strobl & Hirzinger 2011 (imperfect
boards).

The same corners by another's adjustment: OpenCV's calibrateCamera, from lpcal's solution, on lpcal's board and inliers.

It shares neither code nor priors with mrcal or with `bundle`; what it is apart from them, against the uncertainty that is said, is the
check. Source: OpenCV, calib3d; the difference: `geometry.camera_difference`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.chain.k_camera import patterns
from lpcal.chain.k_camera.assess import Sureness, assess, assess_spline, information, judged_pixels
from lpcal.chain.k_camera.next_view import WORTH_SAYING, advise
from lpcal.chain.k_camera.problem import DIGITS, DISTORTIONS, CameraFit, CornerProblem
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.geometry.colmap import load_pycolmap
from lpcal.geometry.rigid_fit import fit as rigid_fit
from lpcal.records.camera import Camera
from lpcal.records.evidence import CameraEvidence, Coverage, NextView, OtherSolver, ProjectionUncertainty, ResidualPattern, ViewThatMatters
from lpcal.records.observations import BoardView

CELLS = (6, 4)
"""Columns and rows of the image's cells in which corners are counted."""
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

    Nothing is reported of the board where `blame_board` is false: views that are too much alike cannot separate its shape from the lens.
    """
    on_board, on_image = patterns.on_board(fit), patterns.on_image(fit)
    left = {where: ResidualPattern(size_px=one.size_px, z=one.z) for where, one in (("board", on_board), ("image", on_image))}
    figures = CameraEvidence(coverage=_coverage(fit), residual_pattern=left)
    warnings = [*_changed(patterns.change(fit), names), *_unmodelled(on_board, on_image, fit, blame_board), *_odd_size(problem, fit)]
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
        independent_check=check_by_opencv(problem, fit),
        free_board_check=free,
        views_that_matter=tuple(ViewThatMatters(image=names[row], without_it=float(sure.gain[row])) for row in order),
        next_view=NextView(hold_the_board=advice.words, std_now_px=advice.before_px, std_then_px=advice.after_px)
        if advice is not None and worth
        else None,
    )
    return figures, warnings


def _uneven(free: OtherSolver, sure: Sureness, fit: CameraFit) -> list[str]:
    """A warning where freeing the board's corners explains much of what is left, or moves the camera by more than its sigma allows."""
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


def _changed(found: patterns.Change | None, names: Sequence[str]) -> list[str]:
    """A warning where the views before and after one of them are of two cameras."""
    if found is None or not found.seen:
        return []
    x, y = found.centre_px
    return [
        f"from {names[found.view]} on the camera is another: its focal length by {100 * found.focal_share:+.2g} %, its centre by "
        f"({x:+.1f}, {y:+.1f}) px: was its zoom, focus or lens moved? Calibrate by views of one setting, that of the captures"
    ]


def _odd_size(problem: CornerProblem, fit: CameraFit) -> list[str]:
    """A warning about a board of a size that none is made in: the images alone do not show it."""
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
    """A warning about the views whose board is much more blurred than usual, or shines."""
    found = [view for view in views if view.corners_px is not None and np.isfinite(view.blur_px)]
    usual = float(np.median([view.blur_px for view in found])) if found else float("nan")
    blurred = [view.image for view in found if view.blur_px > max(MUCH_BLUR * usual, LEAST_BLUR_PX)]
    glaring = [view.image for view in found if view.glare > MUCH_GLARE]
    said = [f"blurred more than the others (usually {usual:.1f} px): {_named(blurred)}"] if blurred else []
    return said + ([f"the board shines, over {100 * MUCH_GLARE:.0f} % of it is at white: {_named(glaring)}"] if glaring else [])


def _named(images: Sequence[str]) -> str:
    more = f" and {len(images) - MOST_NAMED} more" if len(images) > MOST_NAMED else ""
    return ", ".join(images[:MOST_NAMED]) + more


BY = "COLMAP bundle adjustment, every corner of the board free"
"""Who checks."""

MODELS = {"opencv4": "OPENCV", "opencv8": "FULL_OPENCV"}
"""COLMAP's names of the lenses that it shares with lpcal."""
HALF_PIXEL = 0.5
MOST_STEPS, STOP = 300, 1e-12
FEWEST_SEEN = 3
"""A corner seen in fewer views than this stays out."""


def check_with_free_board(problem: CornerProblem, fit: CameraFit) -> OtherSolver | None:
    """How far COLMAP's camera projects from the fit's, where corners are, and its points from the board's; None for other lenses."""
    if fit.camera.model not in MODELS or find_spec("pycolmap") is None:
        return None
    kept = np.flatnonzero(fit.inlier.sum(axis=0) >= FEWEST_SEEN)
    try:
        camera, points_B = _adjusted(problem, fit, kept)
    except (RuntimeError, ValueError) as error:
        return OtherSolver(by=BY, failed=str(error).strip().splitlines()[0])
    pixels = pixel_grid(problem.image_size)
    pixels = pixels[judged_pixels(pixels, fit)]
    if not len(pixels):
        return None
    apart = np.linalg.norm(projection_difference(pixels, fit.camera.unproject(pixels), camera.project)[0], axis=1)
    scale = np.linalg.norm(fit.points_B[kept] - fit.points_B[kept].mean(axis=0)) / np.linalg.norm(points_B - points_B.mean(axis=0))
    off_m = rigid_fit(fit.points_B[kept], scale * points_B)[2]
    return OtherSolver(
        by=BY,
        f_px=(round(float(camera.K[0, 0]), DIGITS), round(float(camera.K[1, 1]), DIGITS)),
        c_px=(round(float(camera.K[0, 2]), DIGITS), round(float(camera.K[1, 2]), DIGITS)),
        difference_rms_px=round(float(np.sqrt(np.mean(apart**2))), DIGITS),
        difference_worst_px=round(float(apart.max()), DIGITS),
        board_off_rms_m=round(float(np.sqrt(np.mean(off_m**2))), DIGITS + 3),
    )


def _adjusted(problem: CornerProblem, fit: CameraFit, kept: npt.NDArray[np.intp]) -> tuple[Camera, Array]:
    """COLMAP's camera and its points (M, 3) of the board."""
    pycolmap = load_pycolmap()
    K, (width, height) = fit.camera.K, problem.image_size
    core = [K[0, 0], K[1, 1], K[0, 2] + HALF_PIXEL, K[1, 2] + HALF_PIXEL]
    scene = pycolmap.Reconstruction()
    scene.add_camera_with_trivial_rig(
        pycolmap.Camera(camera_id=1, model=MODELS[fit.camera.model], width=width, height=height, params=[*core, *fit.camera.distortion])
    )
    ids = [scene.add_point3D(fit.points_B[m], pycolmap.Track()) for m in kept]
    setup = pycolmap.BundleAdjustmentConfig()
    for image, (H_CB, corners_px, inlier) in enumerate(zip(fit.H_CB, problem.corners_px, fit.inlier, strict=True), start=1):
        rows = np.flatnonzero(inlier[kept])
        seen = pycolmap.Image(name=str(image), keypoints=corners_px[kept[rows]] + HALF_PIXEL, camera_id=1, image_id=image)
        scene.add_image_with_trivial_frame(seen, pycolmap.Rigid3d(pycolmap.Rotation3d(H_CB[:3, :3]), H_CB[:3, 3]))
        for place, row in enumerate(rows):
            scene.add_observation(ids[row], pycolmap.TrackElement(image, place))
        setup.add_image(image)
    setup.fix_gauge(pycolmap.BundleAdjustmentGauge.TWO_CAMS_FROM_WORLD)
    pycolmap.logging.minloglevel = pycolmap.logging.Level.ERROR.value
    options = pycolmap.BundleAdjustmentOptions(refine_principal_point=True, print_summary=False)
    solver = options.ceres.solver_options
    solver.max_num_iterations, solver.function_tolerance = MOST_STEPS, STOP
    pycolmap.create_default_bundle_adjuster(options, setup, scene).solve()
    found = np.asarray(scene.cameras[1].params)
    K = np.array([[found[0], 0, found[2] - HALF_PIXEL], [0, found[1], found[3] - HALF_PIXEL], [0, 0, 1.0]])
    camera = Camera(problem.image_size, fit.camera.model, K, found[4:])
    return camera, np.array([scene.points3D[one].xyz for one in ids])


CHECKED_BY = "OpenCV calibrateCamera"
"""Who checks."""

CHECKED_TO = (30, 1e-9)


def check_by_opencv(problem: CornerProblem, fit: CameraFit) -> OtherSolver | None:
    """How far OpenCV's camera projects from the fit's, where corners are; None for lenses that it does not know."""
    import cv2

    if fit.camera.model not in DISTORTIONS:
        return None
    flags = cv2.CALIB_USE_INTRINSIC_GUESS
    flags |= {"opencv4": cv2.CALIB_FIX_K3, "opencv8": cv2.CALIB_RATIONAL_MODEL}.get(fit.camera.model, 0)
    points = [fit.points_B[used].astype(np.float32) for used in fit.inlier if used.any()]
    corners = [px[used].astype(np.float32) for px, used in zip(problem.corners_px, fit.inlier, strict=True) if used.any()]
    start = np.zeros(max(5, fit.camera.distortion.size))
    start[: fit.camera.distortion.size] = fit.camera.distortion
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, *CHECKED_TO)
    try:
        _, K, distortion, *_ = cv2.calibrateCamera(
            points, corners, problem.image_size, fit.camera.K.copy(), start, flags=flags, criteria=criteria
        )
    except cv2.error as error:
        return OtherSolver(by=CHECKED_BY, failed=str(error).strip().splitlines()[-1])
    other = Camera(problem.image_size, fit.camera.model, np.asarray(K, dtype=float), np.ravel(distortion)[: fit.camera.distortion.size])
    pixels = pixel_grid(problem.image_size)
    pixels = pixels[judged_pixels(pixels, fit)]
    if not len(pixels):
        return None
    apart = np.linalg.norm(projection_difference(pixels, fit.camera.unproject(pixels), other.project)[0], axis=1)
    return OtherSolver(
        by=CHECKED_BY,
        f_px=(round(float(K[0, 0]), DIGITS), round(float(K[1, 1]), DIGITS)),
        c_px=(round(float(K[0, 2]), DIGITS), round(float(K[1, 2]), DIGITS)),
        difference_rms_px=round(float(np.sqrt(np.mean(apart**2))), DIGITS),
        difference_worst_px=round(float(apart.max()), DIGITS),
    )

"""The same corners by COLMAP's bundle adjustment, in which every corner of the board is a free point of space.

It knows no shape of a board, shares no code with the solve, and so tells what a board costs that is printed or bent in a way that no
smooth shape follows: the camera moves, and the points found lie off the board's. Two cameras hold the frame and its scale, which moves no
lens. COLMAP's first pixel is centred at (0.5, 0.5).
Source: COLMAP (pycolmap), bundle adjustment; Strobl & Hirzinger 2011 (imperfect boards).
"""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
import numpy.typing as npt

from lpcal.chain.k_camera.assess import judged_pixels
from lpcal.chain.k_camera.problem import DIGITS, CameraFit, CornerProblem
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.geometry.colmap import load_pycolmap
from lpcal.geometry.rigid_fit import fit as rigid_fit
from lpcal.records.camera import Camera
from lpcal.records.evidence import OtherSolver

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

"""Images of the board to a camera, and to the board's pose in each of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from lpcal.api.board_search import grey_of, list_pixels, refuse_another_board, refuse_two_sizes
from lpcal.api.staged import staged
from lpcal.chain.h_cb_board import BoardPose, fit_board_pose
from lpcal.chain.k_camera import board_shape, solve_camera
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.geometry.arrays import Array, Image
from lpcal.records import given, given_records
from lpcal.records.calibration import Camera, CameraSolution
from lpcal.records.observations import Board, BoardPoses, BoardView, BoardViews
from lpcal.records.outcome import Progress, silent
from lpcal.records.rig import BoardSection

type Model = Literal["auto", "opencv4", "opencv5", "opencv8", "splined"]

ASSUMED_SIGMA_PX = 0.1
"""One standard deviation of a corner coordinate, in pixels, where the camera was not solved here and it is not known."""


def board_of(section: BoardSection | None) -> Board | None:
    """The board that a section of panel.yaml describes."""
    if section is None:
        return None
    marker_m = float("nan") if section.marker is None else section.marker
    return Board(
        section.corners, section.square, section.warp == "auto", section.kind, marker_m, section.dictionary or "", section.corner_fit
    )


@staged("board")
def find_boards(
    images: Sequence[npt.NDArray[Any]], board: Board, *, names: Sequence[str] | None = None, progress: Progress = silent
) -> BoardViews:
    """Find the calibration board in images of one camera.

    Parameters
    ----------
    images : sequence of ndarray, each (H, W) or (H, W, 3)
        Grey or RGB images of any scale and type, all of one size.
    board : Board
        The board that they show.
    names : sequence of str, optional
        What the views are called in results and messages; by default ``image 0``, ``image 1``, ...
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    BoardViews
        For each image the corners (ny * nx, 2) in pixels in the order of ``board.points_B()``, NaN where one was not seen; or None and why.

    Raises
    ------
    InputError
        There is no image, or one is no grey or RGB image.
    DisagreementError
        Two sizes; or a board of another corner count.
    DegenerateError
        No board in any image.

    Examples
    --------
    >>> import lpcal
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), image_size=(320, 200), stations=4)
    >>> views = lpcal.find_boards(list(session.board_images()), session.board)
    >>> sum(view.corners_px is not None for view in views.views)
    4
    """
    path = next((row for row, image in enumerate(images) if isinstance(image, str | Path)), None)
    if path is not None:
        raise InputError("a path", where=f"images[{path}]", needed="(H, W) or (H, W, 3) numbers", todo="read it first, as with cv2.imread")
    grey = [grey_of(_picture(image, row)) for row, image in enumerate(images)]
    if not grey:
        raise InputError("no image", where="images", needed="images of the board")
    called = tuple(names) if names is not None else tuple(f"image {row}" for row in range(len(grey)))
    if len(called) != len(grey):
        raise DisagreementError(f"{len(called)} names for {len(grey)} images", where="names", needed="one name an image")
    sizes = [(one.shape[1], one.shape[0]) for one in grey]
    refuse_two_sizes(called, sizes)
    seen = list_pixels(grey.__getitem__, range(len(grey)), board, lambda done: progress("board", done, len(grey)))
    views = BoardViews(sizes[0], tuple(seen[row].named(called[row]) for row in range(len(grey))))
    refuse_another_board(grey.__getitem__, views, board)
    return views


@staged("camera")
def calibrate_camera(
    corners: BoardViews | npt.ArrayLike,
    board: Board,
    image_size: tuple[int, int] | None = None,
    *,
    model: Model = "auto",
    solver: Literal["auto", "mrcal", "opencv"] = "auto",
    progress: Progress = silent,
) -> CameraSolution:
    """Solve for the intrinsics of a camera from corners of a board.

    Parameters
    ----------
    corners : BoardViews, or ndarray (N, rows, columns, 2) or (N, rows * columns, 2)
        What `find_boards` found; or corners in pixels, pixel centres at whole numbers, NaN where one was not seen, columns along x of B.
    board : Board
        The board; with ``board.warp`` it may be bowed where cross-validation prefers that.
    image_size : (int, int), optional
        Width and height in pixels; needed where `corners` is an array.
    model : {"auto", "opencv4", "opencv5", "opencv8", "splined"}
        The lens model; "auto" takes the one that cross-validation expects nearest to the truth.
    solver : {"auto", "mrcal", "opencv"}
        What solves; "auto" is mrcal where it is installed and the board's squares are square.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    CameraSolution
        The camera with the covariance of its parameters, the board's shape in metres, each view's residual in pixels, H_CB, warnings.

    Raises
    ------
    InputError
        No image size; or a splined lens without mrcal.
    DisagreementError
        Another number of corners than the board has.
    DegenerateError
        Fewer than three views, or views that do not determine the focal length or the principal point.
    ConvergenceError
        No solution.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> board = lpcal.Board(corners=(9, 6), square_m=(0.025, 0.025), warp=False)
    >>> camera = lpcal.Camera((640, 480), "opencv4", np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]), np.zeros(4))
    >>> rng = np.random.default_rng(1)
    >>> H_CB = np.tile(np.eye(4), (12, 1, 1))
    >>> for k, H in enumerate(H_CB):
    ...     a, b = 0.5 * np.cos(k), 0.5 * np.sin(k)
    ...     Rx = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    ...     Ry = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    ...     H[:3, :3], H[:3, 3] = Rx @ Ry, [-0.1, -0.06, 0.3 + 0.01 * k]
    >>> corners = np.stack([camera.project(board.points_B() @ H[:3, :3].T + H[:3, 3]) for H in H_CB])
    >>> found = lpcal.calibrate_camera(corners + 0.05 * rng.standard_normal(corners.shape), board, (640, 480), model="opencv4")
    >>> bool(abs(found.camera.K[0, 0] - 600) < 3)
    True
    """
    for word, name, known in ((model, "model", get_args(Model.__value__)), (solver, "solver", ("auto", "mrcal", "opencv"))):
        if word not in known:
            raise InputError(repr(word), where=name, needed=f"one of {', '.join(known)}")
    progress("camera", 0, 1)
    solution = solve_camera(_views(corners, board, image_size), board, model=model, solver=solver)
    progress("camera", 1, 1)
    return solution


def _views(corners: BoardViews | npt.ArrayLike, board: Board, image_size: tuple[int, int] | None) -> BoardViews:
    """Views of corners as a caller gives them."""
    if isinstance(corners, BoardViews):
        return corners
    if image_size is None:
        raise InputError("none is given", where="image_size", needed="width and height in pixels")
    nx, ny = board.corners
    found = given.numbers(corners, "corners", finite=False)
    if found.shape[1:] not in {(ny, nx, 2), (ny * nx, 2)}:
        raise DisagreementError(
            f"an array of {found.shape}", where="corners", needed=f"(N, {ny}, {nx}, 2): a board of {nx}x{ny} inner corners, rows along y"
        )
    rows = found.reshape(len(found), ny * nx, 2)
    seen = np.isfinite(rows).all(axis=2).any(axis=1)
    views = [
        BoardView(f"view {k}", row if any_seen else None, None if any_seen else "no corner")
        for k, (row, any_seen) in enumerate(zip(rows, seen, strict=True))
    ]
    return BoardViews((int(image_size[0]), int(image_size[1])), tuple(views))


@staged("board poses")
def locate_boards(
    boards: BoardViews, camera: CameraSolution | Camera, board: Board | None = None, *, progress: Progress = silent
) -> BoardPoses:
    """Find the board's pose in every view, with its covariance.

    Parameters
    ----------
    boards : BoardViews
        What `find_boards` found.
    camera : CameraSolution or Camera
        What `calibrate_camera` found; or a camera from elsewhere, for which `board` is needed.
    board : Board, optional
        The board, where the camera is from elsewhere; with ``board.warp`` its shape is estimated.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    BoardPoses
        H_CB (N, 4, 4) in metres of the views that have one, their covariance (N, 6, 6), their corners; and why the others have none.

    Raises
    ------
    InputError
        A camera from elsewhere without a board.
    DisagreementError
        A camera from elsewhere of another image size.

    Examples
    --------
    >>> import lpcal
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), image_size=(320, 200), stations=4)
    >>> views = lpcal.find_boards(list(session.board_images()), session.board)
    >>> poses = lpcal.locate_boards(views, session.camera, session.board)
    >>> poses.H_CB.shape
    (4, 4, 4)
    """
    if isinstance(camera, CameraSolution):
        return _located(boards, camera, progress)
    if board is None:
        raise InputError("none is given", where="board", needed="the board, where the camera was not solved from it")
    solution = as_given(given_records.camera(camera), board, "camera", "camera", boards.image_size if boards.views else None)
    poses = _located(boards, solution, progress)
    if not (board.warp and poses.images):
        return poses
    shape = board_shape(boards, board, camera, dict(zip(poses.images, poses.H_CB, strict=True)))
    return _located(boards, replace(solution, points_B=shape), progress)


def as_given(camera: Camera, board: Board | None, source: str, where: str, image_size: tuple[int, int] | None) -> CameraSolution:
    """A camera from elsewhere as a solution: nothing was solved; `source` is what it is called, `where` the place for a message.

    Raises
    ------
    DisagreementError
        The images are of another size.
    """
    if image_size is not None and camera.image_size != image_size:
        raise DisagreementError(
            "a camera of {}x{} pixels; the images have {}x{}".format(*camera.image_size, *image_size),
            where=where,
            needed="the camera that took the images, at their size",
            todo="name the right file, or leave camera.cameramodel out to solve the camera again",
        )
    return CameraSolution(camera, np.zeros((0, 3)) if board is None else board.points_B(), (), f"given: {source}", ASSUMED_SIGMA_PX)


def _located(boards: BoardViews, solution: CameraSolution, progress: Progress) -> BoardPoses:
    """H_CB of every view with a board, by a camera and a shape of the board; and why the others have none."""
    poses: dict[str, BoardPose] = {}
    without: dict[str, str] = {}
    corners: dict[str, Array] = {}
    sigma_px = solution.corner_sigma_px
    for done, view in enumerate(boards.views, start=1):
        if view.corners_px is None:
            without[view.image] = view.why or "no board found"
            continue
        try:
            pose = fit_board_pose(view.corners_px, solution.points_B, solution.camera, sigma_px, solution.H_CB.get(view.image))
        except (DegenerateError, np.linalg.LinAlgError) as error:
            without[view.image] = f"no pose: {error}"
            continue
        poses[view.image] = pose
        corners[view.image] = np.where(pose.inlier[:, None], view.corners_px, np.nan)
        progress("board poses", done, len(boards.views))
    count = len(poses)
    return BoardPoses(
        images=tuple(poses),
        t_camera_s=None,
        H_CB=np.array([pose.H_CB for pose in poses.values()]).reshape(count, 4, 4),
        corners_px=np.array(list(corners.values())).reshape(count, len(solution.points_B), 2),
        points_B=solution.points_B,
        covariance=np.array([pose.covariance for pose in poses.values()]).reshape(count, 6, 6),
        rms_px=np.array([pose.rms_px for pose in poses.values()]),
        corner_sigma_px=sigma_px,
        without=without,
    )


def _picture(image: npt.NDArray[Any], row: int) -> Image:
    found = np.asarray(image)
    if found.dtype.kind not in "uif" or found.ndim not in (2, 3) or (found.ndim == 3 and found.shape[2] != 3) or not found.size:
        raise InputError(f"an array of {found.shape}, {found.dtype}", where=f"images[{row}]", needed="(H, W) or (H, W, 3) numbers")
    if found.dtype.kind == "f" and not np.isfinite(found).all():
        raise InputError("numbers that are not finite", where=f"images[{row}]", needed="finite numbers")
    return found

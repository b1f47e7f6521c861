"""The panel's distance sensor of its readings on a board."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from lpcal.api.staged import staged
from lpcal.chain.distance_beam.findings import calibrate
from lpcal.chain.distance_beam.fit import drawn_in_camera
from lpcal.errors import DisagreementError, InputError
from lpcal.records import given
from lpcal.records.distance import BeamDrawn, BoardReadings, SensorSolution
from lpcal.records.observations import Board, BoardPoses

POSE_M, POSE_RAD = 2e-4, 5e-4
"""One sigma of a board pose, an axis, that comes without a covariance: what a camera of half a megapixel finds."""


@staged("distance sensor")
def calibrate_distance_sensor(
    distance_m: npt.ArrayLike,
    boards: BoardPoses | npt.ArrayLike,
    board: Board | None = None,
    *,
    position: npt.ArrayLike = (0.0, 0.0, 0.0),
    direction: npt.ArrayLike = (0.0, 0.0, 1.0),
    noise_m: float = 0.003,
    tolerance: tuple[float, float] = (0.005, 0.035),
    H_CD: npt.ArrayLike | None = None,
    H_CD_covariance: npt.ArrayLike | None = None,
) -> SensorSolution:
    """Calibrate a distance sensor that is fixed to the camera: the beam in C, its bias and its scale.

    Parameters
    ----------
    distance_m : ndarray (N,)
        Readings on the board, metres; NaN where there is none.
    boards : BoardPoses, or ndarray (N, 4, 4)
        The board in the camera at each reading, of `locate_boards`; or H_CB, metres.
    board : Board, optional
        The board, where `boards` is an array: it says where the board ends.
    position : ndarray (3,)
        Where the beam begins as drawn, metres in D; in C without `H_CD`.
    direction : ndarray (3,)
        Where it goes, likewise.
    noise_m : float
        One sigma of a reading.
    tolerance : (float, float)
        One sigma of the drawing, an axis: of the position in metres, of the direction in radians.
    H_CD, H_CD_covariance : ndarray (4, 4), (6, 6), optional
        The disc in the camera, and its covariance.

    Returns
    -------
    SensorSolution
        The sensor with its covariance, what became of each reading, what the poses lack, warnings.

    Raises
    ------
    InputError, DisagreementError
        Arrays of another shape; readings in another unit, of a stuck sensor, of what is behind the board, or of no beam of this panel.
    DegenerateError
        Fewer than eight readings on the board.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), stations=12)
    >>> H_CB = session.board_truth().H_CB
    >>> n, p = H_CB[:, :3, 2], H_CB[:, :3, 3]
    >>> reading_m = 0.004 + np.sum(n * p, axis=1) / n[:, 2]  # a beam from the camera's centre along z, a bias of 4 mm
    >>> found = lpcal.calibrate_distance_sensor(reading_m, H_CB, session.board, noise_m=0.0005)
    >>> round(1e3 * found.sensor.hit(0.404)[2])
    400
    """
    readings_m = given.numbers(distance_m, "distance_m", finite=False)
    if not isinstance(boards, BoardPoses):
        if board is None:
            raise InputError("no board", where="board", needed="the board: its corners say where it ends")
        H_CB = given.transforms(boards, "boards")
        boards = BoardPoses(tuple(f"reading {k}" for k in range(len(H_CB))), None, H_CB, points_B=board.points_B())
    if readings_m.shape != (len(boards.H_CB),):
        raise DisagreementError(
            f"an array of {given.shape_of(readings_m)}", where="distance_m", needed=f"({len(boards.H_CB)},): a reading a board"
        )
    if boards.points_B is None:
        raise InputError("boards without points_B", where="boards", needed="what locate_boards gives: the corners say where the board ends")
    known = np.flatnonzero(np.isfinite(readings_m))
    x_D, u_D = given.shaped(position, (3,), "position"), given.shaped(direction, (3,), "direction")
    drawn = BeamDrawn(x_D, u_D / np.linalg.norm(u_D), noise_m, tolerance)
    disc = np.eye(4) if H_CD is None else given.transforms(np.asarray(H_CD)[None], "H_CD")[0]
    doubt = np.zeros((6, 6)) if H_CD_covariance is None else given.shaped(H_CD_covariance, (6, 6), "H_CD_covariance")
    start, prior = drawn_in_camera(drawn, disc, doubt)
    return calibrate(board_readings(boards, readings_m, known), start, prior, noise_m)


def board_readings(boards: BoardPoses, distance_m: npt.ArrayLike, rows: npt.NDArray[np.intp]) -> BoardReadings:
    """Readings (N,) at images whose board was found, of some rows."""
    points_B = boards.points_B
    assert points_B is not None
    own = np.diag([POSE_RAD**2] * 3 + [POSE_M**2] * 3)
    covariance = np.tile(own, (len(rows), 1, 1)) if boards.covariance is None else boards.covariance[rows]
    steps = np.diff(np.unique(np.round(points_B[:, 0], 4)))
    square_m = float(steps[steps > 1e-3].min()) if (steps > 1e-3).any() else 0.0
    names = [boards.images[row] for row in rows]
    return BoardReadings.of_images(names, np.asarray(distance_m)[rows], boards.H_CB[rows], covariance, points_B, square_m)

r"""The beam by robust weighted least squares.

Symbols: beam o + t u in C; board k at H_CB,k with normal n and origin p in C; reading r::

    t = n . (p - o) / (n . u)          x = o + t u                    r = bias + scale t + e
    dt/do = -n / (n.u)     dt/du = -t n / (n.u)     dt/dxi = [x cross n, n] / (n.u)      xi left perturbation of H_CB

A reading's variance is the sensor's noise and what its board's pose adds by dt/dxi; errors that readings share (of H_PC, of H_OB, of the
clock offset, where the board is known through the room) are unknowns with their covariance as prior. The drawing is a prior of origin and
direction. Readings off the board or on its rim go by where the beam meets its plane, others by Geman and McClure's weights, graduated from
WIDE to NARROW standard deviations; the last solve is plain least squares of those within LIMIT.
A board that the camera did not see at a reading is known through the room; with a, e, f, d the errors of H_OP, H_PC, H_OB (left
perturbations) and of the clock offset, w the twist by which H_OP changes a second::

    H_CB = H_CP H_PO H_OB          xi = Ad(H_CO) (f - a + w d) - Ad(H_CP) e

Source: Gauss-Newton; graduated non-convexity, Blake & Zisserman 1987; line-laser and rangefinder to camera extrinsics from planes, Zhang &
Pless 2004.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import HandEye
from lpcal.records.distance import BIAS_STD_M, SCALE_STD, BeamDrawn, BoardReadings

WIDE, NARROW = 40.0, 3.0
"""Standard deviations at which the weights begin and end: a beam five degrees off its drawing misses by some ten of a 3 mm sensor's."""
LIMIT = 4.0
"""Standard deviations beyond which a reading is none of the board: of 30 good ones hardly one is lost in 500 sessions."""
ROUNDS = 25
"""Gauss-Newton steps, the weights narrowed over the first twenty."""
SLACK_M = 0.06
"""How far beside the board the beam may seem to go while it is not yet known: five degrees at 0.6 m."""
RIM_M = 0.004
"""Half a spot's width: nearer to the board's edge a reading may be of both the board and what is behind."""
FEWEST = 8
"""Readings that a beam is found from: six numbers of it show, and two more show the noise."""
STEEPEST = 0.17
"""Least cosine between beam and board's normal, 80 deg: beyond, nothing of the reading is the board's."""


@dataclass(frozen=True)
class Beam:
    """A beam in C with bias and scale, and two directions across it in which it may turn."""

    origin_C: Array
    direction_C: Array
    across_C: Array
    """(3, 2) unit vectors across the beam."""
    bias_m: float = 0.0
    scale: float = 1.0

    @staticmethod
    def along(origin_C: Array, direction_C: Array) -> Beam:
        """A beam through a point, with no bias."""
        direction_C = direction_C / np.linalg.norm(direction_C)
        return Beam(origin_C, direction_C, _across(np.eye(3)[int(np.argmin(np.abs(direction_C)))], direction_C))

    def moved(self, step: Array) -> Beam:
        """The beam after a step (7,): its origin, its turn along `across_C`, bias, scale."""
        direction_C = self.direction_C + self.across_C @ step[3:5]
        direction_C = direction_C / np.linalg.norm(direction_C)
        across_C = _across(self.across_C[:, 0], direction_C)
        return Beam(self.origin_C + step[:3], direction_C, across_C, self.bias_m + float(step[5]), self.scale + float(step[6]))


def _across(about_C: Array, direction_C: Array) -> Array:
    """Two unit vectors (3, 2) across a direction, the first as near to a vector as can be."""
    first_C = about_C - direction_C * (about_C @ direction_C)
    first_C = first_C / np.linalg.norm(first_C)
    return np.stack([first_C, np.cross(direction_C, first_C)], axis=1)


@dataclass(frozen=True)
class Met:
    """Where a beam meets the boards, a row a reading."""

    t_m: Array
    x_C: Array
    x_B: Array
    """(N, 3) in each board's frame."""
    normal_C: Array
    cosine: Array
    """(N,) of the beam to the board's normal, signed."""


@dataclass(frozen=True)
class Fit:
    """The beam with its covariance, and each reading."""

    beam: Beam
    covariance: Array
    """(7, 7) of the steps of `Beam.moved`."""
    information: Array
    """(7, 7) by the readings alone, errors that they share taken as known."""
    inlier: Mask
    on_board: Mask
    on_rim: Mask
    residual_m: Array
    sigma_m: Array
    met: Met
    prior: Array
    """(7, 7) covariance of the drawing."""
    start: Beam


def drawn_in_camera(drawn: BeamDrawn, H_CD: Array, H_CD_covariance: Array) -> tuple[Beam, Array]:
    """The beam of the drawing in C, and its covariance (7, 7): of the tolerance, of H_CD, of a zero and a scale that were not measured."""
    origin_C = se3.apply(H_CD, drawn.position_D[None])[0]
    direction_C = se3.rotate(H_CD, drawn.direction_D[None])[0]
    beam = Beam.along(origin_C, direction_C)
    J = np.zeros((5, 6))
    J[:3] = se3.point_jacobian(origin_C)
    J[3:, :3] = -beam.across_C.T @ se3.hat(beam.direction_C)
    covariance = np.diag([drawn.tolerance[0] ** 2] * 3 + [drawn.tolerance[1] ** 2] * 2 + [BIAS_STD_M**2, SCALE_STD**2])
    covariance[:5, :5] += J @ H_CD_covariance @ J.T
    return beam, covariance


def meet(beam: Beam, readings: BoardReadings, H_CB: Array) -> Met:
    """Where the beam meets boards H_CB (N, 4, 4), bowed as found."""
    normal_C = H_CB[:, :3, 2]
    cosine = normal_C @ beam.direction_C
    safe = np.where(np.abs(cosine) < 1e-6, 1e-6, cosine)

    def at(height: Array) -> tuple[Array, Array, Array]:
        t_m = (np.einsum("ni,ni->n", normal_C, H_CB[:, :3, 3] - beam.origin_C) + height) / safe
        x_C = beam.origin_C + t_m[:, None] * beam.direction_C
        return t_m, x_C, np.einsum("nji,nj->ni", H_CB[:, :3, :3], x_C - H_CB[:, :3, 3])

    t_m, x_C, x_B = at(np.zeros(len(H_CB)))
    if len(readings.points_B):
        near = np.argmin(np.sum((x_B[:, None, :2] - readings.points_B[None, :, :2]) ** 2, axis=2), axis=1)
        t_m, x_C, x_B = at(readings.points_B[near, 2])
    return Met(t_m, x_C, x_B, normal_C, cosine)


def off_board_m(met: Met, readings: BoardReadings) -> Array:
    """How far (N,) outside the board the beam meets its plane; negative: inside, by so much."""
    low, high = readings.outline_B
    square = readings.square_m
    return np.asarray(np.max(np.concatenate([low - square - met.x_B[:, :2], met.x_B[:, :2] - high - square], axis=1), axis=1))


def solve(readings: BoardReadings, start: Beam, prior: Array, noise_m: float) -> Fit:
    """The beam of readings, from that of the drawing with its covariance (7, 7).

    Raises
    ------
    DegenerateError
        Fewer readings on the board than a beam takes.
    """
    shared = readings.room_covariance.shape[0]
    whole_prior = np.zeros((7 + shared, 7 + shared))
    whole_prior[:7, :7] = np.linalg.inv(prior)
    if shared:
        whole_prior[7:, 7:] = np.linalg.inv(readings.room_covariance)
    beam, moved = start, np.zeros(shared)
    total = np.zeros(7)
    for k in range(ROUNDS):
        narrowed = min(k / (ROUNDS - 6), 1.0)
        c, slack = WIDE * (NARROW / WIDE) ** narrowed, SLACK_M * (1 - narrowed)
        met, J, residual, sigma = _linear(beam, readings, moved, noise_m)
        z = residual / sigma
        allowed = (off_board_m(met, readings) < slack - RIM_M * (slack == 0)) & (np.abs(met.cosine) > STEEPEST) & (met.t_m > 0)
        weight = allowed * (c**2 / (c**2 + z**2)) ** 2
        if narrowed == 1.0:
            weight = (allowed & (np.abs(z) < LIMIT)).astype(float)
        A, b = J / sigma[:, None] * np.sqrt(weight)[:, None], z * np.sqrt(weight)
        N = A.T @ A + whole_prior
        step = np.linalg.solve(N, A.T @ b - whole_prior @ np.concatenate([total, moved]))
        beam, total, moved = beam.moved(step[:7]), total + step[:7], moved + step[7:]
    met, J, residual, sigma = _linear(beam, readings, moved, noise_m)
    off = off_board_m(met, readings)
    steep = (np.abs(met.cosine) <= STEEPEST) | (met.t_m <= 0)
    inlier = (off < -RIM_M) & ~steep & (np.abs(residual) < LIMIT * sigma)
    if inlier.sum() < FEWEST:
        on = int(np.sum((off < -RIM_M) & ~steep))
        raise DegenerateError(
            f"{int(inlier.sum())} readings of {len(off)} agree on a beam; it meets the board in {on}",
            needed=f"{FEWEST} readings on the board",
            todo="aim the sensor's spot at the board's middle and read at 20 poses and more",
        )
    A = J[inlier] / sigma[inlier, None]
    covariance = np.linalg.inv(A.T @ A + whole_prior)[:7, :7]
    return Fit(beam, covariance, A[:, :7].T @ A[:, :7], inlier, off < -RIM_M, np.abs(off) <= RIM_M, residual, sigma, met, prior, start)


def whole_covariance(beam: Beam, covariance: Array) -> Array:
    """Covariance (8, 8) of origin, direction, bias, scale of that of a beam's steps (7, 7)."""
    J = np.zeros((8, 7))
    J[:3, :3], J[3:6, 3:5], J[6, 5], J[7, 6] = np.eye(3), beam.across_C, 1.0, 1.0
    return np.asarray(J @ covariance @ J.T)


def _linear(beam: Beam, readings: BoardReadings, moved: Array, noise_m: float) -> tuple[Met, Array, Array, Array]:
    """Where the beam meets the boards, derivatives (N, 7 + S) of the readings, residuals (N,) and their standard deviations (N,)."""
    H_CB = se3.exp(readings.by_room @ moved) @ readings.H_CB if moved.size else readings.H_CB
    met = meet(beam, readings, H_CB)
    over = np.where(np.abs(met.cosine) < STEEPEST, STEEPEST, met.cosine)[:, None]
    by_origin = -met.normal_C / over
    by_pose = np.concatenate([np.cross(met.x_C, met.normal_C), met.normal_C], axis=1) / over
    by_turn = met.t_m[:, None] * (by_origin @ beam.across_C)
    shared = np.einsum("ni,nis->ns", by_pose, readings.by_room)
    ones = np.ones((len(met.t_m), 1))
    s = beam.scale
    J = np.concatenate([s * by_origin, s * by_turn, ones, met.t_m[:, None], s * shared], axis=1)
    variance = noise_m**2 + s**2 * np.einsum("ni,nij,nj->n", by_pose, readings.covariance, by_pose)
    residual = readings.distance_m - beam.bias_m - s * met.t_m
    return met, J, residual, np.sqrt(variance)


SHARED = 13
"""Errors that readings through one room share: of H_PC (6), of H_OB (6), of the clock offset."""
LEAST_CLOCK_S = 1e-5
"""Seconds within which a clock offset is known at best."""


def boards_through_room(handeye: HandEye, H_OP: Array, variance: Array, velocity: Array) -> tuple[Array, Array, Array]:
    """H_CB (N, 4, 4), each one's own covariance (N, 6, 6), and by what the shared errors act on it (N, 6, 13).

    `variance` (N, 6) is that of the turn and the origin of H_OP (N, 4, 4) an axis, `velocity` (N, 6) of the turn and the origin.
    """
    H_CP, H_PO = se3.inv(handeye.H_PC), se3.inv(H_OP)
    H_CB = H_CP @ H_PO @ handeye.H_OB
    A = se3.adjoint(H_CP @ H_PO)
    T = np.linalg.inv(se3.turn_and_origin_jacobian(H_OP))
    own = (A @ T) @ (variance[:, :, None] * np.swapaxes(A @ T, 1, 2))
    twist = np.concatenate([velocity[:, :3], velocity[:, 3:] - np.cross(velocity[:, :3], H_OP[:, :3, 3])], axis=1)
    by_room = np.zeros((len(H_OP), 6, SHARED))
    by_room[:, :, :6] = -se3.adjoint(H_CP)
    by_room[:, :, 6:12] = A
    by_room[:, :, 12] = np.einsum("nij,nj->ni", A, twist)
    return H_CB, own, by_room


def room_covariance(handeye: HandEye) -> Array:
    """Covariance (13, 13) of the shared errors; that H_PC and H_OB err together is not counted, which makes readings count less."""
    found = np.zeros((SHARED, SHARED))
    found[:6, :6], found[6:12, 6:12] = handeye.H_PC_covariance, handeye.H_OB_covariance
    found[12, 12] = max(handeye.clock_offset_std_s or 0.0, LEAST_CLOCK_S) ** 2
    return found

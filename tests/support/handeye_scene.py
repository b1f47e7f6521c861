"""Simulated hand-eye sessions with known truth, for the tests and for tools/bench_handeye.py.

More detail than the estimator knows: the camera that is handed over is off by a draw of its own covariance, the board is bowed, corners are
projected through the true lens and drop out, images are stamped with jitter, the body moves smoothly and the mocap samples it with noise.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera
from lpcal.records.observations import Board, BoardPoses, PoseStream

K_TRUE = np.array([[712.4, 0.0, 385.1], [0.0, 713.1, 230.6], [0.0, 0.0, 1.0]])
LENS_TRUE = np.array([-0.302, 0.121, 0.0007, -0.0005, 0.0])
CAMERA_SIGMA = np.array([0.4, 0.4, 0.5, 0.5, 0.002, 0.006, 2e-4, 2e-4, 0.006])
PARAMETERS = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")
FRAME_HZ, MOCAP_HZ = 12.0, 120.0


@dataclass(frozen=True)
class Noise:
    """One standard deviation of everything."""

    px: float = 0.15
    mocap_rad: float = float(np.radians(0.075))
    mocap_m: float = 2e-4
    drift: float = 0.0
    """Share of the mocap's variance that drifts over about a second."""


TYPICAL = Noise()


@dataclass(frozen=True)
class Session:
    """What was measured, and the truth."""

    boards: BoardPoses
    camera: Camera
    H_OP: np.ndarray
    """(N, 4, 4) measured panel poses (static sessions)."""
    stream: PoseStream | None
    H_PC: np.ndarray
    """H_OC of a fixed camera."""
    H_OB: np.ndarray
    """H_PB of a fixed camera."""
    offset_s: float
    flipped: np.ndarray
    """(N,) whether the view's panel pose was swapped."""


def static_session(
    rng: np.random.Generator, views: int = 30, turn_deg: float = 25.0, noise: Noise = TYPICAL, flips: float = 0.0, *, fixed: bool = False
) -> Session:
    """Views at rest, each with its own pose; `fixed`: the camera stands in the room and the body carries the board."""
    H_PC, H_OB, H_CB = _scene(rng, views, np.radians(turn_deg))
    if fixed:
        H_PC, H_OB = _fixed(rng)
    true_OP = _poses(H_PC, H_OB, H_CB, fixed=fixed)
    H_OP = _measured(rng, true_OP, noise)
    flipped = rng.random(views) < flips
    H_OP[flipped] = H_OP[flipped] @ se3.exp(np.array([0.0, 0.0, 2.1, 0.03, -0.02, 0.01]))
    camera, boards = _seen(rng, H_CB, noise, None)
    return Session(boards, camera, H_OP, None, H_PC, H_OB, 0.0, flipped)


def robot_session(rng: np.random.Generator, turn_deg: float = 0.03, shift_mm: float = 0.3) -> Session:
    """Thirty views whose panel poses are off by a random linear function of the pose, of these rms sizes (a length of three axes)."""
    session = static_session(rng, 30, 25.0)
    H = session.H_OP
    clue = np.hstack([se3.rotation_vector(H[0, :3, :3].T @ H[:, :3, :3]), H[:, :3, 3]])
    clue = (clue - clue.mean(axis=0)) / clue.std(axis=0)
    off = clue @ rng.normal(size=(6, 6))
    off[:, :3] *= np.radians(turn_deg) / np.sqrt(np.mean(np.sum(off[:, :3] ** 2, axis=1)))
    off[:, 3:] *= 1e-3 * shift_mm / np.sqrt(np.mean(np.sum(off[:, 3:] ** 2, axis=1)))
    moved = H.copy()
    moved[:, :3, :3] = se3.exp(np.hstack([off[:, :3], np.zeros_like(off[:, :3])]))[:, :3, :3] @ H[:, :3, :3]
    moved[:, :3, 3] += off[:, 3:]
    return replace(session, H_OP=moved)


def moving_session(
    rng: np.random.Generator,
    views: int = 30,
    noise: Noise = TYPICAL,
    flips: float = 0.0,
    turn_deg: float = 20.0,
    every_s: float = 1 / FRAME_HZ,
    *,
    fixed: bool = False,
) -> Session:
    """The panel waved by hand before the board, camera and mocap each on its own clock; `fixed` as of `static_session`."""
    H_PC, H_OB, H_0 = _scene(rng, 1, 0.05)
    if fixed:
        H_PC, H_OB = _fixed(rng)
    motion = _motion(rng, np.radians(turn_deg))
    offset = float(rng.uniform(0.03, 0.08)) * rng.choice([-1, 1])
    t_image = 1.0 + np.arange(views) * every_s + rng.normal(0, 2e-4, views)  # on the mocap's clock
    t_mocap = np.arange(0.0, t_image[-1] + 1.0, 1 / MOCAP_HZ)
    H_CB = motion(t_image) @ H_0[0]
    stream_true = _poses(H_PC, H_OB, motion(t_mocap) @ H_0[0], fixed=fixed)
    H_OP = _measured(rng, stream_true, noise)
    flipped = np.zeros(len(t_mocap), dtype=bool)
    while flips and flipped.mean() < flips:
        start = rng.integers(len(t_mocap))
        flipped[start : start + int(rng.integers(1, 12))] = True
    H_OP[flipped] = H_OP[flipped] @ se3.exp(np.array([0.0, 0.0, 2.1, 0.03, -0.02, 0.01]))
    stream = PoseStream("Panel", t_mocap, H_OP, np.full(len(t_mocap), np.nan), rate_hz=MOCAP_HZ)
    camera, boards = _seen(rng, H_CB, noise, t_image + offset)
    return Session(boards, camera, H_OP[:0], stream, H_PC, H_OB, offset, np.zeros(views, dtype=bool))


def _fixed(rng: np.random.Generator) -> tuple[Array, Array]:
    """H_OC of a camera in the room, H_PB of a board on the body."""
    H_OC = se3.exp(np.concatenate([rng.normal(0, 0.5, 3), np.zeros(3)]))
    H_OC[:3, 3] = rng.uniform(0.7, 2.5) * se3.rotation(rng.normal(0, 2, 3))[:, 0]
    return H_OC, se3.exp(np.concatenate([rng.normal(0, 0.4, 3), rng.normal(0, 0.05, 3)]))


def _poses(H_PC: Array, H_OB: Array, H_CB: Array, *, fixed: bool) -> Array:
    return H_PC @ H_CB @ se3.inv(H_OB) if fixed else H_OB @ se3.inv(H_PC @ H_CB)


def _scene(rng: np.random.Generator, views: int, turn_rad: float) -> tuple[Array, Array, Array]:
    H_PC = se3.exp(np.concatenate([rng.normal(0, 0.4, 3), rng.normal(0, 0.03, 3)]))
    H_OB = se3.exp(np.concatenate([rng.normal(0, 0.5, 3), rng.normal(0, 0.6, 3)]))
    centre_B = np.array([0.1, 0.0625, 0.0])
    R = se3.rotation(rng.uniform(-turn_rad, turn_rad, (views, 3)))
    middle_C = np.stack([rng.uniform(-0.06, 0.06, views), rng.uniform(-0.03, 0.03, views), rng.uniform(0.38, 0.55, views)], axis=1)
    return H_PC, H_OB, se3.transform(R, middle_C - R @ centre_B)


def _motion(rng: np.random.Generator, turn_rad: float) -> Callable[[Array], Array]:
    """A smooth motion of the board before the camera: sums of sines about the board's middle."""
    frequency = rng.uniform(0.3, 1.0, (3, 6))
    phase = rng.uniform(0, 2 * np.pi, (3, 6))
    size = np.array([turn_rad] * 3 + [0.05, 0.03, 0.06]) / 1.5
    middle = se3.transform(np.eye(3), np.array([0.0, 0.0, 0.45]))

    def at(t: Array) -> Array:
        xi = size * np.sum(np.sin(2 * np.pi * frequency * np.asarray(t)[:, None, None] + phase), axis=1)
        return middle @ se3.exp(xi) @ se3.inv(middle)

    return at


def _measured(rng: np.random.Generator, H: Array, noise: Noise) -> Array:
    """Poses with white noise, and a share of it that drifts."""
    sigma = np.array([noise.mocap_rad] * 3 + [noise.mocap_m] * 3)
    white = rng.normal(0, 1, (len(H), 6))
    drift = np.zeros_like(white)
    keep = np.exp(-1 / (1.0 * MOCAP_HZ))
    for k in range(1, len(H)):
        drift[k] = keep * drift[k - 1] + np.sqrt(1 - keep**2) * rng.normal(0, 1, 6)
    e = sigma * (np.sqrt(1 - noise.drift) * white + np.sqrt(noise.drift) * drift)
    found = H.copy()
    found[:, :3, :3] = se3.rotation(e[:, :3]) @ H[:, :3, :3]
    found[:, :3, 3] += e[:, 3:]
    return found


def _seen(rng: np.random.Generator, H_CB: Array, noise: Noise, t_camera_s: Array | None) -> tuple[Camera, BoardPoses]:
    """The camera as handed over, and the boards as found with it."""
    points_B = Board((9, 6), (0.025, 0.025)).points_B()
    u, v = (points_B[:, 0] - 0.1) / 0.1, (points_B[:, 1] - 0.0625) / 0.0625
    bow = 3e-4 * (0.7 * u**2 + 0.3 * v**2)
    points_B[:, 2] = bow.mean() - bow
    corners = central.project(se3.apply(H_CB, points_B), K_TRUE, LENS_TRUE) + rng.normal(0, noise.px, (len(H_CB), len(points_B), 2))
    corners[rng.random(corners.shape[:2]) < 0.03] = np.nan
    off = rng.normal(0, 1, 9) * CAMERA_SIGMA
    K = K_TRUE + np.array([[off[0], 0, off[2]], [0, off[1], off[3]], [0, 0, 0]])
    camera = Camera((752, 480), "opencv5", K, LENS_TRUE + off[4:], parameters=PARAMETERS, covariance=np.diag(CAMERA_SIGMA**2))
    poses = np.array([_pose(corners[k], points_B, camera, H_CB[k]) for k in range(len(H_CB))])
    names = tuple(f"view_{k:03d}.png" for k in range(len(H_CB)))
    return camera, BoardPoses(names, t_camera_s, poses, corners, points_B)


def _pose(corners: Array, points_B: Array, camera: Camera, start: Array) -> Array:
    """H_CB by Gauss-Newton from the truth, with the camera as handed over."""
    seen = np.isfinite(corners).all(axis=1)
    H = start
    for _ in range(4):
        x_C = se3.apply(H, points_B[seen])
        J = camera.projection_jacobian(x_C) @ np.concatenate([-se3.hat(x_C), np.tile(np.eye(3), (len(x_C), 1, 1))], axis=2)
        r = camera.project(x_C) - corners[seen]
        H = se3.exp(-np.linalg.lstsq(J.reshape(-1, 6), r.ravel(), rcond=None)[0]) @ H
    return H


def stop_and_shoot(
    rng: np.random.Generator,
    views: int = 24,
    turn_deg: float = 25.0,
    noise: Noise = TYPICAL,
    dwell_s: float = 1.0,
    move_s: float = 0.6,
    hz: float = MOCAP_HZ,
) -> tuple[Session, npt.NDArray[Any]]:
    """A static session as a recording sees it: the panel rests, is moved on, rests; and the truth of each sample.

    Returns the session with a stream and camera times (offset 0.07 s), and for every sample the view that it belongs to.
    """
    session = static_session(rng, views, turn_deg, noise)
    true_OP = session.H_OP  # with an error of its own in each view, as where cameras of the mocap come and go
    period = dwell_s + move_s
    t = np.arange(0.0, views * period, 1 / hz)
    view = np.minimum((t / period).astype(int), views - 1)
    share = np.clip((t - view * period - dwell_s) / move_s, 0, 1)
    share = share * share * (3 - 2 * share)
    following = np.minimum(view + 1, views - 1)
    step = se3.log(true_OP[following] @ se3.inv(true_OP[view]))
    H_OP = _measured(rng, se3.exp(share[:, None] * step) @ true_OP[view], noise)
    stream = PoseStream("Panel", t, H_OP, np.full(len(t), np.nan), rate_hz=hz)
    middle = np.arange(views) * period + rng.uniform(0.35, 0.65, views) * dwell_s
    offset = 0.07
    boards = BoardPoses(session.boards.images, middle + offset, session.boards.H_CB, session.boards.corners_px, session.boards.points_B)
    return Session(boards, session.camera, session.H_OP[:0], stream, session.H_PC, session.H_OB, offset, session.flipped), view

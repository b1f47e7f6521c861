r"""Where the panel is at every moment of a session, and when the camera looks.

Symbols: ``H_CB(t)`` the static board seen from the camera, ``H_OP = H_OB H_CB^-1 H_PC^-1`` the panel that goes with it. The panel rests
at each station, goes to the next with the least jerk, and ends with one slow sweep; a hand's tremor lies over all of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.simulate.built import Built
from lpcal.simulate.recipe import Recipe

MARGIN_SQUARES = 0.6
"""White border of the board, in squares."""
TURN_RATE_RAD_S = 1.2
SPEED_M_S = 0.9
LEAD_IN_S = 1.0


@dataclass(frozen=True)
class Session:
    """The panel's motion and the camera's moments, both on the mocap system's clock."""

    t_s: Array
    """Mocap samples (N,)."""
    H_OP: Array
    """True panel poses (N, 4, 4) at them."""
    station_s: Array
    station_H_OP: Array
    sweep_s: Array
    sweep_H_OP: Array
    dwells_s: Array
    """(S, 2) beginning and end of the rest at each station."""


def board_outline(corners: tuple[int, int], square_m: tuple[float, float]) -> Array:
    """Points (K, 3) in B round the board with its white border."""
    low, high = np.full(2, -1 - MARGIN_SQUARES), np.array(corners) + MARGIN_SQUARES
    s = np.linspace(0, 1, 9)
    x, y = (low[i] + (high[i] - low[i]) * s for i in range(2))
    edge = [np.stack([x, np.full(9, end)], axis=1) for end in (low[1], high[1])]
    edge += [np.stack([np.full(9, end), y], axis=1) for end in (low[0], high[0])]
    flat = np.concatenate(edge) * square_m
    return np.column_stack([flat, np.zeros(len(flat))])


def station_poses(built: Built, corners: tuple[int, int], square_m: tuple[float, float], count: int, rng: np.random.Generator) -> Array:
    """H_CB (count, 4, 4): the board all over the image, near and far, tilted and turned, always whole."""
    width, height = built.lens.image_size
    outline_B = board_outline(corners, square_m)
    centre_B = outline_B.mean(axis=0)
    diagonal_m = float(np.linalg.norm(np.ptp(outline_B, axis=0)))
    near_m = 1.02 * diagonal_m * built.lens.K[0, 0] / float(np.hypot(width, height)) / 0.9
    cells = [(i, j) for j in range(4) for i in range(5)]
    order = rng.permutation(len(cells))
    far, tilts_rad = rng.permutation(np.linspace(1.05, 2.0, count)), rng.permutation(np.linspace(np.radians(9), np.radians(42), count))
    poses = []
    for index in range(count):
        i, j = cells[order[index % len(cells)]]
        share = np.array([(i + rng.uniform()) / 5, (j + rng.uniform()) / 4])
        about, roll = rng.uniform(0, 2 * np.pi), rng.uniform(-0.8, 0.8)
        tilt = tilts_rad[index] * np.array([np.cos(about), np.sin(about)])
        for shrink in np.linspace(1, 0, 41):
            target = 0.5 + (share - 0.5) * shrink
            pose = board_pose(built, target * [width, height], near_m * far[index] * (1.5 - 0.5 * shrink), tilt, roll, centre_B)
            if built.lens.inside(se3.apply(pose, outline_B), 5):
                break
        poses.append(pose)
    return np.array(poses)


def board_pose(built: Built, pixel: Array, distance_m: Array | float, tilt_rad: Array, roll_rad: Array | float, centre_B: Array) -> Array:
    """H_CB (..., 4, 4) of boards whose centre is seen at pixels (..., 2), at distances, tilted (..., 2) about x and y and rolled."""
    flat, roll = np.zeros_like(tilt_rad[..., :1]), np.asarray(roll_rad)[..., None]
    R = se3.rotation(np.concatenate([tilt_rad, flat], axis=-1)) @ se3.rotation(np.concatenate([flat, flat, roll], axis=-1))
    plane = built.lens.plane(np.reshape(pixel, (-1, 2))).reshape(np.shape(pixel))
    ray = np.concatenate([plane, np.ones_like(plane[..., :1])], axis=-1)
    ray = ray / np.linalg.norm(ray, axis=-1, keepdims=True)
    return se3.transform(R, np.asarray(distance_m)[..., None] * ray - R @ centre_B)


def plan(built: Built, corners: tuple[int, int], square_m: tuple[float, float], recipe: Recipe) -> Session:
    """The whole session: stations, then the sweep."""
    rng = np.random.default_rng([recipe.seed, 2])
    stations = _panel(built, station_poses(built, corners, square_m, recipe.stations, rng))
    sweep = _panel(built, _sweep_poses(built, corners, square_m, recipe, rng))
    keys = np.concatenate([stations, sweep[:1]])
    starts = [LEAD_IN_S]
    travel = [_travel_s(keys[k], keys[k + 1]) for k in range(len(keys) - 1)]
    for k in range(len(keys) - 1):
        starts.append(starts[-1] + recipe.dwell_s + travel[k])
    dwells = np.stack([starts, np.array(starts) + recipe.dwell_s], axis=1)
    step = 1 / recipe.camera_rate_hz
    sweep_s = dwells[-1, 1] + np.arange(1, recipe.sweep_frames + 1) * step
    end = float(sweep_s[-1] + LEAD_IN_S) if recipe.sweep_frames else float(dwells[-1, 1])
    t_s = np.arange(0, end, 1 / recipe.tracking.rate_hz)
    station_s = dwells[:-1].mean(axis=1) + rng.uniform(-0.1, 0.1, len(stations)) * recipe.dwell_s
    motion = _Motion(keys, dwells, sweep, float(step / SWEEP_OVERSAMPLING), _tremor(rng))
    return Session(t_s, motion(t_s), station_s, motion(station_s), sweep_s, motion(sweep_s), dwells[:-1])


def round_trip(stops: Array, recipe: Recipe, rng: np.random.Generator) -> Session:
    """A robot carries the panel from stop to stop, H_OP (N, 4, 4), resting at each; the camera looks in the middle of every rest."""
    travel = [_travel_s(stops[k], stops[k + 1]) for k in range(len(stops) - 1)]
    starts = LEAD_IN_S + np.concatenate([[0.0], np.cumsum(np.array(travel) + recipe.dwell_s)])
    dwells = np.stack([starts, starts + recipe.dwell_s], axis=1)
    t_s = np.arange(0, float(dwells[-1, 1]) + LEAD_IN_S, 1 / recipe.tracking.rate_hz)
    stop_s = dwells.mean(axis=1)
    rate, phase, amplitude = _tremor(rng)
    motion = _Motion(stops, dwells, stops[-1:], 0.0, (rate, phase, ROBOT_STEADINESS * amplitude))
    return Session(t_s, motion(t_s), stop_s, motion(stop_s), np.zeros(0), np.zeros((0, 4, 4)), dwells)


ROBOT_STEADINESS = 0.1
"""Share of a hand's tremor that a robot's arm has at rest: some 0.015 mm, below what a motion-capture system sees."""
SWEEP_OVERSAMPLING = 10


@dataclass(frozen=True)
class _Motion:
    keys: Array
    dwells_s: Array
    sweep: Array
    """H_OP at even steps from the end of the last rest on."""
    sweep_step_s: float
    tremor: tuple[Array, Array, Array]

    def __call__(self, t_s: Array) -> Array:
        """H_OP (N, 4, 4) at times t_s (N,)."""
        leg = np.clip(np.searchsorted(self.dwells_s[:, 1], t_s), 0, len(self.keys) - 1)
        before = np.maximum(leg - 1, 0)
        travel = np.maximum(self.dwells_s[leg, 0] - self.dwells_s[before, 1], 1e-9)
        s = np.clip((t_s - self.dwells_s[before, 1]) / travel, 0, 1)
        s = np.where(leg > 0, s**3 * (10 - 15 * s + 6 * s * s), 1.0)
        start, goal = self.keys[before], self.keys[leg]
        turn = se3.rotation_vector(goal[:, :3, :3] @ np.swapaxes(start[:, :3, :3], -1, -2))
        R = se3.rotation(s[:, None] * turn) @ start[:, :3, :3]
        H_OP = se3.transform(R, start[:, :3, 3] + s[:, None] * (goal[:, :3, 3] - start[:, :3, 3]))
        after = t_s > self.dwells_s[-1, 1]
        if np.any(after) and len(self.sweep) > 1:
            steps = np.arange(len(self.sweep)) * self.sweep_step_s + self.dwells_s[-1, 1]
            H_OP[after] = se3.interpolate(self.sweep, steps, t_s[after])
        rate, phase, amplitude = self.tremor
        xi = np.sum(amplitude * np.sin(2 * np.pi * rate * t_s[:, None, None] + phase), axis=1)
        return np.asarray(H_OP @ se3.exp(xi))


def _panel(built: Built, H_CB: Array) -> Array:
    return np.asarray(built.H_OB @ se3.inv(H_CB) @ se3.inv(built.H_PC))


def _travel_s(H_a: Array, H_b: Array) -> float:
    turn = float(se3.angle_rad(H_b[:3, :3] @ H_a[:3, :3].T))
    return max(0.35, turn / TURN_RATE_RAD_S, float(np.linalg.norm(H_b[:3, 3] - H_a[:3, 3])) / SPEED_M_S)


def _tremor(rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """Rates (Hz), phases and amplitudes (4, 6) of a hand's tremor: 0.02 degrees, 0.15 mm."""
    scale = np.array([np.radians(0.02)] * 3 + [0.00015] * 3) / 2
    return rng.uniform(0.6, 4, (4, 6)), rng.uniform(0, 2 * np.pi, (4, 6)), scale * rng.uniform(0.5, 1.5, (4, 6))


def _sweep_poses(built: Built, corners: tuple[int, int], square_m: tuple[float, float], recipe: Recipe, rng: np.random.Generator) -> Array:
    """H_CB at even steps of the sweep: tilts, roll, place and distance go round slowly, easing in."""
    width, height = built.lens.image_size
    outline_B = board_outline(corners, square_m)
    centre_B = outline_B.mean(axis=0)
    near_m = float(np.linalg.norm(np.ptp(outline_B, axis=0))) * built.lens.K[0, 0] / float(np.hypot(width, height))
    length_s = (recipe.sweep_frames + recipe.camera_rate_hz * LEAD_IN_S) / recipe.camera_rate_hz
    t = np.arange(0, length_s, 1 / (recipe.camera_rate_hz * SWEEP_OVERSAMPLING)) if recipe.sweep_frames else np.zeros(1)
    warped = np.where(t < 0.5, t * t, t - 0.25)
    rate, phase = rng.uniform(0.3, 0.5, 6), rng.uniform(0, 2 * np.pi, 6)
    wave = np.sin(2 * np.pi * rate * warped[:, None] + phase)
    for shrink in np.linspace(1, 0.2, 17):
        pixel = np.array([width, height]) * (0.5 + shrink * np.array([0.1, 0.08]) * wave[:, :2])
        distance_m = near_m * (1.75 + 0.15 * wave[:, 2])
        angles = np.radians([22, 22, 25]) * wave[:, 3:]
        poses = board_pose(built, pixel, distance_m, angles[:, :2], angles[:, 2], centre_B)
        if built.lens.inside(se3.apply(poses, outline_B).reshape(-1, 3), 5):
            break
    return poses

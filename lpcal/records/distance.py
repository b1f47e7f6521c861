"""The panel's distance sensor: its readings, the beam that a calibration finds, and what it rests on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.shown import Shown

PARAMETERS = ("x_m", "y_m", "z_m", "u_x", "u_y", "u_z", "bias_m", "scale")
"""What the rows of a beam's covariance are: its origin and its direction in a frame, the bias and the scale of the readings."""
CALIBRATING_POSES = (
    "read it at 20 to 30 views with its spot on the board, tilted by 20 to 30 deg to all four sides, at half, at once and at one and "
    "a half times the working distance; write the readings as distance_m beside the images"
)
"""The board's poses that calibrate a sensor, in words."""
BIAS_STD_M, SCALE_STD = 0.01, 0.02
"""One sigma of a sensor's zero and of its scale before it is calibrated: a housing's front against its datasheet's, air and target."""


def beam_at(position_D: Sequence[float], direction_D: Sequence[float], distance_m: float) -> tuple[float, float]:
    """What a beam as drawn reads of a plane at a distance along the disc's axis, and how far from that axis it meets it, metres.

    Raises
    ------
    InputError
        The beam does not go forward.
    """
    origin, direction = np.array(position_D, float), np.array(direction_D, float)
    direction /= np.linalg.norm(direction)
    if direction[2] <= 0 or origin[2] >= distance_m:
        raise InputError("the beam does not meet the working distance", where="panel.distance_sensor", needed="a direction forward, z > 0")
    t = (distance_m - origin[2]) / direction[2]
    return float(t), float(np.linalg.norm((origin + t * direction)[:2]))


@dataclass(frozen=True)
class BeamDrawn:
    """The sensor as the panel's drawing has it, in D; `tolerance` is one sigma of the origin (m) and of the direction (rad), an axis."""

    position_D: Array
    """(3,) metres."""
    direction_D: Array
    """(3,) of length 1."""
    noise_m: float
    """One sigma of a reading."""
    tolerance: tuple[float, float] = (0.005, float(np.radians(2.0)))


@dataclass(frozen=True, repr=False)
class DistanceSensor(Shown):
    """A beam in C: a reading is ``bias + scale t`` of what it hits at ``position + t direction``.

    Where the beam begins along itself and the bias are one number in the readings: their covariance says so, and the point that a
    reading means is known better than either.

    Parameters
    ----------
    position_C : ndarray (3,)
        Where the beam begins, metres.
    direction_C : ndarray (3,)
        Where it goes, of length 1.
    bias_m : float
        What the sensor reads at no distance, metres.
    scale : float
        Metres that it reads for a metre.
    noise_m : float
        One sigma of a reading, metres.
    covariance : ndarray (8, 8)
        Of position (m), direction, bias (m), scale.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> sensor = lpcal.DistanceSensor(np.zeros(3), np.array([0, 0, 1.0]), bias_m=0.01, scale=1.0, noise_m=0.003)
    >>> sensor.hit(0.36).round(3).tolist()
    [0.0, 0.0, 0.35]
    """

    position_C: Array
    direction_C: Array
    bias_m: float = 0.0
    scale: float = 1.0
    noise_m: float = 0.003
    covariance: Array = field(default_factory=lambda: np.zeros((8, 8)))

    def along_m(self, reading_m: float) -> float:
        """The distance along the beam that a reading means."""
        return (reading_m - self.bias_m) / self.scale

    def hit(self, reading_m: float) -> Array:
        """The point (3,) in C that a reading means."""
        return np.asarray(self.position_C + self.along_m(reading_m) * self.direction_C)

    @property
    def H_CR(self) -> Array:
        """The beam's frame R (4, 4) in C: its origin, x along it, as ROS has a range sensor's; the turn about the beam is any."""
        x = self.direction_C
        y = np.cross(np.eye(3)[int(np.argmin(np.abs(x)))], x)
        y /= np.linalg.norm(y)
        H = np.eye(4)
        H[:3, :3], H[:3, 3] = np.stack([x, y, np.cross(x, y)], axis=1), self.position_C
        return H

    def reads_m(self, depth_m: float) -> float:
        """What it reads of a plane across the camera's axis at a depth; NaN where the beam does not meet it."""
        ahead = float(self.direction_C[2])
        return self.bias_m + self.scale * (depth_m - float(self.position_C[2])) / ahead if ahead > 0 else float("nan")

    def beside_m(self, x_C: Array) -> Array:
        """How far points (N, 3) lie beside the beam, metres; from its origin where they lie behind that."""
        by = np.asarray(x_C) - self.position_C
        along = np.maximum(by @ self.direction_C, 0.0)
        return np.asarray(np.linalg.norm(by - along[:, None] * self.direction_C, axis=1))

    def std_m(self, reading_m: float) -> float:
        """One sigma along the beam of the point that a reading means: the sensor's noise and its calibration."""
        t = self.along_m(reading_m)
        along = np.concatenate([self.direction_C, np.zeros(3), [-1 / self.scale, -t / self.scale]])
        return float(np.sqrt((self.noise_m / self.scale) ** 2 + along @ self.covariance @ along))

    def across_std_m(self, reading_m: float) -> float:
        """One sigma across the beam, an axis, of the point that a reading means."""
        t = self.along_m(reading_m)
        J = np.concatenate([np.eye(3), t * np.eye(3), np.zeros((3, 2))], axis=1)
        across = np.eye(3) - np.outer(self.direction_C, self.direction_C)
        return float(np.sqrt(max(np.trace(across @ J @ self.covariance @ J.T @ across), 0.0) / 2))


@dataclass(frozen=True)
class BoardReadings:
    """Readings on the board, each with the board's pose in C at that time. Row k of all arrays is one reading."""

    names: tuple[str, ...]
    distance_m: Array
    """(N,)."""
    H_CB: Array
    """(N, 4, 4)."""
    covariance: Array
    """(N, 6, 6) of the left perturbation of H_CB, each reading's own."""
    by_room: Array
    """(N, 6, S) by which errors that readings share act on that perturbation: of H_PC, of H_OB, of the clock offset."""
    room_covariance: Array
    """(S, S) of these shared errors."""
    outline_B: tuple[Array, Array] = (np.zeros(2), np.zeros(2))
    """(2,) the least and the largest x, y of the board's corners."""
    square_m: float = 0.0
    """A square's width, by which the pattern goes on beyond its outermost corners."""
    points_B: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """(M, 3) the corners, bowed as found."""

    @staticmethod
    def of_images(
        names: Sequence[str], distance_m: Array, H_CB: Array, covariance: Array, points_B: Array, square_m: float
    ) -> BoardReadings:
        """Readings at images in which the board was found."""
        low, high = points_B[:, :2].min(axis=0), points_B[:, :2].max(axis=0)
        nothing = np.zeros((len(names), 6, 0))
        return BoardReadings(
            tuple(names), distance_m, H_CB, covariance, nothing, np.zeros((0, 0)), (low, high), square_m, points_B
        )  # fmt: skip


@dataclass(frozen=True)
class ReadingVerdict:
    """What became of one reading."""

    name: str
    """The image, or the time, of the reading."""
    used: bool
    """Whether the solve rests on it."""
    why: str | None
    """Why it was not used."""
    reading_m: float
    """What the sensor read."""
    residual_m: float
    """What it differs by from the beam that was found."""
    at_m: tuple[float, ...]
    """Where the beam meets the board's plane, x and y of B."""


@dataclass(frozen=True, kw_only=True)
class SensorEvidence:
    """What the beam rests on."""

    readings_used: int
    """Count of readings that the fit rests on."""
    residual_rms_m: float
    """Rms of the readings used."""
    expected_rms_m: float
    """The rms that the noise as stated would give, what the fit takes counted."""
    off_drawing_deg: float
    """Angle between the beam found and the one drawn."""
    off_drawing_m: float
    """How far the beam found is from that of the drawing: its direction, and its line at the boards."""
    off_drawing_sigmas: float
    """The direction's, in standard deviations of tolerance and fit."""
    tilt_about_two_axes_deg: tuple[float, ...]
    """How far the boards were tilted against the beam, rms about two axes across it, the larger first."""
    span_m: tuple[float, ...]
    """The nearest and the farthest board along the beam."""
    weakest: str = ""
    """What the poses determine least, and what would improve it, in words."""


@dataclass(frozen=True, repr=False)
class SensorSolution(Shown):
    """The sensor as calibrated, what became of each reading, and what it rests on."""

    sensor: DistanceSensor
    """The sensor with its covariance."""
    readings: tuple[ReadingVerdict, ...]
    """What became of each reading."""
    evidence: SensorEvidence
    """What the fit rests on."""
    warnings: tuple[str, ...] = ()
    """What to look at, in words."""

    @property
    def used(self) -> Mask:
        """(N,) the readings that were used."""
        return np.array([one.used for one in self.readings], dtype=bool)

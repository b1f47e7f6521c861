"""Where a capture was taken: the camera in the room, or in a tracked body that the object rides on, with how sure that is.

What a capture states of it, what a calibration knows of the tracking, and the place that both give.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.shown import Shown

POSE_STD = (5e-4, float(np.radians(0.05)))
"""Metres and radians, one sigma an axis, of a stated pose that says no tolerance and of a body whose noise was not measured: what
motion-capture systems of a room and industrial arms keep."""


@dataclass(frozen=True)
class StatedPlace:
    """What capture.yaml says of where and when a capture was taken; all None: nothing."""

    t_camera_s: float | None = None
    """Seconds on the camera's clock."""
    H_OP: Array | None = None
    """(4, 4) the tracked body that carries the camera, in the room."""
    H_OC: Array | None = None
    """(4, 4) the camera in the room."""
    tolerance: tuple[float, float] | None = None
    """One sigma of the stated pose, an axis: metres, radians; None: not stated."""
    body: str | None = None
    """The tracked body that the object rides on."""
    recording: Path | None = None
    """The recording of this capture, where it is another than the rig's."""
    clock_offset_s: float | None = None
    """``t_camera = t_mocap + clock_offset_s`` of that recording, where it is stated."""

    @property
    def said(self) -> bool:
        """Whether anything that determines the place is stated."""
        return any(one is not None for one in (self.t_camera_s, self.H_OP, self.H_OC, self.body))


@dataclass(frozen=True)
class RoomTracking:
    """What is known of the tracking besides H_PC, as the hand-eye solve found it; NaN and None where it did not.

    The offset holds as in `HandEye`: ``t_camera = t_mocap + offset + drift (t_camera - middle)``.
    """

    H_PC_covariance: Array
    """(6, 6) of the left perturbation of H_PC; where the body carries the board, of H_OC."""
    clock_offset_s: float | None = None
    """``t_camera = t_mocap + offset``."""
    clock_offset_std_s: float | None = None
    """Standard deviation of the offset."""
    clock_drift_ppm: float = 0.0
    """By how much the clocks' rates differ."""
    clock_middle_s: float = 0.0
    """The time on the camera's clock at which the offset holds."""
    mocap_sigma_m: float = POSE_STD[0]
    """One sigma of the origin of a measured body pose, an axis."""
    mocap_sigma_deg: float = float(np.degrees(POSE_STD[1]))
    """One sigma of its turn, an axis."""
    mocap_sigma_dwell_m: float | None = None
    """The same of a mean over a dwell; None: none was seen."""
    mocap_sigma_dwell_deg: float | None = None
    """The same of its turn."""

    def mocap_times(self, t_camera_s: Array) -> Array:
        """Times (N,) on the mocap's clock of times (N,) on the camera's, seconds."""
        drift = 1e-6 * self.clock_drift_ppm * (t_camera_s - self.clock_middle_s)
        return np.asarray(t_camera_s - drift - (self.clock_offset_s or 0.0))

    def sigmas(self, *, steady: bool) -> tuple[float, float]:
        """One sigma of a measured body pose, an axis: metres, radians; of a mean over a dwell where the body stood still."""
        if steady and self.mocap_sigma_dwell_m is not None and self.mocap_sigma_dwell_deg is not None:
            return self.mocap_sigma_dwell_m, float(np.radians(self.mocap_sigma_dwell_deg))
        return self.mocap_sigma_m, float(np.radians(self.mocap_sigma_deg))


@dataclass(frozen=True, repr=False)
class Placement(Shown):
    """The camera at a capture: in the room (``H_OC``), or in the tracked body M that the object rides on (``H_MC``).

    `H_AC` is the one or the other. Covariances are (6, 6), rotation (rad) first, then translation (m), of the left perturbation
    ``H = exp(xi) H_AC``. Captures that share a calibration share its errors: with the error e of H_PC (left perturbation) and that of
    the clock offset, d, ``xi = noise + by_handeye e + by_clock d``.

    Parameters
    ----------
    H_AC : ndarray (4, 4)
        Camera coordinates to those of the room, or of the body; metres.
    covariance : ndarray (6, 6)
        Of `H_AC`, everything counted.
    body : str, optional
        The tracked body whose frame A is; None: A is the room.
    noise_covariance : ndarray (6, 6)
        What of it is this capture's alone: the noise of the measured poses, or the tolerance of a stated one.
    by_handeye : ndarray (6, 6)
        Derivative of the left perturbation by that of H_PC; zero where the camera's own pose is stated.
    by_clock : ndarray (6,)
        Derivative by the clock offset, a second; zero where the bodies stood still.
    t_camera_s : float, optional
        When it was taken, on the camera's clock.
    source : str
        What it comes from, in words.
    notes : tuple of str
        Notes on it.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> calibration = lpcal.Calibration("arm", (), H_PC=np.eye(4))
    >>> H_OP = np.eye(4) + np.array([[0, 0, 0, 1.0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])
    >>> placement = lpcal.place(calibration, H_OP=H_OP, tolerance=(0.0001, 0.001))
    >>> placement.name, placement.H_AC[:3, 3].tolist()
    ('H_OC', [1.0, 0.0, 0.0])
    """

    H_AC: Array
    covariance: Array
    body: str | None = None
    noise_covariance: Array = field(default_factory=lambda: np.zeros((6, 6)))
    by_handeye: Array = field(default_factory=lambda: np.zeros((6, 6)))
    by_clock: Array = field(default_factory=lambda: np.zeros(6))
    t_camera_s: float | None = None
    source: str = ""
    notes: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """What `H_AC` is called where it is written."""
        return "H_OC" if self.body is None else "H_MC"

    @property
    def frame(self) -> str:
        """The frame A, in words."""
        return "the room" if self.body is None else f"the body {self.body}"

    @property
    def position_std_m(self) -> Array:
        """Standard deviation (3,) of the camera's place, metres."""
        return np.asarray(se3.origin_sigmas(self.H_AC, self.covariance))

    @property
    def rotation_std_rad(self) -> Array:
        """Standard deviation (3,) of the camera's turn, about the axes of A, radians."""
        return np.asarray(np.sqrt(np.diag(self.covariance)[:3]))

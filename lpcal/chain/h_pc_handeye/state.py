"""The hand-eye solve in progress: which views count, at which offset and noise, and what has been found so far."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lpcal.chain.h_pc_handeye.likelihood import CameraPrior, HandEyeEstimate, Sigmas, Views
from lpcal.errors import ConvergenceError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.geometry.pose_track import PoseTrack, TrackPoses
from lpcal.records.calibration import Carries
from lpcal.records.observations import BoardPoses

FEWEST_OF_A_CLASS = 6


@dataclass(frozen=True)
class HandEyeOptions:
    """What is known beforehand."""

    clock_offset_s: float | None = None
    """None: to be estimated."""
    camera_share: float = 0.0
    """Share of the views that the camera was solved from too, whose corners its prior has counted already."""
    seed: int = 0
    inverted: bool = False
    """Whether the poses are stated to take room to body: a tracked board before a fixed camera looks so."""
    carries: Carries | None = None
    """What the tracked body carries; None: what the data say."""


@dataclass(frozen=True)
class SolveState:
    """The solve in progress. Row k of arrays is one of the boards' views."""

    boards: BoardPoses
    panel: TrackPoses
    inliers: Mask
    offset_s: float
    clock: bool
    start: tuple[Array, Array]
    camera: CameraPrior | None
    sigmas: Sigmas = field(default_factory=Sigmas)
    deflation: Array = field(default_factory=lambda: np.zeros(0))
    found: HandEyeEstimate | None = None
    corners_px: Array | None = None
    corner_scale: Array | None = None
    """(N, M) by how much a pixel's error grew on the way to the pinhole of the likelihood; None: not at all."""
    track: PoseTrack | None = None
    board_carried: bool = False
    """Whether the panel's poses are inverted ones: see `set_up`."""

    def measured(self) -> Array:
        """H_OP (N, 4, 4) of all views, as the mocap measured it."""
        return se3.inv(self.panel.H) if self.board_carried else self.panel.H

    def views(self) -> Views:
        """The inliers, as the likelihood takes them."""
        steady = self.panel.steady
        both = min(np.sum(steady[self.inliers]), np.sum(~steady[self.inliers])) >= FEWEST_OF_A_CLASS
        noise_class = steady.astype(np.intp) if both else np.zeros(len(steady), dtype=np.intp)
        whole = Views(
            self.boards.H_CB,
            self.panel.H,
            self.panel.velocity,
            noise_class,
            self.deflation,
            self.corners_px,
            self.boards.points_B,
            self.corner_scale,
            self.panel.variance,
            inverse=self.board_carried,
        )
        return whole.of(self.inliers)

    def estimate(self) -> HandEyeEstimate:
        """What has been found.

        Raises
        ------
        ConvergenceError
            Nothing yet.
        """
        if self.found is None:
            raise ConvergenceError("the hand-eye solve has not run", needed="a solve")
        return self.found

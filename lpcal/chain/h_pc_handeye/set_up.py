"""Which of the two the tracked body carries: the camera before a board that stands still, or the board before a camera that does.

Symbols: of a camera in the room and a board on the body, ``H_OP H_PB = H_OC H_CB``; with the poses inverted that is the equation of a
camera on the body, ``H_PO H_OC H_CB = H_PB``. So one solve serves both: it is given H_PO for H_OP, and finds H_OC for H_PC and H_PB for
H_OB. A stream of a camera on the body that was written inverted fits in the same way; the difference is that a body carries
what it carries within its reach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.chain.h_pc_handeye import clock, congruence
from lpcal.chain.h_pc_handeye.state import HandEyeOptions
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import PoseTrack, poses_at

CARRIED_M = 0.6
"""Metres from the body's origin within which it carries a camera or a board: a marker body, a wand or a flange with its tool."""
NEARER = 0.7
"""Share of the camera's distance from the room's origin within which a board that is carried lies to the body's."""
FEWEST = 6
"""Least number of views that decide it."""


@dataclass(frozen=True)
class SetUp:
    """What the body carries."""

    board_carried: bool = False
    misstated: bool = False
    """The poses were stated to take room to body and do not: a fixed camera's session fits as the other one when it is read so."""

    def mover(self, H_OP: Array) -> Array:
        """The poses (N, 4, 4) that the solve is given for H_OP, of those that were read."""
        return se3.inv(H_OP) if self.board_carried != self.misstated else H_OP

    def as_measured(self, poses: Array) -> Array:
        """H_OP (N, 4, 4) of poses as they were read."""
        return se3.inv(poses) if self.misstated else poses

    def warnings(self) -> list[str]:
        """In words, where a key of panel.yaml is wrong."""
        return ["the poses take the body to the room, not mocap.direction: H_PO as is stated: they are read so"] if self.misstated else []


def of_pairs(H_OP: Array, H_CB: Array, options: HandEyeOptions, *, from_images: bool = True) -> SetUp:
    """The set-up of panel poses H_OP (N, 4, 4), as read, and board poses H_CB (N, 4, 4).

    Board poses found elsewhere may be inverted, which looks as a fixed camera does: of these the data leave it open.
    """
    if options.carries is not None:
        return SetUp(options.carries == "board")
    if len(H_OP) < FEWEST or not from_images:
        return SetUp()
    agreed = park.consensus(H_OP, H_CB)
    if congruence.fits(H_OP, H_CB, agreed):
        carried = options.inverted and _carried(agreed)
        return SetUp(carried, carried)
    turned = se3.inv(H_OP)
    agreed = park.consensus(turned, H_CB)
    return SetUp(congruence.fits(turned, H_CB, agreed) and _carried(agreed))


def of_track(track: PoseTrack, t_camera_s: Array, H_CB: Array, options: HandEyeOptions, *, from_images: bool = True) -> SetUp:
    """The set-up of a recording and board poses at the camera's times (N,), at the likeliest clock offset: angles know of no set-up."""
    if options.carries is not None:
        return SetUp(options.carries == "board")
    if not from_images:
        return SetUp()
    known_s = options.clock_offset_s
    candidates = [] if known_s is not None else clock.offset_candidates(track, t_camera_s, H_CB)
    if known_s is None and not candidates:
        return SetUp()
    panel = poses_at(track, t_camera_s - (candidates[0].offset_s if known_s is None else known_s))
    return of_pairs(panel.H[panel.trusted], H_CB[panel.trusted], options, from_images=from_images)


def _carried(agreed: park.Consensus) -> bool:
    """Whether a closed form of inverted poses is that of a board on the body: near to its origin, and the camera is not."""
    camera_m, board_m = (float(np.linalg.norm(H[:3, 3])) for H in (agreed.H_PC, agreed.H_OB))
    return camera_m > CARRIED_M and board_m < min(NEARER * camera_m, CARRIED_M)

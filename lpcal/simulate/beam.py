r"""The panel's distance sensor as really built, and what it reads.

Symbols: o, u the beam in C, b bias, s scale, e noise; t the distance along it to what it meets: the bowed board, found by three steps onto
its surface, else a wall behind it::

    reading = b + s t + e

A spot that lies across the board's edge reads both, by their shares.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.rig import BoardSection, Rig

BIAS_M, SCALE = 0.004, 0.004
"""One sigma of a simulated sensor's zero and scale: those of small time-of-flight modules once warm."""
WALL_M = 0.7
"""Metres from the board to the wall behind it."""
SPOT_M = 0.002
"""Half the spot's width on the board."""


@dataclass(frozen=True)
class TrueBeam:
    """The beam in C with its bias and scale; `noise_m` is one sigma of a reading."""

    position_C: Array
    direction_C: Array
    bias_m: float
    scale: float
    noise_m: float

    def reads(self, t_m: Array, rng: np.random.Generator) -> Array:
        """Readings (N,) of what stands at distances (N,) along the beam, to a tenth of a millimetre."""
        return np.asarray(np.round(self.bias_m + self.scale * t_m + self.noise_m * rng.standard_normal(t_m.shape), 4))


def draw_beam(rig: Rig, H_CD: Array, seed: int) -> TrueBeam | None:
    """The sensor within the tolerance that panel.yaml states; None where it states none."""
    section = None if rig.panel is None else rig.panel.distance_sensor
    if section is None:
        return None
    rng = np.random.default_rng([seed, 11])
    off = np.clip(rng.standard_normal(8), -2, 2)
    x_D = np.array(section.position) + section.tolerance[0] * off[:3]
    u_D = np.array(section.direction) / np.linalg.norm(section.direction)
    u_D = se3.rotation(section.tolerance[1] * np.cross(u_D, off[3:6])) @ u_D
    position_C, direction_C = se3.apply(H_CD, x_D[None])[0], se3.rotate(H_CD, u_D[None])[0]
    return TrueBeam(position_C, direction_C, float(BIAS_M * off[6]), float(1 + SCALE * off[7]), section.noise)


def board_distances(beam: TrueBeam, section: BoardSection, bow_m: float, twist: float, H_CB: Array) -> Array:
    """Distances (N,) along the beam to the board at H_CB (N, 4, 4), or past it to the wall behind."""
    from lpcal.simulate.boards import surface_height  # which rests on the rig as built, and so on this module
    from lpcal.simulate.motion import MARGIN_SQUARES

    H_BC = se3.inv(H_CB)
    o_B = se3.apply(H_BC, beam.position_C[None])[:, 0]
    u_B = se3.rotate(H_BC, beam.direction_C[None])[:, 0]
    z = np.zeros(len(H_CB))
    for _ in range(3):
        t = (z - o_B[:, 2]) / u_B[:, 2]
        x, y = o_B[:, 0] + t * u_B[:, 0], o_B[:, 1] + t * u_B[:, 1]
        z = surface_height(bow_m, twist, section.corners, section.square, x, y)
    low = -(1 + MARGIN_SQUARES) * np.array(section.square)
    high = (np.array(section.corners) + MARGIN_SQUARES) * np.array(section.square)
    inside = np.min([x - low[0], high[0] - x, y - low[1], high[1] - y], axis=0)
    share = np.clip(0.5 + inside / (2 * SPOT_M), 0, 1) * (t > 0)
    behind = (WALL_M - o_B[:, 2]) / u_B[:, 2]
    return np.asarray(share * t + (1 - share) * np.where(behind > 0, behind, WALL_M))

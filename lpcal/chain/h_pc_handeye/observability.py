"""What the panel's motion can show of H_PC, and which motion is lacking.

Symbols: phi_k, the rotation vector of each panel pose against their mean, in P; the eigenvalues s1^2 >= s2^2 >= s3^2 of its mean square.
Rotations about one axis alone leave the translation along it, and the turn about it, undetermined, whatever the residuals say; so s2
is the figure. Source: Tsai & Lenz, A new technique for fully autonomous and efficient 3D robotics hand/eye calibration (1989), lemma 4.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

FEWEST_VIEWS = 4
REFUSE_RAD = np.deg2rad(2.0)
WARN_RAD = np.deg2rad(8.0)
FEW_VIEWS = 10


@dataclass(frozen=True)
class Spread:
    """How far the panel turned."""

    sigma_rad: Array
    """(3,) standard deviation of the rotation about the principal axes, largest first."""
    axes_P: Array
    """(3, 3) these axes in P, one a row."""

    def words(self) -> str:
        """The spreads in degrees."""
        return ", ".join(f"{np.degrees(s):.1f}" for s in self.sigma_rad) + " deg"


def spread(H_OP: Array) -> Spread:
    """The spread of the rotations of panel poses (N, 4, 4)."""
    R = H_OP[:, :3, :3]
    R_mean = se3.nearest_rotation(R.mean(axis=0))
    phi = se3.rotation_vector(np.swapaxes(R_mean[None], 1, 2) @ R)
    phi = phi - phi.mean(axis=0)
    values, vectors = np.linalg.eigh(phi.T @ phi / len(phi))
    return Spread(np.sqrt(np.maximum(values[::-1], 0)), vectors.T[::-1])


def refuse_what_cannot_show_it(H_OP: Array) -> tuple[Spread, list[str]]:
    """The spread, and warnings in words.

    Raises
    ------
    DegenerateError
        Too few views, no rotation, or rotation about one axis only; the motion that improves it is named.
    """
    if len(H_OP) < FEWEST_VIEWS:
        raise DegenerateError(
            f"{len(H_OP)} views with both a board and a panel pose", needed=f"{FEWEST_VIEWS}, better 15", todo="take more, each turned"
        )
    found = spread(H_OP)
    if found.sigma_rad[0] < REFUSE_RAD:
        raise DegenerateError(
            f"the panel hardly turned (spread {found.words()})",
            needed="turns about two axes",
            todo="keep the board in sight and turn the panel by 20 degrees and more about its x, y and z",
        )
    if found.sigma_rad[1] < REFUSE_RAD:
        raise DegenerateError(
            f"the panel turned about one axis only, {_axis(found.axes_P[0])} (spread {found.words()})",
            needed=f"{np.degrees(REFUSE_RAD):.0f} deg about a second axis: the shift along the first, and the turn about it, do not show",
            todo=f"take views that are turned by 15 degrees and more about the panel's {_others(found.axes_P[0])}",
        )
    warnings = []
    if found.sigma_rad[1] < WARN_RAD:
        warnings.append(
            f"the panel turned little about a second axis (spread {found.words()}): views turned further about the panel's "
            f"{_others(found.axes_P[0])} would sharpen H_PC most"
        )
    if len(H_OP) < FEW_VIEWS:
        warnings.append(f"only {len(H_OP)} views: their noise, and so the covariance, is known by guess")
    return found, warnings


def _axis(axis_P: Array) -> str:
    place = int(np.argmax(np.abs(axis_P)))
    name = f"about its {'xyz'[place]}" if abs(axis_P[place]) > 0.9 else "oblique"
    return f"{name} ({', '.join(f'{a:.2f}' for a in axis_P)} in P)"


def _others(axis_P: Array) -> str:
    place = int(np.argmax(np.abs(axis_P)))
    return " and ".join(name for i, name in enumerate("xyz") if i != place)

r"""The kinematics of one wing.

Symbols: setting (azimuth a, joint angle g, d1, d2), radians and metres::

    H_DL = Rz(a) Tx(d1) Ry(-g) Tx(d2)
    the blob sits at Rz(a) [d1 + d2 cos g, 0, d2 sin g], emits along Rz(a) [-sin g, 0, cos g]
    and its axis meets the disc axis at d_object = d1 / tan g + d2 / sin g

Source: the LightPanel's mechanics (docs/frames.md).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

STEP = 1e-6


def wing_transform(setting: Array) -> Array:
    """H_DL (..., 4, 4) of settings (..., 4): azimuth (rad), joint angle g (rad), d1 (m), d2 (m)."""
    setting = np.asarray(setting, dtype=float)
    azimuth, g, d1, d2 = np.moveaxis(setting, -1, 0)
    zero = np.zeros_like(azimuth)
    R_z = se3.rotation(np.stack([zero, zero, azimuth], axis=-1))
    R_y = se3.rotation(np.stack([zero, -g, zero], axis=-1))
    blob = np.stack([d1 + d2 * np.cos(g), zero, d2 * np.sin(g)], axis=-1)
    return se3.transform(R_z @ R_y, (R_z @ blob[..., None])[..., 0])


def wing_jacobian(setting: Array) -> Array:
    """Derivative (..., 6, 4) of the left perturbation of H_DL by the setting (..., 4)."""
    H_DL = wing_transform(setting)
    columns = []
    for axis in range(4):
        step = STEP * np.eye(4)[axis]
        columns.append(
            (se3.log(wing_transform(setting + step) @ se3.inv(H_DL)) - se3.log(wing_transform(setting - step) @ se3.inv(H_DL))) / (2 * STEP)
        )
    return np.stack(columns, axis=-1)


def d_object(setting: Array) -> Array:
    """Distance (...) along the disc axis where the blob's axis meets it; infinite for a joint angle of zero."""
    _, g, d1, d2 = np.moveaxis(np.asarray(setting, dtype=float), -1, 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(np.abs(g) > 1e-9, d1 / np.tan(g) + d2 / np.sin(g), np.inf))

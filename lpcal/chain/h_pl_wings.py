r"""H_CL of every light as the panel's drawing has it, with the covariance that its tolerances give.

Symbols: azimuth a, joint angle g, d1 = disc_radius + disc_spacer + joint, d2 = joint + blob_spacer + blob (m)::

    H_DL = Rz(a) Tx(d1) Ry(-g) Tx(d2)          H_CL = H_CD H_DL          H_CD = inv(H_PC) H_PD
    the blob sits at Rz(a) [d1 + d2 cos g, 0, d2 sin g], emits along Rz(a) [-sin g, 0, cos g]
    and its axis meets the disc axis at d_object = d1 / tan g + d2 / sin g

Source: the LightPanel's kinematics (design contract, section 1); covariances to first order (Barfoot 2017, chapter 7).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Wing, Wings

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


def camera_in_disc(H_PC: Array, H_PC_covariance: Array, H_PD: Array, H_PD_covariance: Array) -> tuple[Array, Array]:
    """H_CD (4, 4) and its covariance (6, 6) from the hand-eye transform and the disc in the tracked body."""
    H_CP = se3.inv(H_PC)
    carry = se3.adjoint(H_CP)
    return H_CP @ H_PD, carry @ (H_PC_covariance + H_PD_covariance) @ carry.T


def design_lights(wings: Sequence[Wing], H_CD: Array, H_CD_covariance: Array, setting_sigma: Array, source_of_H_CD: str) -> Wings:
    """Every light as designed, jointly.

    Parameters
    ----------
    wings : the settings as drawn
    H_CD, H_CD_covariance : the disc in the camera (4, 4), (6, 6); its error is shared by all lights
    setting_sigma : (4,) one standard deviation of azimuth (rad), joint angle (rad), d1 (m), d2 (m)

    Raises
    ------
    DegenerateError
        There is no wing.
    """
    if not wings:
        raise DegenerateError(
            "no light is a wing", needed="lights with azimuth, joint_angle, disc_spacer and blob_spacer", todo="state the wings' settings"
        )
    settings = np.array([[wing.azimuth_rad, wing.joint_angle_rad, wing.d1_m, wing.d2_m] for wing in wings])
    H_DL = wing_transform(settings)
    carry = se3.adjoint(H_CD)
    by_setting = carry @ wing_jacobian(settings) * setting_sigma
    count = len(wings)
    covariance = np.tile(H_CD_covariance, (count, count))
    for k in range(count):
        covariance[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] += by_setting[k] @ by_setting[k].T
    reach = d_object(settings)
    return Wings(
        wings=tuple(wings),
        H_CD=H_CD,
        H_CD_covariance=H_CD_covariance,
        setting_sigma=setting_sigma,
        H_DL=H_DL,
        H_CL=H_CD @ H_DL,
        covariance=covariance,
        source_of_H_CD=source_of_H_CD,
        d_object_m=float(np.median(reach)),
    )

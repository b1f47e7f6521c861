r"""H_CL of every light as the panel's drawing has it, with the covariance that its tolerances give.

Symbols: azimuth a, joint angle g, d1 = disc_radius + disc_spacer + joint, d2 = joint + blob_spacer + blob (m)::

    H_DL = Rz(a) Tx(d1) Ry(-g) Tx(d2)          H_CL = H_CD H_DL          H_CD = inv(H_PC) H_PD
    the blob sits at Rz(a) [d1 + d2 cos g, 0, d2 sin g], emits along Rz(a) [-sin g, 0, cos g]
    and its axis meets the disc axis at d_object = d1 / tan g + d2 / sin g

Source: the LightPanel's kinematics (docs/frames.md); covariances to first order (Barfoot 2017, chapter 7).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.wing import d_object, wing_jacobian, wing_transform
from lpcal.records.calibration import Wing, Wings


def camera_in_disc(H_PC: Array, H_PC_covariance: Array, H_PD: Array, H_PD_covariance: Array) -> tuple[Array, Array]:
    """H_CD (4, 4) and its covariance (6, 6) from the hand-eye transform and the disc in the tracked body."""
    H_CP = se3.inv(H_PC)
    carry = se3.adjoint(H_CP)
    return H_CP @ H_PD, carry @ (H_PC_covariance + H_PD_covariance) @ carry.T


def share_correction(
    H_PC: Array, H_PC_covariance: Array, H_PD: Array, H_PD_covariance: Array, H_CD: Array, H_CD_covariance: Array
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """H_PC and H_PD with their covariances, after spheres have moved H_CD: each takes its share by its uncertainty.

    With ``exp(d) = H_PC H_CD H_DP``, S the sum of both covariances and S' that of the H_CD found, carried to P::

        a = -S_PC S^-1 d,   b = S_PD S^-1 d,   cov(a) = S_PC - S_PC S^-1 (S - S') S^-1 S_PC,   cov(b) alike

    Source: the update of jointly Gaussian variables from a measurement of their difference.
    """
    d = se3.log(H_PC @ H_CD @ se3.inv(H_PD))
    carry = se3.adjoint(H_PC)
    total = H_PC_covariance + H_PD_covariance
    learnt = total - carry @ H_CD_covariance @ carry.T
    found = []
    for H, covariance, sign in ((H_PC, H_PC_covariance, -1.0), (H_PD, H_PD_covariance, 1.0)):
        gain = covariance @ np.linalg.inv(total)
        found.append((se3.exp(sign * gain @ d) @ H, covariance - gain @ learnt @ gain.T))
    return found[0], found[1]


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
    DisagreementError
        A wing is longer than any panel's: its lengths are in another unit.
    """
    if not wings:
        raise DegenerateError(
            "no light is a wing", needed="lights with azimuth, joint_angle, disc_spacer and blob_spacer", todo="state the wings' settings"
        )
    settings = np.array([[wing.azimuth_rad, wing.joint_angle_rad, wing.d1_m, wing.d2_m] for wing in wings])
    refuse_beyond(wings)
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


MOST_M = 5.0
"""Metres that no wing reaches: a length in mm that was written as m, or a panel as large as a room."""


def refuse_beyond(wings: Sequence[Wing]) -> None:
    """Stop where a wing is longer than any panel's.

    Raises
    ------
    DisagreementError
        One is, with its length.
    """
    for wing in wings:
        if wing.d1_m + wing.d2_m > MOST_M:
            raise DisagreementError(
                f"{wing.name}: the wing is {wing.d1_m + wing.d2_m:.4g} m long",
                where="panel and lights",
                needed=f"a wing of at most {MOST_M:g} m",
                todo="correct the units of panel.disc_radius, panel.joint, panel.blob and the light's spacers: mm for m?",
            )


def behind_warning(wings: Wings) -> str | None:
    """In words, where the lights look away from what stands before the panel."""
    if wings.d_object_m > 0:
        return None
    return (
        f"the lights' axes meet {-1e3 * wings.d_object_m:.0f} mm behind the disc: they look away from the object; a joint's angle is "
        "counted towards the disc's axis and is positive"
    )

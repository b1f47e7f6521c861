"""What a hand-eye solve leaves for those who place captures: how well H_PC, the clocks and the tracked poses are known."""

from __future__ import annotations

from dataclasses import replace

from lpcal.records.calibration import HandEye, LightsSolution
from lpcal.records.placement import RoomTracking


def tracking_of(handeye: HandEye, lights: LightsSolution | None = None) -> RoomTracking:
    """What the solve knows of the tracking; the covariance is the lights' where they were refined jointly with H_PC."""
    joint = None if lights is None else lights.H_PC_covariance
    found = RoomTracking(
        H_PC_covariance=handeye.H_PC_covariance if joint is None else joint,
        clock_offset_s=handeye.clock_offset_s,
        clock_offset_std_s=handeye.clock_offset_std_s,
        clock_drift_ppm=1e6 * handeye.clock_drift,
        clock_middle_s=handeye.clock_middle_s,
    )
    noise = handeye.evidence
    if noise is None:
        return found
    return replace(
        found,
        mocap_sigma_m=noise.mocap_sigma_m,
        mocap_sigma_deg=noise.mocap_sigma_deg,
        mocap_sigma_dwell_m=noise.mocap_sigma_dwell_m,
        mocap_sigma_dwell_deg=noise.mocap_sigma_dwell_deg,
    )

"""What a simulated rig is made of besides its panel.yaml: the camera, the session, how large the errors of a real one are."""

from __future__ import annotations

import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class SensorRecipe:
    """What turns light into stored numbers. Noise in electrons; the blur is a Gaussian's sigma."""

    full_well_e: float = 30000.0
    read_noise_e: float = 9.0
    psf_sigma_px: float = 0.6
    bits: int = 8


@dataclass(frozen=True)
class Tracking:
    """What a motion-capture system adds to a pose: 1 sigma per axis, its rate, its correlation time, its failures."""

    rate_hz: float = 120.0
    white_m: float = 0.00010
    white_rad: float = math.radians(0.035)
    coloured_m: float = 0.00015
    coloured_rad: float = math.radians(0.05)
    correlation_s: float = 1.5
    marker_m: float = 0.00008
    flipped_stations: int = 2
    lost_stations: int = 1


@dataclass(frozen=True)
class Recipe:
    """A session. Every random draw follows from `seed`; lengths in metres."""

    seed: int = 1
    image_size: tuple[int, int] = (640, 400)
    focal_share: float = 1.06
    """Focal length over the image's width."""
    stations: int = 22
    sweep_frames: int = 32
    camera_rate_hz: float = 12.0
    dwell_s: float = 0.75
    bow_m: float = 0.0003
    twist: float = 0.15
    dome_radius_m: float = 0.026
    led_exponent: float = 80.7
    """cos^80.7: 15 degrees full half-power angle."""
    led_tilt_rad: float = math.radians(0.35)
    led_power: float = 0.04
    led_diameter_m: float = 0.005
    ambient: float = 0.16
    """Room light, as a share of the mean irradiance at the focus."""
    working_points: int = 200
    sensor: SensorRecipe = field(default_factory=SensorRecipe)
    tracking: Tracking = field(default_factory=Tracking)

"""How far found lights are from true ones: over a working volume, and compared with their own standard deviations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal.records.calibration import Light, LightsSolution
from lpcal.simulate.leds import LedLight

DIM = 0.01
"""Points darker than this share of a light's brightest are left out of the irradiance."""


@dataclass(frozen=True)
class Errors:
    """One row a light; angles in radians, lengths in metres, irradiance relative."""

    direction: np.ndarray
    """(L, N) at the points."""
    aim: np.ndarray
    """(L,) of the direction at the focus, whose sigma is stated; where the distance is ill known it is less than over the volume."""
    irradiance: np.ndarray
    """(L, N) log ratio, its mean over all lights and points taken away; NaN where the light is dim."""
    position: np.ndarray
    """(L,) of the origin of H_CL, of a free light's source; NaN of a distant one."""
    axis: np.ndarray
    level: np.ndarray
    """(L,) log irradiance at the focus, its mean over the lights taken away."""
    sigma: np.ndarray
    """(L, 3) direction a tangent axis, position a coordinate, intensity; as the solver states them."""

    @property
    def nees(self) -> dict[str, float]:
        """Squared errors over what their stated sigmas expect: 1 where these are right."""
        return {
            "aim": float(np.mean(self.aim**2 / (2 * self.sigma[:, 0] ** 2))),
            "direction": float(np.mean(np.mean(self.direction**2, axis=1) / (2 * self.sigma[:, 0] ** 2))),
            "position": float(np.mean(self.position**2 / (3 * self.sigma[:, 1] ** 2))),
            "intensity": float(np.mean(self.level**2 / self.sigma[:, 2] ** 2)),
            "irradiance": float(np.mean(np.nanmean(self.irradiance**2, axis=1) / self.sigma[:, 2] ** 2)),
        }


def errors_of(found: LightsSolution, true: Sequence[LedLight], points_C: np.ndarray) -> Errors:
    """Errors of all lights at points (N, 3)."""
    direction, aim, irradiance, position, axis, level, sigma = [], [], [], [], [], [], []
    for light, real in zip(found.lights, true, strict=True):
        d, E, d_real, E_real = *_field(light, points_C), *_real(real, points_C)
        direction.append(np.arctan2(np.linalg.norm(np.cross(d, d_real), axis=1), np.sum(d * d_real, axis=1)))
        at_focus = [_field(light, found.focus_C[None])[0][0], _real(real, found.focus_C[None])[0][0]]
        aim.append(np.linalg.norm(np.cross(*at_focus)))
        irradiance.append(np.where(E_real > DIM * E_real.max(), np.log(E / E_real), np.nan))
        place, turn = _pose_error(light, real)
        position.append(place)
        axis.append(turn)
        level.append(float(np.log(_field(light, found.focus_C[None])[1] / _real(real, found.focus_C[None])[1])[0]))
        sigma.append([light.direction_std_rad, light.position_std_m, light.intensity_std])
    ratio = np.array(irradiance)
    return Errors(
        direction=np.array(direction),
        aim=np.array(aim),
        irradiance=ratio - np.nanmean(ratio),
        position=np.array(position),
        axis=np.array(axis),
        level=np.array(level) - np.mean(level),
        sigma=np.array(sigma),
    )


def _pose_error(light: Light, real: LedLight) -> tuple[float, float]:
    """Distance and angle of the axis: of a wing's frame; of a free light's source, whose axis is not known; NaN of a distant light."""
    if light.H_CL is None or light.source_C is None:
        return float("nan"), float("nan")
    if np.array_equal(light.H_CL[:3, 3], light.source_C):
        return float(np.linalg.norm(light.source_C - real.source_C)), float("nan")
    axis = np.arccos(min(1.0, float(light.H_CL[:3, 2] @ real.H_CL[:3, 2])))
    return float(np.linalg.norm(light.H_CL[:3, 3] - real.H_CL[:3, 3])), float(axis)


def _field(light: Light, points_C: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    d, E = light.field(points_C)
    return d, E.mean(axis=-1)


def _real(light: LedLight, points_C: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    total = light.field(points_C)
    E = np.linalg.norm(total, axis=1)
    return total / E[:, None], E


def rms(values: np.ndarray) -> float:
    """Root of the mean square of what is a number; NaN where nothing is."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(np.square(known)))) if known.size else float("nan")


def table_row(name: str, errors: Sequence[Errors]) -> str:
    """Figures of one or many rigs, in the units of the issue."""
    every = {
        key: np.concatenate([np.ravel(getattr(one, key)) for one in errors])
        for key in ("direction", "irradiance", "position", "axis", "level")
    }
    nees = {key: np.mean([one.nees[key] for one in errors]) for key in ("aim", "direction", "position", "intensity")}
    degrees = [np.degrees(value) for value in (rms(every["direction"]), every["direction"].max(), rms(every["axis"]))]
    return (
        f"{name:<22}{degrees[0]:8.3f}{degrees[1]:8.3f}{100 * rms(every['irradiance']):9.2f}{1e3 * rms(every['position']):10.2f}"
        f"{degrees[2]:8.2f}{nees['aim']:12.2f}{nees['direction']:8.2f}{nees['position']:6.2f}{nees['intensity']:6.2f}"
    )


HEADER = f"{'':<22}{'dir deg':>8}{'worst':>8}{'irr. %':>9}{'H_CL mm':>10}{'axis':>8}{'NEES: focus':>12}{'volume':>8}{'pos':>6}{'int':>6}"

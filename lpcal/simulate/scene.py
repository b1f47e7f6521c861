r"""An object or a sphere before a wall: what rays meet, and the light that lamps throw on it directly.

Symbols: x a point, n its normal, rho its albedo, V_k whether LED k is seen from it, d_k and E_k the unit vector to it and its irradiance::

    radiance = rho / pi sum_k V_k E_k max(n . d_k, 0)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.simulate.leds import LedLight
from lpcal.simulate.rays import TOUCH, blocked, cast
from lpcal.simulate.shapes import Shape

CARD_ALBEDO = 0.04
PROBES = (0, 8, 12, 16)
"""LEDs of a blob that are tried first: where all of them agree, so do the others."""


@dataclass(frozen=True)
class DrawnScene:
    """A shape at H_CS before a wall. `ambient` is the room's radiance on white, `wall_n_C` points to the camera."""

    shape: Shape
    H_CS: Array
    wall_x_C: Array
    wall_n_C: Array
    wall_albedo: float
    lights: tuple[LedLight, ...]
    ambient: float
    chrome: bool = False
    panel_radius_m: float = 0.0
    """Radius of the dark disc round the camera that chrome mirrors."""
    rod_m: float = 0.0
    """Radius of the dark rod on which the shape stands, seen edge on."""
    card_half_m: float = 0.0
    """Half the side of a dark card on the wall, behind the shape as the camera sees it."""


@dataclass(frozen=True)
class Points:
    """Where N rays end: positions and normals (N, 3), albedo, whether on the shape. Where a ray meets nothing the albedo is 0."""

    x_C: Array
    n_C: Array
    albedo: Array
    on_shape: Mask

    def __getitem__(self, some: Index | slice) -> Points:
        return Points(self.x_C[some], self.n_C[some], self.albedo[some], self.on_shape[some])


def meet(scene: DrawnScene, o_C: Array, d_C: Array, touch: float = TOUCH) -> Points:
    """What unit rays (N, 3) from o_C (3,) or (N, 3) meet first: the shape, else the wall. Nothing stands behind the wall."""
    H_SC = se3.inv(scene.H_CS)
    t = cast(scene.shape, se3.apply(H_SC, o_C), se3.rotate(H_SC, d_C), touch)
    on = np.isfinite(t)
    towards = d_C @ scene.wall_n_C
    behind = ((scene.wall_x_C - o_C) @ scene.wall_n_C) / np.where(towards < 0, towards, -np.inf)
    x_C = o_C + np.where(on, t, behind)[:, None] * d_C
    n_C = np.broadcast_to(scene.wall_n_C, x_C.shape).copy()
    albedo = np.where(towards < 0, wall_reflectance(scene, x_C), 0.0)
    if np.any(on):
        x_S = se3.apply(H_SC, x_C[on])
        n_C[on] = se3.rotate(scene.H_CS, scene.shape.normal(x_S))
        albedo[on] = scene.shape.reflectance(x_S)
    return Points(x_C, n_C, albedo, on)


def joined(parts: list[Points]) -> Points:
    """All of them as one."""
    x_C, n_C = (np.concatenate(arrays) for arrays in ([part.x_C for part in parts], [part.n_C for part in parts]))
    return Points(x_C, n_C, np.concatenate([part.albedo for part in parts]), np.concatenate([part.on_shape for part in parts]))


def wall_reflectance(scene: DrawnScene, x_C: Array) -> Array:
    """Albedo (N,) of the wall with its card at points (N, 3) of it."""
    behind = scene.wall_x_C[2] / scene.H_CS[2, 3] * scene.H_CS[:2, 3]
    on_card = np.abs(x_C[:, :2] - behind).max(axis=1) < scene.card_half_m
    grain = 1 + 0.02 * np.sin(70 * x_C[:, 0] + 1) * np.sin(55 * x_C[:, 1] + 2)
    return np.where(on_card, CARD_ALBEDO, scene.wall_albedo) * grain


def direct(scene: DrawnScene, points: Points, light: LedLight) -> Array:
    """Radiance (N,) of points under one light alone, without what they throw on each other."""
    seen = np.zeros((len(light.power), len(points.x_C)))
    for k, (position, axis, power) in enumerate(zip(light.position_C, light.axis_C, light.power, strict=True)):
        to_led = position - points.x_C
        r2 = np.einsum("ij,ij->i", to_led, to_led)
        r = np.sqrt(r2)
        cosine = np.maximum(-(to_led @ axis) / r, 1e-9)
        facing = np.maximum(np.einsum("ij,ij->i", to_led, points.n_C) / r, 0)
        seen[k] = power * np.exp(light.exponent * np.log(cosine)) / r2 * facing
    asked = np.flatnonzero((points.albedo > 0) & (seen.sum(axis=0) > 0))
    x_S = se3.apply(se3.inv(scene.H_CS), points.x_C[asked])
    led_S = se3.apply(se3.inv(scene.H_CS), light.position_C)
    seen[:, asked] *= ~_hidden(scene.shape, x_S, led_S)
    return np.asarray(points.albedo / np.pi * seen.sum(axis=0))


def _hidden(shape: Shape, x_S: Array, led_S: Array) -> Mask:
    """Which LEDs (n, N) each point does not see: a few are tried, and the others where these disagree."""
    probes = [k for k in PROBES if k < len(led_S)] if len(led_S) > 7 else list(range(len(led_S)))
    hidden = np.zeros((len(led_S), len(x_S)), dtype=bool)
    tried = _blocked_each(shape, x_S, led_S[probes])
    hidden[:] = tried[0]
    hidden[probes] = tried
    mixed = np.flatnonzero(tried.any(axis=0) & ~tried.all(axis=0))
    others = [k for k in range(len(led_S)) if k not in probes]
    if len(mixed) and others:
        hidden[np.ix_(others, mixed)] = _blocked_each(shape, x_S[mixed], led_S[others])
    return hidden


def _blocked_each(shape: Shape, x_S: Array, led_S: Array) -> Mask:
    """Whether each point (N, 3) is hidden from each LED (n, 3), as (n, N), in one pass."""
    pairs = len(led_S), len(x_S), 3
    points, targets = np.broadcast_to(x_S, pairs).reshape(-1, 3), np.broadcast_to(led_S[:, None], pairs).reshape(-1, 3)
    return blocked(shape, points, targets).reshape(pairs[:2])

r"""Images of an object or a sphere before a wall, each light by itself and the room's light by itself.

Symbols: x a point, n its normal, rho its albedo, V_k whether LED k is seen from it, d_k and E_k the unit vector to it and its irradiance::

    radiance = rho / pi sum_k V_k E_k max(n . d_k, 0)          a light
    radiance = rho A (1 + n . up / 3)                          the room

A pixel is one ray, or sixteen where an outline crosses it. A chrome sphere shows what its mirrored rays meet instead.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.simulate.leds import LedLight
from lpcal.simulate.lens import Lens
from lpcal.simulate.rays import blocked, cast
from lpcal.simulate.shapes import Shape

EDGE_OVERSAMPLING = 4
CHUNK = 1 << 15
MIRROR = 0.6
WALL_HALF_M = 0.45
"""Half the wall's side: beyond it a mirror shows the room."""
CARD_ALBEDO = 0.04
ROD_ALBEDO = 0.04
ROOM_SHARE = (0.6, 0.8)
"""Radiance of the room over that of a white surface in it: beside the object, and how much more of it behind the camera."""
PROBES = (0, 8, 12, 16)
"""LEDs of a blob that are tried first: where all of them agree, so do the others."""


@dataclass(frozen=True)
class Scene:
    """A shape at H_CS before a wall. `room` is the radiance of the surroundings, `wall_n_C` points to the camera."""

    shape: Shape
    H_CS: Array
    wall_x_C: Array
    wall_n_C: Array
    wall_albedo: float
    lights: tuple[LedLight, ...]
    ambient: float
    chrome: bool = False
    panel_radius_m: float = 0.0
    """Of the dark disc round the camera that chrome mirrors."""
    rod_m: float = 0.0
    """Radius of the dark rod on which the shape stands, seen edge on."""
    card_half_m: float = 0.0
    """Half the side of a dark card on the wall, behind the shape as the camera sees it."""


@dataclass(frozen=True)
class Rendered:
    """Light (L, H, W) of each light, (H, W) of the room, and the truth a pixel."""

    light: Array
    room: Array
    normals: Array
    depth: Array
    albedo: Array
    mask: Mask
    component: Labels


@dataclass(frozen=True)
class _Points:
    """What rays meet: position, normal, albedo, whether on the shape; `glow` is room light that is not shaded (mirrored surroundings)."""

    x_C: Array
    n_C: Array
    albedo: Array
    on_shape: Mask
    glow: Array


def render(lens: Lens, scene: Scene) -> Rendered:
    """All lights and the room, unblurred, with the truth at the pixels' centres."""
    width, height = lens.image_size
    plane = lens.grid().reshape(-1, 2)
    met, component = _meet(scene, plane)
    edge = _edges(met, component, (height, width), 3 if scene.chrome else 1)
    plain = np.flatnonzero(~edge)
    crossed = np.flatnonzero(edge)
    n = EDGE_OVERSAMPLING
    offset = (np.arange(n) + 0.5) / n - 0.5
    at = np.stack([crossed % width, crossed // width], axis=1)[:, None] + np.stack(np.meshgrid(offset, offset), axis=-1).reshape(1, -1, 2)
    rays = np.concatenate([plane[plain], lens.plane(at.reshape(-1, 2))])
    pixel = np.concatenate([plain, np.repeat(crossed, n * n)])
    weight = np.concatenate([np.ones(len(plain)), np.full(len(crossed) * n * n, 1 / n**2)])
    light, room = np.zeros((len(scene.lights), width * height)), np.zeros(width * height)
    for start in range(0, len(rays), CHUNK):
        part = slice(start, start + CHUNK)
        points, _ = _meet(scene, rays[part])
        shown = _mirrored(scene, points, rays[part]) if scene.chrome else points
        for k, one in enumerate(scene.lights):
            light[k] += np.bincount(pixel[part], weight[part] * _shade(scene, shown, one), width * height)
        soft = shown.albedo * scene.ambient * (1 - shown.n_C[:, 1] / 3) + shown.glow
        room += np.bincount(pixel[part], weight[part] * soft, width * height)
    return Rendered(
        light=light.reshape(-1, height, width),
        room=room.reshape(height, width),
        normals=np.where(met.on_shape[:, None], met.n_C, np.nan).reshape(height, width, 3),
        depth=np.where(met.on_shape, met.x_C[:, 2], np.nan).reshape(height, width),
        albedo=np.where(met.on_shape, met.albedo, np.nan).reshape(height, width),
        mask=met.on_shape.reshape(height, width),
        component=component.reshape(height, width),
    )


def _meet(scene: Scene, plane: Array) -> tuple[_Points, Labels]:
    """What rays (N, 2) of the image meet first: the shape, else the wall."""
    d_C = np.column_stack([plane, np.ones(len(plane))])
    d_C /= np.linalg.norm(d_C, axis=1, keepdims=True)
    H_SC = se3.inv(scene.H_CS)
    t = cast(scene.shape, H_SC[:3, 3], se3.rotate(H_SC, d_C))
    on = np.isfinite(t)
    behind = (scene.wall_x_C @ scene.wall_n_C) / (d_C @ scene.wall_n_C)
    x_C = np.where(on, t, behind)[:, None] * d_C
    n_C = np.broadcast_to(scene.wall_n_C, x_C.shape).copy()
    albedo = _wall_reflectance(scene, x_C)
    on_rod = ~on & _rod(scene, d_C)
    x_C[on_rod] = d_C[on_rod] * (scene.H_CS[2, 3] / d_C[on_rod, 2])[:, None]
    albedo[on_rod] = ROD_ALBEDO
    component = np.zeros(len(x_C), np.uint8)
    if np.any(on):
        x_S = se3.apply(H_SC, x_C[on])
        n_C[on] = se3.rotate(scene.H_CS, scene.shape.normal(x_S))
        albedo[on] = scene.shape.reflectance(x_S)
        component[on] = scene.shape.component(x_S)
    return _Points(x_C, n_C, albedo, on, np.zeros(len(x_C))), component


def _wall_reflectance(scene: Scene, x_C: Array) -> Array:
    """Albedo (N,) of the wall with its card at points (N, 3) of it."""
    behind = scene.wall_x_C[2] / scene.H_CS[2, 3] * scene.H_CS[:2, 3]
    on_card = np.abs(x_C[:, :2] - behind).max(axis=1) < scene.card_half_m
    grain = 1 + 0.02 * np.sin(70 * x_C[:, 0] + 1) * np.sin(55 * x_C[:, 1] + 2)
    return np.where(on_card, CARD_ALBEDO, scene.wall_albedo) * grain


def _rod(scene: Scene, d_C: Array) -> Mask:
    """Rays that meet the rod: it goes down from the shape's middle, in the plane of that depth."""
    at = d_C[:, :2] * (scene.H_CS[2, 3] / d_C[:, 2])[:, None] - scene.H_CS[:2, 3]
    return np.asarray((np.abs(at[:, 0] + 0.03 * at[:, 1]) < scene.rod_m) & (at[:, 1] > 0))


def _edges(met: _Points, component: Labels, size: tuple[int, int], reach: int) -> Mask:
    """Pixels (H*W,) that an outline or a jump in depth may cross."""
    from scipy.ndimage import binary_dilation, maximum_filter, minimum_filter

    label, depth = component.reshape(size), met.x_C[:, 2].reshape(size)
    across = (maximum_filter(label, 3) != minimum_filter(label, 3)) | (maximum_filter(depth, 3) - minimum_filter(depth, 3) > 0.02 * depth)
    near = binary_dilation(label > 0, iterations=3)
    return np.asarray(binary_dilation(across & near, iterations=reach)).ravel()


def _mirrored(scene: Scene, points: _Points, plane: Array) -> _Points:
    """Points that a chrome sphere shows in place of its own: the wall behind it, the dark panel, or the room."""
    d_C = np.column_stack([plane, np.ones(len(plane))])
    d_C /= np.linalg.norm(d_C, axis=1, keepdims=True)
    r_C = d_C - 2 * np.sum(d_C * points.n_C, axis=1, keepdims=True) * points.n_C
    away = -(r_C @ scene.wall_n_C)
    s = ((scene.wall_x_C - points.x_C) @ -scene.wall_n_C) / np.maximum(away, 1e-6)
    at_wall = points.x_C[:, :2] + s[:, None] * r_C[:, :2] - scene.H_CS[:2, 3]
    to_wall = points.on_shape & (away > 0.02) & (np.abs(at_wall).max(axis=1) < WALL_HALF_M)
    to_room = points.on_shape & ~to_wall
    x_C = np.where(to_wall[:, None], points.x_C + s[:, None] * r_C, points.x_C)
    n_C = np.where(points.on_shape[:, None], scene.wall_n_C, points.n_C)
    albedo = np.where(to_wall, MIRROR * _wall_reflectance(scene, x_C), np.where(to_room, 0.0, points.albedo))
    back = points.x_C[:, 2] / np.maximum(-r_C[:, 2], 1e-6)
    at_panel = points.x_C[:, :2] + back[:, None] * r_C[:, :2]
    dark = (r_C[:, 2] < 0) & (np.hypot(*at_panel.T) < scene.panel_radius_m)
    front = np.clip(-r_C[:, 2], 0, 1) ** 2
    cloud = 1 - 0.3 * r_C[:, 1] + 0.2 * np.sin(5 * r_C[:, 0] + 1) * np.sin(4 * r_C[:, 1])
    sky = scene.ambient * (ROOM_SHARE[0] + ROOM_SHARE[1] * front) * cloud
    return _Points(x_C, n_C, albedo, points.on_shape & ~to_wall, np.where(to_room, MIRROR * np.where(dark, 0.15, 1.0) * sky, 0.0))


def _shade(scene: Scene, points: _Points, light: LedLight) -> Array:
    """Radiance (N,) from one light."""
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
    hidden = _hidden(scene.shape, x_S, led_S)
    seen[:, asked] *= ~hidden
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

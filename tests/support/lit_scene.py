"""A small scene under near lights, drawn with more detail than the solver's model.

A matte sphere before a wall; six lights of four LEDs each, so that shadows have penumbrae; each pixel is the mean of nine rays; noise,
ambient light and quantisation. The calibration that comes with it takes each light as one source.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.records.calibration import Calibration, Camera, Light, Lobe
from lpcal.records.observations import RawCapture

SIZE = (160, 112)
K = np.array([[170.0, 0, 80.2], [0, 170.0, 55.1], [0, 0, 1]])
EXPONENT = 6.0
FOCUS = np.array([0.0, 0.0, 0.35])


@dataclass(frozen=True)
class Scene:
    """A sphere (None: none) before a wall; metres in C."""

    centre: tuple[float, float, float] | None = (0.004, -0.003, 0.36)
    radius: float = 0.04
    wall_z: float = 0.45
    albedo: tuple[float, ...] = (0.7,)
    wall_albedo: float = 0.35
    gloss: float = 0.0
    room: float = 0.0
    """Light from all sides, a unit of albedo, more than first harmonics; 0: a glow that is everywhere the same."""


def calibration(lights: int = 6, ring: float = 0.16) -> Calibration:
    made = []
    for k in range(lights):
        angle = 2 * np.pi * k / lights + 0.1
        source = np.array([ring * np.cos(angle), ring * np.sin(angle), 0.03])
        axis = (FOCUS - source) / np.linalg.norm(FOCUS - source)
        intensity = np.array([1.0 + 0.1 * (-1) ** k])
        made.append(Light(f"L{k}", -axis, intensity, None, source, axis, Lobe("cosine", exponent=EXPONENT), 0.001, 0.001, 0.002))
    mean = np.mean([light.intensity[0] for light in made])
    made = [replace(light, intensity=light.intensity / mean) for light in made]
    return Calibration("scene", tuple(made), Camera(SIZE, "opencv4", K, np.zeros(4)), None, 0.35, FOCUS)


def truth(scene: Scene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mask of the sphere, depth and normals (H, W, ...) at pixel centres."""
    column, row = np.meshgrid(np.arange(SIZE[0], dtype=float), np.arange(SIZE[1], dtype=float))
    x, n, _, on = _surface(scene, column, row)
    return on, x[..., 2], n


def draw(scene: Scene, lights: Calibration, seed: int = 0, noise: float = 0.002, bits: int = 12) -> RawCapture:
    """The capture, exposed so that the brightest pixel is at nine tenths."""
    rng = np.random.default_rng(seed)
    stack = np.mean([_signals(scene, lights, dx, dy) for dx in (-1 / 3, 0, 1 / 3) for dy in (-1 / 3, 0, 1 / 3)], axis=0)
    stack *= 0.75 / stack.max()
    ambient = room_light(scene) if scene.room else 0.05 * np.ones_like(stack[0])
    full = 2**bits - 1

    def stored(linear: np.ndarray) -> np.ndarray:
        return (np.clip(np.rint(full * (linear + noise * rng.standard_normal(linear.shape))), 0, full) / full).astype(np.float32)

    return RawCapture(
        "scene",
        tuple(light.name for light in lights.lights),
        stored(stack + ambient),
        np.ones(len(stack)),
        stored(ambient)[None],
        np.ones(1),
        step=1 / full,
    )


def room_light(scene: Scene) -> np.ndarray:
    """What the room adds to every image."""
    column, row = np.meshgrid(np.arange(SIZE[0], dtype=float), np.arange(SIZE[1], dtype=float))
    _, n, albedo, _ = _surface(scene, column, row)
    light = scene.room * (1 - 0.3 * n[..., 1] + 0.1 * n[..., 0] + 0.15 * n[..., 0] * n[..., 2])
    return 0.75 * (albedo * light[..., None] if len(scene.albedo) == 3 else albedo[..., 0] * light)


def _signals(scene: Scene, lights: Calibration, dx: float, dy: float) -> np.ndarray:
    column, row = np.meshgrid(np.arange(SIZE[0]) + dx, np.arange(SIZE[1]) + dy)
    x, n, albedo, _ = _surface(scene, column, row)
    v = -x / np.sqrt(_dot(x, x))[..., None]
    found = []
    for light in lights.lights:
        assert light.axis_C is not None
        assert light.source_C is not None
        side = np.cross(light.axis_C, [0, 1, 0.3])
        side /= np.linalg.norm(side)
        up = np.cross(light.axis_C, side)
        total = 0.0
        for a, b in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            led = light.source_C + 0.003 * (a * side + b * up)
            to_led = led - x
            r2 = _dot(to_led, to_led)
            d = to_led / np.sqrt(r2)[..., None]
            E = light.intensity * np.maximum(-(d @ light.axis_C), 0) ** EXPONENT / r2
            sent = albedo * np.maximum(_dot(n, d), 0)[..., None]
            if scene.gloss:
                h = d + v
                sent = sent + (scene.gloss * np.maximum(_dot(n, h) / np.sqrt(_dot(h, h)), 0) ** 120)[..., None]
            total = total + (E * ~_hidden(scene, x, led))[..., None] * sent / 4
        found.append(total)
    stack = np.stack(found)
    return stack if len(scene.albedo) == 3 else stack[..., 0]


def _surface(scene: Scene, column: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, ...]:
    ray = np.stack([(column - K[0, 2]) / K[0, 0], (row - K[1, 2]) / K[1, 1], np.ones_like(column)], axis=-1)
    x, n = ray * scene.wall_z, np.broadcast_to([0.0, 0.0, -1.0], ray.shape).copy()
    on = np.zeros(column.shape, bool)
    albedo = np.full((*column.shape, len(scene.albedo)), scene.wall_albedo)
    if scene.centre is not None:
        c = np.array(scene.centre)
        a, b = np.sum(ray * ray, axis=-1), ray @ c
        under = b**2 - a * (c @ c - scene.radius**2)
        on = under > 0
        t = (b - np.sqrt(np.maximum(under, 0))) / a
        x[on] = (t[..., None] * ray)[on]
        n[on] = (x[on] - c) / scene.radius
        albedo[on] = scene.albedo
    return x, n, albedo, on


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Over the last axis of three, much faster than its sum."""
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def _hidden(scene: Scene, x: np.ndarray, led: np.ndarray) -> np.ndarray:
    """Whether the sphere stands between points and an LED."""
    if scene.centre is None:
        return np.zeros(x.shape[:-1], bool)
    d = led - x
    f = x - np.array(scene.centre)
    a, b = _dot(d, d), _dot(d, f)
    under = b**2 - a * (_dot(f, f) - scene.radius**2)
    t = (-b - np.sqrt(np.maximum(under, 0))) / a
    return (under > 0) & (t > 1e-6) & (t < 1)

r"""The lights' images in a chrome sphere, LED by LED.

Symbols: sphere of centre c and radius R, camera at the origin, LED at p; in the plane of camera, centre and LED the mirror point is
``P = c + R (cos h e_a + sin h e_b)`` with e_a towards the camera and the LED at the angle g from it (Alhazen's problem). Its two parts of
the angle are equal::

    (P - c) bisects the directions from P to the camera and to the LED

With s and t the distances from P to the LED and to the camera, i the angle of incidence, I the LED's intensity that way, the camera gets::

    E = I / [(s + t + 2 s t / (R cos i)) (s + t + 2 s t cos i / R)]

Source: Coddington's equations for a convex mirror.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.simulate.leds import LedLight
from lpcal.simulate.lens import Lens

BISECTIONS = 60


def mirror_point(centre_C: Array, radius_m: float, led_C: Array) -> Array:
    """Points (N, 3) of the sphere that mirror LEDs (N, 3) into the camera."""
    to_camera, to_led = -centre_C, led_C - centre_C
    b = np.linalg.norm(to_led, axis=1, keepdims=True)
    e_a = to_camera / np.linalg.norm(to_camera)
    cosine = np.clip(to_led @ e_a / b[:, 0], -1, 1)
    e_b = to_led - (to_led @ e_a)[:, None] * e_a
    e_b /= np.maximum(np.linalg.norm(e_b, axis=1, keepdims=True), 1e-15)
    low, high = np.zeros(len(led_C)), np.arccos(cosine)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        n = np.cos(middle)[:, None] * e_a + np.sin(middle)[:, None] * e_b
        P = centre_C + radius_m * n
        incident = _angle(n, -P)
        mirrored = _angle(n, led_C - P)
        low, high = np.where(incident < mirrored, middle, low), np.where(incident < mirrored, high, middle)
    n = np.cos(low)[:, None] * e_a + np.sin(low)[:, None] * e_b
    return np.asarray(centre_C + radius_m * n)


def highlight(lens: Lens, centre_C: Array, radius_m: float, light: LedLight, reflectance: float) -> tuple[Array, Array]:
    """Pixels (n, 2) of a light's LEDs in the sphere and the flux (n,) of each, in radiance summed over pixels."""
    P = mirror_point(centre_C, radius_m, light.position_C)
    n = (P - centre_C) / radius_m
    to_led, to_camera = light.position_C - P, -P
    s, t = np.linalg.norm(to_led, axis=1), np.linalg.norm(to_camera, axis=1)
    cos_i = np.sum(n * to_camera, axis=1) / t
    emitted = light.power * np.maximum(-np.sum(to_led * light.axis_C, axis=1) / s, 0) ** light.exponent
    irradiance = reflectance * emitted / ((s + t + 2 * s * t / (radius_m * cos_i)) * (s + t + 2 * s * t * cos_i / radius_m))
    pixel_angle = (P[:, 2] / t) ** 3 / (lens.K[0, 0] * lens.K[1, 1])
    return lens.project(P), np.where(cos_i > 0, irradiance / pixel_angle, 0.0)


def led_image_sigma(lens: Lens, centre_C: Array, radius_m: float, light: LedLight, diameter_m: float) -> float:
    """Sigma in pixels of one LED's own disc in the sphere: a quarter of its diameter, demagnified by R / (2 s + R)."""
    s = float(np.linalg.norm(light.position_C[0] - centre_C))
    return float(diameter_m / 4 * radius_m / (2 * s + radius_m) * lens.K[0, 0] / centre_C[2])


def _angle(a: Array, b: Array) -> Array:
    return np.asarray(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.sum(a * b, axis=1)))

r"""A sphere seen by a central camera at the origin.

Symbols: centre C, radius R, unit ray u, light at L, mirror point P with normal n::

    outline rays u_k touch the sphere:      u_k . w = 1  with  w = C / sqrt(|C|^2 - R^2),  C = R w / sqrt(|w|^2 - 1)
    ray u meets it at P = t u,              t = u.C - sqrt((u.C)^2 - |C|^2 + R^2),  n = (P - C) / R
    its mirror image of u                   r = u - 2 (u.n) n
    Alhazen: with A = -C, B = L - C of lengths a, b and gamma between them, P = C + R (cos th e_a + sin th e_b) where
             a b sin(2 th - gamma) = R (a sin th - b sin(gamma - th))

Source: the tangent cone of a sphere (elementary); Alhazen's problem in the plane of camera, centre and light.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array

NEWTON_STEPS = 8


def from_outline(u_C: Array, radius: float) -> Array:
    """Centre C (3,) of a sphere of known radius whose outline rays are u_C (K, 3), K >= 3; least squares.

    Raises
    ------
    ValueError
        The rays are not those of a sphere before the camera.
    """
    w = np.linalg.lstsq(u_C, np.ones(len(u_C)), rcond=None)[0]
    excess = w @ w - 1
    if not excess > 0:
        msg = "the outline is not that of a sphere in front of the camera"
        raise ValueError(msg)
    return radius * w / np.sqrt(excess)


def outline(centre_C: Array, radius: float, around_rad: Array) -> Array:
    """Unit rays (K, 3) that touch the sphere, at angles around_rad (K,) about the line of sight to its centre."""
    distance = np.linalg.norm(centre_C)
    forward = centre_C / distance
    right = np.cross(forward, [0.0, 1.0, 0.0] if abs(forward[1]) < 0.9 else [1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    half = np.arcsin(radius / distance)
    ring = np.cos(around_rad)[:, None] * right + np.sin(around_rad)[:, None] * down
    return np.cos(half) * forward + np.sin(half) * ring


def meet(u_C: Array, centre_C: Array, radius: float) -> tuple[Array, Array]:
    """Points P (..., 3) where unit rays u_C (..., 3) meet the sphere and normals n (..., 3) there; NaN where they miss it."""
    along = u_C @ centre_C
    root2 = along**2 - centre_C @ centre_C + radius**2
    t = along - np.sqrt(np.where(root2 >= 0, root2, np.nan))
    P = t[..., None] * u_C
    return P, (P - centre_C) / radius


def reflect(u: Array, n: Array) -> Array:
    """Mirror image (..., 3) of directions u (..., 3) in planes of unit normal n (..., 3)."""
    return u - 2 * np.sum(u * n, axis=-1, keepdims=True) * n


def mirror_point(centre_C: Array, radius: float | Array, light_C: Array) -> Array:
    """Points (..., 3) of spheres in which a camera at the origin sees lights at light_C (..., 3); one radius, or one each (...,)."""
    A = -np.broadcast_to(centre_C, light_C.shape)
    B = light_C - centre_C
    a, b = np.linalg.norm(A, axis=-1), np.linalg.norm(B, axis=-1)
    e_a = A / a[..., None]
    across = B - np.sum(B * e_a, axis=-1, keepdims=True) * e_a
    length = np.linalg.norm(across, axis=-1)
    e_b = across / np.maximum(length, 1e-300)[..., None]
    gamma = np.arctan2(length, np.sum(B * e_a, axis=-1))
    th = gamma / 2
    for _ in range(NEWTON_STEPS):
        f = a * b * np.sin(2 * th - gamma) - radius * (a * np.sin(th) - b * np.sin(gamma - th))
        slope = 2 * a * b * np.cos(2 * th - gamma) - radius * (a * np.cos(th) + b * np.cos(gamma - th))
        th = th - f / slope
    return np.asarray(centre_C + np.asarray(radius)[..., None] * (np.cos(th)[..., None] * e_a + np.sin(th)[..., None] * e_b))

"""The residuals of the lights' geometry, written for one observation in casadi's terms; `geometry_fit` says what they mean.

Data of a highlight: ray u (3), A (2x3, a row after another) already divided by sigma, radius. Of an outline: measured centre (3), its
derivative by the bias (3), square root of the information (3x3). Where the camera's parameters are free (`core`), the derivative of the ray
or of the measured centre by them (3xP) follows, and every residual takes their change before its data.
"""

from __future__ import annotations

from typing import Any

from lpcal.geometry.least_squares import matrix

NEWTON_STEPS = 6


def outline(centre: Any, bias: Any, *rest: Any) -> Any:
    """Sphere centre against its outline."""
    data = moved_ray(15, *rest)
    return matrix(data[6:15], 3, 3) @ (centre - data[:3] - data[3:6] * bias)


def wing_highlight(H_CD: Any, setting: Any, offset: Any, centre: Any, *rest: Any) -> Any:
    """Highlight of a light on a wing."""
    import casadi as ca

    azimuth, g, d1, d2 = setting[0], setting[1], setting[2], setting[3]
    reach, height = d1 + d2 * ca.cos(g) - offset * ca.sin(g), d2 * ca.sin(g) + offset * ca.cos(g)
    source_D = ca.vertcat(ca.cos(azimuth) * reach, ca.sin(azimuth) * reach, height)
    return free_highlight(H_CD[:3, :3] @ source_D + H_CD[:3, 3], centre, *rest)


def free_highlight(source: Any, centre: Any, *rest: Any) -> Any:
    """Highlight of a light at a point."""
    data = moved_ray(10, *rest)
    u, A = data[:3], matrix(data[3:9], 2, 3)
    P = mirror_point(centre, data[9], source)
    return A @ (P / (P.T @ u) - u)


def moved_ray(width: int, *rest: Any) -> Any:
    """Data whose first three numbers, a ray or a place, have moved with the camera's parameters, if these are free."""
    import casadi as ca

    if len(rest) == 1:
        return rest[0]
    core, data = rest
    return ca.vertcat(data[:3] + matrix(data[width:], 3, core.numel()) @ core, data[3:width])


def mirror_point(centre: Any, radius: Any, source: Any) -> Any:
    """The point of a sphere in which a camera at the origin sees a source, by unrolled Newton steps (geometry.sphere)."""
    import casadi as ca

    A, B = -centre, source - centre
    a, b = ca.norm_2(A), ca.norm_2(B)
    e_a = A / a
    across = B - (B.T @ e_a) * e_a
    length = ca.norm_2(across)
    gamma = ca.atan2(length, B.T @ e_a)
    th = gamma / 2
    for _ in range(NEWTON_STEPS):
        f = a * b * ca.sin(2 * th - gamma) - radius * (a * ca.sin(th) - b * ca.sin(gamma - th))
        th = th - f / (2 * a * b * ca.cos(2 * th - gamma) - radius * (a * ca.cos(th) + b * ca.cos(gamma - th)))
    return centre + radius * (ca.cos(th) * e_a + ca.sin(th) * across / length)

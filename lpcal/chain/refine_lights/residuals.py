r"""The residuals of the lights' geometry, written for one observation in casadi's terms; `geometry_fit` says what they mean.

Data of a highlight: ray u (3), A (2x3, a row after another) already divided by sigma, radius. Of an outline: measured centre (3), its
derivative by the bias (3), square root of the information (3x3). Where the camera's parameters are free (`core`), the derivative of the ray
or of the measured centre by them (3xP) follows, and every residual takes their change before its data.

Lights as the sum of their LEDs: geometry, roll, power and tilt of every LED, intensities and albedos in one problem.

Symbols: LED i of light k stands at ``[0, 0, h] + R o_i`` in L, o_i its nominal direction turned by the blob's roll, and emits with power
p_i along a_i, which is o_i but for two small tilts: the dome holds the LED, its die sits askew. Dome height h and radius R are one for
all blobs of a mode. Block b of matte sphere s, ray u, point P::

    r = [log data - log I_k - log rho_s - delta_b - log c - log sum_i p_i cos^m(a_i, P - x_i) (n . d_i) / |P - x_i|^2] / sigma

``c`` is what the mean over the block's own pixels is to its centre, kept from the last round. delta_b (sd 2 %) cancels the texture,
powers (sd 4 %) and tilts (sd 0.5 deg) are priors. A highlight is the mirror image of the LEDs' mean place, weighted
with how they shine at where the sphere mirrors the dome's centre. Source: maximum a posteriori estimation; LED pattern and scatter from the
datasheet.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from lpcal.chain.refine_lights.unknowns import LightUnknown as Unknown
from lpcal.chain.refine_lights.unknowns import leds_of
from lpcal.geometry import led_cluster
from lpcal.geometry.arrays import Array, Index
from lpcal.geometry.least_squares import POSE, Model, Term, compile_residual, matrix

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


def with_free_core(core: int) -> tuple[int, ...]:
    """The size of the block of the camera's parameters, if they are free."""
    return (core,) if core else ()


POWER_SD, TILT_SD_RAD = 0.04, float(np.radians(0.5))
DOME_M, DOME_SIGMA_M = np.array([-0.025, 0.027]), np.array([0.030, 0.010])
"""Height of the dome's centre on the axis and its radius, and how surely."""
SHADING_DATA = 6
"""Numbers of a block's data but for the derivative by the camera's parameters."""
ROLLS_RAD = np.radians(np.arange(0.0, 60.0, 5.0))


@dataclass(frozen=True)
class Cluster:
    """The nominal LEDs of a mode."""

    leds: int

    @property
    def axes(self) -> Array:
        """(n, 3) in L, before roll and tilt."""
        return led_cluster.led_axes(self.leds)

    @property
    def exponent(self) -> float:
        """Exponent of one LED's lobe."""
        return led_cluster.exponent(led_cluster.HALF_POWER_RAD)

    def axes_of(self, roll: float, led: Array) -> tuple[Array, Array]:
        """Directions (n, 3) in which the LEDs stand on the dome, and axes (n, 3); led (3 n,) as log power, tilt, tilt of each."""
        tilt = led.reshape(-1, 3)[:, 1:]
        e1, e2 = _across(self.axes)
        turned = self.axes + tilt[:, :1] * e1 + tilt[:, 1:] * e2
        turned /= np.linalg.norm(turned, axis=1, keepdims=True)
        c, s = np.cos(roll), np.sin(roll)
        by_roll = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        return self.axes @ by_roll, turned @ by_roll

    def symbolic(self, roll: Any, led: Any, dome: Any) -> list[tuple[Any, Any, Any]]:
        """(place in L, axis in L, power) of each LED in casadi's terms."""
        import casadi as ca

        e1, e2 = _across(self.axes)
        c, s = ca.cos(roll), ca.sin(roll)
        R = ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1))
        found = []
        for i, axis in enumerate(self.axes):
            turned = ca.DM(axis) + led[3 * i + 1] * ca.DM(e1[i]) + led[3 * i + 2] * ca.DM(e2[i])
            place = ca.vertcat(0, 0, dome[0]) + dome[1] * (R @ ca.DM(axis))
            found.append((place, R @ (turned / ca.norm_2(turned)), ca.exp(led[3 * i])))
        return found


def highlights(cluster: Cluster, where: tuple[Index, ...], data: Array, robust: float, core: int) -> Term:
    """Chrome highlights: `where` rows of the light, its wing, its mode, and the sphere; data as in `residuals.wing_highlight`."""
    light, wing, mode, centre = where
    more = core > 0
    blocks = (Unknown.H_CD, Unknown.SETTING, Unknown.DOME, Unknown.ROLL, leds_of(cluster.leds), Unknown.CENTRE, *[Unknown.CORE] * more)
    items: tuple[Index | int, ...] = (0, wing, mode, light, light, centre, *[0] * more)
    return Term(_highlight_model(cluster, core, data.shape[1]), blocks, items, data, robust=robust, group=2)


@cache
def _highlight_model(cluster: Cluster, core: int, width: int) -> Model:
    def residual(H_CD: Any, setting: Any, dome: Any, roll: Any, led: Any, centre: Any, *seen: Any) -> Any:
        H_CL = H_CD @ wing_frame(setting)
        mirror_C = mirror_point(centre, seen[-1][9], H_CL[:3, 3] + dome[0] * H_CL[:3, 2])
        x_L = H_CL[:3, :3].T @ (mirror_C - H_CL[:3, 3])
        weight, mean = 0, 0
        for place, axis, power in cluster.symbolic(roll, led, dome):
            light_here = power * _lit(place, axis, x_L, cluster.exponent)
            weight, mean = weight + light_here, mean + light_here * place
        source = H_CL[:3, :3] @ (mean / weight) + H_CL[:3, 3]
        return free_highlight(source, centre, *seen)

    return compile_residual(residual, (POSE, 4, 2, 1, 3 * cluster.leds, 3, *with_free_core(core)), width)


def shading(cluster: Cluster, where: tuple[Index, ...], data: Array, robust: float, core: int) -> Term:
    """Matte blocks: `where` rows of the light, its wing, its mode, the sphere, the sphere's albedo, the block.

    Data: ray u (3), radius, log(data / c), 1 / sigma; with `core` of the camera's parameters free, the ray's derivative by them (3xP).
    """
    light, wing, mode, centre, albedo, block = where
    more = core > 0
    blocks = (
        Unknown.H_CD,
        Unknown.SETTING,
        Unknown.DOME,
        Unknown.ROLL,
        leds_of(cluster.leds),
        Unknown.INTENSITY,
        Unknown.ALBEDO,
        Unknown.CENTRE,
        Unknown.DELTA,
        *[Unknown.CORE] * more,
    )
    items: tuple[Index | int, ...] = (0, wing, mode, light, light, light, albedo, centre, block, *[0] * more)
    return Term(_shading_model(cluster, core, data.shape[1]), blocks, items, data, robust=robust)


@cache
def _shading_model(cluster: Cluster, core: int, width: int) -> Model:
    import casadi as ca

    def residual(
        H_CD: Any, setting: Any, dome: Any, roll: Any, led: Any, intensity: Any, albedo: Any, centre: Any, delta: Any, *rest: Any
    ) -> Any:
        seen = moved_ray(SHADING_DATA, *rest)
        u, radius = seen[:3], seen[3]
        along = u.T @ centre
        P = u * (along - ca.sqrt(along**2 - centre.T @ centre + radius**2))
        n = (P - centre) / radius
        H_CL = H_CD @ wing_frame(setting)
        x_L, n_L = H_CL[:3, :3].T @ (P - H_CL[:3, 3]), H_CL[:3, :3].T @ n
        total = 0
        for place, axis, power in cluster.symbolic(roll, led, dome):
            to_led = place - x_L
            total += power * _lit(place, axis, x_L, cluster.exponent) * (n_L.T @ to_led) / ca.norm_2(to_led)
        return (seen[4] - ca.log(total) - intensity - albedo - delta) * seen[5]

    return compile_residual(residual, (POSE, 4, 2, 1, 3 * cluster.leds, 1, 1, 3, 1, *with_free_core(core)), width)


def wing_frame(setting: Any) -> Any:
    """H_DL of a setting in casadi's terms."""
    import casadi as ca

    ca_, sa, cg, sg = ca.cos(setting[0]), ca.sin(setting[0]), ca.cos(setting[1]), ca.sin(setting[1])
    reach, height = setting[2] + setting[3] * cg, setting[3] * sg
    return ca.vertcat(
        ca.horzcat(ca_ * cg, -sa, -ca_ * sg, ca_ * reach),
        ca.horzcat(sa * cg, ca_, -sa * sg, sa * reach),
        ca.horzcat(sg, 0, cg, height),
        ca.horzcat(0, 0, 0, 1),
    )


def led_prior(count: int, leds: int, scatter: tuple[float, float] = (1.0, 1.0)) -> tuple[Array, Array]:
    """Mean (3 n,) and covariance (3 n, 3 n) of the LEDs' log powers and tilts, whose deviations are `scatter` times what is stated."""
    power_sd, tilt_sd = POWER_SD * scatter[0], TILT_SD_RAD * scatter[1]
    sd = np.tile([power_sd, tilt_sd, tilt_sd], leds)
    return np.zeros((count, 3 * leds)), np.diag(sd**2)


def scan_roll(cluster: Cluster, angle_rad: Array, around_rad: Array, log_lobe: Array) -> float:
    """The roll that explains a light's samples of its lobe best, (N,) angles from and around the axis, log values up to a constant."""
    direction = np.stack([np.sin(angle_rad) * np.cos(around_rad), np.sin(angle_rad) * np.sin(around_rad), np.cos(angle_rad)], axis=1)
    nothing = np.zeros(3 * cluster.leds)
    misfits = []
    for roll in ROLLS_RAD:
        lobe = np.sum(np.maximum(direction @ cluster.axes_of(roll, nothing)[1].T, 1e-6) ** cluster.exponent, axis=1)
        misfits.append(np.var(log_lobe - np.log(lobe)))
    return float(ROLLS_RAD[int(np.argmin(misfits))])


def _lit(place: Any, axis: Any, x_L: Any, exponent: float) -> Any:
    """Irradiance of one LED of power 1 on a surface that faces it at x."""
    import casadi as ca

    ray = x_L - place
    r2 = ray.T @ ray
    return ca.exp(exponent * ca.log(ca.fmax(ray.T @ axis / ca.sqrt(r2), 1e-6))) / r2


def _across(axes: Array) -> tuple[Array, Array]:
    """Two unit vectors (n, 3) across each axis."""
    e1 = np.cross(axes, np.where(np.abs(axes[:, :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    e1 /= np.linalg.norm(e1, axis=1, keepdims=True)
    return e1, np.cross(axes, e1)

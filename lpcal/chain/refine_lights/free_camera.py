r"""The camera's own parameters in the lights' problem, for the solve of camera, hand-eye, wings and spheres together.

Symbols: parameters k with covariance S as the boards left them; a pixel's ray moves by ``u(k + d) = u + U d``, a sphere's centre from its
outline by ``c + C d``. The change d is one more unknown with prior ``d ~ N(0, S)``: what the boards said of the camera, in its few numbers.
Source: sufficient statistics of a Gaussian posterior; first order in d, which is a few hundredths of a pixel.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera

CORE = ("fx", "fy", "cx", "cy")
STEP = 1e-3
"""Step of a difference quotient, as a share of the parameter's standard deviation: rays are smooth over one or two of these."""


def core_size(camera: Camera) -> int:
    """Number of parameters that are free; 0 for a camera without a covariance, or one that is a spline."""
    return 0 if camera.covariance is None or camera.spline is not None else len(camera.parameters)


def with_core(camera: Camera, change: Array) -> Camera:
    """The camera with its parameters (P,) changed."""
    K, distortion = camera.K.copy(), np.array(camera.distortion, dtype=float)
    names = _coefficient_names(distortion.size)
    for name, step in zip(camera.parameters, change, strict=True):
        if name in CORE:
            place = {"fx": (0, 0), "fy": (1, 1), "cx": (0, 2), "cy": (1, 2)}[name]
            K[place] += step
        else:
            distortion[names.index(name)] += step
    return replace(camera, K=K, distortion=distortion)


def _coefficient_names(count: int) -> list[str]:
    return ["k1", "k2", "p1", "p2", *(f"k{k}" for k in range(3, count - 1))][:count]


def steps(camera: Camera) -> Array:
    """Steps (P, P), a row each, small beside the parameters' standard deviations."""
    assert camera.covariance is not None
    return np.asarray(np.diag(STEP * np.sqrt(np.diag(camera.covariance))))


def ray_slope(camera: Camera, pixels: Array) -> Array:
    """U (N, 3, P): how the rays of pixels (N, 2) move with the parameters."""
    columns = []
    for step in steps(camera):
        ahead, behind = (with_core(camera, sign * step).unproject(pixels) for sign in (1, -1))
        columns.append((ahead - behind) / (2 * step.sum()))
    return np.stack(columns, axis=-1)

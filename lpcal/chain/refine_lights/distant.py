r"""Light directions from spheres under an orthographic camera, when nothing is known of the lens.

Symbols: outline circle (x, y, r) in pixels, normal n = ((u - x) / r, (v - y) / r, -sqrt(1 - ...)), line of sight (0, 0, 1)::

    chrome:  d = s - 2 (s . n) n,  s = (0, 0, 1), at the highlight
    matte:   data = g . n where it is lit; g by least squares, d = g / |g|, relative intensity |g|

Source: Woodham 1980 (shading of a Lambertian sphere); mirror reflection.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.calibration import Light, LightsSolution, SphereFinding
from lpcal.records.evidence import LightsEvidence
from lpcal.records.observations import Radiance, SphereView

SIGHT = np.array([0.0, 0.0, 1.0])
FACING_CAMERA, FACING_LIGHT = 0.35, 0.15
FLOOR_RAD = float(np.radians(0.1))
OUTLINE_PX = 0.1


def refine_distant(views: Sequence[SphereView], lights: Sequence[str]) -> LightsSolution:
    """Directions and relative intensities of distant lights, in the axes of C.

    Raises
    ------
    DegenerateError
        A light is seen in no sphere.
    """
    findings = [_finding(view) for view in views]
    intensity = _intensities(views, lights)
    found, disagreement = [], []
    for k, light in enumerate(lights):
        said = [finding.directions_C[light] for finding in findings if light in finding.directions_C and finding.kind == "chrome"]
        said = said or [finding.directions_C[light] for finding in findings if light in finding.directions_C]
        if not said:
            raise DegenerateError(
                "no sphere shows it",
                where=f"light {light}",
                needed="its highlight or its shading in one sphere",
                todo="add its image, or leave the light out",
            )
        mean = np.sum(said, axis=0)
        mean /= np.linalg.norm(mean)
        radius_px = max(_circle(view)[2] for view in views)
        own = 2 * np.hypot(OUTLINE_PX, 0.1) / radius_px
        gaps = [np.arccos(np.clip(mean @ one, -1, 1)) for one in said]
        spread = np.sqrt(np.mean(np.square(gaps))) if len(said) > 1 else 0.0
        disagreement += gaps if len(said) > 1 else []
        found.append(
            Light(light, mean, intensity[k], direction_std_rad=float(max(own, spread / np.sqrt(2), FLOOR_RAD)), intensity_std=float("nan"))
        )
    apart_deg = float(np.degrees(np.sqrt(np.mean(np.square(disagreement))))) if disagreement else None
    return LightsSolution(
        lights=tuple(found),
        focus_C=np.zeros(3),
        d_object_m=None,
        H_CD=None,
        spheres=tuple(findings),
        warnings=("without a camera the images are taken as orthographic and the lights as distant: directions only",),
        evidence=LightsEvidence(spheres_disagree_deg=apart_deg),
    )


def matte_direction(shading: Radiance, light: str, n_C: Array, seen: Mask) -> Array:
    """g (C, 3) of a light from a matte sphere's normals n_C (H, W, 3) at the pixels `seen` (H, W): direction times intensity a channel."""
    k = shading.lights.index(light)
    data = shading.signal[k][seen]
    data = data if data.ndim == 2 else data[:, None]
    n, usable = n_C[seen], ~shading.saturated[k][seen]
    grey = data.mean(axis=1)
    lit = usable & (grey > np.quantile(grey[usable], 0.3)) if usable.any() else usable
    g = np.zeros((data.shape[1], 3))
    for _ in range(6):
        if lit.sum() < 30:
            break
        g = np.linalg.lstsq(n[lit], data[lit].astype(float), rcond=None)[0].T
        direction = g.mean(axis=0) / max(float(np.linalg.norm(g.mean(axis=0))), 1e-12)
        lit = usable & (n @ direction > FACING_LIGHT)
    return g


def _circle(view: SphereView) -> tuple[float, float, float]:
    points = view.outline_px
    A = np.column_stack([2 * points, np.ones(len(points))])
    x, y, c = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return float(x), float(y), float(np.sqrt(c + x * x + y * y))


def _normals(view: SphereView, pixels: Array) -> Array:
    x, y, r = _circle(view)
    across = (pixels - [x, y]) / r
    return np.concatenate([across, -np.sqrt(np.maximum(1 - np.sum(across**2, axis=-1, keepdims=True), 0.0))], axis=-1)


def _finding(view: SphereView) -> SphereFinding:
    directions = {}
    for light, pixel in view.highlights_px.items():
        directions[light] = sphere.reflect(SIGHT, _normals(view, pixel))
    if view.shading is not None:
        for light, g in _shading_vectors(view, view.shading).items():
            mean = g.mean(axis=0)
            if np.linalg.norm(mean) > 0:
                directions[light] = mean / np.linalg.norm(mean)
    return SphereFinding(view.name, view.kind, None, None, used=True, why=None, directions_C=directions)


def _shading_vectors(view: SphereView, shading: Radiance) -> dict[str, Array]:
    rows, columns = np.indices(shading.saturated.shape[1:])
    n_C = _normals(view, np.stack([columns, rows], axis=-1).astype(float))
    return {light: matte_direction(shading, light, n_C, -n_C[..., 2] > FACING_CAMERA) for light in shading.lights}


def _intensities(views: Sequence[SphereView], lights: Sequence[str]) -> Array:
    """Relative intensities (L, C), mean 1; all 1 where no matte sphere shows them."""
    seen = [(view, view.shading) for view in views if view.shading is not None]
    if not seen:
        return np.ones((len(lights), 1))
    per_sphere = []
    for view, shading in seen:
        vectors = _shading_vectors(view, shading)
        size = np.array([np.linalg.norm(vectors[light], axis=1) if light in vectors else np.full(1, np.nan) for light in lights])
        per_sphere.append(size / np.nanmean(size))
    mean = np.nanmean(per_sphere, axis=0)
    return np.asarray(mean / mean.mean())

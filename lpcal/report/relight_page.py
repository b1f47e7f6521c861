"""surfaces/<object>/relight.html: the surface under a light that the pointer moves, in one file that opens offline.

The page shades ``E albedo max(n . d, 0)`` and a gloss lobe, with E and d of a near light at every pixel's own point (see
geometry/light_field.py), so that the object can also be lit as each calibrated light lit it. It draws with WebGL2, or on a plain canvas.
Source of the gloss lobe: Walter et al., Microfacet models for refraction through rough surfaces, 2007 (GGX).

A surface packed for the browser: planes of whole numbers, row differences, deflated, base64.

Code of a plane: a normal's two octahedral coordinates and the depth in 16 bits (depth 0: outside the mask), the rest in 8. Each row is
stored as differences from left to right, high bytes before low bytes; the browser inflates and sums them up again.
Octahedral code of a unit n: ``m = n / (|nx| + |ny| + |nz|)``; ``(mx, my)`` where ``nz <= 0`` (towards the camera), folded over elsewhere.
Source: Cigolle et al., A survey of efficient representations for independent unit vectors, 2014.
"""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal import __version__
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.calibration import Calibration, Light
from lpcal.records.surface import Surface
from lpcal.report.page import data_uri, script_json
from lpcal.report.pictures import block_sum, bounds, png, shaded, shrink
from lpcal.report.templates import environment

POSTER_PX = 420


def render(surface: Surface, calibration: Calibration | None) -> str:
    """The page, whole; with a calibration it offers the calibrated lights."""
    return (
        environment()
        .get_template("relight.html")
        .render(
            name=surface.name,
            version=__version__,
            data=script_json(pack(surface, calibration)),
            poster=data_uri(png(shrink(shaded(surface.normals), surface.mask, POSTER_PX))),
            pieces=surface.components,
        )
    )


MOST_PIXELS = 700_000
GRID = 33
LOBE_KNOTS = 48
LOBE_STOP_RAD = np.pi / 2
SIGMA_SCALE = 25.0

type Planes = list[npt.NDArray[np.uint8] | npt.NDArray[np.uint16]]


@dataclass(frozen=True)
class Reduced:
    """A surface's maps (H, W) as the page shows them, normals (H, W, 3) and albedo (H, W[, 3])."""

    mask: Mask
    normals: Image
    depth: Image
    albedo: Image
    sigma: Image
    lights: Labels
    component: Labels


@dataclass(frozen=True)
class PageLight:
    """A calibrated light as the page's script reads it; a distant one has no source, axis and lobe."""

    name: str
    direction: list[float]
    intensity: list[float]
    source: list[float] | None = None
    axis: list[float] | None = None
    lobe: list[float] | None = None
    """Emission at LOBE_KNOTS angles from the axis, from 0 to LOBE_STOP_RAD."""


def pack(surface: Surface, calibration: Calibration | None) -> dict[str, Any]:
    """Everything that the page's script reads, as plain data."""
    window = bounds(surface.mask)
    step = int(np.ceil(np.sqrt(max(1.0, surface.mask[window].size / MOST_PIXELS))))
    maps = _reduced(surface, window, step)
    mask, depth = maps.mask, maps.depth
    low, high = _range(depth[mask])
    perspective = bool(np.any(np.abs(np.nan_to_num(surface.rays_C[..., :2])) > 0))
    nodes_px, rays = _grid(surface, window, perspective=perspective)
    albedo = maps.albedo.reshape(*mask.shape, -1)
    white = float(np.percentile(albedo[mask], 99.5)) if mask.any() else 1.0
    planes: Planes = [*_octahedral(maps.normals), _code(depth, mask, low, high)]
    planes += [_byte(255 * np.sqrt(np.clip(albedo[..., c] / max(white, 1e-9), 0, 1)), mask) for c in range(albedo.shape[-1])]
    planes.append(_byte(SIGMA_SCALE * np.log2(1 + np.clip(maps.sigma, 0, 180)), mask))
    planes += [_byte(maps.lights, mask), _byte(maps.component, mask)]
    return {
        "name": surface.name,
        "width": mask.shape[1],
        "height": mask.shape[0],
        "channels": albedo.shape[-1],
        "planes": _deflate(planes),
        "depth": [low, high],
        "perspective": perspective,
        "origin": [window[1].start, window[0].start],
        "step": step,
        "grid": {"size": GRID, "px": np.round(nodes_px, 3).tolist(), "ray": np.round(rays, 6).tolist()},
        "sigmaScale": SIGMA_SCALE,
        "lights": [] if calibration is None else [vars(light) for light in _lights(calibration, perspective=perspective)],
        "lobeStop": LOBE_STOP_RAD,
    }


def _reduced(surface: Surface, window: tuple[slice, slice], step: int) -> Reduced:
    """The maps cropped, and averaged over blocks of step by step pixels."""
    mask = surface.mask[window]
    total = block_sum(mask.astype(np.float32), step)

    def mean(value: Any) -> Any:
        value = np.asarray(value[window], dtype=np.float32)
        inside = mask.reshape(mask.shape + (1,) * (value.ndim - 2))
        summed = block_sum(np.where(inside, np.nan_to_num(value), 0), step)
        return summed / np.maximum(total, 1).reshape(total.shape + (1,) * (value.ndim - 2))

    normals = mean(surface.normals)
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    return Reduced(
        mask=total > 0.5 * step * step if step > 1 else mask,
        normals=normals / np.maximum(length, 1e-9),
        depth=mean(surface.depth),
        albedo=mean(surface.albedo),
        sigma=mean(surface.normal_std_deg),
        lights=surface.lights_used[window][::step, ::step],
        component=surface.component[window][::step, ::step],
    )


def _range(values: Any) -> tuple[float, float]:
    if not values.size:
        return 0.0, 1.0
    low, high = float(values.min()), float(values.max())
    return low, max(high, low + 1e-9)


def _grid(surface: Surface, window: tuple[slice, slice], *, perspective: bool) -> tuple[Array, Array]:
    """Nodes over the crop: full-image pixels (GRID, GRID, 2) and their rays (x/z, y/z); orthographic: the pixels themselves."""
    rows = np.linspace(window[0].start, window[0].stop - 1, GRID).round().astype(int)
    columns = np.linspace(window[1].start, window[1].stop - 1, GRID).round().astype(int)
    nodes = np.stack(np.meshgrid(columns, rows), axis=-1).astype(float)
    if not perspective:
        return nodes, nodes
    rays = surface.rays_C[np.ix_(rows, columns)]
    return nodes, np.nan_to_num(rays[..., :2] / rays[..., 2:])


def _octahedral(normals: Any) -> Planes:
    n = normals / np.maximum(np.abs(normals).sum(axis=2, keepdims=True), 1e-9)
    x, y = n[..., 0], n[..., 1]
    away = n[..., 2] > 0
    folded_x = np.where(away, (1 - np.abs(y)) * np.where(x >= 0, 1, -1), x)
    folded_y = np.where(away, (1 - np.abs(x)) * np.where(y >= 0, 1, -1), y)
    return [np.asarray(np.round((c * 0.5 + 0.5) * 65535), dtype=np.uint16) for c in (folded_x, folded_y)]


def _code(depth: Any, mask: Mask, low: float, high: float) -> npt.NDArray[np.uint16]:
    scaled = 1 + np.round((np.nan_to_num(depth) - low) / (high - low) * 65534)
    return np.asarray(np.where(mask, np.clip(scaled, 1, 65535), 0), dtype=np.uint16)


def _byte(value: Any, mask: Mask) -> npt.NDArray[np.uint8]:
    return np.asarray(np.where(mask, np.clip(np.round(np.nan_to_num(value)), 0, 255), 0), dtype=np.uint8)


def _deflate(planes: Planes) -> str:
    parts = []
    for plane in planes:
        wide = plane.astype(np.int64)
        difference = np.diff(wide, axis=1, prepend=0) % (65536 if plane.dtype == np.uint16 else 256)
        if plane.dtype == np.uint16:
            parts.append((difference >> 8).astype(np.uint8).tobytes())
        parts.append((difference & 255).astype(np.uint8).tobytes())
    return base64.b64encode(zlib.compress(b"".join(parts), 9)).decode("ascii")


def _lights(calibration: Calibration, *, perspective: bool) -> list[PageLight]:
    """The calibrated lights; the page can place near ones only where the surface has a camera."""
    angles = np.linspace(0, LOBE_STOP_RAD, LOBE_KNOTS)
    return [
        _light(light, angles, near=perspective and light.source_C is not None and light.axis_C is not None) for light in calibration.lights
    ]


def _light(light: Light, angles: Array, *, near: bool) -> PageLight:
    found = PageLight(light.name, np.round(light.direction_C, 6).tolist(), np.round(np.broadcast_to(light.intensity, 3), 5).tolist())
    if not near or light.source_C is None or light.axis_C is None:
        return found
    lobe = np.round(np.nan_to_num(light.lobe(angles)), 4).tolist()
    return replace(found, source=np.round(light.source_C, 6).tolist(), axis=np.round(light.axis_C, 6).tolist(), lobe=lobe)

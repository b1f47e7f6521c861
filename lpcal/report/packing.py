"""A surface packed for the browser: planes of whole numbers, row differences, deflated, base64.

Code of a plane: a normal's two octahedral coordinates and the depth in 16 bits (depth 0: outside the mask), the rest in 8. Each row is
stored as differences from left to right, high bytes before low bytes; the browser inflates and sums them up again.
Octahedral code of a unit n: ``m = n / (|nx| + |ny| + |nz|)``; ``(mx, my)`` where ``nz <= 0`` (towards the camera), folded over elsewhere.
Source: Cigolle et al., A survey of efficient representations for independent unit vectors, 2014.

A large surface is packed twice: averaged over blocks of pixels, so that the page has a picture at once, and whole, in bands of rows.
"""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.surface import Surface
from lpcal.report.pictures import block_sum

GRID = 33
"""Nodes across the picture at which the page is given rays: between them they change by microns on an object at half a metre."""
SIGMA_SCALE = 25.0
"""Steps of a normal's standard deviation s (deg) in its byte: ``SIGMA_SCALE log2(1 + s)``, so 3 % of s + 1."""
DEPTH_SIGMA_SCALE = 16.0
"""Steps a factor of two of the depth's standard deviation: 4 % a step, and 250 steps for a range of 50,000."""
JUMP_PX = 7.0
"""Step in depth between neighbours, in pixels' own width, from which a surface without stated breaks is cut: 82 degrees."""
FINE_BITS = 12
"""Bits of a normal's coordinate in the full-size bands: .04 deg, a tenth of the least sigma, for two thirds of the bytes of 16."""
BAND_PIXELS = 1_000_000
"""Pixels of a band: what is held at once while a surface is averaged and packed."""

type Planes = list[npt.NDArray[np.uint8] | npt.NDArray[np.uint16]]


@dataclass(frozen=True)
class Reduced:
    """A surface's maps (H, W) as the page shows them, normals (H, W, 3) and albedo (H, W[, 3]); `breaks` (H, W): 1 right, 2 below."""

    mask: Mask
    normals: Image
    depth: Image
    albedo: Image
    sigma: Image
    depth_sigma: Image
    lights: Labels
    component: Labels
    breaks: Labels


@dataclass(frozen=True)
class Scales:
    """What the codes of depth, albedo and the depth's standard deviation are relative to."""

    low: float
    high: float
    white: float
    least_sigma: float

    @staticmethod
    def of(maps: Reduced, depth: Image) -> Scales:
        """Those of a surface's maps; `depth` are all its pixels' depths."""
        low, high = (float(depth.min()), float(depth.max())) if depth.size else (0.0, 1.0)
        white = float(np.percentile(maps.albedo[maps.mask], 99.5)) if maps.mask.any() else 1.0
        known = maps.depth_sigma[maps.mask & (maps.depth_sigma > 0)]
        return Scales(low, max(high, low + 1e-9), max(white, 1e-9), float(np.percentile(known, 1)) if known.size else 1.0)


def reduced(surface: Surface, window: tuple[slice, slice], step: int) -> Reduced:
    """The maps cropped, and averaged over blocks of step by step pixels."""
    rows, columns = window
    height = max(1, BAND_PIXELS // max(columns.stop - columns.start, 1) // step) * step
    parts = [
        _reduced(surface, (slice(top, min(top + height, rows.stop)), columns), step) for top in range(rows.start, max(rows.stop, 1), height)
    ]
    if len(parts) == 1:
        return parts[0]
    return Reduced(**{one.name: np.concatenate([getattr(part, one.name) for part in parts]) for one in fields(Reduced)})


def _reduced(surface: Surface, window: tuple[slice, slice], step: int) -> Reduced:
    """`reduced` for a band of rows."""
    mask = surface.mask[window]
    total = block_sum(mask.astype(np.float32), step)

    def mean(value: Any) -> Any:
        value = np.asarray(value[window], dtype=np.float32)
        inside = mask.reshape(mask.shape + (1,) * (value.ndim - 2))
        summed = block_sum(np.where(inside, np.nan_to_num(value), 0), step)
        return summed / np.maximum(total, 1).reshape(total.shape + (1,) * (value.ndim - 2))

    normals = mean(surface.normals)
    length = lambert.length(normals)[..., None]
    below = (slice(window[0].start, window[0].stop + 1), window[1])  # the surface may break between this band and the next
    cut = block_sum(breaks_of(surface, below)[: len(mask)].astype(np.float32), step) > 0
    return Reduced(
        mask=total > 0.5 * step * step if step > 1 else mask,
        normals=normals / np.maximum(length, 1e-9),
        depth=mean(surface.depth),
        albedo=mean(surface.albedo),
        sigma=mean(surface.normal_std_deg),
        depth_sigma=mean(surface.depth_std),
        lights=surface.lights_used[window][::step, ::step],
        component=surface.component[window][::step, ::step],
        breaks=np.asarray(cut[..., 0] + 2 * cut[..., 1], dtype=np.uint8),
    )


def breaks_of(surface: Surface, window: tuple[slice, slice]) -> Mask:
    """Whether the surface (H, W, 2) breaks towards the right, and below, between pixels of the mask; by the depth where it does not say."""
    mask, depth = surface.mask[window], np.nan_to_num(surface.depth[window])
    found = np.zeros((*mask.shape, 2), dtype=bool)
    rays = surface.rays_C[window]
    pitch = abs(float(np.nan_to_num(rays[-1, -1, 0] - rays[0, 0, 0]))) / max(mask.shape[1] - 1, 1)
    jump = JUMP_PX * (np.where(pitch > 0, pitch * np.abs(depth), 1.0))
    for axis, k in ((1, 0), (0, 1)):
        near, far = (np.s_[:, :-1], np.s_[:, 1:]) if axis == 1 else (np.s_[:-1], np.s_[1:])
        said = surface.breaks[k][window][near] if surface.breaks.size else np.abs(np.diff(depth, axis=axis)) > jump[near]
        found[(*near, k) if isinstance(near, tuple) else (near, slice(None), k)] = said & mask[near] & mask[far]
    return found


def planes_of(maps: Reduced, scales: Scales) -> Planes:
    """All planes of the maps, in the order in which the page's script reads them."""
    mask = maps.mask
    octahedral = [np.asarray(np.round(c * 65535), dtype=np.uint16) for c in _octahedral(maps.normals)]
    planes: Planes = [*octahedral, _code(maps.depth, mask, scales)]
    planes += _albedo(maps.albedo, mask, scales)
    planes.append(_byte(SIGMA_SCALE * np.log2(1 + np.clip(maps.sigma, 0, 180)), mask))
    known = mask & (maps.depth_sigma > 0)
    planes.append(_byte(1 + DEPTH_SIGMA_SCALE * np.log2(np.maximum(np.where(known, maps.depth_sigma, 1) / scales.least_sigma, 1)), known))
    planes += [_byte(maps.lights, mask), _byte(maps.component, mask), maps.breaks]
    return planes


def bands(surface: Surface, window: tuple[slice, slice], step: int, scales: Scales) -> list[tuple[int, str]]:
    """The surface at full size: rows of each band, and its planes (normals, depth, albedo, breaks) packed."""
    rows, columns = window
    height = max(1, BAND_PIXELS // max(columns.stop - columns.start, 1) // step) * step
    found = []
    for top in range(rows.start, rows.stop, height):
        part = reduced(surface, (slice(top, min(top + height, rows.stop)), columns), step)
        planes: Planes = [np.asarray(np.round(c * (2**FINE_BITS - 1)), dtype=np.uint16) for c in _octahedral(part.normals)]
        planes += [_code(part.depth, part.mask, scales), *_albedo(part.albedo, part.mask, scales), part.breaks]
        found.append((part.mask.shape[0], deflate(planes)))
    return found


def ray_grid(surface: Surface, window: tuple[slice, slice], *, perspective: bool) -> tuple[Array, Array]:
    """Nodes over the crop: full-image pixels (GRID, GRID, 2) and their rays (x/z, y/z); orthographic: the pixels themselves."""
    rows = np.linspace(window[0].start, window[0].stop - 1, GRID).round().astype(int)
    columns = np.linspace(window[1].start, window[1].stop - 1, GRID).round().astype(int)
    nodes = np.stack(np.meshgrid(columns, rows), axis=-1).astype(float)
    if not perspective:
        return nodes, nodes
    rays = surface.rays_C[np.ix_(rows, columns)]
    return nodes, np.nan_to_num(rays[..., :2] / rays[..., 2:])


def _octahedral(normals: Any) -> list[Any]:
    """Both coordinates (H, W) of normals (H, W, 3), from 0 to 1."""
    n = normals / np.maximum(np.abs(normals).sum(axis=2, keepdims=True), 1e-9)
    x, y = n[..., 0], n[..., 1]
    away = n[..., 2] > 0
    folded_x = np.where(away, (1 - np.abs(y)) * np.where(x >= 0, 1, -1), x)
    folded_y = np.where(away, (1 - np.abs(x)) * np.where(y >= 0, 1, -1), y)
    return [c * 0.5 + 0.5 for c in (folded_x, folded_y)]


def _code(depth: Any, mask: Mask, scales: Scales) -> npt.NDArray[np.uint16]:
    scaled = 1 + np.round((np.nan_to_num(depth) - scales.low) / (scales.high - scales.low) * 65534)
    return np.asarray(np.where(mask, np.clip(scaled, 1, 65535), 0), dtype=np.uint16)


def _albedo(albedo: Any, mask: Mask, scales: Scales) -> Planes:
    albedo = albedo.reshape(*mask.shape, -1)
    return [_byte(255 * np.sqrt(np.clip(albedo[..., c] / scales.white, 0, 1)), mask) for c in range(albedo.shape[-1])]


def _byte(value: Any, mask: Mask) -> npt.NDArray[np.uint8]:
    return np.asarray(np.where(mask, np.clip(np.round(np.nan_to_num(value)), 0, 255), 0), dtype=np.uint8)


def deflate(planes: Planes, level: int = 6) -> str:
    """Planes as row differences, deflated, in base64."""
    packer, parts = zlib.compressobj(level), []
    for plane in planes:
        wide = plane.astype(np.int32)
        difference = np.diff(wide, axis=1, prepend=0) % (65536 if plane.dtype == np.uint16 else 256)
        if plane.dtype == np.uint16:
            parts.append(packer.compress((difference >> 8).astype(np.uint8).tobytes()))
        parts.append(packer.compress((difference & 255).astype(np.uint8).tobytes()))
    return base64.b64encode(b"".join([*parts, packer.flush()])).decode("ascii")

"""surfaces/<object>/relight.html: the surface in space, under a light that the pointer moves, in one file that opens offline.

The page shades ``E albedo max(n . d, 0)`` and a gloss lobe, with E and d of a near light at every pixel's own point (see
geometry/light_field.py), so that the object can also be lit as each calibrated light lit it. It draws with three.js, or on a plain canvas
where the browser has no WebGL2. Source of the gloss lobe: Walter et al., Microfacet models for refraction through rough surfaces, 2007
(GGX). The surface comes packed (report/packing.py).

Beside the measured shape the page shows the one that the same lights would have given, had they been taken as distant. A distant light has
one direction and one strength: those of its field at the surface's middle x_0. Where the surface was solved that way too, its own depth is
taken. Else the signals are predicted from the measured surface and field, and solved as distant ones::

    i_l = rho E_l(x) max(n . d_l(x), 0)          rho n' = argmin sum_l lit_l (E_l(x_0) d_l(x_0) . b - i_l)^2

and n' is integrated over a coarse grid, as normals from elsewhere are. Of both, what counts is the factor ``z' / z`` of each pixel's depth,
its median put to 1, since normals do not determine the distance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal import __version__
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.records.calibration import Calibration, Light
from lpcal.records.pictures import data_uri, png
from lpcal.records.surface import Surface
from lpcal.report import packing
from lpcal.report.packing import deflate
from lpcal.report.page import script_json
from lpcal.report.page_data import BendData, FullSize, LightData, RelightData
from lpcal.report.pictures import bounds, shaded, shrink
from lpcal.report.templates import environment, packed_three
from lpcal.surface.integrate import Grid
from lpcal.surface.of_normals import FEWEST_PIXELS, integrate_normals

POSTER_PX = 420
"""Largest side of the still picture that stands in the page until it draws."""
MOST_PIXELS = 300_000
"""Pixels of the first picture: half a megapixel is inflated and drawn within half a second by a slow machine."""
MOST_FULL = 9_000_000
"""Pixels of the surface at full size; a larger one is averaged over blocks, which the page says."""
LARGEST_SIDE = 8192
"""Pixels along a side that every WebGL2 of the last ten years takes as a texture."""
LOBE_KNOTS = 48
"""Angles at which the page is given a lobe: every two degrees, between which it is linear."""
LOBE_STOP_RAD = np.pi / 2
"""The largest of them: a light does not shine backwards."""


def render(surface: Surface, calibration: Calibration | None, distant: Surface | None = None) -> str:
    """The page, whole; with a calibration it offers the calibrated lights, and the shape that distant ones would have given.

    `distant` is the surface of the same capture by lights taken as distant; without it, that shape is predicted.
    """
    data, bands = pack(surface, calibration, distant)
    return (
        environment()
        .get_template("relight.html")
        .render(
            name=surface.name,
            version=__version__,
            data=script_json(data),
            bands=[text for _, text in bands],
            three=packed_three(),
            poster=data_uri(png(shrink(shaded(surface.normals), surface.mask, POSTER_PX))),
            pieces=surface.components,
            metric=surface.metric,
        )
    )


def pack(surface: Surface, calibration: Calibration | None, distant: Surface | None = None) -> tuple[RelightData, list[tuple[int, str]]]:
    """Everything that the page's script reads at once, as plain data, and the bands of the full size (none of a small surface)."""
    window = bounds(surface.mask)
    shape = surface.mask[window].shape
    step, fine = _step(shape, MOST_PIXELS), _step(shape, MOST_FULL)
    maps = packing.reduced(surface, window, step)
    scales = packing.Scales.of(maps, surface.depth[window][surface.mask[window]])
    perspective = surface.metric
    nodes_px, rays = packing.ray_grid(surface, window, perspective=perspective)
    bands = packing.bands(surface, window, fine, scales) if fine < step else []
    bend = None if calibration is None else bend_of(surface, calibration, distant)
    document: RelightData = {
        "name": surface.name,
        "width": maps.mask.shape[1],
        "height": maps.mask.shape[0],
        "channels": 1 if maps.albedo.ndim == 2 else maps.albedo.shape[2],
        "planes": packing.deflate(packing.planes_of(maps, scales)),
        "depth": [scales.low, scales.high],
        "perspective": perspective,
        "origin": [window[1].start, window[0].start],
        "step": step,
        "grid": {"size": packing.GRID, "px": np.round(nodes_px, 3).tolist(), "ray": np.round(rays, 7).tolist()},
        "sigmaScale": packing.SIGMA_SCALE,
        "depthSigma": {"least": scales.least_sigma, "scale": packing.DEPTH_SIGMA_SCALE},
        "scales": {str(piece.label): piece.scale_std for piece in surface.components},
        "lights": [] if calibration is None else _lights(calibration, perspective=perspective),
        "lobeStop": LOBE_STOP_RAD,
        "bend": None if bend is None else bend.document(window),
        "full": None if not bands else _full(shape, fine, [rows for rows, _ in bands]),
    }
    return document, bands


def _step(shape: tuple[int, ...], most: int) -> int:
    """The least block size that leaves `most` pixels or fewer, none of the sides too long for a texture."""
    return max(1, int(np.ceil(np.sqrt(shape[0] * shape[1] / most))), -(-max(shape) // LARGEST_SIDE))


def _full(shape: tuple[int, ...], step: int, rows: list[int]) -> FullSize:
    return {"width": -(-shape[1] // step), "height": sum(rows), "step": step, "rows": rows, "bits": packing.FINE_BITS}


def _lights(calibration: Calibration, *, perspective: bool) -> list[LightData]:
    """The calibrated lights; the page can place near ones only where the surface has a camera."""
    angles = np.linspace(0, LOBE_STOP_RAD, LOBE_KNOTS)
    return [
        _light(light, angles, near=perspective and light.source_C is not None and light.axis_C is not None) for light in calibration.lights
    ]


def _light(light: Light, angles: Array, *, near: bool) -> LightData:
    """A light as the page's script reads it; its lobe at angles (K,) from the axis."""
    found: LightData = {
        "name": light.name,
        "direction": np.round(light.direction_C, 6).tolist(),
        "intensity": np.round(np.broadcast_to(light.intensity, 3), 5).tolist(),
        "source": None,
        "axis": None,
        "lobe": None,
    }
    if not near or light.source_C is None or light.axis_C is None:
        return found
    lobe = np.round(np.nan_to_num(light.lobe(angles)), 4).tolist()
    return {**found, "source": np.round(light.source_C, 6).tolist(), "axis": np.round(light.axis_C, 6).tolist(), "lobe": lobe}


CELLS = 96
"""Cells along the longer side of the coarse grid: the bend of a wrong light model is smooth."""
LEAST_LIGHTS = 3
"""Lights that a normal needs."""
HELD = 1e-6
"""Share of the normal equations' trace that holds a normal which fewer than three lights reach to the measured one."""
MOST_RELATIVE = 0.5
"""Largest change of a depth that the page is given, relative: past it, it is no shape of this object."""


@dataclass(frozen=True)
class Bend:
    """How depth and normals change when the lights are taken as distant, over a coarse grid (h, w) of blocks of `step` pixels."""

    solved: bool
    """Whether it was solved from the images, else predicted from the measured surface and lights."""
    mask: Mask
    factor: Image
    """Depth over measured depth, its median 1."""
    tilt: Image
    """(h, w, 2) change of the normal's x and y."""
    window: tuple[slice, slice]
    step: int
    bowl: float
    """Root mean square of the change in depth, metres."""

    def document(self, window: tuple[slice, slice]) -> BendData:
        """The bend as the page's script reads it; `window` is the crop that the page shows."""
        strength = max(float(np.abs(self.factor[self.mask] - 1).max(initial=0)), 1e-9)
        turn = max(float(np.abs(self.tilt[self.mask]).max(initial=0)), 1e-9)
        parts = [(self.factor - 1) / strength, self.tilt[..., 0] / turn, self.tilt[..., 1] / turn]
        words = [
            np.asarray(np.where(self.mask, np.clip(32768 + np.round(32767 * np.nan_to_num(p)), 1, 65535), 0), np.uint16) for p in parts
        ]
        return {
            "solved": self.solved,
            "planes": deflate(list(words)),
            "width": self.mask.shape[1],
            "height": self.mask.shape[0],
            "strength": strength,
            "turn": turn,
            "offset": [self.window[1].start - window[1].start, self.window[0].start - window[0].start],
            "step": self.step,
            "bowl": self.bowl,
        }


def bend_of(surface: Surface, calibration: Calibration, distant: Surface | None = None) -> Bend | None:
    """The bend of a surface; None where there is no camera, the lights are distant anyway, or too few pixels or lights show it."""
    near = [light for light in calibration.lights if light.source_C is not None]
    if not surface.metric or len(near) < LEAST_LIGHTS:
        return None
    window = bounds(surface.mask)
    step = max(1, -(-max(surface.mask[window].shape) // CELLS))
    rows, columns = (slice(part.start + step // 2, part.stop, step) for part in window)
    at = (rows, columns)
    mask = surface.mask[at] & np.isfinite(surface.depth[at])
    if mask.sum() < FEWEST_PIXELS:
        return None
    if distant is not None:
        mask = mask & np.isfinite(distant.depth[at]) & distant.mask[at]
        normals, ratio = distant.normals[at][mask].astype(float), distant.depth[at][mask] / surface.depth[at][mask]
    else:
        normals = _distant_normals(
            surface.normals[at][mask].astype(float), (surface.depth[..., None] * surface.rays_C)[at][mask], calibration
        )
        rays = surface.rays_C[at][mask]
        grid = Grid.of(mask)
        both = [integrate_normals(grid, n, rays, central=True)[0] for n in (surface.normals[at][mask].astype(float), normals)]
        ratio = np.exp(both[1] - both[0])
    factor = _shape_alone(ratio.astype(float), surface.component[at][mask])
    if not np.isfinite(factor).all():
        return None
    bowl = float(np.sqrt(np.mean(((factor - 1) * surface.depth[at][mask]) ** 2)))
    factors, tilts = np.ones(mask.shape, np.float32), np.zeros((*mask.shape, 2), np.float32)
    factors[mask], tilts[mask] = factor, (normals - surface.normals[at][mask])[:, :2]
    return Bend(distant is not None, mask, factors, tilts, window, step, bowl)


def _shape_alone(ratio: Array, label: Labels) -> Array:
    """The depths' factor (P,) with the median of each piece put to 1, kept within what can be shown."""
    medians = {one: np.median(ratio[label == one]) for one in np.unique(label)}
    return np.clip(ratio / np.array([medians[one] for one in label]), 1 - MOST_RELATIVE, 1 + MOST_RELATIVE)


def _distant_normals(normals: Array, points: Array, calibration: Calibration) -> Array:
    """Normals (P, 3) that lights taken as distant would give of a surface of normals (P, 3) at points (P, 3)."""
    middle = np.median(points, axis=0)
    G, right = np.zeros((len(normals), 3, 3)), np.zeros((len(normals), 3))
    for light in calibration.lights:
        d, E = light.field(points)
        d_0, E_0 = light.field(middle)
        signal = E.mean(axis=-1) * np.maximum(np.einsum("pi,pi->p", normals, d), 0)
        pull = float(np.mean(E_0)) * d_0
        lit = (signal > 0).astype(float)
        G += lit[:, None, None] * np.outer(pull, pull)
        right += (lit * signal)[:, None] * pull
    held = HELD * np.trace(G, axis1=1, axis2=2)[:, None] + np.finfo(float).tiny
    b = np.linalg.solve(G + held[..., None] * np.eye(3), (right + held * normals)[..., None])
    return np.asarray(lambert.unit(b[..., 0])[0])

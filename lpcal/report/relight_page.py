"""surfaces/<object>/relight.html: the surface in space, under a light that the pointer moves, in one file that opens offline.

The page shades ``E albedo max(n . d, 0)`` and a gloss lobe, with E and d of a near light at every pixel's own point (see
geometry/light_field.py), so that the object can also be lit as each calibrated light lit it. It draws with three.js, or on a plain canvas
where the browser has no WebGL2. Source of the gloss lobe: Walter et al., Microfacet models for refraction through rough surfaces, 2007
(GGX). The surface comes packed (report/packing.py).
"""

from __future__ import annotations

import numpy as np

from lpcal import __version__
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Light
from lpcal.records.pictures import data_uri, png
from lpcal.records.surface import Surface
from lpcal.report import packing
from lpcal.report.distant_shape import bend_of
from lpcal.report.page_data import FullSize, LightData, RelightData
from lpcal.report.pictures import bounds, shaded, shrunk
from lpcal.report.templates import environment, packed_three, script_json

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
            poster=data_uri(png(shrunk(lambda *part: shaded(surface.normals[part]), surface.mask, POSTER_PX))),
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

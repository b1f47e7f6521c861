"""surfaces/<object>/relight.html: the surface under a light that the pointer moves, in one file that opens offline.

The page shades ``E albedo max(n . d, 0)`` and a gloss lobe, with E and d of a near light at every pixel's own point (see
geometry/light_field.py), so that the object can also be lit as each calibrated light lit it. It draws with WebGL2, or on a plain canvas.
Source of the gloss lobe: Walter et al., Microfacet models for refraction through rough surfaces, 2007 (GGX).
"""

from __future__ import annotations

import numpy as np

from lpcal import __version__
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration
from lpcal.records.surface import Surface
from lpcal.report.page import data_uri, script_json
from lpcal.report.pictures import png, shrink
from lpcal.report.relight_pack import pack
from lpcal.report.templates import environment

POSTER_PX = 420
POSTER_LIGHT = np.array([-0.45, -0.55, -0.7])


def render(surface: Surface, calibration: Calibration | None) -> str:
    """The page, whole; with a calibration it offers the calibrated lights."""
    return (
        environment()
        .get_template("relight.html")
        .render(
            name=surface.name,
            version=__version__,
            data=script_json(pack(surface, calibration)),
            poster=data_uri(poster(surface.normals, surface.mask, POSTER_PX)),
            pieces=surface.components,
        )
    )


def poster(normals: Array | object, mask: object, largest: int) -> bytes:
    """A still picture of normals (H, W, 3) under one distant light, as PNG: what is seen where no script runs."""
    light = POSTER_LIGHT / np.linalg.norm(POSTER_LIGHT)
    shade = 0.06 + 0.9 * np.maximum(np.nan_to_num(np.asarray(normals)) @ light, 0)
    grey = np.repeat((shade ** (1 / 2.2))[..., None], 3, axis=2).astype(np.float32)
    return png(shrink(grey, np.asarray(mask, dtype=bool), largest))

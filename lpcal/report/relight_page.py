"""surfaces/<object>/relight.html: the surface under a light that the pointer moves, in one file that opens offline.

The page shades ``E albedo max(n . d, 0)`` and a gloss lobe, with E and d of a near light at every pixel's own point (see
geometry/light_field.py), so that the object can also be lit as each calibrated light lit it. It draws with WebGL2, or on a plain canvas.
Source of the gloss lobe: Walter et al., Microfacet models for refraction through rough surfaces, 2007 (GGX).
"""

from __future__ import annotations

from lpcal import __version__
from lpcal.records.calibration import Calibration
from lpcal.records.surface import Surface
from lpcal.report.page import data_uri, script_json
from lpcal.report.pictures import png, shaded, shrink
from lpcal.report.relight_pack import pack
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

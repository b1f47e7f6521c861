"""An ambient image that cannot be one: brighter than the images of the lights, of which it should be the lesser part.

Symbols: linear numbers l of an exposure t give the light ``l / t`` (see detect.radiometry), averaged over an image.
"""

from __future__ import annotations

from lpcal.detect.radiometry import Sensor
from lpcal.errors import DisagreementError
from lpcal.records.observations import RawCapture

BRIGHTER = 0.98
"""Lit images under this share of the ambient one are darker, beyond noise."""


def refuse_bright_ambient(raw: RawCapture, sensor: Sensor) -> None:
    """Refuse an ambient image that is brighter than the images of all lights: they were not taken alike.

    Raises
    ------
    DisagreementError
        It is.
    """
    if raw.ambient is None:
        return
    axes = tuple(range(1, raw.images.ndim))
    lit = sensor.linear(raw.images).mean(axis=axes) / raw.exposure_s
    ambient = sensor.linear(raw.ambient).mean(axis=axes) / raw.ambient_exposure_s
    if ambient.min() > 0 and lit.max() < BRIGHTER * ambient.min():
        raise DisagreementError(
            f"the ambient image is brighter than the lit ones: {100 * ambient.min() / lit.max():.0f} % of the brightest of them",
            where=raw.name,
            needed="an ambient image with all lights off, at the exposure of the others or with its own stated",
            todo="take it anew, or state exposure: and exposures: in capture.yaml",
        )

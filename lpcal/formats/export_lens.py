"""A camera as a format can hold it: with as many coefficients as there is room for, fitted again where they do not suffice."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.geometry.lens_models import fit_lens
from lpcal.records.camera import COEFFICIENTS, Camera

MODELS = {4: "opencv4", 5: "opencv5", 8: "opencv8"}


def with_room_for(camera: Camera, count: int) -> tuple[Camera, list[str]]:
    """The camera with `count` (4, 5 or 8) coefficients of distortion k1 k2 p1 p2 k3 k4 k5 k6, and notes on it.

    Fewer are filled up with zeros. More that are not zero, or a splined lens, are fitted again over the image; how far the two lie apart
    is said in pixels.
    """
    if camera.spline is None and not np.any(camera.distortion[count:]):
        held = np.zeros(count)
        held[: min(count, camera.distortion.size)] = camera.distortion[:count]
        return replace(camera, model=MODELS[count], distortion=held), []
    why = "a splined lens" if camera.spline is not None else f"{', '.join(COEFFICIENTS[count : camera.distortion.size])}"
    found = fit_lens(camera.unproject, camera.K, camera.image_size, count, camera.distortion)
    fitted = replace(
        camera,
        model=MODELS[count],
        K=found.K,
        distortion=found.distortion,
        lensmodel="",
        spline=None,
        parameters=(),
        covariance=None,
    )
    said = f"no place for {why}: the lens is fitted again with {', '.join(COEFFICIENTS[:count])}; over the image the two lie"
    return fitted, [f"{said} {found.rms_px:.3g} px apart (rms), {found.largest_px:.3g} px at most"]

"""From the linear images of one sphere to what they say of it: outline, highlights, shading."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.detect import sphere_outline, sphere_start
from lpcal.detect.sphere_highlights import find_highlight
from lpcal.errors import DegenerateError
from lpcal.geometry.arrays import Array, Image
from lpcal.records.calibration import Camera
from lpcal.records.observations import Radiance, SphereView

REFINED_STARTS = 3
CLEAR_RAYS, CLEAR_CONTRAST = 0.9, 20.0
"""An outline that so many rays see so clearly needs no rival."""


@dataclass(frozen=True)
class Expected:
    """What is known of a sphere before it is looked for."""

    kind: str
    radius_m: float | None
    hint_px: Array | None = None
    """(3,) x, y, radius of its outline, about."""
    distance_m: tuple[float, float] | None = None
    """Between which distances from the camera it lies."""


def observe_sphere(radiance: Radiance, expected: Expected, camera: Camera | None) -> SphereView:
    """Outline, and highlights (chrome) or shading (matte), of the one sphere in a capture.

    Raises
    ------
    DegenerateError
        No outline, or no highlight of any light; the sphere is named.
    """
    image = mean_image(radiance)
    curve = sphere_outline.circle_curve()
    if camera is not None and expected.radius_m is not None:
        curve = sphere_outline.perspective_curve(camera, expected.radius_m)
    try:
        outline = _best_outline(image, radiance, expected, camera, curve)
    except DegenerateError as error:
        raise DegenerateError(error.found, where=f"sphere {radiance.name}", needed=error.needed, todo=error.todo) from error
    view = SphereView(
        name=radiance.name,
        kind=expected.kind,
        radius_m=expected.radius_m if expected.radius_m is not None else float("nan"),
        outline_px=outline.points_px,
        outline_sigma_px=outline.sigma_px,
        shading=radiance if expected.kind == "matte" else None,
    )
    return view if expected.kind == "matte" else _with_highlights(view, radiance, outline)


def mean_image(radiance: Radiance) -> Image:
    """Mean over the lights (H, W), grey, ambient light included."""
    mean = np.mean(radiance.signal, axis=0) + radiance.ambient
    return np.asarray(mean.mean(axis=2) if mean.ndim == 3 else mean, dtype=np.float32)


def _best_outline(
    image: Image, radiance: Radiance, expected: Expected, camera: Camera | None, curve: sphere_outline.Curve
) -> sphere_outline.Outline:
    if expected.hint_px is not None:
        starts = [expected.hint_px]
    elif radiance.mask is not None:
        starts = [sphere_start.from_mask(radiance.mask)]
    else:
        radius_px = None
        if camera is not None and expected.radius_m is not None and expected.distance_m is not None:
            near, far = expected.distance_m
            focal = float(np.sqrt(camera.K[0, 0] * camera.K[1, 1]))
            radius_px = (focal * expected.radius_m / far, 1.2 * focal * expected.radius_m / near)
        starts = sphere_start.search(image, radius_px)[:REFINED_STARTS]
    found: list[sphere_outline.Outline] = []
    complaint: DegenerateError | None = None
    for start in starts:
        try:
            found.append(sphere_outline.refine_outline(image, expected.kind, start, curve))
        except DegenerateError as error:
            complaint = complaint or error
            continue
        if len(found[-1].points_px) > CLEAR_RAYS * sphere_outline.RAYS and found[-1].contrast > CLEAR_CONTRAST:
            break
    if not found:
        raise complaint or DegenerateError("no round outline is found", needed="one sphere, whole and sharp in the picture")
    return max(found, key=lambda outline: len(outline.points_px) * np.sqrt(outline.radius_px) * min(outline.contrast, 20.0))


def _with_highlights(view: SphereView, radiance: Radiance, outline: sphere_outline.Outline) -> SphereView:
    places: dict[str, Array] = {}
    sigmas: dict[str, float] = {}
    for k, light in enumerate(radiance.lights):
        dark = float(np.median(radiance.sigma[k]))
        long_, full = _grey(radiance.signal[k]), radiance.saturated[k]
        found = None
        if light in radiance.short:
            short = _grey(radiance.short[light])
            noise = float(1.4826 * np.median(np.abs(short - np.median(short)))) + 1e-9
            found = find_highlight(short, noise, np.zeros_like(full), outline.centre_px, outline.radius_px)
        if found is None:
            found = find_highlight(long_, dark, full, outline.centre_px, outline.radius_px)
        if found is not None:
            places[light], sigmas[light] = found.centre_px, found.sigma_px
    if not places:
        raise DegenerateError(
            "no light's highlight stands out in it",
            where=f"sphere {view.name}",
            needed="a mirror image of each light",
            todo="is it a chrome sphere?",
        )
    return SphereView(view.name, view.kind, view.radius_m, view.outline_px, view.outline_sigma_px, places, sigmas)


def _grey(image: Image) -> Image:
    return np.asarray(image.mean(axis=2) if image.ndim == 3 else image)

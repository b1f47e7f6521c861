"""A capture's images for systems that take them linear: 16 bit PNG, one scale for all, the ambient light off, the lens undone.

Pixels of the pinhole image are looked up in the image as it was taken, by bilinear interpolation; the mask by the nearest pixel.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import InputError
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.camera import Camera
from lpcal.records.exchange import ExchangeContent, LinearImages

FULL = 65535
"""Largest number of 16 bit."""
UNDER_FULL = 0.95
"""Share of the full scale that the brightest pixel is given: highlights stay below it, as readers expect."""


def capture_of(content: ExchangeContent) -> LinearImages:
    """The capture, which a format's `needs` promises."""
    assert content.capture is not None
    return content.capture


def write_images(content: ExchangeContent, target: Path, names: list[str] | None = None, mask: str = "mask") -> list[str]:
    """Write the images of the calibration's lights as ``<name>.png``, by default called after them, and the mask; notes.

    Raises
    ------
    InputError
        A light has no image in the capture.
    """
    capture, lights = capture_of(content), content.calibration.lights
    missing = [light.name for light in lights if light.name not in capture.lights]
    if missing:
        raise InputError(f"no image of {', '.join(missing[:5])}", where=capture.name, needed="an image of every light")
    images = undistorted(np.stack([capture.images[capture.lights.index(light.name)] for light in lights]), content.calibration.camera)
    scale = UNDER_FULL * FULL / max(float(np.nanmax(images)), 1e-12)
    for image, name in zip(images, names or [light.name for light in lights], strict=True):
        write_png(target / f"{name}.png", as_16_bit(image, scale))
    if capture.mask is not None:
        held = undistorted(capture.mask[None].astype(np.float32), content.calibration.camera, nearest=True)[0] > 0.5
        write_png(target / f"{mask}.png", np.asarray(255 * held, np.uint8))
    return [f"images are linear, ambient light off, {scale:.6g} times what the capture says, numbers below zero at zero"]


def as_16_bit(image: Image, scale: float) -> npt.NDArray[np.uint16]:
    """Numbers (H, W[, 3]) times a scale as 16 bit."""
    return np.asarray(np.rint(np.clip(np.nan_to_num(image) * scale, 0, FULL)), np.uint16)


def undistorted(images: Array | Image, camera: Camera | None, *, nearest: bool = False) -> Image:
    """Images (L, H, W[, 3]) of the pinhole camera with the same K; as they are without a camera or a distortion."""
    if camera is None or (camera.spline is None and not np.any(camera.distortion)):
        return np.asarray(images, np.float32)
    import cv2

    height, width = images.shape[1:3]
    column, row = np.meshgrid(np.arange(width), np.arange(height))
    x = (column - camera.K[0, 2]) / camera.K[0, 0]
    y = (row - camera.K[1, 2]) / camera.K[1, 1]
    places = camera.project(np.stack([x, y, np.ones_like(x)], axis=-1)).astype(np.float32)
    way = cv2.INTER_NEAREST if nearest else cv2.INTER_LINEAR
    return np.stack([cv2.remap(np.asarray(image, np.float32), places[..., 0], places[..., 1], way) for image in images])


def write_png(path: Path, pixels: npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | Mask) -> None:
    """Write pixels (H, W) or (H, W, 3) RGB.

    Raises
    ------
    InputError
        They cannot be encoded.
    """
    import cv2

    encoded, data = cv2.imencode(".png", np.asarray(pixels[..., ::-1] if pixels.ndim == 3 else pixels))
    if not encoded:
        raise InputError("cannot be encoded as PNG", where=str(path))
    path.write_bytes(data.tobytes())

"""An object's pixels as a list, with their rays and the signals of the lights at them.

Symbols: P pixels, L lights, ray r (scaled to z = 1), point ``x = z r``. Signals are divided by their light's intensity, so that every
light counts as one of intensity 1; the channels of an RGB capture are averaged into one signal, weighted by their inverse variance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Calibration, Camera, Light
from lpcal.records.observations import Radiance
from lpcal.view import parallel
from lpcal.view.constants import LEAST_COSINE

type Indices = npt.NDArray[np.int64]

LIGHTS_NEEDED = 3


@dataclass(frozen=True)
class SignalMaps:
    """Maps (L, H, W) of the signal of each light per unit of its intensity, and its standard deviation."""

    signal: Image
    sigma: Image
    usable: Mask
    """Not saturated."""


@dataclass(frozen=True)
class PixelList:
    """The pixels of a mask: P pixels under L lights."""

    mask: Mask
    """(H, W); the listed pixels are its True entries, row by row."""
    rays_C: Array
    """(P, 3), scaled to z = 1."""
    signal: Array
    """(L, P)."""
    sigma: Array
    usable: Mask
    central: bool
    """Whether the projection is central; without a camera rays are parallel and depths are in pixels."""

    @property
    def pixels(self) -> int:
        """P."""
        return len(self.rays_C)

    def map(self, values: npt.NDArray[np.generic], outside: float = np.nan) -> npt.NDArray[np.generic]:
        """Values (P, ...) as a map (H, W, ...)."""
        found = np.full((*self.mask.shape, *values.shape[1:]), outside, values.dtype)
        found[self.mask] = values
        return found

    def at(self, some: Indices | slice) -> PixelList:
        """Some of the pixels; the mask stays that of all."""
        return replace(self, rays_C=self.rays_C[some], signal=self.signal[:, some], sigma=self.sigma[:, some], usable=self.usable[:, some])

    def points_C(self, depth: Array) -> Array:
        """Points (P, 3) at depths (P,)."""
        return depth[:, None] * self.rays_C

    def shape_C(self, depth: Array) -> Array:
        """Points (P, 3) of the surface: `points_C` in metres, or column, row and depth in pixels without a camera."""
        if self.central:
            return self.points_C(depth)
        rows, columns = np.nonzero(self.mask)
        return np.stack([columns, rows, depth], axis=1).astype(float)


@dataclass(frozen=True)
class Illumination:
    """The light at each pixel: direct and interreflected."""

    d: Array
    """(L, P, 3) unit vectors to the lights."""
    E: Array
    """(L, P) irradiance."""
    interreflected: Array | None = None
    """(L, P, 3) light vectors of what other parts of the object, the wall and the support reflect here (surface.interreflection)."""
    unseen: Array | None = None
    """(P,) share of a pixel's surroundings that are sides of the object hidden from the camera: their light is an estimate."""

    @property
    def B(self) -> Array:
        """Light vectors (L, P, 3), direct and interreflected."""
        return self.direct if self.interreflected is None else self.direct + self.interreflected

    @property
    def direct(self) -> Array:
        """Light vectors (L, P, 3) of the lights alone."""
        return self.d * self.E[..., None]

    def at(self, some: Indices | slice) -> Illumination:
        """At some of the pixels."""
        interreflected = None if self.interreflected is None else self.interreflected[:, some]
        return Illumination(self.d[:, some], self.E[:, some], interreflected, None if self.unseen is None else self.unseen[some])


def vectors(light: Illumination | Array, some: Indices | slice) -> Array:
    """Light vectors (L, Q, 3) at some of the pixels, from an illumination or from vectors (L, P, 3)."""
    return light.at(some).B if isinstance(light, Illumination) else light[:, some]


def strength(maps: SignalMaps) -> Image:
    """Signal (H, W) of the second brightest light at each pixel: robust to a highlight in one light."""
    return np.asarray(second(maps.signal), np.float32)


def second[T: np.floating](values: npt.NDArray[T]) -> npt.NDArray[T]:
    """Second largest (...) of values (L, ...) along the first axis, L >= 2."""
    high, found = np.maximum(values[0], values[1]), np.minimum(values[0], values[1])
    for one in values[2:]:
        np.maximum(found, np.minimum(high, one), out=found)
        np.maximum(high, one, out=high)
    return found


def lights_of(calibration: Calibration, radiance: Radiance) -> tuple[Light, ...]:
    """The calibrated lights of a capture, in the capture's order.

    Raises
    ------
    DegenerateError
        There are fewer than three lights, or all directions lie in one plane: they do not determine a normal.
    """
    by_name = {light.name: light for light in calibration.lights}
    lights = tuple(by_name[name] for name in radiance.lights)
    if len(lights) < LIGHTS_NEEDED:
        raise DegenerateError(
            f"{len(lights)} light{'s' * (len(lights) != 1)}", where=radiance.name, needed="three lights at least", todo="take more images"
        )
    spread = np.linalg.svd(np.stack([light.direction_C for light in lights]), compute_uv=False)
    if spread[2] < LEAST_COSINE * spread[0]:
        raise DegenerateError(
            "all lights lie in one plane with the object",
            where=f"{radiance.name}, lights {', '.join(radiance.lights)}",
            needed="lights round the object",
            todo="add a light out of the plane",
        )
    return lights


def agree_on_size(name: str, size: tuple[int, ...], camera: Camera | None) -> None:
    """Refuse a capture of another image size (H, W) than the calibrated camera's.

    Raises
    ------
    DisagreementError
        The sizes differ.
    """
    height, width = size
    if camera is not None and (width, height) != tuple(camera.image_size):
        raise DisagreementError(
            f"images of {width}x{height}",
            where=name,
            needed=f"{camera.image_size[0]}x{camera.image_size[1]}, the calibrated camera's size",
            todo="take the capture with that camera and at its full size, or calibrate again",
        )


def grey(radiance: Radiance, lights: Sequence[Light], weight: Array | None = None) -> SignalMaps:
    """Signal maps of a capture per unit of intensity; colours are averaged with `weight` (3,), by default `colour_weight`."""
    factor = _factor(radiance, lights)
    shape = radiance.signal.shape[:3]
    if radiance.signal.ndim == 3:
        return SignalMaps(radiance.signal * factor, radiance.sigma * factor, ~radiance.saturated)
    weight = colour_weight(radiance, lights) if weight is None else weight
    signal, sigma = np.empty(shape, np.float32), np.empty(shape, np.float32)
    for k, by in enumerate(factor):
        signal[k] = (radiance.signal[k] * by) @ weight
        sigma[k] = np.sqrt((radiance.sigma[k] * by) ** 2 @ weight**2)
    return SignalMaps(signal, sigma, ~radiance.saturated)


def colour_weight(radiance: Radiance, lights: Sequence[Light]) -> Array:
    """Weights (3,) of the colours of an RGB capture, of sum 1: their inverse mean variances."""
    both = zip(radiance.sigma, _factor(radiance, lights), strict=True)
    variance = np.mean([np.mean((std * by) ** 2, axis=(0, 1), dtype=float) for std, by in both], axis=0)
    weight = 1 / np.maximum(variance, 1e-20)
    return np.asarray((weight / weight.sum()).astype(np.float32))


def _factor(radiance: Radiance, lights: Sequence[Light]) -> Image:
    """Factor 1 / intensity of each light: (L, 1, 1), or (L, 1, 1, 3) for colours."""
    if radiance.signal.ndim == 3:
        return np.asarray(1 / np.stack([light.intensity.mean(keepdims=True) for light in lights]).astype(np.float32)[:, None], np.float32)
    intensity = np.stack([light.intensity for light in lights]).astype(np.float32)
    return np.asarray(1 / np.broadcast_to(intensity, (len(lights), 3))[:, None, None, :])


def room(radiance: Radiance) -> Image | None:
    """The ambient image (H, W), averaged over colours; None where there is none."""
    picture = radiance.ambient if radiance.ambient.ndim == 2 else radiance.ambient.mean(axis=2)
    return np.asarray(picture) if picture.any() else None


def ray_map(shape: tuple[int, ...], camera: Camera | None) -> Array:
    """Rays (H, W, 3) of all pixels, scaled to z = 1; without a camera all (0, 0, 1)."""
    height, width = shape[:2]
    rays_C = np.zeros((height, width, 3))
    rays_C[..., 2] = 1.0
    if camera is None:
        return rays_C

    def fill(rows: slice) -> None:
        pixels = np.empty((rows.stop - rows.start, width, 2))
        pixels[..., 0], pixels[..., 1] = np.arange(width), np.arange(rows.start, rows.stop)[:, None]
        rays_C[rows, :, :2] = camera.slopes(pixels)

    parallel.run_bands(height, width, fill)
    return rays_C


def rays_at(pixels: npt.NDArray[np.number], camera: Camera | None) -> Array:
    """Rays (N, 3) of pixels (N, 2), scaled to z = 1; without a camera all (0, 0, 1)."""
    if camera is None:
        return np.tile([0.0, 0.0, 1.0], (len(pixels), 1))
    rays_C = np.ones((len(pixels), 3))
    rays_C[:, :2] = camera.slopes(pixels.astype(float))
    return rays_C


def list_pixels(maps: SignalMaps, rays_C: Array, mask: Mask, *, central: bool) -> PixelList:
    """The pixels of a mask (H, W) as a list."""
    at = np.flatnonzero(mask)
    signal, sigma = (values.reshape(len(values), -1)[:, at].astype(float) for values in (maps.signal, maps.sigma))
    return PixelList(mask, rays_C.reshape(-1, 3)[at], signal, sigma, maps.usable.reshape(len(signal), -1)[:, at], central)


def light_vectors(lights: Sequence[Light], x_C: Array, focus_C: Array | None = None) -> tuple[Array, Array]:
    """Unit directions d (L, P, 3) to the lights and irradiance E (L, P) per unit of intensity at points x_C (P, 3).

    If `focus_C` (3,) is given, lights are distant: direction and irradiance are everywhere those at `focus_C`.
    """
    shape = (len(lights), len(x_C))
    if focus_C is not None:
        found = [light.unit_field(focus_C) for light in lights]
        E = np.array([irradiance.mean() for _, irradiance in found])
        return np.broadcast_to(np.stack([d.reshape(1, 3) for d, _ in found]), (*shape, 3)), np.broadcast_to(E[:, None], shape)
    d, E = np.empty((*shape, 3)), np.empty(shape)

    def fill(place: tuple[int, slice]) -> None:
        d[place], E[place] = lights[place[0]].unit_field(x_C[place[1]], single=True)

    parallel.run_all(fill, [(k, at) for k in range(len(lights)) for at in parallel.bands(len(x_C), 1)])
    return d, E


def fronts_m(lights: Sequence[Light], span: tuple[float, float], steps: int) -> Array:
    """Depths (steps,), m, of fronto-parallel planes to be tried, `span` beyond the lights' mean depth in units of their rms spread."""
    sources_C = np.stack([light.source_C for light in lights if light.source_C is not None])
    spread = float(np.sqrt(np.mean(np.sum((sources_C - sources_C.mean(axis=0)) ** 2, axis=1))))
    return np.asarray(max(float(sources_C[:, 2].mean()), 0.0) + spread * np.geomspace(*span, steps))


def light_slopes(lights: Sequence[Light], x_C: Array) -> Array:
    """Derivative (L, P, 3) of the light vectors by log depth, at points x_C (P, 3) moved along their rays."""
    return np.stack([light.slope(x_C) for light in lights])


def powers(xy: Array) -> Array:
    """Monomials 1, x, y, x^2, xy, y^2 (P, 6) of the rays' x and y (P, 2), a basis for functions that are smooth over the image."""
    x, y = xy.T
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)

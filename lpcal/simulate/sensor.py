r"""From light to stored numbers.

Symbols: L the radiance of a pixel, V the vignetting, t the exposure, w the full well in electrons, g the gamma, b and s the black and the
white level as fractions of full scale::

    e = Poisson(V L t w) + read noise,   stored^g = b^g + (s^g - b^g) min(e / w, 1),   then rounded to whole steps

Source: EMVA standard 1288, the linear camera model.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Array
from lpcal.geometry.tone_curve import Gamma, decode, encode
from lpcal.simulate.recipe import SensorRecipe

type Stored = npt.NDArray[np.uint8] | npt.NDArray[np.uint16]


@dataclass(frozen=True)
class Response:
    """A sensor behind a lens, as panel.yaml describes it."""

    sensor: SensorRecipe
    vignetting: Array
    black: float = 0.0
    white: float = 1.0
    gamma: Gamma = 1.0

    def __call__(self, light: Array, rng: np.random.Generator) -> Stored:
        """The stored image (H, W) of light (H, W), already blurred, as a fraction of the full well before vignetting."""
        well = self.sensor.full_well_e
        electrons = rng.poisson(np.maximum(light * self.vignetting, 0) * well) + self.sensor.read_noise_e * rng.standard_normal(light.shape)
        low, high = decode(np.array([self.black, self.white]), self.gamma)
        linear = low + (high - low) * np.minimum(electrons / well, 1)
        scale = 2**self.sensor.bits - 1
        stored = np.clip(np.rint(scale * encode(linear, self.gamma)), 0, scale)
        return stored.astype(np.uint8 if self.sensor.bits <= 8 else np.uint16)


def blur(light: Array, sigma: float) -> Array:
    """Light (H, W) after a Gaussian blur of sigma samples."""
    import cv2

    return np.asarray(cv2.GaussianBlur(light, (0, 0), sigma, borderType=cv2.BORDER_REPLICATE)) if sigma > 0 else light


def splat(light: Array, pixel: Array, flux: float, sigma_px: float) -> None:
    """Add a Gaussian spot of a total flux at a pixel (u, v), integrated over each pixel's square."""
    from scipy.special import erf

    reach = int(np.ceil(5 * sigma_px)) + 1
    u0, v0 = (round(float(p)) for p in pixel)
    profile = []
    for at, middle in ((pixel[0], u0), (pixel[1], v0)):
        edges = np.arange(middle - reach, middle + reach + 2) - 0.5
        profile.append(np.diff(erf((edges - at) / (np.sqrt(2) * sigma_px))) / 2)
    height, width = light.shape
    columns, rows = np.arange(u0 - reach, u0 + reach + 1), np.arange(v0 - reach, v0 + reach + 1)
    in_u, in_v = (columns >= 0) & (columns < width), (rows >= 0) & (rows < height)
    light[np.ix_(rows[in_v], columns[in_u])] += flux * np.outer(profile[1][in_v], profile[0][in_u])

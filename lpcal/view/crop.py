"""The crop of a capture about a mask, and a surface of the crop put back into the full image."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lpcal.geometry.arrays import Mask
from lpcal.records.observations import Radiance
from lpcal.records.surface import Surface

MARGIN_PX = 8
"""Margin about the mask, pixels: no neighbourhood operation reaches farther."""
MAPS = ("normals", "depth", "albedo", "mask", "normal_std_deg", "depth_std", "lights_used", "component", "layer")


@dataclass(frozen=True)
class Crop:
    """A box of rows and columns in an image of a shape (H, W)."""

    rows: slice
    columns: slice
    shape: tuple[int, int]

    @staticmethod
    def about(mask: Mask) -> Crop:
        """The bounding box of a mask (H, W) with its margin; the whole image where the mask is empty."""
        sides = []
        for axis, size in ((1, mask.shape[0]), (0, mask.shape[1])):
            held = np.flatnonzero(mask.any(axis=axis))
            sides.append(slice(max(held[0] - MARGIN_PX, 0), min(held[-1] + MARGIN_PX + 1, size)) if held.size else slice(0, size))
        return Crop(sides[0], sides[1], (mask.shape[0], mask.shape[1]))

    def of[T: np.generic](self, maps: npt.NDArray[T]) -> npt.NDArray[T]:
        """A map (H, W, ...) cropped."""
        return maps[self.rows, self.columns]

    def radiance(self, whole: Radiance) -> Radiance:
        """A capture cropped: its maps are copied one after the other, so that the whole ones can be freed."""
        part = whole
        del whole  # unless the caller holds it, each whole map is freed once its part is copied
        part = replace(part, saturated=self._copies(part.saturated))
        part = replace(part, signal=self._copies(part.signal))
        part = replace(part, sigma=self._copies(part.sigma))
        short = {light: self.of(image).copy() for light, image in part.short.items()}
        mask = None if part.mask is None else self.of(part.mask)
        return replace(part, ambient=self.of(part.ambient).copy(), short=short, mask=mask)

    def _copies[T: np.generic](self, images: npt.NDArray[T]) -> npt.NDArray[T]:
        """Images (L, H, W, ...) cropped, as a copy."""
        return images[:, self.rows, self.columns].copy()

    def surface(self, whole: Surface) -> Surface:
        """A surface cropped: its maps are views of the whole one's; all that is not a map is unchanged."""
        maps = {name: self.of(one) for name in (*MAPS, "rays_C") if (one := getattr(whole, name)).size}
        breaks = whole.breaks[:, self.rows, self.columns] if whole.breaks.size else whole.breaks
        changed: Any = {**maps, "breaks": breaks}
        return replace(whole, **changed)

    def put_back(self, part: Surface) -> Surface:
        """The surface of a crop in the full image; its rays must all be the same (no camera)."""
        maps = {name: self._whole(getattr(part, name)) for name in MAPS}
        breaks = np.ones((2, *self.shape), bool)
        breaks[:, self.rows, self.columns] = part.breaks
        rays = np.broadcast_to(part.rays_C[0, 0], (*self.shape, 3)).copy()
        changed: Any = {**maps, "breaks": breaks, "rays_C": rays}
        return replace(part, **changed)

    def _whole(self, part: npt.NDArray[Any]) -> npt.NDArray[Any]:
        found = np.full((*self.shape, *part.shape[2:]), np.nan if part.dtype.kind == "f" else 0, part.dtype)
        found[self.rows, self.columns] = part
        return found

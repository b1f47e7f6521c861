"""Matte spheres under near lights, as means over small blocks of pixels.

A block's mean shading is not that of its middle: the normals turn within it (at the limb by degrees), so the model is averaged over the
block's own pixels; `log_curve` keeps what that is to the middle. Ambient light is taken away raw; what is saturated, in shadow or near
the limb is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import light_field, se3, sphere
from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.records.calibration import Camera, Light
from lpcal.records.observations import Radiance, SphereView

BLOCK_PX = 6
FACING_CAMERA, FACING_LIGHT = 0.35, 0.12
BLOCK_SHARE = 0.6
SIGNIFICANT = 3.0


@dataclass(frozen=True)
class Samples:
    """Row k is one block under one light."""

    light: Index
    sphere: Index
    block: Index
    log_data: Array
    """Logarithm of the mean over the block."""
    relative_sigma: Array
    """Relative standard deviation of that mean, from image noise."""
    log_geometry: Array
    """log(mean(n . d / r^2)) from the light's source."""
    angle_rad: Array
    """From the light's axis, seen from its source."""
    around_rad: Array
    """About the axis, from the x of the light's frame."""
    ray_C: Array
    """(N, 3) unit ray through the block's middle."""
    log_curve: Array
    """log of the mean of the model over the block's pixels over its value at the middle."""
    colour: Array
    """(N, C) mean data a channel over the grey mean."""

    def some(self, kept: Mask) -> Samples:
        """Those of the mask (N,)."""
        return Samples(*(getattr(self, one.name)[kept] for one in fields(Samples)))


def sample_blocks(views: Sequence[SphereView], centres_C: Array, camera: Camera, lights: Sequence[Light]) -> Samples:
    """Block means of all matte spheres under all lights, which are near ones as far as they are known yet.

    Raises
    ------
    DegenerateError
        No block of a sphere is lit and unsaturated.
    """
    parts: list[Samples] = []
    blocks = 0
    for s, (view, centre_C) in enumerate(zip(views, centres_C, strict=True)):
        if view.shading is None:
            continue
        part = _Sphere(view, view.shading, centre_C, camera).samples(lights)
        if part is None:
            raise DegenerateError(
                "no part of it is lit and unsaturated",
                where=f"sphere {view.name}",
                needed="a matte sphere neither dark nor saturated",
                todo="change the exposure",
            )
        parts.append(replace(part, sphere=np.full_like(part.sphere, s), block=part.block + blocks))
        blocks += int(part.block.max()) + 1
    return _joined(parts)


class _Sphere:
    """One matte sphere's pixels: where they are, how they face, and which block each belongs to."""

    def __init__(self, view: SphereView, shading: Radiance, centre_C: Array, camera: Camera) -> None:
        self.shading, self.centre_C, self.radius_m = shading, centre_C, view.radius_m
        rows, columns = _box(view.outline_px, shading.saturated.shape[1:])
        across = 1 + int(columns.max() - columns.min()) // BLOCK_PX
        block = (rows - rows.min()) // BLOCK_PX * across + (columns - columns.min()) // BLOCK_PX
        self.members = np.bincount(block.ravel())
        u_C = camera.unproject(np.stack([columns, rows], axis=-1).astype(float))
        P_C, n_C = sphere.meet(u_C, centre_C, view.radius_m)
        facing: Mask = np.nan_to_num(-np.sum(n_C * u_C, axis=-1), nan=-1.0) > FACING_CAMERA
        self.rows, self.columns, self.block = rows[facing], columns[facing], block[facing]
        self.u_C, self.P_C, self.n_C = u_C[facing], P_C[facing], n_C[facing]

    def samples(self, lights: Sequence[Light]) -> Samples | None:
        """The samples of every light that the sphere's images show; None where no block is lit."""
        names = [light.name for light in lights]
        parts = [
            self._under(names.index(name), lights[names.index(name)], k) for k, name in enumerate(self.shading.lights) if name in names
        ]
        lit = [part for part in parts if part.light.size]
        return _joined(lit) if lit else None

    def _under(self, row: int, light: Light, k: int) -> Samples:
        assert light.source_C is not None
        assert light.axis_C is not None
        assert light.H_CL is not None
        source_d, r, angle = light_field.near_light(self.P_C, light.source_C, light.axis_C)
        cosine = np.sum(self.n_C * source_d, axis=-1)
        good = np.flatnonzero((cosine > FACING_LIGHT) & ~self.shading.saturated[k, self.rows, self.columns])
        rows, columns, block = self.rows[good], self.columns[good], self.block[good]
        data = self.shading.signal[k, rows, columns].astype(float)
        sigma = self.shading.sigma[k, rows, columns].astype(float)
        channels = data[..., None] if data.ndim == 1 else data
        noise = sigma if sigma.ndim == 1 else np.sqrt(np.mean(sigma**2, axis=-1) / sigma.shape[-1])
        number = np.bincount(block, minlength=len(self.members))

        def mean(value: Array) -> Array:
            return np.bincount(block, weights=value, minlength=len(self.members)) / np.maximum(number, 1)

        level, spread = mean(channels.mean(axis=-1)), np.sqrt(mean(noise**2) / np.maximum(number, 1))
        keep = np.flatnonzero((number >= BLOCK_SHARE * self.members) & (number > 0) & (level > SIGNIFICANT * spread))
        middle = np.stack([mean(self.u_C[good, axis])[keep] for axis in range(3)], axis=1)
        middle /= np.linalg.norm(middle, axis=1, keepdims=True)
        d_C, irradiance = light.field(self.P_C[good])
        model = mean(irradiance.mean(axis=-1) * np.sum(self.n_C[good] * d_C, axis=-1))[keep]
        x_L = se3.apply(se3.inv(light.H_CL), sphere.meet(middle, self.centre_C, self.radius_m)[0])
        return Samples(
            light=np.full(keep.size, row),
            sphere=np.zeros(keep.size, np.intp),
            block=keep,
            log_data=np.log(level[keep]),
            relative_sigma=spread[keep] / level[keep],
            log_geometry=np.log(mean(cosine[good] / r[good] ** 2)[keep]),
            angle_rad=mean(angle[good])[keep],
            around_rad=np.arctan2(x_L[:, 1], x_L[:, 0]),
            ray_C=middle,
            log_curve=np.log(model / self._model_at(light, middle)),
            colour=np.stack([mean(channels[..., c])[keep] / level[keep] for c in range(channels.shape[-1])], axis=1),
        )

    def _model_at(self, light: Light, u_C: Array) -> Array:
        P_C, n_C = sphere.meet(u_C, self.centre_C, self.radius_m)
        d_C, irradiance = light.field(P_C)
        return np.asarray(irradiance.mean(axis=-1) * np.sum(n_C * d_C, axis=-1))


def _joined(parts: Sequence[Samples]) -> Samples:
    return Samples(*(np.concatenate([getattr(part, one.name) for part in parts]) for one in fields(Samples)))


def _box(outline_px: Array, shape: tuple[int, ...]) -> tuple[Index, Index]:
    low = np.maximum(np.floor(outline_px.min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(outline_px.max(axis=0)).astype(int), [shape[1] - 1, shape[0] - 1])
    columns, rows = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
    return rows, columns

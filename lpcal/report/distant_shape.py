"""The shape that the same lights would have given, had they been taken as distant: what a page shows against the measured one.

A distant light has one direction and one strength: those of its field at the surface's middle x_0. Where the surface was solved that way
too, its own depth is taken. Else the signals are predicted from the measured surface and field, and solved as distant ones::

    i_l = rho E_l(x) max(n . d_l(x), 0)          rho n' = argmin sum_l lit_l (E_l(x_0) d_l(x_0) . b - i_l)^2

and n' is integrated over a coarse grid, as normals from elsewhere are. Of both, what counts is the factor ``z' / z`` of each pixel's depth,
its median put to 1, since normals do not determine the distance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.integration.integrate import Grid
from lpcal.integration.of_normals import integrate_normals
from lpcal.records.calibration import Calibration
from lpcal.records.surface import Surface
from lpcal.report.packing import deflate
from lpcal.report.page_data import BendData
from lpcal.report.pictures import bounds
from lpcal.view.constants import FEWEST_PIXELS

CELLS = 96
"""Cells along the longer side of the coarse grid: the bend of a wrong light model is smooth."""
LEAST_LIGHTS = 3
"""Lights that a normal needs."""
HELD = 1e-6
"""Share of the normal equations' trace that holds a normal which fewer than three lights reach to the measured one."""
MOST_RELATIVE = 0.5
"""Largest change of a depth that the page is given, relative: past it, it is no shape of this object."""


@dataclass(frozen=True)
class Bend:
    """How depth and normals change when the lights are taken as distant, over a coarse grid (h, w) of blocks of `step` pixels."""

    solved: bool
    """Whether it was solved from the images, else predicted from the measured surface and lights."""
    mask: Mask
    factor: Image
    """Depth over measured depth, its median 1."""
    tilt: Image
    """(h, w, 2) change of the normal's x and y."""
    window: tuple[slice, slice]
    step: int
    bowl: float
    """Root mean square of the change in depth, metres."""

    def document(self, window: tuple[slice, slice]) -> BendData:
        """The bend as the page's script reads it; `window` is the crop that the page shows."""
        strength = max(float(np.abs(self.factor[self.mask] - 1).max(initial=0)), 1e-9)
        turn = max(float(np.abs(self.tilt[self.mask]).max(initial=0)), 1e-9)
        parts = [(self.factor - 1) / strength, self.tilt[..., 0] / turn, self.tilt[..., 1] / turn]
        words = [
            np.asarray(np.where(self.mask, np.clip(32768 + np.round(32767 * np.nan_to_num(p)), 1, 65535), 0), np.uint16) for p in parts
        ]
        return {
            "solved": self.solved,
            "planes": deflate(list(words)),
            "width": self.mask.shape[1],
            "height": self.mask.shape[0],
            "strength": strength,
            "turn": turn,
            "offset": [self.window[1].start - window[1].start, self.window[0].start - window[0].start],
            "step": self.step,
            "bowl": self.bowl,
        }


def bend_of(surface: Surface, calibration: Calibration, distant: Surface | None = None) -> Bend | None:
    """The bend of a surface; None where there is no camera, the lights are distant anyway, or too few pixels or lights show it."""
    near = [light for light in calibration.lights if light.source_C is not None]
    if not surface.metric or len(near) < LEAST_LIGHTS:
        return None
    window = bounds(surface.mask)
    step = max(1, -(-max(surface.mask[window].shape) // CELLS))
    rows, columns = (slice(part.start + step // 2, part.stop, step) for part in window)
    at = (rows, columns)
    mask = surface.mask[at] & np.isfinite(surface.depth[at])
    if mask.sum() < FEWEST_PIXELS:
        return None
    if distant is not None:
        mask = mask & np.isfinite(distant.depth[at]) & distant.mask[at]
        normals, ratio = distant.normals[at][mask].astype(float), distant.depth[at][mask] / surface.depth[at][mask]
    else:
        normals = _distant_normals(
            surface.normals[at][mask].astype(float), surface.depth[at][mask][:, None] * surface.rays_C[at][mask], calibration
        )
        rays = surface.rays_C[at][mask]
        grid = Grid.of(mask)
        both = [integrate_normals(grid, n, rays, central=True)[0] for n in (surface.normals[at][mask].astype(float), normals)]
        ratio = np.exp(both[1] - both[0])
    factor = _shape_alone(ratio.astype(float), surface.component[at][mask])
    if not np.isfinite(factor).all():
        return None
    bowl = float(np.sqrt(np.mean(((factor - 1) * surface.depth[at][mask]) ** 2)))
    factors, tilts = np.ones(mask.shape, np.float32), np.zeros((*mask.shape, 2), np.float32)
    factors[mask], tilts[mask] = factor, (normals - surface.normals[at][mask])[:, :2]
    return Bend(distant is not None, mask, factors, tilts, window, step, bowl)


def _shape_alone(ratio: Array, label: Labels) -> Array:
    """The depths' factor (P,) with the median of each piece put to 1, kept within what can be shown."""
    labels, of_pixel = np.unique(label, return_inverse=True)
    medians = np.array([np.median(ratio[label == one]) for one in labels])
    return np.clip(ratio / medians[of_pixel], 1 - MOST_RELATIVE, 1 + MOST_RELATIVE)


def _distant_normals(normals: Array, points: Array, calibration: Calibration) -> Array:
    """Normals (P, 3) that lights taken as distant would give of a surface of normals (P, 3) at points (P, 3)."""
    middle = np.median(points, axis=0)
    G, right = np.zeros((len(normals), 3, 3)), np.zeros((len(normals), 3))
    for light in calibration.lights:
        d, E = light.field(points)
        d_0, E_0 = light.field(middle)
        signal = E.mean(axis=-1) * np.maximum(np.einsum("pi,pi->p", normals, d), 0)
        pull = float(np.mean(E_0)) * d_0
        lit = (signal > 0).astype(float)
        G += lit[:, None, None] * np.outer(pull, pull)
        right += (lit * signal)[:, None] * pull
    held = HELD * np.trace(G, axis1=1, axis2=2)[:, None] + np.finfo(float).tiny
    b = np.linalg.solve(G + held[..., None] * np.eye(3), (right + held * normals)[..., None])
    return np.asarray(lambert.unit(b[..., 0])[0])

r"""A capture in full size, tile by tile, based on the solution in coarse pixels.

The coarse capture is solved as any other: object, distance, gloss, interreflection and occlusion. Here each tile takes its light from that
solution, estimates its own normals (shading.field, starting from the coarse normals and each pixel's own albedo), and integrates them to a
depth that is tied to the coarse one (screened integration): with steps g_ab of neighbours a, b and the coarse log depth h,

    minimise  sum_ab w_ab ((u_b - u_a - g_ab) / s)^2  +  sum_p ((u_p - h_p) / (s SCREEN factor))^2

whose influence falls to 1/e over SCREEN coarse pixels, so that tiles which overlap by more agree; between them depths are blended.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Labels, Mask
from lpcal.integration.integrate import Grid, Own, integrate, normals_of, settle, steps
from lpcal.integration.pieces import BREAK_WEIGHT
from lpcal.records.calibration import Camera
from lpcal.records.observations import Radiance
from lpcal.records.outcome import Progress
from lpcal.shading import field
from lpcal.shading.field import Field
from lpcal.shading.gloss import Gloss
from lpcal.shading.normals import Estimate, albedo_of
from lpcal.surface import uncertainty
from lpcal.surface.coarse_solution import CoarseSolution
from lpcal.surface.rounds import FULL_ROUNDS, Scene
from lpcal.view import parallel, pixel_list
from lpcal.view.constants import LEAST_COSINE, OUTLIER2, REGULARISATION
from lpcal.view.crop import MARGIN_PX
from lpcal.view.pixel_list import Illumination

SAMPLES = 1_500_000
"""Samples, lights times pixels, of a tile: its lists of vectors then take some 200 MB a core."""
SCREEN = 3.0
"""Coarse pixels over which the influence of the coarse depth on the fine one falls to 1/e."""
INTEGRATED_SIDE = 768
"""Pixels of a tile's side where depths are integrated."""


@dataclass(frozen=True)
class Tile:
    """A tile of an image."""

    rows: slice
    """Rows with the margin, as far as the image reaches."""
    columns: slice
    core: tuple[slice, slice]
    """Rows and columns without the margin, in the image."""

    @property
    def within(self) -> tuple[slice, slice]:
        """The core within the tile."""
        first = (self.rows.start, self.columns.start)
        found = (slice(some.start - start, some.stop - start) for some, start in zip(self.core, first, strict=True))
        low, high = found
        return low, high

    @property
    def outer(self) -> tuple[slice, slice]:
        """Rows and columns with the margin, in the image."""
        return self.rows, self.columns


def tiles(size: tuple[int, int], side: int, margin: int) -> list[list[Tile]]:
    """Tiles of an image (H, W), row by row."""

    def cuts(length: int) -> list[tuple[slice, slice]]:
        count = max(1, round(length / side))
        ends = np.linspace(0, length, count + 1).round().astype(int).tolist()
        return [(slice(max(low - margin, 0), min(high + margin, length)), slice(low, high)) for low, high in pairwise(ends)]

    return [[Tile(rows, columns, (row, column)) for columns, column in cuts(size[1])] for rows, row in cuts(size[0])]


@dataclass(frozen=True)
class Maps:
    """Maps in full size: (H, W) each, NaN or 0 outside the mask."""

    normals: Image
    """(H, W, 3)."""
    depth: Image
    albedo: Image
    normal_std_deg: Image
    lights_used: Labels
    breaks: Mask
    """(2, H, W)."""


@dataclass(frozen=True)
class Full:
    """A capture in full size."""

    radiance_of: Callable[[slice, slice], Radiance]
    """The radiance of a part of the image, by its rows and columns."""
    mask: Mask
    """(H, W)."""
    camera: Camera | None
    scene: Scene
    """The scene in coarse pixels."""
    gloss: Gloss | None
    coarse: CoarseSolution
    weight: Array | None
    """Weights of the colours in the grey signal, as in coarse pixels."""

    @property
    def side(self) -> int:
        """Side of a tile, pixels, without its margin."""
        return int(np.sqrt(SAMPLES / len(self.scene.lights)))

    def rays_C(self, rows: slice, columns: slice) -> Array:
        """Rays (h, w, 3) of length 1 in z."""
        row, column = np.mgrid[rows, columns]
        return pixel_list.rays_at(np.stack([column, row], axis=-1).reshape(-1, 2), self.camera).reshape(*row.shape, 3)

    def solve(self, progress: Progress) -> Maps:
        """All maps."""
        found = self._blank()
        rows_of_tiles = tiles(self.mask.shape, self.side, MARGIN_PX)
        what = f"{self.scene.name}: normals in full size"
        for k, row in enumerate(rows_of_tiles):
            progress(what, k, len(rows_of_tiles))
            parallel.run_all(lambda tile: self._shaded(tile, found), [tile for tile in row if self.mask[tile.core].any()])
        progress(what, len(rows_of_tiles), len(rows_of_tiles))
        self._integrated(found, progress)
        return found

    def _blank(self) -> Maps:
        size = self.mask.shape
        colours = () if self.weight is None else (len(self.weight),)

        def map_of(*more: int) -> Image:
            return np.full((*size, *more), np.nan, np.float32)

        return Maps(map_of(3), map_of(), map_of(*colours), map_of(), np.zeros(size, np.uint8), np.ones((2, *size), bool))

    def _shaded(self, tile: Tile, found: Maps) -> None:
        """Normals, albedo and what noise makes of the normals."""
        inside = self.mask[tile.outer]
        radiance = self.radiance_of(*tile.outer)
        rays_C = self.rays_C(*tile.outer)
        maps = pixel_list.grey(radiance, self.scene.lights, self.weight)
        seen = pixel_list.list_pixels(maps, rays_C, inside, central=self.scene.seen.central)
        del maps
        coarse, near = self.coarse, self.scene.near
        u = coarse.starting_depth(*tile.outer, rays_C)[inside]
        depth = np.exp(u) if near else np.ones(seen.pixels)
        interreflected = unseen = hidden = None
        if coarse.interreflected is not None:
            interreflected = np.ascontiguousarray(np.moveaxis(coarse.between(coarse.interreflected, *tile.outer)[inside], 1, 0), float)
        if coarse.unseen is not None:
            unseen = coarse.between(coarse.unseen, *tile.outer)[inside].astype(float)
        if coarse.hidden is not None:
            hidden = np.ascontiguousarray(coarse.at(coarse.hidden, *tile.outer)[inside].T)
        lit = Illumination(*pixel_list.light_vectors(self.scene.lights, seen.points_C(depth), self.scene.focus_C), interreflected, unseen)
        n = coarse.between(coarse.n, *tile.outer)[inside].astype(float)
        correction: Array = np.zeros(3)
        if coarse.correction is not None:
            correction = coarse.between(coarse.correction[..., :3], *tile.outer)[inside].astype(float)
        n = lambert.unit(n - correction)[0]
        start = Field(_albedo_by(n, seen, lit, hidden)[:, None] * n, Estimate.nothing(), self.gloss)
        whole = field.solve(seen, Grid.of(inside), lit, hidden, start, rounds=FULL_ROUNDS)
        n = lambert.unit(lambert.unit(whole.b)[0] + correction)[0]
        signal = radiance.signal[:, inside].reshape(len(seen.signal), seen.pixels, -1)
        intensity = np.stack([light.intensity if signal.shape[2] > 1 else light.intensity[:1] for light in self.scene.lights])
        intensity = np.broadcast_to(intensity, (len(intensity), signal.shape[2]))
        albedo = albedo_of(signal, intensity, lit, n, whole.estimate, seen)
        core, within = tile.core, inside[tile.within]
        noise, misfit = uncertainty.noise_deg(whole.estimate, n)
        noise, used = noise * np.maximum(1, np.sqrt(misfit)), whole.estimate.used
        for values, to in ((n, found.normals), (albedo, found.albedo), (noise, found.normal_std_deg), (used, found.lights_used)):
            wide: npt.NDArray[np.generic] = np.zeros((*inside.shape, *values.shape[1:]), to.dtype)
            wide[inside] = values
            wide = wide[tile.within]
            to[core][within] = (wide if to.ndim == wide.ndim else wide[..., 0])[within]

    def _integrated(self, found: Maps, progress: Progress) -> None:
        """Depth, breaks, and the normals and their standard deviations by both."""
        reach = int(np.ceil(SCREEN * self.coarse.factor))
        margin, size = 3 * reach, self.mask.shape
        total = np.zeros(size, np.float32)
        found.depth[...] = 0.0
        rows_of_tiles = tiles(size, max(INTEGRATED_SIDE, margin), margin)
        what = f"{self.scene.name}: depth in full size"
        for k, row in enumerate(rows_of_tiles):
            progress(what, k, len(rows_of_tiles))
            some = [tile for tile in row if self.mask[tile.core].any()]
            for tile, u in zip(some, parallel.run_all(lambda tile: self._front(tile, found), some), strict=True):
                ramp = _ramp(tile, size, margin)
                found.depth[tile.outer] += ramp * u
                total[tile.outer] += ramp
        progress(what, len(rows_of_tiles), len(rows_of_tiles))
        for row in tiles((size[0], 1), self.side, 0):
            rows = row[0].rows
            depth = found.depth[rows] / np.maximum(total[rows], 1e-6)
            found.depth[rows] = np.where(self.mask[rows], np.exp(depth) if self.scene.seen.central else depth, np.nan)

    def _front(self, tile: Tile, found: Maps) -> Image:
        """u (h, w) of a tile; where its core breaks is noted."""
        inside, rays_C = self.mask[tile.outer], self.rays_C(*tile.outer)
        begin = self.coarse.starting_depth(*tile.outer, rays_C)[inside]
        grid, central = Grid.of(inside), self.scene.seen.central
        n = found.normals[tile.outer][inside].astype(float)
        step = steps(grid, n, rays_C[inside], central=central)
        near_break = self.coarse.at(self.coarse.near_break, *tile.outer)[inside]
        tie = 1 / (SCREEN * self.coarse.factor * float(np.median(step.sigma))) ** 2
        own = Own(np.where(near_break, REGULARISATION * tie, tie), begin)
        u, weight = integrate(grid, step, own, begin, graduated=False)
        u = settle(grid, step, own, u, weight)
        holds = np.zeros((2, *inside.shape), bool)
        first = np.flatnonzero(inside.ravel())[grid.a]
        for axis, edges in enumerate((grid.horizontal, ~grid.horizontal)):
            holds[axis].ravel()[first[edges & (weight > BREAK_WEIGHT)]] = True
        found.breaks[:, *tile.core] = ~holds[:, *tile.within]
        values = np.zeros(inside.shape, np.float32)
        values[inside] = u
        return values


def finished(full: Full, found: Maps, agree_deg: float, calibration_deg: float) -> None:
    """Normals drawn to those of the depth where both agree, and their standard deviations in place of what noise makes of them."""
    size, margin = full.mask.shape, 4
    before = np.zeros((0, size[1], 3), np.float32)
    rows_of_tiles = tiles(size, full.side, margin)
    for row in rows_of_tiles:
        rows = row[0].rows
        measured = found.normals[rows].copy()
        measured[: len(before)] = before[-min(len(before), len(measured)) :] if len(before) else measured[:0]
        core = row[0].core[0]
        before = measured[core.stop - rows.start - margin : core.stop - rows.start].copy()

        def of(tile: Tile, measured: Image = measured) -> tuple[Image, Image]:
            return _drawn(full, found, tile, measured[:, tile.columns], agree_deg, calibration_deg)

        for tile, (n, sigma) in zip(row, parallel.run_all(of, row), strict=True):
            found.normals[tile.core], found.normal_std_deg[tile.core] = n, sigma


def _drawn(full: Full, found: Maps, tile: Tile, measured: Image, agree_deg: float, calibration_deg: float) -> tuple[Image, Image]:
    """Normals (h, w, 3) and sigma (h, w) of a tile's core."""
    inside = full.mask[tile.outer]
    n = np.full((*inside.shape, 3), np.nan, np.float32)
    sigma = np.full(inside.shape, np.nan, np.float32)
    if inside.any():
        grid, rays_C = Grid.of(inside), full.rays_C(*tile.outer)
        own = measured[inside].astype(float)
        depth = found.depth[tile.outer][inside].astype(float)
        if full.scene.seen.central:
            points = depth[:, None] * rays_C[inside]
        else:
            points = np.stack([*np.nonzero(inside)[::-1], depth], axis=1).astype(float)
        whole = ~np.where(grid.horizontal, *(found.breaks[k][tile.outer][inside][grid.a] for k in (0, 1)))
        of_depth = normals_of(grid, points, whole)
        of_depth = np.where(np.isfinite(of_depth), of_depth, own)
        noise, used = (one[tile.outer][inside].astype(float) for one in (found.normal_std_deg, found.lights_used))
        share = full.coarse.at(full.coarse.share, *tile.outer)[inside].astype(float)
        around = full.coarse.unseen
        unseen = np.zeros(len(own)) if around is None else full.coarse.at(around, *tile.outer)[inside].astype(float)
        expected = None
        if full.coarse.correction is not None:
            expected = np.degrees(full.coarse.between(full.coarse.correction[..., 3], *tile.outer)[inside].astype(float))
        features = uncertainty.indicators_of(grid, inside, own, of_depth, whole, noise, np.ones(len(own)), used, share, unseen, expected)
        drawn = np.exp(-((features.bend_deg / agree_deg) ** 2))[:, None]
        n[inside] = lambert.unit(own + drawn * of_depth)[0]
        sigma[inside] = uncertainty.normal_sigma_deg(features, calibration_deg)
    return n[tile.within], sigma[tile.within]


def _albedo_by(n: Array, seen: pixel_list.PixelList, lit: Illumination, hidden: Mask | None) -> Array:
    """Albedo (P,) in the signals' units by normals (P, 3): the samples' factor on the shading, then of those that agree."""
    shading = np.maximum(lambert.dot(lit.d, n), 0.0) * lit.E
    counted = seen.usable & (shading > LEAST_COSINE * shading.max(axis=0))
    if hidden is not None:
        counted &= ~hidden
    weight = counted * shading**2
    total = np.maximum(weight.sum(axis=0), 1e-300)
    albedo = np.einsum("kp,kp->p", counted * shading, seen.signal) / total
    for _ in range(2):
        spread2 = seen.sigma**2 + (field.SHARED * seen.signal) ** 2 + (0.1 * albedo * shading) ** 2
        square = (seen.signal - albedo * shading) ** 2 / spread2
        robust = counted / (1 + square / OUTLIER2) ** 2
        albedo = np.sum(robust * shading * seen.signal, axis=0) / np.maximum(np.sum(robust * shading**2, axis=0), 1e-300)
    return np.maximum(albedo, 1e-9)


def _ramp(tile: Tile, size: Sequence[int], margin: int) -> Image:
    """Weights (h, w) that add up to 1 with those of the neighbouring tiles: none at the outer half of the margin."""
    sides = []
    for some, length in zip(tile.outer, size, strict=True):
        at = np.arange(some.start, some.stop)
        low = np.clip((at - some.start + 0.5 - margin / 2) / margin, 0, 1) if some.start > 0 else np.ones(len(at))
        high = np.clip((some.stop - at - 0.5 - margin / 2) / margin, 0, 1) if some.stop < length else np.ones(len(at))
        sides.append(np.minimum(low, high))
    return np.asarray(sides[0][:, None] * sides[1][None], np.float32)

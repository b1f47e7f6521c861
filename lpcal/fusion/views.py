r"""A view of an object: its maps in C, its camera pose, and their values along a direction.

Symbols: A the frame that views share (the room, or the body that the object rides on), H_AC the camera in it, r the ray of a pixel with
length 1 in z, z its depth, delta by how much the logarithm of the depth is off::

    x_A = H_AC (z exp(delta(pixel)) r)

delta is a scale of each piece, and a field over it that bends slowly: a tent at each knot of a grid. Pixels of directions come from a
polynomial that is fitted to the view's own rays, so that no lens model is needed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from lpcal.fusion.seams import ends_of_parts, inner_breaks, near, parted, stds
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Image, Index, Labels, Mask
from lpcal.records.placement import Placement
from lpcal.records.surface import Surface

DEGREE = 5
"""Degree of the polynomial from directions to pixels: leaves 0.01 px of a lens with a tenth of barrel distortion."""
FITTED_RAYS = 4000
"""Rays that it is fitted to, about: 100 for each of its terms are plenty."""
MARGIN_PX = 2
"""Pixels next to a break or the mask's edge that are not compared: normals there mix two surfaces."""
OUTSIDE_PX = 6
"""Pixels beside the mask from where on a view is taken to see the background: an outline is sure within some."""
KEPT_PX = OUTSIDE_PX + 2
"""Pixels beside the mask that a view keeps: beyond them all is background."""
CONE_SPARE_RAD = 0.01
"""By how much the cone about an image is wider than its corners' rays, radians: some pixels, for lenses whose rim bends."""
STEEP = 0.25
"""Least cosine between the normal and the line of sight of a pixel that is compared, 75 degrees: beyond it a pixel spans too much."""
UNSURE_DEG = 12.0
"""Normals whose standard deviation is larger are not compared: they are filled in from their neighbours, not measured."""


@dataclass(frozen=True)
class PlacedView:
    """One surface with its place. Maps are (H, W), NaN outside the mask, of the window of the image that holds the object."""

    name: str
    placement: Placement
    depth: Array
    plane: Array
    """(H, W, 2) x/z and y/z of each pixel's ray."""
    normals_C: Array
    albedo: Array
    """(H, W, 3), linear."""
    component: Labels
    witness: Mask
    """Pixels that can be compared with other views: measured, not too steep, away from edges."""
    whole: Mask
    """(H-1, W-1) squares of four pixels of one piece, without a break between them."""
    normal_std_rad: Array
    depth_std_m: Array
    pieces: tuple[tuple[int, float], ...]
    """Label and relative standard deviation of the distance of each piece."""
    to_pixels: PixelsOfRays
    """Pixels of the window by directions."""
    field: Array
    """(2, 2) x/z and y/z of the whole image's first pixel, and of its last."""
    image: tuple[int, int, int, int]
    """The whole image in pixels of the window: its first column and row, and those after its last."""

    @cached_property
    def pixel_rad(self) -> float:
        """Angle from a pixel to the next, in the middle of the object."""
        return float(np.median(np.diff(self.plane[..., 0], axis=1)))

    @cached_property
    def distance_m(self) -> float:
        """Median depth."""
        return float(np.median(self.depth[self.witness])) if self.witness.any() else float(np.nanmedian(self.depth))

    @cached_property
    def footprint_m(self) -> float:
        """Length of a pixel on a surface that faces the camera at the median depth."""
        return self.pixel_rad * self.distance_m

    @cached_property
    def cone(self) -> tuple[Array, float]:
        """Axis (3,) in C and half angle, radians, of a cone that holds all rays of the image: its corners' are the farthest apart."""
        (left, top), (right, bottom) = self.field
        rays = np.array([[left, top, 1], [right, top, 1], [left, bottom, 1], [right, bottom, 1]])
        rays /= np.linalg.norm(rays, axis=1, keepdims=True)
        axis = rays.mean(axis=0) / np.linalg.norm(rays.mean(axis=0))
        return axis, float(np.arccos(np.clip(rays @ axis, -1, 1)).max()) + CONE_SPARE_RAD

    @cached_property
    def far_outside(self) -> Mask:
        """Pixels well outside the object: the background."""
        from scipy.ndimage import binary_dilation

        return np.asarray(~binary_dilation(self.component > 0, iterations=OUTSIDE_PX))

    def without(self, gone: Mask) -> PlacedView:
        """The view with pixels (H, W) that are not compared and show no surface; its outline and the parameters of its bending stay."""
        touched = gone[:-1, :-1] | gone[:-1, 1:] | gone[1:, :-1] | gone[1:, 1:]
        return replace(self, witness=self.witness & ~gone, whole=self.whole & ~touched)

    @property
    def at(self) -> tuple[slice, slice]:
        """Its window of the whole image."""
        left, top = -self.image[0], -self.image[1]
        height, width = self.depth.shape
        return slice(top, top + height), slice(left, left + width)

    def points_C(self, row: Index, column: Index) -> Array:
        """Points (N, 3) at pixels, as the view has them."""
        z = self.depth[row, column].astype(float)
        return np.column_stack([self.plane[row, column] * z[:, None], z])


@dataclass(frozen=True)
class PixelsOfRays:
    """A polynomial from x/z and y/z to pixels."""

    middle: Array
    span: float
    terms: Array
    """(T, 2)."""

    def __call__(self, plane: Array) -> Array:
        """Pixels (N, 2) as x, y."""
        x, y = ((plane[:, k] - self.middle[k]) / self.span for k in range(2))
        return np.column_stack([_polynomial(x, y, self.terms[:, k]) for k in range(2)])


def fitted(plane: Array, origin: tuple[int, int] = (0, 0)) -> PixelsOfRays:
    """The polynomial that maps an image's rays (H, W, 2) to its pixels, counted from a pixel (column, row)."""
    step = max(int(np.sqrt(plane[..., 0].size / FITTED_RAYS)), 1)
    row, column = np.mgrid[0 : plane.shape[0] : step, 0 : plane.shape[1] : step]
    rays = plane[row, column].reshape(-1, 2).astype(float)
    middle, span = rays.mean(axis=0), float(np.ptp(rays[:, 0]) / 2)
    pixels = np.column_stack([column.ravel() - origin[0], row.ravel() - origin[1]]).astype(float)
    terms, *_ = np.linalg.lstsq(_powers((rays - middle) / span), pixels, rcond=None)
    return PixelsOfRays(middle, span, terms)


def _polynomial(x: Array, y: Array, terms: Array) -> Array:
    """Values (N,) of a polynomial whose terms are in the order of `_powers`, by Horner's rule."""
    found, end = np.zeros(len(x)), len(terms)
    for i in range(DEGREE, -1, -1):
        row = terms[end - (DEGREE + 1 - i) : end]
        end -= len(row)
        inner = np.full(len(x), row[-1])
        for term in row[-2::-1]:
            inner *= y
            inner += term
        found *= x
        found += inner
    return found


def _powers(x: Array) -> Array:
    """All products (N, T) of the two coordinates up to the degree."""
    first, second = (_up_to(x[:, k]) for k in range(2))
    return np.stack([first[i] * second[j] for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i)], axis=1)


def _up_to(x: Array) -> list[Array]:
    found = [np.ones_like(x)]
    for _ in range(DEGREE):
        found.append(found[-1] * x)
    return found


def may_see(view: PlacedView, H_AC: Array, x_A: Array) -> bool:
    """Whether any of some points (N, 3) may lie in a view's image: whether a ball about them meets the cone about its rays."""
    if not len(x_A):
        return False
    low, high = x_A.min(axis=0), x_A.max(axis=0)
    middle_C = se3.apply(se3.inv(H_AC), ((low + high) / 2)[None])[0]
    radius, away = float(np.linalg.norm(high - low)) / 2, float(np.linalg.norm(middle_C))
    if away <= radius:
        return True
    axis, half = view.cone
    return bool(np.arccos(np.clip(middle_C @ axis / away, -1, 1)) < half + np.arcsin(radius / away))


@dataclass(frozen=True)
class LookedUp:
    """What a view shows in N directions; all NaN or 0 where `ok` is false."""

    ok: Mask
    in_image: Mask
    pixel: Array
    """(N, 2) as x, y."""
    depth: Array
    normal_C: Array
    component: Labels


def look(view: PlacedView, x_C: Array) -> LookedUp:
    """What a view shows where points (N, 3) in its C lie: depth and normal between pixels, where the four around are one surface."""
    front = x_C[:, 2] > 1e-6
    plane = x_C[:, :2] / np.where(front, x_C[:, 2], 1.0)[:, None]
    near = front
    for k in range(2):
        near = near & (np.abs(plane[:, k] - view.to_pixels.middle[k]) < 1.6 * view.to_pixels.span)
    pixel = np.full((len(x_C), 2), -1.0)
    pixel[near] = view.to_pixels(plane[near])
    height, width = view.depth.shape
    left, top, right, bottom = view.image
    inside = near & _between(pixel, (left, top), (right - 1, bottom - 1))
    kept = inside & _between(pixel, (0, 0), (width - 1, height - 1))
    column, row = (np.where(kept, pixel[:, k], 0).astype(int) for k in range(2))
    ok = kept & view.whole[row, column]
    at = np.flatnonzero(ok)
    row, column = row[at], column[at]
    fx, fy = pixel[at, 0] - column, pixel[at, 1] - row
    depth, normal = np.full(len(x_C), np.nan), np.full((len(x_C), 3), np.nan)
    weights = ((1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy)
    corners = ((0, 0), (0, 1), (1, 0), (1, 1))
    depth[at] = sum(w * view.depth[row + i, column + j] for w, (i, j) in zip(weights, corners, strict=True))
    mixed = np.zeros((len(at), 3))
    for w, (i, j) in zip(weights, corners, strict=True):
        mixed += w[:, None] * view.normals_C[row + i, column + j]
    normal[at] = mixed / np.maximum(np.linalg.norm(mixed, axis=1, keepdims=True), 1e-12)
    component = np.zeros(len(x_C), view.component.dtype)
    component[at] = view.component[row, column]
    nearest_row, nearest_column = (np.clip(np.rint(pixel[at, 1 - k]).astype(int), 0, n - 1) for k, n in enumerate((height, width)))
    ok[at] = view.witness[nearest_row, nearest_column]
    return LookedUp(ok, inside, pixel, depth, normal, component)


def _between(pixel: Array, first: tuple[int, int], last: tuple[int, int]) -> Mask:
    """Which pixels (N, 2) lie in a window, its first column and row counted in, its last not."""
    x, y = pixel.T
    return np.asarray((x >= first[0]) & (y >= first[1]) & (x < last[0]) & (y < last[1]))


def view_of(surface: Surface, placement: Placement) -> PlacedView:
    """A placed surface as a view: what of it lies about the object, in single precision."""
    whole_mask = surface.mask & np.isfinite(surface.depth) & np.isfinite(surface.normals).all(axis=-1)
    rows, columns = _window(whole_mask)
    at = np.s_[rows, columns]
    mask, normals = whole_mask[at], surface.normals[at]
    rays = surface.rays_C[..., :2]
    component, of = parted(surface.component[at], surface.breaks[:, rows, columns], normals, surface.normal_std_deg[at])
    away, whole = _unbroken(mask, component, surface.breaks[:, rows, columns])
    std_deg = surface.normal_std_deg[at]
    height, width = surface.mask.shape
    single = np.float32
    return PlacedView(
        surface.name,
        placement,
        surface.depth[at].astype(single),
        rays[at].astype(float),
        normals.astype(single),
        _colours(surface, at),
        component,
        away & (_facing(mask, normals, rays[at]) > STEEP) & (std_deg < UNSURE_DEG),
        whole,
        np.radians(std_deg.astype(single)),
        surface.depth_std[at].astype(single),
        stds(tuple((piece.label, max(piece.scale_std, 1e-4)) for piece in surface.components), of),
        fitted(rays, (columns.start, rows.start)),
        np.stack([rays[0, 0], rays[-1, -1]]).astype(float),
        (-columns.start, -rows.start, width - columns.start, height - rows.start),
    )


def renewed(view: PlacedView, surface: Surface, grown: Array) -> PlacedView:
    """A view with the maps of a surface that was solved again at the distances by which its pieces grow: `grown` (H, W), of log depth.

    Its outline, its pieces and their priors stay; what has no depth any more is not compared and shows no surface.
    """
    at = view.at
    normals, std_deg = surface.normals[at], surface.normal_std_deg[at]
    mask = surface.mask[at] & np.isfinite(surface.depth[at]) & np.isfinite(normals).all(axis=-1)
    away, whole = _unbroken(mask, view.component, surface.breaks[:, *at])
    single = np.float32
    return replace(
        view,
        depth=(surface.depth[at] * np.exp(-grown)).astype(single),
        normals_C=normals.astype(single),
        albedo=_colours(surface, at),
        witness=away & (_facing(mask, normals, view.plane) > STEEP) & (std_deg < UNSURE_DEG),
        whole=whole,
        normal_std_rad=np.radians(std_deg.astype(single)),
        depth_std_m=surface.depth_std[at].astype(single),
    )


def _unbroken(mask: Mask, component: Labels, breaks: Mask) -> tuple[Mask, Mask]:
    """Pixels (H, W) away from breaks and edges, and squares (H-1, W-1) of four pixels of one piece without a break between them."""
    from scipy.ndimage import binary_erosion

    right, below = ends_of_parts(component, breaks)
    away = binary_erosion(mask, iterations=MARGIN_PX) & ~near(*inner_breaks(mask, np.stack([right, below])), MARGIN_PX)
    whole = mask[:-1, :-1] & mask[:-1, 1:] & mask[1:, :-1] & mask[1:, 1:]
    return away, whole & ~(right[:-1, :-1] | right[1:, :-1] | below[:-1, :-1] | below[:-1, 1:])


def _facing(mask: Mask, normals: Image, plane: Array) -> Array:
    """Cosine (H, W) between normals and lines of sight, 0 outside the mask."""
    sight = np.concatenate([plane, np.ones((*mask.shape, 1))], axis=-1)
    return np.asarray(-np.einsum("ijk,ijk->ij", np.where(mask[..., None], normals, 0.0), sight) / np.linalg.norm(sight, axis=-1))


def _colours(surface: Surface, at: tuple[slice, slice]) -> Array:
    """The albedo (H, W, 3) of a window."""
    albedo = surface.albedo[at] if surface.albedo.ndim == 3 else np.repeat(surface.albedo[at][..., None], 3, axis=2)
    return albedo.astype(np.float32)


def _window(mask: Mask) -> tuple[slice, slice]:
    """Rows and columns about a mask, KEPT_PX beside it; all where it is empty."""
    if not mask.any():
        return slice(0, mask.shape[0]), slice(0, mask.shape[1])
    ends = [(int(found[0]), int(found[-1])) for found in (np.flatnonzero(mask.any(axis=k)) for k in (1, 0))]
    first, second = (slice(max(low - KEPT_PX, 0), min(high + KEPT_PX + 1, n)) for (low, high), n in zip(ends, mask.shape, strict=True))
    return first, second

r"""A capture without an ambient image: the ambient light is estimated, subtracted, and its uncertainty propagated.

First that of the whole image (segmentation.room_light), so that the mask can be found; then the object's, at the working distance and again
at the depth of that first solve. A last solve with more ambient light shows how normals, depth and distance depend on it: the changes are
added to their standard deviations.

Symbols: signal ``I_k = B_k . b + A / h_k`` where light k (of intensity h_k, which signals are divided by) reaches a pixel, ``A / h_k``
where it does not; ``b = rho n``. On a matte surface, light from all over a room acts through its spherical harmonics of order 0 and 1::

    A = c_0 |b| + c . b            c_0 >= |c|, so that it is nowhere negative

So four coefficients give the ambient light on a whole object to some per cent (parts that the object shields from the room are darker).
Samples in shadow show it alone; near light separates it from the lamps' light, which changes from place to place. A plane behind the object
has one normal and so one ratio a of ambient light to albedo, which its fit gives within 2 %: a constraint on c_0 + c . n.
Source: Basri and Jacobs 2003, IEEE Trans. PAMI 25 (harmonics); Ramamoorthi and Hanrahan 2001, J. Opt. Soc. Am. A 18.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lpcal.geometry import cauchy_fit, lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.geometry.cauchy_fit import Equations
from lpcal.records.calibration import Calibration, Light
from lpcal.records.figures import AmbientFound
from lpcal.records.observations import Radiance
from lpcal.records.surface import Surface
from lpcal.segmentation import ambient_sample_costs, background, mask, planes, room_light
from lpcal.segmentation.room_light import FEW_PIXELS, SHARED, USUAL_STD, RoomLight
from lpcal.shading import normals
from lpcal.view import pixel_list
from lpcal.view.constants import FEWEST_PIXELS, MANY_PIXELS, OUTLIER, OUTLIER2, REGULARISATION
from lpcal.view.pixel_list import PixelList, SignalMaps, light_vectors, list_pixels

type Solve = Callable[[Radiance, Mask | None], Surface]
"""Solves images without ambient light for a surface, within a mask, or within an automatic one (None)."""
ROUNDS = 2
"""Solves: at the working distance, and at the depth that the first one gave."""
UNDECIDED = "no ambient image, and the images show no light beside that of the lamps: none is taken away"


def reconstruct(
    radiance: Radiance,
    calibration: Calibration,
    given: Mask | None,
    focus_C: Array | None,
    begin_m: float,
    solve: Solve,
    hints: mask.Hints = mask.NO_HINTS,
) -> Surface:
    """The surface of a capture whose images contain unknown ambient light.

    `given` is the user's mask; with `focus_C` lights count as distant, acting everywhere as they do there; `begin_m` is the first distance.
    """
    lights, near = pixel_list.lights_of(calibration, radiance), focus_C is None
    maps, rays_C = pixel_list.grey(radiance, lights), pixel_list.ray_map(radiance.signal.shape[1:3], calibration.camera)
    wall, light = None, None
    room_map = np.zeros(maps.signal.shape[1:], np.float32)
    object_mask = given
    if near:
        light = room_light.found(maps, rays_C, lights, begin_m)
        room_map = light.A
        found_by = mask.automatic(room_light.taken_away(maps, light), rays_C, lights, begin_m, hints)
        object_mask = found_by.mask if given is None else given
        wall = wall_of(maps, rays_C, lights, found_by, ~object_mask, light)
    elif object_mask is None:
        object_mask = mask.automatic(maps, rays_C, lights, None, hints).mask
    depth = np.full(int(object_mask.sum()), begin_m if calibration.camera is not None else 1.0)
    surface, room = None, None
    rounds = ROUNDS if near else 1
    for k in range(rounds):
        seen = pixel_list.list_pixels(maps, rays_C, object_mask, central=calibration.camera is not None)
        found = on_object(seen, lights, depth, wall, focus_C, light) if seen.pixels >= FEWEST_PIXELS else None
        if found is None:
            break
        room, room_map[object_mask] = found
        surface = solve(without(radiance, room_map, lights), given if k == rounds - 1 else object_mask)
        object_mask, depth = surface.mask, surface.depth[surface.mask].astype(float)
    del maps, seen  # the solves below hold their own
    if surface is None or room is None:
        plain = solve(radiance, given)
        return replace(plain, figures=replace(plain.figures, ambient=AmbientFound(estimated=False, note=UNDECIDED)))
    more = np.where(surface.mask, (1 + PATCHY) * room_map, room_map)
    return doubted(surface, solve(without(radiance, more, lights), surface.mask), room, float(_share(radiance, room_map, surface.mask)))


def without(radiance: Radiance, room_map: Image, lights: tuple[Light, ...]) -> Radiance:
    """The radiance minus ambient light (H, W); of colour images in proportion to the median signal of each channel."""
    if radiance.signal.ndim == 3:
        ambient = np.asarray(room_map, np.float32)
    else:
        middle = np.median(radiance.signal, axis=0)
        grey = np.median(pixel_list.grey(radiance, lights).signal, axis=0)
        ambient = np.asarray(room_map[..., None] * np.clip(middle / np.maximum(grey, 1e-12)[..., None], 0, 3), np.float32)
    return replace(radiance, signal=radiance.signal - ambient, ambient=ambient)


def doubted(surface: Surface, other: Surface, room: Room, share: float) -> Surface:
    """The surface with standard deviations enlarged by its sensitivity to ambient light.

    `other` is the surface with the share PATCHY more of ambient light: its changes, scaled to the standard deviation of that light,
    are added in quadrature. Each pixel's normal and depth have the common error and a local one, a piece's distance the common one.
    """
    both = surface.mask & other.mask
    doubt = float(np.hypot(room.std, PATCHY)) / PATCHY
    turned = np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(surface.normals - other.normals, axis=-1) / 2, 0, 1))) / np.sqrt(2)
    normal_std = np.where(both, np.hypot(surface.normal_std_deg, doubt * np.nan_to_num(turned)), surface.normal_std_deg)
    central = bool(surface.rays_C[..., :2].any())
    depth_std, components = surface.depth_std.copy(), []
    for piece in surface.components:
        inside = both & (surface.component == piece.label)
        if not inside.any():
            components.append(piece)
            continue
        change = np.log(other.depth[inside] / surface.depth[inside]) if central else other.depth[inside] - surface.depth[inside]
        whole = float(np.median(change))
        scale = surface.depth[inside] if central else 1.0
        depth_std[inside] = np.hypot(depth_std[inside], doubt * np.abs(change - whole) * scale)
        scale_std = float(np.hypot(piece.scale_std, whole * room.std / PATCHY)) if central else piece.scale_std
        components.append(replace(piece, scale_std=scale_std))
    law = tuple(room.c.round(4).tolist())
    ambient = AmbientFound(estimated=True, share_of_signal=round(share, 3), relative_std=round(room.std, 3), law=law)
    return replace(
        surface,
        normal_std_deg=np.asarray(normal_std, np.float32),
        depth_std=np.asarray(depth_std, np.float32),
        components=tuple(components),
        figures=replace(surface.figures, ambient=ambient),
    )


def _share(radiance: Radiance, room_map: Image, inside: Mask) -> float:
    """Median fraction of the signal that is ambient light."""
    signal = radiance.signal if radiance.signal.ndim == 3 else radiance.signal.mean(axis=-1)
    return float(np.median(room_map[inside] / np.maximum(signal.mean(axis=0)[inside], 1e-12)))


LEVELS = np.array([0, 0.01, 0.03, 0.06, 0.1, 0.14, 0.18, 0.23, 0.3, 0.4, 0.55, 0.75, 1.0])
"""Initial values of c_0, in units of the signal of a pixel that faces one of the lights."""
TILT = 0.35
"""Prior standard deviation of each component of c / c_0."""
NEEDED_GAIN = 0.05
"""Relative fall of the misfit from which ambient light counts as detected."""
STEPS = 100
"""Largest number of evaluations of the simplex search."""
LAW_ROUNDS = 10
"""Reweighted solves for the coefficients, after which they no longer change."""
LAW_STD, BLIND_STD = 0.06, 0.25
"""Relative standard deviations of A over an object: of the model besides that of its level; of both where lights are distant."""
PATCHY = 0.12
"""Relative standard deviation of A about the model, between parts of an object."""
WALL_STEPS = 25
"""Largest number of iterations of the fit of the wall."""


@dataclass(frozen=True)
class Wall:
    """The plane behind the object and the ambient light on it."""

    q: Array
    """(3,) plane parameters (segmentation.planes)."""
    ratio: float
    """a: ambient light on it over its albedo."""
    std: float
    """Relative standard deviation of the ratio."""
    n_C: Array


@dataclass(frozen=True)
class Room:
    """The ambient light on an object."""

    c: Array
    """(4,) c_0 and c."""
    std: float
    """Relative standard deviation of the object's mean A."""


def wall_of(maps: SignalMaps, rays_C: Array, lights: Sequence[Light], found: mask.Found, outside: Mask, light: RoomLight) -> Wall | None:
    """The largest plane behind the object, fitted together with its ambient light.

    None where the fit is less certain than the prior. `outside` (H, W) is the mask of pixels outside the object, `light` the ambient light
    estimated from the whole image.
    """
    if not found.planes or found.layer is None:
        return None
    coarse, coarse_rays, f = mask.binned(maps, rays_C)
    rows, columns = coarse.signal.shape[1:]
    own = (outside & (found.layer == background.Layer.WALL))[: rows * f, : columns * f].reshape(rows, f, columns, f).all(axis=(1, 3))
    if own.sum() < FEWEST_PIXELS:
        return None
    some = planes.thinned(list_pixels(coarse, coarse_rays, own, central=True))
    h = intensities(lights)

    def cost(x: Array) -> Array:
        r, _ = planes.residuals(some, planes.predicted(x[:3], some.rays_C, lights) + x[3] / h, shaded=False)
        return np.nan_to_num(r, posinf=1e2).ravel()

    first = np.append(found.planes[0].q, light.room.level)
    x = cauchy_fit.fitted(lambda x: Equations.differenced(cost, x), first, np.abs(first).clip(np.abs(first[:3]).max()), WALL_STEPS)
    m = planes.predicted(x[:3], some.rays_C, lights) + x[3] / h
    if x[3] <= 0 or np.sqrt(np.median(planes.misfit(some, m, shaded=False)[0])) > OUTLIER:
        return None
    alike = max(some.pixels * SHARED / (float(own.mean()) * FEW_PIXELS), 1.0)
    variance = alike * np.linalg.pinv(Equations.differenced(cost, x).curvature)[3, 3]
    std = float(np.sqrt(variance) / x[3])
    return Wall(x[:3], float(x[3]), std, -x[:3] / np.linalg.norm(x[:3])) if std < USUAL_STD else None


def on_object(
    seen: PixelList, lights: Sequence[Light], depth: Array, wall: Wall | None, focus_C: Array | None, light: RoomLight | None = None
) -> tuple[Room, Array] | None:
    """The ambient light on an object at depths (P,), and A (P,) of its pixels; None where none is detected.

    `light` is that of the whole image, where lights are near.
    """
    if light is not None:
        return _near(seen, lights, depth, wall, light)
    h = intensities(lights)
    few = np.unique(np.linspace(0, seen.pixels - 1, min(MANY_PIXELS, seen.pixels)).astype(int))
    some = seen.at(few)
    d, E = light_vectors(lights, some.points_C(depth[few]), focus_C)
    c = _fit(_Trial(some, d * E[..., None], E, h))
    if c is None:
        return None
    d, E = light_vectors(lights, seen.points_C(depth), focus_C)
    whole = _Trial(seen, d * E[..., None], E, h)
    A = whole.room(c, whole.settled(c, rounds=5)[0])
    return Room(c, BLIND_STD), A


def _near(seen: PixelList, lights: Sequence[Light], depth: Array, wall: Wall | None, light: RoomLight) -> tuple[Room, Array]:
    """The model of ambient light fitted to the pixels' own A, and A (P,) by it.

    Each pixel's A is a posterior mean under the prior level of the whole image; dividing its deviation from the prior by the samples'
    information recovers what the samples alone say. The coefficients are fitted to these values under the prior of the whole image. Errors
    are correlated over parts of the image, so the standard deviation counts parts, not pixels.
    """
    d, E = light_vectors(lights, seen.points_C(depth))
    found = ambient_sample_costs.free(seen.signal, seen.sigma, seen.usable, d * E[..., None], np.zeros(E.shape), light.room)
    b, length = found.b, np.maximum(lambert.length(found.b), 1e-20)
    known = np.maximum(found.information, REGULARISATION)
    rows, ratio = np.c_[np.ones(seen.pixels), b / length[:, None]], 1 + (found.A / length / light.room.level - 1) / known
    own2 = ambient_sample_costs.SPREAD**2 * (1 - known) / known
    prior = np.diag([light.level_std**-2, *3 * [TILT**-2]])
    right = np.array([light.level_std**-2, 0, 0, 0])
    if wall is not None:
        by_wall, weight = np.append(1.0, wall.n_C), (light.room.level / wall.ratio) ** 2 / (wall.std**2 + LAW_STD**2)
        prior, right = prior + weight * np.outer(by_wall, by_wall), right + weight * by_wall * wall.ratio / light.room.level
    law = np.array([1.0, 0, 0, 0])
    for _ in range(LAW_ROUNDS):
        weighted = rows / (PATCHY**2 + np.maximum(own2, (ratio - rows @ law) ** 2))[:, None] / SHARED
        law = np.linalg.solve(weighted.T @ rows + prior, weighted.T @ ratio + right)
    c, mean = light.room.level * law, (length @ rows) / length.sum()
    by_parts = weighted.T @ rows * FEW_PIXELS / seen.mask.size
    of_law = float(np.sqrt(mean @ np.linalg.solve(by_parts + prior, mean))) / max(float(mean @ law), REGULARISATION)
    A = np.clip(c[0] * length + b @ c[1:], 0.0, ambient_sample_costs.lowest(seen.signal, seen.usable, light.room))
    interreflected = ambient_sample_costs.DEEP * float(np.median(seen.signal.mean(axis=0))) / max(float(np.median(A)), 1e-20)
    return Room(c, float(np.hypot(np.hypot(LAW_STD, of_law), interreflected))), A


def intensities(lights: Sequence[Light]) -> Array:
    """Intensities h (L, 1)."""
    return np.array([light.intensity.mean() for light in lights])[:, None]


@dataclass(frozen=True)
class _Trial:
    """Pixels, their light vectors (L, P, 3), irradiance (L, P) and intensities (L, 1), on which coefficients are evaluated."""

    seen: PixelList
    B: Array
    E: Array
    h: Array

    def begin(self) -> Array:
        """Initial b (P, 3), half of the smallest sample being ambient light; facing the camera where that has no solution."""
        dim = replace(self.seen, signal=self.seen.signal - (self.seen.signal * self.h).min(axis=0) / 2 / self.h)
        b = normals.estimate(dim, self.B, normals.candidates(dim, self.E), normals.variances(self.seen)).b
        facing = -self.seen.rays_C * (np.median(self.seen.signal, axis=0) / np.median(self.E, axis=0))[:, None]
        return np.where(np.isfinite(b), b, facing)

    def room(self, c: Array, b: Array) -> Array:
        """A (P,) of coefficients c (4,) and b (P, 3)."""
        return np.asarray(np.maximum(c[0] * lambert.length(b) + b @ c[1:], 0.0))

    def settled(self, c: Array, b: Array | None = None, rounds: int = 3) -> tuple[Array, Mask]:
        """b (P, 3) given c, in rounds from b or from the initial one, and the mask (P,) of pixels with a solution."""
        variance = normals.variances(self.seen)
        b = self.begin() if b is None else b
        known = np.zeros(len(b), bool)
        for _ in range(rounds):
            lamps = replace(self.seen, signal=self.seen.signal - self.room(c, b) / self.h)
            found = normals.estimate(lamps, self.B, normals.candidates(lamps, self.E), variance).b
            known = np.isfinite(found[:, 0])
            b = np.where(known[:, None], found, b)
        return b, known

    def misfit(self, c: Array, b: Array) -> float:
        """Sum over the samples of the squared residuals, as lit or as in shadow, whichever is smaller, bounded for outliers."""
        b, known = self.settled(c, b)
        variance = normals.variances(self.seen)
        lamps = self.seen.signal - self.room(c, b) / self.h
        square = np.minimum((lamps - lambert.predicted(self.B, b)) ** 2, lamps**2) / variance
        return float(np.sum(np.where(self.seen.usable, np.where(known, np.minimum(square, OUTLIER2), OUTLIER2), 0.0)))


def _fit(trial: _Trial) -> Array | None:
    """c (4,) of the smallest misfit; None where the images are explained as well without ambient light."""
    from scipy import optimize

    begin = trial.begin()
    unit = float(np.median(np.median(trial.seen.signal, axis=0) / lambert.length(begin)))
    tried = [trial.misfit(np.array([one, 0, 0, 0]), begin) for one in unit * LEVELS]
    first = max(float(unit * LEVELS[int(np.argmin(tried))]), 0.01 * unit)

    def total(x: Array) -> float:
        c = x[0] * np.array([1.0, *x[1:]])
        if x[0] < 0 or np.linalg.norm(x[1:]) > 1:
            return float("inf")
        return float(trial.misfit(c, begin) / SHARED + np.sum((x[1:] / TILT) ** 2))

    simplex = first * np.array([[1.0], [1.25], [1.0], [1.0], [1.0]]) * [1, 0, 0, 0] + 0.3 * np.eye(5, 4, k=-1) * [0, 1, 1, 1]
    options: Any = {"initial_simplex": simplex, "xatol": 0.01, "fatol": 0.1, "maxfev": STEPS}
    x = optimize.minimize(total, simplex[0], method="Nelder-Mead", options=options).x
    c = np.asarray(x[0] * np.array([1.0, *x[1:]]))
    return c if trial.misfit(c, begin) < (1 - NEEDED_GAIN) * tried[0] else None

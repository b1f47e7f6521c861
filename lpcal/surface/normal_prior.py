"""Learned prior of normals: a network (view.network) predicts a correction of each normal and its standard deviation from local channels.

The rounds (surface.rounds) do not determine normals where only one or two lights reach, and may err where most light is interreflected.
There shape, shading and outline of the surroundings carry more information than a smoothness prior. Vectors are expressed in a frame about
each pixel's ray: turned by the shortest rotation that takes the direction to the viewer to (0, 0, -1). All channels are invariant to the
scales of length and brightness.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import pieces
from lpcal.integration.integrate import normals_of, settle, steps
from lpcal.integration.pieces import BREAK_WEIGHT
from lpcal.shading import field, normals
from lpcal.shading.normals import Estimate
from lpcal.view import parallel
from lpcal.view.constants import MANY_PIXELS
from lpcal.view.network import Network
from lpcal.view.pixel_list import Illumination, PixelList

if TYPE_CHECKING:
    from lpcal.surface.rounds import Scene, State

FITTED = Path(__file__).with_name("normal_network.npz")
"""File of the network's weights, written by tools/fit_normal_prior.py."""
LOG_SIGMA = (-5.0, 0.5)
"""Bounds of the natural logarithm of a standard deviation in radians: a third of a degree, and any direction."""
VECTORS = ("normal", "own normal", "depth normal", "lit from", "dark from", "thrown from", "bright from")
"""Channels with components x, y and z."""
DARKEST, BRIGHTEST = 1e-3, 20.0
"""Bounds of the ambient image relative to its median, and of a sample's shading relative to the albedo, which limit outliers."""
MOST_SHARE = 3.0
"""Upper bound of interreflected light, or gloss, relative to direct light."""
FEW = 6.0
"""Number of samples above which the channel of their number saturates."""
WAVES = {"shading": (2, 3), "left": (1, 2)}
"""Orders of the azimuthal harmonics about a pixel's ray, in the samples' shading and in its residual, that are channels."""
MIRRORED = (*(f"{name} x" for name in VECTORS), "open xy", "open xz", *(f"{name} sin {m}" for name, some in WAVES.items() for m in some))
"""Channels that change their sign under reflection."""


def factor_of(pixels: int) -> int:
    """Side of the blocks of pixels on which the network works, pixels."""
    return max(1, round(np.sqrt(pixels / MANY_PIXELS)))


def about_rays(rays_C: Array, x: Array, *, back: bool = False) -> Array:
    """Vectors x (..., P, 3) from the camera's frame to that of each pixel's ray (P, 3), or back."""
    half = -lambert.unit(rays_C)[0] + np.array([0.0, 0.0, -1.0])
    turned, flip = lambert.unit(half)[0], np.array([-1.0, -1.0, 1.0])  # two half turns make a turn of twice the angle between their axes

    def about(y: Array) -> Array:
        return np.asarray(2 * lambert.dot(y, turned)[..., None] * turned - y)

    return about(x * flip) if back else about(x) * flip


def expected(scene: Scene, state: State) -> tuple[Array, Array]:
    """Corrected normals (P, 3) of a settled state, and their standard deviation (P,), radians.

    A predicted turn t of standard deviation s is shrunk by the Wiener factor ``t^2 / (t^2 + s^2)``.
    """
    scene = scene.closely()
    seen, side = scene.seen, factor_of(scene.seen.pixels)
    found = features(scene, state)
    begin = unit(np.stack([found[f"normal {axis}"] for axis in "xyz"]))
    n, log_sigma = answer(Network.read(FITTED), found, begin)
    square = np.sum((n - begin) ** 2, axis=0)
    turn = square / (square + np.exp(2 * log_sigma)) * (n - begin)
    said = between(np.concatenate([turn, log_sigma[None]]), found["share"] > 0, seen.mask, side)
    there = lambert.unit(about_rays(seen.rays_C, state.normals) + said[:, :3])[0]
    return lambert.unit(about_rays(seen.rays_C, there, back=True))[0], np.exp(said[:, 3])


def answer(network: Network, channels: dict[str, Array], begin: Array) -> tuple[Array, Array]:
    """The network's normals (3, rows, columns), and the logarithm of their standard deviation (rows, columns), radians.

    Mean of its outputs for the maps and for their mirror image.
    """
    found = []
    for said, mirror in zip(network.answers(channels, channels["share"] > 0), (1, -1), strict=True):
        n = unit(begin + said[:3] * np.array([mirror, 1, 1])[:, None, None])
        found.append(np.concatenate([n, np.clip(said[3:], *LOG_SIGMA)]))
    mean = np.mean(found, axis=0)
    return unit(mean[:3]), mean[3]


def turned(scene: Scene, state: State) -> tuple[State, Array | None]:
    """A settled state with corrected normals and the depth integrated from them, and the standard deviation of the normals (P,), radians.

    Each piece keeps its median depth. The network was fitted to objects only, so the correction is multiplied by the probability that the
    pixels show one; where that is 0, or lights are distant, the state is returned unchanged with None.
    """
    if not scene.near or scene.of_object <= 0:
        return state, None
    n, sigma_rad = expected(scene, state)
    n = lambert.unit(state.normals + scene.of_object * (n - state.normals))[0]
    grid, seen = scene.grid, scene.seen
    step = steps(grid, n, seen.rays_C, central=seen.central, tilt_rad=sigma_rad)
    before = steps(grid, state.normals, seen.rays_C, central=seen.central, tilt_rad=state.field.tilt_rad)
    step = replace(
        step, sigma=np.maximum(step.sigma, before.sigma)
    )  # a step that steep normals left open is no surer for being turned: it may bridge a gap
    u = settle(grid, step, state.own, state.u, state.weight)
    label = pieces.pieces(grid, state.weight, seen.mask)
    for one in np.unique(label):
        inside = label == one
        u[inside] += np.median(state.u[inside]) - np.median(u[inside])
    b = lambert.length(state.field.b)[:, None] * n
    return replace(state, u=u, normals=n, field=replace(state.field, b=b)), sigma_rad


def between(picture: Array, inside: Mask, mask: Mask, side: int) -> Array:
    """Values (P, C) at the pixels of a mask (H, W), interpolated linearly between those (C, rows, columns) of its blocks."""
    rows, columns = np.nonzero(mask)
    row, column = ((at - (side - 1) / 2) / side for at in (rows, columns))
    total, weight = np.zeros((len(rows), len(picture))), np.zeros(len(rows))
    for i in (0, 1):
        for j in (0, 1):
            r, c = (
                np.clip(np.floor(at).astype(int) + k, 0, most - 1)
                for at, k, most in ((row, i, inside.shape[0]), (column, j, inside.shape[1]))
            )
            share = np.maximum(1 - np.abs(row - r), 0) * np.maximum(1 - np.abs(column - c), 0) * inside[r, c] + 1e-9 * inside[r, c]
            total += share[:, None] * picture[:, r, c].T
            weight += share
    return total / np.maximum(weight, 1e-30)[:, None]


def unit(x: Array) -> Array:
    """Vectors (3, rows, columns) of length 1."""
    return np.asarray(x / np.maximum(np.linalg.norm(x, axis=0), 1e-6))


def normals_of_depth(scene: Scene, state: State) -> Array:
    """Normals (P, 3) of a state's depth; the state's own at depth discontinuities."""
    depth = np.exp(state.u) if scene.seen.central else state.u
    n = normals_of(scene.grid, scene.seen.shape_C(depth), state.weight > BREAK_WEIGHT)
    return np.where(np.isfinite(n), n, state.normals)


@dataclass(frozen=True)
class _Whole:
    """Quantities that the channels need from all pixels together."""

    of_depth: Array
    """(P, 3) normals of the depth."""
    breaks: Array
    """(P,) fraction of a pixel's four edges that are depth discontinuities or lie on the outline."""
    level: Array
    """(P,) logarithm of the albedo."""
    room: Array | None
    """(P,) logarithm of the ambient image; None without one."""
    middle: dict[str, float]
    """Medians of the quantities that have a scale, by which they are divided."""

    @staticmethod
    def of(scene: Scene, state: State) -> _Whole:
        """From a state of the rounds."""
        level = np.log(np.maximum(lambert.length(state.field.b), 1e-12))
        middle, room = {"level": float(np.median(level)), "u": float(np.median(state.u))}, None
        if scene.room is not None:
            room = np.log(np.maximum(scene.room, DARKEST * float(np.median(scene.room)) + 1e-12))
            middle |= {"room": float(np.median(room)), "room over albedo": float(np.median(room - level))}
        return _Whole(normals_of_depth(scene, state), _breaks(scene, state), level, room, middle)


def features(scene: Scene, state: State) -> dict[str, Array]:
    """The channels as maps (rows, columns) of blocks of pixels, for a state of the rounds and a scene cropped to its object.

    Those of `channels`, the fraction of each block that is the object, and its distance from the outline.
    """
    seen, side, whole = scene.seen, factor_of(scene.seen.pixels), _Whole.of(scene, state)
    shape = tuple(-(-length // side) for length in seen.mask.shape)
    row, column = np.nonzero(seen.mask)
    block = row // side * shape[1] + column // side
    count = np.bincount(block, minlength=shape[0] * shape[1])

    def summed(at: slice) -> tuple[int, dict[str, Array]]:
        own = block[at]
        first = int(own.min())
        own = own - first
        return first, {name: np.bincount(own, one) for name, one in channels(scene, state, whole, at).items()}

    parts = parallel.run_bands(seen.pixels, len(seen.signal), summed)
    total = {name: np.zeros(len(count)) for name in parts[0][1]}
    for first, part in parts:
        for name, one in part.items():
            total[name][first : first + len(one)] += one
    means = {name: (one / np.maximum(count, 1)).reshape(shape) for name, one in total.items()}
    away = raster.distance_to(np.pad(~seen.mask, 1, constant_values=True))[1:-1, 1:-1]
    more = maps({"edge": np.log1p(away[seen.mask] / side)}, seen.mask, side)
    return means | more


def channels(scene: Scene, state: State, whole: _Whole, at: slice) -> dict[str, Array]:
    """The channels (Q,) of some of the pixels."""
    seen, lit, found, n, of_depth = scene.seen.at(at), state.lit.at(at), state.found.at(at), state.normals[at], whole.of_depth[at]
    b, level = state.field.b[at], whole.level[at]
    shading = np.where(seen.usable, seen.signal / np.maximum(lit.E, 1e-300), 0.0)
    lights, nothing, albedo = len(shading), np.zeros(len(level)), np.exp(level)
    top = np.sort(shading, axis=0)[::-1]
    out = _vectors(seen, lit, found, n, of_depth, shading) | _open(seen, lit, found, b) | _round_the_ray(seen, lit, found, b)
    out |= {name: np.minimum(top[k] / albedo, BRIGHTEST) for k, name in enumerate(("brightest", "second", "third"))}
    room = whole.room[at] if whole.room is not None else None
    return out | {
        "albedo": level - whole.middle["level"],
        "mean": np.log(np.maximum(shading.mean(axis=0), 1e-12)) - whole.middle["level"],
        "tilt": nothing if state.field.tilt_rad is None else state.field.tilt_rad[at],
        "used": found.used / lights,
        "used of few": np.minimum(found.used, FEW) / FEW,
        "lights": np.full(len(level), 1 / lights),
        "known": np.isfinite(found.b[:, 0]).astype(float),
        "misfit": np.log1p(np.nan_to_num(found.chi2) / np.maximum(found.used - 2, 1)),
        "cost": np.log1p(np.nan_to_num(found.cost) / lights),
        "thrown": np.minimum(np.nan_to_num(normals.interreflected_share(lit, found)), MOST_SHARE),
        "gloss": np.minimum(np.nan_to_num(normals.gloss_share(lit, found)), MOST_SHARE),
        "unseen": nothing if lit.unseen is None else lit.unseen,
        "bend": lambert.length(n - of_depth),
        "own distance": np.clip((state.own.optimum[at] - state.u[at]) * 10, -3, 3),
        "depth": state.u[at] - whole.middle["u"],
        "room": nothing if room is None else room - whole.middle["room"],
        "room over albedo": nothing if room is None else room - level - whole.middle["room over albedo"],
        "has room": np.full(len(level), float(room is not None)),
        "around": np.full(len(level), float(scene.around is not None)),
        "breaks": whole.breaks[at],
    }


def _vectors(seen: PixelList, lit: Illumination, found: Estimate, n: Array, of_depth: Array, shading: Array) -> dict[str, Array]:
    """Vector channels in the frames of the rays: normals, directions of lights, shadows, interreflection and brightest samples."""
    agreed, known, bright = found.inliers.astype(float), np.isfinite(found.b[:, :1]), np.maximum(shading, 0.0)
    interreflected = np.zeros_like(n) if lit.interreflected is None else lit.interreflected.sum(axis=0) / lit.E.sum(axis=0)[:, None]
    vectors = {
        "normal": n,
        "own normal": lambert.unit(np.where(known, found.b, 0.0))[0] * known,
        "depth normal": of_depth,
        "lit from": np.einsum("kp,kpi->pi", agreed, lit.d) / len(agreed),
        "dark from": np.einsum("kp,kpi->pi", 1 - agreed, lit.d) / len(agreed),
        "thrown from": interreflected,
        "bright from": np.einsum("kp,kpi->pi", bright, lit.d) / np.maximum(bright.sum(axis=0), 1e-300)[:, None],
    }
    turned = about_rays(seen.rays_C, np.stack([vectors[name] for name in VECTORS]))
    return {f"{name} {axis}": value[:, k] for name, value in zip(VECTORS, turned, strict=True) for k, axis in enumerate("xyz")}


def _open(seen: PixelList, lit: Illumination, found: Estimate, b: Array) -> dict[str, Array]:
    """Covariance of the normals given the inlying samples, relative to the prior covariance, in the frames of the rays."""
    variance = seen.sigma**2 + (field.SHARED * seen.signal) ** 2 + (field.SHARED * seen.signal.max(axis=0)) ** 2
    weight = found.inliers / variance * (lambert.dot(b, b) * field.ANY_RAD**2)
    covariance = lambert.inverse_3x3(lambert.normal_matrix(lit.B, weight) + np.eye(3), singular=0.0)
    turned = about_rays(seen.rays_C, about_rays(seen.rays_C, covariance.transpose(1, 0, 2)).transpose(2, 1, 0))  # (3, Q, 3)
    return {f"open {'xyz'[i]}{'xyz'[j]}": turned[i, :, j] for i in range(3) for j in range(i, 3)}


def _round_the_ray(seen: PixelList, lit: Illumination, found: Estimate, b: Array) -> dict[str, Array]:
    """Azimuthal harmonics of the samples' shading about each ray, and of its residual, relative to the pixel's albedo."""
    scale = np.maximum(lit.E * lambert.length(b), 1e-300)
    left = seen.signal - np.maximum(lambert.dot(lit.direct, b), 0.0)
    if lit.interreflected is not None:
        left = left - np.maximum(lambert.dot(lit.interreflected, b), 0.0)
    if found.gloss is not None:
        left = left - found.gloss
    values = {name: np.where(seen.usable, np.clip(of / scale, -2, 2), 0.0) for name, of in (("shading", seen.signal), ("left", left))}
    d = about_rays(seen.rays_C, lit.d)
    once = d[..., 1] + 1j * d[..., 0]
    once /= np.maximum(np.abs(once), 1e-300)
    out = {"left": values["left"].mean(axis=0), "left spread": values["left"].std(axis=0)}
    for name, some in WAVES.items():
        for m in some:
            mean = (values[name] * once**m).mean(axis=0)
            out |= {f"{name} sin {m}": mean.imag, f"{name} cos {m}": mean.real}
    return out


def _breaks(scene: Scene, state: State) -> Array:
    """Fraction (P,) of a pixel's four edges that are depth discontinuities or lie on the outline."""
    grid, whole = scene.grid, state.weight > BREAK_WEIGHT
    holds = np.bincount(grid.a[whole], minlength=scene.seen.pixels) + np.bincount(grid.b[whole], minlength=scene.seen.pixels)
    return np.asarray(1 - holds / 4)


def maps(found: dict[str, Array], mask: Mask, side: int) -> dict[str, Array]:
    """Block means of values (P,) as maps (rows, columns), 0 in blocks without pixels, and the fraction of each block inside the mask."""
    rows, columns = (-length % side for length in mask.shape)

    def joined(values: Array) -> Array:
        picture = np.zeros(mask.shape)
        picture[mask] = values
        return raster.block_means(np.pad(picture, ((0, rows), (0, columns))), side)

    share = joined(np.ones(int(mask.sum())))
    return {name: joined(values) / np.maximum(share, 1e-9) for name, values in found.items()} | {"share": share}

r"""Detection of a normal map's green-channel convention (y up or y down) from the integrability (curl) of its slopes.

Symbols: u(column, row) the depth, in pixels or (with a camera) its logarithm; slopes ``p = du/dcolumn, q = du/drow`` follow from the
normals. On a surface ``a = dp/drow`` and ``b = dq/dcolumn`` are the same mixed derivative, the twist. With the vertical component flipped,
b changes its sign. So the correlation ``s = sum(a b) / sqrt(sum(a a') sum(b b'))`` is 1 for the right convention and -1 for the wrong one,
independent of noise: a' is a of the next column and b' is b of the next row, whose noise is independent. Large values are clipped, so that
depth discontinuities do not decide. Where noise hides the twist of neighbours, means over blocks of pixels are used. The curl does not
distinguish hollow from bump: with both components flipped the map is integrable, too. The outline does: near an occluding contour normals
point outwards.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Camera
from lpcal.records.figures import Curl
from lpcal.view.constants import CERTAIN, FEWEST_PIXELS, LEAST_COSINE, OUTLIER_RATE, RIM_PX
from lpcal.view.pixel_list import ray_map

CLEAR = 0.3
"""Absolute correlation from which the convention counts as decided."""
WILD = 0.5
"""Median curl, as a change of slope per pixel, above which a map is not that of a surface: noise of 10 degrees gives half of it."""
BLOCKS = (1, 4, 12)
"""Block sides, pixels, tried in turn until one decides: noise decreases with the block, twist does not."""


@dataclass(frozen=True)
class Convention:
    """Normals (H, W, 3) in C, whether green was turned over for it, how the map reads both ways, and notes."""

    normals_C: Image
    flipped: bool
    as_is: Curl
    turned: Curl
    note: str | None = None


def settled(name: str, normals_C: Image, mask: Mask, camera: Camera | None, stated: str = "auto") -> Convention:
    """Normals (H, W, 3) read in C turned over vertically where their curl says so; `stated`: auto, as-is or flipped.

    Raises
    ------
    DisagreementError
        The channels are in another order.
    DegenerateError
        The map is of no surface, whichever way it is read.
    """
    rays_C = ray_map(mask.shape, camera)
    turned = normals_C * np.array([1, -1, 1], np.float32)
    if stated == "auto":
        _refuse_swapped(name, normals_C, mask, rays_C)
    as_is, flipped = (curl(one, mask, rays_C) for one in (normals_C, turned))
    if stated != "auto":
        chosen = stated == "flipped"
        return Convention(turned if chosen else normals_C, chosen, as_is, flipped)
    good, better = _tells(as_is), _tells(flipped)
    if better and (not good or flipped.likeness > as_is.likeness + CLEAR):
        likeness = f"likeness of its slopes {as_is.likeness:.2f} as it is, {flipped.likeness:.2f} turned over"
        return Convention(turned, True, as_is, flipped, f"green points down in this map ({likeness}): it was turned over")
    if good:
        return Convention(normals_C, False, as_is, flipped)
    if min(as_is.twist_sure, flipped.twist_sure) > CERTAIN or min(as_is.median, flipped.median) > WILD:
        raise DegenerateError(
            f"the normals are of no surface: their slopes' changes agree by {as_is.likeness:.2f} as they are, {flipped.likeness:.2f} with"
            " green turned over (1: a surface)",
            where=name,
            needed="a normal map that integrates: x in red, y in green, z in blue",
            todo="export it again, or state --green as-is or --green flipped",
        )
    note = "the normals do not show whether green points up or down (too little twist): taken as they are; --green states it"
    return Convention(normals_C, False, as_is, flipped, note)


def mirrored(normals_C: Image, mask: Mask, rays_C: Array) -> bool:
    """Whether normals (H, W, 3) along rays (H, W, 3) are clearly those of a surface with one axis turned over, and not as they are."""
    if not mask.any():
        return False
    box = tuple(slice(max(at.min() - 1, 0), at.max() + 2) for at in np.nonzero(mask))  # with the neighbours that rays' steps ask for
    normals_C, mask, rays_C = normals_C[box], mask[box], rays_C[box]
    if (as_is := curl(normals_C, mask, rays_C)).likeness >= -CLEAR or _tells(as_is):
        return False
    return _tells(curl(normals_C * np.array([1, -1, 1], np.float32), mask, rays_C))


def hollow(normals_C: Image, mask: Mask) -> bool:
    """Whether normals (H, W, 3) look inwards all along the outline of a mask (H, W), as those of no thing that is seen whole do.

    Of 100 things drawn or scanned, tables under them or not, the normals' outward component is -0.15 on average at least; it is 0.68 at
    the median.
    """
    along = _along_outline(normals_C, mask)
    return along is not None and float(np.trace(along)) < -CLEAR


def exchanged(normals_C: Image, mask: Mask, rays_C: Array) -> str | None:
    """What was done to x and y of normals (H, W, 3), in words, where they look outwards along the outline only with it undone.

    The curl alone does not say it: a ball whose x and y are exchanged has the normals of a saddle. Of 140 drawn things as they are
    none is named, with x and y exchanged 88 %.
    """
    along = _along_outline(normals_C, mask)
    if along is None:
        return None
    swap, quarter = np.eye(2)[::-1], np.array([[0, -1], [1, 0]])
    ways = [(swap, "exchanged"), (-swap, "exchanged"), (quarter, "turned by 90 degrees"), (-quarter, "turned by 90 degrees")]
    gains = [float(np.sum(turn * along)) for turn, _ in ways]
    turn, words = ways[int(np.argmax(gains))]
    if max(gains) < CLEAR or max(gains) < float(np.trace(along)) + CLEAR:
        return None
    undone = normals_C.copy()
    undone[..., :2] = normals_C[..., :2] @ turn.T.astype(normals_C.dtype)
    return f"x and y are {words}" if curl(undone, mask, rays_C).likeness > -CLEAR else None


def _along_outline(normals_C: Image, mask: Mask) -> Array | None:
    """Mean product (2, 2) of the direction outwards and the normal, x and y each, along the outline of a mask; None where it is short.

    Pixels next to the outline, and at the image's edge, are not asked.
    """
    if not mask.any():
        return None
    box = tuple(slice(max(at.min() - 1, 0), at.max() + 2) for at in np.nonzero(mask))
    inside, n = mask[box] & np.isfinite(normals_C[box][..., 0]), np.nan_to_num(normals_C[box].astype(float))
    layers = [inside]
    for k in range(4 * RIM_PX):
        layers.append(_shrunk(layers[-1], corners=k % 2 == 1))
    depth = np.sum(layers, axis=0, dtype=float)
    down, along = np.gradient(sum(np.roll(depth, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)))
    rim = layers[RIM_PX] & ~layers[3 * RIM_PX]
    steep = np.hypot(along, down)
    rim &= steep > 0
    if rim.sum() < FEWEST_PIXELS:
        return None
    outwards = -np.stack([along, down], axis=-1)[rim] / steep[rim][:, None]
    return np.asarray(np.einsum("pi,pj->ij", outwards, n[rim][:, :2]) / rim.sum())


def _shrunk(mask: Mask, *, corners: bool) -> Mask:
    """A mask (H, W) without the pixels that have a neighbour beside it, corners counted or not; the map goes on beyond its edges."""
    height, width = mask.shape
    wide = np.pad(mask, 1, mode="edge")
    steps = [(i, j) for i in (0, 1, 2) for j in (0, 1, 2) if corners or i == 1 or j == 1]
    return np.asarray(np.all([wide[i : i + height, j : j + width] for i, j in steps], axis=0))


def curl(normals_C: Image, mask: Mask, rays_C: Array) -> Curl:
    """What the curl of normals (H, W, 3) says along rays (H, W, 3)."""
    n = normals_C.astype(float)
    facing = -np.einsum("...i,...i->...", n, rays_C)
    length = lambert.length(n) * lambert.length(rays_C)
    good = mask & (facing > LEAST_COSINE * length)
    size = np.where(good, facing, 1.0)
    if rays_C[..., :2].any():
        along, down = (np.gradient(rays_C, axis=axis) for axis in (1, 0))
        p, q = (np.einsum("...i,...i->...", n, step) / size for step in (along, down))
    else:
        p, q = n[..., 0] / size, n[..., 1] / size
    found = _asked(p, q, good)
    for side in BLOCKS[1:]:
        if (abs(found.likeness) > CLEAR and abs(found.sure) > CERTAIN) or found.twist_sure > CERTAIN:
            break
        coarse = _asked(*_blocks(p, q, good, side))
        found = replace(coarse, median=found.median)
    return found


def _blocks(p: Array, q: Array, good: Mask, side: int) -> tuple[Array, Array, Mask]:
    """Means of slopes (H, W) over blocks of pixels, and the blocks whose pixels are all good."""
    rows, columns = (length // side for length in p.shape)

    def mean(values: Array) -> Array:
        return np.asarray(values[: rows * side, : columns * side].reshape(rows, side, columns, side).mean(axis=(1, 3)))

    return mean(p), mean(q), mean(good.astype(float)) > 1 - 1e-9


def _asked(p: Array, q: Array, good: Mask) -> Curl:
    """What the curl of slopes (H, W) says, where they are good."""
    whole = good[:-1, :-1] & good[:-1, 1:] & good[1:, :-1] & good[1:, 1:]
    a, b = (p[1:] - p[:-1])[:, :-1], (q[:, 1:] - q[:, :-1])[:-1]
    if whole.sum() < 2:
        return Curl(0.0, 0.0, 0.0, 0.0)
    median = float(np.median(np.abs(a - b)[whole]))
    size = np.abs(np.concatenate([a[whole], b[whole]]))
    top = float(np.percentile(size, 100 * (1 - OUTLIER_RATE)))  # depth breaks are rarer in any map worth integrating
    a, b = (np.where(whole, np.clip(one, -top, top), 0.0) for one in (a, b))
    beside, below = a[:, :-1] * a[:, 1:], b[:-1] * b[1:]
    twist = np.sqrt(max(float(beside.sum()), 0.0) * max(float(below.sum()), 0.0))
    all_of_it = float(np.sum(a * a + b * b)) / 2
    scale = twist if min(_sure(beside), _sure(below)) > CERTAIN else all_of_it
    likeness = float(np.sum(a * b)) / scale if scale > 0 else 0.0
    return Curl(float(np.clip(likeness, -1, 1)), _sure(a * b), min(_sure(beside), _sure(below)), median)


def _sure(products: Array) -> float:
    """The sum of products by its standard error if they had no mean."""
    error = float(np.sqrt(np.sum(products**2)))
    return float(products.sum()) / error if error > 0 else 0.0


def _tells(found: Curl) -> bool:
    return found.likeness > CLEAR and found.sure > CERTAIN


def _refuse_swapped(name: str, normals_C: Image, mask: Mask, rays_C: Array) -> None:
    """Refuse a map whose third channel does not face the camera while another is of one sign."""
    n = normals_C[mask]
    facing = -np.einsum("pi,pi->p", n, rays_C[mask])
    towards = float(np.mean(facing > 0))
    if max(towards, 1 - towards) >= 1 - OUTLIER_RATE and np.median(np.abs(facing)) > LEAST_COSINE:
        return
    shares = [max(float(np.mean(n[:, k] > 0)), float(np.mean(n[:, k] < 0))) for k in range(2)]
    k = int(np.argmax(shares))
    if shares[k] > 1 - OUTLIER_RATE and float(np.median(np.abs(n[:, k]))) > float(np.median(np.abs(n[:, 2]))):
        raise DisagreementError(
            f"the {('red', 'green')[k]} channel has one sign all over the map and the blue one is near 0: the channels are swapped",
            where=name,
            needed="x in red, y in green, z (towards the camera) in blue",
            todo="swap red and blue, or export it as RGB" if k == 0 else "put the channels in that order",
        )

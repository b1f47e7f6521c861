"""Fit the network by which the automatic mask's outline is drawn: ``python tools/fit_outline.py SCENES... --folds FILE [--jobs N]``.

SCENES are folders as tools/fit_mask.py reads them, and FILE is what it has written of networks that were not fitted to them; scenes that
are not in it are judged as lpcal does. Those of many lights are seen once more by every second or third of them. Writes the weights that
lpcal.segmentation.outline reads. Printed: how good the masks in full size are by the network as it stands, and DOUBTED and DOUBT_POWER of
lpcal.segmentation.mask by these; for scenes left out of a first fit, the last LEFT_OUT, the masks in coarse pixels and at its scale. Scenes
whose coarse mask is so wrong that there is no outline to draw are not fitted to. Needs PyTorch (``uv run --with torch``); with
OMP_NUM_THREADS=1 where other work shares the machine.
"""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
from scipy import optimize

from fit_mask import WRONG, Seen, by_some, ellipse, elsewhere, iou, line_of, of_scenes
from lpcal.geometry import raster
from lpcal.geometry.raster import block_means
from lpcal.segmentation import background, layers, mask, outline, plane_hough
from lpcal.view import network
from lpcal.view.coarse import joined
from lpcal.view.network import Network

LEFT_OUT = 114
"""Scenes that the first fit does not see."""
DRAWABLE = 0.7
"""IoU of a coarse mask from which its outline is fitted to."""
EPOCHS, BATCH, SIDES = 24, 8, (104, 136)
"""Times that all scenes are seen, scenes a step, and rows and columns of the window that a step sees of each."""
RATE, DECAY = 4e-3, 1e-2
"""Highest step of the one-cycle schedule (Smith and Topin 2018), and the decay of weights (AdamW)."""
WIDTHS = (12, 24, 32, 48, 12)
"""Channels of the four scales, and of the last one."""
NOISE, OFFSET = 0.02, 0.05
"""Standard deviations, in those of a channel, of noise added to pixels and to whole channels: of what scenes do not vary."""
NO_ROOM = 0.15
"""Share of the scenes of a step that are shown without their ambient image."""
CUT, PIERCED, DIMMED, UNLIT = 0.3, 0.15, 0.25, 0.2
"""Shares of the scenes of a step whose object is cut off along lines, has a hole, has a side that no light reaches, or stands before what
no light reaches: drawn objects are round and whole, and they and their backgrounds stand in the light."""
CUTS = 3
"""Lines at most along which an object is cut off: two make a corner."""
CUT_OFF, HOLES = (0.02, 0.4), (0.002, 0.1)
"""Shares of the object that are cut off, or that a hole is, evenly by logarithm."""
DARKER = (3.0, 5.0)
"""By how much the logarithm of the brightness of a side is less that no light reaches."""
SMOOTH_PX = 1.5
"""Standard deviation, in pixels, over which coarse odds change: they are those of pixels two or three times as large."""
MIXED = (0.02, 0.98)
"""Share of a pixel that is the object between which the outline crosses it."""
INWARD = 8
"""Pixels of a window's border where the outline that it is chosen for does not lie."""
FEWEST = 200
"""Pixels that an object counts as at least."""
LOGISTIC = 2.0
"""Weight of the logistic loss beside the lack of overlap."""


@dataclass(frozen=True)
class Example:
    """A scene, by all of its lights or by some."""

    name: str
    whole: bool
    """Whether by all of its lights."""
    channels: dict[str, np.ndarray]
    """(rows, columns) each."""
    of_object: np.ndarray
    """(rows, columns) share of a pixel that is the object."""
    coarse: float
    """IoU of the coarse mask."""
    full: float
    """IoU of the mask in full size, its outline drawn by the network as it stands."""
    expected_wrong: float


def example(scene: Path, lights: slice, judge: Network | None) -> Example:
    """A scene by some of its lights and the coarse odds of a network, by default lpcal's own."""
    seen = Seen.of(scene, lights)
    view, lit = seen.view()
    image = view.image
    planes = plane_hough.find(image, view.table, view.swept, lit, seen.distance_m)
    labels, found, cost = layers.label(view, planes, lit, float(np.log(seen.distance_m)))
    judged = background.judged(view, labels, found.planes, cost, judge)
    apart = mask.apart_of(view, judged)
    factor = outline.scale_of(image.factor)
    channels, window = outline.channels(apart, joined(seen.maps, seen.rays_C, factor)[0], seen.room, factor)
    return Example(
        scene.name,
        lights == slice(None),
        {name: value.astype(np.float16) for name, value in channels.items()},
        block_means(seen.true.astype(float), factor)[window],
        iou(judged.mask, block_means(seen.true.astype(float), image.factor) > 0.5),
        iou(mask.tidy(outline.drawn(apart, seen.maps, seen.rays_C, seen.room)), seen.true),
        background.doubt_of(judged, labels).share if judged.mask.any() else 1.0,
    )


def left_out(scene: Path, folds: Path | None) -> list[Example]:
    """A scene by all its lights, and by every second or third of many, judged by the network that was not fitted to it."""
    judges = {} if folds is None else pickle.loads(folds.read_bytes())
    return [example(scene, some, judges.get(scene.name)) for some in by_some(len(Seen.of(scene).lights))]


def beyond_a_line(share: np.ndarray, part: float, rng: np.random.Generator) -> np.ndarray:
    """The part (rows, columns) of an object that lies furthest in some direction."""
    rows, columns = np.indices(share.shape)
    turn = rng.uniform(0, 2 * np.pi)
    along, inside = np.cos(turn) * rows + np.sin(turn) * columns, share > 0.5
    return np.asarray(inside & (along > np.quantile(along[inside], 1 - part)) if inside.any() else inside)


def hole(share: np.ndarray, part: float, rng: np.random.Generator) -> np.ndarray:
    """An ellipse (rows, columns) in the object that is a part of it."""
    inside = np.argwhere(share > 0.5)
    if not len(inside):
        return np.zeros(share.shape, bool)
    row, column = inside[rng.integers(len(inside))]
    return ellipse(share, row, column, part * len(inside), rng)


def replaced(
    x: np.ndarray, share: np.ndarray, part: np.ndarray, names: Sequence[str], rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """The same with a part of the object that shows what its background shows elsewhere; as it is where there is no room for one."""
    if (there := elsewhere(share, part, MIXED[0], rng)) is not None:
        x, share = x.copy(), share.copy()
        x[:, part], share[part] = x[:, there[:, 0], there[:, 1]], 0.0
        odds = x[names.index("odds")]
        near = raster.dilated(part, round(2 * SMOOTH_PX))
        odds[near] = raster.gaussian_filtered(odds.astype(float), SMOOTH_PX)[near] + rng.uniform(-2, 2)
    return x, share


def dimmed(x: np.ndarray, part: np.ndarray, names: Sequence[str], rng: np.random.Generator) -> np.ndarray:
    """The same with a part of the object that no light reaches; the image without lights shows it."""
    if not (part.any() and x[names.index("has room")].all()):
        return x
    x, by, count = x.copy(), rng.uniform(*DARKER), int(part.sum())
    for name in ("shading", "bright", "over noise"):
        x[names.index(name), part] -= by
    for name in ("leaning x", "leaning y"):
        x[names.index(name), part] = rng.normal(0, 0.15, count)
    if rng.random() < 0.5:
        for name in ("second darkest", "darkest"):
            x[names.index(name), part] = np.log(outline.FAINTEST)
    near = raster.dilated(part, round(2 * SMOOTH_PX))
    odds = x[names.index("odds")]
    odds[part] = rng.uniform(-outline.UNSURE, outline.UNSURE)
    odds[near] = raster.gaussian_filtered(odds.astype(float), SMOOTH_PX)[near]
    return x


def unlit(x: np.ndarray, part: np.ndarray, names: Sequence[str], rng: np.random.Generator) -> np.ndarray:
    """The same with a background that no light reaches; the image without lights shows it."""
    if not (part.any() and x[names.index("has room")].all()):
        return x
    x, count = x.copy(), int(part.sum())
    darkest = {name: float(x[names.index(name)].min()) for name in ("bright", "shading")}
    for name in ("leaning x", "leaning y"):
        x[names.index(name), part] = rng.normal(0, 0.3, count)
    for name, value in {"second darkest": np.log(outline.FAINTEST), "darkest": np.log(outline.FAINTEST), **darkest}.items():
        x[names.index(name), part] = value
    x[names.index("over noise"), part] = rng.normal(-0.5, 0.7, count).clip(outline.NOISY, outline.DIM)
    odds = x[names.index("odds")]
    odds[part] = np.maximum(odds[part], -outline.UNSURE)
    return x


def drawn(one: Example, x: np.ndarray, names: Sequence[str], rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Channels (C, rows, columns), what they show (rows, columns) and where (0 or 1) of a window about a place of the outline."""
    share = one.of_object
    for _ in range(rng.integers(1, CUTS + 1) if rng.random() < CUT else 0):
        x, share = replaced(x, share, beyond_a_line(share, np.exp(rng.uniform(*np.log(CUT_OFF))), rng), names, rng)
    if rng.random() < PIERCED:
        x, share = replaced(x, share, hole(share, np.exp(rng.uniform(*np.log(HOLES))), rng), names, rng)
    if rng.random() < UNLIT:
        x = unlit(x, share < MIXED[0], names, rng)
    if rng.random() < DIMMED:
        x = dimmed(x, beyond_a_line(share, np.exp(rng.uniform(*np.log(CUT_OFF))), rng), names, rng)
    if rng.random() < NO_ROOM:
        x = np.where(np.isin(names, ("room", "has room"))[:, None, None], 0, x)
    if rng.random() < 0.5:
        sign = np.where(np.isin(names, outline.MIRRORED), -1, 1)[:, None, None]
        x, share = x[..., ::-1] * sign, share[:, ::-1]
    at = np.argwhere((share > MIXED[0]) & (share < MIXED[1]))
    middle = at[rng.integers(len(at))] if len(at) else np.array(share.shape) // 2
    begin = [
        int(np.clip(here - rng.integers(INWARD, side - INWARD), 0, max(whole - side, 0)))
        for here, side, whole in zip(middle, SIDES, share.shape, strict=True)
    ]
    window = tuple(slice(first, first + side) for first, side in zip(begin, SIDES, strict=True))
    part, seen = x[:, *window], share[window]
    found = np.zeros((len(x), *SIDES), np.float32), np.zeros(SIDES, np.float32), np.zeros(SIDES, np.float32)
    for to, values in zip(found, (part, seen, np.ones_like(seen)), strict=True):
        to[..., : seen.shape[0], : seen.shape[1]] = values
    return found


def fitted(train: Sequence[Example], seed: int = 0) -> dict[str, np.ndarray]:
    """What a file keeps of the network of least loss over examples, by PyTorch."""
    import torch
    from torch.nn import functional

    from unet import Unet, arrays

    torch.manual_seed(seed)
    names, rng = list(train[0].channels), np.random.default_rng(seed)
    x_of = [np.stack([one.channels[name] for name in names]).astype(np.float32) for one in train]
    some = np.concatenate([x.reshape(len(names), -1)[:, ::97] for x in x_of], axis=1)
    middle, spread = some.mean(axis=1), some.std(axis=1) + 1e-3
    net, each = Unet(len(names), WIDTHS, 1), len(train) // BATCH
    optimizer = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=EPOCHS * each, pct_start=0.15)
    place = np.broadcast_to(network.places(*SIDES), (BATCH, 2, *SIDES))
    for _ in range(EPOCHS):
        for batch in rng.permutation(len(train))[: each * BATCH].reshape(each, BATCH):
            x, share, there = (np.stack(part) for part in zip(*(drawn(train[k], x_of[k], names, rng) for k in batch), strict=True))
            x = np.clip((x - middle[:, None, None]) / spread[:, None, None], -network.FURTHEST, network.FURTHEST)
            noise = OFFSET * rng.standard_normal((*x.shape[:2], 1, 1)) + NOISE * rng.standard_normal(x.shape)
            x = np.concatenate([x + noise, place], axis=1) * there[:, None]
            said, whole = net(torch.from_numpy(x.astype(np.float32)))[:, 0], torch.from_numpy(share)
            true, counted = (whole > 0.5).float(), torch.from_numpy(there)
            area = torch.tensor([max(float(train[k].of_object.sum()), FEWEST) for k in batch])
            logistic = functional.binary_cross_entropy_with_logits(said, true, reduction="none") * 2 * (whole - 0.5).abs() * counted
            p = torch.sigmoid(said) * counted
            both, either = (p * true).sum((1, 2)), (p + true - p * true).sum((1, 2)).clamp(min=1)
            optimizer.zero_grad()
            (LOGISTIC * logistic.sum((1, 2)) / area + 1 - both / either).mean().backward()
            torch.nn.utils.clip_grad_norm_(net.parameters(), 2.0)
            optimizer.step()
            schedule.step()
    return arrays(net, names, outline.MIRRORED, middle, spread)


def doubted(expected: np.ndarray, bad: np.ndarray) -> tuple[float, float]:
    """DOUBTED and DOUBT_POWER of the odds ``1 / (1 + (DOUBTED / expected)^DOUBT_POWER)`` that a mask is `bad`; a power near 2 is likely."""
    log_share = np.log(np.maximum(expected, 1e-3))

    def cost(x: np.ndarray) -> float:
        at = np.exp(x[1]) * (log_share - x[0])
        return float(np.sum(np.logaddexp(0, np.where(bad, -at, at))) + 0.5 * ((x[1] - np.log(2)) / 0.5) ** 2)

    x = optimize.minimize(cost, [np.log(0.2), np.log(2)], method="Nelder-Mead").x
    return float(np.exp(x[0])), float(np.exp(x[1]))


def report(examples: Sequence[Example]) -> None:
    """Print what a fit without some scenes does for these, and write the fit to all."""
    names = sorted({one.name for one in examples})
    left, usable = set(names[-LEFT_OUT:]), [one for one in examples if one.coarse > DRAWABLE]
    net = Network.of(fitted([one for one in usable if one.name not in left]))
    some = [one for one in examples if one.name in left and one.whole]
    print(line_of(f"{len(some)} scenes left out, IoU of coarse masks", [one.coarse for one in some]))
    fine = [iou(np.mean(net.answers(one.channels), axis=0)[0] > 0, one.of_object > 0.5) for one in some]
    print(line_of("   at the network's scale", fine))
    np.savez_compressed(outline.FITTED, **fitted(usable))
    whole = [one for one in examples if one.whole]
    print(line_of(f"{len(whole)} scenes, in full size, by the network as it stood", [one.full for one in whole]))
    expected, bad = np.array([one.expected_wrong for one in whole]), np.array([one.full < WRONG for one in whole])
    at, power = doubted(expected, bad)
    print(f"DOUBTED, DOUBT_POWER = {at:.2f}, {power:.1f}")
    for share in (0.04, 0.06, 0.08, 0.1, 0.12, 0.15, 0.2):
        stated = [float(np.mean(expected[some] > share)) for some in (bad, ~bad)]
        print(f"  expected wrong over {share}: of the wrong {stated[0]:.2f}, of the right {stated[1]:.2f}")


if __name__ == "__main__":
    taken, _ = of_scenes(__doc__, left_out)
    report(list(chain.from_iterable(taken)))

"""Fit the network that the automatic mask judges by: ``python tools/fit_mask.py SCENES... [--jobs N] [--on ENGINE] [--folds FILE]``.

SCENES are folders with calibration.yaml, capture/ and truth/surface.npz (a `mask`); without an ambient image the room's light is
estimated, as the mask does it. Writes the weights that lpcal.view.network reads; cross-validated by scene in FOLDS parts, how good
the coarse masks are. The networks that were fitted without a part of the scenes go to FILE, for tools/fit_outline.py, which must not see
odds of scenes that they were fitted to. The labels themselves depend a little on the network. Needs PyTorch (``uv run --with torch``); with
OMP_NUM_THREADS=1 where other work shares the machine.
"""

from __future__ import annotations

import argparse
import pickle
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

import numpy as np

from lpcal.api.curve import settle_sensor
from lpcal.api.engines import engine_of
from lpcal.api.sensor import stated_in
from lpcal.detect.radiometry import to_radiance
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.capture import read_capture
from lpcal.geometry.raster import block_means
from lpcal.records.calibration import Light
from lpcal.segmentation import background, features, layers, mask, plane_hough, room_light
from lpcal.segmentation.features import View
from lpcal.view import network, pixel_list
from lpcal.view.coarse import LightTable, coarse_of, factor_of
from lpcal.view.constants import CERTAIN, COARSE_PIXELS

FOLDS = 4
EPOCHS, BATCH = 64, 8
"""Times that all scenes are seen, and scenes a step: the IoU of scenes left out gains no more."""
RATE, DECAY = 4e-3, 1e-2
"""Highest step of the one-cycle schedule (Smith and Topin 2018), and the decay of weights (AdamW)."""
WIDTHS = (12, 32, 48, 64, 16)
"""Channels of the four scales, and of the last one."""
SIDES = (60, 80)
"""Rows and columns that crops are brought to."""
PIERCED, HOLES = 0.35, (0.004, 0.15)
"""Share of the samples in whose object a hole is made, and its area in the object's: drawn objects have few."""
NOISE, OFFSET = 0.03, 0.1
"""Standard deviations, in those of a channel, of noise added to pixels and to whole channels: of what scenes do not vary."""
CROPPED, NO_ROOM, DARK_ROOM = 0.5, 0.15, 0.2
"""Shares of the samples that are crops, whose image without lights is left out, and in it the room is dark where lights do not reach it."""
DARKER = (0.3, 3.0)
"""Natural logarithm of the ratio of the object's brightness and that of such a room in the image without lights, from and to."""
OVERLAP = 0.5
"""Weight of 1 - IoU (soft) in the loss, beside the mean logistic loss a pixel of the object's area."""
NOISIER = 2.0
"""Noise of the images, in their own, that is added for a scene's second set of labels."""
TRIES = 20
"""Places in the background that are tried for what shows where a part of the object was."""
MANY = 8
"""Lights of which every second are enough for a surface."""
WRONG = 0.9
"""IoU under which a mask is wrong."""
FEWEST = 60
"""Coarse pixels that an object counts as at least."""


@dataclass(frozen=True)
class Example:
    """A scene's channels with their truth."""

    name: str
    channels: dict[str, np.ndarray]
    """(rows, columns) each."""
    of_object: np.ndarray
    """(rows, columns) share of a coarse pixel that is the object."""
    whole: bool
    """Whether its labels are those of the images as they are."""


@dataclass(frozen=True)
class Seen:
    """A scene as the mask sees it, and its truth."""

    maps: pixel_list.SignalMaps
    rays_C: np.ndarray
    lights: tuple[Light, ...]
    distance_m: float
    room: np.ndarray | None
    true: np.ndarray
    """(H, W) bool."""

    @staticmethod
    def of(scene: Path, some: slice = slice(None)) -> Seen:
        """From its folder, by some of its lights; without an ambient image the room's light is estimated and taken away."""
        calibration = read_calibration(scene / "calibration.yaml")
        names = [light.name for light in calibration.lights]
        raw = read_capture(scene / "capture", names, name=scene.name, use=names[some])
        radiance = to_radiance(raw, settle_sensor(raw, calibration, [("calibration", stated_in(calibration))]).used.sensor)
        lights, distance_m = pixel_list.lights_of(calibration, radiance), calibration.d_object_m or 0.35
        maps = pixel_list.grey(radiance, lights)
        rays_C, room = pixel_list.ray_map(radiance.signal.shape[1:3], calibration.camera), pixel_list.room(radiance)
        if room is None:
            maps = room_light.taken_away(maps, room_light.found(maps, rays_C, lights, distance_m))
        return Seen(maps, rays_C, lights, distance_m, room, np.load(scene / "truth/surface.npz")["mask"])

    def view(self) -> tuple[View, np.ndarray]:
        """The coarse view, and which of its pixels (P,) are lit."""
        image = coarse_of(self.maps, self.rays_C, factor_of(self.maps, COARSE_PIXELS))
        table = LightTable.of(image, self.lights, self.distance_m)
        lit = np.sum(image.signal > CERTAIN * image.sigma, axis=0) >= 3
        return mask.view_of(image, table, self.distance_m, mask.NO_HINTS, self.true.shape, self.room), lit


def by_some(lights: int) -> list[slice]:
    """All lights, and every second or third of many: of captures by few lights there are never enough."""
    return [slice(None), *([slice(0, None, 2)] if lights >= MANY else []), *([slice(1, None, 3)] if lights >= 3 * MANY / 2 else [])]


def example(scene: Path, folds: Path | None) -> list[Example]:
    """A scene labelled as the mask does it, and once more with noise added."""
    del folds  # what is fitted here
    seen = Seen.of(scene)
    view, lit = seen.view()
    image, rng = view.image, np.random.default_rng(int("".join(filter(str.isdigit, scene.name)) or 0))
    of_object = block_means(seen.true.astype(float), image.factor)
    noisy = replace(image, signal=image.signal + NOISIER * image.sigma * rng.standard_normal(image.signal.shape))
    found = []
    for here in (image, noisy):
        planes = plane_hough.find(here, view.table, view.swept, lit, seen.distance_m)
        labels, them, cost = layers.label(view, planes, lit, float(np.log(seen.distance_m)))
        found.append(Example(scene.name, features.channels(view, labels, them.planes, cost), of_object, here is image))
    return found


def crop(true: np.ndarray, rng: np.random.Generator) -> tuple[slice, slice]:
    """Rows and columns of a window that holds the object."""
    sides = []
    for axis in (0, 1):
        held, side = np.flatnonzero(true.any(axis=1 - axis)), true.shape[axis]
        first, last = (int(held[0]), int(held[-1]) + 1) if len(held) else (side // 3, 2 * side // 3)
        sides.append(slice(round(first * rng.random() ** 2), round(side - (side - last) * rng.random() ** 2)))
    return sides[0], sides[1]


def ellipse(share: np.ndarray, row: int, column: int, area: float, rng: np.random.Generator) -> np.ndarray:
    """The part (rows, columns) of an object in an ellipse of some form about a place."""
    rows, columns = np.indices(share.shape)
    longer, turn = np.exp(rng.uniform(-0.7, 0.7)), rng.uniform(0, np.pi)
    along = np.cos(turn) * (rows - row) + np.sin(turn) * (columns - column)
    across = np.cos(turn) * (columns - column) - np.sin(turn) * (rows - row)
    return np.asarray((along**2 * longer + across**2 / longer < area / np.pi) & (share > 0.5))


def elsewhere(share: np.ndarray, part: np.ndarray, most: float, rng: np.random.Generator) -> np.ndarray | None:
    """Rows and columns (N, 2) of a part (rows, columns) moved to where the object's share is under `most`; None where there is no room."""
    at = np.argwhere(part)
    for _ in range(TRIES if len(at) else 0):
        there = at + rng.integers(-np.array(share.shape), share.shape)
        if (there >= 0).all() and (there < share.shape).all() and (share[tuple(there.T)] < most).all():
            return np.asarray(there)
    return None


def pierced(x: np.ndarray, share: np.ndarray, names: Sequence[str], rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """The same with a hole in the object that shows what its background shows elsewhere; as it is where there is no room for one."""
    places = np.argwhere(share > 0.9)
    if not len(places):
        return x, share
    (row, column), area = places[rng.integers(len(places))], (share > 0.5).sum() * np.exp(rng.uniform(*np.log(HOLES)))
    hole = ellipse(share, row, column, area, rng)
    if (there := elsewhere(share, hole, 0.05, rng)) is not None:
        x, share = x.copy(), share.copy()
        x[:, hole], share[hole] = x[:, there[:, 0], there[:, 1]], 0.0
        x[names.index("size"), hole], x[names.index("frame"), hole] = np.sqrt(hole.mean()), 0.0
    return x, share


def darkened(x: np.ndarray, share: np.ndarray, names: Sequence[str], rng: np.random.Generator) -> np.ndarray:
    """The same with a room that is dark without the lights, too, where these do not reach it: drawn rooms are not."""
    far, inside = (x[names.index("nothing")] > 0.5) & (share < 0.5), share > 0.5
    if not (far.any() and inside.any() and x[names.index("has room")].all()):
        return x
    room = x[names.index("room")].copy()
    room[far] = np.median(room[inside]) - rng.uniform(*DARKER) + rng.normal(0, 0.1, int(far.sum()))
    return np.where(np.equal(names, "room")[:, None, None], room - np.median(room), x)


def sampled(one: Example, names: Sequence[str], rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Channels (C, rows, columns) and the object's share (rows, columns) of a crop or the whole, as it is or in a mirror."""
    x, share = np.stack([one.channels[name] for name in names]), one.of_object
    if rng.random() < PIERCED:
        x, share = pierced(x, share, names, rng)
    if rng.random() < DARK_ROOM:
        x = darkened(x, share, names, rng)
    if rng.random() < CROPPED:
        rows, columns = crop(share > 0.5, rng)
        if rows.stop - rows.start > SIDES[0] // 3 and columns.stop - columns.start > SIDES[1] // 3:
            x, share = x[:, rows, columns], share[rows, columns]
    if share.shape != SIDES:
        i, j = (((np.arange(to) + 0.5) * side / to).astype(int) for to, side in zip(SIDES, share.shape, strict=True))
        x, share = x[:, i][:, :, j], share[np.ix_(i, j)]
    if rng.random() < NO_ROOM:
        x = np.where(np.isin(names, ("room", "has room"))[:, None, None], 0, x)
    if rng.random() < 0.5:
        x, share = x[..., ::-1] * np.where(np.isin(names, features.MIRRORED), -1, 1)[:, None, None], share[:, ::-1]
    return x, share


def fitted(train: Sequence[Example], seed: int = 0) -> dict[str, np.ndarray]:
    """What a file keeps of the network of least loss over examples, by PyTorch."""
    import torch
    from torch.nn import functional

    from unet import Unet, arrays

    torch.manual_seed(seed)
    names, rng = list(train[0].channels), np.random.default_rng(seed)
    pixels = np.concatenate([np.stack([one.channels[name].ravel() for name in names])[:, ::7] for one in train], axis=1)
    middle, spread = pixels.mean(axis=1), pixels.std(axis=1) + 1e-3
    by_name: dict[str, list[Example]] = {}
    for one in train:
        by_name.setdefault(one.name, []).append(one)
    net, each = Unet(len(names), WIDTHS, 1), len(by_name) // BATCH
    place = np.broadcast_to(network.places(*SIDES), (BATCH, 2, *SIDES))
    optimizer = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=EPOCHS * each, pct_start=0.15)
    for _ in range(EPOCHS):
        order = rng.permutation(sorted(by_name))
        for batch in order[: each * BATCH].reshape(each, BATCH):
            drawn = [sampled(by_name[name][rng.integers(len(by_name[name]))], names, rng) for name in batch]
            x = (np.stack([one[0] for one in drawn]) - middle[:, None, None]) / spread[:, None, None]
            x = np.clip(x, -network.FURTHEST, network.FURTHEST) + OFFSET * rng.standard_normal((*x.shape[:2], 1, 1))
            x = np.concatenate([x + NOISE * rng.standard_normal(x.shape), place], axis=1)
            share = torch.from_numpy(np.stack([one[1] for one in drawn]).astype(np.float32))
            said, true = net(torch.from_numpy(x.astype(np.float32)))[:, 0], (share > 0.5).float()
            weight = 2 * (share - 0.5).abs() / true.sum((1, 2), keepdim=True).clamp(min=FEWEST)
            logistic = (functional.binary_cross_entropy_with_logits(said, true, reduction="none") * weight).sum((1, 2))
            p = torch.sigmoid(said)
            both, either = (p * true).sum((1, 2)), (p + true - p * true).sum((1, 2)).clamp(min=1)
            optimizer.zero_grad()
            (logistic + OVERLAP * (1 - both / either)).mean().backward()
            torch.nn.utils.clip_grad_norm_(net.parameters(), 2.0)
            optimizer.step()
            schedule.step()
    return arrays(net, names, features.MIRRORED, middle, spread)


def by_folds(examples: Sequence[Example]) -> dict[str, network.Network]:
    """For each scene a network that was not fitted to it."""
    names = sorted({one.name for one in examples})
    part = dict(zip(names, np.random.default_rng(0).permutation(np.arange(len(names)) % FOLDS), strict=True))
    found: dict[str, network.Network] = {}
    for k in range(FOLDS):
        net = network.Network.of(fitted([one for one in examples if part[one.name] != k]))
        found |= {name: net for name in names if part[name] == k}
    return found


def iou(mine: np.ndarray, true: np.ndarray) -> float:
    """Intersection over union."""
    return float((mine & true).sum() / max((mine | true).sum(), 1))


def line_of(name: str, values: list[float]) -> str:
    """A line of figures."""
    x = np.array(values)
    shares = f">= .93 {np.mean(x >= 0.93):.0%}, < .9 {np.mean(x < WRONG):.0%}"
    return f"{name}: mean {x.mean():.3f}, median {np.median(x):.3f}, worst tenth {np.percentile(x, 10):.3f}, {shares}"


def report(examples: Sequence[Example], folds: Path | None = None) -> None:
    """Write the network and those by folds, print figures."""
    if folds is not None:
        left_out = by_folds(examples)
        folds.write_bytes(pickle.dumps(left_out))
        for whole, name in ((True, "as they are"), (False, "with noise added")):
            some = [one for one in examples if one.whole is whole]
            masks = [background.object_in(background.log_odds_by(left_out[one.name], one.channels) > 0, ()) for one in some]
            values = [iou(found, one.of_object > 0.5) for found, one in zip(masks, some, strict=True)]
            print(line_of(f"{len(some)} scenes left out, images {name}: IoU of coarse masks", values))
    np.savez_compressed(background.FITTED, **fitted(examples))


def of_scenes[T](description: str | None, example: Callable[[Path, Path | None], T]) -> tuple[list[T], Path | None]:
    """The examples of the scenes that the command line names, on the engine that it asks for, and the file of the judges by folds."""
    words = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="+", type=Path)
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--on", default="processes")
    words.add_argument("--folds", type=Path)
    given = words.parse_args()
    with engine_of(given.on, given.jobs, Path()).start() as pool:
        return list(pool.map(partial(example, folds=given.folds), given.scenes)), given.folds


if __name__ == "__main__":
    taken, file = of_scenes(__doc__, example)
    report(list(chain.from_iterable(taken)), file)

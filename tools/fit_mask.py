"""Fit what the automatic mask judges by: ``python tools/fit_mask.py SCENES... [--jobs N] [--on ENGINE] [--folds FILE]``.

SCENES are folders with calibration.yaml, capture/ and truth/surface.npz (a `mask`); without an ambient image the room's light is
estimated, as the mask does it. Writes the trees that lpcal.segmentation.background reads and prints its BESIDE; cross-validated by scene in
FOLDS parts, how good the coarse masks are. The judges that were fitted without a part of the scenes go to FILE, for tools/fit_outline.py,
which must not see odds of scenes that they were fitted to. The regions themselves depend a little on the judge. Needs scikit-learn
(``uv run --with scikit-learn``); with OMP_NUM_THREADS=1 where other work shares the machine.
"""

from __future__ import annotations

import argparse
import pickle
from collections.abc import Callable
from dataclasses import dataclass, field, replace
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
from lpcal.segmentation import background, context, flats, layers, mask, outline, regions, room_light
from lpcal.segmentation.regions import Pictures, Regions, View
from lpcal.segmentation.samples import LIT_SIGMAS
from lpcal.view import sight
from lpcal.view.coarse import LightTable, coarse_of, factor_of

FOLDS, INNER = 6, 5
RIDGE = 0.3
"""Penalty on the square of a weight of a clue of standard deviation 1, by the loss of scenes left out, which is flat from .1 to .3."""
REGIONS = {"max_iter": 200, "max_leaf_nodes": 12, "min_samples_leaf": 30, "l2_regularization": 3.0}
CONTEXT = {"max_iter": 150, "max_leaf_nodes": 12, "min_samples_leaf": 200, "l2_regularization": 5.0}
"""Trees of regions and of coarse pixels, and how far they go, by the IoU of scenes left out, which gains no more from more of them."""
COMMON = {"learning_rate": 0.06, "max_features": 0.5, "early_stopping": False, "random_state": 0}
FALLING = ("frame", "frame, a plane")
"""Clues that speak against the object the more the larger they are, whatever the scenes say: what holds the frame is background."""
CROPS = 2
"""Crops of a scene that are fitted to besides the whole, so that the object lies anywhere in the picture."""
WRONG = 0.9
"""IoU under which a mask is wrong."""
SMALLEST = 3
"""Coarse pixels under which a region is not fitted to."""
SOME, CLEAR, FEWEST = 1500, 0.2, 50
"""Coarse pixels of a scene that are fitted to at most; how far from half their share of the object must be; the least object."""


@dataclass
class Example:
    """A scene's regions with their truth."""

    name: str
    pictures: Pictures
    found: Regions
    of_object: np.ndarray
    """(rows, columns) share of a coarse pixel that is the object."""
    bright: np.ndarray
    room: np.ndarray | None
    """(rows, columns) logarithms of the lights' brightness and of the image without lights."""
    whole: bool = True
    """Whether it is no crop."""
    share: np.ndarray = field(init=False)
    """(N,) share of a region that is the object."""
    weight: np.ndarray = field(init=False)
    """(N,) area over the object's, 1 at most; 0 under SMALLEST."""
    clues: np.ndarray = field(init=False)
    """(N, clues) by themselves."""
    first: np.ndarray = field(init=False)
    """(N,) odds of the first fit, of scenes left out."""

    def __post_init__(self) -> None:
        self.share = self.found.mean(self.true)
        area = self.found.area
        self.weight = np.minimum(area / max(self.true.sum(), 1), 1.0) * (area >= SMALLEST)
        self.clues = np.stack(list(self.own().values()), axis=1)

    @property
    def true(self) -> np.ndarray:
        """(rows, columns) bool."""
        return self.of_object > 0.5

    def own(self) -> dict[str, np.ndarray]:
        """The clues (N,) of regions by themselves."""
        return regions.own(self.pictures, self.found)

    def beside(self) -> dict[str, np.ndarray]:
        """The clues (N,) with those about it, by the first odds."""
        return regions.beside(self.pictures, self.found, background.logit(self.first))

    def in_context(self, odds: np.ndarray) -> dict[str, np.ndarray] | None:
        """The clues (P,) of coarse pixels by the odds (N,) of regions."""
        of_pixel = odds[self.found.number]
        return context.clues_of(of_pixel, background.logit(of_pixel), self.pictures, self.found, self.bright, self.room)


@dataclass(frozen=True)
class Seen:
    """A scene as the mask sees it, and its truth."""

    maps: sight.Grey
    rays_C: np.ndarray
    lights: tuple[Light, ...]
    distance_m: float
    room: np.ndarray | None
    true: np.ndarray
    """(H, W) bool."""

    @staticmethod
    def of(scene: Path) -> Seen:
        """From its folder; without an ambient image the room's light is estimated and taken away."""
        calibration = read_calibration(scene / "calibration.yaml")
        raw = read_capture(scene / "capture", [light.name for light in calibration.lights], name=scene.name, use=None)
        radiance = to_radiance(raw, settle_sensor(raw, calibration, [("calibration", stated_in(calibration))]).used.sensor)
        lights, distance_m = sight.lights_of(calibration, radiance), calibration.d_object_m or 0.35
        maps = sight.grey(radiance, lights)
        rays_C, room = sight.ray_map(radiance.signal.shape[1:3], calibration.camera), sight.room(radiance)
        if room is None:
            maps = room_light.taken_away(maps, room_light.found(maps, rays_C, lights, distance_m))
        return Seen(maps, rays_C, lights, distance_m, room, np.load(scene / "truth/surface.npz")["mask"])

    def view(self) -> tuple[View, np.ndarray]:
        """The coarse view, and which of its pixels (P,) are lit."""
        image = coarse_of(self.maps, self.rays_C, factor_of(self.maps, mask.COARSE_PIXELS))
        table = LightTable.of(image, self.lights, self.distance_m)
        lit = np.sum(image.signal > LIT_SIGMAS * image.sigma, axis=0) >= 3
        return View(image, table, flats.sweep(image, table, self.distance_m)), lit


def example(scene: Path, folds: Path | None) -> list[Example]:
    """A scene taken apart as the mask does it."""
    del folds  # what is fitted here
    seen = Seen.of(scene)
    view, lit = seen.view()
    of_object = block_means(seen.true.astype(float), view.image.factor)
    planes = flats.find(view.image, view.table, view.swept, lit, seen.distance_m)
    labels, found, cost = layers.label(view, planes, lit, float(np.log(seen.distance_m)))
    return of_labels(
        scene.name, view, (labels, found.planes, cost), of_object, outline.levels_of(view.image.maps, seen.room, view.image.factor)
    )


def of_labels(
    name: str,
    view: View,
    labelled: tuple[np.ndarray, list[np.ndarray], np.ndarray],
    of_object: np.ndarray,
    levels: tuple[np.ndarray, np.ndarray | None],
) -> list[Example]:
    """The regions of a labelled view and of crops of it, by the object's share (rows, columns) of coarse pixels."""
    rng, examples = np.random.default_rng(int("".join(filter(str.isdigit, name)) or 0)), []
    for k in range(1 + CROPS):
        here = replace(view, allowed=crop(of_object > 0.5, rng) if k else None)
        w = here.window
        pictures = Pictures.of(here, *labelled)
        found = Regions.of(pictures.labels, pictures.bright)
        room = None if levels[1] is None else levels[1][w]
        examples.append(Example(name, pictures, found, of_object[w], levels[0][w], room, not k))
    return examples


def crop(true: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A window (rows, columns) that holds the object."""
    allowed = np.ones(true.shape, bool)
    for axis in (0, 1):
        held = np.flatnonzero(true.any(axis=1 - axis))
        side = true.shape[axis]
        first, last = (held[0], held[-1] + 1) if len(held) else (side // 3, 2 * side // 3)
        outside = np.ones(side, bool)
        outside[int(rng.integers(0, first + 1)) : int(rng.integers(last, side + 1))] = False
        allowed[(outside, slice(None)) if axis == 0 else (slice(None), outside)] = False
    return allowed


def fitted(clues: np.ndarray, share: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Weights (1 + clues) of least logistic loss with a ridge, by Newton's method."""
    middle, spread = clues.mean(axis=0), clues.std(axis=0) + 1e-9
    A = np.c_[np.ones(len(clues)), (clues - middle) / spread]
    ridge = np.diag([1e-6, *[RIDGE] * clues.shape[1]])
    b = np.zeros(A.shape[1])
    for _ in range(15):
        p = 1 / (1 + np.exp(-np.clip(A @ b, -30, 30)))
        h = weight * np.maximum(p * (1 - p), 1e-6)
        b = b + np.linalg.solve(A.T @ (h[:, None] * A) + ridge, A.T @ (weight * (share - p)) - ridge @ b)
    return np.r_[b[0] - np.sum(b[1:] * middle / spread), b[1:] / spread]


def odds(clues: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Odds (N,) by clues (N, clues) and weights."""
    return 1 / (1 + np.exp(-np.clip(b[0] + clues @ b[1:], -30, 30)))


def parts(examples: list[Example], count: int, rng: np.random.Generator) -> np.ndarray:
    """The part of each example, all of a scene in one."""
    names = sorted({one.name for one in examples})
    part = dict(zip(names, rng.permutation(np.arange(len(names)) % count), strict=True))
    return np.array([part[one.name] for one in examples])


def trees(names: list[str], clues: np.ndarray, share: np.ndarray, weight: np.ndarray, kind: dict[str, float]) -> background.Trees:
    """Boosted trees of least logistic loss."""
    from sklearn.ensemble import HistGradientBoostingClassifier

    twice, true = np.r_[clues, clues], np.repeat([1, 0], len(clues))
    counts = np.r_[weight * share, weight * (1 - share)]
    some = counts > 1e-6
    falling = [-1 if name in FALLING else 0 for name in names]
    model = HistGradientBoostingClassifier(monotonic_cst=falling, **COMMON, **kind)
    model.fit(twice[some], true[some], sample_weight=counts[some] * (some.sum() / counts[some].sum()))
    nodes = [one[0].nodes for one in model._predictors]  # noqa: SLF001 (it keeps them nowhere else)
    root = np.cumsum([0, *map(len, nodes[:-1])])
    every, offset = np.concatenate(nodes), np.repeat(root, [len(one) for one in nodes])
    ends = every["is_leaf"].astype(bool)
    clue = np.where(ends, -1, every["feature_idx"])
    threshold = np.where(ends, 0.0, every["num_threshold"])
    left, right = (np.where(ends, 0, every[side] + offset) for side in ("left", "right"))
    leaf = np.where(ends, every["value"], 0.0)
    start = float(model._baseline_prediction.item())  # noqa: SLF001
    return background.Trees(tuple(names), start, root, clue, threshold, left, right, leaf)


def of_trees(found: background.Trees, clues: dict[str, np.ndarray]) -> np.ndarray:
    """Odds (N,) by trees."""
    return 1 / (1 + np.exp(-np.clip(found.log_odds(clues), -30, 30)))


def judge_of(train: list[Example], rng: np.random.Generator) -> background.Judge:
    """A judge; each stage is fitted to odds that the one before gives to scenes it was not fitted to."""
    share, weight = (np.concatenate([getattr(one, name) for one in train]) for name in ("share", "weight"))
    names, part = list(train[0].own()), parts(train, INNER, rng)

    def own(some: list[Example]) -> background.Trees:
        return trees(names, *(np.concatenate([getattr(one, name) for one in some]) for name in ("clues", "share", "weight")), REGIONS)

    for k in range(INNER):
        of_rest = own([one for one, g in zip(train, part, strict=True) if g != k])
        for one, g in zip(train, part, strict=True):
            if g == k:
                one.first = of_trees(of_rest, one.own())
    about = [np.stack(list(one.beside().values()), axis=1) for one in train]
    b = fitted(np.concatenate(about), share, weight)
    beside = dict(zip(["", *train[0].beside()], map(float, b), strict=True))
    return background.Judge(own(train), beside, of_context(train, [odds(one, b) for one in about], rng))


def of_context(train: list[Example], of_regions: list[np.ndarray], rng: np.random.Generator) -> background.Trees:
    """The trees of coarse pixels by their regions' odds (N,)."""
    clues, share, weight, names = [], [], [], []
    for one, known in zip(train, of_regions, strict=True):
        here = one.in_context(known)
        if here is None:
            continue
        of_object = one.of_object.ravel()
        some = rng.permutation(np.flatnonzero(np.abs(of_object - 0.5) > CLEAR))[: SOME if one.whole else SOME // CROPS]
        names = list(here)
        clues.append(np.stack([values[some] for values in here.values()], axis=1))
        share.append((of_object[some] > 0.5).astype(float))
        weight.append(np.full(len(some), of_object.size / max(len(some), 1) / max(one.true.sum(), FEWEST)))
    return trees(names, np.concatenate(clues), np.concatenate(share), np.concatenate(weight), CONTEXT)


def by_folds(examples: list[Example], rng: np.random.Generator) -> dict[str, background.Judge]:
    """For each scene a judge that was not fitted to it."""
    part = parts(examples, FOLDS, rng)
    found: dict[str, background.Judge] = {}
    for k in range(FOLDS):
        judge = judge_of([one for one, g in zip(examples, part, strict=True) if g != k], rng)
        found |= {one.name: judge for one, g in zip(examples, part, strict=True) if g == k}
    return found


def masks_of(one: Example, judge: background.Judge) -> tuple[float, float, float]:
    """IoU of the regions, of the coarse pixels in their context, and of a perfect judge of regions."""
    by_regions = judge.of_regions(one.pictures, one.found)
    clues = one.in_context(by_regions)
    of_pixel = by_regions[one.found.number]
    if clues is not None:
        of_pixel = of_trees(judge.context, clues).reshape(one.true.shape)
    each = (by_regions[one.found.number], of_pixel, one.share[one.found.number])
    return tuple(iou(background.object_in(here > 0.5, ()), one.true) for here in each)


def iou(mine: np.ndarray, true: np.ndarray) -> float:
    """Intersection over union."""
    return float((mine & true).sum() / max((mine | true).sum(), 1))


def line_of(name: str, values: list[float]) -> str:
    """A line of figures."""
    x = np.array(values)
    shares = f">= .93 {np.mean(x >= 0.93):.0%}, < .9 {np.mean(x < WRONG):.0%}"
    return f"{name}: mean {x.mean():.3f}, median {np.median(x):.3f}, worst tenth {np.percentile(x, 10):.3f}, {shares}"


def report(examples: list[Example], folds: Path | None = None) -> None:
    """Write the trees and the judges by folds, print weights and figures."""
    left_out = by_folds(examples, np.random.default_rng(0))
    if folds is not None:
        folds.write_bytes(pickle.dumps(left_out))
    for kind, some in (("whole", [one for one in examples if one.whole]), ("crops", [one for one in examples if not one.whole])):
        found = np.array([masks_of(one, left_out[one.name]) for one in some])
        for name, values in zip(("regions", "coarse pixels in context", "a perfect judge of the regions"), found.T, strict=True):
            print(line_of(f"{kind}, {len(some)}: IoU of {name}, scenes left out", list(values)))
    judge = judge_of(examples, np.random.default_rng(0))
    np.savez_compressed(background.FITTED, **judge.own.arrays("regions"), **judge.context.arrays("context"))
    print("BESIDE = {")
    for key, value in judge.beside.items():
        print(f'    "{key}": {value:.3g},')
    print("}")


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

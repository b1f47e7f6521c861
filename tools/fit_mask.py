"""Fit the weights by which the automatic mask judges the object's regions: ``python tools/fit_mask.py SCENES... [--jobs N] [--on ENGINE]``.

SCENES are folders with calibration.yaml, capture/ and truth/surface.npz (a `mask`); without an ambient image the room's light is
estimated, as the mask does it. Prints the weights for lpcal.surface.background (OWN and BESIDE); cross-validated by scene in FOLDS parts,
how good the coarse masks are with the weights as they stand and with the fitted ones. The regions themselves depend a little on the
weights: run it until these stand still; then tools/fit_outline.py.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, field, replace
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
from lpcal.surface import background, flats, layers, mask, regions, room_light, sight
from lpcal.surface.coarse import LightTable, coarse_of, factor_of
from lpcal.surface.regions import Pictures, Regions, View

FOLDS, INNER = 6, 5
RIDGE = 0.3
"""Penalty on the square of a weight of a clue of standard deviation 1, by the loss of scenes left out, which is flat from .1 to .3."""
CROPS = 2
"""Crops of a scene that are fitted to besides the whole, so that the object lies anywhere in the picture."""
WRONG = 0.9
"""IoU under which a mask is wrong."""
SMALLEST = 3
"""Coarse pixels under which a region is not fitted to."""


@dataclass
class Example:
    """A scene's regions with their truth."""

    name: str
    pictures: Pictures
    found: Regions
    true: np.ndarray
    """(rows, columns) bool."""
    now: np.ndarray
    """(rows, columns) the mask by the weights as they stand."""
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
        self.clues = np.stack(list(regions.own(self.pictures, self.found).values()), axis=1)

    def beside(self) -> np.ndarray:
        """The clues (N, clues) with those about it, by the first odds."""
        return np.stack(list(regions.beside(self.pictures, self.found, background.logit(self.first)).values()), axis=1)


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
        lit = np.sum(image.signal > mask.LIT_SIGMAS * image.sigma, axis=0) >= 3
        return View(image, table, flats.sweep(image, table, self.distance_m)), lit


def example(scene: Path) -> list[Example]:
    """A scene taken apart as the mask does it."""
    seen = Seen.of(scene)
    view, lit = seen.view()
    true = block_means(seen.true.astype(float), view.image.factor) > 0.5
    planes = flats.find(view.image, view.table, view.swept, lit, seen.distance_m)
    return of_view(scene.name, view, planes, lit, seen.distance_m, true)


def of_view(name: str, view: View, planes: list[np.ndarray], lit: np.ndarray, distance_m: float, true: np.ndarray) -> list[Example]:
    """The regions of a view and of crops of it; true (rows, columns)."""
    labels, found, cost = layers.label(view, planes, lit, float(np.log(distance_m)))
    now = background.judged(view, labels, found.planes, cost).mask
    rng, examples = np.random.default_rng(int("".join(filter(str.isdigit, name)) or 0)), []
    for k in range(1 + CROPS):
        here = replace(view, allowed=crop(true, rng) if k else None)
        w = here.window
        pictures = Pictures.of(here, labels, found.planes, cost)
        examples.append(Example(name, pictures, Regions.of(pictures.labels, pictures.bright), true[w], now[w], not k))
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
    """Odds (N,) by weights."""
    return 1 / (1 + np.exp(-np.clip(b[0] + clues @ b[1:], -30, 30)))


def parts(examples: list[Example], count: int, rng: np.random.Generator) -> np.ndarray:
    """The part of each example, all of a scene in one."""
    names = sorted({one.name for one in examples})
    part = dict(zip(names, rng.permutation(np.arange(len(names)) % count), strict=True))
    return np.array([part[one.name] for one in examples])


def stacked(train: list[Example], rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Both lines' weights; the second is fitted to odds that the first gives to scenes it was not fitted to."""
    share, weight = (np.concatenate([getattr(one, name) for one in train]) for name in ("share", "weight"))
    part = parts(train, INNER, rng)
    for k in range(INNER):
        some = [one for one, g in zip(train, part, strict=True) if g != k]
        b = fitted(*(np.concatenate([getattr(one, name) for one in some]) for name in ("clues", "share", "weight")))
        for one, g in zip(train, part, strict=True):
            if g == k:
                one.first = odds(one.clues, b)
    second = fitted(np.concatenate([one.beside() for one in train]), share, weight)
    return fitted(np.concatenate([one.clues for one in train]), share, weight), second


def iou(mine: np.ndarray, true: np.ndarray) -> float:
    """Intersection over union."""
    return float((mine & true).sum() / max((mine | true).sum(), 1))


def validated(examples: list[Example], rng: np.random.Generator) -> tuple[list[float], list[float]]:
    """IoU of each scene by weights fitted to others, and the loss."""
    part, found, loss = parts(examples, FOLDS, rng), [0.0] * len(examples), [0.0] * len(examples)
    for k in range(FOLDS):
        first, second = stacked([one for one, g in zip(examples, part, strict=True) if g != k], rng)
        for i in np.flatnonzero(part == k):
            one = examples[i]
            one.first = odds(one.clues, first)
            p = odds(one.beside(), second)
            q = background.object_in(p[one.found.number] > 0.5, ())
            found[i] = iou(q, one.true)
            sure = np.clip(p, 1e-3, 1 - 1e-3)
            loss[i] = -float(np.sum(one.weight * (one.share * np.log(sure) + (1 - one.share) * np.log(1 - sure))))
    return found, loss


def line_of(name: str, values: list[float]) -> str:
    """A line of figures."""
    x = np.array(values)
    shares = f">= .93 {np.mean(x >= 0.93):.0%}, < .9 {np.mean(x < WRONG):.0%}"
    return f"{name}: mean {x.mean():.3f}, median {np.median(x):.3f}, worst tenth {np.percentile(x, 10):.3f}, {shares}"


def report(examples: list[Example]) -> None:
    """Print weights and figures."""
    rng = np.random.default_rng(0)
    runs = [validated(examples, rng) for _ in range(3)]
    found, loss = (np.mean([run[k] for run in runs], axis=0) for k in range(2))
    whole = np.array([one.whole for one in examples])
    for kind, some in (("whole", whole), ("crops", ~whole)):
        print(f"{kind}: {some.sum()}")
        print(
            line_of(
                "  IoU with the weights as they stand", [iou(one.now, one.true) for one, here in zip(examples, some, strict=True) if here]
            )
        )
        print(line_of("  IoU with fitted weights, scenes left out", list(found[some])), f"; loss {loss[some].mean():.4f}")
    first, second = stacked(examples, rng)
    one = examples[0]
    for name, b, clues in (
        ("OWN", first, regions.own(one.pictures, one.found)),
        ("BESIDE", second, regions.beside(one.pictures, one.found, one.first)),
    ):
        print(f"{name} = {{")
        for key, value in zip(["", *clues], b, strict=True):
            print(f'    "{key}": {value:.3g},')
        print("}")


def of_scenes[T](description: str | None, example: Callable[[Path], T]) -> list[T]:
    """The examples of the scenes that the command line names, on the engine that it asks for."""
    words = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="+", type=Path)
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--on", default="processes")
    given = words.parse_args()
    with engine_of(given.on, given.jobs, Path()).start() as pool:
        return list(pool.map(example, given.scenes))


if __name__ == "__main__":
    report(list(chain.from_iterable(of_scenes(__doc__, example))))

"""Fit the weights by which the automatic mask's outline is judged: ``python tools/fit_outline.py SCENES... --folds FILE [--jobs N]``.

SCENES are folders as tools/fit_mask.py reads them, and FILE is what it has written of networks that were not fitted to them; scenes that
are not in it are judged as lpcal does. Prints WITH_ROOM and WITHOUT_ROOM of lpcal.segmentation.outline, and DOUBTED and DOUBT_POWER of
lpcal.segmentation.mask; and how good the masks are, coarse and in full size. Each scale's clues depend on the weights before it: run it
until these stand still. Scenes whose regions are judged so wrong that there is no outline to draw are not fitted to.
"""

from __future__ import annotations

import pickle
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import optimize

from fit_mask import WRONG, Seen, iou, line_of, of_scenes
from lpcal.geometry.raster import block_means
from lpcal.segmentation import background, cut, flats, layers, mask, outline
from lpcal.view.network import Network

RIDGE = 1e-3
"""Penalty on the square of a weight, by a mean weight of 1 for pixels: pixels are many, it keeps the equations solvable."""
SOME = 3000
"""Pixels of a scale that are fitted to at most, spread over its band: neighbours say the same."""
CLEAR = 0.3
"""Share of a pixel on either side that must be its lesser one's at most, for it to be fitted to."""
FEWEST = 50
"""Pixels that an object counts as at least."""
DRAWABLE = 0.85
"""IoU of a coarse mask from which its outline is fitted to."""


@dataclass(frozen=True)
class Clues:
    """Pixels' clues and what they are."""

    names: tuple[str, ...]
    values: np.ndarray
    """(N, clues)."""
    true: np.ndarray
    """(N,) bool."""

    @staticmethod
    def of(values: Mapping[str, np.ndarray], share: np.ndarray, rng: np.random.Generator) -> Clues:
        """From clues (N,) and the share (N,) of a pixel that is the object."""
        clear = np.flatnonzero(np.abs(share - 0.5) > CLEAR)
        some = rng.permutation(clear)[:SOME]
        return Clues(tuple(values), np.stack(list(values.values()), axis=1)[some], share[some] > 0.5)


@dataclass(frozen=True)
class Example:
    """A scene."""

    name: str
    outline: list[Clues]
    room: bool
    masks: tuple[float, float]
    """IoU of the coarse pixels and in full size."""
    expected_wrong: float


def example(scene: Path, network: Network | None = None) -> Example:
    """A scene's clues, along the way that the mask takes with its weights as they stand."""
    seen, rng = Seen.of(scene), np.random.default_rng(0)
    view, lit = seen.view()
    image = view.image
    planes = flats.find(image, view.table, view.swept, lit, seen.distance_m)
    labels, found, cost = layers.label(view, planes, lit, float(np.log(seen.distance_m)))
    share = block_means(seen.true.astype(float), image.factor)
    judged = background.judged(view, labels, found.planes, cost, network)
    coarse = iou(judged.mask, share > 0.5)
    of_outline, fine = [], 0.0
    if judged.mask.any():
        at = view.swept.u[np.argmin(np.median(view.swept.cost[:, judged.mask.ravel()], axis=1))]
        log_odds = background.logit(judged.odds.ravel()).reshape(image.shape)
        apart = outline.Apart(judged.mask, labels, found, image, view.table, float(at), log_odds)
        here, weights = judged.mask, outline.WITHOUT_ROOM if seen.room is None else outline.WITH_ROOM
        for before, factor in outline.factors(image.factor):
            level = outline.asked(apart, seen.maps, seen.rays_C, seen.room, here, before, factor)
            of_outline.append(Clues.of(level.clues, block_means(seen.true.astype(float), factor)[level.band], rng))
            here = level.drawn(weights)
        fine = iou(mask.tidy(cut.halfway(here, seen.maps.signal, seen.maps.sigma)), seen.true)
    return Example(
        scene.name,
        of_outline if coarse >= DRAWABLE else [],
        seen.room is not None,
        (coarse, fine),
        background.doubt_of(judged, labels).share if judged.mask.any() else 1.0,
    )


def left_out(scene: Path, folds: Path | None) -> Example:
    """A scene's clues by the network that was not fitted to it."""
    networks = {} if folds is None else pickle.loads(folds.read_bytes())
    return example(scene, networks.get(scene.name))


def fitted(some: Sequence[Clues]) -> np.ndarray:
    """Weights (clues,) of least logistic loss with a ridge, by Newton's method; a pixel counts as its share of the object, as in an IoU."""
    A, true = np.concatenate([one.values for one in some]), np.concatenate([one.true for one in some])
    weight = np.concatenate([np.full(len(one.true), 1 / max(int(one.true.sum()), FEWEST)) for one in some])
    weight /= weight.sum()
    b = np.zeros(A.shape[1])
    for _ in range(25):
        p = 1 / (1 + np.exp(-np.clip(A @ b, -30, 30)))
        slope = A.T @ (weight * (p - true)) + RIDGE * b
        b = b - np.linalg.solve((A * (weight * p * (1 - p))[:, None]).T @ A + RIDGE * np.eye(len(b)), slope)
    return b


def doubted(expected: np.ndarray, bad: np.ndarray) -> tuple[float, float]:
    """DOUBTED and DOUBT_POWER of the odds ``1 / (1 + (DOUBTED / expected)^DOUBT_POWER)`` that a mask is `bad`; a power near 2 is likely."""
    log_share = np.log(np.maximum(expected, 1e-3))

    def cost(x: np.ndarray) -> float:
        at = np.exp(x[1]) * (log_share - x[0])
        return float(np.sum(np.logaddexp(0, np.where(bad, -at, at))) + 0.5 * ((x[1] - np.log(2)) / 0.5) ** 2)

    x = optimize.minimize(cost, [np.log(0.2), np.log(2)], method="Nelder-Mead").x
    return float(np.exp(x[0])), float(np.exp(x[1]))


def printed(name: str, some: Sequence[Clues]) -> None:
    """Print weights."""
    if some:
        print(f"{name} = {{{', '.join(f'"{key}": {value:.3g}' for key, value in zip(some[0].names, fitted(some), strict=True))}}}")


def report(examples: Sequence[Example]) -> None:
    """Print weights and figures."""
    for k, name in enumerate(("coarse pixels", "full size")):
        print(line_of(f"IoU with the weights as they stand, {name}", [one.masks[k] for one in examples]))
    for name, room in (("WITH_ROOM", True), ("WITHOUT_ROOM", False)):
        printed(name, [clues for one in examples if one.room == room for clues in one.outline if len(clues.true)])
    expected, bad = np.array([one.expected_wrong for one in examples]), np.array([one.masks[1] < WRONG for one in examples])
    at, power = doubted(expected, bad)
    print(f"DOUBTED, DOUBT_POWER = {at:.2f}, {power:.1f}")
    for share in (0.04, 0.06, 0.08, 0.1, 0.12, 0.15, 0.2):
        stated = [float(np.mean(expected[some] > share)) for some in (bad, ~bad)]
        print(f"  expected wrong over {share}: of the wrong {stated[0]:.2f}, of the right {stated[1]:.2f}")


if __name__ == "__main__":
    report(of_scenes(__doc__, left_out)[0])

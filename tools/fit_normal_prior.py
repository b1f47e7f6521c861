"""Fit the network that expects normals: ``python tools/fit_normal_prior.py SCENES... [--jobs N] [--on ENGINE] [--keep FILE] [--out FILE]``.

SCENES are folders with calibration.yaml, capture/ and truth/surface.npz (`mask`, `normals`). Each is reconstructed with its automatic
mask, of many lights once more by every second or third; what the rounds have settled, as surface.normal_prior sees it, stands beside the
true normals. Writes the weights that
lpcal.surface reads, or FILE. Printed: for scenes left out of a first fit, the last LEFT_OUT, the mean angle of normals before and after.
``--keep`` writes what was taken from the scenes, or reads it where the file is there; ``--held-out`` writes the first fit, by which
tools/fit_normal_sigma.py is to be run on those scenes. Needs PyTorch (``uv run --with torch``); with OMP_NUM_THREADS=1 where other work
shares the machine.

The loss is the mean angle (of chords) between normals, and, apart from it, minus the logarithm of the likelihood of these angles by the
stated standard deviations: Student's distribution, as errors of normals have heavy tails.
"""

from __future__ import annotations

import argparse
import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np

from fit_mask import by_some
from lpcal.api import surfaces
from lpcal.api.engines import engine_of
from lpcal.errors import LpcalError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.capture import read_capture
from lpcal.surface import normal_prior
from lpcal.surface.rounds import Scene, State
from lpcal.view import network
from lpcal.view.network import Network

LEFT_OUT = 70
"""Scenes that the first fit does not see."""
EPOCHS, BATCH, SIDE = 64, 8, 72
"""Times that all scenes are seen, scenes a step, and blocks a side of the window that a step sees of each."""
RATE, DECAY = 4e-3, 1e-2
"""Highest step of the one-cycle schedule (Smith and Topin 2018), and the decay of weights (AdamW)."""
WIDTHS = (16, 32, 48, 64, 16)
"""Channels of the four scales, and of the last one."""
NOISE, OFFSET = 0.03, 0.1
"""Standard deviations, in those of a channel, of noise added to blocks and to whole channels: of what scenes do not vary."""
FREEDOM = 4.0
"""Degrees of freedom of Student's distribution."""
ANGLE = 40.0
"""Weight of the mean angle, radians, beside the logarithm of the likelihood."""
BEGIN = -2.5
"""Natural logarithm of the standard deviation, in radians, that the fit begins with: that of most normals."""
FEWEST = 60
"""Blocks that an object counts as at least."""
HALF = 0.3
"""Length of a block's mean normal under which its pixels face too many ways for it to have one."""


@dataclass(frozen=True)
class Example:
    """A scene's channels with its true normals."""

    name: str
    whole: bool
    """Whether by all of its lights."""
    channels: dict[str, np.ndarray]
    """(rows, columns) each."""
    true: np.ndarray
    """(3, rows, columns) about the blocks' rays."""
    weight: np.ndarray
    """(rows, columns) share of each block that counts."""

    @property
    def normals(self) -> np.ndarray:
        """(3, rows, columns) those that are to be turned."""
        return normal_prior.unit(np.stack([self.channels[f"normal {axis}"] for axis in "xyz"]))


def examples_of(scene: Path) -> list[Example]:
    """What the network sees of a scene by all its lights and by some."""
    calibration = read_calibration(scene / "calibration.yaml")
    return [one for some in by_some(len(calibration.lights)) for one in example(scene, some)]


def example(scene: Path, some: slice = slice(None)) -> list[Example]:
    """What the network sees of a scene by some of its lights; nothing where it has no surface."""
    with np.load(scene / "truth/surface.npz") as stored:
        truth = np.where(stored["mask"][..., None], stored["normals"], np.nan).astype(float)
    seen: list[Example] = []
    plain = normal_prior.expected

    def heard(whole: Scene, state: State) -> tuple[np.ndarray, np.ndarray]:
        true, part = truth[whole.seen.mask], whole.closely()
        side = normal_prior.factor_of(part.seen.pixels)
        about = normal_prior.about_rays(part.seen.rays_C, np.nan_to_num(true))
        known = np.isfinite(true).all(axis=1).astype(float)
        named = dict(zip("xyz", about.T, strict=True)) | {"known": known}
        found, of = normal_prior.features(part, state), normal_prior.maps(named, part.seen.mask, side)
        mean = np.stack([of[axis] for axis in "xyz"])
        weight = np.where((of["known"] > 0.5) & (np.linalg.norm(mean, axis=0) > HALF), of["known"] * of["share"], 0.0)
        seen.append(
            Example(scene.name, some == slice(None), {k: v.astype(np.float32) for k, v in found.items()}, normal_prior.unit(mean), weight)
        )
        return plain(whole, state)

    normal_prior.expected = heard
    try:
        calibration = read_calibration(scene / "calibration.yaml")
        names = [light.name for light in calibration.lights]
        surfaces.reconstruct(read_capture(scene / "capture", names, use=names[some]), calibration)
    except LpcalError as error:
        print(f"{scene.name}: {error}")
    finally:
        normal_prior.expected = plain
    return seen[-1:]


def placed(example: Example, x: np.ndarray, mirrored: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Channels x, normals to be turned, true ones and weights of a window of a scene (or of its mirror image) somewhere in it."""
    parts = [x, example.normals, example.true, example.weight[None]]
    if rng.random() < 0.5:
        flip = np.array([-1, 1, 1])[:, None, None]
        signs = (mirrored[:, None, None], flip, flip, 1)
        parts = [sign * part[..., ::-1] for sign, part in zip(signs, parts, strict=True)]
    from_, to = [slice(None)], [slice(None)]
    for side in parts[0].shape[1:]:
        first = int(rng.integers(0, max(side - SIDE, 0) + 1))
        begin = int(rng.integers(0, max(SIDE - side, 0) + 1))
        from_.append(slice(first, first + SIDE))
        to.append(slice(begin, begin + min(side, SIDE)))
    found = [np.zeros((len(part), SIDE, SIDE), np.float32) for part in parts]
    for window, part in zip(found, parts, strict=True):
        window[tuple(to)] = part[tuple(from_)]
    return tuple(found)


def channels_of(one: Example, names: Sequence[str], middle: np.ndarray, spread: np.ndarray) -> np.ndarray:
    """The channels and places of a scene as the network takes them."""
    inside = one.channels["share"] > 0
    x = np.stack([one.channels[name] for name in names])
    x = np.clip((x - middle[:, None, None]) / spread[:, None, None], -network.FURTHEST, network.FURTHEST)
    return np.asarray(np.concatenate([x, network.places(*inside.shape)]) * inside, np.float32)


def fitted(train: Sequence[Example], seed: int = 0) -> dict[str, np.ndarray]:
    """What a file keeps of the network of least loss over examples, by PyTorch."""
    import torch
    from torch.nn import functional

    from unet import Unet, arrays

    torch.manual_seed(seed)
    names, rng = list(train[0].channels), np.random.default_rng(seed)
    inside = [one.channels["share"] > 0.5 for one in train]
    some = [np.stack([one.channels[name][at] for name in names])[:, ::7] for one, at in zip(train, inside, strict=True)]
    middle, spread = np.concatenate(some, axis=1).mean(axis=1), np.concatenate(some, axis=1).std(axis=1) + 1e-3
    x_of = [channels_of(one, names, middle, spread) for one in train]
    mirrored = np.where(np.isin([*names, "down", "aside"], normal_prior.MIRRORED), -1, 1)
    net, each = Unet(len(names), WIDTHS, 4), len(train) // BATCH
    with torch.no_grad():
        net.out.bias[3] += BEGIN
    optimizer = torch.optim.AdamW(net.parameters(), lr=RATE, weight_decay=DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=EPOCHS * each, pct_start=0.15)
    for _ in range(EPOCHS):
        for batch in rng.permutation(len(train))[: each * BATCH].reshape(each, BATCH):
            drawn = [placed(train[k], x_of[k], mirrored, rng) for k in batch]
            x, begin, true, weight = (np.stack(part) for part in zip(*drawn, strict=True))
            counted = (x != 0).any(axis=1, keepdims=True)
            noise = OFFSET * rng.standard_normal((*x.shape[:2], 1, 1)) + NOISE * rng.standard_normal(x.shape)
            answer = net(torch.from_numpy((x + counted * noise).astype(np.float32)))
            n = functional.normalize(torch.from_numpy(begin) + answer[:, :3], dim=1)
            log_sigma = answer[:, 3].clamp(*normal_prior.LOG_SIGMA)
            share = torch.from_numpy(weight[:, 0])
            share = share / share.sum((1, 2), keepdim=True).clamp(min=FEWEST)
            square = ((n - torch.from_numpy(true)) ** 2).sum(1)
            unlikely = (FREEDOM + 2) / 2 * torch.log1p(square.detach() / (FREEDOM * torch.exp(2 * log_sigma))) + 2 * log_sigma
            optimizer.zero_grad()
            ((unlikely + ANGLE * torch.sqrt(square + 1e-4)) * share).sum((1, 2)).mean().backward()
            torch.nn.utils.clip_grad_norm_(net.parameters(), 2.0)
            optimizer.step()
            schedule.step()
    return arrays(net, names, normal_prior.MIRRORED, middle, spread)


def angles_deg(one: Example, net: Network | None) -> float:
    """Mean angle between a scene's normals and the true ones, of those that a network expects, or as they were."""
    n = one.normals if net is None else normal_prior.answer(net, one.channels, one.normals)[0]
    angle = np.degrees(np.arccos(np.clip(np.sum(n * one.true, axis=0), -1, 1)))
    return float((angle * one.weight).sum() / max(one.weight.sum(), 1e-9))


def report(examples: Sequence[Example], out: Path, held_out: Path | None) -> None:
    """Print what a fit without some scenes does for these, and write the fit to all."""
    left = sorted({one.name for one in examples})[-LEFT_OUT:]
    first = fitted([one for one in examples if one.name not in left])
    if held_out is not None:
        np.savez_compressed(held_out, **first)
    net, some = Network.of(first), [one for one in examples if one.name in left and one.whole]
    for what, judge in (("as they were", None), ("as expected", net)):
        x = np.array([angles_deg(one, judge) for one in some])
        figures = f"mean {x.mean():.2f}, worst tenth {np.percentile(x, 90):.2f}, over 6: {np.sum(x > 6)}"
        print(f"{len(x)} scenes left out, normals {what}, degrees: {figures}")
    np.savez_compressed(out, **fitted(examples))


def main() -> None:
    """Take what is needed of scenes, and fit."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="*", type=Path)
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--on", default="processes")
    words.add_argument("--keep", type=Path)
    words.add_argument("--held-out", type=Path)
    words.add_argument("--out", type=Path, default=normal_prior.FITTED)
    given = words.parse_args()
    if given.keep is not None and given.keep.exists():
        examples = pickle.loads(given.keep.read_bytes())
    else:
        with engine_of(given.on, given.jobs, Path()).start() as pool:
            examples = list(chain.from_iterable(pool.map(examples_of, given.scenes)))
        if given.keep is not None:
            given.keep.write_bytes(pickle.dumps(examples))
    report(examples, given.out, given.held_out)


if __name__ == "__main__":
    main()

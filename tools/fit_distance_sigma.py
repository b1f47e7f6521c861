"""Fit what the light's model lacks in a piece's distance: ``python tools/fit_distance_sigma.py SCENES RESULTS [SCENES RESULTS ...]``.

SCENES are folders of simulated scenes (calibration.yaml, truth/surface.npz each), RESULTS the folders that tools/bench_scenes.py wrote of
them. Every piece's error of distance is held against its `scale_std`, whose part by the calibration is taken as it is; the rest is
stretched by the factor of greatest likelihood. Prints the factor, and by how many standard deviations the pieces are off with and without
it: OPEN and HIDDEN of lpcal.surface.uncertainty are to be multiplied by it until it is 1. Then BROKEN_OFF, from the pieces that are not the
largest; and of those that stand APART or more from what they border on, by their share of the object, how often the distance at which they
touch it is nearer to the truth than their own, and how near it is then (SMALL, TOUCHES and TOUCH_STD of lpcal.surface.components).
"""

from __future__ import annotations

import argparse
import json
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy import optimize

from lpcal.formats.calibration_yaml import read_calibration
from lpcal.surface import uncertainty
from lpcal.surface.components import BORDER, steps_to_larger
from lpcal.surface.integrate import Grid

LEAST = 0.02
"""Share of a scene's pixels under which a piece does not count."""
APART = 0.1
"""Natural logarithm of a ratio of depths from which two pieces stand apart."""
SHARES = (0.0, 0.06, 0.12, 0.25, 1.0)
"""Bounds of the classes of pieces by their share of the object."""
FAILED = 0.12
"""Error of a log distance at which it is cut: more is a failure of the mask or of the search, not of a sigma."""


def pieces(scene: Path, result: Path) -> list[tuple[float, float, float, float]]:
    """Error of the log distance, `scale_std` but for BROKEN_OFF, its part by the calibration, log distance from the largest piece."""
    lights = read_calibration(scene / "calibration.yaml").lights
    true, found = np.load(scene / "truth/surface.npz"), np.load(result / "surface.npz")
    both = found["mask"] & true["mask"] & np.isfinite(found["depth"]) & (true["depth"] > 0)
    rows = []
    components = json.loads((result / "summary.json").read_text())["components"]
    for one in components:
        inside = both & (found["component"] == one["label"])
        if inside.sum() >= LEAST * both.sum():
            error = float(np.median(np.log(true["depth"][inside] / found["depth"][inside])))
            calibration = uncertainty.scale_std(lights, np.inf, one["mean_depth_m"], 0.0)
            gap = float(np.log(one["mean_depth_m"] / components[0]["mean_depth_m"]))
            std = float(np.sqrt(max(one["scale_std"] ** 2 - (uncertainty.BROKEN_OFF * gap) ** 2, calibration**2)))
            rows.append((error, std, calibration, gap))
    return rows


def touching(scene: Path, result: Path) -> list[tuple[float, float, float]]:
    """Of each piece that stands apart: its share of the object, the errors of its log distance as it is and where it would touch others.

    Errors are relative to the largest piece's.
    """
    true, found = np.load(scene / "truth/surface.npz"), np.load(result / "surface.npz")
    mask = found["mask"] & np.isfinite(found["depth"])
    grid, u, label = Grid.of(mask), np.log(found["depth"][mask].astype(float)), found["component"][mask].astype(int)
    known = true["mask"][mask] & (true["depth"][mask] > 0)
    error = u - np.log(np.where(known, true["depth"][mask], 1.0))
    rows = []
    for one in range(2, int(label.max()) + 1):
        inside = known & (label == one)
        step, _ = steps_to_larger(grid.a, grid.b, u, label, one)
        if len(step) >= BORDER and inside.sum() >= LEAST * known.sum() and abs(apart := float(np.median(step))) >= APART:
            off = float(np.median(error[inside]) - np.median(error[known & (label == 1)]))
            rows.append((float(inside.sum() / known.sum()), off, off - apart))
    return rows


def factor_of(error: np.ndarray, stated: np.ndarray, calibration: np.ndarray) -> float:
    """The factor on the part not by the calibration under which errors (N,) are likeliest, each being Gaussian."""
    rest = stated**2 - calibration**2

    def cost(log_factor: float) -> float:
        variance = calibration**2 + np.exp(2 * log_factor) * rest
        return float(np.sum(np.log(variance) + np.clip(error, -FAILED, FAILED) ** 2 / variance))

    return float(np.exp(optimize.minimize_scalar(cost, bounds=(-2, 2), method="bounded").x))


def broken_off(error: np.ndarray, stated: np.ndarray, gap: np.ndarray) -> float:
    """Share of the gap (N,) to the largest piece that makes errors (N,) of the others likeliest together with what is stated of them."""

    def cost(log_share: float) -> float:
        variance = stated**2 + (np.exp(log_share) * gap) ** 2
        return float(np.sum(np.log(variance) + error**2 / variance))

    return float(np.exp(optimize.minimize_scalar(cost, bounds=(-5, 1), method="bounded").x))


def main() -> None:
    """Read, fit, print."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("folders", nargs="+", type=Path, help="SCENES RESULTS, as often as you like")
    given = words.parse_args().folders
    known = [
        (scene, results / scene.name) for scenes, results in zip(given[::2], given[1::2], strict=True) for scene in sorted(scenes.iterdir())
    ]
    rows = np.array([row for scene, result in known if (result / "surface.npz").exists() for row in pieces(scene, result)])
    error, stated, calibration, gap = rows.T
    factor = factor_of(error, stated, calibration)
    print(f"{len(rows)} pieces; factor {factor:.2f}")
    for name, sigma in (("as stated", stated), ("with the factor", np.sqrt(calibration**2 + factor**2 * (stated**2 - calibration**2)))):
        off = np.abs(error) / sigma
        rms = np.sqrt(np.mean(np.clip(error, -FAILED, FAILED) ** 2 / sigma**2))
        print(f"{name}: off by {rms:.2f} sigma rms, {np.median(off):.2f} median; median sigma {np.median(sigma):.4f}")
        print(f"  over 3 sigma {np.mean(off > 3):.1%}, over 4 {np.mean(off > 4):.1%}")
    others = gap != 0
    print(f"BROKEN_OFF {broken_off(error[others], stated[others], gap[others]):.2f}, of {others.sum()} pieces")
    apart = np.array([row for scene, result in known if (result / "surface.npz").exists() for row in touching(scene, result)]).reshape(
        -1, 3
    )
    for low, high in pairwise(SHARES):
        share, own, touch = apart[(apart[:, 0] >= low) & (apart[:, 0] < high)].T
        nearer = np.abs(touch) < np.abs(own)
        off = np.median(np.abs(touch[nearer])) if nearer.any() else np.nan
        print(f"apart, {low:.2f} to {high:.2f} of the object: {len(share)}; nearer touching {nearer.sum()}, off by {off:.3f} median then")


if __name__ == "__main__":
    main()

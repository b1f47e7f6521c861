"""Fit what the light's model lacks in a piece's distance: ``python tools/fit_distance_sigma.py SCENES RESULTS [SCENES RESULTS ...]``.

SCENES are folders of simulated scenes (calibration.yaml, truth/surface.npz each), RESULTS the folders that tools/bench_scenes.py wrote of
them. Every piece's error of distance is held against its `scale_std`, whose part by the calibration is taken as it is; the rest is
stretched by the factor of greatest likelihood. Prints the factor, and by how many standard deviations the pieces are off with and without
it: NEARBY of lpcal.surface.distance_search is to be divided by its square until it is 1. Then BROKEN_OFF, from the pieces that are not the
largest.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np
from scipy import optimize

from lpcal.formats.calibration_yaml import read_calibration
from lpcal.surface import uncertainty

LEAST = 0.02
"""Share of a scene's pixels under which a piece does not count."""
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


if __name__ == "__main__":
    main()

"""The light stage by itself, on scenes that know more than the model: ``python tools/bench_lights.py [SCENES]``.

Prints, for 1 to 4 chrome spheres, the rms error of the sources, NEES across the axis (2 expected) and the time of a solve; then how many
planted joint clicks are named, and how many falsely.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
from lpcal.chain.refine_lights.clicks import fit_with_clicks
from lpcal.chain.refine_lights.geometry_fit import fit_geometry
from lpcal.chain.refine_lights.measure import measure_centre
from test_lights_geometry import CAMERA, DRAWN, Scene

NAMES = [wing.name for wing in DRAWN]


def geometry(scenes: int) -> None:
    """Errors and NEES by the number of chrome spheres."""
    print("spheres   source rms mm   NEES of 2   s a solve")
    for count in (1, 2, 3, 4):
        errors, nees, begun = [], [], time.perf_counter()
        for seed in range(scenes):
            scene = Scene(1000 + seed, count)
            fit = fit_geometry(NAMES, scene.views, [measure_centre(view, CAMERA) for view in scene.views], CAMERA, scene.wings)
            gap = fit.source_C - scene.source_C
            errors.append(gap)
            nees += [
                gap[k, :2] @ np.linalg.solve(fit.source_covariance[3 * k : 3 * k + 2, 3 * k : 3 * k + 2], gap[k, :2])
                for k in range(len(NAMES))
            ]
        spent = (time.perf_counter() - begun) / scenes
        print(f"{count:7d} {1e3 * np.sqrt(np.mean(np.square(errors))):15.2f} {np.mean(nees):11.2f} {spent:11.2f}")


def clicks(scenes: int) -> None:
    """Planted clicks found and named, and falsely found."""
    found = falsely = planted = 0
    for seed in range(scenes):
        row, step = seed % 6, 1 if seed % 2 else -1
        scene = Scene(2000 + seed, 4, {row: step} if seed % 2 == 0 or seed % 3 == 0 else None)
        expected = {(f"L{row}", 30 + 10 * step)} if seed % 2 == 0 or seed % 3 == 0 else set()
        _, _, named = fit_with_clicks(NAMES, scene.views, [measure_centre(view, CAMERA) for view in scene.views], CAMERA, scene.wings)
        said = {(click.name, round(float(np.degrees(click.found_rad)))) for click in named}
        planted, found, falsely = planted + len(expected), found + len(said & expected), falsely + len(said - expected)
    print(f"clicks under 4 chrome spheres: {found} of {planted} planted named, {falsely} falsely, in {scenes} scenes")


def main(words: list[str]) -> None:
    """Run both."""
    scenes = int(words[0]) if words else 30
    geometry(scenes)
    clicks(scenes)


if __name__ == "__main__":
    main(sys.argv[1:])

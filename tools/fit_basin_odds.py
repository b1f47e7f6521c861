"""Fit the odds of the distances that the light allows: ``python tools/fit_basin_odds.py SCENES... [--jobs N]``.

SCENES are folders with calibration.yaml, capture/ and truth/surface.npz (``mask``, ``depth``); those without an ambient image are passed
over. The distance minima of each (lpcal.surface.distance_search) are found with the true mask; INDEPENDENT is the value under which the
right ones are likeliest, with WORKING as it stands and for some others beside it. A scene without a right minimum does not count.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from scipy import optimize

from lpcal.api.curve import settle_sensor
from lpcal.api.sensor import stated_in
from lpcal.detect.radiometry import to_radiance
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.capture import read_capture
from lpcal.surface import distance_search
from lpcal.view import pixel_list

RIGHT = 0.1
"""Difference of log distances within which a basin is the right one."""
TRIED = (0.1, 0.2, 0.3, 0.5, 10.0)
"""Values of WORKING that are tried; the last is as good as no prior."""


def ends_of(scene: Path) -> tuple[distance_search.DistanceMinima, float] | None:
    """The basins and the true log distance."""
    calibration = read_calibration(scene / "calibration.yaml")
    raw = read_capture(scene / "capture", [light.name for light in calibration.lights], name=scene.name, use=None)
    radiance = to_radiance(raw, settle_sensor(raw, calibration, [("calibration", stated_in(calibration))]).used.sensor)
    if pixel_list.room(radiance) is None or calibration.d_object_m is None:
        return None
    lights, true = pixel_list.lights_of(calibration, radiance), np.load(scene / "truth/surface.npz")
    mask, rays_C = true["mask"].astype(bool), pixel_list.ray_map(radiance.signal.shape[1:3], calibration.camera)
    found = distance_search.search(pixel_list.grey(radiance, lights), rays_C, mask, lights, calibration.d_object_m)
    return None if found is None else (found, float(np.median(np.log(true["depth"][mask & (true["depth"] > 0)]))))


def fitted(known: list[tuple[distance_search.DistanceMinima, float]], working: float) -> tuple[float, float, int]:
    """INDEPENDENT, the negative log likelihood, and in how many scenes the likeliest basin is not the right one."""
    distance_search.WORKING = working

    def right(independent: float) -> list[tuple[float, bool]]:
        distance_search.INDEPENDENT = independent
        rows = []
        for found, true in known:
            off = [abs(float(np.median(one.u)) - true) for one in found.ends]
            odds = distance_search.odds_of(found.ends, found.lights, found.about_m)
            if min(off) < RIGHT:
                rows.append((float(odds[np.argmin(off)]), bool(np.argmax(odds) == np.argmin(off))))
        return rows

    def loss(log_independent: float) -> float:
        return -float(np.sum(np.log([max(odds, 1e-9) for odds, _ in right(float(np.exp(log_independent)))])))

    best = float(np.exp(optimize.minimize_scalar(loss, bounds=(-2, 4), method="bounded").x))
    return best, loss(np.log(best)), sum(not ok for _, ok in right(best))


def main() -> None:
    """Search, fit, print."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="+", type=Path)
    words.add_argument("--jobs", type=int, default=1)
    given = words.parse_args()
    with ProcessPoolExecutor(given.jobs) as pool:
        known = [one for one in pool.map(ends_of, given.scenes) if one is not None]
    print(f"{len(known)} scenes")
    for working in TRIED:
        independent, loss, wrong = fitted(known, working)
        print(f"WORKING {working:.2f}: INDEPENDENT {independent:.1f}, negative log likelihood {loss:.1f}, another is likeliest in {wrong}")


if __name__ == "__main__":
    main()

"""How often the automatic mask is right on drawn scenes, and what its stated doubt is worth: ``python tools/mask_doubt.py SCENES...``.

SCENES are folders with calibration.yaml, capture/ and truth/surface.npz (a `mask`). A row a scene: IoU with the true mask, weak share and
stated odds; then the fit of ``odds = 1 / (1 + (DOUBTED / weak)^DOUBT_POWER)`` to whether the IoU is under 0.9, for lpcal.surface.mask.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from scipy import optimize

from lpcal.api.curve import settle_sensor
from lpcal.api.sensor import stated_in
from lpcal.detect.radiometry import to_radiance
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.capture import read_capture
from lpcal.surface import mask, sight

WRONG = 0.9


def found_in(scene: Path) -> tuple[mask.Found, float]:
    """The mask of a scene and its IoU with the true one; without an ambient image the light of the room is left in."""
    calibration = read_calibration(scene / "calibration.yaml")
    raw = read_capture(scene / "capture", [light.name for light in calibration.lights], name=scene.name, use=None)
    sensor = settle_sensor(raw, calibration, [("calibration", stated_in(calibration))]).used.sensor
    radiance = to_radiance(raw, sensor)
    lights = sight.lights_of(calibration, radiance)
    rays_C = sight.ray_map(radiance.signal.shape[1:3], calibration.camera)
    found = mask.automatic(sight.grey(radiance, lights), rays_C, lights, calibration.d_object_m)
    true = np.load(scene / "truth/surface.npz")["mask"]
    return found, float((found.mask & true).sum() / (found.mask | true).sum())


def main(folders: list[str]) -> None:
    """Print the table and the fit."""
    weak, iou = [], []
    for scene in map(Path, folders):
        if not (scene / "capture/ambient.png").exists():
            continue
        begun = time.process_time()
        found, one = found_in(scene)
        if found.weak is None:
            print(f"{scene.name}  IoU {one:.3f}  {found.how}", flush=True)
            continue
        weak.append(found.weak)
        iou.append(one)
        print(
            f"{scene.name}  IoU {one:.3f}  weak {found.weak:.3f}  odds {found.doubt:.2f}  {found.how}  {time.process_time() - begun:.1f} s",
            flush=True,
        )
    log_weak, wrong = np.log(np.maximum(weak, 1e-3)), np.array(iou) < WRONG

    def cost(x: np.ndarray) -> float:
        at = np.exp(x[1]) * (log_weak - x[0])
        return float(np.sum(np.logaddexp(0, np.where(wrong, -at, at))) + 0.5 * ((x[1] - np.log(2)) / 0.5) ** 2)

    x = optimize.minimize(cost, [np.log(0.5), np.log(2)], method="Nelder-Mead").x
    print(f"IoU: worst tenth {np.percentile(iou, 10):.3f}, median {np.median(iou):.3f}, {np.mean(wrong):.0%} under {WRONG}")
    print(f"DOUBTED {np.exp(x[0]):.2f}, DOUBT_POWER {np.exp(x[1]):.1f}")


if __name__ == "__main__":
    main(sys.argv[1:])

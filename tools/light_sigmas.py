"""Whether the lights' stated sigmas are true: ``python tools/light_sigmas.py [COUNT [FIRST]]``, 100 simulated rigs from seed 0.

Each rig has 4, 6, 8 or 12 lights, 1 to 4 chrome and 0, 1, 2 or 4 matte spheres; joints at 20, 30 or 40 degrees, spheres, focal lengths,
picture sizes, blur and noise drawn too. Images are rendered as `light_rigs` does and go through lpcal's detection; each rig is solved with
its wings and without. NEES: squared error over the stated sigma's square a degree of freedom, mean over lights and points; 1 is right.
What is drawn is kept: a change of the solver needs no new images.
"""

from __future__ import annotations

import hashlib
import pickle
import sys
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

from light_errors import Errors, errors_of, rms
from light_rigs import CACHE, Drawn, capture_rig, in_frame, rig_of, sources
from lpcal.chain.refine_lights import refine_judged
from lpcal.errors import LpcalError
from lpcal.records.calibration import LightsSolution
from lpcal.simulate.recipe import Recipe, SensorRecipe

RIGS = 100
LIGHTS, CHROME, MATTE = (4, 6, 8, 12), (1, 2, 3, 4), (0, 1, 2, 4)
WANTED = (0.6, 1.5)
MEASURES = ("direction", "position", "irradiance")


@dataclass(frozen=True)
class Plan:
    """What is drawn of a rig before its errors are."""

    seed: int
    lights: int
    chrome: int
    matte: int
    joint_rad: float
    radius_m: float
    recipe: Recipe


def plan(seed: int) -> Plan:
    """Every 64 seeds hold every combination of lights, chrome and matte spheres; the order is drawn."""
    order = np.random.default_rng([seed // 64, 90]).permutation(64)[seed % 64]
    rng = np.random.default_rng([seed, 91])
    width = int(rng.choice([400, 480, 560]))
    sensor = SensorRecipe(read_noise_e=float(rng.uniform(5, 14)), psf_sigma_px=float(rng.uniform(0.5, 0.8)))
    recipe = Recipe(
        seed=10_000 + seed,
        image_size=(width, 5 * width // 8),
        focal_share=float(rng.uniform(0.95, 1.25)),
        dome_radius_m=float(rng.uniform(0.023, 0.031)),
        led_tilt_rad=float(np.radians(rng.uniform(0.2, 0.5))),
        led_power=float(rng.uniform(0.02, 0.05)),
        sensor=sensor,
    )
    joint_rad = float(np.radians(rng.choice([20, 30, 40], p=[0.25, 0.5, 0.25])))
    counts = LIGHTS[order % 4], CHROME[order // 4 % 4], MATTE[order // 16]
    return Plan(seed, *counts, joint_rad, float(rng.choice([0.02, 0.025])), recipe)


def drawn_as(one: Plan) -> Drawn:
    """The rig of a plan, rendered and seen, or as kept from before."""
    code = hashlib.sha256(b"".join(path.read_bytes() for path in sources()) + repr(one).encode()).hexdigest()[:16]
    kept = CACHE / f"sigmas_{one.seed}_{code}.pkl"
    if not kept.exists():
        CACHE.mkdir(exist_ok=True)
        rig, wings, sigma = rig_of("lightpanel-6", one.chrome, one.matte)
        lights = {
            f"L{k}": rig.lights["L0"].model_copy(update={"azimuth": 2 * np.pi * k / one.lights, "joint_angle": one.joint_rad})
            for k in range(one.lights)
        }
        spheres = {name: section.model_copy(update={"radius": one.radius_m}) for name, section in rig.spheres.items()}
        wings = [
            replace(wings[0], name=name, azimuth_rad=2 * np.pi * k / one.lights, joint_angle_rad=one.joint_rad)
            for k, name in enumerate(lights)
        ]
        rig = rig.model_copy(update={"lights": lights, "spheres": spheres})
        kept.with_suffix(".part").write_bytes(pickle.dumps(capture_rig(rig, wings, sigma, one.recipe)))
        kept.with_suffix(".part").rename(kept)
    built, camera, windows, designed = pickle.loads(kept.read_bytes())
    return Drawn(built, camera, tuple(in_frame(view, corner, camera.image_size) for view, corner in windows), designed)


def judged(seen: Drawn, *, with_wings: bool) -> tuple[LightsSolution, Errors]:
    """The lights of a drawn rig and their errors.

    Raises
    ------
    LpcalError
        Whatever the tool refuses.
    """
    found = refine_judged(list(seen.views), seen.names, seen.camera, seen.wings if with_wings else None)
    return found, errors_of(found, seen.built.lights, seen.built.points_C)


def main(count: int, first: int) -> None:
    """Draw, solve, and say by class what the sigmas are worth."""
    rows: dict[str, list[Errors]] = defaultdict(list)
    refused: list[str] = []
    for seed in range(first, first + count):
        one = plan(seed)
        try:
            seen = drawn_as(one)
        except LpcalError as error:
            refused.append(f"{seed:4d} seen   {error}")
            print(refused[-1], flush=True)
            continue
        for under in ("wings", "free"):
            try:
                _, errors = judged(seen, with_wings=under == "wings")
            except LpcalError as error:
                refused.append(f"{seed:4d} {under:<6} {error}")
                print(refused[-1], flush=True)
                continue
            print(f"{seed:4d} {under:<6}{_line(one, errors)}", flush=True)
            for row in ("all", f"{one.lights} lights", f"{one.chrome} chrome", f"{one.matte} matte"):
                rows[f"{under}: {row}"].append(errors)
    print(f"\nNEES over {count} simulated rigs, wanted {WANTED[0]} to {WANTED[1]}   rigs" + "".join(f"{name:>13}" for name in MEASURES))
    for row in sorted(rows):
        print(f"{row:<48}{len(rows[row]):5d}" + "".join(f"{_mean(rows[row], name):13.2f}" for name in MEASURES))
    print(f"refused: {len(refused)}", *refused, sep="\n")


def _line(one: Plan, errors: Errors) -> str:
    figures = "".join(f"{name} {errors.nees[name]:8.2f}  " for name in MEASURES)
    return (
        f"{one.lights:3d} lights {one.chrome} chrome {one.matte} matte  joint {np.degrees(one.joint_rad):.0f} deg  NEES {figures}"
        f" {np.degrees(rms(errors.direction)):.3f} deg {1e3 * rms(errors.position):.2f} mm {100 * rms(errors.irradiance):.2f} %"
    )


def _mean(errors: Sequence[Errors], name: str) -> float:
    values = [one.nees[name] for one in errors if np.isfinite(one.nees[name])]
    return float(np.mean(values)) if values else float("nan")


if __name__ == "__main__":
    main(*[*map(int, sys.argv[1:]), RIGS, 0][:2] if len(sys.argv) < 3 else map(int, sys.argv[1:3]))

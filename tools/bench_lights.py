"""Figures of the lights: ``python tools/bench_lights.py [WHAT...]``, of rig_a, speed, rigs, whole, exact, clicks; all without.

rig_a    the rendered rig of LPCAL_DATA, from its images: one to four chrome spheres, without matte, with the LEDs unknown
speed    12 lights, 8 chrome and 8 matte spheres: time and peak memory of the solve, and of ``lpcal refine`` from images
rigs     100 simulated rigs that know more than the model: errors compared with their sigmas; of 30 of them, what more spheres do
whole    8 of them from whole images instead of windows about the spheres
exact    50 rigs without model error: errors compared with the Bayesian Cramer-Rao bound
clicks   50 joints stated one click off, and as many rigs without: found, and falsely found
A number after a colon takes so many rigs: ``rigs:20:5`` solves 20, and 5 of them with all numbers of spheres.
"""

from __future__ import annotations

import os
import pickle
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parent))

from light_errors import HEADER, Errors, errors_of, rms, table_row
from light_rigs import CACHE, REPOSITORY, Drawn, drawn, exact, first_of
from lpcal.api.sensor import sensor_of_camera
from lpcal.chain.refine_lights import refine
from lpcal.chain.refine_lights.measure import measure_centre
from lpcal.chain.refine_lights.swaps import fit_with_clicks
from lpcal.detect.radiometry import to_radiance
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.capture import read_capture
from lpcal.formats.panel_yaml import read_rig
from lpcal.formats.wings_yaml import read_wings
from lpcal.records.calibration import Wings
from lpcal.records.observations import SphereView
from lpcal.simulate.leds import LedLight

DATA = Path(os.environ.get("LPCAL_DATA", REPOSITORY.parent / "shared" / "data"))
RIGS, LADDER_RIGS, WHOLE, EXACT, CLICKS = 100, 30, 8, 50, 50
LADDER = [(1, 0), (2, 0), (3, 0), (4, 0), (1, 4), (2, 4), (4, 1), (4, 2), (4, 4)]
STEPS = [
    ((1, 0), (2, 0)),
    ((2, 0), (3, 0)),
    ((3, 0), (4, 0)),
    ((1, 0), (1, 4)),
    ((2, 0), (2, 4)),
    ((4, 0), (4, 1)),
    ((4, 1), (4, 2)),
    ((4, 2), (4, 4)),
]
"""Fewer and more spheres, (chrome, matte)."""
COMMAND = """
import resource, sys
from lpcal.cli.main import main
code = main(sys.argv[1:])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
sys.exit(code)
"""
SOLVE = """
import pickle, resource, sys, time
from lpcal.chain.refine_lights import refine
given = pickle.load(open(sys.argv[1], "rb"))
begun = time.perf_counter()
refine(*given)
print(time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def lpcal(*words: str, rig: Path) -> float:
    """Run a command in a rig folder; its peak memory in GB."""
    arguments = [sys.executable, "-c", COMMAND, *words, "--rig", str(rig)]
    said = subprocess.run(arguments, check=True, capture_output=True, text=True).stdout
    return float(said.splitlines()[-1]) / 1e6


def rig_a() -> None:
    """The rendered rig, all stages from images."""
    rig = CACHE / "rig_a"
    if not (rig / "calib" / "wings.yaml").exists():
        shutil.copytree(DATA / "rig_a", rig, dirs_exist_ok=True, ignore=shutil.ignore_patterns("truth", "objects"))
        for command in ("intrinsics", "handeye", "wings"):
            lpcal(command, rig=rig)
    described, camera, wings = (
        read_rig(rig / "panel.yaml").rig,
        read_camera(rig / "calib" / "camera.yaml"),
        read_wings(rig / "calib" / "wings.yaml"),
    )
    sensor, reach = sensor_of_camera(camera), (0.4 * wings.d_object_m, 2.5 * wings.d_object_m)
    views = []
    for name, section in described.spheres.items():
        radiance = to_radiance(read_capture(rig / section.images, list(described.lights), name=name), sensor)
        views.append(observe_sphere(radiance, Expected(section.kind, section.radius, None, reach), camera))
    truth = DATA / "rig_a" / "truth"
    true, points_C = _true_lights(truth, list(described.lights)), np.loadtxt(truth / "points.csv", delimiter=",", skiprows=1)
    unknown = replace(wings, wings=tuple(replace(wing, leds=None) for wing in wings.wings))
    print(f"rig_a\n{HEADER}")
    cases: list[tuple[str, list[SphereView], Wings]] = [(f"{c} chrome, 4 matte", first_of(views, c, 4), wings) for c in (1, 2, 3, 4)]
    cases += [(f"{c} chrome, no matte", first_of(views, c, 0), wings) for c in (1, 2, 3, 4)]
    cases += [(f"4 chrome, {m} matte", first_of(views, 4, m), wings) for m in (1, 2)]
    cases += [("4 and 4, LEDs unknown", first_of(views, 4, 4), unknown)]
    for name, some, known in cases:
        print(table_row(name, [errors_of(refine(some, list(described.lights), camera, known), true, points_C)]), flush=True)
    print("wanted: 4 and 4 <= 0.060, 0.150, 0.8 %, 0.9 mm, 0.35 deg, NEES 0.3-2; LEDs unknown <= 0.070, 1.3 %")


def _true_lights(truth: Path, names: list[str]) -> list[LedLight]:
    leds, frames = np.load(truth / "leds.npz"), yaml.safe_load((truth / "lights.yaml").read_text())
    frames = frames.get("lights", frames)
    frames = {entry["name"]: entry for entry in frames} if isinstance(frames, list) else frames
    found = []
    for name in names:
        position, axis, power = (leds[f"{name}_{key}"] for key in ("position", "axis", "power"))
        found.append(LedLight(name, np.array(frames[name]["H_CL"]), position, axis, power, float(leds["exponent"]), 1.0, np.zeros(3)))
    return found


def speed() -> None:
    """Twelve lights under sixteen spheres."""
    seen = drawn(900, "lightpanel-12", 8, 8)
    (CACHE / "speed.pkl").write_bytes(pickle.dumps(([*seen.views], seen.names, seen.camera, seen.wings)))
    alone = subprocess.run(
        [sys.executable, "-c", SOLVE, str(CACHE / "speed.pkl")], check=True, capture_output=True, text=True
    ).stdout.split()
    print(f"12 lights, 8 + 8 spheres: solve {float(alone[0]):.1f} s, {float(alone[1]) / 1e6:.2f} GB; wanted < 10 s, < 1 GB")
    rig = _speed_rig()
    begun = time.perf_counter()
    peak = lpcal("refine", rig=rig)
    print(f"the whole of lpcal refine, {12 * 8 * 3 + 16} images of 640x400 read: {time.perf_counter() - begun:.1f} s, {peak:.2f} GB")


def _speed_rig() -> Path:
    """A folder of twelve lights and sixteen spheres, the camera given, no boards."""
    rig = CACHE / "speed"
    if not (rig / "panel.yaml").exists():
        text = yaml.safe_load((REPOSITORY / "rigs" / "lightpanel-12" / "panel.yaml").read_text())
        text = {key: text[key] for key in ("lpcal", "name", "camera", "panel", "lights")}
        text["camera"] = {"cameramodel": "lens.cameramodel", "black_level": "0.8 %", "flat_field": "flat.png"}
        text["spheres"] = {
            f"{kind}_{k}": {"kind": kind, "radius": "25 mm", "images": f"spheres/{kind}_{k}"}
            for kind in ("chrome", "matte")
            for k in range(8)
        }
        source = CACHE / "speed_panel"
        source.mkdir(parents=True, exist_ok=True)
        (source / "panel.yaml").write_text(yaml.safe_dump(text, sort_keys=False))
        subprocess.run([sys.executable, "-m", "lpcal", "simulate", str(rig), "--rig", str(source)], check=True, stdout=subprocess.DEVNULL)
        for command in ("intrinsics", "wings"):
            lpcal(command, rig=rig)
    shutil.rmtree(rig / "calib" / "lights.yaml", ignore_errors=True)
    return rig


def _solved(make: Callable[[int], Drawn], seeds: Sequence[int], ladder: list[tuple[int, int]]) -> dict[tuple[int, int], list[Errors]]:
    found: dict[tuple[int, int], list[Errors]] = {rung: [] for rung in ladder}
    for done, seed in enumerate(seeds):
        one = make(seed)
        for rung in ladder:
            solution = refine(one.some(*rung), one.names, one.camera, one.wings)
            found[rung].append(errors_of(solution, one.built.lights, one.built.points_C))
        print(f"\r{done + 1} of {len(seeds)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return found


def rigs(count: int = RIGS, ladder: int = LADDER_RIGS) -> None:
    """Errors compared with sigmas, and what more spheres do."""
    most = [(4, 0), (4, 4)]
    found = _solved(drawn, range(ladder), LADDER)
    print(f"{ladder} simulated rigs of 6 lights; NEES wanted 0.5-1.2\n{HEADER}")
    for (chrome, matte), errors in found.items():
        print(table_row(f"{chrome} chrome, {matte} matte", errors))
    print("more spheres: rms error after over before, wanted <= 1.05        direction  position")
    for before, after in STEPS:
        ratio = [
            rms(np.concatenate([getattr(one, key).ravel() for one in found[after]]))
            / rms(np.concatenate([getattr(one, key).ravel() for one in found[before]]))
            for key in ("direction", "position")
        ]
        print(
            f"  {before[0]} chrome, {before[1]} matte -> {after[0]} chrome, {after[1]} matte {ratio[0]:38.3f}{ratio[1]:10.3f}", flush=True
        )
    more = _solved(drawn, range(ladder, count), most)
    print(f"{count} simulated rigs\n{HEADER}")
    for chrome, matte in most:
        print(table_row(f"{chrome} chrome, {matte} matte", found[chrome, matte] + more[chrome, matte]))


def whole(count: int = WHOLE) -> None:
    """The same from whole images."""
    found = _solved(lambda seed: drawn(seed, margin=None), range(count), [(4, 0), (4, 4)])
    beside = _solved(drawn, range(count), [(4, 0), (4, 4)])
    print(f"{count} rigs from whole images, and the same from windows\n{HEADER}")
    for what, results in (("whole", found), ("window", beside)):
        for (chrome, matte), errors in results.items():
            print(table_row(f"{chrome} + {matte}, {what}", errors))


def exact_rigs(count: int = EXACT) -> None:
    """Errors compared with the bound."""
    found = _solved(exact, range(count), [(2, 0), (4, 0), (4, 4)])
    print(f"{count} rigs without model error: rms over bound, wanted <= 1.10\n{HEADER}   rms/bound: dir   pos   int")
    for (chrome, matte), errors in found.items():
        ratio = [np.sqrt(np.mean([one.nees[key] for one in errors])) for key in ("direction", "position", "intensity")]
        print(table_row(f"{chrome} chrome, {matte} matte", errors) + f"{ratio[0]:17.2f}{ratio[1]:6.2f}{ratio[2]:6.2f}")


def clicks(count: int = CLICKS) -> None:
    """One joint of each rig stated a click off, and none."""
    for chrome, matte in ((4, 0), (2, 0), (1, 0), (1, 4)):
        found = falsely = 0
        for seed in range(count):
            one = drawn(seed)
            row, step = seed % len(one.names), 1 if seed // len(one.names) % 2 else -1
            for wings, planted in ((one.misdrawn(row, step), {(one.names[row], -step)}), (one.wings, set())):
                said = _said(one, one.some(chrome, matte), wings)
                found, falsely = found + len(said & planted), falsely + len(said - planted)
        under = f"{chrome} chrome, {matte} matte"
        print(f"clicks, {under}: {found} of {count} found, {falsely} falsely in {2 * count} rigs; wanted {count}, 0", flush=True)


def _said(one: Drawn, views: list[SphereView], wings: Wings) -> set[tuple[str, int]]:
    """Lights said to stand clicks off, and how many."""
    if any(view.shading for view in views):
        warnings = refine(views, one.names, one.camera, wings).warnings
        words = [match for match in (re.match(r"(\w+): joint at (-?\d+) deg, not (-?\d+)", warning) for warning in warnings) if match]
        return {(match[1], round((int(match[2]) - int(match[3])) / 10)) for match in words}
    measured = [measure_centre(view, one.camera) for view in views]
    _, _, named = fit_with_clicks(one.names, views, measured, one.camera, wings)
    return {(click.name, round(float(np.degrees(click.found_rad - click.drawn_rad) / 10))) for click in named}


WHAT: dict[str, Callable[..., None]] = {"rig_a": rig_a, "speed": speed, "rigs": rigs, "whole": whole, "exact": exact_rigs, "clicks": clicks}


def main(words: list[str]) -> None:
    """Run what is named, or all."""
    CACHE.mkdir(exist_ok=True)
    for word in words or WHAT:
        name, *counts = word.split(":")
        WHAT[name](*map(int, counts))


if __name__ == "__main__":
    main(sys.argv[1:])

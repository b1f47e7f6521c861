"""Many small captures: drawn, and reconstructed by an engine, compared with the plain loop.

``python tools/many_captures.py DIR [--count 200] [--size 48] [--jobs 2] [--on dask]`` draws a ball under six distant lights so many
times, each another ball, reconstructs them one after the other and by the engine, and prints wall clock and processor time of both, the
share of two cores' throughput, and whether the bytes are the same. Each is a command of its own, imports and all; processor time is that
of every process that it started, those too that outlive it by a moment (Linux: this process adopts and awaits them).
"""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.documents import Provenance
from lpcal.records.calibration import Calibration, Light

SIZE = 48
LIGHTS = 6
ADOPT = 36
"""Linux's PR_SET_CHILD_SUBREAPER."""
OF_THE_RUN = ("times_s", "peak_memory_mb", "files")
"""What of summary.json is of the run, not of the surface."""


def dome() -> Calibration:
    """Six distant lights at half a right angle, no camera."""
    angle = 2 * np.pi * np.arange(LIGHTS) / LIGHTS
    directions = np.stack([0.6 * np.cos(angle), 0.6 * np.sin(angle), -0.8 * np.ones(LIGHTS)], axis=1)
    return Calibration("dome", tuple(Light(f"L{k}", d, np.ones(1)) for k, d in enumerate(directions)))


def draw(folder: Path, seed: int, size: int = SIZE) -> Path:
    """A capture of a ball somewhere, with a mask."""
    rng = np.random.default_rng(seed)
    centre, radius = size * rng.uniform(0.42, 0.58, 2), size * rng.uniform(0.28, 0.4)
    row, column = np.mgrid[:size, :size]
    x, y = (column - centre[0]) / radius, (row - centre[1]) / radius
    ball = x**2 + y**2 < 0.95
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.01))], axis=-1)
    folder.mkdir(parents=True)
    for light in dome().lights:
        shading = np.where(ball, 0.8 * np.maximum(n @ light.direction_C, 0), 0.3) + 0.02 + 0.002 * rng.standard_normal(ball.shape)
        Image.fromarray(np.rint(255 * np.clip(shading, 0, 1)).astype(np.uint8)).save(folder / f"{light.name}.png")
    Image.fromarray(np.full((size, size), 5, np.uint8)).save(folder / "ambient.png")
    Image.fromarray((255 * ball).astype(np.uint8)).save(folder / "mask.png")
    return folder


def collection(folder: Path, count: int, size: int = SIZE) -> list[Path]:
    """So many captures and dome.yaml beside them."""
    write_calibration(folder / "dome.yaml", dome(), Provenance())
    return [draw(folder / f"c{k:04d}", k, size) for k in range(count)]


def same_bytes(one: Path, other: Path) -> bool:
    """Whether two folders of a surface hold the same but for what is of the run."""
    names = {path.name for path in one.iterdir()}
    if names != {path.name for path in other.iterdir()}:
        return False
    documents = [json.loads((folder / "summary.json").read_text()) for folder in (one, other)]
    for document in documents:
        for key in OF_THE_RUN:
            document.pop(key)
    plain = all((one / name).read_bytes() == (other / name).read_bytes() for name in names - {"summary.json"})
    return plain and documents[0] == documents[1]


@dataclass(frozen=True)
class Spent:
    """What a command took, seconds."""

    wall: float
    processor: float
    others: float
    """Processor time of all else on the machine meanwhile: above a few per cent, the wall clock is no benchmark."""


def busy_s() -> float:
    """Processor time that the machine has spent since it began, all processes together."""
    user, nice, system = (int(word) for word in Path("/proc/stat").read_text().split()[1:4])
    return (user + nice + system) / os.sysconf("SC_CLK_TCK")


def run(words: list[str]) -> Spent:
    """Run ``lpcal`` with these words to its end, and all that it started."""
    ctypes.CDLL(None).prctl(ADOPT, 1, 0, 0, 0)
    begun, before, busy = time.perf_counter(), os.times(), busy_s()
    with subprocess.Popen([sys.executable, "-m", "lpcal", *words], stdout=subprocess.DEVNULL) as command:
        code = command.wait()
    wall = time.perf_counter() - begun
    assert code == 0, code
    with contextlib.suppress(ChildProcessError):
        while True:
            os.wait()
    after = os.times()
    own = after.children_user + after.children_system - before.children_user - before.children_system
    return Spent(wall, own, busy_s() - busy - own)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--size", type=int, default=SIZE, help="pixels across a capture")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--on", default="dask")
    asked = parser.parse_args()
    captures = collection(asked.folder, asked.count, asked.size)
    words = ["reconstruct", *map(str, captures), "-c", str(asked.folder / "dome.yaml"), "--quiet", "-o"]
    loop = run([*words, str(asked.folder / "by_loop")])
    there = run([*words, str(asked.folder / f"by_{asked.on}"), "--on", asked.on, "--jobs", str(asked.jobs)])
    for name, took in (("loop", loop), (asked.on, there)):
        spent = f"{took.processor:.1f} s of processor time (all else {took.others:.1f} s)"
        print(f"{name}: {took.wall:.1f} s, {spent}, {took.wall / asked.count:.3f} s a capture")
    faster = loop.wall / there.wall
    print(f"the loop's time is {faster:.2f} times {asked.on}'s: {faster / asked.jobs:.2f} of {asked.jobs} cores' throughput")
    print(f"processor time is {there.processor / loop.processor:.2f} times the loop's")
    same = [same_bytes(asked.folder / "by_loop" / one.name, asked.folder / f"by_{asked.on}" / one.name) for one in captures]
    print(f"{sum(same)} of {len(same)} surfaces have the same bytes")


if __name__ == "__main__":
    main()

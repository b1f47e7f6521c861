"""Processor time and peak memory of lpcal compared with an older commit of itself, and of its solvers with plain peers.

``python tools/bench_speed.py [--check]``: prints the table of docs/benchmarks.md; ``--check`` fails where a ratio has slid by more than a
quarter from the committed one. Each row is a ratio of two things that run one after the other on the same machine, so that how fast the
machine is, and how busy, hardly counts. Processor time is user and system time of all threads, in whole processes for lpcal itself, which
runs on one core here. The older commit is laid out of the clone's history into a folder of its own.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from scipy.sparse import linalg

from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.documents import Provenance
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array
from lpcal.integration import multigrid, pieces
from lpcal.integration.integrate import Grid, Own, integrate, settle, steps, system
from lpcal.kernels.library import SWITCH
from lpcal.records.calibration import Calibration, Light
from lpcal.shading import normals
from lpcal.surface import uncertainty
from lpcal.view.pixel_list import PixelList

ROOT = Path(__file__).resolve().parents[1]
TABLE = ROOT / "docs/benchmarks.md"
PINNED = "ceaa673"
SLIDE = 0.25
"""Share by which a ratio may fall short of the committed one."""
RUN = "import sys; sys.path.insert(0, sys.argv.pop(1)); from lpcal.cli.main import main; sys.exit(main())"
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
"""Of the linear algebra, here and in the commands: threads that wait for each other count as processor time, the twins' twice over."""
REPEATED_S = 1.0
"""Processor seconds over which a short work is repeated: its least is then the same on a busy machine."""
PYTHON_PIXELS = 300
"""Pixels that the peer in plain Python does: it takes milliseconds a pixel."""


@dataclass(frozen=True)
class Row:
    """What was measured, and by how much lpcal is better: processor time or memory of the peer over its own."""

    name: str
    own: str
    peer: str
    ratio: float


def laid_out(folder: Path) -> Path:
    """The package of the pinned commit, in a folder of its own."""
    archive = subprocess.run(["git", "archive", PINNED, "lpcal"], cwd=ROOT, check=True, capture_output=True).stdout
    subprocess.run(["tar", "-x", "-C", str(folder)], input=archive, check=True)
    return folder


def process(code: Path, words: list[str]) -> tuple[float, float]:
    """Processor seconds and peak MB of an lpcal command by a folder of code."""
    env = os.environ | ONE_THREAD
    child = subprocess.Popen([sys.executable, "-P", "-c", RUN, str(code), *words], env=env, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if status:
        raise SystemExit(f"lpcal {' '.join(words)} by {code}: exit {status}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def ball(folder: Path, lights: int, size: tuple[int, int], radius: float) -> list[str]:
    """The words that reconstruct a drawn capture: a ball under distant lights, with its mask and an ambient image, 16 bit."""
    rng = np.random.default_rng(lights)
    turn, slant = 2.4 * np.arange(lights), np.radians(20 + 30 * rng.random(lights))
    S = np.stack([np.sin(slant) * np.cos(turn), np.sin(slant) * np.sin(turn), -np.cos(slant)], axis=1)
    y, x = (np.mgrid[: size[0], : size[1]] - np.reshape(size, (2, 1, 1)) / 2) / radius
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0.05))], axis=-1)
    inside = x**2 + y**2 < 0.9
    folder.mkdir()
    for k, light in enumerate(S):
        shown = np.where(inside, 0.6 * np.clip(n @ light, 0, 1), 0) + 0.02 + 2e-3 * rng.standard_normal(size)
        cv2.imwrite(str(folder / f"L{k}.png"), np.rint(65535 * np.clip(shown, 0, 1)).astype(np.uint16))
    cv2.imwrite(str(folder / "ambient.png"), np.full(size, round(0.02 * 65535), np.uint16))
    cv2.imwrite(str(folder / "mask.png"), 255 * inside.astype(np.uint8))
    named = tuple(Light(f"L{k}", light, np.ones(1)) for k, light in enumerate(S))
    path = folder.with_suffix(".yaml")
    write_calibration(path, Calibration("dome", named), Provenance())
    return ["reconstruct", str(folder), "-c", str(path), "-o", f"{folder}_surface"]


def captures(folder: Path) -> list[Row]:
    """Whole commands compared with the pinned commit."""
    old, rows = laid_out(folder), []
    for name, lights, size, radius in (("8 lights of 240x180", 8, (180, 240), 80.0), ("96 lights of 612x512", 96, (512, 612), 115.0)):
        words = ball(folder / f"ball{lights}", lights, size, radius)
        then, now = process(old, words), process(ROOT, [*words, "--jobs", "1"])
        rows.append(Row(f"reconstruct, {name}: processor time", f"{now[0]:.1f} s", f"{then[0]:.1f} s at {PINNED}", then[0] / now[0]))
        rows.append(Row(f"reconstruct, {name}: peak memory", f"{now[1]:.0f} MB", f"{then[1]:.0f} MB at {PINNED}", then[1] / now[1]))
    return rows


def timed(work: Callable[[], object]) -> float:
    """Processor seconds of this process for some work: the least of three, of a short one that of more."""
    found: list[float] = []
    while len(found) < 3 or sum(found) < REPEATED_S:
        begun = time.process_time()
        work()
        found.append(time.process_time() - begun)
    return min(found)


def integration() -> Row:
    """The masked solve of 153,756 pixels compared with scipy's spsolve, to the same depth."""
    y, x = np.indices((470, 470))
    mask = ((x - 235) / 1.0) ** 2 + (y - 235) ** 2 < 221.5**2
    grid, rng = Grid.of(mask), np.random.default_rng(1)
    pixels = len(grid.rows)
    depth = np.hypot(grid.rows - 200.0, grid.columns - 250.0) / 50
    step = depth[grid.b] - depth[grid.a] + 1e-3 * rng.standard_normal(len(grid.a))
    A, right = system(grid, np.ones(len(step)), step, np.full(pixels, 1e-6), depth)
    own = timed(lambda: multigrid.solve(A, right, np.zeros(pixels)))
    columns = A.sparse().tocsc()
    peer = timed(lambda: linalg.spsolve(columns, right))
    apart = np.std(multigrid.solve(A, right, np.zeros(pixels)) - linalg.spsolve(columns, right))
    name = f"least squares of {pixels} pixels (rms apart {apart / np.std(depth):.0e} of the depth's)"
    return Row(name, f"{own:.2f} s", f"{peer:.2f} s, scipy spsolve", peer / own)


def broken_integration() -> Row:
    """Depth with breaks, and its sigma, of the normals of two balls before a wall, compared with the kernels' numpy twins."""
    y, x = np.indices((470, 470))
    rays = np.stack([(x - 235) / 600, (y - 235) / 600, np.ones(x.shape)], axis=-1)
    mask, z = (x - 235) ** 2 + (y - 235) ** 2 < 221.5**2, np.full(x.shape, 0.36)
    for column, row, radius, front in ((-0.03, 0.0, 0.05, 0.36), (0.06, 0.03, 0.04, 0.33)):
        height2 = radius**2 - (0.35 * rays[..., 0] - column) ** 2 - (0.35 * rays[..., 1] - row) ** 2
        z = np.where(height2 > 0, np.minimum(z, front - np.sqrt(np.maximum(height2, 0))), z)
    slopes = [np.gradient(rays * z[..., None], axis=axis) for axis in (0, 1)]
    rng, r = np.random.default_rng(3), rays[mask]
    n = lambert.unit(np.cross(*slopes)[mask])[0]
    n *= -np.sign(np.sum(n * r, axis=1))[:, None]
    n = lambert.unit(n + 0.02 * rng.standard_normal(r.shape))[0]
    grid, pixels = Grid.of(mask), len(r)
    own = Own(np.full(pixels, 0.5), np.log(z[mask]) + 0.05 * rng.standard_normal(pixels))

    def whole() -> Array:
        step = steps(grid, n, r, central=True)
        u, weight = integrate(grid, step, own, np.full(pixels, np.log(0.35)), graduated=True)
        weight = pieces.without_slivers(grid, weight, mask)
        u = settle(grid, step, own, u, weight)
        label, towards = pieces.pieces(grid, weight, mask), -np.sum(n * r, axis=1) / np.linalg.norm(r, axis=1)
        uncertainty.depth_sigma(grid, np.full(pixels, 2.0), towards, r[:, :2], np.exp(u), label)
        return u

    mine = timed(whole)
    os.environ[SWITCH] = "numpy"
    begun = time.thread_time()
    whole()
    twin = time.thread_time() - begun
    del os.environ[SWITCH]
    return Row(
        f"integration with breaks and sigma of {pixels} pixels", f"{mine:.2f} s", f"{twin:.2f} s, the kernels' numpy twins", twin / mine
    )


def reweighted(B: np.ndarray, signal: np.ndarray) -> np.ndarray:
    """b (P, 3) of least absolute residuals, by least squares weighted again, a pixel at a time in plain Python."""
    found = np.empty((signal.shape[1], 3))
    for p in range(signal.shape[1]):
        weight = np.ones(len(B))
        for _ in range(30):
            root = np.sqrt(weight)[:, None]
            found[p] = np.linalg.lstsq(root * B[:, p], root[:, 0] * signal[:, p], rcond=None)[0]
            weight = 1 / np.maximum(np.abs(signal[:, p] - B[:, p] @ found[p]), 1e-6)
    return found


def robust_normals() -> Row:
    """Robust normals of 12 lights with shadows and highlights compared with the same by an iteratively reweighted L1 a pixel."""
    rng, lights, pixels = np.random.default_rng(2), 12, 40_000
    turn = 2 * np.pi * np.arange(lights) / lights
    S = np.stack([0.6 * np.cos(turn), 0.6 * np.sin(turn), np.full(lights, -0.8)], axis=1)
    B = np.repeat(S[:, None], pixels, axis=1)
    n = lambert.unit(np.stack([*(0.5 * rng.standard_normal((2, pixels))), np.full(pixels, -1.0)], axis=1))[0]
    signal = 0.5 * lambert.predicted(B, n) + 2e-3 * rng.standard_normal((lights, pixels))
    signal[rng.random(signal.shape) < 0.05] += 0.4
    signal[rng.random(signal.shape) < 0.05] *= 0.1
    seen = PixelList(
        np.ones((200, 200), bool), np.tile([0.0, 0, 1], (pixels, 1)), signal, np.full(signal.shape, 2e-3), np.ones(signal.shape, bool), True
    )
    usable = normals.candidates(seen, np.ones(signal.shape))
    own = timed(lambda: normals.estimate(seen, B, usable, normals.variances(seen)))
    begun = time.process_time()
    plain = reweighted(B[:, :PYTHON_PIXELS], signal[:, :PYTHON_PIXELS])
    peer = (time.process_time() - begun) * pixels / PYTHON_PIXELS

    def error(b: np.ndarray) -> float:
        return float(np.degrees(np.nanmean(np.arccos(np.clip(np.sum(lambert.unit(b)[0] * n[: len(b)], axis=1), -1, 1)))))

    mine = error(normals.estimate(seen, B, usable, normals.variances(seen)).b)
    name = f"robust normals of {pixels} pixels (mean error {mine:.2f} deg, the peer's {error(plain):.2f})"
    return Row(name, f"{own:.2f} s", f"{peer:.0f} s, reweighted L1 in plain Python", peer / own)


def table(rows: list[Row]) -> str:
    """The rows as they stand in the documentation."""
    head = "| what | lpcal | peer | times better |\n|---|---|---|---|\n"
    return head + "".join(f"| {row.name} | {row.own} | {row.peer} | {row.ratio:.3g} |\n" for row in rows)


def slides(rows: list[Row]) -> list[str]:
    """What is worse than the committed table says, by more than SLIDE."""
    committed = {}
    for line in TABLE.read_text(encoding="utf-8").splitlines():
        if match := re.match(r"\| ([^|(]+?)(?: \([^|]*\))? \| .* \| ([\d.e+]+) \|$", line):
            committed[match[1]] = float(match[2])
    found = []
    for row in rows:
        key = row.name.split(" (")[0]
        if key not in committed:
            found.append(f"{key}: not in {TABLE.name}")
        elif row.ratio < (1 - SLIDE) * committed[key]:
            found.append(f"{key}: {row.ratio:.3g} times better, {committed[key]:.3g} in {TABLE.name}")
    return found


def main(words: list[str]) -> int:
    """Measure, print, and with --check hold against what is committed."""
    if not ONE_THREAD.items() <= os.environ.items():  # numpy has asked for them already
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | ONE_THREAD)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory() as folder:
        rows = [*captures(Path(folder)), integration(), broken_integration(), robust_normals()]
    print(table(rows))
    worse = slides(rows) if "--check" in words else []
    print("".join(f"slid: {one}\n" for one in worse), end="")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

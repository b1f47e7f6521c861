"""Models of whole simulated sessions compared with their truth.

``python tools/fuse_shapes.py OUT [--shapes bust,stone] [--stops 16] [--size WxH] [--peers]``. Each shape gets a rig of its own, of another
seed: its images are drawn, camera, hand-eye and lights are calibrated from them by the commands, every stop is reconstructed and all are
fused. What is there already is not made again, except the fusion. With ``--peers`` the same depth maps are fused in other ways, and
photogrammetry is tried on the ambient images (`fuse_peers.py`). Prints one table, and writes OUT/table.json.

Columns: rms of the model's vertices and of the single surfaces as placed, from the true surface along its normal; how many times nearer;
how much of what two views saw the model has; median error of its normals, as it stands and put where it belongs; share of vertices within
two of their sigmas; rms of what all vertices share (one motion and growth of the whole: one draw a session), and its sigma; the errors' rms
in sigmas, the median sigma; the rms that one motion and growth of the whole does not explain; errors of the views' distances before and
after; processor time of fusing over that of all reconstructions, and its peak memory.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import numpy as np

import lpcal
from bench_fuse import Truth, of_mesh, of_model, of_views, twice_seen
from fuse_peers import peers
from lpcal.formats.model_files import read_model
from lpcal.simulate.tour import SHAPES

COLUMNS = {
    "rms_mm": ("rms mm", 3),
    "singles_median_rms_mm": ("single mm", 3),
    "gain": ("nearer", 1),
    "completeness_percent": ("complete %", 2),
    "normals_median_deg": ("normals deg", 2),
    "normals_own_median_deg": ("own deg", 2),
    "within_2_sigma_percent": ("in 2 sigma %", 1),
    "shared_rms_mm": ("shared mm", 3),
    "shared_sigma_mm": ("shared sigma", 3),
    "rms_in_sigmas": ("rms/sigma", 2),
    "sigma_median_mm": ("sigma mm", 3),
    "own_rms_mm": ("own mm", 3),
    "distances_rms_mm": ("dist mm", 2),
    "fused_distances_rms_mm": ("fused mm", 2),
    "time_ratio": ("time ratio", 2),
    "peak_gb": ("GB", 2),
    "used": ("used", 0),
}
"""Figures of the table: what heads them, and digits after the point."""


@dataclass(frozen=True)
class Spent:
    """What a command took."""

    seconds: float
    """Processor time."""
    peak_gb: float


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--shapes", default=",".join(SHAPES))
    parser.add_argument("--stops", type=int, default=16)
    parser.add_argument("--size", default="752x480")
    parser.add_argument("--seed", type=int, default=1, help="of the first shape's rig; each next one's is one more")
    parser.add_argument("--peers", action="store_true")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    rows, others = [], []
    for name in options.shapes.split(","):
        seed = options.seed + list(SHAPES).index(name)
        rig = options.out / name
        spent = made(rig, name, options.stops, options.size, seed)
        row, model, surfaces = judged(rig, spent)
        rows.append({"shape": name, "seed": seed} | row)
        print(line(rows[-1]), flush=True)
        if options.peers:
            truth = Truth.of(rig)
            twice_O = twice_seen(truth, surfaces)
            for peer in peers(rig, surfaces):
                said = {"shape": name, "peer": peer.name, "note": peer.note}
                if peer.points_O is not None:
                    said |= of_mesh(truth, peer.points_O, twice_O, model.figures.step_m)
                others.append(said)
                print(json.dumps(said), flush=True)
        (options.out / "table.json").write_text(json.dumps({"rows": rows, "peers": others}, indent=1), encoding="utf-8")
    print("\n| shape | " + " | ".join(head for head, _ in COLUMNS.values()) + " |")
    print("|---|" + "---|" * len(COLUMNS))
    for row in [*rows, {"shape": "median"} | {key: float(np.median([row[key] for row in rows])) for key in COLUMNS}]:
        print(line(row))
    if others:
        print("\n| shape | fused by | rms mm | median mm | complete % | |\n|---|---|---|---|---|---|")
        for said in others:
            figures = [
                f"{said[key]:.{n}f}" if key in said else "-" for key, n in (("rms_mm", 3), ("median_mm", 3), ("completeness_percent", 2))
            ]
            print(f"| {said['shape']} | {said['peer']} | {' | '.join(figures)} | {said['note']} |")


def line(row: dict) -> str:
    """A row of the table."""
    return f"| {row['shape']} | " + " | ".join(f"{row[key]:.{digits}f}" for key, (_, digits) in COLUMNS.items()) + " |"


def made(rig: Path, name: str, stops: int, size: str, seed: int) -> dict[str, Spent]:
    """Simulate, calibrate, reconstruct and fuse by the commands: what the last two took."""
    if not (rig / "truth").is_dir():
        run(["simulate", str(rig), "--session", str(stops), "--object", name, "--size", size, "--seed", str(seed)])
    run(["export", str(rig)])
    captures = [str(rig / "session" / f"stop_{k:02d}") for k in range(stops)]
    kept = rig.parent / f"{name}_reconstruct.json"
    words = ["--rig", str(rig), "--no-pages", "--jobs", "1", "--outputs", "maps"]
    if not kept.is_file():
        kept.write_text(json.dumps(run(["reconstruct", *captures, *words]).__dict__), encoding="utf-8")
    fused = run(["fuse", *captures, "-o", str(rig / "model"), "--rig", str(rig)])
    return {"reconstruct": Spent(**json.loads(kept.read_text(encoding="utf-8"))), "fuse": fused}


def judged(rig: Path, spent: dict[str, Spent]) -> tuple[dict, lpcal.ObjectModel, list]:
    """The figures of a rig's model."""
    truth, model = Truth.of(rig), read_model(rig / "model")
    surfaces = [lpcal.read_surface(rig / "surfaces" / view.name) for view in model.views]
    row = of_model(truth, model) | of_mesh(truth, model.vertices_A, twice_seen(truth, surfaces), model.figures.step_m)
    row |= of_views(truth, model, surfaces)
    row |= {"time_ratio": spent["fuse"].seconds / spent["reconstruct"].seconds, "peak_gb": spent["fuse"].peak_gb}
    row |= {"fuse_s": spent["fuse"].seconds, "reconstruct_s": spent["reconstruct"].seconds}
    return row | {"used": sum(view.used for view in model.views)}, model, surfaces


def run(words: list[str]) -> Spent:
    """A command of lpcal, to its end; its processor time and peak memory with those of its children.

    Raises
    ------
    RuntimeError
        It fails.
    """
    with subprocess.Popen(
        [sys.executable, "-m", "lpcal", *words, "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stderr is not None
        said = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"lpcal {' '.join(words[:2])} ...: {said.strip()}")
    return Spent(used.ru_utime + used.ru_stime, used.ru_maxrss / 1e6)


if __name__ == "__main__":
    main()

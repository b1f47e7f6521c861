"""A flat card under near and under distant lights: how far from a plane it comes out, in mm.

``python tools/bench_surface.py card [SEED ...]``: a rig is simulated with a card as its object, calibrated from its own images, and the
card reconstructed both ways.
"""

from __future__ import annotations

import json
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.run import run_all
from lpcal.pipeline.simulate import simulate
from lpcal.pipeline.workspace import Workspace
from lpcal.records.outcome import silent
from make_calib_data import RECIPE, RIG

COLUMNS = ("bowl_mm", "plane_rms_mm", "plane_peak_to_valley_mm", "extent_mm")


def card(seed: int, folder: Path) -> tuple[dict[str, float], dict[str, float]]:
    """Flatness of a card by near and by distant lights, in a rig simulated from a seed."""
    text = RIG.read_text(encoding="utf-8")
    panel = folder / "panel.yaml"
    panel.write_text(text[: text.index("\nobjects:")] + "\nobjects:\n  card: objects/card\n", encoding="utf-8")
    simulate(read_rig(panel), folder / "rig", replace(RECIPE, seed=seed), silent)
    run_all(Workspace(read_rig(folder / "rig" / "panel.yaml")), silent)
    summary = json.loads((folder / "rig" / "surfaces" / "card" / "summary.json").read_text(encoding="utf-8"))
    return summary["flatness"], summary["flatness_distant"]


def main(seeds: list[int]) -> None:
    """Print the table."""
    print(f"{'seed':<10}{'lights':<10}" + "".join(f"{name:>26}" for name in COLUMNS))
    for seed in seeds or [RECIPE.seed]:
        with tempfile.TemporaryDirectory() as folder:
            for lights, found in zip(("near", "distant"), card(seed, Path(folder)), strict=True):
                print(f"{seed:<10}{lights:<10}" + "".join(f"{found[name]:>26.2f}" for name in COLUMNS), flush=True)


if __name__ == "__main__":
    main([int(word) for word in sys.argv[1:]])

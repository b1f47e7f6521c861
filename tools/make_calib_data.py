"""Make calib_data/demo_rig again: the rig that `lpcal demo` runs on, simulated, truth beside it.

uv run python tools/make_calib_data.py [FOLDER]
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.simulate import simulate
from lpcal.simulate.recipe import Recipe

REPOSITORY = Path(__file__).resolve().parent.parent
RIG = REPOSITORY / "rigs" / "lightpanel-6" / "panel.yaml"
RECIPE = Recipe(seed=20260105, image_size=(480, 320), stations=24, sweep_frames=26, dwell_s=0.65)


def main() -> None:
    """Write the folder, and say how large it is."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else REPOSITORY / "calib_data" / "demo_rig"
    shutil.rmtree(folder, ignore_errors=True)
    outcome = simulate(read_rig(RIG), folder, RECIPE, lambda what, done, total: print(f"{what} {done}/{total}"))
    print(outcome.summary[0])
    for kind in ("png", "csv", "npz"):
        print(kind, sum(path.stat().st_size for path in folder.rglob(f"*.{kind}")))


if __name__ == "__main__":
    main()

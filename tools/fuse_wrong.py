"""Wrong captures among right ones: which are named, and what becomes of the model.

``python tools/fuse_wrong.py RIG OTHER_RIG [--every 2] [--view 2]``. Of a simulated and reconstructed session every so many stops are fused:
as they are, and with one of them 20 mm beside its pose, 20 mm too far, 20 mm too near, turned by 72 degrees (the body's markers taken for
each other), and replaced by a view of another rig's object. Prints, a line each: the model's rms, the views left out, and why.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

import lpcal
from bench_fuse import Truth, rms
from lpcal.geometry import se3
from lpcal.records.surface import Surface

OFF_M = 0.02


def grown(surface: Surface, by_m: float) -> Surface:
    """Its distance wrong by so much."""
    return replace(surface, depth=surface.depth * np.float32(1 + by_m / float(np.nanmedian(surface.depth))))


def moved(surface: Surface, twist: list[float]) -> Surface:
    """Its camera elsewhere, seen in C."""
    placement = surface.placement
    return replace(surface, placement=replace(placement, H_AC=placement.H_AC @ se3.exp(np.array(twist))))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rig", type=Path)
    parser.add_argument("other", type=Path)
    parser.add_argument("--every", type=int, default=2)
    parser.add_argument("--view", type=int, default=2)
    options = parser.parse_args()
    truth = Truth.of(options.rig)
    folders = sorted((options.rig / "surfaces").glob("stop_*"))[:: options.every]
    right = [lpcal.read_surface(folder) for folder in folders]
    strange = lpcal.read_surface(options.other / "surfaces" / folders[options.view].name)
    wrong: dict[str, Callable[[Surface], Surface]] = {
        "none": lambda surface: surface,
        "20 mm beside": lambda surface: moved(surface, [0, 0, 0, OFF_M, 0, 0]),
        "20 mm too far": lambda surface: grown(surface, OFF_M),
        "20 mm too near": lambda surface: grown(surface, -OFF_M),
        "turned by 72 deg": lambda surface: moved(surface, [0, 0, np.radians(72), 0, 0, 0]),
        "another object": lambda surface: replace(strange, name=surface.name, placement=surface.placement),
    }
    for kind, spoilt in wrong.items():
        surfaces = list(right)
        surfaces[options.view] = spoilt(right[options.view])
        model = lpcal.fuse(surfaces)
        off, _ = truth.along(model.vertices_A)
        left_out = [f"{view.name}: {view.why}" for view in model.views if not view.used]
        said = left_out or [one for one in model.warnings if "its distance was changed" in one]
        print(
            f"| {kind} | {1e3 * rms(off):.3f} mm | {sum(view.used for view in model.views)} of {len(right)} | {'; '.join(said)} |",
            flush=True,
        )


if __name__ == "__main__":
    main()

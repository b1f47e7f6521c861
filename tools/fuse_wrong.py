"""Wrong captures among right ones: which are named, and what becomes of the model.

``python tools/fuse_wrong.py RIG OTHER_RIG [--every 1] [--views 2,7]``. Of a simulated and reconstructed session every so many stops are
fused: as they are, and one of them after the other left away, 20 mm beside its pose, 20 mm too far, 20 mm too near, flipped (half a turn of
the tracked body about its axis), turned by 72 degrees (the body's markers taken for each other), and replaced by a view of another rig's
object. Prints, a line each: the model's rms and the share of what two right views see that it has, the same of the model without the wrong
view, whether that view alone is left out, and what is said.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

import lpcal
from bench_fuse import Truth, of_mesh, twice_seen
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
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--views", default="2,7", help="which of the stops that are fused are spoilt, one at a time, counted from 0")
    options = parser.parse_args()
    truth = Truth.of(options.rig)
    folders = sorted((options.rig / "surfaces").glob("stop_*"))[:: options.every]
    right = [lpcal.read_surface(folder) for folder in folders]
    print(f"| none | {figures(truth, lpcal.fuse(right), right)} |", flush=True)
    for place in map(int, options.views.split(",")):
        others = [surface for k, surface in enumerate(right) if k != place]
        without = figures(truth, lpcal.fuse(others), others)
        print(f"| {right[place].name} left away | {without} |", flush=True)
        for kind, wrong in spoilt(right[place], lpcal.read_surface(options.other / "surfaces" / folders[place].name)).items():
            model = lpcal.fuse([wrong if k == place else surface for k, surface in enumerate(right)])
            print(f"| {right[place].name} {kind} | {figures(truth, model, others)} | {verdict(model, place)} |", flush=True)


def spoilt(surface: Surface, strange: Surface) -> dict[str, Surface]:
    """A view wrong in each way; `strange` shows another object."""
    wrong: dict[str, Callable[[], Surface]] = {
        "20 mm beside": lambda: moved(surface, [0, 0, 0, OFF_M, 0, 0]),
        "20 mm too far": lambda: grown(surface, OFF_M),
        "20 mm too near": lambda: grown(surface, -OFF_M),
        "flipped": lambda: moved(surface, [0, 0, np.pi, 0, 0, 0]),
        "turned by 72 deg": lambda: moved(surface, [0, 0, np.radians(72), 0, 0, 0]),
        "another object": lambda: replace(strange, name=surface.name, placement=surface.placement),
    }
    return {kind: make() for kind, make in wrong.items()}


def figures(truth: Truth, model: lpcal.ObjectModel, right: list[Surface]) -> str:
    """How near a model is to the truth, and how whole."""
    said = of_mesh(truth, model.vertices_A, twice_seen(truth, right), model.figures.step_m)
    return f"{said['rms_mm']:.3f} mm | {said['completeness_percent']:.2f} %"


def verdict(model: lpcal.ObjectModel, place: int) -> str:
    """Whether the wrong view is left out and no other, and what is said of it or of others."""
    out = [k for k, view in enumerate(model.views) if not view.used]
    word = "left out" if out == [place] else "left out with others" if place in out else "others left out" if out else "used"
    said = [f"{view.name}: {view.why}" for view in model.views if not view.used]
    said += [one for one in model.warnings if "its distance was changed" in one]
    return f"{word} | {'; '.join(said)}"


if __name__ == "__main__":
    main()

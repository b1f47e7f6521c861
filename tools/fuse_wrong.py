"""Wrong captures among right ones: which are named, and what becomes of the model.

``python tools/fuse_wrong.py RIG OTHER_RIG [--every 1] [--views 2,7] [--together]``. Of a simulated and reconstructed session every so
many stops are fused: as they are, and one of them after the other left away, 20 mm beside its pose, 20 mm too far, 20 mm too near,
flipped (half a turn of the tracked body about its axis), turned by 72 degrees (the body's markers taken for each other), and replaced by
a view of another rig's object. Prints, a line each: the model's rms and the share of what two right views see that it has, the same of it
without the wrong view, and what becomes of the wrong view, and of right ones that are left out or remarked. With ``--together`` the views
are wrong at once: all in the same way (moved together they confirm each other), and the first of them flipped, the next 20 mm too near,
and so on.
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
from lpcal.records.model import ViewInModel
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
    parser.add_argument("--together", action="store_true", help="spoil them all at once")
    options = parser.parse_args()
    truth = Truth.of(options.rig)
    folders = sorted((options.rig / "surfaces").glob("stop_*"))[:: options.every]
    right = [lpcal.read_surface(folder) for folder in folders]
    print(f"| none | {figures(truth, lpcal.fuse(right), right)} |", flush=True)
    places = [int(word) for word in options.views.split(",")]
    strange = [lpcal.read_surface(options.other / "surfaces" / folder.name) for folder in folders]
    if options.together:
        together(truth, right, strange, places)
        return
    for place in places:
        others = [surface for k, surface in enumerate(right) if k != place]
        without = figures(truth, lpcal.fuse(others), others)
        print(f"| {right[place].name} left away | {without} |", flush=True)
        for kind, wrong in spoilt(right[place], strange[place]).items():
            model = lpcal.fuse([wrong if k == place else surface for k, surface in enumerate(right)])
            print(f"| {right[place].name} {kind} | {figures(truth, model, others)} | {verdict(model, [place])} |", flush=True)


def together(truth: Truth, right: list[Surface], strange: list[Surface], places: list[int]) -> None:
    """The figures with several views wrong at once."""
    others = [surface for k, surface in enumerate(right) if k not in places]
    print(f"| without {', '.join(right[k].name for k in places)} | {figures(truth, lpcal.fuse(others), others)} |", flush=True)
    wrong = {k: spoilt(right[k], strange[k]) for k in places}
    kinds = list(wrong[places[0]])
    alike = [[kind] * len(places) for kind in kinds]
    for named in [*alike, [("flipped", "20 mm too near", "another object", "20 mm beside")[k % 4] for k in range(len(places))]]:
        spoilt_views = {k: wrong[k][kind] for k, kind in zip(places, named, strict=True)}
        model = lpcal.fuse([spoilt_views.get(k, surface) for k, surface in enumerate(right)])
        said = ", ".join(f"{right[k].name} {kind}" for k, kind in zip(places, named, strict=True))
        print(f"| {said} | {figures(truth, model, others)} | {verdict(model, places)} |", flush=True)


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


def verdict(model: lpcal.ObjectModel, places: list[int]) -> str:
    """Which of the wrong views are left out, or used with a remark, and which right ones; and what is said of them."""
    remarked = {k: one for k, view in enumerate(model.views) for one in model.warnings if one.startswith(f"{view.name}: its distance")}
    words = []
    for k, view in enumerate(model.views):
        if k in places or not view.used or k in remarked:
            state = "left out" if not view.used else "used, remarked" if k in remarked else "used"
            words.append(f"{'' if k in places else 'right, but '}{state}: {view.name}: {remarked.get(k, view.why or _changed(view))}")
    return "; ".join(words)


def _changed(view: ViewInModel) -> str:
    return f"changed by {1e3 * (view.distance_change_m or 0):+.1f} mm, {view.distance_sigmas:.1f} sigmas"


if __name__ == "__main__":
    main()

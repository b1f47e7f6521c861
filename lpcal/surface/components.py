"""The pieces of a surface as it states them: how far away each is, how surely, and what other distances the images allow.

The largest piece's other distances are those of the search (surface.basins). A small piece that stands apart from what it borders on has a
second answer too: that it touches it. Light between parts of an object falsifies the distance of a small piece by a tenth and more, and
parts of one object mostly hang together.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.geometry.arrays import Array, Labels, Mask
from lpcal.records.surface import Alternative, Component
from lpcal.surface import normals, uncertainty
from lpcal.surface.basins import Basins
from lpcal.surface.integrate import Grid
from lpcal.surface.rounds import Scene, State
from lpcal.surface.sight import Indices

STATED_DISTANCE = 0.003
"""Relative standard deviation of a distance that the user states."""
UNKNOWN_DISTANCE = 0.5
"""Relative standard deviation of a distance that nothing determines."""
SMALL = 0.12
"""Share of the object's pixels under which a piece that stands apart may in truth touch the rest: of 5 larger ones of 180 drawn scenes that
stand a tenth apart or more none did (tools/fit_distance_sigma.py)."""
TOUCHES, TOUCH_STD = 0.5, 0.04
"""Odds that such a piece touches what it borders on, and the relative standard deviation of its distance from there if so: of 14 such
pieces of the same scenes 10 were nearer to the truth where they touch, off by .03 at the median."""
BORDER = 20
"""Pairs of neighbouring pixels of two pieces from which the piece borders on the rest."""


def of(scene: Scene, state: State, depth: Array, label: Labels, basins_found: Basins | None) -> tuple[Component, ...]:
    """The pieces by depths (P,) and labels (P,)."""
    found: list[Component] = []
    for one in np.unique(label):
        inside = label == one
        middle = float(depth[inside].mean())
        curvature = float(state.own.curvature[inside].sum())
        if scene.distance_m is not None and one == 1:
            std = STATED_DISTANCE
        elif scene.near:
            fewer = uncertainty.fewer_regions(int(inside.sum()), found[0].pixels) if found else 1.0
            model = state.anchors[int(one)].std if int(one) in state.anchors else fewer * model_std(state, inside)
            std = uncertainty.scale_std(scene.lights, curvature, middle, model)
            std = float(np.hypot(std, np.median(state.moved[inside]))) if state.moved is not None else std
            std = float(np.hypot(std, uncertainty.BROKEN_OFF * np.log(middle / found[0].mean_depth_m))) if found else std
        else:
            std = UNKNOWN_DISTANCE
        others = basins_found.others() if basins_found is not None and one == 1 else []
        alternatives = tuple(Alternative(ratio * middle, std, odds) for ratio, odds in others)
        piece = Component(int(one), int(inside.sum()), middle, std, alternatives)
        if scene.near and found and piece.pixels < SMALL * len(label):
            piece = replace(piece, alternatives=_touching(scene.grid, np.log(depth), label, piece, found))
        found.append(piece)
    return tuple(found)


def model_std(state: State, inside: Mask) -> float:
    """What the model lacks in the distance of a piece (P,): see uncertainty.model_std."""
    shaded = float(np.mean(state.found.used[inside] <= normals.LEAST))
    shine = state.field.gloss
    return uncertainty.model_std(glossy=shine is not None and shine.clear, shaded_share=shaded)


def _touching(grid: Grid, u: Array, label: Labels, piece: Component, larger: list[Component]) -> tuple[Alternative, ...]:
    """The distance at which a piece touches the larger ones, where that is another answer than its own, by log depths u (P,)."""
    step, beside = steps_to_larger(grid.a, grid.b, u, label, piece.label)
    if len(step) < BORDER:
        return ()
    nearest = larger[int(np.argmax(np.bincount(beside))) - 1]
    apart, std = float(np.median(step)), float(np.hypot(nearest.scale_std, TOUCH_STD))
    if abs(apart) <= np.hypot(piece.scale_std, std):
        return ()
    return (Alternative(float(piece.mean_depth_m * np.exp(-apart)), std, TOUCHES),)


def steps_to_larger(a: Indices, b: Indices, u: Array, label: Labels, piece: int) -> tuple[Array, Labels]:
    """By how much u (P,) steps (N,) from larger pieces to this one over the edges of neighbours a, b (edges,), and these pieces' labels."""
    out, into = (label[a] == piece) & (label[b] < piece), (label[b] == piece) & (label[a] < piece)
    return np.concatenate([(u[a] - u[b])[out], (u[b] - u[a])[into]]), np.concatenate([label[b][out], label[a][into]])

"""The reported pieces of a surface: mean depth, its standard deviation, and alternative distances that the images allow.

Alternatives of the largest piece come from the distance search, those of a smaller one from its own sweep (surface.distance_search).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lpcal.geometry.arrays import Array, Labels
from lpcal.integration.of_normals import UNKNOWN_DISTANCE
from lpcal.records.surface import Alternative, Component
from lpcal.surface import distance_search, uncertainty
from lpcal.surface.distance_search import DistanceMinima
from lpcal.surface.rounds import Scene, State
from lpcal.view.constants import STATED_STD, UNLIKELY


def of(scene: Scene, state: State, depth: Array, label: Labels, minima: DistanceMinima | None) -> tuple[Component, ...]:
    """The pieces of depths (P,) with labels (P,)."""
    found: list[Component] = []
    for one in np.unique(label):
        inside = label == one
        middle = float(depth[inside].mean())
        curvature = float(state.own.curvature[inside].sum())
        if scene.distance_m is not None and one == 1:
            std = STATED_STD
        elif scene.near:
            fewer = uncertainty.fewer_regions(int(inside.sum()), found[0].pixels) if found else 1.0
            model = fewer * distance_search.std_of(scene.seen, scene.lights, np.log(depth), inside)
            std = uncertainty.scale_std(scene.lights, curvature, middle, model)
            std = float(np.hypot(std, np.median(state.moved[inside]))) if state.moved is not None else std
            std = float(np.hypot(std, uncertainty.BROKEN_OFF * np.log(middle / found[0].mean_depth_m))) if found else std
        else:
            std = UNKNOWN_DISTANCE
        others = minima.others() if minima is not None and one == 1 else []
        alternatives = tuple(Alternative(ratio * middle, std, odds) for ratio, odds in others)
        piece = Component(int(one), int(inside.sum()), middle, std, alternatives)
        if scene.near and found and scene.distance_m is None:
            piece = _by_its_light(scene, state, np.log(depth), label, piece)
        found.append(piece)
    return tuple(found)


def _by_its_light(scene: Scene, state: State, u: Array, label: Labels, piece: Component) -> Component:
    """A smaller piece with the uncertainty and the alternatives of its own distance sweep, from log depths u (P,)."""
    ends = distance_search.of_piece(
        scene.seen, scene.lights, u, state.lit.interreflected, label == piece.label, float(np.median(u[label == 1]))
    )
    std = max(piece.scale_std, ends.std)
    stated = [
        (shift, odds) for shift, odds in zip(ends.shift, ends.odds, strict=True) if odds > UNLIKELY and abs(shift) > distance_search.APART
    ]
    others = tuple(Alternative(float(piece.mean_depth_m * np.exp(shift)), std, float(odds)) for shift, odds in stated)
    return replace(piece, scale_std=std, alternatives=others)

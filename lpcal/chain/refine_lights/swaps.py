"""Lights whose images bear each other's names: each highlight is nearest to where another wing would put it.

For every light as drawn the highlight in every chrome sphere is foretold; the assignment of names to wings with the least sum of squared
distances is found (Kuhn 1955, by scipy). Another than the stated one is believed when it explains the highlights many times better.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal.chain.refine_lights.geometry_fit import SOURCE_OFFSET_M
from lpcal.chain.refine_lights.measure import CentreMeasurement
from lpcal.errors import DisagreementError
from lpcal.geometry import sphere
from lpcal.records.calibration import Camera, Wings
from lpcal.records.observations import SphereView

BETTER = 9.0


def refuse_swapped(
    lights: Sequence[str], views: Sequence[SphereView], measured: Sequence[CentreMeasurement], camera: Camera, wings: Wings
) -> None:
    """Refuse images under each other's names.

    Raises
    ------
    DisagreementError
        Two lights or more are swapped; they are named.
    """
    names = [wing.name for wing in wings.wings if wing.name in lights]
    rows = [k for k, wing in enumerate(wings.wings) if wing.name in lights]
    cost = np.zeros((len(names), len(names)))
    seen = np.zeros(len(names))
    source_C = wings.H_CL[rows, :3, 3] + SOURCE_OFFSET_M * wings.H_CL[rows, :3, 2]
    for view, centre in zip(views, measured, strict=True):
        foretold = camera.project(sphere.mirror_point(centre.centre_C, view.radius_m, source_C))
        for k, name in enumerate(names):
            if name in view.highlights_px:
                cost[k] += np.sum((foretold - view.highlights_px[name]) ** 2, axis=1)
                seen[k] += 1
    if not seen.all() or np.array_equal(np.argmin(cost, axis=1), np.arange(len(names))):  # each nearest to its own: nothing is swapped
        return
    from scipy.optimize import linear_sum_assignment

    image, wing = linear_sum_assignment(cost)
    stated, best = float(np.trace(cost)), float(cost[image, wing].sum())
    if stated < BETTER * best or np.array_equal(image, wing):
        return
    moved = [f"{names[k]} where {names[j]} should be" for k, j in zip(image, wing, strict=True) if k != j]
    raise DisagreementError(
        f"the highlights stand as if images or cables were swapped: {', '.join(moved)}",
        where="spheres",
        needed="each image lit by the light whose name it bears",
        todo="exchange the cables, the image names, or the lights' settings in panel.yaml",
    )

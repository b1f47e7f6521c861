r"""From placed surfaces to a model, step by step.

1. Points of every view are looked up in every other at the tracked poses; a view that the others contradict is left out (`consensus`).
2. All pairs in one least-squares problem: poses, distances, slow bending (`align`); a view that had to move too far is left out as well.
3. A view that was left out by its tracked pose is reconsidered: it is taken in if, aligned within its sigmas, it fits after all.
4. The signed distance of all views on a grid, its triangles (`volume`), moved onto the views' mean with their normals (`vertices`).
5. What no view saw well, and where the panel should stand next (`missing`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.fusion.align import Aligned, align, compared
from lpcal.fusion.consensus import HEARD, Doubted, agreement, fits_after_all, moved_too_far, outvoted
from lpcal.fusion.missing import missing
from lpcal.fusion.rig_evidence import rig_evidence
from lpcal.fusion.vertices import Vertices, on_the_views
from lpcal.fusion.views import PlacedView
from lpcal.fusion.volume import Over, in_turn, surface_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.records.model import ModelFigures, ObjectModel, ViewInModel
from lpcal.records.outcome import Progress, silent

MOST_LEFT_OUT = 3
"""Views that may be left out after the alignment, one at a time: more than that is no session with some bad views."""
FEWEST = 2
"""Views that a model takes: of one alone `lpcal reconstruct` makes a mesh."""
CONTRADICTION = 3.0
"""By how many sigmas of a vertex views must differ to be said to disagree there."""


def model_of(
    name: str,
    views: Sequence[PlacedView],
    step_m: float | None = None,
    progress: Progress = silent,
    lights: Sequence[Light] | None = None,
    over: Over = in_turn,
) -> ObjectModel:
    """The model of placed views; with the calibrated lights also what the views show of them. `over` has its tiles of space worked on.

    Raises
    ------
    DegenerateError
        Fewer than two views are left that overlap, or none shows a surface.
    """
    H_PC_covariance = shared_covariance(views)
    pairs = compared(views, H_PC_covariance)
    shares = agreement(range(len(views)), pairs)
    out = outvoted(len(views), pairs)
    progress("views compared", len(views) - len(out), len(views))
    while True:
        kept = [k for k in range(len(views)) if k not in {one.index for one in out}]
        if len(kept) < FEWEST or not any(pairs[key].agree for key in pairs if set(key) <= set(kept)):
            raise DegenerateError(
                f"{len(kept)} of {len(views)} surfaces agree, and they do not overlap" if len(kept) >= FEWEST else "one surface is left",
                where=name,
                needed="surfaces that overlap, of one object",
                todo="are they placed in one frame, and is the object the same?",
            )
        aligned = align([views[k] for k in kept], H_PC_covariance, progress)
        doubted = moved_too_far(aligned)
        if not doubted or len(out) >= len(views) // 2 or len(kept) <= FEWEST + 1:
            break
        out.append(Doubted(kept[doubted[0].index], doubted[0].why))
    aligned, kept = _heard_again(views, aligned, kept, out, H_PC_covariance, progress)
    rough = surface_of(aligned.placed, step_m, over)
    progress("surface", 1, 2)
    found = on_the_views(aligned, rough)
    progress("surface", 2, 2)
    model = _model(name, views, kept, out, shares, aligned, found)
    return model if lights is None else replace(model, rig=rig_evidence(aligned, found, lights))


def _heard_again(
    views: Sequence[PlacedView], aligned: Aligned, kept: list[int], out: list[Doubted], H_PC_covariance: Array, progress: Progress
) -> tuple[Aligned, list[int]]:
    """The alignment with those taken in that fit after all; they leave `out`."""
    for doubt in sorted(out, key=lambda one: -one.agreement):
        if doubt.agreement < HEARD:
            break
        tried = sorted([*kept, doubt.index])
        with_it = align([views[k] for k in tried], H_PC_covariance, progress)
        if fits_after_all(with_it, tried.index(doubt.index)):
            aligned, kept = with_it, tried
            out.remove(doubt)
    return aligned, kept


def shared_covariance(views: Sequence[PlacedView]) -> Array:
    """Covariance (6, 6) of the transform whose error all placements share: what their noise leaves of their covariance; zero: none."""
    for view in views:
        by, rest = view.placement.by_handeye, view.placement.covariance - view.placement.noise_covariance
        if abs(np.linalg.det(by)) > 1e-9:
            back = np.linalg.inv(by)
            covariance = back @ rest @ back.T
            values, vectors = np.linalg.eigh((covariance + covariance.T) / 2)
            return np.asarray((vectors * np.maximum(values, 0)) @ vectors.T)
    return np.zeros((6, 6))


def _model(
    name: str,
    views: Sequence[PlacedView],
    kept: Sequence[int],
    out: Sequence[Doubted],
    shares: dict[int, float],
    aligned: Aligned,
    found: Vertices,
) -> ObjectModel:
    why = {one.index: one.why for one in out}
    said = []
    for k, view in enumerate(views):
        share = None if not np.isfinite(shares[k]) else shares[k]
        said.append(_fit(aligned, kept.index(k), share) if k in kept else ViewInModel(view.name, False, why[k], share))
    warnings = [f"{view.name} is left out: {view.why}" for view in said if not view.used]
    warnings += [
        f"{view.name} has too few points in common with the others: placed by its pose alone" for view in said if view.agreement is None
    ]
    triangles = found.triangles
    return ObjectModel(
        name,
        views[0].placement.frame,
        triangles.vertices_A,
        found.normals_A,
        triangles.faces,
        found.albedo,
        found.sigma_m,
        found.normal_sigma_rad,
        found.disagreement_m,
        found.views,
        tuple(said),
        _figures(aligned, found),
        tuple(warnings),
        missing(aligned, found),
    )


def _fit(aligned: Aligned, place: int, share: float | None) -> ViewInModel:
    """How a view that was used fits."""
    one = aligned.placed[place]
    before = one.view.placement.H_AC
    pixel = np.column_stack([one.column, one.row]).astype(float)
    delta = one.bending.at(one.field, pixel, one.view.component[one.row, one.column])
    rms = [fit.rms_m for key, fit in aligned.pairs.items() if place in key and fit.agree]
    return ViewInModel(
        one.view.name,
        True,
        None,
        share,
        moved_m=float(np.linalg.norm(one.H_AC[:3, 3] - before[:3, 3])),
        turned_rad=float(se3.angle_rad(one.H_AC[:3, :3] @ before[:3, :3].T)),
        distance_change_m=float(np.median(delta)) * one.view.distance_m,
        residual_m=float(np.median(rms)) if rms else None,
        H_AC=one.H_AC,
    )


def _figures(aligned: Aligned, found: Vertices) -> ModelFigures:
    v, faces = found.triangles.vertices_A, found.triangles.faces
    a, b, c = (v[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    two = (found.views[faces] >= 2).all(axis=1)
    apart = (found.disagreement_m > CONTRADICTION * found.sigma_m)[faces].any(axis=1) & two
    edges = np.sort(np.concatenate([faces[:, :2], faces[:, 1:], faces[:, ::2]]), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    open_edges = unique[count == 1]
    pairs = {tuple(sorted(key)) for key, fit in aligned.pairs.items() if fit.agree}
    return ModelFigures(
        before_m=aligned.before_m,
        after_m=aligned.after_m,
        pairs=len(pairs),
        area_m2=float(area.sum()),
        step_m=float(np.median(np.linalg.norm(b - a, axis=1))),
        sigma_m=float(np.median(found.sigma_m)),
        seen_by_two=float(area[two].sum() / area.sum()),
        disagreeing=float(area[apart].sum() / max(area[two].sum(), 1e-30)),
        open_edges_m=float(np.linalg.norm(v[open_edges[:, 0]] - v[open_edges[:, 1]], axis=1).sum()),
        distance_scale=float(aligned.parameters[6]),
        distance_scale_std=float(np.sqrt(aligned.covariance[6, 6])),
    )

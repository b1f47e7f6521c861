r"""From placed surfaces to a model, step by step.

1. Where every view and every piece of it stands; what the others contradict is left out (`registration`).
2. The signed distance of all views on a grid, its triangles (`volume`), moved onto the views' mean (`vertices`), with the detail of their
   normals (`detail`).
3. With the images of the views: each solved again with what all show together, aligned again, and the surface anew (`second_solve`).
4. What no view saw well, and where the panel should stand next (`missing`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.fusion.align import Aligned
from lpcal.fusion.consensus import MOST_SCALE_SIGMAS, usual_growth
from lpcal.fusion.missing import missing
from lpcal.fusion.piece_distances import Piece
from lpcal.fusion.registration import Registered, registered
from lpcal.fusion.rig_evidence import rig_evidence
from lpcal.fusion.second_solve import Images, again
from lpcal.fusion.vertices import Vertices, on_the_views
from lpcal.fusion.views import PlacedView
from lpcal.fusion.volume import Over, in_turn, surface_of
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.records.model import ModelFigures, ObjectModel, PieceInModel, ViewInModel
from lpcal.records.outcome import Progress, silent

CONTRADICTION = 3.0
"""By how many sigmas of a vertex views must differ to be said to disagree there."""


def model_of(
    name: str,
    views: Sequence[PlacedView],
    step_m: float | None = None,
    progress: Progress = silent,
    lights: Sequence[Light] | None = None,
    over: Over = in_turn,
    images: Images | None = None,
) -> ObjectModel:
    """The model of placed views; with the calibrated lights also what the views show of them. `over` has its tiles of space worked on.

    With their `images` the views are solved again once a first surface is known.

    Raises
    ------
    DegenerateError
        Fewer than two views are left that overlap, or none shows a surface.
    """
    places = registered(name, views, shared_covariance(views), progress)
    aligned = places.aligned
    rough = surface_of(aligned.placed, step_m, over)
    reflectance = None
    if images is not None:
        aligned, reflectance = again(aligned, rough, images, progress)
        places = replace(places, aligned=aligned)
        rough = rough if reflectance is None else surface_of(aligned.placed, step_m, over)
    progress("surface", 1, 2)
    found = on_the_views(aligned, rough)
    progress("surface", 2, 2)
    model = _model(name, views, places, found)
    model = replace(model, figures=replace(model.figures, reflectance=reflectance))
    return model if lights is None else replace(model, rig=rig_evidence(aligned, found, lights))


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


def _model(name: str, views: Sequence[PlacedView], places: Registered, found: Vertices) -> ObjectModel:
    aligned, kept = places.aligned, places.kept
    largest = {k: max((one for one in places.pieces[k] if one.why is None), key=lambda one: one.pixels) for k in kept}
    usual = {k: usual_growth([one.delta for other, one in largest.items() if other != k]) for k in kept}
    said = []
    for k, view in enumerate(views):
        share = None if not np.isfinite(places.shares[k]) else places.shares[k]
        if k in kept:
            sigmas = abs(largest[k].delta - usual[k]) / dict(view.pieces)[largest[k].label]
            fit = _fit(aligned, kept.index(k), share, view)
            said.append(replace(fit, distance_sigmas=float(sigmas), pieces=_pieces(view, places.pieces[k])))
        else:
            said.append(ViewInModel(view.name, False, places.why.get(k, "nothing of it fits the others"), share))
    warnings = [f"{view.name} is left out: {view.why}" for view in said if not view.used]
    warnings += [
        f"{view.name} has too few points in common with the others: placed by its pose alone" for view in said if view.agreement is None
    ]
    for k in kept:
        warnings += _stretched(views[k], largest[k], usual[k], said[k].distance_sigmas or 0.0)
    for one in said:
        lost = [piece for piece in one.pieces if piece.why is not None]
        warnings += [f"{one.name}: a piece of {piece.pixels} pixels is left out: {piece.why}" for piece in lost]
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


def _stretched(view: PlacedView, piece: Piece, usual: float, sigmas: float) -> list[str]:
    """A remark where the distance of a view's largest piece was changed otherwise than the others', by many of its sigmas.

    It is used all the same where too few views would be left without it. `usual` is what the others' logarithms were changed by.
    """
    if sigmas < MOST_SCALE_SIGMAS:
        return []
    by_mm, usual_mm = (1e3 * view.distance_m * np.expm1(delta) for delta in (piece.delta, usual))
    apart = f"the others' by {usual_mm:+z.1f} mm, {sigmas:.1f} of its sigmas apart"
    return [f"{view.name}: its distance was changed by {by_mm:+z.1f} mm, {apart}, to fit the others"]


def _pieces(view: PlacedView, pieces: Sequence[Piece]) -> tuple[PieceInModel, ...]:
    """What became of the pieces of a view."""
    found = []
    for one in pieces:
        grown_m = float(np.nanmedian(view.depth[view.component == one.label])) * np.expm1(one.delta)
        found.append(PieceInModel(one.label, one.pixels, one.why, one.supporters, float(grown_m) if one.why is None else None))
    return tuple(found)


def _fit(aligned: Aligned, place: int, share: float | None, first: PlacedView) -> ViewInModel:
    """How a view that was used fits; `first` is the view as it came, before it was solved again."""
    one = aligned.placed[place]
    before = one.view.placement.H_AC
    pixel = np.column_stack([one.column, one.row]).astype(float)
    grown = np.exp(one.bending.at(one.field, pixel, one.view.component[one.row, one.column]))
    change_m = one.view.depth[one.row, one.column] * grown - first.depth[one.row, one.column]
    rms = [fit.rms_m for key, fit in aligned.pairs.items() if place in key and fit.agree]
    return ViewInModel(
        one.view.name,
        True,
        None,
        share,
        moved_m=float(np.linalg.norm(one.H_AC[:3, 3] - before[:3, 3])),
        turned_rad=float(se3.angle_rad(one.H_AC[:3, :3] @ before[:3, :3].T)),
        distance_change_m=float(np.nanmedian(change_m)),
        residual_m=float(np.median(rms)) if rms else None,
        H_AC=one.H_AC,
        solved_again=one.view.depth is not first.depth,  # pieces and pixels that are left out leave a view's maps as they are
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
        distance_scale_std=float(np.sqrt(aligned.shared_covariance[6, 6])),
        shared_sigma_m=found.shared_sigma_m,
    )

"""Placed surfaces to one model: how near the truth, how honest, which view is named."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest
from scipy import ndimage
from scipy.spatial import cKDTree

import lpcal
from fusion_views import DISTANCE_M, FOCAL_PX, Scene, scene
from lpcal.api import fusing
from lpcal.api.engines import engine_of
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.model_files import read_model, write_model
from lpcal.fusion import align, tiles, vertices, volume
from lpcal.fusion.consensus import outvoted
from lpcal.fusion.missing import loops_of
from lpcal.fusion.model import _fit, shared_covariance
from lpcal.fusion.pair_selection import everyone
from lpcal.fusion.views import fitted, view_of
from lpcal.fusion.volume import held_together, rested
from lpcal.geometry import se3
from lpcal.records.model import ObjectModel
from lpcal.records.surface import Component, Surface

pytest.importorskip("skimage")


@cache
def fused() -> tuple[Scene, ObjectModel]:
    """Ten views of a stone, fused."""
    found = scene()
    return found, lpcal.fuse(found.surfaces)


def test_the_model_is_nearer_than_the_views_and_says_how_near() -> None:
    """Also with a calibration and distances that are off."""
    found, model = fused()
    off_m = found.off_m(model.vertices_A)
    single = []
    for surface in found.surfaces:
        points = se3.apply(surface.placement.H_AC, (surface.rays_C * surface.depth[..., None])[surface.mask].astype(float))
        single.append(float(np.sqrt(np.mean(found.off_m(points) ** 2))))
    assert float(np.sqrt(np.mean(off_m**2))) < 0.6 * float(np.median(single))
    assert np.mean(np.abs(off_m) < 3 * model.sigma_m) > 0.9  # H_PC's error, which all vertices share, is one of two sigmas here
    assert 0 < model.figures.shared_sigma_m < float(np.sqrt(np.mean(model.sigma_m**2)))
    assert model.figures.after_m < model.figures.before_m / 8
    angle = np.degrees(np.arccos(np.clip((found.normals(model.vertices_A) * model.normals_A).sum(axis=1), -1, 1)))
    assert np.median(angle) < 2.0
    assert all(view.used and view.agreement is not None and view.agreement > 0.8 for view in model.views)
    assert not model.warnings
    assert "10 of 10 used" in repr(model)


def test_normals_have_the_sigma_that_the_views_state() -> None:
    """Views whose normals are known to a degree: the mean of several is known better, and its errors are of that size.

    All vertices share a move, which on a bumpy stone leads to other normals: they are compared where each vertex belongs.
    """
    found, model = fused()
    v, n = model.vertices_A, found.normals(model.vertices_A)
    away = v - v.mean(axis=0)
    moves = np.column_stack([n, np.cross(away, n), (away * n).sum(axis=1)])
    by = np.linalg.lstsq(moves, found.off_m(v))[0]
    there = v - by[:3] - np.cross(by[3:6], away) - by[6] * away
    angle = np.arccos(np.clip((found.normals(there) * model.normals_A).sum(axis=1), -1, 1))
    sigma = model.normal_sigma_rad
    assert 0.45 < np.sqrt(np.mean((angle / sigma) ** 2) / 2) < 1.1
    assert np.degrees(np.median(sigma[model.seen_by >= 3])) < 0.75
    assert np.degrees(np.median(sigma[model.seen_by == 1])) == pytest.approx(1.0, rel=0.02)


@pytest.mark.slow
def test_sigmas_are_those_of_the_errors_over_many_rigs() -> None:
    """The mean square of errors in their sigmas is about 1: each rig's shared errors are one draw, so it is told over rigs alone.

    So is that of the part that all vertices share, one motion and one growth of the whole, in its own sigma.
    """
    squares, together = [], []
    for seed in range(3, 11):
        found = scene("stone", 10, seed)
        model = lpcal.fuse(found.surfaces, step_m=0.004)
        off_m = found.off_m(model.vertices_A)
        squares.append(float(np.mean((off_m / model.sigma_m) ** 2)))
        Q = vertices.shared(model.vertices_A, found.normals(model.vertices_A))
        together.append(float(np.mean((Q @ (Q.T @ off_m)) ** 2)) / model.figures.shared_sigma_m**2)
    assert 0.5 < np.mean(squares) < 2, squares
    assert 0.4 < np.mean(together) < 2, together


def test_a_rim_that_normals_hardly_know_has_the_sigma_of_it() -> None:
    """Towards the rims of three views, where one or two see a place, slopes are off by 4 degrees and the normals say so."""
    found, bent = scene(), []
    for surface, side in zip(found.surfaces[:3], (1, -1, 1), strict=True):
        from_edge_px = ndimage.distance_transform_edt(surface.mask)
        slant = np.clip(-np.einsum("ijk,ijk->ij", np.nan_to_num(surface.normals), surface.rays_C), 0.3, 1)
        off_m = side * np.radians(4.0) / slant**2 * np.maximum(8 - from_edge_px, 0) * DISTANCE_M / FOCAL_PX
        std_deg = np.where(surface.mask & (from_edge_px < 8), np.float32(4.0), surface.normal_std_deg)
        bent.append(replace(surface, depth=(surface.depth + off_m).astype(np.float32), normal_std_deg=std_deg))
    model = lpcal.fuse(bent, step_m=0.003)
    ends = model.vertices_A[np.unique(np.concatenate(loops_of(model.faces)))]
    rim = cKDTree(ends).query(model.vertices_A)[0] < 0.006
    off_m = np.abs(found.off_m(model.vertices_A))
    assert np.mean(off_m[rim] < 2 * model.sigma_m[rim]) > 0.9
    assert np.median(model.sigma_m[rim]) > 1.4 * np.median(model.sigma_m[~rim])


def test_a_change_of_distance_counts_what_solving_again_changed() -> None:
    """Solved again 2 % farther, a view stands farther by that against the depth as it came; where its field takes it off, as before."""
    views = [view_of(one, one.placement) for one in scene().surfaces[:3]]
    found = align.align(views, shared_covariance(views))
    before_m = _fit(found, 0, None, views[0]).distance_change_m
    one = found.placed[0]
    again = replace(one, view=replace(one.view, depth=one.view.depth * 1.02))
    back = replace(again, field=np.concatenate([one.field[:1] - np.log(1.02), one.field[1:]]))
    farther_m, same_m = (
        _fit(replace(found, placed=(new, *found.placed[1:])), 0, None, views[0]).distance_change_m for new in (again, back)
    )
    assert farther_m - before_m == pytest.approx(0.02 * one.view.distance_m, rel=0.02)
    assert same_m == pytest.approx(before_m, abs=1e-6)


def test_pairs_of_views_do_not_count_as_if_each_were_new() -> None:
    """Three copies of each of two views make nine pairs of the two, and know thrice what one pair does of the scale of all distances."""
    told = []
    for copies in (1, 3):
        views = [view_of(one, one.placement) for one in scene().surfaces[:2] for _ in range(copies)]
        state = align._start(views)
        problem = align._Problem.of(state, shared_covariance(views))
        N, _ = problem.normal_equations(state, align.all_meetings(state, 0.006, everyone(2 * copies)), 1e-3)
        told.append(float(N.dense()[6, 6]))
    assert told[1] / told[0] == pytest.approx(3, rel=0.15)


def test_all_round_is_closed_and_outward() -> None:
    """An object that is seen all round has few open edges; its faces look outward."""
    found, model = fused()
    a, b, c = (model.vertices_A[model.faces[:, k]] for k in range(3))
    outward = found.normals((a + b + c) / 3)
    assert np.mean((np.cross(b - a, c - a) * outward).sum(axis=1) > 0) > 0.99
    assert model.figures.open_edges_m < 0.3


def test_what_is_not_seen_stays_open() -> None:
    """Views of one side alone give that side."""
    found, whole = fused()
    model = lpcal.fuse(found.surfaces[:3])
    assert model.figures.area_m2 < 0.8 * whole.figures.area_m2
    assert model.figures.open_edges_m > 0.1


def test_a_patch_that_no_view_puts_there_goes() -> None:
    """Of a strip of triangles whose far end no view sees, those with two corners that one does see stay."""
    faces = np.array([[k, k + 1, k + 2] for k in range(6)])
    kept, left = rested(np.arange(8) < 3, faces)
    assert kept.tolist() == [0, 1, 2, 3]
    assert left.tolist() == [[0, 1, 2], [1, 2, 3]]


def test_a_patch_that_one_view_alone_puts_there_and_hardly_knows_goes() -> None:
    """Faces with a loose corner are left out; where none would stay, that is said."""
    faces = np.array([[k, k + 1, k + 2] for k in range(6)])
    kept, left = held_together(faces, np.arange(8) > 4)
    assert kept.tolist() == [0, 1, 2, 3, 4]
    assert left.tolist() == [[0, 1, 2], [1, 2, 3], [2, 3, 4]]
    with pytest.raises(DegenerateError, match="seen by one view alone"):
        held_together(faces, np.ones(8, bool))


def test_a_piece_that_one_view_alone_sees_has_a_sigma_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """However few vertices the covariance is carried to: a small piece beside the object, its distance known to 3 %, is left out."""
    monkeypatch.setattr(vertices, "SIGMA_VERTICES", 10)
    first, *others = scene().surfaces[:3]
    views = [view_of(one, one.placement) for one in (_with_a_scrap(first), *others)]
    aligned = align.align(views, shared_covariance(views))
    found = vertices.on_the_views(aligned, volume.surface_of(aligned.placed, 0.003))
    assert found.loose_m2 > 2e-4
    assert np.abs(scene().off_m(found.triangles.vertices_A)).max() < 0.005


def test_what_stands_before_the_object_is_seen_through() -> None:
    """Places on the surface are seen through by nobody; 15 mm before it, by the views that see the object or the background behind them."""
    views = [view_of(surface, surface.placement) for surface in scene().surfaces]
    placed = align.align(views, shared_covariance(views)).placed
    x_A, n_A, _ = placed[0].points()
    inner = np.einsum("ij,ij->i", n_A, placed[0].H_AC[:3, 3] - x_A) > 0.6 * np.linalg.norm(placed[0].H_AC[:3, 3] - x_A, axis=1)
    assert np.mean(vertices.through(placed, x_A[inner], 0.002) > 0) < 0.02
    assert np.mean(vertices.through(placed, x_A[inner] + 0.015 * n_A[inner], 0.002) >= vertices.OUTVOTED) > 0.95


def _with_a_scrap(surface: Surface) -> Surface:
    """The surface with a second piece in a corner of the image, before the background."""
    inside = np.zeros(surface.mask.shape, bool)
    inside[4:26, 4:26] = True
    assert not (inside & surface.mask).any()
    single = np.float32
    sight = surface.rays_C / np.linalg.norm(surface.rays_C, axis=-1, keepdims=True)
    breaks = surface.breaks.copy()
    breaks[0, :, :-1] &= ~(inside[:, :-1] & inside[:, 1:])
    breaks[1, :-1] &= ~(inside[:-1] & inside[1:])

    def put(values: np.ndarray, new: np.ndarray | float) -> np.ndarray:
        there = inside[..., None] if values.ndim == 3 else inside
        return np.where(there, new, values).astype(values.dtype)

    return replace(
        surface,
        mask=surface.mask | inside,
        depth=put(surface.depth, single(0.35)),
        normals=put(surface.normals, -sight),
        albedo=put(surface.albedo, single(0.6)),
        normal_std_deg=put(surface.normal_std_deg, single(1.0)),
        depth_std=put(surface.depth_std, single(4e-4)),
        component=put(surface.component, 2),
        components=(*surface.components, Component(2, int(inside.sum()), 0.35, 0.03)),
        breaks=breaks,
    )


def test_what_all_views_say_is_the_same_by_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Held a thousand vertices at a time, or all at once."""
    found = scene()
    monkeypatch.setattr("lpcal.fusion.vertices.HELD", 3000)
    by_blocks = lpcal.fuse(found.surfaces[:3], step_m=0.0024)
    monkeypatch.undo()
    at_once = lpcal.fuse(found.surfaces[:3], step_m=0.0024)
    assert len(at_once.vertices_A) > 1000
    np.testing.assert_allclose(by_blocks.vertices_A, at_once.vertices_A, atol=1e-9)
    np.testing.assert_allclose(by_blocks.sigma_m, at_once.sigma_m, rtol=1e-9)
    np.testing.assert_allclose(by_blocks.albedo, at_once.albedo, rtol=0.05)


def test_the_surface_is_the_same_by_tiles(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tiles of a few boxes give the triangles that one gives: joined at their edges, no cell twice, none missing; on workers, too."""
    surfaces = scene().surfaces[:4]
    views = [view_of(surface, surface.placement) for surface in surfaces]
    placed = align.align(views, shared_covariance(views)).placed
    whole = volume.surface_of(placed, 0.0025)
    over_processes = partial(fusing._over, engine_of("processes", 2))
    for across, over in ((3, volume.in_turn), (9, over_processes)):
        monkeypatch.setattr(tiles, "TILE", across)
        by_tiles = volume.surface_of(placed, 0.0025, over)
        if over is volume.in_turn:
            assert len(tiles.tiles_of([one.points()[0] for one in placed], tiles.VoxelGrid(np.array([0.0, 0.0, 0.0]), 0.0025))) > 20
        order, other = (np.lexsort(np.round(one.vertices_A, 6).T) for one in (whole, by_tiles))
        np.testing.assert_allclose(by_tiles.vertices_A[other], whole.vertices_A[order], atol=1e-5)
        assert len(by_tiles.faces) == len(whole.faces)
        assert len(np.unique(np.sort(by_tiles.faces, axis=1), axis=0)) == len(by_tiles.faces)


@pytest.mark.parametrize("kind", ["shifted", "flipped", "other object"])
def test_a_wrong_view_is_named_and_left_out(kind: str) -> None:
    """20 mm beside its pose; turned as a tracker's swapped markers turn it; of something else."""
    surfaces = list(scene().surfaces)
    surfaces[3] = _wrong(surfaces[3], kind)
    views = [view_of(surface, surface.placement) for surface in surfaces]
    pairs = align.compared(views, shared_covariance(views))
    out = outvoted(len(views), pairs)
    assert [one.index for one in out] == [3]
    assert "the others confirm" in out[0].why


@pytest.mark.parametrize(
    "kinds",
    [
        {3: "shifted", 4: "shifted"},
        {3: "shifted", 4: "flipped"},
        {3: "flipped", 4: "other object"},
        {3: "shifted", 5: "other object"},
        {3: "other object", 5: "other object"},
    ],
)
def test_two_wrong_views_at_once_are_named_and_left_out(kinds: dict[int, str]) -> None:
    """Neighbours, and two with a right view between them, which stays: two of ten do not outvote the rest."""
    surfaces = list(scene().surfaces)
    for k, kind in kinds.items():
        surfaces[k] = _wrong(surfaces[k], kind)
    views = [view_of(surface, surface.placement) for surface in surfaces]
    out = outvoted(len(views), align.compared(views, shared_covariance(views)))
    assert sorted(one.index for one in out) == sorted(kinds)


def test_of_two_views_that_differ_nobody_knows_which_is_wrong() -> None:
    """A view that one other alone judges stays until it is aligned; one that two contradict goes."""
    fine, bad = align.PairFit(900, 30, 1e-3), align.PairFit(0, 400, 1e-3)
    ring = {(a, b): fine for a in range(4) for b in range(4) if a != b}
    assert [one.index for one in outvoted(5, ring | {(0, 4): bad})] == []
    assert [one.index for one in outvoted(5, ring | {(0, 4): bad, (4, 1): bad})] == [4]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["shifted", "too far", "flipped", "other object"])
def test_the_model_is_unharmed_by_a_wrong_view(kind: str) -> None:
    """It is as near the truth as with the view in its place; a view that is heard again is not taken in for that."""
    found, whole = fused()
    surfaces = list(found.surfaces)
    surfaces[3] = _wrong(surfaces[3], kind)
    model = lpcal.fuse(surfaces)
    assert [view.name for view in model.views if not view.used] == ["stop_03"]
    assert "stop_03 is left out" in model.warnings[0]
    rms = [float(np.sqrt(np.mean(found.off_m(one.vertices_A) ** 2))) for one in (model, whole)]
    assert rms[0] < 1.5 * rms[1]


def _wrong(surface: Surface, kind: str) -> Surface:
    if kind == "other object":
        other = scene("beast").surfaces[5]
        return replace(other, name=surface.name, placement=surface.placement)
    if kind == "too far":
        return replace(surface, depth=surface.depth * np.float32(1 + 0.02 / 0.35))
    twist = np.array([0, 0, 0, 0.02, 0, 0]) if kind == "shifted" else np.array([0, 0, 1.3, 0, 0, 0])
    return replace(surface, placement=replace(surface.placement, H_AC=surface.placement.H_AC @ se3.exp(twist)))


def test_refused() -> None:
    """What cannot be fused is said."""
    found = scene().surfaces
    with pytest.raises(DegenerateError, match="1 surface"):
        lpcal.fuse(found[:1])
    with pytest.raises(InputError, match="is not placed"):
        lpcal.fuse([found[0], replace(found[1], placement=None)])
    with pytest.raises(DisagreementError, match="the body cart"):
        lpcal.fuse([found[0], replace(found[1], placement=replace(found[1].placement, body="cart"))])
    with pytest.raises(DegenerateError, match="do not overlap"):
        lpcal.fuse([found[0], found[4]])


def test_written_and_read(tmp_path: pytest.TempPathFactory) -> None:
    """What a model's folder holds is what was written, for other readers too."""
    import trimesh

    _, model = fused()
    folder = tmp_path / "model"
    write_model(folder, model, {"times_s": {"fuse": 1.0}})
    again = read_model(folder)
    assert again.views[0].name == "stop_00"
    np.testing.assert_array_equal(again.vertices_A, model.vertices_A)
    np.testing.assert_allclose(again.sigma_m, model.sigma_m, rtol=1e-6)
    assert again.figures == model.figures
    for name in ("mesh.ply", "mesh.glb", "mesh.obj"):
        mesh = trimesh.load(folder / name, force="mesh", process=False)
        assert len(mesh.faces) == len(model.faces)
        np.testing.assert_allclose(np.sort(mesh.bounds, axis=0), [model.vertices_A.min(axis=0), model.vertices_A.max(axis=0)], atol=1e-4)
    head = (folder / "mesh.ply").read_bytes()[:800].decode("ascii", "replace")
    assert "property float sigma_m" in head
    assert "comment frame the room, metres" in head


def test_pixels_of_directions() -> None:
    """The polynomial undoes a lens."""
    plane = scene().surfaces[0].rays_C[..., :2]
    pixels = fitted(plane)(plane.reshape(-1, 2))
    row, column = np.indices(plane.shape[:2])
    np.testing.assert_allclose(pixels, np.column_stack([column.ravel(), row.ravel()]), atol=0.01)


def test_derivatives_are_those_of_the_residual() -> None:
    """A step of the parameters changes the residuals by as much as the rows say."""
    surfaces = scene().surfaces[:3]
    views = [view_of(surface, surface.placement) for surface in surfaces]
    state = align._start(views)
    problem = align._Problem.of(state, shared_covariance(views))
    x = np.zeros(problem.size)
    rng = np.random.default_rng(2)
    met = align.all_meetings(problem.moved(state, x), 0.006, everyone(3))[0, 1]
    columns, values = problem._rows(state[0], state[1], 0, 1, met)
    step = 1e-5 * rng.standard_normal(problem.size) * np.r_[np.ones(3), 0.3 * np.ones(3), 1, np.ones(problem.size - 7)]
    moved = problem.moved(state, x + step)
    p_A, _, _ = moved[0].points()
    # the same points of the second view, moved with it
    pixel = met.pixel
    grown = np.exp(moved[1].bending.at(moved[1].field, pixel, met.component))
    q_C = se3.apply(se3.inv(state[1].H_AC), met.q_A) * grown[:, None]
    after = np.einsum("ij,ij->i", met.n_A, p_A[met.index] - se3.apply(moved[1].H_AC, q_C))
    expected = (values * step[columns]).sum(axis=1)
    np.testing.assert_allclose(after - met.residual_m, expected, atol=2e-3 * float(np.abs(expected).max()))

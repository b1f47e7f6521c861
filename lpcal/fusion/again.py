r"""Every view solved again with what all of them together know: where the surface lies, and the light that its parts throw on each other.

Symbols: z the depth of a view as aligned, T_k the light vectors of what the parts of the model reflect (`between`), a the reflectance
of the median patch, I_k the signals of a view at points p of it, V_k B_k the light vectors of its lights, 0 where the model hides them::

    b_i(p; a) = argmin_b sum_k rho((I_k - b . (V_k B_k + T_k(a))) / s_k)            each view i by itself, where lights reach p
    a         = argmin sum_p,i,j rho(b_i / |b_i| - b_j / |b_j|)

Each view has its lights elsewhere, so with a wrong reflectance what is reflected turns its normals another way: where views agree best is
the reflectance of the object, one number for all of them. That all signals fit the model's own normals best says less: these were found
with each view's guess of it. Each view is then solved again at its depth with that light, and takes the place of the first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.errors import LpcalError
from lpcal.fusion.align import SHARED, Aligned, Start, align
from lpcal.fusion.bending import bending_of
from lpcal.fusion.between import Body, at_points
from lpcal.fusion.pairs import Placed
from lpcal.fusion.pieces import cleared
from lpcal.fusion.vertices import albedo_of
from lpcal.fusion.views import PlacedView, renewed
from lpcal.fusion.volume import Triangles
from lpcal.geometry import lambert, se3
from lpcal.geometry.arrays import Array, Index, Mask
from lpcal.integration.integrate import Grid
from lpcal.records.calibration import Calibration
from lpcal.records.observations import Radiance
from lpcal.records.outcome import Progress, silent
from lpcal.records.surface import Surface
from lpcal.segmentation import mask
from lpcal.segmentation.mask import NO_HINTS
from lpcal.surface import bounce, rounds, surroundings
from lpcal.surface import reconstruct as solver
from lpcal.surface.rounds import Held, Scene
from lpcal.view import sight

TRIED = np.arange(0.0, 0.97, 0.16)
"""Reflectances of the median patch that are tried; between them the cost is nearly a parabola."""
APART_RAD = float(np.radians(3.0))
"""Scale of the loss of what two views' normals of a place differ by: most differ by one or two degrees."""
BESIDE_PX = 2.0
"""Points of two views that are so near each other, in footprints of a pixel, are one place."""
LIKE = float(np.cos(np.radians(18.0)))
"""Least cosine between the model's normals at two points of one place."""
INDEPENDENT = 5000.0
"""Pairs that all of them are worth against what reflectance is common: most say the same of the few places that see each other."""
MOST_POINTS, FEWEST_PAIRS = 25_000, 200
"""Points of all views that are compared, about, and pairs of them from which a reflectance is estimated."""
MODEL_STD, OUTLIER, ROUNDS = 0.03, 2.5, 5
"""What the light at a point lacks, a standard deviation, as a share of its brightest signal; the scale of the loss, in standard deviations
of a signal; and rounds of its weights."""
CLEAR, FEWEST_LIGHTS = 0.1, 4
"""Least cosine between the model's normal and a light that counts as reaching a point, and of these the fewest that tell its normal: one
more than needed, so that one in shadow can be found."""
SMOOTHED = 12
"""Vertices whose normals' mean is the model's normal at a point."""

type Images = Callable[[str], tuple[Radiance, Calibration] | None]
"""The linear images of a view, by its name, and the calibration that it was reconstructed with; None where there are none."""


@dataclass(frozen=True)
class ViewSamples:
    """Signals (L, N) at points of one view, their standard deviation, and what lights them."""

    x_A: Array
    n_A: Array
    """(N, 3) points, and the model's normals there."""
    footprint_m: float
    signal: Array
    sigma: Array
    usable: Mask
    lit: Array
    """(L, N, 3) light vectors of the lights in A, 0 where the model hides them."""
    direct: Array
    """(L, Q) irradiance of the model's patches."""
    shares: tuple[Index, Array]


def again(aligned: Aligned, model: Triangles, images: Images, progress: Progress = silent) -> tuple[Aligned, float | None]:
    """The views of an alignment solved again by their images, and aligned again; those without images stay as they are.

    With them comes the reflectance that was found; None: nothing was solved again, for want of images or of places that views share.
    """
    state = aligned.placed
    footprint_m = float(np.median([one.view.footprint_m for one in state]))
    body = Body.of(model, albedo_of(state, model.vertices_A, model.normals_A, footprint_m))
    normals = _Smoothed(model)
    samples = []
    for one in state:
        known = images(one.view.name)
        samples.append(None if known is None else sampled(body, normals, one, *known))
    reflectance = reflectance_of(body, [some for some in samples if some is not None])
    if reflectance is None:
        return aligned, None
    views = []
    for done, (one, some) in enumerate(zip(state, samples, strict=True)):
        known = None if some is None else images(one.view.name)
        if some is not None and known is not None:
            views.append(solved(one, body, body.thrown(some.direct, reflectance), reflectance, known))
        else:
            views.append(one.view)
        progress("views solved again", done + 1, len(state))
    own = []
    for one, view, start in zip(state, views, aligned.starts, strict=True):
        stands = aligned.parameters[start : start + 6 + len(view.pieces)]
        bent = np.zeros(bending_of(view, one.bending.step_px).size - len(view.pieces))
        own.append(np.concatenate([stands, bent if view is not one.view else one.field[len(view.pieces) :]]))
    shared = np.concatenate([aligned.parameters[:7], np.zeros(SHARED - 7)])  # depths hold their tilt and bending now
    start_of = Start(shared, own, [{} for _ in state])
    found = align(views, aligned.H_PC_covariance, progress, start_of, state[0].bending.step_px, aligned.partners)
    return replace(cleared(found), before_m=aligned.before_m), reflectance


class _Smoothed:
    """Normals of a model, each the mean of those about it."""

    def __init__(self, model: Triangles) -> None:
        from scipy.spatial import cKDTree

        self.tree, self.normals_A = cKDTree(model.vertices_A), model.normals_A

    def __call__(self, x_A: Array, n_A: Array) -> Array:
        _, near = self.tree.query(x_A, k=SMOOTHED)
        of = self.normals_A[near]
        mean = (of * (np.einsum("nki,ni->nk", of, n_A) > 0.5)[..., None]).sum(axis=1)
        length = np.linalg.norm(mean, axis=1, keepdims=True)
        return np.where(length > 0.5, mean / np.maximum(length, 1e-12), n_A)


def sampled(body: Body, normals: Callable[[Array, Array], Array], one: Placed, radiance: Radiance, calibration: Calibration) -> ViewSamples:
    """What a view's images show at the points that are compared with other views."""
    lights = sight.lights_of(calibration, radiance)
    maps = sight.grey(radiance, lights)
    row, column = one.row - one.view.image[1], one.column - one.view.image[0]
    x_A, seen_n_A, _ = one.points()
    n_A = normals(x_A, seen_n_A)
    d_C, E = sight.light_vectors(lights, se3.apply(se3.inv(one.H_AC), x_A))
    lit = d_C @ one.H_AC[:3, :3].T * E[..., None]
    for k, light in enumerate(lights):
        lit[k, body.hidden(x_A, n_A, one.H_AC, light)] = 0.0
    signal, sigma = (of[:, row, column].astype(float) for of in (maps.signal, maps.sigma))
    usable, direct = maps.usable[:, row, column], body.direct(one.H_AC, lights)
    return ViewSamples(x_A, n_A, one.view.footprint_m, signal, sigma, usable, lit, direct, body.shares(x_A, n_A))


def reflectance_of(body: Body, samples: Sequence[ViewSamples]) -> float | None:
    """The reflectance of the model's median patch at which views agree best; None where no views show common places."""
    if not samples:
        return None
    pairs = _met(samples)
    if len(pairs) < FEWEST_PAIRS:
        return None
    direct = np.concatenate([some.direct for some in samples])
    ends = np.cumsum([len(some.direct) for some in samples])[:-1]
    n_A = np.concatenate([some.n_A for some in samples])
    costs = []
    for one in TRIED:
        by_view = np.split(body.thrown(direct, float(one)), ends)
        turned = np.concatenate([_normals(some, thrown) for some, thrown in zip(samples, by_view, strict=True)]) - n_A
        square = ((turned[pairs[:, 0]] - turned[pairs[:, 1]]) ** 2).sum(axis=1)
        costs.append(float(np.nanmean(square / (square + APART_RAD**2))))
    odds = INDEPENDENT * np.array(costs) + ((TRIED - bounce.COMMON) / bounce.COMMON_SIGMA) ** 2
    least = int(np.clip(np.argmin(odds), 1, len(TRIED) - 2))
    before, here, after = odds[least - 1 : least + 2]
    shift = np.clip(0.5 * (before - after) / max(before - 2 * here + after, 1e-30), -1, 1)
    return float(np.clip(TRIED[least] + shift * (TRIED[1] - TRIED[0]), *bounce.REFLECTANCES[:: len(bounce.REFLECTANCES) - 1]))


def _met(samples: Sequence[ViewSamples]) -> Index:
    """Pairs (M, 2) of points of two views that lie at one place and face one way."""
    from scipy.spatial import cKDTree

    x_A, n_A = np.concatenate([some.x_A for some in samples]), np.concatenate([some.n_A for some in samples])
    view = np.repeat(np.arange(len(samples)), [len(some.x_A) for some in samples])
    some = np.arange(0, len(x_A), max(len(x_A) // MOST_POINTS, 1))
    pairs = some[cKDTree(x_A[some]).query_pairs(BESIDE_PX * float(np.median([one.footprint_m for one in samples])), output_type="ndarray")]
    a, b = pairs.T
    return np.asarray(pairs[(view[a] != view[b]) & (np.einsum("ni,ni->n", n_A[a], n_A[b]) > LIKE)])


def _normals(some: ViewSamples, thrown: Array) -> Array:
    """Normals (N, 3) in A of points by their signals, with the light of patches (L, Q, 3); NaN where too few lights reach them."""
    light = some.lit + at_points(thrown, some.shares)
    strength = np.linalg.norm(some.lit, axis=2)
    sure = some.usable & (np.einsum("lni,ni->ln", some.lit, some.n_A) > CLEAR * np.maximum(strength, 1e-12))
    variance = some.sigma**2 + (MODEL_STD * some.signal.max(axis=0)) ** 2
    weight = sure / variance
    for _ in range(ROUNDS):
        b, _ = lambert.weighted(light, some.signal, weight)
        square = (some.signal - lambert.predicted(light, np.nan_to_num(b))) ** 2 / variance
        weight = sure / variance / (1 + square / OUTLIER**2) ** 2
    return np.where((sure.sum(axis=0) >= FEWEST_LIGHTS)[:, None], lambert.unit(b)[0], np.nan)


def solved(one: Placed, body: Body, thrown: Array, reflectance: float, known: tuple[Radiance, Calibration]) -> PlacedView:
    """A view solved again with the light (L, Q, 3) of the model's patches."""
    view = one.view
    radiance, calibration = known
    row, column = np.nonzero(view.component > 0)
    pixel = np.column_stack([column, row]).astype(float)
    component = view.component[row, column]
    grown = one.bending.at(one.field, pixel, component)
    by_piece = one.field[one.bending.place[component]]
    depth = view.depth[row, column] * np.exp(grown)
    shown = np.isin(component, np.unique(view.component[view.witness])) & np.isfinite(depth)
    row, column, depth, by_piece = row[shown], column[shown], depth[shown].astype(float), by_piece[shown]
    x_A = se3.apply(one.H_AC, np.column_stack([view.plane[row, column] * depth[:, None], depth]))
    n_A = se3.rotate(one.H_AC, view.normals_C[row, column].astype(float))
    light = at_points(thrown, body.shares(x_A, n_A)) @ one.H_AC[:3, :3]
    inside, scale = np.zeros(radiance.signal.shape[1:3], bool), np.zeros(view.depth.shape)
    inside[view.at][row, column] = True
    scale[row, column] = by_piece
    try:
        surface = reconstructed(radiance, calibration, inside, Held(np.log(depth), light, reflectance))
    except LpcalError:
        return view
    return renewed(view, surface, scale)


def reconstructed(radiance: Radiance, calibration: Calibration, object_mask: Mask, held: Held) -> Surface:
    """The surface of a capture by near lights, of the pixels of a mask (H, W) at which `held` is given.

    Raises
    ------
    DegenerateError
        Too few pixels are lit by three lights.
    DisagreementError
        The images are not of the calibrated camera's size.
    """
    sight.agree_on_size(radiance.name, radiance.signal.shape[1:3], calibration.camera)
    lights = sight.lights_of(calibration, radiance)
    maps, rays_C = sight.grey(radiance, lights), sight.ray_map(radiance.signal.shape[1:3], calibration.camera)
    found = mask.automatic(maps, rays_C, lights, held.distance_m, NO_HINTS, sight.room(radiance), drawn=False)
    _, around = surroundings.found_beside(maps, rays_C, object_mask, found, lights)
    seen = sight.look_at(maps, rays_C, object_mask, central=True)
    scene = Scene(radiance.name, seen, Grid.of(object_mask), lights, None, None, around, held, solver.room_of(radiance, object_mask))
    return solver.surface_of(radiance, scene, rounds.run(scene, held.u, silent), rays_C, None)

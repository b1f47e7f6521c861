r"""Second solve of every view, with the depth and the interreflection of the model of all views.

Symbols: z the depth of a view as aligned, p a place of the model, T_ik the light vectors of the interreflected light there under light k of
view i (`model_interreflection`), a the reflectance of the median patch, I_ik the signals at p of the views i that see it, V_ik B_ik the
light vectors of their lights, 0 where the model occludes them::

    b_p(a) = argmin_b sum_ik rho((I_ik - b . (V_ik B_ik + T_ik(a))) / s_ik)          one albedo and normal of all views that see p
    a      = argmin N / 2 log sum_pik rho(..)  +  prior

Each view has its lights elsewhere, so with a wrong reflectance no one normal explains the signals of all of them. The normals of views that
are solved apart say less: what is reflected comes from the same parts in all views and turns their normals alike. So does the fit of all
signals to the model's own normals: these were found with each view's guess of the light. Each view is then solved again at its depth with
that light, and takes the place of the first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.errors import LpcalError
from lpcal.fusion.align import SHARED, Aligned, Start, align
from lpcal.fusion.correspondences import Placed
from lpcal.fusion.deformation import bending_of
from lpcal.fusion.model_interreflection import PATCHES, Body, at_points
from lpcal.fusion.piece_distances import cleared
from lpcal.fusion.vertices import GATE_PX, albedo_of, evidence
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
from lpcal.surface import interreflection, rounds, surroundings
from lpcal.surface import reconstruct as solver
from lpcal.surface.rounds import OtherViews, Scene
from lpcal.view import pixel_list

TRIED = np.arange(0.0, 0.97, 0.16)
"""Reflectances of the median patch that are tried; between them the cost is nearly a parabola."""
PLACES = 4000
"""Vertices of the model at which signals are compared, about: one number is asked of them."""
FEWEST_VIEWS, FEWEST_PLACES = 2, 100
"""Views that must see a place for it to count, and fewest such places from which a reflectance is estimated."""
INDEPENDENT = float(PATCHES)
"""Signals that all of them are worth against what reflectance is common: what one patch's light lacks is lacking in all that it reaches."""
MODEL_STD, OUTLIER, ROUNDS = 0.01, 2.5, 5
"""What the light at a place lacks, a standard deviation, as a share of its brightest signal in a view (of a knot 0.7 %); the scale of the
loss, in standard deviations of a signal; and rounds of its weights."""
CLEAR = 0.1
"""Least cosine between the model's normal and a light that counts as reaching a place."""
SMOOTHED = 12
"""Vertices whose normals' mean is the model's normal at a point."""

type Images = Callable[[str], tuple[Radiance, Calibration] | None]
"""The linear images of a view, by its name, and the calibration that it was reconstructed with; None where there are none."""


@dataclass(frozen=True)
class ViewSamples:
    """Signals (L, N) of a view at the places that it sees, their standard deviation, and what lights them."""

    place: Index
    """(N,) which of the model's places these are."""
    signal: Array
    sigma: Array
    reached: Mask
    """(L, N) not saturated, and reached by the light."""
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
    x_A, n_A = places_of(model)
    seen = evidence(state, x_A, n_A, GATE_PX * footprint_m).weight > 0
    samples = []
    for one, at in zip(state, seen, strict=True):
        known = images(one.view.name)
        samples.append(None if known is None else sampled(body, x_A, n_A, np.flatnonzero(at), one, *known))
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


def places_of(model: Triangles) -> tuple[Array, Array]:
    """Vertices (P, 3) all over a model, and at each the mean normal (P, 3) of those about it."""
    from scipy.spatial import cKDTree

    some = slice(None, None, max(len(model.vertices_A) // PLACES, 1))
    x_A, n_A = model.vertices_A[some], model.normals_A[some]
    _, near = cKDTree(model.vertices_A).query(x_A, k=min(SMOOTHED, len(model.vertices_A)))
    of = model.normals_A[near]
    mean = (of * (np.einsum("nki,ni->nk", of, n_A) > 0.5)[..., None]).sum(axis=1)
    return x_A, lambert.unit(mean)[0]


def sampled(body: Body, x_A: Array, n_A: Array, place: Index, one: Placed, radiance: Radiance, calibration: Calibration) -> ViewSamples:
    """What a view's images show at those of some places (P, 3) with normals (P, 3) that it sees."""
    from scipy.ndimage import map_coordinates

    x_A, n_A = x_A[place], n_A[place]
    lights = pixel_list.lights_of(calibration, radiance)
    maps = pixel_list.grey(radiance, lights)
    x_C = se3.apply(se3.inv(one.H_AC), x_A)
    column, row = (one.view.to_pixels(x_C[:, :2] / x_C[:, 2:]) - one.view.image[:2]).T
    signal = np.stack([map_coordinates(each.astype(float), [row, column], order=1, mode="nearest") for each in maps.signal])
    at = np.s_[:, np.rint(row).astype(int), np.rint(column).astype(int)]
    d_C, E = pixel_list.light_vectors(lights, x_C)
    lit = d_C @ one.H_AC[:3, :3].T * E[..., None]
    for k, light in enumerate(lights):
        lit[k, body.hidden(x_A, n_A, one.H_AC, light)] = 0.0
    reached = maps.usable[at] & (np.einsum("lni,ni->ln", lit, n_A) > CLEAR * E)
    return ViewSamples(place, signal, maps.sigma[at].astype(float), reached, lit, body.direct(one.H_AC, lights), body.shares(x_A, n_A))


def reflectance_of(body: Body, samples: Sequence[ViewSamples]) -> float | None:
    """The reflectance of the model's median patch with which one normal a place explains the signals of all views best.

    None where too few places are seen by several views.
    """
    views = np.bincount(np.concatenate([some.place for some in samples])) if samples else np.zeros(1, int)
    shared = views >= FEWEST_VIEWS
    if shared.sum() < FEWEST_PLACES:
        return None
    direct = np.concatenate([some.direct for some in samples])
    ends = np.cumsum([len(some.direct) for some in samples])[:-1]
    costs = []
    for one in TRIED:
        by_view = np.split(body.thrown(direct, float(one)), ends)
        lights = [some.lit + at_points(thrown, some.shares) for some, thrown in zip(samples, by_view, strict=True)]
        costs.append(_unexplained(samples, lights, shared))
    odds = INDEPENDENT * np.log(costs) + ((TRIED - interreflection.COMMON) / interreflection.COMMON_SIGMA) ** 2
    least = int(np.clip(np.argmin(odds), 1, len(TRIED) - 2))
    before, here, after = odds[least - 1 : least + 2]
    shift = np.clip(0.5 * (before - after) / max(before - 2 * here + after, 1e-30), -1, 1)
    return float(
        np.clip(TRIED[least] + shift * (TRIED[1] - TRIED[0]), *interreflection.REFLECTANCES[:: len(interreflection.REFLECTANCES) - 1])
    )


def _unexplained(samples: Sequence[ViewSamples], lights: Sequence[Array], shared: Mask) -> float:
    """Robust mean square of what one b a place leaves of the signals of all views, under the light (L, N, 3) of each.

    How bright each capture came out is free.
    """
    b, gain = np.zeros((len(shared), 3)), np.ones(len(samples))
    for done in range(ROUNDS + 1):
        A, c, total, count = np.zeros((len(b), 3, 3)), np.zeros((len(b), 3)), 0.0, 1
        for k, (some, light) in enumerate(zip(samples, lights, strict=True)):
            variance = some.sigma**2 + (MODEL_STD * some.signal.max(axis=0)) ** 2
            weight = (some.reached & shared[some.place]) / variance
            if done:
                expected = lambert.predicted(light, b[some.place])
                square = (some.signal - gain[k] * expected) ** 2 / (variance * OUTLIER**2)
                total += float((weight * variance * square / (1 + square)).sum())
                count += int(np.count_nonzero(weight))
                weight = weight / (1 + square) ** 2
                gain[k] = (weight * expected * some.signal).sum() / max((weight * expected**2).sum(), 1e-300)
            A[some.place] += gain[k] ** 2 * np.einsum("ln,lni,lnj->nij", weight, light, light)
            c[some.place] += gain[k] * np.einsum("ln,lni,ln->ni", weight, light, some.signal)
        ridge = 1e-9 * np.trace(A, axis1=1, axis2=2) + 1e-30
        b = np.linalg.solve(A + ridge[:, None, None] * np.eye(3), c[..., None])[..., 0]
        gain /= gain.mean()
    return total / count


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
        surface = reconstructed(radiance, calibration, inside, OtherViews(np.log(depth), light, reflectance))
    except LpcalError:
        return view
    return renewed(view, surface, scale)


def reconstructed(radiance: Radiance, calibration: Calibration, object_mask: Mask, other_views: OtherViews) -> Surface:
    """The surface of a capture by near lights, of the pixels of a mask (H, W) at which `other_views` are given.

    Raises
    ------
    DegenerateError
        Too few pixels are lit by three lights.
    DisagreementError
        The images are not of the calibrated camera's size.
    """
    pixel_list.agree_on_size(radiance.name, radiance.signal.shape[1:3], calibration.camera)
    lights = pixel_list.lights_of(calibration, radiance)
    maps, rays_C = pixel_list.grey(radiance, lights), pixel_list.ray_map(radiance.signal.shape[1:3], calibration.camera)
    found = mask.automatic(maps, rays_C, lights, other_views.distance_m, NO_HINTS, pixel_list.room(radiance), drawn=False)
    around = surroundings.found_beside(maps, rays_C, object_mask, found, lights)
    seen = pixel_list.list_pixels(maps, rays_C, object_mask, central=True)
    scene = Scene(radiance.name, seen, Grid.of(object_mask), lights, None, None, around, other_views, solver.room_of(radiance, object_mask))
    return solver.surface_of(radiance, scene, rounds.run(scene, other_views.u, silent), rays_C, None)

"""The alternating rounds of a reconstruction: light at the present depth -> normals -> steps and own distances of the pixels -> depth.

From round SHAPE_ROUND on the depth also gives occlusion (which lights the surface hides from a pixel) and interreflection.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Mask
from lpcal.integration import jumps, pieces
from lpcal.integration.integrate import Grid, Own, integrate, settle, steps
from lpcal.records.calibration import Light
from lpcal.records.outcome import Progress
from lpcal.shading import field, normals
from lpcal.shading.field import Field
from lpcal.shading.normals import Estimate
from lpcal.surface import contrast, distance, distance_search, interreflection
from lpcal.surface.relief import Relief
from lpcal.surface.scales import Blocks
from lpcal.surface.surroundings import Around
from lpcal.view import parallel, pixel_list
from lpcal.view.coarse import SPAN
from lpcal.view.constants import FEWEST_PIXELS, LEAST_COSINE, REGULARISATION, SHADOW_STEPS, STATED_STD
from lpcal.view.crop import Crop
from lpcal.view.pixel_list import Illumination, PixelList

ROUNDS = 9
"""Largest number of rounds: two settle the depth, the others what depends on it."""
SETTLED = 2e-4
"""Median change of log depth below which a round is the last: a thirtieth of the smallest relative standard deviation of a distance."""
SETTLED_PIECE = 10 * SETTLED
"""The same for the smaller pieces, whose distances are less certain."""
SHAPE_ROUND = distance_search.GRADUATED
"""From which on the depth is good enough to find gloss, occlusion and interreflection; only later rounds may be the last."""
SHADED = 0.6
"""A sample whose light the depth occludes is left out where it is darker than this share of the unoccluded prediction."""
CARRIED_ROUNDS = 4
"""Rounds of the field (shading.field) at full size, starting from that of the blocks."""
FULL_ROUNDS = 3
"""Largest number of rounds at full size after those of the blocks."""


@dataclass(frozen=True)
class State:
    """The estimates after a round: P pixels."""

    u: Array
    """(P,) log depth, or depth in pixels without a camera."""
    weight: Array
    """(edges,) weights of the edges (integration.integrate)."""
    normals: Array
    """(P, 3)."""
    found: Estimate
    """Which samples agree with the normals, and their residuals."""
    own: Own
    """Each pixel's own distance."""
    lit: Illumination
    """The light under which the normals were estimated."""
    field: Field
    """The field of the normals, with the gloss of the object."""
    reflects: interreflection.Reflectance | None = None
    """The reflectance that interreflection shows, and the shares of its modelled parts; None before it is estimated."""
    moved: Array | None = None
    """(P,) absolute change of u in the last round; None after the first."""


@dataclass(frozen=True)
class OtherViews:
    """What a model fused from several views says of this view's surface: P pixels."""

    u: Array
    """log depth."""
    interreflected: Array
    """(L, P, 3) light vectors of the interreflected light, parts that this view does not see included."""
    reflectance: float
    """Reflectance of the object's median pixel."""

    def in_blocks(self, blocks: Blocks) -> OtherViews:
        """The same for blocks of pixels."""
        interreflected = np.stack([np.stack([blocks.means(column) for column in one.T], axis=1) for one in self.interreflected])
        return replace(self, u=blocks.means(self.u), interreflected=interreflected)

    @property
    def distance_m(self) -> float:
        """Median depth."""
        return float(np.exp(np.median(self.u)))

    def own(self) -> Own:
        """Each pixel's own distance, with standard deviation STATED_STD: far less certain than the steps, which determine the shape."""
        return Own(np.full(len(self.u), STATED_STD**-2.0), self.u)


@dataclass(frozen=True)
class Scene:
    """What does not change through the rounds."""

    name: str
    seen: PixelList
    grid: Grid
    lights: tuple[Light, ...]
    focus_C: Array | None
    """(3,) point at which the lights' directions and irradiance are taken, where they count as distant; None: they are near."""
    distance_m: float | None = None
    """Median depth of the largest piece, where it is stated."""
    around: Around | None = None
    """Planes around the object that reflect light onto it."""
    other_views: OtherViews | None = None
    """What a model of several views says; None for a single view."""
    room: Array | None = None
    """(P,) signal of the ambient image; None without one."""
    of_object: float = 1.0
    """Probability that the pixels show an object and not its support or wall: the weight of the prior of normals (surface.normal_prior)."""

    @property
    def near(self) -> bool:
        """Whether the lights are near, so that they determine the distance."""
        return self.focus_C is None

    @cached_property
    def break_cost(self) -> Array:
        """(edges,) cost of a depth discontinuity at each edge, by the contrast of the images there."""
        return contrast.break_costs(self.seen, self.grid)

    def closely(self) -> Scene:
        """The same with maps cropped to the object."""
        cut = Crop.about(self.seen.mask).of(self.seen.mask)
        return self if cut.shape == self.seen.mask.shape else replace(self, seen=replace(self.seen, mask=cut))

    def lit_at(self, depth: Array, interreflected: Array | None = None) -> Illumination:
        """The light at depths (P,)."""
        return Illumination(*pixel_list.light_vectors(self.lights, self.seen.points_C(depth), self.focus_C), interreflected)

    def slope_at(self, depth: Array, some: slice) -> Array:
        """Derivatives (L, Q, 3) of the lights' vectors by log depth at some of the pixels, by depths (P,) of all."""
        return pixel_list.light_slopes(self.lights, self.seen.rays_C[some] * depth[some, None])


def run(scene: Scene, begin: Array, progress: Progress) -> State:
    """All rounds, from log depths `begin` (P,); large objects first in blocks of pixels (surface.scales), then at full size."""
    scene = scene.closely()
    blocks = Blocks.of(scene.seen, scene.grid) if scene.near else None
    if blocks is None:
        return _until_settled(scene, once(scene, begin, None, 0), 1, progress)
    other_views = None if scene.other_views is None else scene.other_views.in_blocks(blocks)
    coarse = replace(scene, seen=blocks.coarse, grid=blocks.coarse_grid, other_views=other_views)

    def in_blocks(what: str, done: int, total: int) -> None:
        progress(f"{what} in coarse pixels", done, total)

    settled = _until_settled(coarse, once(coarse, blocks.means(begin), None, 0), 1, in_blocks)
    return _until_settled(scene, _carried(scene, blocks, settled), ROUNDS - FULL_ROUNDS, progress, interreflection_known=True)


def _until_settled(scene: Scene, state: State, first: int, progress: Progress, *, interreflection_known: bool = False) -> State:
    """The state after rounds `first`, `first` + 1, ..., until one changes next to nothing."""
    rounds = ROUNDS if scene.near else 1
    for k in range(first, rounds):
        progress(f"{scene.name}: normals and depth", k, rounds)
        before, state = state, once(scene, state.u, state, k, interreflection_known=interreflection_known)
        state = replace(state, moved=np.abs(state.u - before.u))
        if k > SHAPE_ROUND and _settled(scene, state):
            break
    progress(f"{scene.name}: normals and depth", rounds, rounds)
    return state


def _carried(scene: Scene, blocks: Blocks, state: State) -> State:
    """The state of the blocks, interpolated to the pixels."""
    tilt_rad = None if state.field.tilt_rad is None else state.field.tilt_rad[blocks.of_pixel]
    whole = Field(blocks.between(state.field.b), blocks.estimate(state.field.estimate), state.field.gloss, tilt_rad)
    u = blocks.front(state.u, state.normals)
    return State(
        u,
        blocks.edges(state.weight),
        lambert.unit(whole.b)[0],
        blocks.estimate(state.found),
        blocks.own(state.own),
        blocks.lit(scene.lit_at(np.exp(u)), state.lit),
        whole,
        state.reflects,
    )


def _settled(scene: Scene, state: State) -> bool:
    """Whether the last round changed next to nothing, in the largest piece and in all others."""
    if state.moved is None:
        return False
    label = pieces.pieces(scene.grid, state.weight, scene.seen.mask)
    return all(np.median(state.moved[label == one]) < (SETTLED if one == 1 else SETTLED_PIECE) for one in np.unique(label))


def once(scene: Scene, u: Array, before: State | None, k: int = ROUNDS, *, interreflection_known: bool = False) -> State:
    """Round k from u (P,) and the state before; with `interreflection_known` its interreflection and gloss are kept.

    Raises
    ------
    DegenerateError
        Too few pixels are lit by three lights.
    """
    scene = scene.closely()
    seen, grid = scene.seen, scene.grid
    depth = np.exp(u) if seen.central else np.ones_like(u)
    lit = scene.lit_at(depth)
    shaped = before if k >= SHAPE_ROUND else None
    reflects = hidden = None
    if shaped is not None:
        by_object, hidden = hidden_lights(scene, depth, shaped, lit)
        if scene.other_views is not None:
            lit, reflects = _by_other_views(scene, depth, shaped, lit)
        elif interreflection_known:
            lit, reflects = replace(lit, interreflected=shaped.lit.interreflected, unseen=shaped.lit.unseen), shaped.reflects
        else:
            lit, reflects = _interreflected(scene, depth, shaped, lit, by_object, hidden)
    usable = normals.candidates(seen, lit.E, hidden)
    glossy = (k >= SHAPE_ROUND or not scene.near) and not interreflection_known
    whole = _estimated(
        scene,
        lit,
        usable,
        hidden,
        before,
        interreflection.COMMON if glossy else None,
        CARRIED_ROUNDS if interreflection_known else None,
    )
    found, n = whole.estimate, lambert.unit(whole.b)[0]
    step = steps(grid, n, seen.rays_C, central=seen.central, tilt_rad=whole.tilt_rad, break_cost=scene.break_cost)
    by_light, own = _own(scene, u, depth, lit, found)
    u, weight = integrate(grid, step, own, u, graduated=scene.near and shaped is None)
    if scene.near and shaped is not None and not interreflection_known:
        u, weight = jumps.jumped(grid, step, own, u)
    weight = pieces.without_slivers(grid, weight, seen.mask)
    u = settle(grid, step, own, u, weight)
    if scene.near:
        u = distance.levelled(by_light, u, pieces.connected(grid, weight > pieces.BREAK_WEIGHT))
        u = np.clip(u, *(np.median(u) + np.log(SPAN)))  # only wrong slopes lead further
    if scene.distance_m is not None and seen.central:
        largest = pieces.pieces(grid, weight, seen.mask) == 1
        u = u + np.log(scene.distance_m) - np.median(u[largest])
    return State(u, weight, n, found, own, lit, whole, reflects)


def _own(scene: Scene, u: Array, depth: Array, lit: Illumination, found: Estimate) -> tuple[Own, Own]:
    """Own distances of the pixels, by light or by other views; and the same downweighted where interreflection is poorly known."""
    if scene.other_views is not None:
        own = scene.other_views.own()
        return own, own
    if not scene.near:
        own = Own(np.full(scene.seen.pixels, REGULARISATION), u)
        return own, own
    own = distance.own_distance(lit, partial(scene.slope_at, depth), depth, scene.seen, found)
    return own, distance.doubted(own, lit, scene.seen, found)


def hidden_lights(scene: Scene, depth: Array, before: State, lit: Illumination) -> tuple[Mask, Mask]:
    """Samples (L, P) whose light the object occludes, by its depths (P,), and those occluded by it or by the planes around it.

    Only samples darker than SHADED of the unoccluded prediction count.
    """
    seen = scene.seen
    relief, x_C = Relief.of(seen, depth), seen.points_C(depth)
    albedo = lambert.length(before.field.b)
    expected = albedo * lit.E * np.maximum(lambert.dot(lit.d, before.normals), LEAST_COSINE)
    dark = ~(seen.signal > SHADED * expected)
    by_object, by_any = np.zeros_like(dark), np.zeros_like(dark)

    def of(k: int) -> None:
        source_C = scene.lights[k].source_C
        if source_C is None:
            return
        maybe = np.flatnonzero(dark[k])
        by_object[k, maybe] = relief.hidden_from(x_C[maybe], source_C, SHADOW_STEPS)
        by_any[k] = by_object[k]
        if scene.around is not None:
            by_any[k, maybe] |= scene.around.front.hidden_from(x_C[maybe], source_C, SHADOW_STEPS)

    parallel.run_all(of, range(len(scene.lights)))
    return by_object, by_any


def _interreflected(
    scene: Scene, depth: Array, before: State, lit: Illumination, by_object: Mask, hidden: Mask
) -> tuple[Illumination, interreflection.Reflectance]:
    """The light including interreflection at depths (P,), and the reflectance."""
    seen = scene.seen
    by = interreflection.interreflected(seen, depth, replace(before.found, b=before.field.b), before.normals, scene.lights, scene.around)
    dark = interreflection.in_shadow(seen, lit, before.normals, by_object)
    first = before.reflects or interreflection.reflectance(seen, by, before.field.b, dark)
    begin = replace(lit, interreflected=first.per_unit * by.J(first.sides, first.beyond))
    evidence = interreflection.LitEvidence(first.strengths, *field.strengths_seen(seen, scene.grid, begin, hidden, before.field, by.parts))
    found = interreflection.reflectance(seen, by, before.field.b, dark, evidence)
    return replace(lit, interreflected=found.per_unit * by.J(found.sides, found.beyond), unseen=by.unseen), found


def _by_other_views(scene: Scene, depth: Array, before: State, lit: Illumination) -> tuple[Illumination, interreflection.Reflectance]:
    """The light including the interreflection by the model of several views, and that of the planes around the object."""
    assert scene.other_views is not None
    interreflected, reflectance = scene.other_views.interreflected, scene.other_views.reflectance
    per_unit = reflectance / float(np.median(lambert.length(before.field.b)))
    if scene.around is not None:
        interreflected = interreflected + per_unit * interreflection.from_around(
            scene.seen, depth, before.normals, scene.lights, scene.around
        )
    return replace(lit, interreflected=interreflected, unseen=np.zeros(scene.seen.pixels)), interreflection.Reflectance(
        reflectance, per_unit, 0.0, 0.5
    )


def _estimated(
    scene: Scene,
    lit: Illumination,
    usable: Mask,
    hidden: Mask | None,
    before: State | None,
    glossy: float | None,
    rounds: int | None = None,
) -> Field:
    """Normals, albedo and gloss."""
    seen = scene.seen
    if before is not None:
        return field.solve(seen, scene.grid, lit, hidden, before.field, glossy, rounds)
    start = normals.estimate(seen, lit, usable, normals.variances(seen))
    lit_pixels = int(np.isfinite(start.b[:, 0]).sum())
    if lit_pixels < FEWEST_PIXELS:
        raise DegenerateError(
            f"{lit_pixels} pixels are lit by three lights",
            where=scene.name,
            needed=f"{FEWEST_PIXELS} at least",
            todo="check the mask, the exposure and the ambient image",
        )
    return field.solve(seen, scene.grid, lit, hidden, start, glossy)

"""The rounds of a reconstruction: light at the depth so far -> normals -> steps of depth and each pixel's own distance -> depth.

From the third round on the depth is used for more: which lights the surface hides from a pixel, what its parts reflect onto each other.
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
"""Rounds at most: two settle the depth, the others what depends on it."""
SETTLED = 2e-4
"""Median change of log depth under which a round is the last: a thirtieth of the least relative standard deviation of a distance."""
SETTLED_PIECE = 10 * SETTLED
"""The same of pieces that have broken off, whose distances are less sure."""
SHAPE_ROUND = distance_search.GRADUATED
"""From which on the depth is good enough to find gloss, occlusion and interreflection; only later rounds may be the last."""
SHADED = 0.6
"""A sample of a light that the depth hides is left out where it is darker than this share of what the light would give unoccluded."""
CARRIED_ROUNDS = 4
"""Rounds of the field at full size, from that of the blocks."""
FULL_ROUNDS = 3
"""Most rounds at full size after those of the blocks."""


@dataclass(frozen=True)
class State:
    """Where the rounds are: P pixels."""

    u: Array
    """log depth, or depth in pixels without a camera."""
    weight: Array
    """Weights of the edges."""
    normals: Array
    found: Estimate
    own: Own
    lit: Illumination
    """The light that the normals were found in."""
    field: Field
    """The field of the normals, with the gloss of the object."""
    reflects: interreflection.Reflectance | None = None
    """The reflectance that interreflection shows, and the shares of what is guessed of it; None before it is looked for."""
    moved: Array | None = None
    """(P,) by how much the last round changed u; None before there are two."""


@dataclass(frozen=True)
class Held:
    """What other views say of a surface: P pixels."""

    u: Array
    """log depth."""
    interreflected: Array
    """(L, P, 3) light vectors of what the object's parts throw on each other, those among them that this view does not see."""
    reflectance: float
    """That of the object's median pixel."""

    def in_blocks(self, blocks: Blocks) -> Held:
        """The same for blocks of pixels."""
        interreflected = np.stack([np.stack([blocks.means(column) for column in one.T], axis=1) for one in self.interreflected])
        return replace(self, u=blocks.means(self.u), interreflected=interreflected)

    @property
    def distance_m(self) -> float:
        """Median depth."""
        return float(np.exp(np.median(self.u)))

    def own(self) -> Own:
        """Each pixel's distance: the steps between pixels make the shape, which normals measure to a tenth of its standard deviation."""
        return Own(np.full(len(self.u), STATED_STD**-2.0), self.u)


@dataclass(frozen=True)
class Scene:
    """What stays as it is through the rounds."""

    name: str
    seen: PixelList
    grid: Grid
    lights: tuple[Light, ...]
    focus_C: Array | None
    """Where lights act as they do there; None: they are near."""
    distance_m: float | None = None
    """Median depth of the largest piece, where it is known."""
    around: Around | None = None
    """What stands round the object and reflects light onto it."""
    held: Held | None = None
    """What other views say of it; None: nothing."""
    room: Array | None = None
    """(P,) signal of the image without lights; None where there is none."""
    of_object: float = 1.0
    """Odds that the pixels are an object and not what it stands on or before: by these its normals are turned (surface.normal_prior)."""

    @property
    def near(self) -> bool:
        """Whether the light determines the distance."""
        return self.focus_C is None

    @cached_property
    def break_cost(self) -> Array:
        """(edges,) cost of a depth discontinuity at each edge, by the contrast of the images there."""
        return contrast.break_costs(self.seen, self.grid)

    def closely(self) -> Scene:
        """The same with maps of the object's part of the picture alone: no round depends on what is empty about it."""
        cut = Crop.about(self.seen.mask).of(self.seen.mask)
        return self if cut.shape == self.seen.mask.shape else replace(self, seen=replace(self.seen, mask=cut))

    def lit_at(self, depth: Array, interreflected: Array | None = None) -> Illumination:
        """The light at depths (P,)."""
        return Illumination(*pixel_list.light_vectors(self.lights, self.seen.points_C(depth), self.focus_C), interreflected)

    def slope_at(self, depth: Array, some: slice) -> Array:
        """Derivatives (L, Q, 3) of the lights' vectors by log depth at some of the pixels, by depths (P,) of all."""
        return pixel_list.light_slopes(self.lights, self.seen.rays_C[some] * depth[some, None])


def run(scene: Scene, begin: Array, progress: Progress) -> State:
    """All rounds, from log depths `begin` (P,); of many pixels by blocks of them first, which settle what pixels have in common."""
    scene = scene.closely()
    blocks = Blocks.of(scene.seen, scene.grid) if scene.near else None
    if blocks is None:
        return _until_settled(scene, once(scene, begin, None, 0), 1, progress)
    held = None if scene.held is None else scene.held.in_blocks(blocks)
    coarse = replace(scene, seen=blocks.coarse, grid=blocks.coarse_grid, held=held)

    def in_blocks(what: str, done: int, total: int) -> None:
        progress(f"{what} in coarse pixels", done, total)

    settled = _until_settled(coarse, once(coarse, blocks.means(begin), None, 0), 1, in_blocks)
    return _until_settled(scene, _carried(scene, blocks, settled), ROUNDS - FULL_ROUNDS, progress, interreflection_known=True)


def _until_settled(scene: Scene, state: State, first: int, progress: Progress, *, interreflection_known: bool = False) -> State:
    """The state after rounds from the one of number `first` on, until one changes next to nothing."""
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
    """The state of the blocks at their pixels."""
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
    """One round from u (P,) and the state before, whose reflected light and gloss stay where they are known.

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
        if scene.held is not None:
            lit, reflects = _held(scene, depth, shaped, lit)
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
    """What each pixel says of its own distance by light, or what is known of it; and the same as far as the light is known."""
    if scene.held is not None:
        own = scene.held.own()
        return own, own
    if not scene.near:
        own = Own(np.full(scene.seen.pixels, REGULARISATION), u)
        return own, own
    own = distance.own_distance(lit, partial(scene.slope_at, depth), depth, scene.seen, found)
    return own, distance.doubted(own, lit, scene.seen, found)


def hidden_lights(scene: Scene, depth: Array, before: State, lit: Illumination) -> tuple[Mask, Mask]:
    """Samples (L, P) whose light the object hides, by its depths (P,), and those that it or what it stands on hides.

    The picture must agree: they are darker than with that light.
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
    """The light with what surfaces reflect at depths (P,), and their reflectance."""
    seen = scene.seen
    by = interreflection.interreflected(seen, depth, replace(before.found, b=before.field.b), before.normals, scene.lights, scene.around)
    dark = interreflection.in_shadow(seen, lit, before.normals, by_object)
    first = before.reflects or interreflection.reflectance(seen, by, before.field.b, dark)
    begin = replace(lit, interreflected=first.per_unit * by.J(first.sides, first.beyond))
    evidence = interreflection.LitEvidence(first.strengths, *field.strengths_seen(seen, scene.grid, begin, hidden, before.field, by.parts))
    found = interreflection.reflectance(seen, by, before.field.b, dark, evidence)
    return replace(lit, interreflected=found.per_unit * by.J(found.sides, found.beyond), unseen=by.unseen), found


def _held(scene: Scene, depth: Array, before: State, lit: Illumination) -> tuple[Illumination, interreflection.Reflectance]:
    """The light with what other views say that surfaces reflect, and what the planes about the object do."""
    assert scene.held is not None
    interreflected, reflectance = scene.held.interreflected, scene.held.reflectance
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

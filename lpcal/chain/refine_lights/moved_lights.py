r"""Which light has moved between two days: the chrome spheres of both in one problem.

Symbols: sources s_k of the first day; all of them move together by H and are scaled by 1 + c about their middle m; light k alone moves
by d_k. Spheres of either day have centres C_s, their highlights h are seen at a pixel, their outlines measure their centres::

    s'_k = H ((1 + c) (s_k - m) + m) + d_k                                          the sources of the second day
    highlight:  (project(mirror point of s in the sphere) - h) / sigma
    outline:    W (C_s - measured_s - by_bias_s b),   b of both days, prior as in refine_lights

All d_k are 0 first. Linear about that solution, with A the derivative by d_k that s, H, c, C and b cannot follow and r the residuals::

    d_k = -(A^T A)^-1 A^T r,   F = (gain / 3) / ((r^T r - gain) / freedom),   gain = d_k^T A^T A d_k

and likewise along each axis of the light's own frame: along its arm, sideways (the azimuth turns it there), along its emission (its joint
turns it there). sigma is what the highlights themselves scatter by, not what is stated of them: what is wrong with both days alike, as the
drawing, the radius of the spheres or the camera, cancels or is taken up by H and c. A light that has moved is left free, and the others are
looked at again. Where one camera serves both days, H and c are what the outlines leave open and no more: H = 1 and c = 0 are tried first,
and kept if, the lights that have moved being free, the data ask for no other (F of seven), and no light is named whose move they would
explain as well. Source: generalised least squares; Cook and Weisberg, Residuals and Influence in Regression (1982), 2.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.refine_lights.geometry_fit import BIAS_PX, KINDS
from lpcal.chain.refine_lights.measure import CentreMeasurement, measured_spheres
from lpcal.geometry import rigid_fit, se3, sphere
from lpcal.geometry.arrays import Array, Index
from lpcal.records.calibration import Camera, SphereFinding
from lpcal.records.observations import SphereView

CHROME = KINDS[0]
"""The kind of sphere whose highlights show where lights are."""
OUTLINE_SIGMA_PX, HIGHLIGHT_SIGMA_PX = 0.15, 0.015
"""Scatter of an outline's points and error of a highlight, pixels, where a file of an earlier lpcal does not state them."""
FEWEST_SPHERES = 2
"""Chrome spheres a day: one alone leaves each light's distance open."""
HYPOTHESES = 4
"""What is asked of each light: has it moved anywhere; along its arm; sideways; along its emission."""
SHARED = 7
"""What all lights may share: a shift, a turn, a scale."""
LEAD = 10.0
"""A light is named if another one's chance is so many times its own: of two whose moves would explain the data as well, neither is."""
ROUNDS = 5
"""Gauss-Newton steps: the start is within millimetres, three suffice; the others settle the highlights' scatter."""
STEP = 1e-7
"""Metres and radians of a difference quotient."""
STIFF = 1e-12
"""Share of the largest singular value under which a direction counts as left open by the data and is not moved along."""


@dataclass(frozen=True)
class Day:
    """What the chrome spheres of a day show, and the camera that saw them."""

    spheres: Sequence[SphereFinding]
    camera: Camera

    @property
    def views(self) -> list[SphereView]:
        """Those that were used and have an outline."""
        return [
            SphereView(
                found.name,
                found.kind,
                found.radius_m,
                found.outline_px,
                found.outline_sigma_px if np.isfinite(found.outline_sigma_px) else OUTLINE_SIGMA_PX,
                found.highlights_px,
                {name: found.highlight_sigma_px.get(name, HIGHLIGHT_SIGMA_PX) for name in found.highlights_px},
            )
            for found in self.spheres
            if found.used and found.kind == CHROME and found.radius_m is not None and len(found.outline_px)
        ]


@dataclass(frozen=True)
class MovedLights:
    """How each of L lights has moved against all others, in C of the second day; metres."""

    moved_C: Array
    """(L, 3) d."""
    covariance: Array
    """(L, 3, 3) of d."""
    chance: Array
    """(L,) that an unmoved rig shows a light move by as much, all lights and hypotheses counted."""
    common: Array
    """(7,) shift of the middle, turn, scale of all lights together."""
    scatter_px: float
    """Scatter of the highlights, an axis."""
    freedom: int
    either: tuple[int, ...] = ()
    """Two lights one of which has moved beyond chance, but which of them the data do not say; their `chance` is 1."""
    moved_alone: tuple[int, ...] = ()
    """The lights that are left free when the others are held against each other; of two of which either has moved, the likelier."""
    shared_chance: float = float("nan")
    """That an unmoved rig shows as much of `common`; NaN where two cameras saw the days."""


def moved_lights(before: Day, after: Day, sources_C: Array, axes_C: Array, names: Sequence[str], unlikely: float) -> MovedLights | None:
    """Hold each light against all others, by the spheres of both days.

    Parameters
    ----------
    sources_C : (2, L, 3) metres, about where the lights are on either day
    axes_C : (L, 3, 3) each light's frame on the second day, its axes in columns; NaN where it has none
    names : the lights
    unlikely : a light whose chance is less is left free when the others are held against each other

    Returns
    -------
    MovedLights, or None where a day has fewer than two chrome spheres, or the data are too few to tell.
    """
    problem = _problem(before, after, names, sources_C[0].mean(axis=0))
    found = None if problem is None else problem.solved(sources_C)
    if found is None:
        return None
    if before.camera is not after.camera:
        return _peeled(found, axes_C, unlikely)
    still = _peeled(found.still(), axes_C, unlikely)
    if still is not None and _explains(still, found, unlikely):
        return replace(still, common=found.common, shared_chance=_shared_chance(found, still.moved_alone))
    freed = _peeled(found, axes_C, unlikely)
    return None if freed is None else replace(freed, shared_chance=_shared_chance(found, freed.moved_alone))


def _explains(still: MovedLights, found: _Linear, unlikely: float) -> bool:
    """Whether moves of single lights explain the data without anything that all share, and better than that would alone."""
    said = still.chance.min() if still.moved_alone else 1.0
    return _shared_chance(found, still.moved_alone) >= unlikely and _shared_chance(found, ()) >= (LEAD * said if said < unlikely else 0.0)


def _peeled(found: _Linear, axes_C: Array, unlikely: float) -> MovedLights | None:
    """Each light against all others; one that has moved is left free when the others are looked at again."""
    free: list[int] = []
    while True:
        tested = _tested(found, axes_C, free)
        if tested is None:
            return None
        count = len(tested.chance)
        worst, second = sorted((k for k in range(count) if k not in free), key=lambda k: float(tested.chance[k]))[:2]
        if tested.chance[worst] >= unlikely or len(free) >= count - 3:
            return replace(tested, moved_alone=tuple(free))
        if tested.chance[second] < LEAD * tested.chance[worst]:
            chance = np.where(np.isin(np.arange(count), free), tested.chance, 1.0)
            return replace(tested, chance=chance, either=(worst, second), moved_alone=(*free, worst))
        free.append(worst)


@dataclass(frozen=True)
class _Problem:
    """All spheres of both days, the first day's first."""

    lights: int
    cameras: tuple[Camera, Camera]
    day: Index
    """(S,)."""
    radius_m: Array
    measured: tuple[CentreMeasurement, ...]
    whitening: Array
    """(S, 3, 3)."""
    sphere_of: Index
    """(N,) of each highlight, and the light whose it is."""
    light_of: Index
    seen_px: Array
    weight: Array
    """(N,) relative, by what is stated."""
    middle_C: Array
    """(3,) of the first day's lights, about where they start."""

    def highlights(self, x: Array, own: Array) -> Array:
        """(N, 2) pixels that the highlights lie off what x and moves (L, 3) of single lights predict."""
        sources, centres = self.sources(x, own), self.centres(x)
        found = np.empty_like(self.seen_px)
        for day, camera in enumerate(self.cameras):
            rows = self.day[self.sphere_of] == day
            which = self.sphere_of[rows]
            mirror = sphere.mirror_point(centres[which], self.radius_m[which], sources[day][self.light_of[rows]])
            found[rows] = camera.project(mirror) - self.seen_px[rows]
        return found

    def sources(self, x: Array, own: Array) -> tuple[Array, Array]:
        """(L, 3) of either day."""
        s, common = x[: 3 * self.lights].reshape(-1, 3), x[3 * self.lights : 3 * self.lights + SHARED]
        m = self.middle_C
        return s, se3.apply(_about(m, common[:6]), (1 + common[6]) * (s - m) + m) + own

    def centres(self, x: Array) -> Array:
        """(S, 3)."""
        return x[3 * self.lights + SHARED : -1].reshape(-1, 3)

    def residuals(self, x: Array, own: Array, scatter_px: float) -> Array:
        """All, whitened; those of the highlights first."""
        mean, sigma = BIAS_PX[CHROME]
        off = self.centres(x) - [m.centre_C + m.by_bias * x[-1] for m in self.measured]
        outlines = np.einsum("sij,sj->si", self.whitening, off)
        seen = self.highlights(x, own) * (self.weight / scatter_px)[:, None]
        return np.concatenate([seen.ravel(), outlines.ravel(), [(x[-1] - mean) / sigma]])

    def derivatives(self, x: Array, scatter_px: float) -> tuple[Array, Array, Array]:
        """Residuals (M,), their derivatives (M, P) by x and (M, L, 3) by single lights' moves.

        A residual is of one sphere and one light at most: all lights, and all spheres, take their steps at once.
        """
        nothing, eye = np.zeros((self.lights, 3)), STEP * np.eye(len(x))
        r = self.residuals(x, nothing, scatter_px)
        J, own = np.zeros((len(r), len(x))), np.zeros((len(r), self.lights, 3))
        light, seen = np.repeat(self.light_of, 2), np.arange(2 * len(self.seen_px))
        ball = np.concatenate([np.repeat(self.sphere_of, 2), np.repeat(np.arange(len(self.day)), 3)])
        first = 3 * self.lights + SHARED
        for axis in range(3):
            by_source = (self.residuals(x + eye[axis : 3 * self.lights : 3].sum(axis=0), nothing, scatter_px) - r) / STEP
            by_centre = (self.residuals(x + eye[first + axis : -1 : 3].sum(axis=0), nothing, scatter_px) - r) / STEP
            by_own = (self.residuals(x, nothing + STEP * np.eye(3)[axis], scatter_px) - r) / STEP
            J[seen, 3 * light + axis], own[seen, light, axis] = by_source[seen], by_own[seen]
            J[np.arange(len(ball)), first + 3 * ball + axis] = by_centre[:-1]
        for column in (*range(3 * self.lights, first), len(x) - 1):
            J[:, column] = (self.residuals(x + eye[column], nothing, scatter_px) - r) / STEP
        return r, J, own

    def solved(self, sources_C: Array) -> _Linear | None:
        """The solution in which no light has moved by itself, and its derivatives."""
        H = rigid_fit.fit(sources_C[1], sources_C[0])[0]
        common = se3.log(_shift(-self.middle_C) @ H @ _shift(self.middle_C))
        x = np.concatenate([sources_C[0].ravel(), common, [0.0], np.ravel([m.centre_C for m in self.measured]), [BIAS_PX[CHROME][0]]])
        scatter_px, freedom = HIGHLIGHT_SIGMA_PX, 2 * len(self.seen_px) + 3 * len(self.measured) + 1 - len(x)
        if freedom < HYPOTHESES:
            return None
        for _ in range(ROUNDS):
            r, J, _ = self.derivatives(x, scatter_px)
            size = np.linalg.norm(J, axis=0)
            x = x - np.linalg.lstsq(J / size, r, rcond=STIFF)[0] / size
            off = self.highlights(x, np.zeros((self.lights, 3))) * self.weight[:, None]
            scatter_px = max(float(np.sqrt(np.sum(off**2) / max(freedom - len(self.measured), 1))), STEP)
        r, J, own = self.derivatives(x, scatter_px)
        return _Linear(r, J, own, x[3 * self.lights : 3 * self.lights + SHARED], scatter_px)


@dataclass(frozen=True)
class _Linear:
    r: Array
    J: Array
    own: Array
    """(M, L, 3) by the lights' own moves."""
    common: Array
    scatter_px: float

    def still(self) -> _Linear:
        """The same where the lights share no move: linear about the solution in which they do."""
        shared = np.s_[3 * self.own.shape[1] : 3 * self.own.shape[1] + SHARED]
        off = self.r - self.J[:, shared] @ self.common
        return _Linear(off, np.delete(self.J, shared, axis=1), self.own, np.zeros(SHARED), self.scatter_px)


def _problem(before: Day, after: Day, names: Sequence[str], middle_C: Array) -> _Problem | None:
    """The observations; None where a day has too few spheres."""
    used = [measured_spheres([_of_lights(view, names) for view in one.views], one.camera)[0] for one in (before, after)]
    used = [[pair for pair in day if pair[0].highlights_px] for day in used]
    if min(map(len, used)) < FEWEST_SPHERES:
        return None
    both = [*used[0], *used[1]]
    rows = [(s, names.index(light), view, light) for s, (view, _) in enumerate(both) for light in view.highlights_px]
    return _Problem(
        lights=len(names),
        cameras=(before.camera, after.camera),
        day=np.repeat([0, 1], [len(day) for day in used]),
        radius_m=np.array([view.radius_m for view, _ in both]),
        measured=tuple(m for _, m in both),
        whitening=np.array([np.linalg.inv(np.linalg.cholesky(m.covariance)) for _, m in both]),
        sphere_of=np.array([s for s, *_ in rows]),
        light_of=np.array([k for _, k, *_ in rows]),
        seen_px=np.array([view.highlights_px[light] for *_, view, light in rows]),
        weight=HIGHLIGHT_SIGMA_PX / np.array([view.highlight_sigma_px[light] for *_, view, light in rows]),
        middle_C=middle_C,
    )


def _of_lights(view: SphereView, names: Sequence[str]) -> SphereView:
    """A view with the highlights of these lights alone."""
    return replace(view, highlights_px={light: pixel for light, pixel in view.highlights_px.items() if light in names})


def _tested(found: _Linear, axes_C: Array, free: Sequence[int]) -> MovedLights | None:
    """Each light's own move and its chance; those of `free` move freely meanwhile."""
    from scipy.stats import f as fisher

    lights = found.own.shape[1]
    moved, covariance, chance = np.zeros((lights, 3)), np.zeros((lights, 3, 3)), np.ones(lights)
    freedom = 0
    all_free, but_own = _span(found, free), {k: _span(found, [j for j in free if j != k]) for k in free}
    for k in range(lights):
        Q = but_own.get(k, all_free)
        r, A = (each - Q @ (Q.T @ each) for each in (found.r, found.own[:, k]))
        N, g = A.T @ A, -A.T @ r
        freedom = len(r) - Q.shape[1] - 3
        if freedom < 1 or np.linalg.cond(N) > 1 / STIFF:
            return None
        moved[k] = np.linalg.solve(N, g)
        gain = float(g @ moved[k])
        variance = (float(r @ r) - gain) / freedom
        covariance[k] = variance * np.linalg.inv(N)
        odds = [float(fisher.sf(gain / 3 / variance, 3, freedom))]
        for axis in axes_C[k].T if np.isfinite(axes_C[k]).all() else ():
            alone = float((axis @ g) ** 2 / (axis @ N @ axis))
            odds.append(float(fisher.sf(alone / ((float(r @ r) - alone) / (freedom + 2)), 1, freedom + 2)))
        chance[k] = min(1.0, min(odds) * len(odds) * lights)
    return MovedLights(moved, covariance, chance, found.common, found.scatter_px, freedom)


def _shared_chance(found: _Linear, free: Sequence[int]) -> float:
    """That lights which share no move show as much of one, those of `free` moving as they like."""
    from scipy.stats import f as fisher

    still = found.still()
    least = []
    for one in (found, still):
        Q = _span(one, free)
        least.append(float(one.r @ one.r - np.sum((Q.T @ one.r) ** 2)))
    freedom = len(found.r) - found.J.shape[1] - 3 * len(free)
    return 1.0 if freedom < 1 else float(fisher.sf(max(least[1] - least[0], 0.0) / SHARED / (least[0] / freedom), SHARED, freedom))


def _span(found: _Linear, free: Sequence[int]) -> Array:
    """An orthonormal basis (M, Q) of what the unknowns can follow, the moves of the lights `free` among them."""
    fixed = np.concatenate([found.J, found.own[:, [*free]].reshape(len(found.r), -1)], axis=1)
    return np.linalg.qr(fixed / np.linalg.norm(fixed, axis=0))[0]


def _shift(by_m: Array) -> Array:
    return se3.transform(np.eye(3), by_m)


def _about(middle_C: Array, xi: Array) -> Array:
    """A motion (4, 4) about a point: the turn leaves it where it is."""
    return np.asarray(_shift(middle_C) @ se3.exp(xi) @ _shift(-middle_C))

r"""Where the lights are: wings, sphere centres and chrome highlights in one maximum a posteriori problem.

Symbols: setting q (azimuth, g, d1, d2) of each wing, source offset e on the blob's axis (one for all blobs of a LED mode), sphere
centres C_s, radial bias b of the outlines (one for chrome, one for matte)::

    source_C = H_CD H_DL(q) [0, 0, e]                                    or free, for a light that is no wing
    highlight:  A (P / (P . u) - u) / sigma,   P the mirror point of the source in the sphere, u the ray of the pixel seen
    outline:    W (C_s - measured_s - by_bias_s b)
    camera:     with its parameters free, u + U d for u and measured_s + C_s d for measured_s (`core`)
    priors:     H_CD, q about the drawing; e about -15 +- 30 mm; b about -0.31 +- 0.09 px (chrome), -0.015 +- 0.04 px (matte)

The bias of a chrome outline is real: its rim mirrors what is behind it. Source: maximum a posteriori estimation, Alhazen's mirror
point by Newton's method inside the derivative.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lpcal.chain.refine_lights import residuals
from lpcal.chain.refine_lights.free_camera import ray_slope
from lpcal.chain.refine_lights.measure import CentreMeasurement, local_projection
from lpcal.chain.refine_lights.unknowns import LightUnknown as Unknown
from lpcal.errors import DegenerateError
from lpcal.geometry import se3, sphere
from lpcal.geometry.arrays import Array, Index
from lpcal.geometry.least_squares import POSE, Block, Solution, SolverOptions, Term, compile_residual, independent_prior, prior, solve
from lpcal.geometry.wing import wing_jacobian, wing_transform
from lpcal.records.calibration import Camera, Wings
from lpcal.records.observations import SphereView

SOURCE_OFFSET_M, SOURCE_OFFSET_SIGMA_M = -0.015, 0.030
BIAS_PX = {"chrome": (-0.31, 0.09), "matte": (-0.015, 0.04)}
"""Mean and standard deviation of the radial bias that all outlines of a kind share, in pixels (`tools/outline_errors.py`)."""
KINDS = ("chrome", "matte")
ROBUST = 3.0
FREE_SIGMA_M = 1.0
"""A light of which nothing is known is within this of where its start puts it, twice as far at most."""


@dataclass(frozen=True)
class GeometryFit:
    """The solved geometry. Sources follow the order of `lights`; those that are wings also have a frame."""

    lights: tuple[str, ...]
    wing_of: tuple[int | None, ...]
    """Row in `wings` of each light, None for a free one."""
    source_C: Array
    """(L, 3)."""
    source_covariance: Array
    """(3 L, 3 L), joint."""
    H_CL: Array
    """(L, 4, 4), NaN for a free light."""
    frame_covariance: Array
    """(L, 6, 6) of the left perturbation of H_CL, NaN for a free light."""
    settings: Array
    """(W, 4)."""
    settings_std: Array
    """(W, 4)."""
    H_CD: Array | None
    H_CD_covariance: Array | None
    core: Array
    """(P,) change of the camera's parameters, where they are free."""
    source_offset_m: dict[int, float]
    """By LED mode; 0 where the mode is not stated."""
    centres_C: Array
    """(S, 3)."""
    centres_sigma_m: Array
    """(S,) rms a coordinate."""
    bias_px: dict[str, float]
    highlight_px: dict[tuple[str, str], float]
    """Distance between seen and predicted highlight, by sphere and light."""
    cost: float


def fit_geometry(
    lights: Sequence[str], views: Sequence[SphereView], measured: Sequence[CentreMeasurement], camera: Camera, wings: Wings | None
) -> GeometryFit:
    """Solve for the lights' geometry.

    Raises
    ------
    DegenerateError
        A light that is no wing has no highlight; or the data leave a direction undetermined.
    """
    problem = _Problem(tuple(lights), tuple(views), tuple(measured), camera, wings)
    solution = solve(problem.blocks(), problem.terms(), options=SolverOptions(iterations=200))
    return problem.result(solution)


@dataclass(frozen=True)
class _Problem:
    lights: tuple[str, ...]
    views: tuple[SphereView, ...]
    measured: tuple[CentreMeasurement, ...]
    camera: Camera
    wings: Wings | None

    @property
    def rows(self) -> dict[str, int]:
        """Row of each wing by light name."""
        return {wing.name: k for k, wing in enumerate(self.wings.wings)} if self.wings else {}

    @property
    def core(self) -> int:
        """How many of the camera's parameters are free."""
        return self.measured[0].by_core.shape[1]

    @property
    def free(self) -> list[str]:
        return [light for light in self.lights if light not in self.rows]

    @property
    def modes(self) -> list[int]:
        return sorted({wing.leds or 0 for wing in self.wings.wings}) if self.wings else []

    def blocks(self) -> dict[str, Block]:
        blocks: dict[str, Block] = {
            Unknown.CENTRE: Block(np.array([m.centre_C for m in self.measured])),
            Unknown.BIAS: Block(np.array([[BIAS_PX[kind][0]] for kind in KINDS])),
        }
        if self.wings is not None:
            blocks[Unknown.H_CD] = Block(self.wings.H_CD[None])
            blocks[Unknown.SETTING] = Block(settings_of(self.wings))
            blocks[Unknown.OFFSET] = Block(np.full((len(self.modes), 1), SOURCE_OFFSET_M))
        if self.core:
            blocks[Unknown.CORE] = Block(np.zeros((1, self.core)))
        if self.free:
            blocks[Unknown.SOURCE] = Block(
                np.array([start_of_free_light(light, self.views, self.measured, self.camera) for light in self.free])
            )
        return blocks

    def terms(self) -> list[Term]:
        blocks = self.blocks()
        bias = np.array([BIAS_PX[kind] for kind in KINDS])
        terms = [self._outlines(), independent_prior(Unknown.BIAS, bias[:, :1], bias[:, 1:])]
        if self.wings is not None:
            offset = np.full((len(self.modes), 1), SOURCE_OFFSET_M)
            terms += [
                prior(Unknown.H_CD, blocks[Unknown.H_CD], self.wings.H_CD, self.wings.H_CD_covariance),
                independent_prior(Unknown.SETTING, settings_of(self.wings), self.wings.setting_sigma),
                independent_prior(Unknown.OFFSET, offset, np.array([SOURCE_OFFSET_SIGMA_M])),
            ]
        if self.core:
            assert self.camera.covariance is not None
            terms.append(prior(Unknown.CORE, blocks[Unknown.CORE], np.zeros(self.core), self.camera.covariance))
        if self.free:
            terms.append(independent_prior(Unknown.SOURCE, blocks[Unknown.SOURCE].value, np.array([FREE_SIGMA_M] * 3)))
        terms += [term for term in (self._wing_highlights(), self._free_highlights()) if term is not None]
        return terms

    def _outlines(self) -> Term:
        kinds = np.array([KINDS.index(view.kind) for view in self.views])
        return outline_term(self.measured, kinds)

    def _seen(self, among: Sequence[str]) -> list[tuple[int, str]]:
        return [(s, light) for s, view in enumerate(self.views) for light in view.highlights_px if light in among]

    def _wing_highlights(self) -> Term | None:
        seen = self._seen(list(self.rows))
        if not seen or self.wings is None:
            return None
        row = np.array([self.rows[light] for _, light in seen])
        mode = np.array([self.modes.index(self.wings.wings[k].leds or 0) for k in row])
        which = np.array([s for s, _ in seen])
        return self._highlights(
            residuals.wing_highlight,
            (Unknown.H_CD, Unknown.SETTING, Unknown.OFFSET, Unknown.CENTRE),
            (POSE, 4, 1, 3),
            (0, row, mode, which),
            seen,
        )

    def _free_highlights(self) -> Term | None:
        seen = self._seen(self.free)
        if not seen:
            return None
        row, which = np.array([self.free.index(light) for _, light in seen]), np.array([s for s, _ in seen])
        return self._highlights(residuals.free_highlight, (Unknown.SOURCE, Unknown.CENTRE), (3, 3), (row, which), seen)

    def _highlights(
        self,
        residual: Callable[..., Any],
        names: tuple[str, ...],
        sizes: tuple[int, ...],
        index: tuple[Index | int, ...],
        seen: list[tuple[int, str]],
    ) -> Term:
        data = highlight_data(self.views, seen, self.camera, core=self.core > 0)
        model = compile_residual(residual, (*sizes, *residuals.with_free_core(self.core)), data.shape[1])
        return Term(model, (*names, *[Unknown.CORE] * (self.core > 0)), (*index, *[0] * (self.core > 0)), data, robust=ROBUST, group=2)

    def result(self, solution: Solution) -> GeometryFit:
        names = [
            name for name in (Unknown.H_CD, Unknown.SETTING, Unknown.OFFSET, Unknown.SOURCE, Unknown.CENTRE) if name in solution.blocks
        ]
        covariance = solution.covariance(*names)
        ends = np.cumsum([0, *(solution.blocks[name].count * solution.blocks[name].size for name in names)])
        start = dict(zip(names, ends, strict=False))
        of_lights = [self._light(light, solution, start, len(covariance)) for light in self.lights]
        source_C, H_CL, by_source, by_frame = (list(parts) for parts in zip(*of_lights, strict=True))
        J = np.concatenate(by_source)
        centre_block = covariance[start[Unknown.CENTRE] :, start[Unknown.CENTRE] :]
        wings = self.wings is not None
        return GeometryFit(
            lights=self.lights,
            wing_of=tuple(self.rows.get(light) for light in self.lights),
            source_C=np.array(source_C),
            source_covariance=J @ covariance @ J.T,
            H_CL=np.array(H_CL),
            frame_covariance=np.array([J_frame @ covariance @ J_frame.T for J_frame in by_frame]),
            settings=solution[Unknown.SETTING] if wings else np.zeros((0, 4)),
            settings_std=np.sqrt(np.diag(solution.covariance(Unknown.SETTING))).reshape(-1, 4) if wings else np.zeros((0, 4)),
            H_CD=solution[Unknown.H_CD][0] if wings else None,
            H_CD_covariance=solution.covariance(Unknown.H_CD) if wings else None,
            core=solution[Unknown.CORE][0] if self.core else np.zeros(0),
            source_offset_m={mode: float(solution[Unknown.OFFSET][k, 0]) for k, mode in enumerate(self.modes)},
            centres_C=solution[Unknown.CENTRE],
            centres_sigma_m=np.sqrt(np.diag(centre_block).reshape(-1, 3).mean(axis=1)),
            bias_px={kind: float(solution[Unknown.BIAS][k, 0]) for k, kind in enumerate(KINDS)},
            highlight_px=self._misses(np.array(source_C), solution[Unknown.CENTRE]),
            cost=solution.cost,
        )

    def _light(self, light: str, solution: Solution, start: dict[Unknown, int], width: int) -> tuple[Array, Array, Array, Array]:
        """Source (3,) and frame (4, 4) of a light, and their derivatives (3, width), (6, width) by the unknowns that start so."""
        J_source, J_frame = np.zeros((3, width)), np.full((6, width), np.nan)
        if light not in self.rows:
            k = self.free.index(light)
            first = start[Unknown.SOURCE] + 3 * k
            J_source[:, first : first + 3] = np.eye(3)
            return solution[Unknown.SOURCE][k], np.full((4, 4), np.nan), J_source, J_frame
        assert self.wings is not None
        k = self.rows[light]
        mode = self.modes.index(self.wings.wings[k].leds or 0)
        H_CD, setting, offset = solution[Unknown.H_CD][0], solution[Unknown.SETTING][k], float(solution[Unknown.OFFSET][mode, 0])
        disc, first = start[Unknown.H_CD], start[Unknown.SETTING] + 4 * k
        J_frame = np.zeros((6, width))
        J_frame[:, disc : disc + 6] = np.eye(6)
        J_frame[:, first : first + 4] = se3.adjoint(H_CD) @ wing_jacobian(setting)
        H_CL: Array = H_CD @ wing_transform(setting)
        source_C = H_CL[:3, 3] + offset * H_CL[:3, 2]
        J_source = se3.point_jacobian(source_C) @ J_frame
        J_source[:, start[Unknown.OFFSET] + mode] = H_CL[:3, 2]
        return source_C, H_CL, J_source, J_frame

    def _misses(self, source_C: Array, centres_C: Array) -> dict[tuple[str, str], float]:
        misses = {}
        for s, view in enumerate(self.views):
            for light, seen in view.highlights_px.items():
                if light in self.lights:
                    P = sphere.mirror_point(centres_C[s], view.radius_m, source_C[self.lights.index(light)])
                    misses[view.name, light] = float(np.linalg.norm(self.camera.project(P) - seen))
        return misses


def outline_term(measured: Sequence[CentreMeasurement], kinds: Index) -> Term:
    """Centres against their outlines; `kinds` (S,) the row in KINDS of each sphere."""
    rows = [[m.centre_C, m.by_bias, np.linalg.inv(np.linalg.cholesky(m.covariance)).ravel(), m.by_core.ravel()] for m in measured]
    data, core = np.array([np.concatenate(row) for row in rows]), measured[0].by_core.shape[1]
    model = compile_residual(residuals.outline, (3, 1, *residuals.with_free_core(core)), data.shape[1])
    return Term(model, (Unknown.CENTRE, Unknown.BIAS, *[Unknown.CORE] * (core > 0)), (np.arange(len(data)), kinds, *[0] * (core > 0)), data)


def start_of_free_light(light: str, views: Sequence[SphereView], measured: Sequence[CentreMeasurement], camera: Camera) -> Array:
    """Where the mirrored rays of a light's highlights come nearest to each other, (3,).

    Raises
    ------
    DegenerateError
        No sphere shows its highlight.
    """
    M, y, reach, rays = np.zeros((3, 3)), np.zeros(3), 0.0, []
    for view, m in zip(views, measured, strict=True):
        if light in view.highlights_px:
            P, n = sphere.meet(camera.unproject(view.highlights_px[light]), m.centre_C, view.radius_m)
            r = sphere.reflect(P / np.linalg.norm(P), n)
            across = np.eye(3) - np.outer(r, r)
            M, y, reach = M + across, y + across @ P, float(np.linalg.norm(m.centre_C))
            rays.append((P, r))
    if not rays or not np.isfinite(y).all():
        raise DegenerateError(
            f"no chrome sphere shows the light {light}",
            where=f"light {light}",
            needed="a highlight of it, or its wing's setting",
            todo="add a chrome sphere",
        )
    P, r = rays[0]
    guess = P + reach * r  # one ray alone leaves the distance open: as far from the sphere as the camera is
    along = 1e-3 * np.eye(3)
    found = np.linalg.solve(M + along, y + along @ guess)
    in_front = np.mean([(found - P) @ r for P, r in rays]) > 0
    return np.asarray(found if in_front else guess)


def highlight_data(views: Sequence[SphereView], seen: Sequence[tuple[int, str]], camera: Camera, *, core: bool) -> Array:
    """Data (N, 10 or more) of highlights, each the row of its sphere and its light, as `residuals` has them."""
    pixels = np.array([views[s].highlights_px[light] for s, light in seen])
    sigma = np.array([views[s].highlight_sigma_px[light] for s, light in seen])
    u_C = camera.unproject(pixels)
    A = local_projection(camera, u_C) / sigma[:, None, None]
    slope = ray_slope(camera, pixels).reshape(len(seen), -1) if core else np.zeros((len(seen), 0))
    return np.column_stack([u_C, A.reshape(-1, 6), np.array([views[s].radius_m for s, _ in seen]), slope])


def settings_of(wings: Wings) -> Array:
    """Settings (W, 4) as drawn: azimuth, g (rad), d1, d2 (m)."""
    return np.array([[w.azimuth_rad, w.joint_angle_rad, w.d1_m, w.d2_m] for w in wings.wings])

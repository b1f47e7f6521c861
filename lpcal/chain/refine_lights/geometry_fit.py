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
        blocks = {
            "centre": Block(np.array([m.centre_C for m in self.measured])),
            "bias": Block(np.array([[BIAS_PX[kind][0]] for kind in KINDS])),
        }
        if self.wings is not None:
            blocks["H_CD"] = Block(self.wings.H_CD[None])
            blocks["setting"] = Block(settings_of(self.wings))
            blocks["offset"] = Block(np.full((len(self.modes), 1), SOURCE_OFFSET_M))
        if self.core:
            blocks["core"] = Block(np.zeros((1, self.core)))
        if self.free:
            blocks["source"] = Block(np.array([start_of_free_light(light, self.views, self.measured, self.camera) for light in self.free]))
        return blocks

    def terms(self) -> list[Term]:
        blocks = self.blocks()
        bias = np.array([BIAS_PX[kind] for kind in KINDS])
        terms = [self._outlines(), independent_prior("bias", bias[:, :1], bias[:, 1:])]
        if self.wings is not None:
            offset = np.full((len(self.modes), 1), SOURCE_OFFSET_M)
            terms += [
                prior("H_CD", blocks["H_CD"], self.wings.H_CD, self.wings.H_CD_covariance),
                independent_prior("setting", settings_of(self.wings), self.wings.setting_sigma),
                independent_prior("offset", offset, np.array([SOURCE_OFFSET_SIGMA_M])),
            ]
        if self.core:
            assert self.camera.covariance is not None
            terms.append(prior("core", blocks["core"], np.zeros(self.core), self.camera.covariance))
        if self.free:
            terms.append(independent_prior("source", blocks["source"].value, np.array([FREE_SIGMA_M] * 3)))
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
            residuals.wing_highlight, ("H_CD", "setting", "offset", "centre"), (POSE, 4, 1, 3), (0, row, mode, which), seen
        )

    def _free_highlights(self) -> Term | None:
        seen = self._seen(self.free)
        if not seen:
            return None
        row, which = np.array([self.free.index(light) for _, light in seen]), np.array([s for s, _ in seen])
        return self._highlights(residuals.free_highlight, ("source", "centre"), (3, 3), (row, which), seen)

    def _highlights(
        self,
        residual: Callable[..., Any],
        names: tuple[str, ...],
        sizes: tuple[int, ...],
        index: tuple[Index | int, ...],
        seen: list[tuple[int, str]],
    ) -> Term:
        data = highlight_data(self.views, seen, self.camera, core=self.core > 0)
        model = compile_residual(residual, (*sizes, *with_free_core(self.core)), data.shape[1])
        return Term(model, (*names, *["core"] * (self.core > 0)), (*index, *[0] * (self.core > 0)), data, robust=ROBUST, group=2)

    def result(self, solution: Solution) -> GeometryFit:
        names = [name for name in ("H_CD", "setting", "offset", "source", "centre") if name in solution.blocks]
        covariance = solution.covariance(*names)
        start = dict(
            zip(names, np.cumsum([0, *(solution.blocks[name].count * solution.blocks[name].size for name in names)]), strict=False)
        )
        by_source, by_frame, source_C, H_CL = [], [], [], []
        for light in self.lights:
            J_source, J_frame = np.zeros((3, len(covariance))), np.full((6, len(covariance)), np.nan)
            if light in self.rows:
                k = self.rows[light]
                leds = self.wings.wings[k].leds if self.wings else None
                mode = self.modes.index(leds or 0)
                H_CD, setting, offset = solution["H_CD"][0], solution["setting"][k], float(solution["offset"][mode, 0])
                J_frame = np.zeros((6, len(covariance)))
                J_frame[:, start["H_CD"] : start["H_CD"] + 6] = np.eye(6)
                J_frame[:, start["setting"] + 4 * k : start["setting"] + 4 * k + 4] = se3.adjoint(H_CD) @ wing_jacobian(setting)
                H = H_CD @ wing_transform(setting)
                x = H[:3, 3] + offset * H[:3, 2]
                J_source = se3.point_jacobian(x) @ J_frame
                J_source[:, start["offset"] + mode] = H[:3, 2]
            else:
                k = self.free.index(light)
                H, x = np.full((4, 4), np.nan), solution["source"][k]
                J_source[:, start["source"] + 3 * k : start["source"] + 3 * k + 3] = np.eye(3)
            source_C.append(x)
            H_CL.append(H)
            by_source.append(J_source)
            by_frame.append(J_frame @ covariance @ J_frame.T)
        J = np.concatenate(by_source)
        centre_block = covariance[start["centre"] :, start["centre"] :]
        return GeometryFit(
            lights=self.lights,
            wing_of=tuple(self.rows.get(light) for light in self.lights),
            source_C=np.array(source_C),
            source_covariance=J @ covariance @ J.T,
            H_CL=np.array(H_CL),
            frame_covariance=np.array(by_frame),
            settings=solution["setting"] if "setting" in names else np.zeros((0, 4)),
            settings_std=np.sqrt(np.diag(solution.covariance("setting"))).reshape(-1, 4) if "setting" in names else np.zeros((0, 4)),
            H_CD=solution["H_CD"][0] if "H_CD" in names else None,
            H_CD_covariance=solution.covariance("H_CD") if "H_CD" in names else None,
            core=solution["core"][0] if self.core else np.zeros(0),
            source_offset_m={mode: float(solution["offset"][k, 0]) for k, mode in enumerate(self.modes)},
            centres_C=solution["centre"],
            centres_sigma_m=np.sqrt(np.diag(centre_block).reshape(-1, 3).mean(axis=1)),
            bias_px={kind: float(solution["bias"][k, 0]) for k, kind in enumerate(KINDS)},
            highlight_px=self._misses(np.array(source_C), solution["centre"]),
            cost=solution.cost,
        )

    def _misses(self, source_C: Array, centres_C: Array) -> dict[tuple[str, str], float]:
        misses = {}
        for s, view in enumerate(self.views):
            for light, seen in view.highlights_px.items():
                if light in self.lights:
                    P = sphere.mirror_point(centres_C[s], view.radius_m, source_C[self.lights.index(light)])
                    misses[view.name, light] = float(np.linalg.norm(self.camera.project(P) - seen))
        return misses


def with_free_core(core: int) -> tuple[int, ...]:
    """The size of the block of the camera's parameters, if they are free."""
    return (core,) if core else ()


def outline_term(measured: Sequence[CentreMeasurement], kinds: Index) -> Term:
    """Centres against their outlines; `kinds` (S,) the row in KINDS of each sphere."""
    rows = [[m.centre_C, m.by_bias, np.linalg.inv(np.linalg.cholesky(m.covariance)).ravel(), m.by_core.ravel()] for m in measured]
    data, core = np.array([np.concatenate(row) for row in rows]), measured[0].by_core.shape[1]
    model = compile_residual(residuals.outline, (3, 1, *with_free_core(core)), data.shape[1])
    return Term(model, ("centre", "bias", *["core"] * (core > 0)), (np.arange(len(data)), kinds, *[0] * (core > 0)), data)


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

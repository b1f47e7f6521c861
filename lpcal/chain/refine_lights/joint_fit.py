"""The last fit: wings, sphere centres, highlights and shading together, every LED of every blob free within its scatter.

Starts from the chrome's geometry and the shading's intensities (`geometry_fit`, `shading`); `residuals` holds what they miss by.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.refine_lights import residuals
from lpcal.chain.refine_lights.free_camera import ray_slope
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX, KINDS, ROBUST, GeometryFit, highlight_data, outline_term, settings_of
from lpcal.chain.refine_lights.measure import CentreMeasurement
from lpcal.chain.refine_lights.residuals import Cluster
from lpcal.chain.refine_lights.samples import Samples, sample_blocks
from lpcal.chain.refine_lights.shading import KNOTS_RAD, MODEL_SD, TEXTURE_SD, ShadingFit
from lpcal.chain.refine_lights.unknowns import LightUnknown as Unknown
from lpcal.chain.refine_lights.unknowns import leds_of
from lpcal.chain.refine_lights.volume import volume_points
from lpcal.geometry import led_cluster, se3, sphere
from lpcal.geometry.arrays import Array, Index
from lpcal.geometry.least_squares import Block, Solution, SolverOptions, Term, independent_prior, prior, solve
from lpcal.geometry.wing import wing_transform
from lpcal.records.calibration import Camera, LedCluster, Light, Lobe, Wings
from lpcal.records.observations import SphereView

FIRST_SHARE = 3
"""One block of so many is used in the rough solve."""
ALBEDO_SD = 3.0
SCATTER_WEIGHT = 20.0
"""What is stated of the LEDs' scatter counts as much as so many powers or tilts that were measured."""
STEP = 1e-6


@dataclass(frozen=True)
class JointFit:
    """Lights whose lobe is the sum of their LEDs, and how sure each is."""

    lights: tuple[Light, ...]
    """Without standard deviations and colour."""
    H_CD: Array
    H_CD_covariance: Array
    core: Array
    """(P,) change of the camera's parameters, where they are free."""
    settings: Array
    """(W, 4)."""
    settings_std: Array
    cost: float
    centres_C: Array
    bias_px: dict[str, float]
    dome_m: dict[int, list[float]]
    """Height and radius by mode."""
    highlight_px: dict[tuple[str, str], float]
    shading: dict[str, float]
    """Rms of data over model, as a fraction, by sphere."""
    position_std_m: Array
    direction_std_rad: Array
    """(L,) a tangent axis, rms over the working volume."""
    intensity_std: Array
    """(L,) of the relative irradiance, rms over the working volume."""
    source_C: Array
    """(L, 3) middles of the blobs' domes."""
    source_covariance: Array
    """(3 L, 3 L), joint."""


def can_fit(views: Sequence[SphereView], wings: Wings | None, lights: Sequence[str]) -> bool:
    """Whether every light is a wing of a known LED mode and a matte sphere shows them."""
    drawn = {wing.name: wing.leds for wing in wings.wings} if wings else {}
    return any(view.shading for view in views) and all(drawn.get(light) in led_cluster.RINGS for light in lights)


def fit_jointly(
    start: GeometryFit,
    first: ShadingFit,
    samples: Samples,
    views: Sequence[SphereView],
    measured: Sequence[CentreMeasurement],
    camera: Camera,
    wings: Wings,
    focus_C: Array,
    intensity_sd: float,
) -> JointFit:
    """Solve roughly, from some of the blocks; with all, curved as under the lights found so; with the LEDs' scatter that this shows."""
    problem = _Problem(tuple(start.lights), tuple(views), tuple(measured), camera, wings, intensity_sd)
    few = samples.some(samples.block % FIRST_SHARE == 0)
    blocks = problem.start(start, first, samples) | {Unknown.DELTA: _deltas(few)}
    rough = solve(blocks, problem.terms(blocks, few), eliminate=Unknown.DELTA, options=SolverOptions(iterations=100, tolerance=1e-3))
    samples = sample_blocks(views, rough[Unknown.CENTRE], camera, problem.lights_of(dict(rough.blocks)))
    blocks = dict(rough.blocks) | {Unknown.DELTA: _deltas(samples)}
    options = SolverOptions(iterations=100, tolerance=1e-5)
    solution = solve(blocks, problem.terms(blocks, samples), eliminate=Unknown.DELTA, options=options)
    problem, blocks = replace(problem, scatter=problem.scatter_seen(solution)), dict(solution.blocks)
    solution = solve(blocks, problem.terms(blocks, samples), eliminate=Unknown.DELTA, options=options)
    return problem.result(solution, focus_C)


@dataclass(frozen=True)
class _Problem:
    names: tuple[str, ...]
    views: tuple[SphereView, ...]
    measured: tuple[CentreMeasurement, ...]
    camera: Camera
    wings: Wings
    intensity_sd: float
    scatter: tuple[float, float] = (1.0, 1.0)
    """The LEDs' powers and tilts scatter so many times as much as `residuals` states."""

    @property
    def wing(self) -> Index:
        """Row in the wings of each light."""
        order = [wing.name for wing in self.wings.wings]
        return np.array([order.index(name) for name in self.names])

    @property
    def core(self) -> int:
        """How many of the camera's parameters are free."""
        return self.measured[0].by_core.shape[1]

    @property
    def leds(self) -> list[int]:
        return [int(self.wings.wings[row].leds or 1) for row in self.wing]

    @property
    def modes(self) -> list[int]:
        return sorted(set(self.leds))

    @property
    def mode(self) -> Index:
        return np.array([self.modes.index(leds) for leds in self.leds])

    def start(self, fit: GeometryFit, first: ShadingFit, samples: Samples) -> dict[str, Block]:
        """Where the descent starts from; each blob's roll by trying."""
        assert fit.H_CD is not None
        rolls = []
        for k, leds in enumerate(self.leds):
            own = samples.light == k
            log_lobe = first.log_lobe[own]
            rolls.append(
                [residuals.scan_roll(Cluster(leds), samples.angle_rad[own], samples.around_rad[own], log_lobe) if own.any() else 0.0]
            )
        domes = [[fit.source_offset_m.get(mode, residuals.DOME_M[0]), residuals.DOME_M[1]] for mode in self.modes]
        # with the LEDs' sum normalised on the axis the lobe's own level is 1, but for the LEDs' distance
        blocks = {
            Unknown.H_CD: Block(fit.H_CD[None]),
            Unknown.SETTING: Block(fit.settings),
            Unknown.DOME: Block(np.array(domes)),
            Unknown.ROLL: Block(np.array(rolls)),
            Unknown.INTENSITY: Block(np.log(first.intensity.mean(axis=1))[:, None]),
            Unknown.ALBEDO: Block(np.array([[first.log_albedo.get(s, 0.0)] for s in range(len(self.views))])),
            Unknown.CENTRE: Block(fit.centres_C),
            Unknown.BIAS: Block(np.array([[fit.bias_px[kind]] for kind in KINDS])),
        }
        blocks |= {Unknown.CORE: Block(fit.core[None])} if self.core else {}
        return blocks | {leds_of(mode): Block(np.zeros((len(self.names), 3 * mode))) for mode in self.modes}

    def terms(self, blocks: dict[str, Block], samples: Samples) -> list[Term]:
        """Observations and priors."""
        count, wings = len(self.names), self.wings
        kinds = np.array([KINDS.index(view.kind) for view in self.views])
        terms = [
            prior(Unknown.H_CD, blocks[Unknown.H_CD], wings.H_CD, wings.H_CD_covariance),
            independent_prior(Unknown.SETTING, settings_of(wings), wings.setting_sigma),
            independent_prior(Unknown.DOME, np.tile(residuals.DOME_M, (len(self.modes), 1)), residuals.DOME_SIGMA_M),
            independent_prior(Unknown.ROLL, blocks[Unknown.ROLL].value, np.array([1.0])),
            independent_prior(Unknown.INTENSITY, np.zeros((count, 1)), np.array([self.intensity_sd])),
            independent_prior(Unknown.ALBEDO, blocks[Unknown.ALBEDO].value, np.array([ALBEDO_SD])),
            independent_prior(Unknown.DELTA, np.zeros_like(blocks[Unknown.DELTA].value), np.array([TEXTURE_SD])),
            independent_prior(
                Unknown.BIAS, np.array([[BIAS_PX[kind][0]] for kind in KINDS]), np.array([[BIAS_PX[kind][1]] for kind in KINDS])
            ),
            outline_term(self.measured, kinds),
        ]
        if self.core:
            assert self.camera.covariance is not None
            terms.append(prior(Unknown.CORE, blocks[Unknown.CORE], np.zeros(self.core), self.camera.covariance))
        for mode in self.modes:
            cluster, rows = Cluster(mode), [k for k, leds in enumerate(self.leds) if leds == mode]
            mean, covariance = residuals.led_prior(count, mode, self.scatter)
            terms.append(independent_prior(leds_of(mode), mean, np.sqrt(np.diag(covariance))))
            terms += [term for term in (self._highlights(cluster, rows), self._shading(cluster, rows, samples)) if term is not None]
        return terms

    def scatter_seen(self, solution: Solution) -> tuple[float, float]:
        """The scatter that the LEDs show, by the evidence: their squares over how many of them the data determine."""
        found = []
        for places in ([0], [1, 2]):
            squares, known = SCATTER_WEIGHT, SCATTER_WEIGHT
            for mode in self.modes:
                sd = np.sqrt(np.diag(residuals.led_prior(1, mode)[1]))
                z = solution[leds_of(mode)] / sd
                variance = np.diag(solution.covariance(leds_of(mode))).reshape(z.shape) / sd**2
                squares += float(np.sum(z.reshape(-1, 3)[:, places] ** 2))
                known += float(np.sum(1 - variance.reshape(-1, 3)[:, places]))
            found.append(float(np.sqrt(squares / known)))
        return found[0], found[1]

    def _highlights(self, cluster: Cluster, rows: list[int]) -> Term | None:
        seen = [
            (s, light)
            for s, view in enumerate(self.views)
            for light in view.highlights_px
            if light in self.names and self.names.index(light) in rows
        ]
        if not seen:
            return None
        light = np.array([self.names.index(name) for _, name in seen])
        where = (light, self.wing[light], self.mode[light], np.array([s for s, _ in seen]))
        data = highlight_data(self.views, seen, self.camera, core=self.core > 0)
        return residuals.highlights(cluster, where, data, ROBUST, self.core)

    def _shading(self, cluster: Cluster, rows: list[int], samples: Samples) -> Term | None:
        own = np.isin(samples.light, rows)
        if not own.any():
            return None
        light, which = samples.light[own], samples.sphere[own]
        block = np.unique(samples.block, return_inverse=True)[1][own]
        radius = np.array([view.radius_m for view in self.views])[which]
        scale = np.log(_axis_level(cluster))
        target = samples.log_data[own] - samples.log_curve[own] + scale
        rays = samples.ray_C[own]
        slope = ray_slope(self.camera, self.camera.project(rays)).reshape(len(rays), -1) if self.core else np.zeros((len(rays), 0))
        data = np.column_stack([rays, radius, target, 1 / np.hypot(samples.relative_sigma[own], MODEL_SD), slope])
        return residuals.shading(cluster, (light, self.wing[light], self.mode[light], which, which, block), data, ROBUST, self.core)

    def lights_of(self, blocks: dict[str, Block]) -> list[Light]:
        """The lights as they stand."""
        return [self._light(k, blocks) for k in range(len(self.names))]

    def _light(self, k: int, blocks: dict[str, Block]) -> Light:
        leds, H_CL = self._leds(k, blocks), self._frame(k, blocks)
        source_L = np.array([0.0, 0.0, blocks[Unknown.DOME].value[self.mode[k], 0]])
        return Light(
            name=self.names[k],
            direction_C=-H_CL[:3, 2],
            intensity=np.exp(blocks[Unknown.INTENSITY].value[k]),
            H_CL=H_CL,
            source_C=se3.apply(H_CL, source_L[None])[0],
            axis_C=H_CL[:3, 2],
            lobe=Lobe("leds", exponent=leds.exponent, angle_rad=KNOTS_RAD, value=_mean_lobe(leds), leds=leds),
        )

    def result(self, solution: Solution, focus_C: Array) -> JointFit:
        """The solution as lights, with the standard deviations that it gives."""
        blocks = dict(solution.blocks)
        lights = [self._with_direction(k, blocks, focus_C) for k in range(len(self.names))]
        parts = [Unknown.H_CD, Unknown.SETTING, Unknown.DOME, Unknown.ROLL, Unknown.INTENSITY, *(leds_of(mode) for mode in self.modes)]
        covariance = solution.covariance(*parts)
        J = self._derivatives(blocks, parts, volume_points(focus_C))
        place, source, field = J[:, :3], J[:, 3:6].reshape(-1, J.shape[2]), J[:, 6:].reshape(len(self.names), -1, 4, J.shape[2])
        turn, level = field[:, :, :3], field[:, :, 3] - field[:, :, 3].mean(axis=(0, 1))
        shading_terms = [place_ for place_, term in enumerate(solution.terms) if Unknown.DELTA in term.blocks and len(term.blocks) > 1]
        left = np.concatenate([solution.residuals[t][:, 0] / solution.terms[t].data[:, 5] for t in shading_terms])
        which = np.concatenate([solution.terms[t].items(7) for t in shading_terms])
        return JointFit(
            lights=tuple(lights),
            H_CD=solution[Unknown.H_CD][0],
            H_CD_covariance=solution.covariance(Unknown.H_CD),
            core=solution[Unknown.CORE][0] if self.core else np.zeros(0),
            settings=solution[Unknown.SETTING],
            settings_std=np.sqrt(np.diag(solution.covariance(Unknown.SETTING))).reshape(-1, 4),
            cost=solution.cost,
            centres_C=solution[Unknown.CENTRE],
            bias_px={kind: float(solution[Unknown.BIAS][k, 0]) for k, kind in enumerate(KINDS)},
            dome_m={mode: solution[Unknown.DOME][k].tolist() for k, mode in enumerate(self.modes)},
            highlight_px=self._misses(lights, solution[Unknown.CENTRE]),
            shading={self.views[s].name: float(np.sqrt(np.mean(left[which == s] ** 2))) for s in np.unique(which)},
            position_std_m=np.sqrt(np.einsum("kij,jl,kil->k", place, covariance, place) / 3),
            direction_std_rad=np.sqrt(_mean_variance(turn, covariance).sum(axis=1) / 2),
            intensity_std=np.sqrt(_mean_variance(level[:, :, None], covariance)[:, 0]),
            source_C=np.array([self._figures(k, blocks, focus_C[None])[3:6] for k in range(len(self.names))]),
            source_covariance=source @ covariance @ source.T,
        )

    def _with_direction(self, k: int, blocks: dict[str, Block], focus_C: Array) -> Light:
        light = self._light(k, blocks)
        around = volume_points(focus_C)
        d_C, _ = light.field(around)
        across = np.eye(3) - d_C[:, :, None] * d_C[:, None]
        source_C = np.linalg.solve(across.sum(axis=0), np.sum(across @ around[:, :, None], axis=0)[:, 0])
        return replace(light, direction_C=light.field(focus_C[None])[0][0], source_C=source_C)

    def _derivatives(self, blocks: dict[str, Block], parts: list[str], points_C: Array) -> Array:
        """(L, 6 + 4 N, P) of `_figures` by the parameters; those of one light count in its rows only."""
        start = dict(zip(parts, np.cumsum([0, *(blocks[name].count * blocks[name].size for name in parts)]), strict=False))
        J = np.zeros((len(self.names), 6 + 4 * len(points_C), sum(blocks[name].count * blocks[name].size for name in parts)))
        for k, leds in enumerate(self.leds):
            now = self._figures(k, blocks, points_C)
            own = {
                Unknown.H_CD: 0,
                Unknown.SETTING: self.wing[k],
                Unknown.DOME: self.mode[k],
                Unknown.ROLL: k,
                Unknown.INTENSITY: k,
                leds_of(leds): k,
            }
            for name, item in own.items():
                block = blocks[name]
                for axis in range(block.size):
                    step = np.zeros((block.count, block.size))
                    step[item, axis] = STEP
                    moved = self._figures(k, blocks | {name: block.moved(step)}, points_C)
                    J[k, :, start[name] + item * block.size + axis] = (moved - now) / STEP
        return J

    def _figures(self, k: int, blocks: dict[str, Block], points_C: Array) -> Array:
        """(6 + 4 N,) of one light: origin of H_CL, middle of the dome; direction and log irradiance at points (N, 3)."""
        H_CL, leds = self._frame(k, blocks), self._leds(k, blocks)
        x_L = se3.apply(se3.inv(H_CL), points_C)
        d_L, irradiance = led_cluster.cluster_field(x_L, leds.position_L, leds.axis_L, leds.power, leds.exponent)
        level = np.log(irradiance) + blocks[Unknown.INTENSITY].value[k]
        middle_C = H_CL[:3, 3] + blocks[Unknown.DOME].value[self.mode[k], 0] * H_CL[:3, 2]
        return np.concatenate([H_CL[:3, 3], middle_C, np.column_stack([se3.rotate(H_CL, d_L), level]).ravel()])

    def _frame(self, k: int, blocks: dict[str, Block]) -> Array:
        H_CL: Array = blocks[Unknown.H_CD].value[0] @ wing_transform(blocks[Unknown.SETTING].value[self.wing[k]])
        return H_CL

    def _leds(self, k: int, blocks: dict[str, Block]) -> LedCluster:
        mode = self.leds[k]
        dome, led = blocks[Unknown.DOME].value[self.mode[k]], blocks[leds_of(mode)].value[k]
        return _cluster_of(Cluster(mode), dome, float(blocks[Unknown.ROLL].value[k, 0]), led)

    def _misses(self, lights: Sequence[Light], centres_C: Array) -> dict[tuple[str, str], float]:
        misses = {}
        for s, view in enumerate(self.views):
            for name, seen in view.highlights_px.items():
                if name in self.names:
                    light = lights[self.names.index(name)]
                    assert light.source_C is not None
                    P = sphere.mirror_point(centres_C[s], view.radius_m, light.source_C)
                    misses[view.name, name] = float(np.linalg.norm(self.camera.project(P) - seen))
        return misses


def _mean_variance(J: Array, covariance: Array) -> Array:
    """Variances (L, F), mean over points, of figures whose derivatives (L, N, F, P) by the parameters are given."""
    return np.asarray(np.mean(np.sum((J @ covariance) * J, axis=3), axis=1))


def _deltas(samples: Samples) -> Block:
    return Block(np.zeros((int(np.unique(samples.block).size), 1)))


def _axis_level(cluster: Cluster) -> float:
    """Sum of the nominal LEDs' lobes on the axis: what makes the whole 1 there."""
    return float(np.sum(np.maximum(cluster.axes[:, 2], 0.0) ** cluster.exponent))


def _cluster_of(cluster: Cluster, dome: Array, roll: float, led: Array) -> LedCluster:
    stands, axes = cluster.axes_of(roll, led)
    return LedCluster(np.array([0.0, 0.0, dome[0]]) + dome[1] * stands, axes, np.exp(led[::3]) / _axis_level(cluster), cluster.exponent)


def _mean_lobe(leds: LedCluster) -> Array:
    """Emission over the knots of the table, averaged over the roll, 1 on the axis."""
    roll = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    sine, cosine = np.sin(KNOTS_RAD)[:, None], np.cos(KNOTS_RAD)[:, None]
    direction = np.stack([sine * np.cos(roll), sine * np.sin(roll), np.broadcast_to(cosine, (len(KNOTS_RAD), len(roll)))], axis=-1)
    emission = np.mean(np.maximum(direction @ leds.axis_L.T, 0.0) ** leds.exponent @ leds.power, axis=1)
    return np.asarray(emission / emission[0])

r"""What the matte spheres' shading and a chrome sphere held out say of the lights found.

Symbols: block b of sphere s under light k; data over what the lights predict, m = log data - log model, each sphere's albedo removed
(median over its blocks)::

    drift       mean of m by (s, k), both medians removed: a light brighter at one sphere than at another
    outer ring  m fitted as the lobe of 7 LEDs and of 19 by turns, a level a sphere and light free
    held out    the highlights of a chrome sphere under the lights that the others find; a matte one's shading under those of the others
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.refine_lights.explain import fitted
from lpcal.chain.refine_lights.measure import CentreMeasurement, Measured
from lpcal.chain.refine_lights.samples import Samples, sample_blocks
from lpcal.chain.refine_lights.shading import lobe_of_leds
from lpcal.errors import DegenerateError
from lpcal.geometry import led_cluster, sphere
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Camera, Light, LightsSolution, Wings
from lpcal.records.observations import SphereView

DRIFTED, DRIFTED_PLAIN, DRIFTED_TIMES = 0.03, 0.08, 4.0
"""A light that differs by so much between spheres (under lobes on paper, which ripple), and so many times what others do, has drifted."""
OTHER_LOBE, UNFIT = 0.25, 0.03
"""Another number of LEDs is named when it leaves this share of the squares and the stated one misses by more than that."""
GATE_PX, GATE_SHADING = 0.05, 0.015
EXPECTED_GATES, SHADING_SD = 2.5, 0.003
"""Where the lights or the highlights are less certain than the gate, a miss of so many of its own sigmas is let pass; shading that
fits has the second, relative."""
CENTRE_STEPS = 4


@dataclass(frozen=True)
class Shaded:
    """Misfit m (N,) of the blocks, their samples, the spheres' names."""

    misfit: Array
    samples: Samples
    names: tuple[str, ...]


def diagnose(solution: LightsSolution, used: Measured, camera: Camera, wings: Wings | None) -> LightsSolution:
    """The solution with what is wrong among its warnings, and how well it predicts in its evidence."""
    names = [light.name for light in solution.lights]
    kept = {finding.name: finding for finding in solution.spheres if finding.used and finding.centre_C is not None}
    placed = [(view, m, np.asarray(kept[view.name].centre_C)) for view, m in used if view.name in kept]
    warnings, predicted = list[str](), None
    where = [(view, centre) for view, _, centre in placed]
    shaded = shading_misfit(where, solution.lights, camera)
    plain = shading_misfit(where, [_with_plain_lobe(light, wings) for light in solution.lights], camera)
    if shaded is not None and plain is not None:
        warnings += _drifts(shaded, names, DRIFTED) or _drifts(plain, names, DRIFTED_PLAIN)
        warnings += _other_lobes(shaded, solution.lights, wings)
        predicted = _held_out_shading(shaded)
    highlight_px, gate_px = _held_out_highlights(names, [(v, m) for v, m, _ in placed], camera, wings)
    shading, shading_free = predicted or (None, None)
    warnings += _gates(highlight_px, gate_px, shading_free)
    evidence = replace(
        solution.evidence,
        predicted_shading_rms=shading,
        predicted_shading_rms_albedo_free=shading_free,
        predicted_highlight_px=highlight_px,
    )
    return replace(solution, warnings=(*solution.warnings, *warnings), evidence=evidence)


def shading_misfit(placed: Sequence[tuple[SphereView, Array]], lights: Sequence[Light], camera: Camera) -> Shaded | None:
    """Log of data over what the lights predict, a level a sphere removed; None without matte spheres."""
    views = [view for view, _ in placed]
    if not any(view.shading for view in views):
        return None
    samples = sample_blocks(views, np.array([centre for _, centre in placed]), camera, lights)
    misfit = np.zeros(samples.light.size)
    for k, light in enumerate(lights):
        for s, (view, centre_C) in enumerate(placed):
            own = (samples.light == k) & (samples.sphere == s)
            P, n = sphere.meet(samples.ray_C[own], centre_C, view.radius_m)
            d, irradiance = light.field(P)
            model = irradiance.mean(axis=-1) * np.sum(n * d, axis=-1)
            misfit[own] = samples.log_data[own] - samples.log_curve[own] - np.log(np.maximum(model, 1e-12))
    for s in np.unique(samples.sphere):
        misfit[samples.sphere == s] -= np.median(misfit[samples.sphere == s])
    return Shaded(misfit, samples, tuple(view.name for view in views))


def _with_plain_lobe(light: Light, wings: Wings | None) -> Light:
    """A light with the lobe that its number of LEDs has on paper: a free one follows a drift, as each sphere sees its own part of it."""
    leds = {wing.name: wing.leds for wing in wings.wings}.get(light.name) if wings else None
    return replace(light, lobe=lobe_of_leds(leds) or light.lobe)


def _drifts(shaded: Shaded, names: Sequence[str], limit: float) -> list[str]:
    """Lights that are brighter at one sphere than at another."""
    spheres = np.unique(shaded.samples.sphere)
    if len(spheres) < 2:
        return []
    table = np.full((len(spheres), len(names)), np.nan)
    for row, s in enumerate(spheres):
        for k in range(len(names)):
            own = (shaded.samples.sphere == s) & (shaded.samples.light == k)
            if own.any():
                table[row, k] = np.median(shaded.misfit[own])
    table = table[:, np.isfinite(table).all(axis=0)]
    seen = [name for k, name in enumerate(names) if np.isfinite(table).all() and k < table.shape[1]]
    if len(seen) < 3:
        return []
    table -= np.median(table, axis=1, keepdims=True)
    change = np.ptp(table, axis=0)
    limit = max(limit, DRIFTED_TIMES * float(np.median(change)))
    remarks = []
    for k in (int(row) for row in np.flatnonzero(change > limit)):
        bright, dim = (shaded.names[spheres[int(pick(table[:, k]))]] for pick in (np.argmax, np.argmin))
        remarks.append(
            f"{seen[k]}: {100 * np.expm1(change[k]):.0f} % brighter at {bright} than at {dim}, the other lights alike: does it drift? "
            "let it warm up, check its current, and take the spheres again"
        )
    return remarks


def _other_lobes(shaded: Shaded, lights: Sequence[Light], wings: Wings | None) -> list[str]:
    """Lights that fall off as another number of LEDs than stated does."""
    samples, remarks = shaded.samples, []
    stated = {wing.name: wing.leds for wing in wings.wings} if wings else {}
    for k, light in enumerate(lights):
        leds, own = stated.get(light.name), samples.light == k
        if leds not in {7, 19} or own.sum() < 30:
            continue
        left = {mode: _lobe_misfit(samples, own, mode) for mode in (7, 19)}
        other = 26 - leds
        if left[leds] > UNFIT**2 and left[other] < OTHER_LOBE * left[leds]:
            why = "is its outer ring off" if other < leds else "are its outer LEDs on"
            remarks.append(f"{light.name}: falls off as {other} LEDs do, not {leds}: {why}? Correct the blob, or leds in panel.yaml")
    return remarks


def _lobe_misfit(samples: Samples, own: Array, leds: int) -> float:
    """Mean square of one light's blocks about the lobe of so many LEDs, a level a sphere free."""
    y = (samples.log_data - samples.log_geometry)[own] - np.log(led_cluster.mean_lobe(samples.angle_rad[own], leds))
    for s in np.unique(samples.sphere[own]):
        mine = samples.sphere[own] == s
        y[mine] -= y[mine].mean()
    return float(np.mean(y**2))


def _held_out_shading(shaded: Shaded) -> tuple[float, float] | None:
    """Rms of the shading of matte spheres under levels that the others find, as a fraction, with and without what all lights share.

    What all lights share at a block is the sphere's albedo there. None for a single sphere.
    """
    samples, spheres = shaded.samples, np.unique(shaded.samples.sphere)
    if len(spheres) < 2:
        return None
    left = np.zeros(samples.light.size)
    for s in spheres:
        own, others = samples.sphere == s, samples.sphere != s
        rest = shaded.misfit[own].copy()
        for k in np.unique(samples.light[own]):
            level = shaded.misfit[others & (samples.light == k)]
            rest[samples.light[own] == k] -= np.median(level) if level.size else 0.0
        left[own] = rest - np.median(rest)
    block = np.unique(samples.block, return_inverse=True)[1]
    count = np.bincount(block)
    shared = np.bincount(block, weights=left) / count
    free = ((left - shared[block]) * np.sqrt(count / np.maximum(count - 1, 1))[block])[count[block] > 1]
    return float(np.sqrt(np.mean(left**2))), float(np.sqrt(np.mean(free**2))) if free.size else float("nan")


def _held_out_highlights(lights: Sequence[str], used: Measured, camera: Camera, wings: Wings | None) -> tuple[float | None, float]:
    """Rms (px) by which the lights that the other spheres find miss a chrome sphere's highlights, and the gate for it."""
    chrome = [k for k, (view, _) in enumerate(used) if view.highlights_px]
    if len(chrome) < (2 if wings else 3):
        return None, GATE_PX
    k = chrome[len(chrome) // 2]
    view, measured = used[k]
    try:
        others = fitted(lights, [*used[:k], *used[k + 1 :]], camera, wings)
    except DegenerateError:
        others = None
    names = [light for light in lights if light in view.highlights_px]
    if others is None or len(names) < 3:
        return None, GATE_PX
    source_C = np.array([others.source_C[others.lights.index(name)] for name in names])
    seen = np.array([view.highlights_px[name] for name in names])
    sigma = float(np.mean([view.highlight_sigma_px[name] for name in names]))
    start_C = measured.centre_C + others.bias_px[view.kind] * measured.by_bias
    rows = [others.lights.index(name) for name in names]
    blocks = [others.source_covariance[3 * row : 3 * row + 3, 3 * row : 3 * row + 3] for row in rows]
    expected = np.hypot(sigma, _predicted_sigma(start_C, view.radius_m, source_C, blocks, camera))
    miss = _miss_px(replace(measured, centre_C=start_C), view.radius_m, source_C, seen, sigma, camera)
    return miss, max(GATE_PX, EXPECTED_GATES * float(expected))


def _predicted_sigma(centre_C: Array, radius_m: float, source_C: Array, covariance: Sequence[Array], camera: Camera) -> float:
    """Standard deviation (px, of the distance) of predicted highlights that the sources' own uncertainty gives."""
    step = 1e-5

    def predicted(source: Array) -> Array:
        return camera.project(sphere.mirror_point(centre_C, radius_m, source))

    variances = []
    for x, block in zip(source_C, covariance, strict=True):
        J = np.stack([(predicted(x + step * axis) - predicted(x - step * axis)) / (2 * step) for axis in np.eye(3)], axis=-1)
        variances.append(np.trace(J @ block @ J.T))
    return float(np.sqrt(np.mean(variances)))


def _miss_px(measured: CentreMeasurement, radius_m: float, source_C: Array, seen: Array, sigma: float, camera: Camera) -> float:
    """Rms (px) between highlights seen and predicted, the centre free within what its outline allows."""
    prior = np.linalg.inv(measured.covariance)
    centre_C, step = measured.centre_C, 1e-6

    def predicted(centre: Array) -> Array:
        return camera.project(sphere.mirror_point(centre, radius_m, source_C))

    for _ in range(CENTRE_STEPS):
        J = np.stack(
            [(predicted(centre_C + step * axis) - predicted(centre_C - step * axis)).ravel() / (2 * step) for axis in np.eye(3)], 1
        )
        rest = (seen - predicted(centre_C)).ravel()
        N = J.T @ J / sigma**2 + prior
        centre_C = centre_C + np.linalg.solve(N, J.T @ rest / sigma**2 - prior @ (centre_C - measured.centre_C))
    return float(np.sqrt(np.mean(np.sum((seen - predicted(centre_C)) ** 2, axis=1))))


def _gates(px: float | None, gate_px: float, shading: float | None) -> list[str]:
    remarks = []
    if px is not None and px > gate_px:
        remarks.append(f"the other spheres predict the highlights of one held out to {px:.2f} px only, {gate_px:.2f} is the limit")
    if shading is not None and shading > GATE_SHADING:
        remarks.append(
            f"the other spheres predict the shading of one held out to {100 * shading:.1f} % only, {100 * GATE_SHADING:g} is the limit"
        )
    return remarks

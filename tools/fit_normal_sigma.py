"""Fit the standard deviation of normals: how each indicator of ``surface/uncertainty.py`` counts.

``python tools/fit_normal_sigma.py SCENES... [--jobs N] [--on ENGINE] [--keep FILE.npz] [--distant] [--noise X]``: SCENES are simulated
scenes with truth (folders that hold ``capture`` with an ambient image, ``calibration.yaml`` and ``truth/surface.npz``), or folders of
such, to which the network of surface.normal_prior was not fitted. Each is reconstructed within its true mask; the indicators of its pixels
stand beside the angle between its normals and the true ones. The variance is a sum of squared indicators, each with a factor that is not
negative; the factors are those of the greatest likelihood (Student's, so that outliers do not dominate), every scene counting alike,
scaled so that the median scene has the share of pixels within two sigma that is expected.

``--distant`` fits the factors of distant light, without the network's expected normals. ``--keep`` writes the indicators, or reads them if
the file exists. ``--noise`` fixes the factor of the samples' own noise, the first of distant light: simulated matter follows the model, so
it says less about that factor than real sets do (``tools/bench_surface.py`` prints median errors over sigma on DiLiGenT).

Printed: the factors; for each scene the share of pixels within two sigma, by factors fitted on all the others (cross-validated by scene);
the median and the worst tenth of these.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
from scipy import ndimage, optimize

from lpcal import read_calibration, read_capture, reconstruct
from lpcal.api.engines import engine_of
from lpcal.geometry.arrays import Array
from lpcal.surface import normal_prior, uncertainty

FREEDOM = 4.0
"""Degrees of freedom of Student's distribution: errors of normals have heavy tails."""
EXPECTED = 93.0
"""Share of errors within two standard deviations at the median scene, per cent: 86.5 would be a normal distribution's, but scenes differ in
what the indicators do not see, and at the worst tenth of them two thirds should still be within."""
MOST_PIXELS = 4000
"""Pixels of a scene that are used, spread over it: neighbours err alike."""
DISAGREES = 5.0
"""Spread of the true normals over 3x3 pixels, degrees, over which a pixel's true normal hangs on where in the pixel one looks."""
NAMES = ("noise", "bend round", "bend", "edge", "three", "filled", "thrown", "unseen")
"""The indicators of distant light, in the order of `uncertainty.squares`."""
NEAR_NAMES = ("bend", "expected")
"""Those of near light."""


def scenes_of(paths: list[Path]) -> Iterator[Path]:
    """The scenes among folders and folders of scenes."""
    for path in paths:
        if (path / "calibration.yaml").exists():
            yield path
        else:
            yield from sorted(one for one in path.iterdir() if (one / "calibration.yaml").exists())


def indicators_of(scene: Path, *, distant: bool = False) -> tuple[str, Array, Array, float]:
    """Squares of the indicators (P, N) of a scene's pixels, the errors of their normals (P,) in degrees, and the calibration's part."""
    seen: list[tuple[Array, float]] = []
    plain, turned = uncertainty.normal_sigma_deg, normal_prior.turned

    def heard(found: uncertainty.Indicators, calibration_deg: float) -> Array:
        seen.append((uncertainty.squares(found), calibration_deg))
        return plain(found, calibration_deg)

    with np.load(scene / "truth" / "surface.npz") as stored:
        mask, truth = stored["mask"].astype(bool), stored["normals"]
    uncertainty.normal_sigma_deg = heard
    if distant:
        normal_prior.turned = lambda _scene, state: (state, None)
    try:
        calibration = read_calibration(scene / "calibration.yaml")
        found = reconstruct(read_capture(scene / "capture", [light.name for light in calibration.lights]), calibration, mask=mask)
    finally:
        uncertainty.normal_sigma_deg, normal_prior.turned = plain, turned
    square, calibration_deg = seen[-1]
    error = np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(found.normals - truth, axis=-1) / 2, 0, 1)))
    steady = mask & (_spread_deg(truth, mask) < DISAGREES)
    known = (steady & np.isfinite(error))[found.mask]
    some = np.flatnonzero(known)
    some = some[:: max(1, len(some) // MOST_PIXELS)]
    return scene.name, square[some], error[found.mask][some], calibration_deg


def _spread_deg(n: Array, mask: Array) -> Array:
    """Rms angle (H, W) of normals (H, W, 3) about their mean over 3x3 pixels."""
    inside = np.maximum(ndimage.uniform_filter(mask.astype(float), 3), 1e-9)
    mean = np.stack([ndimage.uniform_filter(np.where(mask, n[..., axis], 0.0), 3) / inside for axis in range(3)], axis=-1)
    return np.degrees(np.sqrt(np.maximum(1 - np.sum(mean**2, axis=-1), 0.0)))


def fitted(scenes: list[tuple[str, Array, Array, float]], noise: float | None = None) -> Array:
    """Factors (N,) of the greatest likelihood: an angle e has the density ``e / s^2 (1 + e^2 / (F s^2))^-(F/2+1)``.

    The first is held where `noise` gives it.
    """
    unit = np.mean([square.mean(axis=0) for _, square, _, _ in scenes], axis=0) + 1e-6

    def cost(x: Array) -> tuple[float, Array]:
        factor, total, slope = np.exp(x) / unit, 0.0, np.zeros(len(x))
        for _, square, error, calibration in scenes:
            variance = square @ factor + calibration**2 + 1e-4
            e2 = error**2
            total += float(np.mean(np.log(variance) + (FREEDOM / 2 + 1) * np.log1p(e2 / (FREEDOM * variance))))
            by_variance = 1 / variance - (FREEDOM / 2 + 1) * e2 / (FREEDOM * variance**2 + e2 * variance)
            slope += (square * by_variance[:, None]).mean(axis=0) * factor
        return total / len(scenes), slope / len(scenes)

    bounds = [(-14.0, 8.0)] * len(unit)
    if noise is not None:
        bounds[0] = (np.log(noise * unit[0]),) * 2
    found = optimize.minimize(cost, np.clip(np.zeros(len(unit)), *np.transpose(bounds)), jac=True, method="L-BFGS-B", bounds=bounds)
    factor = np.exp(found.x) / unit
    scales = np.geomspace(0.25, 16.0, 121)
    scaled = [np.append(factor[0] if noise is not None else scale * factor[0], scale * factor[1:]) for scale in scales]
    held = [float(np.median([within(scene, one) for scene in scenes])) for one in scaled]
    return scaled[int(np.argmin(np.abs(np.array(held) - EXPECTED)))]


def within(scene: tuple[str, Array, Array, float], factor: Array) -> float:
    """Share of a scene's pixels within two sigma, per cent."""
    _, square, error, calibration = scene
    return float(100 * np.mean(error <= 2 * np.sqrt(square @ factor + calibration**2)))


def main() -> None:
    """Print the factors and what they hold."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scenes", nargs="+", type=Path)
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--on", default="processes")
    words.add_argument("--keep", type=Path)
    words.add_argument("--noise", type=float)
    words.add_argument("--distant", action="store_true")
    given = words.parse_args()
    if given.keep is not None and given.keep.exists():
        with np.load(given.keep) as kept:
            names = sorted({key.rpartition(".")[0] for key in kept.files})
            scenes = [(name, kept[f"{name}.square"], kept[f"{name}.error"], float(kept[f"{name}.calibration"])) for name in names]
    else:
        with engine_of(given.on, given.jobs, Path()).start() as pool:
            scenes = list(pool.map(partial(indicators_of, distant=given.distant), scenes_of(given.scenes)))
        if given.keep is not None:
            parts = ((f"{one[0]}.{key}", one[k]) for one in scenes for k, key in ((1, "square"), (2, "error"), (3, "calibration")))
            np.savez(given.keep, **{key: np.asarray(value) for key, value in parts})
    titles, factors = (NAMES, uncertainty.FACTORS) if given.distant else (NEAR_NAMES, uncertainty.NEAR_FACTORS)
    for name, factor in zip(titles, fitted(scenes, given.noise), strict=True):
        print(f"{name:<12}{factor:12.4g}")
    print(f"\n{'scene':<14}{'now':>8}{'left out':>10}   within two sigma, %")
    table = []
    for k, scene in enumerate(scenes):
        table.append((within(scene, np.array(factors)), within(scene, fitted(scenes[:k] + scenes[k + 1 :], given.noise))))
        print(f"{scene[0]:<14}{table[-1][0]:8.1f}{table[-1][1]:10.1f}")
    for title, share in (("median", 50), ("worst tenth", 10)):
        print(f"{title:<14}" + "".join(f"{value:9.1f}" for value in np.percentile(table, share, axis=0)))


if __name__ == "__main__":
    main()

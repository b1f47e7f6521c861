"""Normals under imported lights of unknown powers, by lpcal and by plain least squares, over simulated captures (tools/lit_heights.py).

``python tools/bench_gains.py [COUNT] [KIND...]``: COUNT captures a kind (default 20). Mean errors in degrees over the object:

plain      least squares on all samples, powers taken as equal
lpcal      as `lpcal reconstruct` does it, powers estimated where it believes them
held       the same with powers held equal
known      the same with the true powers
worst      of lpcal over plain least squares, in any capture
found      captures whose powers were estimated;  refused: captures that were refused for their gamma;  warned: those with a warning of it

Faster with OPENBLAS_NUM_THREADS=1.
A capture that is refused counts in none of the means; `curve stated` states the gamma that `curve` does not.
"""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np

from lit_heights import Drawn, Recipe, draw
from lpcal.api.curve import Settled, settle_sensor
from lpcal.detect.radiometry import to_radiance
from lpcal.errors import DisagreementError
from lpcal.geometry import lambert
from lpcal.records.calibration import Calibration
from lpcal.records.sensor import StatedSensor
from lpcal.surface.reconstruct import Options, reconstruct
from lpcal.view import pixel_list

KINDS: dict[str, tuple[Recipe, bool]] = {
    "equal": (Recipe(), False),
    "equal, glossy": (Recipe(gloss=0.3), False),
    "equal, shadowed": (Recipe(bumps=8, most_slant_deg=72), False),
    "equal, both": (Recipe(gloss=0.3, bumps=8, most_slant_deg=72), False),
    "unequal 10 %": (Recipe(spread=0.1), False),
    "unequal 30 %": (Recipe(spread=0.3), False),
    "unequal, both": (Recipe(spread=0.2, gloss=0.3, bumps=8, most_slant_deg=72), False),
    "curve": (Recipe(gamma="srgb", bumps=8), False),
    "curve, glossy": (Recipe(gamma=2.2, gloss=0.3), False),
    "curve, unequal": (Recipe(gamma="srgb", spread=0.2, bumps=8), False),
    "curve stated": (Recipe(gamma="srgb", gloss=0.2, bumps=8), True),
    "6 lights": (Recipe(lights=6, gloss=0.2, bumps=4), False),
    "6 lights, unequal": (Recipe(lights=6, spread=0.2, gloss=0.2, bumps=4), False),
    "50 lights": (Recipe(lights=50, gloss=0.2, bumps=4), False),
    "50, unequal": (Recipe(lights=50, spread=0.2, gloss=0.2, bumps=4), False),
}
"""Each with whether its gamma is stated."""


def error_deg(n: np.ndarray, drawn: Drawn) -> float:
    """Mean angle of normals (H, W, 3) over the object."""
    apart = np.linalg.norm(n - drawn.normals, axis=-1)[drawn.mask]
    return float(np.nanmean(np.degrees(2 * np.arcsin(np.clip(apart / 2, 0, 1)))))


def errors(drawn: Drawn, settled: Settled) -> tuple[float, float, float, float, bool]:
    """Mean errors of the four ways, and whether powers were estimated."""
    radiance = to_radiance(drawn.raw, settled.used.sensor)
    options = Options(mask=drawn.mask, linear=settled.linear)
    own = reconstruct(radiance, drawn.calibration, options)
    held = reconstruct(radiance, known(drawn.calibration, np.ones(len(drawn.intensity))), options)
    true = reconstruct(radiance, known(drawn.calibration, drawn.intensity), options)
    signal = pixel_list.grey(radiance, drawn.calibration.lights).signal[:, drawn.mask].astype(float)
    S = np.stack([light.direction_C for light in drawn.calibration.lights])
    plain = np.full(drawn.normals.shape, np.nan)
    plain[drawn.mask] = lambert.unit(np.linalg.lstsq(S, signal, rcond=None)[0].T)[0]
    found = own.figures.intensities_found is not None
    return error_deg(plain, drawn), *(error_deg(one.normals, drawn) for one in (own, held, true)), found


def known(calibration: Calibration, powers: np.ndarray) -> Calibration:
    """The calibration with powers that somebody has measured."""
    lights = zip(calibration.lights, powers, strict=True)
    return replace(calibration, lights=tuple(replace(light, intensity=np.array([one]), intensity_std=0.0) for light, one in lights))


def main(count: int, wanted: list[str]) -> None:
    """Print the table."""
    print(f"{'kind':<20}{'plain':>8}{'lpcal':>8}{'held':>8}{'known':>8}{'worst':>8}{'found':>7}{'refused':>9}{'warned':>8}")
    for name, (recipe, stated) in KINDS.items():
        if wanted and name not in wanted:
            continue
        rows, refused, warned = [], 0, 0
        for seed in range(count):
            drawn = draw(recipe, seed)
            try:
                settled = settle_sensor(drawn.raw, drawn.calibration, [("stated", StatedSensor(recipe.gamma))] if stated else [])
            except DisagreementError:
                refused += 1
                continue
            warned += bool(settled.notes)
            rows.append(errors(drawn, settled))
        table = np.array(rows).reshape(-1, 5)
        means = "".join(f"{value:>8.2f}" for value in table[:, :4].mean(axis=0)) if rows else f"{'-':>8}" * 4
        worst = f"{np.max(table[:, 1] - table[:, 0]):>+8.2f}" if rows else f"{'-':>8}"
        print(f"{name:<20}{means}{worst}{int(table[:, 4].sum()):>7}{refused:>9}{warned:>8}", flush=True)


if __name__ == "__main__":
    words = sys.argv[1:]
    main(int(words[0]) if words else 20, words[1:])

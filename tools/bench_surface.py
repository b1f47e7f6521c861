"""Normals of DiLiGenT by lpcal compared with plain least squares on the same images.

``python tools/bench_surface.py [FOLDER]``: FOLDER holds diligent_ball, diligent_bear (default: the recordings' surface folder);
``python tools/bench_surface.py card`` is tools/bench_card.py; with the word ``counts`` it prints the errors by the number of lights: each
set holds the one before, the next light being that furthest from all so far.
Angles in degrees; six lights are those nearest to six evenly spread azimuths at the median slant.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import numpy as np

from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.formats.capture import read_capture
from lpcal.formats.import_lights import read_lights
from lpcal.geometry import lambert
from lpcal.records.calibration import Light
from lpcal.surface.reconstruct import Options, reconstruct
from lpcal.view import sight

DATA = Path(os.environ.get("LPCAL_DATA", Path(__file__).resolve().parents[2] / "shared/data")) / "surface"
COUNTS = (6, 8, 10, 16, 24, 48, 96)
FIRST = {"diligent_ball": 1, "diligent_bear": 21}
"""The first 20 images of bear are known to be corrupted."""


def six(lights: list[Light]) -> list[Light]:
    """Six lights spread evenly round the view axis."""
    S = np.stack([light.direction_C for light in lights])
    slant, turn = np.hypot(S[:, 0], S[:, 1]), np.arctan2(S[:, 1], S[:, 0])
    cost = [np.abs(np.angle(np.exp(1j * (turn - k * np.pi / 3)))) + np.abs(slant - np.median(slant)) for k in range(6)]
    return [lights[int(np.argmin(one))] for one in cost]


def spread(lights: list[Light]) -> list[Light]:
    """Lights in an order in which each is the one furthest from those before it, beginning with the most central."""
    S = np.stack([light.direction_C for light in lights])
    cosine = S @ S.T
    order = [int(np.argmax(cosine.sum(axis=1)))]
    while len(order) < len(lights):
        nearest = cosine[:, order].max(axis=1)
        nearest[order] = np.inf
        order.append(int(np.argmin(nearest)))
    return [lights[k] for k in order]


def errors(folder: Path, names: list[str] | None) -> tuple[float, float, float]:
    """Mean errors of lpcal and of plain least squares, and lpcal's seconds."""
    _, calibration = read_lights(folder)
    raw = read_capture(folder, [light.name for light in calibration.lights], use=names)
    radiance, begun = to_radiance(raw, Sensor()), time.perf_counter()
    found = reconstruct(radiance, calibration, Options())
    seconds = time.perf_counter() - begun
    with np.load(folder / "normal_gt.npz") as stored:
        truth = stored[stored.files[0]] * [1, -1, -1]
    mask = found.mask & (np.linalg.norm(truth, axis=-1) > 0.5)
    lights = sight.lights_of(calibration, radiance)
    signal = sight.grey(radiance, lights).signal[:, mask].astype(float)
    B = np.repeat(np.stack([light.direction_C for light in lights])[:, None], mask.sum(), axis=1)
    plain = lambert.unit(lambert.weighted(B, signal, np.ones(signal.shape))[0])[0]

    def mean_deg(n: np.ndarray) -> float:
        return float(np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(n - truth[mask], axis=-1) / 2, 0, 1))).mean())

    return mean_deg(found.normals[mask]), mean_deg(plain), seconds


def main() -> None:
    """Print the table."""
    if sys.argv[1:2] == ["card"]:
        from bench_card import main as card

        card([int(word) for word in sys.argv[2:]])
        return
    words = [word for word in sys.argv[1:] if word != "counts"]
    root = Path(words[0]) if words else DATA
    print(f"{'set':<15}{'lights':<14}{'lpcal':>8}{'plain':>8}{'s':>7}")
    for name, first in FIRST.items():
        folder = root / name
        if not folder.is_dir():
            print(f"{name:<15}not there")
            continue
        lights = list(read_lights(folder)[1].lights)
        chosen: dict[str, list[str] | None] = {
            "all": None,
            f"from {first}": [one.name for one in lights[first - 1 :]],
            "six": [one.name for one in six(lights[first - 1 :])],
        }
        if "counts" in sys.argv[1:]:
            some = spread(lights[first - 1 :])
            chosen = {str(min(count, len(some))): [one.name for one in some[:count]] for count in COUNTS}
        for label, names in chosen.items():
            own, plain, seconds = errors(folder, names)
            print(f"{name:<15}{label:<14}{own:>8.2f}{plain:>8.2f}{seconds:>7.1f}", flush=True)


if __name__ == "__main__":
    main()

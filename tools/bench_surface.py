"""Normals of DiLiGenT by lpcal compared with plain least squares on the same images.

``python tools/bench_surface.py [FOLDER]``: FOLDER holds diligent_ball, diligent_bear (default: the recordings' surface folder);
``python tools/bench_surface.py card`` is tools/bench_card.py; with the word ``counts`` it prints the errors by the number of lights: each
set holds the one before, the next light being that furthest from all so far.
``python tools/bench_surface.py smooth [-o FOLDER]`` counts, on real sets whose truth nobody knows, the neighbours whose normals are over 15
degrees apart; FOLDER gets a picture of both normal maps of each.
Angles in degrees; six lights are those nearest to six evenly spread azimuths at the median slant.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.formats.capture import read_capture
from lpcal.formats.import_lights import named_after, read_lights
from lpcal.geometry import lambert
from lpcal.records.calibration import Light
from lpcal.records.observations import Radiance
from lpcal.surface.reconstruct import Options, reconstruct
from lpcal.view import pixel_list

DATA = Path(os.environ.get("LPCAL_DATA", Path(__file__).resolve().parents[2] / "shared/data")) / "surface"
COUNTS = (6, 8, 10, 16, 24, 48, 96)
FIRST = {"diligent_ball": 1, "diligent_bear": 21}
"""The first 20 images of bear are known to be corrupted."""

REAL = {
    "psbox": ("lights/psbox/light_directions.txt", "lights/psbox/Objects"),
    "uw buddha": ("lights/uw_psm/lights.txt", "lights/uw_psm/buddha"),
    "uw gray": ("lights/uw_psm/lights.txt", "lights/uw_psm/gray"),
}
"""Lights and images of sets of 12 distant lights."""
RAYLEIGH_MEDIAN = np.sqrt(2 * np.log(2))
"""Median of an angle whose two axes have a standard deviation of 1."""
APART_DEG = 15.0
"""Between the normals of neighbouring pixels: few surfaces bend so much in a pixel, speckle and cracks do."""


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


def plain_normals(radiance: Radiance, lights: Sequence[Light], mask: np.ndarray) -> np.ndarray:
    """Normals (P, 3) of a mask by plain least squares on all samples."""
    signal = pixel_list.grey(radiance, lights).signal[:, mask].astype(float)
    B = np.repeat(np.stack([light.direction_C for light in lights])[:, None], mask.sum(), axis=1)
    return lambert.unit(lambert.weighted(B, signal, np.ones(signal.shape))[0])[0]


def share_apart(normals: np.ndarray, mask: np.ndarray) -> float:
    """Per cent of the neighbours in a mask whose normals (H, W, 3) are over APART_DEG apart."""
    far = []
    for one, other in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        cosine = np.sum(normals[one] * normals[other], axis=-1)[mask[one] & mask[other]]
        far.append(cosine < np.cos(np.radians(APART_DEG)))
    return float(100 * np.concatenate(far).mean())


def smooth(words: list[str]) -> None:
    """Print the table of the real sets, and draw their normals."""
    out = Path(words[words.index("-o") + 1]) if "-o" in words else None
    print(f"{'set':<12}{'pixels':>8}{'lpcal %':>9}{'plain %':>9}{'ratio':>7}")
    for name, (light_file, images) in REAL.items():
        folder = DATA.parent / images
        if not folder.is_dir():
            print(f"{name:<12}not there")
            continue
        calibration = named_after(read_lights(DATA.parent / light_file)[1], folder)
        radiance = to_radiance(read_capture(folder, [light.name for light in calibration.lights]), Sensor())
        found = reconstruct(radiance, calibration, Options())
        plain = np.full(found.normals.shape, np.nan)
        plain[found.mask] = plain_normals(radiance, pixel_list.lights_of(calibration, radiance), found.mask)
        own, other = share_apart(found.normals, found.mask), share_apart(plain, found.mask)
        print(f"{name:<12}{found.mask.sum():>8}{own:>9.2f}{other:>9.2f}{own / other:>7.2f}", flush=True)
        if out is not None:
            both = np.concatenate([found.normals, plain], axis=1) * [1, -1, -1]
            out.mkdir(parents=True, exist_ok=True)
            Image.fromarray(np.nan_to_num(127.5 * (1 + both), nan=127).astype(np.uint8)).save(out / f"{name.replace(' ', '_')}.png")


def errors(folder: Path, names: list[str] | None) -> list[float]:
    """Mean errors of lpcal and of plain least squares, their medians, the median of lpcal's over its sigma, and lpcal's seconds."""
    _, calibration = read_lights(folder)
    raw = read_capture(folder, [light.name for light in calibration.lights], use=names)
    radiance, begun = to_radiance(raw, Sensor()), time.perf_counter()
    found = reconstruct(radiance, calibration, Options())
    seconds = time.perf_counter() - begun
    with np.load(folder / "normal_gt.npz") as stored:
        truth = stored[stored.files[0]] * [1, -1, -1]
    mask = found.mask & (np.linalg.norm(truth, axis=-1) > 0.5)
    plain = plain_normals(radiance, pixel_list.lights_of(calibration, radiance), mask)

    own, other = (
        np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(n - truth[mask], axis=-1) / 2, 0, 1))) for n in (found.normals[mask], plain)
    )
    sigmas = np.median(own / found.normal_std_deg[mask]) / RAYLEIGH_MEDIAN
    return [float(one) for one in (own.mean(), other.mean(), np.median(own), np.median(other), sigmas, seconds)]


def main() -> None:
    """Print the table."""
    if sys.argv[1:2] == ["card"]:
        from bench_card import main as card

        card([int(word) for word in sys.argv[2:]])
        return
    if sys.argv[1:2] == ["smooth"]:
        smooth(sys.argv[2:])
        return
    words = [word for word in sys.argv[1:] if word != "counts"]
    root = Path(words[0]) if words else DATA
    print(
        f"{'':<29}{'mean':>8}{'':>8}{'median':>8}\n{'set':<15}{'lights':<14}" + 2 * f"{'lpcal':>8}{'plain':>8}" + f"{'/sigma':>8}{'s':>8}"
    )
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
            print(f"{name:<15}{label:<14}" + "".join(f"{one:>8.2f}" for one in errors(folder, names)), flush=True)


if __name__ == "__main__":
    main()

"""Powers of imported lights: found where they differ, left alone where not, never taken up for a curve or gloss, and said."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from lit_heights import Drawn, Recipe, draw
from lpcal.api.curve import settle_sensor
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.formats.calibration_yaml import write_calibration
from lpcal.geometry import lambert
from lpcal.records.provenance import Provenance
from lpcal.records.sensor import StatedSensor
from lpcal.surface import self_calibration
from lpcal.surface.reconstruct import Options, reconstruct
from lpcal.view import pixel_list

SMALL = Recipe(size=56)
EQUAL = {
    "matte": SMALL,
    "gloss": replace(SMALL, gloss=0.4),
    "broad gloss and shadows": replace(SMALL, gloss=0.3, shine=10, bumps=8, most_slant_deg=72),
    "six lights": replace(SMALL, lights=6, gloss=0.2, bumps=4),
    "eight lights, much gloss": replace(SMALL, lights=8, gloss=0.4, bumps=8),
    "fifty lights": replace(SMALL, lights=50, gloss=0.2, bumps=4),
    "room": replace(SMALL, room=0.2, gloss=0.2),
}
UNEQUAL = {
    "matte": replace(SMALL, spread=0.1),
    "a little": replace(SMALL, spread=0.03),
    "much": replace(SMALL, spread=0.4),
    "gloss": replace(SMALL, spread=0.2, gloss=0.2),
    "shadows": replace(SMALL, spread=0.2, bumps=8, most_slant_deg=72),
    "six lights": replace(SMALL, lights=6, spread=0.2),
    "fifty lights": replace(SMALL, lights=50, spread=0.2, gloss=0.2, bumps=4),
}


def seen_by(drawn: Drawn) -> tuple[pixel_list.PixelList, tuple]:
    radiance = to_radiance(drawn.raw, Sensor())
    lights = pixel_list.lights_of(drawn.calibration, radiance)
    rays = pixel_list.ray_map(drawn.mask.shape, None)
    return pixel_list.list_pixels(pixel_list.grey(radiance, lights), rays, drawn.mask, central=False), lights


def error_deg(n: np.ndarray, truth: np.ndarray) -> float:
    return float(np.degrees(np.nanmean(2 * np.arcsin(np.clip(np.linalg.norm(n - truth, axis=-1) / 2, 0, 1)))))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", EQUAL)
def test_equal_powers_stay_equal(kind: str, seed: int) -> None:
    assert self_calibration.intensities(*seen_by(draw(EQUAL[kind], seed))) is None


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", UNEQUAL)
def test_unequal_powers_are_found_nearer_than_equal_ones(kind: str, seed: int) -> None:
    drawn = draw(UNEQUAL[kind], seed)
    found = self_calibration.intensities(*seen_by(drawn))
    assert found is not None
    assert found.mean() == pytest.approx(1.0)
    assert np.std(np.log(found / drawn.intensity)) < 0.5 * np.std(np.log(drawn.intensity))


@pytest.mark.parametrize("kind", ["gloss", "broad gloss and shadows", "six lights", pytest.param("fifty lights", marks=pytest.mark.slow)])
def test_equal_lights_come_out_better_than_plain_least_squares(kind: str) -> None:
    drawn = draw(EQUAL[kind], 4)
    seen, lights = seen_by(drawn)
    S = np.stack([light.direction_C for light in lights])
    plain = lambert.unit(np.linalg.lstsq(S, seen.signal, rcond=None)[0].T)[0]
    found = reconstruct(to_radiance(drawn.raw, Sensor()), drawn.calibration, Options(mask=drawn.mask))
    assert found.figures.intensities_found is None
    assert error_deg(found.normals[drawn.mask], drawn.normals[drawn.mask]) < 0.5 * error_deg(plain, drawn.normals[drawn.mask])


@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2))])
def test_a_curve_is_not_taken_up_by_powers(seed: int) -> None:
    drawn = draw(Recipe(size=40, lights=30, gamma=2.2), seed)
    settled = settle_sensor(drawn.raw, drawn.calibration, [("told", StatedSensor(1.0))])
    assert not settled.linear
    radiance = to_radiance(drawn.raw, settled.used.sensor)
    by_hand, heeded = (reconstruct(radiance, drawn.calibration, Options(mask=drawn.mask, linear=each)) for each in (True, settled.linear))
    assert by_hand.figures.intensities_found  # powers would take it up
    assert heeded.figures.intensities_found is None


def test_powers_that_somebody_measured_are_no_matter() -> None:
    drawn = draw(UNEQUAL["much"], 0)
    lights = drawn.calibration.lights
    assert self_calibration.unmeasured(lights)
    assert not self_calibration.unmeasured([replace(light, intensity_std=0.01) for light in lights])
    assert not self_calibration.unmeasured([replace(lights[0], intensity=np.array([1.1])), *lights[1:]])


@pytest.mark.parametrize(("kind", "recipe"), [("found", UNEQUAL["gloss"]), ("equal", EQUAL["gloss"]), ("equal", EQUAL["six lights"])])
def test_powers_that_are_estimated_are_said_on_the_terminal(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, kind: str, recipe: Any
) -> None:
    drawn = draw(recipe, 2)
    (tmp_path / "cap").mkdir()
    for name, image in zip(drawn.raw.lights, drawn.raw.images, strict=True):
        cv2.imwrite(str(tmp_path / f"cap/{name}.png"), np.rint(255 * image).astype(np.uint8))
    cv2.imwrite(str(tmp_path / "cap/mask.png"), 255 * drawn.mask.astype(np.uint8))
    cv2.imwrite(str(tmp_path / "cap/ambient.png"), np.rint(255 * drawn.raw.ambient[0]).astype(np.uint8))
    write_calibration(tmp_path / "c.yaml", drawn.calibration, Provenance())
    code, _, told = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out", cwd=tmp_path)
    assert code == 0, told
    said = "the lights' intensities are not stated: they were estimated from the object" in told
    figures = json.loads((tmp_path / "out/summary.json").read_text())["counts_and_residuals"]
    assert said == (kind == "found") == ("intensities_found" in figures)

"""Real chrome and matte spheres under distant lights: PSBox's probes and the University of Washington's."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import pytest

from lpcal.chain.refine_lights import refine
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.formats.capture import read_capture
from lpcal.records.calibration import LightsSolution
from lpcal.records.observations import SphereView

Data = Callable[[str], Path]
IMAGES = [f"Image_{k:02d}" for k in range(1, 13)]
FLIP = np.array([1.0, -1.0, -1.0])  # published: x right, y up, z to the camera


def published(folder: Path) -> np.ndarray:
    directions = np.loadtxt(folder / "light_directions.txt").T
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def twin(folder: Path) -> np.ndarray:
    """The published recipe: grey of 250 and more, its median, a circle with y counted from the bottom, both from 1."""
    x0, y0, radius = np.loadtxt(folder / "circle_data.txt")
    found = []
    for name in IMAGES:
        blue, green, red = cv2.split(cv2.imread(str(folder / f"{name}.JPG")).astype(float))
        grey = np.rint(0.2989 * red + 0.5870 * green + 0.1140 * blue)
        rows, columns = np.nonzero(grey >= 250)
        n = np.array([np.median(columns) + 1 - x0, len(grey) - np.median(rows) - y0, 0.0]) / radius
        n[2] = np.sqrt(1 - n @ n)
        found.append(2 * n[2] * n - [0, 0, 1])
    return np.array(found)


def apart_deg(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(np.sum(a * b, axis=1), -1, 1)))


@cache
def view_of(name: str, kind: str, folder: Path, lights: tuple[str, ...]) -> SphereView:
    return observe_sphere(to_radiance(read_capture(folder, list(lights), name=name), Sensor()), Expected(kind, None), None)


def solved(folders: dict[str, tuple[str, Path]], lights: list[str]) -> LightsSolution:
    return refine([view_of(name, kind, folder, tuple(lights)) for name, (kind, folder) in folders.items()], lights, None, None)


def test_the_published_recipe_is_read_right(data: Data) -> None:
    for probe in ("LightProbe-1", "LightProbe-2"):
        folder = data("lights/psbox") / probe
        assert apart_deg(twin(folder), published(folder)).max() < 0.1


@pytest.mark.slow
def test_own_directions_agree_with_the_published(data: Data) -> None:
    """The published circles were set by hand, and their two probes differ by .4 to 1.75 deg."""
    folders = {probe: ("chrome", data("lights/psbox") / probe) for probe in ("LightProbe-1", "LightProbe-2")}
    solution = solved(folders, IMAGES)
    for sphere, (_, folder) in zip(solution.spheres, folders.values(), strict=True):
        own = np.array([sphere.directions_C[light] for light in IMAGES])
        assert np.median(apart_deg(own, published(folder) * FLIP)) < 1.3


@pytest.mark.slow
def test_the_rim_is_found_where_it_fades_into_the_wall(data: Data) -> None:
    """At its top LightProbe-1 mirrors the wall behind it, and the only edge there lies 6 px inside the rim. Streaks that it mirrors end
    at the rim, at y = 51.5 +- 1 px (read off the images' polar unwrapping with the wall's brightness divided out)."""
    folder = data("lights/psbox") / "LightProbe-1"
    view = view_of("LightProbe-1", "chrome", folder, tuple(IMAGES))
    waves = np.column_stack([2 * view.outline_px, np.ones(len(view.outline_px))])
    x, y, c = np.linalg.lstsq(waves, np.sum(view.outline_px**2, axis=1), rcond=None)[0]
    assert y - np.sqrt(c + x**2 + y**2) == pytest.approx(51.5, abs=1.5)


def test_chrome_and_matte_agree(data: Data) -> None:
    lights = [f"light_{k:02d}" for k in range(12)]
    folder = data("lights/uw_psm")
    solution = solved({"chrome": ("chrome", folder / "chrome"), "gray": ("matte", folder / "gray")}, lights)
    chrome, matte = (np.array([sphere.directions_C[light] for light in lights]) for sphere in solution.spheres)
    assert np.median(apart_deg(chrome, matte)) < 1.7

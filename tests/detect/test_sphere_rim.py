"""The outline of a chrome sphere whose rim mirrors, over a part of it, what is as dark as what is behind it: a kink there and no step."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from lpcal.detect.sphere_outline import circle_curve, on_sharp_edges, refine_outline
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.records.observations import Radiance

SIZE, FINER, BACK, INSIDE, NOISE = 96, 8, 0.05, 0.16, 0.0012
SECTORS = {"a quarter": (24.0, 250.0, 90.0), "a third": (30.0, 20.0, 120.0), "of a small one": (16.0, 130.0, 100.0)}


def _rim(r: float, start_deg: float, width_deg: float, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A picture (SIZE, SIZE), and the sphere's place."""
    middle = SIZE / 2 + rng.uniform(-0.5, 0.5, 2)
    row, column = (np.indices((SIZE * FINER, SIZE * FINER)) + 0.5) / FINER - 0.5
    inward = r - np.hypot(column - middle[0], row - middle[1])
    around = (np.degrees(np.arctan2(row - middle[1], column - middle[0])) - start_deg) % 360
    share = np.clip(inward / 5, 0, 1)
    faded = np.where(around < width_deg, BACK + (INSIDE - BACK) * share**1.5, INSIDE)
    fine = np.where(inward > 0, faded, BACK)
    return gaussian_filter(fine.reshape(SIZE, FINER, SIZE, FINER).mean(axis=(1, 3)), 0.6) + NOISE * rng.normal(size=(SIZE, SIZE)), middle


@pytest.mark.parametrize("sector", SECTORS)
def test_a_rim_as_dark_as_what_is_behind_it_moves_no_outline(sector: str) -> None:
    rng = np.random.default_rng(3)
    r, *where = SECTORS[sector]
    image, middle = _rim(r, *where, rng)
    first = refine_outline(image, "chrome", np.array([*middle, r]), circle_curve())
    found = on_sharp_edges(image, first, circle_curve())
    assert np.linalg.norm(found.centre_px - middle) < 0.1
    assert abs(found.radius_px - r) < 0.1
    assert found.sigma_px < 0.15


@pytest.mark.slow
def test_what_is_observed_of_a_sphere_is_its_sharp_outline() -> None:
    rng = np.random.default_rng(3)
    image, middle = _rim(*SECTORS["a quarter"], rng)
    lights = ("A", "B", "C")
    signal = np.repeat(image[None].astype(np.float32), 3, axis=0)
    row, column = np.indices(image.shape)
    for k, (x, y) in enumerate(((-8, -4), (7, -5), (1, 8))):
        signal[k] += 0.7 * np.exp(-0.5 * ((column - middle[0] - x) ** 2 + (row - middle[1] - y) ** 2)).astype(np.float32)
    none = np.zeros(signal.shape, bool)
    radiance = Radiance("ball", lights, signal, np.full_like(signal, NOISE), none, np.zeros_like(signal[0]))
    view = observe_sphere(radiance, Expected("chrome", None, np.array([*middle, 24.0])), None)
    x, y = view.outline_px[:, 0], view.outline_px[:, 1]
    centre = np.linalg.lstsq(np.column_stack([2 * x, 2 * y, np.ones_like(x)]), x**2 + y**2, rcond=None)[0][:2]
    assert np.linalg.norm(centre - middle) < 0.1

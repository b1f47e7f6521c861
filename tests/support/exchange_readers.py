"""A calibration to export, and other systems' own readers, each skipped by its name where it is not installed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from lpcal.geometry import se3
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

LENSES = {
    "opencv4": [-0.18, 0.07, 0.0008, 0.0001],
    "opencv5": [-0.18, 0.07, 0.0008, 0.0001, -0.012],
    "opencv8": [0.12, 0.05, 0.0008, -0.0003, 0.004, 0.31, 0.02, 0.001],
}
H_PC = se3.transform(se3.rotation(np.array([0.3, -0.2, 1.1])), np.array([0.0123456789, -0.031, 0.044]))
FOCUS_C = np.array([0.002, -0.003, 0.36])


def reader(name: str) -> ModuleType:
    """Another system's own package; the test is skipped, by its name, where it is not installed (uv sync --group readers)."""
    return pytest.importorskip(name, reason=f"the reader {name} is not installed")


def camera(model: str = "opencv5") -> Camera:
    K = np.array([[461.629, 0, 362.680], [0, 460.152, 246.049], [0, 0, 1.0]])
    return Camera((752, 480), model, K, np.array(LENSES[model]), black_level=0.008, rms_px=0.21)


def lights(count: int = 6) -> tuple[Light, ...]:
    made = []
    for k in range(count):
        angle = 2 * np.pi * k / count + 0.1
        source = np.array([0.16 * np.cos(angle), 0.17 * np.sin(angle), 0.03])
        axis = (FOCUS_C - source) / np.linalg.norm(FOCUS_C - source)
        x = np.cross([0, 1.0, 0.3], axis)
        x /= np.linalg.norm(x)
        H_CL = se3.transform(np.stack([x, np.cross(axis, x), axis], axis=1), source + 0.003 * axis)
        intensity = np.array([1.0, 0.9, 0.8]) * (1 + 0.1 * (-1) ** k)
        made.append(Light(f"L{k}", -axis, intensity, H_CL, source, axis, Lobe("cosine", exponent=4.0 + 0.3 * k), 0.001, 0.002, 0.01))
    mean = np.mean([light.intensity for light in made])
    return tuple(replace(light, intensity=light.intensity / mean) for light in made)


def calibration(model: str = "opencv5") -> Calibration:
    return Calibration("rig", lights(), camera(model), H_PC, 0.36, FOCUS_C)


def grid(found: Camera) -> np.ndarray:
    """Pixels all over the image (N, 2)."""
    width, height = found.image_size
    x, y = np.meshgrid(np.linspace(0, width - 1, 13), np.linspace(0, height - 1, 9))
    return np.stack([x.ravel(), y.ravel()], axis=1)


def same_lens(found: Camera, wanted: Camera, tolerance_px: float = 1e-9) -> None:
    """Two cameras project alike."""
    assert found.image_size == wanted.image_size
    rays = wanted.unproject(grid(wanted))
    assert np.abs(found.project(rays) - wanted.project(rays)).max() < tolerance_px


def only(folder: Path) -> Path:
    """The one export in a folder, its list apart."""
    found = [path for path in folder.iterdir() if path.name != "lpcal-export.json"]
    assert len(found) == 1
    return found[0]

"""Draws a capture of any size: a relief with detail at all scales before a camera or under distant lights, 16 bit, with its truth.

``python tools/large_capture.py FOLDER --size 6000x4000 --lights 48 [--distant]`` writes FOLDER/capture (images, ambient, mask),
FOLDER/calibration.yaml and FOLDER/truth.npz (normals and depth at every eighth pixel). Rows are drawn in bands: memory does not matter.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.documents import Provenance
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Calibration, Camera, Light, Lobe

DISTANCE_M = 0.35
FOCUS_C = np.array([0.0, 0.0, DISTANCE_M])
BAND = 64
THIN = 8


def lights_of(count: int, *, distant: bool) -> tuple[Light, ...]:
    """Lights on three rings about the camera."""
    made = []
    for k in range(count):
        turn, slant = 2.39996 * k, np.radians(22 + 28 * ((k * 0.618) % 1))
        if distant:
            direction = np.array([np.sin(slant) * np.cos(turn), np.sin(slant) * np.sin(turn), -np.cos(slant)])
            made.append(Light(f"L{k:02}", direction, np.ones(1)))
            continue
        source = FOCUS_C + 0.36 * np.array([np.sin(slant) * np.cos(turn), np.sin(slant) * np.sin(turn), -np.cos(slant)])
        axis = (FOCUS_C - source) / np.linalg.norm(FOCUS_C - source)
        made.append(Light(f"L{k:02}", -axis, np.ones(1), None, source, axis, Lobe("cosine", exponent=3.0), 1e-3, 1e-3, 2e-3))
    return tuple(made)


def relief(x: Array, y: Array) -> Array:
    """Height (...) in units of the picture's width, at places in the same units: hills, ripples, and a letter's strokes; smooth."""
    hills = 0.03 * np.exp(-((x / 0.22) ** 2 + (y / 0.16) ** 2)) + 0.006 * np.sin(17 * x + 2 * y) * np.cos(13 * y)
    strokes = 0.0012 * np.tanh(3 * np.sin(70 * x + 11 * y)) + 0.0004 * np.sin(260 * x) * np.sin(230 * y)
    return np.asarray(hills + strokes)


def main() -> None:
    """Draw."""
    words = argparse.ArgumentParser()
    words.add_argument("folder", type=Path)
    words.add_argument("--size", default="1732x1155")
    words.add_argument("--lights", type=int, default=48)
    words.add_argument("--distant", action="store_true")
    words.add_argument("--no-mask", action="store_true")
    asked = words.parse_args()
    width, height = (int(side) for side in asked.size.split("x"))
    (asked.folder / "capture").mkdir(parents=True, exist_ok=True)
    lights = lights_of(asked.lights, distant=asked.distant)
    focal = 1.1 * width
    K = np.array([[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1.0]])
    camera = None if asked.distant else Camera((width, height), "opencv4", K, np.zeros(4))
    calibration = Calibration("drawn", lights, camera, None, None if asked.distant else DISTANCE_M, None if asked.distant else FOCUS_C)
    write_calibration(asked.folder / "calibration.yaml", calibration, Provenance())
    images = np.empty((len(lights) + 1, height, width), np.uint16)
    inside, kept = np.zeros((height, width), np.uint8), []
    rng = np.random.default_rng(7)
    for first in range(0, height, BAND):
        row, column = np.mgrid[first - 1 : min(first + BAND, height) + 1, -1 : width + 1].astype(float)
        x, y = (column - (width - 1) / 2) / width, (row - (height - 1) / 2) / width
        if asked.distant:
            points = np.stack([column, row, -width * relief(x, y)], axis=-1)
        else:
            rays = np.stack([x * width / focal, y * width / focal, np.ones_like(x)], axis=-1)
            points = DISTANCE_M * (1 - relief(x, y))[..., None] * rays
        n = np.cross(points[1:-1, 2:] - points[1:-1, :-2], points[2:, 1:-1] - points[:-2, 1:-1])
        n /= -np.linalg.norm(n, axis=-1, keepdims=True)
        n *= -np.sign(n[..., 2:])
        points, x, y = points[1:-1, 1:-1], x[1:-1, 1:-1], y[1:-1, 1:-1]
        rows = slice(first, first + len(points))
        albedo = 0.55 + 0.2 * np.sign(np.sin(90 * x) * np.sin(80 * y)) + 0.05 * np.sin(500 * x)
        inside[rows] = 255 * ((x / 0.46) ** 4 + (y / 0.3) ** 4 < 1)
        for k, light in enumerate(lights):
            d, E = light.field(points.reshape(-1, 3))
            d, E = d.reshape(points.shape), E.reshape(x.shape)
            scale = 0.9 if asked.distant else 0.9 * 0.36**2
            shown = np.where(inside[rows] > 0, scale * albedo * E * np.maximum(np.sum(n * d, axis=-1), 0), 0.004) + 0.01
            shown += np.sqrt(1e-7 + 2e-5 * shown) * rng.standard_normal(shown.shape)
            images[k, rows] = np.rint(65535 * np.clip(shown, 0, 1))
        images[-1, rows] = np.rint(65535 * (0.01 + 3e-4 * rng.standard_normal(x.shape)))
        some = slice(-first % THIN, None, THIN)
        kept.append((n[some, ::THIN].astype(np.float32), points[some, ::THIN, 2].astype(np.float32)))
    for name, image in zip([*(light.name for light in lights), "ambient"], images, strict=True):
        cv2.imwrite(str(asked.folder / f"capture/{name}.png"), image, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    if not asked.no_mask:
        cv2.imwrite(str(asked.folder / "capture/mask.png"), inside)
    normals, depth = (np.concatenate(parts) for parts in zip(*kept, strict=True))
    np.savez(asked.folder / "truth.npz", normals=normals, depth=depth, mask=inside[::THIN, ::THIN] > 0)


if __name__ == "__main__":
    main()

"""Pictures of exact planes under near lights: a card before a wall, over a floor."""

from __future__ import annotations

import numpy as np

from lit_scene import calibration
from lpcal.segmentation import planes
from lpcal.view.pixel_list import SignalMaps, ray_map

CARD = (slice(36, 74), slice(50, 105))
WALL, FLOOR = np.array([0.04, -0.02, 1 / 0.45]), np.array([0.0, 1.0, 0.1]) / 0.06
WORKING_M = 0.38


def picture(parts: list[tuple[np.ndarray, np.ndarray, np.ndarray]], seed: int = 0) -> tuple[SignalMaps, np.ndarray]:
    """Maps and rays of planes, each with its albedo (H, W) and where it is seen, the last one on top."""
    camera = calibration().camera
    assert camera is not None
    width, height = camera.image_size
    rays, lights = ray_map((height, width), camera), calibration().lights
    signal = np.zeros((len(lights), height, width))
    for q, albedo, where in parts:
        sent = np.nan_to_num(planes.predicted(q, rays.reshape(-1, 3), lights).reshape(len(lights), height, width))
        signal[:, where] = (albedo * sent)[:, where]
    sigma = np.full_like(signal, 0.004 * np.median(signal))
    signal += sigma * np.random.default_rng(seed).standard_normal(signal.shape)
    return SignalMaps(signal.astype(np.float32), sigma.astype(np.float32), np.ones(signal.shape, bool)), rays


def scene(pattern: bool = False, card: float | None = 0.7, floor: bool = False) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """A wall, plain or patterned; a card 5 cm before it; a floor under it."""
    row, column = np.indices((112, 160))
    everywhere = np.ones((112, 160), bool)
    on_card = np.zeros_like(everywhere)
    on_card[CARD] = True
    albedo = np.where((row // 8 + column // 8) % 2, 0.25, 0.4) if pattern else np.full(everywhere.shape, 0.35)
    parts = [(WALL, albedo, everywhere)]
    if floor:
        parts.append((FLOOR, np.full(everywhere.shape, 0.5), row > 78))
    if card is not None:
        parts.append((WALL * 0.45 / 0.4, np.full(everywhere.shape, card), on_card))
    return parts

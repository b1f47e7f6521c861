"""Flat sheets with a chessboard, seen in perspective by a homography, with whatever surround: cut squares, frames, tables."""

from __future__ import annotations

import cv2
import numpy as np

SQUARE = 40
"""Pixels of the sheet a square."""
WIDE = 6
"""Squares of surround on every side of the sheet."""
LIGHT, DARK = 215, 35


def sheet(corners: tuple[int, int], *, outer: float = 1.0, surround: int = LIGHT, frame: tuple[float, int] = (0.0, LIGHT)) -> np.ndarray:
    """A board whose outermost squares keep `outer` of their width, a frame (squares wide, its light), and the surround's light."""
    nx, ny = corners
    y, x = (axis / SQUARE - WIDE for axis in np.mgrid[: (ny - 1 + 2 * WIDE) * SQUARE, : (nx - 1 + 2 * WIDE) * SQUARE].astype(float))
    black = (np.floor(x) + np.floor(y)) % 2 == 0
    out = np.maximum(np.maximum(-x, x - (nx - 1)), np.maximum(-y, y - (ny - 1)))
    board = np.where(black, DARK, LIGHT)
    return np.where(out < outer, board, np.where(out < outer + frame[0], frame[1], surround)).astype(np.uint8)


def seen(paper: np.ndarray, seed: int, *, size: tuple[int, int] = (960, 720), noise: float = 2.0, fill: float = 0.9) -> np.ndarray:
    """The sheet (H, W) in an image of a size (w, h), in a perspective and at a roll by the seed, blurred and noisy."""
    rng = np.random.default_rng(seed)
    h, w = paper.shape
    inner = np.array([[0, 0], [w, 0], [w, h], [0, h]], dtype=float) - [w / 2, h / 2]
    margin = (WIDE - 1.3) * SQUARE
    board = inner * [(w - 2 * margin) / w, (h - 2 * margin) / h]
    roll = rng.uniform(-0.5, 0.5)
    turn = np.array([[np.cos(roll), -np.sin(roll)], [np.sin(roll), np.cos(roll)]])
    tilt = rng.uniform(-0.35, 0.35, 2) / np.abs(board).max(axis=0)

    def put(points: np.ndarray) -> np.ndarray:
        return np.asarray((points @ turn.T) / (1 + points @ tilt)[:, None])

    placed = put(board)
    scale = fill * np.min(np.array(size) / np.ptp(placed, axis=0))
    middle = (placed.min(axis=0) + placed.max(axis=0)) / 2
    target = (placed - middle) * scale + np.array(size) / 2
    H = cv2.getPerspectiveTransform((board + np.array([w, h]) / 2).astype(np.float32), target.astype(np.float32))
    fine = cv2.warpPerspective(paper, H, size, flags=cv2.INTER_AREA, borderMode=cv2.BORDER_REPLICATE)
    return np.clip(cv2.GaussianBlur(fine, (0, 0), 0.9) + noise * rng.standard_normal(fine.shape), 0, 255).astype(np.uint8)


def cap(rng: np.random.Generator, h: int, w: int) -> np.ndarray:
    return np.clip(rng.normal(4, 3, (h, w)), 0, 255)


def bright_noise(rng: np.random.Generator, h: int, w: int) -> np.ndarray:
    return np.clip(rng.normal(128, 45, (h, w)), 0, 255)


def cloth(rng: np.random.Generator, h: int, w: int) -> np.ndarray:
    white = rng.normal(0, 1, (h, w)).astype(np.float32)
    return np.clip(128 + sum(40 * s * cv2.GaussianBlur(white, (0, 0), s) for s in (1, 2, 4, 8, 16)), 0, 255)


def leaves(rng: np.random.Generator, h: int, w: int) -> np.ndarray:
    image = np.full((h, w), 60, np.uint8)
    for _ in range(h * w // 300):
        at, axes = rng.integers(0, (w, h)), rng.integers((4, 2), (25, 12))
        cv2.ellipse(
            image,
            (int(at[0]), int(at[1])),
            (int(axes[0]), int(axes[1])),
            float(rng.uniform(0, 360)),
            0,
            360,
            int(rng.integers(20, 230)),
            -1,
        )
    return image


def carpet(rng: np.random.Generator, h: int, w: int) -> np.ndarray:
    y, x = np.mgrid[:h, :w]
    return np.clip(128 + 50 * np.sin(x / 5.1) * np.sin(y / 4.7 + 0.8 * np.sin(x / 40)) + rng.normal(0, 8, (h, w)), 0, 255)


def defocused(rng: np.random.Generator, h: int, w: int) -> np.ndarray:
    return cv2.GaussianBlur(leaves(rng, h, w), (0, 0), 30) + rng.normal(0, 2, (h, w))


BOARDLESS = (cap, bright_noise, cloth, leaves, carpet, defocused)
"""Frames without a board, each a function of a generator, height and width: dark, noisy, textured or out of focus."""

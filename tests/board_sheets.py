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

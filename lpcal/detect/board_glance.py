"""The board at a glance: OpenCV's classic detector with its fast check, a few milliseconds, corners to a pixel."""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array, Image
from lpcal.records.observations import Board


def glance(grey: Image, board: Board) -> Array | None:
    """Corners (N, 2) of a chessboard in an image (H, W) of 0..1; None where it is not seen at once, or is of another kind."""
    import cv2

    if board.kind != "chessboard":
        return None
    top = float(np.quantile(grey, 0.999))
    stored = np.rint(255 * np.clip(grey / max(top, 1e-6), 0, 1)).astype(np.uint8)
    flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
    found, corners = cv2.findChessboardCorners(stored, board.corners, flags=flags)
    return np.asarray(corners, dtype=float).reshape(-1, 2) if found else None

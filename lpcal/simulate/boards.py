r"""Images of the board: every sample of a pixel is traced through the lens to the bowed board.

Symbols: o_B, d_B a ray in B; u, v in -1..1 over the corners; the board's surface, whose mean over the corners is the plane z = 0::

    z_B(x, y) = bow (m - 0.7 u^2 - 0.3 v^2 + twist u v)

Light on it is soft and uneven. Sixteen samples a pixel are blurred before they are summed; each is the mean of the print over its own
small square, or edges would stand in steps of a quarter of a pixel.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.rig import BoardSection
from lpcal.simulate.built import Built
from lpcal.simulate.motion import MARGIN_SQUARES, board_outline
from lpcal.simulate.sensor import blur

OVERSAMPLING = 4
WHITE, BLACK, BACKGROUND = 0.55, 0.045, 0.05
TEXELS = 40
"""Texels along the side of a charuco board's square."""
FINER = 3
"""Places a side of a sample's square at which a charuco board is read."""


@dataclass(frozen=True)
class BoardScene:
    """The board as printed, bowed and lit."""

    built: Built
    section: BoardSection
    albedo: Callable[[Array, Array], Array]
    """Reflectance at x, y in squares."""
    plane: Array
    """(H n, W n, 2) undistorted plane coordinates of the image's samples."""
    psf_sigma_px: float

    def height_m(self, x_m: Array, y_m: Array) -> Array:
        """z_B of the board's surface at x_B, y_B."""
        return surface_height(self.built.bow_m, self.built.twist, self.section.corners, self.section.square, x_m, y_m)

    def points_B(self) -> Array:
        """True corners (ny*nx, 3), x first."""
        nx, ny = self.section.corners
        x, y = np.meshgrid(np.arange(nx) * self.section.square[0], np.arange(ny) * self.section.square[1])
        return np.stack([x.ravel(), y.ravel(), self.height_m(x, y).ravel()], axis=1)

    def render(self, H_CB: Array, lamp_B: Array, backdrop: Array) -> Array:
        """Light (H, W) of the board at a pose before a backdrop (H, W), blurred. `lamp_B` (2,) is the slope of the soft light."""
        width, height = self.built.lens.image_size
        outline = self.built.lens.project(se3.apply(H_CB, board_outline(self.section.corners, self.section.square)))
        left, top = np.maximum(np.floor(outline.min(axis=0)).astype(int) - 6, 0)
        right, bottom = np.minimum(np.ceil(outline.max(axis=0)).astype(int) + 7, [width, height])
        n = OVERSAMPLING
        rays = self.plane[top * n : bottom * n, left * n : right * n].astype(np.float64)
        samples = self._samples(H_CB, lamp_B, rays)
        fine = np.repeat(np.repeat(backdrop[top:bottom, left:right], n, axis=0), n, axis=1)
        fine = blur(np.where(np.isnan(samples), fine, samples), n * self.psf_sigma_px)
        light = backdrop.copy()
        light[top:bottom, left:right] = fine.reshape(bottom - top, n, right - left, n).mean(axis=(1, 3))
        return light

    def _samples(self, H_CB: Array, lamp_B: Array, rays: Array) -> Array:
        """Radiance of each sample's ray, NaN where it misses the board."""
        H_BC = se3.inv(H_CB)
        o_B = H_BC[:3, 3]
        d_B = [rays[..., 0] * H_BC[k, 0] + rays[..., 1] * H_BC[k, 1] + H_BC[k, 2] for k in range(3)]
        z = np.zeros(rays.shape[:2])
        for _ in range(3):
            s = (z - o_B[2]) / d_B[2]
            x, y = o_B[0] + s * d_B[0], o_B[1] + s * d_B[1]
            z = self.height_m(x, y)
        i, j = x / self.section.square[0], y / self.section.square[1]
        nx, ny = self.section.corners
        soft = 1 + lamp_B[0] * (i / nx - 0.5) + lamp_B[1] * (j / ny - 0.5)
        on = (i > -1 - MARGIN_SQUARES) & (i < nx + MARGIN_SQUARES) & (j > -1 - MARGIN_SQUARES) & (j < ny + MARGIN_SQUARES) & (s > 0)
        return np.where(on, soft * self.albedo(i, j), np.nan)


def surface_height(bow_m: float, twist: float, corners: tuple[int, int], square_m: tuple[float, float], x_m: Array, y_m: Array) -> Array:
    """z_B of the board's surface; its mean over the corners is zero."""
    nx, ny = corners
    u = 2 * x_m / (square_m[0] * (nx - 1)) - 1
    v = 2 * y_m / (square_m[1] * (ny - 1)) - 1
    mean = 0.7 * np.mean(np.linspace(-1, 1, nx) ** 2) + 0.3 * np.mean(np.linspace(-1, 1, ny) ** 2)
    # beyond the corners the sheet goes on straight enough: u and v are held
    u, v = np.clip(u, -1.5, 1.5), np.clip(v, -1.5, 1.5)
    return np.asarray(bow_m * (mean - 0.7 * u * u - 0.3 * v * v + twist * u * v))


def make_scene(built: Built, section: BoardSection, psf_sigma_px: float) -> BoardScene:
    """The scene of a rig's board; its rays are traced once.

    Raises
    ------
    InputError
        The board is of a pattern that is not drawn.
    """
    if section.kind in {"circles", "aprilgrid"}:
        raise InputError(f"a board of {section.kind} is not simulated", where="board", needed="kind: chessboard or charuco")
    albedo = _charuco(section) if section.kind == "charuco" else _chessboard(section)
    return BoardScene(built, section, albedo, built.lens.grid(OVERSAMPLING), psf_sigma_px)


def backdrop(image_size: tuple[int, int], rng: np.random.Generator) -> Array:
    """A dim room behind the board, out of focus (H, W)."""
    width, height = image_size
    field = blur(rng.standard_normal((height // 4 + 1, width // 4 + 1)), 8)
    field = np.repeat(np.repeat(field, 4, axis=0), 4, axis=1)[:height, :width]
    return np.asarray(BACKGROUND * np.clip(0.5 + 0.35 * blur(field, 6) / (field.std() + 1e-12), 0.1, 1.2))


def _chessboard(section: BoardSection) -> Callable[[Array, Array], Array]:
    """Squares; the one outside the first corner is black. Samples that an edge crosses are grey by their shares of it."""
    nx, ny = section.corners

    def wave(x: Array) -> Array:
        """1 and -1 in turn from square to square, with slopes one sample wide."""
        width = np.hypot(np.gradient(x, axis=0), np.gradient(x, axis=1))
        to_edge = np.abs(np.remainder(x + 0.5, 1) - 0.5)
        return np.where(np.remainder(np.floor(x), 2) == 0, 1.0, -1.0) * np.minimum(2 * to_edge / np.maximum(width, 1e-12), 1)

    def albedo(i: Array, j: Array) -> Array:
        printed = (i > -1) & (i < nx) & (j > -1) & (j < ny)
        return np.where(printed, WHITE + (BLACK - WHITE) * (1 + wave(i) * wave(j)) / 2, WHITE)

    return albedo


def _charuco(section: BoardSection) -> Callable[[Array, Array], Array]:
    """OpenCV's own drawing of the board, read at its texels."""
    import cv2

    squares = (section.corners[0] + 1, section.corners[1] + 1)
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, section.dictionary or "DICT_5X5_100"))
    marker = (section.marker or 0.7 * section.square[0]) / section.square[0]
    drawn = cv2.aruco.CharucoBoard(squares, 1.0, float(marker), dictionary).generateImage(
        (squares[0] * TEXELS, squares[1] * TEXELS), None, 0, 1
    )
    texture = np.where(np.asarray(drawn) > 127, WHITE, BLACK)

    def read(i: Array, j: Array) -> Array:
        column, row = np.floor((i + 1) * TEXELS).astype(int), np.floor((j + 1) * TEXELS).astype(int)
        printed = (column >= 0) & (column < texture.shape[1]) & (row >= 0) & (row < texture.shape[0])
        return np.where(printed, texture[np.clip(row, 0, texture.shape[0] - 1), np.clip(column, 0, texture.shape[1] - 1)], WHITE)

    def albedo(i: Array, j: Array) -> Array:
        (i_down, i_across), (j_down, j_across) = np.gradient(i), np.gradient(j)
        offset = (np.arange(FINER) + 0.5) / FINER - 0.5
        places = [(i + a * i_across + b * i_down, j + a * j_across + b * j_down) for a in offset for b in offset]
        return np.asarray(np.mean([read(*place) for place in places], axis=0))

    return albedo

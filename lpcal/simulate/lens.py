r"""The simulated camera: pixels of points, and rays of pixels.

Symbols: ``(x, y) = (X/Z, Y/Z)`` of a point in C, ``r2 = x^2 + y^2``, five coefficients k1 k2 p1 p2 k3::

    x_d = x (1 + k1 r2 + k2 r2^2 + k3 r2^3) + 2 p1 x y + p2 (r2 + 2 x^2),     u = fx x_d + cx

Rays come from fixed-point iteration of the inverse. On purpose it shares no code with ``geometry.camera``, which the solvers use.
Source: OpenCV, calib3d module documentation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array

INVERSE_STEPS = 40
INVERSE_PRECISION = 1e-12
CHUNK = 1 << 16


@dataclass(frozen=True)
class Lens:
    """A camera with OpenCV's five distortion coefficients; pixel centres at whole numbers."""

    image_size: tuple[int, int]
    K: Array
    distortion: Array
    vignetting_r4: float = 0.1
    vignetting_centre_px: tuple[float, float] = (0.0, 0.0)
    """Where the vignetting is centred, from the image's middle."""

    def project(self, x_C: Array) -> Array:
        """Pixels (..., 2) of points x_C (..., 3)."""
        plane_d = self._distort(x_C[..., :2] / x_C[..., 2:])
        return np.asarray(plane_d * np.diag(self.K)[:2] + self.K[:2, 2])

    def plane(self, pixels: Array) -> Array:
        """Undistorted (x, y) (N, 2) at z = 1 of pixels (N, 2)."""
        plane_d = (np.asarray(pixels, dtype=float) - self.K[:2, 2]) / np.diag(self.K)[:2]
        parts = [self._undistort(plane_d[start : start + CHUNK]) for start in range(0, len(plane_d), CHUNK)]
        return np.concatenate(parts) if parts else plane_d

    def grid(self, oversampling: int = 1) -> Array:
        """Undistorted plane coordinates (H n, W n, 2) of the image's samples, n to a pixel's side."""
        width, height = self.image_size
        u, v = (np.arange(size * oversampling) / oversampling - 0.5 + 0.5 / oversampling for size in (width, height))
        pixels = np.stack(np.meshgrid(u, v), axis=-1)
        return self.plane(pixels.reshape(-1, 2)).reshape(pixels.shape)

    def inside(self, x_C: Array, margin_px: float) -> bool:
        """Whether all points x_C (N, 3) are in front and project into the image, by a margin."""
        if np.any(x_C[:, 2] <= 0.02):
            return False
        pixels = self.project(x_C)
        return bool(np.all(pixels >= margin_px) and np.all(pixels <= np.array(self.image_size) - 1 - margin_px))

    def vignetting(self) -> Array:
        """Relative sensitivity (H, W), 1 at its centre: cos^4 of the ray and a further fall with the fourth power of the radius."""
        width, height = self.image_size
        u, v = np.meshgrid(np.arange(width), np.arange(height))
        du = (u - (width - 1) / 2 - self.vignetting_centre_px[0]) / self.K[0, 0]
        dv = (v - (height - 1) / 2 - self.vignetting_centre_px[1]) / self.K[1, 1]
        r2 = du * du + dv * dv
        corner2 = ((width / 2 / self.K[0, 0]) ** 2 + (height / 2 / self.K[1, 1]) ** 2) ** 2
        return np.asarray((1 + r2) ** -2 * (1 - self.vignetting_r4 * r2 * r2 / corner2))

    def _distort(self, plane: Array) -> Array:
        k1, k2, p1, p2, k3 = self.distortion
        x, y = plane[..., 0], plane[..., 1]
        r2 = x * x + y * y
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        x_d = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
        y_d = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
        return np.stack([x_d, y_d], axis=-1)

    def _undistort(self, plane_d: Array) -> Array:
        plane = plane_d.copy()
        for _ in range(INVERSE_STEPS):
            step = plane_d - self._distort(plane)
            plane += step
            if np.max(np.abs(step), initial=0.0) < INVERSE_PRECISION:
                break
        return plane

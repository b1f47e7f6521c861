r"""Cost of a depth discontinuity between two pixels, by the contrast of their images.

Two surfaces at different depths hardly ever look the same on both sides of their border: normals, albedo, irradiance and shadows differ.
Where the images show no contrast, what asks for a break is an error that many pixels share (interreflection, gloss or a shadow that is not
modelled), and the surface is whole. So a break costs, in units of the cost where contrast is high,

    1 + (CONTRAST / c_ab)^2,      c_ab^2 = sum_k (I_ka - I_kb)^2 / sum_k ((I_ka + I_kb) / 2)^2

over the lights k. Noise is contrast as well, so that dark or noisy pixels are neutral. Sources: Gamble and Poggio 1987, MIT A.I. Memo 970
(discontinuities of depth where the image has edges); Boykov and Jolly 2001, ICCV (costs of a cut that fall with the contrast).
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.integration.integrate import Grid
from lpcal.view.constants import REGULARISATION
from lpcal.view.pixel_list import PixelList

CONTRAST = 0.05
"""Contrast, a ratio, that 19 of 20 true depth discontinuities exceed on drawn scenes (tools/break_contrast.py)."""


def break_costs(seen: PixelList, grid: Grid) -> Array:
    """Cost (edges,) of a break at each edge of the grid of `seen`, no less than 1."""
    difference, total = np.zeros(len(grid.a)), np.zeros(len(grid.a))
    for signal in seen.signal:  # light by light: all at once would need a copy of the images for each end
        at_a, at_b = signal[grid.a], signal[grid.b]
        difference += (at_a - at_b) ** 2
        total += (at_a + at_b) ** 2
    contrast2 = 4 * difference / np.maximum(total, np.finfo(float).tiny)
    return np.asarray(1 + CONTRAST**2 / np.maximum(contrast2, REGULARISATION))

"""Array types for signatures; shapes are given in the docstrings."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

type Array = npt.NDArray[np.float64]
"""Real numbers, double precision."""

type Image = npt.NDArray[np.float32]
"""Real values per pixel, single precision: (H, W) or (H, W, 3)."""

type Mask = npt.NDArray[np.bool_]
"""True where something holds."""

type Labels = npt.NDArray[np.uint8]
"""Small integers per pixel."""

type Index = npt.NDArray[np.intp]
"""Indices into another array."""

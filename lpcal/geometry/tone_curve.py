r"""Tone curves: how stored numbers follow from linear ones, both as fractions of full scale.

Symbols: stored s, linear l. A gamma g: ``s = l^(1/g)``. sRGB (IEC 61966-2-1): ``s = 12.92 l`` up to l = .0031308, then
``s = 1.055 l^(1/2.4) - .055``; over its whole range it is about a gamma of 2.2, in the dark it is not.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lpcal.errors import DisagreementError

type Numbers = npt.NDArray[np.floating[Any]]
type Gamma = float | Literal["srgb"]
"""A tone curve: an exponent, or the word srgb."""

SRGB_EXPONENT = 2.2
"""The exponent of the power that is nearest to sRGB's curve over its whole range."""
SRGB_LINEAR_STORED, SRGB_LINEAR, SRGB_SLOPE = 0.04045, 0.0031308, 12.92
"""Stored and linear number up to which sRGB is a straight line, and the line's slope."""
SRGB_OFFSET, SRGB_POWER = 0.055, 2.4
"""Offset and exponent of sRGB beyond its line."""


def decode(stored: Numbers, gamma: Gamma) -> Numbers:
    """Linear numbers of stored ones, of any shape and kind of float; negative ones are 0 under a curve that is none of gamma 1."""
    if gamma == 1.0:
        return stored
    above = np.maximum(stored, 0)
    if gamma == "srgb":
        curved = ((above + SRGB_OFFSET) / (1 + SRGB_OFFSET)) ** np.asarray(SRGB_POWER, above.dtype)
        return np.asarray(np.where(above <= SRGB_LINEAR_STORED, above / SRGB_SLOPE, curved), above.dtype)
    return np.asarray(above ** np.asarray(gamma, above.dtype))


def encode(linear: Numbers, gamma: Gamma) -> Numbers:
    """Stored numbers of linear ones (see `decode`)."""
    above = np.maximum(linear, 0)
    if gamma == "srgb":
        curved = (1 + SRGB_OFFSET) * above ** (1 / SRGB_POWER) - SRGB_OFFSET
        return np.asarray(np.where(above <= SRGB_LINEAR, SRGB_SLOPE * above, curved))
    return np.asarray(above ** (1 / gamma))


def exponent(gamma: Gamma) -> float:
    """The exponent that a curve has, or is nearest to."""
    return SRGB_EXPONENT if gamma == "srgb" else float(gamma)


def worded(gamma: Gamma) -> str:
    """A curve as people write it: ``2.2``, ``srgb``."""
    return "srgb" if gamma == "srgb" else f"{gamma:.3g}"


def not_linear(power: float) -> DisagreementError:
    """The refusal of a matte sphere whose shading is light's only once its numbers are raised to a power."""
    return DisagreementError(
        f"its shading falls off as a matte sphere's does only when the numbers are raised to {power:.1f}: they are not linear",
        needed="images proportional to light",
        todo="switch the camera's gamma and tone curves off, or state camera.gamma (now undone as stated) in panel.yaml",
    )

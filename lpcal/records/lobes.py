"""How a light's intensity falls off with the angle from its axis, and the kinds of such lobes.

Kinds are lpcal's own, those that a program adds, and those of installed packages: an entry point of the group ``lpcal.lobes`` names a
`LobeKind`. A kind that a program has put into `geometry.light_field.FORMULAS` comes first. Packages are asked only where a name is not
known without them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from lpcal.errors import InputError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.light_field import FORMULAS, TABLED, Formula, table_lobe
from lpcal.records.installed import installed

GROUP = "lpcal.lobes"
"""The entry points of installed packages among which kinds of lobe are looked for."""


@dataclass(frozen=True)
class LobeKind:
    """A kind of lobe of one parameter.

    Parameters
    ----------
    name : str
        The word that stands as ``kind`` in a file.
    formula : callable
        ``formula(angle_rad, exponent)``: the intensity (...) relative to that on the axis, at angles (...) from 0 to pi. It is 1 at the
        angle 0 and nowhere negative.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> lpcal.extend.LobeKind("gaussian", lambda angle_rad, exponent: np.exp(-exponent * angle_rad**2)).name
    'gaussian'
    """

    name: str
    formula: Callable[[Array, float], Array]


def register(kind: LobeKind) -> None:
    """Add a kind for this process, or another one under its name."""
    FORMULAS[kind.name] = kind.formula


def formula_of(name: str) -> Formula:
    """The function of a kind.

    Raises
    ------
    InputError
        No kind has the name, or an installed package names what is no kind.
    """
    if name not in FORMULAS and name not in known():
        raise InputError(
            f"a lobe of kind {name!r}", needed=f"one of {', '.join(known())}", todo="register the kind, or install its package"
        )
    return FORMULAS[name]


def known() -> list[str]:
    """The names of all kinds, in order, those of installed packages too.

    Raises
    ------
    InputError
        An installed package names what is no kind.
    """
    for kind in installed(GROUP, LobeKind, "a LobeKind"):
        FORMULAS.setdefault(kind.name, kind.formula)
    return sorted({*FORMULAS, *TABLED})


@dataclass(frozen=True)
class LedCluster:
    """The LEDs of a blob, in its mechanical frame L: power 1 in all on the axis, each with the lobe cos(angle)^exponent."""

    position_L: Array
    """(n, 3) metres."""
    axis_L: Array
    """(n, 3)."""
    power: Array
    """(n,)."""
    exponent: float
    """The power of the cosine by which an LED's emission falls off."""

    def in_C(self, H_CL: Array) -> tuple[Array, Array, Array, float]:
        """Positions (n, 3) and axes (n, 3) in C, power (n,) and exponent, of a blob that stands at ``H_CL``."""
        return se3.apply(H_CL, self.position_L), se3.rotate(H_CL, self.axis_L), self.power, self.exponent


@dataclass(frozen=True)
class Lobe:
    """How a light's intensity falls with the angle from its axis, seen from its source; 1 on the axis.

    Parameters
    ----------
    kind : str
        ``isotropic``: constant. ``cosine``: cos(angle)^exponent, 0 behind the light. ``table``: cubic through (angle_rad, value), 0 beyond
        the last angle. ``leds``: the sum of `leds`, which is not round; the table then holds its mean over the roll. Others of one
        parameter are those of `lpcal.extend.register_lobe`.
    exponent : float
        The parameter of a kind that has one, 0 and more.
    angle_rad, value : ndarray (K,)
        A table: angles from the axis, increasing, and the intensity there, 1 on the axis.
    leds : LedCluster, optional
        The LEDs of a cluster, for the kind ``leds``.
    node_rad, factor : ndarray (n,), (n, n)
        A smooth factor over the directions in the light's frame, which a table may carry, at the nodes of `geometry.lobe_map`.
    seen_rad : float
        Largest angle from the axis at which spheres showed this light: beyond it the lobe is extrapolated. NaN where it is not known.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> lobe = lpcal.extend.Lobe("cosine", exponent=2.0)
    >>> lobe(np.radians([0.0, 60.0, 120.0])).round(3).tolist()
    [1.0, 0.25, 0.0]
    """

    kind: str = "isotropic"
    exponent: float = 0.0
    angle_rad: Array = field(default_factory=lambda: np.zeros(0))
    """(N,) angles from the axis at which `value` is tabulated."""
    value: Array = field(default_factory=lambda: np.zeros(0))
    """(N,) emission at `angle_rad`, 1 at its largest."""
    leds: LedCluster | None = None
    node_rad: Array = field(default_factory=lambda: np.zeros(0))
    """(N,) angles from an LED's axis at which `factor` is tabulated."""
    factor: Array = field(default_factory=lambda: np.zeros((0, 0)))
    """(N,) by what the LEDs' own emission is multiplied at `node_rad`."""
    seen_rad: float = float("nan")
    """Largest angle from the axis at which spheres showed this light: beyond it the lobe is extrapolated. NaN: not known."""

    def __call__(self, angle_rad: Array) -> Array:
        """Relative intensity (...) at angles (...) from the axis."""
        if self.kind in TABLED:
            return table_lobe(angle_rad, self.angle_rad, self.value)
        return formula_of(self.kind)(angle_rad, self.exponent)

"""Where the compiled kernels are, and how they are called.

A library is named after its sources' digest: one that was built from other sources is never loaded. This file imports nothing but the
standard library before a kernel is asked for, since the build runs it too.
"""

from __future__ import annotations

import ctypes
import functools
import hashlib
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parent
ENDING = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
WIDE = "-avx2"
"""What the name of the library for x86 processors with vectors of four doubles has besides: same sources, same operations, same bytes."""
LANES = 4
"""Doubles that kernels work on together (kernel.h); arrays that are to have a multiple of so many in a row are filled up with zeros."""
LINKS = 6
"""Links that multigrid's levels have room for, an unknown behind the pixels (multigrid.h)."""
SWITCH = "LPCAL_KERNELS"
"""Environment variable: `numpy` leaves the library alone and lets the twins do all the work."""

SIGNATURES = {
    "agreeing": "i i i f f i f f f b i b f f f d i i f f b f f f f",
    "behind": "i f i i f f f",
    "block_means": "i i i i i f f f",
    "blocks": "i i i i i i s s b f f f b",
    "cheapest_cut": "i m f f m b b",
    "cluster": "i i f f f f d f f",
    "cluster_single": "i i f f f f d f f",
    "cluster_slope": "i i f f f f d f",
    "connected": "i i n n b n",
    "coupled": "i i m f f f f f f d i d",
    "cubic": "i i i i s s d d f n f s",
    "curved": "i i s d i s n n",
    "distort": "i f f f f",
    "entries": "i f f i f i i i f f d d b f",
    "evidence": "i i i f f i f f f b i b f f f f f f i i f f f f",
    "few": "i i f f b f f d i i d d f b f f f",
    "free": "i i f f b f s f i f f",
    "gathered": "i i i f f i f f f b i b f f f i i f f",
    "hidden": "i f f i i i f f d d b",
    "integrated": "i n m m f f f f f i i f d d d d f f f s m i f",
    "joined": "i i i i i f f f f",
    "joined_singles": "i i i i i f f s s",
    "labelled": "i i b m m m",
    "lattice": "i i i f f f",
    "links": "i i n n f f d d f f f",
    "lobe": "i i f f f d f",
    "lobe_costs": "i i i f f f f f d d d f",
    "many": "i i f f b f f d d d d i d i d d f f b f f f",
    "many_labels": "i i i f f f i d d f f",
    "misses": "i i f f f f f f",
    "nearest": "i i b n n f",
    "own_distance": "i i f f f f i f b f f f f f",
    "planar": "i i f f b f s f f f b",
    "plane": "i i i s d d f f n f f d f",
    "received": "i i i f f f f f f f i i f f i d d d d i i",
    "moved": "i i s n d f f",
    "misfit": "i i f f b f i f i i f f",
    "multigrid": "i n m m f f f f f f s m d i f",
    "ring": "i i i s f f f i f f",
    "room_free": "i i f f b f s f d f i f f f f",
    "room_planar": "i i f f b f s f d f i f f b f",
    "saddles": "i i i f s s s f f",
    "slid": "i i i i i i f f f f",
    "steps": "i i n n f f f d d d f f",
    "two_labels": "i i s s s i n i d s s",
    "thrown_fits": "i i f f f f f d d f",
    "turns": "i i i f f n n f",
    "undistort": "i f f i d f",
    "unexplained": "i i f f f f f d i f f f",
    "weighted": "i i f f f d f f",
    "white": "i i i s s d d f f n f s",
}
"""Arguments of each kernel: d a number, i a whole one; contiguous arrays: f, s doubles and singles, n and m integers of 64 and 32 bits,
b booleans."""


def sources() -> list[Path]:
    """The C files and what they include, in the order in which they are compiled."""
    return sorted([*FOLDER.glob("*.c"), *FOLDER.glob("*.h")])


def built(kind: str = "") -> Path:
    """Where the library of these sources is, if it was built; of kind WIDE: for processors that have wider vectors."""
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in sources())).hexdigest()
    return FOLDER / f"kernels-{digest[:16]}{kind}{ENDING}"


def who_works() -> str:
    """Who does the kernels' work, in a word or two."""
    return "compiled" if built().exists() and os.environ.get(SWITCH) != "numpy" else "not compiled, numpy does their work"


def kernel(name: str) -> Callable[..., None] | None:
    """The compiled kernel of a name, which checks the types of what it is given; None where its twin does the work."""
    return None if os.environ.get(SWITCH) == "numpy" else _loaded().get(name)


@functools.cache
def _loaded() -> dict[str, Callable[..., None]]:
    """All kernels by name; none where there is no library."""
    try:
        library = ctypes.CDLL(os.fspath(built()))
        library.lpcal_wide.restype = ctypes.c_int64
        if library.lpcal_wide() and built(WIDE).exists():
            library = ctypes.CDLL(os.fspath(built(WIDE)))
    except OSError:
        return {}
    kinds = _kinds()
    found: dict[str, Callable[..., None]] = {}
    for name, signature in SIGNATURES.items():
        function = library[f"lpcal_{name}"]
        function.restype = None
        function.argtypes = [kinds[one] for one in signature.split()]
        found[name] = function
    return found


def _kinds() -> dict[str, Any]:
    import numpy as np

    dtypes = {"f": np.float64, "s": np.float32, "n": np.int64, "m": np.int32, "b": np.bool_}
    return {"d": ctypes.c_double, "i": ctypes.c_int64, **{one: _array_of(np.dtype(dtype)) for one, dtype in dtypes.items()}}


def _array_of(dtype: Any) -> Any:
    """A type of argument that takes contiguous arrays of a dtype and nothing else, in a twentieth of the time of numpy's `ndpointer`."""
    import numpy as np

    def from_param(_: object, given: object) -> object:
        if type(given) is np.ndarray and given.dtype == dtype and given.flags.c_contiguous:
            try:
                return ctypes.byref(ctypes.c_char.from_buffer(given))
            except (TypeError, ValueError):  # not to be written to, or empty
                return ctypes.c_void_p(given.ctypes.data)
        found = f"{given.dtype} of strides {given.strides}" if isinstance(given, np.ndarray) else type(given).__name__
        raise TypeError(f"{found} where a contiguous array of {dtype} is needed")

    return type(f"Array_{dtype}", (), {"from_param": classmethod(from_param)})

r"""Gradient-boosted trees: log odds as a sum over many small decision trees of a few clues.

Each tree asks at a node whether one clue is at most a threshold, and ends in a leaf with a number; the log odds are their sum. The trees
are fitted by scikit-learn in tools/fit_mask.py and kept in a file of arrays, so that lpcal needs numpy alone to use them. Sources:
Friedman 2001, Annals of Statistics 29 (gradient boosting); Ke et al. 2017, LightGBM (trees over binned clues).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.kernels.library import kernel
from lpcal.surface.sight import Indices

FITTED = Path(__file__).with_name("mask_trees.npz")
"""Where the mask's trees are."""


@dataclass(frozen=True)
class Trees:
    """T trees of N nodes together, each node after its parent."""

    clues: tuple[str, ...]
    start: float
    """Log odds before any tree."""
    root: Indices
    """(T,) the first node of each tree."""
    clue: Indices
    """(N,) the number of the clue that a node asks for; -1 at a leaf."""
    threshold: Array
    """(N,) up to which the way leads left."""
    left: Indices
    right: Indices
    """(N,) the next node."""
    leaf: Array
    """(N,) what a leaf adds to the log odds; 0 at other nodes."""

    def log_odds(self, clues: Mapping[str, Array]) -> Array:
        """Log odds (P,) by clues (P,) of these names, of which there may be more."""
        at = np.stack([np.asarray(clues[name], float) for name in self.clues], axis=1)
        return self._summed(at)

    def _summed(self, clues: Array) -> Array:
        """Log odds (P,) by clues (P, C)."""
        total = np.full(len(clues), self.start)
        if run := kernel("trees"):
            nodes = (np.ascontiguousarray(one, np.int64) for one in (self.root, self.clue, self.left, self.right))
            values = (np.ascontiguousarray(one, float) for one in (self.threshold, self.leaf))
            run(*clues.shape, len(self.root), np.ascontiguousarray(clues), *nodes, *values, total)
            return total
        every = np.arange(len(clues))
        for root in self.root:
            node = np.full(len(clues), root)
            while (open_ := self.clue[node] >= 0).any():
                goes = clues[every, np.maximum(self.clue[node], 0)] <= self.threshold[node]
                node = np.where(open_, np.where(goes, self.left[node], self.right[node]), node)
            total += self.leaf[node]
        return total

    def arrays(self, name: str) -> dict[str, np.ndarray]:
        """What a file keeps of them, under a name."""
        kept: dict[str, np.ndarray] = {"clues": np.array(self.clues), "start": np.array(self.start), "root": self.root.astype(np.int32)}
        kept |= {"clue": self.clue.astype(np.int8), "left": self.left.astype(np.int32), "right": self.right.astype(np.int32)}
        kept |= {"threshold": self.threshold, "leaf": self.leaf.astype(np.float32)}
        return {f"{name}.{key}": value for key, value in kept.items()}

    @staticmethod
    def of(arrays: Mapping[str, np.ndarray], name: str) -> Trees:
        """From what a file keeps."""
        root, clue, left, right = (arrays[f"{name}.{key}"].astype(np.int64) for key in ("root", "clue", "left", "right"))
        threshold, leaf = (arrays[f"{name}.{key}"].astype(float) for key in ("threshold", "leaf"))
        return Trees(tuple(map(str, arrays[f"{name}.clues"])), float(arrays[f"{name}.start"]), root, clue, threshold, left, right, leaf)


@cache
def fitted(name: str) -> Trees:
    """The mask's trees of a name, `regions` or `context`."""
    with np.load(FITTED) as arrays:
        return Trees.of(arrays, name)

r"""Correspondences between two views: points of one projected into the other.

Symbols: p a point of view i, q what view j shows in its direction, n the normal there, both in the common frame A::

    r = n . (p - q)

A point that lies in front of what j shows, or beside the object where j sees the background, contradicts j, which should have seen it;
so does one whose normal differs much from the one there. One behind the surface is hidden from j and says nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.fusion.deformation import Bending
from lpcal.fusion.views import PlacedView, look
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array, Index, Labels, Mask

TURN = np.cos(np.radians(40.0))
"""Least cosine between two views' normals of one place: measured ones differ by some degrees, those of two sides of an edge by more."""
LIKE = np.cos(np.radians(14.0))
"""Least cosine at which normals confirm each other. They know nothing of distances, so a view that is turned shows in them at once."""


@dataclass(frozen=True)
class Placed:
    """A view where it stands now."""

    view: PlacedView
    bending: Bending
    H_AC: Array
    field: Array
    """Parameters of its bending."""
    row: Index
    column: Index
    """Pixels of the points that are looked up in other views."""

    def points(self) -> tuple[Array, Array, Array]:
        """Its points and normals in A, (N, 3) each, and the vectors from the camera to the points."""
        pixel = np.column_stack([self.column, self.row]).astype(float)
        grown = np.exp(self.bending.at(self.field, pixel, self.view.component[self.row, self.column]))
        x_C = self.view.points_C(self.row, self.column) * grown[:, None]
        n_A = se3.rotate(self.H_AC, self.view.normals_C[self.row, self.column])
        return se3.apply(self.H_AC, x_C), n_A, se3.rotate(self.H_AC, x_C)


@dataclass(frozen=True)
class Meeting:
    """Points (N) of one view that meet another's surface."""

    index: Index
    """Which of the points looked up."""
    p_A: Array
    q_A: Array
    n_A: Array
    """Mean of both normals."""
    pixel: Array
    component: Labels
    """Pixel and piece of q."""
    residual_m: Array
    agree: int
    contradict: int

    def __getitem__(self, some: Mask) -> Meeting:
        picked = {name: getattr(self, name)[some] for name in ("index", "p_A", "q_A", "n_A", "pixel", "component")}
        return Meeting(**picked, residual_m=self.residual_m[some], agree=self.agree, contradict=self.contradict)


def meet(first: tuple[Array, Array, Array], second: Placed, gate_m: float) -> Meeting | None:
    """Points of one view, as `Placed.points`, looked up in another; None where they show no common side.

    `gate_m` is how far apart the two surfaces may be, along the normal, to be taken for one.
    """
    p_A, n_p, _ = first
    facing = np.flatnonzero(faces(p_A, n_p, second))
    if len(facing) < 10:
        return None
    seen = _Facing.of(p_A[facing], n_p[facing], second, gate_m)
    keep = np.flatnonzero(seen.close & (seen.cosine > TURN))
    return Meeting(
        facing[keep],
        p_A[facing[keep]],
        seen.q_A[keep],
        seen.n_A[keep],
        seen.pixel[keep],
        seen.component[keep],
        seen.residual_m[keep],
        int(seen.agree.sum()),
        int((seen.unlike | seen.through).sum()),
    )


def votes(first: tuple[Array, Array], second: Placed, gate_m: float) -> tuple[Mask, Mask]:
    """Which points (N, 3) with normals (N, 3) another view confirms, and which it contradicts.

    Unlike in `meet`, a point whose normal turns away is judged as well: one that stands before what the view sees hides it, whichever
    way it faces.
    """
    p_A, n_p = first
    seen = _Facing.of(p_A, n_p, second, gate_m)
    facing = faces(p_A, n_p, second)
    return seen.agree & facing, seen.through | (seen.unlike & facing)


def faces(p_A: Array, n_p: Array, second: Placed) -> Mask:
    """Which points (N, 3) with normals (N, 3) face a view."""
    to_camera = second.H_AC[:3, 3] - p_A
    return np.asarray(np.einsum("ij,ij->i", n_p, to_camera) > 0.3 * np.linalg.norm(to_camera, axis=1))


@dataclass(frozen=True)
class _Facing:
    """What a view shows in the directions of points (N)."""

    q_A: Array
    n_A: Array
    pixel: Array
    component: Labels
    residual_m: Array
    cosine: Array
    close: Mask
    through: Mask
    """Points that the view sees through: they stand before what it shows, or before the background."""

    @property
    def agree(self) -> Mask:
        return self.close & (self.cosine > LIKE)

    @property
    def unlike(self) -> Mask:
        return self.close & (self.cosine <= LIKE)

    @classmethod
    def of(cls, p_A: Array, n_p: Array, second: Placed, gate_m: float) -> _Facing:
        x_C = se3.apply(se3.inv(second.H_AC), p_A)
        seen = look(second.view, x_C)
        delta = np.zeros(len(p_A))
        at = np.flatnonzero(seen.ok)
        delta[at] = second.bending.at(second.field, seen.pixel[at], seen.component[at])
        z = seen.depth * np.exp(delta)
        q_C = x_C * (z / x_C[:, 2])[:, None]
        n_q = se3.rotate(second.H_AC, seen.normal_C)
        n_A = n_p + n_q
        n_A /= np.maximum(np.linalg.norm(n_A, axis=1, keepdims=True), 1e-12)
        q_A = se3.apply(second.H_AC, q_C)
        r = np.einsum("ij,ij->i", n_A, p_A - q_A)
        close = seen.ok & (np.abs(r) < gate_m)
        before = seen.ok & ~close & (x_C[:, 2] < z - gate_m)
        beside = seen.in_image & background(second.view, seen.pixel)
        cosine = np.einsum("ij,ij->i", n_p, n_q)
        return cls(q_A, n_A, seen.pixel, seen.component, r, cosine, close, before | beside)


def background(view: PlacedView, pixel: Array) -> Mask:
    """Pixels (N, 2) that are well outside the object."""
    column, row = (np.clip(np.rint(pixel[:, k]).astype(int), 0, n - 1) for k, n in enumerate(view.depth.shape[::-1]))
    return view.far_outside[row, column]

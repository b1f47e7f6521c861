"""One model of several placed surfaces: its vertices with what each rests on, and how each view fits."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lpcal.geometry.arrays import Array, Index
from lpcal.records.shown import Shown


@dataclass(frozen=True)
class PieceInModel:
    """A connected piece of a surface, and at which distance the other views confirm it."""

    label: int
    """As in the surface's `component`."""
    pixels: int
    """Count of its pixels."""
    why: str | None
    """Why it was left out; None: it was used."""
    supporters: int
    """Other views that confirm it where it was placed."""
    distance_change_m: float | None = None
    """By how much its distance was changed; None: it was left out."""


@dataclass(frozen=True)
class ViewInModel:
    """How one surface fits the others."""

    name: str
    """The capture's name."""
    used: bool
    """Whether the solve rests on it."""
    why: str | None
    """Why it was left out; None: it was used."""
    agreement: float | None
    """Share of its points, of those that other views should have seen, that these confirm at the tracked poses; None: too few in common."""
    moved_m: float | None = None
    """How far its camera was moved against its placement."""
    turned_rad: float | None = None
    """By how much it was turned."""
    distance_change_m: float | None = None
    """By how much its distances were changed, the median."""
    residual_m: float | None = None
    """Robust rms of its points from the other views' surfaces, along the normal."""
    H_AC: Array | None = None
    """(4, 4) the camera in the model's frame, as aligned."""
    solved_again: bool = False
    """Whether its capture was solved again with the light that the object's parts throw on each other."""
    pieces: tuple[PieceInModel, ...] = ()
    """Its connected pieces, and parts of them that breaks and seams cut off, which count on; none of a surface that was left out."""
    distance_sigmas: float | None = None
    """By how much the distance of its largest piece was changed otherwise than the others', in standard deviations of its own."""


@dataclass(frozen=True)
class ModelFigures:
    """Figures of a model as a whole; metres."""

    before_m: float
    """Robust rms of what overlapping views differ by along the normal, with the placements alone."""
    after_m: float
    """The same once aligned."""
    pairs: int
    """Pairs of views that overlap."""
    area_m2: float
    """Area of the model's surface, square metres."""
    step_m: float
    """Median length of an edge."""
    sigma_m: float
    """Median standard deviation of a vertex along its normal."""
    seen_by_two: float
    """Share of the area that two or more views see."""
    disagreeing: float
    """Share of that area where views differ by more than three of its sigmas."""
    open_edges_m: float
    """Length of the edges of what was not seen."""
    distance_scale: float
    """By how much all distances were changed together, relative."""
    distance_scale_std: float
    """Relative standard deviation of the scale that all distances share."""
    shared_sigma_m: float = 0.0
    """What of `sigma_m` all vertices share, rms: one motion and one growth of the whole, whose seven numbers one session draws once."""
    reflectance: float | None = None
    """Reflectance of the object's median place, by the light between its parts, with which the views were solved again; None: they were
    not."""


@dataclass(frozen=True)
class NextStop:
    """Where the panel should stand next, and what that would show of what is missing; areas in square metres."""

    H_AC: Array
    """(4, 4) the camera in the model's frame, metres."""
    H_AP: Array | None
    """(4, 4) the tracked panel there; None where no tracked body carries the camera."""
    beside: str
    """The stop that is nearest to it."""
    turn_rad: float
    """By how much the camera is turned against that stop's."""
    distance_m: float
    """From the camera to the object's middle."""
    unseen_m2: float
    """Area that no view has seen, about: of caps over what is open."""
    once_m2: float
    """Area that one view alone has seen."""
    reset: bool
    """Whether the wings must be set again for it: it stands much nearer or farther than the other stops."""


@dataclass(frozen=True)
class Missing:
    """What no view has seen well; areas in square metres."""

    area_m2: float
    """The model's own."""
    open_m2: float
    """That of the caps over its open edges: about what no view has seen."""
    once_m2: float
    """What one view alone sees."""
    loose_m2: float
    """What was left out: one view alone saw it, and how far away it is was not known well enough."""
    stops: tuple[NextStop, ...] = ()
    """Where the panel should stand next, the best first, each with what it adds to those before it; empty: nothing is worth a stop."""


@dataclass(frozen=True)
class LightEvidence:
    """The change of a calibrated light that the views favour."""

    name: str
    """The light's name."""
    intensity_change: float
    """Relative."""
    intensity_std: float
    """Relative standard deviation of the intensity."""
    source_change_C: Array
    """(3,) metres."""
    source_std_m: Array
    """(3,)."""
    sigmas: float
    """Distance from the calibrated value in standard deviations, rms over the directions that the views determine."""


@dataclass(frozen=True)
class RigEvidence:
    """What the views show of their common calibration."""

    H_PC_change: Array
    """(6,) the change of H_PC that the views favour, a twist (rad, metres): left perturbation."""
    H_PC_covariance: Array
    """(6, 6) of H_PC with the views included."""
    H_PC_sigmas: float
    """Distance from the calibrated value in standard deviations, rms over the directions that the views determine."""
    distance_scale: float
    """Relative change of all distances."""
    distance_scale_std: float
    """Relative standard deviation of the scale that all distances share."""
    lights: tuple[LightEvidence, ...]
    """By light, what its own solve rests on."""
    normals_before_rad: float
    """What two views' normals of one place differ by, an axis and a view, robust rms."""
    normals_after_rad: float
    """The same with the lights changed as the views favour."""
    moved: tuple[str, ...] = ()
    """What is said to have moved since the calibration, in words; empty: nothing."""


@dataclass(frozen=True, repr=False)
class ObjectModel(Shown):
    """One surface of an object in the room, or in the body that it rides on.

    Parameters
    ----------
    name : str
        What it is called.
    frame : str
        The frame A of its vertices, in words: the room, or the body.
    vertices_A : ndarray (V, 3)
        Metres.
    normals_A : ndarray (V, 3)
        Unit normals, outward, as the images say: the weighted mean of the views' photometric normals.
    faces : ndarray (F, 3) of int
        Vertices of each triangle, counter-clockwise seen from outside.
    albedo : ndarray (V, 3)
        Linear, relative, without the views' different brightness.
    sigma_m : ndarray (V,)
        Standard deviation of each vertex along its normal, everything counted.
    normal_sigma_rad : ndarray (V,)
        Standard deviation of each normal, an axis.
    disagreement_m : ndarray (V,)
        Rms of where the views that see a vertex put it; 0 where one alone does.
    seen_by : ndarray (V,) of int
        How many views see it.
    views : tuple of ViewInModel
        What became of each surface.
    figures : ModelFigures
        Figures of the whole.
    warnings : tuple of str
        Remarks: the surfaces that were left out, and why.
    missing : Missing, optional
        What no view has seen well, and where the panel should stand next.
    rig : RigEvidence, optional
        What the views show of their calibration; None where none was given.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> from lpcal.records.model import ModelFigures
    >>> ones = np.ones(3)
    >>> figures = ModelFigures(0, 0, 1, 0.5, 1, 0, 1, 0, 3, 0, 0)
    >>> corners, faces = np.eye(3), np.array([[0, 1, 2]])
    >>> found = lpcal.ObjectModel("tile", "the room", corners, corners, faces, corners, ones, ones, ones, faces[0], (), figures)
    >>> found.colours.shape, found.name
    ((3, 3), 'tile')
    """

    name: str
    frame: str
    vertices_A: Array
    normals_A: Array
    faces: Index
    albedo: Array
    sigma_m: Array
    normal_sigma_rad: Array
    disagreement_m: Array
    seen_by: Index
    views: tuple[ViewInModel, ...]
    figures: ModelFigures
    warnings: tuple[str, ...] = field(default=())
    missing: Missing | None = None
    rig: RigEvidence | None = None

    @property
    def colours(self) -> Array:
        """Albedo (V, 3) as a share of its 99th percentile at nine tenths, linear; grey where none is known."""
        known = self.albedo[np.isfinite(self.albedo).all(axis=1)]
        top = float(np.percentile(known, 99)) if len(known) else 1.0
        return np.clip(np.nan_to_num(self.albedo / max(top, 1e-12) * 0.9, nan=0.45), 0, 1)

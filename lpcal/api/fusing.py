"""Placed surfaces of one object to one model."""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence

from lpcal.api.staged import staged
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.fusion.model import FEWEST, model_of
from lpcal.fusion.views import PlacedView, view_of
from lpcal.records import screens
from lpcal.records.model import ObjectModel
from lpcal.records.outcome import Progress, silent
from lpcal.records.surface import Surface

LEAST_PIXELS = 200
"""Pixels of a surface that must bear witness: fewer tell nothing of how it fits."""


@staged("fusion")
def fuse(surfaces: Sequence[Surface], *, name: str = "model", step_m: float | None = None, progress: Progress = silent) -> ObjectModel:
    """Fuse surfaces of one object into one model, in the frame that they are placed in.

    The tracked poses are priors: each view's pose, distance and slow bending are refined within their standard deviations so that all
    pairs of views that overlap agree. A view that the others contradict is named and left out. What no view saw stays open.

    Parameters
    ----------
    surfaces : sequence of Surface
        Two or more, each with its placement, metric.
    name : str
        What the model is called.
    step_m : float, optional
        Length of the model's edges, metres, about; by default 1.4 pixels on the object.
    progress : callable, optional
        Called with what is done, how much of it, and of how many.

    Returns
    -------
    ObjectModel
        Vertices in metres in the room, or in the body that the object rides on, with their standard deviations, the photometric normals,
        albedo, where views disagree, and what became of each view.

    Raises
    ------
    InputError
        A surface is not placed or not metric, or scikit-image is not installed.
    DisagreementError
        Surfaces are placed in different frames.
    DegenerateError
        Fewer than two surfaces are left that agree and overlap.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> from dataclasses import replace
    >>> flat = lpcal.integrate(np.zeros((12, 12, 3)) + [0, 0, -1.0], name="flat")
    >>> try:
    ...     lpcal.fuse([flat, flat])
    ... except lpcal.errors.InputError as error:
    ...     print(error.found)
    is not placed
    """
    if len(surfaces) < FEWEST:
        raise DegenerateError(
            f"{len(surfaces)} surface", where="fuse", needed="two or more, placed", todo="take more captures round the object"
        )
    views = [_view(surface) for surface in surfaces]
    frames = {view.placement.body for view in views}
    if len(frames) > 1:
        raise DisagreementError(
            f"surfaces placed in {' and in '.join(sorted({view.placement.frame for view in views}))}",
            where=name,
            needed="one frame for all",
            todo="state `body:` in the capture.yaml of all captures or of none",
        )
    if importlib.util.find_spec("skimage") is None:
        raise InputError("scikit-image is not installed", where="fuse", needed="lpcal[fuse]", todo="uv add 'lpcal[fuse]'")
    return model_of(name, views, step_m, progress)


def _view(surface: Surface) -> PlacedView:
    """A surface as a view.

    Raises
    ------
    InputError
        It is not placed, or not metric.
    DegenerateError
        It has too few pixels.
    """
    if surface.placement is None:
        todo = "state time or pose in capture.yaml and reconstruct it anew, or give it a placement of lpcal.place"
        raise InputError("is not placed", where=surface.name, needed="where the camera was when it was captured", todo=todo)
    if not surface.metric or not surface.components:
        raise InputError("has no metric depth", where=surface.name, needed="a surface of lpcal reconstruct with a camera and near lights")
    view = view_of(surface, surface.placement)
    if view.witness.sum() < LEAST_PIXELS:
        raise DegenerateError(f"{int(view.witness.sum())} pixels", where=surface.name, needed=f"{LEAST_PIXELS} that are measured")
    return view


@screens.screen_of.register
def _model_screen(found: ObjectModel) -> screens.RecordScreen:
    figures = found.figures
    used = sum(view.used for view in found.views)
    rows = [
        (
            "surface",
            f"{len(found.vertices_A)} vertices, {1e4 * figures.area_m2:.1f} cm2 in {found.frame}, edges {1e3 * figures.step_m:.2f} mm",
        ),
        ("views", f"{used} of {len(found.views)} used, {figures.pairs} pairs overlap"),
        ("differences", f"{1e3 * figures.before_m:.3f} mm by the placements alone, {1e3 * figures.after_m:.3f} mm aligned"),
        ("sigma", f"{1e3 * figures.sigma_m:.3f} mm of a vertex, the median"),
        ("seen twice", f"{100 * figures.seen_by_two:.1f} % of the area; views disagree on {100 * figures.disagreeing:.1f} % of it"),
    ]
    return screens.RecordScreen(f"ObjectModel {found.name}", rows, found.warnings)

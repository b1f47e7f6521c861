"""Placed surfaces of one object to one model."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import overload

import numpy as np

from lpcal.api.engines import Engine, Lost, each
from lpcal.api.sensor import BY_CAPTURE, Statements, stated_in
from lpcal.api.staged import staged
from lpcal.api.surfaces import linear
from lpcal.errors import DegenerateError, DisagreementError, InputError, UsageError
from lpcal.fusion.model import model_of
from lpcal.fusion.registration import FEWEST
from lpcal.fusion.tiles import SpaceTile, TileFaces
from lpcal.fusion.views import PlacedView, view_of
from lpcal.fusion.volume import TileWork, in_turn
from lpcal.geometry import se3
from lpcal.records import screens
from lpcal.records.calibration import Calibration, Light
from lpcal.records.model import LightEvidence, ObjectModel
from lpcal.records.observations import Radiance, RawCapture
from lpcal.records.outcome import Progress, silent
from lpcal.records.sensor import SensorInUse
from lpcal.records.surface import Surface

LEAST_STEP_PX = 0.25
"""Finest edges of a model, in footprints of a pixel: finer ones show nothing more, and half the length takes four times as long."""
FEWEST_STEPS = 8
"""Fewest edges along the longest side of what a view shows: of fewer no surface is left."""
LEAST_PIXELS = 200
"""Least number of usable pixels of a surface: fewer do not show how it fits."""


@staged("fusion")
def fuse(
    surfaces: Iterable[Surface],
    *,
    name: str = "model",
    step_m: float | None = None,
    calibration: Calibration | None = None,
    captures: Mapping[str, RawCapture] | None = None,
    sensor: Statements = (),
    engine: Engine | None = None,
    progress: Progress = silent,
) -> ObjectModel:
    """Fuse surfaces of one object into one model, in the frame that they are placed in.

    The tracked poses are priors: each view's pose, distance and slow bending are refined within their standard deviations so that all
    pairs of views that overlap agree. A view that the others contradict is named and left out. What no view saw stays open.

    Parameters
    ----------
    surfaces : iterable of Surface
        Two or more, each with its placement, metric. What is needed of each is kept, so that many may be read one after the other.
    name : str
        What the model is called.
    step_m : float, optional
        Length of the model's edges, metres, about; by default 1.4 pixels on the object.
    calibration : Calibration, optional
        The one that the surfaces share: the model then states what the views show of its lights and H_PC, and whether the rig has moved.
    captures : mapping of str to RawCapture, optional
        The captures that the surfaces were made of, by the surfaces' names; read where they are asked for. With them and the calibration
        every view is solved again at the place where all put it, with the light that the object's parts throw on each other, which one
        view alone sees half of. Those without an ambient image, or made linear otherwise than their surface was, are left as they are.
    sensor : sequence of (str, StatedSensor)
        What is known of the sensor besides what captures and calibration say, by who says it.
    engine : Engine, optional
        Where the tiles of the model's space are worked on, of `lpcal.api.engines.engine_of`; None: one after the other, here. The model is
        the same.
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
    UsageError
        `step_m` is under a quarter of a pixel on the object, or over an eighth of it.
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
    views, sensors = [], {}
    for surface in surfaces:
        views.append(_view(surface))
        sensors[surface.name] = surface.sensor
    if len(views) < FEWEST:
        raise DegenerateError(
            f"{len(views)} surface", where="fuse", needed="two or more, placed", todo="take more captures round the object"
        )
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
    _refuse_step(step_m, views)
    over = in_turn if engine is None else partial(_over, engine)
    images = None if calibration is None or captures is None else partial(_images, captures, calibration, sensors, sensor)
    return model_of(name, views, step_m, progress, None if calibration is None else calibration.lights, over, images)


def _refuse_step(step_m: float | None, views: Sequence[PlacedView]) -> None:
    if step_m is None:
        return
    footprint_m = float(np.median([view.footprint_m for view in views]))
    least_m = LEAST_STEP_PX * footprint_m
    most_m = footprint_m * max(max(view.depth.shape) for view in views) / FEWEST_STEPS
    if not least_m <= step_m <= most_m:
        needed = f"{1e3 * least_m:.2g} mm, a quarter of a pixel on the object, to {1e3 * most_m:.2g} mm, an eighth of it"
        raise UsageError(f"edges of {1e3 * step_m:g} mm", where="--step", needed=needed, todo="leave it out: 1.4 pixels on the object")


def _images(
    captures: Mapping[str, RawCapture],
    calibration: Calibration,
    sensors: Mapping[str, SensorInUse | None],
    sensor: Statements,
    name: str,
) -> tuple[Radiance, Calibration] | None:
    """The linear images of a view and the calibration for them; None where it cannot be solved again as it was at first."""
    raw = captures.get(name)
    if raw is None or raw.full is not None or raw.ambient is None or calibration.camera is None:
        return None
    calibration = calibration.of_images(raw.size)
    by_name = {light.name: light for light in calibration.lights}
    if any(light not in by_name or by_name[light].source_C is None for light in raw.lights):
        return None
    radiance, used = linear(raw, calibration, [(BY_CAPTURE, raw.sensor), ("the calibration", stated_in(calibration)), *sensor])
    before = sensors.get(name)
    return (radiance, calibration) if before is None or _alike(before, used) else None


def _alike(first: SensorInUse, second: SensorInUse) -> bool:
    """Whether two captures were made linear alike."""
    one, other = first.sensor, second.sensor
    levels = [(sensor.gamma, sensor.black_level, sensor.white_level) for sensor in (one, other)]
    return levels[0] == levels[1] and (one.flat_field is None) == (other.flat_field is None)


class _Tasks(Sequence[tuple[TileWork, SpaceTile]]):
    """Tiles to work on, each with what a worker needs of it, made when it is handed over."""

    def __init__(self, work: TileWork, tiles: Sequence[SpaceTile]) -> None:
        self.work, self.tiles = work, tiles

    def __len__(self) -> int:
        return len(self.tiles)

    @overload
    def __getitem__(self, at: int) -> tuple[TileWork, SpaceTile]: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[tuple[TileWork, SpaceTile]]: ...
    def __getitem__(self, at: int | slice) -> tuple[TileWork, SpaceTile] | Sequence[tuple[TileWork, SpaceTile]]:
        if isinstance(at, slice):
            return _Tasks(self.work, self.tiles[at])
        return self.work.narrowed(self.tiles[at]), self.tiles[at]


def _worked(task: tuple[TileWork, SpaceTile]) -> TileFaces:
    """One tile, on a worker."""
    work, tile = task
    return work(tile)


def _over(engine: Engine, work: TileWork, tiles: Sequence[SpaceTile]) -> list[TileFaces]:
    """The tiles' triangles by the workers of an engine; of one whose workers were lost, here."""
    found: list[TileFaces | None] = [None] * len(tiles)
    for number, faces in each(_worked, _Tasks(work, tiles), engine):
        found[number] = None if isinstance(faces, Lost) else faces
    return [work(tile) if faces is None else faces for tile, faces in zip(tiles, found, strict=True)]


def refine_rig(calibration: Calibration, model: ObjectModel) -> Calibration:
    """The calibration with its lights and H_PC corrected by the views of a model.

    Intensities keep their mean of 1: a factor that all lights share shows in the surfaces' albedo alone.

    Parameters
    ----------
    calibration : Calibration
        The one that `fuse` was given.
    model : ObjectModel
        What it made.

    Returns
    -------
    Calibration
        Sources, intensities and H_PC changed, with standard deviations as found.

    Raises
    ------
    InputError
        The model says nothing of its rig: `fuse` was given no calibration.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> from lpcal.records.model import LightEvidence, ModelFigures, RigEvidence
    >>> lamp = lpcal.Light("L0", np.array([0, 0, -1.0]), np.ones(1), source_C=np.zeros(3), axis_C=np.array([0, 0, 1.0]))
    >>> seen = LightEvidence("L0", 0.0, 0.002, np.array([0.001, 0, 0]), np.full(3, 2e-4), 1.2)
    >>> rig = RigEvidence(np.zeros(6), np.zeros((6, 6)), 0.0, 0.0, 0.003, (seen,), 0.02, 0.015)
    >>> ones, corners, faces = np.ones(3), np.eye(3), np.array([[0, 1, 2]])
    >>> figures = ModelFigures(0, 0, 1, 0.5, 1, 0, 1, 0, 3, 0, 0)
    >>> made = (corners, corners, faces, corners, ones, ones, ones, faces[0], (), figures)
    >>> model = lpcal.ObjectModel("tile", "the room", *made, rig=rig)
    >>> refined = lpcal.refine_rig(lpcal.Calibration("rig", (lamp,), H_PC=np.eye(4)), model)
    >>> refined.lights[0].source_C.tolist()
    [0.001, 0.0, 0.0]
    """
    rig = model.rig
    if rig is None:
        raise InputError("says nothing of its rig", where=model.name, needed="a model of fuse with calibration=", todo="fuse again with it")
    changes = {one.name: one for one in rig.lights}
    lights = [_changed(light, changes[light.name]) if light.name in changes else light for light in calibration.lights]
    mean = float(np.mean([light.intensity for light in lights])) if lights else 1.0
    lights = [replace(light, intensity=light.intensity / mean) for light in lights]
    H_PC = calibration.H_PC if calibration.H_PC is None else se3.exp(rig.H_PC_change) @ calibration.H_PC
    tracking = None if calibration.tracking is None else replace(calibration.tracking, H_PC_covariance=rig.H_PC_covariance)
    return replace(calibration, lights=tuple(lights), H_PC=H_PC, tracking=tracking)


def _changed(light: Light, change: LightEvidence) -> Light:
    """A light as the views would have it; its axis and mechanical frame go with its source."""
    assert light.source_C is not None
    H_CL = light.H_CL
    if H_CL is not None:
        H_CL = H_CL.copy()
        H_CL[:3, 3] += change.source_change_C
    return replace(
        light,
        intensity=light.intensity * (1 + change.intensity_change),
        source_C=light.source_C + change.source_change_C,
        H_CL=H_CL,
        intensity_std=change.intensity_std * float(np.mean(light.intensity)),
        position_std_m=float(np.sqrt(np.mean(change.source_std_m**2))),
    )


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
        todo = "state time or pose in capture.yaml and reconstruct it again, or give it a placement of lpcal.place"
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

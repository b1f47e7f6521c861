"""``lpcal fuse``: surfaces read, fused, written as a model."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median

from lpcal.api.engines import Engine
from lpcal.api.fusing import fuse, refine_rig
from lpcal.errors import DisagreementError, InputError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.model_files import MODEL, summary_of, write_model
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.outputs import refuse_place
from lpcal.formats.surface_files import MAPS_FILE, is_placed, read_surface
from lpcal.pipeline.capture_files import SurfaceCaptures
from lpcal.pipeline.sensor import stated_in_panel
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Calibration
from lpcal.records.model import ObjectModel, ViewInModel
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.surface import Surface
from lpcal.report.model_page import missing_words, model_html, rig_words

FEWEST_OTHERS = 3
"""Views of which one is said to be changed most: of two that differ nobody knows which is wrong."""
SURFACES = "surfaces"
"""The folder of a rig that holds its surfaces."""


def fuse_folders(
    captures: Sequence[Path],
    target: Path,
    rig: Workspace | None,
    step_m: float | None,
    progress: Progress,
    *,
    page: bool = True,
    refine: bool = False,
    again: bool = True,
    engine: Engine | None = None,
) -> Outcome:
    """Fuse surfaces, each its own folder or that of its capture, and write the model.

    `page`: with its page; `refine`: with the rig's calibration as the views would have it; `again`: with the views solved again by their
    captures; `engine`: where tiles of space are worked on.

    Raises
    ------
    InputError, DisagreementError, DegenerateError
        As `surface_folders` and `fuse`.
    """
    folders = surface_folders(captures, rig)
    refuse_place(target, MODEL, folders)
    begun = time.process_time()
    unplaced = [] if captures else [folder for folder in folders if not is_placed(folder)]
    left = [folder.name for folder in unplaced if len(unplaced) < len(folders)]  # where none is placed, fuse says what is lacking
    folders = [folder for folder in folders if folder.name not in left]
    calibration = _calibration(rig, needed=refine)
    surfaces = _read(folders, progress)
    lights = [] if calibration is None else [light.name for light in calibration.lights]
    model = fuse(
        surfaces,
        name=target.resolve().name,
        step_m=step_m,
        calibration=calibration,
        captures=SurfaceCaptures(folders, lights) if again and lights else None,
        sensor=() if rig is None else (("panel.yaml", stated_in_panel(rig)),),
        engine=engine,
        progress=progress,
    )
    seconds = time.process_time() - begun
    document = {"times_s": {"fuse": seconds}, "inputs": [str(folder) for folder in folders]}
    write_model(
        target, model, document, model_html(model) if page else None, refine_rig(calibration, model) if calibration and refine else None
    )
    said = _said(target, model, again=again) + [f"without {', '.join(left)}: not placed"] * bool(left)
    said.append(f"written to {target}: {', '.join(sorted(path.name for path in target.iterdir()))}")
    return Outcome(said, {**summary_of(model), **document, "folder": str(target)}, list(model.warnings))


def _read(folders: Sequence[Path], progress: Progress) -> Iterator[Surface]:
    """The surfaces, one after the other."""
    for done, folder in enumerate(folders):
        yield read_surface(folder)
        progress("surfaces read", done + 1, len(folders))


def _calibration(rig: Workspace | None, *, needed: bool) -> Calibration | None:
    """The calibration of the rig; None where there is none.

    Raises
    ------
    InputError
        There is none and it is needed, or it cannot be read.
    """
    path = None if rig is None else rig.calib("calibration.yaml")
    if path is not None and path.is_file():
        return read_calibration(path)
    if needed:
        todo = "run lpcal run first, or leave --refine out"
        raise InputError("no calibration to refine", where=str(path or "--refine"), needed="the rig's calib/calibration.yaml", todo=todo)
    return None


def surface_folders(captures: Sequence[Path], rig: Workspace | None) -> list[Path]:
    """The folders of surfaces that are named, or of the captures that are named; without a name all surfaces of the rig.

    A capture that is an object of the rig has its surface under its key, any other under its folder's name.

    Raises
    ------
    InputError
        One has no surface.
    DisagreementError
        One is named twice.
    """
    held = rig.folder / SURFACES if rig is not None else Path(SURFACES)
    if not captures:
        found = sorted(path.parent for path in held.glob(f"*/{MAPS_FILE}"))
        if not found:
            raise InputError("no surface", where=str(held), needed="what lpcal reconstruct writes", todo="run lpcal reconstruct first")
        return found
    found = []
    keys = {(rig.folder / entry).resolve(): key for key, entry in rig.rig_file.rig.objects.items()} if rig is not None else {}
    for capture in captures:
        name = keys.get(capture.resolve(), capture.resolve().name)
        place = next((path for path in (capture, held / name) if (path / MAPS_FILE).is_file()), None)
        if place is None:
            holds = capture.is_dir() and any(capture.glob("*/capture.yaml"))
            todo = f"name what is in it: {capture}/*" if holds else "run lpcal reconstruct on it first"
            todo = todo if capture.exists() else did_you_mean(capture, "correct the path")
            raise InputError(
                "no surface there", where=str(capture), needed="a surface's folder, or a capture that was reconstructed", todo=todo
            )
        found.append(place)
    twice = next((path for k, path in enumerate(found) if path.resolve() in {other.resolve() for other in found[:k]}), None)
    if twice is not None:
        raise DisagreementError("named twice", where=str(twice), needed="each surface once", todo="leave one of them out")
    return found


def _said(target: Path, model: ObjectModel, *, again: bool) -> list[str]:
    figures = model.figures
    used = [view for view in model.views if view.used]
    lines = [
        f"{target}: {len(model.vertices_A)} vertices, {1e4 * figures.area_m2:.1f} cm2, in {model.frame}; "
        f"{len(used)} of {len(model.views)} surfaces, {figures.pairs} pairs overlap",
        f"overlapping surfaces differ by {1e3 * figures.before_m:.2f} mm as placed, by {1e3 * figures.after_m:.3f} mm aligned; "
        f"a vertex is known to {1e3 * figures.sigma_m:.2f} mm",
        f"{100 * figures.seen_by_two:.0f} % of the area is seen by two or more; they disagree on {100 * figures.disagreeing:.1f} % of it; "
        f"{1e3 * figures.open_edges_m:.0f} mm of open edges",
    ]
    if figures.reflectance is not None:
        lines.append(f"views solved again with the light between the object's parts: its reflectance is about {figures.reflectance:.2f}")
    kept = [view.name for view in used if again and not view.solved_again]
    if kept:
        which = "no view is" if len(kept) == len(used) else f"{', '.join(kept)}: not"
        lines.append(
            f"{which} solved again with the light between the object's parts: it needs the rig's calibration, and the capture as it was "
            "reconstructed, with an ambient image"
        )
    lines += _most_changed(used)
    lines += [_line(view) for view in model.views]
    lines += [] if model.missing is None else missing_words(model.missing, model.frame)
    return lines + ([] if model.rig is None else rig_words(model.rig))


def _most_changed(used: Sequence[ViewInModel]) -> list[str]:
    """The view whose distance was changed most against the others, however well it fits them since."""
    changes = {view.name: view.distance_change_m for view in used if view.distance_change_m is not None}
    if len(changes) < FEWEST_OTHERS:
        return []
    usual = median(changes.values())
    most = max(used, key=lambda view: abs(changes.get(view.name, usual) - usual))
    apart = "" if most.distance_sigmas is None else f", {most.distance_sigmas:.1f} of its sigmas from the others'"
    by_mm, usual_mm = 1e3 * changes[most.name], 1e3 * usual
    return [f"distances were changed by {usual_mm:+z.1f} mm, the median; most that of {most.name}, by {by_mm:+z.1f} mm{apart}"]


def _line(view: ViewInModel) -> str:
    if not view.used:
        return f"  {view.name}: left out: {view.why}"
    confirmed = "placed by its pose alone" if view.agreement is None else f"confirmed by {100 * view.agreement:.0f} %"
    moved = f"moved {1e3 * (view.moved_m or 0):.2f} mm, distance {1e3 * (view.distance_change_m or 0):+.2f} mm"
    moved += "" if view.distance_sigmas is None else f", {view.distance_sigmas:.1f} sigmas from the others'"
    return f"  {view.name}: {confirmed}; {moved}; within {1e3 * (view.residual_m or 0):.3f} mm of the others"

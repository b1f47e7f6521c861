"""Captures to surfaces: which captures, which calibration, where to, and what summary.json says.

A normal map from elsewhere to a depth and a mesh.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

from lpcal import __version__
from lpcal.api.sensor import BY_CAPTURE, BY_COMMAND, stated_in
from lpcal.api.surface_notes import distance_said
from lpcal.api.surfaces import DISTANCE_M, Green, integrate, reconstruct
from lpcal.errors import InputError, LpcalError, UsageError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.capture import check_lights, read_capture
from lpcal.formats.documents import plain, sha256
from lpcal.formats.mask_files import read_mask
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.normal_map import read_normals
from lpcal.formats.outputs import refuse_place
from lpcal.formats.placement_document import stated_place_of
from lpcal.formats.record_documents import document_of
from lpcal.formats.surface_files import OUTPUTS, SUMMARY, SURFACE, summary_of, write_surface
from lpcal.integration.pieces import flatness
from lpcal.pipeline.capture_files import files_of, place_of
from lpcal.pipeline.placing import NO_RIG, Recorded, made_from, placed, placed_said, recorded_of
from lpcal.pipeline.sensor import stated_in_panel
from lpcal.pipeline.workspace import Stage, Workspace, within
from lpcal.records.calibration import Calibration, Camera
from lpcal.records.installed import version_of
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.sensor import StatedSensor
from lpcal.records.surface import Surface
from lpcal.report.relight_page import render
from lpcal.segmentation.mask import NO_HINTS, Hints, Keep
from lpcal.view.parallel import cores, run_all

CALIBRATION = "calibration.yaml"
MASK_WORDS = {"auto", "none"}
"""What --mask takes besides a file."""
type Hashes = dict[Path, str]
"""sha256 of files."""


@dataclass(frozen=True)
class Task:
    """One capture to reconstruct."""

    capture: Path
    target: Path
    name: str


@dataclass(frozen=True)
class Wishes:
    """What the user asks for, for every capture."""

    near: bool = True
    method: str | None = None
    """A method to compare with; None: lpcal's own."""
    integrator: str = "lpcal"
    distance_m: float | None = None
    mask: str = "auto"
    """auto | none | a file."""
    hints: Hints = NO_HINTS
    """Where the object is, by the user."""
    keep: Keep = "object"
    use: tuple[str, ...] | None = None
    outputs: tuple[str, ...] = tuple(OUTPUTS)
    """Which files besides summary.json, by formats.surface_files.OUTPUTS."""
    jobs: int | None = None
    """Threads that share a capture's bands of pixels; None: one a core."""
    sensor: StatedSensor = field(default_factory=StatedSensor)
    """What the command's words say of the sensor."""
    panel: StatedSensor = field(default_factory=StatedSensor)
    """What the rig's panel.yaml says of it."""
    recorded: Recorded = NO_RIG
    """The rig's recording of its tracked bodies."""
    arrangement: Literal["auto", "stated"] = "auto"
    placed_mesh: bool = False
    """Whether the meshes of a capture that is placed are in the room, or in the body that the object rides on."""


def rig_tasks(workspace: Workspace, folder: Path | None = None) -> list[Task]:
    """All objects of the rig, into surfaces/<key> of the rig or of `folder`."""
    objects: dict[str, str] = workspace.need("objects")
    return [
        Task(workspace.path(entry, f"objects.{key}"), (folder or workspace.folder / "surfaces") / key, key)
        for key, entry in objects.items()
    ]


def capture_tasks(captures: list[Path], workspace: Workspace | None, folder: Path | None) -> list[Task]:
    """Given captures; one that is an object of the rig takes its key, another its folder's name."""
    objects = workspace.rig_file.rig.objects if workspace else {}
    keys = {(workspace.folder / entry).resolve(): key for key, entry in objects.items()} if workspace else {}
    root = folder or (workspace.folder / "surfaces" if workspace else Path("surfaces"))
    tasks = []
    for capture in captures:
        name = keys.get(capture.resolve(), capture.resolve().name)
        tasks.append(Task(capture, root if folder and len(captures) == 1 else root / name, name))
    return tasks


def refuse_targets(tasks: list[Task], inputs: list[Path]) -> None:
    """Refuse surfaces that would be written over each other, over an input, or over anything that is no surface of lpcal's.

    Raises
    ------
    UsageError, InputError
        As `refuse_place`; or two captures have one name.
    """
    there: dict[Path, Task] = {}
    for task in tasks:
        if not task.name:
            raise UsageError("a capture without a name", where=str(task.capture), needed="a capture folder")
        twin = there.setdefault(task.target, task)
        if twin is not task:
            raise UsageError(
                f"the surfaces of {twin.capture} and of {task.capture} would both be written there",
                where=str(task.target),
                needed="captures of different names",
                todo="reconstruct them one at a time, each with its own -o",
            )
        refuse_place(task.target, SURFACE, [*inputs, task.capture])


def reconstruct_one(task: Task, calibration: Calibration, calibration_path: Path, wishes: Wishes, progress: Progress) -> dict[str, Any]:
    """Reconstruct one capture and write its folder; the document is that of summary.json."""
    begun = time.perf_counter()
    with cores(wishes.jobs):
        raw = read_capture(task.capture, [light.name for light in calibration.lights], name=task.name, use=wishes.use)
    saying = [(BY_COMMAND, wishes.sensor), (BY_CAPTURE, raw.sensor), (calibration_path.name, stated_in(calibration))]
    saying.append(("panel.yaml", wishes.panel))
    mask = read_mask(Path(wishes.mask), raw.size[::-1]) if wishes.mask not in MASK_WORDS else wishes.mask
    placement, said = placed(raw.place, calibration, wishes.recorded, task.capture)
    with cores(wishes.jobs):
        hashes = hashes_of(task, calibration_path)
    digest = made_from_of(task, wishes, hashes)
    calibration = calibration.of_images(raw.size)
    made = partial(
        reconstruct,
        raw,
        calibration,
        box=wishes.hints.box,
        points=wishes.hints.points,
        keep=wishes.keep,
        distance_m=wishes.distance_m,
        sensor=saying,
        placement=placement,
        arrangement=wishes.arrangement,
        progress=progress,
    )
    read = time.perf_counter()
    with cores(wishes.jobs):
        surface = made(mask=mask, method=wishes.method or ("near" if wishes.near else "distant"), integrator=wishes.integrator)
    surface = replace(surface, warnings=(*surface.warnings, *said))
    solved = time.perf_counter()
    document = summary_document(surface, task, hashes, wishes, {"reading": read - begun, "solving": solved - read})
    near = wishes.near and wishes.method is None and calibration.lights[0].source_C is not None
    with cores(wishes.jobs):
        distant = made(mask=surface.mask, method="distant") if document["flatness"] and near and raw.full is None else None
    document |= ({} if distant is None else {"flatness_distant": flatness(distant)}) | {"made_from": digest}
    progress(f"{task.name}: writing", 0, 1)
    page = partial(render, surface, calibration, distant)
    with cores(wishes.jobs):
        write_surface(task.target, surface, document, page, wishes.outputs, placed_mesh=wishes.placed_mesh)
    progress(f"{task.name}: writing", 1, 1)
    return document


def of_rig(wishes: Wishes, workspace: Workspace | None, task: Task, calibration_path: Path) -> Wishes:
    """The wishes with what the rig's panel.yaml says of sensor and tracking, for a capture or a calibration in the rig's folder."""
    if workspace is None or not within(workspace, task.capture, calibration_path):
        return wishes
    return replace(wishes, panel=stated_in_panel(workspace), recorded=recorded_of(workspace))


def summary_document(surface: Surface, task: Task, hashes: Hashes, wishes: Wishes, times_s: dict[str, float]) -> dict[str, Any]:
    """What summary.json holds."""
    return summary_of(surface) | {
        "flatness": flatness(surface),
        "times_s": {key: round(value, 2) for key, value in times_s.items()},
        "peak_memory_mb": peak_memory_mb(),
        "versions": {"lpcal": __version__} | {name: version_of(name) for name in ("numpy", "scipy")},
        "options": {
            word: value for word, value in asdict(replace(wishes, panel=StatedSensor())).items() if word not in {"jobs", "recorded"}
        },
        "capture": place_of(task.capture, task.target),
        "inputs": {_name_in(task.capture, path): one for path, one in hashes.items()},
    }


def peak_memory_mb() -> int | None:
    """The most memory that this process has held; None where the system does not say (Windows)."""
    try:
        import resource
    except ImportError:
        return None
    held = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return round(held / (1024 * 1024 if sys.platform == "darwin" else 1024))


def hashes_of(task: Task, calibration_path: Path) -> Hashes:
    """sha256 of the calibration and of every file of the capture, which cores share."""
    files = [calibration_path, *files_of(task.capture)]
    return dict(zip(files, run_all(sha256, files), strict=True))


def made_from_of(task: Task, wishes: Wishes, hashes: Hashes) -> str:
    """A digest of all that a surface is made from: lpcal's version, the files' contents, and all that is wished."""
    hashes = hashes if wishes.mask in MASK_WORDS else hashes | {Path(wishes.mask): sha256(Path(wishes.mask))}
    said = [
        __version__,
        task.name,
        [[_name_in(task.capture, path), one] for path, one in hashes.items()],
        plain(asdict(replace(wishes, mask="", jobs=None, recorded=NO_RIG)) | {"recorded": None}),
        *made_from(stated_place_of(task.capture), wishes.recorded),
    ]
    said += [wishes.mask] if wishes.mask in MASK_WORDS else []
    return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()


def _name_in(capture: Path, path: Path) -> str:
    """A file's path in the capture; its name where it lies elsewhere."""
    return path.relative_to(capture).as_posix() if path.is_relative_to(capture) else path.name


def standing(task: Task, calibration_path: Path, wishes: Wishes) -> dict[str, Any] | None:
    """The document of a surface that stands, whole, and was made from what there is now; None where there is none."""
    try:
        document = json.loads((task.target / SUMMARY).read_text(encoding="utf-8"))
        sizes = {name: (task.target / name).stat().st_size for name in document["files"]}
        same = sizes == document["files"] and document["made_from"] == made_from_of(task, wishes, hashes_of(task, calibration_path))
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return document if same and isinstance(document, dict) else None


def line_of(document: dict[str, Any], target: Path) -> str:
    """One line for people."""
    figures, pieces = document["counts_and_residuals"], document["components"]
    where = ", ".join(distance_said(piece) for piece in pieces[:3])
    return (
        f"{document['name']}: {figures['pixels']} px in {len(pieces)} piece{'s' * (len(pieces) != 1)}"
        + (f" at {where}" if document["units"] == "metres" else "")
        + f", {document['times_s']['solving']:.1f} s -> {from_here(target)}"
        + (f"\n  sensor: {document['sensor']['in_words']}" if document["sensor"]["in_words"] else "")
        + _flat_said(document)
        + placed_said(document.get("placement"))
    )


def _flat_said(document: dict[str, Any]) -> str:
    """How flat a nearly flat piece came out, by lights where they are and by distant ones."""
    near, distant = plain(document["flatness"]), plain(document.get("flatness_distant"))  # as read again
    if not near:
        return ""
    said = f"\n  nearly flat: {near['plane_rms_mm']:.2f} mm rms from a plane, {near['plane_peak_to_valley_mm']:.2f} mm from peak to valley"
    said += f" over {near['extent_mm']:.0f} mm, a bowl of {near['bowl_mm']:.2f} mm"
    return said + (f"; with distant lights it would be one of {distant['bowl_mm']:.1f} mm" if distant else "")


def from_here(target: Path) -> Path:
    """The path as it is seen from the current folder, where it lies in it."""
    here = Path.cwd()
    return target.resolve().relative_to(here) if target.resolve().is_relative_to(here) else target


@dataclass(frozen=True)
class SurfaceStage(Stage):
    """The surfaces of all objects; up to date when each was made from the files and the calibration that there are now."""

    def refuse_places(self, workspace: Workspace, inputs: Iterable[Path]) -> None:
        """Refuse to write a surface where something else stands."""
        refuse_targets(rig_tasks(workspace), list(inputs))

    def up_to_date(self, workspace: Workspace) -> bool:
        """Whether every surface stands and was made from what there is now."""
        calibration_path = workspace.calib(CALIBRATION)
        return all(
            standing(task, calibration_path, of_rig(Wishes(), workspace, task, calibration_path)) is not None
            for task in rig_tasks(workspace)
        )


def _run(workspace: Workspace, progress: Progress) -> Outcome:
    from lpcal.pipeline.many import reconstruct_all  # which rests on this module

    return reconstruct_all(rig_tasks(workspace), workspace.calib(CALIBRATION), Wishes(), progress, workspace)


def _look_closer(workspace: Workspace) -> None:
    """Whether any object has an image of every light; what one object lacks does not stop the others."""
    lights, lacking = list(workspace.rig_file.rig.lights), []
    tasks = rig_tasks(workspace) if lights else []
    for task in tasks:
        try:
            check_lights(task.capture, lights)
        except LpcalError as error:
            lacking.append(error)
    if lacking and len(lacking) == len(tasks):
        raise lacking[0]


def _inputs(workspace: Workspace) -> list[Path]:
    objects = workspace.rig_file.rig.objects
    return [workspace.calib(CALIBRATION), *(path for key, name in objects.items() for path in workspace.files(name, f"objects.{key}"))]


STAGE = SurfaceStage(
    name="reconstruct",
    kinds={},
    wanted=lambda workspace: bool(workspace.rig_file.rig.objects),
    inputs=_inputs,
    settings=lambda workspace: {"objects": workspace.rig_file.rig.objects},
    run=_run,
    look_closer=_look_closer,
)


def calibration_of(workspace: Workspace | None, given: Path | None) -> Path:
    """The calibration that a command means: the given one, else the rig's.

    Raises
    ------
    InputError
        Neither is there.
    """
    if given is not None:
        return given
    if workspace is None:
        raise InputError("no calibration", needed="-c calibration.yaml, or a rig folder", todo="name one with -c, or go into a rig folder")
    return workspace.calib(CALIBRATION)


HEAD = 1000
"""Bytes of a file among which lpcal's own says its kind, as its second line."""


def integrate_file(
    normals: Path,
    calibration: Path | None,
    mask: Path | None,
    target: Path,
    distance_m: float | None = None,
    green: Green = "auto",
    integrator: str = "lpcal",
) -> Outcome:
    """Integrate a normal map and write its folder.

    Raises
    ------
    LpcalError
        The map, the mask or the calibration cannot be read, or they disagree.
    """
    refuse_place(target, SURFACE, [path for path in (normals, calibration, mask) if path is not None])
    begun = time.perf_counter()
    values, good = read_normals(normals)
    inside = good if mask is None else good & read_mask(mask, good.shape)
    camera, working_m = (None, None) if calibration is None else _camera(calibration)
    distance_m = distance_m or working_m or DISTANCE_M
    surface = integrate(values, camera, inside, distance_m=distance_m, green=green, integrator=integrator, name=normals.stem)
    *remarks, _ = surface.warnings
    seconds = round(time.perf_counter() - begun, 2)
    figures = document_of(surface.figures)
    document = summary_of(surface) | {
        "convention": figures.pop("convention"),
        "counts_and_residuals": figures,
        "times_s": {"solving": seconds},
        "inputs": {path.name: sha256(path) for path in (normals, calibration, mask) if path is not None},
    }
    write_surface(target, surface, document)
    pieces = len(surface.components)
    line = f"{surface.name}: {surface.mask.sum()} px in {pieces} piece{'s' * (pieces != 1)}, depth in {document['units']}, {seconds:.1f} s"
    return Outcome([f"{line} -> {from_here(target)}", *(f"  {note}" for note in remarks)], {"surfaces": [document]})


def _camera(path: Path) -> tuple[Camera | None, float | None]:
    """Camera and working distance of a calibration, or the camera of a file that holds one alone."""
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="calibration.yaml, or any camera file", todo=did_you_mean(path))
    with path.open("rb") as stream:
        begins = stream.read(HEAD)
    if re.search(rb"^kind: calibration\s*$", begins, re.MULTILINE):
        lights = read_calibration(path)
        return lights.camera, lights.d_object_m
    return read_camera_file(path), None

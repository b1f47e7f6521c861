"""Many captures: each is one item of work, done where an engine says, and what stands and is up to date is not done again.

What goes wrong with one capture costs that one: a bad image, a full disk, a worker that is killed. At the end stands one table.

The table of many surfaces: surfaces.csv and surfaces.html in their folder, worst first.
"""

from __future__ import annotations

import csv
import io
import logging
import traceback
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from lpcal.errors import InputError, LpcalError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.images import read_image
from lpcal.formats.outputs import marked, refuse_place, write_text
from lpcal.pipeline.reconstruct import MASK_WORDS, Task, Wishes, line_of, of_rig, reconstruct_one, refuse_targets, standing
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Calibration
from lpcal.records.outcome import Outcome, Progress, silent
from lpcal.records.pictures import data_uri, png
from lpcal.report.pictures import shaded, shrink
from lpcal.report.side_pages import COLLECTION_MARK, Row, collection_html

if TYPE_CHECKING:  # where all is done here, no processes are asked for
    from lpcal.api.engines import Engine

logger = logging.getLogger("lpcal")
BUG = 1
"""The exit code of what no capture may cause."""
type State = Literal["done", "up to date", "failed", "lost"]


@dataclass(frozen=True)
class Job:
    """One capture to reconstruct, as it goes to a worker."""

    task: Task
    calibration_path: Path
    wishes: Wishes
    anew: bool = False
    """Whether it is done again although it stands and is up to date."""
    pictured: bool = False
    """Whether a small picture of the surface is wanted, for the table of many."""


@dataclass(frozen=True)
class Done:
    """What became of one capture."""

    state: State
    document: dict[str, Any] = field(default_factory=dict)
    """That of summary.json; empty where there is no surface."""
    error: LpcalError | None = None
    exit_code: int = 0
    picture: bytes | None = None
    """The shaded surface, a small PNG."""


def do(job: Job, progress: Progress = silent) -> Done:
    """Reconstruct one capture, unless it stands and is up to date; what goes wrong is said and not raised."""
    try:
        stands = None if job.anew else standing(job.task, job.calibration_path, job.wishes)
        if stands is not None:
            return Done("up to date", stands, picture=_picture(job))
        calibration = _calibration(job.calibration_path, _changed_ns(job.calibration_path))
        document = reconstruct_one(job.task, calibration, job.calibration_path, job.wishes, progress)
        return Done("done", document, picture=_picture(job))
    except LpcalError as error:
        return Done("failed", error=error, exit_code=error.exit_code)
    except MemoryError:
        return _refused(InputError("not enough memory", where=str(job.task.capture), todo="have fewer worked on at a time: --jobs"))
    except OSError as error:
        return _refused(InputError(error.strerror or str(error), where=str(error.filename or job.task.capture)))
    except Exception as error:
        logger.exception("%s", job.task.name)
        last = traceback.extract_tb(error.__traceback__)[-1]
        said = f"{type(error).__name__}: {error}, in {Path(last.filename).name}:{last.lineno}"
        found = LpcalError(f"a bug of lpcal: {said}", where=str(job.task.capture), todo="please report it; alone the capture says more")
        return Done("failed", error=found, exit_code=BUG)


def _refused(error: LpcalError) -> Done:
    return Done("failed", error=error, exit_code=error.exit_code)


def _changed_ns(path: Path) -> int:
    """When a file was last changed; 0 of one that is not there, which is said when it is read."""
    return path.stat().st_mtime_ns if path.is_file() else 0


@lru_cache(maxsize=2)
def _calibration(path: Path, changed_ns: int) -> Calibration:  # noqa: ARG001 - one that was changed is read again
    """The calibration, which a worker reads once for all its captures."""
    return read_calibration(path)


def reconstruct_all(
    tasks: list[Task],
    calibration_path: Path,
    wishes: Wishes,
    progress: Progress,
    workspace: Workspace | None = None,
    *,
    engine: Engine | None = None,
    anew: bool = False,
) -> Outcome:
    """Reconstruct each capture; a bad one is named at the end and does not stop the others.

    What the rig's panel.yaml says of the sensor counts for captures and calibrations that lie in its folder, where these say nothing.

    Parameters
    ----------
    engine : where they are worked on; None: one after the other, here
    again : whether what stands and is up to date is done again

    Raises
    ------
    LpcalError
        The calibration cannot be read, the only capture is bad, or a surface would be written over something else.
    """
    refuse_targets(tasks, [calibration_path, *([] if wishes.mask in MASK_WORDS else [Path(wishes.mask)])])
    root = tasks[0].target.parent if len(tasks) > 1 else None
    if root is not None:
        COLLECTION.refuse(root)
    _calibration(
        calibration_path, _changed_ns(calibration_path)
    ).with_lights()  # once here: what is wrong with it is wrong with every capture
    if engine is not None and len(tasks) > 1:
        wishes = replace(wishes, jobs=1)  # a core a capture
    jobs = [Job(task, calibration_path, of_rig(wishes, workspace, task, calibration_path), anew, root is not None) for task in tasks]
    done = _here(jobs, progress) if engine is None or len(jobs) == 1 else _there(jobs, engine, progress)
    if len(done) == 1 and done[0].error is not None:
        raise done[0].error
    remarks = [f"{task.name} was not reconstructed: {one.error}" for task, one in zip(tasks, done, strict=True) if one.error is not None]
    documents = [one.document for one in done if one.document]
    remarks += [f"{document['name']}: {note}" for document in documents for note in document["notes"]]
    summary = [_line(task, one) for task, one in zip(tasks, done, strict=True) if one.document]
    codes = [one.exit_code for one in done if one.exit_code]
    if root is not None:
        summary.append(_counted(done))
        try:
            page = write_collection(root, [*zip(tasks, done, strict=True)])
            summary.append(f"written {page}")
        except LpcalError as error:  # a full disk has room for no table either; what became of each capture is said all the same
            remarks.append(str(error))
            codes.append(error.exit_code)
    return Outcome(summary, {"surfaces": documents}, remarks, exit_code=next(iter(codes), 0))


def _line(task: Task, done: Done) -> str:
    said = line_of(done.document, task.target)
    return said if done.state == "done" else f"{said.splitlines()[0]} (up to date)"


def _counted(done: Sequence[Done]) -> str:
    """How many captures came to what."""
    counts = {state: sum(one.state == state for one in done) for state in ("done", "up to date", "failed", "lost")}
    return f"{len(done)} captures: " + ", ".join(f"{count} {state}" for state, count in counts.items() if count)


def _here(jobs: Sequence[Job], progress: Progress) -> list[Done]:
    """One after the other, in this process."""
    done = []
    for number, job in enumerate(jobs):
        if len(jobs) > 1:
            progress("captures", number, len(jobs))
        done.append(do(job, progress))
    if len(jobs) > 1:
        progress("captures", len(jobs), len(jobs))
    return done


def _there(jobs: Sequence[Job], engine: Engine, progress: Progress) -> list[Done]:
    """Where the engine says; files by their whole paths, for a worker may stand elsewhere."""
    done: dict[int, Done] = {}
    progress("captures", 0, len(jobs))
    for number, found in _each(jobs, engine):
        done[number] = found
        progress("captures", len(done), len(jobs))
    return [done[number] for number in range(len(jobs))]


def _each(jobs: Sequence[Job], engine: Engine) -> Iterator[tuple[int, Done]]:
    from lpcal.api.engines import Lost, each

    for number, found in each(do, [_absolute(job) for job in jobs], engine):
        if isinstance(found, Lost):
            where, todo = str(jobs[number].task.capture), "the same command again does what is not done yet"
            yield number, Done("lost", error=(error := InputError(found.why, where=where, todo=todo)), exit_code=error.exit_code)
        else:
            yield number, found


def _absolute(job: Job) -> Job:
    task, wishes = job.task, job.wishes
    task = replace(task, capture=task.capture.absolute(), target=task.target.absolute())
    mask = wishes.mask if wishes.mask in MASK_WORDS else str(Path(wishes.mask).absolute())
    return replace(job, task=task, calibration_path=job.calibration_path.absolute(), wishes=replace(wishes, mask=mask))


THUMBNAIL = 120
"""Pixels of a surface's picture along its longer side: a screen shows some fifty."""
COLUMNS = tuple(one.name for one in fields(Row) if one.name != "picture")


@dataclass(frozen=True)
class Table:
    """The two files of a table, as outputs."""

    csv: str = "surfaces.csv"
    page: str = "surfaces.html"

    def refuse(self, root: Path) -> None:
        """Refuse to write where something else stands.

        Raises
        ------
        UsageError, InputError
            As `refuse_place`.
        """
        refuse_place(root / self.csv, CSV)
        refuse_place(root / self.page, PAGE)


CSV = marked("a table of surfaces", ",".join(COLUMNS))
PAGE = marked("a page of surfaces", COLLECTION_MARK)
COLLECTION = Table()


def write_collection(root: Path, found: Sequence[tuple[Task, Done]]) -> Path:
    """Write the table of what became of each capture; the page's path.

    Raises
    ------
    InputError
        They cannot be written.
    """
    rows = sorted((row_of(root, *one) for one in found), key=lambda row: (-row.doubt, row.name))
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows([_written(getattr(row, column)) for column in COLUMNS] for row in rows)
    write_text(root / COLLECTION.csv, text.getvalue(), CSV)
    write_text(root / COLLECTION.page, collection_html(root.resolve().name, rows), PAGE)
    return root / COLLECTION.page


def row_of(root: Path, task: Task, done: Done) -> Row:
    """One capture's line: its figures, and how much is to be doubted, 1 for one that has no surface."""
    document, error = done.document, done.error
    figures, pieces = document.get("counts_and_residuals", {}), document.get("components", [])
    metric = document.get("units") == "metres"
    largest = max(pieces, key=lambda piece: piece["pixels"], default=None)
    odds = max((one["odds"] for one in (largest or {}).get("alternatives", [])), default=None)
    return Row(
        name=task.name,
        state=done.state,
        doubt=round(1.0 if not document else max(float(document.get("mask_doubt") or 0), float(odds or 0)), 3),
        pixels=figures.get("pixels"),
        pieces=len(pieces) if document else None,
        distance_mm=1e3 * largest["mean_depth_m"] if largest and metric else None,
        distance_std_mm=1e3 * largest["mean_depth_m"] * largest["scale_std"] if largest and metric else None,
        other_distance_odds=odds,
        mask_doubt=document.get("mask_doubt"),
        normal_std_deg=figures.get("normal_std_deg"),
        residual_sigmas=figures.get("residual_sigmas_rms"),
        solving_s=document.get("times_s", {}).get("solving"),
        peak_memory_mb=document.get("peak_memory_mb"),
        folder=_seen_from(root, task.target),
        notes=" | ".join(document.get("notes", [])),
        error="" if error is None else " ".join(str(error).split()),
        picture=data_uri(done.picture) if done.picture else None,
    )


def _seen_from(root: Path, target: Path) -> str:
    return target.relative_to(root).as_posix() if target.is_relative_to(root) else target.resolve().as_posix()


def _written(cell: Any) -> str:
    return "" if cell is None else f"{cell:.6g}" if isinstance(cell, float) else str(cell)


def _picture(job: Job) -> bytes | None:
    """The shaded surface, small; None where it is not wanted, or its pictures are not there."""
    folder = job.task.target
    if not job.pictured:
        return None
    try:
        inside = read_image(folder / "mask.png").pixels > 0
        normals_gl = read_image(folder / "normals_gl.png").pixels
    except (InputError, OSError, MemoryError):
        return None
    return png(shrink(shaded((2 * normals_gl - 1) * np.array([1, -1, -1], np.float32)), inside, THUMBNAIL))

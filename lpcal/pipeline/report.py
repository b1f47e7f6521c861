"""calib/report.html from whatever the stages have written: reads calib/ and surfaces/, solves nothing."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from lpcal.errors import InputError
from lpcal.formats.documents import read_document, write_text
from lpcal.formats.images import read_image
from lpcal.pipeline.workspace import Workspace
from lpcal.records.outcome import Outcome, Progress
from lpcal.report.page import render
from lpcal.report.pictures import png, shaded, shrink
from lpcal.report.rig_report import KINDS, RigReport, SurfaceReport
from lpcal.report.verdict import headline, verdicts

THUMBNAIL = 220


def write_report(workspace: Workspace, progress: Progress) -> Outcome:
    """Write calib/report.html.

    Raises
    ------
    InputError
        No stage has written anything; or a document is cut off.
    """
    documents = {kind: read_document(path, kind) for kind in KINDS if (path := workspace.calib(f"{kind}.yaml")).is_file()}
    folders = sorted(path.parent for path in (workspace.folder / "surfaces").glob("*/summary.json"))
    if not documents and not folders:
        raise InputError(
            "nothing to report on: no stage has written anything yet",
            where=str(workspace.folder / "calib"),
            needed="at least one of " + ", ".join(f"{kind}.yaml" for kind in KINDS),
            todo="lpcal run, or a stage such as lpcal intrinsics",
        )
    surfaces = []
    for done, folder in enumerate(folders, start=1):
        surfaces.append(_surface(folder))
        progress("pictures", done, len(folders))
    report = RigReport(workspace.rig_file.rig.name, documents, tuple(surfaces))
    path = workspace.calib("report.html")
    write_text(path, render(report))
    lines = verdicts(report)
    tone, sentence = headline(lines)
    summary = [*(f"{line.title:<10} {line.word:<10} {line.found}" for line in lines), sentence, workspace.relative(path)]
    found = [{"stage": line.stage, "name": line.title, "verdict": line.tone, "found": line.found, "notes": line.notes} for line in lines]
    return Outcome(summary, {"report": str(path), "verdict": tone, "stages": found})


def _surface(folder: Path) -> SurfaceReport:
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except ValueError as error:
        todo = "reconstruct the object anew, or remove the folder"
        raise InputError(
            "not readable as JSON", where=str(folder / "summary.json"), needed="a summary that lpcal wrote", todo=todo
        ) from error
    relight = f"../surfaces/{folder.name}/relight.html" if (folder / "relight.html").is_file() else None
    return SurfaceReport(folder.name, summary, _pictures(folder), relight)


def _pictures(folder: Path) -> dict[str, bytes]:
    """Small pictures of the maps that are there, cropped to the mask."""
    if not (folder / "mask.png").is_file():
        return {}
    inside = read_image(folder / "mask.png").pixels > 0
    found: dict[str, bytes] = {}
    if (folder / "normals_gl.png").is_file():
        normals_gl = read_image(folder / "normals_gl.png").pixels
        normals = (2 * normals_gl - 1) * np.array([1, -1, -1], np.float32)
        found["shape"] = png(shrink(shaded(normals), inside, THUMBNAIL))
        found["normals"] = png(shrink(normals_gl, inside, THUMBNAIL))
    if (folder / "albedo.png").is_file():
        albedo = read_image(folder / "albedo.png").pixels
        colour = albedo if albedo.ndim == 3 else np.repeat(albedo[..., None], 3, axis=2)
        found["albedo"] = png(shrink(np.asarray((0.85 * colour) ** (1 / 2.2), dtype=np.float32), inside, THUMBNAIL))
    return found

"""calib/report.html from whatever the stages have written: reads calib/ and surfaces/, solves nothing."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

import numpy as np

from lpcal import __version__
from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.camera_yaml import read_camera_solution
from lpcal.formats.distance_files import read_distance
from lpcal.formats.documents import read_provenance, sha256
from lpcal.formats.h_cb_yaml import read_h_cb
from lpcal.formats.h_op_yaml import read_h_op
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.images import read_image
from lpcal.formats.lights_yaml import read_lights
from lpcal.formats.outputs import marked, refuse_place, write_text
from lpcal.formats.surface_files import MAPS_FILE, read_summary
from lpcal.formats.wings_yaml import read_wings
from lpcal.geometry.arrays import Mask
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.pictures import png
from lpcal.records.rig import Rig
from lpcal.report.page import render
from lpcal.report.pictures import doubtful, shaded, shrink
from lpcal.report.rig_report import KINDS, PARTS, RigReport, SurfaceReport
from lpcal.report.verdict import headline, verdicts

THUMBNAIL = 220
HIGHEST = 98.0
"""Percentile of a standard deviation at which its colours end: the last few pixels are the rim's."""
STAMP_WITHIN = 2000
FILE = "report.html"
KIND = marked("a report", '<meta name="lpcal-inputs"')


@dataclass(frozen=True)
class ReportStage(Stage):
    """The report; up to date when it says that it was made from the documents that there are now."""

    def up_to_date(self, workspace: Workspace) -> bool:
        """Whether the page stands and carries the stamp of what there is now."""
        path = workspace.calib(FILE)
        return path.is_file() and f'content="{_stamp(workspace)}"' in path.read_text(encoding="utf-8")[:STAMP_WITHIN]


def _report(workspace: Workspace, surfaces: Sequence[SurfaceReport]) -> RigReport:
    """The records of the documents that there are."""
    paths = {path.stem: path for path in _documents(workspace)}

    def read[Record](kind: str, reader: Callable[[Path], Record]) -> Record | None:
        return reader(paths[kind]) if kind in paths else None

    found = read("H_OP", read_h_op)
    return RigReport(
        workspace.rig_file.rig.name,
        camera=read("camera", read_camera_solution),
        boards=read("H_CB", read_h_cb),
        body_poses=None if found is None else found.by_image(),
        course=None if found is None else found.course,
        image_times_s={} if found is None else found.times_by_image(),
        handeye=read("handeye", read_handeye),
        wings=read("wings", read_wings),
        distance=read("distance", read_distance),
        lights=read("lights", read_lights),
        calibration=read("calibration", read_calibration),
        provenance={kind: read_provenance(path, kind) for kind, path in paths.items()},
        surfaces=tuple(surfaces),
        lacks=_lacks(workspace.rig_file.rig),
    )


def _lacks(rig: Rig) -> frozenset[str]:
    """What the rig does not state: no stage will find it."""
    stated = {
        "camera": rig.camera,
        "handeye": rig.mocap,
        "wings": any(light.is_wing for light in rig.lights.values()),
        "lights": rig.lights,
        "spheres": rig.spheres,
        "surfaces": rig.objects,
    }
    return frozenset(part for part, found in stated.items() if not found)


def write_report(workspace: Workspace, progress: Progress) -> Outcome:
    """Write calib/report.html.

    Raises
    ------
    InputError
        No stage has written anything; or a document is cut off, or holds what cannot be.
    """
    path = workspace.calib(FILE)
    refuse_place(path, KIND)
    folders = [path.parent for path in _summaries(workspace)]
    if not _documents(workspace) and not folders:
        raise InputError(
            "nothing to report on: no stage has written anything yet",
            where=str(workspace.folder / "calib"),
            needed="at least one of " + ", ".join(f"{kind}.yaml" for kind in KINDS),
            todo="lpcal run, or a stage such as lpcal intrinsics",
        )
    report = _report(workspace, _surfaces(folders, path, progress))
    write_text(path, render(report, _stamp(workspace)), KIND)
    return _outcome(report, path, workspace.relative(path))


def report_calibration(calibration: Path, surfaces: Sequence[Path], target: Path | None, progress: Progress) -> Outcome:
    """Write the report of a calibration that stands by itself, and of surfaces; without a rig nothing else is known.

    Parameters
    ----------
    calibration : a calibration.yaml
    surfaces : folders that `lpcal reconstruct` wrote
    target : the page; None: beside the calibration, after its name

    Raises
    ------
    InputError
        The calibration or a surface is not there or cannot be read, or something else stands where the page would.
    """
    path = target or calibration.with_name(f"{calibration.stem}_report.html")
    refuse_place(path, KIND, [calibration])
    found = read_calibration(calibration)
    report = RigReport(
        found.name,
        calibration=found,
        provenance={"calibration": read_provenance(calibration, "calibration")},
        surfaces=tuple(_surfaces([folder.resolve() for folder in surfaces], path, progress)),
        lacks=frozenset(PARTS),
    )
    write_text(path, render(report), KIND)
    return _outcome(report, path, str(path))


def _outcome(report: RigReport, path: Path, shown: str) -> Outcome:
    """The verdicts in words and as a document."""
    lines = verdicts(report)
    tone, sentence = headline(lines)
    summary = [*(f"{line.title:<10} {line.word:<10} {line.found}" for line in lines), sentence, shown]
    found = [{"stage": line.stage, "name": line.title, "verdict": line.tone, "found": line.found, "notes": line.notes} for line in lines]
    return Outcome(summary, {"report": str(path), "verdict": tone, "stages": found})


def _surfaces(folders: Sequence[Path], page: Path, progress: Progress) -> list[SurfaceReport]:
    """What each folder holds, with the way from the page to its relighting page."""
    found = []
    for done, folder in enumerate(folders, start=1):
        there = (folder / "relight.html").is_file()
        way = Path(os.path.relpath(folder, page.parent.resolve())).as_posix() if there else ""
        relight = f"{quote(way)}/relight.html" if there else None
        found.append(SurfaceReport(folder.name, read_summary(folder / "summary.json"), _pictures(folder), relight))
        progress("pictures", done, len(folders))
    return found


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
    return found | _sigmas(folder, inside)


def _sigmas(folder: Path, inside: Mask) -> dict[str, bytes]:
    """Pictures of how sure the normals and the depth's shape are; none where the maps are not there or nothing is known."""
    if not (folder / MAPS_FILE).is_file():
        return {}
    found: dict[str, bytes] = {}
    with np.load(folder / MAPS_FILE) as maps:
        metric = bool(np.any(maps["rays"][..., :2])) if "rays" in maps else True
        unit, scale = ("mm", 1e3) if metric else ("px", 1.0)
        for what, name, factor, sign in (("normals", "normal_std_deg", 1.0, "°"), ("depth", "depth_std", scale, f" {unit}")):
            sigma = factor * maps[name]
            known = sigma[inside & np.isfinite(sigma)] if sigma.shape == inside.shape else sigma[:0]
            if known.size and (high := float(np.percentile(known, HIGHEST))) > 0:
                found[f"sigma of {what}, 0 to {high:.2g}{sign}"] = png(shrink(doubtful(sigma, high), inside, THUMBNAIL))
    return found


def _documents(workspace: Workspace) -> list[Path]:
    return [path for kind in KINDS if (path := workspace.calib(f"{kind}.yaml")).is_file()]


def _summaries(workspace: Workspace) -> list[Path]:
    return sorted((workspace.folder / "surfaces").glob("*/summary.json"))


def _stamp(workspace: Workspace) -> str:
    """A digest of lpcal's version, the rig's name, and every document with its path; of the relighting pages, whether they are there."""
    pages = [path.parent / "relight.html" for path in _summaries(workspace)]
    made_from = [__version__, workspace.rig_file.rig.name, *(str(page.is_file()) for page in pages)]
    made_from += [f"{workspace.relative(path)} {sha256(path)}" for path in [*_documents(workspace), *_summaries(workspace)]]
    return hashlib.sha256("\n".join(made_from).encode()).hexdigest()


STAGE = ReportStage(
    name="report",
    kinds={},
    wanted=lambda workspace: bool(_documents(workspace) or _summaries(workspace)),
    inputs=lambda workspace: [*_documents(workspace), *_summaries(workspace)],
    settings=lambda workspace: {"name": workspace.rig_file.rig.name},
    run=write_report,
)

"""The chain on one page.

::

board images             -> K, H_CB        intrinsics
mocap, H_CB              -> H_OP, H_PC     handeye
wings, H_PC, H_PD        -> H_CL drawn     wings       H_CL = (H_OP H_PC)^-1 H_OL
readings, H_CB, H_PC     -> its beam in C  distance
spheres, H_CL drawn      -> H_CL           refine
all of it                -> calibration    export
captures, calibration    -> surfaces       reconstruct

The whole chain on the bundled rig, and what it found held against the truth that travels with it.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.errors import InputError, LpcalError
from lpcal.formats.bundled import folder as bundled_folder
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.documents import read_document
from lpcal.formats.field_csv import read_field
from lpcal.formats.outputs import whole
from lpcal.formats.panel_yaml import FILE_NAME, read_rig
from lpcal.formats.surface_files import read_surface
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.pipeline import distance, export, handeye, intrinsics, reconstruct, refine, report, wings
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.outcome import Outcome, Progress

CHAIN: tuple[Stage, ...] = (intrinsics.STAGE, handeye.STAGE, wings.STAGE, distance.STAGE, refine.STAGE, export.STAGE)


def before(stage: Stage) -> tuple[Stage, ...]:
    """The stages that come before one."""
    return CHAIN[: CHAIN.index(stage)]


@dataclass(frozen=True)
class Brought:
    """A stage, and what running it found; None where its files were up to date."""

    stage: Stage
    outcome: Outcome | None


def bring_up_to_date(workspace: Workspace, stages: Sequence[Stage], progress: Progress) -> list[Brought]:
    """Run those of the stages that the rig has the sections for and whose files are out of date, in order."""
    wanted = (stage for stage in stages if stage.wanted(workspace))
    return [Brought(stage, None if stage.up_to_date(workspace) else stage.run(workspace, progress)) for stage in wanted]


def together(brought: Sequence[Brought], *, say_up_to_date: bool) -> Outcome:
    """One outcome of several stages; the exit code is the first that is not 0."""
    summary, document, warnings, exit_code = list[str](), dict[str, Any](), list[str](), 0
    for stage, outcome in ((one.stage, one.outcome) for one in brought):
        if outcome is None:
            summary += [f"{stage.name}: up to date"] * say_up_to_date
            continue
        summary += [f"{stage.name}: {outcome.summary[0]}", *(f"  {line}" for line in outcome.summary[1:])]
        document[stage.name] = outcome.document
        warnings += [f"{stage.name}: {warning}" for warning in outcome.warnings]
        exit_code = exit_code or outcome.exit_code
    return Outcome(summary, document, warnings, exit_code=exit_code)


def look_ahead(workspace: Workspace, stages: Sequence[Stage]) -> None:
    """Before the first of the stages starts: all that panel.yaml names for any of them is there, and no output replaces anything else.

    Raises
    ------
    LpcalError
        As the stage itself would raise it, minutes later.
    """
    for stage in stages:
        if stage.wanted(workspace):
            stage.look(workspace)


def run_stage(workspace: Workspace, stage: Stage, progress: Progress) -> Outcome:
    """Run one stage after whatever it rests on; what comes before it and was out of date is reported first.

    A stage that the rig has not the sections for says so at once.
    """
    earlier_stages = before(stage) if stage.wanted(workspace) else ()
    look_ahead(workspace, (*earlier_stages, stage))
    earlier = together(bring_up_to_date(workspace, earlier_stages, progress), say_up_to_date=False)
    outcome = stage.run(workspace, progress)
    said, warnings = [*earlier.summary, *outcome.summary], [*earlier.warnings, *outcome.warnings]
    return Outcome(said, outcome.document, warnings, outcome.next_command, outcome.exit_code)


def run_all(workspace: Workspace, progress: Progress) -> Outcome:
    """The whole chain, the objects' surfaces and the report.

    Raises
    ------
    InputError
        The rig has not the sections of a single stage.
    """
    stages = (*CHAIN, reconstruct.STAGE)
    if not any(stage.wanted(workspace) for stage in stages):
        raise InputError(
            "no stage has what it needs",
            where=str(workspace.rig_file.file),
            needed="camera: and board:, or lights: and spheres:, or objects: with a calibration",
            todo="see lpcal new, or the README's rig folder",
        )
    look_ahead(workspace, stages)
    chain = together(bring_up_to_date(workspace, stages, progress), say_up_to_date=True)
    page = report.write_report(workspace, progress)
    return Outcome(
        [*chain.summary, *page.summary],
        chain.document | {"report": page.document},
        [*chain.warnings, *page.warnings],
        exit_code=chain.exit_code,
    )


def rigs_in(folders: Sequence[Path]) -> list[Path]:
    """Rigs that folders are or hold, each once.

    Raises
    ------
    InputError
        A folder is no rig and holds none.
    """
    found: dict[Path, None] = {}
    for folder in folders:
        inside = (
            [folder]
            if folder.is_file() or (folder / FILE_NAME).is_file()
            else sorted(each.parent for each in folder.glob(f"*/{FILE_NAME}"))
        )
        if not inside:
            raise InputError(f"no {FILE_NAME} in it or in a folder of it", where=str(folder), needed="a rig, or a folder of rigs")
        found |= dict.fromkeys(inside)
    return list(found)


def run_rigs(rigs: Sequence[Path], run: Callable[[Path], Outcome]) -> Outcome:
    """Run each rig; what goes wrong with one is named at the end and stops no other.

    Raises
    ------
    LpcalError
        The only one is bad.
    """
    summary: list[str] = []
    warnings: list[str] = []
    documents: dict[str, object] = {}
    exit_code = 0
    for rig in rigs:
        try:
            found = run(rig)
        except LpcalError as error:
            if len(rigs) == 1:
                raise
            summary.append(f"{rig}: not done")
            warnings.append(f"{rig} was not run to its end: {error}")
            exit_code = exit_code or error.exit_code
            continue
        summary += [f"{rig}:", *(f"  {line}" for line in found.summary)]
        warnings += [f"{rig}: {warning}" for warning in found.warnings]
        documents[str(rig)] = found.document
        exit_code = exit_code or found.exit_code
    return Outcome(summary, {"rigs": documents}, warnings, exit_code=exit_code)


RIG = "demo_rig"
DARKEST = 0.01
"""Points that a light gives less than this share of its brightest are not compared."""


def demo(target: Path, progress: Progress) -> Outcome:
    """Copy the bundled rig to a new folder, calibrate it, reconstruct its objects, and compare.

    Raises
    ------
    InputError, UsageError
        The folder is there and not empty, or is the current one.
    """
    with whole(target) as draft:
        shutil.copytree(bundled_folder("calib_data") / RIG, draft)
    workspace = Workspace(read_rig(target / "panel.yaml"))
    chain = run_all(workspace, progress)
    lines, figures = compare(workspace)
    pages = [workspace.calib("report.html"), *sorted(target.glob("surfaces/*/relight.html"))]
    return Outcome(
        summary=[
            *chain.summary,
            "",
            "found, against the truth of this simulated rig:",
            *lines,
            "",
            "look at:",
            *(f"  {page}" for page in pages),
        ],
        document=chain.document | {"against_truth": figures, "pages": [str(page) for page in pages]},
        warnings=chain.warnings,
        next_command="lpcal new my_rig",
        exit_code=chain.exit_code,
    )


def compare(workspace: Workspace) -> tuple[list[str], dict[str, Any]]:
    """Errors of what was found, each with the sigma that lpcal stated, as lines and as figures."""
    truth = workspace.folder / "truth"
    lines: list[str] = []
    figures: dict[str, Any] = {}

    def say(name: str, error: float, stated: float, unit: str) -> None:
        figures[name] = {"error": error, "stated_std": stated, "unit": unit}
        beside = f"   stated sigma {stated:.3g} {unit}" if np.isfinite(stated) else ""
        lines.append(f"  {name:<30} {error:8.3g} {unit}{beside}")

    camera, true_camera = read_document(workspace.calib("camera.yaml"), "camera"), _yaml(truth / "camera.yaml")
    std = np.sqrt(np.diag(np.array(camera["covariance"])))
    say("focal length", abs(camera["K"][0][0] - true_camera["K"][0][0]), float(std[0]), "px")
    handeye, true_handeye = read_document(workspace.calib("handeye.yaml"), "handeye"), _yaml(truth / "handeye.yaml")
    xi = se3.log(np.array(true_handeye["H_PC"]) @ se3.inv(np.array(handeye["H_PC"])))
    origin_m = np.array(true_handeye["H_PC"])[:3, 3] - np.array(handeye["H_PC"])[:3, 3]
    sigma = np.array(handeye["H_PC_covariance"])
    say(
        "camera in the panel, rotation",
        float(np.degrees(np.linalg.norm(xi[:3]))),
        float(np.degrees(np.sqrt(np.trace(sigma[:3, :3])))),
        "deg",
    )
    say(
        "camera in the panel, position",
        1e3 * float(np.linalg.norm(origin_m)),
        1e3 * float(np.linalg.norm(se3.origin_sigmas(np.array(handeye["H_PC"]), sigma))),
        "mm",
    )
    if handeye["clock_offset_s"] is not None:
        offset = abs(handeye["clock_offset_s"] - true_handeye["clock_offset_s"])
        say("clock offset", 1e3 * offset, 1e3 * handeye["clock_offset_std_s"], "ms")
    _compare_lights(workspace, truth, say)
    for path in sorted(truth.glob("objects/*.npz")):
        _compare_surface(workspace.folder / "surfaces" / path.stem, dict(np.load(path)), say)
    return lines, figures


def _compare_lights(workspace: Workspace, truth: Path, say: Any) -> None:
    calibration = read_calibration(workspace.calib("calibration.yaml"))
    points_C, true = read_field(truth / "field.csv")
    angles, ratios = [], []
    for light in calibration.lights:
        d_C, irradiance = light.field(points_C)
        true_d_C, true_irradiance = true[light.name]
        lit = true_irradiance > DARKEST * true_irradiance.max()
        angles.append(_angle_deg(d_C, true_d_C)[lit])
        ratios.append((irradiance.mean(axis=1) / true_irradiance)[lit])
    ratio = np.concatenate(ratios)
    stated_deg = float(np.degrees(np.sqrt(2 * np.mean([light.direction_std_rad**2 for light in calibration.lights]))))
    say("lights' direction, rms", float(np.sqrt(np.mean(np.concatenate(angles) ** 2))), stated_deg, "deg")
    error = ratio * ratio.sum() / np.sum(ratio**2) - 1
    say(
        "lights' irradiance, rms",
        100 * float(np.sqrt(np.mean(error**2))),
        100 * float(np.mean([light.intensity_std for light in calibration.lights])),
        "%",
    )


def _compare_surface(folder: Path, true: dict[str, Array], say: Any) -> None:
    if not (folder / "surface.npz").is_file():
        return
    surface = read_surface(folder)
    both = surface.mask & true["mask"].astype(bool)
    angle_deg = _angle_deg(surface.normals[both].astype(float), true["normals"][both].astype(float))
    stated = float(np.median(np.sqrt(2) * surface.normal_std_deg[both]))
    say(f"{folder.name}: normals, median", float(np.nanmedian(angle_deg)), stated, "deg")
    scale = [piece.scale_std * piece.mean_depth_m for piece in surface.components]
    error_m = np.abs(surface.depth[both] - true["depth"][both])
    say(f"{folder.name}: depth, median", 1e3 * float(np.nanmedian(error_m)), 1e3 * max(scale, default=float("nan")), "mm")


def _angle_deg(a: Array, b: Array) -> Array:
    return np.asarray(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.sum(a * b, axis=-1))))


def _yaml(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))
    return found

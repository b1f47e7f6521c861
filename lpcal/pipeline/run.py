"""The chain on one page.

::

board images             -> K, H_CB        intrinsics
mocap, H_CB              -> H_OP, H_PC     handeye
wings, H_PC, H_PD        -> H_CL drawn     wings       H_CL = (H_OP H_PC)^-1 H_OL
spheres, H_CL drawn      -> H_CL           refine
all of it                -> calibration    export
captures, calibration    -> surfaces       reconstruct
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lpcal.errors import InputError, LpcalError
from lpcal.formats.panel_yaml import FILE_NAME
from lpcal.pipeline import export, handeye, intrinsics, reconstruct, refine, report, wings
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.outcome import Outcome, Progress

CHAIN: tuple[Stage, ...] = (intrinsics.STAGE, handeye.STAGE, wings.STAGE, refine.STAGE, export.STAGE)


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
    """Run one stage after whatever it rests on; what comes before it and was out of date is told on top.

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

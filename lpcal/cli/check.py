"""``lpcal check [mocap.csv]``: before any solve, what is wrong with mocap and images, with the key or the command that corrects it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.errors import LpcalError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.pipeline.handeye_inputs import HandEyeInputs
    from lpcal.pipeline.workspace import Workspace


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """A recording in place of ``mocap.file``."""
    parser.add_argument(
        "recording", nargs="?", type=Path, metavar="MOCAP", help="the motion-capture recording, in place of mocap.file of panel.yaml"
    )
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Look at the data; the exit code is that of the first thing that is wrong, 0 where nothing is.

    Raises
    ------
    LpcalError
        The data cannot be read.
    """
    from lpcal.api.handeye_check import check_handeye
    from lpcal.formats.record_documents import document_of
    from lpcal.pipeline.distance import list_pixels
    from lpcal.pipeline.handeye_inputs import gather, section_of, with_recording

    workspace = with_recording(open_workspace(options), options.recording)
    given, section = gather(workspace, progress), section_of(workspace)
    body = given.H_OP if given.stream is None else given.stream
    assert body is not None
    stated = section.clock_offset
    found = check_handeye(
        body,
        given.boards,
        clock_offset_s=None if given.stream is None or stated == "estimate" else float(stated),
        carries=section.carries,
        inverted=section.direction == "H_PO",
    )
    said, strange = list_pixels(workspace, given.boards)
    wrong = [*(_in_the_rig(error, workspace) for error in found.wrong), *strange]
    notes = found.notes if given.stream is not None else (*found.notes[:1], *(("", note) for note in given.notes), *found.notes[1:])
    name = section.file if section.poses is None else section.poses
    recognised = ("format", f"{name} read as: {given.format}")
    lines = [f"{topic:<12}{text}" for topic, text in (*_boards(given), recognised, *notes, *said)]
    for error in wrong:
        lines += [f"WRONG       {line}" if k == 0 else f"          {line}" for k, line in enumerate(error.message().splitlines())]
    return Outcome(
        summary=lines if wrong else [*lines, "verdict     nothing wrong found"],
        document={"format": given.format}
        | document_of(found.figures)
        | {"wrong": [{"message": error.message(), "exit_code": error.exit_code, "do": error.todo} for error in wrong]},
        warnings=list(found.warnings),
        next_command=None if wrong else "lpcal handeye",
        exit_code=wrong[0].exit_code if wrong else 0,
    )


def _in_the_rig(error: LpcalError, workspace: Workspace) -> LpcalError:
    """The error with the place in panel.yaml where the argument that it names is stated."""
    from lpcal.api.handeye_check import CLOCK_OFFSET

    if error.where != CLOCK_OFFSET:
        return error
    return type(error)(
        error.found, where=workspace.rig_file.where("mocap.clock_offset"), needed=error.needed, todo="write clock_offset: estimate"
    )


def _boards(given: HandEyeInputs) -> list[tuple[str, str]]:
    """How many views show the board, and which do not."""
    from lpcal.api.handeye_check import NAMED

    said = [("boards", f"found in {len(given.boards.images)} of {len(given.images)} views")]
    without = given.without_board | given.without_pose
    for why in dict.fromkeys(without.values()):
        images = [image for image, reason in without.items() if reason == why]
        more = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
        said.append(("", f"{len(images)} without: {why}: {', '.join(images[:NAMED])}{more}"))
    return said

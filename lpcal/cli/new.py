"""``lpcal new``: a rig folder to start from."""

from __future__ import annotations

import argparse
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from lpcal.errors import InputError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.records.rig import Rig


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("folder", type=Path, metavar="DIR", help="the folder to start; a panel.yaml that is there is never overwritten")
    parser.add_argument(
        "--from",
        dest="origin",
        metavar="RIG",
        help="a bundled rig's name, mocap, rti, rti-with-ball, or a panel.yaml or its folder (default: lightpanel-6)",
    )


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001
    """Copy the panel.yaml and make the folders that it names."""
    from lpcal.formats.bundled import DEFAULT_RIG, rig_names, start_file, start_names
    from lpcal.formats.outputs import write_text
    from lpcal.formats.panel_yaml import FILE_NAME, read_rig

    origin = read_rig(start_file(options.origin))
    target = options.folder / FILE_NAME
    if target.exists() or (options.folder.exists() and not options.folder.is_dir()):
        found = "is there already" if target.exists() else "is a file"
        raise InputError(found, where=str(target if target.exists() else options.folder), needed="a new folder", todo="name another folder")
    write_text(target, origin.file.read_text(encoding="utf-8"))
    folders = _folders(origin.rig)
    for name in folders:
        (options.folder / name).mkdir(parents=True, exist_ok=True)
    known = [*rig_names(), *start_names()]
    beside = _samples(origin.file.parent) if options.origin in known else []
    for sample in beside:
        place = options.folder / sample.relative_to(origin.file.parent)
        if not place.exists():
            place.parent.mkdir(parents=True, exist_ok=True)
            write_text(place, sample.read_text(encoding="utf-8"))
    summary = [
        f"{target}: a copy of {options.origin or DEFAULT_RIG}; edit it to your rig",
        *(f"  {options.folder / name}/" for name in folders),
        *(f"  {options.folder / sample.relative_to(origin.file.parent)}: a sample" for sample in beside),
        f"then: {'; '.join(_todo(origin.rig, numbered=any(sample.name == 'capture.yaml' for sample in beside)))}",
        f"other rigs to start from: {', '.join(name for name in known if name != (options.origin or DEFAULT_RIG))}",
    ]
    document = {"panel": str(target), "folders": [str(options.folder / name) for name in folders], "rigs": known}
    first = "lpcal intrinsics" if origin.rig.camera and origin.rig.camera.images else "lpcal run"
    board = " && lpcal board" if origin.rig.board else ""
    return Outcome(summary, document, next_command=f"cd {options.folder}{board}; after the images are there, {first}")


def _samples(folder: Path) -> list[Path]:
    """What lies beside a bundled panel.yaml: samples of tables, and captures' capture.yaml."""
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.name != "panel.yaml")


def _folders(rig: Rig) -> list[str]:
    """The folders that a rig's images go to, each once; those that lead out of the rig are the user's own."""
    patterns = rig.camera.images if rig.camera else []
    named = [PurePosixPath(pattern).parent for pattern in patterns]
    named += [PurePosixPath(csv).with_suffix("") for csv in (rig.mocap.images[1:] if rig.mocap else [])]
    named += [PurePosixPath(sphere.images) for sphere in rig.spheres.values()] + [PurePosixPath(name) for name in rig.objects.values()]
    inside = [path for path in named if path.parts and not path.is_absolute() and ".." not in path.parts and "*" not in str(path)]
    return list(dict.fromkeys(path.as_posix() for path in inside))


def _todo(rig: Rig, *, numbered: bool) -> list[str]:
    """What goes where, in words; `numbered` where a capture.yaml takes photographs by their order."""
    todo = []
    if rig.camera and rig.camera.images:
        todo.append(f"board views as {', '.join(rig.camera.images)}")
    if rig.mocap and (rig.mocap.file or rig.mocap.poses):
        times = f" with {', '.join(rig.mocap.images)}" if rig.mocap.images else ""
        todo.append(f"the recorded poses as {rig.mocap.file or rig.mocap.poses}{times}")
    if rig.camera and rig.camera.flat_field:
        todo.append(f"a white card, evenly lit, as {rig.camera.flat_field}, or leave the line flat_field out")
    if rig.spheres or rig.objects:
        names = "in the lights' order, named as capture.yaml there says" if numbered else f"{', '.join(list(rig.lights)[:2])}, ..."
        todo.append(f"for every sphere and object one image a light ({names}) and ambient, in its folder")
    return todo or ["fill in the sections that you need"]

"""``lpcal reconstruct``: normals, albedo, depth and mesh of captures."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.engine_words import add_on, begin_early, engine_of_words, jobs_of
from lpcal.cli.rig_option import add_rig_option, length, open_workspace
from lpcal.errors import InputError, UsageError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.pipeline.workspace import Workspace
    from lpcal.records.sensor import StatedSensor
    from lpcal.segmentation.mask import Hints


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("captures", nargs="*", type=Path, metavar="CAPTURE", help="capture folders (default: all objects of the rig)")
    parser.add_argument("-c", "--calibration", type=Path, help="calibration.yaml (default: calib/calibration.yaml of the rig)")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="where to (default: surfaces/<object> of the rig)")
    parser.add_argument("--mask", default="auto", metavar="auto|none|FILE", help="which pixels are the object (default: auto)")
    parser.add_argument("--box", metavar="X,Y,W,H", help="a box in pixels that holds the object, where the automatic mask errs")
    parser.add_argument("--point", action="append", default=[], metavar="X,Y", help="a pixel that shows the object; may be repeated")
    parser.add_argument("--keep", choices=("object", "support", "all"), default="object", help="what to reconstruct of what is found")
    parser.add_argument("--lights", choices=("near", "distant"), default="near", help="how lights act (default: near, where known)")
    parser.add_argument("--method", metavar="NAME", help="a method to compare with: least-squares, l1, ranks (default: lpcal's own)")
    parser.add_argument("--integrator", default="lpcal", metavar="NAME", help="with --method: lpcal, poisson, cosines (default: lpcal)")
    parser.add_argument("--distance", metavar="LENGTH", help="median distance of the object where it is known, such as 352mm")
    parser.add_argument("--gamma", metavar="G", help="stored = linear^(1/G), or srgb for photographs, where nothing else states it")
    parser.add_argument("--black-level", metavar="SHARE", help="the stored number of no light, of full scale, such as 0.8%%")
    parser.add_argument("--white-level", metavar="SHARE", help="the stored number at which the sensor saturates, of full scale")
    parser.add_argument(
        "--arrangement",
        choices=("auto", "stated"),
        default="auto",
        help="whether images that fit their lights better in another order, or turned, are refused (auto) or taken as they are",
    )
    parser.add_argument("--use", metavar="L0,L3", help="take only these lights")
    parser.add_argument(
        "--mesh-frame",
        choices=("camera", "placed"),
        default="camera",
        help="meshes in the camera's frame, or where capture.yaml places them: in the room, or in the body that the object rides on",
    )
    parser.add_argument("--outputs", metavar="WORDS", help="which files beside summary.json, such as normals,depth,ply (default: all)")
    parser.add_argument("--no-pages", action="store_true", help="no relight.html")
    parser.add_argument(
        "--jobs",
        metavar="N",
        help="cores: of one capture those that share its work (default: all), of many the captures worked on at a time "
        "(default: one after the other; with --on, every processor); the result is the same with any number",
    )
    add_on(parser)
    parser.add_argument("--anew", action="store_true", help="do again what stands and is up to date")
    add_rig_option(parser)


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Do it."""
    jobs = jobs_of(options.jobs)
    begin_early(options.on, jobs, len(options.captures))
    from lpcal.pipeline.many import reconstruct_all
    from lpcal.pipeline.reconstruct import Wishes, calibration_of, capture_tasks, rig_tasks

    wishes = Wishes(
        near=options.lights == "near",
        method=None if options.method == "lpcal" else options.method,
        integrator=options.integrator,
        distance_m=length(options.distance),
        mask=options.mask,
        sensor=_sensor(options),
        hints=_hints(options),
        keep=options.keep,
        use=tuple(name.strip() for name in options.use.split(",") if name.strip()) if options.use else None,
        outputs=_outputs(options.outputs, pages=not options.no_pages),
        jobs=jobs,
        placed_mesh=options.mesh_frame == "placed",
        arrangement=options.arrangement,
    )
    if not options.captures:
        rig: Workspace | None = open_workspace(options)
        tasks = rig_tasks(rig, options.output) if rig else []
    else:
        rig = _rig_if_any(options)
        tasks = capture_tasks(options.captures, rig, options.output)
    engine = engine_of_words(options.on, wishes.jobs, tasks[0].target.parent) if len(tasks) > 1 else None
    return reconstruct_all(tasks, calibration_of(rig, options.calibration), wishes, progress, rig, engine=engine, anew=options.anew)


def _outputs(text: str | None, *, pages: bool) -> tuple[str, ...]:
    """The files that are asked for, by their words."""
    from lpcal.formats.surface_files import OUTPUTS

    found = list(OUTPUTS) if text is None else [word.strip() for word in text.split(",") if word.strip()]
    strange = [word for word in found if word not in OUTPUTS]
    if strange or not found:
        what = f"no output is called {', '.join(strange)}" if strange else "no word"
        raise UsageError(what, where="--outputs", needed=f"some of {','.join(OUTPUTS)}", todo="write for example normals,depth")
    return tuple(word for word in OUTPUTS if word in found and (pages or word != "page"))


def _sensor(options: argparse.Namespace) -> StatedSensor:
    """What the words say of the sensor."""
    from lpcal.records.quantities import parse, parse_gamma
    from lpcal.records.sensor import StatedSensor

    try:
        gamma = None if options.gamma is None else parse_gamma(options.gamma)
    except ValueError as error:
        found, _, needed = str(error).partition("; ")
        raise UsageError(f"--gamma {found}", needed=needed, todo="write for example 2.2") from error
    levels = []
    for name, text in (("--black-level", options.black_level), ("--white-level", options.white_level)):
        try:
            levels.append(None if text is None else parse(text, "share"))
        except ValueError as error:
            raise UsageError(str(error), where=name, needed="a share of full scale such as 0.8%") from error
    return StatedSensor(gamma, levels[0], levels[1])


def _hints(options: argparse.Namespace) -> Hints:
    """Where the object is, by the words of the command."""
    from lpcal.segmentation.mask import Hints

    box = None if options.box is None else _whole_numbers(options.box, "--box", 4)
    if box is not None and (min(box[:2]) < 0 or min(box[2:]) < 1):
        raise UsageError(f"{options.box} holds no pixel", where="--box", needed="x, y >= 0 and width, height >= 1 in pixels")
    points = tuple(_whole_numbers(text, "--point", 2) for text in options.point)
    return Hints(None if box is None else (box[0], box[1], box[2], box[3]), tuple((x, y) for x, y in points))


def _whole_numbers(text: str, where: str, count: int) -> tuple[int, ...]:
    """So many whole numbers with commas between them."""
    example = "120,80,400,300" if count == 4 else "320,240"
    try:
        found = tuple(int(part) for part in text.split(","))
    except ValueError as error:
        raise UsageError(f"{text} is not {count} whole numbers", where=where, needed=f"pixels such as {example}") from error
    if len(found) != count:
        raise UsageError(f"{text} is not {count} whole numbers", where=where, needed=f"pixels such as {example}")
    return found


def _rig_if_any(options: argparse.Namespace) -> Workspace | None:
    """The rig, or None where a calibration is given and no rig is near."""
    try:
        return open_workspace(options)
    except InputError:
        if options.calibration is None or options.rig != Path():
            raise
        return None

"""``lpcal simulate``: a synthetic rig folder with its truth."""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from lpcal.cli.engine_words import add_engine_words, engine_of_words, jobs_of
from lpcal.errors import UsageError
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("folder", type=Path, metavar="DIR", help="the folder to make; it must be new or empty")
    parser.add_argument("--rig", metavar="R", help="a panel.yaml, its folder, or a bundled rig's name (default: lightpanel-6)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="another number, another rig (default 1)")
    parser.add_argument("--size", default="640x400", metavar="WxH", help="the camera's image size (default 640x400)")
    parser.add_argument("--stations", type=int, default=22, metavar="N", help="board views (default 22)")
    parser.add_argument(
        "--session", type=int, default=0, metavar="N", help="a robot's path round an object too: captures at N stops, 4 to 400, in session/"
    )
    parser.add_argument("--object", metavar="NAME", help="the object of the session: bust (default), pair, vase, knot, stone or beast")
    parser.add_argument("--count", type=int, default=0, metavar="N", help="so many rigs, of seeds one after the other: DIR/seed_0001, ...")
    add_engine_words(parser, "of --count, rigs")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Simulate a rig."""
    from lpcal.formats.bundled import rig_file
    from lpcal.formats.panel_yaml import read_rig
    from lpcal.pipeline.simulate import simulate
    from lpcal.simulate.recipe import Recipe
    from lpcal.simulate.tour import SHAPES

    size = re.fullmatch(r"(\d+)x(\d+)", options.size)
    if not size or min(int(n) for n in size.groups()) < 120 or max(int(n) for n in size.groups()) > 8192:
        raise UsageError(f"--size {options.size}", needed="width x height in pixels, 120 to 8192 each", todo="write for example 640x400")
    if options.stations < 4 or options.seed < 0:
        raise UsageError(f"--stations {options.stations} --seed {options.seed}", needed="at least 4 stations, a seed of 0 or more")
    if options.session and not 4 <= options.session <= 400:
        raise UsageError(f"--session {options.session}", needed="4 to 400 stops", todo="write for example 16")
    if options.object is not None and options.object not in SHAPES:
        raise UsageError(f"--object {options.object}", needed=f"one of {', '.join(SHAPES)}", todo="correct it")
    if options.object is not None and not options.session:
        raise UsageError("--object without --session", needed="the number of stops round the object", todo="write for example --session 16")
    if options.count < 0 or (not options.count and (options.on or options.jobs)):
        raise UsageError(f"--count {options.count}", needed="one rig or more, with --jobs or --on", todo="write for example --count 20")
    recipe = Recipe(seed=options.seed, image_size=(int(size[1]), int(size[2])), stations=options.stations)
    rig = read_rig(rig_file(options.rig))
    stops, item = options.session, options.object or "bust"
    if not options.count:
        return simulate(rig, options.folder, recipe, progress, stops=stops, item=item)
    from lpcal.pipeline.simulate_many import simulate_many

    engine = engine_of_words(options.on, jobs_of(options.jobs), options.folder)
    return simulate_many(rig, options.folder, recipe, options.count, progress, engine=engine, stops=stops, item=item)

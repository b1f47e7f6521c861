"""The table of commands and the one error boundary. Only the chosen command's module is imported.

``--verbose`` and ``--log FILE``: what the stages log under the name ``lpcal``, on stderr and in a file.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import sys
from collections.abc import Container, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, cast

from lpcal import __version__
from lpcal.cli.console import complain, open_streams, progress_bars, show
from lpcal.cli.freed_memory import keep as keep_freed_memory
from lpcal.cli.stops import Stopped, received, say_stopped
from lpcal.errors import InputError, LpcalError, UsageError

if TYPE_CHECKING:  # records are dataclasses, whose import costs as much as all the rest of `lpcal --help`
    import logging

    from lpcal.records.outcome import Outcome, Progress

COMMANDS = {
    "demo": "run the whole chain on the bundled rig: calibration, report, reconstruction, mesh, relighting page",
    "new": "start a rig folder from one of the bundled rigs",
    "board": "the printable calibration target at true scale",
    "design": "wing settings for a working distance, and what the LightBlobs give there",
    "intrinsics": "camera.yaml, camera.cameramodel and H_CB.yaml from images of the board",
    "check": "before any solve: what is wrong with these data, in words",
    "handeye": "handeye.yaml: the camera in the tracked body (H_PC), the board in the room (H_OB), the clock offset",
    "wings": "wings.yaml: every light as designed, with the covariance of the tolerances",
    "distance": "distance.yaml: the beam of the panel's distance sensor, of its readings on the board",
    "refine": "lights.yaml: the lights refined from images of spheres, with the wings as prior",
    "export": "calibration.yaml, the product, from whatever stages are up to date",
    "reconstruct": "normals, albedo, depth and mesh of a capture",
    "fuse": "one model of surfaces whose captures are placed in the room",
    "integrate": "depth and mesh of a normal map from elsewhere",
    "evaluate": "a surface compared with the truth: angles of the normals, differences of the depth",
    "diff": "has my rig moved: two calibrations, light by light, each change with its sigma",
    "import": "a calibration from other systems' files",
    "field": "the calibrated light field at given points",
    "report": "calib/report.html, one file, opens offline",
    "study": "the two experiments of the LightPanel paper: phase angle, ambient light",
    "simulate": "a synthetic rig folder with its truth",
    "mark": "a sphere, a mask, a board's corners or the lights of images set by mouse, where they are not found automatically",
    "frames": "the frames of a video as images, with the table of their times",
    "watch": "while one captures: each new image judged, and what comes next",
    "run": "every stage that is out of date, in order",
    "completion": "completion of commands, options and file names for bash, zsh or fish",
}
LIBRARIES = ("numpy", "scipy", "opencv-contrib-python-headless", "mrcal", "casadi", "pycolmap")
# many small matrices: threads of the linear algebra cost more than they bring; set before numpy is imported, the user's setting wins
for _variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")
os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # it would read the metadata of every package that is installed

BUG = 1
USAGE = 2
YOUNG_OBJECTS = 300_000
"""New objects after which unreachable cycles are looked for: Python's 2,000 have it look a hundred times while modules are imported."""


class Command(Protocol):
    """What the module of a command holds."""

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command's own words."""

    def run(self, options: argparse.Namespace, progress: Progress) -> Outcome:
        """Do it."""


def main(words: list[str] | None = None) -> int:
    """Run one command; the exit code is that of the error (docs/errors.md)."""
    words = sys.argv[1:] if words is None else words
    gc.set_threshold(YOUNG_OBJECTS)
    open_streams()
    try:
        try:
            options, command = _parse(words)
        except (SystemExit, BrokenPipeError) as end:  # help and versions end there
            return _ended(end)
        keep_freed_memory()
        with logged(options), progress_bars(quiet=options.quiet) as progress, ExitStack() as options.until_done:
            outcome = command.run(options, progress)
        return _said(outcome, as_json=options.json)
    except LpcalError as error:
        complain(f"lpcal: {error}")
        return error.exit_code
    except KeyboardInterrupt as stop:
        return say_stopped(stop)
    except (OSError, MemoryError) as error:  # what the system refuses is the user's to correct
        return say_stopped(Stopped(received[0])) if received else _refused(error)
    except Exception as error:  # noqa: BLE001 - the boundary: whatever is left is a bug of lpcal's
        if received:
            return say_stopped(Stopped(received[0]))
        if type(error).__name__ == "LinAlgError":  # numpy's, which is not imported here
            return _refused_singular(error)
        import shlex
        import traceback

        traceback.print_exc()
        complain(f"lpcal {__version__}: this is a bug of lpcal; please report the lines above and the command: lpcal {shlex.join(words)}")
        return BUG


def _ended(end: SystemExit | BrokenPipeError) -> int:
    """Leave as help, versions and wrong words do; quietly where whoever read them has left, as `| head` does."""
    try:
        if isinstance(end, BrokenPipeError):
            raise end
        sys.stdout.flush()
    except BrokenPipeError:
        _into_nothing()
        return 0
    raise end


def _into_nothing() -> None:
    """Drop what is still to be printed, or the interpreter complains once more at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _said(outcome: Outcome, *, as_json: bool) -> int:
    """Print the outcome; its exit code. Whoever read the summary may have left, as `| head` does; the work is done all the same."""
    try:
        show(outcome, as_json=as_json)
        sys.stdout.flush()
    except OSError as error:
        _into_nothing()
        if not isinstance(error, BrokenPipeError):
            complain(f"lpcal: the work is done, but its summary cannot be written to stdout: {error.strerror}")
            return outcome.exit_code or InputError.exit_code
    return outcome.exit_code


def _refused_singular(error: Exception) -> int:
    """Say that the data leave an unknown open which no stage has looked for; the exit code of data that determine too little."""
    from lpcal.api.staged import undetermined

    said = undetermined(error)
    complain(f"lpcal: {said}")
    return said.exit_code


def _refused(error: OSError | MemoryError) -> int:
    """Say what the system refused; the exit code of an input that cannot be used."""
    if isinstance(error, MemoryError):
        said = InputError("not enough memory", needed="inputs that fit into it", todo="take fewer or smaller images")
    else:
        said = InputError(error.strerror or str(error), where=str(error.filename or ""), todo="correct that, or name another place")
    complain(f"lpcal: {said}")
    return said.exit_code


def parser_of(commands: Container[str]) -> tuple[argparse.ArgumentParser, dict[str, Command]]:
    """The parser, with the words of some of the commands, and those commands' modules: only they are imported."""
    parser = argparse.ArgumentParser(
        prog="lpcal",
        description="Calibrates a camera-and-light panel and rebuilds surfaces with it.",
        epilog="Exit codes: 0 done; 1 a bug; 2 usage; 3 an input is missing or unreadable; 4 too few or degenerate data; "
        "5 no convergence, or the quality gate failed; 6 inputs disagree; 130 interrupted (128 + n by signal n).",
    )
    parser.add_argument("--version", action=_Versions, nargs=0, help="the versions of lpcal and of the libraries that it calls, then leave")
    subparsers = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    modules: dict[str, Command] = {}
    for name, line in COMMANDS.items():
        subparser = subparsers.add_parser(name, help=line, description=sentence(line))
        if name in commands:
            modules[name] = cast("Command", importlib.import_module(f"lpcal.cli.{name.replace('import', 'import_')}"))
            modules[name].add_arguments(subparser)
            add_log_options(subparser)
    return parser, modules


def sentence(line: str) -> str:
    """A command's line as a sentence; one that begins with a file's name keeps it as it is."""
    return (line if "." in line.split(maxsplit=1)[0] else line[0].upper() + line[1:]) + "."


def _parse(words: list[str]) -> tuple[argparse.Namespace, Command]:
    chosen = next((word for word in words if not word.startswith("-")), None)
    parser, modules = parser_of({chosen} if chosen else ())
    if chosen is not None and not modules:
        _refuse_unknown(chosen)
    if not words:
        parser.print_help(sys.stderr)
        parser.exit(USAGE)
    options, unknown = parser.parse_known_args(words)
    if unknown:
        _refuse_options(parser, chosen, unknown)
    if not modules:  # argparse has already ended the run for an unknown or missing command
        parser.error("no command")
    return options, modules[options.command]


def _refuse_unknown(word: str) -> None:
    """Say that there is no such command, and which may be meant.

    Raises
    ------
    UsageError
    """
    from difflib import get_close_matches

    near = get_close_matches(word.lower(), COMMANDS, n=3)
    todo = f"did you mean {' or '.join(f'lpcal {name}' for name in near)}?" if near else "lpcal --help lists them"
    raise UsageError(f"no command is called {word}", needed=f"one of {', '.join(COMMANDS)}", todo=todo)


def _refuse_options(parser: argparse.ArgumentParser, command: str | None, unknown: list[str]) -> None:
    """End as argparse does for words that a command does not know, with the options that may be meant."""
    from difflib import get_close_matches

    subparsers = next(action for action in parser._actions if isinstance(action, argparse._SubParsersAction))  # noqa: SLF001
    owner = subparsers.choices.get(command or "", parser)
    known = [word for action in owner._actions for word in action.option_strings]  # noqa: SLF001
    near = [one for word in unknown if word.startswith("--") for one in get_close_matches(word.partition("=")[0], known, n=2)]
    owner.error(f"unrecognized arguments: {' '.join(unknown)}" + (f"; did you mean {' or '.join(dict.fromkeys(near))}?" if near else ""))


class _Versions(argparse.Action):
    """Prints versions from the packages' metadata: none of them is imported."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print and leave."""
        from importlib.metadata import PackageNotFoundError, version

        from lpcal.kernels.library import who_works

        print(f"lpcal {__version__}")  # noqa: T201
        for name in LIBRARIES:
            try:
                print(f"{name} {version(name)}")  # noqa: T201
            except PackageNotFoundError:
                print(f"{name} is not installed")  # noqa: T201
        print(f"kernels {who_works()}")  # noqa: T201
        parser.exit()


if __name__ == "__main__":
    sys.exit(main())


MARK = "# lpcal's log\n"
"""The first line of a log, by which lpcal knows one that it may write on."""


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Declare the words that every command takes."""
    parser.add_argument("--json", action="store_true", help="print one JSON document instead of the summary")
    loudness = parser.add_mutually_exclusive_group()
    loudness.add_argument("--quiet", action="store_true", help="no progress on stderr; warnings and errors stay")
    loudness.add_argument("--verbose", action="store_true", help="what each stage does, and how long it takes, on stderr")
    parser.add_argument("--log", type=Path, metavar="FILE", help="write that into a file too, with times, after what stands there")


@contextmanager
def logged(options: argparse.Namespace) -> Iterator[None]:
    """Hand what is logged to where the command's words want it.

    Raises
    ------
    UsageError, InputError
        The file is no log of lpcal's, or cannot be written.
    """
    if not options.verbose and options.log is None:
        yield
        return
    import logging

    handlers: list[logging.Handler] = []
    if options.verbose:
        console = logging.StreamHandler()
        console.addFilter(lambda record: record.levelno < logging.WARNING)  # warnings are said at the end, by the command
        console.setFormatter(logging.Formatter("%(message)s"))
        handlers.append(console)
    if options.log is not None:
        handlers.append(_file(options.log))
    logger = logging.getLogger("lpcal")
    before = logger.level
    logger.setLevel(logging.DEBUG)
    for handler in handlers:
        logger.addHandler(handler)
    try:
        yield
    finally:
        for handler in handlers:
            logger.removeHandler(handler)
            handler.close()
        logger.setLevel(before)


def _file(path: Path) -> logging.Handler:
    import logging

    from lpcal.formats.outputs import marked, refuse_place

    refuse_place(path, marked("a log of lpcal's", MARK))
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or not path.stat().st_size:
        path.write_text(MARK, encoding="utf-8")
    handler = logging.FileHandler(path, encoding="utf-8")
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)-7s %(message)s"))
    return handler

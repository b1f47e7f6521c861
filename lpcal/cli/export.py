"""``lpcal export``: calibration.yaml, the product, and other systems' files."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.cli.rig_option import add_rig_option, open_workspace
from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "source",
        nargs="?",
        type=Path,
        metavar="SOURCE",
        help="panel.yaml or its folder, the same as --rig; with --format also any calibration, camera, handeye.yaml, lights or surface",
    )
    add_rig_option(parser)
    parser.add_argument("--format", action="append", metavar="F[,F]", help="write other systems' files; all: every one there is enough for")
    parser.add_argument("--list", action="store_true", help="every format: what it needs, what it keeps, what it loses; then leave")
    parser.add_argument("--capture", type=Path, metavar="CAPTURE", help="a capture folder, for formats that hold images")
    parser.add_argument("--surface", type=Path, metavar="SURFACE", help="a surface's folder, for meshes, depth maps and point clouds")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="where to (default: exchange in the rig's calib, else exchange)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Write calibration.yaml, running first what is out of date; or other systems' files."""
    from lpcal.errors import UsageError

    if options.list:
        from lpcal.pipeline.exchange import list_formats

        return list_formats()
    formats = [name.strip() for words in options.format or () for name in words.split(",") if name.strip()]
    if not formats:
        from lpcal.pipeline import export
        from lpcal.pipeline.run import run_stage

        if options.capture or options.surface or options.output:
            raise UsageError("no --format", needed="--format F[,F], or all", todo="lpcal export --list names them")
        return run_stage(open_workspace(options, options.source), export.STAGE, progress)
    from lpcal.pipeline.exchange import ExchangeWishes, export_file, export_rig

    wishes = ExchangeWishes(formats, options.capture, options.surface, options.output)
    if options.source is not None and not _is_rig(options.source):
        return export_file(options.source, wishes, progress)
    return export_rig(open_workspace(options, options.source), wishes, progress)


def _is_rig(source: Path) -> bool:
    """Whether a word names a rig: its folder, its panel.yaml, or one of any name."""
    if source.is_dir():
        return (source / "panel.yaml").is_file()
    if source.name == "panel.yaml":
        return True
    try:
        text = source.read_text(encoding="utf-8", errors="replace")[:65536]
    except OSError:
        return False
    return source.suffix in {".yaml", ".yml"} and text.lstrip().startswith("lpcal:") and "\nkind:" not in text

"""``lpcal evaluate``: a surface compared with the truth."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "surface", type=Path, metavar="SURFACE", help="a surface's folder, or another method's normals: .npz .npy .mat .png .tif"
    )
    parser.add_argument(
        "--truth",
        type=Path,
        required=True,
        metavar="FILE",
        help="true normals (.npz with normals, depth, mask; .npy .mat .png .tif), or a folder",
    )
    parser.add_argument("--mask", type=Path, metavar="FILE", help="which pixels count (default: all that both hold)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001
    """Compare them."""
    from lpcal.pipeline.diff import evaluate_files

    return evaluate_files(options.surface, options.truth, options.mask)

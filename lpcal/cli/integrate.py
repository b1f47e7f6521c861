"""``lpcal integrate``: depth and mesh of a normal map from elsewhere."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("normals", type=Path, metavar="NORMALS", help=".npz, .npy, .mat, .png or .tif; z towards the camera, or as in C")
    parser.add_argument("-c", "--calibration", type=Path, help="calibration or any camera file (default: parallel rays, depth in pixels)")
    parser.add_argument(
        "--green",
        choices=("auto", "as-is", "flipped"),
        default="auto",
        help="whether green is turned over: DirectX maps have it down (default: found by the curl)",
    )
    parser.add_argument("--integrator", default="lpcal", metavar="NAME", help="lpcal, poisson or cosines, to compare (default: lpcal)")
    parser.add_argument("--mask", type=Path, metavar="FILE", help="which pixels count (default: those that hold a normal)")
    parser.add_argument("--distance", metavar="LENGTH", help="median distance of the object, such as 352mm (default: the calibration's)")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="where to (default: surfaces/<name of the file>)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001
    """Do it."""
    from lpcal.cli.rig_option import length
    from lpcal.pipeline.reconstruct import integrate_file

    target = options.output or Path("surfaces") / options.normals.stem
    distance_m = length(options.distance)
    return integrate_file(options.normals, options.calibration, options.mask, target, distance_m, options.green, options.integrator)

"""What lpcal makes of inputs that people brought: ``python tools/case_table.py [--cases DIR] [--only 02-,13-]``.

Each record of `CASES` is one case of the cases' folder (beside the folder of ``LPCAL_DATA``, or DIR): the folder that is copied, what is
edited in the copy, the commands, the exit code that is right of the last one, and what is right to be said by then: words (a regular
expression), or a figure that is read from what was written and its bounds. Case 31 has a test of its own (tests/formats/test_documents.py).

A row each: case, commands, exit code, seconds of processor time, what was said or measured, right or not. Exit code 1 where one is not
right.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import yaml

Figure = Callable[[Path], tuple[float, str]]
"""Of a folder, what is measured in it and in what unit."""
IMPORT_LP, IMPORT_MAT = "import dome.lp -o d.yaml", "import cap/light.mat -o d.yaml"
RECONSTRUCT = "reconstruct cap -c d.yaml -o out"
HANDEYE = ("check", "handeye")
MOST_SAID = 110
BALL = 0.4
"""Radius of the balls of cases 01, 14 and 17 over the width of their images; their masks leave the outermost pixels out."""
SIMULATED = """lpcal: 1
name: robot
camera: {images: stations/*.png, black_level: 0.8 %}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
mocap: {poses: robot.csv}
"""


@dataclass(frozen=True)
class Case:
    """One input and what is right."""

    folder: str
    commands: tuple[str, ...]
    code: int = 0
    said: str = ""
    figure: Figure | None = None
    most: float = 0.0
    """The figure's upper bound."""
    edit: tuple[str, str] = ("", "")
    """Text of panel.yaml and what stands for it."""
    seconds: float = 600.0
    """Seconds of processor time, of the last command."""


def place(name: str, *mm: float) -> Figure:
    """How far the origin of a transform of handeye.yaml is from where it should be."""

    def measure(folder: Path) -> tuple[float, str]:
        H = np.array(yaml.safe_load((folder / "calib" / "handeye.yaml").read_text())[name])
        return float(np.linalg.norm(1e3 * H[:3, 3] - mm)), f"mm of {name} off"

    return measure


def focal(px: float) -> Figure:
    """How far fx is from a camera's."""

    def measure(folder: Path) -> tuple[float, str]:
        K = np.array(yaml.safe_load((folder / "calib" / "camera.yaml").read_text())["K"])
        return float(abs(K[0, 0] / px - 1) * 100), "% of fx off"

    return measure


def surface(folder: Path) -> dict[str, np.ndarray]:
    """What reconstruct wrote."""
    return dict(np.load(next((folder / "out").rglob("surface.npz"))))


def ball(folder: Path) -> tuple[float, str]:
    """Median angle of the normals to those of the ball in the mask."""
    found = surface(folder)
    mask = cv2.imread(str(folder / "cap" / "mask.png"), cv2.IMREAD_GRAYSCALE) > 0
    rows, columns = np.nonzero(mask)
    centre = np.array([columns.mean(), rows.mean()])
    radius = BALL * mask.shape[1]
    u, v = (np.arange(mask.shape[1]) - centre[0]) / radius, (np.arange(mask.shape[0]) - centre[1]) / radius
    x, y = np.meshgrid(u, v)
    inside = (x**2 + y**2 < 0.9) & np.isfinite(found["normals"]).all(axis=2)
    true = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=2)
    cosine = np.sum(true * found["normals"], axis=2)[inside]
    return float(np.median(np.degrees(np.arccos(np.clip(cosine, -1, 1))))), "deg median of the normals"


def bump(folder: Path) -> tuple[float, str]:
    """Percent by which the border of a bump on a plane at 200 mm is off."""
    depth = surface(folder)["depth"]
    border = np.concatenate([depth[2, 2:-2], depth[-3, 2:-2], depth[2:-2, 2], depth[2:-2, -3]])
    return float(abs(np.nanmedian(border) / 0.2 - 1) * 100), "% of 200 mm off"


def sigmas_of_truth(folder: Path) -> tuple[float, str]:
    """Of a simulated rig: the six numbers of H_PC, by its stated covariance, as one standard normal number."""
    from lpcal.formats.handeye_yaml import read_handeye
    from lpcal.geometry import se3

    found = read_handeye(folder / "calib" / "handeye.yaml")
    true = np.array(yaml.safe_load((folder / "truth" / "handeye.yaml").read_text())["H_PC"])
    e = se3.log(true @ se3.inv(found.H_PC))
    return float(np.sqrt(e @ np.linalg.solve(found.H_PC_covariance, e) / 6)), "sigmas rms of H_PC"


BASE = place("H_PC", -8.16, -8.35, -16.63)
ROBOT = place("H_PC", -71.70, 59.14, 29.25)
FIXED = place("H_OC", 1748.30, -1006.44, 1163.97)
ON_BODY = place("H_PB", 50.08, -40.39, 18.96)
CASES = (
    Case("01-gamma-jpeg-under-lp", (IMPORT_LP, RECONSTRUCT), 6, "not linear.*gamma"),
    Case("01-gamma-jpeg-under-lp", (IMPORT_LP, RECONSTRUCT + " --gamma srgb"), figure=ball, most=1.0),
    Case("02-board-or-camera-moved-midway/p1_board20mm_half", ("check",), 6, "the board moved between view_014.png and view_015.png"),
    Case("02-board-or-camera-moved-midway/p1_board20mm_half", ("handeye",), 6, "the board moved between view_014.png and view_015.png"),
    Case(
        "02-board-or-camera-moved-midway/p1_cam3deg_half", ("check",), 6, "the camera in its mount moved between view_014.png and view_01"
    ),
    Case(
        "02-board-or-camera-moved-midway/p1_cam3deg_half", ("handeye",), 6, "the camera in its mount moved between view_014.png and view_"
    ),
    Case("03-fixed-camera-tracked-board", HANDEYE, 0, "camera stands still in the room", FIXED, 1.0),
    Case("03-fixed-camera-tracked-board", HANDEYE, 0, "H_PB +board in", ON_BODY, 0.5, edit=(", direction: H_PO", "")),
    Case("03-fixed-camera-tracked-board", HANDEYE, 0, "H_OC", FIXED, 1.0, edit=("direction: H_PO", "carries: board")),
    Case("04-near_ps-parallel-axes/qq2_parallel_axes", (IMPORT_MAT, RECONSTRUCT), 0, "at 1|at 2", bump, 1.0),
    Case("04-near_ps-parallel-axes/qq3_noDir_mu0", (IMPORT_MAT, RECONSTRUCT), 0, "at 1|at 2", bump, 1.0),
    Case("05-near_ps-guessed-image-size", ("import light.mat -o d.yaml", RECONSTRUCT), 0, "at 1|at 2", bump, 1.0),
    Case("06-directx-normal-map/i2_dx", ("integrate n.png -o out",), 0, "green points down"),
    Case("07-clocks/d1_drift1000", HANDEYE, 0, r"\+1000 \+- \S+ ppm"),
    Case("07-clocks/n10_epoch", HANDEYE, 0, "", BASE, 0.5),
    Case("07-clocks/n10_epoch", ("check",), 0, "unlike epochs .images in Unix time"),
    Case("07-clocks/n10b_epoch_stated", HANDEYE, 0, "as given", BASE, 0.5),
    Case("07-clocks/n8_ns_times", HANDEYE, 0, "", BASE, 0.5),
    Case(
        "08-few-lost-poses-hide-one-axis/n13_oneaxis_lostzero",
        ("check",),
        4,
        "3 poses are the identity: lost(.|\n)*one axis only, about its z",
    ),
    Case("08-few-lost-poses-hide-one-axis/n13b_oneaxis_lostzero1", ("handeye",), 4, "one axis only, about its z"),
    Case("09-lost-body-written-as-pose/n4b_vicon_zeros_long", ("check",), 0, "lost in 1300 samples(.|\n)*spread by 16"),
    Case("09-lost-body-written-as-pose/n4b_vicon_zeros_long", HANDEYE, 0, "1300 samples are zeros", BASE, 1.4),
    Case("09-lost-body-written-as-pose/n5_frozen", HANDEYE, 0, "repeat the pose before them", BASE, 1.4),
    Case("11-like-parity-board-camera-rolled", ("check",), 0, "10 boards were found by their other end"),
    Case("11-like-parity-board-camera-rolled", HANDEYE, 0, "20 of 20 used"),
    Case("12-european-and-windows-text/m1_semicolon_decimal_comma", HANDEYE, 0, "", BASE, 0.5),
    Case("12-european-and-windows-text/m2_decimal_comma_unquoted", ("check",), 3, "decimal commas between commas"),
    Case("12-european-and-windows-text/m4_utf16", HANDEYE, 0, "", BASE, 0.5),
    Case("12-european-and-windows-text/m7_all_quoted", HANDEYE, 0, "", BASE, 0.5),
    Case("13-text-layouts-unknown/n1_space_header", HANDEYE, 0, "", BASE, 0.5),
    Case("13-text-layouts-unknown/n1d_rostopic_p", HANDEYE, 0, "times are ns", BASE, 0.5),
    Case("13-text-layouts-unknown/n2_trc", HANDEYE, 0, "4 markers made a body.*fit to 0.00 mm"),
    Case("14-hidden-files-and-names/c1_appledouble", ("intrinsics",), 0, "found in 18 of 18"),
    Case("14-hidden-files-and-names/l10_cp1252", (IMPORT_LP, RECONSTRUCT), figure=ball, most=0.3),
    Case("14-hidden-files-and-names/l13_quoted", (IMPORT_LP, RECONSTRUCT), figure=ball, most=0.3),
    Case("14-hidden-files-and-names/l14_unicode_nfd", (IMPORT_LP, RECONSTRUCT), figure=ball, most=0.3),
    Case("14-hidden-files-and-names/l8_case", (IMPORT_LP, RECONSTRUCT), figure=ball, most=0.3),
    Case("16-robot-poses/r12_dup_rows", ("check",), 6, "view_004.png stands in line 6 already"),
    Case("16-robot-poses/r2_kuka_abc", HANDEYE, 0, "taken as millimetres", ROBOT, 0.1),
    Case("16-robot-poses/r3_six_numbers", ("check",), 3, "a rotation that nothing names(.|\n)*mocap.rotation"),
    Case("16-robot-poses/r3_six_numbers", HANDEYE, 0, "", ROBOT, 0.1, edit=("robot.txt", "robot.txt, rotation: rotation_vector")),
    Case("16-robot-poses/r6_mm_named", HANDEYE, 0, "", ROBOT, 0.1),
    Case("17-float-tiff-of-large-numbers", (IMPORT_LP, RECONSTRUCT), 0, "4095 is taken as full scale", ball, 0.3),
    Case("19-paths/g6_raw", (IMPORT_LP, RECONSTRUCT), 3, "a camera's raw file"),
    Case("19-paths/n6_backslash", HANDEYE, 0, "", BASE, 0.5),
    Case("19-paths/v1_video", ("intrinsics",), 3, "is a video"),
    Case("19-paths/y_brackets [v2] ü", ("intrinsics",), 0, "found in 18 of 18"),
    Case("19-paths/y_folder", ("intrinsics",), 0, "found in 18 of 18"),
    Case("21-dark-noise-frames", ("intrinsics",), 4, "hardly any contrast", seconds=15),
    Case("32-board-with-cut-squares", ("intrinsics",), 0, "found in 6 of 6", focal(534.0), 0.5),
    Case("33-corner-count-hint", ("intrinsics",), 6, "28x17 inner corners.*asked for 24x17", seconds=15),
    Case("34-mocap-layouts", ("check",), 4, "0 markers of one body", edit=("qtm_15_unidentified_real.tsv", "qtm_unidentified.tsv")),
    Case("34-mocap-layouts", ("check",), 4, "2 poses in", edit=("qtm_15_unidentified_real.tsv", "comment_then_headerless.csv")),
    Case(
        "simulated, for 35",
        ("handeye",),
        0,
        "measures the board as 101.5",
        sigmas_of_truth,
        1.7,
        edit=("square: 25 mm", "square: 24.625 mm"),
    ),
)


def run(folder: Path, words: str) -> tuple[int, str, float]:
    """One command of lpcal's: exit code, all that it prints but its progress, seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run([sys.executable, "-m", "lpcal", *words.split()], cwd=folder, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    lines = [line for line in (ended.stdout + "\n" + ended.stderr).splitlines() if not re.search(r": \d+ of \d+$", line)]
    return ended.returncode, "\n".join(lines), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def prepared(case: Case, cases: Path, home: Path) -> Path:
    """A copy of the case's folder in `home`, edited; a rig is simulated for a case that comes without images."""
    folder = home / "case"
    if case.folder.startswith("simulated"):
        (home / "robot.yaml").write_text(SIMULATED)
        run(home, "simulate --rig robot.yaml --seed 7 --size 400x250 --stations 20 case")
        old, new = case.edit
        (folder / "panel.yaml").write_text((folder / "panel.yaml").read_text().replace(old, new))
        run(folder, "intrinsics")
        return folder
    shutil.copytree(cases / case.folder, folder, copy_function=shutil.copyfile)
    for path in (folder, *folder.rglob("*")):
        path.chmod(0o755 if path.is_dir() else 0o644)
    panel, (old, new) = folder / "panel.yaml", case.edit
    if old:
        panel.write_text(panel.read_text().replace(old, new))
    return folder


def judged(case: Case, cases: Path) -> tuple[int, float, str, bool]:
    """Exit code and seconds of the last command, what it said or what was measured, and whether that is right."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = prepared(case, cases, Path(temporary))
        code, said, seconds = 0, "", 0.0
        for words in case.commands:
            code, said, seconds = run(folder, words)
        found = re.search(case.said, said)
        right = code == case.code and found is not None and seconds < case.seconds
        line = next((line for line in said.splitlines() if case.said and re.search(case.said.split("(.|")[0], line)), "")
        measured = line.strip()[:MOST_SAID]
        if case.figure is not None and code == 0:
            value, unit = case.figure(folder)
            right = right and value < case.most
            measured = f"{value:.2f} {unit} (right: under {case.most:g}); {measured}".rstrip("; ")
        return code, seconds, measured or said.strip().splitlines()[0][:MOST_SAID], right


def main() -> int:
    """Print the table; 1 where a row is not right."""
    beside = Path(os.environ.get("LPCAL_DATA", "../shared/data")).parent / "cases"
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--cases", type=Path, default=beside)
    parser.add_argument("--only", default="", help="parts of cases' names, separated by commas")
    options = parser.parse_args()
    chosen = [case for case in CASES if not options.only or any(number in case.folder for number in options.only.split(","))]
    print("| case | commands | code | s | said or measured | right |\n|---|---|---|---|---|---|")
    wrong = 0
    for case in chosen:
        code, seconds, measured, right = judged(case, options.cases.resolve())
        wrong += not right
        edited = f" ({case.edit[0]} -> {case.edit[1] or 'nothing'})" if case.edit[0] else ""
        print(
            f"| {case.folder}{edited} | {'; '.join(case.commands)} | {code} | {seconds:.1f} | {measured} | {'yes' if right else 'NO'} |",
            flush=True,
        )
    print(f"{len(chosen) - wrong} of {len(chosen)} right")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

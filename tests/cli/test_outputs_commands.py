"""Every way in which a command's output could replace an input, a foreign file or folder, or a device: none does."""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from lpcal.formats.calibration_yaml import write_calibration
from lpcal.records.calibration import Calibration, Light
from lpcal.records.provenance import Provenance

type Run = Callable[..., tuple[int, str, str]]

PANEL = """lpcal: 1
camera: {images: boards/*.png}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
mocap: {file: mocap.csv, images: times.csv}
objects: {ball: ball, vase: vase}
"""
WAYS: dict[str, str] = {
    "the capture folder": "reconstruct ball -c c.yaml -o ball",
    "the capture folder by another way": "reconstruct ball -c c.yaml -o ./vase/../ball",
    "the capture folder through a link": "reconstruct ball -c c.yaml -o link_to_ball",
    "another capture": "reconstruct ball -c c.yaml -o vase",
    "the folder of all captures": "reconstruct ball -c c.yaml -o all",
    "the current folder": "reconstruct ball -c c.yaml -o .",
    "the folder above": "reconstruct ball -c c.yaml -o ..",
    "the root": "reconstruct ball -c c.yaml -o /",
    "a folder of the user's": "reconstruct ball -c c.yaml -o notes",
    "a surface with a file of the user's in it": "reconstruct ball -c c.yaml -o surface",
    "a photograph": "reconstruct ball -c c.yaml -o ball/L0.png",
    "the calibration": "reconstruct ball -c c.yaml -o c.yaml",
    "a device": "reconstruct ball -c c.yaml -o /dev/null",
    "a pipe": "reconstruct ball -c c.yaml -o fifo",
    "a link into nowhere": "reconstruct ball -c c.yaml -o nowhere",
    "two captures into one surface": "reconstruct vase all/vase -c c.yaml",
    "one of several into a folder of the user's": "reconstruct ball vase -c c.yaml -o several",
    "the mask": "reconstruct ball -c c.yaml --mask ball/mask.png -o ball/mask.png",
    "the points": "field c.yaml points.csv -o points.csv",
    "the calibration, by field": "field c.yaml points.csv -o c.yaml",
    "another csv": "field c.yaml points.csv -o mocap.csv",
    "a photograph, by field": "field c.yaml points.csv -o ball/L0.png",
    "a device, by field": "field c.yaml points.csv -o /dev/zero",
    "a folder, by field": "field c.yaml points.csv -o notes",
    "the imported file": "import dome.lp -o dome.lp",
    "the rig file": "import dome.lp -o panel.yaml",
    "a note": "import dome.lp -o notes/note.txt",
    "a link to the rig file": "import dome.lp -o link_to_panel",
    "the normal map": "integrate normals.png -o normals.png",
    "the folder of the normal map": "integrate notes/normals.png -o notes",
    "the current folder, by integrate": "integrate normals.png -o .",
    "a photograph, by board": "board -o ball/L0.png",
    "the rig file, by board": "board -o panel.yaml",
    "another PDF": "board -o paper.pdf",
    "a table of the user's": "study ambient -o studies",
    "a folder with things in it, by simulate": "simulate notes",
    "the current folder, by simulate": "simulate .",
    "a file, by simulate": "simulate mocap.csv",
    "a folder with things in it, by demo": "demo notes",
    "the root, by demo": "demo /",
    "a rig, by new": "new .",
    "a file, by new": "new mocap.csv",
    "a camera of the user's in calib": "intrinsics",
    "a hand-eye of the user's in calib": "handeye",
    "a page of the user's in calib": "report",
    "a surface of the user's, by the rig": "reconstruct -c c.yaml",
}
"""What would be replaced, and the command that would do it."""


@pytest.fixture
def desk(tmp_path: Path) -> Path:
    """A folder as people have it: a rig, captures, notes, links, and one surface that the user has put a file into."""
    desk = tmp_path / "desk"
    for folder in ("ball", "vase", "all/vase", "notes", "boards", "several/ball", "calib", "studies", "surface", "surfaces/ball"):
        (desk / folder).mkdir(parents=True)
    for capture in ("ball", "vase", "all/vase"):
        for name in ("L0", "L1", "L2", "mask"):
            cv2.imwrite(str(desk / capture / f"{name}.png"), np.full((12, 16), 90, np.uint8))
    for name in ("normals.png", "notes/normals.png", "boards/v0.png"):
        cv2.imwrite(str(desk / name), np.full((12, 16, 3), (255, 128, 128), np.uint8))
    lights = tuple(
        Light(name=f"L{k}", direction_C=d / np.linalg.norm(d), intensity=np.ones(1))
        for k, d in enumerate(np.array([[0.3, 0, -1], [-0.2, 0.2, -1], [0, -0.3, -1.0]]))
    )
    write_calibration(desk / "c.yaml", Calibration("dome", lights), Provenance())
    texts = {
        "panel.yaml": PANEL,
        "mocap.csv": "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n",
        "times.csv": "file,time_s\nboards/v0.png,0\n",
        "points.csv": "x_m,y_m,z_m\n0,0,0.3\n",
        "dome.lp": "3\na 0.3 0 1\nb -0.2 0.2 1\nc 0 -0.3 1\n",
        "notes/note.txt": "the only copy",
        "several/ball/note.txt": "the only copy",
        "paper.pdf": "%PDF-1.4 not a board",
        "studies/study_ambient.csv": "years of work\n",
        "surface/summary.json": '{"kind": "surface"}',
        "surface/mesh_retouched.ply": "hours of work",
        "surfaces/ball/note.txt": "the only copy",
    } | {f"calib/{name}": "of the user's own" for name in ("camera.yaml", "camera.cameramodel", "H_CB.yaml", "handeye.yaml", "report.html")}
    for name, text in texts.items():
        (desk / name).write_text(text)
    os.mkfifo(desk / "fifo")
    for name, aim in {"link_to_ball": "ball", "link_to_panel": "panel.yaml", "nowhere": "absent"}.items():
        (desk / name).symlink_to(aim)
    return desk


def everything(folder: Path) -> dict[str, str]:
    """What each path of a folder is: where a link leads, the digest of a file."""
    found = {}
    for path in sorted(folder.rglob("*")):
        kind = f"link to {path.readlink()}" if path.is_symlink() else "folder" if path.is_dir() else "other"
        found[str(path.relative_to(folder))] = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else kind
    return found


@pytest.mark.parametrize("way", WAYS)
def test_nothing_is_replaced(desk: Path, lpcal: Run, way: str) -> None:
    before = everything(desk)
    code, out, err = lpcal(*WAYS[way].split(), cwd=desk)
    assert code in {2, 3}, err
    assert out == ""
    assert everything(desk) == before
    assert len(err) <= 600
    assert "Traceback" not in err


def test_what_lpcal_wrote_is_replaced(desk: Path, lpcal: Run) -> None:
    shutil.rmtree(desk / "calib")
    for command in (
        "field c.yaml points.csv -o field.csv",
        "import dome.lp -o new.yaml",
        "board -o board.pdf",
        "integrate normals.png -o flat",
    ):
        for _ in range(2):
            code, _, err = lpcal(*command.split(), cwd=desk)
            assert code == 0, err

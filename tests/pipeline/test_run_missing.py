"""``lpcal run`` with a file missing: the stage's own message and code, before anything is computed."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from lpcal.formats.bundled import rig_file, rig_names
from lpcal.formats.panel_yaml import read_rig
from lpcal.records.rig import Rig

type Run = Callable[..., tuple[int, str, str]]


def named(rig: Rig) -> dict[str, str]:
    """What a rig names: a path in its folder, and the command of the stage that reads it first."""
    found = {}
    if rig.camera:
        found |= {str(Path(pattern).parent): "intrinsics" for pattern in rig.camera.images}
        found |= {rig.camera.flat_field: "intrinsics"} if rig.camera.flat_field else {}
    if rig.mocap:
        found |= dict.fromkeys(rig.mocap.images, "intrinsics")
        found |= {"sweep/0.png": "intrinsics"} if len(rig.mocap.images) > 1 else {}
        found |= {name: "handeye" for name in (rig.mocap.file, rig.mocap.poses) if name}
    for capture in rig.spheres.values():
        found |= {capture.images: "refine", f"{capture.images}/L0.png": "refine"}
    return found | dict.fromkeys(rig.objects.values(), "reconstruct")


def populate(folder: Path, rig: Rig) -> None:
    """Every file that the rig names, none of which could be worked with: they are never looked at."""
    picture = cv2.imencode(".png", np.zeros((12, 16), np.uint8))[1].tobytes()
    captures = [sphere.images for sphere in rig.spheres.values()] + list(rig.objects.values())
    names = [f"{capture}/{light}.png" for capture in captures for light in [*rig.lights, "ambient"]]
    if rig.camera:
        names += [pattern.replace("*", "0") for pattern in rig.camera.images]
        names += [rig.camera.flat_field] if rig.camera.flat_field else []
    if rig.mocap and len(rig.mocap.images) > 1:
        names.append("sweep/0.png")
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(picture)
    if rig.mocap:
        for table, image in zip(rig.mocap.images, ("stations/0.png", "sweep/0.png"), strict=False):
            (folder / table).write_text(f"file,time_s\n{image},0\n")
        for name in (rig.mocap.file, rig.mocap.poses):
            if name:
                (folder / name).write_text("t_s,x_m,y_m,z_m,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n")


WAYS = [(rig, name, stage) for rig in rig_names() for name, stage in named(read_rig(rig_file(rig)).rig).items()]


@pytest.mark.parametrize(("rig", "name", "stage"), WAYS)
def test_run_answers_as_the_stage_does(tmp_path: Path, lpcal: Run, rig: str, name: str, stage: str) -> None:
    populate(tmp_path, read_rig(rig_file(rig)).rig)
    shutil.copy(rig_file(rig), tmp_path / "panel.yaml")
    lost = tmp_path / name
    shutil.rmtree(lost) if lost.is_dir() else lost.unlink()
    code, out, err = lpcal("run", cwd=tmp_path)
    assert (code, out) == (6 if name.endswith("L0.png") else 3, "")
    assert Path(name).name.removesuffix(".png") in err
    assert "\n  do: " in err
    assert "Traceback" not in err
    assert not (tmp_path / "calib").exists(), "nothing was begun"
    assert lpcal(stage, cwd=tmp_path) == (code, out, err)

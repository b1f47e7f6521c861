"""``lpcal fuse`` on surfaces in folders."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import lpcal as library
from fusion_views import scene
from lpcal.cli.main import main

pytest.importorskip("skimage")


def test_fuse(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Surfaces in, a model's folder out; again over it; what is no surface is an input that is missing."""
    monkeypatch.chdir(tmp_path)
    for surface in scene().surfaces[:3]:
        library.write_surface(tmp_path / "surfaces" / surface.name, surface)
    names = [f"surfaces/stop_0{k}" for k in range(3)]
    assert main(["fuse", *names, "-o", "model", "--json", "--step", "4mm"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["kind"] == "model"
    assert [view["used"] for view in told["views"]] == [True, True, True]
    assert {path.name for path in (tmp_path / "model").iterdir()} == {
        *("mesh.ply", "mesh.glb", "mesh.obj", "model.npz", "model.html", "summary.json")
    }
    (tmp_path / "session" / "stop_00").mkdir(parents=True)
    assert main(["fuse", "session/stop_00", "-o", "model"]) == 4  # the capture's surface is found; one alone is no model
    assert main(["fuse", "nothing", "-o", "model"]) == 3
    assert "no surface there" in capsys.readouterr().err
    assert main(["fuse", names[0], names[0], "-o", "model"]) == 6


def test_a_distance_that_was_put_right_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One view 6 % too far, by little more of its sigmas than right views are: on the screen, in summary.json and on the page."""
    off, sigmas = 0.06, 2.2
    for surface in scene().surfaces:
        one = surface
        if surface.name == "stop_04":
            component = replace(surface.components[0], scale_std=off / sigmas)
            one = replace(surface, depth=surface.depth * np.float32(np.exp(off)), components=(component,))
        library.write_surface(tmp_path / surface.name, one)
    folders = sorted(str(path) for path in tmp_path.glob("stop_*"))
    assert main(["fuse", *folders, "-o", str(tmp_path / "model"), "--step", "2.4mm"]) == 0
    told = capsys.readouterr()
    assert "mm, the median; most that of stop_04, by -" in told.out
    summary = json.loads((tmp_path / "model" / "summary.json").read_text(encoding="utf-8"))
    view = next(view for view in summary["views"] if view["name"] == "stop_04")
    assert view["distance_sigmas"] == pytest.approx(sigmas, abs=0.3)
    assert view["distance_change_m"] < -0.012
    page = (tmp_path / "model" / "model.html").read_text(encoding="utf-8")
    assert f"({view['distance_sigmas']:.1f} sigmas from the others" in page


@pytest.mark.parametrize(
    ("step", "said"),
    [
        ("5", "--step: a bare number, 5"),
        ("0mm", "--step: 0mm is not over zero"),
        ("0.1mm", "--step: edges of 0.1 mm\n  needed: 0.43 mm, a quarter of a pixel on the object"),
        ("50mm", "--step: edges of 50 mm\n"),
    ],
)
def test_edges_that_cannot_be(tmp_path: Path, capsys: pytest.CaptureFixture[str], step: str, said: str) -> None:
    """The option is named, and what it may be; a grid finer than pixels takes hours, one as coarse as the object has no surface."""
    for surface in scene().surfaces[:2]:
        library.write_surface(tmp_path / surface.name, surface)
    assert main(["fuse", str(tmp_path / "stop_00"), str(tmp_path / "stop_01"), "-o", str(tmp_path / "model"), "--step", step]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "model").exists()


def test_where_a_user_stands(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Started above the rig; without names, beside surfaces that are not placed; an object by its key; a folder of captures."""
    rig = tmp_path / "rig"
    rig.mkdir()
    (rig / "panel.yaml").write_text("lpcal: 1\nname: rig\nobjects: {cup: objects/2024-05-01}\n", encoding="utf-8")
    views = scene().surfaces[:3]
    for name, surface in zip(["stop_00", "stop_01", "cup"], views, strict=True):
        library.write_surface(rig / "surfaces" / name, surface)
    for capture in ("session/stop_00", "session/stop_01", "objects/2024-05-01"):
        (rig / capture).mkdir(parents=True)
        (rig / capture / "capture.yaml").touch()
    monkeypatch.chdir(tmp_path)
    assert main(["fuse", "rig/session/stop_00", "rig/session/stop_01", "rig/objects/2024-05-01", "-o", "model", "--step", "6mm"]) == 0
    told = capsys.readouterr().out
    assert "written to model: mesh.glb" in told
    assert "no view is solved again with the light between the object's parts: it needs the rig's calibration" in told
    assert main(["fuse", "rig/session/stop_00", "rig/session/stop_01", "-o", "model", "--step", "6mm", "--once"]) == 0
    assert "solved again" not in capsys.readouterr().out
    assert main(["fuse", "rig/session", "-o", "model"]) == 3
    assert "name what is in it: rig/session/*" in capsys.readouterr().err
    assert main(["fuse", "rig/sesion/stop_00", "-o", "model"]) == 3
    assert "did you mean rig/session?" in capsys.readouterr().err
    library.write_surface(rig / "surfaces" / "relief", replace(views[0], name="relief", placement=None))
    monkeypatch.chdir(rig)
    assert main(["fuse", "--step", "6mm"]) == 0
    assert "without relief: not placed" in capsys.readouterr().out

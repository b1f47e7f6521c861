"""``lpcal fuse`` on surfaces in folders."""

from __future__ import annotations

import json
from pathlib import Path

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
    assert {path.name for path in (tmp_path / "model").iterdir()} == {"mesh.ply", "mesh.glb", "mesh.obj", "model.npz", "summary.json"}
    (tmp_path / "session" / "stop_00").mkdir(parents=True)
    assert main(["fuse", "session/stop_00", "-o", "model"]) == 4  # the capture's surface is found; one alone is no model
    assert main(["fuse", "nothing", "-o", "model"]) == 3
    assert "no surface there" in capsys.readouterr().err
    assert main(["fuse", names[0], names[0], "-o", "model"]) == 6

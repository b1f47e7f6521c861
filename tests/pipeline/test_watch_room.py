"""What watch says beside the images: a capture's reading of the distance sensor, what the newest model lacks."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

import lpcal
from lpcal.formats.documents import plain
from lpcal.formats.record_documents import document_of
from lpcal.pipeline.watch_room import WatchedRoom
from lpcal.records.model import Missing, NextStop


def test_a_reading_is_held_against_where_the_lights_meet(tmp_path: Path) -> None:
    """By the calibrated beam; without a distance in capture.yaml nothing is said."""
    capture = tmp_path / "cup"
    capture.mkdir()
    beam = lpcal.DistanceSensor(np.array([0, 0, 0.01]), np.array([0, 0, 1.0]), bias_m=0.005)
    room = WatchedRoom(tmp_path, lpcal.Calibration("rig", (), focus_C=np.array([0, 0, 0.35]), distance_sensor=beam))
    assert room.reading(capture) is None
    (capture / "capture.yaml").write_text("distance: 350 mm\n", encoding="utf-8")
    assert room.reading(capture) == ("the distance sensor reads 350 mm", True)
    (capture / "capture.yaml").write_text("distance: 512 mm\n", encoding="utf-8")
    said = room.reading(capture)
    assert said is not None
    assert "167 mm farther than where the lights meet" in said[0]
    assert not said[1]
    assert WatchedRoom.of(tmp_path).reading(capture) == ("the distance sensor reads 512 mm", True)


def test_what_the_newest_model_lacks(tmp_path: Path) -> None:
    """It is read when it comes and when it changes, not again while it stays."""
    room = WatchedRoom.of(tmp_path)
    assert not room.look_at_models()
    stop = NextStop(np.eye(4), None, "stop_03", 0.5, 0.35, 0.0012, 0.0030, False)
    document = {"kind": "model", "frame": "the room", "missing": document_of(Missing(0.02, 0.002, 0.004, 0.0, (stop,)))}
    (tmp_path / "model").mkdir()
    (tmp_path / "model" / "summary.json").write_text(json.dumps(plain(document)), encoding="utf-8")
    assert room.look_at_models()
    assert room.model[0].startswith("model: missing, of 200.0 cm2: some 20.0 cm2 that no view has seen")
    assert "29 deg from stop_03" in room.model[1]
    assert not room.look_at_models()

"""``lpcal distance``: readings beside the images to distance.yaml and calibration.yaml, what `check` says, what the simulator reads."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

import lpcal
from lpcal.errors import DisagreementError, InputError
from lpcal.formats.distance_files import read_distance, read_distances
from lpcal.formats.h_cb_yaml import write_h_cb
from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline import distance
from lpcal.pipeline.workspace import Workspace
from lpcal.records.observations import BoardPoses
from lpcal.records.outcome import silent
from lpcal.records.provenance import Provenance
from lpcal.records.rig import Rig
from lpcal.simulate.beam import board_distances, draw_beam

PANEL = """lpcal: 1
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
panel:
  disc_radius: 60 mm
  joint: 15 mm
  blob: 30 mm
  distance_sensor: {position: [30 mm, 0 mm, 5 mm], direction: [0, 0, 1], noise: 2 mm, tolerance: [4 mm, 1 deg], readings: readings.csv}
"""
BOARD = lpcal.Board((9, 6), (0.025, 0.025))
U = np.array([0.02, -0.01, 1.0]) / np.linalg.norm([0.02, -0.01, 1.0])
BEGIN = np.array([0.032, 0.001, 0.005])


def views() -> tuple[np.ndarray, np.ndarray]:
    """Poses with the spot on the board, and what a sensor with a zero of 6 mm reads there."""
    rng = np.random.default_rng(4)
    H = np.tile(np.eye(4), (24, 1, 1))
    H[:, :3, :3] = Rotation.from_rotvec(np.radians(30) * rng.uniform(-1, 1, (24, 3)) * [1, 1, 0.3]).as_matrix()
    spot_B = np.array([0.1, 0.0625, 0.0]) + 0.04 * rng.uniform(-1, 1, (24, 3)) * [1, 1, 0]
    t = rng.uniform(0.25, 0.55, 24)
    H[:, :3, 3] = BEGIN + t[:, None] * U - np.einsum("nij,nj->ni", H[:, :3, :3], spot_B)
    return H, 0.006 + t + 0.002 * rng.standard_normal(24)


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    (tmp_path / "panel.yaml").write_text(PANEL)
    H, reading = views()
    names = [f"images/{k:02d}.png" for k in range(24)]
    (tmp_path / "images").mkdir()
    for name in names:
        (tmp_path / name).touch()
    rows = [f"{name},{1e3 * one:.1f}" for name, one in zip(names, reading, strict=True)]
    rows[5] = f"{names[5]},"  # no echo there
    (tmp_path / "readings.csv").write_text("\n".join(["file,distance_mm", *rows]) + "\n")
    count = BOARD.points_B().shape[0]
    poses = BoardPoses(
        tuple(names),
        None,
        H,
        np.zeros((24, count, 2)),
        BOARD.points_B(),
        np.tile(1e-9 * np.eye(6), (24, 1, 1)),
        np.full(24, 0.05),
        0.05,
    )
    write_h_cb(tmp_path / "calib/H_CB.yaml", poses, {}, (9, 6), Provenance())
    return tmp_path


def test_the_stage_writes_the_beam_and_a_calibration_carries_it(rig: Path) -> None:
    outcome = distance.STAGE.run(Workspace(read_rig(rig / "panel.yaml")), silent)
    assert any("23 of 23 used" in line for line in outcome.summary)
    found = read_distance(rig / "calib/distance.yaml")
    error = found.sensor.hit(0.006 + 0.35) - (BEGIN + 0.35 * U)
    assert np.linalg.norm(error) < 4 * max(found.sensor.std_m(0.356), found.sensor.across_std_m(0.356))
    lights = tuple(lpcal.Light(f"L{k}", np.array([x, 0, -0.8]), np.ones(1)) for k, x in enumerate((0.6, -0.6)))
    whole = lpcal.Calibration("rig", lights, lpcal.Camera((640, 480), "opencv4", np.diag([600.0, 600, 1]), np.zeros(4)))
    lpcal.write_calibration(rig / "calib/calibration.yaml", replace(whole, distance_sensor=found.sensor))
    again = lpcal.read_calibration(rig / "calib/calibration.yaml").distance_sensor
    assert np.allclose(again.hit(0.4), found.sensor.hit(0.4))
    assert np.allclose(again.covariance, found.sensor.covariance, rtol=1e-6, atol=1e-14)


def test_check_names_readings_in_another_unit(rig: Path) -> None:
    text = (rig / "readings.csv").read_text()
    (rig / "readings.csv").write_text(text.replace("distance_mm", "distance_m"))
    workspace = Workspace(read_rig(rig / "panel.yaml"))
    H, _ = views()
    poses = BoardPoses(tuple(f"images/{k:02d}.png" for k in range(24)), None, H, points_B=BOARD.points_B())
    notes, wrong = distance.list_pixels(workspace, poses)
    assert notes == []
    assert len(wrong) == 1
    assert isinstance(wrong[0], DisagreementError)
    assert "panel.yaml" in wrong[0].where
    assert "millimetres" in wrong[0].found


def test_a_table_without_readings_is_an_error_only_where_one_is_asked_for(tmp_path: Path) -> None:
    table = tmp_path / "stations.csv"
    table.write_text("file,time_s\n")
    assert read_distances(table, needed=False) == []
    with pytest.raises(InputError, match="distance_m"):
        read_distances(table)
    table.write_text("time_s,distance_cm\n1.5,40\n2.5,\n")
    (row,) = read_distances(table)
    assert (row.t_camera_s, row.distance_m, row.image) == (1.5, pytest.approx(0.4), None)
    table.write_text("time_s,distance_cm\n1.5,far\n")
    with pytest.raises(InputError, match="'far'"):
        read_distances(table)


def test_panel_yaml_asks_for_units_and_a_direction(tmp_path: Path) -> None:
    for wrong, words in (("noise: 2 mm", "noise: 2"), ("direction: [0, 0, 1]", "direction: [0, 0, 0]")):
        (tmp_path / "panel.yaml").write_text(PANEL.replace(wrong, words))
        with pytest.raises(InputError, match=r"bare number|without length"):
            read_rig(tmp_path / "panel.yaml")


def test_the_simulator_reads_the_board_or_the_wall_behind() -> None:
    H, _ = views()
    rig = read_rig_text(PANEL)
    beam = draw_beam(rig, np.eye(4), 3)
    beam = replace(beam, position_C=BEGIN, direction_C=U)
    n, p = H[:, :3, 2], H[:, :3, 3]
    t = np.sum(n * (p - BEGIN), axis=1) / (n @ U)
    assert np.allclose(board_distances(beam, rig.board, 0.0, 0.0, H), t, atol=1e-9)
    beside = H.copy()
    beside[:, :3, 3] += 0.4 * H[:, :3, 0]
    assert np.all(board_distances(beam, rig.board, 0.0, 0.0, beside) > t + 0.3)
    assert np.std(beam.reads(np.full(4000, 0.4), np.random.default_rng(0))) == pytest.approx(0.002, rel=0.05)


def read_rig_text(text: str) -> Rig:
    return Rig.model_validate(yaml.safe_load(text))

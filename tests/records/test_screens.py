"""Records print as one screen of figures with their sigmas, and as a table with a picture in a notebook."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

import lpcal
from lpcal.geometry import se3
from lpcal.records import screens
from lpcal.records.calibration import LightsSolution
from lpcal.records.model import ModelFigures
from lpcal.records.observations import SphereView
from lpcal.records.shown import Shown

S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1], [0.0, 0.0, -1]])
S /= np.linalg.norm(S, axis=1, keepdims=True)
CAMERA = lpcal.Camera(
    (64, 48), "opencv4", np.array([[60.0, 0, 32], [0, 60, 24], [0, 0, 1]]), np.zeros(4), parameters=("fx", "fy", "cx", "cy")
)
CAMERA = replace(CAMERA, covariance=np.diag([0.04, 0.09, 0.01, 0.0016]))


@pytest.fixture(scope="module")
def records() -> dict[str, Shown]:
    """One record of every kind that is shown."""
    session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), image_size=(320, 200), stations=6)
    truth = session.board_truth()
    views = lpcal.find_boards([*session.board_images(), np.zeros((200, 320), np.uint8)], session.board)
    rng = np.random.default_rng(0)
    handeye = lpcal.solve_handeye(truth.H_OP, truth.H_CB)
    handeye = replace(handeye, H_PC_covariance=np.diag([1e-6] * 3 + [4e-8] * 3), warnings=("one", "two", "three", "four"))
    wings = lpcal.design_lights(lpcal.read_rig("lightpanel-12"))
    calibration = lpcal.assemble_calibration(wings, CAMERA, name="twelve")
    y, x = np.mgrid[-20:21, -20:21] / 40.0
    normals = np.stack([x, y, -np.sqrt(1 - x**2 - y**2)], axis=-1)
    surface = lpcal.integrate(normals, name="cap")
    stream = lpcal.PoseStream("wand", np.arange(9) / 90, np.tile(np.eye(4), (9, 1, 1)), np.full(9, np.nan), rate_hz=90)
    demo = lpcal.read_rig("demo")
    capture = lpcal.read_capture(demo.folder / "spheres/matte_0", list(demo.rig.lights))
    steps = np.random.default_rng(2).normal(size=(9, 2, 3)) * [[0.03], [0.05]]
    H_CB = np.concatenate([truth.H_CB, *(truth.H_CB @ se3.exp(np.r_[turn, move]) for move, turn in steps)])
    n, p = H_CB[:, :3, 2], H_CB[:, :3, 3]
    beam = lpcal.calibrate_distance_sensor(0.004 + np.sum(n * p, axis=1) / n[:, 2], H_CB, session.board, noise_m=0.0005)
    corners, ones, face = np.eye(3), np.ones(3), np.array([[0, 1, 2]])
    figures = ModelFigures(0, 0, 1, 0.5, 1, 0, 1, 0, 3, 0, 0)
    return {
        "ObjectModel": lpcal.ObjectModel("tile", "the room", corners, corners, face, corners, ones, ones, ones, face[0], (), figures),
        "Placement": lpcal.Placement(np.eye(4), 1e-6 * np.eye(6)),
        "DistanceSensor": beam.sensor,
        "SensorSolution": beam,
        "Camera": CAMERA,
        "CameraSolution": lpcal.calibrate_camera(views, session.board, model="opencv4"),
        "HandEye": handeye,
        "Wings": wings,
        "Light": calibration.lights[0],
        "LightsSolution": LightsSolution(calibration.lights, np.zeros(3), 0.35, None, ()),
        "Calibration": calibration,
        "LightField": lpcal.light_field(calibration, rng.uniform(0.3, 0.4, (5, 3))),
        "Surface": surface,
        "Evaluation": lpcal.evaluate(surface, normals, depth=40 * normals[..., 2]),
        "BoardViews": views,
        "BoardPoses": lpcal.locate_boards(views, session.camera, session.board),
        "PoseStream": stream,
        "RigFile": demo,
        "Mesh": lpcal.mesh(surface),
        "Simulation": session,
        "BoardTruth": truth,
        "RawCapture": capture,
        "HandEyeCheck": lpcal.check_handeye(truth.H_OP, truth.H_CB),
        "Study": lpcal.study("ambient", at=[20]),
        "SphereView": SphereView("ball", "chrome", 0.02, np.array([[1.0, 2], [3, 2], [2, 1], [2, 3]]), 0.1, {"L0": np.ones(2)}),
    }


assert lpcal.simulate_rig
assert lpcal.check_handeye
assert lpcal.study
assert lpcal.calibrate_distance_sensor
assert lpcal.fuse
assert lpcal.mesh  # loaded, so that their records are registered
KINDS = [kind.__name__ for kind in screens.screen_of.registry if kind is not object]


@pytest.mark.parametrize("kind", KINDS)
def test_a_record_is_one_screen(records: dict[str, Shown], kind: str) -> None:
    said = repr(records[kind])
    lines = said.splitlines()
    assert lines[0].startswith(kind)
    assert len(lines) <= screens.LINES
    assert max(map(len, lines)) <= screens.COLUMNS
    assert "nan" not in said
    assert not re.search(r"array\(|object at 0x", said)


@pytest.mark.parametrize("kind", KINDS)
def test_a_notebook_shows_a_table(records: dict[str, Shown], kind: str) -> None:
    page = ET.fromstring(records[kind]._repr_html_())  # well-formed, and nothing of it is fetched
    assert len(page.findall("table/tr")) >= 1
    pictures = page.findall("svg") + page.findall("img")
    wanted = {"Wings", "LightsSolution", "Calibration", "Surface", "Evaluation", "BoardViews", "RawCapture"}
    assert bool(pictures) == (kind in wanted)
    assert all(one.get("src", "data:").startswith("data:") for one in pictures)


def test_sigmas_stand_beside_figures(records: dict[str, Shown]) -> None:
    assert "60.000 +- 0.200, 60.000 +- 0.300 px" in repr(CAMERA)
    assert "32.000 +- 0.100, 24.000 +- 0.040 px" in repr(CAMERA)
    assert re.search(r"turned by \[.*\] \+- 0\.057, 0\.057, 0\.057 deg", repr(records["HandEye"]))
    assert "direction  [" in repr(records["Light"])
    assert re.search(r"source .* \+- \d+\.\d+ mm", repr(records["Light"]))


def test_the_origins_sigma_is_not_that_of_the_perturbation() -> None:
    far = np.eye(4)
    far[:3, 3] = [1.0, 0, 0]
    covariance = np.diag([1e-6, 1e-6, 1e-6, 1e-12, 1e-12, 1e-12])
    found = lpcal.HandEye(far, covariance, np.eye(4), covariance, None, None, ())
    assert re.search(r"H_PC +at \[1000\.00 0\.00 0\.00\] \+- 0\.0010, 1\.00, 1\.00 mm", repr(found))


def test_what_is_left_out_is_counted(records: dict[str, Shown]) -> None:
    assert "and 1 more warnings" in repr(records["HandEye"])
    many = replace(
        records["Calibration"], lights=tuple(replace(lamp, name=f"M{k}") for k in range(5) for lamp in records["Calibration"].lights)
    )
    assert "and 48 more" in repr(many)
    assert "6 of 7" in repr(records["BoardViews"])


def test_names_cannot_break_a_page(records: dict[str, Shown]) -> None:
    page = replace(records["Calibration"], name="<script>alert(1)</script>")._repr_html_()
    assert "<script>" not in page

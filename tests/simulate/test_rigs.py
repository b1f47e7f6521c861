"""lpcal simulate: the bundled rigs, other kinds of rigs, the same bytes from the same seed, and what it refuses."""

from __future__ import annotations

import csv
import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import yaml

from lpcal.formats.bundled import folder, rig_file, rig_names
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3
from lpcal.pipeline.simulate import simulate
from lpcal.records.outcome import silent
from lpcal.simulate.built import working_distance
from lpcal.simulate.captures import mirror_point
from lpcal.simulate.leds import ring_directions
from lpcal.simulate.lens import Lens
from lpcal.simulate.rays import blocked, cast
from lpcal.simulate.recipe import Recipe, SensorRecipe
from lpcal.simulate.sensor import Response, splat
from lpcal.simulate.shapes import SHAPES
from lpcal.simulate.tracking import swapped_fit

SMALL = Recipe(seed=5, image_size=(240, 160), stations=4, sweep_frames=0)
DOME = """
lpcal: 1
camera: {cameramodel: camera.cameramodel, gamma: 2.2, black_level: 1 %}
lights: {L0: {}, L1: {}}
spheres: {chrome: {kind: chrome, radius: 20 mm, images: spheres/chrome}}
objects: {thing: things/one}
"""


def digests(where: Path) -> dict[str, str]:
    return {
        path.relative_to(where).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(where.rglob("*"))
        if path.is_file()
    }


def made(tmp_path: Path, panel: str, recipe: Recipe = SMALL, name: str = "rig") -> Path:
    (tmp_path / "panel.yaml").write_text(panel)
    simulate(read_rig(tmp_path / "panel.yaml"), tmp_path / name, recipe, silent)
    return tmp_path / name


def test_every_bundled_rig_is_read() -> None:
    assert {"lightpanel-6", "lightpanel-12", "dome", "robot-camera"} <= set(rig_names())
    assert rig_file(None).parent.name == "lightpanel-6"
    for name in rig_names():
        assert read_rig(rig_file(name)).rig.name == name


@pytest.mark.parametrize(("name", "distance_m", "count"), [("lightpanel-6", 0.350, 6), ("lightpanel-12", 0.400, 12)])
def test_wings_of_the_bundled_panels_meet_at_their_distance(name: str, distance_m: float, count: int) -> None:
    rig = read_rig(rig_file(name)).rig
    assert len(rig.lights) == count
    for light in rig.lights.values():
        assert working_distance(rig.model_copy(update={"lights": {"one": light}})) == pytest.approx(distance_m, abs=5e-5)


def test_the_demo_rig_travels_with_its_truth() -> None:
    demo = folder("calib_data") / "demo_rig"
    rig = read_rig(demo / "panel.yaml").rig
    for sphere in rig.spheres.values():
        assert {f"{name}.png" for name in rig.lights} | {"ambient.png", "capture.yaml"} <= {
            path.name for path in (demo / sphere.images).iterdir()
        }
    for name in ("camera.yaml", "handeye.yaml", "lights.yaml", "leds.npz", "field.csv", "points.csv", "spheres.yaml", "objects.yaml"):
        assert (demo / "truth" / name).is_file()
    assert sum(path.stat().st_size for path in demo.rglob("*.png")) < 4e6


@pytest.mark.slow
def test_a_seed_gives_the_same_bytes_and_another_seed_others(tmp_path: Path) -> None:
    first, again = made(tmp_path, DOME, name="first"), made(tmp_path, DOME, name="again")
    other = made(tmp_path, DOME, Recipe(seed=6, image_size=SMALL.image_size), name="other")
    assert digests(first) == digests(again)
    assert digests(first)["spheres/chrome/L0.png"] != digests(other)["spheres/chrome/L0.png"]


@pytest.mark.slow
def test_a_dome_needs_neither_board_nor_mocap(tmp_path: Path) -> None:
    rig = made(tmp_path, DOME)
    assert not (rig / "truth" / "handeye.yaml").exists()
    assert "LENSMODEL_OPENCV5" in (rig / "camera.cameramodel").read_text()
    assert {path.name for path in (rig / "things" / "one").iterdir()} == {"L0.png", "L1.png", "ambient.png", "capture.yaml"}
    lights = yaml.safe_load((rig / "truth" / "lights.yaml").read_text())["lights"]
    assert all("H_DL" not in light and light["lit"] == 1 for light in lights)
    short, long = (cv2.imread(str(rig / "spheres" / "chrome" / name), 0) for name in ("short_L0.png", "L0.png"))
    assert np.median(short) < np.median(long) - 5
    assert short.max() < 255 == long.max()


def test_a_robot_states_one_pose_an_image(tmp_path: Path) -> None:
    panel = rig_file("robot-camera").read_text().replace("direction: H_OP  ", "direction: H_PO  ")
    rig = made(tmp_path, panel)
    rows = list(csv.DictReader((rig / "robot.csv").read_text().splitlines()))
    assert [row["file"] for row in rows] == [f"stations/station_{k:02d}.png" for k in range(4)]
    q, t = (np.array([[float(row[key]) for key in keys] for row in rows]) for keys in (("qx", "qy", "qz", "qw"), ("x_m", "y_m", "z_m")))
    H_PO = se3.transform(se3.rotation_from_quaternion(q), t)
    true = list(csv.DictReader((rig / "truth" / "H_OP.csv").read_text().splitlines()))
    t_true = np.array([[float(row[key]) for key in "xyz"] for row in true])
    np.testing.assert_allclose(se3.inv(H_PO)[:, :3, 3], t_true, atol=0.0015)


def test_images_listed_by_name_are_made_by_name(tmp_path: Path) -> None:
    rig = made(tmp_path, "lpcal: 1\ncamera: {images: [a/one.png, a/two.tif, b/three.png]}\nboard: {corners: [6, 4], square: 30 mm}\n")
    assert all((rig / name).is_file() for name in ("a/one.png", "a/two.tif", "b/three.png"))
    rows = (rig / "truth" / "H_CB.csv").read_text().splitlines()
    assert [row.split(",")[0] for row in rows[1:]] == ["a/one.png", "a/two.tif", "b/three.png"]


@pytest.mark.slow
def test_a_charuco_board_is_found_in_its_images(tmp_path: Path) -> None:
    charuco = "kind: charuco\n  marker: 20 mm\n  dictionary: DICT_4X4_50"
    panel = rig_file("robot-camera").read_text().replace("kind: chessboard", charuco)
    rig = made(tmp_path, panel, Recipe(seed=5, image_size=(640, 420), stations=3, sweep_frames=0))
    board = cv2.aruco.CharucoBoard((10, 7), 25.0, 20.0, cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50))
    counts = [len(cv2.aruco.CharucoDetector(board).detectBoard(cv2.imread(str(path), 0))[0]) for path in sorted(rig.glob("stations/*.png"))]
    assert len(counts) == 3
    assert min(counts) > 40


@pytest.mark.parametrize(
    ("panel", "words"),
    [
        ("lpcal: 1\nlights: {L0: {}}\n", "no section camera"),
        ("lpcal: 1\ncamera: {images: a/*.png}\n", "no section board"),
        (
            "lpcal: 1\ncamera: {}\nboard: {corners: [9, 6], square: 25 mm}\nmocap: {board_poses: {file: H.csv}}\n",
            "board poses are not simulated",
        ),
        ("lpcal: 1\ncamera: {}\nboard: {corners: [9, 6], square: 25 mm}\nmocap: {file: m.c3d}\n", "only Motive's CSV"),
        ("lpcal: 1\ncamera: {}\nlights: {L0: {}}\nobjects: {a: ../a}\n", "leads out of the folder"),
        ("lpcal: 1\ncamera: {flat_field: /flat.png}\nlights: {L0: {}}\n", "leads out of the folder"),
        ("lpcal: 1\ncamera: {images: 's/??.png'}\nboard: {corners: [9, 6], square: 25 mm}\n", "cannot be numbered"),
    ],
)
def test_what_cannot_be_simulated_is_said_before_anything_is_written(
    lpcal: Callable[..., Any], tmp_path: Path, panel: str, words: str
) -> None:
    (tmp_path / "panel.yaml").write_text(panel)
    code, _, err = lpcal("simulate", "--rig", tmp_path, tmp_path / "out")
    assert (code, words in err, (tmp_path / "out").exists()) == (3, True, False)


def test_a_folder_that_is_there_is_left_alone(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "kept.txt").write_text("mine")
    code, _, err = lpcal("simulate", tmp_path)
    assert code == 3
    assert "is there already" in err
    assert "with -o" not in err
    assert [path.name for path in tmp_path.iterdir()] == ["kept.txt"]


@pytest.mark.parametrize(
    "words", [["--size", "640"], ["--size", "20x20"], ["--stations", "2"], ["--seed", "-1"], ["--object", "knot"], ["--session", "3"]]
)
def test_words_out_of_range_are_usage(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, words: list[str]) -> None:
    code, _, err = lpcal("simulate", *words, tmp_path / "out")
    assert code == 2
    assert words[0] in err


def test_an_unknown_rig_lists_the_known_ones(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, _, err = lpcal("simulate", "--rig", "lightpannel", tmp_path / "out")
    assert code == 3
    assert "lightpanel-6" in err


def test_the_command_says_what_it_made(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text(rig_file("robot-camera").read_text())
    code, out, _ = lpcal("simulate", "--rig", tmp_path / "panel.yaml", "--size", "240x160", "--stations", "4", tmp_path / "out")
    assert code == 0
    assert "4 station images" in out
    assert "lpcal run" in out


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_rays_stop_at_the_first_crossing(name: str) -> None:
    """A signed distance that were too large anywhere would let a ray jump through a thin part: dense sampling shows none before the hit."""
    shape = SHAPES[name](0.05)
    rng = np.random.default_rng(3)
    o_S = np.array([0.01, 0.02, -0.35])
    d_S = rng.uniform(-0.055, 0.055, (400, 3)) * [1, 1, 0] - o_S
    d_S /= np.linalg.norm(d_S, axis=1, keepdims=True)
    t = cast(shape, o_S, d_S)
    hit = np.isfinite(t)
    assert 60 < hit.sum() < 400
    x_S = o_S + t[hit, None] * d_S[hit]
    assert np.abs(shape.distance(x_S)).max() < 3e-5 * shape.bound_m
    assert np.linalg.norm(x_S, axis=1).max() < shape.bound_m
    along = np.linspace(0.25, 0.45, 4000)
    for ray, end in zip(d_S[::5], np.where(hit, t, np.inf)[::5], strict=True):
        before = along[along < end - 1e-5]
        assert shape.distance(o_S + before[:, None] * ray).min() > -1e-6
    assert np.mean(np.sum(shape.normal(x_S) * d_S[hit], axis=1) < 0.02) > 0.99


def test_a_point_behind_a_ball_is_in_its_shadow() -> None:
    ball = SHAPES["pair"](0.05)
    behind, beside = np.array([[-0.05 * 0.5, 0.25 * 0.05, 0.3]]), np.array([[0.3, 0.3, 0.3]])
    lamp = np.array([[-0.025, 0.0125, -0.3]])
    assert blocked(ball, behind, lamp)[0]
    assert not blocked(ball, beside, lamp)[0]


def test_the_lens_agrees_with_opencv_both_ways() -> None:
    lens = Lens((640, 400), np.array([[680.0, 0, 322], [0, 681, 197], [0, 0, 1]]), np.array([-0.28, 0.1, 0.0007, -0.0004, 0.01]))
    x_C = np.random.default_rng(0).uniform([-0.4, -0.25, 1], [0.4, 0.25, 1], (300, 3)) * np.random.default_rng(1).uniform(0.2, 2, (300, 1))
    theirs = cv2.projectPoints(x_C, np.zeros(3), np.zeros(3), lens.K, lens.distortion)[0].reshape(-1, 2)
    np.testing.assert_allclose(lens.project(x_C), theirs, atol=1e-9)
    np.testing.assert_allclose(lens.plane(theirs), x_C[:, :2] / x_C[:, 2:], atol=1e-10)
    fine = lens.grid(3)
    np.testing.assert_allclose(fine[4, 7], lens.grid()[1, 2], atol=1e-12)


def test_mirrored_rays_reach_the_led() -> None:
    rng = np.random.default_rng(4)
    centre_C, led_C = np.array([0.03, -0.02, 0.36]), rng.uniform([-0.2, -0.2, 0], [0.2, 0.2, 0.05], (50, 3))
    P = mirror_point(centre_C, 0.025, led_C)
    n = (P - centre_C) / 0.025
    u = P / np.linalg.norm(P, axis=1, keepdims=True)
    r = u - 2 * np.sum(u * n, axis=1, keepdims=True) * n
    to = (led_C - P) / np.linalg.norm(led_C - P, axis=1, keepdims=True)
    np.testing.assert_allclose(r, to, atol=1e-9)


def test_a_spot_keeps_its_place_and_its_flux() -> None:
    light = np.zeros((40, 60))
    splat(light, np.array([31.37, 18.81]), 5.0, 0.7)
    v, u = np.mgrid[:40, :60]
    assert light.sum() == pytest.approx(5, rel=1e-6)
    np.testing.assert_allclose([np.sum(u * light) / 5, np.sum(v * light) / 5], [31.37, 18.81], atol=1e-4)
    splat(light, np.array([-0.2, 39.4]), 1.0, 0.7)  # over the image's corner: what lies outside is lost
    assert 5 < light.sum() < 5.6


@pytest.mark.parametrize("gamma", [1.0, 2.2])
def test_the_sensor_stores_linear_light_by_black_white_and_gamma(gamma: float) -> None:
    response = Response(SensorRecipe(read_noise_e=5), np.ones((200, 200)), black=0.02, white=0.9, gamma=gamma)
    rng = np.random.default_rng(0)
    for light in (0.0, 0.1, 0.6):
        stored = response(np.full((200, 200), light), rng) / 255
        linear = (stored**gamma - 0.02**gamma) / (0.9**gamma - 0.02**gamma)
        assert linear.mean() == pytest.approx(light, abs=2e-3)
    assert response(np.full((200, 200), 3.0), rng).max() == round(0.9 * 255)
    shot = response(np.full((200, 200), 0.5), rng) / 255
    if gamma == 1.0:
        assert shot.std() / 0.88 == pytest.approx(np.sqrt(0.5 * 30000) / 30000, rel=0.25)


def test_swapped_markers_turn_the_body_and_fit_worse() -> None:
    marker_P = np.array([[81, 0, 4], [24, 79, 12], [-74, 41, 4], [-58, -62, 20], [35, -80, 7]]) / 1000
    H_flip, error_m = swapped_fit(marker_P)
    assert np.degrees(se3.angle_rad(H_flip[:3, :3])) > 10
    assert 0.001 < error_m < 0.04


def test_leds_stand_in_rings() -> None:
    directions = ring_directions(19)
    polar = np.degrees(np.arccos(directions[:, 2]))
    np.testing.assert_allclose(np.sort(polar), [0] + [11.25] * 6 + [22.5] * 12, atol=1e-6)
    np.testing.assert_allclose(directions.mean(axis=0)[:2], 0, atol=1e-12)

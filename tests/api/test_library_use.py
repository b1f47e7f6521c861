"""The library in a program's hands: arrays in, records out, errors for arrays that cannot be, a log, nothing printed."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

import lpcal
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.geometry.arrays import Array
from lpcal.records.observations import BoardViews, RawCapture, SphereView

S = np.array([[0.5, 0, -1], [-0.25, 0.45, -1], [-0.25, -0.45, -1], [0.0, 0.0, -1], [0.4, 0.4, -1]])
S /= np.linalg.norm(S, axis=1, keepdims=True)
DOME = lpcal.Calibration("dome", tuple(lpcal.Light(f"L{k}", s, np.ones(1)) for k, s in enumerate(S)))
Y, X = np.mgrid[-1.2:1.2:48j, -1.2:1.2:48j]
BALL = X**2 + Y**2 < 0.9
NORMALS = np.where(BALL[..., None], np.stack([X, Y, -np.sqrt(np.maximum(1 - X**2 - Y**2, 0.1))], axis=-1), 0)
IMAGES = 0.7 * np.clip(np.einsum("lc,hwc->lhw", S, NORMALS), 0, 1)
ROOM = np.zeros_like(IMAGES[0])


@pytest.fixture(scope="module")
def robot() -> tuple[np.ndarray, np.ndarray]:
    truth = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), seed=3).board_truth()
    return truth.H_OP, truth.H_CB


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.float32, np.float64])
def test_a_stack_of_any_type_gives_the_same_normals(kind: type) -> None:
    full = np.iinfo(kind).max if np.issubdtype(kind, np.integer) else 1
    images = (full * IMAGES).astype(kind)
    surface = lpcal.reconstruct(images, DOME, ambient=ROOM.astype(kind), mask=BALL)
    assert lpcal.evaluate(surface, NORMALS).normal_median_deg < 1.0


def test_the_room_is_taken_away_by_its_exposure() -> None:
    room = np.full_like(ROOM, 0.1)
    surface = lpcal.reconstruct(
        0.5 * (IMAGES + room), DOME, ambient=2 * room, exposure_s=np.full(5, 0.01), ambient_exposure_s=[0.04], mask=BALL
    )
    assert lpcal.evaluate(surface, NORMALS).normal_median_deg < 1.0


def test_lights_in_another_order_are_named() -> None:
    order = [3, 0, 4, 1, 2]
    surface = lpcal.reconstruct(IMAGES[order], DOME, lights=[f"L{k}" for k in order], ambient=ROOM, mask=BALL)
    assert lpcal.evaluate(surface, NORMALS).normal_median_deg < 1.0


def test_a_gamma_is_stated_by_the_caller() -> None:
    surface = lpcal.reconstruct(IMAGES ** (1 / 2.2), DOME, ambient=ROOM, mask=BALL, sensor=lpcal.StatedSensor(gamma=2.2))
    assert surface.sensor is not None
    assert surface.sensor.said_by == {"gamma": "the caller"}
    assert lpcal.evaluate(surface, NORMALS).normal_median_deg < 1.0


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"images": IMAGES[0]}, InputError, "images: an array of"),
        ({"images": IMAGES[:3]}, DisagreementError, "3 images for 5 lights"),
        ({"images": np.where(IMAGES == 0, np.nan, IMAGES)}, InputError, "not finite"),
        ({"images": IMAGES[..., None]}, InputError, r"\(5, 48, 48, 1\)"),
        ({"images": [["a"]]}, InputError, "no numbers"),
        ({"ambient": ROOM[:-1]}, DisagreementError, "ambient"),
        ({"mask": BALL[:-1]}, DisagreementError, "mask"),
        ({"mask": "all"}, InputError, "'all'"),
        ({"method": "nearby"}, InputError, "'nearby'"),
        ({"exposure_s": [1, 2]}, DisagreementError, "exposure_s"),
        ({"exposure_s": [1, 1, 1, 1, 2]}, InputError, "ambient_exposure_s"),
        ({"images": np.zeros_like(IMAGES)}, DegenerateError, "dark"),
        ({"lights": ["L0", "L1", "L2", "L3", "L9"]}, DisagreementError, "L9"),
    ],
)
def test_images_that_cannot_be_are_refused(change: dict[str, Any], error: type[Exception], words: str) -> None:
    given = {"images": IMAGES, "ambient": ROOM, "mask": BALL} | change
    with pytest.raises(error, match=words):
        lpcal.reconstruct(given.pop("images"), DOME, **given)


def test_a_distance_that_is_stated_without_a_camera_is_said_to_be_unused() -> None:
    plain = lpcal.reconstruct(IMAGES, DOME, ambient=ROOM, mask=BALL)
    stated = lpcal.reconstruct(IMAGES, DOME, ambient=ROOM, mask=BALL, distance_m=350)
    assert not [note for note in plain.warnings if "distance is stated" in note]
    assert [note for note in stated.warnings if "distance is stated" in note and "not used" in note]
    assert np.array_equal(stated.depth, plain.depth, equal_nan=True)


def changed(poses: np.ndarray, row: int, place: tuple[int, int], value: float) -> np.ndarray:
    poses = poses.copy()
    poses[(row, *place)] = value
    return poses


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        (lambda P, B: {"H_OP": P[:-1]}, DisagreementError, "21 poses of the body and 22 of the board"),
        (lambda P, B: {"H_OP": P[0]}, InputError, r"H_OP: an array of \(4, 4\)"),
        (lambda P, B: {"H_OP": changed(P, 3, (0, 0), 7.0)}, InputError, r"H_OP\[3\]: is no rigid transform"),
        (lambda P, B: {"H_CB": changed(B, 5, (3, 3), 0.0)}, InputError, r"H_CB\[5\]: is no rigid transform"),
        (lambda P, B: {"H_CB": changed(B, 5, (0, 3), np.nan)}, InputError, "H_CB: 1 numbers that are not finite"),
        (lambda P, B: {"t_mocap_s": np.arange(22.0)}, InputError, "t_camera_s: none are given"),
        (lambda P, B: {"t_camera_s": np.arange(22.0)}, InputError, "t_mocap_s: none are given"),
        (lambda P, B: {"t_mocap_s": np.arange(21.0), "t_camera_s": np.arange(22.0)}, DisagreementError, "t_mocap_s"),
        (lambda P, B: {"t_mocap_s": -np.arange(22.0), "t_camera_s": np.arange(22.0)}, InputError, "times that increase"),
        (lambda P, B: {"H_OP": P[:2], "H_CB": B[:2]}, DegenerateError, "views"),
    ],
)
def test_poses_that_cannot_be_are_refused(
    robot: tuple[np.ndarray, np.ndarray], change: Callable[..., Any], error: type, words: str
) -> None:
    given = {"H_OP": robot[0], "H_CB": robot[1]} | change(*robot)
    with pytest.raises(error, match=words):
        lpcal.solve_handeye(given.pop("H_OP"), given.pop("H_CB"), **given)


@pytest.mark.parametrize("seed", [1, 2])
def test_handeye_with_a_clock_from_arrays(seed: int) -> None:
    session = lpcal.simulate_rig(lpcal.read_rig("lightpanel-6"), seed=seed)
    truth, stream = session.board_truth(), session.stream
    found = lpcal.solve_handeye(stream.H_OP, truth.H_CB, t_mocap_s=stream.t_s, t_camera_s=truth.t_camera_s)
    assert abs(found.clock_offset_s - session.clock_offset_s) < 5 * found.clock_offset_std_s + 1e-4
    assert np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3]) < 1e-3
    np.testing.assert_allclose(found.mocap_times(truth.t_camera_s), truth.t_camera_s - session.clock_offset_s, atol=2e-3)


def test_normals_come_back_from_their_own_depth() -> None:
    surface = lpcal.integrate(np.where(BALL[..., None], NORMALS, np.nan), name="ball")
    again = lpcal.evaluate(surface, NORMALS, depth=np.where(BALL, -np.sqrt(np.maximum(1 - X**2 - Y**2, 0)) * 47 / 2.4, np.nan))
    assert again.normal_mean_deg < 1e-3
    assert again.depth_rms_m < 0.3
    assert not again.metric


@pytest.mark.parametrize(
    ("normals", "words"), [(NORMALS[..., :2], r"\(48, 48, 2\)"), ([["a"]], "no numbers"), (np.zeros((5, 5)), r"needed: \(H, W, 3\)")]
)
def test_maps_that_are_no_normals_are_refused(normals: Array | list[list[str]], words: str) -> None:
    with pytest.raises(InputError, match=words):
        lpcal.integrate(normals)


def test_evaluate_says_how_far_off_a_surface_is() -> None:
    surface = lpcal.integrate(np.where(BALL[..., None], NORMALS, np.nan))
    turn = np.radians(3.0)
    R = np.array([[1, 0, 0], [0, np.cos(turn), -np.sin(turn)], [0, np.sin(turn), np.cos(turn)]])
    found = lpcal.evaluate(replace(surface, normal_std_deg=np.full(BALL.shape, 3.0, np.float32)), NORMALS @ R.T)
    assert 1.5 < found.normal_mean_deg < 3.0
    assert found.normal_p95_deg == pytest.approx(3.0, abs=0.05)
    assert 0.4 < found.normal_z_rms < 0.75
    with pytest.raises(DisagreementError):
        lpcal.evaluate(surface, NORMALS[1:])
    with pytest.raises(DegenerateError):
        lpcal.evaluate(surface, NORMALS, mask=~BALL)


def test_a_surface_comes_back_from_its_folder(tmp_path: Path) -> None:
    surface = lpcal.reconstruct(IMAGES, DOME, ambient=ROOM, mask=BALL)
    lpcal.write_surface(tmp_path / "ball", surface, DOME)
    again = lpcal.read_surface(str(tmp_path / "ball"))
    np.testing.assert_array_equal(again.depth, surface.depth)
    assert again.components == surface.components
    assert again.warnings == surface.warnings
    assert (tmp_path / "ball/relight.html").is_file()
    (tmp_path / "mine").write_text("mine")
    with pytest.raises(InputError):
        lpcal.write_calibration(tmp_path / "mine", DOME)


def test_a_calibration_comes_back_from_its_file(tmp_path: Path) -> None:
    wings = lpcal.design_lights(lpcal.read_rig("lightpanel-12"))
    rig = lpcal.assemble_calibration(wings, lpcal.simulate_rig(lpcal.read_rig("lightpanel-12")).camera, H_PC=np.eye(4), name="twelve")
    lpcal.write_calibration(str(tmp_path / "c.yaml"), rig)
    again = lpcal.read_calibration(tmp_path / "c.yaml")
    x_C = np.array([[0.0, 0.01, 0.33], [0.02, 0, 0.36]])
    np.testing.assert_allclose(lpcal.light_field(again, x_C).irradiance, lpcal.light_field(rig, x_C).irradiance, rtol=1e-3)
    assert again.camera.image_size == rig.camera.image_size
    assert np.array_equal(again.H_PC, np.eye(4))


def test_the_truth_of_a_simulation_is_its_own_light_field() -> None:
    session = lpcal.simulate_rig(lpcal.read_rig("lightpanel-6"), seed=4)
    x_C = session.built.points_C[:20]
    field = lpcal.light_field(session.calibration, x_C)
    for k, light in enumerate(session.built.lights):
        vectors = light.field(x_C)
        np.testing.assert_allclose(field.irradiance[k, :, 0], np.linalg.norm(vectors, axis=1), rtol=1e-3)
        np.testing.assert_allclose(field.direction_C[k], vectors / np.linalg.norm(vectors, axis=1, keepdims=True), atol=1e-3)


def test_progress_is_a_callback_and_the_log_is_named_lpcal(caplog: pytest.LogCaptureFixture, capsys: pytest.CaptureFixture[str]) -> None:
    told = []
    with caplog.at_level(logging.DEBUG, logger="lpcal"):
        surface = lpcal.integrate(NORMALS, green="as-is")
        lpcal.reconstruct(IMAGES, DOME, ambient=ROOM, mask=BALL, progress=lambda *step: told.append(step))
    assert {record.name for record in caplog.records} == {"lpcal"}
    assert "integration: begins" in caplog.messages
    assert [record.levelname for record in caplog.records if record.message.endswith(surface.warnings[-1])] == ["WARNING"]
    assert all(isinstance(what, str) and 0 <= done <= total for what, done, total in told)
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "")


def test_no_colour_of_lights_is_lost() -> None:
    lamp = lpcal.Light("L0", np.array([0, 0, -1.0]), np.array([1.0, 0.5, 0.2]))
    field = lpcal.light_field([lamp, replace(lamp, name="L1", intensity=np.ones(1))], np.zeros((2, 3)))
    assert field.irradiance.shape == (2, 2, 3)
    assert field.irradiance[0, 0].tolist() == [1.0, 0.5, 0.2]


@pytest.mark.parametrize("method", ["near", "distant"])
def test_the_command_finds_what_the_library_finds(request: pytest.FixtureRequest, tmp_path: Path, method: str) -> None:
    stored = np.rint(65535 * IMAGES).astype(np.uint16)
    (tmp_path / "ball").mkdir()
    for k, image in enumerate([*stored, np.zeros_like(stored[0])]):
        cv2.imwrite(str(tmp_path / "ball" / (f"L{k}.png" if k < len(S) else "ambient.png")), image)
    cv2.imwrite(str(tmp_path / "ball/mask.png"), np.uint8(255) * BALL)
    lpcal.write_calibration(tmp_path / "c.yaml", DOME)
    run = request.getfixturevalue("lpcal")
    assert run("reconstruct", "ball", "-c", "c.yaml", "-o", "out", "--lights", method, cwd=tmp_path)[0] == 0
    by_command = lpcal.read_surface(tmp_path / "out")
    rig = lpcal.read_calibration(tmp_path / "c.yaml")
    by_stack = lpcal.reconstruct(stored, rig, ambient=np.zeros_like(stored[0]), mask=BALL, method=method)
    by_folder = lpcal.reconstruct(lpcal.read_capture(tmp_path / "ball", rig), rig, method=method)
    for found in (by_stack, by_folder):
        np.testing.assert_array_equal(found.normals, by_command.normals)
        np.testing.assert_array_equal(found.depth, by_command.depth)
        assert found.warnings == by_command.warnings


def test_a_box_and_points_say_where_the_object_is() -> None:
    whole = np.ones_like(BALL)
    found = lpcal.reconstruct(IMAGES + 0.05, DOME, ambient=ROOM + 0.05, mask=whole, box=(4, 4, 30, 40), points=[(24, 24)])
    assert found.mask.sum() == 30 * 40
    for wrong in ({"box": (40, 4, 30, 40)}, {"box": (-1, 4, 30, 40)}, {"box": (4, 4, 0, 1)}, {"points": [(48, 3)]}):
        with pytest.raises(DisagreementError, match="images"):
            lpcal.reconstruct(IMAGES, DOME, ambient=ROOM, mask=whole, **wrong)
    with pytest.raises(InputError, match="'most'"):
        lpcal.reconstruct(IMAGES, DOME, ambient=ROOM, mask=whole, keep="most")


BOARD = lpcal.Board((9, 6), (0.025, 0.025))
PANEL = lpcal.read_rig("lightpanel-6")
CAMERA = lpcal.Camera((640, 480), "opencv4", np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]), np.zeros(4))
DARK = np.zeros((200, 200), np.uint8)
RAW = RawCapture("raw", tuple(f"L{k}" for k in range(5)), IMAGES.astype(np.float32), np.ones(5), None, np.ones(0))
TURN = np.linspace(0, 6, 40)
OUTLINE = [120, 90] + 50 * np.stack([np.cos(TURN), np.sin(TURN)], axis=1)
VIEW = SphereView("ball", "chrome", np.nan, OUTLINE, 0.05, {"L9": np.array([120.0, 90])}, {"L9": 0.05})


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: lpcal.find_boards([], BOARD), InputError, "no image"),
        (lambda: lpcal.find_boards(["board.png"], BOARD), InputError, r"images\[0\]"),
        (lambda: lpcal.find_boards([DARK + np.nan], BOARD), InputError, "not finite"),
        (lambda: lpcal.find_boards([DARK], BOARD, names=["a", "b"]), DisagreementError, "2 names for 1 images"),
        (lambda: lpcal.find_boards([DARK, DARK[1:]], BOARD), DisagreementError, "two sizes"),
        (lambda: lpcal.find_boards([DARK, DARK], BOARD), DegenerateError, "in any of 2 images"),
        (lambda: lpcal.calibrate_camera(np.zeros((4, 5, 4, 2)), BOARD, (640, 480)), DisagreementError, r"\(N, 6, 9, 2\)"),
        (lambda: lpcal.calibrate_camera(np.zeros((4, 6, 9, 2)), BOARD), InputError, "image_size"),
        (lambda: lpcal.calibrate_camera(np.full((4, 6, 9, 2), np.nan), BOARD, (640, 480)), DegenerateError, "0 of 4 images"),
        (lambda: lpcal.calibrate_camera(np.zeros((4, 6, 9, 2)), BOARD, (640, 480)), DegenerateError, "one pose"),
        (lambda: lpcal.calibrate_camera(np.zeros((4, 6, 9, 2)), BOARD, (640, 480), model="pinhole"), InputError, "model: 'pinhole'"),
        (lambda: lpcal.calibrate_camera(np.zeros((4, 6, 9, 2)), BOARD, (640, 480), solver="ceres"), InputError, "solver: 'ceres'"),
        (lambda: lpcal.locate_boards(BoardViews((10, 10), ()), CAMERA), InputError, "board: none is given"),
        (lambda: lpcal.design_lights([]), DegenerateError, "no light is a wing"),
        (lambda: lpcal.design_lights(PANEL, np.eye(3)), InputError, "H_CD"),
        (lambda: lpcal.design_lights(PANEL, np.eye(4), H_CD_covariance=np.eye(3)), InputError, "H_CD_covariance"),
        (lambda: lpcal.design_lights(PANEL, setting_std=(1.0, 2.0)), InputError, "setting_std"),
        (lambda: lpcal.refine_lights([], ["L0"]), DegenerateError, "no sphere"),
        (lambda: lpcal.refine_lights([VIEW], []), InputError, "no light"),
        (lambda: lpcal.refine_lights([VIEW], ["L0", "L1"]), DegenerateError, "L0"),
        (lambda: lpcal.refine_lights([VIEW], ["L0", "L1"], CAMERA), InputError, "no radius of ball"),
        (lambda: lpcal.find_sphere(IMAGES, "glass"), InputError, "'glass'"),
        (lambda: lpcal.find_sphere("images", "chrome"), InputError, "no numbers"),
        (lambda: lpcal.find_sphere(IMAGES, "chrome", camera=CAMERA), InputError, "radius_m"),
        (lambda: lpcal.find_sphere(IMAGES, "chrome", hint_px=[1, 2]), InputError, "hint_px"),
        (lambda: lpcal.find_sphere(np.full((2, 50, 50), 0.5), "chrome"), DegenerateError, "outline"),
        (lambda: lpcal.assemble_calibration(lpcal.design_lights(PANEL), H_PC=np.eye(3)), InputError, "H_PC"),
        (lambda: lpcal.light_field([], [[0, 0, 1]]), InputError, "no light"),
        (lambda: lpcal.light_field(DOME, [0, 1]), InputError, "x_C"),
        (lambda: lpcal.simulate_rig(PANEL, image_size=(10, 10)), InputError, "120 pixels"),
        (lambda: lpcal.reconstruct(np.zeros((0, 5, 5)), DOME), InputError, "images"),
        (lambda: lpcal.reconstruct(RAW, DOME, ambient=ROOM), InputError, "ambient: given beside a capture"),
        (lambda: lpcal.reconstruct(RAW, DOME, lights=["L0"] * 5), InputError, "lights: given beside a capture"),
        (lambda: lpcal.find_sphere(RAW, "chrome", mask=BALL[1:]), DisagreementError, "mask"),
        (lambda: lpcal.reconstruct(IMAGES, DOME, mask=BALL, distance_m=-0.3), InputError, "-0.3 m"),
        (lambda: lpcal.integrate(np.zeros((20, 20, 3))), DegenerateError, "0 pixels"),
        (lambda: lpcal.integrate(-NORMALS), DegenerateError, "away from the camera"),
        (lambda: lpcal.read_rig("nothing"), InputError, "nothing"),
        (lambda: lpcal.read_mocap("nothing"), InputError, "nothing"),
        (lambda: lpcal.read_capture("nothing", ["L0"]), InputError, "nothing"),
        (lambda: lpcal.read_calibration("nothing.yaml"), InputError, "nothing"),
        (lambda: lpcal.read_camera("nothing"), InputError, "nothing"),
        (lambda: lpcal.read_surface("nothing"), InputError, "nothing"),
    ],
)
def test_what_cannot_be_is_an_error_of_the_library(call: Callable[..., Any], error: type, words: str) -> None:
    with pytest.raises(error, match=words):
        call()


@pytest.mark.parametrize("seed", [1, 2, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (3, 4))])
def test_exact_poses_are_no_step(seed: int) -> None:
    session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), seed=seed)
    truth = session.board_truth()
    rng = np.random.default_rng(seed)
    for _ in range(4):
        rounded = truth.H_CB + 1e-15 * rng.standard_normal(truth.H_CB.shape) * [[1], [1], [1], [0]]
        found = lpcal.solve_handeye(truth.H_OP, rounded)
        assert np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3]) < 1e-9


WRONG_ARGUMENTS: dict[str, dict[str, Any]] = {
    "images": {"images": IMAGES.astype(complex)},
    "images of other shapes": {"images": [*IMAGES[:-1], IMAGES[-1][:5]]},
    "mask": {"mask": np.where(BALL, 1.0, np.nan)},
    "distance_m": {"distance_m": "350 mm"},
    "lights": {"lights": [0, 1, 2, 3, 4]},
    "box": {"box": (1, 2, 3)},
    "box as text": {"box": "1,2,30,30"},
    "points": {"points": [(20,)]},
    "points that is one": {"points": (20, 20)},
    "points not finite": {"points": [(np.nan, 1)]},
    "placement": {"placement": np.eye(4)},
}


@pytest.mark.parametrize("name", WRONG_ARGUMENTS)
def test_arguments_of_reconstruct_that_cannot_be_are_named(name: str) -> None:
    given = {"images": IMAGES, "ambient": ROOM, "mask": BALL, **WRONG_ARGUMENTS[name]}
    with pytest.raises(InputError) as caught:
        lpcal.reconstruct(given.pop("images"), DOME, **given)
    assert str(caught.value.where).startswith(name.split(maxsplit=1)[0])


def test_arguments_of_the_others_that_cannot_be_are_named(robot: tuple[np.ndarray, np.ndarray]) -> None:
    wrong: dict[str, Callable[[], object]] = {
        "H_OP": lambda: lpcal.solve_handeye(robot[0].astype(complex), robot[1]),
        "distance_m": lambda: lpcal.integrate(NORMALS, distance_m="350 mm"),  # type: ignore[arg-type]
        "green": lambda: lpcal.integrate(NORMALS, green="down"),  # type: ignore[arg-type]
        "surface": lambda: lpcal.mesh(NORMALS),  # type: ignore[arg-type]
    }
    for where, call in wrong.items():
        with pytest.raises(InputError) as caught:
            call()
        assert str(caught.value.where).startswith(where), where

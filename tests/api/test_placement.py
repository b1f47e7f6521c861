"""Captures that are placed: in the room by a recording or a stated pose, in the tracked body that the object rides on.

The truth is made with scipy's rotations and plain matrices, not with lpcal's own transforms.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import trimesh
from scipy.linalg import expm, logm
from scipy.spatial.transform import Rotation

import lpcal as library
from lit_scene import Scene, calibration, draw, truth
from lpcal.errors import DegenerateError, InputError, UsageError
from lpcal.formats.calibration_yaml import read_calibration, write_calibration
from lpcal.formats.panel_yaml import read_capture_section
from lpcal.formats.placement_document import placement_document, placement_from_document, stated_place_of
from lpcal.formats.surface_files import read_surface
from lpcal.records.observations import PoseStream
from lpcal.records.placement import RoomTracking
from lpcal.records.provenance import Provenance

H_PC = np.eye(4)
H_PC[:3, :3] = Rotation.from_rotvec([0.3, -0.2, 0.9]).as_matrix()
H_PC[:3, 3] = [0.012, -0.034, 0.056]
TRACKING = RoomTracking(
    H_PC_covariance=np.diag([2e-3, 1e-3, 3e-3, 4e-4, 3e-4, 5e-4]) ** 2,
    clock_offset_s=0.25,
    clock_offset_std_s=0.002,
    mocap_sigma_m=4e-4,
    mocap_sigma_deg=0.08,
)
TRACKED = library.Calibration("rig", (), H_PC=H_PC, tracking=TRACKING)


def matrix(turn: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Transforms (..., 4, 4) of rotation vectors and shifts (..., 3)."""
    H = np.broadcast_to(np.eye(4), (*np.shape(turn)[:-1], 4, 4)).copy()
    H[..., :3, :3], H[..., :3, 3] = Rotation.from_rotvec(turn).as_matrix(), x
    return H


def panel(t: float | np.ndarray) -> np.ndarray:
    """A hand's motion: half a turn a second about a fixed axis, a fifth of a metre a second."""
    t = np.asarray(t)[..., None]
    return matrix(np.array([0.1, 0.4, 0.2]) * (t + 1), np.array([0.5, 0, 1.2]) + t * [0.2, -0.1, 0])


def table(t: float | np.ndarray) -> np.ndarray:
    return matrix(np.array([0, 0.0, 0.6]) * np.asarray(t)[..., None], np.array([0.1, 0.2, 0.3]))


def recording(name: str, motion: Callable[..., Any], begin: float = 0.0, end: float = 4.0, rate: float = 100.0) -> library.PoseStream:
    t = np.arange(begin, end, 1 / rate)
    return library.PoseStream(name, t, motion(t), np.full(t.size, np.nan), rate_hz=rate)


def twist(H: np.ndarray) -> np.ndarray:
    """Turn and shift (6,) of a small transform, by the matrix logarithm."""
    L = np.real(logm(H))
    return np.array([L[2, 1], L[0, 2], L[1, 0], *L[:3, 3]])


def moved(xi: np.ndarray) -> np.ndarray:
    a, b, c = xi[:3]
    return expm(np.block([[np.array([[0, -c, b], [c, 0, -a], [-b, a, 0]]), xi[3:, None]], [np.zeros((1, 4))]]))


def test_the_camera_is_where_the_tracked_body_carried_it() -> None:
    found = library.place(TRACKED, recording("panel", panel), 2.25)
    assert (found.name, found.body, found.t_camera_s) == ("H_OC", None, 2.25)
    assert "moving" in found.source
    assert np.allclose(found.H_AC, panel(2.0) @ H_PC, atol=1e-5)


def test_a_clock_that_drifts_is_followed() -> None:
    drifting = replace(TRACKED, tracking=replace(TRACKING, clock_drift_ppm=1000.0, clock_middle_s=10.0))
    found = library.place(drifting, recording("panel", panel), 2.25)
    assert np.allclose(found.H_AC, panel(2.25 - 1e-3 * (2.25 - 10.0) - 0.25) @ H_PC, atol=1e-5)


def test_another_recording_has_its_own_clock() -> None:
    found = library.place(TRACKED, recording("panel", panel), 2.25, clock_offset_s=-0.5)
    assert np.allclose(found.H_AC, panel(2.75) @ H_PC, atol=1e-5)


def test_a_point_of_the_object_stays_where_it_is_in_the_body_that_it_rides_on() -> None:
    x_M = np.array([0.02, -0.01, 0.03, 1.0])
    for t in (1.0, 1.5, 2.0):
        found = library.place(TRACKED, recording("panel", panel), t + 0.25, object_poses=recording("table", table))
        assert (found.name, found.body) == ("H_MC", "table")
        x_C = np.linalg.inv(panel(t) @ H_PC) @ table(t) @ x_M
        assert np.allclose(found.H_AC @ x_C, x_M, atol=1e-5)


def test_a_camera_that_stands_still_sees_the_table_turn() -> None:
    fixed = replace(TRACKED, carries="board")
    assert np.allclose(library.place(fixed, t_camera_s=1.0).H_AC, H_PC)
    found = library.place(fixed, t_camera_s=1.75, object_poses=recording("table", table))
    assert np.allclose(found.H_AC, np.linalg.inv(table(1.5)) @ H_PC, atol=1e-5)


def test_a_stated_pose_needs_no_recording() -> None:
    H_OP = panel(1.0)
    assert np.allclose(library.place(TRACKED, H_OP=H_OP).H_AC, H_OP @ H_PC)
    found = library.place(library.Calibration("none", ()), H_OC=H_OP, tolerance=(1e-3, 2e-3))
    assert np.allclose(found.position_std_m, 1e-3)
    assert np.allclose(found.rotation_std_rad, 2e-3)


@pytest.mark.parametrize("rides", [False, True])
def test_the_covariance_is_the_spread_of_what_is_found(rides: bool) -> None:
    """Poses, H_PC and the clock off by what the calibration says of them, 300 times: NEES of 6 numbers between 5.2 and 6.8."""
    rng = np.random.default_rng(5)
    t, sigma_rad = 2.0, np.radians(TRACKING.mocap_sigma_deg)
    right = np.linalg.inv(table(t)) @ panel(t) @ H_PC if rides else panel(t) @ H_PC
    spread = np.linalg.cholesky(TRACKING.H_PC_covariance)

    def seen(motion: Callable[..., Any], late: float) -> PoseStream:
        turn = Rotation.from_rotvec(sigma_rad * rng.standard_normal(3)).as_matrix()
        shift = TRACKING.mocap_sigma_m * rng.standard_normal(3)

        def pose(moments: np.ndarray) -> np.ndarray:
            H = motion(moments + late)
            H[:, :3, :3], H[:, :3, 3] = turn @ H[:, :3, :3], H[:, :3, 3] + shift
            return H

        return recording("body", pose, 1.6, 2.4, 50.0)

    nees = []
    for _ in range(300):
        late = TRACKING.clock_offset_std_s * rng.standard_normal()
        wrong = replace(TRACKED, H_PC=moved(spread @ rng.standard_normal(6)) @ H_PC)
        other = seen(table, late) if rides else None
        found = library.place(wrong, seen(panel, late), t + 0.25, object_poses=other)
        xi = twist(right @ np.linalg.inv(found.H_AC))
        nees.append(xi @ np.linalg.solve(found.covariance, xi))
    assert 5.2 < np.mean(nees) < 6.8


def test_what_captures_share_and_what_is_their_own_make_the_whole() -> None:
    found = library.place(TRACKED, recording("panel", panel), 2.25, object_poses=recording("table", table))
    shared = found.by_handeye @ TRACKING.H_PC_covariance @ found.by_handeye.T + 0.002**2 * np.outer(found.by_clock, found.by_clock)
    assert np.allclose(found.covariance, found.noise_covariance + shared)
    again = placement_from_document(json.loads(json.dumps(placement_document(found), default=lambda one: one.tolist())))
    for name in ("H_AC", "covariance", "noise_covariance", "by_handeye", "by_clock"):
        assert np.allclose(getattr(again, name), getattr(found, name), atol=1e-15)
    assert (again.body, again.t_camera_s, again.source) == (found.body, found.t_camera_s, found.source)
    later = library.place(TRACKED, recording("panel", panel), 2.25 + 1e-3)
    ahead = library.place(TRACKED, recording("panel", panel), 2.25)
    assert np.allclose(-1e-3 * ahead.by_clock, twist(later.H_AC @ np.linalg.inv(ahead.H_AC)), atol=1e-5)


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"t_camera_s": 9.0}, DegenerateError, "outside the mocap recording"),
        ({"t_camera_s": None}, InputError, "no time"),
        ({"poses": None}, InputError, "no recording"),
        ({"H_OP": np.eye(4)}, UsageError, "more than one"),
        ({"poses": None, "H_OP": np.ones((4, 4))}, InputError, "H_OP"),
        ({"calibration": library.Calibration("bare", ())}, InputError, "H_PC"),
    ],
)
def test_what_cannot_be_placed_says_why(change: Any, error: type[Exception], words: str) -> None:
    given = {"calibration": TRACKED, "poses": recording("panel", panel), "t_camera_s": 2.0} | change
    with pytest.raises(error, match=words):
        library.place(**given)


def test_capture_yaml_states_a_pose_with_its_units(tmp_path: Path) -> None:
    (tmp_path / "capture.yaml").write_text(
        "time: 12.5 s\npose:\n  H_OP: {position: [812.5 mm, -3 cm, 0.4 m], rotation_vector: [0 deg, 90 deg, 0 deg]}\n"
        "  tolerance: [0.2 mm, 0.1 deg]\n"
    )
    place = stated_place_of(tmp_path)
    assert place.t_camera_s == 12.5
    assert np.allclose(place.H_OP, matrix(np.array([0, np.pi / 2, 0]), np.array([0.8125, -0.03, 0.4])))
    assert np.allclose(place.tolerance, (2e-4, np.radians(0.1)))
    (tmp_path / "capture.yaml").write_text("pose: {H_OC: {position: [0 m, 0 m, 1 m], quaternion: [0, 0, 0.70711, 0.70711]}}\n")
    assert np.allclose(stated_place_of(tmp_path).H_OC, matrix(np.array([0, 0, np.pi / 2]), np.array([0, 0, 1.0])), atol=1e-5)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time: 12.5\n", "bare number"),
        ("pose: {H_OP: {position: [1, 2, 3], quaternion: [0, 0, 0, 1]}}\n", "bare number"),
        ("pose: {H_OP: {position: [1 m, 2 m, 3 m]}}\n", "no rotation"),
        ("pose: {H_OP: {position: [1 m, 2 m, 3 m], quaternion: [0, 0, 0, 2]}}\n", "length 2"),
        ("pose: {tolerance: [1 mm, 1 deg]}\n", "neither H_OP nor H_OC"),
        ("position: [1 m, 2 m, 3 m]\n", "unknown key"),
    ],
)
def test_what_is_written_wrong_is_named_with_its_line(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "capture.yaml").write_text(text)
    with pytest.raises(InputError, match=words) as found:
        read_capture_section(tmp_path / "capture.yaml")
    assert "capture.yaml" in str(found.value)


def test_a_calibration_keeps_what_it_knows_of_the_tracking(tmp_path: Path) -> None:
    whole = replace(calibration(), H_PC=H_PC, tracking=TRACKING)
    write_calibration(tmp_path / "calibration.yaml", whole, Provenance())
    again = read_calibration(tmp_path / "calibration.yaml").tracking
    assert np.allclose(again.H_PC_covariance, TRACKING.H_PC_covariance, atol=0, rtol=1e-6)
    assert (again.clock_offset_s, again.mocap_sigma_m, again.mocap_sigma_dwell_m) == (0.25, 4e-4, None)


def csv_of(stream: library.PoseStream) -> str:
    rows = [
        ",".join(f"{one:.9f}" for one in (t, *H[:3, 3], *Rotation.from_matrix(H[:3, :3]).as_quat()))
        for t, H in zip(stream.t_s, stream.H_OP, strict=True)
    ]
    return "\n".join(["t_s,x_m,y_m,z_m,qx,qy,qz,qw", *rows]) + "\n"


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    """A rig whose one object was taken at 2.25 s of the camera's clock, with a mask that spares the search for it."""
    raw = draw(Scene(), calibration())
    (tmp_path / "panel.yaml").write_text(
        "lpcal: 1\nlights: {L0: {}, L1: {}, L2: {}, L3: {}, L4: {}, L5: {}}\nobjects: {ball: ball}\nmocap: {file: mocap.csv}\n"
    )
    (tmp_path / "mocap.csv").write_text(csv_of(recording("panel", panel)))
    write_calibration(tmp_path / "calib/calibration.yaml", replace(calibration(), H_PC=H_PC, tracking=TRACKING), Provenance())
    folder = tmp_path / "ball"
    folder.mkdir()
    for name, image in zip((*raw.lights, "ambient"), (*raw.images, raw.ambient[0]), strict=True):
        cv2.imwrite(str(folder / f"{name}.png"), np.rint(65535 * image).astype(np.uint16))
    cv2.imwrite(str(folder / "mask.png"), 255 * truth(Scene())[0].astype(np.uint8))
    (folder / "capture.yaml").write_text("time: 2.25 s\n")
    return tmp_path


def test_a_surface_lies_in_the_room_and_is_made_anew_when_its_recording_is_another(
    lpcal: Callable[..., tuple[int, str, str]], rig: Path
) -> None:
    words = ("reconstruct", "--outputs", "maps,ply,glb", "--mesh-frame", "placed")
    code, told, said = lpcal(*words, cwd=rig)
    assert code == 0, said
    assert "placed: the camera at" in told
    surface = read_surface(rig / "surfaces/ball")
    right = panel(2.0) @ H_PC
    assert np.allclose(surface.placement.H_AC, right, atol=1e-5)
    x_C = (surface.depth[..., None] * surface.rays_C)[surface.mask].astype(float)
    x_O = x_C @ right[:3, :3].T + right[:3, 3]
    for name in ("mesh.ply", "mesh.glb"):
        vertices = trimesh.load(rig / f"surfaces/ball/{name}", force="mesh").vertices
        assert np.allclose(vertices.min(axis=0), x_O.min(axis=0), atol=1e-4)
        assert np.allclose(vertices.max(axis=0), x_O.max(axis=0), atol=1e-4)
    assert b"comment frame O: the room, metres" in (rig / "surfaces/ball/mesh.ply").read_bytes()[:400]
    assert "up to date" in lpcal(*words, cwd=rig)[1]
    (rig / "mocap.csv").write_text(csv_of(recording("panel", lambda t: panel(t + 0.1))))
    code, told, said = lpcal(*words, cwd=rig)
    assert "up to date" not in told
    assert np.allclose(read_surface(rig / "surfaces/ball").placement.H_AC, panel(2.1) @ H_PC, atol=1e-5)


def test_a_capture_outside_its_recording_is_a_surface_all_the_same(lpcal: Callable[..., tuple[int, str, str]], rig: Path) -> None:
    (rig / "ball/capture.yaml").write_text("time: 200 s\n")
    code, _, said = lpcal("reconstruct", "--outputs", "maps", cwd=rig)
    assert code == 0, said
    assert "not placed in the room: no pose of" in said
    assert read_surface(rig / "surfaces/ball").placement is None


def test_a_body_without_its_time_is_an_error_before_anything_is_computed(lpcal: Callable[..., tuple[int, str, str]], rig: Path) -> None:
    (rig / "ball/capture.yaml").write_text("body: turntable\n")
    code, _, said = lpcal("reconstruct", "--outputs", "maps", cwd=rig)
    assert code == InputError.exit_code
    assert "body without time" in said

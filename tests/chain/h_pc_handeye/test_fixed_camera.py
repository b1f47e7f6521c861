"""A camera that stands still and a board on the tracked body: told from a camera on the body, solved, and written under its own names."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

from handeye_scene import Session, moving_session, static_session
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import HandEyeFinding, HandEyeOptions, solve_moving, solve_paired
from lpcal.chain.h_pc_handeye.set_up import SetUp, of_pairs
from lpcal.errors import DisagreementError
from lpcal.formats.handeye_yaml import read_handeye, write_handeye
from lpcal.formats.pasted_transforms import write_easy_handeye
from lpcal.geometry import se3
from lpcal.geometry.pose_track import poses_at
from lpcal.records.provenance import Provenance

SEEDS = [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 2))]


def nees(session: Session, found: HandEyeFinding) -> np.ndarray:
    """Of H_OC and of H_PB, six numbers each."""
    handeye = found.handeye
    pairs = ((session.H_PC, handeye.H_PC, handeye.H_PC_covariance), (session.H_OB, handeye.H_OB, handeye.H_OB_covariance))
    errors = [se3.log(H @ se3.inv(of)) for H, of, _ in pairs]
    return np.array([e @ np.linalg.solve(C, e) for e, (_, _, C) in zip(errors, pairs, strict=True)])


def paired(session: Session, options: HandEyeOptions | None = None) -> HandEyeFinding:
    return solve_paired(session.boards, session.H_OP, session.camera, options or HandEyeOptions())


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("inverted", [False, True])
def test_a_fixed_camera_is_told_and_solved(seed: int, inverted: bool) -> None:
    session = static_session(np.random.default_rng(seed), 24, fixed=True)
    read = replace(session, H_OP=se3.inv(session.H_OP)) if inverted else session
    found = paired(read, HandEyeOptions(inverted=inverted))
    assert found.handeye.carries == "board"
    assert found.handeye.names == ("H_OC", "H_PB")
    assert (nees(session, found) < 22.5).all(), "the 99.9 % point of chi^2 of six"
    assert np.linalg.norm(found.handeye.H_PC[:3, 3] - session.H_PC[:3, 3]) < 2e-3
    assert np.linalg.norm(found.handeye.H_OB[:3, 3] - session.H_OB[:3, 3]) < 1e-3
    assert any("not mocap.direction: H_PO" in each for each in found.handeye.warnings) == inverted
    np.testing.assert_allclose(found.set_up.as_measured(read.H_OP), session.H_OP)


@pytest.mark.parametrize("seeds", [range(4), pytest.param(range(12), marks=pytest.mark.slow)])
def test_the_sigmas_of_a_fixed_camera_are_its_errors(seeds: range) -> None:
    sessions = [static_session(np.random.default_rng(100 + seed), 24, fixed=True) for seed in seeds]
    mean = np.mean([nees(session, paired(session)) for session in sessions], axis=0)
    assert (mean > 2.5).all()
    assert (mean < 10).all(), "draws of six numbers: 6 +- 1 for twelve of them"


@pytest.mark.parametrize("seed", SEEDS)
def test_a_board_waved_before_a_fixed_camera(seed: int) -> None:
    session = moving_session(np.random.default_rng(seed), 60, fixed=True)
    assert session.stream is not None
    found = solve_moving(session.boards, track_of(session.stream), session.camera, HandEyeOptions())
    assert found.handeye.carries == "board"
    assert (nees(session, found) < 22.5).all()
    assert found.handeye.clock_offset_s is not None
    assert abs(found.handeye.clock_offset_s - session.offset_s) < 2e-3


@pytest.mark.parametrize("seed", SEEDS)
def test_a_camera_on_the_body_stays_one(seed: int) -> None:
    session = static_session(np.random.default_rng(seed), 24)
    assert of_pairs(session.H_OP, session.boards.H_CB, HandEyeOptions()) == SetUp()
    assert paired(session).handeye.carries == "camera"
    with pytest.raises(DisagreementError, match="inverted") as error:
        paired(replace(session, H_OP=se3.inv(session.H_OP)))
    assert "mocap.carries: board" in error.value.todo


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_stated_counts(seed: int) -> None:
    session = static_session(np.random.default_rng(seed), 24, fixed=True)
    near = replace(session, H_OP=se3.inv(session.H_PC) @ session.H_OP, H_PC=np.eye(4))  # the room's origin in the camera
    found = paired(near, HandEyeOptions(carries="board"))
    assert found.handeye.carries == "board"
    assert np.linalg.norm(found.handeye.H_PC[:3, 3]) < 2e-3
    with pytest.raises(DisagreementError):
        paired(session, HandEyeOptions(carries="camera"))


def test_a_track_turned_round_moves_as_its_poses_do() -> None:
    stream = moving_session(np.random.default_rng(3), 20).stream
    assert stream is not None
    track = replace(track_of(stream), inverse=True)
    t, dt = np.linspace(1.2, 2.0, 9), 1e-3
    here, there = poses_at(track, t), poses_at(track, t + dt)
    np.testing.assert_allclose(here.H @ poses_at(replace(track, inverse=False), t).H, np.tile(np.eye(4), (9, 1, 1)), atol=1e-12)
    turn = se3.rotation_vector(there.H[:, :3, :3] @ np.swapaxes(here.H[:, :3, :3], 1, 2)) / dt
    shift = (there.H[:, :3, 3] - here.H[:, :3, 3]) / dt
    scale = np.abs(here.velocity).max()
    assert np.median(np.abs(np.concatenate([turn, shift], axis=1) - here.velocity)) < 0.15 * scale


def test_files_bear_the_names_of_a_fixed_camera(tmp_path: Path) -> None:
    session = static_session(np.random.default_rng(5), 24, fixed=True)
    found = paired(session).handeye
    path = tmp_path / "handeye.yaml"
    write_handeye(path, found, Provenance({}, {}), "wand")
    document = yaml.safe_load(path.read_text())
    assert not {"H_PC", "H_OB", "H_PC_covariance"} & set(document)
    assert set(document["transforms"]) == {"H_OC", "H_CO", "H_PB", "H_BP"}
    assert "board coordinates to wand coordinates" in document["transforms"]["H_PB"]["says"]
    assert "H_PC" not in path.read_text()
    again = read_handeye(path)
    assert again.carries == "board"
    np.testing.assert_allclose(again.H_PC, found.H_PC)
    np.testing.assert_allclose(again.H_OB_covariance, found.H_OB_covariance)
    write_easy_handeye(tmp_path / "easy.yaml", found.H_PC, "wand", found.carries)
    assert yaml.safe_load((tmp_path / "easy.yaml").read_text())["parameters"]["eye_on_hand"] is False

"""Images stamped at another time than they were taken at: said with by how much, and never of sound sessions or of lost poses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import lpcal
from handeye_scene import Session, moving_session
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_moving
from lpcal.errors import DisagreementError


def warnings(session: Session, t_camera_s: np.ndarray) -> str:
    found = solve_moving(replace(session.boards, t_camera_s=t_camera_s), track_of(session.stream), session.camera, HandEyeOptions())
    return "\n".join(found.handeye.warnings)


@pytest.mark.parametrize(("seed", "by_s"), [(0, 0.083), (1, 0.15), (2, -0.06)])
def test_stamps_a_frame_off_are_named(seed: int, by_s: float) -> None:
    session = moving_session(np.random.default_rng(seed), 48)
    off = np.random.default_rng(seed + 10).random(48) < 0.25
    words = warnings(session, session.boards.t_camera_s + by_s * off)
    assert f"{abs(1e3 * by_s):.0f} ms {'earlier' if by_s > 0 else 'later'}" in words


@pytest.mark.parametrize("seed", [0, 1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (2, 3))])
def test_right_stamps_are_not_doubted(seed: int) -> None:
    session = moving_session(np.random.default_rng(seed), 48, flips=0.1 * (seed % 2))
    assert "stamps" not in warnings(session, session.boards.t_camera_s)


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 2))])
def test_blurred_boards_are_no_wrong_stamps(seed: int) -> None:
    session = moving_session(np.random.default_rng(seed), 72)
    rng = np.random.default_rng(seed + 20)
    blurred = rng.random(72) < 0.2
    corners = session.boards.corners_px + blurred[:, None, None] * rng.normal(0, 4.0, (72, 1, 2))
    shift = np.where(blurred[:, None], rng.normal(0, 0.004, (72, 3)), 0)
    H_CB = session.boards.H_CB.copy()
    H_CB[:, :3, 3] += shift
    smeared = replace(session, boards=replace(session.boards, corners_px=corners, H_CB=H_CB))
    assert "stamps" not in warnings(smeared, session.boards.t_camera_s)


@pytest.mark.parametrize(("factor", "words"), [(2.0, "runs 0.5 times as long"), (0.5, "runs 2 times as long"), (1.2, "runs 0.8333 times")])
def test_a_recording_whose_rate_is_misread_is_named(factor: float, words: str) -> None:
    session = moving_session(np.random.default_rng(0), 48)
    stream = replace(session.stream, t_s=factor * session.stream.t_s)
    with pytest.raises(DisagreementError, match=words):
        solve_moving(session.boards, track_of(stream), session.camera, HandEyeOptions())
    found = lpcal.check_handeye(stream, session.boards)
    assert [words in one.found for one in found.wrong] == [True]


def test_a_misread_rate_hides_no_other_mistake() -> None:
    """A recording at half its times whose poses are those of a mirrored room, too: both are named, and figures are those at true times."""
    session = moving_session(np.random.default_rng(0), 48)
    mirrored = np.diag([1.0, -1.0, 1.0, 1.0])
    stream = replace(session.stream, t_s=2 * session.stream.t_s, H_OP=mirrored @ session.stream.H_OP @ mirrored)
    found = lpcal.check_handeye(stream, session.boards)
    alone = lpcal.check_handeye(replace(stream, t_s=session.stream.t_s), session.boards)
    assert "times as long" in found.wrong[0].found
    assert [one.found for one in found.wrong[1:]] == [one.found for one in alone.wrong] != []


def test_other_mistakes_are_no_misread_rate() -> None:
    session = moving_session(np.random.default_rng(1), 48)
    mirrored = np.diag([1.0, -1.0, 1.0, 1.0])
    for wrong in (np.linalg.inv(session.stream.H_OP), mirrored @ session.stream.H_OP @ mirrored):
        found = lpcal.check_handeye(replace(session.stream, H_OP=wrong), session.boards)
        assert found.wrong
        assert "times as long" not in found.wrong[0].found

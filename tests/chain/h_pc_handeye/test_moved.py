"""What happens to a session on its way: the board or the camera moved, boards found by either end, lost poses that lend an axis."""

from __future__ import annotations

import numpy as np
import pytest

from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_paired
from lpcal.chain.h_pc_handeye.ends import settled_ends
from lpcal.chain.h_pc_handeye.moved import find_step
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import HandEye
from lpcal.records.observations import BoardPoses

H_PC = se3.transform(se3.rotation(np.array([0.3, -0.2, 0.9])), np.array([0.03, -0.05, 0.08]))
H_OB = se3.transform(se3.rotation(np.array([0.1, 2.9, 0.2])), np.array([0.5, 1.0, 0.2]))
NOISE = np.array([6e-4] * 3 + [4e-4] * 3)
"""Standard deviations of a panel pose's turn (rad) and shift (m)."""


def session(seed: int, count: int = 30, *, shared: float = 0.0) -> tuple[Array, Array]:
    """H_OP and H_CB of a session whose mocap has noise of its own and, in share, noise that wanders from view to view."""
    rng = np.random.default_rng(seed)
    tilt = se3.exp(np.concatenate([rng.normal(0, 0.25, (count, 3)), rng.normal(0, 0.05, (count, 3))], axis=1))
    H_CB = tilt @ se3.transform(se3.rotation(np.array([0.1, 0.2, 0.0])), np.array([-0.1, -0.06, 0.5]))
    white = rng.normal(size=(count, 6))
    wander = np.zeros((count, 6))
    for k in range(1, count):
        wander[k] = 0.8 * wander[k - 1] + 0.6 * rng.normal(size=6)
    H_OP = H_OB @ se3.inv(H_PC @ H_CB) @ se3.exp(NOISE * (np.sqrt(1 - shared) * white + np.sqrt(shared) * wander))
    return H_OP, H_CB


def step_of(H: Array, H_CB: Array) -> Array:
    """The board poses after a step H of the board (in its own frame) at half of the session."""
    late = np.arange(len(H_CB)) >= len(H_CB) // 2
    return np.where(late[:, None, None], H_CB @ H, H_CB)


NAMES = [f"v{k:02d}.png" for k in range(60)]
TURN = se3.exp(np.array([0, 0, np.radians(1.7), 0.02, 0, 0]))


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("what", "H"), [("board", TURN), ("board", se3.exp(np.array([0, 0, 0, 0.005, 0.004, 0]))), ("camera", TURN)])
def test_a_step_is_named(seed: int, what: str, H: Array) -> None:
    H_OP, H_CB = session(seed)
    late = np.arange(30) >= 17
    moved = H_CB @ H if what == "board" else H @ H_CB
    found = find_step(H_OP, np.where(late[:, None, None], moved, H_CB), NAMES[:30])
    assert found is not None
    assert found.after in {"v16.png", "v17.png", "v18.png"}, "a step of a few sigmas may be placed a view off"
    assert NAMES.index(found.after) == NAMES.index(found.before) + 1
    if np.linalg.norm(H[:3, 3]) > 0.01:
        assert what in found.what
        assert abs(np.degrees(found.angle_rad) - 1.7) < 0.25
    assert found.parted_m < 0.6 * found.misplaced_m


@pytest.mark.parametrize("shared", [0.0, 0.6, 0.9])
def test_a_session_in_one_piece_is_left_alone(shared: float) -> None:
    assert all(find_step(*session(100 + seed, shared=shared), NAMES[:30]) is None for seed in range(8))


def test_handeye_refuses_a_step() -> None:
    H_OP, H_CB = session(7)
    with pytest.raises(DisagreementError, match=r"the board moved between v14\.png and v15\.png"):
        solve_paired(BoardPoses(tuple(NAMES[:30]), None, step_of(TURN, H_CB)), H_OP, None, HandEyeOptions())


@pytest.mark.parametrize("seed", range(3))
def test_boards_found_by_either_end_are_settled(seed: int) -> None:
    H_OP, H_CB = session(seed, 20)
    x, y = np.meshgrid(np.arange(9), np.arange(7))
    points_B = 0.025 * np.stack([x.ravel(), y.ravel(), np.zeros(63)], axis=1)
    flipped = np.arange(20) % 2 == 1
    H_turn = se3.transform(se3.rotation(np.array([0, 0, np.pi])), points_B[-1])
    corners_px = np.arange(20 * 63 * 2, dtype=float).reshape(20, 63, 2)
    found_CB = np.where(flipped[:, None, None], H_CB @ H_turn, H_CB)
    boards = BoardPoses(tuple(NAMES[:20]), None, found_CB, corners_px, points_B)
    settled, turned = settled_ends(boards, H_OP, np.ones(20, dtype=bool))
    assert turned.sum() == 10
    assert (turned == flipped).all() or (turned == ~flipped).all()
    board_O = H_OP @ H_PC @ settled.H_CB
    assert np.ptp(board_O[:, :3, 3], axis=0).max() < 0.02
    whole = BoardPoses(tuple(NAMES[:20]), None, H_CB, corners_px, points_B)
    assert not settled_ends(whole, H_OP, np.ones(20, dtype=bool))[1].any()


@pytest.mark.parametrize("lost", [1, 3])
def test_a_few_lost_poses_lend_no_axis(lost: int) -> None:
    angle = np.linspace(-0.6, 0.6, 24)
    H_OP = se3.transform(
        se3.rotation(np.stack([0 * angle, 0 * angle, angle], axis=1)), np.stack([0.1 * angle, 0.2 * angle, 0 * angle], axis=1)
    )
    H_CB = se3.inv(H_OP @ H_PC) @ H_OB
    H_OP = H_OP.copy()
    H_OP[4 : 4 + lost] = np.eye(4)
    with pytest.raises(DegenerateError, match="about one axis only, about its z"):
        solve_paired(BoardPoses(tuple(NAMES[:24]), None, H_CB), H_OP, None, HandEyeOptions())


@pytest.mark.parametrize("scale", [1.015, 0.98, 1.03])
def test_a_board_of_another_size_than_stated_is_solved_for_and_said(scale: float) -> None:
    H_OP, H_CB = session(3)
    small = H_CB.copy()
    small[:, :3, 3] /= scale
    boards = BoardPoses(tuple(NAMES[:30]), None, small)
    found = solve_paired(boards, H_OP, None, HandEyeOptions()).handeye
    error = se3.log(found.H_PC @ se3.inv(H_PC))
    nees = error @ np.linalg.solve(found.H_PC_covariance, error)
    assert nees < 16.8
    assert abs(found.evidence.board_size_by_mocap - scale) < 4 * found.evidence.board_size_by_mocap_std
    assert any("mocap measures the board" in warning and "H_PC is in the mocap's metres" in warning for warning in found.warnings)
    sound = solve_paired(BoardPoses(tuple(NAMES[:30]), None, H_CB), H_OP, None, HandEyeOptions()).handeye
    assert not any("mocap measures the board" in warning for warning in sound.warnings)


def test_origin_sigmas_are_those_of_the_origin() -> None:
    rng = np.random.default_rng(0)
    H = se3.transform(se3.rotation(np.array([0.1, 0.5, -0.3])), np.array([0.8, -0.5, 0.3]))
    A = rng.normal(size=(6, 6)) * 1e-3
    drawn = se3.exp(rng.multivariate_normal(np.zeros(6), A @ A.T, 20000)) @ H
    np.testing.assert_allclose(se3.origin_sigmas(H, A @ A.T), drawn[:, :3, 3].std(axis=0), rtol=0.03)
    found = HandEye(H, A @ A.T, np.eye(4), np.eye(6), None, None, ())
    np.testing.assert_allclose(found.position_std_m, drawn[:, :3, 3].std(axis=0), rtol=0.03)
    turns = np.array([se3.rotation_vector(one[:3, :3] @ H[:3, :3].T) for one in drawn[:4000]])
    np.testing.assert_allclose(found.rotation_std_rad, turns.std(axis=0), rtol=0.06)

"""Images stamped at another time than they were taken at: said with by how much, and never of sound sessions or of lost poses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handeye_scene import moving_session
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye.solve import Options, solve_moving


def warnings(session, t_camera_s: np.ndarray) -> str:
    found = solve_moving(replace(session.boards, t_camera_s=t_camera_s), track_of(session.stream), session.camera, Options())
    return "\n".join(found.handeye.warnings)


@pytest.mark.parametrize(("seed", "by_s"), [(0, 0.083), (1, 0.15), (2, -0.06)])
def test_stamps_a_frame_off_are_named(seed: int, by_s: float) -> None:
    session = moving_session(np.random.default_rng(seed), 48)
    off = np.random.default_rng(seed + 10).random(48) < 0.25
    words = warnings(session, session.boards.t_camera_s + by_s * off)
    assert f"{abs(1e3 * by_s):.0f} ms {'earlier' if by_s > 0 else 'later'}" in words


@pytest.mark.parametrize("seed", range(4))
def test_right_stamps_are_not_doubted(seed: int) -> None:
    session = moving_session(np.random.default_rng(seed), 48, flips=0.1 * (seed % 2))
    assert "stamps" not in warnings(session, session.boards.t_camera_s)

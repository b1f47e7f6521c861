"""What `lpcal check` says of the board's size before any solve: the truth where it shows, nothing where the closed form cannot tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handeye_scene import TYPICAL, Session, moving_session, static_session
from lpcal.chain.h_pc_handeye.congruence import closed_form_size_warning
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array


def warned(H_OP: Array, H_CB: Array) -> str | None:
    return closed_form_size_warning(H_OP, H_CB, park.consensus(H_OP, H_CB).H_PC, "camera")


def drifting(seed: int) -> tuple[Array, Array]:
    """A long sweep whose tracking errors last for a second: neighbours share them."""
    noise = replace(TYPICAL, mocap_rad=np.radians(0.6), mocap_m=4e-3, drift=0.95)
    session = moving_session(np.random.default_rng(seed), 120, noise, every_s=0.1)
    assert session.stream is not None
    assert session.boards.t_camera_s is not None
    return se3.interpolate(session.stream.H_OP, session.stream.t_s, session.boards.t_camera_s - session.offset_s), session.boards.H_CB


def sized(session: Session, share: float) -> tuple[Array, Array]:
    H_CB = session.boards.H_CB.copy()
    H_CB[:, :3, 3] *= share
    return session.H_OP, H_CB


@pytest.mark.parametrize("seeds", [range(4), pytest.param(range(8), marks=pytest.mark.slow)])
def test_errors_that_neighbours_share_make_no_other_size(seeds: range) -> None:
    said, z = [], []
    for seed in seeds:
        H_OP, H_CB = drifting(seed)
        said.append(warned(H_OP, H_CB))
        z.append((park.board_scale(H_OP, H_CB, park.consensus(H_OP, H_CB).H_PC[:3, :3]) - 1) / park.board_scale_sigma(H_OP, H_CB))
    assert said == [None] * len(seeds)
    assert 0.3 < np.sqrt(np.mean(np.square(z))) < 1.8


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_board_always_at_one_place_in_the_picture_tells_no_size(seed: int) -> None:
    """Its distance is then as good as a part of the camera's place on the body."""
    rng = np.random.default_rng(seed)
    session = static_session(rng, 28)
    H_CB = session.boards.H_CB.copy()
    H_CB[:, :3, 3] = rng.normal([0.02, -0.01, 0.9], 2e-3, (28, 3))
    error = rng.normal(0, [np.radians(0.03)] * 3 + [3e-4] * 3, (28, 6))
    H_OP = np.array([se3.exp(xi) @ H for xi, H in zip(error, session.H_OB @ se3.inv(session.H_PC @ H_CB), strict=True)])
    H_CB[:, :3, 3] *= 0.95
    assert warned(H_OP, H_CB) is None


@pytest.mark.parametrize(("seed", "share"), [(1, 0.985), (2, 0.985), (3, 1.02), (4, 1.01)])
def test_a_square_misstated_by_a_percent_is_named(seed: int, share: float) -> None:
    text = warned(*sized(static_session(np.random.default_rng(seed), 40), share))
    assert text is not None
    assert "its stated size" in text
    assert warned(*sized(static_session(np.random.default_rng(seed), 40), 1.0)) is None

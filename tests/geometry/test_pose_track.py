"""Pose tracks: flips, gaps and lone samples never reach an interpolated pose; dwells are averaged; velocities are right."""

from __future__ import annotations

import numpy as np
import pytest

from handeye_scene import Noise, moving_session, stop_and_shoot
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye.clock import as_good, offset_candidates
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import clean, poses_at

FLIP = se3.exp(np.array([0.0, 0.0, 2.1, 0.03, -0.02, 0.01]))


def _motion(t: Array) -> Array:
    xi = np.stack([0.3 * np.sin(2 * t), 0.2 * np.sin(3 * t), 0.1 * np.cos(t), 0.1 * np.sin(t), 0.2 * np.cos(2 * t), 0.1 * t], axis=1)
    return se3.exp(xi)


def test_flips_and_gaps_never_reach_a_pose() -> None:
    t = np.arange(0, 10, 1 / 120)
    H_OP = _motion(t)
    flipped = ((t > 2) & (t < 2.04)) | ((t > 5) & (t < 5.01)) | ((t > 7) & (t < 7.2))
    H_OP[flipped] = H_OP[flipped] @ FLIP
    gap = (t > 8) & (t < 8.3)
    track = clean(t[~gap], H_OP[~gap], np.full(np.sum(~gap), np.nan))
    asked = np.linspace(-0.1, 10.1, 800)
    found = poses_at(track, asked)
    error = np.linalg.norm((found.H - _motion(asked))[found.trusted].reshape(-1, 16), axis=1)
    assert error.max() < 2e-4  # the chord over a sampling interval
    assert 0.85 < found.trusted.mean() < 0.93
    lost = [why for why in found.why if why]
    assert {"outside the mocap recording", "the body was lost, or its markers swapped, within 50 ms"} == set(lost)


def test_a_flip_that_lasts_is_found_by_the_marker_error() -> None:
    t = np.arange(0, 10, 1 / 120)
    H_OP, error = _motion(t), np.full(len(t), 1e-4)
    swapped = (t > 4) & (t < 6)
    H_OP[swapped] = H_OP[swapped] @ FLIP
    error[swapped] = 0.01
    track = clean(t, H_OP, error)
    assert track.dropped["markers swapped, by the system's own error"] == swapped.sum()
    assert not poses_at(track, np.array([5.0])).trusted.any()
    assert not poses_at(clean(t, H_OP, np.full(len(t), np.nan)), np.array([4.02])).trusted.any()


def test_dwells_are_averaged_and_motion_is_not() -> None:
    rng = np.random.default_rng(0)
    t = np.arange(0, 8, 1 / 120)
    slow = _motion(np.where(t < 3, 0.0, t - 3))
    H_OP = se3.exp(rng.normal(0, [5e-4] * 3 + [1e-4] * 3, (len(t), 6))) @ slow
    found = poses_at(clean(t, H_OP, np.full(len(t), np.nan)), np.array([1.0, 1.5, 2.0, 4.0, 5.0]))
    assert found.steady.tolist() == [True, True, True, False, False]
    assert np.all(found.velocity[:3] == 0)
    single, mean = 5e-4, np.linalg.norm(se3.log(found.H[:3] @ se3.inv(slow[:1]))[:, :3], axis=1) / np.sqrt(3)
    assert np.sqrt(np.mean(mean**2)) < 0.35 * single


def test_velocity() -> None:
    t = np.arange(0, 10, 1 / 120)
    found = poses_at(clean(t, _motion(t), np.full(len(t), np.nan)), np.linspace(1, 9, 50))
    step = 1e-4
    later, before = _motion(found.t_mocap_s + step), _motion(found.t_mocap_s - step)
    turn = se3.rotation_vector(later[:, :3, :3] @ np.swapaxes(before[:, :3, :3], 1, 2)) / (2 * step)
    assert np.abs(found.velocity[:, :3] - turn).max() < 1e-2
    assert np.abs(found.velocity[:, 3:] - (later - before)[:, :3, 3] / (2 * step)).max() < 5e-3


def test_what_is_too_short_holds_no_pose() -> None:
    one = clean(np.zeros(1), np.eye(4)[None], np.full(1, np.nan))
    assert not poses_at(one, np.array([0.0])).trusted.any()


def test_many_short_flips_leave_the_rest_to_be_trusted() -> None:
    rng = np.random.default_rng(2)
    t = np.arange(0, 10, 1 / 120)
    H_OP = _motion(t)
    flipped = np.zeros(len(t), dtype=bool)
    while flipped.mean() < 0.2:
        start = rng.integers(len(t))
        flipped[start : start + int(rng.integers(1, 12))] = True
    H_OP[flipped] = H_OP[flipped] @ FLIP
    asked = np.linspace(0.2, 9.8, 500)
    found = poses_at(clean(t, H_OP, np.full(len(t), np.nan)), asked)
    assert (
        np.linalg.norm((found.H - _motion(asked))[found.trusted].reshape(-1, 16), axis=1).max() < 3e-4
    )  # a straight line over a gap of three samples
    assert found.trusted.mean() > 0.2


def test_a_moving_body_is_never_taken_for_resting() -> None:
    for seed in range(12):
        session = moving_session(np.random.default_rng(seed), 30)
        found = poses_at(
            clean(session.stream.t_s, session.stream.H_OP, session.stream.error_m), session.boards.t_camera_s - session.offset_s
        )
        assert not found.steady.any()
        assert np.all(np.any(found.velocity != 0, axis=1))


def test_a_resting_body_rests_and_has_no_speed() -> None:
    session, _ = stop_and_shoot(np.random.default_rng(0), 20, noise=Noise(drift=0.3))
    found = poses_at(clean(session.stream.t_s, session.stream.H_OP, session.stream.error_m), session.boards.t_camera_s - session.offset_s)
    assert found.steady.mean() > 0.9
    assert np.mean(np.any(found.velocity != 0, axis=1)) < 0.1


@pytest.mark.parametrize(("seed", "dwell_s"), [(1, 0.8), (2, 1.2), (3, 1.0), (4, 0.6)])
def test_the_offsets_between_which_all_views_fall_into_rests(seed: int, dwell_s: float) -> None:
    session, _ = stop_and_shoot(np.random.default_rng(seed), 20, noise=Noise(drift=0.3), dwell_s=dwell_s)
    track = track_of(session.stream)
    best = offset_candidates(track, session.boards.t_camera_s, session.boards.H_CB)[0]
    low, high = as_good(track, session.boards.t_camera_s, session.boards.H_CB, best)
    assert low < session.offset_s < high
    assert 0.5 * dwell_s < high - low < 1.8 * dwell_s
    middle = poses_at(track, session.boards.t_camera_s - (low + high) / 2)
    assert middle.steady[middle.trusted].all()


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_panel_that_moves_leaves_no_such_stretch(seed: int) -> None:
    session = moving_session(np.random.default_rng(seed), 40)
    track = track_of(session.stream)
    best = offset_candidates(track, session.boards.t_camera_s, session.boards.H_CB)[0]
    low, high = as_good(track, session.boards.t_camera_s, session.boards.H_CB, best)
    assert high - low < 0.1
    assert low - 0.02 < session.offset_s < high + 0.02

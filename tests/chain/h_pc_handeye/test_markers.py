"""Hand-eye from bare markers: a pose made of few markers close together counts for less than one made of all."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handeye_scene import Noise, Session, moving_session
from lpcal.chain.h_op_body import body_of
from lpcal.chain.h_op_panel import track_of
from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_moving
from lpcal.geometry import se3
from lpcal.geometry.pose_track import poses_at
from lpcal.records.observations import MarkerStream, PoseStream

PLACES_P = {"A": (0.01, 0.0, 0.0), "B": (0.0, 0.012, 0.002), "C": (-0.01, 0.004, 0.0), "D": (0.1, -0.09, 0.05), "E": (-0.12, -0.09, 0.0)}
SIGMA_M = 1e-4
EXACT = Noise(mocap_rad=1e-9, mocap_m=1e-9)


def _session(seed: int) -> tuple[Session, PoseStream]:
    """A session whose body is of five markers, the outer two of which are hidden half of the time; and the pose stream made of it."""
    rng = np.random.default_rng(seed)
    session = moving_session(rng, 60, EXACT)
    t, H_OP = session.stream.t_s, session.stream.H_OP
    x_P = np.array(list(PLACES_P.values()))
    x_O = se3.apply(H_OP, np.broadcast_to(x_P, (len(t), *x_P.shape))) + rng.normal(0, SIGMA_M, (len(t), 5, 3))
    x_O[(t % 1.0) < 0.5, 3:] = np.nan
    return session, body_of(MarkerStream("Panel", t, tuple(PLACES_P), x_O, 120.0), PLACES_P)


@pytest.mark.slow
def test_poses_count_by_their_own_covariance() -> None:
    weighted, alike, nees = [], [], []
    for seed in range(4):
        session, stream = _session(seed)
        for one, errors in ((stream, weighted), (replace(stream, covariance=None), alike)):
            found = solve_moving(session.boards, track_of(one), session.camera, HandEyeOptions()).handeye
            xi = se3.log(session.H_PC @ se3.inv(found.H_PC))
            errors.append(np.sum(xi[:3] ** 2))
            if one is stream:
                nees.append(xi @ np.linalg.solve(found.H_PC_covariance, xi))
    assert np.mean(weighted) < 0.6**2 * np.mean(alike)
    assert np.mean(nees) < 6 + 4 * np.sqrt(12 / 4)


def test_the_variance_of_a_pose_is_that_of_the_samples_around_it() -> None:
    _, stream = _session(0)
    track = track_of(stream)
    hidden, whole = poses_at(track, np.array([2.25, 2.75])).variance
    assert hidden[:3].min() > 20 * whole[:3].max()
    assert np.allclose(whole, track.variance[np.argmin(np.abs(track.t_s - 2.75))], rtol=0.3)

"""Stop and shoot without a clock: rests found, matched to the images in order, whatever lacks on either side; else refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from handeye_rigs import FLIP, image_rig
from handeye_scene import Noise, Session, stop_and_shoot
from lpcal.chain.h_op_panel import Rests, match_rests, rests_of, track_of
from lpcal.errors import DisagreementError
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.geometry import se3


def recorded(seed: int, views: int = 24, **kwargs: Any) -> tuple[Session, npt.NDArray[Any]]:
    session, view = stop_and_shoot(np.random.default_rng(seed), views, noise=Noise(drift=0.3), **kwargs)
    return session, view


def right_rests(rests: Rests, session: Session) -> npt.NDArray[Any]:
    """The rest of each view, by the time that the match does not know."""
    t = session.boards.t_camera_s - session.offset_s
    distance = np.abs(rests.t_s[None] - t[:, None])
    return np.where(distance.min(axis=1) < 0.6, np.argmin(distance, axis=1), -1)


@pytest.mark.parametrize("seed", range(4))
def test_every_view_finds_its_rest(seed: int) -> None:
    session, _ = recorded(seed)
    rests = rests_of(track_of(session.stream))
    assert len(rests.t_s) == 24
    assert np.array_equal(match_rests(rests, session.boards.H_CB), right_rests(rests, session))


@pytest.mark.parametrize("seed", range(3))
def test_rests_without_images_and_flipped_rests(seed: int) -> None:
    session, view = recorded(seed, 30)
    wrong = np.isin(view, [4, 17])
    H_OP = np.where(wrong[:, None, None], session.stream.H_OP @ FLIP, session.stream.H_OP)
    rests = rests_of(track_of(replace(session.stream, H_OP=H_OP)))
    taken = np.setdiff1d(np.arange(30), [0, 1, 9, 20, 29])
    H_CB = session.boards.H_CB[taken]
    right = right_rests(rests, session)[taken]
    found = match_rests(rests, H_CB)
    sound = ~np.isin(taken, [4, 17])
    assert np.mean(found[sound] == right[sound]) > 0.95
    assert np.all(found[sound][found[sound] != right[sound]] == -1)


def test_refusals() -> None:
    session, _ = recorded(5)
    rests = rests_of(track_of(session.stream))
    with pytest.raises(DisagreementError, match="do not match the 24 rests"):
        match_rests(rests, session.boards.H_CB[np.random.default_rng(0).permutation(24)])
    with pytest.raises(DisagreementError, match="do not match"):
        match_rests(rests, recorded(6)[0].boards.H_CB)
    with pytest.raises(DisagreementError, match="24 rests of the body in the recording for 3 views"):
        match_rests(rests, session.boards.H_CB[:3])


def test_command(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    session, _ = recorded(7)
    image_rig(tmp_path, session)
    text = (tmp_path / "panel.yaml").read_text()
    (tmp_path / "panel.yaml").write_text(text.replace(", images: times.csv", ""))
    code, out, err = lpcal("check", cwd=tmp_path)
    assert code == 0, out + err
    assert "24 of 24 views matched to the body's rests, in order" in out
    code, out, err = lpcal("handeye", cwd=tmp_path)
    assert code == 0, out + err
    found = read_handeye(tmp_path / "calib" / "handeye.yaml")
    xi = se3.log(session.H_PC @ se3.inv(found.H_PC))
    assert xi @ np.linalg.solve(found.H_PC_covariance, xi) < 25
    assert found.clock_offset_s is None
    assert all(view.used for view in found.views)


def test_a_rest_in_a_trembling_hand_is_a_rest() -> None:
    session, view = stop_and_shoot(np.random.default_rng(12), 20, noise=Noise(drift=0.9), dwell_s=0.8)
    found = rests_of(track_of(session.stream))
    period = 0.8 + 0.6
    assert len(found.t_s) == view.max() + 1
    assert np.abs(found.t_s - (np.arange(20) * period + 0.4))[:-1].max() < 0.1  # the last one goes on to the end

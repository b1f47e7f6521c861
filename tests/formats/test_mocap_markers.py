"""H_PD from marker tracks: the rigid fit's covariance is its spread; names that do not match are refused with those that are there."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lpcal.chain.h_pd_markers import h_pd_from_markers
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import rigid_fit, se3
from lpcal.geometry.arrays import Array
from lpcal.records.observations import PoseStream

MARKERS = {
    "A": (0.08, 0.0, 0.004),
    "B": (0.02, 0.08, 0.012),
    "C": (-0.07, 0.04, 0.004),
    "D": (-0.06, -0.06, 0.02),
    "E": (0.03, -0.08, 0.007),
}


def _stream(rng: np.random.Generator, H_PD: Array, glue_m: float) -> PoseStream:
    H_OP = se3.exp(rng.normal(0, 0.3, (50, 6)))
    tracks = {}
    for name, x_D in MARKERS.items():
        x_P = H_PD[:3, :3] @ (np.array(x_D) + rng.normal(0, glue_m, 3)) + H_PD[:3, 3]
        tracks[name] = H_OP[:, :3, :3] @ x_P + H_OP[:, :3, 3] + rng.normal(0, 1e-4, (50, 3))
    return PoseStream("Panel", np.arange(50) / 100, H_OP, np.full(50, 1e-4), tracks, rate_hz=100)


def test_covariance_is_the_spread() -> None:
    nees = []
    for seed in range(150):
        rng = np.random.default_rng(seed)
        H_PD = se3.exp(rng.normal(0, [0.05] * 3 + [0.004] * 3))
        found, covariance, misfit = h_pd_from_markers(_stream(rng, H_PD, 5e-4), MARKERS)
        error = se3.log(H_PD @ se3.inv(found))
        nees.append(error @ np.linalg.solve(covariance, error))
        assert max(misfit.values()) < 5e-3
    assert np.mean(nees) == pytest.approx(6.0, abs=1.3)


def test_lost_markers_and_swapped_moments_are_left_out() -> None:
    rng = np.random.default_rng(3)
    H_PD = se3.exp(rng.normal(0, [0.05] * 3 + [0.004] * 3))
    stream = _stream(rng, H_PD, 0.0)
    stream.markers_O["A"][:20] = np.nan
    stream.H_OP[30:40] = stream.H_OP[30:40] @ se3.exp(np.array([0, 0, 2.0, 0, 0, 0]))
    stream.error_m[30:40] = 0.01
    found, _, _ = h_pd_from_markers(stream, MARKERS)
    assert np.abs(found - H_PD).max() < 2e-3
    assert np.linalg.norm(found[:3, 3] - H_PD[:3, 3]) < 2e-4


def test_refusals() -> None:
    rng = np.random.default_rng(4)
    stream = _stream(rng, np.eye(4), 0.0)
    with pytest.raises(DisagreementError, match=r"no marker Z of Panel.*\n.*A, B, C, D, E"):
        h_pd_from_markers(stream, MARKERS | {"Z": (0.0, 0.0, 0.0)})
    with pytest.raises(DisagreementError, match="mm from where"):
        h_pd_from_markers(stream, MARKERS | {"A": (0.08, 0.0, 0.08)})
    with pytest.raises(DegenerateError, match="2 markers"):
        h_pd_from_markers(stream, {"A": MARKERS["A"], "B": MARKERS["B"]})
    with pytest.raises(DegenerateError, match="one line"):
        rigid_fit.fit(np.eye(3) * [1, 0, 0], np.array([[1.0, 0, 0], [2, 0, 0], [3, 0, 0]]))


def test_rig_a(data: Callable[[str], Path]) -> None:
    import yaml

    from lpcal.formats.mocap import read_mocap
    from lpcal.formats.panel_yaml import read_rig

    folder = data("rig_a")
    rig = read_rig(folder / "panel.yaml").rig
    H_PD, covariance, _ = h_pd_from_markers(read_mocap(folder / "mocap.csv", "LightPanel"), rig.panel.markers)
    true_PD = np.array(yaml.safe_load((folder / "truth" / "handeye.yaml").read_text())["H_PD"])
    error = se3.log(true_PD @ se3.inv(H_PD))
    assert error @ np.linalg.solve(covariance, error) < 22.5  # 99.9 % of six degrees of freedom

"""A body from bare markers: its poses within their own covariance, exchanged and strayed markers corrected, blind bodies refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lpcal.chain.h_op_body import body_of
from lpcal.errors import DegenerateError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.observations import MarkerStream

PLACES_P = {"A": (0.08, 0.0, 0.0), "B": (0.0, 0.06, 0.01), "C": (-0.07, 0.02, 0.0), "D": (0.01, -0.05, 0.03), "E": (-0.03, -0.06, 0.0)}
SIGMA_M = 2e-4


def recording(
    rng: np.random.Generator, count: int = 400, names: tuple[Any, ...] = tuple(PLACES_P), sigma_m: float = SIGMA_M
) -> tuple[MarkerStream, Array]:
    """A body that turns slowly, its markers seen with noise; the true poses."""
    t = np.arange(count) / 120
    xi = np.stack(
        [a * np.sin(2 * np.pi * f * t + p) for a, f, p in zip(rng.uniform(0.2, 0.5, 6), rng.uniform(0.2, 0.6, 6), range(6), strict=True)],
        axis=1,
    )
    H_OP = se3.exp(xi)
    x_P = np.array([PLACES_P[name] for name in names])
    x_O = se3.apply(H_OP, np.broadcast_to(x_P, (count, *x_P.shape))) + rng.normal(0, sigma_m, (count, len(names), 3))
    return MarkerStream("Panel", t, names, x_O, 120.0), H_OP


def test_poses_within_their_covariance() -> None:
    markers, true_OP = recording(np.random.default_rng(0), 2000)
    markers.x_O[::7, 2] = np.nan
    found = body_of(markers, PLACES_P)
    xi = se3.log(true_OP @ se3.inv(found.H_OP))
    nees = np.einsum("ni,nij,nj->n", xi, np.linalg.inv(found.covariance), xi)
    assert np.mean(nees) == pytest.approx(6.0, abs=0.5)
    assert np.sqrt(np.mean((found.H_OP[:, :3, 3] - true_OP[:, :3, 3]) ** 2)) < SIGMA_M
    assert found.lost == 0
    assert "in the frame of panel.markers" in found.notes[0]


def test_without_places_the_body_is_the_same_up_to_its_frame() -> None:
    markers, true_OP = recording(np.random.default_rng(1))
    found = body_of(markers)
    H_PP = se3.inv(true_OP) @ found.H_OP
    assert np.linalg.norm(H_PP[:, :3, 3] - H_PP[:, :3, 3].mean(axis=0), axis=1).max() < 2e-3
    assert np.degrees(se3.angle_rad(H_PP[:, :3, :3] @ H_PP[0, :3, :3].T)).max() < 1.5
    assert "origin their centre" in found.notes[0]


def test_exchanged_and_strayed_markers_are_mended() -> None:
    markers, true_OP = recording(np.random.default_rng(2))
    markers.x_O[50:80, [0, 3]] = markers.x_O[50:80, [3, 0]]
    markers.x_O[120:125, 1] += [0.03, 0.0, 0.02]
    markers.x_O[300:310] += np.random.default_rng(3).normal(0, 0.03, (10, 5, 3))
    found = body_of(markers, PLACES_P)
    true_OP = true_OP[np.searchsorted(markers.t_s, found.t_s)]
    assert found.lost >= 9
    assert "30 samples with two markers' names exchanged: put right" in found.notes
    assert any("with one marker off" in note for note in found.notes)
    inside = found.t_s < 2.4
    assert np.linalg.norm(found.H_OP[inside, :3, 3] - true_OP[inside, :3, 3], axis=1).max() < 1.2e-3
    assert np.isfinite(found.H_OP).all()


def test_three_markers() -> None:
    markers, true_OP = recording(np.random.default_rng(4), names=("A", "B", "C"))
    markers.x_O[10:20, [0, 1]] = markers.x_O[10:20, [1, 0]]
    markers.x_O[30:33, 2] = np.nan
    found = body_of(markers, PLACES_P)
    assert found.lost == 3
    assert (
        np.degrees(se3.angle_rad(found.H_OP[:, :3, :3] @ np.swapaxes(np.delete(true_OP, [30, 31, 32], axis=0)[:, :3, :3], 1, 2))).max() < 2
    )


def test_refusals() -> None:
    markers, _ = recording(np.random.default_rng(5))
    line = MarkerStream("Panel", markers.t_s, ("A", "B", "C"), markers.x_O[:, :1] + np.arange(3)[:, None] * [0.05, 0.0, 0.0])
    with pytest.raises(DegenerateError, match="on one line"):
        body_of(line)
    apart = markers.x_O.copy()
    apart[::2, 0], apart[1::2, 1] = np.nan, np.nan
    with pytest.raises(DegenerateError, match="never seen together, 4 at most"):
        body_of(MarkerStream("Panel", markers.t_s, markers.names, apart))

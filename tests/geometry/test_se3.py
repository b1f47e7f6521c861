"""The laws of rigid transforms, near their singularities too."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from lpcal.geometry import se3

ANGLES = [0.0, 1e-12, 1e-7, 1e-4, 1e-3, 0.3, 2.0, np.pi - 1e-3, np.pi - 1e-7]


def twists(angles: list[float] = ANGLES) -> st.SearchStrategy[np.ndarray]:
    unit = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)
    near = st.tuples(*[st.floats(-2, 2)] * 3)
    return st.builds(lambda a, v, t: np.concatenate([a * np.array(v) / np.linalg.norm(v), t]), st.sampled_from(angles), unit, near)


@given(twists())
@settings(deadline=None, max_examples=200)
def test_log_undoes_exp(xi: np.ndarray) -> None:
    H = se3.exp(xi)
    np.testing.assert_allclose(se3.exp(se3.log(H)), H, atol=1e-9)
    np.testing.assert_allclose(H[:3, :3] @ H[:3, :3].T, np.eye(3), atol=1e-12)


@given(twists(), twists())
@settings(deadline=None, max_examples=200)
def test_adjoint_moves_a_twist_through_a_transform(xi: np.ndarray, move: np.ndarray) -> None:
    H = se3.exp(move)
    np.testing.assert_allclose(H @ se3.exp(xi) @ se3.inv(H), se3.exp(se3.adjoint(H) @ xi), atol=1e-9)


@given(twists())
@settings(deadline=None, max_examples=200)
def test_quaternion_and_inverse(xi: np.ndarray) -> None:
    H = se3.exp(xi)
    np.testing.assert_allclose(se3.rotation_from_quaternion(se3.quaternion(H[:3, :3])), H[:3, :3], atol=1e-12)
    np.testing.assert_allclose(se3.inv(H) @ H, np.eye(4), atol=1e-12)


@given(twists([0.01, 0.3, 2.0]), st.floats(0, 1))
@settings(deadline=None, max_examples=100)
def test_interpolation_runs_along_one_axis(xi: np.ndarray, share: float) -> None:
    H = np.stack([np.eye(4), se3.exp(xi)])
    between = se3.interpolate(H, np.array([1.0, 3.0]), np.array([1.0 + 2 * share]))[0]
    np.testing.assert_allclose(se3.rotation_vector(between[:3, :3]), share * xi[:3], atol=1e-9)
    np.testing.assert_allclose(between[:3, 3], share * H[1, :3, 3], atol=1e-9)

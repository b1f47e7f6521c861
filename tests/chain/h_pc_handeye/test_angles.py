"""Robot poses whose three angles are read in another order than they were written in: named, with the key that corrects it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from handeye_scene import static_session
from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_paired
from lpcal.errors import DisagreementError
from lpcal.formats.robot_poses import ROTATIONS, Stated, read_robot_poses
from lpcal.geometry import se3


def numbers_of(R: np.ndarray, kind: str) -> np.ndarray:
    """Three numbers (N, 3) of rotations as `mocap.rotation` calls them, by turning the rotation's middle axis back."""
    if kind == "rotation_vector_deg":
        return np.degrees(se3.rotation_vector(R))
    if kind == "xyz_deg":  # R = Rx Ry Rz is the inverse of Rz Ry Rx of the opposite angles
        return -np.degrees(se3.angles_about_zyx(np.swapaxes(R, 1, 2)))[:, ::-1]
    zyx = np.degrees(se3.angles_about_zyx(R))
    return zyx if kind == "abc_deg" else zyx[:, ::-1]


@pytest.mark.parametrize("kind", ["abc_deg", "rpy_deg", "xyz_deg", "rotation_vector_deg"])
def test_numbers_come_back_as_their_rotation(kind: str) -> None:
    R = se3.rotation(np.random.default_rng(3).normal(0, 0.7, (40, 3)))
    np.testing.assert_allclose(ROTATIONS[kind](numbers_of(R, kind)), R, atol=1e-12)


def test_the_axes_of_three_angles() -> None:
    quarter = np.array([[np.pi / 2, 0, 0]])
    np.testing.assert_allclose(se3.rotation_about_axes(quarter, "zyx")[0] @ [1, 0, 0], [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(se3.rotation_about_axes(quarter, "xyz")[0] @ [0, 1, 0], [0, 0, 1], atol=1e-12)
    a, b, c = se3.rotation_about_axes(np.array([[0.3, -0.4, 0.8]]), "zyz"), se3.rotation(np.array([0, 0, 0.3])), 0.8
    np.testing.assert_allclose(a[0], b @ se3.rotation(np.array([0, -0.4, 0])) @ se3.rotation(np.array([0, 0, c])), atol=1e-12)


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    ("written", "read"), [("xyz_deg", "abc_deg"), ("rpy_deg", "abc_deg"), ("abc_deg", "rpy_deg"), ("rotation_vector_deg", "abc_deg")]
)
def test_another_order_is_named(tmp_path: Path, seed: int, written: str, read: str) -> None:
    session = static_session(np.random.default_rng(seed), 24)
    rows = np.concatenate([session.H_OP[:, :3, 3], numbers_of(session.H_OP[:, :3, :3], written)], axis=1)
    path = tmp_path / "robot.txt"
    path.write_text("\n".join(" ".join(f"{value:.9f}" for value in row) for row in rows))
    wrong = read_robot_poses(path, Stated(rotation=read)).H
    with pytest.raises(DisagreementError, match="three numbers are of another order or kind") as error:
        solve_paired(session.boards, wrong, session.camera, HandEyeOptions())
    assert f"mocap.rotation: {written}" in error.value.todo or f"or {written}, if it says {read[:3]}" in error.value.todo
    right = read_robot_poses(path, Stated(rotation=written)).H
    assert solve_paired(session.boards, right, session.camera, HandEyeOptions()).handeye.carries == "camera"

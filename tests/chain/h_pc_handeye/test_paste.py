"""What users paste is the transform that was found, whichever form is read back; the left-out error is that of a solve without the view."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

from handeye_scene import static_session
from lpcal.chain.h_pc_handeye import HandEyeOptions, solve_paired
from lpcal.formats.pasted_transforms import both_ways, matrix_lines, write_easy_handeye
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array

FLOAT = r"-?\d+\.\d+"


@pytest.fixture(params=range(4))
def H(request: pytest.FixtureRequest) -> Array:
    return se3.exp(np.random.default_rng(request.param).normal(0, [1.2, 1.2, 1.2, 0.3, 0.3, 0.3]))


def back(R: Array, x: Array | list[float]) -> Array:
    return se3.transform(np.asarray(R), np.asarray(x))


def test_every_form_is_the_same_transform(H: Array) -> None:
    for name, H_AB in (("H_PC", H), ("H_CP", se3.inv(H)), ("H_OB", H @ H), ("H_BO", se3.inv(H @ H))):
        given = both_ways(H, H @ H, "Panel")[name]
        x = given["translation_m"]
        read = [
            given["matrix"],
            back(Rotation.from_quat(given["quaternion_xyzw"]).as_matrix(), x),
            back(Rotation.from_quat(given["quaternion_wxyz"], scalar_first=True).as_matrix(), x),
            back(Rotation.from_rotvec(given["rotation_vector_rad"]).as_matrix(), x),
            back(Rotation.from_euler("xyz", given["rpy_rad"]).as_matrix(), x),
        ]
        urdf = [float(number) for number in re.findall(FLOAT, given["urdf"])]
        read.append(back(Rotation.from_euler("xyz", urdf[3:]).as_matrix(), urdf[:3]))
        ros = [float(number) for number in re.findall(FLOAT, given["ros"])]
        read.append(back(Rotation.from_quat(ros[3:]).as_matrix(), ros[:3]))
        for form in read:
            assert np.abs(form - H_AB).max() < 3e-6
    assert both_ways(H, H, "Light Panel")["H_PC"]["ros"].endswith("--frame-id Light_Panel --child-frame-id camera")


def test_the_lines_are_python(H: Array) -> None:
    assert np.abs(np.array(ast.literal_eval("\n".join(matrix_lines(H)))) - H).max() < 1e-6


def test_easy_handeye(tmp_path: Path, H: Array) -> None:
    write_easy_handeye(tmp_path / "it.yaml", H, "Panel")
    document = yaml.safe_load((tmp_path / "it.yaml").read_text())
    t = document["transformation"]
    assert np.abs(back(Rotation.from_quat([t["qx"], t["qy"], t["qz"], t["qw"]]).as_matrix(), [t["x"], t["y"], t["z"]]) - H).max() < 1e-9
    assert document["parameters"]["eye_on_hand"] is True
    assert document["parameters"]["robot_effector_frame"] == "Panel"


def test_left_out_error_is_that_of_a_solve_without_the_view() -> None:
    session = static_session(np.random.default_rng(0), 14)
    found = solve_paired(session.boards, session.H_OP, session.camera, HandEyeOptions()).handeye
    apart = [view.held_out_m for view in found.views]
    for k in (0, 5, 9):
        rest = np.delete(np.arange(14), k)
        without = solve_paired(session.boards.of(rest), session.H_OP[rest], session.camera, HandEyeOptions()).handeye
        H_OB = session.H_OP[k] @ without.H_PC @ session.boards.H_CB[k]
        assert apart[k] == pytest.approx(np.linalg.norm(H_OB[:3, 3] - without.H_OB[:3, 3]), abs=1.5e-4)
    inside = np.sqrt(np.mean([view.residual_m**2 for view in found.views]))
    assert np.sqrt(np.mean(np.square(apart))) > inside

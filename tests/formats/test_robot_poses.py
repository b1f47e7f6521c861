"""Poses as controllers and programs write them, names that are nearly the images', rows without a pose, angles in radians."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.robot_poses import ImagePoses, Stated, read_robot_poses
from lpcal.geometry import se3
from lpcal.pipeline.handeye_inputs import _paired

COUNT = 7


def poses(seed: int = 0) -> np.ndarray:
    """Poses (N, 4, 4) of a robot's flange, metres."""
    rng = np.random.default_rng(seed)
    return se3.transform(se3.rotation(rng.uniform(-1.5, 1.5, (COUNT, 3))), rng.uniform(-0.9, 0.9, (COUNT, 3)))


def turns(H: np.ndarray) -> Rotation:
    return Rotation.from_matrix(H[:, :3, :3])


def quaternions(H: np.ndarray, order: str = "xyzw") -> np.ndarray:
    q = turns(H).as_quat()
    return q if order == "xyzw" else q[:, [3, 0, 1, 2]]


def listed(form: str, *numbers: np.ndarray) -> str:
    return "\n".join(form.format(*row) for row in np.concatenate(numbers, axis=1)) + "\n"


def universal_robots(H: np.ndarray) -> str:
    return listed("p[{:.9f}, {:.9f}, {:.9f}, {:.9f}, {:.9f}, {:.9f}]", H[:, :3, 3], turns(H).as_rotvec())


def kuka(H: np.ndarray) -> str:
    angles = turns(H).as_euler("ZYX", degrees=True)
    return listed("{{E6POS: X {:.6f}, Y {:.6f}, Z {:.6f}, A {:.7f}, B {:.7f}, C {:.7f}, S 2, T 35}}", 1e3 * H[:, :3, 3], angles)


def abb(H: np.ndarray) -> str:
    form = "CONST robtarget p:=[[{:.6f},{:.6f},{:.6f}],[{:.9f},{:.9f},{:.9f},{:.9f}],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];"
    return listed(form, 1e3 * H[:, :3, 3], quaternions(H, "wxyz"))


def printed(H: np.ndarray) -> str:
    return "\n".join(np.array2string(one, separator=", ", precision=12) for one in H) + "\n"


def as_one(H: np.ndarray) -> str:
    return "array(" + np.array2string(H, separator=", ", precision=12) + ")\n"


def in_matlab(H: np.ndarray) -> str:
    return "\n".join("[" + "; ".join(" ".join(f"{v:.12f}" for v in row) for row in one) + "];" for one in H) + "\n"


@pytest.mark.parametrize("write", [universal_robots, kuka, abb, printed, as_one, in_matlab])
def test_controllers_and_programs_text(tmp_path: Path, write: Callable[[np.ndarray], str]) -> None:
    (tmp_path / "robot.txt").write_text("# recorded by hand\n" + write(poses()))
    found = read_robot_poses(tmp_path / "robot.txt")
    assert found.files is None
    np.testing.assert_allclose(found.H, poses(), atol=2e-8)


@pytest.mark.parametrize("suffix", [".json", ".yaml", ".npy", ".npz"])
@pytest.mark.parametrize("rows", [3, 4])
def test_arrays_in_order(tmp_path: Path, suffix: str, rows: int) -> None:
    path, H = tmp_path / f"robot{suffix}", poses()[:, :rows]
    if suffix == ".npy":
        np.save(path, H)
    elif suffix == ".npz":
        np.savez(path, H)
    else:
        path.write_text(json.dumps(H.tolist()) if suffix == ".json" else yaml.safe_dump(H.tolist()))
    np.testing.assert_allclose(read_robot_poses(path).H, poses(), atol=1e-12)


@pytest.mark.parametrize("suffix", [".json", ".npz"])
def test_arrays_by_name(tmp_path: Path, suffix: str) -> None:
    path, named = tmp_path / f"robot{suffix}", {f"view_{k}.png": H for k, H in enumerate(poses())}
    if suffix == ".npz":
        np.savez(path, allow_pickle=False, **named)
    else:
        path.write_text(json.dumps({name: H.tolist() for name, H in named.items()}))
    found = read_robot_poses(path)
    assert found.files == tuple(named)
    np.testing.assert_allclose(found.H, poses(), atol=1e-12)


@pytest.mark.parametrize(
    ("name", "held", "words"),
    [
        ("a.json", "[[1, 2, 3]]", "an array of (1, 1, 3)"),
        ("a.json", '{"a": 3}', "no matrices by name"),
        ("a.json", "[[[1, 2", "cannot be read as arrays"),
        ("a.npy", "no array", "cannot be read as arrays"),
        ("a.yaml", "- [[a, b], [c, d]]", "no array of numbers"),
    ],
)
def test_other_arrays_are_refused(tmp_path: Path, name: str, held: str, words: str) -> None:
    (tmp_path / name).write_text(held)
    with pytest.raises(InputError) as caught:
        read_robot_poses(tmp_path / name)
    assert words in str(caught.value)


@pytest.mark.parametrize("order", ["xyzw", "wxyz"])
def test_seven_numbers_a_line_need_the_quaternions_order(tmp_path: Path, order: str) -> None:
    path, H = tmp_path / "robot.txt", poses()
    path.write_text(listed(" ".join(["{:.9f}"] * 7), H[:, :3, 3], quaternions(H, order)))
    np.testing.assert_allclose(read_robot_poses(path, Stated(quaternion=order)).H, H, atol=1e-8)
    with pytest.raises(InputError, match="seven numbers a line"):
        read_robot_poses(path)


@pytest.mark.parametrize(
    ("names", "order", "stated"),
    [
        ("q0,q1,q2,q3", "wxyz", None),
        ("q1,q2,q3,q4", "wxyz", "wxyz"),
        ("q1,q2,q3,q4", "xyzw", "xyzw"),
        ("qx,qy,qz,qw", "xyzw", None),
    ],
)
def test_numbered_quaternions(tmp_path: Path, names: str, order: str, stated: str | None) -> None:
    path, H = tmp_path / "robot.csv", poses()
    path.write_text(f"x,y,z,{names}\n" + listed(",".join(["{:.9f}"] * 7), H[:, :3, 3], quaternions(H, order)))
    found = read_robot_poses(path, Stated(quaternion=stated))
    assert found.files is None
    np.testing.assert_allclose(found.H, H, atol=1e-8)
    if names.startswith("q1"):
        with pytest.raises(InputError, match="which of them is the scalar"):
            read_robot_poses(path)


def test_an_image_without_a_pose_is_left_out_and_said(tmp_path: Path) -> None:
    path, H = tmp_path / "robot.csv", poses()
    rows = listed(",".join(["{:.9f}"] * 7), H[:, :3, 3], quaternions(H)).splitlines()
    rows[2], rows[5] = ",,,,,,", "nan,nan,nan,nan,nan,nan,nan"
    path.write_text("file,x,y,z,qx,qy,qz,qw\n" + "".join(f"v{k}.png,{row}\n" for k, row in enumerate(rows)))
    found = read_robot_poses(path)
    assert found.files == tuple(f"v{k}.png" for k in (0, 1, 3, 4, 6))
    assert "no pose of v2.png, v5.png" in found.notes
    np.testing.assert_allclose(found.H, H[[0, 1, 3, 4, 6]], atol=1e-8)


def test_radians_that_are_read_as_degrees_are_named(tmp_path: Path) -> None:
    path, H = tmp_path / "robot.csv", poses()
    path.write_text("x_mm,y_mm,z_mm,A,B,C\n" + listed(",".join(["{:.9f}"] * 6), 1e3 * H[:, :3, 3], turns(H).as_euler("ZYX")))
    with pytest.raises(DisagreementError, match="read as degrees"):
        read_robot_poses(path)
    path.write_text(path.read_text().replace("A,B,C", "A_rad,B_rad,C_rad"))
    np.testing.assert_allclose(read_robot_poses(path).H, H, atol=1e-8)


@pytest.mark.parametrize(
    "names",
    [
        [f"boards/view_{k}.png" for k in range(COUNT)],
        [f"view_{k}.png" for k in range(COUNT)],
        [f"view_{k}" for k in range(COUNT)],
        [str(k) for k in range(COUNT)],
        [str(k) for k in range(1, COUNT + 1)],
    ],
)
def test_names_that_are_nearly_the_images(names: list[str]) -> None:
    images = [f"boards/view_{k}.png" for k in range(COUNT)]
    found = _paired(ImagePoses(poses(), tuple(names)), images, Path("robot.csv"))
    assert list(found) == images
    np.testing.assert_array_equal(np.stack(list(found.values())), poses())


def test_a_bare_name_that_two_images_have_is_neither(tmp_path: Path) -> None:
    images = ["a/view.png", "b/view.png", "b/other.png"]
    found = _paired(ImagePoses(poses()[:2], ("view", "other")), images, tmp_path / "robot.csv")
    assert list(found) == ["b/other.png"]


def written(path: Path, kind: str, metres: int, turn: int, count: int = 12) -> Path:
    """Poses with so many digits of positions (m) and rotations (degrees, radians or a quaternion's numbers)."""
    rng = np.random.default_rng(7)
    x, v = rng.uniform(-0.6, 0.6, (count, 3)), rng.uniform(-1.2, 1.2, (count, 3))
    names, turns = {
        "quaternion": ("qx,qy,qz,qw", se3.quaternion(se3.rotation(v))),
        "abc": ("A,B,C", np.rad2deg(v)),
        "rpy": ("roll_deg,pitch_deg,yaw_deg", np.rad2deg(v)),
        "vector": ("rx,ry,rz", v),
        "zyz": ("A,B,C", np.rad2deg(v)),
    }[kind]
    rows = np.concatenate([np.round(x, metres), np.round(turns, turn)], axis=1)
    path.write_text(f"x_m,y_m,z_m,{names}\n" + "".join(",".join(f"{one:.9g}" for one in row) + "\n" for row in rows))
    return path


@pytest.mark.parametrize(
    ("kind", "metres", "turn", "said"),
    [
        ("quaternion", 5, 6, []),
        ("quaternion", 2, 6, ["multiples of 10 mm"]),
        ("quaternion", 5, 2, ["quaternions are multiples of 0.01"]),
        ("quaternion", 5, 3, []),
        ("quaternion", 3, 6, []),
        ("abc", 5, 3, []),
        ("abc", 5, 0, ["angles are multiples of 1 deg"]),
        ("rpy", 2, 0, ["multiples of 10 mm", "multiples of 1 deg"]),
        ("zyz", 5, 0, ["multiples of 1 deg"]),
        ("vector", 1, 4, ["multiples of 100 mm"]),
        ("vector", 5, 2, ["multiples of 0.01 rad"]),
    ],
)
def test_numbers_rounded_too_far_are_noticed(tmp_path: Path, kind: str, metres: int, turn: int, said: list[str]) -> None:
    stated = Stated(rotation="zyz_deg") if kind == "zyz" else Stated()
    for direction in ("H_OP", "H_PO"):
        notes = read_robot_poses(written(tmp_path / "poses.csv", kind, metres, turn), replace(stated, direction=direction)).notes
        found = [note for note in notes if "rounded" in note]
        assert len(found) == len(said), found
        assert all(one in note for one, note in zip(said, found, strict=True)), found
    few = read_robot_poses(written(tmp_path / "few.csv", kind, metres, turn, count=2), stated)
    assert not [note for note in few.notes if "rounded" in note], "of two poses it may be chance"

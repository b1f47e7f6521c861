"""Mocap readers: every layout gives the poses that were written into it; what is wrong is refused with place and exit code."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.image_times import read_image_times
from lpcal.formats.mocap import read_mocap
from lpcal.formats.robot_poses import Stated, read_robot_poses
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from mocap_files import motive

RATE = 120.0


@pytest.fixture
def truth() -> tuple[Array, Array]:
    rng = np.random.default_rng(0)
    H_OP = se3.exp(np.concatenate([rng.normal(0, 0.5, (40, 3)), rng.normal(0, 1, (40, 3))], axis=1))
    return np.arange(40) / RATE, H_OP


LAYOUTS = [
    {"version": "1.21", "units": "Meters"},
    {"version": "1.23", "units": "Millimeters"},
    {"version": "1.24", "units": "Centimeters", "timecode": True},
    {"version": "1.25", "units": "Meters"},
    {"version": "1.23", "rotation": "XYZ"},
    {"version": "1.24", "rotation": "ZYX", "units": "Millimeters"},
]


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: "-".join(map(str, layout.values())))
def test_motive_layouts(tmp_path: Path, truth: tuple[Array, Array], layout: dict[str, str] | dict[str, bool | str]) -> None:
    t, H_OP = truth
    found = read_mocap(motive(tmp_path / "take.csv", t, H_OP, lost=(3, 4, 20), **layout), "Panel")
    seen = np.setdiff1d(np.arange(40), [3, 4, 20])
    assert found.lost == 3
    assert np.allclose(found.t_s, t[seen], atol=1e-6)
    assert np.abs(found.H_OP - H_OP[seen]).max() < 1e-6
    assert np.allclose(found.error_m, 1e-4, atol=1e-8)
    marker_P = se3.apply(se3.inv(found.H_OP), found.markers_O["Marker1"][:, None])[:, 0]
    assert np.abs(marker_P - [0.08, 0.01, 0.0]).max() < 1e-6


def test_motive_body_is_chosen_or_refused(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    path = motive(tmp_path / "take.csv", *truth, bodies=("Panel", "Wand"))
    assert read_mocap(path, "panel").body == "Panel"
    with pytest.raises(DisagreementError, match=r"no body Lamp(.|\n)*Panel, Wand") as refusal:
        read_mocap(path, "Lamp")
    assert refusal.value.exit_code == 6
    with pytest.raises(InputError, match="2 bodies: Panel, Wand"):
        read_mocap(path)


def test_motive_units_and_order_stated_by_the_user_win(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    t, H_OP = truth
    found = read_mocap(motive(tmp_path / "take.csv", t, H_OP), "Panel", units="mm", direction="H_PO")
    assert np.allclose(found.H_OP[:, :3, :3], np.swapaxes(H_OP[:, :3, :3], 1, 2), atol=1e-6)
    assert np.allclose(se3.inv(found.H_OP)[:, :3, 3], 1e-3 * H_OP[:, :3, 3], atol=1e-6)
    assert "against the header's" in found.notes[0]
    text = (tmp_path / "take.csv").read_text().replace(",Length Units,Meters", "")
    (tmp_path / "bare.csv").write_text(text)
    with pytest.raises(InputError, match=r"mocap\.units"):
        read_mocap(tmp_path / "bare.csv", "Panel")


def test_cut_file_names_its_line(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    path = motive(tmp_path / "take.csv", *truth)
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:30], lines[30][:40]]))
    with pytest.raises(InputError, match=r"take\.csv:31: \d+ cells"):
        read_mocap(path, "Panel")
    lines[20] = lines[20].replace(",0.", ",O.", 1)
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match=r"take\.csv:21: 'O\."):
        read_mocap(path, "Panel")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("plain.csv", "{t:.9f}, {x:.9f}, {y:.9f}, {z:.9f}, {qx:.9f}, {qy:.9f}, {qz:.9f}, {qw:.9f}"),
        ("tum.txt", "{t:.9f} {x:.9f} {y:.9f} {z:.9f} {qx:.9f} {qy:.9f} {qz:.9f} {qw:.9f}"),
        ("named.csv", "{x:.9f};{y:.9f};{z:.9f};{qw:.9f};{qx:.9f};{qy:.9f};{qz:.9f};{t:.9f}"),
        ("euroc.csv", "{ns:d},{x:.9f},{y:.9f},{z:.9f},{qw:.9f},{qx:.9f},{qy:.9f},{qz:.9f},0.1,0.2,0.3"),
    ],
)
def test_plain_layouts(tmp_path: Path, truth: tuple[Array, Array], name: str, text: str) -> None:
    t, H_OP = truth
    t = t + 1.5e9 if name == "euroc.csv" else t
    heads = {
        "tum.txt": "# timestamp tx ty tz qx qy qz qw",
        "named.csv": "x_m;y_m;z_m;qw;qx;qy;qz;t_s",
        "euroc.csv": "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_x, v_y, v_z",
    }
    rows = []
    for k in np.random.default_rng(1).permutation(40):
        q, x = se3.quaternion(H_OP[k, :3, :3]), H_OP[k, :3, 3]
        values = dict(zip(("x", "y", "z", "qx", "qy", "qz", "qw"), (*x, *q), strict=True))
        rows.append(text.format(t=t[k], ns=round(t[k] * 1e9), **values))
    rows.append(rows[0])
    (tmp_path / name).write_text("\n".join([*([heads[name]] if name in heads else []), *rows]))
    found = read_mocap(tmp_path / name)
    assert np.allclose(found.t_s, t, atol=1e-6)
    assert np.abs(found.H_OP - H_OP).max() < 1e-6
    assert any("out of order" in note for note in found.notes)
    assert any("1 repeated" in note for note in found.notes)


@pytest.mark.parametrize(
    ("content", "error", "words"),
    [
        (b"", InputError, "empty"),
        (b"\x02\x50" + bytes(100), InputError, "needed: a whole C3D file"),
        (b"NO_OF_FRAMES\t10\n", InputError, "no FREQUENCY and no MARKER_NAMES"),
        (b"Trajectories,,,\n100,,\n", InputError, r"take\.csv:2: not the rows rate"),
        (b"Joints,,,\n100,,\n", InputError, "only Joints"),
        (b"#ROSBAG V2.0\n", InputError, "cannot be read as a bag"),
        (b"1,2,3\n4,5,6\n", InputError, "3 columns without names"),
        (b"t,x,y,z,qx,qy,qz\n", InputError, "no column for qw"),
        (b"0,1,2,3,0,0,0,2\n", InputError, r"take\.csv:1: a quaternion of length 2"),
        (b"t,x,y,z,qx,qy,qz,qw\n0,,,,,,,\n1,,,,,,,\n", DegenerateError, "not one pose"),
    ],
)
def test_refusals(tmp_path: Path, content: bytes, error: type[Exception], words: str) -> None:
    (tmp_path / "take.csv").write_bytes(content)
    with pytest.raises(error, match=words):
        read_mocap(tmp_path / "take.csv")


def test_real_files(data: Callable[[str], Path]) -> None:
    folder = data("mocap")
    old = read_mocap(folder / "motive_1.21_hmv-s16.csv")
    assert (len(old.t_s), old.body, old.lost) == (250, "Rigid Body 1", 0)
    assert np.ptp(old.H_OP[:, :3, 3], axis=0).max() < 1e-3
    assert len(old.markers_O) == 3
    assert len(read_mocap(folder / "tum_freiburg1_xyz.txt").t_s) == 1497
    euroc = read_mocap(folder / "euroc_V102.csv")
    assert euroc.rate_hz == pytest.approx(200, rel=1e-3)
    assert euroc.t_s[0] == pytest.approx(int((folder / "euroc_V102.csv").read_text().splitlines()[1].split(",")[0]) * 1e-9, abs=2.5e-7)
    markers = read_mocap(folder / "motive_1.24_head.csv")
    assert (markers.body, markers.names) == ("Oak-D-Kamera", ("Marker 001", "Marker 002", "Marker 003"))
    qualisys = read_mocap(folder / "qualisys_6D.tsv")
    assert (qualisys.body, len(qualisys.t_s)) == ("PSVH", 1489)
    assert qualisys.H_OP[0, :3, 3] == pytest.approx([-0.19491974, 0.0022415, 0.00099661])
    foot = read_mocap(folder / "optitrack_walking.c3d", "Foot")
    assert (foot.x_O.shape, foot.rate_hz) == ((3361, 5, 3), pytest.approx(160))
    tf = read_mocap(folder / "ros_tf_example.bag", "base_footprint")
    assert len(tf.t_s) == 517
    assert tf.t_s[0] == pytest.approx(1714741164.1775, abs=1e-3)


def test_robot_poses(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    _, H_OP = truth
    (tmp_path / "flat.txt").write_text("\n".join(" ".join(f"{v:.12f}" for v in H.ravel()) for H in H_OP))
    (tmp_path / "square.txt").write_text("\n\n".join("\n".join("\t".join(f"{v:.12f}" for v in row) for row in H) for H in H_OP))
    (tmp_path / "columns.txt").write_text("\n".join(",".join(f"{v:.12f}" for v in H.T.ravel()) for H in H_OP))
    for name in ("flat.txt", "square.txt", "columns.txt"):
        assert np.abs(read_robot_poses(tmp_path / name).H - H_OP).max() < 1e-9
    assert np.abs(read_robot_poses(tmp_path / "flat.txt", Stated(direction="H_PO")).H @ H_OP - np.eye(4)).max() < 1e-9
    q = se3.quaternion(H_OP[:, :3, :3])
    rows = [f"im_{k}.png,{','.join(f'{v:.12f}' for v in (*(1000 * H_OP[k, :3, 3]), *q[k]))}" for k in range(40)]
    (tmp_path / "named.csv").write_text("\n".join(["file,x_m,y_m,z_m,qx,qy,qz,qw", *rows]))
    named = read_robot_poses(tmp_path / "named.csv", Stated(units="mm"))
    assert named.files[3] == "im_3.png"
    assert np.abs(named.H - H_OP).max() < 1e-9
    (tmp_path / "cut.txt").write_text((tmp_path / "flat.txt").read_text()[:-30])
    with pytest.raises(InputError, match=r"cut\.txt:40"):
        read_robot_poses(tmp_path / "cut.txt")
    (tmp_path / "sheared.txt").write_text("1 0.1 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n")
    with pytest.raises(InputError, match=r"sheared\.txt:1: a matrix that is no rotation"):
        read_robot_poses(tmp_path / "sheared.txt")


def test_image_times(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"")
    (tmp_path / "times.csv").write_text("file,time_s\na.png,1.5\n")
    assert read_image_times(tmp_path / "times.csv") == [(tmp_path / "a.png", 1.5)]
    (tmp_path / "times.csv").write_text("file,time_s\na.png,1.5\nb.png,1.6\n")
    with pytest.raises(InputError, match=r"times\.csv:3: no such image: b\.png"):
        read_image_times(tmp_path / "times.csv")
    (tmp_path / "times.csv").write_text("file,time_s\na.png,\n")
    with pytest.raises(InputError, match=r"times\.csv:2: time_s"):
        read_image_times(tmp_path / "times.csv")

"""Vicon, Qualisys, C3D and ROS recordings: the poses and markers that were written are read, whatever the layout; the rest is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal
from lpcal.errors import DegenerateError, DisagreementError, InputError
from lpcal.formats.mocap import read_mocap
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from mocap_files import motive

RATE = 100.0
MARKERS_P = {"A": (0.08, 0.0, 0.0), "B": (0.0, 0.06, 0.01), "C": (-0.07, 0.02, 0.0), "D": (0.01, -0.05, 0.03)}


@pytest.fixture
def truth() -> tuple[Array, Array]:
    rng = np.random.default_rng(0)
    H_OP = se3.exp(np.concatenate([rng.normal(0, 0.5, (30, 3)), rng.normal(0, 1, (30, 3))], axis=1))
    return np.arange(30) / RATE, H_OP


def marker_tracks(H_OP: Array) -> dict[str, Array]:
    return {name: se3.apply(H_OP, np.tile(x, (len(H_OP), 1, 1)))[:, 0] for name, x in MARKERS_P.items()}


def vicon_poses(
    path: Path,
    H_OP: Array,
    *,
    turn: str = "rad",
    title: str = "Objects",
    bodies: tuple[Any, ...] = ("Panel:Panel",),
    lost: tuple[Any, ...] = (),
    before: str = "",
) -> Path:
    axes = ["RX", "RY", "RZ", *(["RW"] if turn == "quaternion" else []), "TX", "TY", "TZ"]
    unit = {"rad": ["rad"] * 3, "deg": ["deg"] * 3, "quaternion": [""] * 4}[turn] + ["mm"] * 3
    names = "".join("," + ",".join([f"Global Angle {name}", *[""] * (len(axes) - 1)]) for name in bodies)
    rows = [
        f"{title},",
        f"{RATE:.0f},",
        f",{names}",
        "Frame,Sub Frame," + ",".join(axes * len(bodies)),
        ",," + ",".join(unit * len(bodies)),
    ]
    for k, H in enumerate(H_OP):
        vector = se3.rotation_vector(H[:3, :3]) * (np.degrees(1) if turn == "deg" else 1)
        r = se3.quaternion(H[:3, :3]) if turn == "quaternion" else vector
        cells = [f"{v:.8f}" for v in (*r, *(1000 * H[:3, 3]))] if k not in lost else [""] * len(axes)
        rows.append(",".join([str(k + 1), "0", *cells * len(bodies)]))
    path.write_text("\n".join([*([before] if before else []), *rows, ""]) + "\n")
    return path


@pytest.mark.parametrize("turn", ["rad", "deg", "quaternion"])
@pytest.mark.parametrize("title", ["Objects", "Segments"])
def test_vicon_poses(tmp_path: Path, truth: tuple[Array, Array], turn: str, title: str) -> None:
    t, H_OP = truth
    found = read_mocap(vicon_poses(tmp_path / "take.csv", H_OP, turn=turn, title=title, lost=(4, 5)))
    seen = np.setdiff1d(np.arange(30), [4, 5])
    assert (found.body, found.lost) == ("Panel", 2)
    assert np.allclose(found.t_s, t[seen])
    assert np.abs(found.H_OP - H_OP[seen]).max() < 1e-6


def test_vicon_sections_and_bodies(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    _, H_OP = truth
    joints = "Joints,\n100,\n,,hip\nFrame,Sub Frame,RX\n,,deg\n1,0,12.0\n2,0,13.0\n"
    path = vicon_poses(tmp_path / "take.csv", H_OP, title="Segments", bodies=("Rig:Panel", "Rig:Wand"), before=joints)
    assert np.abs(read_mocap(path, "panel").H_OP - H_OP).max() < 1e-6
    assert read_mocap(path, "Rig:Wand").body == "Rig:Wand"
    with pytest.raises(InputError, match="2 bodies: Rig:Panel, Rig:Wand"):
        read_mocap(path)
    with pytest.raises(DisagreementError, match=r"several bodies Rig(.|\n)*Rig:Panel, Rig:Wand"):
        read_mocap(path, "Rig")
    with pytest.raises(DisagreementError, match="no body Lamp"):
        read_mocap(path, "Lamp")
    path.write_text(path.read_text()[:-60])
    with pytest.raises(InputError, match=r"take\.csv:\d+: \d+ cells"):
        read_mocap(path, "panel")
    path.write_text(vicon_poses(path, H_OP).read_text().replace(",,rad,rad,rad,mm", ",,rad,rad,rad,furlong"))
    with pytest.raises(InputError, match="'furlong' as unit"):
        read_mocap(path)


def vicon_markers(path: Path, tracks: dict[str, Array]) -> Path:
    names = ",".join(f"Panel:{name},," for name in tracks)
    rows = ["Trajectories,", f"{RATE:.0f},", f",,{names}", "Frame,Sub Frame," + ",".join(["X,Y,Z"] * len(tracks))]
    rows.append(",," + ",".join(["mm,mm,mm"] * len(tracks)))
    for k in range(len(next(iter(tracks.values())))):
        cells = [f"{1000 * v:.6f}" if np.isfinite(v) else "" for track in tracks.values() for v in track[k]]
        rows.append(",".join([str(k + 1), "0", *cells]))
    path.write_text("\r\n".join(rows) + "\r\n")
    return path


def qualisys(
    path: Path, kind: str, names: Any, blocks: list[Array], *, head: bool = True, lead: bool = True, frames: int | None = None
) -> Path:
    rows = [
        ("NO_OF_FRAMES", str(frames or len(blocks[0]))),
        ("FREQUENCY", f"{RATE:.0f}"),
        ("TIME_STAMP", "2026-01-22, 17:47:17.123", "22.1"),
    ]
    rows += [("DATA_INCLUDED", kind), ("BODY_NAMES" if kind == "6D" else "MARKER_NAMES", *names)]
    rows += [("TRAJECTORY_TYPES", *["Measured"] * len(names))] if kind == "3D" else []
    first = ["X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual", *(f"Rot[{k}]" for k in range(9))] if kind == "6D" else ["X", "Y", "Z"]
    labels = [f"{name} {axis}" if kind == "3D" or axis == "X" else axis for name in names for axis in first]
    rows += [(*(["Frame", "Time"] if lead else []), *labels, "")] if head else []
    for k in range(len(blocks[0])):
        numbers = [f"{v:.6f}" if np.isfinite(v) else "" for block in blocks for v in block[k]]
        rows.append((*([str(k + 1), f"{k / RATE:.5f}"] if lead else []), *numbers, ""))
    path.write_text("\r\n".join("\t".join(row) for row in rows) + "\r\n")
    return path


def body_block(H_OP: Array) -> Array:
    rot = np.swapaxes(H_OP[:, :3, :3], 1, 2).reshape(-1, 9)  # by columns
    return np.concatenate([1000 * H_OP[:, :3, 3], np.full((len(H_OP), 3), 77.0), np.full((len(H_OP), 1), 0.2), rot], axis=1)


@pytest.mark.parametrize(("head", "lead"), [(True, True), (True, False), (False, True), (False, False)])
def test_qualisys_bodies(tmp_path: Path, truth: tuple[Array, Array], head: bool, lead: bool) -> None:
    t, H_OP = truth
    lost, zero = body_block(H_OP), body_block(H_OP)
    lost[3], zero[7] = np.nan, 0.0
    zero[7, 6] = -1
    path = qualisys(tmp_path / "take.tsv", "6D", ("Panel", "Wand"), [lost, zero], head=head, lead=lead)
    panel, wand = read_mocap(path, "Panel"), read_mocap(path, "wand")
    for found, gone in ((panel, 3), (wand, 7)):
        seen = np.delete(np.arange(30), gone)
        assert found.lost == 1
        assert np.allclose(found.t_s, t[seen])
        assert np.abs(found.H_OP - H_OP[seen]).max() < 2e-6
    assert np.allclose(panel.error_m, 2e-4)
    with pytest.raises(DisagreementError, match=r"no body Lamp(.|\n)*Panel, Wand"):
        read_mocap(path, "Lamp")


def test_qualisys_refusals(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    _, H_OP = truth
    block = body_block(H_OP)
    by_rows = block.copy()
    by_rows[5, 7:] = np.arange(9)
    with pytest.raises(InputError, match=r"take\.tsv:12: Rot"):
        read_mocap(qualisys(tmp_path / "take.tsv", "6D", ("Panel",), [by_rows]))
    path = qualisys(tmp_path / "take.tsv", "6D", ("Panel",), [block], frames=500)
    assert "the header says 500 frames, 30 are there" in read_mocap(path).notes
    path.write_text(path.read_text()[:-70])
    with pytest.raises(InputError, match=r"take\.tsv:36: \d+ cells"):
        read_mocap(path)


def c3d(path: Path, tracks: dict[str, Array], units: str = "mm") -> Path:
    import ezc3d

    content = ezc3d.c3d()
    scale = {"mm": 1000.0, "m": 1.0}[units]
    points = np.ones((4, len(tracks), len(next(iter(tracks.values())))))
    points[:3] = scale * np.moveaxis(np.array(list(tracks.values())), 2, 0)
    content["parameters"]["POINT"]["RATE"]["value"] = [RATE]
    content["parameters"]["POINT"]["UNITS"]["value"] = [units]
    content["parameters"]["POINT"]["LABELS"]["value"] = tuple(tracks)
    content["data"]["points"] = points
    content.write(str(path))
    return path


@pytest.mark.parametrize("system", ["vicon", "qualisys", "c3d mm", "c3d m"])
def test_markers(tmp_path: Path, truth: tuple[Array, Array], system: str) -> None:
    t, H_OP = truth
    tracks = marker_tracks(H_OP)
    tracks["B"][3:6] = np.nan
    if system == "vicon":
        path = vicon_markers(tmp_path / "take.csv", tracks)
    elif system == "qualisys":
        path = qualisys(tmp_path / "take.tsv", "3D", [f"Panel_{name}" for name in tracks], [1000 * track for track in tracks.values()])
    else:
        path = c3d(tmp_path / "take.c3d", {f"Panel_{name}": track for name, track in tracks.items()}, system.split()[1])
    found = read_mocap(path, "Panel")
    assert found.names == tuple(MARKERS_P)
    assert np.allclose(found.t_s, t, atol=1e-6)
    true = np.stack(list(tracks.values()), axis=1)
    assert np.allclose(found.x_O, true, atol=2e-6, equal_nan=True)
    with pytest.raises(DisagreementError, match="no marker of Lamp"):
        read_mocap(path, "Lamp")


def test_which_markers_are_a_body(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    tracks = marker_tracks(truth[1])
    several = {f"{body}{k}": track for body in ("Plate_", "Arm") for k, track in enumerate(tracks.values())}
    path = c3d(tmp_path / "take.c3d", several | {"*12": tracks["A"], "Unlabeled 7": tracks["B"]})
    with pytest.raises(InputError, match="2 bodies: Plate, Arm"):
        read_mocap(path)
    found = read_mocap(path, "plate")
    assert found.names == ("0", "1", "2", "3")
    assert "2 unlabeled markers left out" in found.notes
    assert len(read_mocap(c3d(tmp_path / "bare.c3d", tracks)).names) == 4
    with pytest.raises(DegenerateError, match="2 markers"):
        read_mocap(c3d(tmp_path / "two.c3d", {"A": tracks["A"], "B": tracks["B"]}))
    (tmp_path / "cut.c3d").write_bytes((tmp_path / "take.c3d").read_bytes()[:700])
    with pytest.raises(InputError, match="needed: a whole C3D file"):
        read_mocap(tmp_path / "cut.c3d")


def ros(
    path: Path, t: Array, H_OP: Array, *, kind: str = "PoseStamped", topics: tuple[Any, ...] = ("/vrpn/panel/pose",), bag_delay: float = 3.0
) -> Path:
    rosbags = pytest.importorskip("rosbags")
    assert rosbags
    from rosbags.rosbag1 import Writer as Writer1
    from rosbags.rosbag2 import StoragePlugin
    from rosbags.rosbag2 import Writer as Writer2
    from rosbags.typesys import Stores, get_typestore

    first = path.suffix == ".bag"
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.ROS2_HUMBLE)
    kinds = store.types
    sequence = {"seq": 0} if first else {}
    plugin = StoragePlugin.MCAP if path.suffix == ".mcap" else StoragePlugin.SQLITE3
    with Writer1(path) if first else Writer2(path.with_suffix(""), version=8, storage_plugin=plugin) as writer:
        name = f"geometry_msgs/msg/{kind}" if kind != "TFMessage" else "tf2_msgs/msg/TFMessage"
        connections = [writer.add_connection(topic, name, typestore=store) for topic in topics]
        for k, H in enumerate(H_OP):
            q = kinds["geometry_msgs/msg/Quaternion"](*se3.quaternion(H[:3, :3]))
            stamp = kinds["builtin_interfaces/msg/Time"](sec=int(t[k]), nanosec=round(t[k] % 1 * 1e9))
            header = kinds["std_msgs/msg/Header"](stamp=stamp, frame_id="world", **sequence)
            if kind == "PoseStamped":
                pose = kinds["geometry_msgs/msg/Pose"](kinds["geometry_msgs/msg/Point"](*H[:3, 3]), q)
                message = kinds["geometry_msgs/msg/PoseStamped"](header, pose)
            else:
                transform = kinds["geometry_msgs/msg/Transform"](kinds["geometry_msgs/msg/Vector3"](*H[:3, 3]), q)
                stamped = kinds["geometry_msgs/msg/TransformStamped"](header, "panel", transform)
                message = stamped if kind == "TransformStamped" else kinds["tf2_msgs/msg/TFMessage"]([stamped])
            raw = store.serialize_ros1(message, name) if first else store.serialize_cdr(message, name)
            for connection in connections:
                writer.write(connection, int((t[k] + bag_delay) * 1e9), raw)
    if first:
        return path
    return next(found for found in path.with_suffix("").iterdir() if found.suffix in {".db3", ".mcap"})


@pytest.mark.parametrize("file", ["take.bag", "take.db3", "take.mcap"])
@pytest.mark.parametrize("kind", ["PoseStamped", "TransformStamped", "TFMessage"])
def test_ros(tmp_path: Path, truth: tuple[Array, Array], file: str, kind: str) -> None:
    if (file, kind) == ("take.bag", "TFMessage"):
        pytest.skip("rosbags cannot write it; the real bag of test_mocap_formats holds it")
    t, H_OP = truth
    t = t + 1.7e9
    path = ros(tmp_path / file, t, H_OP, kind=kind)
    found = read_mocap(path, "panel")
    assert np.allclose(found.t_s, t, atol=1e-6)
    assert np.abs(found.H_OP - H_OP).max() < 1e-9
    if path.suffix != ".bag":
        assert len(read_mocap(path.parent).t_s) == 30


def test_the_stream_names_the_format_that_was_recognised(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    """What is read names it, whichever reader knew it; a body made of markers keeps it."""
    t, H_OP = truth
    tracks = marker_tracks(H_OP)
    poses = np.column_stack([t, H_OP[:, :3, 3], se3.quaternion(H_OP[:, :3, :3])])
    np.savetxt(tmp_path / "take.txt", poses)
    np.savetxt(tmp_path / "plain.csv", poses, delimiter=",")
    files = {
        "Vicon csv": vicon_poses(tmp_path / "vicon.csv", H_OP),
        "Qualisys tsv": qualisys(tmp_path / "take.tsv", "6D", ("Panel",), [body_block(H_OP)]),
        "C3D": c3d(tmp_path / "take.c3d", {f"Panel_{name}": track for name, track in tracks.items()}),
        "TUM trajectory": tmp_path / "take.txt",
        "csv of poses": tmp_path / "plain.csv",
        "ROS bag": ros(tmp_path / "take.bag", t, H_OP),
        "Motive csv": motive(tmp_path / "motive.csv", t, H_OP),
    }
    assert {name: read_mocap(path).format for name, path in files.items()} == {name: name for name in files}
    assert lpcal.read_mocap(files["C3D"]).format == "C3D"
    assert "C3D" in str(lpcal.read_mocap(files["C3D"]))


def test_ros_refusals(tmp_path: Path, truth: tuple[Array, Array], monkeypatch: pytest.MonkeyPatch) -> None:
    path = ros(tmp_path / "take.bag", *truth, topics=("/vrpn/panel/pose", "/vrpn/wand/pose"))
    with pytest.raises(InputError, match="2 bodies: /vrpn/panel/pose, /vrpn/wand/pose"):
        read_mocap(path)
    with pytest.raises(DisagreementError, match="no body lamp"):
        read_mocap(path, "lamp")
    path.write_bytes(path.read_bytes()[:2000])
    with pytest.raises(InputError, match="cannot be read as a bag"):
        read_mocap(path, "panel")
    monkeypatch.setitem(__import__("sys").modules, "rosbags.highlevel", None)
    with pytest.raises(InputError, match=r"pip install lpcal\[ros\]"):
        read_mocap(path, "panel")


@pytest.mark.parametrize(("unit", "metres"), [("Inches", 0.0254), ("Feet", 0.3048), ("Centimeters", 0.01)])
def test_units_are_read_as_they_are_spelled(tmp_path: Path, truth: tuple[Array, Array], unit: str, metres: float) -> None:
    t, H_OP = truth
    path = motive(tmp_path / "take.csv", t, H_OP)
    path.write_text(path.read_text().replace("Length Units,Meters", f"Length Units,{unit}"))
    np.testing.assert_allclose(read_mocap(path).H_OP[:, :3, 3], metres * H_OP[:, :3, 3], atol=1e-8)
    path = vicon_poses(tmp_path / "vicon.csv", H_OP)
    path.write_text(path.read_text().replace("mm", unit.lower()))
    np.testing.assert_allclose(read_mocap(path).H_OP[:, :3, 3], metres * 1000 * H_OP[:, :3, 3], atol=1e-6)


def test_a_unit_that_nobody_knows_is_shown(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    path = motive(tmp_path / "take.csv", *truth)
    path.write_text(path.read_text().replace("Length Units,Meters", "Length Units,Furlongs"))
    with pytest.raises(InputError, match="'Furlongs'"):
        read_mocap(path)


def test_two_takes_in_one_file_are_named(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    path = motive(tmp_path / "take.csv", *truth)
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines, *lines]) + "\n")
    with pytest.raises(InputError, match=rf"take\.csv:{len(lines) + 1}: .*\n.*\n.*the header of a second recording"):
        read_mocap(path)
    path.write_text("\n".join([*lines, "the end"]) + "\n")
    with pytest.raises(InputError) as caught:
        read_mocap(path)
    assert "second recording" not in str(caught.value)


def test_qualisys_without_matrices_says_what_to_export(tmp_path: Path, truth: tuple[Array, Array]) -> None:
    _, H_OP = truth
    path = qualisys(tmp_path / "take.tsv", "6D", ("Panel",), [body_block(H_OP)])
    rows = [line.split("\t") for line in path.read_text().splitlines()]
    path.write_text("\n".join("\t".join(row if len(row) < 18 else row[:9]) for row in rows) + "\n")
    with pytest.raises(InputError, match=r"Roll, Pitch and Yaw alone.*\n.*Rot\[0\]"):
        read_mocap(path)


@pytest.mark.parametrize("digits", [0, 1, 6])
def test_times_rounded_to_seconds_are_no_second_body(tmp_path: Path, digits: int) -> None:
    t = np.arange(600) / RATE
    rows = [f"{one:.{digits}f} {np.sin(one):.6f} {0.2 * one:.6f} 0 0 0 0 1" for one in t]
    path = tmp_path / "tum.txt"
    path.write_text("\n".join(rows) + "\n")
    if digits:
        assert len(read_mocap(path).t_s) >= 60
    else:
        with pytest.raises(DisagreementError, match=r"\d+ poses at 7 times, 1 s from one to the next.*rounded"):
            read_mocap(path)

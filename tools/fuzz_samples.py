"""A valid sample of every format that lpcal reads, small, with the command that reads it; for ``fuzz.py``.

The samples are written here by hand, not by lpcal's own writers where another system's file is meant, and made once a process.
"""

from __future__ import annotations

import csv
import functools
import io
import random
import struct
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import yaml

type Files = dict[str, bytes]
POSES = 30
RATE_HZ = 100.0
LIGHTS = ("L0", "L1", "L2", "L3")
MARKERS_P = {"A": (0.08, 0.0, 0.0), "B": (0.0, 0.06, 0.01), "C": (-0.07, 0.02, 0.0), "D": (0.01, -0.05, 0.03)}
SIZE = (24, 18)
"""Width and height of the pictures, in pixels."""


@dataclass(frozen=True)
class Sample:
    """A folder of small files, the one that is mutated, and the command that reads it."""

    name: str
    target: str
    command: str
    content: Callable[[], bytes]
    beside: Callable[[], Files] = field(default=dict)

    def make(self, folder: Path, _: random.Random) -> Path:
        """Write the folder; the path of the file to mutate."""
        for name, data in (_made(self.beside) | {self.target: _made(self.content)}).items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(data)
        return folder / self.target


@functools.cache
def _made[Content](make: Callable[[], Content]) -> Content:
    return make()


def _rows(rows: list[list[object]], delimiter: str = ",") -> bytes:
    stream = io.StringIO()
    csv.writer(stream, delimiter=delimiter, lineterminator="\n").writerows(rows)
    return stream.getvalue().encode()


# poses


@functools.cache
def poses() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (N,), positions (N, 3) in metres and quaternions xyzw (N, 4) of a body that turns about all its axes."""
    t = np.arange(POSES) / RATE_HZ
    w = np.stack([0.5 * np.sin(9 * t), 0.4 * np.sin(7 * t + 1), 0.3 * np.sin(5 * t + 2)], axis=1)
    angle = np.linalg.norm(w, axis=1, keepdims=True)
    q = np.concatenate([np.sin(angle / 2) * w / angle, np.cos(angle / 2)], axis=1)
    return t, np.stack([0.2 * np.sin(3 * t), 1 + 0.1 * np.cos(4 * t), 0.3 * t], axis=1), q


def matrices() -> np.ndarray:
    """The same as H_OP (N, 4, 4)."""
    _, x, (a, b, c, d) = poses()[0], poses()[1], poses()[2].T
    R = np.array(
        [
            [1 - 2 * (b * b + c * c), 2 * (a * b - c * d), 2 * (a * c + b * d)],
            [2 * (a * b + c * d), 1 - 2 * (a * a + c * c), 2 * (b * c - a * d)],
            [2 * (a * c - b * d), 2 * (b * c + a * d), 1 - 2 * (a * a + b * b)],
        ]
    )
    H = np.tile(np.eye(4), (POSES, 1, 1))
    H[:, :3, :3], H[:, :3, 3] = np.moveaxis(R, 2, 0), x
    return H


def plain() -> bytes:
    """A csv with names."""
    t, x, q = poses()
    head: list[list[object]] = [["t_s", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"]]
    return _rows(head + [[f"{value:.7f}" for value in row] for row in np.column_stack([t, x, q])])


def tum() -> bytes:
    """TUM: blanks, no header."""
    t, x, q = poses()
    return "\n".join(" ".join(f"{value:.7f}" for value in row) for row in np.column_stack([1.7e9 + t, x, q])).encode()


def euroc() -> bytes:
    """EuRoC: nanoseconds, w first."""
    t, x, q = poses()
    head = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n"
    lines = [f"{int(1e9 * (1.4e9 + t[k]))}," + ",".join(f"{value:.7f}" for value in (*x[k], *q[k][[3, 0, 1, 2]])) for k in range(POSES)]
    return (head + "\n".join(lines)).encode()


def motive() -> bytes:
    """Motive's csv of one rigid body."""
    t, x, q = poses()
    columns = [("Rotation", axis) for axis in "XYZW"] + [("Position", axis) for axis in "XYZ"] + [("Mean Marker Error", "")]
    head = "Format Version,1.23,Take Name,Take 1,Capture Frame Rate,100.0,Rotation Type,Quaternion,Length Units,Meters"
    labels = [["Rigid Body"] * 8, ["Panel"] * 8, ['"ABC"'] * 8, [one for one, _ in columns]]
    rows = [head, "", *("," + "," + ",".join(row) for row in labels), "Frame,Time (Seconds)," + ",".join(axis for _, axis in columns)]
    rows += [f"{k},{t[k]:.6f}," + ",".join(f"{value:.6f}" for value in (*q[k], *x[k], 1e-4)) for k in range(POSES)]
    return ("\r\n".join(rows) + "\r\n").encode()


def vicon() -> bytes:
    """Vicon Tracker's csv of one object."""
    _, x, q = poses()
    rows = ["Objects", "100", ",,Global Angle Panel:Panel", "Frame,Sub Frame,RX,RY,RZ,RW,TX,TY,TZ", ",,,,,,mm,mm,mm"]
    rows += [f"{k + 1},0," + ",".join(f"{value:.6f}" for value in (*q[k], *(1000 * x[k]))) for k in range(POSES)]
    return ("\n".join(rows) + "\n\n").encode()


def tracks() -> dict[str, np.ndarray]:
    """Markers (N, 3) in the room, metres."""
    return {name: matrices()[:, :3, :3] @ np.array(place) + poses()[1] for name, place in MARKERS_P.items()}


def vicon_markers() -> bytes:
    """Vicon Nexus' csv of trajectories."""
    names = ",".join(f"Panel:{name},," for name in MARKERS_P)
    rows = ["Trajectories", "100", f",,{names}", "Frame,Sub Frame," + ",".join(["X,Y,Z"] * 4), ",," + ",".join(["mm,mm,mm"] * 4)]
    rows += [f"{k + 1},0," + ",".join(f"{1000 * value:.4f}" for track in tracks().values() for value in track[k]) for k in range(POSES)]
    return ("\n".join(rows) + "\n").encode()


def trc() -> bytes:
    """OpenSim's and Cortex' .trc."""
    head = [
        ["PathFileType", 4, "(X/Y/Z)", "take.trc"],
        ["DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units"],
        [100, 100, POSES, 4, "mm"],
    ]
    head += [["Frame#", "Time", *(cell for name in MARKERS_P for cell in (f"Panel_{name}", "", ""))]]
    head += [["", "", *(f"{axis}{k + 1}" for k in range(4) for axis in "XYZ")], []]
    body = [[k + 1, f"{poses()[0][k]:.5f}", *(f"{1000 * v:.4f}" for track in tracks().values() for v in track[k])] for k in range(POSES)]
    return _rows([*head, *body], "\t")


def qualisys() -> bytes:
    """Qualisys' tsv of 6DOF bodies."""
    H = matrices()
    rows = [["NO_OF_FRAMES", POSES], ["FREQUENCY", 100], ["DATA_INCLUDED", "6D"], ["BODY_NAMES", "Panel"]]
    rows += [["Frame", "Time", "Panel X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual", *(f"Rot[{k}]" for k in range(9))]]
    for k in range(POSES):
        numbers = (*(1000 * H[k, :3, 3]), 0, 0, 0, 0.2, *H[k, :3, :3].T.ravel())
        rows.append([k + 1, f"{k / 100:.5f}", *(f"{value:.6f}" for value in numbers)])
    return _rows(rows, "\t")


def c3d() -> bytes:
    """C3D of four markers."""
    import ezc3d

    content = ezc3d.c3d()
    points = np.ones((4, 4, POSES))
    points[:3] = 1000 * np.moveaxis(np.array(list(tracks().values())), 2, 0)
    for key, value in {"RATE": [RATE_HZ], "UNITS": ["mm"], "LABELS": tuple(f"Panel_{name}" for name in MARKERS_P)}.items():
        content["parameters"]["POINT"][key]["value"] = value
    content["data"]["points"] = points
    with tempfile.TemporaryDirectory() as folder:
        content.write(f"{folder}/take.c3d")
        return Path(folder, "take.c3d").read_bytes()


def _ros(suffix: str) -> bytes:
    from rosbags.rosbag1 import Writer as Writer1
    from rosbags.rosbag2 import StoragePlugin
    from rosbags.rosbag2 import Writer as Writer2
    from rosbags.typesys import Stores, get_typestore

    first = suffix == "bag"
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.ROS2_HUMBLE)
    kinds, name = store.types, "geometry_msgs/msg/PoseStamped"
    t, x, q = poses()
    with tempfile.TemporaryDirectory() as folder:
        plugin = StoragePlugin.MCAP if suffix == "mcap" else StoragePlugin.SQLITE3
        place = Path(folder, "take.bag" if first else "take")
        with Writer1(place) if first else Writer2(place, version=8, storage_plugin=plugin) as writer:
            connection = writer.add_connection("/vrpn/panel/pose", name, typestore=store)
            for k in range(POSES):
                stamp = kinds["builtin_interfaces/msg/Time"](sec=100, nanosec=round(1e9 * t[k]))
                header = kinds["std_msgs/msg/Header"](stamp=stamp, frame_id="world", **({"seq": 0} if first else {}))
                turn, point = kinds["geometry_msgs/msg/Quaternion"](*q[k]), kinds["geometry_msgs/msg/Point"](*x[k])
                message = kinds[name](header, kinds["geometry_msgs/msg/Pose"](point, turn))
                raw = store.serialize_ros1(message, name) if first else store.serialize_cdr(message, name)
                writer.write(connection, int(1e9 * (103 + t[k])), raw)
        return place.read_bytes() if first else next(found for found in place.iterdir() if found.suffix == f".{suffix}").read_bytes()


def bag() -> bytes:
    """A ROS 1 bag."""
    return _ros("bag")


def mcap() -> bytes:
    """A ROS 2 recording as MCAP."""
    return _ros("mcap")


def recorded(file: str) -> Callable[[], Files]:
    """What stands beside a recording: the rig, and board poses found elsewhere."""

    def beside() -> Files:
        rig = {"lpcal": 1, "mocap": {"file": file, "board_poses": {"file": "boards.csv"}}}
        return {"panel.yaml": yaml.safe_dump(rig).encode(), "boards.csv": plain()}

    return beside


# cameras

K = np.array([[712.4, 0, 385.1], [0, 713.1, 230.6], [0, 0, 1.0]])
DISTORTION = [-0.3, 0.12, 0.0007, -0.0005, 0.01]


def opencv_yaml() -> bytes:
    """OpenCV's YAML."""
    return _opencv(".yml")


def opencv_xml() -> bytes:
    """OpenCV's XML."""
    return _opencv(".xml")


def _opencv(ending: str) -> bytes:
    import cv2

    storage = cv2.FileStorage(ending, cv2.FILE_STORAGE_WRITE | cv2.FILE_STORAGE_MEMORY)
    storage.write("image_width", 752)
    storage.write("image_height", 480)
    storage.write("camera_matrix", K)
    storage.write("distortion_coefficients", np.array(DISTORTION).reshape(-1, 1))
    return str(storage.releaseAndGetString()).encode()


def ros_yaml() -> bytes:
    """ROS' camera_info."""
    matrix = {"rows": 3, "cols": 3, "data": K.ravel().tolist()}
    lens = {"rows": 1, "cols": 5, "data": DISTORTION}
    document = {"image_width": 752, "image_height": 480, "camera_name": "left", "camera_matrix": matrix}
    return yaml.safe_dump(document | {"distortion_model": "plumb_bob", "distortion_coefficients": lens}).encode()


def kalibr() -> bytes:
    """Kalibr's camchain."""
    camera = {"camera_model": "pinhole", "distortion_model": "radtan", "distortion_coeffs": DISTORTION[:4]}
    return yaml.safe_dump({"cam0": camera | {"intrinsics": [712.4, 713.1, 385.1, 230.6], "resolution": [752, 480]}}).encode()


def colmap_text() -> bytes:
    """COLMAP's cameras.txt."""
    return b"# Camera list\n1 OPENCV 752 480 712.4 713.1 385.6 231.1 -0.3 0.12 0.0007 -0.0005\n"


def colmap_binary() -> bytes:
    """COLMAP's cameras.bin."""
    return struct.pack("<QiiQQ8d", 1, 1, 4, 752, 480, 712.4, 713.1, 385.6, 231.1, *DISTORTION[:4])


def cameramodel() -> bytes:
    """mrcal's cameramodel."""
    numbers = ", ".join(map(repr, [712.4, 713.1, 385.1, 230.6, *DISTORTION]))
    lens = "    'lensmodel':  'LENSMODEL_OPENCV5',\n"
    body = f"    'intrinsics': [ {numbers} ],\n    'extrinsics': [ 0, 0, 0, 0, 0, 0 ],\n    'imagersize': [ 752, 480 ]\n"
    return f"# x\n{{\n{lens}{body}}}\n".encode()


def with_camera(file: str) -> Callable[[], Files]:
    """The rig that names a camera file."""

    def beside() -> Files:
        return {"panel.yaml": yaml.safe_dump({"lpcal": 1, "camera": {"cameramodel": file}}).encode()}

    return beside


# lights and their lobes


def directions() -> np.ndarray:
    """Unit vectors to the lights, x right, y up, z to the camera."""
    d = np.array([[0.4, 0, 1], [0, 0.4, 1], [-0.4, 0, 1], [0, -0.4, 1.0]])
    return d / np.linalg.norm(d, axis=1, keepdims=True)


def lp() -> bytes:
    """A .lp file."""
    return ("4\n" + "\n".join(f"{name}.png {x:.6f} {y:.6f} {z:.6f}" for name, (x, y, z) in zip(LIGHTS, directions(), strict=True))).encode()


def mat() -> bytes:
    """near_ps' light.mat."""
    from scipy.io import savemat

    stream = io.BytesIO()
    savemat(stream, {"S": 100 * directions(), "Dir": -directions(), "Phi": np.ones((4, 3)), "mu": np.ones((4, 1))})
    return stream.getvalue()


def near_ps_camera() -> Files:
    """near_ps' camera.mat, beside light.mat."""
    from scipy.io import savemat

    stream = io.BytesIO()
    savemat(stream, {"K": K})
    return {"camera.mat": stream.getvalue()}


def led_params() -> bytes:
    """LUCES' led_params.txt."""
    rows = ["N_img nrows ncols f x0 y0 mean_distance sfull:[Lpos Ldir Phi mu 0]", "4 480 752 712.4 385.1 230.6 350"]
    rows += [" ".join(f"{value:.6g}" for value in (*(100 * d), 0, 0, 1, 7.5, 7.5, 7.5, 1, 0)) for d in directions()]
    return ("\n".join(rows) + "\n").encode()


def diligent_directions() -> bytes:
    """DiLiGenT's light_directions.txt."""
    return "\n".join(" ".join(f"{value:.6f}" for value in d) for d in directions()).encode()


def diligent() -> Files:
    """What stands beside DiLiGenT's light_directions.txt."""
    names = "\n".join(f"{name}.png" for name in LIGHTS).encode()
    return {"light_intensities.txt": b"1 1 1\n" * 4, "filenames.txt": names} | {f"{name}.png": picture() for name in LIGHTS}


def ies() -> bytes:
    """A photometric file after IESNA LM-63."""
    gamma = np.arange(0, 91, 10)
    table = "\n".join([" ".join(map(str, gamma)), "0", " ".join(f"{value:.2f}" for value in 800 * np.cos(np.radians(gamma)) ** 4)])
    return f"IESNA:LM-63-2002\n[MANUFAC] x\nTILT=NONE\n1 1000 1 {gamma.size} 1 1 2 0.05 0.05 0\n1 1 4.2\n{table}\n".encode()


def ldt() -> bytes:
    """A photometric file after EULUMDAT."""
    gamma = np.arange(0, 91, 10)
    head = ["maker", "3", "1", "24", "15", str(gamma.size), "5", *["x"] * 5, *["50"] * 4, *["0"] * 5, "100", "100", "1.0", "0", "1"]
    head += [*["1"] * 6, *["0.5"] * 10]
    return "\r\n".join(
        [*head, *(f"{value:.4f}" for row in (np.arange(24) * 15.0, gamma, 800 * np.cos(np.radians(gamma)) ** 4) for value in row)]
    ).encode()


def with_lobe(file: str) -> Callable[[], Files]:
    """A rig whose first light's lobe comes from a file."""

    def beside() -> Files:
        sphere = {"kind": "matte", "radius": "25 mm", "images": "ball"}
        lights: dict[str, dict[str, str]] = {name: {} for name in LIGHTS} | {LIGHTS[0]: {"lobe": file}}
        rig = {"lpcal": 1, "lights": lights, "spheres": {"ball": sphere}}
        return {"panel.yaml": yaml.safe_dump(rig).encode()} | {f"ball/{name}.png": picture() for name in LIGHTS}

    return beside


# pictures


def picture(ending: str = ".png") -> bytes:
    """A grey ball."""
    import cv2

    y, x = np.mgrid[: SIZE[1], : SIZE[0]]
    z = np.sqrt(np.maximum(64.0 - (x - 12) ** 2 - (y - 9) ** 2, 0)) / 8
    return bytes(cv2.imencode(ending, np.uint8(200 * z))[1].tobytes())


def pictures(ending: str) -> Callable[[], bytes]:
    """A grey ball in a format."""
    return functools.partial(picture, ending)


def normals_png() -> bytes:
    """A normal map of 8 bit."""
    import cv2

    return bytes(cv2.imencode(".png", np.rint(255 * (normals() + 1) / 2).astype(np.uint8)[..., ::-1])[1].tobytes())


def normals() -> np.ndarray:
    """Normals of a ball, x right, y up, z to the camera."""
    y, x = np.mgrid[: SIZE[1], : SIZE[0]]
    n = np.dstack([(x - 12) / 16, -(y - 9) / 16, np.ones(x.shape)])
    return n / np.linalg.norm(n, axis=2, keepdims=True)


def normals_npy() -> bytes:
    """A table of normals."""
    stream = io.BytesIO()
    np.save(stream, normals())
    return stream.getvalue()


def normals_npz() -> bytes:
    """Tables of normals and of a mask."""
    stream = io.BytesIO()
    np.savez_compressed(stream, normals=normals(), mask=np.ones(normals().shape[:2], bool))
    return stream.getvalue()


def normals_tif() -> bytes:
    """A normal map of floats."""
    import tifffile

    stream = io.BytesIO()
    tifffile.imwrite(stream, normals().astype(np.float32), photometric="rgb")
    return stream.getvalue()


def capture(ending: str = ".png") -> Files:
    """A capture under distant lights, and their calibration."""
    images = {f"ball/{name}{ending}": picture(ending) for name in LIGHTS}
    return images | {"c.yaml": calibration(), "ball/capture.yaml": capture_yaml()}


def capture_yaml() -> bytes:
    """A capture's own section."""
    return b"exposure: 20 ms\ngain: 1.0\nexposures: {L0: 20 ms}\nlights: [L0, L1, L2, L3]\n"


# what lpcal writes itself


def calibration() -> bytes:
    """lpcal's calibration.yaml of distant lights."""
    return _written("import lights.lp -o c.yaml", {"lights.lp": lp()}, "c.yaml")


def camera_yaml() -> bytes:
    """lpcal's camera.yaml."""
    return _written("intrinsics", with_camera("c.cameramodel")() | {"c.cameramodel": cameramodel()}, "calib/camera.yaml")


def panel_yaml() -> bytes:
    """A rig file with a panel and wings."""
    wing = {"joint_angle": "30 deg", "disc_spacer": "28.9 mm", "blob_spacer": "40 mm", "leds": 19}
    rig = {"lpcal": 1, "camera": {"cameramodel": "c.cameramodel"}, "panel": {"disc_radius": "60 mm", "joint": "15 mm", "blob": "30 mm"}}
    return yaml.safe_dump(rig | {"lights": {name: {"azimuth": f"{90 * k} deg", **wing} for k, name in enumerate(LIGHTS)}}).encode()


def wings_yaml() -> bytes:
    """lpcal's wings.yaml."""
    return _written("wings", {"panel.yaml": panel_yaml(), "c.cameramodel": cameramodel()}, "calib/wings.yaml")


def near_calibration() -> bytes:
    """lpcal's calibration.yaml of near lights with a camera."""
    return _written("export", {"panel.yaml": panel_yaml(), "c.cameramodel": cameramodel()}, "calib/calibration.yaml")


def _written(command: str, files: Files, wanted: str) -> bytes:
    """What a command of lpcal's writes from files."""
    import subprocess
    import sys

    with tempfile.TemporaryDirectory() as folder:
        for name, data in files.items():
            Path(folder, name).write_bytes(data)
        subprocess.run([sys.executable, "-m", "lpcal", *command.split()], cwd=folder, check=True, capture_output=True)
        return Path(folder, wanted).read_bytes()


def points() -> bytes:
    """Points for lpcal field."""
    return b"x_m,y_m,z_m\n0,0,0.3\n0.01,0.02,0.35\n-0.03,0.01,0.4\n"


def boards() -> Files:
    """Images without a board, and a rig that looks for one."""
    rig = {"lpcal": 1, "camera": {"images": "v*.png"}, "board": {"kind": "chessboard", "corners": [4, 3], "square": "25 mm"}}
    return {"panel.yaml": yaml.safe_dump(rig).encode()} | {f"v{k}.png": picture() for k in range(4)}


def vnl() -> bytes:
    """Corners as mrcal's tools keep them."""
    lines = ["# filename x y level"]
    for k in range(4):
        lines += [f"v{k}.png {3 + 5 * x + k:.3f} {4 + 5 * y:.3f} 0" for y in range(3) for x in range(4)]
    return ("\n".join(lines) + "\n").encode()


def times() -> bytes:
    """Times of images."""
    return b"file,time_s\n" + b"".join(f"v{k}.png,{0.05 * k}\n".encode() for k in range(4))


def timed() -> Files:
    """A rig with images and their times."""
    rig = yaml.safe_load(boards()["panel.yaml"]) | {"mocap": {"file": "mocap.csv", "images": "times.csv"}}
    rig["camera"] = {"cameramodel": "c.cameramodel"}
    return boards() | {"panel.yaml": yaml.safe_dump(rig).encode(), "mocap.csv": plain(), "c.cameramodel": cameramodel()}


def robot_csv() -> bytes:
    """A robot's poses by image."""
    _, x, q = poses()
    head: list[list[object]] = [["file", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"]]
    return _rows(head + [[f"v{k}.png", *(f"{value:.7f}" for value in (*x[k], *q[k]))] for k in range(4)])


def robot_matrices() -> bytes:
    """A robot's poses in the images' order."""
    return "\n".join(" ".join(f"{value:.7f}" for value in H.ravel()) for H in matrices()[:4]).encode()


def h_cb_yaml() -> bytes:
    """lpcal's H_CB.yaml of four views."""
    from lpcal.formats.h_cb_yaml import write_h_cb
    from lpcal.records.observations import BoardPoses
    from lpcal.records.provenance import Provenance

    with tempfile.TemporaryDirectory() as folder:
        corners_px, points_B = np.tile(np.arange(24.0).reshape(12, 2), (4, 1, 1)), np.zeros((12, 3))
        spread = np.tile(1e-6 * np.eye(6), (4, 1, 1))
        names = tuple(f"v{k}.png" for k in range(4))
        found = BoardPoses(names, None, matrices()[:4], corners_px, points_B, spread, np.ones(4), 0.1)
        write_h_cb(Path(folder, "H_CB.yaml"), found, {}, (4, 3), Provenance())
        return Path(folder, "H_CB.yaml").read_bytes()


def posed(file: str) -> Callable[[], Files]:
    """A robot's rig whose boards are found already."""

    def beside() -> Files:
        rig = yaml.safe_load(boards()["panel.yaml"]) | {"mocap": {"poses": file}}
        return boards() | {"panel.yaml": yaml.safe_dump(rig).encode(), "calib/camera.yaml": camera_yaml(), "calib/H_CB.yaml": h_cb_yaml()}

    return beside


RECONSTRUCT = "reconstruct ball -c c.yaml -o out --mask none"

SAMPLES: list[Sample] = [
    *(
        Sample(name, f"mocap.{ending}", "check", content, recorded(f"mocap.{ending}"))
        for name, ending, content in (
            ("plain csv", "csv", plain),
            ("tum", "txt", tum),
            ("euroc", "csv", euroc),
            ("motive", "csv", motive),
            ("vicon", "csv", vicon),
            ("vicon markers", "csv", vicon_markers),
            ("trc", "trc", trc),
            ("qualisys", "tsv", qualisys),
            ("c3d", "c3d", c3d),
            ("ros1 bag", "bag", bag),
            ("mcap", "mcap", mcap),
        )
    ),
    Sample("board poses", "boards.csv", "check", plain, lambda: recorded("mocap.csv")() | {"mocap.csv": plain()}),
    Sample("times", "times.csv", "intrinsics", times, timed),
    Sample("robot csv", "robot.csv", "check", robot_csv, posed("robot.csv")),
    Sample("robot matrices", "robot.txt", "check", robot_matrices, posed("robot.txt")),
    *(
        Sample(name, file, "intrinsics", content, with_camera(file))
        for name, file, content in (
            ("opencv yaml", "c.yml", opencv_yaml),
            ("opencv xml", "c.xml", opencv_xml),
            ("ros yaml", "c.yaml", ros_yaml),
            ("kalibr", "camchain.yaml", kalibr),
            ("colmap text", "cameras.txt", colmap_text),
            ("colmap binary", "cameras.bin", colmap_binary),
            ("cameramodel", "c.cameramodel", cameramodel),
        )
    ),
    Sample("lp", "lights.lp", "import lights.lp -o c.yaml", lp),
    Sample("near_ps mat", "light.mat", "import light.mat -o c.yaml", mat, near_ps_camera),
    Sample(
        "near_ps camera", "camera.mat", "import light.mat -o c.yaml", lambda: near_ps_camera()["camera.mat"], lambda: {"light.mat": mat()}
    ),
    Sample("luces", "led_params.txt", "import led_params.txt -o c.yaml", led_params),
    Sample(
        "diligent",
        "set/light_directions.txt",
        "import set -o c.yaml",
        diligent_directions,
        lambda: {f"set/{n}": d for n, d in diligent().items()},
    ),
    Sample("ies", "lobe.ies", "refine", ies, with_lobe("lobe.ies")),
    Sample("ldt", "lobe.ldt", "refine", ldt, with_lobe("lobe.ldt")),
    Sample("panel.yaml", "panel.yaml", "export", panel_yaml, lambda: {"c.cameramodel": cameramodel()}),
    Sample("capture.yaml", "ball/capture.yaml", RECONSTRUCT, capture_yaml, capture),
    Sample("calibration", "c.yaml", "field c.yaml p.csv -o f.csv", calibration, lambda: {"p.csv": points()}),
    Sample("near calibration", "c.yaml", "field c.yaml p.csv -o f.csv", near_calibration, lambda: {"p.csv": points()}),
    Sample("points", "p.csv", "field c.yaml p.csv -o f.csv", points, lambda: {"c.yaml": calibration()}),
    Sample("camera.yaml", "calib/camera.yaml", "check", camera_yaml, lambda: posed("robot.csv")() | {"robot.csv": robot_csv()}),
    Sample("H_CB.yaml", "calib/H_CB.yaml", "check", h_cb_yaml, lambda: posed("robot.csv")() | {"robot.csv": robot_csv()}),
    Sample("wings.yaml", "calib/wings.yaml", "report", wings_yaml, lambda: {"panel.yaml": panel_yaml()}),
    Sample("corners.vnl", "corners.vnl", "intrinsics --corners-cache corners.vnl", vnl, boards),
    *(
        Sample(ending[1:], f"ball/L0{ending}", RECONSTRUCT, pictures(ending), functools.partial(capture, ending))
        for ending in (".png", ".jpg", ".tif", ".bmp", ".pgm", ".webp")
    ),
    Sample("mask", "mask.png", "reconstruct ball -c c.yaml -o out --mask mask.png", picture, capture),
    Sample("normals png", "n.png", "integrate n.png -o out", normals_png),
    Sample("normals npy", "n.npy", "integrate n.npy -o out", normals_npy),
    Sample("normals npz", "n.npz", "integrate n.npz -o out", normals_npz),
    Sample("normals tif", "n.tif", "integrate n.tif -o out", normals_tif),
]

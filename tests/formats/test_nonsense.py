"""What cannot be is refused by every reader of its kind, with its place: cameras, lights, wings and poses of lpcal's own documents."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from lpcal.chain.h_pl_wings import design_lights
from lpcal.chain.refine_lights import as_designed
from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import read_calibration, write_calibration
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import read_camera, write_camera
from lpcal.formats.h_cb_yaml import read_h_cb, write_h_cb
from lpcal.formats.h_op_yaml import ImagePanelPoses, read_h_op, write_h_op
from lpcal.formats.handeye_yaml import read_handeye, write_handeye
from lpcal.formats.lights_yaml import read_lights, write_lights
from lpcal.formats.wings_yaml import read_wings, write_wings
from lpcal.geometry import se3
from lpcal.records.calibration import Calibration, Camera, CameraSolution, HandEye, ViewVerdict, Wing
from lpcal.records.observations import BoardPoses
from lpcal.records.provenance import Provenance

K = np.array([[712.4, 0, 385.1], [0, 713.1, 230.6], [0, 0, 1.0]])
NAMES = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2")
CAMERA = Camera((752, 480), "opencv4", K, np.array([-0.3, 0.12, 7e-4, -5e-4]), 0.008, rms_px=0.05, parameters=NAMES, covariance=np.eye(8))
H = np.stack([se3.exp(np.array([0.1 * k, 0.2, 0.3, 0.1, 0.2, 0.3])) for k in range(2)])
COVARIANCE = np.diag([1e-6] * 6)
WINGS = design_lights(
    [Wing(f"L{k}", 1.0 * k, 0.5236, 0.104, 0.085, 19) for k in range(2)], H[0], COVARIANCE, np.array([0.01, 0.02, 5e-4, 5e-4]), "a test"
)
LIGHTS = as_designed(WINGS, ["L0", "L1"], 0.1)


def write(kind: str, path: Path) -> None:
    """A valid document of a kind."""
    made = Provenance()
    views = (ViewVerdict("a.png", True, None),)
    match kind:
        case "camera":
            write_camera(path, CameraSolution(CAMERA, np.zeros((0, 3)), (), "mrcal", 0.1), made)
        case "calibration":
            write_calibration(path, Calibration("x", LIGHTS.lights, CAMERA, H[0], 0.35, np.array([0, 0, 0.35])), made)
        case "lights":
            write_lights(path, LIGHTS, made)
        case "wings":
            write_wings(path, WINGS, made)
        case "handeye":
            write_handeye(path, HandEye(H[0], COVARIANCE, H[1], COVARIANCE, 0.01, 0.001, views), made)
        case "H_OP":
            steady = np.array([True, False])
            write_h_op(path, ImagePanelPoses("panel", ("a.png", "b.png"), np.array([0.0, 1.0]), H, (None, None), steady, 0.01), made)
        case "H_CB":
            points_B = np.array([[0, 0, 0], [0.025, 0, 0], [0, 0.025, 0], [0.025, 0.025, 0.0]])
            pixels = np.full((2, 4, 2), 100.0)
            rms = np.array([0.1, 0.1])
            poses = BoardPoses(("a.png", "b.png"), None, H, pixels, points_B, np.stack([COVARIANCE] * 2), rms, 0.1)
            write_h_cb(path, poses, {}, (2, 2), made)


READERS: dict[str, Callable[[Path], Any]] = {
    "camera": read_camera,
    "calibration": read_calibration,
    "lights": read_lights,
    "wings": read_wings,
    "handeye": read_handeye,
    "H_OP": read_h_op,
    "H_CB": read_h_cb,
}
STRETCHED, MIRRORED, BROKEN = (
    np.diag([1.1, 1.1, 1.1, 1]).tolist(),
    np.diag([1, 1, -1, 1]).tolist(),
    [[float("nan")] * 4] * 4,
)
NONSENSE: list[tuple[str, str, list[Any]]] = [
    ("camera", "K.0.0", [0, -700, float("nan"), float("inf"), "x", None, 10**400]),
    ("camera", "K", [np.eye(2).tolist(), [], [[700, 0, 300], [5, 700, 200], [0, 0, 1]], [[700, 0, 300], [0, 700, 200], [0, 0, 2]]]),
    ("camera", "image_size", [[0, 480], [752, -5], [752], [752, 480, 3], [1e9, 480], "752x480", [float("nan"), 480]]),
    ("camera", "distortion", [[0.1] * 5, [], [float("inf")] * 4, "none", [[0.1] * 4]]),
    ("camera", "model", ["fisheye", None, ["opencv4"], "opencv5"]),
    ("camera", "gamma", [0, -1, float("nan"), "x"]),
    ("camera", "black_level", [-0.1, 1.5, float("nan")]),
    ("camera", "white_level", [0, 0.001, 2]),
    ("camera", "covariance", [np.eye(3).tolist(), (-np.eye(8)).tolist(), "x"]),
    ("camera", "rms_px", [-1, float("inf")]),
    ("calibration", "camera.K.1.1", [0, -700, float("nan")]),
    ("calibration", "camera.image_size", [[0, 480], [752, -5]]),
    ("calibration", "H_PC", [STRETCHED, MIRRORED, BROKEN, [[1]], "x"]),
    ("calibration", "lights.0.H_CL", [STRETCHED, MIRRORED, BROKEN]),
    ("calibration", "lights.0.direction", [[0, 0, 0], [0, 0, float("nan")], [1, 0], "up"]),
    ("calibration", "lights.0.axis", [[0, 0, 0], [float("inf"), 0, 0]]),
    ("calibration", "lights.0.source_m", [[0, 0, 1e6], [float("nan"), 0, 0], [1]]),
    ("calibration", "lights.0.intensity", [-1, 0, float("nan"), float("inf"), [1, 1], [1, -1, 1], "bright"]),
    ("calibration", "lights.0.name", ["L1", "", "../x", "a/b", "..", "ambient", "mask", "short_L1"]),
    ("calibration", "lights.0.lobe", [{"kind": "laser"}, {"kind": "cosine", "exponent": -1}, {"kind": "cosine", "exponent": 1e9}, "x"]),
    ("calibration", "lights.0.position_std_m", [-1, "x", float("inf")]),
    ("calibration", "lights.0.intensity_std", [-0.1, [1]]),
    ("calibration", "lights", [[], None, {}, "L0", [None], ["L0"]]),
    ("calibration", "d_object_m", [-1, 0, "far", float("nan")]),
    ("lights", "lights.0.intensity", [-1, 0]),
    ("lights", "lights.0.direction", [[0, 0, 0]]),
    ("lights", "lights.0.name", ["L1", "a/b"]),
    ("lights", "H_CD", [STRETCHED, MIRRORED, BROKEN]),
    ("wings", "H_CD", [STRETCHED, MIRRORED, BROKEN]),
    ("wings", "lights.0.H_CL", [STRETCHED, MIRRORED, BROKEN]),
    ("wings", "lights.0.setting.joint_angle_deg", [91, -120, float("nan"), "x"]),
    ("wings", "covariance", [np.eye(6).tolist(), (-np.eye(12)).tolist(), "x"]),
    ("handeye", "H_PC", [STRETCHED, MIRRORED, BROKEN, [], "x"]),
    ("handeye", "H_OB", [STRETCHED, MIRRORED, BROKEN]),
    ("handeye", "H_PC_covariance", [(-np.eye(6)).tolist(), np.eye(3).tolist(), "x"]),
    ("handeye", "clock_offset_s", ["soon", float("nan"), [1]]),
    ("H_OP", "views.0.H_OP", [STRETCHED, MIRRORED, BROKEN, [[1]], "x"]),
    ("H_OP", "views.0.t_camera_s", ["x", float("nan"), [1]]),
    ("H_CB", "views.0.H_CB", [STRETCHED, MIRRORED, BROKEN, [[1]], "x"]),
    ("H_CB", "board.points_m", [[], [[1, 2]], [[float("nan")] * 3] * 4, "x"]),
    ("H_CB", "views.0.rms_px", [float("nan"), "x"]),
]


@pytest.mark.parametrize("kind", READERS)
def test_what_can_be_is_read(tmp_path: Path, kind: str) -> None:
    write(kind, tmp_path / "a.yaml")
    READERS[kind](tmp_path / "a.yaml")


@pytest.mark.parametrize(
    ("kind", "key", "value"), [(kind, key, value) for kind, key, values in NONSENSE for value in values], ids=lambda value: str(value)[:30]
)
def test_what_cannot_be_is_refused(tmp_path: Path, kind: str, key: str, value: Any) -> None:
    path = tmp_path / f"{kind}.yaml"
    write(kind, path)
    document = inner = yaml.safe_load(path.read_text())
    *steps, last = [int(step) if step.isdigit() else step for step in key.split(".")]
    for step in steps:
        inner = inner[step]
    inner[last] = value
    path.write_text(yaml.safe_dump(document, sort_keys=False))
    for reader in [READERS[kind], *([read_camera_file] if kind == "camera" or key.startswith("camera.") else [])]:
        with pytest.raises(InputError, match=f"{kind}.yaml") as caught:
            reader(path)
        assert len(str(caught.value)) < 600

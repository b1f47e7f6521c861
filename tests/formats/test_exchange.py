"""Other systems' formats: written, read by those systems' own readers, compared to the last digit; and read back by lpcal."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import cv2
import numpy as np
import pytest
import yaml
from scipy.io import loadmat
from scipy.spatial.transform import Rotation

import lpcal
from exchange_readers import FOCUS_C, H_PC, LENSES, calibration, camera, grid, lights, only, reader, same_lens
from lpcal.api.exchange import Exported
from lpcal.errors import InputError, UsageError
from lpcal.formats.exchange import ADDED, known_formats
from lpcal.records.calibration import Calibration, Lobe
from lpcal.records.exchange import ExchangeContent

EXACT = 1e-9
"""By how much a number may differ after it went through a text with all its digits."""


def export(folder: Path, name: str, content: Calibration | None = None, **more: Any) -> Exported:
    (one,) = lpcal.export_calibration(folder, content or calibration(), [name], **more)
    return one


@pytest.mark.parametrize("model", LENSES)
def test_opencv_reads_its_own(tmp_path: Path, model: str) -> None:
    export(tmp_path, "opencv", calibration(model))
    stored = cv2.FileStorage(str(tmp_path / "camera.opencv.yml"), cv2.FILE_STORAGE_READ)
    K, lens = stored.getNode("camera_matrix").mat(), stored.getNode("distortion_coefficients").mat()
    size = int(stored.getNode("image_width").real()), int(stored.getNode("image_height").real())
    wanted = camera(model)
    assert size == wanted.image_size
    points = wanted.unproject(grid(wanted))
    found = cv2.projectPoints(points.reshape(-1, 1, 3), np.zeros(3), np.zeros(3), K, lens)[0].reshape(-1, 2)
    assert np.abs(found - grid(wanted)).max() < EXACT
    same_lens(lpcal.read_calibration(tmp_path / "camera.opencv.yml").camera, wanted)


@pytest.mark.parametrize("model", LENSES)
def test_ros_has_the_projection_that_image_proc_needs(tmp_path: Path, model: str) -> None:
    export(tmp_path, "ros", calibration(model))
    stored = yaml.safe_load((tmp_path / "camera.ros.yaml").read_text())
    wanted = camera(model)
    keys = {"image_width", "image_height", "camera_name", "camera_matrix", "distortion_model", "distortion_coefficients"}
    assert keys | {"rectification_matrix", "projection_matrix"} == set(stored)
    P = np.reshape(stored["projection_matrix"]["data"], (3, 4))
    K, lens = np.reshape(stored["camera_matrix"]["data"], (3, 3)), np.array(stored["distortion_coefficients"]["data"])
    size = stored["image_width"], stored["image_height"]
    x, y = cv2.initUndistortRectifyMap(K, lens, np.eye(3), P[:, :3], size, cv2.CV_32FC1)  # where image_proc looks pixels up
    at = np.rint(grid(wanted)).astype(int)
    pinhole = np.linalg.solve(wanted.K, np.column_stack([at, np.ones(len(at))]).T).T
    assert np.abs(np.stack([x, y], axis=-1)[at[:, 1], at[:, 0]] - wanted.project(pinhole)).max() < 1e-3  # its map is of float32
    assert np.abs(P[:, 3]).max() == 0
    same_lens(lpcal.read_calibration(tmp_path / "camera.ros.yaml").camera, wanted)


def test_mrcal_reads_the_ros_camera(tmp_path: Path) -> None:
    mrcal = reader("mrcal")
    export(tmp_path, "ros")
    model = mrcal.cameramodel(str(tmp_path / "camera.ros.yaml"))
    found = mrcal.project(camera().unproject(grid(camera())), *model.intrinsics())
    assert np.abs(found - grid(camera())).max() < EXACT


@pytest.mark.parametrize("model", LENSES)
def test_mrcal_reads_its_own_and_the_pose(tmp_path: Path, model: str) -> None:
    mrcal = reader("mrcal")
    export(tmp_path, "mrcal", calibration(model))
    found = mrcal.cameramodel(str(tmp_path / "camera.cameramodel"))
    pixels = mrcal.project(camera(model).unproject(grid(camera(model))), *found.intrinsics())
    assert np.abs(pixels - grid(camera(model))).max() < EXACT
    assert tuple(found.imagersize()) == camera(model).image_size
    Rt = mrcal.Rt_from_rt(found.rt_ref_cam() if callable(getattr(found, "rt_ref_cam", None)) else found.extrinsics_rt_toref())
    assert np.abs(np.vstack([Rt[:3], Rt[3:]]) - np.vstack([H_PC[:3, :3], H_PC[:3, 3]])).max() < EXACT
    back = lpcal.read_calibration(tmp_path / "camera.cameramodel")
    assert np.abs(back.H_PC - H_PC).max() < EXACT


def test_kalibr_has_no_k3_so_the_lens_is_fitted(tmp_path: Path) -> None:
    one = export(tmp_path / "five", "kalibr")
    assert re.search(r"no place for k3: .* fitted again .* ([0-9.e-]+) px at most", one.notes[0])
    stored = yaml.safe_load((tmp_path / "five" / "camchain.yaml").read_text())["cam0"]
    assert (stored["camera_model"], stored["distortion_model"]) == ("pinhole", "radtan")
    fx, fy, cx, cy = stored["intrinsics"]
    K = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    rays = camera().unproject(grid(camera()))
    pixels = cv2.projectPoints(rays.reshape(-1, 1, 3), np.zeros(3), np.zeros(3), K, np.array(stored["distortion_coeffs"]))[0]
    apart = np.abs(pixels.reshape(-1, 2) - grid(camera())).max()
    assert apart < 1.05 * float(re.search(r"([0-9.e-]+) px at most", one.notes[0])[1]), "it is said how far it is off"
    assert export(tmp_path / "four", "kalibr", calibration("opencv4")).notes == ()
    same_lens(lpcal.read_calibration(tmp_path / "four" / "camchain.yaml").camera, camera("opencv4"))


@pytest.mark.parametrize("model", LENSES)
def test_colmap_counts_pixels_half_a_pixel_on(tmp_path: Path, model: str) -> None:
    from lpcal.geometry.colmap import load_pycolmap

    pycolmap = load_pycolmap()
    export(tmp_path, "colmap", calibration(model))
    found = pycolmap.Reconstruction()
    found.read_text(str(tmp_path / "colmap"))
    held = found.cameras[1]
    assert held.model.name == ("OPENCV" if model == "opencv4" else "FULL_OPENCV")
    rays = camera(model).unproject(grid(camera(model)))
    pixels = np.array([held.img_from_cam(ray) for ray in rays])
    assert np.abs(pixels - 0.5 - grid(camera(model))).max() < EXACT
    same_lens(lpcal.read_calibration(tmp_path / "colmap").camera, camera(model))


def test_metashape_by_its_own_equations(tmp_path: Path) -> None:
    """Metashape's manual, appendix: its reader is no package; so the equations that it states are evaluated here."""
    export(tmp_path, "metashape")
    root = ET.parse(tmp_path / "camera.metashape.xml").getroot()
    assert root.findtext("projection") == "frame"
    f, cx, cy, b1, k1, k2, k3, p1, p2 = (float(root.findtext(name)) for name in ("f", "cx", "cy", "b1", "k1", "k2", "k3", "p1", "p2"))
    rays = camera().unproject(grid(camera()))
    x, y = rays[:, 0] / rays[:, 2], rays[:, 1] / rays[:, 2]
    r2 = x**2 + y**2
    bend = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
    x_d = x * bend + p1 * (r2 + 2 * x**2) + 2 * p2 * x * y
    y_d = y * bend + p2 * (r2 + 2 * y**2) + 2 * p1 * x * y
    pixels = np.stack([752 / 2 + cx + x_d * f + x_d * b1, 480 / 2 + cy + y_d * f], axis=1)
    assert np.abs(pixels - 0.5 - grid(camera())).max() < EXACT
    same_lens(lpcal.read_calibration(tmp_path / "camera.metashape.xml").camera, camera())


def test_meshroom_by_its_own_equations(tmp_path: Path) -> None:
    """AliceVision's jsonIO and DistortionBrown: its reader is no package, so what they compute is computed here."""
    export(tmp_path, "meshroom")
    document = json.loads((tmp_path / "meshroom.sfm").read_text())
    one = document["intrinsics"][0]
    fx = float(one["focalLength"]) / float(one["sensorWidth"]) * float(one["width"])
    fy = fx * float(one["pixelRatio"])
    k1, k2, k3, t1, t2 = map(float, one["distortionParams"])
    rays = camera().unproject(grid(camera()))
    x, y = rays[:, 0] / rays[:, 2], rays[:, 1] / rays[:, 2]
    r2 = x**2 + y**2
    bend = k1 * r2 + k2 * r2**2 + k3 * r2**3
    x_d = x + x * bend + t2 * (r2 + 2 * x**2) + 2 * t1 * x * y
    y_d = y + y * bend + t1 * (r2 + 2 * y**2) + 2 * t2 * x * y
    offset = np.array([float(value) for value in one["principalPoint"]])
    pixels = np.stack([x_d * fx, y_d * fy], axis=1) + offset + [752 / 2, 480 / 2]
    assert np.abs(pixels - grid(camera())).max() < EXACT
    assert all(isinstance(value, str) for value in (*one["distortionParams"], one["width"], document["version"][0]))
    assert [view["path"] for view in document["views"]] == [f"L{k}.png" for k in range(6)]
    same_lens(lpcal.read_calibration(tmp_path / "meshroom.sfm").camera, camera())


def test_tf_is_the_camera_in_the_body(tmp_path: Path) -> None:
    export(tmp_path, "tf", body="light panel")
    words = (tmp_path / "tf_static.sh").read_text().split()
    stated = {word: words[k + 1] for k, word in enumerate(words) if word.startswith("--")}
    R = Rotation.from_quat([float(stated[f"--q{axis}"]) for axis in "xyzw"]).as_matrix()
    assert np.abs(R - H_PC[:3, :3]).max() < EXACT
    assert np.abs(np.array([float(stated[f"--{axis}"]) for axis in "xyz"]) - H_PC[:3, 3]).max() < EXACT
    assert (stated["--frame-id"], stated["--child-frame-id"]) == ("light_panel", "camera_optical_frame")


def test_ros_takes_the_transform_as_a_message(tmp_path: Path) -> None:
    rosbags = reader("rosbags.typesys")
    export(tmp_path, "tf")
    store = rosbags.get_typestore(rosbags.Stores.ROS2_HUMBLE)
    types, stored = store.types, yaml.safe_load((tmp_path / "tf_static.yaml").read_text())
    message = types["geometry_msgs/msg/TransformStamped"](
        header=types["std_msgs/msg/Header"](
            stamp=types["builtin_interfaces/msg/Time"](**stored["header"]["stamp"]), frame_id=stored["header"]["frame_id"]
        ),
        child_frame_id=stored["child_frame_id"],
        transform=types["geometry_msgs/msg/Transform"](
            translation=types["geometry_msgs/msg/Vector3"](**stored["transform"]["translation"]),
            rotation=types["geometry_msgs/msg/Quaternion"](**stored["transform"]["rotation"]),
        ),
    )
    name = "geometry_msgs/msg/TransformStamped"
    back = store.deserialize_cdr(store.serialize_cdr(message, name), name)
    assert abs(back.transform.translation.x - H_PC[0, 3]) < EXACT
    assert np.abs(lpcal.read_calibration(tmp_path / "tf_static.yaml").H_PC - H_PC).max() < EXACT


def test_urdf_places_camera_and_lights(tmp_path: Path) -> None:
    urdf = reader("pytransform3d.urdf")
    export(tmp_path, "urdf")
    manager = urdf.UrdfTransformManager()
    manager.load_urdf((tmp_path / "rig.urdf").read_text())
    found = manager.get_transform("camera_optical_frame", "panel")  # takes the camera's coordinates to the panel's
    assert np.abs(found - H_PC).max() < EXACT
    for light in lights():
        assert np.abs(manager.get_transform(f"light_{light.name}", "panel") - H_PC @ light.H_CL).max() < EXACT
    assert np.abs(lpcal.read_calibration(tmp_path / "rig.urdf").H_PC - H_PC).max() < EXACT


def test_the_distance_sensor_goes_with_the_rig(tmp_path: Path) -> None:
    """Its beam is a frame's x axis in URDF and glTF, and rows in MATLAB."""
    beam = lpcal.DistanceSensor(np.array([0.04, -0.01, 0.02]), np.array([-0.1, 0.05, 0.99]) / np.sqrt(0.9926), 0.003, 1.01, 0.002)
    content = replace(calibration(), distance_sensor=beam)
    assert np.allclose(beam.H_CR[:3, :3] @ beam.H_CR[:3, :3].T, np.eye(3))
    for name in ("urdf", "rig-glb", "matlab"):
        export(tmp_path, name, content)
    root = ET.fromstring((tmp_path / "rig.urdf").read_text())
    (joint,) = [one for one in root.iter("joint") if one.find("child").get("link") == "distance_sensor"]
    assert np.allclose([float(value) for value in joint.find("origin").get("xyz").split()], beam.position_C)
    turn = [float(value) for value in joint.find("origin").get("rpy").split()]
    assert np.allclose(Rotation.from_euler("xyz", turn).as_matrix()[:, 0], beam.direction_C)
    text = (tmp_path / "rig.glb").read_bytes()[20:]
    (node,) = [one for one in json.loads(text)["nodes"] if one["name"].startswith("distance sensor")]
    assert np.allclose(Rotation.from_quat(node["rotation"]).as_matrix()[:, 0], beam.direction_C)
    assert node["extras"]["scale"] == 1.01
    stored = loadmat(tmp_path / "calibration.mat")
    assert np.allclose(stored["distance_direction_C"][0], beam.direction_C)
    assert np.allclose(stored["distance_bias_scale_noise"][0], [0.003, 1.01, 0.002])


def test_easy_handeye_as_its_publisher_reads_it(tmp_path: Path) -> None:
    export(tmp_path, "easy_handeye", body="tool0")
    stored = yaml.safe_load((tmp_path / "easy_handeye.yaml").read_text())
    held = stored["transformation"]
    assert stored["parameters"]["eye_on_hand"] is True
    assert stored["parameters"]["robot_effector_frame"] == "tool0"
    R = Rotation.from_quat([held[f"q{axis}"] for axis in "xyzw"]).as_matrix()
    assert np.abs(R - H_PC[:3, :3]).max() < EXACT
    assert np.abs(lpcal.read_calibration(tmp_path / "easy_handeye.yaml").H_PC - H_PC).max() < EXACT


def test_a_camera_that_stands_still_has_its_place_in_the_room(tmp_path: Path) -> None:
    fixed = Calibration("cell", (), None, H_PC, carries="board")
    for name in ("tf", "urdf", "easy_handeye", "matlab"):
        one = export(tmp_path / name, name, fixed)
        back = lpcal.read_calibration(one.files[-1])
        assert back.carries == "board", name
        assert np.abs(back.H_PC - H_PC).max() < EXACT
    lpcal.write_calibration(tmp_path / "calibration.yaml", fixed)
    back = lpcal.read_calibration(tmp_path / "calibration.yaml")
    assert (back.carries, back.lights) == ("board", ())
    assert "H_OC:" in (tmp_path / "calibration.yaml").read_text()


def test_lp_directions_are_those_at_the_working_point(tmp_path: Path) -> None:
    one = export(tmp_path, "lp")
    lines = (tmp_path / "lights.lp").read_text().splitlines()
    assert lines[0] == "6"
    for line, light in zip(lines[1:], lights(), strict=True):
        name, *vector = line.split()
        towards = (light.source_C - FOCUS_C) / np.linalg.norm(light.source_C - FOCUS_C)
        assert name == f"{light.name}.png"
        assert np.abs(np.array(vector, float) - towards * [1, -1, -1]).max() < EXACT
        assert float(vector[2]) > 0, "towards the camera"
    assert "near lights become directions" in one.notes[0]


def test_lp_positions_are_millimetres_about_the_working_point(tmp_path: Path) -> None:
    export(tmp_path, "lp-positions")
    rows = np.array([line.split()[1:] for line in (tmp_path / "lights_positions.lp").read_text().splitlines()[1:-1]], float)
    wanted = 1e3 * (np.array([light.source_C for light in lights()]) - FOCUS_C) * [1, -1, -1]
    assert np.abs(rows - wanted).max() < EXACT


def test_relightlabs_dome(tmp_path: Path) -> None:
    export(tmp_path, "dome")
    dome = json.loads((tmp_path / "rig.dome").read_text())
    assert dome["lightConfiguration"] == "lights3d"
    places = np.array([[one[axis] for axis in "xyz"] for one in dome["positions3d"]])
    assert np.abs(places - 1e3 * (np.array([light.source_C for light in lights()]) - FOCUS_C) * [1, -1, -1]).max() < EXACT
    assert [one["g"] for one in dome["ledAdjust"]] == pytest.approx([light.intensity[1] for light in lights()], abs=EXACT)
    back = lpcal.read_calibration(tmp_path / "rig.dome")
    for found, light in zip(back.lights, lights(), strict=True):
        towards = (light.source_C - FOCUS_C) / np.linalg.norm(light.source_C - FOCUS_C)
        assert np.abs(found.direction_C - towards).max() < EXACT


def test_diligent_has_the_light_that_arrives(tmp_path: Path) -> None:
    export(tmp_path, "diligent")
    folder = tmp_path / "diligent"
    directions, power = (np.loadtxt(folder / f"light_{name}.txt") for name in ("directions", "intensities"))
    arriving = np.array([light.field(FOCUS_C)[1] for light in lights()])
    assert (folder / "filenames.txt").read_text().split() == [f"L{k}.png" for k in range(6)]
    assert np.abs(power / power[0] - arriving / arriving[0]).max() < EXACT
    back = lpcal.read_calibration(folder)
    assert np.abs(np.array([light.direction_C for light in back.lights]) * [1, -1, -1] - directions).max() < EXACT


def test_luces_holds_the_near_lights(tmp_path: Path) -> None:
    export(tmp_path, "luces")
    rows = (tmp_path / "luces" / "led_params.txt").read_text().splitlines()
    count, width, height, f, x0, y0, distance = map(float, rows[1].split())
    assert (count, width, height, f, distance) == (6, 752, 480, 461.629, 360.0)
    assert (x0, y0) == (362.680, 246.049)
    table = np.array([row.split() for row in rows[2:]], float)
    assert np.abs(table[:, :3] - 1e3 * np.array([light.source_C for light in lights()])).max() < EXACT
    back = lpcal.read_calibration(tmp_path / "luces")
    x_C = FOCUS_C + np.random.default_rng(0).normal(0, 0.03, (20, 3))
    for found, light in zip(back.lights, lights(), strict=True):
        assert np.abs(found.field(x_C)[1] / light.field(x_C)[1] - 1).max() < EXACT


def test_near_ps_is_read_by_scipy_as_by_matlab(tmp_path: Path) -> None:
    export(tmp_path, "near_ps")
    light, eye = (loadmat(tmp_path / "near_ps" / f"{name}.mat") for name in ("light", "camera"))
    assert np.abs(light["S"] - 1e3 * np.array([one.source_C for one in lights()])).max() < EXACT
    assert np.abs(light["mu"][:, 0] - [one.lobe.exponent for one in lights()]).max() < EXACT
    assert np.abs(eye["K"] - camera().K).max() == 0
    back = lpcal.read_calibration(tmp_path / "near_ps")
    x_C = FOCUS_C + np.random.default_rng(0).normal(0, 0.03, (20, 3))
    for found, one in zip(back.lights, lights(), strict=True):
        assert np.abs(found.field(x_C)[1] / one.field(x_C)[1] - 1).max() < EXACT


def test_meshrooms_lights(tmp_path: Path) -> None:
    export(tmp_path, "meshroom-lights")
    stored = json.loads((tmp_path / "meshroom_lights.json").read_text())["lights"]
    for k, (one, light) in enumerate(zip(stored, lights(), strict=True)):
        towards = (light.source_C - FOCUS_C) / np.linalg.norm(light.source_C - FOCUS_C)
        assert (one["viewId"], one["type"]) == (str(k), "directional")
        assert np.abs(np.array(one["direction"], float) - towards).max() < EXACT
    back = lpcal.read_calibration(tmp_path / "meshroom_lights.json")
    assert len(back.lights) == 6


def test_matlab_holds_all_of_it(tmp_path: Path) -> None:
    pymatreader = reader("pymatreader")
    export(tmp_path, "matlab", calibration("opencv8"))
    stored = pymatreader.read_mat(str(tmp_path / "calibration.mat"))
    assert np.abs(stored["H_PC"] - H_PC).max() == 0
    assert np.abs(stored["K_matlab"][:2, 2] - camera().K[:2, 2] - 1).max() < EXACT, "MATLAB counts pixels from 1"
    assert np.abs(stored["distortion"] - LENSES["opencv8"]).max() == 0
    back = lpcal.read_calibration(tmp_path / "calibration.mat")
    same_lens(back.camera, camera("opencv8"))
    x_C = FOCUS_C + np.random.default_rng(0).normal(0, 0.03, (20, 3))
    for found, light in zip(back.lights, lights(), strict=True):
        assert np.abs(found.H_CL - light.H_CL).max() == 0
        assert np.abs(found.field(x_C)[1] / light.field(x_C)[1] - 1).max() < 1e-4  # the lobe is a table, every half a degree


def test_a_lobe_that_is_no_cosine_is_fitted_and_said(tmp_path: Path) -> None:
    angle = np.radians(np.arange(0, 61, 3.0))
    flat_topped = Lobe("table", angle_rad=angle, value=np.exp(-((angle / 0.5) ** 4)))
    changed = replace(calibration(), lights=tuple(replace(light, lobe=flat_topped) for light in lights()))
    one = export(tmp_path, "luces", changed)
    said = next(note for note in one.notes if "cosines" in note)
    worst = float(re.search(r"up to ([0-9.e+-]+) %", said)[1])
    mu = float((tmp_path / "luces" / "led_params.txt").read_text().splitlines()[2].split()[9])
    assert 2 < mu < 12
    assert 3 < worst < 30


def test_a_splined_lens_is_fitted_and_how_far_is_said(tmp_path: Path) -> None:
    mrcal = reader("mrcal")
    lens = "LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=10_Ny=8_fov_x_deg=70"
    rng = np.random.default_rng(3)
    vector = np.concatenate([[600.0, 600.0, 320, 240], 1e-4 * rng.normal(size=mrcal.lensmodel_num_params(lens) - 4)])
    splined = replace(camera(), image_size=(640, 480), model="splined", distortion=np.zeros(0), lensmodel=lens, spline=vector)
    splined = replace(splined, K=np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]))
    one = export(tmp_path / "a", "opencv", Calibration("wide", (), splined))
    most = float(re.search(r"([0-9.e-]+) px at most", one.notes[0])[1])
    found = lpcal.read_calibration(tmp_path / "a" / "camera.opencv.yml").camera
    rays = splined.unproject(grid(splined))
    assert 0 < np.linalg.norm(found.project(rays) - grid(splined), axis=1).max() < 1.2 * most < 2
    export(tmp_path / "b", "mrcal", Calibration("wide", (), splined))
    same_lens(lpcal.read_calibration(tmp_path / "b" / "camera.cameramodel").camera, splined)


def test_a_format_says_what_it_lacks(tmp_path: Path) -> None:
    alone = Calibration("lens", (), camera())
    with pytest.raises(InputError, match="no hand-eye"):
        lpcal.export_calibration(tmp_path, alone, ["tf"])
    with pytest.raises(UsageError, match="no format is called opncv"):
        lpcal.export_calibration(tmp_path, alone, ["opncv"])
    assert not list(tmp_path.iterdir()), "nothing is written"
    found = {one.format: one.skipped for one in lpcal.export_calibration(tmp_path, alone)}
    assert found["opencv"] == ""
    assert found["tf"] == "no hand-eye"
    assert "no lights" in found["lp"]


def test_what_somebody_changed_is_not_written_over(tmp_path: Path) -> None:
    export(tmp_path, "opencv")
    export(tmp_path, "opencv", calibration("opencv8"))  # its own may be replaced
    path = tmp_path / "camera.opencv.yml"
    path.write_text(path.read_text() + "# checked by Ann\n")
    with pytest.raises(InputError, match="another file is there already"):
        export(tmp_path, "opencv")
    assert "Ann" in path.read_text()
    export(tmp_path, "ros")
    assert set(json.loads((tmp_path / "lpcal-export.json").read_text())["files"]) == {"camera.opencv.yml", "camera.ros.yaml"}


def test_a_program_adds_a_format(tmp_path: Path) -> None:
    def write(content: ExchangeContent, folder: Path) -> list[str]:
        (folder / "count.txt").write_text(str(len(content.calibration.lights)))
        return ["a count alone"]

    lpcal.register_format(lpcal.ExchangeFormat("count", "a count", ("lights",), "how many", "all else", write))
    try:
        one = export(tmp_path, "count")
        assert only(tmp_path).read_text() == "6"
        assert one.notes == ("a count alone",)
    finally:
        ADDED.clear()
    with pytest.raises(InputError, match="is no format"):
        lpcal.register_format("count")


def test_the_command(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    from lpcal import write_calibration

    write_calibration(tmp_path / "calibration.yaml", calibration())
    code, out, err = lpcal("export", "calibration.yaml", "--format", "opencv,tf", "--format", "lp", "-o", "out", cwd=tmp_path)
    assert code == 0, err
    assert "out: 3 formats" in out
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "camera.opencv.yml", "tf_static.sh", "tf_static.yaml", "lights.lp", "lpcal-export.json"
    }  # fmt: skip
    assert "near lights become directions" in err
    code, out, _ = lpcal("export", "--list")
    assert code == 0
    for name in known_formats():
        assert f"{name}: " in out
    assert out.count("  loses ") == len(known_formats())
    assert lpcal("export", "calibration.yaml", "--format", "tff", "-o", "out")[0] == 2
    code, out, err = lpcal("import", "out/camera.opencv.yml", "-o", "lens.yaml")
    assert code == 0, err
    assert "no lights, a camera" in out
    code, _, err = lpcal("reconstruct", "out", "-c", "lens.yaml")
    assert code == 3
    assert "no lights" in err
    code, out, err = lpcal("export", "lens.yaml", "--format", "all", "--json")
    assert code == 0, err
    done = {one["format"]: one["skipped"] for one in json.loads(out)["formats"]}
    assert done["kalibr"] is None
    assert done["lp"] == "no lights"


def test_the_table_in_the_docs_is_that_of_the_formats() -> None:
    from make_formats_table import PAGE, page

    assert page(PAGE.read_text(encoding="utf-8")) == PAGE.read_text(encoding="utf-8"), "python tools/make_formats_table.py --write"


def test_every_format_is_read_back_by_a_test_of_that_name() -> None:
    from lpcal.formats.exchange import OWN
    from make_formats_table import READ_BACK

    assert [*READ_BACK] == [one.name for one in OWN]
    tests = "".join(path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_exchange*.py"))
    for name, back in READ_BACK.items():
        assert f"def {back.test}(" in tests, name
        assert bool(back.by) or bool(back.instead), name

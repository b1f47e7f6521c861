"""What a format holds comes back: every format that lpcal reads too, and scenes with lights that other programs wrote."""

from __future__ import annotations

import json
import struct
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import lpcal
from exchange_readers import FOCUS_C, H_PC, calibration, camera, lights, same_lens
from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import lobe_document
from lpcal.formats.exchange import OWN
from lpcal.formats.import_other import import_other
from lpcal.records.calibration import Calibration

EXACT = 1e-9
BACK = [one for one in OWN if one.read is not None]
LENS = {"opencv", "ros", "colmap", "mrcal", "metashape", "meshroom", "matlab", "rig-glb"}
"""Formats that hold the lens of five coefficients as it is."""
POSE = {"mrcal", "tf", "urdf", "easy_handeye", "matlab", "rig-glb"}
PLACES = {"lp-positions", "dome", "luces", "near_ps", "matlab", "rig-glb"}
FRAMES = {"urdf", "matlab", "rig-glb"}
DIRECTIONS = {"lp", "diligent", "meshroom-lights"}
"""Formats that hold near lights as directions from the working point."""
FILES = {"colmap": "colmap", "diligent": "diligent", "luces": "luces", "near_ps": "near_ps", "tf": "tf_static.yaml"}
"""What of a format is read, where it is not its one file."""


def place_of(name: str, folder: Path) -> Path:
    (one,) = lpcal.export_calibration(folder, calibration(), [name])
    return folder / FILES[name] if name in FILES else one.files[0]


@pytest.mark.parametrize("name", [one.name for one in BACK])
def test_what_a_format_holds_comes_back(tmp_path: Path, name: str) -> None:
    place = place_of(name, tmp_path)
    found, back = import_other(place), lpcal.read_calibration(place)
    assert found.format
    wanted = calibration()
    if name in LENS:
        same_lens(back.camera, camera())
    if name in POSE:
        assert np.abs(back.H_PC - H_PC).max() < EXACT
    if name in PLACES | FRAMES | DIRECTIONS:
        assert len(back.lights) == len(wanted.lights)
    for got, light in zip(back.lights, wanted.lights, strict=bool(back.lights)):
        if name in PLACES:
            assert np.abs(got.source_C - light.source_C).max() < EXACT
        if name in FRAMES:
            assert np.abs(got.H_CL - light.H_CL).max() < EXACT
        if name in DIRECTIONS:
            towards = (light.source_C - FOCUS_C) / np.linalg.norm(light.source_C - FOCUS_C)
            assert np.abs(got.direction_C - towards).max() < EXACT
    assert name in LENS | POSE | PLACES | FRAMES | DIRECTIONS | {"kalibr"}, "a format that no comparison covers"


def test_every_format_of_a_calibration_is_read_too() -> None:
    """Only images and surfaces, which are no calibration, are written alone."""
    assert {one.name for one in OWN if one.read is None} == {
        "ptm", "hsh", "openlime", "ply", "glb", "obj", "stl", "depth-tiff", "depth-exr", "points", "normals"
    }  # fmt: skip


@pytest.mark.parametrize("carries", ["camera", "board"])
def test_the_rig_as_a_scene_comes_back_whole(tmp_path: Path, carries: str) -> None:
    beam = lpcal.DistanceSensor(np.array([0.04, -0.01, 0.02]), np.array([-0.1, 0.05, 0.99]) / np.sqrt(0.9926), 0.003, 1.01, 0.002)
    wanted = replace(calibration(), carries=carries, distance_sensor=beam)
    lpcal.export_calibration(tmp_path, wanted, ["rig-glb"])
    back = lpcal.read_calibration(tmp_path / "rig.glb")
    assert (back.name, back.carries, back.d_object_m) == (wanted.name, carries, wanted.d_object_m)
    assert (back.camera.black_level, back.camera.gamma) == (0.008, 1.0)
    assert back.warnings == ()
    assert np.abs(back.H_PC - H_PC).max() < EXACT
    assert np.abs(back.focus_C - FOCUS_C).max() < EXACT
    assert np.abs(back.distance_sensor.H_CR - beam.H_CR).max() < EXACT
    assert (back.distance_sensor.scale, back.distance_sensor.noise_m) == (1.01, 0.002)
    x_C = FOCUS_C + np.random.default_rng(0).normal(0, 0.03, (20, 3))
    for got, light in zip(back.lights, wanted.lights, strict=True):
        assert got.name == light.name
        assert lobe_document(got.lobe) == lobe_document(light.lobe)
        assert np.abs(got.field(x_C)[1] / light.field(x_C)[1] - 1).max() < EXACT


def test_a_scene_of_a_distant_rig_and_of_a_camera_alone(tmp_path: Path) -> None:
    far = tuple(replace(light, source_C=None, axis_C=None, H_CL=None) for light in lights())
    lpcal.export_calibration(tmp_path / "far", replace(calibration(), lights=far, H_PC=None), ["rig-glb"])
    back = lpcal.read_calibration(tmp_path / "far" / "rig.glb")
    assert back.H_PC is None
    for got, light in zip(back.lights, far, strict=True):
        assert got.source_C is None
        assert np.abs(got.direction_C - light.direction_C).max() < EXACT
    lpcal.export_calibration(tmp_path / "eye", Calibration("eye", (), camera()), ["rig-glb"])
    back = lpcal.read_calibration(tmp_path / "eye" / "rig.glb")
    assert back.lights == ()
    same_lens(back.camera, camera())


def scene(**more: object) -> dict[str, object]:
    """A scene as Blender writes it: z of the room becomes y, a group that is turned, moved and scaled, a camera and lamps below it."""
    lamp = {"extensions": {"KHR_lights_punctual": {"light": 0}}}
    spots = [
        {"type": "spot", "color": [1, 0.5, 0.25], "intensity": 200, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}},
        {"type": "point", "intensity": 100},
        {"type": "directional", "intensity": 3},
    ]
    nodes = [
        {"name": "group", "children": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8], "translation": [1, 2, 3], "scale": [2, 2, 2]},
        {"name": "Camera", "camera": 0, "translation": [0, 0, 1]},
        {"name": "Spot", "translation": [0.1, 0, 1], **lamp},
        {"name": "Lamp", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.2, 1, 1],
         "extensions": {"KHR_lights_punctual": {"light": 1}}},
    ]  # fmt: skip
    found = {
        "asset": {"version": "2.0", "generator": "Khronos glTF Blender I/O v4.2"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.4, "znear": 0.1}}],
        "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": spots}},
    }  # fmt: skip
    return found | more


def test_a_scene_that_another_program_wrote(tmp_path: Path) -> None:
    path = tmp_path / "stage.gltf"
    path.write_text(json.dumps(scene()))
    back = lpcal.read_calibration(path)
    spot, lamp = back.lights
    assert (spot.name, lamp.name) == ("Spot", "Lamp")
    assert np.abs(spot.source_C - [0.2, 0, 0]).max() < EXACT, "beside the camera, in metres of the room"
    assert np.abs(lamp.source_C - [0, 0.4, 0]).max() < EXACT, "up is -y of the camera"
    assert np.abs(spot.axis_C - [0, 0, 1]).max() < EXACT
    assert spot.intensity / lamp.intensity == pytest.approx([2, 1, 0.5])
    angle = np.array([0, 0.2, 0.4, 0.6, 0.7])
    wanted = np.clip((np.cos(angle) - np.cos(0.6)) / (np.cos(0.2) - np.cos(0.6)), 0, 1) ** 2
    assert np.abs(spot.lobe(angle) - wanted).max() < 1e-3
    assert lamp.lobe.kind == "isotropic"
    assert back.camera is None
    assert "states no image size" in back.warnings[0]


def test_scenes_that_are_none_of_a_rig(tmp_path: Path) -> None:
    endless, twice, squashed = scene(), scene(), scene()
    endless["nodes"][1]["children"] = [0]
    twice["nodes"][2]["name"] = "Lamp"
    squashed["nodes"][0]["scale"] = [1, 1, -1]
    for text, words in (
        (endless, "stands twice"),
        (twice, "two lights of one name"),
        (squashed, "squashed"),
        (scene(extensions={"KHR_lights_punctual": {"lights": 2 * [{"type": "spot", "spot": {"outerConeAngle": 9}}]}}), "a cone of 0 to 9"),
        (scene(nodes=[{"name": "Camera"}], cameras=[]), "no lights and no camera"),
    ):
        (tmp_path / "bad.gltf").write_text(json.dumps(text))
        with pytest.raises(InputError, match=words):
            lpcal.read_calibration(tmp_path / "bad.gltf")
    for raw in (b"", b"glTF", struct.pack("<5I", 0x46546C67, 2, 20, 2**31, 0x4E4F534A), b"{}", b"[1]", json.dumps(scene()).encode()[:300]):
        (tmp_path / "bad.glb").write_bytes(raw)
        with pytest.raises(InputError, match=r"of no format that lpcal imports|of no known format"):
            lpcal.read_calibration(tmp_path / "bad.glb")

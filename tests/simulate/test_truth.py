"""A simulated rig agrees with its own truth: what its images show is what its files say."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import yaml

from lpcal.detect.board import find_board
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3, sphere
from lpcal.pipeline.simulate import simulate
from lpcal.records.observations import Board
from lpcal.records.outcome import silent
from lpcal.records.rig import BoardSection, Rig
from lpcal.simulate.boards import make_scene
from lpcal.simulate.built import build
from lpcal.simulate.motion import station_poses
from lpcal.simulate.recipe import Recipe

PANEL = """
lpcal: 1
name: small
camera: {images: stations/*.png, black_level: 0.8 %, flat_field: flat.png}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
mocap: {file: mocap.csv, body: LightPanel, images: [stations.csv, sweep.csv]}
panel:
  disc_radius: 60 mm
  joint: 15 mm
  blob: 30 mm
  markers: {Marker1: [81 mm, 0 mm, 4 mm], Marker2: [24 mm, 79 mm, 12 mm], Marker3: [-74 mm, 41 mm, 4 mm], Marker4: [-58 mm, -62 mm, 20 mm]}
lights:
  L0: {azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}
  L1: {azimuth: 120 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 7}
  L2: {azimuth: 240 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 1}
spheres:
  chrome: {kind: chrome, radius: 25 mm, images: spheres/chrome}
  matte: {kind: matte, radius: 25 mm, images: spheres/matte}
objects: {pair: objects/pair}
"""
RECIPE = Recipe(seed=11, image_size=(360, 240), stations=8, sweep_frames=6, dwell_s=0.5)


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory) -> Path:
    here = tmp_path_factory.mktemp("simulated")
    (here / "panel.yaml").write_text(PANEL)
    simulate(read_rig(here / "panel.yaml"), here / "rig", RECIPE, silent)
    return here / "rig"


def truth(rig: Path, name: str) -> dict[str, Any]:
    return yaml.safe_load((rig / "truth" / f"{name}.yaml").read_text())


def poses(path: Path) -> tuple[list[str], np.ndarray]:
    rows = list(csv.DictReader(path.read_text().splitlines()))
    q, t = (np.array([[float(row[key]) for key in keys] for row in rows]) for keys in (("qx", "qy", "qz", "qw"), ("x", "y", "z")))
    return [row["image"] for row in rows], se3.transform(se3.rotation_from_quaternion(q), t)


def lens(rig: Path) -> tuple[np.ndarray, np.ndarray]:
    camera = truth(rig, "camera")
    return np.array(camera["K"]), np.array(camera["distortion"])


def board_points(rig: Path) -> np.ndarray:
    board = truth(rig, "handeye")["board"]
    u, v = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 6))
    z = -0.7 * u**2 - 0.3 * v**2 + board["twist"] * u * v
    return np.stack([0.1 * (u + 1), 0.0625 * (v + 1), board["bow_m"] * (z - z.mean())], axis=-1).reshape(-1, 3)


def test_rendered_corners_are_the_projected_ones(rig: Path) -> None:
    K, distortion = lens(rig)
    images, H_CB = poses(rig / "truth" / "H_CB.csv")
    errors = []
    for image, H in zip(images, H_CB, strict=True):
        grey = cv2.imread(str(rig / image), cv2.IMREAD_GRAYSCALE)
        true = cv2.projectPoints(board_points(rig), cv2.Rodrigues(H[:3, :3])[0], H[:3, 3], K, distortion)[0].reshape(6, 9, 2)
        spacing = min(np.linalg.norm(np.diff(true, axis=axis), axis=-1).min() for axis in (0, 1))
        window = max(2, int(0.4 * spacing))
        found = cv2.cornerSubPix(grey, true.reshape(-1, 1, 2).astype(np.float32) + 0.4, (window, window), (-1, -1), (3, 80, 1e-4))
        errors.append(found.reshape(-1, 2) - true.reshape(-1, 2))
    errors = np.array(errors)
    assert len(errors) == 14
    assert np.abs(np.median(errors, axis=(0, 1))).max() < 0.01
    assert np.sqrt(np.mean(errors**2)) < 0.06
    assert np.abs(errors).max() < 0.35


def test_edges_do_not_stand_in_steps() -> None:
    """Without noise and stored bits corners are where they should be: sixteen plain samples a pixel leave 0.12 px."""
    board = BoardSection(corners=(9, 6), square="25 mm")
    built = build(Rig(lpcal=1, board=board), RECIPE)
    scene = make_scene(built, board, 0.6)
    poses = station_poses(built, board.corners, board.square, 12, np.random.default_rng(1))
    errors = []
    for H in poses:
        image = (255 * scene.render(H, np.zeros(2), np.full((240, 360), 0.05))).astype(np.float32)
        view = find_board(image, Board((9, 6), (0.025, 0.025)))
        if view.corners_px is not None:
            errors.append(view.corners_px - built.lens.project(se3.apply(H, scene.points_B())))
    assert len(errors) >= 10
    assert np.sqrt(np.nanmean(np.square(errors))) < 0.004
    assert np.nanmax(np.abs(errors)) < 0.03


def test_the_first_corner_is_the_one_whose_outer_square_is_black(rig: Path) -> None:
    K, distortion = lens(rig)
    images, H_CB = poses(rig / "truth" / "H_CB.csv")
    outside_B = np.array([[-0.0125, -0.0125, 0], [0.2125, 0.1375, 0]])
    for image, H in zip(images, H_CB, strict=True):
        grey = cv2.imread(str(rig / image), cv2.IMREAD_GRAYSCALE)
        (u0, v0), (u1, v1) = (
            cv2.projectPoints(outside_B, cv2.Rodrigues(H[:3, :3])[0], H[:3, 3], K, distortion)[0].reshape(2, 2).round().astype(int)
        )
        assert int(grey[v0, u0]) + 30 < int(grey[v1, u1])


def test_the_poses_chain_to_the_board_in_the_room(rig: Path) -> None:
    handeye = truth(rig, "handeye")
    images, H_OP = poses(rig / "truth" / "H_OP.csv")
    also, H_CB = poses(rig / "truth" / "H_CB.csv")
    assert images == also
    np.testing.assert_allclose(H_OP @ np.array(handeye["H_PC"]) @ H_CB, np.broadcast_to(handeye["H_OB"], H_OP.shape), atol=2e-8)
    np.testing.assert_allclose(np.array(handeye["H_PD"]) @ np.array(handeye["H_DC"]), handeye["H_PC"], atol=1e-12)


def test_the_recording_is_the_true_motion_but_for_noise_and_named_failures(rig: Path) -> None:
    handeye = truth(rig, "handeye")
    rows = list(csv.reader((rig / "mocap.csv").read_text().splitlines()))[7:]
    kept = np.array([[float(cell) for cell in row[1:10]] for row in rows if row[2]])
    assert len(kept) < len(rows)
    H = se3.transform(se3.rotation_from_quaternion(kept[:, 1:5]), kept[:, 5:8])
    times = {row["image"]: float(row["t_camera_s"]) for row in csv.DictReader((rig / "truth" / "H_OP.csv").read_text().splitlines())}
    images, H_OP = poses(rig / "truth" / "H_OP.csv")
    t_s = np.array([times[image] for image in images]) - handeye["clock_offset_s"]
    E = se3.inv(H_OP) @ se3.interpolate(H, kept[:, 0], t_s)
    bad = {entry["station"]: entry["why"] for entry in handeye["bad_stations"]}
    assert bad
    for k in range(8):
        turned, moved = np.degrees(se3.angle_rad(E[k, :3, :3])), np.linalg.norm(E[k, :3, 3])
        if k not in bad:
            assert turned < 0.4
            assert moved < 0.0012
        elif bad[k].startswith("flipped"):
            nearest = kept[np.argmin(np.abs(kept[:, 0] - t_s[k])), 8]
            assert turned > 10
            assert nearest > 0.002
        else:
            assert np.min(np.abs(kept[:, 0] - t_s[k])) > 0.05


def test_the_field_is_the_sum_over_the_leds(rig: Path) -> None:
    leds = np.load(rig / "truth" / "leds.npz")
    rows = list(csv.DictReader((rig / "truth" / "field.csv").read_text().splitlines()))
    assert {row["light"] for row in rows} == {"L0", "L1", "L2"}
    assert [len(leds[f"{name}_power"]) for name in ("L0", "L1", "L2")] == [19, 7, 1]
    for row in rows[::17]:
        x_C = np.array([float(row[key]) for key in ("x_m", "y_m", "z_m")])
        E = np.zeros(3)
        for position, axis, power in zip(*(leds[f"{row['light']}_{part}"] for part in ("position", "axis", "power")), strict=True):
            d, r = (position - x_C) / np.linalg.norm(position - x_C), np.linalg.norm(position - x_C)
            E += power * max(-d @ axis, 0.0) ** float(leds["exponent"]) / r**2 * d
        assert float(row["irradiance"]) == pytest.approx(np.linalg.norm(E), rel=1e-6)
        np.testing.assert_allclose([float(row[key]) for key in ("dx", "dy", "dz")], E / np.linalg.norm(E), atol=1e-7)


def test_lights_follow_the_wings_within_tolerance(rig: Path) -> None:
    H_CD = se3.inv(np.array(truth(rig, "handeye")["H_DC"]))
    for light, azimuth_deg in zip(truth(rig, "lights")["lights"], (0, 120, 240), strict=True):
        a, g = np.radians(light["azimuth_deg"]), np.radians(light["joint_angle_deg"])
        origin_D = np.array([np.cos(a), np.sin(a), 0]) * (light["d1_m"] + light["d2_m"] * np.cos(g)) + [0, 0, light["d2_m"] * np.sin(g)]
        axis_D = np.array([-np.sin(g) * np.cos(a), -np.sin(g) * np.sin(a), np.cos(g)])
        np.testing.assert_allclose(np.array(light["H_DL"])[:3, 3], origin_D, atol=1e-12)
        np.testing.assert_allclose(np.array(light["H_DL"])[:3, 2], axis_D, atol=1e-12)
        np.testing.assert_allclose(light["H_CL"], H_CD @ np.array(light["H_DL"]), atol=1e-12)
        off = [light["azimuth_deg"] - azimuth_deg, light["joint_angle_deg"] - 30, 1e3 * light["d1_m"] - 103.923, 1e3 * light["d2_m"] - 85]
        assert np.all(np.abs(off) <= 2 * np.array([0.5, 1, 0.5, 0.5]) + 1e-9)
        assert max(np.abs(off)) > 0


def test_highlights_stand_where_the_mirror_law_puts_them(rig: Path) -> None:
    K, distortion = lens(rig)
    leds, ball = np.load(rig / "truth" / "leds.npz"), truth(rig, "spheres")["chrome"]
    centre_C = np.array(ball["centre_m"])
    for name in ("L0", "L1", "L2"):
        image = cv2.imread(str(rig / f"spheres/chrome/short_{name}.png"), cv2.IMREAD_GRAYSCALE).astype(float)
        assert 80 < image.max() < 250
        v, u = np.unravel_index(np.argmax(image), image.shape)
        patch = image[v - 4 : v + 5, u - 4 : u + 5] - np.median(image)
        patch[patch < 3] = 0
        rows, columns = np.mgrid[v - 4 : v + 5, u - 4 : u + 5]
        found = np.array([np.sum(columns * patch), np.sum(rows * patch)]) / patch.sum()
        middle = leds[f"{name}_power"] @ leds[f"{name}_position"] / leds[f"{name}_power"].sum()
        P = sphere.mirror_point(centre_C, ball["radius_m"], middle)
        expected = cv2.projectPoints(P.reshape(1, 3), np.zeros(3), np.zeros(3), K, distortion)[0].ravel()
        assert np.linalg.norm(found - expected) < 0.25  # the LEDs that face the sphere weigh more than the others


def test_matte_pixels_are_lambertian_in_the_true_field(rig: Path) -> None:
    """Reads stored numbers back to light: black level, flat field and exposure are one factor for all pixels of all lights."""
    K, distortion = lens(rig)
    leds, ball = np.load(rig / "truth" / "leds.npz"), truth(rig, "spheres")["matte"]
    flat = cv2.GaussianBlur(cv2.imread(str(rig / "flat.png"), 0).astype(float) - 0.008 * 255, (0, 0), 6)
    ambient = cv2.imread(str(rig / "spheres/matte/ambient.png"), 0).astype(float)
    centre_C, radius_m = np.array(ball["centre_m"]), ball["radius_m"]
    middle = cv2.projectPoints(centre_C.reshape(1, 3), np.zeros(3), np.zeros(3), K, distortion)[0].ravel().round().astype(int)
    ratios = []
    for name in ("L0", "L1", "L2"):
        image = cv2.imread(str(rig / f"spheres/matte/{name}.png"), 0).astype(float)
        for du in range(-12, 13, 2):
            for dv in range(-12, 13, 2):
                pixel = middle + np.array([du, dv])
                plane = cv2.undistortPoints(pixel.astype(float).reshape(1, 1, 2), K, distortion).ravel()
                ray = np.array([*plane, 1]) / np.linalg.norm([*plane, 1])
                along = ray @ centre_C
                x_C = (along - np.sqrt(along**2 - centre_C @ centre_C + radius_m**2)) * ray
                n = (x_C - centre_C) / radius_m
                to = leds[f"{name}_position"] - x_C
                r = np.linalg.norm(to, axis=1)
                lobe = np.maximum(-np.sum(to * leds[f"{name}_axis"], axis=1) / r, 0) ** float(leds["exponent"])
                E = np.sum(leds[f"{name}_power"] * lobe / r**2 * np.maximum(to @ n / r, 0))
                stored = image[pixel[1], pixel[0]]
                if stored < 240 and E > 3:
                    ratios.append((stored - ambient[pixel[1], pixel[0]]) / flat[pixel[1], pixel[0]] / E)
    ratios = np.array(ratios)
    assert len(ratios) > 200
    spread = ratios.std() / ratios.mean()
    assert 0.005 < spread < 0.06  # a few percent of texture and noise, no more


def test_surface_truth_is_a_surface(rig: Path) -> None:
    K, distortion = lens(rig)
    true = np.load(rig / "truth" / "objects" / "pair.npz")
    mask, component = true["mask"], true["component"]
    assert set(np.unique(component)) == {0, 1, 2}
    np.testing.assert_array_equal(mask, component > 0)
    height, width = mask.shape
    pixels = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1).reshape(-1, 1, 2).astype(float)
    plane = cv2.undistortPoints(pixels, K, distortion, criteria=(3, 100, 1e-12)).reshape(height, width, 2)
    x_C = np.concatenate([plane, np.ones((height, width, 1))], axis=-1) * true["depth"][..., None]
    along, down = np.gradient(x_C, axis=1), np.gradient(x_C, axis=0)
    n = np.cross(along, down)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    n[n[..., 2] > 0] *= -1
    inside = cv2.erode(mask.astype(np.uint8), np.ones((7, 7))) > 0
    angle = np.degrees(np.arccos(np.clip(np.sum(n * true["normals"], axis=-1), -1, 1)))[inside]
    assert np.median(angle) < 0.3
    assert np.all(np.sum(true["normals"][mask] * x_C[mask], axis=-1) < 1e-3)


def test_shadows_fall_where_the_object_stands_between(rig: Path) -> None:
    """The wall behind is lit by L0 (from the right) save for one patch, which lies left of the object."""
    lit = cv2.imread(str(rig / "objects/pair/L0.png"), 0).astype(float) - cv2.imread(str(rig / "objects/pair/ambient.png"), 0)
    mask = np.load(rig / "truth" / "objects" / "pair.npz")["mask"]
    wall = cv2.dilate(mask.astype(np.uint8), np.ones((5, 5))) == 0
    near = cv2.dilate(mask.astype(np.uint8), np.ones((51, 51))) > 0
    dark = wall & near & (cv2.GaussianBlur(lit, (0, 0), 1.5) < 2)
    assert dark.sum() > 300
    assert np.nonzero(dark)[1].mean() < np.nonzero(mask)[1].mean() - 10

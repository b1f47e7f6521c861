"""Spheres in rendered images, the joint fit of every LED, and the commands wings, refine, export, field on the bundled rig."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml

from lpcal.api.lights import wing_of
from lpcal.chain.h_pl_wings import design_lights
from lpcal.chain.refine_lights import refine
from lpcal.detect.radiometry import Sensor, fit_flat_field, to_radiance
from lpcal.detect.spheres import Expected, observe_sphere
from lpcal.formats.calibration_yaml import light_document, light_from_document
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.capture import read_capture
from lpcal.formats.field_csv import read_field
from lpcal.formats.images import read_image
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry import se3, sphere
from lpcal.pipeline.refine import _looked
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import Camera, LightsSolution, Wings
from lpcal.records.observations import SphereView
from lpcal.records.outcome import silent
from lpcal.view.parallel import cores

RIG = Path(__file__).resolve().parents[3] / "calib_data" / "demo_rig"
Run = Callable[..., tuple[int, str, str]]


def truth(name: str) -> dict[str, object]:
    return yaml.safe_load((RIG / "truth" / name).read_text())


@pytest.fixture(scope="module")
def camera() -> Camera:
    found = truth("camera.yaml")
    return Camera(tuple(found["image_size"]), "opencv5", np.array(found["K"]), np.array(found["distortion"]))


@pytest.fixture(scope="module")
def views(camera: Camera) -> list[SphereView]:
    rig = read_rig(RIG / "panel.yaml").rig
    levels = Sensor(rig.camera.black_level)
    sensor = Sensor(rig.camera.black_level, flat_field=fit_flat_field(read_image(RIG / "flat.png").pixels, levels))
    return [
        observe_sphere(
            to_radiance(read_capture(RIG / section.images, list(rig.lights), name=name), sensor),
            Expected(section.kind, section.radius, None, (0.15, 0.9)),
            camera,
        )
        for name, section in rig.spheres.items()
    ]


def drawn_wings(clicked: str = "", clicks: int = 0) -> Wings:
    """The wings as drawn, one joint stated some clicks of 10 degrees off."""
    rig = read_rig(RIG / "panel.yaml").rig
    H_CD = se3.inv(np.array(truth("handeye.yaml")["H_DC"]))
    wings = [wing_of(name, light, rig.panel) for name, light in rig.lights.items()]
    wings = [replace(w, joint_angle_rad=w.joint_angle_rad + np.radians(10 * clicks * (w.name == clicked))) for w in wings]
    sigma = np.array([np.radians(0.5), np.radians(1), 5e-4, 5e-4])
    rng = np.random.default_rng(5)
    disc_sigma = np.array([1e-3] * 3 + [3e-4] * 3)
    return design_lights(wings, se3.exp(rng.normal(size=6) * disc_sigma) @ H_CD, np.diag(disc_sigma**2), sigma, "test")


@pytest.fixture(scope="module")
def solution(views: list[SphereView], camera: Camera) -> LightsSolution:
    wings = drawn_wings()
    return refine(views, [wing.name for wing in wings.wings], camera, wings, intensity_sd=0.1)


@pytest.mark.parametrize("clicks", [pytest.param(0, marks=pytest.mark.slow), 1])
def test_shading_tells_a_click_that_one_chrome_sphere_does_not(views: list[SphereView], camera: Camera, clicks: int) -> None:
    some = [view for view in views if view.name != "chrome_1"]
    wings = drawn_wings("L2", clicks)
    found = refine(some, [wing.name for wing in wings.wings], camera, wings, intensity_sd=0.1)
    said = [warning for warning in found.warnings if "joint at" in warning]
    assert said == (["L2: joint at 30 deg, not 40 deg; correct joint_angle in panel.yaml"] if clicks else [])
    frames = {entry["name"]: np.array(entry["H_CL"]) for entry in truth("lights.yaml")["lights"]}
    axis = [np.degrees(np.arccos(np.clip(light.H_CL[:3, 2] @ frames[light.name][:3, 2], -1, 1))) for light in found.lights]
    assert np.sqrt(np.mean(np.square(axis))) < 1.0


def test_outlines_lie_where_the_spheres_are(views: list[SphereView], camera: Camera) -> None:
    for view in views:
        true = truth("spheres.yaml")[view.name]
        drawn = camera.project(sphere.outline(np.array(true["centre_m"]), true["radius_m"], np.linspace(0, 2 * np.pi, 720)))
        middle = drawn.mean(axis=0)
        radius = np.interp(_around(view.outline_px - middle), *_sorted(_around(drawn - middle), np.linalg.norm(drawn - middle, axis=1)))
        offset = np.linalg.norm(view.outline_px - middle, axis=1) - radius
        assert abs(np.median(offset)) < (0.45 if view.kind == "chrome" else 0.15)
        assert np.std(offset) < 0.5
        assert len(view.outline_px) > (150 if view.kind == "chrome" else 250)


def test_highlights_are_the_mirror_images_of_the_lights(views: list[SphereView], camera: Camera) -> None:
    sources = {entry["name"]: np.array(entry["source_m"]) for entry in truth("lights.yaml")["lights"]}
    chrome = [view for view in views if view.kind == "chrome"]
    assert len(chrome) == 2
    for view in chrome:
        true = truth("spheres.yaml")[view.name]
        assert set(view.highlights_px) == set(sources)
        for light, seen in view.highlights_px.items():
            expected = camera.project(sphere.mirror_point(np.array(true["centre_m"]), true["radius_m"], sources[light]))
            assert np.linalg.norm(seen - expected) < 0.12, (view.name, light)


def test_the_joint_fit_finds_field_frames_and_axes(solution: LightsSolution) -> None:
    points_C, true = read_field(RIG / "truth" / "field.csv")
    angles, ratios, within = [], [], []
    for light in solution.lights:
        d_C, irradiance = light.field(points_C)
        true_d, true_irradiance = true[light.name]
        lit = true_irradiance > 0.01 * true_irradiance.max()
        angles.append(np.degrees(np.arccos(np.clip(np.sum(d_C * true_d, axis=1), -1, 1)))[lit])
        ratios.append((irradiance[:, 0] / true_irradiance)[lit])
        within.append(np.sqrt(np.mean(angles[-1] ** 2)) / (np.sqrt(2) * np.degrees(light.direction_std_rad)))
    ratio = np.concatenate(ratios)
    assert np.sqrt(np.mean(np.concatenate(angles) ** 2)) < 0.15
    assert np.sqrt(np.mean((ratio * ratio.sum() / np.sum(ratio**2) - 1) ** 2)) < 0.025
    assert np.sqrt(np.mean(np.square(within))) < 2.0
    frames = {entry["name"]: np.array(entry["H_CL"]) for entry in truth("lights.yaml")["lights"]}
    origin = [np.linalg.norm(light.H_CL[:3, 3] - frames[light.name][:3, 3]) for light in solution.lights]
    axis = [np.degrees(np.arccos(np.clip(light.H_CL[:3, 2] @ frames[light.name][:3, 2], -1, 1))) for light in solution.lights]
    assert np.sqrt(np.mean(np.square(origin))) < 1.5e-3
    assert np.sqrt(np.mean(np.square(axis))) < 0.9
    assert all(finding.used for finding in solution.spheres)


def test_a_light_survives_its_file(solution: LightsSolution) -> None:
    points_C = np.array([[0.01, 0.02, 0.33], [-0.03, 0.0, 0.36]])
    for light in solution.lights:
        again = light_from_document(yaml.safe_load(yaml.safe_dump(_plain(light_document(light)))))
        np.testing.assert_allclose(again.field(points_C)[0], light.field(points_C)[0], atol=1e-6)
        np.testing.assert_allclose(again.field(points_C)[1], light.field(points_C)[1], rtol=1e-4)


@pytest.fixture(scope="module")
def dome(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bundled rig as a dome: no mocap, no panel, the camera from a file, nothing known of the lights."""
    folder = tmp_path_factory.mktemp("dome")
    for name in ("spheres", "objects"):
        shutil.copytree(RIG / name, folder / name)
    shutil.copy(RIG / "flat.png", folder)
    true = truth("camera.yaml")
    K, d = true["K"], true["distortion"]
    lens = [K[0][0], K[1][1], K[0][2], K[1][2], *d]
    (folder / "lens.cameramodel").write_text(
        "{ 'lensmodel': 'LENSMODEL_OPENCV5', 'intrinsics': " + str([float(x) for x in lens]) + ","
        " 'rt_cam_ref': [0,0,0,0,0,0], 'extrinsics': [0,0,0,0,0,0], 'imagersize': " + str(list(true["image_size"])) + " }\n"
    )
    spheres = "\n".join(
        f"  {n}: {{kind: {n.split('_')[0]}, radius: 25 mm, images: spheres/{n}}}" for n in ("chrome_0", "chrome_1", "matte_0", "matte_1")
    )
    (folder / "panel.yaml").write_text(
        "lpcal: 1\nname: dome\ncamera: {cameramodel: lens.cameramodel, black_level: 0.8 %, flat_field: flat.png}\n"
        f"lights: {{{', '.join(f'L{k}: {{}}' for k in range(6))}}}\nspheres:\n{spheres}\nobjects: {{bust: objects/bust}}\n"
    )
    return folder


@pytest.mark.slow
def test_a_dome_calibrates_from_spheres_alone(dome: Path, lpcal: Run) -> None:
    code, out, err = lpcal("export", cwd=dome)
    assert code == 0, err
    assert "6 lights" in out
    code, out, err = lpcal("field", "calib/calibration.yaml", RIG / "truth" / "points.csv", "-o", "field.csv", cwd=dome)
    assert code == 0, err
    _, found = read_field(dome / "field.csv")
    _, true = read_field(RIG / "truth" / "field.csv")
    angle = np.concatenate([np.degrees(np.arccos(np.clip(np.sum(found[k][0] * true[k][0], axis=1), -1, 1))) for k in true])
    assert np.sqrt(np.mean(angle**2)) < 1.0


@pytest.mark.slow
def test_spheres_look_the_same_to_any_number_of_cores(dome: Path) -> None:
    workspace = Workspace(read_rig(dome / "panel.yaml"))
    spheres = workspace.rig_file.rig.spheres
    camera = read_camera_file(dome / "lens.cameramodel")
    found = []
    for count in (1, 3):
        with cores(count):
            found.append(_looked(workspace, spheres, camera, Sensor(black_level=0.008), None, silent))
    one, several = found
    assert list(one) == list(several) == list(spheres)
    for name, view in one.items():
        other = several[name]
        assert isinstance(view, SphereView)
        assert isinstance(other, SphereView)
        assert view.outline_px.tobytes() == other.outline_px.tobytes()
        assert all(at.tobytes() == other.highlights_px[light].tobytes() for light, at in view.highlights_px.items())


def test_a_light_without_its_image_is_an_error_of_that_light(dome: Path, lpcal: Run, tmp_path: Path) -> None:
    rig = shutil.copytree(dome, tmp_path / "rig", ignore=shutil.ignore_patterns("calib"))
    (rig / "spheres" / "matte_0" / "L3.png").rename(rig / "spheres" / "matte_0" / "L33.png")
    code, out, err = lpcal("refine", cwd=rig)
    assert code == 6
    assert "no image of L3" in err
    assert "L33" in err
    assert "Traceback" not in err
    assert not (rig / "calib" / "lights.yaml").exists()
    assert out == ""


@pytest.mark.slow
def test_an_all_black_capture_is_refused(dome: Path, lpcal: Run, tmp_path: Path) -> None:
    rig = shutil.copytree(dome, tmp_path / "rig", ignore=shutil.ignore_patterns("calib"))
    for path in (rig / "objects" / "bust").glob("*.png"):
        cv2.imwrite(str(path), np.zeros_like(cv2.imread(str(path), cv2.IMREAD_UNCHANGED)))
    code, _, err = lpcal("reconstruct", cwd=rig)
    assert code in {3, 4}  # 3: no calibration yet, said before any capture is read
    lpcal("export", cwd=rig)
    code, _, err = lpcal("reconstruct", cwd=rig)
    assert code == 4
    assert "dark" in err
    assert not (rig / "surfaces").exists()


@pytest.mark.slow
def test_half_a_calibration_is_refused(dome: Path, lpcal: Run, tmp_path: Path) -> None:
    lpcal("export", cwd=dome)
    whole = (dome / "calib" / "calibration.yaml").read_text()
    (tmp_path / "half.yaml").write_text(whole[: len(whole) // 2])
    code, _, err = lpcal("reconstruct", dome / "objects" / "bust", "-c", tmp_path / "half.yaml", "-o", tmp_path / "out", cwd=tmp_path)
    assert code == 3
    assert "half.yaml" in err
    assert "lpcal export" in err
    assert not (tmp_path / "out").exists()


def test_wings_need_their_sections(lpcal: Run, tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nlights: {L0: {}}\n")
    code, _, err = lpcal("wings", cwd=tmp_path)
    assert code == 3
    assert "panel:" in err
    assert not (tmp_path / "calib").exists()


def test_wings_as_drawn_without_mocap(lpcal: Run, tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text(
        "lpcal: 1\npanel: {disc_radius: 60 mm, joint: 15 mm, blob: 30 mm}\n"
        "lights: {L0: {azimuth: 0 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19},\n"
        "         L1: {azimuth: 90 deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}}\n"
    )
    code, out, err = lpcal("wings", cwd=tmp_path)
    assert code == 0, err
    assert "350.0 mm" in out
    code, out, err = lpcal("export", "panel.yaml", cwd=tmp_path)
    assert code == 0, err
    assert "as designed" in err


def _around(offset: np.ndarray) -> np.ndarray:
    return np.arctan2(offset[:, 1], offset[:, 0])


def _sorted(around: np.ndarray, radius: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    order = np.argsort(around)
    return around[order], radius[order]


def _plain(value: object) -> object:
    from lpcal.formats.documents import plain

    return plain(value)

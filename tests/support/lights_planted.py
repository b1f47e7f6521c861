"""Rigs with a mistake planted in their spheres: the bundled simulated rig's images, altered or drawn again by the simulator."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import yaml

from lpcal.api.simulation import response_of
from lpcal.formats.panel_yaml import read_rig
from lpcal.simulate.built import Built, build
from lpcal.simulate.captures import SphereTruth, Studio
from lpcal.simulate.recipe import Recipe

REPOSITORY = Path(__file__).resolve().parents[2]
RIG = REPOSITORY / "calib_data" / "demo_rig"
LIGHTS = [f"L{k}" for k in range(6)]
WINGS = "panel: {{disc_radius: 60 mm, joint: 15 mm, blob: 30 mm{camera}}}\nlights:\n" + "".join(
    f"  L{k}: {{{{azimuth: {60 * k} deg, joint_angle: 30 deg, disc_spacer: 28.923 mm, blob_spacer: 40 mm, leds: 19}}}}\n" for k in range(6)
)
FREE = f"lights: {{{', '.join(f'{light}: {{}}' for light in LIGHTS)}}}\n"
BLACK = 0.008

type Image = np.ndarray


def truth(name: str) -> dict[str, Any]:
    return yaml.safe_load((RIG / "truth" / f"{name}.yaml").read_text())


def rig(
    folder: Path, spheres: Sequence[str], *, wings: bool = False, lens: bool = True, radius: str = "25 mm", camera: str = "", more: str = ""
) -> Path:
    """A rig folder of the bundled rig's spheres: its camera from a file, the wings' settings or nothing known of the lights."""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(RIG / "flat.png", folder)
    for name in spheres:
        if not (folder / "spheres" / name).exists() and (RIG / "spheres" / name).exists():
            shutil.copytree(RIG / "spheres" / name, folder / "spheres" / name)
    true = truth("camera")
    K, size = true["K"], true["image_size"]
    core = [float(value) for value in (K[0][0], K[1][1], K[0][2], K[1][2], *true["distortion"])]
    (folder / "lens.cameramodel").write_text(
        f"{{ 'lensmodel': 'LENSMODEL_OPENCV5', 'intrinsics': {core}, 'rt_cam_ref': [0,0,0,0,0,0], 'extrinsics': [0,0,0,0,0,0],"
        f" 'imagersize': {list(size)} }}\n"
    )
    named = "cameramodel: lens.cameramodel, " if lens else ""
    sections = "".join(f"  {name}: {{kind: {name.split('_')[0]}, radius: {radius}, images: spheres/{name}}}\n" for name in spheres)
    (folder / "panel.yaml").write_text(
        f"lpcal: 1\ncamera: {{{named}black_level: 0.8 %, flat_field: flat.png}}\n"
        + (WINGS.format(camera=camera) if wings else FREE)
        + f"spheres:\n{sections}{more}"
    )
    return folder


def alter(folder: Path, sphere: str, change: Callable[[Image], Image], names: Callable[[str], bool] = lambda _: True) -> None:
    """Change the stored images of a sphere whose names (without ending) are meant."""
    for path in (folder / "spheres" / sphere).glob("*.png"):
        if names(path.stem):
            cv2.imwrite(str(path), np.clip(np.rint(change(image(folder, sphere, path.stem))), 0, 255).astype(np.uint8))


def image(folder: Path, sphere: str, name: str) -> Image:
    path = folder / "spheres" / sphere / f"{name}.png"
    stored = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    assert stored is not None, path
    return stored.astype(float)


def exchange(folder: Path, sphere: str, order: dict[str, str]) -> None:
    """Give images each other's names: order[new name] is the old one."""
    place = folder / "spheres" / sphere
    for prefix in ("", "short_"):
        if (place / f"{prefix}L0.png").exists():
            held = {new: (place / f"{prefix}{old}.png").read_bytes() for new, old in order.items()}
            for new, data in held.items():
                (place / f"{prefix}{new}.png").write_bytes(data)


def outline(name: str) -> tuple[float, float, float]:
    """About where a sphere of the bundled rig is seen: x, y, radius in pixels."""
    K = np.array(truth("camera")["K"])
    sphere = truth("spheres")[name]
    x = np.array(sphere["centre_m"])
    u = K @ (x / x[2])
    return float(u[0]), float(u[1]), float(K[0, 0] * sphere["radius_m"] / np.sqrt(x[2] ** 2 - sphere["radius_m"] ** 2))


@cache
def built() -> Built:
    return build(read_rig(RIG / "panel.yaml").rig, RECIPE)


RECIPE = Recipe(seed=20260105, image_size=(480, 320))


def draw(folder: Path, spheres: dict[str, SphereTruth], change: Callable[[Built], Built] = lambda b: b, seed: int = 0) -> None:
    """Draw spheres again with the bundled rig's simulator, its lights changed."""
    section = read_rig(RIG / "panel.yaml").rig
    studio = Studio(change(built()), RECIPE, response_of(section, built(), RECIPE), spheres)
    for k, name in enumerate(spheres):
        capture = studio.sphere(name, np.random.default_rng([seed, k]))
        place = folder / "spheres" / name
        place.mkdir(parents=True, exist_ok=True)
        for stem, stored in capture.images.items():
            cv2.imwrite(str(place / f"{stem}.png"), stored)
        lines = [f"exposure: {1e3 * capture.exposure_s:g} ms"]
        if capture.exposures_s:
            lines.append("exposures: {" + ", ".join(f"{stem}: {1e3 * s:g} ms" for stem, s in capture.exposures_s.items()) + "}")
        (place / "capture.yaml").write_text("\n".join(lines) + "\n")


def sphere_at(name: str) -> SphereTruth:
    """A sphere where the bundled rig has it."""
    found = truth("spheres")[name]
    return SphereTruth(found["kind"], np.array(found["centre_m"]), found["radius_m"])


def without_outer_ring(light: str) -> Callable[[Built], Built]:
    def change(rig: Built) -> Built:
        lights = [
            replace(one, power=np.where(np.arange(len(one.power)) < 7, one.power, 0.0)) if one.name == light else one for one in rig.lights
        ]
        return replace(rig, lights=tuple(lights))

    return change


def brighter(light: str, by: float) -> Callable[[Built], Built]:
    def change(rig: Built) -> Built:
        return replace(rig, lights=tuple(replace(one, power=by * one.power) if one.name == light else one for one in rig.lights))

    return change

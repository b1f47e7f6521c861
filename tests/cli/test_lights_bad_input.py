"""What people do wrong with spheres: one message each, the contract's exit code, nothing half-written."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from lights_planted import BLACK, LIGHTS, alter, draw, exchange, image, outline, rig, sphere_at
from lpcal.formats.lights_yaml import read_lights

Run = Callable[..., tuple[int, str, str]]
Plant = Callable[[Path], object]


def blurred(folder: Path) -> None:
    rig(folder, ["chrome_0"])
    alter(folder, "chrome_0", lambda stored: cv2.GaussianBlur(stored, (0, 0), 4.0))


def cut(folder: Path, by_px: int = 20) -> None:
    """The picture moved to the left until its border cuts the sphere."""
    rig(folder, ["matte_0"])
    x, _, r = outline("matte_0")
    left = int(x - r) + by_px
    alter(folder, "matte_0", lambda stored: np.pad(stored[:, left:], ((0, 0), (0, left)), mode="edge"))


def two_spheres(folder: Path) -> None:
    rig(folder, ["matte_0", "matte_1"])
    x, y, r = outline("matte_1")
    rows, columns = np.indices((320, 480))
    disc = np.hypot(columns - x, rows - y) < r + 1.5
    for name in [*LIGHTS, "ambient"]:
        other = image(folder, "matte_1", name)
        alter(folder, "matte_0", lambda stored, other=other: np.where(disc, other, stored), lambda stem, name=name: stem == name)
    rig(folder, ["matte_0"])


def saturated(folder: Path) -> None:
    rig(folder, ["matte_0"])
    alter(folder, "matte_0", lambda stored: 30 * stored)


def without_highlights(folder: Path) -> None:
    """A chrome sphere whose inside is black paint."""
    rig(folder, ["chrome_0"])
    x, y, r = outline("chrome_0")
    rows, columns = np.indices((320, 480))
    inside, dark = np.hypot(columns - x, rows - y) < 0.85 * r, image(folder, "chrome_0", "ambient")
    alter(folder, "chrome_0", lambda stored: np.where(inside, dark, stored), lambda stem: stem in LIGHTS)
    alter(folder, "chrome_0", lambda stored: np.full_like(stored, 255 * BLACK), lambda stem: stem.startswith("short_"))


def auto_exposure(folder: Path) -> None:
    """The camera exposes each image so that its brightest part is the same."""
    rig(folder, ["matte_0"])
    black = 255 * BLACK
    for k, name in enumerate(LIGHTS):
        alter(folder, "matte_0", lambda stored, k=k: black + (0.55 + 0.05 * k) * (stored - black), lambda stem, name=name: stem == name)


REFUSED: dict[str, tuple[Plant, int, str, str]] = {
    "sphere cut by the frame": (cut, 4, "cut by the picture's border", "the whole sphere in the picture"),
    "sphere not in focus": (blurred, 4, "out of focus", "focus on the sphere"),
    "two spheres in a picture": (two_spheres, 4, "two spheres in the picture", "hint: ["),
    "matte saturated everywhere": (saturated, 4, "saturated wherever it is lit under L0, L1, L2, L3, L4, L5", "change the exposure"),
    "highlights outside": (without_highlights, 4, "no highlight of L0, L1, L2, L3, L4, L5 stands out inside", "is it a chrome sphere"),
    "auto-exposure": (auto_exposure, 6, "are darker than in the ambient image", "switch auto-exposure"),
    "radius in mm for m": (lambda f: rig(f, ["chrome_0"], radius="25 m"), 6, "with radius 25 m it would be", "is the unit right?"),
    "radius ten times too large": (
        lambda f: rig(f, ["chrome_0", "matte_0"], wings=True, radius="250 mm"), 6, "it would be 3.6", "a radius of about 2"),
}  # fmt: skip
SOON = {"sphere cut by the frame", "auto-exposure", "radius in mm for m"}
"""Those that take seconds."""


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name not in SOON)) for name in REFUSED])
def test_refused(tmp_path: Path, lpcal: Run, name: str) -> None:
    plant, code, words, todo = REFUSED[name]
    plant(tmp_path)
    found, out, err = lpcal("refine", cwd=tmp_path)
    assert found == code, out + err
    assert words in err
    assert todo in err
    assert any(f"{name}_" in err for name in ("chrome", "matte"))
    assert not (tmp_path / "calib" / "lights.yaml").exists()


def one_bad_of_three(folder: Path) -> None:
    rig(folder, ["chrome_0", "chrome_1", "matte_0"])
    alter(folder, "matte_0", lambda stored: 30 * stored)


def light_off(folder: Path) -> None:
    rig(folder, ["chrome_0", "chrome_1"])
    rng = np.random.default_rng(3)
    dark = image(folder, "chrome_0", "ambient")
    alter(folder, "chrome_0", lambda _: dark + rng.normal(0, 1, dark.shape), lambda stem: stem == "L3")
    alter(folder, "chrome_0", lambda stored: np.full_like(stored, 255 * BLACK), lambda stem: stem == "short_L3")


def split_highlight(folder: Path) -> None:
    rig(folder, ["chrome_0", "chrome_1"])
    alter(folder, "chrome_0", lambda stored: np.maximum(stored, np.roll(stored, (9, 12), (0, 1))), lambda stem: stem == "short_L2")


def bright_room(folder: Path) -> None:
    """The lamps at a sixteenth of what they were, the room as it was."""
    rig(folder, ["chrome_0", "chrome_1", "matte_0"])
    room = image(folder, "matte_0", "ambient")
    alter(folder, "matte_0", lambda stored: room + (stored - room) / 16, lambda stem: stem in LIGHTS)


def changing_room(folder: Path) -> None:
    rig(folder, ["chrome_0", "chrome_1"])
    black = 255 * BLACK
    room = image(folder, "chrome_0", "ambient")
    (folder / "spheres" / "chrome_0" / "ambient.png").rename(folder / "spheres" / "chrome_0" / "ambient_0.png")
    cv2.imwrite(str(folder / "spheres" / "chrome_0" / "ambient_1.png"), np.rint(black + 1.5 * (room - black)).astype(np.uint8))


def darker_in_one_frame(folder: Path) -> None:
    """The room's light went down by a third for one image."""
    rig(folder, ["chrome_0", "chrome_1"])
    black = 255 * BLACK
    room = image(folder, "chrome_0", "ambient")
    alter(folder, "chrome_0", lambda stored: stored - (room - black) / 3, lambda stem: stem == "L4")


TOLD: dict[str, tuple[Plant, int, str, str]] = {
    "one bad sphere of three": (one_bad_of_three, 4, "left out: sphere matte_0", "6 lights from 2 of 3 spheres"),
    "light off in its image": (light_off, 0, "sphere chrome_0: L3 lights nothing: is it off in its image?", "left out"),
    "highlight split": (split_highlight, 0, "sphere chrome_0: it shows 2 bright spots under L2", "is the highlight split"),
    "ambient brighter than the light": (bright_room, 0, "sphere matte_0: more ambient light than lamp light", "shade the scene"),
    "ambient changed between its images": (changing_room, 0, "sphere chrome_0: the ambient light changed by", "between its 2 images"),
    "ambient changed in one frame": (darker_in_one_frame, 0, "sphere chrome_0: under L4", "auto-exposure"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", TOLD)
def test_done_and_said(tmp_path: Path, lpcal: Run, name: str) -> None:
    plant, code, words, more = TOLD[name]
    plant(tmp_path)
    found, out, err = lpcal("refine", cwd=tmp_path)
    assert found == code, out + err
    assert words in err
    assert more in out + err
    lights = read_lights(tmp_path / "calib" / "lights.yaml")
    assert [light.name for light in lights.lights] == LIGHTS
    left_out = {sphere.name: str(sphere.why) for sphere in lights.spheres if not sphere.used}
    assert set(left_out) == ({"matte_0"} if code else set())
    assert all("saturated" in why for why in left_out.values())
    if code == 0:
        assert any(words in warning for warning in lights.warnings)


def test_the_clean_rig_is_told_nothing(tmp_path: Path, lpcal: Run) -> None:
    rig(tmp_path, ["chrome_0", "chrome_1"])
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 0
    assert "warning" not in err


@pytest.mark.parametrize("spheres", [["chrome_0"], pytest.param(["matte_0", "matte_1"], marks=pytest.mark.slow)])
def test_one_place_tells_directions_only(tmp_path: Path, lpcal: Run, spheres: list[str]) -> None:
    rig(tmp_path, spheres)
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 0, err
    assert "their positions cannot be found" in err
    assert "two chrome spheres at different places" in err
    found = read_lights(tmp_path / "calib" / "lights.yaml")
    centre_C = np.mean([sphere_at(name).centre_C for name in spheres], axis=0)
    from lights_planted import built

    for light, true in zip(found.lights, built().lights, strict=True):
        assert light.source_C is None
        toward = true.source_C - centre_C
        angle = np.degrees(np.arccos(light.direction_C @ toward / np.linalg.norm(toward)))
        assert angle < (2.0 if "chrome_0" in spheres else 6.0)


def test_another_order_of_the_images_is_refused(tmp_path: Path, lpcal: Run) -> None:
    rig(tmp_path, ["chrome_0", "chrome_1"])
    exchange(tmp_path, "chrome_0", {"L0": "L1", "L1": "L2", "L2": "L0"})
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 6, err
    assert "in another order" in err
    assert "L0's image shows L1" in err or "L1's image shows L0" in err
    assert not (tmp_path / "calib" / "lights.yaml").exists()


@pytest.mark.slow
def test_far_lights_are_said_to_be_distant(tmp_path: Path, lpcal: Run) -> None:
    from dataclasses import replace

    from lpcal.simulate.built import Built

    def away(rig_: Built) -> Built:
        def moved(one: Any) -> Any:
            shift = 60.0 * (one.source_C - rig_.focus_C)
            return replace(one, position_C=one.position_C + shift, power=one.power * 60**2, exponent=0.0, source_C=one.source_C + shift)

        return replace(rig_, lights=tuple(moved(one) for one in rig_.lights))

    rig(tmp_path, ["chrome_a", "chrome_b"])
    draw(tmp_path, {"chrome_a": sphere_at("chrome_0"), "chrome_b": sphere_at("chrome_1")}, away)
    code, out, err = lpcal("refine", cwd=tmp_path)
    assert code == 0, err
    assert "cannot tell near from far" in err
    assert "from [" in out
    found = read_lights(tmp_path / "calib" / "lights.yaml")
    from lights_planted import built

    for light, true in zip(found.lights, away(built()).lights, strict=True):
        toward = true.source_C / np.linalg.norm(true.source_C)
        assert np.degrees(np.arccos(light.direction_C @ toward)) < 2.5 * np.sqrt(2) * np.degrees(light.direction_std_rad) + 0.2

"""Numbers that are not linear are found, refused or undone; linear ones are not called so for gloss, shadows or the room's light."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lit_scene
from lit_heights import Drawn, Recipe
from lit_heights import draw as draw_large
from lit_scene import Scene
from lpcal.api.curve import curve_of, settle_sensor
from lpcal.detect.radiometry import Sensor
from lpcal.detect.response import ShownResponse, stored_curve
from lpcal.errors import DisagreementError
from lpcal.formats.capture import read_capture
from lpcal.geometry.tone_curve import decode, encode
from lpcal.records.calibration import Calibration, Camera, LedCluster, Light, Lobe
from lpcal.records.sensor import StatedSensor, ToneClaim

SEEDS = [0, pytest.param(1, marks=pytest.mark.slow), pytest.param(2, marks=pytest.mark.slow)]


@functools.cache
def draw(recipe: Recipe, seed: int) -> Drawn:
    return draw_large(replace(recipe, size=56), seed)


TAG = ToneClaim("carry an sRGB chunk", "srgb")


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("gamma", [1.0, 1.6, 2.2])
def test_the_exponent_is_found(gamma: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    S = rng.normal(size=(14, 3)) * 0.4 + [0, 0, -1]
    n = np.array([0, 0, -1.0]) + 0.4 * rng.normal(size=(400, 3))
    linear = np.maximum(S @ n.T, 0) / 4
    stored = encode(linear, gamma) + 0.001 * rng.standard_normal(linear.shape)
    shown = ShownResponse(lambda curve: decode(stored, curve), linear > 0, np.repeat(S[:, None], 400, axis=1))
    found = stored_curve(shown, 1.0, "srgb")
    assert found.gamma == pytest.approx(gamma, rel=0.06)
    assert found.believed == (gamma != 1.0)
    assert found.claim_explains == (gamma == 2.2)
    few = ShownResponse(lambda curve: decode(stored[:5], curve), shown.usable[:5], shown.B[:5])
    assert stored_curve(few, 1.0, "srgb") is None


CURVED = {
    "few lights": Recipe(lights=7, gamma=2.2),
    "photographs": Recipe(gamma="srgb", bumps=8),
    "a soft curve": Recipe(gamma=1.8, gloss=0.1),
    "gloss": Recipe(gamma="srgb", gloss=0.3),
    "unequal lamps": Recipe(gamma=2.2, spread=0.2),
    "unequal lamps, photographs, room": Recipe(gamma="srgb", spread=0.3, room=0.1),
    "many lights": Recipe(lights=40, gamma=2.2, bumps=8),
}


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", CURVED)
def test_a_curve_that_nobody_states_is_refused_with_the_cure(kind: str, seed: int) -> None:
    drawn = draw(CURVED[kind], seed)
    with pytest.raises(DisagreementError, match="not linear") as stop:
        settle_sensor(drawn.raw, drawn.calibration, [])
    assert "--gamma" in str(stop.value)
    assert len(str(stop.value)) <= 600


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("recipe", [Recipe(lights=40, gamma=2.2, bumps=8, gloss=0.1), Recipe(lights=8, gamma="srgb", bumps=8, gloss=0.1)])
def test_a_curve_that_gloss_half_hides_is_said_at_least(recipe: Any, seed: int) -> None:
    drawn = draw(recipe, seed)
    try:
        settled = settle_sensor(drawn.raw, drawn.calibration, [])
    except DisagreementError:
        return
    assert "if they are photographs, state gamma: srgb" in settled.notes[0]
    assert not settled.linear


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", CURVED)
def test_the_same_curve_stated_is_no_matter(kind: str, seed: int) -> None:
    drawn = draw(CURVED[kind], seed)
    settled = settle_sensor(drawn.raw, drawn.calibration, [("told", StatedSensor(CURVED[kind].gamma))])
    assert (settled.notes, settled.linear) == ((), True)


LINEAR = {
    "matte": Recipe(),
    "gloss": Recipe(gloss=0.4),
    "broad gloss": Recipe(gloss=0.4, shine=8, bumps=8),
    "cast shadows": Recipe(bumps=10, most_slant_deg=75),
    "six lights, all of it": Recipe(lights=6, gloss=0.3, bumps=8),
    "unequal lamps": Recipe(spread=0.3),
    "unequal lamps, gloss, shadows": Recipe(spread=0.3, gloss=0.3, bumps=8),
    "room": Recipe(room=0.3, bumps=8),
    "fifty lights": Recipe(lights=50, gloss=0.3, bumps=8),
    "noise": Recipe(noise=0.02),
}


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("kind", LINEAR)
def test_linear_numbers_are_taken_as_they_are(kind: str, seed: int) -> None:
    drawn = draw(LINEAR[kind], seed)
    settled = settle_sensor(drawn.raw, drawn.calibration, [])
    assert (settled.notes, settled.linear, settled.used.sensor) == ((), True, Sensor())


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "scene", [lit_scene.Scene(), lit_scene.Scene(gloss=0.5), lit_scene.Scene(room=0.25), lit_scene.Scene(albedo=(0.8, 0.5, 0.2))]
)
def test_near_lights_a_wall_and_its_shadows_are_no_curve(scene: Scene, seed: int) -> None:
    raw = lit_scene.draw(scene, lit_scene.calibration(8), seed)
    assert settle_sensor(raw, lit_scene.calibration(8), []).notes == ()
    without = settle_sensor(replace(raw, ambient=None, ambient_exposure_s=np.ones(0)), lit_scene.calibration(8), [])
    assert without.notes == ()


@pytest.mark.parametrize("seed", SEEDS)
def test_near_lights_show_a_curve(seed: int) -> None:
    raw = lit_scene.draw(lit_scene.Scene(), lit_scene.calibration(8), seed)
    curved = replace(raw, images=encode(raw.images, 2.2).astype(np.float32), ambient=encode(raw.ambient, 2.2).astype(np.float32))
    with pytest.raises(DisagreementError, match="with gamma 2"):
        settle_sensor(curved, lit_scene.calibration(8), [])


@pytest.mark.parametrize("seed", range(3))
def test_a_tag_that_the_object_bears_out_is_followed_and_said(seed: int) -> None:
    drawn = draw(Recipe(gamma="srgb", bumps=4), seed)
    settled = settle_sensor(replace(drawn.raw, claim=TAG), drawn.calibration, [])
    assert settled.used.sensor == Sensor(gamma="srgb")
    assert settled.used.document()["in_words"] == "gamma srgb (the images' own tag)"
    assert "carry an sRGB chunk; taken as linear they miss" in settled.notes[0]


@pytest.mark.parametrize("seed", range(3))
def test_a_tag_on_linear_numbers_is_not_followed(seed: int) -> None:
    drawn = draw(Recipe(bumps=4, gloss=0.1), seed)
    settled = settle_sensor(replace(drawn.raw, claim=TAG), drawn.calibration, [])
    assert (settled.used.sensor, settled.notes) == (Sensor(), ())


@pytest.mark.parametrize("seed", range(3))
def test_a_tag_of_another_curve_than_the_objects_is_refused(seed: int) -> None:
    drawn = draw(Recipe(gamma=3.0, bumps=4), seed)
    with pytest.raises(DisagreementError, match="not linear"):
        settle_sensor(replace(drawn.raw, claim=ToneClaim("carry a gAMA chunk of gamma 1.8", 1.8)), drawn.calibration, [])


@pytest.mark.parametrize("claim", [TAG, ToneClaim("carry an ICC profile of gamma 1.8", 1.8), ToneClaim("are JPEGs", None)])
def test_a_tag_that_nothing_tells_of_is_said_with_the_cure(claim: ToneClaim) -> None:
    drawn = draw(Recipe(lights=4), 0)
    settled = settle_sensor(replace(drawn.raw, claim=claim), drawn.calibration, [])
    assert claim.said in settled.notes[0]
    assert "--gamma srgb" in settled.notes[0]
    assert settled.used.sensor == Sensor()
    assert not settled.linear
    photographs = ToneClaim("are a camera's JPEGs (Canon)", "srgb", photograph=True)
    undone = settle_sensor(replace(drawn.raw, claim=photographs), drawn.calibration, [])
    assert undone.used.sensor == Sensor(gamma="srgb")
    assert "if they are linear, state gamma: 1" in undone.notes[0]
    linear = ToneClaim("carry a gAMA chunk of gamma 1", 1.0)
    assert settle_sensor(replace(drawn.raw, claim=linear), drawn.calibration, []).notes == ()
    assert settle_sensor(replace(drawn.raw, claim=claim), drawn.calibration, [("told", StatedSensor(1.0))]).notes == ()


@pytest.mark.parametrize(("true", "stated", "better"), [(1.0, 2.2, "1.0"), ("srgb", 1.0, "2.2"), (1.0, "srgb", "1.0"), (2.2, 1.4, "2.2")])
def test_a_gamma_that_is_stated_wrong_is_said_with_both_fits_and_no_powers_take_it_up(
    true: float | str, stated: float | str, better: str
) -> None:
    drawn = draw(Recipe(gamma=true, bumps=4), 1)
    settled = settle_sensor(drawn.raw, drawn.calibration, [("capture.yaml", StatedSensor(stated))])
    assert not settled.linear
    assert "(capture.yaml) does not suit the images" in settled.notes[0]
    assert settled.notes[0].count(" %") == 2


def test_the_largest_number_of_the_images_is_the_white_level_but_for_what_is_stated() -> None:
    drawn = draw(Recipe(), 0)
    raw = replace(drawn.raw, white_level=0.0625, images=drawn.raw.images / 16, ambient=drawn.raw.ambient / 16)
    found = settle_sensor(raw, drawn.calibration, []).used
    assert found.sensor.white_level == 0.0625
    assert found.document()["in_words"] == "white level 6.25 % (the images' largest number)"
    assert settle_sensor(raw, drawn.calibration, [("told", StatedSensor(white_level=0.5))]).used.sensor.white_level == 0.5


def rig_a_lights(folder: Path) -> Calibration:
    """The rig as it truly is."""
    import yaml

    truth = yaml.safe_load((folder / "truth/lights.yaml").read_text())
    camera = yaml.safe_load((folder / "truth/camera.yaml").read_text())
    lights = []
    with np.load(folder / "truth/leds.npz") as leds:
        for entry in truth["lights"]:
            name, H_CL = entry["name"], np.array(entry["H_CL"])
            R = H_CL[:3, :3]
            places, axes = (leds[f"{name}_position"] - H_CL[:3, 3]) @ R, leds[f"{name}_axis"] @ R
            cluster = LedCluster(places, axes, leds[f"{name}_power"] / leds[f"{name}_power"].sum(), float(leds["exponent"]))
            lobe = Lobe("leds", leds=cluster)
            source_C = np.array(entry["source_m"])
            intensity = np.array([entry["intensity"]])
            lights.append(Light(name, source_C / np.linalg.norm(source_C), intensity, H_CL, source_C, R[:, 2], lobe, 1e-4, 1e-4, 1e-3))
    lens = Camera(tuple(camera["image_size"]), camera["model"], np.array(camera["K"]), np.array(camera["distortion"]), black_level=0.008)
    return Calibration("rig_a", tuple(lights), lens, None, 0.35, np.array([0, 0, 0.35]))


CAPTURES = ["objects/bunny", "objects/rocker", "objects/pair", "spheres/matte_0"]
MORE = ["objects/nefertiti", "objects/spot", "objects/teapot", "spheres/matte_1", "spheres/matte_2", "spheres/matte_3"]


@pytest.mark.parametrize("name", [*CAPTURES, *(pytest.param(name, marks=pytest.mark.slow) for name in MORE)])
def test_rendered_objects_with_all_that_light_does_are_no_curve(data: Callable[[str], Path], name: str) -> None:
    folder = data("rig_a")
    calibration = rig_a_lights(folder)
    raw = read_capture(folder / name, [light.name for light in calibration.lights])
    assert settle_sensor(raw, calibration, [("told", StatedSensor(black_level=0.008))]).notes == ()
    assert curve_of(raw, Sensor(0.008), calibration, "srgb") is not None


@pytest.mark.parametrize("name", ["spheres/matte_0", "spheres/matte_1", "objects/bunny", "objects/spot"])
def test_rendered_objects_stored_by_a_curve_are_refused_or_said(data: Callable[[str], Path], name: str) -> None:
    folder = data("rig_a")
    calibration = rig_a_lights(folder)
    raw = read_capture(folder / name, [light.name for light in calibration.lights])
    images, ambient = (encode(np.maximum(each - 0.008, 0), 2.2).astype(np.float32) for each in (raw.images, raw.ambient))
    try:
        settled = settle_sensor(replace(raw, images=images, ambient=ambient), calibration, [])
    except DisagreementError:
        return
    assert name.startswith("objects")
    assert "may not be linear" in settled.notes[0]

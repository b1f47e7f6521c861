"""A sensor that is stated holds for every calibration, whoever states it, and is said."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from lit_heights import Drawn, Recipe, draw
from lpcal.api.sensor import sensor_in_use
from lpcal.detect.radiometry import Sensor
from lpcal.errors import DisagreementError, InputError
from lpcal.formats.calibration_yaml import read_calibration, write_calibration
from lpcal.formats.light_tables import C_FROM_UP
from lpcal.formats.surface_files import read_surface
from lpcal.records.provenance import Provenance
from lpcal.records.sensor import FlatField, StatedSensor

RECIPE = Recipe(lights=5, gamma="srgb", size=40)  # five lights cannot tell a curve: what is stated is all there is


def write(folder: Path, drawn: Drawn, **stated: str) -> Path:
    """The capture as 8 bit PNGs, with what capture.yaml states, and its lights as dome.lp beside it."""
    folder.mkdir(parents=True)
    for name, image in zip(drawn.raw.lights, drawn.raw.images, strict=True):
        cv2.imwrite(str(folder / f"{name}.png"), np.rint(255 * image).astype(np.uint8))
    cv2.imwrite(str(folder / "mask.png"), 255 * drawn.mask.astype(np.uint8))
    cv2.imwrite(str(folder / "ambient.png"), np.rint(255 * drawn.raw.ambient[0]).astype(np.uint8))
    if stated:
        (folder / "capture.yaml").write_text("".join(f"{key}: {value}\n" for key, value in stated.items()))
    lines = [f"{light.name}.png {' '.join(f'{v:.6f}' for v in light.direction_C * C_FROM_UP)}" for light in drawn.calibration.lights]
    (folder.parent / "dome.lp").write_text("\n".join([str(len(lines)), *lines]) + "\n")
    return folder


def error_deg(folder: Path, drawn: Drawn) -> float:
    apart = np.linalg.norm(read_surface(folder).normals - drawn.normals, axis=-1)[drawn.mask]
    return float(np.degrees(np.nanmean(2 * np.arcsin(np.clip(apart / 2, 0, 1)))))


def test_what_is_said_first_counts() -> None:
    first, then = StatedSensor(2.2, None, 0.9), StatedSensor(1.8, 0.01)
    assert first.over(then) == StatedSensor(2.2, 0.01, 0.9)
    assert then.over(first) == StatedSensor(1.8, 0.01, 0.9)
    assert StatedSensor().over(then) == then
    assert StatedSensor(black_level=0.0).said == {"black_level": 0.0}


def test_the_sensor_in_use_and_who_says_it() -> None:
    used = sensor_in_use([("a", StatedSensor("srgb")), ("b", StatedSensor(1.8, 0.008)), ("c", StatedSensor(white_level=0.0625))], "here")
    assert used.sensor == Sensor(0.008, 0.0625, "srgb")
    assert used.said_by == {"gamma": "a", "black_level": "b", "white_level": "c"}
    assert used.document()["in_words"] == "gamma srgb (a), black level 0.8 % (b), white level 6.25 % (c)"
    assert sensor_in_use([("a", StatedSensor(1.0, 0.0))], "here").document()["in_words"] == ""
    with pytest.raises(DisagreementError, match="black below white"):
        sensor_in_use([("a", StatedSensor(black_level=0.5)), ("b", StatedSensor(white_level=0.4))], "here")


@pytest.mark.parametrize(
    "stated", [StatedSensor("srgb"), StatedSensor(2.2, 0.01, 0.9), StatedSensor(flat_field=FlatField(np.eye(3))), StatedSensor()]
)
def test_a_calibration_without_a_camera_keeps_the_sensor(tmp_path: Path, stated: StatedSensor) -> None:
    made = replace(draw(RECIPE, 0).calibration, sensor=stated)
    write_calibration(tmp_path / "c.yaml", made, Provenance())
    found = read_calibration(tmp_path / "c.yaml")
    assert found.camera is None
    assert replace(found.sensor, flat_field=None) == replace(stated, flat_field=None)
    if stated.flat_field is not None:
        assert np.allclose(found.sensor.flat_field.coefficients, stated.flat_field.coefficients)


@pytest.mark.parametrize("wrong", ["gamma: -1", "gamma: adobe", "black_level: 2", "white_level: 0", "gamma: 2.2, model: pinhole"])
def test_a_sensor_that_cannot_be_is_refused(tmp_path: Path, wrong: str) -> None:
    write_calibration(tmp_path / "c.yaml", draw(RECIPE, 0).calibration, Provenance())
    with (tmp_path / "c.yaml").open("a") as file:
        file.write(f"camera: {{{wrong}}}\n")
    with pytest.raises(InputError, match=wrong.rpartition(",")[2].partition(":")[0].strip()):
        read_calibration(tmp_path / "c.yaml")


def by_command(rig: Path) -> tuple[list[str], str]:
    return ["--gamma", "srgb"], "the command"


def by_capture(rig: Path) -> tuple[list[str], str]:
    (rig / "cap/capture.yaml").write_text("gamma: sRGB\n")
    return [], "capture.yaml"


def by_calibration(rig: Path) -> tuple[list[str], str]:
    with (rig / "c.yaml").open("a") as file:
        file.write("camera: {gamma: srgb}\n")
    return [], "c.yaml"


def by_panel(rig: Path) -> tuple[list[str], str]:
    (rig / "panel.yaml").write_text("lpcal: 1\ncamera: {gamma: srgb}\n")
    return [], "panel.yaml"


@pytest.mark.parametrize("state", [by_command, by_capture, by_calibration, by_panel])
def test_imported_lights_heed_a_gamma_wherever_it_is_stated(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, state: Callable[..., Any]
) -> None:
    drawn = draw(RECIPE, 3)
    write(tmp_path / "cap", drawn)
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[0] == 0
    assert lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "untold")[0] == 0
    words, who = state(tmp_path)
    code, told, wrong = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "told", *words)
    assert code == 0, wrong
    assert f"sensor: gamma srgb ({who})" in told
    assert json.loads((tmp_path / "told/summary.json").read_text())["sensor"]["said_by"] == {"gamma": who}
    assert error_deg(tmp_path / "told", drawn) < 1.0
    assert error_deg(tmp_path / "untold", drawn) > 5.0


@pytest.mark.parametrize(
    ("panel", "calibration", "words"),
    [
        ("gamma: 1.8", "gamma: srgb", "panel.yaml says gamma 1.8, c.yaml gamma srgb, which counts"),
        ("gamma: srgb", "gamma: 2.2", "panel.yaml says gamma srgb, c.yaml gamma 2.2, which counts"),
        ("gamma: srgb, white_level: 99 %", "gamma: srgb, white_level: 0.98", "panel.yaml says white level 99 %, c.yaml white level 98 %"),
        ("gamma: srgb", "gamma: srgb", ""),
    ],
)
def test_a_panel_changed_over_its_calibration_is_said(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, panel: str, calibration: str, words: str
) -> None:
    write(tmp_path / "cap", draw(RECIPE, 3))
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[0] == 0
    with (tmp_path / "c.yaml").open("a") as file:
        file.write(f"camera: {{{calibration}}}\n")
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{{panel}}}\n")
    _, _, told = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out")
    assert words in told
    assert words or "which counts" not in told
    stated = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out", "--gamma", "srgb", "--white-level", "99%")[2]
    assert "which counts" not in stated


def test_a_panel_elsewhere_says_nothing_of_this_capture(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    write(tmp_path / "other/cap", draw(RECIPE, 3))
    (tmp_path / "rig").mkdir()
    (tmp_path / "rig/panel.yaml").write_text("lpcal: 1\ncamera: {gamma: srgb}\n")
    assert lpcal("import", "../other/dome.lp", "-o", "../other/c.yaml", cwd=tmp_path / "rig")[0] == 0
    code, told, _ = lpcal("reconstruct", "../other/cap", "-c", "../other/c.yaml", "-o", "../other/out")
    assert code == 0
    assert "sensor:" not in told


def test_a_linear_capture_says_nothing_of_its_sensor(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    write(tmp_path / "cap", draw(replace(RECIPE, gamma=1.0), 3))
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[0] == 0
    code, told, wrong = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out")
    assert code == 0
    assert "sensor" not in told
    assert "gamma" not in wrong


def fall_off(shape: tuple[int, int]) -> np.ndarray:
    row, column = np.indices(shape)
    return (1 - 0.5 * ((row / shape[0] - 0.2) ** 2 + (column / shape[1] - 0.3) ** 2)).astype(np.float32)


@pytest.mark.parametrize("where", ["capture.yaml", "panel.yaml"])
def test_a_flat_field_without_a_lens_divides_out_of_the_albedo(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, where: str
) -> None:
    drawn = draw(replace(RECIPE, gamma=1.0, size=56), 3)
    fall = fall_off(drawn.mask.shape)
    dimmed = replace(drawn, raw=replace(drawn.raw, images=drawn.raw.images * fall))
    write(tmp_path / "cap", dimmed)
    cv2.imwrite(str(tmp_path / "cap/flat.png"), np.rint(160 * fall).astype(np.uint8))
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[0] == 0
    assert lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "untold")[0] == 0
    if where == "capture.yaml":
        (tmp_path / "cap/capture.yaml").write_text("flat_field: flat.png\n")
    else:
        (tmp_path / "panel.yaml").write_text("lpcal: 1\ncamera: {flat_field: cap/flat.png}\n")
    code, told, wrong = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "told")
    assert code == 0, wrong
    assert f"flat field divided out ({where})" in told
    ratio = (read_surface(tmp_path / "untold").albedo / read_surface(tmp_path / "told").albedo / fall)[drawn.mask]
    assert np.nanstd(ratio) / np.nanmean(ratio) < 0.02


def test_a_flat_field_that_is_not_there(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    write(tmp_path / "cap", draw(RECIPE, 3), flat_field="none.png")
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[0] == 0
    code, _, told = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out")
    assert code == 3
    assert "no such file: none.png" in told


def test_export_without_a_lens_keeps_what_panel_yaml_states(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    wings = ", ".join(
        f"L{k}: {{azimuth: {60 * k} deg, joint_angle: 30 deg, disc_spacer: 29 mm, blob_spacer: 40 mm, leds: 19}}" for k in range(6)
    )
    text = (
        f"lpcal: 1\ncamera: {{gamma: srgb, black_level: 0.8 %, white_level: 98 %}}\n"
        f"panel: {{disc_radius: 60 mm, joint: 15 mm, blob: 30 mm}}\nlights: {{{wings}}}\n"
    )
    (tmp_path / "panel.yaml").write_text(text)
    code, _, told = lpcal("export", cwd=tmp_path)
    assert code == 0, told
    found = read_calibration(tmp_path / "calib/calibration.yaml")
    assert found.camera is None
    assert found.sensor == StatedSensor("srgb", 0.008, 0.98)
    (tmp_path / "panel.yaml").write_text(text.replace("srgb", "1.8"))
    assert lpcal("export")[0] == 0
    assert read_calibration(tmp_path / "calib/calibration.yaml").sensor.gamma == 1.8

"""``lpcal import``: other systems' lights, in C, and what is wrong with their files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from scipy.io import savemat

import exchange_readers
from lit_scene import EXPONENT, K, Scene, calibration, draw, truth
from lpcal import write_calibration
from lpcal.errors import DisagreementError, InputError, LpcalError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.import_lights import read_lights
from lpcal.formats.surface_files import read_surface
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.surface import self_calibration
from lpcal.view.pixel_list import PixelList


def test_lp_is_turned_into_the_cameras_axes(tmp_path: Path) -> None:
    path = tmp_path / "dome.lp"
    path.write_text("2\nmy stone 01.jpg 0.6 0.0 0.8\nC:\\photos\\img_2.tif 0 0.6 0.8\n")
    name, found = read_lights(path)
    assert ".lp" in name
    assert [light.name for light in found.lights] == ["my stone 01", "img_2"]
    assert np.allclose(found.lights[0].direction_C, [0.6, 0, -0.8])
    assert np.allclose(found.lights[1].direction_C, [0, -0.6, -0.8])  # above is -y, before the object is -z
    assert found.camera is None
    assert all(light.source_C is None for light in found.lights)


def diligent(folder: Path, count: int = 3) -> Path:
    folder.mkdir()
    (folder / "filenames.txt").write_text("".join(f"{k + 1:03d}.png\n" for k in range(count)))
    (folder / "light_directions.txt").write_text("0 0.6 0.8\n0.6 0 0.8\n-0.6 0 0.8\n")
    (folder / "light_intensities.txt").write_text("1 2 3\n2 3 4\n3 4 5\n")
    return folder


def test_a_diligent_folder(tmp_path: Path) -> None:
    _, found = read_lights(diligent(tmp_path / "ball"))
    assert [light.name for light in found.lights] == ["001", "002", "003"]
    assert np.mean([light.intensity for light in found.lights]) == pytest.approx(1)
    assert found.lights[0].intensity[2] / found.lights[0].intensity[0] == pytest.approx(3)
    with pytest.raises(DisagreementError, match="4 images, 3 directions"):
        read_lights(diligent(tmp_path / "bear", count=4))


@pytest.mark.parametrize("order", ["2048 1536", "1536 2048"])
def test_luces_led_params(tmp_path: Path, order: str) -> None:
    path = tmp_path / "led_params.txt"
    rows = ["N_img nrows ncols f x0 y0 mean_distance sfull:[Lpos Ldir Phi mu 0]", f"3 {order} 2300 1020.5 770.1 300"]
    rows += [f"{x} {y} -20 {-x / 100} {-y / 100} 3 1.0 0.9 0.8 0.6 0" for x, y in ((100, 0), (0, 100), (-100, 0))]
    path.write_text("\n".join(rows) + "\n")
    _, found = read_lights(path)
    assert found.camera.image_size == (2048, 1536)
    assert found.lights[0].source_C == pytest.approx([0.1, 0, -0.02])
    assert found.lights[0].lobe.exponent == pytest.approx(0.6)
    assert found.d_object_m == pytest.approx(0.3)
    d, irradiance = found.lights[0].field(np.array([[0.1, 0, 0.28]]))
    assert d[0] == pytest.approx([0, 0, -1])
    expected = 1 / 0.3**2 * np.cos(np.arctan2(1, 3)) ** 0.6 / 0.9
    assert irradiance[0, 0] == pytest.approx(expected, rel=1e-6)


def test_near_ps_mat_with_a_transposed_camera_and_the_images_size(tmp_path: Path) -> None:
    S = np.array([[100.0, 0, 400], [0, 100, 400], [-100, 0, 400]])
    Dir = np.array([[-0.2, 0, 1.0], [0, -0.2, 1], [0.2, 0, 1]])
    savemat(tmp_path / "light.mat", {"S": S, "Dir": Dir, "Phi": np.full((3, 1), 3e7), "mu": np.ones((3, 1))})
    K = np.array([[3000.0, 0, 800], [0, 3000, 610], [0, 0, 1]])
    savemat(tmp_path / "camera.mat", {"K": K.T})
    cv2.imwrite(str(tmp_path / "photometric_sample_raw_0001.png"), np.zeros((1200, 1620), np.uint8))
    _, found = read_lights(tmp_path)
    assert np.allclose(found.camera.K, K)
    assert found.camera.image_size == (1620, 1200)
    assert found.lights[2].source_C == pytest.approx([-0.1, 0, 0.4])
    assert found.focus_C == pytest.approx([0, 0, 0.9])  # where the axes meet


def write_luces(folder: Path) -> list[str]:
    rows = ["N_img nrows ncols f x0 y0 mean_distance sfull:[Lpos Ldir Phi mu 0]", f"6 112 160 {K[0, 0]} {K[0, 2]} {K[1, 2]} 350"]
    for light in calibration().lights:
        numbers = [*(1e3 * light.source_C), *light.axis_C, *3 * [7.5 * light.intensity[0]], EXPONENT, 0]
        rows.append(" ".join(f"{number:.8g}" for number in numbers))
    (folder / "led_params.txt").write_text("\n".join(rows) + "\n")
    return [f"{k + 1:02d}" for k in range(6)]


def write_near_ps(folder: Path) -> list[str]:
    lights = calibration().lights
    S, Dir = (np.stack([getattr(light, name) for light in lights]) for name in ("source_C", "axis_C"))
    Phi = np.stack([light.intensity for light in lights])
    savemat(folder / "light.mat", {"S": 1e3 * S, "Dir": Dir, "Phi": 3e7 * Phi, "mu": np.full((6, 1), EXPONENT)})
    savemat(folder / "camera.mat", {"K": K})
    return [str(k + 1) for k in range(6)]


@pytest.mark.parametrize("write", [write_luces, write_near_ps])
def test_near_lights_are_read_as_they_are(tmp_path: Path, write: Callable[..., Any]) -> None:
    names = write(tmp_path)
    cv2.imwrite(str(tmp_path / f"{names[0]}.png"), np.zeros((112, 160), np.uint16))
    _, found = read_lights(tmp_path)
    true = calibration()
    assert [light.name for light in found.lights] == names
    assert np.allclose(found.camera.K, true.camera.K, atol=1e-6)
    for one, other in zip(found.lights, true.lights, strict=True):
        assert np.allclose(one.source_C, other.source_C, atol=1e-8)
        assert np.allclose(one.axis_C, other.axis_C, atol=1e-7)
        assert np.allclose(one.intensity, other.intensity, rtol=1e-6)
        assert one.lobe.exponent == pytest.approx(EXPONENT)


def test_images_beside_imported_near_lights_become_a_surface_in_metres(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    names = write_near_ps(tmp_path)
    raw = draw(Scene(), calibration())
    mask, depth, _ = truth(Scene())
    for name, image in zip(names, raw.images, strict=True):
        cv2.imwrite(str(tmp_path / f"{name}.png"), np.rint(65535 * image).astype(np.uint16))
    cv2.imwrite(str(tmp_path / "ambient.png"), np.rint(65535 * raw.ambient[0]).astype(np.uint16))
    cv2.imwrite(str(tmp_path / "mask.png"), 255 * mask.astype(np.uint8))
    code, told, wrong = lpcal("import", tmp_path, "-o", tmp_path / "calibration.yaml")
    assert code == 0, wrong
    assert "6 near lights" in told
    code, _, wrong = lpcal("reconstruct", tmp_path, "-c", tmp_path / "calibration.yaml", "-o", tmp_path / "out", cwd=tmp_path)
    assert code == 0, wrong
    assert abs(np.nanmedian(read_surface(tmp_path / "out").depth - depth)) < 0.004


def test_images_of_a_light_file_become_a_surface_in_pixels(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    """A ball under lights of an .lp, by parallel rays: its normals, and a depth that is a ball's."""
    row, column = np.indices((80, 80))
    x, y = (column - 39.5) / 32, (row - 39.5) / 32
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)
    mask = x**2 + y**2 < 0.92
    turns = np.radians([0, 60, 120, 180, 240, 300])
    directions = np.stack([0.5 * np.cos(turns), 0.5 * np.sin(turns), np.full(6, np.sqrt(0.75))], axis=1)  # x right, y up, z to the viewer
    for k, d in enumerate(directions):
        image = 0.8 * np.maximum(n @ (d * [1, -1, -1]), 0) * mask
        cv2.imwrite(str(tmp_path / f"img{k}.png"), np.rint(65535 * image).astype(np.uint16))
    cv2.imwrite(str(tmp_path / "mask.png"), 255 * mask.astype(np.uint8))
    lines = [f"img{k}.jpg {d[0]:.6f} {d[1]:.6f} {d[2]:.6f}" for k, d in enumerate(directions)]
    (tmp_path / "dome.lp").write_text("\n".join(["6", *lines]) + "\n")
    assert lpcal("import", tmp_path / "dome.lp", "-o", tmp_path / "c.yaml")[0] == 0
    code, _, wrong = lpcal("reconstruct", tmp_path, "-c", tmp_path / "c.yaml", "-o", tmp_path / "out", cwd=tmp_path)
    assert code == 0, wrong
    surface = read_surface(tmp_path / "out")
    assert np.median(np.linalg.norm(surface.normals - n, axis=-1)[mask]) < 0.01
    assert np.std((surface.depth - 32 * n[..., 2])[mask]) < 0.5


def test_intensities_that_nobody_measured_are_found_under_many_lights() -> None:
    """A dome of 24 lights, of which hardly a pixel sees all."""
    rng = np.random.default_rng(0)
    row, column = np.indices((60, 60))
    x, y = (column - 29.5) / 27, (row - 29.5) / 27
    mask = x**2 + y**2 < 0.9
    n = np.stack([x, y, -np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)[mask]
    turn, slant = 2.4 * np.arange(24), np.radians(20 + 45 * np.arange(24) / 24)
    d = np.stack([np.sin(slant) * np.cos(turn), np.sin(slant) * np.sin(turn), -np.cos(slant)], axis=1)
    power = 2 ** rng.uniform(-1, 1, 24)
    signal = 0.5 * power[:, None] * np.maximum(d @ n.T, 0) + 0.003 * rng.standard_normal((24, len(n)))
    seen = PixelList(mask, np.tile([0.0, 0.0, 1.0], (len(n), 1)), signal, np.full(signal.shape, 0.003), np.ones(signal.shape, bool), False)
    found = self_calibration.intensities(seen, [Light(f"L{k}", one, np.ones(1)) for k, one in enumerate(d)])
    assert found / found.mean() == pytest.approx(power / power.mean(), rel=0.03)


def test_a_table_in_columns_named_after_images(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    path = tmp_path / "light_directions.txt"
    path.write_text("0.6 0 -0.6\n0 0.6 0\n0.8 0.8 0.8\n")
    images = tmp_path / "photos"
    images.mkdir()
    for stem in ("img_10", "img_2", "img_1", "mask", "ambient_0"):
        cv2.imwrite(str(images / f"{stem}.png"), np.zeros((4, 4), np.uint8))
    code, told, _ = lpcal("import", path, "--images", images, "-o", tmp_path / "calibration.yaml")
    assert code == 0
    assert "3 distant lights" in told
    found = read_calibration(tmp_path / "calibration.yaml")
    assert [light.name for light in found.lights] == ["img_1", "img_2", "img_10"]


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.lp", "one.jpg 0 0 1\n", "does not begin with the number of lights"),
        ("a.lp", "1\none.jpg 0 x 1\n", "no number"),
        ("a.lp", "1\none.jpg 0 nan 1\n", "not finite"),
        ("a.lp", "1\none.jpg 1e200 0 1\n", "damaged"),
        ("a.lp", "1\none.jpg 0 0 0\n", "no direction"),
        ("a.txt", "1 2\n3 4\n", "no table of directions"),
        ("led_params.txt", "3 2048 1536 2300 1020 770 300\n1 2 3\n", "not the rows of led_params"),
        ("light.mat", "not matlab", "MATLAB"),
        ("a.xyz", "?", "no format that lpcal imports"),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, lpcal: Callable[..., Any], name: str, text: str, words: str) -> None:
    path = tmp_path / name
    path.write_text(text)
    code, _, told = lpcal("import", path, "-o", tmp_path / "out.yaml")
    assert code == 3, told
    assert words in told
    assert not (tmp_path / "out.yaml").exists()


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_lights(tmp_path / "none.lp")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("3\none.jpg 0 0 1\n", "1 lights, but the first line says 3"),
        ("2\na/one.jpg 0 0 1\nb/one.jpg 0 1 1\n", "two lights are called one"),
        ("3\none.jpg 0 0 1\ntwo.jpg 0 0.6 0.8\nthree.jpg 0 0.6 8\n", "though 67 % of them are of length 1"),
        ("2\none.jpg 0 0 -1\ntwo.jpg 0 0.6 -0.8\n", "every light stands behind the object"),
    ],
)
def test_parts_of_an_lp_that_contradict_each_other_are_said(
    tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]], text: str, words: str
) -> None:
    (tmp_path / "a.lp").write_text(text)
    code, _, told = lpcal("import", tmp_path / "a.lp", "-o", tmp_path / "out.yaml")
    assert code == 6, told
    assert words in told
    assert not (tmp_path / "out.yaml").exists()


@pytest.mark.parametrize(
    ("rows", "encoding"),
    [
        (("M\u00fcnze 1.png 0.6 0 0.8", "M\u00fcnze 2.png 0 0.6 0.8"), "cp1252"),
        (("Mu\u0308nze 1.png\t0.6\t0\t0.8", "Mu\u0308nze 2.png\t0\t0.6\t0.8"), "utf-8"),
        (("M\u00fcnze 1.png;0,6;0;0,8", "M\u00fcnze 2.png;0;0,6;0,8"), "utf-16"),
        (('"C:\\x\\M\u00fcnze 1.png", 0.6, 0, 0.8', '"C:\\x\\M\u00fcnze 2.png", 0, 0.6, 0.8'), "utf-8-sig"),
        (("M\u00fcnze 1.png,0.6,0,0.8", "M\u00fcnze 2.png,0,0.6,0.8"), "utf-8"),
    ],
)
def test_an_lp_of_any_encoding_and_delimiter(tmp_path: Path, rows: tuple[str, str], encoding: str) -> None:
    (tmp_path / "dome.lp").write_bytes("\r\n".join(["2", *rows, ""]).encode(encoding))
    _, found = read_lights(tmp_path / "dome.lp")
    assert [light.name for light in found.lights] == ["M\u00fcnze 1", "M\u00fcnze 2"]
    assert np.allclose([light.direction_C for light in found.lights], [[0.6, 0, -0.8], [0, -0.6, -0.8]])


def test_vectors_that_are_positions_are_said(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    path = tmp_path / "dome.lp"
    path.write_text("2\none.jpg 240 0 320\ntwo.jpg 0 240 320\n")
    code, _, told = lpcal("import", path, "-o", tmp_path / "c.yaml")
    assert code == 0
    assert "length 400 are taken as positions" in told
    path.write_text("2\none.jpg 120 0 160\ntwo.jpg 0 240 320\n")
    code, _, told = lpcal("import", path, "-o", tmp_path / "c.yaml")
    assert code == 0
    assert "length 200 to 400 are taken as positions" in told
    for stated in ("positions", "directions"):
        code, _, told = lpcal("import", path, "--vectors", stated, "-o", tmp_path / "c.yaml")
        assert code == 0
        assert f"taken as {stated}" in told
        assert np.allclose(read_calibration(tmp_path / "c.yaml").lights[0].direction_C, [0.6, 0, -0.8])


RING = np.array([[60.0 * np.cos(t), 60.0 * np.sin(t), 0.0] for t in np.linspace(0, 2 * np.pi, 8, endpoint=False)])


@pytest.mark.parametrize(
    "more",
    [
        {"Dir": np.tile([0.0, 0.0, 1.0], (8, 1)), "mu": np.ones((8, 1))},
        {"Dir": RING / 60 + [0, 0, 2.0], "mu": np.ones((8, 1))},
        {"mu": np.zeros((8, 1))},
        {"Dir": np.tile([0.0, 0.0, 1.0], (8, 1)) + 0.01 * np.random.default_rng(0).standard_normal((8, 3)), "mu": np.ones((8, 1))},
    ],
    ids=["parallel", "apart", "no axes", "parallel but for workmanship"],
)
def test_axes_that_do_not_meet_give_no_working_point(tmp_path: Path, more: dict[str, Array]) -> None:
    savemat(tmp_path / "light.mat", {"S": RING, "Phi": np.ones((8, 1)), **more})
    _, found = read_lights(tmp_path / "light.mat")
    assert found.d_object_m is None
    assert found.focus_C is None


def test_aimed_axes_with_some_error_meet(tmp_path: Path) -> None:
    Dir = np.array([0, 0, 200.0]) - RING + np.random.default_rng(0).standard_normal((8, 3)) * 3
    savemat(tmp_path / "light.mat", {"S": RING, "Dir": Dir, "mu": np.ones((8, 1))}, do_compression=True)
    _, found = read_lights(tmp_path / "light.mat")
    assert found.d_object_m == pytest.approx(0.2, rel=0.05)


def test_axes_are_needed_where_a_lobe_has_one(tmp_path: Path) -> None:
    savemat(tmp_path / "light.mat", {"S": RING, "mu": np.ones((8, 1))})
    with pytest.raises(InputError, match="holds no Dir"):
        read_lights(tmp_path / "light.mat")


def test_a_guessed_image_size_gives_way_to_the_captures(tmp_path: Path) -> None:
    savemat(tmp_path / "light.mat", {"S": RING})
    savemat(tmp_path / "camera.mat", {"K": np.array([[300.0, 0, 121.7], [0, 300, 87.2], [0, 0, 1]])})
    _, found = read_lights(tmp_path / "light.mat")
    assert found.camera.size_guessed
    assert found.camera.of_images((240, 180)).image_size == (240, 180)
    assert found.camera.of_images((480, 360)).image_size == found.camera.image_size  # another resolution: K is not its own


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"Phi": -np.ones((8, 1))}, "intensity -1"),
        ({"Phi": np.full((8, 1), np.nan)}, "not finite"),
        ({"S": np.zeros((8, 3))}, "one place"),
        ({"S": RING[:, :2]}, "S is 8x2"),
        ({"Dir": np.zeros((8, 3))}, "no direction"),
        ({"mu": np.ones((5, 1))}, "8, 8, 8 and 5 rows"),
    ],
)
def test_nonsense_in_a_mat_is_refused(tmp_path: Path, change: dict[str, Array], words: str) -> None:
    savemat(tmp_path / "light.mat", {"S": RING, "Dir": np.tile([0.0, 0, 1], (8, 1)), "mu": np.ones((8, 1)), **change})
    with pytest.raises(LpcalError, match=words):
        read_lights(tmp_path / "light.mat")


def test_a_damaged_mat_is_an_error_of_the_contract(tmp_path: Path) -> None:
    """Each byte in turn set to other values: an error of the contract, or lights."""
    savemat(tmp_path / "whole.mat", {"S": RING[:3], "Dir": np.tile([0.0, 0, 1], (3, 1)), "mu": np.ones((3, 1))})
    whole, path = (tmp_path / "whole.mat").read_bytes(), tmp_path / "light.mat"
    refused = 0
    for at in range(124, len(whole)):
        for value in (0x00, 0x7F, 0xFF):
            path.write_bytes(whole[:at] + bytes([value]) + whole[at + 1 :])
            try:
                read_lights(path)
            except LpcalError:
                refused += 1
    assert refused > 100


def test_a_mat_of_version_7_3_is_named(tmp_path: Path) -> None:
    (tmp_path / "light.mat").write_bytes(b"MATLAB 7.3 MAT-file".ljust(512) + b"\x89HDF\r\n\x1a\n")
    with pytest.raises(InputError, match="save it with -v7"):
        read_lights(tmp_path / "light.mat")


def test_positions_whose_point_is_said_are_near_lights_again(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    write_calibration(tmp_path / "calibration.yaml", exchange_readers.calibration())
    assert lpcal("export", "calibration.yaml", "--format", "lp-positions,dome", "-o", "out", cwd=tmp_path)[0] == 0
    places = {light.name: light.source_C for light in exchange_readers.calibration().lights}
    for name in ("lights_positions.lp", "rig.dome"):
        code, said, told = lpcal("import", f"out/{name}", "-o", "back.yaml", cwd=tmp_path)
        assert code == 0, told
        assert "6 near lights" in said, name
        back = read_calibration(tmp_path / "back.yaml")
        assert np.abs(back.focus_C - exchange_readers.FOCUS_C).max() < 1e-9
        for light in back.lights:
            assert np.abs(light.source_C - places[light.name]).max() < 1e-9, name
    path = tmp_path / "out" / "lights_positions.lp"
    assert lpcal("import", path, "--vectors", "directions", "-o", tmp_path / "far.yaml")[0] == 0
    assert read_calibration(tmp_path / "far.yaml").lights[0].source_C is None
    path.write_text(path.read_text().rpartition(" ")[0] + " far\n")
    code, _, told = lpcal("import", path, "-o", tmp_path / "back.yaml")
    assert code == 3, told
    assert "no number" in told

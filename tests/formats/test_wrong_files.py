"""Files handed to a command that reads another kind: what they are taken for is said, and what to do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

import lpcal as library
from lpcal.errors import DisagreementError, InputError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.import_lights import import_lights, read_lights
from lpcal.formats.normal_map import read_normals
from lpcal.records.calibration import Wing

type Run = Callable[..., tuple[int, str, str]]

Y, X = np.mgrid[-20:21, -30:31] / 45.0
NORMALS_UP = np.stack([X, -Y, np.sqrt(1 - X**2 - Y**2)], axis=-1)
"""A sphere's, x right, y up, z to the camera."""


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("dome.lp", "3\na.png 0 0 1\nb.png 0 .6 .8\nc.png .6 0 .8\n"),
        ("panel.yaml", "name: rig\nlights: {L0: {}}\n"),
        ("camera.cameramodel", "# the camera\n{\n 'lensmodel': 'LENSMODEL_OPENCV5',\n}\n"),
        ("page.html", "<html>\n<body>: :</body>\n"),
    ],
)
def test_another_systems_file_in_a_calibrations_place_is_told_to_be_imported(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=f"lpcal import {name} -o calibration.yaml"):
        read_calibration(tmp_path / name)


def test_another_document_of_lpcals_is_no_calibration(tmp_path: Path) -> None:
    (tmp_path / "lights.yaml").write_text("lpcal: 1\nkind: lights\nprovenance: {}\n")
    with pytest.raises(InputError, match=r"of kind 'lights'(?s:.*)give the calibration that lpcal export writes"):
        read_calibration(tmp_path / "lights.yaml")


def test_a_rigs_folder_in_a_calibrations_place_is_told_where_it_is(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"a folder(?s:.*)name the file"):
        read_calibration(tmp_path)
    (tmp_path / "calib").mkdir()
    (tmp_path / "calib" / "calibration.yaml").write_text("lpcal: 1\n")
    with pytest.raises(InputError, match=r"a folder(?s:.*)name .*calib.calibration\.yaml"):
        read_calibration(tmp_path)


@pytest.mark.parametrize("more", ["0.8", "0.8 0.7 0.6", "1 45"])
@pytest.mark.parametrize("name", ["img_01.png", "my stone 1.jpg", "C:\\photos\\img 1.TIF", "raw.CR2"])
def test_numbers_beside_a_direction_are_not_taken_for_it(tmp_path: Path, name: str, more: str) -> None:
    (tmp_path / "dome.lp").write_text(f"2\n{name} 0.6 0 0.8 {more}\nb.png 0 0.6 0.8 {more}\n")
    with pytest.raises(InputError, match=rf"dome\.lp:2: {3 + len(more.split())} numbers after"):
        read_lights(tmp_path / "dome.lp")


def test_names_that_end_in_numbers_are_names(tmp_path: Path) -> None:
    (tmp_path / "dome.lp").write_text("3\nstone 01 0.6 0 0.8\nb.2.png 0 0.6 0.8\nside 3 4 5 0 0 1\n")
    _, found = read_lights(tmp_path / "dome.lp")
    assert len(found.lights) == 3


def test_two_lights_of_one_direction_are_named(tmp_path: Path, lpcal: Run) -> None:
    rows = ["a.png 0 0 1", "b.png 0 .6 .8", "c.png .6 0 .8", "d.png 0 .6 .8"]
    (tmp_path / "dome.lp").write_text("\n".join(["4", *rows]) + "\n")
    code, _, err = lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)
    assert code == 0
    assert "b and d are of one direction" in err
    (tmp_path / "dome.lp").write_text("\n".join(["3", *rows[:3]]) + "\n")
    assert "one direction" not in lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[2]


@pytest.mark.parametrize("compressed", [False, True])
def test_matlabs_normals_are_read(tmp_path: Path, compressed: bool) -> None:
    savemat(tmp_path / "Normal_gt.mat", {"Normal_gt": NORMALS_UP, "note": "ball"}, do_compression=compressed)
    normals_C, good = read_normals(tmp_path / "Normal_gt.mat")
    assert good.all()
    assert np.allclose(normals_C, NORMALS_UP * [1, -1, -1], atol=1e-6)
    savemat(tmp_path / "two.mat", {"one": NORMALS_UP, "other": NORMALS_UP})
    with pytest.raises(InputError, match="2 arrays of height x width x 3"):
        read_normals(tmp_path / "two.mat")


def test_evaluate_takes_a_matlab_truth_and_names_another_convention(tmp_path: Path, lpcal: Run) -> None:
    savemat(tmp_path / "Normal_gt.mat", {"Normal_gt": NORMALS_UP})
    np.save(tmp_path / "own.npy", NORMALS_UP)
    code, out, _ = lpcal("evaluate", "own.npy", "--truth", "Normal_gt.mat", cwd=tmp_path)
    assert code == 0
    assert "0.000 deg mean" in out
    assert "turned over" not in out
    for axis, signs in (("x", (-1, 1, 1)), ("y", (1, -1, 1))):
        np.save(tmp_path / "own.npy", NORMALS_UP * signs)
        _, out, _ = lpcal("evaluate", "own.npy", "--truth", "Normal_gt.mat", cwd=tmp_path)
        assert f"with {axis} of one of them turned over it would be 0.000 deg mean" in out


@pytest.mark.parametrize("ending", [".txt", ".exr"])
def test_a_map_of_a_kind_that_is_not_read_says_what_is(tmp_path: Path, ending: str) -> None:
    (tmp_path / f"n{ending}").write_text("0 0 1\n")
    with pytest.raises(InputError, match=r"(?s)needed: a normal map: \.npz.*numpy\.save"):
        read_normals(tmp_path / f"n{ending}")


def test_points_in_millimetres_are_asked_about() -> None:
    lamp = library.Light("L0", np.array([0, 0, -1.0]), np.ones(1), source_C=np.array([0.2, 0, 0]), axis_C=np.array([0, 0, 1.0]))
    assert library.light_field([lamp], [[0, 0, 0.35], [0.1, 0, 2.0]]).warnings == ()
    assert "are they in millimetres" in library.light_field([lamp], [[0, 0, 350.0], [100, 0, 2000.0]]).warnings[-1]


def wing(d1_m: float = 0.104, joint_deg: float = 30.0) -> Wing:
    return Wing("L0", 0.0, float(np.radians(joint_deg)), d1_m, 0.085)


def test_a_wing_in_metres_for_millimetres_is_refused() -> None:
    assert library.design_lights([wing()]).d_object_m > 0
    with pytest.raises(DisagreementError, match=r"the wing is 60\.09 m long(?s:.*)mm for m"):
        library.design_lights([wing(60.004)])


PANEL = """lpcal: 1
panel: {disc_radius: 60 mm, joint: 15 mm, blob: 30 mm}
lights:
  L0: {azimuth: 0 deg, joint_angle: JOINT, disc_spacer: 29 mm, blob_spacer: 40 mm}
  L1: {azimuth: 180 deg, joint_angle: JOINT, disc_spacer: 29 mm, blob_spacer: 40 mm}
"""


@pytest.mark.parametrize(("joint", "behind"), [("30 deg", False), ("-30 deg", True)])
def test_lights_that_look_away_are_warned_of(tmp_path: Path, lpcal: Run, joint: str, behind: bool) -> None:
    (tmp_path / "panel.yaml").write_text(PANEL.replace("JOINT", joint))
    code, _, err = lpcal("wings", cwd=tmp_path)
    assert code == 0, err
    assert ("mm behind the disc: they look away" in err) == behind


@pytest.mark.parametrize("unit", ["degrees", "radians"])
@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (1, 0, 2)])
def test_angles_in_place_of_vectors(tmp_path: Path, unit: str, order: tuple[int, ...]) -> None:
    """Azimuth, elevation and a constant radius, in any order; the same lights as vectors, or as places in one plane, are taken."""
    azimuth, elevation = np.radians(15.0 * np.arange(24)), np.radians(np.tile([35.0, 60.0], 12))
    u = np.stack([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)], axis=1)
    scale = 1.0 if unit == "radians" else 180 / np.pi
    angles = np.stack([scale * azimuth, scale * elevation, np.ones(24)], axis=1)[:, order]

    def file(vectors: np.ndarray) -> Path:
        path = tmp_path / "dome.lp"
        path.write_text("\n".join(["24", *(f"i{k}.png {x} {y} {z}" for k, (x, y, z) in enumerate(vectors))]))
        return path

    with pytest.raises(DisagreementError, match=f"azimuth and elevation in {unit}"):
        read_lights(file(angles))
    assert import_lights(file(angles), "positions").notes
    for vectors in (u, 150 * u / u[:, 2:]):
        assert len(read_lights(file(vectors))[1].lights) == 24

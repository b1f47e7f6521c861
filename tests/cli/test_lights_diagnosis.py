"""What is wrong with a rig's lights and spheres, planted one at a time: each is named.

``PYTHONPATH=tests/support python tests/cli/test_lights_diagnosis.py`` prints the table: mistake, exit code, first line.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from lights_planted import brighter, draw, exchange, rig, sphere_at, without_outer_ring
from lpcal.chain.refine_lights.diagnosis import GATE_PX
from lpcal.formats.lights_yaml import read_lights

Run = Callable[..., tuple[int, str, str]]
ALL = ["chrome_0", "chrome_1", "matte_0", "matte_1"]


@dataclass(frozen=True)
class Planted:
    """What is planted, the exit code, the words that name it, and whether it takes long."""

    plant: Callable[[Path], object]
    code: int
    words: str
    slow: bool = False


def swapped_cables(folder: Path) -> None:
    rig(folder, ALL, wings=True)
    for sphere in ALL:
        exchange(folder, sphere, {"L1": "L4", "L4": "L1"})


def clicked(folder: Path) -> None:
    """The wing is as the bundled rig has it, 30 deg; the drawing says 40."""
    rig(folder, ["chrome_0", "chrome_1"], wings=True)
    panel = folder / "panel.yaml"
    panel.write_text(panel.read_text().replace("azimuth: 300 deg, joint_angle: 30 deg", "azimuth: 300 deg, joint_angle: 40 deg"))


def ring_off(folder: Path) -> None:
    rig(folder, ["chrome_0", "chrome_1", "matte_0", "matte_1"], wings=True)
    draw(folder, {name: sphere_at(name) for name in ("matte_0", "matte_1")}, without_outer_ring("L5"))


def another_radius(folder: Path, name: str = "chrome_1", stated: str = "30 mm") -> None:
    rig(folder, ALL, wings=True)
    panel = folder / "panel.yaml"
    kind = name.split("_", maxsplit=1)[0]
    panel.write_text(panel.read_text().replace(f"{name}: {{kind: {kind}, radius: 25 mm", f"{name}: {{kind: {kind}, radius: {stated}"))


def moved_camera(folder: Path) -> None:
    """The camera is stated 12 mm from where the bundled rig has it, to half a millimetre and a fifth of a degree."""
    rig(folder, ["chrome_0", "chrome_1"], wings=True, camera=", camera: {position: [12 mm, 0 mm, 0 mm], tolerance: [0.5 mm, 0.2 deg]}")


def drifting(folder: Path) -> None:
    rig(folder, ["chrome_0", "chrome_1", "matte_0", "matte_1", "matte_2", "matte_3"], wings=True)
    early, late = {"matte_0": sphere_at("matte_0"), "matte_2": sphere_at("matte_1")}, {"matte_1": sphere_at("matte_0")}
    late["matte_3"] = sphere_at("matte_1")
    draw(folder, early)
    draw(folder, late, brighter("L2", 1.1))


def reordered_matte(folder: Path) -> None:
    rig(folder, ALL, wings=True)
    exchange(folder, "matte_1", {"L0": "L1", "L1": "L0"})


def curved(folder: Path) -> None:
    """The camera stores with a gamma of 2.2 that nobody states."""
    from lights_planted import BLACK, alter

    rig(folder, ["matte_0"])
    black = 255 * BLACK
    alter(folder, "matte_0", lambda stored: black + (255 - black) * np.clip((stored - black) / (255 - black), 0, 1) ** (1 / 2.2))


PLANTED = {
    "two cables swapped": Planted(swapped_cables, 6, "L1 where L4 should be, L4 where L1 should be"),
    "a wing one click off": Planted(clicked, 0, "L5: joint at 30 deg, not 40", slow=True),
    "a blob with its outer ring off": Planted(ring_off, 0, "L5: falls off as 7 LEDs do, not 19: is its outer ring off", slow=True),
    "a chrome sphere of another radius": Planted(
        another_radius, 6, "sphere chrome_1: its highlights fit as if its radius were 2", slow=True
    ),
    "a matte sphere of another radius": Planted(
        lambda f: another_radius(f, "matte_0"), 6, "sphere matte_0: its shading fits as if its radius were 2", slow=True
    ),
    "a moved camera": Planted(moved_camera, 6, "has it moved since the hand-eye images", slow=True),
    "a light that drifts by 10 %": Planted(drifting, 0, "L2: 1", slow=True),
    "a matte sphere's images in another order": Planted(reordered_matte, 6, "sphere matte_1: its images are in another order", slow=True),
    "a gamma that nobody states": Planted(curved, 6, "gamma", slow=True),
}


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * case.slow) for name, case in PLANTED.items()])
def test_each_mistake_is_named(tmp_path: Path, lpcal: Run, name: str) -> None:
    case = PLANTED[name]
    case.plant(tmp_path)
    code, out, err = lpcal("refine", cwd=tmp_path)
    assert code == case.code, out + err
    assert case.words in err
    assert (tmp_path / "calib" / "lights.yaml").exists() == (code == 0)


@pytest.mark.slow
def test_without_a_mistake_nothing_is_named_and_a_sphere_held_out_is_predicted(tmp_path: Path, lpcal: Run) -> None:
    rig(tmp_path, ALL, wings=True)
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 0
    assert "warning" not in err
    evidence = read_lights(tmp_path / "calib" / "lights.yaml").evidence
    assert 0 < evidence.predicted_highlight_px < 3 * GATE_PX  # an image half as wide as the one that the gate is for
    assert 0 < evidence.predicted_shading_rms < 0.02
    assert 0 < evidence.predicted_shading_rms_albedo_free < 0.005


@pytest.mark.slow
@pytest.mark.parametrize("gamma", ["2.2", "1.6", "srgb"])
def test_a_spheres_own_capture_yaml_is_heeded_and_said(tmp_path: Path, lpcal: Run, gamma: str) -> None:
    from lights_planted import BLACK, alter
    from lpcal.geometry.tone_curve import encode
    from lpcal.records.quantities import parse_gamma

    rig(tmp_path, ["matte_0"])
    black = 255 * BLACK
    alter(tmp_path, "matte_0", lambda stored: 255 * encode((stored - black) / (255 - black), parse_gamma(gamma)))
    (tmp_path / "spheres/matte_0/capture.yaml").write_text(f"gamma: {gamma}\nblack_level: 0 %\n")
    code, out, err = lpcal("refine", cwd=tmp_path)
    assert code == 0, out + err
    assert f"matte_0: sensor: gamma {gamma} (capture.yaml)" in err


@pytest.mark.slow
@pytest.mark.parametrize(("gamma", "spheres", "wings"), [(1.8, ["chrome_0", "chrome_1", "matte_0"], True)])
def test_a_gamma_too_slight_for_one_sphere_is_named_by_the_lights(
    tmp_path: Path, lpcal: Run, gamma: float, spheres: list[str], wings: bool
) -> None:
    """Near lights hide a part of a gamma from a matte sphere alone; those that the chrome spheres place do not."""
    from lights_planted import alter
    from lpcal.geometry.tone_curve import encode

    rig(tmp_path, spheres, wings=wings)
    for name in spheres:
        alter(tmp_path, name, lambda stored: 255 * encode(stored / 255, gamma))
    code, out, err = lpcal("refine", cwd=tmp_path)
    assert code == 6, out + err
    found = re.search(r"sphere matte_.: its shading .* raised to ([\d.]+): they are not linear", err)
    assert found, err
    assert float(found[1]) == pytest.approx(gamma, abs=0.2)


def _table() -> None:
    """The table of the closing note."""
    import contextlib
    import io
    import os
    import sys
    import tempfile

    from lpcal.cli.main import main

    for name, plant in ((name, case.plant) for name, case in PLANTED.items()):
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            plant(Path(folder))
            out, err = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                code = main(["refine"])
            lines = err.getvalue().replace(folder + os.sep, "").splitlines()
            telling = [line for line in lines if line.startswith(("warning", "lpcal"))] or ["-"]
            sys.stdout.write(f"| {name} | {code} | {telling[0]} |\n")
            sys.stdout.flush()


if __name__ == "__main__":
    _table()

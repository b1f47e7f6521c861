"""What a newcomer does wrong, and what lpcal says to it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from lpcal.errors import DisagreementError
from lpcal.formats.bundled import folder as bundled_folder
from lpcal.formats.capture import read_capture

BOARD_ONLY = "lpcal: 1\ncamera: {images: stations/*.png}\nboard: {kind: chessboard, corners: [9, 6], square: 25 mm}\n"


def test_export_of_a_rig_without_lights_lacks_a_section(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text(BOARD_ONLY)
    shutil.copytree(bundled_folder("calib_data") / "demo_rig" / "stations", tmp_path / "stations")
    code, out, err = lpcal("export", cwd=tmp_path)
    assert (code, out) == (3, "")
    assert "panel.yaml: nothing says where the lights are" in err
    assert "needed: lights: with spheres:" in err
    assert "board" not in err, "and no image is looked at before"
    assert not (tmp_path / "calib").exists()


def test_a_rig_that_is_not_bundled_is_named_by_what_was_typed(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    code, _, err = lpcal("new", tmp_path / "mine", "--from", "lightpanel-7")
    assert code == 3
    assert err.startswith("lpcal: lightpanel-7: no bundled rig")
    assert "lightpanel-6" in err
    assert not (tmp_path / "mine").exists()


@pytest.fixture
def capture(tmp_path: Path) -> Path:
    for light in ("L0", "L1", "L2"):
        cv2.imwrite(str(tmp_path / f"{light}.png"), np.full((20, 30), 90, np.uint8))
    return tmp_path


def test_two_images_of_one_light_are_not_chosen_from(capture: Path) -> None:
    cv2.imwrite(str(capture / "L1.tif"), np.full((20, 30), 40, np.uint8))
    with pytest.raises(DisagreementError, match=r"L1\.png and L1\.tif: two images of one name"):
        read_capture(capture, ["L0", "L1", "L2"])


@pytest.mark.parametrize("text", ["", "# exposure: 20 ms\n"])
def test_a_capture_yaml_of_comments_alone_states_nothing(capture: Path, text: str) -> None:
    (capture / "capture.yaml").write_text(text)
    assert read_capture(capture, ["L0", "L1", "L2"]).exposure_s == pytest.approx([1, 1, 1])


def test_refine_names_an_image_that_is_no_lights_and_counts_a_dark_sphere(
    lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    spheres = bundled_folder("calib_data") / "demo_rig" / "spheres"
    for name in ("bright", "dark"):
        shutil.copytree(spheres / "chrome_0", tmp_path / name)
    cv2.imwrite(str(tmp_path / "bright" / "ref.png"), np.zeros((320, 480), np.uint8))
    for image in (tmp_path / "dark").glob("*.png"):
        cv2.imwrite(str(image), np.zeros((320, 480), np.uint8))
    lights = ", ".join(f"L{k}: {{}}" for k in range(6))
    sections = "\n".join(f"  {name}: {{kind: chrome, images: {name}}}" for name in ("bright", "dark"))
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nlights: {{{lights}}}\nspheres:\n{sections}\n")
    code, out, err = lpcal("refine", cwd=tmp_path)
    assert code == 4  # the others are done, and the code is the bad one's
    assert "6 lights from 1 of 2 spheres" in out
    assert "bright: left out: ref.png is no light's" in err
    assert "left out: dark: all dark" in err

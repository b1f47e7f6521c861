"""A light list that is not that of the images: said in words where it leaves the normals hardly known, and never of the right one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from lpcal.simulate.captures import Conditions, capture, ring


def write(folder: Path, order: list[int], signs: tuple[int, int, int] = (1, 1, 1)) -> None:
    """Twelve lights on two rings, and an .lp in which light k has the direction of light order[k], its axes times `signs`."""
    (folder / "cap").mkdir()
    vectors, mask = [], np.zeros(0)
    for number, phase in enumerate((25.0, 45.0)):
        conditions = Conditions(phase_deg=phase, noise=0.004, ambient=0.05, peak=0.75, pixels=44)
        raw, _, mask = capture(conditions, number)
        for k, (image, light) in enumerate(zip(raw.images, ring(conditions), strict=True)):
            cv2.imwrite(str(folder / f"cap/L{6 * number + k}.png"), np.rint(255 * image).astype(np.uint8))
            vectors.append(light.direction_C * [1, -1, -1] * np.array(signs))
        cv2.imwrite(str(folder / "cap/ambient.png"), np.rint(255 * np.asarray(raw.ambient)[0]).astype(np.uint8))
    cv2.imwrite(str(folder / "cap/mask.png"), 255 * mask.astype(np.uint8))
    rows = [f"L{k}.png " + " ".join(f"{v:.6f}" for v in vectors[other]) for k, other in enumerate(order)]
    (folder / "dome.lp").write_text("\n".join([str(len(rows)), *rows]) + "\n")


def said(lpcal: Callable[..., Any], folder: Path) -> str:
    """What `reconstruct` says with the .lp of a folder; it ends with 0."""
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=folder)[0] == 0
    code, _, err = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out", cwd=folder)
    assert code == 0, err
    return str(err)


def test_the_right_list_is_not_doubted(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    write(tmp_path, list(range(12)))
    assert "warning" not in said(lpcal, tmp_path)


def test_lights_in_no_order(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    write(tmp_path, [5, 11, 3, 9, 1, 7, 0, 6, 2, 8, 4, 10])
    assert "do not fit the lights" in said(lpcal, tmp_path)


@pytest.mark.parametrize(
    ("order", "words"),
    [
        ([*range(1, 12), 0], "L1 is of the light L0, L2 is of the light L1"),
        ([11, *range(11)], "L11 is of the light L0, L0 is of the light L1"),
        (list(range(11, -1, -1)), "L11 is of the light L0, L10 is of the light L1"),
        (np.argsort([f"{k}" for k in range(12)]).tolist(), "L10 is of the light L2, L11 is of the light L3, L2 is of the light L4"),
        pytest.param([*range(2, 12), 0, 1], "L2 is of the light L0, L3 is of the light L1", marks=pytest.mark.slow),
    ],
    ids=["a line too early", "a line too late", "backwards", "as text", "shifted by two"],
)
def test_lights_in_another_order(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, order: list[int], words: str) -> None:
    write(tmp_path, order)
    assert lpcal("import", "dome.lp", "-o", "c.yaml", cwd=tmp_path)[0] == 0
    code, _, err = lpcal("reconstruct", "cap", "-c", "c.yaml", "-o", "out", cwd=tmp_path)
    assert code == 6
    assert words in err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("signs", [(-1, -1, 1), (1, 1, 1)])
def test_a_list_half_a_turn_off(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, signs: tuple[int, int, int]) -> None:
    write(tmp_path, list(range(12)), signs)
    assert ("hollow all along its outline" in said(lpcal, tmp_path)) == (signs[0] < 0)


@pytest.mark.parametrize(
    ("order", "signs"),
    [(range(12), (1, -1, 1)), (range(12), (-1, 1, 1)), ([0, 5, 4, 3, 2, 1, 6, 11, 10, 9, 8, 7], (1, 1, 1))],
    ids=["y down", "x left", "rings the other way round"],
)
def test_mirrored_lists(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, order: list[int], signs: tuple[int, int, int]) -> None:
    write(tmp_path, list(order), signs)
    assert "x or y turned over" in said(lpcal, tmp_path)


@pytest.mark.parametrize(("one", "other"), [(0, 1), *(pytest.param(*pair, marks=pytest.mark.slow) for pair in ((2, 9), (7, 10)))])
def test_two_of_a_dozen_exchanged(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, one: int, other: int) -> None:
    order = list(range(12))
    order[one], order[other] = other, one
    write(tmp_path, order)
    words = said(lpcal, tmp_path)
    assert f"L{one} fits the light L{other}" in words
    assert f"L{other} fits the light L{one}" in words

"""Lobes from makers' photometric files, and as the prior of what spheres show."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lpcal.errors import InputError
from lpcal.formats.lobe_files import read_lobe

Run = Callable[..., tuple[int, str, str]]
GAMMA_DEG = np.arange(0, 91, 5)


def lobe(gamma_deg: np.ndarray, plane_deg: np.ndarray) -> np.ndarray:
    """(C, G) cd: a cosine power that is wider in one plane than across it."""
    exponent = 12 + 4 * np.cos(2 * np.radians(plane_deg))
    return 800 * np.cos(np.radians(gamma_deg)) ** exponent[:, None]


def mean_lobe(gamma_deg: np.ndarray) -> np.ndarray:
    turn = np.arange(0, 360, 0.5)
    return lobe(gamma_deg, turn).mean(axis=0) / 800


def ies(plane_deg: np.ndarray, tilt: str = "TILT=NONE") -> str:
    rows = [*lobe(GAMMA_DEG, plane_deg)]
    table = "\n".join(" ".join(f"{value:.4f}" for value in row) for row in [GAMMA_DEG, plane_deg, *rows])
    return f"IESNA:LM-63-2002\n[MANUFAC] Lämpchen\n{tilt}\n1 1000 1 {GAMMA_DEG.size} {plane_deg.size} 1 2 0.05 0.05 0\n1 1 4.2\n{table}\n"


def ldt(symmetry: int, planes: int = 24, sets: int = 1) -> str:
    plane_deg = np.arange(planes) * 360 / planes
    given = {0: plane_deg, 1: plane_deg[:1], 2: plane_deg[: planes // 2 + 1], 4: plane_deg[: planes // 4 + 1]}
    given[3] = np.arange(270, 451, 360 / planes)
    head = ["maker", "3", str(symmetry), str(planes), f"{360 / planes:g}", str(GAMMA_DEG.size), "5", *["x"] * 5, *["50"] * 4, *["0"] * 5]
    head += ["100", "100", "1.0", "0", str(sets), *["1"] * 6 * sets, *["0.5"] * 10]
    rows = [plane_deg, GAMMA_DEG, *lobe(GAMMA_DEG, given[symmetry])]
    return "\r\n".join([*head, *(f"{value:.4f}".replace(".", ",") for row in rows for value in row)])


@pytest.mark.parametrize("last_deg", [360.0, 345.0, 180.0, 90.0])
def test_an_ies_file_gives_the_mean_over_its_planes(tmp_path: Path, last_deg: float) -> None:
    (tmp_path / "blob.IES").write_text(ies(np.arange(0, last_deg + 1, 15)), encoding="latin-1")
    found = read_lobe(tmp_path / "blob.IES")
    np.testing.assert_allclose(found(np.radians(GAMMA_DEG)), mean_lobe(GAMMA_DEG), atol=1e-4)


@pytest.mark.parametrize("symmetry", [0, 2, 3, 4])
def test_an_ldt_file_of_any_symmetry_gives_the_same_mean(tmp_path: Path, symmetry: int) -> None:
    (tmp_path / "blob.ldt").write_text(ldt(symmetry, sets=2))
    np.testing.assert_allclose(read_lobe(tmp_path / "blob.ldt")(np.radians(GAMMA_DEG)), mean_lobe(GAMMA_DEG), atol=1e-4)


def test_a_round_lobe_has_one_plane(tmp_path: Path) -> None:
    (tmp_path / "a.ldt").write_text(ldt(1))
    (tmp_path / "a.ies").write_text(ies(np.zeros(1), "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8"))
    expected = np.cos(np.radians(GAMMA_DEG)) ** 16
    for name in ("a.ldt", "a.ies"):
        np.testing.assert_allclose(read_lobe(tmp_path / name)(np.radians(GAMMA_DEG)), expected, atol=1e-4)


@pytest.mark.parametrize(
    ("name", "text", "found"),
    [
        ("a.ies", ies(np.zeros(1))[:300], "cut off"),
        ("a.ies", ies(np.zeros(1)).replace("TILT", "BENT"), "TILT"),
        ("a.ies", ies(np.zeros(1)).replace(" 1 2 0.05", " 3 2 0.05"), "type 3"),
        ("a.ies", ies(np.zeros(1)).replace("800.0000", "0.0000"), "no lobe"),
        ("a.ldt", ldt(0)[:900], "cut off"),
        ("a.ldt", ldt(0).replace("\r\n3\r\n0\r\n", "\r\n3\r\n7\r\n", 1), "symmetry 7"),
        ("a.txt", "x", ".txt"),
    ],
)
def test_what_is_no_lobe_is_said(tmp_path: Path, name: str, text: str, found: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=found):
        read_lobe(tmp_path / name)
    with pytest.raises(InputError, match="cannot be read"):
        read_lobe(tmp_path / "none.ies")


def test_leds_and_lobe_together_are_refused(lpcal: Run, tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text("lpcal: 1\nlights: {L0: {leds: 19, lobe: blob.ies}}\n")
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 3
    assert "leds and lobe" in err

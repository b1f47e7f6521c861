"""A board of another corner count than stated, on the bundled rig's images."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

STATIONS = Path(__file__).resolve().parents[2] / "calib_data" / "demo_rig" / "stations"


@pytest.mark.slow
@pytest.mark.parametrize("stated", ["[8, 6]", "[9, 7]"])
def test_the_count_on_the_board_is_named(stated: str, tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    (tmp_path / "stations").mkdir()
    for image in sorted(STATIONS.glob("*.png"))[::4]:
        shutil.copy(image, tmp_path / "stations")
    board = f"{{kind: chessboard, corners: {stated}, square: 25 mm}}"
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\ncamera: {{images: stations/*.png}}\nboard: {board}\n")
    code, _, err = lpcal("intrinsics", cwd=tmp_path)
    assert code == 6
    assert "found a board of 9x6 inner corners" in err
    assert not (tmp_path / "calib" / "camera.yaml").exists()

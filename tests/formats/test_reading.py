"""The roof over the readers: libraries that a reader loads are not counted as what its file asks for."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

SCRIPT = """
import sys
from pathlib import Path
import lpcal.formats.reading as reading
reading.SPARE_BYTES = 32 << 20
from {module} import {reader}
{reader}(Path(sys.argv[1]))
"""


@pytest.mark.parametrize("ending", [".png", ".jpg", ".tif"])
def test_the_first_image_of_a_process_is_read_whatever_its_decoder_takes_to_load(tmp_path: Path, ending: str) -> None:
    cv2.imwrite(str(tmp_path / f"a{ending}"), np.full((20, 30), 99, np.uint8))
    script = SCRIPT.format(module="lpcal.formats.images", reader="read_image")
    ended = subprocess.run([sys.executable, "-c", script, tmp_path / f"a{ending}"], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr


def test_the_first_cameras_txt_of_a_process_too(tmp_path: Path) -> None:
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 752 480 712.4 713.1 385.1 230.6\n")
    script = SCRIPT.format(module="lpcal.formats.camera_files", reader="read_camera_file")
    ended = subprocess.run([sys.executable, "-c", script, tmp_path / "cameras.txt"], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr

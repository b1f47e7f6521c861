"""`lpcal frames`: a video's frames, each with its time, whole or not at all."""

from __future__ import annotations

import csv
import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lpcal.cli.main import main

av = pytest.importorskip("av", reason="PyAV is not installed: uv sync --group readers")
COUNT, RATE = 12, 10


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Grey pictures that grow brighter, ten a second, but for a pause of a second after the sixth."""
    path = tmp_path_factory.mktemp("video") / "boards.mp4"
    with av.open(str(path), "w") as container:
        stream = container.add_stream("mpeg4", rate=RATE)
        stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
        stream.codec_context.time_base = Fraction(1, RATE)
        for k in range(COUNT):
            frame = av.VideoFrame.from_ndarray(np.full((48, 64, 3), 20 * k, np.uint8), format="rgb24")
            frame.pts = k + (RATE if k > 5 else 0)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


def rows(folder: Path) -> list[tuple[str, float]]:
    """The table of times."""
    with (folder / "images.csv").open() as table:
        return [(row["file"], float(row["time_s"])) for row in csv.DictReader(table)]


def test_every_frame_has_its_time(video: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "boards"
    assert main(["frames", str(video), "-o", str(folder), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["frames"] == COUNT
    found = rows(folder)
    assert [time_s for _, time_s in found] == pytest.approx([(k + (RATE if k > 5 else 0)) / RATE for k in range(COUNT)], abs=1e-4)
    for k, (name, _) in enumerate(found):
        assert np.asarray(Image.open(folder / name)).mean() == pytest.approx(20 * k, abs=6)


def test_fewer_frames_and_an_older_folder(video: Path, tmp_path: Path) -> None:
    folder = tmp_path / "boards"
    assert main(["frames", str(video), "-o", str(folder)]) == 0
    assert main(["frames", str(video), "-o", str(folder), "--every", "300ms"]) == 0
    assert np.diff([time_s for _, time_s in rows(folder)]).min() >= 0.3 - 1e-6
    assert len(list(folder.iterdir())) == len(rows(folder)) + 1
    (folder / "mine.txt").write_text("mine")
    assert main(["frames", str(video), "-o", str(folder)]) == 3
    assert (folder / "mine.txt").read_text() == "mine"


@pytest.mark.parametrize(("content", "code"), [(None, 3), (b"no video at all", 3), (b"", 3)])
def test_what_is_no_video_is_refused(tmp_path: Path, content: bytes | None, code: int) -> None:
    path = tmp_path / "odd.mp4"
    if content is not None:
        path.write_bytes(content)
    assert main(["frames", str(path), "-o", str(tmp_path / "out")]) == code
    assert not (tmp_path / "out").exists()


def test_an_odd_time_is_a_word_of_the_command(video: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["frames", str(video), "-o", str(tmp_path / "out"), "--every", "3"]) == 2
    assert "--every" in capsys.readouterr().err

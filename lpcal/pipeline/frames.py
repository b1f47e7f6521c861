"""`lpcal frames`: a video becomes a folder of images, and images.csv with their times."""

from __future__ import annotations

from pathlib import Path

from lpcal.formats.outputs import Kind, refuse_place, whole
from lpcal.formats.video import read_frames
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.pictures import png

TABLE = "images.csv"
HEAD = "file,time_s"


def _is_ours(folder: Path) -> bool:
    """Whether a folder holds a video's frames and nothing else."""
    names = {path.name for path in folder.iterdir()}
    table = folder / TABLE
    rows = table.read_text(encoding="utf-8").splitlines() if table.is_file() else []
    return rows[:1] == [HEAD] and names == {TABLE, *(row.split(",")[0] for row in rows[1:])}


FRAMES = Kind("the folder of a video's frames", _is_ours)
"""A folder of frames, as an output: one may replace another."""


def write_frames(video: Path, folder: Path, every_s: float, progress: Progress) -> Outcome:
    """Write the frames of a video as PNG and the table of their times, the folder whole or not at all.

    Raises
    ------
    InputError
        The video cannot be read, or something else stands in the folder.
    DegenerateError
        It holds no frame.
    """
    refuse_place(folder, FRAMES, [video])
    rows: list[str] = []
    with whole(folder, FRAMES, [video]) as draft:
        draft.mkdir()
        for frame in read_frames(video, every_s):
            name = f"frame_{frame.number:06d}.png"
            (draft / name).write_bytes(png(frame.pixels))
            rows.append(f"{name},{frame.time_s:.6f}")
            progress("frames", len(rows), len(rows) + 1)
        (draft / TABLE).write_text("\n".join([HEAD, *rows]) + "\n", encoding="utf-8")
    last_s = float(rows[-1].split(",")[1])
    lines = [f"{len(rows)} frames over {last_s:.2f} s -> {folder}"]
    lines.append(f"in panel.yaml: camera: {{images: {folder.name}/*.png}}, and with a recording mocap: {{images: {folder.name}/{TABLE}}}")
    return Outcome(lines, {"folder": str(folder), "frames": len(rows), "seconds": last_s})

"""Frames of a video as images, each with its time, by PyAV (extra `video`).

A frame's time is its presentation time stamp, in seconds from the first frame: what a camera that films says of its own clock. Frames are
decoded, so what the video's compression lost is lost; board corners bear it, shading does not.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lpcal.errors import DegenerateError, InputError
from lpcal.formats.named_files import did_you_mean

VIDEOS = (".mp4", ".mov", ".avi", ".mkv", ".webm", ".m4v", ".mpg", ".mts")
"""Endings of videos' names."""


@dataclass(frozen=True)
class Frame:
    """A frame: its number, its time in seconds from the first, and its pixels (H, W, 3) RGB."""

    number: int
    time_s: float
    pixels: npt.NDArray[np.uint8]


def read_frames(path: Path, every_s: float = 0.0) -> Iterator[Frame]:
    """The frames of a video in their order, no two nearer than `every_s` seconds.

    Raises
    ------
    InputError
        The extra is not installed, or the file is not there or no video that can be read.
    DegenerateError
        It holds no frame.
    """
    try:
        import av
    except ImportError as error:
        raise InputError("PyAV is not installed, which reads videos", where=str(path), needed="pip install lpcal[video]") from error
    if not path.is_file():
        raise InputError("no such file", where=str(path), needed="a video", todo=did_you_mean(path))
    first, last = None, -np.inf
    with _unreadable(path), av.open(str(path)) as container:
        if not container.streams.video:
            raise InputError("no pictures in it", where=str(path), needed="a video")
        for number, frame in enumerate(container.decode(video=0)):
            stamp = float(frame.time) if frame.time is not None else number / float(container.streams.video[0].average_rate or 1)
            first = stamp if first is None else first
            if stamp - first - last >= every_s - TOLERANCE_S:
                last = stamp - first
                yield Frame(number, last, np.asarray(frame.to_ndarray(format="rgb24")))
    if first is None:
        raise DegenerateError("no frame in it", where=str(path), needed="a video of at least one frame")


TOLERANCE_S = 1e-6
"""Seconds by which a time stamp may be rounded."""


@contextlib.contextmanager
def _unreadable(path: Path) -> Iterator[None]:
    """What the library says of a broken file becomes an error that names it."""
    import av

    try:
        yield
    except (av.error.FFmpegError, EOFError) as error:
        raise InputError(f"cannot be read: {error}", where=str(path), needed="a video") from error

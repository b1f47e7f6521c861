"""Rig folders whose images are marked, and ``lpcal mark`` at work on them."""

from __future__ import annotations

import json
import threading
import urllib.error
import urllib.request
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.mark import mark

PANEL = """# my panel
lpcal: 1
lights: {L0: {}, L1: {}, L2: {}}   # three
spheres:
  ball: {kind: chrome, radius: 25 mm, images: spheres/ball}  # the large one
  grey:
    kind: matte   # painted
    radius: 20 mm
    images: spheres/grey
"""
SIZE = (60, 80)


def capture_folder(root: Path) -> Path:
    """The images of a sphere in a new rig."""
    (root / "panel.yaml").write_text(PANEL)
    (root / "spheres" / "ball").mkdir(parents=True)
    y, x = np.mgrid[: SIZE[0], : SIZE[1]]
    ball = np.where((x - 40) ** 2 + (y - 30) ** 2 < 400, 180, 20).astype(np.uint8)
    for k in range(3):
        Image.fromarray(ball + np.uint8(k)).save(root / "spheres" / "ball" / f"IMG_{k}.png")
    return root / "spheres" / "ball"


class Served:
    """The command at work in a thread."""

    def __init__(self, folder: Path) -> None:
        self.said: list[str] = []
        told = threading.Event()

        def say(line: str) -> None:
            self.said.append(line)
            told.set()

        self.outcome: Any = None
        self.thread = threading.Thread(
            target=lambda: setattr(
                self,
                "outcome",
                mark(folder, read_rig(next(up / "panel.yaml" for up in folder.parents if (up / "panel.yaml").is_file())), say),
            )
        )
        self.thread.start()
        assert told.wait(20)
        self.address = self.said[0].split()[-1]

    def ask(self, path: str, message: Any = None, *, token: bool = True, host: str | None = None) -> tuple[int, bytes]:
        base, _, query = self.address.partition("/?")
        request = urllib.request.Request(
            base + path + (f"?{query}" if token else ""), None if message is None else json.dumps(message).encode()
        )
        if host:
            request.add_header("Host", host)
        try:
            with urllib.request.urlopen(request, timeout=20) as answer:
                return answer.status, answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.read()

    def end(self) -> None:
        """End the command where it is not over yet; its thread must be."""
        if self.thread.is_alive():
            with suppress(OSError):
                self.ask("/done", {})
        self.thread.join(10)
        assert not self.thread.is_alive()


def boards(folder: Path) -> Path:
    """A rig with a chessboard and images of it."""
    (folder / "panel.yaml").write_text("lpcal: 1\ncamera: {images: stations/*.png}\nboard: {corners: [9, 6], square: 25 mm}  # printed\n")
    (folder / "stations" / "a").mkdir(parents=True)
    for k in range(2):
        Image.fromarray(np.full((60, 80), 100 + k, np.uint8)).save(folder / "stations" / "a" / f"{k}.png")
    return folder / "stations" / "a"

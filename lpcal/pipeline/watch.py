"""``lpcal watch``: the folder is looked at five times a second, and each new image is judged as soon as it is whole.

Where more come than can be searched for the board, the newest is searched first and the others are only measured: what is said is never
far behind. A sphere is looked for once all its lights have come, by a process of its own. A capture's reading of the distance sensor is
compared with the working distance, and what the newest model still lacks is said. The page is served to this machine alone.
"""

from __future__ import annotations

import contextlib
import json
import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.boards import board_of
from lpcal.api.engines import processes
from lpcal.api.spheres import find_sphere
from lpcal.api.watching import Seen, Watched, lacking
from lpcal.detect.board import find_board
from lpcal.errors import InputError, LpcalError, UsageError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.capture import read_capture
from lpcal.formats.images import read_image
from lpcal.formats.model_files import SUMMARY
from lpcal.formats.named_files import hidden, image_endings
from lpcal.formats.panel_yaml import read_capture_section
from lpcal.formats.record_documents import known_record_of
from lpcal.pipeline.workspace import natural
from lpcal.records.calibration import Calibration
from lpcal.records.model import Missing
from lpcal.records.observations import SphereView
from lpcal.records.outcome import Outcome
from lpcal.records.rig import Rig, SphereSection
from lpcal.report.model_page import missing_words
from lpcal.report.page_data import WatchData
from lpcal.report.side_pages import watch_html

BESIDE = 0.1
"""Share of the working distance beyond which a reading is said to be off it: the lights' axes have parted by a tenth of it there."""


@dataclass
class WatchedRoom:
    """The rig's calibration, where there is one, and the newest model of its folder."""

    folder: Path | None
    calibration: Calibration | None = None
    model: list[str] = field(default_factory=list)
    """What it lacks, in lines."""
    seen: tuple[Path, int] | None = None
    """The summary that these lines are of, and its time."""

    @classmethod
    def of(cls, folder: Path | None) -> WatchedRoom:
        """The room of a rig's folder; without a calibration that can be read there is none."""
        path = None if folder is None else folder / "calib" / "calibration.yaml"
        try:
            return cls(folder, read_calibration(path) if path is not None and path.is_file() else None)
        except LpcalError:
            return cls(folder)

    def reading(self, capture: Path) -> tuple[str, bool] | None:
        """What the distance sensor read at a capture, in words, and whether it is well; None where capture.yaml states no distance."""
        try:
            distance_m = read_capture_section(capture / "capture.yaml").distance
        except LpcalError as error:
            return error.found, False
        if distance_m is None:
            return None
        said = f"the distance sensor reads {1e3 * distance_m:.0f} mm"
        known = self.calibration
        if known is None or known.focus_C is None:
            return said, True
        wanted_m = float(known.focus_C[2])
        expected_m = wanted_m if known.distance_sensor is None else known.distance_sensor.reads_m(wanted_m)
        off_m = distance_m - expected_m
        if abs(off_m) <= BESIDE * wanted_m:
            return said, True
        way = "farther" if off_m > 0 else "nearer"
        return f"{said}, {1e3 * abs(off_m):.0f} mm {way} than where the lights meet: move the panel, or it has hit something else", False

    def look_at_models(self) -> bool:
        """Whether the newest model of the folder is another than at the last look; its lines are read then."""
        found = sorted(self.folder.glob(f"*/{SUMMARY}"), key=lambda path: path.stat().st_mtime_ns) if self.folder is not None else []
        for path in reversed(found):
            state = path, path.stat().st_mtime_ns
            if state == self.seen:
                return False
            lines = _lines(path)
            if lines:
                self.seen, self.model = state, lines
                return True
        return False


def _lines(path: Path) -> list[str]:
    """What the model of a summary.json lacks; nothing where it is none of a model."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        missing = known_record_of(Missing, document.get("missing")) if document.get("kind") == "model" else None
        return [] if missing is None else [f"{path.parent.name}: {line}" for line in missing_words(missing, document["frame"])]
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return []


LOOK_S = 0.2
"""Seconds between two looks at the folder: ten in the two seconds that are allowed."""
BUDGET_S = 0.4
"""Seconds after which the images that still wait are no longer searched for the board: with a look and what comes meanwhile, under two."""
STANDS_BACK = 19
"""The niceness of a process that looks for a sphere: the least urgent."""
SHOWN = 60
"""Images that the page lists."""
LOOPBACK = "127.0.0.1"


@dataclass
class Watch:
    """A folder that is watched."""

    folder: Path
    rig: Rig | None
    session: Watched
    known: dict[Path, tuple[int, int]] = field(default_factory=dict)
    """Size and time of each image when it was last looked at."""
    done: set[tuple[Path, int, int]] = field(default_factory=set)
    pending: dict[str, Future[SphereView | LpcalError]] = field(default_factory=dict)
    """Spheres that are looked for, by their folders."""
    room: WatchedRoom = field(default_factory=lambda: WatchedRoom(None))
    read: set[str] = field(default_factory=set)
    """Captures whose reading of the distance sensor was looked at."""
    behind_s: float = 0.0
    """The longest that an image has waited from its last change to its verdict."""

    def new(self) -> list[Path]:
        """Images that have come or changed, and did not change since the last look."""
        found = []
        for path in sorted(self.folder.rglob("*"), key=natural):
            if path.suffix.lower() not in image_endings() or hidden(path) or path.stem == "mask":
                continue
            try:
                state = path.stat()
            except OSError:
                continue
            now = (state.st_size, state.st_mtime_ns)
            if self.known.get(path) == now and (path, *now) not in self.done and state.st_size:
                found.append(path)
            self.known[path] = now
        return found

    def judge(self, path: Path, *, look: bool) -> Seen:
        """Judge one image; one that cannot be read says why."""
        self.done.add((path, *self.known[path]))
        name = path.relative_to(self.folder).as_posix()
        try:
            pixels = read_image(path).pixels
        except LpcalError as error:
            seen = Seen(name, "board", "poor", (error.found,))
            self.session.seen.append(seen)
            return seen
        stem = path.stem
        if stem.removeprefix("short_") != stem or stem == "ambient" or stem.startswith("ambient_"):
            seen = self.session.judge_beside(name, pixels)
        elif stem in self.session.lights:
            sphere = self._sphere(path.parent)
            chrome = sphere is not None and sphere.kind == "chrome"
            seen = self.session.judge_light(path.parent.relative_to(self.folder).as_posix(), stem, pixels, chrome=chrome)
        else:
            seen = self.session.judge_board(name, pixels, look=look)
        self.behind_s = max(self.behind_s, time.time() - self.known[path][1] / 1e9)
        return seen

    def _sphere(self, folder: Path) -> SphereSection | None:
        spheres = self.rig.spheres if self.rig else {}
        return next((sphere for sphere in spheres.values() if Path(sphere.images).name == folder.name), None)

    def look_for_spheres(self, executor: Executor, touched: Iterable[Path]) -> None:
        """Have a sphere looked for in each of these folders that is a sphere's and has all its lights."""
        for folder in sorted(set(touched)):
            name, sphere = folder.relative_to(self.folder).as_posix(), self._sphere(folder)
            if sphere is not None and self.session.folders.get(name, set()) >= set(self.session.lights):
                self.pending[name] = executor.submit(sphere_in, folder, self.session.lights, sphere)

    def readings(self, touched: Iterable[Path]) -> list[Seen]:
        """What the distance sensor read at each of these captures, once all its lights have come."""
        found = []
        for folder in sorted(set(touched)):
            name = folder.relative_to(self.folder).as_posix()
            if name in self.read or not self.session.lights or not self.session.folders.get(name, set()) >= set(self.session.lights):
                continue
            said = self.room.reading(folder)
            if said is not None:
                self.read.add(name)
                found.append(self.session.judge_reading(name, said[0], well=said[1]))
        return found

    def found_spheres(self) -> list[Seen]:
        """The spheres that were looked for and are done."""
        done = [name for name, future in self.pending.items() if future.done()]
        found = []
        for name in done:
            future = self.pending.pop(name)
            lost = future.exception()
            found.append(
                self.session.judge_sphere(name, future.result() if lost is None else InputError(str(lost) or "it was not looked for"))
            )
        return found

    def state(self) -> WatchData:
        """What the page shows."""
        session = self.session
        return {
            "folder": str(self.folder),
            "next": session.following(),
            "images": len(session.seen),
            "boards": len(session.boards),
            "covered": session.covered,
            "cells": session.counted.astype(int).tolist(),
            "spheres": {folder: {"tone": one.tone, "words": "; ".join(one.words)} for folder, one in session.spheres.items()},
            "lacking": {folder or ".": list(names) for folder, names in lacking(session).items()},
            "seen": [{"name": one.name, "tone": one.tone, "words": "; ".join(one.words)} for one in session.seen[-SHOWN:][::-1]],
            "model": self.room.model,
            "behind_s": round(self.behind_s, 2),
        }


def sphere_in(folder: Path, lights: Sequence[str], sphere: SphereSection) -> SphereView | LpcalError:
    """The sphere of a capture, without a camera; or why it was not found. Its process stands back behind the one that judges images."""
    with contextlib.suppress(AttributeError, OSError):  # not on Windows
        os.setpriority(os.PRIO_PROCESS, 0, STANDS_BACK)
    try:
        found = find_sphere(read_capture(folder, lights), sphere.kind, sphere.radius, hint_px=sphere.hint)
    except LpcalError as error:
        return error
    return replace(found, shading=None)  # what is sent back is small


def watch(
    folder: Path,
    rig: Rig | None,
    say: Callable[[str], None],
    *,
    home: Path | None = None,
    port: int | None = 0,
    idle_s: float | None = None,
    sleep: Any = time.sleep,
) -> Outcome:
    """Watch a folder until nothing has come for `idle_s` seconds (None: until it is interrupted).

    `home` is the rig's folder: its calibration gives how far away a capture should stand, its newest model what it still lacks.

    Raises
    ------
    InputError
        There is no such folder.
    UsageError
        The port is taken.
    """
    if not folder.is_dir():
        raise InputError("no such folder", where=str(folder), needed="a folder that images come into")
    board = None if rig is None or rig.board is None else board_of(rig.board)
    awaited = tuple(str(sphere.images) for sphere in rig.spheres.values()) if rig else ()
    at = Watch(folder, rig, Watched(board, tuple(rig.lights) if rig else (), awaited=awaited), room=WatchedRoom.of(home))
    if board is not None:
        find_board(np.random.default_rng(0).random((120, 160)).astype(np.float32), board)  # imports and warms what the first would wait for
    with _served(at, port) as address, processes(1) as executor:
        if awaited:
            executor.submit(os.getpid).result()  # a process that is there before the first image is
        if address:
            say(f"watching {folder}; the page: {address}")
        last, announced = time.monotonic(), ""
        while idle_s is None or at.pending or time.monotonic() - last < idle_s:
            waiting = at.new()
            begun = time.monotonic()
            for path in reversed(waiting):
                say(line_of(at.judge(path, look=time.monotonic() - begun < BUDGET_S)))
            at.look_for_spheres(executor, [path.parent for path in waiting])
            spheres = at.found_spheres()
            for seen in [*at.readings([path.parent for path in waiting]), *spheres]:
                say(line_of(seen))
            if at.room.look_at_models():
                for line in at.room.model:
                    say(f"    {line}")
            last = time.monotonic() if waiting or spheres else last
            if (waiting or spheres) and at.session.following() != announced:
                announced = at.session.following()
                say(f"    next: {announced}")
            sleep(LOOK_S)
    found = at.state()
    lines = [f"{found['images']} images, {found['boards']} with the board, {100 * found['covered']:.0f} % of the image covered"]
    lines += [f"{where} lacks {', '.join(names)}" for where, names in found["lacking"].items() if names]
    return Outcome([*lines, f"next: {found['next']}"], {**found})


def line_of(seen: Seen) -> str:
    """A verdict for the terminal."""
    return f"{'ok  ' if seen.tone == 'good' else '!   ' if seen.tone == 'fair' else '!!  '}{seen.name}: {'; '.join(seen.words)}"


@contextmanager
def _served(at: Watch, port: int | None) -> Iterator[str | None]:
    """The page, served to this machine alone; its address."""
    if port is None:
        yield None
        return

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            host = (self.headers.get("Host") or "").rpartition(":")[0]
            if host not in {LOOPBACK, "localhost"}:  # a page of elsewhere that calls itself by another name
                self.send_error(403)
            elif self.path == "/state.json":
                self._send("application/json", json.dumps(at.state(), allow_nan=False))
            elif self.path == "/":
                self._send("text/html; charset=utf-8", watch_html(at.state()))
            else:
                self.send_error(404)

        def _send(self, media: str, text: str) -> None:
            content = text.encode("utf-8")
            self.send_response(200)
            self.send_header("Content-Type", media)
            self.send_header("Content-Length", str(len(content)))
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    try:
        server = ThreadingHTTPServer((LOOPBACK, port), Handler)
    except (OSError, OverflowError) as error:
        raise UsageError(f"port {port} cannot be used: {error}", where="--port", needed="a free port, or 0 for any") from error
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://{LOOPBACK}:{server.server_address[1]}/"
    finally:
        server.shutdown()
        server.server_close()

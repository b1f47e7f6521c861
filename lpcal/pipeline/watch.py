"""``lpcal watch``: the folder is looked at five times a second, and each new image is judged as soon as it is whole.

Images are read and measured by threads, the newest first. Those that would be judged too late wait until nothing newer does, so that
what is shown is never far behind what the camera does, however many images come. A sphere is looked for once all its lights have come,
by a process of its own. A capture's reading of the distance sensor is compared with the working distance, and what the newest model still
lacks is said. The page is served to this machine alone.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np

from lpcal.api.boards import board_of
from lpcal.api.engines import processes
from lpcal.api.spheres import find_sphere
from lpcal.api.watching import Measured, Seen, Watched, lacking, measure_board
from lpcal.errors import InputError, LpcalError
from lpcal.formats.capture import read_capture
from lpcal.formats.images import read_numbers
from lpcal.formats.named_files import did_you_mean, hidden, image_endings
from lpcal.pipeline.watch_page import served
from lpcal.pipeline.watch_room import WatchedRoom
from lpcal.pipeline.workspace import natural
from lpcal.records.observations import Board, SphereView
from lpcal.records.outcome import Outcome
from lpcal.records.rig import Rig, SphereSection
from lpcal.report.page_data import WatchData

LOOK_S = 0.2
"""Seconds between two looks at the folder: ten in the two seconds that are allowed."""
LATE_S = 1.0
"""Seconds after which an image that was not begun waits until nothing newer does: half of what is allowed, the rest is for the judging."""
AT_WORK = min(4, os.cpu_count() or 1)
"""Images that are judged at a time: decoding and searching use a core each, and four keep up with any camera that writes files."""
STANDS_BACK = 10
"""The niceness of a process that looks for a sphere: a tenth of the share of one that judges images. (19, the least urgent, gets a
seventieth: on a busy machine its imports alone take minutes.)"""
SHOWN = 60
"""Images that the page lists."""
type Sphere = SphereView | LpcalError
type Judged = Measured | LpcalError
"""An image as it was measured, or why it cannot be read."""


@dataclass(frozen=True)
class Arrived:
    """An image that is whole and waits to be judged."""

    path: Path
    state: tuple[int, int]
    """Its size and time."""
    came_s: float
    """When it was there, as `time.time` has it: its last change, or the first look where it is older."""


@dataclass
class Watch:
    """A folder that is watched."""

    folder: Path
    rig: Rig | None
    session: Watched
    begun_s: float = field(default_factory=time.time)
    known: dict[Path, tuple[int, int]] = field(default_factory=dict)
    """Size and time of each image when it was last looked at."""
    taken: dict[Path, tuple[int, int]] = field(default_factory=dict)
    """The same of each image that waits, is judged or was."""
    fresh: dict[Path, Arrived] = field(default_factory=dict)
    """Images that wait, the newest last."""
    late: dict[Path, Arrived] = field(default_factory=dict)
    """Those that wait until no fresh one does."""
    at_work: dict[Future[Judged], Arrived] = field(default_factory=dict)
    pending: dict[str, Future[Sphere]] = field(default_factory=dict)
    """Spheres that are looked for, by their folders."""
    room: WatchedRoom = field(default_factory=lambda: WatchedRoom(None))
    read: set[str] = field(default_factory=set)
    """Captures whose reading of the distance sensor was looked at."""
    unshown: deque[float] = field(default_factory=deque)
    """When the images came that are newer than every one that was judged."""
    behind_s: float = 0.0
    """The longest that images had been there of which neither they nor a newer one was judged."""
    longest_wait_s: float = 0.0
    """The longest that one image waited for its own verdict."""
    put_off: int = 0
    """Images that had to wait until no newer one did."""
    shown: WatchData = field(init=False)
    """What the page shows: `state` as it was when something was last seen."""

    def __post_init__(self) -> None:
        self.shown = self.state()

    def look(self) -> None:
        """Take in the images that have come or changed, and did not change since the last look."""
        found = []
        for path in images_under(self.folder):
            try:
                state = path.stat()
            except OSError:
                continue
            now = (state.st_size, state.st_mtime_ns)
            if self.known.get(path) == now and self.taken.get(path) != now and state.st_size:
                found.append(Arrived(path, now, max(state.st_mtime_ns / 1e9, self.begun_s)))
            self.known[path] = now
        for one in sorted(found, key=lambda one: (one.state[1], natural(one.path))):
            self.taken[one.path] = one.state
            self.late.pop(one.path, None)
            self.fresh.pop(one.path, None)
            self.fresh[one.path] = one
            self.unshown.append(one.came_s)

    @property
    def waiting(self) -> int:
        """Images that are not judged yet."""
        return len(self.fresh) + len(self.late) + len(self.at_work)

    def hand_over(self, pool: Executor) -> None:
        """Have the newest images judged, as many as are judged at a time."""
        now = time.time()
        for one in [one for one in self.fresh.values() if now - one.came_s > LATE_S][: max(len(self.fresh) - AT_WORK, 0)]:
            self.late[one.path] = self.fresh.pop(one.path)
            self.put_off += 1
        while len(self.at_work) < AT_WORK and (self.fresh or self.late):
            row = self.fresh or self.late
            _, one = row.popitem()
            board = self.session.board if self._kind(one.path) == "board" else None
            self.at_work[pool.submit(judged, one.path, board, look=not self.fresh)] = one

    def judged_within(self, pause_s: float, touched: set[Path]) -> list[Seen]:
        """Wait so long for an image that is at work; what was judged, and into `touched` the folders of these images."""
        if not self.at_work:
            time.sleep(pause_s)
            return []
        done = wait(self.at_work, timeout=pause_s, return_when=FIRST_COMPLETED).done
        touched |= {self.at_work[future].path.parent for future in done}
        return [seen for future in done if (seen := self.judge(future)) is not None]

    def waits_in(self, folder: Path) -> bool:
        """Whether an image of this folder is not judged yet."""
        return any(one.path.parent == folder for one in (*self.fresh.values(), *self.late.values(), *self.at_work.values()))

    def judge(self, future: Future[Judged]) -> Seen | None:
        """What came of an image; None where it has changed meanwhile, or is looked at again when there is time."""
        one, found = self.at_work.pop(future), future.result()
        if self.taken.get(one.path) != one.state:
            return None
        if isinstance(found, Measured) and not found.searched and found.corners_share is None:
            self.late[one.path] = one
            return None
        now = time.time()
        while self.unshown and self.unshown[0] <= one.came_s:
            self.behind_s = max(self.behind_s, now - self.unshown.popleft())
        self.longest_wait_s = max(self.longest_wait_s, now - one.came_s)
        return self._note(one.path, found)

    def _note(self, path: Path, found: Judged) -> Seen:
        name, kind = path.relative_to(self.folder).as_posix(), self._kind(path)
        if isinstance(found, LpcalError):
            seen = Seen(name, "board", "poor", (found.found,))
            self.session.seen.append(seen)
            return seen
        if kind == "beside":
            return self.session.note_beside(name, (found.words, found.tone))
        if kind == "light":
            sphere, folder = self.sphere_of(path.parent), path.parent.relative_to(self.folder).as_posix()
            chrome = sphere is not None and sphere.kind == "chrome"
            return self.session.note_light(folder, path.stem, (found.words, found.tone), chrome=chrome)
        return self.session.note_board(name, found)

    def _kind(self, path: Path) -> Literal["beside", "light", "board"]:
        stem = path.stem
        if stem.startswith(("short_", "ambient_")) or stem == "ambient":
            return "beside"
        return "light" if stem in self.session.lights else "board"

    def sphere_of(self, folder: Path) -> SphereSection | None:
        """The sphere of the rig whose images this folder holds."""
        spheres = self.rig.spheres if self.rig else {}
        return next((sphere for sphere in spheres.values() if Path(sphere.images).name == folder.name), None)

    def look_for_spheres(self, find: Callable[[Path, Sequence[str], SphereSection], Future[Sphere]], touched: Iterable[Path]) -> None:
        """Have a sphere looked for in each of these folders that is a sphere's and has all its lights."""
        for folder in sorted(set(touched)):
            name, sphere = folder.relative_to(self.folder).as_posix(), self.sphere_of(folder)
            if sphere is not None and self.session.folders.get(name, set()) >= set(self.session.lights):
                self.pending[name] = find(folder, self.session.lights, sphere)

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
            "waiting": self.waiting,
            "put_off": self.put_off,
            "behind_s": round(self.behind_s, 2),
            "longest_wait_s": round(self.longest_wait_s, 2),
        }


def images_under(folder: Path) -> Iterator[Path]:
    """Images of a folder and of those in it."""
    endings = image_endings()
    for where, _, names in os.walk(folder):
        for name in names:
            path = Path(where, name)
            if path.suffix.lower() in endings and path.stem != "mask" and not hidden(path):
                yield path


def judged(path: Path, board: Board | None, *, look: bool) -> Judged:
    """An image as it was measured, or why it cannot be read; `look`: whether there is time to search for the board beyond a glance."""
    try:
        return measure_board(read_numbers(path).stored, board, look=look)
    except LpcalError as error:
        return error


def _warm(board: Board | None) -> None:
    """Import what the first image would wait for, and search once."""
    measure_board(np.random.default_rng(0).random((120, 160)).astype(np.float32), board)


def _begin_process(other: Executor) -> None:
    """Start the process that looks for spheres, by a thread that is niced as it shall be (Linux, where a thread has a niceness)."""
    if sys.platform == "linux":
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), STANDS_BACK)
    other.submit(os.getpid).result()


def _in_process(other: Executor, folder: Path, lights: Sequence[str], sphere: SphereSection) -> Sphere:
    return other.submit(sphere_in, folder, lights, sphere).result()


def sphere_in(folder: Path, lights: Sequence[str], sphere: SphereSection) -> Sphere:
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
        raise InputError("no such folder", where=str(folder), needed="a folder that images come into", todo=did_you_mean(folder))
    board = None if rig is None or rig.board is None else board_of(rig.board)
    awaited = tuple(str(sphere.images) for sphere in rig.spheres.values()) if rig else ()
    at = Watch(folder, rig, Watched(board, tuple(rig.lights) if rig else (), awaited=awaited), room=WatchedRoom.of(home))
    with (
        served(lambda: at.shown, port) as address,
        ThreadPoolExecutor(AT_WORK) as pool,
        ThreadPoolExecutor(1) as aside,
        processes(1) as other,
    ):
        pool.submit(_warm, board)
        if address:
            say(f"watching {folder}; the page: {address}")
        last, looked, announced = time.monotonic(), -LOOK_S, ""
        begun: Future[None] | None = None
        touched: set[Path] = set()
        while idle_s is None or at.pending or at.waiting or time.monotonic() - last < idle_s:
            if time.monotonic() - looked >= LOOK_S:
                looked = time.monotonic()
                at.look()
                if at.room.look_at_models():
                    for line in at.room.model:
                        say(f"    {line}")
            at.hand_over(pool)
            seen = at.judged_within(max(looked + LOOK_S - time.monotonic(), 0.0), touched)
            if begun is None and any(at.sphere_of(folder) for folder in touched):
                begun = aside.submit(_begin_process, other)  # one that is there before the sphere's last image is
            whole = {folder for folder in touched if not at.waits_in(folder)}
            touched -= whole
            at.look_for_spheres(lambda *asked: aside.submit(_in_process, other, *asked), whole)
            spheres = at.found_spheres()
            for one in [*seen, *at.readings(whole), *spheres]:
                say(line_of(one))
            last = time.monotonic() if seen or spheres or at.waiting else last
            if (seen or spheres) and not at.fresh and at.session.following() != announced:
                announced = at.session.following()
                say(f"    next: {announced}")
            if seen or spheres or whole:
                at.shown = at.state()
    found = at.state()
    lines = [f"{found['images']} images, {found['boards']} with the board, {100 * found['covered']:.0f} % of the image covered"]
    lines += [f"{where} lacks {', '.join(names)}" for where, names in found["lacking"].items() if names]
    return Outcome([*lines, f"next: {found['next']}"], {**found})


def line_of(seen: Seen) -> str:
    """A verdict for the terminal."""
    return f"{'ok  ' if seen.tone == 'good' else '!   ' if seen.tone == 'fair' else '!!  '}{seen.name}: {'; '.join(seen.words)}"

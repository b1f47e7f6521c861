"""How lpcal writes: whole or not at all, and never over anything that it did not write itself.

Three laws, for every file and folder that any command makes:

1. What is there already is replaced only where it is empty or known by its own content as an earlier output of the same kind (`Kind`),
   and never where it is one of the command's inputs, a device, a link into nowhere, or a folder that one stands in (`refuse_place`).
2. A draft is written beside the place it is for, flushed to the disk, and then takes its name in one step: a file by rename(2), a folder by
   an exchange of the two names (Linux ``renameat2(RENAME_EXCHANGE)``, macOS ``renameatx_np(RENAME_SWAP)``). Where a system has no exchange
   the old folder steps aside first, signals are held back between the two renames, and the next writer puts it back if a kill came between.
3. A draft's folder is locked while its process lives (flock(2), which the system releases however a process ends), so one whose lock can
   be had is what a killed process left: what it had set aside is put back, the rest is cleared away (`recover`).
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import shutil
import signal
import stat
import sys
import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from lpcal.errors import InputError, UsageError

SCRATCH = ".lpcal-draft-"
"""What the name of a draft's folder begins with."""
ASIDE = "aside"
"""The folder in a draft's folder that holds what is replaced, until the new one stands."""
END_BYTES = 4096
"""How many bytes at either end of a file are read to find what wrote it: every mark stands in its first or last lines."""
AT_CWD = -100 if sys.platform == "linux" else -2
"""The value of AT_FDCWD, which makes renameat take a path as rename does."""
EXCHANGE = 2
"""The flag of Linux's renameat2 and of macOS's renameatx_np that exchanges two names; it is 2 on both."""
HELD_BACK = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))


@dataclass(frozen=True)
class Kind:
    """A kind of output: what people call it, and how one that lpcal wrote is known."""

    name: str
    """With its article, for messages."""
    is_ours: Callable[[Path], bool] = lambda _: False
    """Whether the file or folder that stands there is one that lpcal wrote; it is neither empty nor absent."""


NEW = Kind("a new file")
"""An output that never replaces anything."""


def summarised(name: str, kind: str, summary: str, files: Collection[str]) -> Kind:
    """A kind of folder whose summary (JSON) says `kind`, with no file in it but those that lpcal writes there."""

    def is_ours(folder: Path) -> bool:
        try:
            said = json.loads((folder / summary).read_text(encoding="utf-8"))
        except (FileNotFoundError, ValueError):
            return False
        strangers = {path.name for path in folder.iterdir()} - set(files)
        return isinstance(said, dict) and said.get("kind") == kind and not strangers

    return Kind(name, is_ours)


def marked(name: str, *marks: str) -> Kind:
    """A kind of file that holds one of the marks among its first or last `END_BYTES` bytes."""

    def is_ours(path: Path) -> bool:
        with path.open("rb") as stream:
            head = stream.read(END_BYTES)
            stream.seek(max(path.stat().st_size - END_BYTES, 0))
            tail = stream.read(END_BYTES)
        return any(mark.encode() in end for mark in marks for end in (head, tail))

    return Kind(name, is_ours)


def refuse_place(path: Path, kind: Kind, inputs: Iterable[Path] = ()) -> None:
    """Refuse an output that would destroy something; called before any work is done, and again before the output takes its name.

    Raises
    ------
    UsageError
        The place is one of `inputs`, or a folder that the command was started in or below.
    InputError
        Something stands there that lpcal did not write, or that is no file or folder, or it cannot be looked at.
    """
    elsewhere = "name another place" + " with -o" * (kind is not NEW)
    try:
        for given in inputs:
            if path.exists() and given.exists() and path.samefile(given):
                raise UsageError("the output is one of the inputs", where=str(path), needed="a place of its own", todo=elsewhere)
        if path.is_symlink() and not path.exists():
            raise InputError("a link that leads nowhere", where=str(path), needed=f"a place for {kind.name}", todo=elsewhere)
        if not path.exists():
            return
        if path.is_dir():
            if Path.cwd().is_relative_to(path.resolve()):
                raise UsageError("the current folder or one above it", where=str(path), needed="a folder of its own", todo=elsewhere)
            ours = not any(path.iterdir()) or _is(kind, path)
        elif not stat.S_ISREG(path.stat().st_mode):
            raise InputError("a device, not a file", where=str(path), needed=f"a place for {kind.name}", todo=elsewhere)
        else:
            ours = path.stat().st_size == 0 or _is(kind, path)
    except OSError as error:
        raise InputError(f"cannot be looked at: {error.strerror}", where=str(path), needed=f"a place for {kind.name}") from error
    if not ours:
        what = "a folder with other things in it" if path.is_dir() else "another file"
        needed = f"a new or empty place, or {kind.name} that lpcal wrote" if kind is not NEW else "a new or empty place"
        raise InputError(f"{what} is there already", where=str(path), needed=needed, todo=f"{elsewhere}, or move it away")


def _is(kind: Kind, path: Path) -> bool:
    try:
        return kind.is_ours(path)
    except (NotADirectoryError, IsADirectoryError):
        return False


@contextmanager
def whole(path: Path, kind: Kind = NEW, inputs: Iterable[Path] = ()) -> Iterator[Path]:
    """A path to write to in place of `path`: it takes the final name once the block has ended without an error.

    Works for a file and for a folder; a folder of that name is replaced, never mixed. A link to a file or folder stays a link.

    Raises
    ------
    InputError
        Nothing can be written there, the disk is full, or a folder stands where a file should, or a file where a folder should.
    UsageError, InputError
        As `refuse_place`.
    """
    refuse_place(path, kind, inputs)
    path = path.resolve()
    with _system_errors_named(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        recover(path.parent)
        with _scratch_in(path.parent) as scratch:
            draft = scratch / path.name
            yield draft
            if path.exists() and path.is_dir() != draft.is_dir():
                found, needed = ("a folder", "a file") if path.is_dir() else ("a file", "a folder")
                raise InputError(
                    f"{found} is in the way", where=str(path), needed=f"a place for {needed}", todo="move it or write elsewhere"
                )
            refuse_place(path, kind, inputs)
            _flush(draft)
            if path.is_dir():
                _replace_folder(draft, path)
            else:
                draft.replace(path)
            _flush_one(path.parent)


def write_text(path: Path, text: str, kind: Kind = NEW) -> None:
    """Write a text file in UTF-8, whole or not at all."""
    with whole(path, kind) as draft:
        draft.write_text(text, encoding="utf-8", newline="")


@contextmanager
def alone_in(folder: Path, waiting: Callable[[], None]) -> Iterator[None]:
    """Hold the lock of a folder; `waiting` is called once where another process holds it, then the lock is waited for.

    Where the system or the disk has no such lock, nothing is held.
    """
    with _locked(folder, waiting):
        yield


@contextmanager
def _scratch_in(folder: Path) -> Iterator[Path]:
    """A locked folder in a folder, gone afterwards."""
    while True:
        scratch = Path(tempfile.mkdtemp(prefix=SCRATCH, dir=folder))
        with _locked(scratch) as held:
            if held is False or not scratch.is_dir():  # another process took it for a killed one's before it was locked
                continue
            try:
                yield scratch
            finally:
                shutil.rmtree(scratch, ignore_errors=True)
            return


@contextmanager
def _locked(folder: Path, waiting: Callable[[], None] | None = None) -> Iterator[bool | None]:
    """Hold flock(2) on a folder, waiting for it where `waiting` is given; whether it is held, None where there are no such locks."""
    try:
        import fcntl
    except ImportError:  # Windows
        yield None
        return
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:  # gone, or not to be read
        yield False
        return
    try:
        held: bool | None = True
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            held = waiting is not None
            if waiting is not None:
                waiting()
                fcntl.flock(descriptor, fcntl.LOCK_EX)
        except OSError:  # a disk without locks
            held = None
        yield held
    finally:
        os.close(descriptor)


def recover(folder: Path) -> None:
    """Put back what a killed process had set aside in a folder, and clear its drafts away. Those of living processes are locked."""
    with contextlib.suppress(OSError):
        for scratch in folder.glob(f"{SCRATCH}*"):
            with _locked(scratch) as ours:
                if not ours:
                    continue
                for aside in (scratch / ASIDE).glob("*"):
                    if not (folder / aside.name).exists():
                        aside.rename(folder / aside.name)
                shutil.rmtree(scratch, ignore_errors=True)


def _replace_folder(draft: Path, path: Path) -> None:
    """Put a folder in the place of another, at once where the system can, else so that a kill between can be undone."""
    if _exchange(draft, path):
        return
    aside = draft.parent / ASIDE / path.name
    aside.parent.mkdir()
    with _signals_held_back():
        path.rename(aside)
        try:
            draft.rename(path)
        except OSError:
            aside.rename(path)
            raise


def _exchange(one: Path, other: Path) -> bool:
    """Exchange two names in one step; whether the system could."""
    name = {"linux": "renameat2", "darwin": "renameatx_np"}.get(sys.platform)
    function = getattr(ctypes.CDLL(None), name, None) if name else None
    if function is None:
        return False
    return bool(function(AT_CWD, os.fsencode(one), AT_CWD, os.fsencode(other), ctypes.c_uint(EXCHANGE)) == 0)


@contextmanager
def _signals_held_back() -> Iterator[None]:
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, HELD_BACK)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _flush(draft: Path) -> None:
    """Have the system write a file, or a folder and all in it, to the disk."""
    if draft.is_dir():
        for folder, _, files in os.walk(draft):
            for name in files:
                _flush_one(Path(folder) / name)
            _flush_one(Path(folder))
    else:
        _flush_one(draft)


def _flush_one(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError:
        if not path.is_dir():  # some systems cannot flush a folder
            raise
    finally:
        os.close(descriptor)


@contextmanager
def _system_errors_named(path: Path) -> Iterator[None]:
    """An error of the system while writing, as one that names the output."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        needed, todo = "a folder with room to write to", "make room, or name another place"
        raise InputError(f"cannot write here: {reason}", where=str(path), needed=needed, todo=todo) from error

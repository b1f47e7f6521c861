"""`lpcal mark`: a page on this machine in which a sphere, a mask, a board's corners or the lights of a capture's images are set by mouse.

The page is served to the loopback address alone and only to who knows the token in its address; a page of elsewhere that a browser is
looking at cannot ask for it. What it sends is written at once, whole or not at all; it ends when the page says so.
"""

from __future__ import annotations

import base64
import binascii
import io
import json
import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, unquote, urlsplit

import numpy as np

from lpcal.errors import InputError, LpcalError, UsageError
from lpcal.formats.images import read_image
from lpcal.formats.marks import CAPTURE_FILE, MASK_FILE, write_board_marks, write_hint, write_light_images, write_mask
from lpcal.formats.named_files import PICTURES, did_you_mean
from lpcal.formats.panel_yaml import read_capture_section
from lpcal.geometry.arrays import Image, Mask
from lpcal.pipeline.watch_page import LOOPBACK
from lpcal.records.outcome import Outcome
from lpcal.records.pictures import png
from lpcal.records.rig import BoardSection, RigFile
from lpcal.report.page_data import MarkData
from lpcal.report.pictures import block_sum
from lpcal.report.side_pages import mark_html

LARGEST_PX = 2400
"""Pixels along the longer side that the page is shown: a screen's, and quick to send; a larger image is averaged over blocks."""
BRIGHTEST = 99.5
"""Percentile that is shown white: highlights may saturate."""
MOST_BYTES = 64_000_000
"""Bytes of a message from the page: a mask of any size that is shown is less."""


@dataclass
class Marking:
    """A capture that is marked: its folder, its rig, and what has been written."""

    folder: Path
    rig: RigFile | None
    images: tuple[str, ...]
    written: list[str] = field(default_factory=list)
    done: threading.Event = field(default_factory=threading.Event)

    @property
    def sphere(self) -> str | None:
        """The sphere of the rig whose images these are."""
        spheres = {} if self.rig is None else self.rig.rig.spheres
        base = Path() if self.rig is None else self.rig.folder
        return next((name for name, one in spheres.items() if (base / one.images).resolve() == self.folder.resolve()), None)

    @property
    def board(self) -> bool:
        """Whether these are images of the rig's chessboard: of none of its spheres and objects."""
        if self.rig is None or self.rig.rig.board is None or self.rig.rig.board.kind != "chessboard":
            return False
        others = [*(one.images for one in self.rig.rig.spheres.values()), *self.rig.rig.objects.values()]
        return all((self.rig.folder / one).resolve() != self.folder.resolve() for one in others)

    def named(self, image: str) -> str:
        """An image as the rig's stages name it: relative to the rig's folder where it lies in it."""
        path, home = (self.folder / image).resolve(), Path() if self.rig is None else self.rig.folder.resolve()
        return path.relative_to(home).as_posix() if path.is_relative_to(home) else path.as_posix()

    @property
    def lights(self) -> tuple[str, ...]:
        """The rig's lights."""
        return () if self.rig is None else tuple(self.rig.rig.lights)

    def document(self) -> MarkData:
        """What the page is given."""
        section = self.rig.rig.spheres[self.sphere] if self.rig is not None and self.sphere else None
        return {
            "folder": str(self.folder),
            "images": list(self.images),
            "sphere": self.sphere,
            "hint": None if section is None or section.hint is None else list(section.hint),
            "board": self.board,
            "marks": {} if not self.board or self.rig is None or self.rig.rig.board is None else self._marked(self.rig.rig.board),
            "lights": [] if self.board else list(self.lights),
            "named": read_capture_section(self.folder / CAPTURE_FILE).images,
            "mask": (self.folder / MASK_FILE).is_file(),
        }

    def shown(self, name: str) -> tuple[bytes, int]:
        """An image of the capture as a PNG that a person can look at, and by how much it is smaller."""
        pixels = read_image(self.folder / name).pixels
        step = max(1, -(-max(pixels.shape[:2]) // LARGEST_PX))
        small = _averaged(pixels, step)
        small = small / max(float(np.percentile(small, BRIGHTEST)), 1e-6)
        return png(np.asarray(np.round(255 * np.clip(small, 0, 1) ** (1 / 2.2)), dtype=np.uint8)), step

    def save(self, asked: dict[str, Any]) -> list[str]:
        """Write what the page has set; what was written, in words.

        Raises
        ------
        UsageError
            The message is not one of the page's.
        InputError
            It cannot be written, or another mask is there.
        """
        said: list[str] = []
        if asked.get("circle") is not None:
            said.append(self._hint(asked["circle"]))
        if asked.get("marks"):
            said += self._board(asked["marks"])
        if asked.get("mask") is not None:
            mask = self._mask(asked["mask"])
            write_mask(self.folder, mask)
            said.append(f"{self.folder / MASK_FILE}: {int(mask.sum())} pixels")
        if asked.get("named"):
            said.append(self._names(asked["named"]))
        self.written += said
        return said

    def _hint(self, circle: Any) -> str:
        if self.rig is None or self.sphere is None:
            raise UsageError("a sphere is marked", where=str(self.folder), needed="the images of one of the rig's spheres")
        numbers = [float(x) for x in circle]
        if len(numbers) != 3 or not np.isfinite(numbers).all() or numbers[2] <= 0:
            raise UsageError(f"a circle of {circle}", needed="x, y and a radius over zero, pixels")
        write_hint(self.rig.file, self.sphere, numbers)
        return f"{self.rig.file}: spheres.{self.sphere}.hint: [{', '.join(f'{x:.1f} px' for x in numbers)}]"

    def _marked(self, section: BoardSection) -> dict[str, list[float]]:
        return {image: list(section.marks[name]) for image in self.images if (name := self.named(image)) in section.marks}

    def _board(self, marks: Any) -> list[str]:
        """Write the corners that were marked, by image."""
        if self.rig is None or not self.board:
            raise UsageError("a board is marked", where=str(self.folder), needed="a rig with a chessboard, and a folder of its images")
        found = {str(image): [float(x) for x in np.ravel(at)] for image, at in dict(marks).items()}
        wrong = [image for image, at in found.items() if image not in self.images or len(at) != 8 or not np.isfinite(at).all()]
        if wrong:
            raise UsageError(f"corners of {', '.join(wrong)}", needed="four corners of a board, in an image of this folder")
        said = []
        for image, at in found.items():
            write_board_marks(self.rig.file, self.named(image), at)
            said.append(f"{self.rig.file}: board.marks of {self.named(image)}")
        return said

    def _mask(self, text: Any) -> Mask:
        """The mask (H, W) in the images' own size."""
        from PIL import Image as Pictures

        try:
            content = base64.b64decode(str(text).partition(",")[2], validate=True)
            with Pictures.open(io.BytesIO(content)) as picture:
                small = np.asarray(picture.convert("RGBA"))[..., 3] > 127
        except (binascii.Error, OSError) as error:
            raise UsageError("a mask that is no picture", needed="the page's own message") from error
        width, height = read_image(self.folder / self.images[0]).size
        step = max(1, -(-max(width, height) // LARGEST_PX))
        if small.shape != (-(-height // step), -(-width // step)):
            raise UsageError(f"a mask of {small.shape[1]}x{small.shape[0]}", needed="one of the picture's size")
        if not small.any():
            raise UsageError("an empty mask", needed="at least a pixel of the object", todo="paint it, or leave the mask out")
        return np.asarray(np.repeat(np.repeat(small, step, axis=0), step, axis=1)[:height, :width])

    def _names(self, named: Any) -> str:
        pairs = {str(light): str(image) for light, image in dict(named).items()}
        strangers = [light for light in pairs if light not in self.lights] + [image for image in pairs.values() if image not in self.images]
        if strangers or len(set(pairs.values())) < len(pairs):
            raise UsageError(f"lights named {pairs}", needed="a light of the rig for an image of the capture, each once")
        write_light_images(self.folder, pairs)
        return f"{self.folder / CAPTURE_FILE}: images of {', '.join(pairs)}"


def _averaged(pixels: Image, step: int) -> Image:
    """Grey or colour as (h, w, 3), averaged over blocks."""
    rgb = np.repeat(pixels[..., None], 3, axis=2) if pixels.ndim == 2 else pixels
    total = block_sum(np.ones(rgb.shape[:2], np.float32), step)
    return np.asarray(block_sum(np.asarray(rgb, np.float32), step) / total[..., None])


def mark(
    folder: Path, rig: RigFile | None, say: Callable[[str], None], *, port: int = 0, browse: Callable[[str], Any] | None = None
) -> Outcome:
    """Serve the page until it says that it is done.

    Raises
    ------
    InputError
        There is no such folder, or no image in it.
    UsageError
        The port is taken.
    """
    if not folder.is_dir():
        raise InputError("no such folder", where=str(folder), needed="a capture folder", todo=did_you_mean(folder))
    images = tuple(path.name for path in sorted(folder.iterdir()) if path.suffix.lower() in PICTURES and path.stem != "mask")
    if not images:
        raise InputError("no image", where=str(folder), needed="the images of a capture or of a sphere")
    at = Marking(folder, rig, images)
    at.document()  # a capture.yaml that cannot be read is said now
    token = secrets.token_urlsafe(18)
    try:
        server = ThreadingHTTPServer((LOOPBACK, port), handler_of(at, token))
    except (OSError, OverflowError) as error:
        raise UsageError(f"port {port} cannot be used: {error}", where="--port", needed="a free port, or 0 for any") from error
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        address = f"http://{LOOPBACK}:{server.server_address[1]}/?token={token}"
        say(f"marking {folder}; the page: {address}")
        if browse is not None:
            browse(address)
        while not at.done.wait(0.2):
            pass
    finally:
        server.shutdown()
        server.server_close()
    lines = at.written or ["nothing was marked"]
    return Outcome(lines, {"folder": str(folder), "written": at.written})


@dataclass(frozen=True)
class Answer:
    """What is sent back."""

    status: int
    content: bytes = b""
    media: str = "application/json"
    step: int | None = None
    """By how much a picture is smaller than its image."""


def got(at: Marking, token: str, path: str) -> Answer:
    """The page, or an image of the capture."""
    if path == "/":
        return Answer(200, mark_html(at.document(), token).encode(), "text/html; charset=utf-8")
    name = path.removeprefix("/image/")
    if name == path or name not in at.images:
        return Answer(404)
    try:
        content, step = at.shown(name)
    except LpcalError as error:
        return Answer(400, str(error).encode(), "text/plain; charset=utf-8")
    return Answer(200, content, "image/png", step)


def posted(at: Marking, path: str, content: bytes) -> Answer:
    """What the page has sent, written; or the word that it is done."""
    if path == "/done":
        return Answer(200, b"{}")
    try:
        asked = json.loads(content)
        return Answer(200, json.dumps({"said": at.save(asked if isinstance(asked, dict) else {})}).encode())
    except LpcalError as error:
        return Answer(409, json.dumps({"error": str(error)}).encode())
    except (ValueError, TypeError, AttributeError):
        return Answer(400, json.dumps({"error": "not a message of the page"}).encode())


def handler_of(at: Marking, token: str) -> type[BaseHTTPRequestHandler]:
    """What answers the page."""

    class Handler(BaseHTTPRequestHandler):
        def _known(self) -> bool:
            host = (self.headers.get("Host") or "").rpartition(":")[0]
            given = parse_qs(urlsplit(self.path).query).get("token", [""])[0]
            return host in {LOOPBACK, "localhost"} and secrets.compare_digest(given.encode(), token.encode())

        def do_GET(self) -> None:
            self._send(got(at, token, unquote(urlsplit(self.path).path)) if self._known() else Answer(403))

        def do_POST(self) -> None:
            size, path = int(self.headers.get("Content-Length") or 0), urlsplit(self.path).path
            known = self._known() and 0 <= size <= MOST_BYTES
            self._send(posted(at, path, self.rfile.read(size)) if known else Answer(403))
            if known and path == "/done":
                at.done.set()

        def _send(self, answer: Answer) -> None:
            self.send_response(answer.status)
            self.send_header("Content-Type", answer.media)
            self.send_header("Content-Length", str(len(answer.content)))
            self.send_header("Cache-Control", "no-store")
            if answer.step is not None:
                self.send_header("X-Step", str(answer.step))
            self.end_headers()
            self.wfile.write(answer.content)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    return Handler

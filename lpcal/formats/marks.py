"""What `lpcal mark` writes: a sphere's hint and a board's corners in panel.yaml, mask.png, the lights' images in capture.yaml."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.formats.outputs import Kind, whole, write_text
from lpcal.formats.panel_yaml import read_capture_section, read_rig
from lpcal.formats.yaml_edit import with_value
from lpcal.geometry.arrays import Mask

SOFTWARE = "lpcal mark"
"""What mask.png says made it: by that another one may replace it."""
CAPTURE_FILE = "capture.yaml"
MASK_FILE = "mask.png"


def _is_marked(path: Path) -> bool:
    from PIL import Image

    try:
        with Image.open(path) as head:
            return head.info.get("Software") == SOFTWARE
    except OSError:
        return False


MASK = Kind("a mask that was marked", _is_marked)
"""A mask, as an output: one that was drawn otherwise is never replaced."""


def edits_of(name: str) -> Kind:
    """A file of a person's of this name, in which one value is set."""
    return Kind(f"the {name}", lambda path: path.name == name)


def write_hint(panel: Path, sphere: str, circle_px: Sequence[float]) -> None:
    """Set ``spheres.<sphere>.hint`` of a panel.yaml.

    Raises
    ------
    InputError
        The file cannot be read or written, or the value cannot be set without touching the rest.
    """
    read_rig(panel)
    text = panel.read_bytes().decode("utf-8-sig")
    value = "[" + ", ".join(f"{x:.1f} px" for x in circle_px) + "]"
    write_text(panel, with_value(text, ["spheres", sphere, "hint"], value, str(panel)), edits_of(panel.name))


def write_board_marks(panel: Path, image: str, marks_px: Sequence[float]) -> None:
    """Set ``board.marks.<image>`` of a panel.yaml: x and y of the board's four outermost inner corners (8,), in turn round it.

    Raises
    ------
    InputError
        As `write_hint`.
    """
    section = read_rig(panel).rig.board
    marks = {**({} if section is None else section.marks), image: tuple(marks_px)}
    text = panel.read_bytes().decode("utf-8-sig")
    rows = (f"{json.dumps(name, ensure_ascii=False)}: [{', '.join(f'{x:.1f} px' for x in at)}]" for name, at in marks.items())
    write_text(panel, with_value(text, ["board", "marks"], "{" + ", ".join(rows) + "}", str(panel)), edits_of(panel.name))


def write_light_images(folder: Path, images: Mapping[str, str]) -> None:
    """Set ``images`` of a capture's capture.yaml: which file shows which light.

    Raises
    ------
    InputError
        As `write_hint`.
    """
    path = folder / CAPTURE_FILE
    read_capture_section(path)
    text = path.read_bytes().decode("utf-8-sig") if path.is_file() else ""
    value = "{" + ", ".join(f"{json.dumps(light)}: {json.dumps(name, ensure_ascii=False)}" for light, name in images.items()) + "}"
    write_text(path, with_value(text, ["images"], value, str(path)), edits_of(CAPTURE_FILE))


def write_mask(folder: Path, mask: Mask) -> None:
    """Write mask.png of a mask (H, W) into a capture's folder.

    Raises
    ------
    InputError
        A mask that was not marked is there already, or it cannot be written.
    """
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    words = PngInfo()
    words.add_text("Software", SOFTWARE)
    with whole(folder / MASK_FILE, MASK) as draft:
        Image.fromarray(np.asarray(mask, np.uint8) * np.uint8(255)).save(draft, format="PNG", pnginfo=words)


def named_by_capture(folder: Path, images: Mapping[str, str], lights: Sequence[str], files: dict[str, Path]) -> dict[str, Path]:
    """The folder's images by name, those that capture.yaml gives to a light under the light's.

    Raises
    ------
    DisagreementError
        A name that is no light's, a file that is not there, or one that two lights have.
    """
    if not images:
        return files
    where, there = f"{folder / 'capture.yaml'}, images", {path.name: stem for stem, path in files.items()}
    strange = [light for light in images if light not in lights]
    if strange:
        raise DisagreementError(f"no light is called {strange[0]}", where=where, needed=f"some of {', '.join(lights)}", todo="correct it")
    for light, name in images.items():
        if name not in there or list(images.values()).count(name) > 1:
            found = f"no image {name}" if name not in there else f"{name} for two lights"
            raise DisagreementError(found, where=where, needed=f"an image of the folder for {light}, each once", todo="correct it")
    others = {stem: path for stem, path in files.items() if path.name not in images.values() and stem not in images}
    return {light: files[there[name]] for light, name in images.items()} | others

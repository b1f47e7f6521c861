"""What `lpcal mark` writes: a sphere's hint and a board's corners in panel.yaml, mask.png, the lights' images in capture.yaml.

In a YAML file that a person wrote, one value is set and all else stays as it is: comments, order and spaces too.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.outputs import Kind, whole, write_text
from lpcal.formats.panel_yaml import read_capture_section, read_rig
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


def with_value(text: str, keys: Sequence[str], value: str, where: str) -> str:
    """The text with `value`, YAML on one line, at the place that the keys lead to; sections that lack on the way are made.

    Raises
    ------
    InputError
        The text is no YAML of sections, or it holds anchors, tags or the like by which the change would touch something else.
    """
    try:
        before = yaml.safe_load(text)
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        edited = _edited(text, node, keys, value)
        after = yaml.safe_load(edited)
        wanted = _set(before, keys, yaml.safe_load(value))
    except (yaml.YAMLError, TypeError, ValueError) as error:
        raise _by_hand(keys, value, where) from error
    if after != wanted:
        raise _by_hand(keys, value, where)
    return edited


def _by_hand(keys: Sequence[str], value: str, where: str) -> InputError:
    return InputError(
        f"{'.'.join(keys)} cannot be set without touching the rest",
        where=where,
        needed="plain YAML",
        todo=f"write by hand {keys[-1]}: {value}",
    )


def _edited(text: str, node: Any, keys: Sequence[str], value: str) -> str:
    if node is None:
        return text + ("" if not text or text.endswith("\n") else "\n") + _line(keys, value) + "\n"
    if not isinstance(node, yaml.MappingNode):
        raise TypeError(type(node).__name__)
    found = next((below for key, below in node.value if key.value == keys[0]), None)
    if found is None:
        return _inserted(text, node, _line(keys, value))
    if len(keys) > 1 and not (isinstance(found, yaml.ScalarNode) and not found.value):
        return _edited(text, found, keys[1:], value)
    content = value if len(keys) == 1 else "{" + _line(keys[1:], value) + "}"
    start, end = found.start_mark.index, found.end_mark.index
    kept = text[start:end]
    blank = kept[len(kept.rstrip()) :]
    return text[:start] + ("" if start and text[start - 1] in " \t" else " ") + content + blank + text[end:]


def _line(keys: Sequence[str], value: str) -> str:
    """``a: {b: value}`` for the keys a and b."""
    inner = value
    for key in reversed(keys[1:]):
        inner = f"{{{key}: {inner}}}"
    return f"{keys[0]}: {inner}"


def _inserted(text: str, node: yaml.MappingNode, line: str) -> str:
    """The line as the mapping's first one, or as its first part where it stands in braces."""
    if node.flow_style:
        at = node.start_mark.index + 1
        return text[:at] + line + (", " if node.value else "") + text[at:]
    first = node.value[0][0].start_mark
    return text[: first.index] + line + "\n" + " " * first.column + text[first.index :]


def _set(document: Any, keys: Sequence[str], value: Any) -> Any:
    document = dict(document or {})
    document[keys[0]] = value if len(keys) == 1 else _set(document.get(keys[0]), keys[1:], value)
    return document

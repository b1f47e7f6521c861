"""panel.yaml and capture.yaml: read, checked against their schema, every complaint with its line."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from lpcal.errors import InputError
from lpcal.records.rig import CaptureSection, Rig, RigFile

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError

FILE_NAME = "panel.yaml"


def find(start: Path) -> Path:
    """The panel.yaml named by a file or folder, or else the nearest one in the folder `start` or above it.

    Raises
    ------
    InputError
        There is none.
    """
    if start.is_file():
        return start
    if start.is_dir():
        for folder in [start.resolve(), *start.resolve().parents]:
            if (folder / FILE_NAME).is_file():
                return folder / FILE_NAME
    raise InputError(
        f"no {FILE_NAME} here or above" if start.is_dir() else "no such file or folder",
        where=str(start),
        needed="a rig folder",
        todo="go into one, name it with --rig, or start one with: lpcal new my_rig",
    )


def read_rig(path: Path) -> RigFile:
    """Read a panel.yaml.

    Raises
    ------
    InputError
        Not YAML, an unknown key, a bare number for a length, or a value of the wrong form; with file:line.
    """
    document, lines = _load(path)
    return RigFile(rig=_checked(Rig, document, path, lines), file=path, lines=lines)


def read_capture_section(path: Path) -> CaptureSection:
    """Read a capture.yaml; an absent file states nothing."""
    if not path.is_file():
        return CaptureSection()
    document, lines = _load(path)
    return _checked(CaptureSection, document, path, lines)


def _load(path: Path) -> tuple[Any, dict[str, int]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
        root = yaml.compose(text, Loader=yaml.SafeLoader)
        document = yaml.safe_load(text)
    except UnicodeDecodeError as error:
        raise InputError("not a text file in UTF-8", where=str(path), needed="YAML") from error
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{path}:{mark.line + 1}" if mark else str(path)
        raise InputError(f"not YAML: {error.problem}", where=place, needed="key: value lines", todo="mend that line") from error
    if document is None:
        raise InputError("empty", where=str(path), needed="key: value lines")
    lines: dict[str, int] = {}
    _collect_lines(root, "", lines, path)
    return document, lines


def _collect_lines(node: yaml.Node | None, prefix: str, lines: dict[str, int], path: Path) -> None:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            name = f"{prefix}{key.value}"
            if name in lines:
                raise InputError(
                    f"the key {name} stands twice, first in line {lines[name]}",
                    where=f"{path}:{key.start_mark.line + 1}",
                    needed="each key once",
                    todo="remove one of them",
                )
            lines[name] = key.start_mark.line + 1
            _collect_lines(value, f"{name}.", lines, path)
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            lines[f"{prefix}{index}"] = value.start_mark.line + 1
            _collect_lines(value, f"{prefix}{index}.", lines, path)


def _checked[Model: "BaseModel"](model: type[Model], document: Any, path: Path, lines: dict[str, int]) -> Model:
    from pydantic import ValidationError

    if not isinstance(document, dict):
        raise InputError("not a mapping of keys to values", where=f"{path}:1", needed="key: value lines")
    try:
        return model.model_validate(_filled(document))
    except ValidationError as error:
        raise _complaint(error, model, path, lines) from error


def _filled(document: dict[str, Any]) -> dict[str, Any]:
    """A section with nothing behind its key is as good as absent; a light (``L1:``) as one of which nothing is known."""
    filled = {key: value for key, value in document.items() if value is not None}
    if isinstance(filled.get("lights"), dict):
        filled["lights"] = {name: {} if light is None else light for name, light in filled["lights"].items()}
    return filled


def _complaint(error: ValidationError, model: type[BaseModel], path: Path, lines: dict[str, int]) -> InputError:
    """The first complaint as one message, the number of others after it."""
    complaints = error.errors(include_url=False)
    first = complaints[0]
    steps = [str(step) for step in first["loc"]]
    key = ".".join(steps)
    while key not in lines and "." in key:  # pydantic adds the branch of a union to the place
        key = key.rpartition(".")[0]
    place = f"{path}:{lines[key]}" if key in lines else str(path)
    others = f"; {len(complaints) - 1} more like it or other follow" if len(complaints) > 1 else ""
    if first["type"] == "extra_forbidden":
        return InputError(
            f"unknown key {'.'.join(steps)}{others}",
            where=place,
            needed=f"one of: {', '.join(_known_keys(model, steps[:-1]))}",
            todo="correct the key's spelling, or remove it",
        )
    if first["type"] == "missing":
        return InputError(f"the key {'.'.join(steps)} is missing{others}", where=place, needed=steps[-1], todo="add it")
    words = first["msg"].removeprefix("Value error, ")
    value = "" if first["type"] == "value_error" else f" (found {first['input']!r})"
    return InputError(f"{words}{value}{others}", where=f"{place}, {key}")


def _known_keys(model: type[BaseModel], steps: list[str]) -> list[str]:
    """Keys that the section at `steps` knows."""
    schema: dict[str, Any] = model.model_json_schema()
    definitions, node = schema.get("$defs", {}), schema
    for step in steps:
        node = node.get("properties", {}).get(step) or node.get("additionalProperties") or node
        node = next((branch for branch in node.get("anyOf", []) if branch.get("type") != "null"), node)
        while "$ref" in node:
            node = definitions[node["$ref"].rpartition("/")[2]]
    return list(node.get("properties", {}))

"""panel.yaml and capture.yaml: read, checked against their schema, every complaint with its line."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from lpcal.errors import InputError
from lpcal.formats.guarded_yaml import load_yaml
from lpcal.formats.named_files import did_you_mean
from lpcal.formats.reading import reader
from lpcal.formats.text import read_text
from lpcal.records.rig import CaptureSection, Rig, RigFile

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError
    from pydantic_core import ErrorDetails

FILE_NAME = "panel.yaml"
NEEDED = {
    "int_": "a whole number",
    "float_": "a number",
    "finite_": "a number",
    "string_": "a name or a text",
    "tuple_": "a list such as [9, 6]",
    "list_": "a list such as [a, b]",
    "dict_": "a section of key: value lines",
    "model_": "a section of key: value lines",
}


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
        todo=did_you_mean(start, "go into one, name it with --rig, or start one with: lpcal new my_rig"),
    )


@reader("a panel.yaml")
def read_rig(path: Path) -> RigFile:
    """Read a panel.yaml.

    Raises
    ------
    InputError
        Not YAML, an unknown key, a bare number for a length, or a value of the wrong form; with file:line.
    """
    document, lines = _load(path)
    if document is None:
        raise InputError("empty", where=str(path), needed="key: value lines")
    return RigFile(rig=_checked(Rig, document, path, lines), file=path, lines=lines)


@reader("a capture.yaml")
def read_capture_section(path: Path) -> CaptureSection:
    """Read a capture.yaml; an absent file, or one of comments alone, states nothing."""
    if not path.is_file():
        return CaptureSection()
    document, lines = _load(path)
    return CaptureSection() if document is None else _checked(CaptureSection, document, path, lines)


class _AsWritten(yaml.SafeLoader):
    """Scalars stay the text that a person wrote (``on``, ``2024-01-01``, ``1e3``); the schema, not YAML, says what they mean."""

    yaml_implicit_resolvers = {  # noqa: RUF012 - the name is PyYAML's
        letter: [pair for pair in pairs if pair[0].endswith((":null", ":merge"))]
        for letter, pairs in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }


def _load(path: Path) -> tuple[Any, dict[str, int]]:
    text = read_text(path, "a text file")
    lines: dict[str, int] = {}
    try:
        return load_yaml(text, path, _AsWritten, lambda node: _collect_lines(node, "", lines)), lines
    except yaml.YAMLError as error:
        raise _not_yaml(error, text, path) from error


def _not_yaml(error: yaml.YAMLError, text: str, path: Path) -> InputError:
    if isinstance(error, yaml.MarkedYAMLError):
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark else 1
        if "<stream end>" in str(error.problem):
            found = "ends in the middle of a [list] or a {section}"
            return InputError(found, where=f"{path}:{line}", needed="the whole file", todo="close it, or fetch the file again")
        return InputError(f"not YAML: {error.problem}", where=f"{path}:{line}", needed="key: value lines", todo="correct that line")
    line = text.count("\n", 0, getattr(error, "position", 0)) + 1
    return InputError("not YAML: a control character", where=f"{path}:{line}", needed="plain text", todo="correct that line")


def _collect_lines(node: yaml.Node, prefix: str, lines: dict[str, int]) -> None:
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            lines[f"{prefix}{key.value}"] = key.start_mark.line + 1
            _collect_lines(value, f"{prefix}{key.value}.", lines)
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            lines[f"{prefix}{index}"] = value.start_mark.line + 1
            _collect_lines(value, f"{prefix}{index}.", lines)


def _checked[Model: "BaseModel"](model: type[Model], document: Any, path: Path, lines: dict[str, int]) -> Model:
    from pydantic import ValidationError

    if not isinstance(document, dict):
        raise InputError("not a mapping of keys to values", where=f"{path}:1", needed="key: value lines")
    try:
        return model.model_validate(_filled(document))
    except ValidationError as error:
        raise _complaint(error, model, path, lines) from error


def _filled(document: dict[str, Any]) -> dict[str, Any]:
    """A key with nothing behind it is as good as absent; a light or a sphere (``L1:``) is there, and nothing is known of it."""
    filled = {}
    for key, value in document.items():
        if key in {"lights", "spheres"} and isinstance(value, dict):
            filled[key] = {name: {} if entry is None else entry for name, entry in value.items()}
        elif isinstance(value, dict) and key != "objects":
            filled[key] = _filled(value)
        elif value is not None:
            filled[key] = value
    return filled


def _complaint(error: ValidationError, model: type[BaseModel], path: Path, lines: dict[str, int]) -> InputError:
    """One complaint as one message, the number of others after it. A misspelled key comes first: others follow from it."""
    complaints = error.errors(include_url=False)
    first = min(complaints, key=lambda complaint: complaint["type"] != "extra_forbidden")
    steps = [str(step) for step in first["loc"]]
    key = ".".join(steps)
    above = key
    while above not in lines and "." in above:
        above = above.rpartition(".")[0]
    shown = key if first["type"] in {"missing", "extra_forbidden"} or above not in lines else above
    where = f"{path}:{lines[above]}, {shown}" if above in lines else f"{path}, {shown}"
    different = {(*[step for step in one["loc"] if isinstance(step, str)], one["msg"]) for one in complaints}
    others = f" (the first of {len(different)} mistakes)" if len(different) > 1 else ""
    if first["type"] == "extra_forbidden":
        known = _known_keys(model, steps[:-1])
        near = difflib.get_close_matches(steps[-1], known, n=1)
        todo = f"write {near[0]}" if near else "correct the key's spelling, or remove it"
        return InputError(f"unknown key{others}", where=where, needed=f"one of: {', '.join(known)}", todo=todo)
    found, needed = _in_words(first)
    todo = "write lpcal: 1 at the top of the file" if key == "lpcal" else f"add {steps[-1]}:" if first["type"] == "missing" else ""
    return InputError(f"{found}{others}", where=where, needed=needed, todo=todo)


def _in_words(complaint: ErrorDetails) -> tuple[str, str]:
    """What was found and what was needed, of one of pydantic's complaints."""
    kind, facts = complaint["type"], complaint.get("ctx", {})
    found = complaint["input"] if isinstance(complaint["input"], str) else repr(complaint["input"])
    match kind:
        case "missing":
            return "the key is missing", "a value for it"
        case "value_error":
            said, _, wanted = complaint["msg"].removeprefix("Value error, ").partition("; ")
            return said, wanted
        case "literal_error":
            return found, "one of: " + str(facts["expected"]).replace(" or ", ", ").replace("'", "")
        case "too_long" | "too_short":
            return f"{facts['actual_length']} values", f"{facts.get('max_length', facts.get('min_length'))} values"
        case "greater_than" | "greater_than_equal" | "less_than":
            words = {"greater_than": "more than", "greater_than_equal": "at least", "less_than": "less than"}[kind]
            return found, f"{words} {facts.get('gt', facts.get('ge', facts.get('lt')))}"
    for part, needed in NEEDED.items():
        if kind.startswith(part):
            return found, needed
    return f"{found}: {complaint['msg']}", ""


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

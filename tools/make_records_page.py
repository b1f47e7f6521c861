"""The page of what each stage's result holds: ``python tools/make_records_page.py`` writes docs/reference/stage-records.md.

From the return types of the library's functions the records are followed from field to field; what a field holds is read from the string
under it, or from the section Parameters of its record. A test holds the page to the records.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import re
import textwrap
import types
import typing
from pathlib import Path
from typing import Any

import numpy as np

import lpcal

PAGE = Path(__file__).resolve().parents[1] / "docs/reference/stage-records.md"
STAGES = (
    ("Camera", "calibrate_camera", "intrinsics"),
    ("Board poses", "locate_boards", "intrinsics"),
    ("Hand-eye check", "check_handeye", "check"),
    ("Hand-eye", "solve_handeye", "handeye"),
    ("Wings", "design_lights", "wings"),
    ("Distance sensor", "calibrate_distance_sensor", "distance"),
    ("Lights", "refine_lights", "refine"),
    ("Calibration", "assemble_calibration", "export"),
    ("Surface", "reconstruct", "reconstruct"),
    ("Model", "fuse", "fuse"),
    ("Comparison", "compare_calibrations", "diff"),
    ("Evaluation", "evaluate", "evaluate"),
)
"""The stages in the chain's order: a heading, the library's function, and the command that calls it."""
HEAD = """# What each stage's result holds

Each function of the library returns a frozen record, and the command of the same stage writes it. The fields of the records, and of the
records in them, are listed here; a record that stands in several is listed once, where it first occurs. `repr` shows the figures of a
record, `dataclasses.fields(record)` names its fields. The keys of the files are under [files that lpcal writes](file-formats.md).

<!-- written by tools/make_records_page.py -->
"""
"""What the page begins with."""
ESCAPED = "\\|"
"""A stroke within a cell of a table."""


def records_in(hint: Any) -> list[type]:
    """The record classes that a type names, in order."""
    if isinstance(hint, type) and dataclasses.is_dataclass(hint):
        return [hint]
    return [found for each in typing.get_args(hint) for found in records_in(each)]


def described(record: type) -> dict[str, str]:
    """What each field holds: the string under it, or its entry under Parameters; empty where neither says it."""
    (tree,) = ast.parse(textwrap.dedent(inspect.getsource(record))).body
    assert isinstance(tree, ast.ClassDef)
    said = dict(re.findall(r"^(\w+) : [^\n]*\n((?:    [^\n]*\n?)+)", parameters(record), re.MULTILINE))
    for at, field in enumerate(tree.body[:-1]):
        after = tree.body[at + 1]
        if isinstance(field, ast.AnnAssign) and isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant):
            said[ast.unparse(field.target)] = str(after.value.value)
    return {field.name: " ".join(said.get(field.name, "").split()) for field in dataclasses.fields(record)}


def parameters(record: type) -> str:
    """The section Parameters of a record's docstring; empty without one."""
    found = re.search(r"Parameters\n-+\n(.*?)(?:\n\n|\Z)", inspect.getdoc(record) or "", re.DOTALL)
    return found[1] + "\n" if found else ""


def type_words(hint: Any) -> str:
    """A type as a reader needs it."""
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if isinstance(hint, typing.TypeAliasType):
        return type_words(hint.__value__)
    if hint is type(None):
        return "None"
    if isinstance(hint, types.UnionType) or origin is typing.Union:
        return " or ".join(type_words(each) for each in parts)
    if origin is typing.Literal:
        return " or ".join(repr(each) for each in parts)
    if origin is np.ndarray:
        return "ndarray"
    if origin is not None:
        inside, name = [type_words(each) for each in parts if each is not Ellipsis], str(origin.__name__).lower()
        if name in {"dict", "mapping"}:
            return f"{name} from {' to '.join(inside)}"
        return f"{name} of {', '.join(dict.fromkeys(inside))}"
    return getattr(hint, "__name__", str(hint))


def table(record: type) -> str:
    """A record's fields as a table."""
    hints = typing.get_type_hints(record)
    rows = [f"| `{name}` | {type_words(hints[name])} | {said.replace('|', ESCAPED)} |" for name, said in described(record).items()]
    return "\n".join(["| field | type | what it holds |", "|---|---|---|", *rows])


def stage_records() -> dict[str, list[type]]:
    """The records of each stage by its function's name, each record where it first occurs."""
    seen: list[type] = []
    found: dict[str, list[type]] = {}
    for _, function, _ in STAGES:
        waiting, own = records_in(typing.get_type_hints(getattr(lpcal, function))["return"]), []
        while waiting:
            record = waiting.pop(0)
            if record in seen:
                continue
            seen.append(record)
            own.append(record)
            waiting += [inner for hint in typing.get_type_hints(record).values() for inner in records_in(hint)]
        found[function] = own
    return found


def page() -> str:
    """The whole page."""
    parts, of = [HEAD], stage_records()
    for heading, function, command in STAGES:
        (result, *_) = records_in(typing.get_type_hints(getattr(lpcal, function))["return"])
        parts.append(f"## {heading}\n\n`lpcal.{function}` returns a `{result.__name__}`; the command is `lpcal {command}`.\n")
        for record in of[function]:
            summary = (inspect.getdoc(record) or "").partition("\n\n")[0].replace("\n", " ")
            parts.append(f"### {record.__name__}\n\n{summary}\n\n{table(record)}\n")
    return "\n".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")

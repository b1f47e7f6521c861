"""The numeric constants of the surface stage: ``python tools/surface_constants.py [FOLDER]`` (lpcal by default).

A constant is a name in capitals that a module of STAGE sets to numbers alone: literals, tuples and dicts of them, arithmetic on them.
What is computed from another constant does not count. Prints each constant, how many there are in each package and in all, and which have
their name and value in common.
"""

from __future__ import annotations

import ast
import sys
from collections import defaultdict
from pathlib import Path

STAGE = ("surface", "shading", "view", "segmentation", "integration")


def of_module(tree: ast.Module) -> dict[str, str]:
    """The constants' names and what they are set to."""
    found: dict[str, str] = {}
    for statement in tree.body:
        if not isinstance(statement, ast.Assign) or not _of_numbers(statement.value):
            continue
        target, value = statement.targets[0], statement.value
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            pairs = list(zip(target.elts, value.elts, strict=True))
        else:
            pairs = [(target, value)]
        found |= {name.id: ast.unparse(one) for name, one in pairs if isinstance(name, ast.Name) and name.id.lstrip("_").isupper()}
    return found


def _of_numbers(value: ast.expr) -> bool:
    """Whether it holds numbers and refers to no other constant."""
    named = [node.id for node in ast.walk(value) if isinstance(node, ast.Name)]
    named += [node.attr for node in ast.walk(value) if isinstance(node, ast.Attribute)]
    numbers = [node for node in ast.walk(value) if isinstance(node, ast.Constant) and type(node.value) in {int, float}]
    return bool(numbers) and not any(name.isupper() for name in named)


def of_stage(folder: Path) -> dict[str, dict[str, str]]:
    """The constants of each module, by its name, of a folder that holds the packages of STAGE."""
    modules = [path for package in STAGE for path in sorted((folder / package).glob("*.py"))]
    return {path.relative_to(folder).as_posix(): of_module(ast.parse(path.read_text(encoding="utf-8"))) for path in modules}


def main(words: list[str]) -> None:
    """Print them."""
    found = of_stage(Path(words[0]) if words else Path(__file__).resolve().parents[1] / "lpcal")
    twice, count = defaultdict(list), defaultdict(int)
    for module, constants in found.items():
        for name, value in constants.items():
            print(f"{module}: {name} = {value}")
            twice[name, value].append(module)
            count[module.partition("/")[0]] += 1
    for (name, value), modules in twice.items():
        if len(modules) > 1:
            print(f"in common: {name} = {value} in {', '.join(modules)}")
    print(", ".join(f"{package} {count[package]}" for package in STAGE), "in all", sum(count.values()))


if __name__ == "__main__":
    main(sys.argv[1:])

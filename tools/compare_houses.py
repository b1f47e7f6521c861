"""How this package compares with others: ``python tools/compare_houses.py PACKAGE_FOLDER...``, a column each, read from the source alone.

Get others by ``pip install --no-deps --target THERE mrcal pytransform3d scikit-image caliscope`` and name the folders. Counted are the
functions and classes at the top of a module whose names do not begin with an underscore, nor their modules', unless an ``__init__`` exports
them; tests are left out.

- documented: share with a docstring; parameters: share of functions with arguments whose docstring has a section of them (numpydoc,
  Google, Sphinx); example: share with ``>>>`` or an Examples section
- the face: the same of the names that the package's ``__init__`` exports, or those of its folders where it exports none itself
- single importer: share of lines in modules that exactly one other module imports
- keys: look-ups of a literal string, by subscription or ``get``, a thousand lines
- same names: public classes of one name in two modules
"""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

SECTION = re.compile(r"^\s*(Parameters\n\s*-+|Args:|Arguments:|:param|ARGUMENTS|\s*- )", re.MULTILINE)
EXAMPLE = re.compile(r"^\s*(>>>|Examples?\n|Examples?:|SYNOPSIS)", re.MULTILINE)


@dataclass(frozen=True)
class Module:
    """A module of a package."""

    name: str
    path: Path
    source: str
    tree: ast.Module

    @property
    def lines(self) -> int:
        return len(self.source.splitlines())

    @property
    def definitions(self) -> dict[str, Definition]:
        kinds = (ast.FunctionDef, ast.ClassDef)
        return {node.name: node for node in self.tree.body if isinstance(node, kinds) and not node.name.startswith("_")}


type Definition = ast.FunctionDef | ast.ClassDef


def modules_of(folder: Path) -> list[Module]:
    found = []
    for path in sorted(folder.rglob("*.py")):
        inside = path.relative_to(folder).with_suffix("")
        if {"tests", "test", "_vendored", "externals"} & set(inside.parts):
            continue
        source = path.read_text(encoding="utf-8", errors="replace")
        parts = [folder.name, *inside.parts]
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        found.append(Module(name, path, source, ast.parse(source)))
    return found


def share(marks: list[bool]) -> float | None:
    """Per cent of the marks that are set; None of none."""
    return 100 * sum(marks) / len(marks) if marks else None


def per_cent(value: float | None) -> str:
    """Whole per cent, rounded down, so that 100 means every one; below twenty with a digit."""
    return "-" if value is None else f"{value:.1f} %" if value < 20 else f"{int(value)} %"


def takes_arguments(node: ast.FunctionDef | ast.ClassDef) -> bool:
    if isinstance(node, ast.ClassDef):
        return False
    every = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
    return bool(every)


@dataclass(frozen=True)
class Documented:
    """How many names there are, and per cent of them with a docstring, with a section of parameters, with an example."""

    count: int
    any: float | None
    parameters: float | None
    example: float | None

    @classmethod
    def of(cls, nodes: list[Definition]) -> Documented:
        texts = [ast.get_docstring(node) or "" for node in nodes]
        with_arguments = [bool(SECTION.search(text)) for text, node in zip(texts, nodes, strict=True) if takes_arguments(node)]
        examples = [bool(EXAMPLE.search(text)) for text in texts]
        return cls(len(nodes), share([bool(text) for text in texts]), share(with_arguments), share(examples))


def functions(tree: ast.AST) -> Iterator[ast.FunctionDef]:
    yield from (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


def length(node: ast.FunctionDef) -> int:
    first = node.body[0]
    docstring = (first.end_lineno or 0) - first.lineno + 1 if ast.get_docstring(node) else 0
    return (node.end_lineno or 0) - node.lineno + 1 - docstring


def imported(module: Module, names: set[str]) -> set[str]:
    """Modules of the package that a module imports."""
    found = set()
    package = module.name if module.path.stem == "__init__" else module.name.rpartition(".")[0]
    for node in ast.walk(module.tree):
        if isinstance(node, ast.Import):
            found |= {one.name for one in node.names}
        if isinstance(node, ast.ImportFrom):
            parts = package.split(".")
            above = ".".join(parts[: len(parts) - node.level + 1]) if node.level else ""
            whole = ".".join(part for part in (above, node.module or "") if part)
            found |= {whole, *(f"{whole}.{one.name}" for one in node.names)}
    return {name for name in found if name in names} - {module.name}


def keys(tree: ast.AST) -> int:
    count = 0
    for node in ast.walk(tree):
        key = node.slice if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load) else None
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "get" and node.args:
            key = node.args[0]
        count += isinstance(key, ast.Constant) and isinstance(key.value, str)
    return count


def exported(init: Path, folder: Path) -> set[tuple[str, str]]:
    """Module and name of what an ``__init__`` imports from its package; a stub beside it counts for it."""
    stub = init.with_suffix(".pyi")
    tree = ast.parse((stub if stub.is_file() else init).read_text(encoding="utf-8"))
    package = ".".join([folder.name, *init.parent.relative_to(folder).parts])
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            parts = package.split(".")
            above = ".".join(parts[: len(parts) - node.level + 1]) if node.level else ""
            module = ".".join(part for part in (above, node.module or "") if part)
            found |= {(module, one.name) for one in node.names}
    return found


def faces(folder: Path, modules: list[Module]) -> tuple[list[Definition], set[tuple[str, str]]]:
    """The definitions that the package exports itself, or else its folders; and all that any ``__init__`` exports."""
    inits = [module.path for module in modules if module.path.stem == "__init__"]
    every = {path: exported(path, folder) for path in inits}
    anywhere = set().union(*every.values())
    known = {(module.name, name): node for module in modules for name, node in module.definitions.items()}
    own = [known[one] for one in sorted(every[folder / "__init__.py"]) if one in known]
    return own or [known[one] for one in sorted(anywhere) if one in known], anywhere


@dataclass(frozen=True)
class House:
    """What is counted of a package."""

    name: str
    public: Documented
    face: Documented
    median_module: float
    longest_function: int
    single_importer: float
    """Per cent of the lines."""
    keys: float
    """A thousand lines."""
    same_names: int


def house(folder: Path) -> House:
    modules = modules_of(folder)
    own, anywhere = faces(folder, modules)
    nodes = [
        node
        for module in modules
        for name, node in module.definitions.items()
        if not any(part.startswith("_") for part in module.name.split(".")) or (module.name, name) in anywhere
    ]
    names = {module.name for module in modules}
    importers = Counter(name for module in modules for name in imported(module, names))
    lines = sum(module.lines for module in modules)
    single = sum(module.lines for module in modules if importers[module.name] == 1)
    classes = Counter(node.name for node in nodes if isinstance(node, ast.ClassDef))
    return House(
        folder.name,
        Documented.of(nodes),
        Documented.of(own),
        median([module.lines for module in modules if module.path.stem != "__init__"]),
        max(length(one) for module in modules for one in functions(module.tree)),
        100 * single / lines,
        1000 * sum(keys(module.tree) for module in modules) / lines,
        sum(count > 1 for count in classes.values()),
    )


def table(houses: list[House]) -> list[str]:
    """The table in Markdown, a column a package."""
    rows = [("", [one.name for one in houses]), ("---", ["---"] * len(houses))]
    for title, of in (("of all", "public"), ("of those", "face")):
        found: list[Documented] = [getattr(one, of) for one in houses]
        what = "public functions and classes" if of == "public" else "names that the package exports"
        rows += [
            (what, [str(one.count) for one in found]),
            (f"{title}, documented", [per_cent(one.any) for one in found]),
            (f"{title}, with a section of parameters", [per_cent(one.parameters) for one in found]),
            (f"{title}, with an example", [per_cent(one.example) for one in found]),
        ]
    rows += [
        ("median module, lines", [f"{one.median_module:.0f}" for one in houses]),
        ("longest function, lines", [str(one.longest_function) for one in houses]),
        ("lines in modules with one importer", [per_cent(one.single_importer) for one in houses]),
        ("look-ups of a literal string, a thousand lines", [f"{one.keys:.1f}" for one in houses]),
        ("public classes that share a name", [str(one.same_names) for one in houses]),
    ]
    return [f"| {title} | {' | '.join(cells)} |" if title != "---" else "|" + "---|" * (len(houses) + 1) for title, cells in rows]


if __name__ == "__main__":
    print("\n".join(table([house(Path(one)) for one in sys.argv[1:]])))

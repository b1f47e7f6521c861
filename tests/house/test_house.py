"""The house's own rules: small rooms, plain names, imports that point one way, a help that is there at once."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import surface_constants
from compare_houses import house
from lpcal.cli.main import COMMANDS

REPOSITORY = Path(__file__).resolve().parents[2]
MODULES = sorted((REPOSITORY / "lpcal").rglob("*.py"))
MODULE_LINES, FUNCTION_LINES = 400, 60
SURFACE_MODULES = 20
"""Modules of the surface stage beside its ``__init__``."""
SURFACE_CONSTANTS = 246
"""Numeric constants of the surface stage and what it stands on at most, by tools/surface_constants.py; 60 would do."""
MOST_SINGLE = 20.0
"""Per cent of the lines that may stand in modules that exactly one other module imports."""
VAGUE = {"utils", "util", "helpers", "helper", "common", "misc", "base", "core", "manager", "managers"}
UNUSED_BY_RECONSTRUCT = {"matplotlib", "casadi", "pycolmap", "mrcal", "reportlab", "ezc3d", "rosbags", "networkx"}
FOLDERS = {".ci", ".github", "calib_data", "docs", "examples", "lpcal", "packaging", "rigs", "tests", "tools"}
LARGEST = 1_500_000
"""Bytes of a tracked file at most: the demo's motion-capture recording is the largest that is needed."""
HEAVY = ["scipy", "cv2", "mrcal", "casadi", "pycolmap"]

# a folder of someone's own machine: a home, a user's folder on Windows, the folder that this repository lies in
SOMEONES_OWN = re.compile(rf"/home/\w|/Users/\w|/root/\w|[A-Z]:\\+Users|{re.escape(str(REPOSITORY))}\b")


def name_of(path: Path) -> str:
    return path.relative_to(REPOSITORY).as_posix()


def functions(tree: ast.Module) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
    yield from (node for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)))


def length(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines of a function without its docstring: what a public name's documentation takes is no code to be read through."""
    first = function.body[0]
    documented = ast.get_docstring(function, clean=False) is not None
    return function.end_lineno - function.lineno + 1 - (first.end_lineno - first.lineno + 1 if documented else 0)


def tracked() -> list[Path]:
    """The repository's own files: git's where it is a clone."""
    found = subprocess.run(["git", "ls-files", "-z"], cwd=REPOSITORY, capture_output=True, text=True, check=False)
    if found.returncode:
        pytest.skip("not a git clone")
    return [path for name in found.stdout.split("\0") if name and (path := REPOSITORY / name).is_file()]


@cache
def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def test_rooms_are_small() -> None:
    wide = [name_of(path) for path in MODULES if len(path.read_text(encoding="utf-8").splitlines()) >= MODULE_LINES]
    assert not wide, f"modules of {MODULE_LINES} lines or more: split them"
    long = [f"{path}:{one.lineno} {one.name}" for path in MODULES for one in functions(tree_of(path)) if length(one) >= FUNCTION_LINES]
    assert not long, f"functions of {FUNCTION_LINES} lines or more"


def test_the_surface_stage_reads_as_its_method() -> None:
    """What it stands on (the view of a capture, masks, integration) has packages of its own."""
    folder = REPOSITORY / "lpcal" / "surface"
    rooms = [name_of(path) for path in MODULES if path.is_relative_to(folder) and path.name != "__init__.py"]
    assert 10 < len(rooms) <= SURFACE_MODULES, rooms


def test_the_surface_stage_gains_no_constants() -> None:
    """Its choices are to follow from energies and from fits that tools repeat, not from numbers that someone has chosen."""
    module = surface_constants.of_module(ast.parse("A, B = 1.5, 2\nC = {'a': 0.1}\nD = A**2\nE = 'x'\nF = np.linspace(0, 1, 3)\nlow = 3"))
    assert list(module) == ["A", "B", "C", "F"]
    found = surface_constants.of_stage(REPOSITORY / "lpcal")
    count = sum(map(len, found.values()))
    assert 60 < count <= SURFACE_CONSTANTS, f"{count}: {found}"


def test_a_module_says_what_it_is() -> None:
    assert not [name_of(path) for path in MODULES if not ast.get_docstring(tree_of(path))]


def test_a_docstring_reads_alone() -> None:
    """Editors and the documentation show it without the name before it: a sentence that begins with "Of" hangs in the air there."""
    hanging = [
        f"{name_of(path)}:{number}"
        for path in MODULES
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if re.match(r'\s*r?"""Of ', line)
    ]
    assert not hanging


def annotations(tree: ast.Module) -> Iterator[ast.expr]:
    """Every type that is written down: of arguments, results, variables and aliases."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.returns is not None:
            yield node.returns
        if isinstance(node, (ast.arg, ast.AnnAssign)) and node.annotation is not None:
            yield node.annotation
        if isinstance(node, ast.TypeAlias):
            yield node.value


UNTYPED = re.compile(r"(dict|Mapping)\[str, (object|Any)\]")
TYPED_ROOMS = ("chain", "surface", "segmentation", "integration", "view", "report", "records")
OPEN_DOCUMENTS = {"records/outcome.py": 1, "records/provenance.py": 1}
"""The JSON that a command prints and the options that it was run with, which differ by command; nothing else may hold an untyped mapping.
What a page's script is given is typed in report/page_data.py."""


@pytest.mark.parametrize("room", TYPED_ROOMS)
def test_stages_hand_on_records_not_dicts(room: str) -> None:
    """What a stage found is a record with typed fields; a mapping of anything exists only where a file or a page is written."""
    for path in sorted((REPOSITORY / "lpcal" / room).rglob("*.py")):
        count = sum(len(UNTYPED.findall(ast.unparse(one))) for one in annotations(tree_of(path)))
        assert count <= OPEN_DOCUMENTS.get(path.relative_to(REPOSITORY / "lpcal").as_posix(), 0), (
            f"{name_of(path)}: a frozen record, not a dict"
        )


def looked_up(tree: ast.Module) -> list[str]:
    """Keys that are looked up as literal strings, by subscription or ``get``."""
    found = []
    for node in ast.walk(tree):
        key = node.slice if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load) else None
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "get" and node.args:
            key = node.args[0]
        if isinstance(key, ast.Constant) and isinstance(key.value, str):
            found.append(key.value)
    return found


@pytest.mark.parametrize("room", ["chain", "report"])
def test_no_figure_is_looked_up_by_a_string(room: str) -> None:
    found = {name_of(path): looked_up(tree_of(path)) for path in sorted((REPOSITORY / "lpcal" / room).rglob("*.py"))}
    assert len(found) > 10
    assert {name: keys for name, keys in found.items() if keys} == {}


def test_no_vague_names() -> None:
    vague = [name_of(path) for path in tracked() if VAGUE & {part.lower() for part in (path.stem, *path.relative_to(REPOSITORY).parts)}]
    assert not vague


def test_imports_point_one_way() -> None:
    program = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True, no_logo=True))"
    found = subprocess.run([sys.executable, "-c", program], cwd=REPOSITORY, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout
    assert re.search(r"Contracts: [1-9]\d* kept, 0 broken", found.stdout), found.stdout


def test_nothing_that_a_run_wrote_is_tracked() -> None:
    files = tracked()
    strange = {name_of(path).split("/")[0] for path in files if "/" in name_of(path)} - FOLDERS
    assert not strange, f"folders that are none of the project's: {strange}"
    large = [f"{name_of(path)}: {path.stat().st_size} bytes" for path in files if path.stat().st_size > LARGEST]
    assert not large, large


def test_no_path_of_someones_own_machine() -> None:
    found = []
    for path in tracked():
        content = path.read_bytes()
        if b"\0" not in content[:1024] and path != Path(__file__):
            lines = content.decode("utf-8", "replace").splitlines()
            found += [f"{name_of(path)}:{number}: {line.strip()[:80]}" for number, line in enumerate(lines, 1) if SOMEONES_OWN.search(line)]
    assert not found


def imported_by(*words: str) -> set[str]:
    """The packages that are imported once ``lpcal WORDS`` has printed its help."""
    program = (
        "import sys\nfrom lpcal.cli.main import main\n"
        f"try:\n    main({list(words)!r})\nexcept SystemExit as stop:\n    assert not stop.code, stop.code\n"
        "print('imported:', *{name.partition('.')[0] for name in sys.modules})"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stderr
    assert found.stdout.startswith("usage: lpcal")
    return set(found.stdout.rpartition("imported: ")[2].split())


def test_reconstruct_imports_only_what_it_uses() -> None:
    """By all modules that the command's own import; what they import where it is used is held by a slow test."""
    used = imported_by("reconstruct", "--help")
    assert "numpy" not in used
    program = (
        "import importlib, pkgutil, sys, lpcal.surface, lpcal.shading, lpcal.segmentation, lpcal.integration, lpcal.view\n"
        "import lpcal.pipeline.reconstruct, lpcal.formats.surface_files, lpcal.report.relight_page\n"
        "rooms = (lpcal.surface, lpcal.shading, lpcal.segmentation, lpcal.integration, lpcal.view)\n"
        "parts = [one.name for room in rooms for one in pkgutil.iter_modules(room.__path__, room.__name__ + '.')]\n"
        "[importlib.import_module(name) for name in parts]\n"
        "print(*{name.partition('.')[0] for name in sys.modules})"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "numpy" in found.stdout.split()
    assert not UNUSED_BY_RECONSTRUCT & set(found.stdout.split())


def test_help_is_there_at_once() -> None:
    packages = imported_by("--help")
    assert "argparse" in packages
    assert not packages & {*HEAVY, "numpy", "pydantic", "matplotlib"}


def test_a_commands_help_is_there_at_once() -> None:
    """What the words of all commands import, in one process: nothing heavy, so none of them does."""
    program = (
        "import sys\nfrom lpcal.cli.main import COMMANDS, parser_of\n_, modules = parser_of(COMMANDS)\n"
        "print(len(modules), *{name.partition('.')[0] for name in sys.modules})"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.split()
    assert int(found[0]) == len(COMMANDS)
    assert not set(found) & set(HEAVY)


def test_no_two_public_classes_share_a_name() -> None:
    """A name that is read in a message, a signature or a search means one thing."""
    homes: dict[str, list[str]] = {}
    for path in MODULES:
        for node in tree_of(path).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                homes.setdefault(node.name, []).append(name_of(path))
    assert not {name: found for name, found in homes.items() if len(found) > 1}


def test_modules_are_shared_and_names_are_documented() -> None:
    """The figures that docs/architecture.md compares with other libraries: what one module alone imports, what is documented."""
    found = house(REPOSITORY / "lpcal")
    assert found.single_importer < MOST_SINGLE
    assert 80 <= found.median_module <= 200
    assert found.face.count > 40
    assert (found.public.any, found.face.any, found.face.parameters, found.face.example) == (100, 100, 100, 100)


def test_tests_mirror_the_house() -> None:
    """A test stands in the folder of what it tests; `house` is the repository itself, `support` what tests share."""
    homes = {path.parent.relative_to(REPOSITORY / "tests") for path in (REPOSITORY / "tests").rglob("*.py")} - {
        Path("house"),
        Path("support"),
    }
    assert len(homes) > 12
    assert not [str(home) for home in homes if not (REPOSITORY / "lpcal" / home).is_dir()]
    assert not list((REPOSITORY / "tests" / "support").glob("test_*.py"))


def test_no_test_imports_anothers_module() -> None:
    """What tests share stands in modules of its own, so that each test file is read and run by itself."""
    files = sorted((REPOSITORY / "tests").rglob("test_*.py"))
    assert len(files) > 50
    importing = {
        path.name for path in files if re.search(r"^\s*(from|import) (tests|test_|\.)", path.read_text(encoding="utf-8"), re.MULTILINE)
    }
    assert not importing

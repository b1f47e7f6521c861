"""The library's face: its names and signatures are frozen, its documentation is whole and runs, and it costs nothing to import."""

from __future__ import annotations

import doctest
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import lpcal

FROZEN = dict(re.findall(r"^(\w+)(\(.*\))$", (Path(__file__).parent / "library_names.txt").read_text(encoding="utf-8"), re.MULTILINE))
PUBLIC = sorted(FROZEN)


def signature_of(name: str) -> str:
    """Names, kinds and defaults of the parameters; a default that is a function or made again is an ellipsis."""
    parameters = inspect.signature(getattr(lpcal, name)).parameters.values()
    plain = [
        one.replace(annotation=one.empty, default=... if callable(one.default) or "factory" in repr(one.default) else one.default)
        if one.default is not one.empty
        else one.replace(annotation=one.empty)
        for one in parameters
    ]
    return str(inspect.Signature(plain)).replace("Ellipsis", "...")


def test_names_are_frozen() -> None:
    assert sorted(lpcal.__all__) == sorted([*PUBLIC, *lpcal.MODULES])
    assert set(lpcal.__all__) < set(dir(lpcal))


@pytest.mark.parametrize("name", PUBLIC)
def test_signatures_are_frozen(name: str) -> None:
    assert signature_of(name) == FROZEN[name]


def test_a_name_that_is_none_is_no_attribute() -> None:
    with pytest.raises(AttributeError, match="no attribute 'reconstuct'"):
        lpcal.reconstuct  # noqa: B018


@pytest.mark.parametrize("name", PUBLIC)
def test_examples_run(name: str) -> None:
    examples = [one for one in doctest.DocTestFinder(recurse=False).find(getattr(lpcal, name), name, globs={}) if one.examples]
    assert examples, f"{name} has no example"
    for one in examples:
        assert doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(one).failed == 0


@pytest.mark.parametrize("name", PUBLIC)
def test_every_parameter_is_documented(name: str) -> None:
    text = inspect.getdoc(getattr(lpcal, name)) or ""
    sections = re.split(r"^(\w+)\n-+\n", text, flags=re.MULTILINE)
    found = dict(zip(sections[1::2], sections[2::2], strict=True))
    assert {"Parameters", "Examples"} <= set(found)
    named = {one.strip() for line in re.findall(r"^(\w[\w, ]*?) : ", found["Parameters"], re.MULTILINE) for one in line.split(",")}
    taken = inspect.signature(getattr(lpcal, name)).parameters
    assert named == set(taken), f"{name} documents what it does not take, or takes what it does not document"
    together = [re.findall(r"\w+", line) for line in re.findall(r"^(\w[\w, ]*?) : ", found["Parameters"], re.MULTILINE)]
    defaults = [{repr(taken[one].default) for one in line} for line in together]
    assert all(len(one) == 1 for one in defaults), f"{name}: the page shows one default for parameters that are documented together"
    if inspect.isfunction(getattr(lpcal, name)):
        assert "Returns" in found or name.startswith("write_")
        assert "Raises" in found or name == "mesh"


DOCUMENTED = [(module, name) for module in ("extend", "methods", "tables") for name in getattr(lpcal, module).__all__]
"""What the public modules hold; types and dicts among it have no parameters of their own."""


@pytest.mark.parametrize(
    ("module", "name"),
    [one for one in DOCUMENTED if inspect.isroutine(named := getattr(getattr(lpcal, one[0]), one[1])) or inspect.isclass(named)]
    + [("errors", "LpcalError")],
)
def test_what_public_modules_hold_has_an_example_that_runs(module: str, name: str) -> None:
    found = getattr(getattr(lpcal, module), name)
    assert "Parameters\n----------" in inspect.getdoc(found)
    examples = [one for one in doctest.DocTestFinder(recurse=False).find(found, name, globs={}) if one.examples]
    assert examples
    for one in examples:
        assert doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(one).failed == 0


def imported_by(program: str) -> set[str]:
    """The packages that are imported once a program has run."""
    program += "\nimport sys\nprint(*sorted({name.partition('.')[0] for name in sys.modules}))"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return set(found.stdout.split())


def test_importing_costs_nothing() -> None:
    bare = imported_by("pass")
    assert imported_by("import lpcal; dir(lpcal)") - bare == {"lpcal"}


@pytest.mark.parametrize("name", ["Calibration", "read_rig", "mesh", "light_field"])
def test_a_name_imports_no_more_than_it_needs(name: str) -> None:
    assert not imported_by(f"import lpcal; lpcal.{name}") & {"casadi", "mrcal", "pycolmap", "matplotlib", "trimesh", "reportlab"}


def test_the_package_is_typed() -> None:
    assert (Path(lpcal.__file__).parent / "py.typed").is_file()


def test_no_name_is_a_modules_too() -> None:
    """Once it is imported, a module of the package stands under its name there, whatever stood there before."""
    package = Path(lpcal.__file__).parent
    modules = {path.stem for path in package.iterdir() if path.suffix == ".py" or path.is_dir()} - set(lpcal.MODULES)
    assert not modules & set(lpcal.__all__)

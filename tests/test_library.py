"""The library's face: its names and signatures are frozen, its documentation runs, and it costs nothing to import."""

from __future__ import annotations

import doctest
import inspect

import pytest

import lpcal

SIGNATURES = {}
FUNCTIONS = [name for name in lpcal.__all__ if inspect.isfunction(getattr(lpcal, name))]
RECORDS = [name for name in lpcal.__all__ if inspect.isclass(getattr(lpcal, name))]


@pytest.mark.parametrize("name", [*FUNCTIONS, *RECORDS])
def test_examples_run(name: str) -> None:
    found = getattr(lpcal, name)
    examples = doctest.DocTestFinder(recurse=False).find(found, name, globs={})
    assert examples[0].examples, f"{name} has no example"
    for one in examples:
        result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(one)
        assert result.failed == 0

"""Every command of the table has its module."""

from __future__ import annotations

import importlib
import inspect

import pytest

from lpcal.cli.main import COMMANDS


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_a_module_with_its_words_and_its_run(command: str) -> None:
    module = importlib.import_module(f"lpcal.cli.{command.replace('import', 'import_')}")
    assert list(inspect.signature(module.add_arguments).parameters) == ["parser"]
    assert list(inspect.signature(module.run).parameters) == ["options", "progress"]

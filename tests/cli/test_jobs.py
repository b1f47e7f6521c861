"""``--jobs`` of the commands that share work among cores."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import pytest

from lpcal.cli.engine_words import add_cores, jobs_of
from lpcal.errors import UsageError
from lpcal.view.parallel import cores, run_all, workers


def asked(*words: Any) -> Any:
    parser = argparse.ArgumentParser()
    add_cores(parser, "the work")
    return jobs_of(parser.parse_args(words).jobs)


def test_a_number_of_cores_is_taken_and_nonsense_refused() -> None:
    assert asked() is None
    assert asked("--jobs", "3") == 3
    for text in ("0", "-1", "two", "1.5"):
        with pytest.raises(UsageError, match="no number of cores"):
            asked("--jobs=" + text)


def test_what_is_said_outside_holds_inside_unless_that_says_more() -> None:
    with cores(3):
        with cores(None):
            assert workers() == 3
        with cores(1):
            assert workers() == 1
    assert workers() >= 1


@pytest.mark.parametrize("count", [1, 2, 5])
def test_work_comes_back_in_its_order(count: Any) -> None:
    with cores(count):
        assert run_all(lambda k: k * k, range(20)) == [k * k for k in range(20)]


@pytest.mark.parametrize("command", ["intrinsics", "refine", "run", "reconstruct"])
def test_each_command_that_shares_work_takes_it(command: Any, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    code, told, _ = lpcal(command, "--help")
    assert code == 0
    assert "--jobs N" in told

"""What the README says is what lpcal does."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tour import README, differs, run, steps


@pytest.mark.slow
def test_the_tour_runs_and_prints_what_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    walked = steps(README.read_text(encoding="utf-8"))
    assert len(walked) > 8
    for step in walked:
        missing = differs(step.said, run(step))
        assert missing is None, f"{step.command} no longer prints: {missing}"


def test_every_command_is_on_the_page() -> None:
    from lpcal.cli.main import COMMANDS

    text = README.read_text(encoding="utf-8")
    assert [name for name in COMMANDS if f"lpcal {name}" not in text] == []


def test_links_of_the_page_lead_somewhere() -> None:
    text = README.read_text(encoding="utf-8")
    for link in re.findall(r"\]\(([^)#]+)\)", text):
        assert (README.parent / link).exists(), link

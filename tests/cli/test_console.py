"""Messages on a terminal and in a file."""

from __future__ import annotations

import io

import pytest

from lpcal.cli.console import fitted

LINES = (
    "warning: bust: the normals carry no standard deviations, and the distance is not measured by this method\n"
    "  needed: one of demo, new, board, design, intrinsics, check, handeye, wings, distance, refine, export, reconstruct\n"
    "  do: lpcal reconstruct objects/bust --calibration calib/calibration.yaml --output surfaces/bust --distance 350mm\n"
    "done"
)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_lines_fit_a_terminal_of_80_columns_and_commands_stay_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    found = fitted(LINES, Terminal())
    command = LINES.split("\n")[2]
    assert command in found.split("\n")
    assert max(len(line) for line in found.split("\n") if line != command) <= 80
    assert " ".join(found.split()) == " ".join(LINES.split())
    assert "\n  measured by" in found  # what follows stands under its line, further in
    assert found.endswith("\ndone")


def test_a_file_gets_lines_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert fitted(LINES, io.StringIO()) == LINES

"""How much of each room of lpcal the tests run: ``uv run python tools/coverage_rooms.py [pytest's words]``, a table in Markdown.

Lines that a test runs over lines that there are, by folder, with the modules of which least is run. Without words the default tests are
run; ``-m "slow or not slow"`` takes all, and a file or two what you work on. What a process that a test starts runs is counted only where
pytest-cov's own start-up is heeded, so figures of `cli` and `api/engines.py` are low.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
LEAST = 8
"""Modules that are named, those of which least is run."""


def measured(words: list[str]) -> dict[str, tuple[int, int]]:
    """Lines run and lines there are, by module's path within lpcal."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "coverage.json"
        command = [sys.executable, "-m", "pytest", "-q", "--cov=lpcal", f"--cov-report=json:{report}", *words]
        environment = os.environ | {"COVERAGE_CORE": "sysmon", "COVERAGE_FILE": str(Path(folder) / "data")}
        subprocess.run(command, cwd=REPOSITORY, check=False, env=environment, stdout=sys.stderr)
        files = json.loads(report.read_text(encoding="utf-8"))["files"]
    return {name.removeprefix("lpcal/"): (one["summary"]["covered_lines"], one["summary"]["num_statements"]) for name, one in files.items()}


def table(modules: dict[str, tuple[int, int]]) -> list[str]:
    """The lines of the table, and of the modules of which least is run."""
    rooms: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for name, counts in modules.items():
        rooms[name.split("/")[0] if "/" in name else "(top)"].append(counts)
        rooms["all"].append(counts)
    lines = ["| room | statements | run |", "|---|---|---|"]
    for room, counts in sorted(rooms.items(), key=lambda one: (one[0] == "all", one[0])):
        run, there = (sum(one[k] for one in counts) for k in (0, 1))
        lines.append(f"| {room} | {there} | {100 * run / max(there, 1):.0f} % |")
    least = sorted((run / there, name) for name, (run, there) in modules.items() if there)[:LEAST]
    return [*lines, "", "least: " + ", ".join(f"{name} {100 * share:.0f} %" for share, name in least)]


if __name__ == "__main__":
    print("\n".join(table(measured(sys.argv[1:]))))

"""Run the README's tour and write what it prints into the page: ``python tools/update_readme_tour.py``.

A block's lines are kept up to its first ``...``; a command without one gets its whole output.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "support"))
from tour import README, SKIPPED, run, steps


def main() -> None:
    """Rewrite the console blocks."""
    text = README.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for step in steps(text):
            before = "\n".join([f"$ {step.command}", *step.said])
            text = text.replace(before, "\n".join([f"$ {step.command}", *shortened(step.said, run(step))]), 1)
        os.chdir(README.parent)
    README.write_text(text, encoding="utf-8")


def shortened(said: list[str], printed: list[str]) -> list[str]:
    """The output as the page shows it: lines that stood on it stay by their first word, left-out stretches as ``...``."""
    if SKIPPED not in [line.strip() for line in said]:
        return printed
    wanted = [line.split()[:1] for line in said if line.strip() and line.strip() != SKIPPED]
    shown: list[str] = []
    for line in printed:
        if line.split()[:1] in wanted:
            shown.append(line)
        elif not shown or shown[-1] != SKIPPED:
            shown.append(SKIPPED)
    return shown


if __name__ == "__main__":
    main()

"""All benchmarks, one after another, each in a process of its own: ``python tools/bench.py [PART OF A NAME]``."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main(words: list[str]) -> int:
    """Run those whose name holds the word given, or all; the exit code is the worst."""
    chosen = [path for path in sorted(HERE.glob("bench_*.py")) if not words or words[0] in path.stem]
    worst = 0
    for path in chosen:
        print(f"== {path.stem}", flush=True)
        worst = max(worst, subprocess.run([sys.executable, str(path)], check=False).returncode)
    return worst if chosen else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

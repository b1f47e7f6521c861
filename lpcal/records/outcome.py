"""What a stage or a command returns to its caller."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

type Progress = Callable[[str, int, int], None]
"""Called with what is done, how much of it, and of how many."""


@dataclass(frozen=True)
class Outcome:
    """What was found: lines for people, a document for programs, warnings, and the command that comes next."""

    summary: list[str]
    document: dict[str, Any] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    next_command: str | None = None
    exit_code: int = 0


def silent(_what: str, _done: int, _total: int) -> None:
    """A progress callback that says nothing."""

"""What a file was made from, by what, and when."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

from lpcal import __version__


@dataclass(frozen=True)
class Provenance:
    """What a file was made from."""

    inputs: dict[str, str] = field(default_factory=dict)
    """sha256 by path, relative to the rig folder where it lies in it."""
    options: dict[str, Any] = field(default_factory=dict)
    lpcal_version: str = __version__
    time: str = field(default_factory=lambda: datetime.now(UTC).isoformat(timespec="seconds"))

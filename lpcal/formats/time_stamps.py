"""Times as people and loggers write them, as seconds: dates (``2026-01-05 03:49:50.755``, with a zone or without) and times of the day.

A date without a zone is taken as UTC: only differences count, for clocks of unlike epochs are lined up by the motion. A time of the day
that falls by more than half a day has passed midnight.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime

OF_THE_DAY = re.compile(r"(\d{1,2}):(\d{2}):(\d{2}(?:[.,]\d+)?)")
DATE = re.compile(r"(\d{4})[-/.](\d{2})[-/.](\d{2})[T ](\d{2}:\d{2}:\d{2})([.,]\d+)?(?:\s*(Z|[+-]\d{2}:?\d{2}))?")
DAY_S = 86400.0


def seconds_of(stamp: str) -> float | None:
    """Seconds since 1970 of a date, or since midnight of a time of the day; None where a text is neither."""
    text = stamp.strip()
    day = OF_THE_DAY.fullmatch(text)
    if day:
        hours, minutes, seconds = int(day[1]), int(day[2]), float(day[3].replace(",", "."))
        return 3600.0 * hours + 60.0 * minutes + seconds if hours < 24 and minutes < 60 and seconds < 61 else None
    date = DATE.fullmatch(text)
    if date is None:
        return None
    try:
        whole = datetime.fromisoformat(f"{date[1]}-{date[2]}-{date[3]}T{date[4]}{(date[6] or '').replace('Z', '+00:00')}")
    except ValueError:
        return None
    whole = whole if whole.tzinfo else whole.replace(tzinfo=UTC)
    return whole.timestamp() + float((date[5] or ".0").replace(",", "."))


def with_seconds(rows: Sequence[str], place: int) -> tuple[list[str], tuple[str, ...]]:
    """Rows of cells, commas between, their times in seconds where the first one's is a date or a time of the day; and that it was so.

    A cell that is none stays as it is, for whoever reads the rows to name.
    """
    first = next((cell for cell in (_cell(row, place) for row in rows) if cell), "")
    if seconds_of(first) is None:
        return list(rows), ()
    of_the_day = OF_THE_DAY.fullmatch(first) is not None
    found, days, before = [], 0, 0.0
    for row in rows:
        time_s, cells = seconds_of(_cell(row, place)), row.split(",")
        if time_s is not None:
            days += of_the_day and time_s < before - DAY_S / 2
            before = time_s
            cells[place] = f"{time_s + days * DAY_S:.6f}"
        found.append(",".join(cells))
    return found, ("times are of the day" if of_the_day else "times are dates",)


def _cell(row: str, place: int) -> str:
    cells = row.split(",")
    return cells[place].strip() if place < len(cells) else ""

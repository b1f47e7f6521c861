"""The table of formats in docs/how-to/formats.md, from the formats themselves: python tools/make_formats_table.py [--write]."""

from __future__ import annotations

import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs" / "how-to" / "formats.md"
BEGIN, END = "<!-- the table of formats -->", "<!-- its end -->"


def table() -> str:
    """The table, in Markdown."""
    from lpcal.formats.exchange import OWN

    rows = ["| `--format` | system and file | read too | keeps | loses |", "|---|---|---|---|---|"]
    rows += [f"| `{one.name}` | {one.title} | {'yes' if one.read else ''} | {one.keeps} | {one.loses} |" for one in OWN]
    return "\n".join(rows)


def page(text: str) -> str:
    """The page with the table as it is now."""
    head, _, rest = text.partition(BEGIN)
    return f"{head}{BEGIN}\n\n{table()}\n\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    written = page(PAGE.read_text(encoding="utf-8"))
    if "--write" in sys.argv:
        PAGE.write_text(written, encoding="utf-8")
    else:
        print(table())

"""Text as people's programs leave it, made the plain text that the readers read: UTF-8, commas, decimal points, no quotes, NFC.

A recording that went through a European or Windows program comes back with semicolons or tabs between its cells and commas in its numbers,
with cells in quotes, as UTF-16 or in a code page. Lines are never joined or dropped, so a line's number is that of the file.
"""

from __future__ import annotations

import codecs
import csv
import re
import unicodedata
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.named_files import did_you_mean

MOST_BYTES = 2 << 30
"""Bytes of the largest text that is read: four hours of forty markers at 240 Hz."""
LONGEST_LINE = 1 << 20
"""Characters of the longest line that is read: a recording of five thousand markers has less."""
MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""The byte order marks, and the encodings that they stand for; that of UTF-32 begins as that of UTF-16 does."""
CODE_PAGE = "cp1252"
"""The encoding that is taken for a text that is not UTF-8: Western Windows."""
NOT_TEXT = re.compile(r"[\x00-\x08\x0e-\x19\x1b-\x1f]")
"""Control characters that no text holds."""
MORE_CELLS = 1.3
"""Cells of a row of whole numbers, in those of the names above it, from which they are halves of numbers with decimal commas."""
SAMPLE_LINES = 40
"""Lines that are looked at to find the delimiter."""
DECIMAL_COMMA = re.compile(r"(?<![\d,.])([-+]?\d*),(\d+(?:[eE][-+]?\d+)?)(?![\d,.])")
"""A number with a comma for its point, between cells that something else divides."""


def read_text(path: Path, needed: str = "a text file") -> str:
    """The text of a file, whatever its encoding and line ends, in NFC.

    Raises
    ------
    InputError
        It is not there, cannot be read, is no text, or is larger than `MOST_BYTES`.
    """
    try:
        size = path.stat().st_size
        if size > MOST_BYTES:
            raise InputError(f"{size / 1e9:.1f} GB", where=str(path), needed=f"{needed} of at most {MOST_BYTES / 1e9:.1f} GB")
        data = path.read_bytes()
    except FileNotFoundError as error:
        raise InputError("no such file", where=str(path), needed=needed, todo=did_you_mean(path, "correct the name")) from error
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", where=str(path), needed=needed) from error
    return decode(data, path, needed)


def decode(data: bytes, path: Path, needed: str = "a text file") -> str:
    """Bytes as text, by their mark, as UTF-8, or as Windows' code page; line ends are made plain.

    Raises
    ------
    InputError
        The bytes are no text, or a line has no end.
    """
    marked = next((name for mark, name in MARKS if data.startswith(mark)), None)
    if marked is None and b"\x00" in data[:200]:
        marked = "utf-16-le" if data[1:2] == b"\x00" else "utf-16-be"
    try:
        text = data.decode(marked or "utf-8")
    except UnicodeDecodeError:
        text = data.decode(CODE_PAGE, errors="replace")
    found = NOT_TEXT.search(text)
    if found:
        line = text.count("\n", 0, found.start()) + 1
        raise InputError(
            f"not text: a control character in line {line}", where=str(path), needed=needed, todo="is it another kind of file?"
        )
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if max(map(len, text.split("\n"))) > LONGEST_LINE:
        raise InputError("not text: a line without an end", where=str(path), needed=needed, todo="is it another kind of file?")
    return text if text.isascii() else unicodedata.normalize("NFC", text)


def with_commas(text: str, path: Path) -> str:
    """A table of cells, whatever stands between them, as cells with commas between: decimal points, no quotes, the same lines.

    Raises
    ------
    InputError
        Commas stand both between the cells and in the numbers, so that it is open which is which.
    """
    delimiter = delimiter_of(text)
    if delimiter == "," and '"' not in text:
        _refuse_decimal_commas(text, path)
        return text
    if delimiter != "," and '"' not in text:
        return decimal_points(text).replace(",", " ").replace(delimiter, ",")
    lines, opened = [], False
    for line in text.split("\n"):
        if '"' not in line:
            lines.append(line if delimiter == "," else decimal_points(line).replace(",", " ").replace(delimiter, ","))
            opened = opened and not line.strip()
            continue
        whole = _closed(line, delimiter) if opened else line
        opened = whole.count('"') % 2 == 1
        cells = next(csv.reader([whole], delimiter=delimiter, strict=False), [])
        lines.append(",".join(decimal_points(cell).replace(",", " ") for cell in cells))
    plain = "\n".join(lines)
    if delimiter == ",":
        _refuse_decimal_commas(plain, path)
    return plain


def _closed(line: str, delimiter: str) -> str:
    """A line under a line whose last quotes stay open: what closes them here is taken away, or what they hold is put in quotes."""
    if line == '"' or line.startswith((f'"{delimiter}', '""')):
        return line[1:]
    return line if line.startswith('"') else f'"{line}'


def delimiter_of(text: str) -> str:
    """What stands between the cells of a table: the sign among ; tab and comma that most lines have, in that order of trust."""
    lines = [line for line in text[: 1 << 18].split("\n") if line.strip()][:SAMPLE_LINES]
    if not lines:
        return ","
    has = {sign: sum(sign in line for line in lines) for sign in ";\t,"}
    return next((sign for sign in ";\t" if has[sign] > len(lines) / 2), ",")


def decimal_points(text: str) -> str:
    """Numbers with a decimal comma, between cells that no comma divides, with a decimal point."""
    return DECIMAL_COMMA.sub(r"\1.\2", text) if "," in text else text


def _refuse_decimal_commas(text: str, path: Path) -> None:
    """A row of numbers with about twice the cells of the row above it, and not a point among them."""
    before = 0
    for number, line in enumerate(text[: 1 << 18].split("\n")[:SAMPLE_LINES], start=1):
        cells = line.rstrip(", ").split(",")
        whole = len(cells) > 3 and all(re.fullmatch(r"\s*[-+]?\d*\s*", cell) for cell in cells)
        if whole and before and len(cells) >= MORE_CELLS * before:
            raise InputError(
                f"{len(cells)} cells under {before} names: decimal commas between commas",
                where=f"{path}:{number}",
                needed="a decimal point, or ; between the cells",
                todo="export it again with decimal points",
            )
        before = len(cells) if not whole and any(cell.strip() for cell in cells) else before

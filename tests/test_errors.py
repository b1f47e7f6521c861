"""One message: short whatever a file holds, on the lines that it is meant to have, without control characters."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from lpcal.errors import MOST_CHARACTERS, InputError


@given(st.text(max_size=3000), st.text(max_size=3000), st.text(max_size=3000), st.text(max_size=3000))
def test_a_message_is_short_and_printable(found: str, where: str, needed: str, todo: str) -> None:
    message = str(InputError(found, where=where, needed=needed, todo=todo))
    assert len(message) <= MOST_CHARACTERS
    assert all(letter.isprintable() or letter == "\n" for letter in message)
    assert message.count("\n") <= 2


def test_a_long_part_loses_its_middle_and_the_others_stay() -> None:
    message = str(InputError("'" + "9" * 5000 + "' in column 5", where="mocap.csv:7", needed="a number", todo="is the file cut off?"))
    assert message.startswith("mocap.csv:7: '999")
    assert "999' in column 5\n  needed: a number\n  do: is the file cut off?" in message
    assert " ... " in message


def test_a_short_message_is_as_it_was_written() -> None:
    assert str(InputError("a bare number, 25", where="a.yaml:1", needed="a length", todo="write 25 mm")) == (
        "a.yaml:1: a bare number, 25\n  needed: a length\n  do: write 25 mm"
    )

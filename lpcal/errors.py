"""Everything that can go wrong, by the exit code it ends with.

::

    LpcalError                     1  never raised itself
    |-- UsageError                 2  the command's words are off
    |-- InputError                 3  an input is missing, unreadable, or not what a file of its kind holds
    |-- DegenerateError            4  too few data, or data that cannot determine what is asked
    |-- ConvergenceError           5  the solve did not converge, or failed its quality gate
    `-- DisagreementError          6  two inputs contradict each other: units, sizes, names, clocks

One message says what was found, where, what was needed and what to do::

    raise InputError("a bare number, 25", where="panel.yaml:12, board.square", needed="a length with its unit",
                     todo="write 25 mm")
"""

from __future__ import annotations

from functools import partial

__all__ = ["ConvergenceError", "DegenerateError", "DisagreementError", "InputError", "LpcalError", "UsageError"]

MOST_CHARACTERS = 590
"""Characters of a message: with the program's name before it, 600, which is what a reader takes in at once."""
ELLIPSIS = " ... "


class LpcalError(Exception):
    """An error that the user can correct.

    Parameters
    ----------
    found : str
        What was found, in words.
    where : str
        File and line, key, image or light.
    needed : str
        What would have been right.
    todo : str
        What to do about it.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> try:
    ...     lpcal.integrate(np.zeros((4, 4)))
    ... except lpcal.errors.LpcalError as error:
    ...     print(type(error).__name__, error.exit_code, error.found, sep="; ")
    InputError; 3; an array of (4, 4)
    """

    exit_code = 1

    def __init__(self, found: str, *, where: str = "", needed: str = "", todo: str = "") -> None:
        self.found, self.where, self.needed, self.todo = found, where, needed, todo
        super().__init__(self.message())

    def __reduce__(self) -> tuple[partial[LpcalError], tuple[str]]:
        """How it goes from one process to another, whole."""
        return partial(type(self), where=self.where, needed=self.needed, todo=self.todo), (self.found,)

    def message(self) -> str:
        """Where it is, what was found, what was needed and what to do, on as few lines as it takes, and never on more than a screen.

        What comes from a file may be of any length and hold any character: long parts lose their middles, and what cannot be
        printed is shown as ?.
        """
        parts = [printable(part) for part in (self.where, self.found, self.needed, self.todo)]
        while sum(map(len, parts)) > MOST_CHARACTERS - len(": \n  needed: \n  do: "):
            longest = max(range(len(parts)), key=lambda k: len(parts[k]))
            parts[longest] = without_middle(parts[longest], 3 * len(parts[longest]) // 4)
        where, found, needed, todo = parts
        lines = [f"{where}: {found}" if where else found]
        lines += [f"  needed: {needed}"] if needed else []
        lines += [f"  do: {todo}"] if todo else []
        return "\n".join(lines)


def printable(text: str) -> str:
    """A text on one line, without control characters."""
    return "".join(letter if letter.isprintable() else "?" for letter in " ".join(text.split()))


def without_middle(text: str, length: int) -> str:
    """A text cut to a length at its middle."""
    kept = max(length - len(ELLIPSIS), 2) // 2
    return text if len(text) <= length else text[:kept] + ELLIPSIS + text[-kept:]


class UsageError(LpcalError):
    """The command's words are off."""

    exit_code = 2


class InputError(LpcalError):
    """An input is missing, unreadable, or not what a file of its kind holds."""

    exit_code = 3


class DegenerateError(LpcalError):
    """Too few data, or data that cannot determine what is asked."""

    exit_code = 4


class ConvergenceError(LpcalError):
    """A solve did not converge, or failed its quality gate."""

    exit_code = 5


class DisagreementError(LpcalError):
    """Two inputs contradict each other: units, sizes, names, clocks."""

    exit_code = 6

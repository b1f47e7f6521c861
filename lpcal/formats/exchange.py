"""Other systems' formats that lpcal writes: one entry a format, lpcal's own and those that others add.

An entry point of the group ``lpcal.formats`` names an `ExchangeFormat`; a program registers one with `register`. A format that was added
stands for lpcal's own of the same name.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from lpcal.errors import UsageError
from lpcal.formats.installed import installed
from lpcal.records.calibration import Calibration
from lpcal.records.exchange import ExchangeContent, Part

GROUP = "lpcal.formats"
"""The entry points of installed packages among which formats are looked for."""


@dataclass(frozen=True)
class ExchangeFormat:
    r"""A format of another system's.

    Parameters
    ----------
    name : str
        The word that asks for it: ``--format NAME``.
    title : str
        The system and its file.
    needs : tuple of str
        What there must be to write: ``camera``, ``hand-eye``, ``lights``, ``near lights``, ``surface``, ``metric surface``, ``capture``.
    keeps, loses : str
        What of a calibration a file holds, and what it has no place for.
    write : callable
        ``write(content: ExchangeContent, folder: Path) -> list[str]``: writes its files or folders into an empty folder; what it returns
        is said to the user: what was changed or lost of this very calibration.
    read : callable, optional
        ``read(path: Path) -> Calibration``: reads one back.
    recognise : callable, optional
        ``recognise(path: Path) -> bool``: whether a file or folder is one; never raises.

    Examples
    --------
    >>> import lpcal
    >>> def write(content, folder):
    ...     (folder / "lights.csv").write_text("".join(f"{light.name}\\n" for light in content.calibration.lights))
    ...     return []
    >>> lpcal.ExchangeFormat("names", "a list of the lights", ("lights",), "names", "all else", write).name
    'names'
    """

    name: str
    title: str
    needs: tuple[Part, ...]
    keeps: str
    loses: str
    write: Callable[[ExchangeContent, Path], list[str]]
    read: Callable[[Path], Calibration] | None = None
    recognise: Callable[[Path], bool] | None = None

    def lacking(self, content: ExchangeContent) -> list[Part]:
        """What there is not of all that it needs."""
        return [part for part in self.needs if content.lacks(part)]


ADDED: dict[str, ExchangeFormat] = {}
"""Formats that this program has registered, by name."""


def register(added: ExchangeFormat) -> None:
    """Add a format, or another one under its name."""
    ADDED[added.name] = added


def known_formats() -> dict[str, ExchangeFormat]:
    """All formats by name: lpcal's own in their order, then those of installed packages, then the program's.

    Raises
    ------
    InputError
        An installed package names what is no format.
    """
    from lpcal.formats.exchange_own import OWN

    return {one.name: one for one in (*OWN, *of_packages())} | ADDED


def of_packages() -> tuple[ExchangeFormat, ...]:
    """The formats of installed packages."""
    return installed(GROUP, ExchangeFormat, "an ExchangeFormat")


def formats_of(names: list[str]) -> list[ExchangeFormat]:
    """The formats of these names, each once.

    Raises
    ------
    UsageError
        No format has a name; near ones are named.
    """
    from difflib import get_close_matches

    known = known_formats()
    for name in names:
        if name not in known:
            near = get_close_matches(name.lower(), known, n=3)
            todo = f"did you mean {' or '.join(near)}?" if near else "lpcal export --list names them"
            raise UsageError(f"no format is called {name}", needed=f"one of {', '.join(known)}", todo=todo)
    return [known[name] for name in dict.fromkeys(names)]

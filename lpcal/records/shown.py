"""Records as people see them: one screen of figures in a console, a table and a picture in a notebook."""

from __future__ import annotations


class Shown:
    """A record that prints as one screen: `lpcal.records.screens` says what stands there.

    The dataclass of such a record is made with ``repr=False``, or its own repr, every number of every array, would come first.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        """One screen of figures, with standard deviations where they are known."""
        from lpcal.records import screens

        return screens.text(self)

    def _repr_html_(self) -> str:
        """The same as a table, with a picture where the record has one."""
        from lpcal.records import screens

        return screens.html(self)

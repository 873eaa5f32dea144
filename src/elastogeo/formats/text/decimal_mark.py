"""The decimal mark of a text, learnt from its numbers: a point or a comma, never both, never one for thousands."""

from __future__ import annotations

import re

from elastogeo.errors import FormatError

_SURELY_DECIMAL = re.compile(r",(?!\d\d\d)|,\d{3}[\deE]|(?<!\d),|\d{4},|(?<!\d)0\d*,", re.ASCII)
_MARKS = {",": ",", "comma": ",", ".": ".", "point": "."}


class DecimalMark:
    """The decimal mark of a text, learnt from its numbers, and whether a comma has shown that it is not one for thousands.

    Attributes
    ----------
    mark : str
        `,` or `.`; empty until a number has shown one.
    """

    def __init__(self, said: str = "") -> None:
        """Take what the text says of itself: `comma`, `point`, or nothing."""
        self.mark = _MARKS.get(said.lower(), "")
        self.sure = self.mark != ""
        self.doubtful = ""

    def allows(self, mark: str) -> bool:
        """Whether a number with this mark (empty: with none) fits those before it."""
        return not mark or self.mark in ("", mark)

    def settle(self, mark: str, text: str) -> None:
        """Learn from a text whose numbers have this mark."""
        self.mark = self.mark or mark
        if mark == "," and not self.sure:
            self.sure = _SURELY_DECIMAL.search(text) is not None
            if not self.doubtful and (found := re.search(r"\d{1,3},\d{3}", text)):
                self.doubtful = found[0]

    def check(self, source: str) -> None:
        """Raise a `FormatError` if the commas may as well be marks for thousands."""
        if self.mark == "," and not self.sure:
            raise FormatError(
                f"{source}: the commas, as in {self.doubtful[:40]!r}, may be decimal marks or marks for "
                "thousands; say which by a line '# decimal: comma' above the header, or write the numbers without commas"
            )


def mark_of(cell: str) -> str:
    """The decimal mark that a plain number shows; empty if it has none."""
    return "," if "," in cell else "." if "." in cell else ""

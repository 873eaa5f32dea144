"""What the compensation files of a SINUMERIK have in common: a first line that says what for, assignments, and M17."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.machine import Array

_CHANNEL, _END = "CHANDATA(1)", "M17"


@dataclass(frozen=True, slots=True)
class IniFile:
    """The file of one kind of compensation.

    Attributes
    ----------
    head : str
        Its first line.
    title : str
        What people call the compensation, for messages.
    """

    head: str
    title: str

    def can_read(self, head: bytes) -> bool:
        """Whether a file that begins with these bytes is one."""
        return head.startswith(self.head.encode())

    def text(self, assignments: Iterable[str]) -> bytes:
        """The file with these lines."""
        return "\n".join([self.head, _CHANNEL, *assignments, _END, ""]).encode()

    def assignments(self, data: bytes, source: str) -> Iterator[tuple[str, str]]:
        """Each line of a file, behind where it stands.

        Raises
        ------
        FormatError
            If the file is cut off.
        """
        lines = data.decode("ascii", "replace").split("\n")
        if len(lines) < 2 or lines[-2:] != [_END, ""]:
            raise FormatError(f"{source}: does not end with M17 on a line of its own; it may be cut off, copy it again")
        for k, line in enumerate(lines[:-2], 1):
            if line not in (self.head, _CHANNEL):
                yield f"{source}, line {k}", line

    def unknown(self, line: str, where: str) -> FormatError:
        """The error of a line that such a file does not have."""
        return FormatError(f"{where}: {line[:60]!r} is nothing that {self.title} has; take it out")


def even_column(
    values: Mapping[int, float], low: float, high: float, step: float, what: str, source: str
) -> tuple[Array, Array]:
    """Positions from MIN to MAX at STEP, and the value at each by its number, shape (n,) each, in the unit of the control.

    Raises
    ------
    FormatError
        If there are more or fewer values than positions.
    """
    count = round((high - low) / step) + 1 if step > 0 else 0
    if sorted(values) != list(range(count)):
        raise FormatError(f"{source}: {what} has {len(values)} points where MIN, MAX and STEP make {count}; correct them")
    return low + step * np.arange(count, dtype=float), np.array([values[k] for k in range(count)])

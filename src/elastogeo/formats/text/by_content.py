"""Which format a file is of, told from its content and never from its name: what run files and log files share."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Protocol, TypeVar

from elastogeo.errors import FormatError
from elastogeo.formats.text.files_read import may_open, noted

HEAD = 65_536
"""Bytes from the beginning of a file that a detector sees."""

MAX_BYTES = 100_000_000


class Detected(Protocol):
    """What a format says of itself."""

    @property
    def name(self) -> str:
        """What people call it."""

    @property
    def suffix(self) -> str:
        """The usual end of its file names, with the dot."""

    @property
    def can_read(self) -> Callable[[bytes], bool]:
        """Whether a file that begins with these bytes is of this format."""


F = TypeVar("F", bound=Detected)


def add(formats: dict[str, F], one: F) -> None:
    """Add a format to a register.

    Raises
    ------
    FormatError
        If another has the same name.
    """
    if one.name in formats:
        raise FormatError(f"a format named {one.name!r} is registered already; give yours another name")
    formats[one.name] = one


def opened(path: str | Path, source: str) -> bytes:
    """The bytes of a file, one more than `MAX_BYTES` at the most.

    Raises
    ------
    FormatError
        If it cannot be opened.
    """
    may_open(path)
    try:
        with open(path, "rb") as file:
            return noted(path, file.read(MAX_BYTES + 1))
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise FormatError(f"{source}: cannot be opened ({reason}); check the path and its permissions") from None


def claiming(formats: Mapping[str, F], data: bytes) -> list[F]:
    """The formats that claim the bytes of a file."""
    return [one for one in formats.values() if one.can_read(data[:HEAD])]


def format_of(
    formats: Mapping[str, F],
    data: bytes,
    source: str,
    explain: Callable[[bytes], str],
    claimed: Sequence[F] | None = None,
) -> F:
    """The one format that claims these bytes.

    Parameters
    ----------
    formats : mapping of str to format
    data : bytes
        The whole file.
    source : str
        Where they came from, for messages.
    explain : callable
        What a file is that none of them reads, and what to do; empty if that cannot be told.
    claimed : sequence of format, optional
        What `claiming` gave, if it was asked already.

    Raises
    ------
    FormatError
        If the file is empty or too large, or none or more than one claims it.
    """
    if len(data) > MAX_BYTES:
        raise FormatError(f"{source}: is larger than {MAX_BYTES // 1_000_000} MB; split it into several files")
    if not data:
        raise FormatError(f"{source}: the file is empty; copy or export it again")
    found = claiming(formats, data) if claimed is None else claimed
    if len(found) == 1:
        return found[0]
    known = ", ".join(f"{one.name} ({one.suffix})" for one in formats.values())
    if found:
        claims = " and ".join(one.name for one in found)
        raise FormatError(f"{source}: could be {claims}, so it is not read; export it in one of the formats {known}")
    why = explain(data)
    raise FormatError(f"{source}: {why or f'begins with {data[:20]!r}, which no known format does; known are {known}'}")

"""Which files a document is read from, as the readers themselves open them: what has to be kept to read it again.

Every file of this room is opened in one of a few places (documents, run files and logs, parts of recordings), and each of
them notes it here. So the list is right for every instrument and format, those to come included. For what somebody sent, the
same places open nothing outside of it: a document may name any path.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from elastogeo.errors import FormatError

_SHIPPED = Path(__file__).resolve().parents[1]
_TOP: ContextVar[Path | None] = ContextVar("the folder outside of which nothing is opened", default=None)
_NOTES: ContextVar[dict[Path, str] | None] = ContextVar("files read", default=None)


@contextmanager
def files_read() -> Iterator[dict[Path, str]]:
    """The files that are opened inside, each with the SHA-256 of the bytes that were read.

    Paths stand as the readers made them: the folder of the document, and what it says behind it. What ships with elastogeo
    is among them.

    Yields
    ------
    dict of Path to str
        It grows while files are read.
    """
    found: dict[Path, str] = {}
    token = _NOTES.set(found)
    try:
        yield found
    finally:
        _NOTES.reset(token)


@contextmanager
def confined_to(folder: str | Path) -> Iterator[None]:
    """Let nothing be read inside that lies outside of a folder, but for what ships with elastogeo.

    Parameters
    ----------
    folder : str or Path
        It holds what somebody sent, and no links.
    """
    token = _TOP.set(Path(os.path.normpath(Path(folder).absolute())))
    try:
        yield
    finally:
        _TOP.reset(token)


def may_open(path: str | Path) -> None:
    """Refuse a path that leads out of the folder in which reading stays, if it stays in one.

    Raises
    ------
    FormatError
        Before anything there is looked at; whether it exists is not told.
    """
    top = _TOP.get()
    if top is None:
        return
    place = Path(os.path.normpath(Path(path).absolute()))
    if not place.is_relative_to(top) and not place.is_relative_to(_SHIPPED):
        raise FormatError(
            f"{os.path.relpath(place, top)}: lies outside of what was sent; "
            f"send the file too, beside the test, and name it from there"
        )


def noted(path: str | Path, data: bytes) -> bytes:
    """The same bytes, noted as those of a file if somebody wants to know.

    Raises
    ------
    FormatError
        If the file was read before, and was another.
    """
    found = _NOTES.get()
    if found is not None:
        sha256 = hashlib.sha256(data).hexdigest()
        if found.setdefault(Path(path), sha256) != sha256:
            raise FormatError(f"{path}: changed while it was read; read it again when it is whole")
    return data

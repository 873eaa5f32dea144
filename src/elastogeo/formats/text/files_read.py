"""Which files a document is read from, as the readers themselves open them: what has to be kept to read it again.

Every file of this room is opened in one of a few places (documents, run files and logs, parts of recordings), and each of
them notes it here. So the list is right for every instrument and format, those to come included.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from elastogeo.errors import FormatError

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

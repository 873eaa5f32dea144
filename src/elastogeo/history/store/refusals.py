"""What a database says when it cannot, in the words of this program."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from sqlalchemy.exc import DBAPIError, IntegrityError
from sqlalchemy.exc import TimeoutError as NoConnection

from elastogeo.errors import StoreError

_SAID = {
    "is locked": "another program has held it for half a minute; wait until it is done, or close it",
    "lock timeout": "another program has held it for half a minute; wait until it is done, or close it",
    "is full": "there is no room on the disk; nothing was kept of this step; free some, then repeat it",
    "no space left": "there is no room on the server's disk; nothing was kept of this step; free some, then repeat it",
    "disk i/o error": "the disk failed while it was read or written; check the disk, then: elastogeo history verify",
    "input/output error": "the server's disk failed; nothing was kept of this step; check that disk, then repeat it",
    "is malformed": "is damaged; restore it from a backup: elastogeo history restore",
    "not a database": "is no file of SQLite, or is damaged; name the right file, or restore it from a backup",
    "permission denied for schema": (
        "this user may not make tables in this database; let its owner say: GRANT CREATE ON SCHEMA public TO the user"
    ),
    "permission denied": "this user may not do this in the database; let its owner grant it",
    "read-only transaction": "may only be read here; name the server that is written to, or ask for the right to write",
    "readonly": "may only be read here; ask for the right to write the file and its folder",
    "unable to open": "cannot be opened; ask for the right to read and write the file and its folder",
}


@contextmanager
def in_words(url: str, writes: bool) -> Iterator[None]:
    """Turn what a database refuses into a `StoreError`; a broken rule of the schema stays what it is.

    Raises
    ------
    StoreError
    """
    try:
        yield
    except IntegrityError:
        raise
    except NoConnection as error:
        raise StoreError(f"{url}: too many ask it at once; wait, then try again") from error
    except UnicodeEncodeError as error:
        raise StoreError(
            f"{str(error.object)[:80]!r} holds bytes that are no text in UTF-8; rename it, then repeat"
        ) from error
    except DBAPIError as error:
        said = " ".join(str(error.orig).split())
        if not writes and ("readonly" in said or "read-only" in said):
            raise StoreError(
                f"{url}: was to be written while it was only read: a fault of elastogeo, please report it"
            ) from error
        for part, words in _SAID.items():
            if part in said.lower():
                raise StoreError(f"{url}: {words}") from error
        if error.statement is None or error.connection_invalidated:
            raise StoreError(f"{url}: cannot be reached: {said}; check the address, and that the server runs") from error
        raise StoreError(f"{url}: the database says: {said}; nothing was kept of this step") from error

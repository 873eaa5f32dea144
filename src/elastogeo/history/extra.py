"""What the history needs beyond the core, and what to say when it is not there."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from elastogeo.errors import StoreError

_EXTRAS = {"sqlalchemy": "history", "alembic": "history", "psycopg": "postgresql", "argon2": "web"}


class MissingHistoryExtraError(StoreError):
    """The history was asked for and needs packages that are not installed."""


@contextmanager
def needs_history_extra() -> Iterator[None]:
    """Run imports that need the extra `history`, or `postgresql`.

    Raises
    ------
    MissingHistoryExtraError
        If SQLAlchemy, Alembic or psycopg is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        missing = (error.name or "").partition(".")[0]
        if missing not in _EXTRAS:
            raise
        raise MissingHistoryExtraError(
            f"the history needs {missing}, which is not installed; "
            f"install it with: pip install 'elastogeo[{_EXTRAS[missing]}]'"
        ) from error

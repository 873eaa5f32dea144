"""The store of machines, tests and results: what was measured, when, by what it was evaluated, and what was done about it.

One file of SQLite, or PostgreSQL, by the same code (SQLAlchemy Core). Raw files lie beside it under their hash and are never
altered. Fills the results of `changes` and keeps the JSON of the views of `report`; the command line and the pages open it.
The ground wing is `store`: tables, engine, migrations, files, audit trail. SQLAlchemy and Alembic come with the extra
`history`.
"""

from typing import TYPE_CHECKING, Any

from elastogeo.discovery import first_use
from elastogeo.history.extra import needs_history_extra

if TYPE_CHECKING:
    from elastogeo.history.history import Added, History
    from elastogeo.history.intake.machines import KnownMachine
    from elastogeo.history.store import Store

_found = first_use(__name__, {"history": "Added History", "intake.machines": "KnownMachine", "store.opening": "Store"})

__all__ = ["Added", "History", "KnownMachine", "Store"]


def __getattr__(name: str) -> Any:
    """Import a name of the face where it is used first (PEP 562)."""
    with needs_history_extra():
        return _found(name)

"""The ground of the history: its tables, how a database is opened and migrated, the raw files, the audit trail."""

from typing import TYPE_CHECKING, Any

from elastogeo.discovery import first_use
from elastogeo.history.extra import needs_history_extra

if TYPE_CHECKING:
    from elastogeo.history.store.clock import now
    from elastogeo.history.store.editions import edition
    from elastogeo.history.store.files import Files
    from elastogeo.history.store.making import Made, make_store
    from elastogeo.history.store.opening import Store, fill_store, open_store, read, write

_found = first_use(
    __name__,
    {
        "clock": "now",
        "editions": "edition",
        "files": "Files",
        "making": "Made make_store",
        "opening": "Store fill_store open_store read write",
    },
)

__all__ = ["Files", "Made", "Store", "edition", "fill_store", "make_store", "now", "open_store", "read", "write"]


def __getattr__(name: str) -> Any:
    """Import a name of the face where it is used first (PEP 562)."""
    with needs_history_extra():
        return _found(name)

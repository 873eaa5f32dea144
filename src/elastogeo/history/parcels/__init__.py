"""What somebody sent: kept in a folder of its own until it is looked into, confirmed and imported, or a day old.

`staging` takes it as it comes, `unpacking` lays it out, `recognising` says what it is. The jobs `look` and `import` do the
rest. Nothing that was sent is believed: not its names, sizes or counts, and no path in it leads out of its folder.
"""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.history.parcels.staging import LARGEST, MOST_FILES, Arriving, arriving, sweep_parcels, too_large

__all__ = ["LARGEST", "MOST_FILES", "Arriving", "arriving", "sweep_parcels", "too_large"]

__getattr__ = first_use(__name__, {"staging": "Arriving LARGEST MOST_FILES arriving sweep_parcels too_large"})

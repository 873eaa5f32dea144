"""The register of families of error sources. A new one is a file of this room with a function that registers itself:

    @family
    def thermal_growth(machine):
        for joint in machine.joints:
            yield Source(f"E_T{joint.name}", "mm/K", ("motion", joint.name), 0, temperature, "thermal growth")

Nothing else changes: the catalogue lists it, patterns select it, the contract suite tests it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from elastogeo.discovery import import_all

if TYPE_CHECKING:
    from elastogeo.machine import Machine
    from elastogeo.sources.source import Source

Family = Callable[["Machine"], Iterator["Source"]]
Named = Callable[["Machine", str], "Source | None"]
_REGISTER: dict[str, Family] = {}
_NAMED: dict[str, Named] = {}


def family(sources: Family) -> Family:
    """Register a function that yields the sources of a machine."""
    _REGISTER[sources.__name__] = sources
    return sources


def named(source: Named) -> Named:
    """Register a function that makes a source from a name that no listing holds (any degree, any exponent), or None."""
    _NAMED[source.__name__] = source
    return source


def source_named(machine: Machine, name: str) -> Source | None:
    """The source that a name means although no family lists it, or None."""
    families()
    return next((source for make in _NAMED.values() if (source := make(machine, name)) is not None), None)


def families() -> dict[str, Family]:
    """All families by name; every file of this room and its wings is looked at."""
    import_all(__name__.rpartition(".")[0])
    return dict(_REGISTER)

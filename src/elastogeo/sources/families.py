'''The register of families of error sources: found and registered by themselves, in all files of this room and its wings.

To add one, write one file with a function that registers itself. Nothing else changes: the catalogue lists its sources,
patterns select them, the contract suite in `tests/sources/test_contract.py` tests them. A complete one,
`sliding_compliance.py`::

    """Compliance along an axis that changes as it travels: `CQ_XXX` is what C_XXX gains per mm from the test's centre."""

    from dataclasses import dataclass

    from elastogeo.machine import COMPONENTS
    from elastogeo.sources import Source, family


    @dataclass(frozen=True)
    class LoadTimesTravel:
        axis: str
        component: int

        def __call__(self, situation):
            return situation.load(self.axis)[:, self.component] * situation.from_centre(self.axis)


    @family
    def sliding_compliance(machine):
        for joint in machine.joints:
            if not joint.is_rotary:
                letter = COMPONENTS[joint.direction]
                yield Source(
                    name=f"CQ_{letter}{letter}{joint.name}",
                    unit="mm/N/mm",
                    site=("motion", joint.name),
                    component=joint.direction,
                    driver=LoadTimesTravel(joint.name, joint.direction),
                    meaning=f"what C_{letter}{letter}{joint.name} gains along the travel of {joint.name}",
                    load=joint.direction,
                    force_degree=1.0,
                )
'''

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

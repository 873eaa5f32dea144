"""Why a compliance is known by no test between tool and workpiece, and what reading elsewhere would tell it: as facts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array, Machine, Point
from elastogeo.planning.ceilings import Ceiling
from elastogeo.sources import Source

LEVER = 100.0
"""Distance [mm] of the second probe that is proposed for a rotation."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """Two sums of compliances, of neighbours in the loop: what the one gains and the other loses moves no reading.

    Attributes
    ----------
    gained, lost : mapping of str to float
        Coefficients by name: of the neighbour nearer to the tool, and of the one nearer to the workpiece.
    slides, turns : tuple of str
        The linear and the rotary axes that move between the two, and leave the exchanged as it is.
    """

    gained: Mapping[str, float]
    lost: Mapping[str, float]
    slides: tuple[str, ...]
    turns: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Probe:
    """A displacement probe across one joint, in the frame of its carriage: an instrument `joint-probe`.

    Attributes
    ----------
    across : str
        The axis.
    sensor : tuple of 3 float
        Unit vector along which it reads.
    point : tuple of 3 float [mm]
        Where it touches.
    """

    across: str
    sensor: Point
    point: Point = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Remedy:
    """What readings elsewhere tell a compliance by itself.

    Attributes
    ----------
    probes : tuple of Probe
        One at the frame's origin for a translation: there it sees no rotation of the joint, anywhere else it does. For a
        rotation two, a lever apart; their difference over the lever.
    known : tuple of str
        All compliances that become known by themselves, as far as loads drive them.
    gain : int
        By how much the ceiling of the rank grows.
    """

    probes: tuple[Probe, ...]
    known: tuple[str, ...]
    gain: int


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a compliance is never known by itself from tests between tool and workpiece.

    Attributes
    ----------
    name : str
    displacement, load : int
        Its components, 0 to 5 for X Y Z A B C.
    alike : tuple of str
        Compliances that make the very same trace in every such test, this one among them; empty if none does.
    exchanges : tuple of Exchange
        With its neighbours, those that change it.
    remedy : Remedy or None
        None for a place, across which no probe sits.
    """

    name: str
    displacement: int
    load: int
    alike: tuple[str, ...]
    exchanges: tuple[Exchange, ...]
    remedy: Remedy | None


def reason_for(machine: Machine, found: Ceiling, name: str) -> Reason | None:
    """Why a compliance is never known by itself; None if the best tests between tool and workpiece tell it.

    Parameters
    ----------
    machine : Machine
    found : Ceiling
        Of that machine.
    name : str
        Of a compliance of a joint or a place; of a reciprocal pair that of the one that stands for both.

    Raises
    ------
    InputError
        If it is none.
    """
    if not found.unseen(name):
        return None
    source = found.sources[found.labels.index(name)]
    return Reason(
        name=name,
        displacement=source.component,
        load=source.load or 0,
        alike=next((group for group in found.alike(found.labels) if name in group), ()),
        exchanges=tuple(_exchanges(machine, found, name)),
        remedy=_remedy(found, source) if source.site[0] == "motion" else None,
    )


def _exchanges(machine: Machine, found: Ceiling, name: str) -> Iterator[Exchange]:
    at = found.labels.index(name)
    rotary = {joint.name for joint in machine.joints if joint.is_rotary}
    for pair in found.pairs:
        nearer = np.array([source.site[1] == pair.second for source in found.sources])
        for row in pair.exchanges[pair.exchanges[:, at] != 0]:
            yield Exchange(
                gained={found.labels[k]: float(row[k]) for k in np.flatnonzero(row * nearer)},
                lost={found.labels[k]: float(-row[k]) for k in np.flatnonzero(row * ~nearer)},
                slides=tuple(axis for axis in pair.moving if axis not in rotary),
                turns=tuple(axis for axis in pair.moving if axis in rotary),
            )


def _remedy(found: Ceiling, source: Source) -> Remedy:
    axis = source.site[1]
    probes = _probes(axis, source.component)
    seen = {source.component, *(int(np.argmax(probe.sensor)) for probe in probes)}
    known = tuple(
        label
        for label, other in zip(found.labels, found.sources, strict=True)
        if other.site == source.site and (other.component in seen or (found.reciprocal and other.load in seen))
    )
    return Remedy(probes, known, found.gain(known))


def _probes(axis: str, component: int) -> tuple[Probe, ...]:
    unit = np.eye(3)
    if component < 3:
        return (Probe(axis, _point(unit[component])),)
    along, across = unit[(component + 1) % 3], _point(unit[(component + 2) % 3])  # a turn about z moves what is on x in y
    return (Probe(axis, across), Probe(axis, across, _point(LEVER * along)))


def _point(vector: Array) -> Point:
    x, y, z = map(float, vector)
    return x, y, z

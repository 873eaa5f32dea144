"""Compliant places that are no axis: holder, spindle nose, table, the post of a bar.

A machine is rigid but for its joints, unless its file declares a place: `[places.holder]`, on which carriage, and where.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from elastogeo.errors import MachineError
from elastogeo.machine.quantity import Point
from elastogeo.machine.topology import Topology

TOOL, WORKPIECE = "tool", "workpiece"
_NAME = re.compile(r"[a-z][a-z0-9_]*")


@dataclass(frozen=True, slots=True)
class Place:
    """A place of the structural loop that gives way although nothing moves there.

    Attributes
    ----------
    name : str
        In small letters, so that it is no axis: `holder`. It ends the names of its parameters, `CL_XXholder`.
    on : str
        The carriage that it is fixed to: an axis letter, or `tool` or `workpiece` for the last one of a branch. What lies
        farther from the foundation sits on the place: the next axes, the tool, the workpiece.
    offset : tuple of 3 float [mm]
        Where, in the frame of that carriage, along whose axes its compliance counts.
    carries_workpiece : bool
        Whether the weight of the workpiece loads it, if it is on the workpiece's side: a table, and no post beside it.
    """

    name: str
    on: str
    offset: Point = (0.0, 0.0, 0.0)
    carries_workpiece: bool = True

    def beyond(self, topology: Topology) -> str:
        """The axis that sits on it, the next one away from the foundation; empty at the end of a branch."""
        for branch in (topology.workpiece[::-1], topology.tool):
            if self.on in branch[:-1]:
                return branch[branch.index(self.on) + 1]
        return ""


def check_places(places: Sequence[Place], topology: Topology, machine: str) -> None:
    """Refuse places that are nowhere, or whose names do not tell them from axes and from each other.

    Raises
    ------
    MachineError
        With the place and the value.
    """
    names = [place.name for place in places]
    for place in places:
        where = f"machine {machine!r}, place {place.name!r}"
        if not _NAME.fullmatch(place.name) or place.name in (TOOL, WORKPIECE):
            raise MachineError(
                f"{where}: a place is named in small letters a to z, digits and _, and neither tool nor workpiece; "
                f"call it for example holder"
            )
        if names.count(place.name) > 1:
            raise MachineError(f"{where}: it is declared {names.count(place.name)} times; each may stand once")
        if place.on not in (*topology.axes, TOOL, WORKPIECE):
            raise MachineError(
                f"{where}: it is on {place.on!r}, which is no carriage of {topology.compact}; write an axis letter, "
                f"tool or workpiece"
            )
        if not all(map(isfinite, place.offset)):
            raise MachineError(f"{where}: the offset must be three finite numbers, got {place.offset}")

"""What happens while a tool goes along its path."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.errors import InputError
from elastogeo.machine.cutting.forces import PathForce
from elastogeo.machine.cutting.tools import HeldTool
from elastogeo.machine.weights import Workpiece

SIDES = ("left", "right")


@dataclass(frozen=True, slots=True)
class Cut:
    """What happens while the tool goes along the path.

    Attributes
    ----------
    force : PathForce or None
        On the tool; none for a path in air.
    tool : HeldTool or None
        Of tool and holder, beyond what the tests had in the loop; rigid if it is not given.
    workpiece : Workpiece or None
        Its weight.
    normal_to : str
        `left` or `right` of the travel: which way along the normal counts as positive.
    """

    force: PathForce | None = None
    tool: HeldTool | None = None
    workpiece: Workpiece | None = None
    normal_to: str = "left"

    def __post_init__(self) -> None:
        """Refuse a side that is none, and a weight that is not known."""
        if self.workpiece is not None and self.workpiece.mass is None:
            raise InputError("the mass of the workpiece is not given; state mass_kg, or leave the workpiece out")
        if self.normal_to not in SIDES:
            raise InputError(f"the normal points to {self.normal_to!r}; write left or right, seen along the travel")

"""What of a fleet, and of a series, a person looks at: the machines that fit, one indicator of the last tests."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.changes.due_dates import OVERDUE
from elastogeo.changes.fleets import FleetState, MachineRow
from elastogeo.changes.result import ChangeVerdict
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FleetPart(Result):
    """The machines of a fleet that fit what is asked for, in their order: the worst first.

    Attributes
    ----------
    fleet : FleetState
        All of it.
    place, model : str
        Where a machine stands, and of which model it is; empty: any.
    state : str
        One of `MACHINE_STATES`; empty: any. Overdue are all whose test is, in whatever state they are.
    first : int
        Of the machines that fit, the first that is shown.
    """

    fleet: FleetState
    place: str = ""
    model: str = ""
    state: str = ""
    first: int = 0

    @property
    def machines(self) -> tuple[MachineRow, ...]:
        """Those that fit."""
        return tuple(row for row in self.fleet.machines if self.fits(row))

    def fits(self, row: MachineRow, *, but: str = "") -> bool:
        """Whether a machine fits what is asked for, `but` for one of `place`, `model`, `state`."""
        return (
            (not self.place or but == "place" or row.place == self.place)
            and (not self.model or but == "model" or row.model == self.model)
            and (not self.state or but == "state" or self.state in states_of(row))
        )


def states_of(row: MachineRow) -> tuple[str, ...]:
    """The states under which a machine counts: its own, and overdue where its test is."""
    return (row.state, OVERDUE) if row.overdue > 0 and row.state != OVERDUE else (row.state,)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Trend(Result):
    """One indicator of a series over time.

    Attributes
    ----------
    verdict : ChangeVerdict
    indicator : str
        Its name; empty: the one to look at first.
    days : float or None [d]
        How long before the last test it is drawn; None: all of it.
    first : int
        Of the tests, the newest first, the first that is listed.
    """

    verdict: ChangeVerdict
    indicator: str = ""
    days: float | None = None
    first: int = 0

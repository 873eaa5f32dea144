"""What a person looks at in a history: a machine, what has a word in its name. A part of `History`."""

from __future__ import annotations

from dataclasses import replace

from elastogeo.changes import Found, MachineState, machine_shown
from elastogeo.errors import InputError
from elastogeo.history.alarms.judging import judged
from elastogeo.history.alarms.states import state_rows
from elastogeo.history.finding import found_by
from elastogeo.history.intake.machines import KnownMachine, machine_keyed
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, read


class Looking:
    """What is read of an open history, by the keys of its rows.

    Attributes
    ----------
    store : Store
    """

    store: Store

    def known_machine(self, key: int) -> KnownMachine | None:
        """The machine of a key; None if there is none."""
        with read(self.store) as connection:
            return machine_keyed(connection, key)

    def machine_shown(self, key: int, series: int | None = None) -> MachineState:
        """A machine by its key: one of its series judged, the others as they were judged last.

        Parameters
        ----------
        key : int
        series : int, optional
            Key of the series; by default the worst.

        Raises
        ------
        InputError
            If there is no such machine, or it has no such series.
        """
        at = now()
        with read(self.store) as connection:
            rows = state_rows(connection, key)
            if not rows:
                raise InputError(f"there is no machine {key}; the fleet names those that there are")
            known = [row for row in rows if row.series_key is not None]
            if series is not None and series not in {row.series_key for row in known}:
                raise InputError(f"{rows[0].machine} has no series {series}; its page names those that it has")
            plain = machine_shown(rows[0].machine, (), known, days(at))
            chosen = series if series is not None or not known else plain.rows[0].series_key
            verdicts = [] if chosen is None else [judged(connection, chosen, at)]
        return replace(plain, series=tuple(verdicts))

    def search(self, words: str) -> Found:
        """Machines, series, tests, instruments and events that have these words in what is said of them."""
        with read(self.store) as connection:
            return found_by(connection, words)

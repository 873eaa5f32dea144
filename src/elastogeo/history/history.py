"""A history, open: what a person does with it. It only puts the wings together; what they do is in the wings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import Any

from sqlalchemy import Connection

from elastogeo.changes import (
    SUSPECT,
    ChangeVerdict,
    EventList,
    FleetState,
    Kind,
    MachineState,
    RuleTest,
    Tolerance,
    machine_state,
)
from elastogeo.errors import ElastogeoError, StoreError
from elastogeo.formats import campaign_parts
from elastogeo.history import alarms
from elastogeo.history.access import Access
from elastogeo.history.ahead import Ahead
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.alarms.judging import judged
from elastogeo.history.alarms.states import fleet
from elastogeo.history.analyses import (
    analyse,
    keep_parts,
    unanalysed,
)
from elastogeo.history.care import Care
from elastogeo.history.intake.asides import KnownTest, set_test_aside
from elastogeo.history.intake.days import ends_of_day
from elastogeo.history.intake.folders import in_order, paths_of_tests, written
from elastogeo.history.intake.happenings import Happened, listed_events, record_event
from elastogeo.history.intake.imports import Imported, import_test
from elastogeo.history.intake.instruments import KnownInstrument, add_instrument
from elastogeo.history.intake.machines import KnownMachine, add_machine, machine_named, machines
from elastogeo.history.intake.notebook import notebook_of
from elastogeo.history.intake.watching import EVERY, SETTLE, Seen, Watch
from elastogeo.history.looking import Looking
from elastogeo.history.names import KnownSeries, series_named, series_of_machine
from elastogeo.history.records import Records
from elastogeo.history.requirements.baselines import Chosen, choose, set_baseline
from elastogeo.history.requirements.intervals import set_interval
from elastogeo.history.requirements.tolerances import kind_of, set_tolerance
from elastogeo.history.store import Store, audit, edition, now, open_store, read
from elastogeo.history.tasks import Tasks


@dataclass(frozen=True, slots=True)
class Added:
    """What became of a path that was to be imported.

    Attributes
    ----------
    path : Path
    imported : Imported or None
        None if it was refused.
    verdict : ChangeVerdict or None
        What its series says then.
    unanalysed : str
        Why it says nothing there; empty if it does.
    campaign : str
        Of a campaign, what became of it, in words; its tests came before.
    error : str
        Why it was refused; empty if it was not.
    """

    path: Path
    imported: Imported | None
    verdict: ChangeVerdict | None = None
    unanalysed: str = ""
    campaign: str = ""
    error: str = ""

    @property
    def new(self) -> bool:
        """Whether it came in just now."""
        return self.imported is not None and self.imported.new


class History(Access, Ahead, Care, Looking, Records, Tasks):
    """Machines and their tests over the years.

    Parameters
    ----------
    url : str or Path
        A file of SQLite (`shop.db`) or `postgresql://user@host/database`.
    create : bool
        Make it if it is not there.
    files : str or Path, optional
        The folder of the raw files, where it is not beside the database.
    who : str
        Who works with it, for the audit trail; by default who is logged in.

    Raises
    ------
    StoreError
        If it is not there, cannot be reached, or has another schema.

    Examples
    --------
    >>> history = eg.History("shop.db", create=True)
    >>> history.add_machine("Mill 3", serial="4711")
    >>> history.add("march", machine="Mill 3")
    """

    def __init__(self, url: str | Path, create: bool = False, *, files: str | Path | None = None, who: str = "") -> None:
        self.who = who or audit.login()
        self.store: Store = open_store(url, create, files=files, who=self.who)

    @classmethod
    def of(cls, store: Store, who: str) -> History:
        """A history that is open already, in somebody's name: the pages serve many persons from one."""
        history = cls.__new__(cls)
        history.who, history.store = who, store
        return history

    def __enter__(self) -> History:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<History {self.store.url!r}>"

    def close(self) -> None:
        """Let go of the database."""
        self.store.close()

    def add_machine(self, name: str, *, kind: str = "", serial: str = "", place: str = "") -> KnownMachine:
        """Add a machine, or say more of one that is there."""
        return add_machine(self.store, name, who=self.who, kind=kind, serial=serial, place=place)

    def add_instrument(
        self, serial: str, *, kind: str = "", calibrated: str = "", due: str = "", certificate: str = ""
    ) -> KnownInstrument:
        """Add an instrument, or say more of one that is there: a calibration, and until when it holds."""
        said = {"kind": kind, "calibrated": calibrated, "due": due, "certificate": certificate}
        return add_instrument(self.store, serial, who=self.who, **said)

    def try_rule(self, machine: str, series: str = "", **how: Any) -> RuleTest:
        """Try the rule on a series: false alarms and delay; `how` as `history.alarms.try_rule_of` takes it."""
        return alarms.try_rule_of(self.store, machine, series, **how)

    def add_event(
        self, kind: str, note: str, *, machine: str | None = None, instrument: str | None = None, at: str = ""
    ) -> Happened:
        """Keep what happened to a machine or an instrument: a repair, parameter edit, move, crash, calibration or note."""
        return record_event(self.store, kind, note, who=self.who, machine=machine, instrument=instrument, at=at)

    def events(self, machine: str = "", kind: str = "", year: int | None = None) -> EventList:
        """What happened, the newest first: to a machine and the instruments that tested it, or to all."""
        return listed_events(self.store, machine, kind, year)

    def set_aside(self, test: int, why: str, *, back: bool = False) -> KnownTest:
        """Set a test aside, so that it counts no more, or take it back."""
        found = set_test_aside(self.store, test, who=self.who, why=why, back=back)
        assess(self.store, found.series)
        return found

    def edition(self) -> str:
        """Another text as soon as anything has changed that is shown of the history."""
        with read(self.store) as connection:
            return edition(connection)

    def machines(self) -> tuple[KnownMachine, ...]:
        """All machines, by name."""
        with read(self.store) as connection:
            return machines(connection)

    def add(
        self,
        path: str | Path,
        *,
        machine: str | None = None,
        repeats: str | int | None = None,
        date: str = "",
        undated: str = "",
        instrument: str = "",
        source: str = "",
    ) -> Added:
        """Import one test, and say what the history says of its machine then.

        Parameters
        ----------
        path : str or Path
            A folder with a `test.toml` or `drive.toml`, or such a file.
        machine : str, optional
            Its name; without it the test must say the machine's serial number.
        repeats : str or int, optional
            The suspect test that it repeats: a number, `last` or `none`; without it, it is found.
        date : str
            When it was measured, if the test does not say it.
        undated : str
            When it counts as measured if neither says it.
        instrument : str
            Serial number of the instrument, if the test does not say it.
        source : str
            Where it came from, as it is to be noted; by default its path.

        Raises
        ------
        InputError
            If it is no test, or machine or date are not said; nothing was imported then.
        """
        path = Path(path)
        asked = {"machine": machine, "repeats": repeats, "date": date, "undated": undated, "instrument": instrument}
        asked |= {"source": source}
        imported = import_test(self.store, path, who=self.who, was_suspect=_was_suspect, **asked)  # type: ignore[arg-type]
        analysis = analyse(self.store, imported.test, self.who)
        return Added(
            path, imported, assess(self.store, imported.series, imported.test), self._unanalysed(imported.series, analysis)
        )

    def _unanalysed(self, series: int, analysis: int) -> str:
        with read(self.store) as connection:
            return str(unanalysed(connection, series, analysis))

    def add_all(
        self, path: str | Path, *, machine: str | None = None, date: str = "", dates_of_files: bool = False
    ) -> Iterator[Added]:
        """Import every test of a folder or a campaign, the oldest first; one that is refused is told, the others come in.

        A campaign is kept as such when all its tests are in.

        Raises
        ------
        InputError
            If the folder holds no test.
        StoreError
            If the history cannot be written.
        """
        parts = campaign_parts(path)
        places = parts.tests.values() if parts else paths_of_tests(path)
        serials = {parts.tests[said]: serial for said, serial in parts.serials.items()} if parts else {}
        found = {}
        for test in in_order(places):
            undated = written(test) if dates_of_files else ""
            try:
                added = self.add(test, machine=machine, date=date, undated=undated, instrument=serials.get(test, ""))
                found[test] = added.imported
            except StoreError:
                raise
            except ElastogeoError as error:
                added = Added(test, None, error=str(error))
            yield added
        if parts:
            keys = {said: got.test for said, place in parts.tests.items() if (got := found.get(place))}
            kept, refused = keep_parts(self.store, parts, keys, self.who)
            yield Added(parts.file, None, campaign=kept, error=refused)

    def verdict(self, machine: str, series: str = "") -> ChangeVerdict:
        """Whether a machine has changed, by one series of its tests: its only one, or the one with this in its name.

        Raises
        ------
        InputError
            If there is no such machine or series, or more than one.
        """
        with read(self.store) as connection:
            return judged(connection, series_named(connection, machine, series).key, now())

    def machine(self, name: str) -> MachineState:
        """A machine by all its series, the worst first.

        Raises
        ------
        InputError
            If there is no such machine.
        """
        with read(self.store) as connection:
            found = machine_named(connection, name)
            every = [judged(connection, one.key, now()) for one in series_of_machine(connection, name)]
        return machine_state(found.name, every)

    def fleet(self) -> FleetState:
        """All machines, the worst first: as they were judged last, and what has become overdue since."""
        with read(self.store) as connection:
            return fleet(connection, now())

    def series(self, machine: str) -> tuple[KnownSeries, ...]:
        """The series of a machine, by name or serial number: its tests by one recipe each."""
        with read(self.store) as connection:
            return series_of_machine(connection, machine)

    def set_baseline(
        self,
        machine: str,
        series: str = "",
        *,
        why: str,
        tests: Sequence[int] = (),
        first: int | None = None,
        last: int | None = None,
        begin: str = "",
        end: str = "",
    ) -> Chosen:
        """Set the tests that count as the ordinary state of a machine: by their numbers, or so many between two dates.

        Raises
        ------
        InputError
            If there are too few, one is set aside, or no reason is given.
        """
        at = now()
        days = (ends_of_day(begin, "begin", at)[0] if begin else None, ends_of_day(end, "end", at)[1] if end else None)
        with read(self.store) as connection:
            key = series_named(connection, machine, series).key
            chosen = tests or choose(connection, key, first, last, *days)
        found = set_baseline(self.store, key, chosen, who=self.who, why=why)
        assess(self.store, key)
        return found

    def kind(self, machine: str, indicator: str, series: str = "") -> Kind:
        """The kind of an indicator of a series: its unit, and from when on a change of it matters."""
        with read(self.store) as connection:
            return kind_of(connection, series_named(connection, machine, series).key, indicator)

    def set_tolerance(
        self,
        machine: str,
        indicator: str,
        series: str = "",
        *,
        why: str,
        lower: float | None = None,
        upper: float | None = None,
        relevance: float | None = None,
    ) -> None:
        """Set between which values an indicator must stay, and from when on a change matters; without any, take it back.

        Parameters
        ----------
        machine, indicator, series, why : str
        lower, upper : float, optional
            In the unit of its kind.
        relevance : float, optional
            In the unit of its kind; a share of the mean where the kind is relative.

        Raises
        ------
        InputError
            If there is no such indicator, nothing keeps the tolerance, or no reason is given.
        """
        with read(self.store) as connection:
            key = series_named(connection, machine, series).key
        set_tolerance(self.store, key, indicator, Tolerance(lower, upper, relevance), who=self.who, why=why)
        assess(self.store, key)

    def set_interval(self, machine: str, days: float | None, series: str = "", *, grace: float = 7.0, why: str = "") -> None:
        """Set how often a series is tested; None: no date."""
        with read(self.store) as connection:
            key = series_named(connection, machine, series).key
        set_interval(self.store, key, days, grace, who=self.who, why=why)
        assess(self.store, key)

    def watch(
        self,
        folder: str | Path,
        *,
        machine: str | None = None,
        dates_of_files: bool = False,
        once: bool = False,
        again: bool = False,
        settle: float = SETTLE,
        every: float = EVERY,
    ) -> Iterator[Seen[Added]]:
        """Import every test of a folder when it is whole, and those that come; says what it sees.

        Parameters
        ----------
        folder : str or Path
            Into which the computer of an instrument writes; nothing in it is changed.
        machine : str, optional
            Of all its tests; without it, they say the serial number of theirs.
        dates_of_files : bool
            Whether a test that does not say its date counts as measured when its run files were last written.
        once : bool
            Whether to stop when all that is whole has come in.
        again : bool
            Whether to try again what was refused before.
        settle, every : float [s]
            Without a change after which a file counts as written; between two looks.
        """
        place = Path(folder).resolve()
        with read(self.store) as connection:
            notebook = notebook_of(self.store.files, place, audit.identity(connection))
        if again:
            notebook.forget()

        def bring(path: Path) -> Added:
            return self.add(path, machine=machine, undated=written(path) if dates_of_files else "")

        def told() -> str:
            return repr((machine, dates_of_files, self.machines()))

        return Watch(place, bring, notebook, told, settle, every).run(once)


def _was_suspect(connection: Connection, series: int, at: datetime) -> bool:
    return judged(connection, series, at).state == SUSPECT

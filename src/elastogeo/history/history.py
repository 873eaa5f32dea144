"""A history, open: what a person does with it. It only puts the wings together; what they do is in the wings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from elastogeo.changes import AuditTrail
from elastogeo.errors import ElastogeoError, StoreError
from elastogeo.history.intake.folders import in_order, tests_in
from elastogeo.history.intake.imports import Imported, import_test
from elastogeo.history.intake.machines import KnownMachine, add_machine, machines
from elastogeo.history.store import Store, audit, open_store, read


@dataclass(frozen=True, slots=True)
class Added:
    """What became of a path that was to be imported.

    Attributes
    ----------
    path : Path
    imported : Imported or None
        None if it was refused.
    error : str
        Why it was refused; empty if it was not.
    """

    path: Path
    imported: Imported | None
    error: str = ""


class History:
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

    def audit(self, last: int = 20, subject: str = "", who: str = "") -> AuditTrail:
        """The audit trail: its last rows (of a subject, of a person), and whether all of it is as it was written."""
        from elastogeo.history.store.trail import audit_trail

        return audit_trail(self.store, last, subject, who)

    def machines(self) -> tuple[KnownMachine, ...]:
        """All machines, by name."""
        with read(self.store) as connection:
            return machines(connection)

    def add(
        self, path: str | Path, *, machine: str | None = None, repeats: str | int | None = None, date: str = ""
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

        Raises
        ------
        InputError
            If it is no test, or machine or date are not said; nothing was imported then.
        """
        path = Path(path)
        imported = import_test(self.store, path, machine=machine, who=self.who, repeats=repeats, date=date)
        return Added(path, imported)

    def add_all(self, path: str | Path, *, machine: str | None = None, date: str = "") -> Iterator[Added]:
        """Import every test in a folder, the oldest first; one that is refused is told, and the others come in.

        Raises
        ------
        InputError
            If the folder holds no test.
        StoreError
            If the history cannot be written.
        """
        for test in in_order(tests_in(path)):
            try:
                yield self.add(test, machine=machine, date=date)
            except StoreError:
                raise
            except ElastogeoError as error:
                yield Added(test, None, str(error))

"""What is cared for in a history: instruments, what is wanted of each series, who is told. A part of `History`."""

from __future__ import annotations

from dataclasses import replace

from elastogeo.changes import InstrumentRecord, KeptCopies, KeptInstruments, KeptSettings, SeriesRecord
from elastogeo.changes.alarms import Recipient, Recipients
from elastogeo.errors import InputError
from elastogeo.history import alarms
from elastogeo.history.intake.machines import KnownMachine, change_machine
from elastogeo.history.jobs import kept_jobs, put_job
from elastogeo.history.registers.instruments import instrument_record, instruments
from elastogeo.history.registers.wanted import series_record, wanted_of_series
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, read
from elastogeo.history.upkeep.kept_copies import BACK_UP, VERIFY, kept_copies, place_of_copy


class Care:
    """What is done with an open history to keep it in order.

    Attributes
    ----------
    store : Store
    who : str
        For the audit trail.
    """

    store: Store
    who: str

    def instruments(self) -> KeptInstruments:
        """All instruments, those whose calibration has run out first."""
        with read(self.store) as connection:
            found = instruments(connection, self.store.url, now())
            return replace(found, simulated=alarms.simulated(connection))

    def instrument(self, key: int) -> InstrumentRecord:
        """One instrument, with its calibrations, alarms, and what was tested with it.

        Raises
        ------
        InputError
            If there is none of this key.
        """
        with read(self.store) as connection:
            return replace(instrument_record(connection, key, now()), simulated=alarms.simulated(connection))

    def settings(self) -> KeptSettings:
        """What people have set: of each series its baseline, its limits, how often it is tested."""
        with read(self.store) as connection:
            found = wanted_of_series(connection)
            return KeptSettings(self.store.url, days(now()), found, alarms.simulated(connection))

    def series_settings(self, key: int) -> SeriesRecord:
        """One series: what is wanted of it, and what that is decided from.

        Raises
        ------
        InputError
            If there is no such series.
        """
        with read(self.store) as connection:
            at = now()
            return series_record(connection, key, alarms.judged(connection, key, at), at)

    def copies(self) -> KeptCopies:
        """The backups that were made, and when all was checked."""
        with read(self.store) as connection:
            return kept_copies(connection, self.store)

    def put_backup(self) -> int:
        """Ask a worker for a backup, in the folder of backups; the number of the job, of the one that is going on if one is.

        Raises
        ------
        InputError
            If no folder for backups is set.
        """
        with read(self.store) as connection:
            going = next((one.key for one in kept_jobs(connection, "", 20, BACK_UP).jobs if not one.is_over), None)
        if going is not None:
            return going
        return put_job(self.store, BACK_UP, {"place": str(place_of_copy(self.store, now()))}, self.who)

    def put_check(self) -> int:
        """Ask a worker to check all that is kept; the number of the job."""
        return put_job(self.store, VERIFY, {}, self.who)

    def change_machine(
        self, key: int, *, name: str, kind: str = "", serial: str = "", place: str = "", why: str = ""
    ) -> KnownMachine:
        """Say anew what a machine is called, its model, serial number and place; what is empty is not known any more."""
        return change_machine(self.store, key, who=self.who, name=name, kind=kind, serial=serial, place=place, why=why)

    def silence_until(self, machine: str, day: str, why: str) -> None:
        """Send nothing of a machine until the end of a day (`2026-12-24`), or send again (`now`).

        Raises
        ------
        InputError
            If it is no day to come, there is no such machine, or no reason is given.
        """
        alarms.silence_machine(self.store, machine, alarms.end_of(day.strip(), "the last day"), self.who, why)

    def add_recipient(self, channel: str, address: str, digest: bool = True) -> Recipients:
        """Let somebody be told of alarms.

        Raises
        ------
        SelectionError
            If there is no such channel.
        InputError
            If it is no address of the channel.
        """
        return alarms.add_recipient(self.store, channel, address, self.who, digest)

    def remove_recipient(self, number: int) -> Recipients:
        """Tell somebody nothing more."""
        one = self._recipient(number)
        return alarms.remove_recipient(self.store, one.channel, one.address, self.who)

    def try_recipient(self, number: int) -> Recipient:
        """Send somebody a trial message now.

        Raises
        ------
        DeliveryError
            If it was not taken.
        """
        one = self._recipient(number)
        alarms.try_recipient(one.channel, one.address)
        return one

    def _recipient(self, number: int) -> Recipient:
        found = next((one for one in alarms.recipients(self.store).recipients if one.number == number), None)
        if found is None:
            raise InputError(f"there is no recipient {number}")
        return found

    def recipients(self) -> Recipients:
        """Who is told of alarms; of a web address the host only, since the rest may be a secret."""
        return alarms.recipients(self.store, whole=False)

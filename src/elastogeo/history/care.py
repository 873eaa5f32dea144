"""What is cared for in a history: alarms, instruments, wishes, recipients, backups, the audit trail. A part of `History`."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

from elastogeo.changes import (
    AuditTrail,
    InstrumentRecord,
    KeptCopies,
    KeptInstruments,
    KeptSettings,
    SeriesRecord,
    Verified,
)
from elastogeo.changes.alarms import AlarmList, Delivery, KeptAlarm, Recipient, Recipients
from elastogeo.errors import InputError, StoreError
from elastogeo.history import alarms
from elastogeo.history.intake.machines import KnownMachine, change_machine
from elastogeo.history.jobs import kept_jobs, put_job
from elastogeo.history.registers.instruments import instrument_record, instruments
from elastogeo.history.registers.wanted import series_record, wanted_of_series
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, read
from elastogeo.history.upkeep.backups import back_up
from elastogeo.history.upkeep.exports import export
from elastogeo.history.upkeep.kept_copies import BACK_UP, VERIFY, kept_copies, note_copy, place_of_copy
from elastogeo.history.upkeep.manifests import Copied
from elastogeo.history.upkeep.raw_copies import Step, silent
from elastogeo.history.upkeep.verification import verify


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

    def audit(
        self, last: int = 20, subject: str = "", who: str = "", before: int | None = None, check: int | None = None
    ) -> AuditTrail:
        """The audit trail: its last rows (of a subject, of a person), and whether all of it is as it was written.

        Parameters
        ----------
        last : int
            Rows.
        subject, who : str
            Only the rows of this subject, by its first words (`test 12`, `series`), or of this person.
        before : int, optional
            Only rows before this one.
        check : int, optional
            Rows up to which the trail is checked, where a longer one would take too long; by default any is checked.
        """
        from elastogeo.history.store.trail import audit_trail

        return audit_trail(self.store, last, subject, who, before, check)

    def back_up(self, folder: str | Path, step: Step = silent) -> Copied:
        """Copy everything into a new folder, while others work, check the copy, and note it in the audit trail."""
        copied = back_up(self.store, folder, step)
        with suppress(StoreError):  # a history that may only be read is backed up too
            note_copy(self.store, copied, self.who)
        return copied

    def verify(self, step: Step = silent) -> Verified:
        """Check that everything kept is as it was written."""
        return verify(self.store, step)

    def export(self, folder: str | Path, step: Step = silent) -> Copied:
        """Write everything as files into a new folder."""
        return export(self.store, folder, step)

    def unknown_alarms(self) -> int:
        """How many open alarms nobody has acknowledged, but for those that an instrument's alarm holds back."""
        with read(self.store) as connection:
            return alarms.unknown(connection)

    def simulated(self) -> str:
        """From what all tests are simulated, one a line; empty if any was measured or there is none."""
        with read(self.store) as connection:
            return alarms.simulated(connection)

    def alarms(self, closed: float = 0.0) -> AlarmList:
        """All that waits for somebody: open alarms, overdue tests, messages that did not arrive.

        Parameters
        ----------
        closed : float [d]
            With the alarms that were closed within so many days, and the machines of which nothing is sent.
        """
        with read(self.store) as connection:
            return alarms.lately(connection, now(), timedelta(closed)) if closed else alarms.standing(connection, now())

    def alarm(self, number: int) -> KeptAlarm:
        """One alarm, open or closed, with all that happened to it.

        Raises
        ------
        InputError
            If there is none of this number.
        """
        with read(self.store) as connection:
            return alarms.kept_alarm(connection, number, now())

    def acknowledge(self, number: int, why: str) -> AlarmList:
        """Say that somebody knows of an alarm; it stays open, and is told again only if it becomes worse."""
        return alarms.acknowledge(self.store, number, self.who, why)

    def close_alarm(self, number: int, *, repaired: bool, why: str) -> AlarmList:
        """End an alarm: as repaired, so that a new baseline follows, or as false, so that the old one stays."""
        return alarms.close(self.store, number, repaired, self.who, why)

    def silence(self, machine: str, until: datetime | None, why: str) -> None:
        """Send nothing of a machine until then, None: until now; what is held back is sent afterwards."""
        alarms.silence_machine(self.store, machine, until, self.who, why)

    def deliver(self) -> Delivery:
        """Send what is due, this week's digest included."""
        return alarms.deliver(self.store)

"""What a person confirms of an upload that was looked at: of which machine its tests are, and when they were measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from elastogeo.changes import KeptJob
from elastogeo.changes.records import DONE
from elastogeo.errors import InputError
from elastogeo.history.intake.machines import add_machine, machines
from elastogeo.history.store import Store, read


@dataclass(frozen=True, slots=True)
class Unplaced:
    """Tests whose machine a person must name.

    Attributes
    ----------
    serial : str
        Of the machine, as they say it; empty: they say none.
    tests : tuple of str
        Their paths, as the sender knows them.
    """

    serial: str
    tests: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ToConfirm:
    """What a look has found, and what is still to be said of it.

    Attributes
    ----------
    parcel : str
    unplaced : tuple of Unplaced
    undated : bool
        Whether a test does not say when it was measured.
    known : tuple of int
        Keys of the tests that the history has already.
    new : int
        How many it has not.
    """

    parcel: str
    unplaced: tuple[Unplaced, ...]
    undated: bool
    known: tuple[int, ...]
    new: int


def to_confirm(looked: KeptJob) -> ToConfirm | None:
    """What is to be confirmed of a job; None of one that is no look, or is not done."""
    if looked.kind != "look" or looked.state != DONE or looked.result is None:
        return None
    tests = looked.result["tests"]
    fresh = [one for one in tests if not one["known"]]
    groups: dict[str, list[str]] = {}
    for one in fresh:
        if not one["machine"]:
            groups.setdefault(one["serial"], []).append(one["path"])
    return ToConfirm(
        parcel=looked.result["parcel"],
        unplaced=tuple(Unplaced(serial, tuple(paths)) for serial, paths in groups.items()),
        undated=any(not one["date"] for one in fresh),
        known=tuple(sorted({one["known"]["test"] for one in tests if one["known"]})),
        new=len(fresh),
    )


def confirmed(store: Store, found: ToConfirm, said: Sequence[tuple[str, str, str]], date: str, who: str) -> dict[str, Any]:
    """What the job `import` is asked, once a person has said what a look could not know; new machines are made.

    Parameters
    ----------
    store : Store
    found : ToConfirm
    said : sequence of (serial, machine, name)
        Of the tests that say this serial number the machine, or the name of a new one.
    date : str
        Of the tests that do not say theirs.
    who : str
        Who confirms.

    Raises
    ------
    InputError
        If a machine or the date is missing, or there is no such machine; nothing is made then.
    """
    with read(store) as connection:
        there = {one.name for one in machines(connection)}
    chosen = _chosen(found, {serial: (machine.strip(), name.strip()) for serial, machine, name in said}, there)
    if found.undated and not date:
        raise InputError("a test does not say when it was measured; give its date")
    for serial, name in chosen.items():
        if name not in there:
            add_machine(store, name, who=who, serial=serial)
    return {"parcel": found.parcel, "date": date, "machines": chosen, "known": list(found.known)}


def _chosen(found: ToConfirm, said: Mapping[str, tuple[str, str]], there: set[str]) -> dict[str, str]:
    """The name of the machine of each serial number, of one that is there or of a new one."""
    chosen = {}
    for group in found.unplaced:
        machine, name = said.get(group.serial, ("", ""))
        if not machine and not name:
            of = f"with the serial number {group.serial}" if group.serial else "that do not say their machine"
            raise InputError(f"choose the machine of the tests {of}, or name a new one")
        if machine and machine not in there:
            raise InputError(f"there is no machine {machine!r}; choose one that is there, or name a new one")
        chosen[group.serial] = machine or name
    return chosen

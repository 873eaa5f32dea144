"""Machines and series by the names that a person gives: the whole name, or as much of it as says which."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches

from sqlalchemy import Connection, or_, select

from elastogeo.errors import InputError, several
from elastogeo.history.store.schema import machine, series


@dataclass(frozen=True, slots=True)
class KnownSeries:
    """A series of the history.

    Attributes
    ----------
    key : int
    name : str
        Of its recipe.
    machine : str
    machine_key : int
    """

    key: int
    name: str
    machine: str
    machine_key: int


def machine_key(connection: Connection, name: str) -> int:
    """The key of the machine of this name, or serial number.

    Raises
    ------
    InputError
        If there is none; the message names those that are near.
    """
    rows = connection.execute(
        select(machine.c.id, machine.c.name).where(or_(machine.c.name == name, machine.c.serial == name)).limit(2)
    ).all()
    exact = [row.id for row in rows if row.name == name] or [row.id for row in rows if name]
    if exact:
        return int(exact[0])
    names = list(connection.scalars(select(machine.c.name).order_by(machine.c.name)))
    near = get_close_matches(name, names, n=1)
    there = f"did you mean {near[0]!r}?" if near else f"there are: {several(names)}" if names else "there is none yet"
    raise InputError(f"the history has no machine {name!r}; {there}")


def series_of_machine(connection: Connection, name: str) -> tuple[KnownSeries, ...]:
    """The series of a machine, the oldest first.

    Raises
    ------
    InputError
        If there is no such machine.
    """
    key = machine_key(connection, name)
    rows = connection.execute(
        select(series.c.id, series.c.name, machine.c.name.label("of"))
        .join(machine, machine.c.id == series.c.machine)
        .where(series.c.machine == key)
        .order_by(series.c.id)
    )
    return tuple(KnownSeries(row.id, row.name, row.of, key) for row in rows)


def series_named(connection: Connection, of: str, name: str = "") -> KnownSeries:
    """The series of a machine whose name is this, or has this in it; its only one where no name is given.

    Raises
    ------
    InputError
        If there is none, or several.
    """
    every = series_of_machine(connection, of)
    wanted = name.strip().casefold()
    found = [one for one in every if one.name == name] or [one for one in every if wanted in one.name.casefold()]
    if len(found) == 1:
        return found[0]
    if not every:
        raise InputError(f"{of} has no test yet; import one with: elastogeo history import PATH --machine {of!r}")
    names = "; ".join(repr(one.name) for one in (found or every))
    if found:
        what = f"{len(found)} series of {of} have {name!r} in their names" if wanted else f"{of} has {len(found)} series"
        raise InputError(f"{what}; say which: {names}")
    raise InputError(f"{of} has no series {name!r}; it has: {names}")

"""The machines of a history: which individual a test is of is said by a person or by the test, never guessed."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from difflib import get_close_matches

from sqlalchemy import Connection, insert, select, update

from elastogeo.errors import InputError, several
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import machine


class UnplacedError(InputError):
    """The history does not know the machine that a test is of: once it does, the test can come in as it is."""


@dataclass(frozen=True, slots=True)
class KnownMachine:
    """A machine of the history.

    Attributes
    ----------
    key : int
    name : str
        Of this very machine: `Hermle C50 no. 3`.
    kind : str
        Of its model: `hermle_c50`.
    serial : str
    place : str
        Hall or plant.
    """

    key: int
    name: str
    kind: str = ""
    serial: str = ""
    place: str = ""


def add_machine(store: Store, name: str, *, who: str, kind: str = "", serial: str = "", place: str = "") -> KnownMachine:
    """Add a machine, or say more of one that is there: what is empty stays as it is.

    Raises
    ------
    InputError
        If the name is empty, differs from that of another machine only by case or blanks, or another machine has the serial
        number.
    """
    name = check_name(name, "a machine")
    said = {"kind": kind.strip(), "serial": serial.strip(), "place": place.strip()}
    with write(store) as connection:
        same = _where(connection, serial=said["serial"]) if said["serial"] else []
        if same and same[0].name != name:
            raise InputError(f"{same[0].name!r} has the serial number {serial!r} already; a number is of one machine")
        known = _where(connection, name=name)
        alike = [one.name for one in _where(connection) if _folded(one.name) == _folded(name)]
        if alike and not known:
            raise InputError(
                f"{name!r} is {alike[0]!r} but for letters or blanks; use that name, or one that people tell apart"
            )
        if not known:
            row = {"name": name, **said, "made_at": now()}
            key = connection.execute(insert(machine).values(row).returning(machine.c.id)).scalar_one()
            audit.record(connection, who, "add machine", f"machine {key}", new={"name": name, **said})
            return KnownMachine(key, name, **said)
        old = known[0]
        changed = {what: value for what, value in said.items() if value and value != getattr(old, what)}
        if changed:
            connection.execute(update(machine).where(machine.c.id == old.key).values(changed))
            before = {what: getattr(old, what) for what in changed}
            audit.record(connection, who, "change machine", f"machine {old.key}", old=before, new=changed)
        return _where(connection, name=name)[0]


def change_machine(
    store: Store, key: int, *, who: str, name: str, kind: str = "", serial: str = "", place: str = "", why: str = ""
) -> KnownMachine:
    """Say anew what a machine is called, its model, serial number and place; what is empty is not known any more.

    Raises
    ------
    InputError
        If there is no such machine, the name is none or is another machine's, or another machine has the serial number.
    """
    said = {"name": check_name(name, "a machine"), "kind": kind.strip(), "serial": serial.strip(), "place": place.strip()}
    with write(store) as connection:
        every = _where(connection)
        old = next((one for one in every if one.key == key), None)
        if old is None:
            raise InputError(f"there is no machine {key}")
        others = [one for one in every if one.key != key]
        for one in others:
            if _folded(one.name) == _folded(said["name"]):
                raise InputError(f"{one.name!r} is another machine; give a name that people tell from it")
            if said["serial"] and one.serial == said["serial"]:
                raise InputError(f"{one.name!r} has the serial number {one.serial!r} already; a number is of one machine")
        changed = {what: value for what, value in said.items() if value != getattr(old, what)}
        if changed:
            connection.execute(update(machine).where(machine.c.id == key).values(changed))
            before = {what: getattr(old, what) for what in changed}
            audit.record(connection, who, "change machine", f"machine {key}", old=before, new=changed, why=why.strip())
        return KnownMachine(key, **said)


def machines(connection: Connection) -> tuple[KnownMachine, ...]:
    """All machines, by name."""
    return tuple(_where(connection))


def machine_keyed(connection: Connection, key: int) -> KnownMachine | None:
    """The machine of a key; None if there is none."""
    return next(iter(_where(connection, id=key)), None)


def machine_named(connection: Connection, asked: str) -> KnownMachine:
    """The machine of a name; else of a serial number.

    Raises
    ------
    UnplacedError
        If there is none; the message names those that are near, and how to add one.
    """
    found = _where(connection, name=asked.strip()) or (asked.strip() and _where(connection, serial=asked.strip())) or []
    if len(found) == 1:
        return found[0]
    names = [one.name for one in _where(connection)]
    near = get_close_matches(asked, names, n=1)
    there = f"did you mean {near[0]!r}?" if near else f"there are: {several(names)}" if names else "there is none yet"
    raise UnplacedError(f"the history has no machine {asked!r}; {there}; add one with: elastogeo history machine {asked!r}")


def machine_of(connection: Connection, named: str | None, serial: str, where: str) -> KnownMachine:
    """The machine that a test is of: the one that is named, else that of the serial number that the test says.

    Parameters
    ----------
    connection : Connection
    named : str or None
    serial : str
        `machine_serial` under `[about]` of the test; empty if it says none.
    where : str
        The test, for the message.

    Raises
    ------
    UnplacedError
        If neither says it, or there is no such machine.
    InputError
        If the two contradict each other.
    """
    if named is None:
        if not serial:
            names = [one.name for one in _where(connection)]
            there = f" (there are: {several(names)})" if names else ""
            raise UnplacedError(
                f"{where}: does not say which machine it is of; give --machine NAME{there}, or write machine_serial under "
                f"[about]"
            )
        found = _where(connection, serial=serial)
        if not found:
            raise UnplacedError(
                f"{where}: is of the machine with the serial number {serial!r}, which no machine of the history has; add it "
                f"with: elastogeo history machine NAME --serial {serial!r}"
            )
        return found[0]
    known = machine_named(connection, named)
    if serial and known.serial and serial != known.serial:
        raise InputError(
            f"{where}: is of the machine with the serial number {serial!r}, and {known.name!r} has {known.serial!r}; give "
            f"the right machine, or correct machine_serial under [about]"
        )
    return known


def check_name(name: str, of: str) -> str:
    """A name without blanks around it.

    Raises
    ------
    InputError
        If nothing is left, or it has a line break.
    """
    name = name.strip()
    if not name or not name.isprintable():
        raise InputError(f"{name!r} is no name for {of}; write letters, digits, blanks")
    return name


def _folded(name: str) -> str:
    """A name without what people do not tell apart: case, width of blanks, the ways to write one letter."""
    return " ".join(unicodedata.normalize("NFKC", name).casefold().split())


def _where(connection: Connection, **known: str | int) -> list[KnownMachine]:
    columns = (machine.c.id, machine.c.name, machine.c.kind, machine.c.serial, machine.c.place)
    asked = select(*columns).where(*(machine.c[name] == value for name, value in known.items())).order_by(machine.c.name)
    return [KnownMachine(*row) for row in connection.execute(asked)]

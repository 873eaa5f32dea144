"""What was sent, recognised: each test with what it says of itself, and why the rest is none. Nothing is guessed.

Everything is read as the command line reads it, so what is wrong is said in the same words, with line and column; but no
file outside of what was sent is opened, whatever a document names.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, select

from elastogeo.errors import ElastogeoError
from elastogeo.formats import TestWithFiles, campaign_parts, confined_to, inspect_file, read_with_files, run_files_of
from elastogeo.history.intake.folders import TESTS, in_order
from elastogeo.history.intake.machines import machines
from elastogeo.history.intake.recipes import origin_of
from elastogeo.history.store.schema import machine, series, test
from elastogeo.history.work import Work
from elastogeo.observe import MachineTest

CAMPAIGN = "campaign.toml"
_MOST_OTHERS = 50
"""Files that are no tests of which each is looked into; of the others only the number is told."""
_DRIVE = "feed drives"


def recognised(work: Work, top: Path, connection: Connection) -> dict[str, Any]:
    """What lies in a folder.

    Returns
    -------
    dict
        `tests`: [{path, name, kind, model, origin, serial, machine, machine_key, date, files, known}], the oldest first;
        `machine` is the one that has the serial number that the test says; empty if it says none, or nobody has it.
        `campaigns`: [{path, name, tests}]; `others`: [{path, what, error}], what is no test; `more`: how many more.
        `errors`: what is wrong with a test, as the command line says it.
    """
    found: dict[str, Any] = {"tests": [], "campaigns": [], "others": [], "more": 0, "errors": []}
    used: set[Path] = set()
    with confined_to(top):
        for file in sorted(top.rglob(CAMPAIGN)):
            used.add(file)
            _campaign(file, top, found)
        tests = _places(top)
        for number, place in enumerate(in_order(tests)):
            work.step(f"reading {said(place, top)}", number, len(tests))
            _gather(place)
            used |= {place / name for name in TESTS}
            _test(connection, place, top, used, found)
        _others(work, top, used, found)
    return found


def tests_of(top: Path) -> tuple[tuple[Path, str, str], ...]:
    """The tests that lie in a folder, the oldest first: the folder of each, the serial number of the machine that it says,
    and that of the instrument that its campaign says.
    """
    instruments: dict[Path, str] = {}
    for file in sorted(top.rglob(CAMPAIGN)):
        with suppress(ElastogeoError):  # it is told where the campaign is kept
            parts = campaign_parts(file)
            for name, serial in parts.serials.items() if parts else ():
                instruments[Path(os.path.normpath(parts.tests[name]))] = serial  # type: ignore[union-attr]
    return tuple((place, _serial(place), instruments.get(place, "")) for place in in_order(_places(top)))


def said(path: Path, top: Path) -> str:
    """A path as its sender knows it."""
    return path.relative_to(top).as_posix() if path != top else "what was sent"


def in_the_senders_words(error: str, top: Path) -> str:
    """An error whose paths are those of what was sent."""
    return error.replace(f"{top}{os.sep}", "").replace(str(top), "what was sent")


def _places(top: Path) -> list[Path]:
    """The folders with a test in what was sent; hidden ones are left out."""
    return sorted({path.parent for path in _below(top) if path.name in TESTS})


def _serial(place: Path) -> str:
    """The serial number of its machine that a test says; empty if it says none, or cannot be read."""
    file = next(place / name for name in TESTS if (place / name).is_file())
    try:
        return str(tomllib.loads(file.read_text("utf-8-sig"))["about"]["machine_serial"]).strip()
    except (OSError, ValueError, RecursionError, KeyError, TypeError):
        return ""


def _campaign(file: Path, top: Path, found: dict[str, Any]) -> None:
    try:
        parts = campaign_parts(file)
    except ElastogeoError as error:
        found["errors"].append(in_the_senders_words(str(error), top))
        return
    if parts is not None:
        entry = {"path": said(file.parent, top), "name": parts.name, "tests": len(parts.tests)}
        found["campaigns"].append(entry)


def _gather(place: Path) -> None:
    """Put run files that were sent loose to where the test beside them names them; nothing else is moved."""
    file = place / TESTS[0]
    if not file.is_file():
        return
    try:
        named = run_files_of(file)
    except ElastogeoError:
        return  # the reader says what is wrong with it
    for path in named:
        path = path if path.exists() else path.with_name(path.name.partition("#")[0])
        loose = place / path.name
        inside = Path(os.path.normpath(path)).is_relative_to(place)
        if inside and not path.exists() and loose.is_file() and loose not in named:
            path.parent.mkdir(parents=True, exist_ok=True)
            loose.rename(path)


def _test(connection: Connection, place: Path, top: Path, used: set[Path], found: dict[str, Any]) -> None:
    try:
        one = read_with_files(place)
    except ElastogeoError as error:
        found["errors"].append(in_the_senders_words(str(error), top))
        used |= set(_below(place))
        return
    used |= {path for path, _ in one.files.values()}
    about = one.test.about
    serial = about.machine_serial.strip()
    of = next((known for known in machines(connection) if serial and known.serial == serial), None)
    found["tests"].append(
        {
            "path": said(place, top),
            "name": one.test.name,
            "kind": one.test.instrument if isinstance(one.test, MachineTest) else _DRIVE,
            "model": one.test.machine.name if isinstance(one.test, MachineTest) else "",
            "origin": origin_of(one.test),
            "from": one.test.simulated,
            "serial": serial,
            "machine": of.name if of else "",
            "machine_key": of.key if of else None,
            "date": about.date,
            "files": len(one.files),
            "known": _known(connection, one),
        }
    )


def _known(connection: Connection, one: TestWithFiles) -> dict[str, Any] | None:
    """The test in the history that is this one."""
    asked = select(test.c.id, test.c.name, machine.c.name.label("of"), machine.c.id.label("machine"))
    joined = asked.join(series, series.c.id == test.c.series).join(machine, machine.c.id == series.c.machine)
    row = connection.execute(joined.where(test.c.sha256 == one.sha256)).one_or_none()
    return None if row is None else {"test": row.id, "name": row.name, "machine": row.of, "machine_key": row.machine}


def _others(work: Work, top: Path, used: set[Path], found: dict[str, Any]) -> None:
    """Files that no test names: what each is, and why it is no test."""
    rest = [path for path in sorted(_below(top)) if path not in used]
    found["more"] = max(len(rest) - _MOST_OTHERS, 0)
    for path in rest[:_MOST_OTHERS]:
        work.step(f"looking at {said(path, top)}")
        entry = {"path": said(path, top), "what": "", "error": ""}
        try:
            what = inspect_file(path)
            entry["what"], entry["error"] = f"{what.kind}, {what.format}", what.problem
        except ElastogeoError as error:
            entry["error"] = in_the_senders_words(str(error), top)
        found["others"].append(entry)


def _below(folder: Path) -> Iterator[Path]:
    """The files in and below a folder, hidden ones left out."""
    for place, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith((".", "__MACOSX"))]
        yield from (Path(place) / name for name in files if not name.startswith(".") and name.lower() != "thumbs.db")

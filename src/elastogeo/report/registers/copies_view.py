"""The view of backups and checks of a history, and `elastogeo.copies/1`, its document.

folder : in which the pages make backups, or null
backups : [{at, who, place, rows, files, size, wrong}], the last first; `wrong` are checks that the history did not pass
checks : [{at, who, rows, files, faults, first}], the last first; `first` are the first faults by name
"""

from __future__ import annotations

from dataclasses import asdict

from elastogeo.changes import KeptCheck, KeptCopies, KeptCopy
from elastogeo.report.days import date_said, days_said, iso_date, moment_said
from elastogeo.report.document import document
from elastogeo.report.numbers import significant
from elastogeo.report.view import Badge, Section, Table, View, lines, views

OLD, TOO_OLD = 7.0, 31.0
"""Days after which the last backup is old, and too old."""
_UNITS = ("bytes", "kB", "MB", "GB", "TB")
_STEP = 1000.0


@lines(KeptCopy)
def copy_line(one: KeptCopy) -> str:
    """`3 May 2026 by A. Miller: backups/2026-05-03, 12 files, 3.40 MB`."""
    return f"{date_said(one.at)} by {one.who}: {one.place}, {one.files} files, {size_said(one.size)}"


@lines(KeptCheck)
def check_line(one: KeptCheck) -> str:
    """`3 May 2026 by A. Miller: as it was written`."""
    return f"{date_said(one.at)} by {one.who}: {_found(one)}"


@views(KeptCopies)
def copies_view(result: KeptCopies) -> View:
    """When all was backed up last, and checked last."""
    copies = Table(
        ("When", "By", "Folder", "Raw files", "Size", "What was wrong then"),
        tuple(
            (moment_said(one.at), one.who, one.place, str(one.files), size_said(one.size), ", ".join(one.wrong))
            for one in result.copies
        ),
        words=(0, 1, 2, 5),
        name="backups",
    )
    checks = Table(
        ("When", "By", "Rows", "Raw files", "What was found"),
        tuple((moment_said(one.at), one.who, str(one.rows), str(one.files), _found(one)) for one in result.checks),
        words=(0, 1, 4),
        name="checks",
    )
    entries = [asdict(one) | {"at": iso_date(one.at)} for one in result.copies]
    found = {
        "now": iso_date(result.now),
        "folder": result.folder or None,
        "backups": entries,
        "checks": [asdict(one) | {"at": iso_date(one.at)} for one in result.checks],
    }
    named = (("Backups", copies), ("Checks", checks))
    return View(
        kind="Backup",
        title=result.store,
        origin="",
        head=(("Backups go to", result.folder),) if result.folder else (),
        sentence=f"{_last_copy(result)} {_last_check(result)}",
        document=document("elastogeo.copies/1", found),
        rows=[{name: value for name, value in entry.items() if name != "wrong"} for entry in entries],
        tables=tuple(table for _, table in named if table.rows),
        sections=tuple(Section(title, tables=(table,)) for title, table in named if table.rows),
        badge=_badge(result),
        advice=(_advice(result),),
    )


def size_said(size: int) -> str:
    """`3.40 MB`: three digits."""
    number, unit = float(size), 0
    while number >= _STEP and unit < len(_UNITS) - 1:
        number, unit = number / _STEP, unit + 1
    return f"{significant(number, 3) if unit else size} {_UNITS[unit]}"


def _last_copy(result: KeptCopies) -> str:
    if not result.copies:
        return "No backup was made yet."
    return f"The last backup is {_ago(result.now - result.copies[0].at)}."


def _last_check(result: KeptCopies) -> str:
    if not result.checks:
        return "Nothing was checked yet."
    last = result.checks[0]
    return f"All was checked {_ago(result.now - last.at).removesuffix(' old')} ago: {_found(last)}."


def _ago(days: float) -> str:
    return f"{days_said(days)} old" if days >= 1 else "less than a day old"


def _found(one: KeptCheck) -> str:
    if not one.faults:
        return "as it was written"
    more = one.faults - len(one.first)
    named = f"{', '.join(one.first)}{f' and {more} more' if more else ''}"
    return f"{one.faults} {'fault' if one.faults == 1 else 'faults'}: {named}"


def _badge(result: KeptCopies) -> Badge:
    if result.checks and result.checks[0].faults:
        return Badge("■", "Not as it was written", "bad")
    age = result.now - result.copies[0].at if result.copies else None
    if age is None or age > TOO_OLD:
        return Badge("■", "No backup" if age is None else "The last backup is too old", "bad")
    return Badge("▲", "The last backup is old", "care") if age > OLD else Badge("●", "Backed up", "good")


def _advice(result: KeptCopies) -> str:
    if not result.folder:
        return "Set ELASTOGEO_BACKUPS to a folder, on another disk if there is one; then backups can be made from here."
    return "A backup on the disk of the history is lost with it: let ELASTOGEO_BACKUPS name a folder of another disk."

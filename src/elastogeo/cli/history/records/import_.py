"""`elastogeo history import`: tests into the history, the oldest first."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who
from elastogeo.cli.plain import plain

if TYPE_CHECKING:
    from elastogeo.changes import ChangeVerdict
    from elastogeo.history import Added

SUSPECT, ALARM = "suspect", "alarm"
"""States of a series of which more is said than their name."""

Machine = Annotated[str | None, typer.Option("--machine", "-m", help="The machine, by name; else as the test says.")]


def import_(
    paths: Annotated[
        list[Path], typer.Argument(metavar="PATH...", help="A test, a campaign, or a folder with tests in it.")
    ],
    machine: Machine = None,
    repeats: Annotated[
        str | None, typer.Option(help="The suspect test that this one repeats: its number, last, or none; else found.")
    ] = None,
    date: Annotated[str, typer.Option(help="When it was measured, if the test does not say so.")] = "",
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Import tests, and say what has changed.

    A test that is there already is left as it is, whatever its folder is called.

    \b
    Examples:
      elastogeo history import march --machine "Mill 3"
      elastogeo history import years-of-tests --store shop.db
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        found: list[Added] = []
        for path in paths:
            if repeats is not None:
                added = [history.add(path, machine=machine, repeats=repeats, date=date)]
            else:
                added = history.add_all(path, machine=machine, date=date)  # type: ignore[assignment]
            for one in added:
                found.append(one)
                if not as_json:
                    _tell(one, found[:-1])
    refused = [one for one in found if one.error]
    if as_json:
        screen.show_json({"schema": "elastogeo.imports/1", "tests": [_document(one) for one in found]})
    elif len(found) > 1:
        new = sum(one.new for one in found)
        known = sum(one.imported is not None and not one.new for one in found)
        screen.say(f"{new} new, {known} known already, {len(refused)} refused.")
    if refused:
        raise typer.Exit(2)


def _tell(one: Added, before: Sequence[Added]) -> None:
    """Say what became of a test; what its machine has, only where that is new."""
    from elastogeo.cli import screen

    told = {earlier.imported.series: _state(earlier) for earlier in before if earlier.imported}
    same = one.imported is not None and told.get(one.imported.series) == _state(one)
    for line in lines_of(one, brief=same):
        if one.error:
            print(plain(f"elastogeo: {line}"), file=sys.stderr, flush=True)
        else:
            screen.say(line)


def lines_of(one: Added, brief: bool = False) -> list[str]:
    """What became of a test, in lines for a person; `brief` leaves out what its machine has."""
    got = one.imported
    if got is None:
        return [one.error or one.campaign]
    known = "" if got.new else " is known, nothing was changed"
    state = f": {_state(one)}" if one.verdict else ""
    head = f"Test {got.test}{known}: {got.name}, {got.machine}, {got.at:%Y-%m-%d}, {got.series_name}{state}"
    tells = one.verdict is not None and not brief and _state(one) in (SUSPECT, ALARM)
    told = _sentence(one.verdict) if one.verdict is not None and tells else ""
    unanalysed = f"it says nothing in its series: {one.unanalysed}" if one.unanalysed else ""
    return [head, *(f"  {note}" for note in (told, unanalysed, *got.notes) if note)]


def _state(one: Added) -> str:
    return "" if one.verdict is None else one.verdict.state


def _sentence(verdict: ChangeVerdict) -> str:
    from elastogeo.report import view_of

    return view_of(verdict).sentence


def _document(one: Added) -> dict[str, Any]:
    got = one.imported
    if got is None:
        return (
            {"path": str(one.path), "error": one.error} if one.error else {"path": str(one.path), "campaign": one.campaign}
        )
    return {
        "path": str(one.path),
        **asdict(got),
        "at": got.at.isoformat(),
        "state": _state(one),
        "unanalysed": one.unanalysed,
    }

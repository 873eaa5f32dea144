"""`elastogeo history watch`: every test of a folder into the history, when it is whole."""

from __future__ import annotations

import sys
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who
from elastogeo.cli.plain import plain


def watch(
    folder: Annotated[Path, typer.Argument(help="Into which the instrument's computer writes; nothing in it is changed.")],
    machine: Annotated[str | None, typer.Option("--machine", "-m", help="Of all its tests; else as each test says.")] = None,
    once: Annotated[bool, typer.Option("--once", help="Stop when all that is whole has come in.")] = False,
    dates_of_files: Annotated[
        bool, typer.Option("--dates-of-files", help="A test that says no date was measured when its runs were written.")
    ] = False,
    again: Annotated[bool, typer.Option("--again", help="Try again what was refused before.")] = False,
    settle_s: Annotated[float, typer.Option(help="Seconds without a change after which a file is whole.", min=0.0)] = 5.0,
    every_s: Annotated[float, typer.Option(help="Seconds between two looks.", min=0.1)] = 10.0,
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Import what comes into a folder, when it is whole.

    Half-written tests wait; a bad one is told once and left as it is. Ctrl-C stops it.

    \b
    Example:
      elastogeo history watch /mnt/ballbar --machine "Mill 3"
      elastogeo history watch /mnt/ballbar --once
    """
    from elastogeo.cli import screen
    from elastogeo.cli.history.records.import_ import lines_of

    refused = False
    with eg.History(store, who=who) as history:
        options = {"dates_of_files": dates_of_files, "once": once, "again": again, "settle": settle_s, "every": every_s}
        seen_all = history.watch(folder, machine=machine, **options)  # type: ignore[arg-type]
        if not once:
            screen.say(f"Watching {folder}; Ctrl-C stops.")
        for seen in seen_all:
            said = "\n".join(lines_of(seen.brought)) if seen.brought else f"{seen.path.name}: {seen.said}"
            line = f"{datetime.now():%Y-%m-%d %H:%M:%S} {seen.what}: {said}"
            bad = seen.what in ("refused", "held", "failed")
            print(plain(line), file=sys.stderr if bad else sys.stdout, flush=True)
            refused = refused or bad
    if once and refused:
        raise typer.Exit(2)

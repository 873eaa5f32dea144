"""What a person sees at the terminal: any view. Nothing is computed or formatted here."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import typer
from rich import box
from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table as RichTable

from elastogeo.cli.plain import plain
from elastogeo.report import Said, Table, View, save_report, view_of

Step = Callable[[str], None]

_WIDTH = 160
"""Of tables that go to a file or another program: wide enough that no cell is folded."""
_MARKS = {True: ("ok", "green"), False: ("look", "yellow"), None: ("n/t", "dim")}

_console = Console(highlight=False)
if not _console.is_terminal:
    _console = Console(highlight=False, width=_WIDTH)


def say(sentence: str) -> None:
    """Print a sentence, as it is, but for what would command the terminal."""
    _console.print(plain(sentence), markup=False, soft_wrap=True)


def show_json(document: Any) -> None:
    """Print one JSON document."""
    print(json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False))


@contextmanager
def progress(first: str, quiet: bool) -> Iterator[Step]:
    """Show what is going on, and for how long, on standard error while it goes on."""
    columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=quiet or not console.is_terminal) as bar:
        task = bar.add_task(first, total=None)
        yield lambda what: bar.update(task, description=what)


def show(result: object, report: Path | None, as_json: bool) -> None:
    """Show a result of any kind and write its report, if one is wanted; end with code 1 if the data do not support it.

    Raises
    ------
    typer.Exit
        With code 1 if a decisive check failed.
    """
    view = view_of(result)
    written = None
    if report:
        with progress("writing the report", quiet=as_json):
            written = save_report(view, report)
    if as_json:
        show_json(dict(view.document))
    else:
        show_view(view)
        if written:
            say(f"Report: {written}")
    if not view.supported:
        raise typer.Exit(1)


def show_view(view: View) -> None:
    """The answer first, then its tables, then the verdict."""
    say(f"{view.kind}: {view.title}, {view.subtitle}" if view.subtitle else f"{view.kind}: {view.title}")
    if view.origin:
        say(view.origin)
    for sentence in view.alert:
        say(sentence)
    say("")
    if view.badge is not None:
        say(f"{view.badge.mark} {view.badge.text}")
    say(view.sentence)
    for sentence in view.advice:
        say(sentence)
    for table in view.tables:
        say("")
        show_table(table)
    if view.notes:
        say("")
    for note in view.notes:
        say(note)
    if view.checks:
        say("")
    for check in (*view.attention, *view.passed):
        show_check(check)


def show_table(table: Table) -> None:
    """A table as wide as the terminal; a cell too long for its column is folded, never cut."""
    shown = RichTable(box=box.SIMPLE_HEAD if table.title else None, show_edge=False, pad_edge=False, title_justify="left")
    if table.title:
        say(table.title)
    for k, heading in enumerate(table.headings):
        words = k in table.words
        shown.add_column(
            plain(heading).replace("[", "\\["), justify="left" if words else "right", no_wrap=not words, overflow="fold"
        )
    for row in table.rows:
        shown.add_row(*(plain(cell).replace("[", "\\[") for cell in row))
    _console.print(shown)
    if table.note:
        _console.print(plain(table.note), markup=False, style="dim")


def show_check(check: Said) -> None:
    """One point of a verdict."""
    mark, style = _MARKS[check.passed]
    _console.print(f"[{style}]{mark:>4}[/{style}]  ", end="")
    say(f"{check.name}: {check.sentence}")

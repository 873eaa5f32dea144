"""`elastogeo record`: a machine's own signals, live from its OPC UA server, into files."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from elastogeo.cli.options import AsJson

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from elastogeo.recording import Watcher

PASSWORD = "ELASTOGEO_OPCUA_PASSWORD"


def record(
    server: Annotated[
        str, typer.Argument(metavar="SERVER", help="Address of an OPC UA server (opc.tcp://host:4840), or a recording file.")
    ],
    folder: Annotated[
        Path, typer.Option("--output", "-o", help="Folder to record into; a recording in it is gone on with.")
    ],
    node: Annotated[
        list[str] | None,
        typer.Option("--node", "-n", help="Node to record: ns=2;s=X, or name[unit]=ns=2;s=X; may be repeated."),
    ] = None,
    duration: Annotated[
        float | None, typer.Option(help="Seconds to record, from the first connection on; else until Ctrl-C.", min=0.0)
    ] = None,
    sampling_ms: Annotated[
        float | None, typer.Option(help="Interval in which the server is asked to sample [ms]; else 100.", min=0.0)
    ] = None,
    batch_s: Annotated[float | None, typer.Option(help="Write a part every so many seconds; else 5.")] = None,
    user: Annotated[
        str | None, typer.Option(help="User name; the password is in ELASTOGEO_OPCUA_PASSWORD, or asked for.")
    ] = None,
    security: Annotated[
        str | None, typer.Option(help="Policy,Mode,certificate,key, for a signed or encrypted channel.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Record signals of a machine while it runs.

    Whatever is counted as kept is on disk, even if the recorder is killed. What could not be received is fetched from the
    server's history, or marked as a gap.

    \b
    Example:
      elastogeo record opc.tcp://mill:4840 -n "current_x[A]=ns=2;s=X.Current" -n "position_x[mm]=ns=2;s=X.Pos" -o monday
      elastogeo record recording.toml -o monday --duration 3600
    """
    from elastogeo.cli import screen
    from elastogeo.recording import planned, recording_json, recording_lines
    from elastogeo.recording import record as recorded

    sampling = None if sampling_ms is None else sampling_ms / 1000
    plan = planned(server, node or (), sampling=sampling, batch=batch_s, user=user, security=security)
    password = _password() if plan.user else ""
    with _watching() as watcher:
        recording = recorded(plan, folder, watcher, duration, password)
    if as_json:
        screen.show_json(recording_json(recording))
    else:
        for line in recording_lines(recording):
            screen.say(line)
    if not any(recording.samples.values()):
        raise typer.Exit(1)


def _password() -> str:
    """From the environment, or asked for: never from a file or the command line, which others can read."""
    return os.environ.get(PASSWORD) or typer.prompt("Password", hide_input=True, err=True, type=str)


@contextmanager
def _watching() -> Iterator[Watcher]:
    """Show on standard error what goes on: a line that vanishes at a terminal, plain sentences elsewhere."""
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    console = Console(stderr=True, highlight=False)
    if not console.is_terminal:
        yield _Plain()
        return
    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        yield _Live(bar, bar.add_task("recording", total=None))


class _Plain:
    """For a log or another program: a sentence a line, as soon as it is true."""

    def say(self, sentence: str) -> None:
        print(sentence, file=sys.stderr, flush=True)

    def kept(self, part: str, samples: int, total: int) -> None:
        self.say(f"{part}: {samples} samples kept, {total} in all.")


class _Live:
    """For a person: what happened stays, with its time of day; what is kept is counted in the last line."""

    def __init__(self, bar: Progress, task: TaskID) -> None:
        self._bar, self._task = bar, task

    def say(self, sentence: str) -> None:
        self._bar.console.print(f"{datetime.now():%H:%M:%S} {sentence}", markup=False, soft_wrap=True)

    def kept(self, part: str, samples: int, total: int) -> None:
        self._bar.update(self._task, description=f"{total} samples kept, the last {samples} in {part}")

"""`elastogeo history work`: do what takes long and was asked for on the pages."""

from __future__ import annotations

import sys
import threading
from datetime import datetime
from typing import TYPE_CHECKING, Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who
from elastogeo.cli.plain import plain

if TYPE_CHECKING:
    from elastogeo.history.jobs import Worker


def work(
    once: Annotated[bool, typer.Option("--once", help="Stop when no job waits.")] = False,
    attached: Annotated[
        bool, typer.Option("--attached", help="Stop when standard input ends: the program that started it is gone.")
    ] = False,
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Do the jobs that wait: imports, drawings, plans.

    `elastogeo serve` starts one by itself. SIGTERM or Ctrl-C lets it finish its step and put the job back; a job whose
    worker was killed is done again by the next.

    \b
    Example:
      elastogeo history work --store shop.db
    """
    from elastogeo.history.jobs import Worker, give_way, stop_at_signals
    from elastogeo.history.parcels import sweep_parcels

    with eg.History(store, who=who) as history:
        worker = Worker(history.store, _tell, sweep_parcels)
        stop_at_signals(worker)
        give_way()
        if attached:
            threading.Thread(target=_stop_at_end, args=(worker,), daemon=True).start()
        worker.run(once)


def _stop_at_end(worker: Worker) -> None:
    sys.stdin.read()
    worker.stop()


def _tell(line: str) -> None:
    print(plain(f"{datetime.now():%Y-%m-%d %H:%M:%S} {line}"), flush=True)

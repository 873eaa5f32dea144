"""`elastogeo history plan`: keep a plan of tests with its due date, list what is due, say that one is done."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def plan(
    file: Annotated[
        Path | None, typer.Argument(metavar="[PLAN.json]", help="What elastogeo plan --json printed; none: list the plans.")
    ] = None,
    machine: Annotated[str, typer.Option("--machine", "-m", help="The machine, by name.")] = "",
    name: Annotated[str, typer.Option(help="Of the plan; by default that of its file.")] = "",
    due: Annotated[str, typer.Option(help="Until when it is to be done: 2026-05-01.")] = "",
    grace: Annotated[float, typer.Option(help="Days after which it is overdue.", min=0)] = 7.0,
    done: Annotated[int | None, typer.Option(help="The number of a plan that was done.")] = None,
    why: Annotated[str, typer.Option(help="A remark, for the audit trail.")] = "",
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Keep a plan of tests with its due date, or list them.

    \b
    Examples:
      elastogeo plan --machine hermle_c50 --tests 4 --json > spring.json
      elastogeo history plan spring.json --machine "Mill 3" --due 2026-05-01
      elastogeo history plan --done 3
      elastogeo history plan
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        if done is not None:
            history.finish_plan(done, why)
        if file is not None:
            if not machine:
                raise eg.InputError(
                    "a plan is of a machine; say --machine with its name, as elastogeo history list shows it"
                )
            history.keep_plan(file, machine=machine, name=name, due=due, grace=grace)
        found = history.plans(machine or None)
    screen.show(found, None, as_json)

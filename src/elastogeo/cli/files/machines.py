"""`elastogeo machines`: the machines that ship with elastogeo, or one machine in full."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report


def machines(
    name: Annotated[str, typer.Argument(help="A shipped machine or a machine file, to see it in full.")] = "",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """List the machines that are there, or show one.

    \b
    Example:
      elastogeo machines hermle_c50
    """
    from elastogeo.cli import screen
    from elastogeo.report import Table, view_of

    if name:
        screen.show(eg.read_machine(name), report, as_json)
        return
    found = eg.machines()
    if as_json:
        screen.show_json(
            {"schema": "elastogeo.machines/1", "machines": [view_of(machine).document for machine in found.values()]}
        )
    else:
        rows = tuple((key, m.name, m.topology.compact, m.topology.iso) for key, m in found.items())
        screen.show_table(Table(("name", "machine", "topology", "ISO 10791-6"), rows, words=(0, 1, 2, 3)))

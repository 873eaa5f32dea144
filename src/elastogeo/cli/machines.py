"""`elastogeo machines`: the machines that ship with elastogeo, or one machine in full."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elastogeo.cli.options import AsJson


def machines(
    name: Annotated[str, typer.Argument(help="A shipped machine or a machine file, to see it in full.")] = "",
    as_json: AsJson = False,
) -> None:
    """List the machines that are there, or show one.

    \b
    Example:
      elastogeo machines hermle_c50
    """
    from elastogeo.cli import screen
    from elastogeo.formats import find_machine, read_machine, shipped_machines
    from elastogeo.report import Table, view_of

    if name:
        screen.show(find_machine(name, Path.cwd()), None, as_json)
        return
    found = {key: read_machine(path) for key, path in shipped_machines().items()}
    if as_json:
        screen.show_json({"machines": [view_of(machine).document for machine in found.values()]})
    else:
        rows = tuple((key, m.name, m.topology.compact, m.topology.iso) for key, m in found.items())
        screen.show_table(Table(("name", "machine", "topology", "ISO 10791-6"), rows, words=(0, 1, 2, 3)))

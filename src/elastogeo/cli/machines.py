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
    from elastogeo.report import machine_json

    found = [find_machine(name, Path.cwd())] if name else [read_machine(path) for path in shipped_machines().values()]
    if as_json:
        screen.show_json([machine_json(machine) for machine in found])
    elif name:
        screen.show_machine(found[0])
    else:
        screen.show_machines(dict(zip(shipped_machines(), found, strict=True)))

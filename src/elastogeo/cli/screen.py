"""What a person sees at the terminal: results as tables and sentences. Nothing is computed here."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from elastogeo.estimate import Confounding
from elastogeo.identify import Check, Identification
from elastogeo.machine import Machine
from elastogeo.report import combination, parameter_rows, save_figures, save_html

Step = Callable[[str], None]

_console = Console(highlight=False)


def say(sentence: str) -> None:
    """Print a sentence, as it is."""
    _console.print(sentence, markup=False, soft_wrap=True)


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


def write_report(result: Identification, folder: Path, step: Step) -> Path:
    """Write the HTML report and its figures to a folder; return the report's path."""
    step("drawing the figures")
    save_figures(result, folder)
    step("writing the report")
    return save_html(result, folder / "report.html")


def show_identification(result: Identification) -> None:
    """Parameters, fit, verdict."""
    test = result.test
    say(f"{test.name}, on {test.machine.name} ({test.machine.topology.compact}), {len(test.runs)} runs")
    if test.simulated:
        say(f"Simulated data. {test.simulated}")
    say("")
    _console.print(_parameters(result))
    say("")
    _console.print(_levels(result))
    say("")
    _stands_for(result.confounding)
    say("")
    for check in result.verdict:
        _show_check(check)


def show_confounding(found: Confounding) -> None:
    """What can and cannot be told apart."""
    say(f"{len(found.labels)} parameters, rank {found.rank}, condition {found.condition_scaled:.4g} (scaled columns)")
    if found.null:
        say(f"No reading changes with {len(found.null)}: {', '.join(found.null)}")
    together = [group for group in found.groups if len(group) > 1]
    for group in together:
        say(f"Always together: {', '.join(group)}")
    _stands_for(found)


def show_machines(machines: Mapping[str, Machine]) -> None:
    """The shipped machines, a line each."""
    table = Table(box=None, pad_edge=False)
    for heading in ("name", "machine", "topology", "ISO 10791-6"):
        table.add_column(heading)
    for name, machine in machines.items():
        table.add_row(name, machine.name, machine.topology.compact, machine.topology.iso.replace("[", "\\["))
    _console.print(table)


def show_machine(machine: Machine) -> None:
    """One machine in full."""
    say(f"{machine.name}  {machine.topology.compact}  {machine.topology.iso}")
    table = Table(box=None, pad_edge=False)
    for heading in ("axis", "branch", "kind", "offset [mm]", "travel"):
        table.add_column(heading.replace("[", "\\["))
    for joint in machine.joints:
        branch = "tool" if machine.in_tool_branch(joint.name) else "workpiece"
        low, high = joint.travel
        unit = "rad" if joint.is_rotary else "mm"
        offset = ", ".join(f"{value:g}" for value in joint.offset)
        table.add_row(
            joint.name, branch, "rotary" if joint.is_rotary else "linear", offset, f"{low:.4g} to {high:.4g} {unit}"
        )
    _console.print(table)
    for sentence in machine.assumed:
        say(f"Assumed: {sentence}")


def _parameters(result: Identification) -> Table:
    table = Table(box=None, pad_edge=False)
    table.add_column("parameter")
    for heading in ("value ± U (95 %)", "unit", "trace, p-p \\[um]", "share \\[%]"):
        table.add_column(heading, justify="left" if heading == "unit" else "right")
    for row in parameter_rows(result):
        table.add_row(row.name, row.value, row.unit, row.peak_to_peak_um, row.share_percent)
    return table


def _levels(result: Identification) -> Table:
    table = Table(box=None, pad_edge=False)
    for heading in ("force \\[N]", "readings", "RMSE \\[um]", "fit \\[%]"):
        table.add_column(heading, justify="right")
    for level in result.levels:
        table.add_row(f"{level.force:g}", str(level.readings), f"{level.rmse * 1000:.3f}", f"{level.fitness:.1f}")
    return table


def _stands_for(found: Confounding) -> None:
    for name in found.retained:
        if len(found.stands_for(name)) > 1:
            say(f"{name} stands for {combination(found.stands_for(name))}")


def _show_check(check: Check) -> None:
    mark, style = ("ok", "green") if check.passed else ("look", "yellow")
    _console.print(f"[{style}]{mark:>4}[/{style}]  ", end="")
    say(f"{check.name}: {check.sentence}")

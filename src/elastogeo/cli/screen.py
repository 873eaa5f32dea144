"""What a person sees at the terminal: results as tables and sentences. Nothing is computed here."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from elastogeo.estimate import Confounding
from elastogeo.identification import BeforeAfter, Check, Diagnosis, Identification, WhatIf
from elastogeo.machine import Machine
from elastogeo.report import (
    combination,
    comparison_rows,
    diagnosis_rows,
    in_micrometres,
    log_words,
    parameter_rows,
    save_figures,
    save_html,
    save_pdf,
    sentence_of,
    what_if_rows,
)

Step = Callable[[str], None]

_WIDTH = 140
"""Of tables that go to a file or another program: wide enough that no cell is folded."""

_console = Console(highlight=False)
if not _console.is_terminal:
    _console = Console(highlight=False, width=_WIDTH)


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
    """Write the report as HTML and PDF, and its figures, to a folder; return the path of the HTML."""
    step("drawing the figures")
    save_figures(result, folder)
    step("writing the report")
    save_pdf(result, folder / "report.pdf")
    return save_html(result, folder / "report.html")


def show_identification(result: Identification) -> None:
    """Parameters, fit, verdict."""
    show_head(result)
    show_parameters(result)
    say("")
    _console.print(_levels(result))
    say("")
    _stands_for(result.confounding)
    say("")
    for check in result.verdict:
        show_check(check)


def show_confounding(found: Confounding) -> None:
    """What can and cannot be told apart."""
    say(f"{len(found.labels)} parameters, rank {found.rank}, condition {found.condition_scaled:.4g} (scaled columns)")
    if found.null:
        say(f"No reading changes with {len(found.null)}: {', '.join(found.null)}")
    together = [group for group in found.groups if len(group) > 1]
    for group in together:
        say(f"Always together: {', '.join(group)}")
    _stands_for(found)


def show_diagnosis(diagnosis: Diagnosis, result: Identification, significant: bool) -> None:
    """The ranked faults, what was not told apart, the ISO 230-4 parameters."""
    show_head(result)
    table = empty_table(("", "fault", "what", "value ± U (95 %)", "unit", "trace, p-p [um]", "share [%]"), left=(0, 1, 2, 4))
    for row in diagnosis_rows(diagnosis, result):
        if row.significant == "yes" or not significant:
            table.add_row(row.rank, row.name, row.meaning, row.value, row.unit, row.distortion_um, row.share_percent)
    _console.print(table)
    for row in diagnosis_rows(diagnosis, result):
        if row.also:
            say(f"{row.name} cannot be told from {row.also}")
    if diagnosis.untold:
        say(f"This test says nothing of {', '.join(diagnosis.untold)}")
    for force, circle in diagnosis.circularity.items():
        found = {"G ccw": circle.g_ccw, "G cw": circle.g_cw, "G(b)": circle.g_bidirectional, "D": circle.mean_radial}
        said = ", ".join(f"{name} {in_micrometres(value)} um" for name, value in found.items() if value is not None)
        say(f"ISO 230-4 at {force:g} N: {said}")
    say("")
    for check in result.verdict:
        show_check(check)


def show_comparison(compared: BeforeAfter) -> None:
    """What changed between two tests."""
    say(f"{compared.before.test.name} -> {compared.after.test.name}")
    say("")
    table = empty_table(("parameter", "before", "after", "change ± U (95 %)", "unit", "p", "changed"), left=(0, 4))
    for row in comparison_rows(compared):
        table.add_row(row.name, row.before, row.after, row.change, row.unit, row.p_value, row.changed)
    _console.print(table)
    say("")
    for check in compared.verdict:
        show_check(check)


def show_what_if(predicted: WhatIf) -> None:
    """What a correction would bring."""
    say(f"With {', '.join(predicted.corrected)} corrected, predicted:")
    table = empty_table(("force [N]", "deviation", "before [um]", "after [um]", "change [%]"), left=(1,))
    for row in what_if_rows(predicted):
        table.add_row(row.force, row.what, row.before_um, row.after_um, row.change_percent)
    _console.print(table)


def show_machines(machines: Mapping[str, Machine]) -> None:
    """The shipped machines, a line each."""
    table = empty_table(("name", "machine", "topology", "ISO 10791-6"), left=range(4))
    for name, machine in machines.items():
        table.add_row(name, machine.name, machine.topology.compact, machine.topology.iso.replace("[", "\\["))
    _console.print(table)


def show_machine(machine: Machine) -> None:
    """One machine in full."""
    say(f"{machine.name}  {machine.topology.compact}  {machine.topology.iso}")
    table = empty_table(("axis", "branch", "kind", "offset [mm]", "travel"), left=range(5))
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


def show_table(shown: Table) -> None:
    """Print a table."""
    _console.print(shown)


def show_head(result: Identification) -> None:
    """What was tested."""
    test = result.test
    say(f"{test.name}, on {test.machine.name} ({test.machine.topology.compact}), {len(test.runs)} runs")
    if test.simulated:
        say(f"Simulated data. {test.simulated}")
    for sentence in log_words(test):
        say(sentence)
    say("")


def empty_table(headings: Sequence[str], left: Sequence[int]) -> Table:
    """An empty table; columns not named in `left` are figures."""
    table = Table(box=None, pad_edge=False)
    for k, heading in enumerate(headings):
        table.add_column(heading.replace("[", "\\["), justify="left" if k in left else "right", no_wrap=k not in left)
    return table


def show_parameters(result: Identification) -> None:
    """The identified parameters."""
    table = empty_table(("parameter", "value ± U (95 %)", "unit", "trace, p-p [um]", "share [%]"), left=(0, 2))
    for row in parameter_rows(result):
        table.add_row(row.name, row.value, row.unit, row.peak_to_peak_um, row.share_percent)
    show_table(table)


def _levels(result: Identification) -> Table:
    table = empty_table(("force [N]", "readings", "RMSE [um]", "fit [%]"), left=())
    for level in result.levels:
        fit = "–" if level.fitness is None else f"{level.fitness:.1f}"
        table.add_row(f"{level.force:g}", str(level.readings), f"{level.rmse * 1000:.3f}", fit)
    return table


def _stands_for(found: Confounding) -> None:
    for name in found.retained:
        if len(found.stands_for(name)) > 1:
            say(f"{name} stands for {combination(found.stands_for(name))}")


def show_check(check: Check) -> None:
    """One point of a verdict."""
    mark, style = {True: ("ok", "green"), None: ("n/t", "dim")}.get(check.passed, ("look", "yellow"))
    _console.print(f"[{style}]{mark:>4}[/{style}]  ", end="")
    say(f"{check.name}: {sentence_of(check)}")

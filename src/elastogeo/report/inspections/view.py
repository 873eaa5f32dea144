"""The view of an inspected file, and `elastogeo.inspection/1`, its document.

path, kind, format, runs, duration_s, metadata, notes, problem : as `Inspected` has them
columns : [{name, unit, quantity, guess, count, numbers, first, low, high, rate_Hz}]
channels : [{quantity, channel, unit}], entries `[[channels]]` of a test or drive file
renamed : {our name with its unit: header of the file}, the table `columns` of a test file
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from elastogeo.formats import Inspected, InspectedColumn
from elastogeo.report.document import document
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.view import KeyValue, Section, Table, View, views

SCHEMA = "elastogeo.inspection/1"
_KINDS = {
    "run": "run file, readings of an instrument",
    "readings": "set of readings for elastogeo calibrate",
    "log": "log of a control or data logger",
    "recording": "recording of elastogeo record",
    "test": "test file",
    "drive": "drive file",
    "machine": "machine file",
    "simulation": "simulation file",
    "calibration": "calibration file",
}


@views(Inspected)
def inspection_view(found: Inspected) -> View:
    """All that is shown of an inspected file."""
    rows = tuple(_row(column) for column in found.columns)
    headings = ("column", "unit", "quantity", "values", "least", "greatest", "rate [Hz]", "first values")
    table = Table(headings, rows, words=(0, 1, 2, 7))
    entries = _document(found)
    mapping = tuple(_mapping(found))
    return View(
        kind="File",
        title=found.path,
        subtitle=found.format,
        origin="",
        head=(("Format", found.format), ("Kind", _KINDS.get(found.kind, found.kind))),
        sentence=_answer(found),
        values=(KeyValue("columns", str(len(found.columns))),),
        document=entries,
        rows=entries["columns"],
        alert=(found.problem,) if found.problem else (),
        tables=(table,) if rows else (),
        notes=(*(f"{key}: {value}" for key, value in found.metadata.items()), *found.notes, *mapping),
        sections=(Section("Columns", tables=(table,), points=mapping),) if rows else (),
    )


def _answer(found: Inspected) -> str:
    kind = _KINDS.get(found.kind, found.kind)
    runs = f", {found.runs} runs" if found.runs > 1 else ""
    length = "" if found.duration is None else f", {significant(found.duration, 3)} s"
    if not found.columns:
        return f"It is a {kind} ({found.format})."
    known, columns = sum(1 for column in found.columns if column.quantity), len(found.columns)
    read = "understood as they stand" if known == columns else f"{known} of them understood as they stand"
    return f"It is a {kind} ({found.format}){runs}{length}: {columns} columns, {read}."


def _row(column: InspectedColumn) -> tuple[str, ...]:
    count = str(column.count) if column.numbers == column.count else f"{column.numbers} of {column.count}"
    return (
        column.name,
        column.unit or "none said",
        column.quantity or (f"{column.guess}?" if column.guess else "not known"),
        count,
        *(("–" if end is None else pretty(significant(end, 5))) for end in (column.low, column.high)),
        "–" if column.rate is None else significant(column.rate, 4),
        pretty(", ".join("no number" if value != value else f"{value:.6g}" for value in column.first)),
    )


def _mapping(found: Inspected) -> Iterable[str]:
    """What to write into a test or drive file; a quantity with a question mark in the table is a guess."""
    if found.channels and not all(column.quantity for column in found.columns):
        yield "In a test or drive file, to be confirmed:"
        for entry in found.channels:
            yield "\n".join(["[[channels]]", *(f'{key} = "{value}"' for key, value in entry.items())])
    if found.renamed:
        yield "In a test file, to be confirmed:"
        yield "\n".join(["[columns]", *(f'"{ours}" = "{theirs}"' for ours, theirs in found.renamed.items())])


def _document(found: Inspected) -> dict[str, Any]:
    return document(
        SCHEMA,
        {
            "path": found.path,
            "kind": found.kind,
            "format": found.format,
            "runs": found.runs,
            "duration_s": found.duration,
            "metadata": found.metadata,
            "notes": found.notes,
            "problem": found.problem,
            "columns": [
                {
                    "name": column.name,
                    "unit": column.unit,
                    "quantity": column.quantity,
                    "guess": column.guess,
                    "count": column.count,
                    "numbers": column.numbers,
                    "first": column.first,
                    "low": column.low,
                    "high": column.high,
                    "rate_Hz": column.rate,
                }
                for column in found.columns
            ],
            "channels": list(found.channels),
            "renamed": found.renamed,
        },
    )

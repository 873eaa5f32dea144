"""The view of identified feed drives: friction and inertia of every axis, and which model predicts runs it has not seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from elastogeo.drive import DriveTest
from elastogeo.identification.feed_drives import AxisDrive, DriveIdentification
from elastogeo.report.days import origin_said
from elastogeo.report.feed_drives.document import drive_json
from elastogeo.report.feed_drives.rows import (
    drive_rows,
    identified,
    model_rows,
    note_sentences,
    samples_sentence,
    score_rows,
    searched_sentence,
)
from elastogeo.report.head import about_lines
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST_VALUES = 5
_FIRST = ("coulomb", "viscous", "inertia")
"""Terms that the first screen shows, in this order, before others."""
_CAPTIONS = {
    "friction": "What each motor takes over the velocity of its axis, less what inertia and loads take, and the friction of "
    "the model.",
    "run": "A run as it was recorded, and as it is predicted from all others.",
    "models": "Error of each model at left-out runs; the line is that of the first. Orange: what the runs support.",
}


@views(DriveIdentification)
def drive_view(result: DriveIdentification) -> View:
    """All that is shown of identified feed drives."""
    test = result.test
    told = identified(result)
    pictures = {name: _picture(name, result) for name in _CAPTIONS if name != "models" or any(a.models for a in told)}
    tables = tuple(table for axis in result.axes for table in _tables(axis))
    document = drive_json(result)
    return View(
        kind="Feed drives",
        title=test.name,
        subtitle=f"axes {', '.join(test.axes)}",
        origin=origin_said("simulated", test.simulated),
        head=_head(test),
        sentence=_answer(result),
        values=_values([axis for axis in result.axes if axis.parameters]),
        picture=pictures["friction"] if told else None,
        checks=said(result.verdict),
        document=document,
        rows=[{"axis": axis["axis"], **entry} for axis in document["axes"] for entry in axis["parameters"]],
        tables=tables,
        notes=(*_notes(result), *note_sentences(result)),
        sections=tuple(_sections(result, pictures if told else {})),
    )


def _head(test: DriveTest) -> tuple[tuple[str, str], ...]:
    steps = sorted({record.step for record in test.records})
    apart = " to ".join(f"{1000 * step:.4g}" for step in (steps[0], steps[-1])[: 1 + (steps[-1] > 1.001 * steps[0])])
    samples = sum(len(record.time) for record in test.of(test.axes[0]))
    lines = (
        *about_lines(test.about),
        ("Runs", f"{len(test.runs)}, {samples} samples of each axis, one every {apart} ms"),
        ("Held out", ", ".join(test.held_out)),
        ("Remarks", test.about.remarks),
        ("Files", f"{len(test.files)}, their SHA-256 below" if test.files else ""),
    )
    return tuple((label, text) for label, text in lines if text)


def _answer(result: DriveIdentification) -> str:
    told = identified(result)
    sums = [axis.axis for axis in result.axes if axis.parameters and axis not in told]
    untold = [axis.axis for axis in result.axes if not axis.parameters]
    left = [f"{significant(axis.left_out.rmse, 3)} {axis.effort_unit} ({axis.axis})" for axis in told if axis.left_out]
    how = f"; left-out runs are predicted to {', '.join(left)} RMSE" if left else ""
    parts = (
        f"Friction and inertia of {', '.join(axis.axis for axis in told)} are identified{how}." if told else "",
        f"Of {', '.join(sums)} some terms are determined as sums only." if sums else "",
        f"{', '.join(untold)} cannot be identified." if untold else "",
        attention_sentence(result.verdict),
    )
    return " ".join(part for part in parts if part)


def _values(axes: list[AxisDrive]) -> tuple[KeyValue, ...]:
    """Whole terms of all axes, as many as there is room for: friction before inertia, and this before the rest."""
    known = [(axis.axis, p.name, row) for axis in axes for p, row in zip(axis.parameters, drive_rows(axis), strict=True)]
    names = sorted({name for _, name, _ in known}, key=_rank)
    shown: list[KeyValue] = []
    for name in names:
        of_all = [
            KeyValue(f"{row.name}, {axis}", pretty(row.value), row.unit, row.meaning)
            for axis, term, row in known
            if term == name
        ]
        if shown and len(shown) + len(of_all) > _MOST_VALUES:
            break
        shown += of_all
    return tuple(shown[:_MOST_VALUES])


def _rank(name: str) -> tuple[int, str]:
    kind = name.split()[0]
    return (_FIRST.index(kind) if kind in _FIRST else len(_FIRST), name)


def _tables(axis: AxisDrive) -> tuple[Table, ...]:
    tables = []
    if axis.parameters:
        rows = [(r.name, pretty(r.value), r.unit, pretty(r.at_motor), r.meaning) for r in drive_rows(axis)]
        headings = ("term", "value ± U (95 %)", "unit", "at the motor", "what")
        tables.append(_table(headings, rows, {0, 2, 3, 4}, f"Axis {axis.axis}", samples_sentence(axis)))
    if axis.fit is not None and axis.structure is not None:
        scores = [(r.run, r.samples, r.rmse, r.r2, r.from_) for r in score_rows(axis)]
        headings = ("run", "samples", f"RMSE [{axis.effort_unit}]", "R²", "predicted from")
        note = f"RMSE {axis.fit.rmse:.4g} {axis.effort_unit}, R² {axis.fit.r2:.3f}"
        tables.append(_table(headings, scores, {0, 4}, f"Axis {axis.axis}, runs", note))
    if axis.models:
        unit = axis.effort_unit
        models = [
            (r.name, r.parameters, r.searched, r.rmse, r.left_out, r.held_out, pretty(r.gain_percent), r.better)
            for r in model_rows(axis)
        ]
        heads = (
            "model",
            "parameters",
            "searched",
            f"RMSE [{unit}]",
            f"left-out runs [{unit}]",
            f"held-out runs [{unit}]",
            "gain [%]",
            "surely better",
        )
        note = "* what the runs support: of possible models, the simplest that none surely beats. Another: --model NAME"
        tables.append(_table(heads, models, {0, 2, 7}, f"Axis {axis.axis}, models", note))
    return tuple(tables)


def _table(headings: Sequence[str], rows: Sequence[tuple[str, ...]], words: set[int], title: str, note: str) -> Table:
    """A table without the columns that hold nothing."""
    kept = [k for k in range(len(headings)) if any(row[k] for row in rows)]
    return Table(
        tuple(headings[k] for k in kept),
        tuple(tuple(row[k] for k in kept) for row in rows),
        words=tuple(n for n, k in enumerate(kept) if k in words),
        title=title,
        note=note,
    )


def _notes(result: DriveIdentification) -> list[str]:
    searched = [searched_sentence(value) for axis in result.axes if axis.fit for value in axis.fit.searched]
    return searched + [f"Not compared: {name}: {why}" for axis in result.axes for name, why in axis.not_compared.items()]


def _sections(result: DriveIdentification, pictures: dict[str, Picture]) -> list[Section]:
    sections = [Section(f"Axis {axis.axis}", _refusal(axis), tables=_tables(axis)) for axis in result.axes]
    rest = tuple(picture for name, picture in pictures.items() if name != "friction")
    return [
        *sections,
        Section("How well runs are predicted", pictures=rest),
        Section("The logs", points=tuple(result.test.notes)),
        *([Section("Files", tables=(_files(result.test),))] if result.test.files else []),
    ]


def _refusal(axis: AxisDrive) -> tuple[str, ...]:
    return (f"{axis.refusal[:1].upper()}{axis.refusal[1:]}.",) if axis.refusal else ()


def _files(test: DriveTest) -> Table:
    rows = tuple((run, file, sha256) for run, (file, sha256) in test.files.items())
    return Table(("run", "file", "SHA-256"), rows, words=(0, 1, 2))


def _picture(name: str, result: DriveIdentification) -> Picture:
    return Picture(name, _CAPTIONS[name], _CAPTIONS[name], lambda: _drawn(name, result))


def _drawn(name: str, result: DriveIdentification) -> Figure:
    from elastogeo.report.feed_drives.figures import friction_figure, models_figure, run_figure

    return {"friction": friction_figure, "run": run_figure, "models": models_figure}[name](result)

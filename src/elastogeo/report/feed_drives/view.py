"""The view of identified feed drives: friction and inertia of every axis, and which model predicts runs it has not seen."""

from __future__ import annotations

from typing import TYPE_CHECKING

from elastogeo.identification.feed_drives import AxisDrive, DriveIdentification
from elastogeo.report.feed_drives.document import drive_json
from elastogeo.report.feed_drives.rows import (
    drive_rows,
    model_rows,
    note_sentences,
    samples_sentence,
    score_rows,
    searched_sentence,
)
from elastogeo.report.numbers import pretty
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KEY_VALUES = 5
_CAPTIONS = {
    "friction": "Effort over speed, less what inertia and loads take, and the friction of the model.",
    "run": "A run as it was recorded, and as it is predicted from all others.",
    "models": "Error of each model: at the runs it was identified from, and at left-out runs.",
}


@views(DriveIdentification)
def drive_view(result: DriveIdentification) -> View:
    """All that is shown of identified feed drives."""
    test = result.test
    told = [axis for axis in result.axes if axis.fit is not None and axis.fit.separated]
    pictures = {name: _picture(name, result) for name in _CAPTIONS if name != "models" or any(a.models for a in told)}
    tables = tuple(table for axis in result.axes for table in _tables(axis))
    document = drive_json(result)
    return View(
        kind="Feed drives",
        title=test.name,
        subtitle=f"axes {', '.join(test.axes)}",
        origin=f"Simulated: {test.simulated}" if test.simulated else "",
        head=(("Runs", str(len(test.runs))), ("Axes", ", ".join(test.axes))),
        sentence=_answer(result),
        values=_values(told),
        picture=pictures["friction"] if told else None,
        checks=said(result.verdict),
        document=document,
        rows=[{"axis": axis["axis"], **entry} for axis in document["axes"] for entry in axis["parameters"]],
        tables=tables,
        notes=(*_notes(result), *note_sentences(result)),
        sections=tuple(_sections(result, pictures if told else {})),
    )


def _answer(result: DriveIdentification) -> str:
    told = [axis.axis for axis in result.axes if axis.parameters]
    untold = [axis.axis for axis in result.axes if not axis.parameters]
    lead = f"Friction and inertia of {', '.join(told)} are identified" if told else "No axis is identified"
    rest = f"; {', '.join(untold)} cannot be" if told and untold else ""
    return f"{lead}{rest}. {attention_sentence(result.verdict)}"


def _values(told: list[AxisDrive]) -> tuple[KeyValue, ...]:
    rows = [(axis.axis, row) for axis in told for row in drive_rows(axis)]
    return tuple(KeyValue(f"{axis} {row.name}", pretty(row.value), row.unit, row.meaning) for axis, row in rows[:KEY_VALUES])


def _tables(axis: AxisDrive) -> tuple[Table, ...]:
    tables = []
    if axis.parameters:
        rows = tuple((r.name, pretty(r.value), r.unit, pretty(r.at_motor), r.meaning) for r in drive_rows(axis))
        headings = ("term", "value ± U (95 %)", "unit", "at the motor", "what")
        tables.append(Table(headings, rows, words=(0, 2, 3, 4), title=f"Axis {axis.axis}", note=samples_sentence(axis)))
    if axis.fit is not None and axis.structure is not None:
        scores = tuple((r.run, r.samples, r.rmse, r.r2, r.from_) for r in score_rows(axis))
        headings = ("run", "samples", f"RMSE [{axis.effort_unit}]", "R²", "predicted from")
        note = f"RMSE {axis.fit.rmse:.4g} {axis.effort_unit}, R² {axis.fit.r2:.3f}"
        tables.append(Table(headings, scores, words=(0, 4), title=f"Axis {axis.axis}, runs", note=note))
    if axis.models:
        models = tuple(
            (r.name, r.parameters, r.searched, r.rmse, r.left_out, r.held_out, pretty(r.gain_percent), r.better)
            for r in model_rows(axis)
        )
        heads = ("model", "parameters", "searched", "RMSE", "left-out runs", "held-out runs", "gain [%]", "surely better")
        note = "* what the runs support: of possible models, the simplest that none surely beats. Another: --model NAME"
        tables.append(Table(heads, models, words=(0, 2, 7), title=f"Axis {axis.axis}, models", note=note))
    return tuple(tables)


def _notes(result: DriveIdentification) -> list[str]:
    searched = [searched_sentence(value) for axis in result.axes if axis.fit for value in axis.fit.searched]
    return searched + [f"Not compared: {name}: {why}" for axis in result.axes for name, why in axis.not_compared.items()]


def _sections(result: DriveIdentification, pictures: dict[str, Picture]) -> list[Section]:
    sections = [Section(f"Axis {axis.axis}", tables=_tables(axis)) for axis in result.axes]
    rest = tuple(picture for name, picture in pictures.items() if name != "friction")
    return [
        *sections,
        Section("How well runs are predicted", pictures=rest),
        Section("The logs", points=tuple(result.test.notes)),
    ]


def _picture(name: str, result: DriveIdentification) -> Picture:
    return Picture(name, _CAPTIONS[name], _CAPTIONS[name], lambda: _drawn(name, result))


def _drawn(name: str, result: DriveIdentification) -> Figure:
    from elastogeo.report.feed_drives.figures import drive_figures

    return drive_figures(result)[name]

"""What a person sees of identified feed drives at the terminal. Nothing is computed here."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from elastogeo.cli import screen
from elastogeo.identification.feed_drives import AxisDrive, DriveIdentification
from elastogeo.report import (
    drive_rows,
    model_rows,
    note_sentences,
    samples_sentence,
    score_rows,
    searched_sentence,
)


def show_drives(result: DriveIdentification) -> None:
    """Parameters, runs, models and verdict of every axis."""

    test = result.test
    screen.say(f"{test.name}: {len(test.runs)} runs, axes {', '.join(test.axes)}")
    if test.simulated:
        screen.say(f"Simulated data. {test.simulated}")
    for sentence in note_sentences(result):
        screen.say(sentence)
    for found in result.axes:
        screen.say("")
        _show_axis(found)


def _show_axis(found: AxisDrive) -> None:
    screen.say(f"Axis {found.axis}. {samples_sentence(found)}")
    if found.parameters:
        rows = [(row.name, row.value, row.unit, row.at_motor, row.meaning) for row in drive_rows(found)]
        _show_rows(("term", "value ± U (95 %)", "unit", "at the motor", "what"), rows, left=(0, 2, 3, 4))
    if found.fit is not None and found.structure is not None:
        screen.say(f"RMSE {found.fit.rmse:.4g} {found.effort_unit}, R2 {found.fit.r2:.3f}")
        for value in found.fit.searched:
            screen.say(searched_sentence(value))
        scores = [(row.run, row.samples, row.rmse, row.r2, row.from_) for row in score_rows(found)]
        _show_rows(("run", "samples", f"RMSE [{found.effort_unit}]", "R2", "predicted from"), scores, left=(0, 4))
    if found.models:
        headings = ("model", "parameters", "searched", "RMSE", "left-out runs", "gain [%]", "surely better")
        models = [
            (row.name, row.parameters, row.searched, row.rmse, row.left_out, row.gain_percent, row.better)
            for row in model_rows(found)
        ]
        _show_rows(headings, models, left=(0, 2, 6))
        screen.say("* what the runs support: of models without an impossible value, the simplest that none surely beats")
    for name, why in found.not_compared.items():
        screen.say(f"Not compared: {name}: {why}")
    for check in found.verdict:
        screen.show_check(check)


def _show_rows(headings: Sequence[str], rows: Iterable[Sequence[str]], left: Sequence[int]) -> None:
    table = screen.empty_table(headings, left)
    for row in rows:
        table.add_row(*(cell.replace("[", "\\[") for cell in row))
    screen.show_table(table)
    screen.say("")

"""The rows of the tables of a feed drive in words and figures: one place for the page and the command line."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from elastogeo.drive import EVERY_LOG, RunScore, Searched
from elastogeo.identification.feed_drives import AxisDrive, DriveIdentification, rmse_of
from elastogeo.report.drive_terms import term_name
from elastogeo.report.numbers import said_estimate, significant, written_unit
from elastogeo.report.text import combination

_UNIT_AT_MOTOR = {"kg m^2": "kg·m²", "N m s/rad": "N·m·s/rad"}
NOTES = 5
"""Sentences on the logs that are shown; the JSON has all."""


@dataclass(frozen=True, slots=True)
class DriveRow:
    """One parameter: what it is called, `value ± U` (half the 95 % interval), its unit, at the motor's shaft, in words."""

    name: str
    value: str
    unit: str
    at_motor: str
    meaning: str


@dataclass(frozen=True, slots=True)
class ScoreRow:
    """One run: how well it is predicted, and from what."""

    run: str
    samples: str
    rmse: str
    r2: str
    from_: str


@dataclass(frozen=True, slots=True)
class ModelRow:
    """One compared model."""

    name: str
    parameters: str
    searched: str
    rmse: str
    left_out: str
    held_out: str
    gain_percent: str
    better: str


def identified(result: DriveIdentification) -> list[AxisDrive]:
    """The axes whose every term has a number of its own."""
    return [axis for axis in result.axes if axis.fit is not None and axis.fit.separated]


def drive_rows(axis: AxisDrive) -> tuple[DriveRow, ...]:
    """The parameters of an axis; a sum of terms that are not distinguished stands under all their names."""
    rows = []
    for p in axis.parameters:
        at_motor = ""
        if p.at_motor:
            estimate, unit = p.at_motor
            at_motor = f"{said_estimate(estimate)} {_UNIT_AT_MOTOR[unit]}"
        mixed = len(p.stands_for) > 1
        meaning = "not distinguished" if mixed else p.meaning
        name = term_name(p.name) if not mixed else combination(p.stands_for)
        rows.append(DriveRow(name, said_estimate(p.estimate), written_unit(p.unit), at_motor, meaning))
    return tuple(rows)


def score_rows(axis: AxisDrive) -> tuple[ScoreRow, ...]:
    """Every run once: the held-out ones from those identified, each of these from all others."""
    left = axis.left_out.scores if axis.left_out else axis.identified
    how = "all other runs" if axis.left_out else "this run itself"
    return (*_scores(left, how), *_scores(axis.held_out, "the runs that are not held out"))


def model_rows(axis: AxisDrive) -> tuple[ModelRow, ...]:
    """The compared models, in their order."""
    return tuple(
        ModelRow(
            name=f"{model.name} *" if model.name == axis.supported else model.name,
            parameters=str(len(model.fit.solution.labels) + len(model.fit.searched)),
            searched=", ".join(map(searched_words, model.fit.searched)),
            rmse=significant(model.fit.rmse, 4),
            left_out=significant(model.left_out.rmse, 4),
            held_out="" if rmse_of(model.held_out) is None else significant(rmse_of(model.held_out) or 0.0, 4),
            gain_percent=f"{100 * model.gain:.1f}" if k else "",
            better=_better(model.better, model.impossible) if k else "",
        )
        for k, model in enumerate(axis.models)
    )


def searched_words(found: Searched) -> str:
    """A searched parameter: `delay 12.5 ms`."""
    name = found.name.replace("_", " ")
    value = f"{found.value * 1000:.3g} ms" if found.unit == "s" else f"{found.value:.3g} {found.unit}".rstrip()
    return f"{name} {value}{' (an end of what was searched)' if found.at_bound else ''}"


def searched_sentence(found: Searched) -> str:
    """A searched parameter with its interval."""
    factor, unit = (1000.0, "ms") if found.unit == "s" else (1.0, found.unit)
    low, high = (None if end is None else f"{end * factor:.3g}" for end in found.interval)
    return f"{searched_words(found)}, 95 % from {low or 'the least searched'} to {high or 'the most searched'} {unit}"


def samples_sentence(axis: AxisDrive) -> str:
    """How many samples were used."""
    if axis.fit is None:
        return ""
    used = sum(axis.fit.samples.values())
    left = f"{axis.fit.left_out} left out as at rest, too slow or without a motion"
    return f"Model {axis.model}{_standing(axis)}: {used} samples of {len(axis.fit.samples)} runs, {left}"


def _standing(axis: AxisDrive) -> str:
    if not axis.supported:
        return ""
    return ", which the runs support" if axis.supported == axis.model else f"; the runs support {axis.supported}"


def note_sentences(result: DriveIdentification) -> list[str]:
    """What was done to the logs: first what holds for all of them."""
    notes = sorted(result.test.notes, key=lambda note: not note.startswith(EVERY_LOG))
    more = [f"... and {len(notes) - NOTES} more; --json has all"] if len(notes) > NOTES else []
    return notes[:NOTES] + more


def _scores(scores: Iterable[RunScore], how: str) -> list[ScoreRow]:
    return [ScoreRow(s.run, str(s.samples), significant(s.rmse, 4), f"{s.r2:.3f}", how) for s in scores]


def _better(surely: bool, impossible: tuple[str, ...]) -> str:
    if impossible:
        return f"{'yes' if surely else 'no'}, but with a negative {', '.join(impossible)}"
    return "yes" if surely else "no"

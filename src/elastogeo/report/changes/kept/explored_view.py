"""The view of the readings of one test (`elastogeo.explore/1`): what a person looks into by himself.

test, name, machine, series, date, origin : which test
along : {quantity, unit}, what the readings count along
unit : of the readings, `um` or `urad`
readings, shown : how many there are, and how many of them are here
runs : [{run, force_N, direction, readings, along, measured, predicted}]; `direction` is `ccw`, `cw` or empty; `predicted` by
    the kept parameters, null where there are none. Readings are less the reference if one is subtracted, and less the run's
    own set-up; lengths to 0.1 nm, which is far below what an instrument tells
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.changes import NO_READINGS, NOT_EXPLAINED, Explored, ExploredRun
from elastogeo.machine import Array
from elastogeo.report.days import date_said, iso_date, origin_said
from elastogeo.report.document import document
from elastogeo.report.numbers import significant
from elastogeo.report.text import MICRO, UM
from elastogeo.report.view import Table, View, lines, views

_PLACES, _PLACES_ALONG = 4, 5
_DIRECTIONS = {1: "ccw", -1: "cw", 0: ""}


@lines(ExploredRun)
def explored_run_line(run: ExploredRun) -> str:
    """`ccw-500: 500 N, 90 readings`."""
    return f"{run.run}: {run.force:g} N, {run.readings} readings"


@views(Explored)
def explored_view(found: Explored) -> View:
    """The runs of a test, and what is left between reading and model."""
    angular = any(run.angular for run in found.runs)
    factor, unit = (MICRO, "urad") if angular else (UM, "um")
    turned = found.unit == "deg" or found.quantity == "angle"
    runs = [_run(run, factor, 180 / np.pi if turned else 1.0) for run in found.runs]
    along = {"quantity": found.quantity, "unit": "deg" if turned else found.unit}
    return View(
        kind="Readings",
        title=found.machine,
        subtitle=f"{found.name}, {date_said(found.date)}",
        origin="" if found.origin == "measured" else origin_said(found.origin, found.from_what or found.origin),
        sentence=_answer(found),
        document=document(
            "elastogeo.explore/1",
            {
                "test": found.key,
                "name": found.name,
                "machine": found.machine,
                "series": found.recipe,
                "date": iso_date(found.date),
                "origin": found.origin,
                "along": along,
                "unit": unit,
                "readings": found.readings,
                "shown": found.shown,
                "runs": runs,
            },
        ),
        rows=_rows(runs, along["quantity"] or "along", unit),
        tables=(_table(found, factor, unit),) if found.runs else (),
        notes=(_thinned(found),) if found.shown < found.readings else (),
    )


def _run(run: ExploredRun, factor: float, along: float) -> dict[str, Any]:
    return {
        "run": run.run,
        "force_N": run.force,
        "direction": _DIRECTIONS[run.sense],
        "readings": run.readings,
        "along": _rounded(run.pose * along, _PLACES_ALONG),
        "measured": _rounded(run.measured * factor, _PLACES),
        "predicted": None if run.predicted is None else _rounded(run.predicted * factor, _PLACES),
    }


def _rounded(values: Array, places: int) -> list[float]:
    return [round(float(value), places) + 0.0 for value in values]


def _rows(runs: list[dict[str, Any]], along: str, unit: str) -> list[dict[str, Any]]:
    """A row a reading."""
    return [
        {
            "run": run["run"],
            "force_N": run["force_N"],
            "direction": run["direction"],
            along: at,
            f"measured_{unit}": measured,
            f"predicted_{unit}": predicted,
        }
        for run in runs
        for at, measured, predicted in zip(
            run["along"], run["measured"], run["predicted"] or [None] * len(run["measured"]), strict=True
        )
    ]


def _table(found: Explored, factor: float, unit: str) -> Table:
    shown = "µrad" if unit == "urad" else "µm"
    return Table(
        ("run", "force [N]", "direction", "readings", f"left over, RMS [{shown}]"),
        tuple(
            (run.run, f"{run.force:g}", _DIRECTIONS[run.sense].upper(), str(run.readings), _left(run, factor))
            for run in found.runs
        ),
        words=(0, 2),
        name="runs",
        keys=tuple(run.run for run in found.runs),
    )


def _left(run: ExploredRun, factor: float) -> str:
    if run.predicted is None:
        return ""
    return significant(float(np.sqrt(np.mean((run.measured - run.predicted) ** 2))) * factor)


def _answer(found: Explored) -> str:
    if found.refusal == NO_READINGS:
        return "This test has no readings that could be looked into here: its page says what it tells."
    runs = f"{len(found.runs)} {'run' if len(found.runs) == 1 else 'runs'} with {found.readings} readings"
    if found.refusal == NOT_EXPLAINED:
        return f"{runs}; no model stands beside them, since the test determines no parameters."
    return f"{runs}, what the identified model says of them, and what is left."


def _thinned(found: Explored) -> str:
    return (
        f"{found.shown} of {found.readings} readings are shown: of each short piece of a run the one with the least and the "
        f"one with the greatest residual."
    )

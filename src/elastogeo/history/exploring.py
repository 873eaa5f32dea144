"""The readings of a test of the store, with what its kept parameters predict: nothing is estimated again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from elastogeo.changes import NO_READINGS, NOT_EXPLAINED, Explored, ExploredRun
from elastogeo.errors import ElastogeoError
from elastogeo.history.analyses.raw import raw_files
from elastogeo.history.comparing import counted_test, identification_in, kept_document, read_of
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, read
from elastogeo.identification import RunSystem, Trace, identify, systems_of
from elastogeo.machine import Array
from elastogeo.observe import MachineTest

MOST = 30_000
"""Readings that are shown of a test: about 0.8 MB of JSON."""


def explore(store: Store, key: int, most: int = MOST) -> Explored:
    """The readings of a test and what is predicted of them.

    Parameters
    ----------
    store : Store
    key : int
        Of the test.
    most : int
        Readings above which runs are thinned: of each short piece the one with the least and the one with the greatest
        residual stay.

    Raises
    ------
    InputError
        If there is no such test.
    StoreError
        If a raw file is missing or damaged.
    """
    with read(store) as connection:
        row = counted_test(connection, key)
        document = None if row.analysis is None or row.error else kept_document(connection, row.analysis)
        raw = raw_files(connection, key)
    found = read_of(store.files, raw)
    runs: tuple[ExploredRun, ...] = ()
    explained = False
    if found is not None:
        every, explained = _traces(found, document)
        runs = tuple(_explored(found, trace, angular, explained) for trace, angular in every)
    total = sum(run.readings for run in runs)
    quantity = "" if found is None else found.setup.pose_quantity
    return Explored(
        key=key,
        name=row.name,
        machine=row.machine_name,
        recipe=row.recipe_name,
        date=days(row.at),
        origin=row.origin,
        from_what=row.from_what,
        quantity=quantity,
        unit="" if found is None else found.setup.file_units.get(quantity, ""),
        runs=runs if total <= most else tuple(thinned_run(run, max(most * run.readings // total, 2)) for run in runs),
        refusal=NO_READINGS if not runs else "" if explained else NOT_EXPLAINED,
    )


def _traces(test: MachineTest, document: Mapping[str, Any] | None) -> tuple[list[tuple[Trace, bool]], bool]:
    """The runs of a test, each with whether it reads angles; whether what is predicted is."""
    kept = None if document is None else identification_in(document)
    try:
        runs = systems_of(test).runs
        if kept is None:
            return [(_trace(run, np.zeros(run.readings)), run.angular) for run in runs], False
        if test.question.robust:  # the weights of the readings decide where each circle lies
            traces = identify(test).traces
            return [(trace, run.angular) for trace, run in zip(traces, runs, strict=True)], True
        names = [entry["name"] for entry in kept["parameters"]]
        values = np.array([entry["value"] for entry in kept["parameters"]], dtype=float)
        return [(_trace(run, run.design_of(names) @ values), run.angular) for run in runs], True
    except ElastogeoError:  # what cannot be asked can still be looked at
        return [(_plain(run), bool(run.direction[:, 3:].any())) for run in test.observations()], False


def _trace(run: RunSystem, predicted: Array) -> Trace:
    return Trace(run.name, run.force, run.observations.pose, run.reading.copy(), predicted, run.test)


def _plain(run: Any) -> Trace:
    return Trace(run.run, run.force, run.pose, run.reading, np.zeros(len(run.reading)), "")


def _explored(test: MachineTest, trace: Trace, angular: bool, explained: bool) -> ExploredRun:
    around = test.setup.pose_quantity == "angle"
    sense = next((run.sense for run in test.runs if run.name == trace.run), 0) if around else 0
    predicted = trace.predicted if explained else None
    return ExploredRun(trace.run, trace.force, sense, trace.pose, trace.measured, predicted, angular, len(trace.measured))


def thinned_run(run: ExploredRun, most: int) -> ExploredRun:
    """A run with at most so many of its readings: of each short piece those with the least and the greatest residual."""
    if len(run.measured) <= most:
        return run
    left = run.measured if run.predicted is None else run.measured - run.predicted
    chosen = np.array(sorted(set(_extremes(left, max(most // 2, 1)))))
    predicted = None if run.predicted is None else run.predicted[chosen]
    return ExploredRun(
        run.run, run.force, run.sense, run.pose[chosen], run.measured[chosen], predicted, run.angular, run.readings
    )


def _extremes(left: Array, pieces: int) -> Iterator[int]:
    for first, last in pairwise(np.linspace(0, len(left), pieces + 1).astype(int).tolist()):
        if last > first:
            yield first + int(np.argmin(left[first:last]))
            yield first + int(np.argmax(left[first:last]))

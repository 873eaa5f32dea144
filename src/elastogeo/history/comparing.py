"""Two tests of the store against each other, from what is kept of them: the same at once as asking them again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime
from math import inf, nan
from typing import Any

import numpy as np
from sqlalchemy import Connection, Row, Select, func, select

from elastogeo.changes import (
    FEW_RUNS,
    NOT_ANALYSED,
    NOTHING_IN_COMMON,
    OTHER_MACHINE,
    CircleTrace,
    Comparable,
    ComparedTest,
    ComparedTests,
    IndicatorDifference,
    ParameterDifference,
    SettingDifference,
    indicator_differences,
    reference_of,
    within_scatter,
)
from elastogeo.errors import InputError
from elastogeo.estimate import Solution
from elastogeo.formats import read_test
from elastogeo.history.alarms.baselines import baseline_of
from elastogeo.history.alarms.priors import prior_of
from elastogeo.history.analyses.raw import RawFile, laid_out, raw_files
from elastogeo.history.intake.recipes import differing
from elastogeo.history.series_of import days, series_of
from elastogeo.history.store import Files, Store, read
from elastogeo.history.store.schema import analysis, machine, series, test
from elastogeo.identification import Change, Check, Determined, Difference, differences_of, in_common, unchanged
from elastogeo.machine import Array
from elastogeo.observe import MachineTest

TEST = "test.toml"
_SELDOM_SAID = ("date", "imported_from", "remarks")
"""Of what a test says of itself: what differs always, or is no setting."""
_UM = 1000.0

Sides = tuple["Row[Any]", "Row[Any]"]
Documents = tuple[Mapping[str, Any], Mapping[str, Any]]


def compare_tests(store: Store, one: int, other: int) -> ComparedTests:
    """Two tests held against each other, the earlier one first.

    The parameters are those of the analyses that their charts count with: the same numbers as `eg.compare` of the two.

    Raises
    ------
    InputError
        If there is no such test, or both are one.
    StoreError
        If a raw file is missing or damaged.
    """
    if one == other:
        raise InputError("this is one test; choose another to compare it with")
    with read(store) as connection:
        before, after = sorted((counted_test(connection, key) for key in (one, other)), key=lambda row: (row.at, row.id))
        rows = before, after
        refusal = _refusal(before, after)
        tests = _compared(before), _compared(after)
        settings = tuple(_settings(before, after))
        if refusal:
            return ComparedTests(*tests, refusal, (), 0, (), None, "", settings, (), None, (), ())
        indicators, baseline = _indicators(connection, before, after)
        documents = tuple(kept_document(connection, row.analysis) for row in rows)
        raw = tuple(raw_files(connection, row.id) for row in rows)
    parameters, joint, unjudged, verdict = _parameters((documents[0], documents[1]))
    if not indicators and unjudged == NOTHING_IN_COMMON:
        refusal = NOTHING_IN_COMMON
    traces, radius, axes = _circles(store.files, raw) if not refusal else ((), None, ())
    checks = (within_scatter(indicators), *verdict)
    return ComparedTests(
        *tests, refusal, indicators, baseline, parameters, joint, unjudged, settings, traces, radius, axes,
        tuple(check for check in checks if check is not None),
    )  # fmt: skip


def comparable(store: Store, one: int) -> Comparable:
    """The tests of the machine of a test, the newest first.

    Raises
    ------
    InputError
        If there is no such test.
    """
    with read(store) as connection:
        owner = counted_test(connection, one)
        asked = _asked().where(series.c.machine == owner.machine_key).order_by(test.c.at.desc(), test.c.id.desc())
        rows = connection.execute(asked).all()
    return Comparable(owner.machine_name, tuple(_compared(row) for row in rows))


def counted_test(connection: Connection, key: int) -> Row[Any]:
    """A test with its series, and the analysis that its chart counts with.

    Raises
    ------
    InputError
        If there is no such test.
    """
    found = connection.execute(_asked().where(test.c.id == key)).one_or_none()
    if found is None:
        raise InputError(f"there is no test {key}; elastogeo history show lists those of a machine")
    return found


def _asked() -> Select[Any]:
    """Tests with their series, and the analyses that their charts count with."""
    last = (
        select(func.max(analysis.c.id))
        .where(analysis.c.test == test.c.id, analysis.c.software == series.c.software)
        .correlate(test, series)
        .scalar_subquery()
    )
    return (
        select(
            test,
            series.c.name.label("recipe_name"),
            series.c.recipe,
            series.c.software,
            series.c.machine.label("machine_key"),
            machine.c.name.label("machine_name"),
            last.label("analysis"),
            select(analysis.c.error).where(analysis.c.id == last).scalar_subquery().label("error"),
        )
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
    )


def _refusal(before: Row[Any], after: Row[Any]) -> str:
    if before.machine_key != after.machine_key:
        return OTHER_MACHINE
    return NOT_ANALYSED if any(row.analysis is None or row.error for row in (before, after)) else ""


def _compared(row: Row[Any]) -> ComparedTest:
    at: datetime = row.at
    return ComparedTest(
        key=row.id,
        name=row.name,
        machine=row.machine_name,
        recipe=row.recipe_name,
        machine_key=row.machine_key,
        series=row.series,
        date=days(at),
        origin=row.origin,
        from_what=row.from_what,
        software="" if row.analysis is None else row.software,
        error=row.error or "",
    )


def _indicators(connection: Connection, before: Row[Any], after: Row[Any]) -> tuple[tuple[IndicatorDifference, ...], int]:
    """The indicators of two tests of one series, and of how many tests the baseline is that says how they scatter."""
    if before.series != after.series:
        return (), 0
    made = series_of(connection, before.series)
    base = baseline_of(connection, before.series)
    reference, count = None, 0
    if base is not None and set(base.tests) <= set(made.tests):
        prior, _ = prior_of(connection, before.series, before.software, made)
        reference, count = reference_of(made, base, prior), len(base.tests)
    return indicator_differences(made, str(before.id), str(after.id), reference), count


def kept_document(connection: Connection, key: int) -> Mapping[str, Any]:
    """The document of an analysis."""
    found: Mapping[str, Any] = connection.execute(select(analysis.c.document).where(analysis.c.id == key)).scalar_one()
    return found


def _parameters(
    documents: Documents,
) -> tuple[tuple[ParameterDifference, ...], Change | None, str, tuple[Check, ...]]:
    """What both tests determine; why there is nothing, if there is nothing."""
    before, after = (identification_in(document) for document in documents)
    if before is None or after is None:
        return (), None, NOTHING_IN_COMMON, ()
    sides = determined_by(before), determined_by(after)
    names = in_common(*sides)
    if not names:
        return (), None, NOTHING_IN_COMMON, ()
    if not (sides[0].judged and sides[1].judged):
        return (), None, FEW_RUNS, ()
    found, joint = differences_of(*sides, names)
    ends = [{entry["name"]: entry for entry in side["parameters"]} for side in (before, after)]
    told = tuple(_told(one, ends[0][one.name], ends[1][one.name]) for one in found)
    return told, joint, "", (unchanged(found, joint),)


def identification_in(document: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """The parameters of a kept result: its own, or those of its joints."""
    found = document if "parameters" in document else document.get("joints")
    return found if isinstance(found, Mapping) and found.get("parameters") else None


def determined_by(document: Mapping[str, Any]) -> Determined:
    """What a kept identification determines (`elastogeo.identification/1`), as `identification.determined` says it."""
    entries, rows = document["parameters"], document.get("correlation")
    u = np.array([_number(entry["standard_uncertainty"], nan) for entry in entries])
    whole = np.eye(len(u))
    for k, row in enumerate(rows or ()):
        whole[k, :k] = whole[:k, k] = [_number(value, nan) for value in row]
    solution = Solution(
        labels=tuple(entry["name"] for entry in entries),
        values=np.array([entry["value"] for entry in entries], dtype=float),
        covariance=whole * np.outer(u, u),
        degrees_of_freedom=np.array([_number(entry["degrees_of_freedom"], inf) for entry in entries]),
        residual_std=nan,
    )
    return Determined(
        solution=solution,
        units={entry["name"]: entry["unit"] for entry in entries},
        stands_for={entry["name"]: entry["stands_for"] for entry in entries},
        judged=rows is not None and bool(np.isfinite(solution.covariance).all()),
    )


def _number(value: float | None, none: float) -> float:
    return none if value is None else value


def _told(found: Difference, before: Mapping[str, Any], after: Mapping[str, Any]) -> ParameterDifference:
    intervals = _interval(before["interval95"]), _interval(after["interval95"])
    return ParameterDifference(found, intervals, after["stands_for"], after["separated"], _distortion(after))


def _interval(ends: Sequence[float] | None) -> tuple[float, float] | None:
    return None if ends is None else (ends[0], ends[1])


def _distortion(entry: Mapping[str, Any]) -> float | None:
    if entry["peak_to_peak_um"] is None or not entry["value"]:
        return None
    return abs(float(entry["peak_to_peak_um"] / entry["value"])) / _UM


def _settings(before: Row[Any], after: Row[Any]) -> Iterator[SettingDifference]:
    """What differs of the recipe, of what the tests say of themselves, and of the analysis."""
    for name in differing(before.recipe, after.recipe):
        yield SettingDifference(name, _at(before.recipe, name), _at(after.recipe, name), True)
    for name in dict.fromkeys((*before.about, *after.about)):
        one, other = before.about.get(name), after.about.get(name)
        if one != other and name not in _SELDOM_SAID:
            yield SettingDifference(name, one, other, False)
    if before.software != after.software:
        yield SettingDifference("software", before.software, after.software, False)


def _at(recipe: Any, name: str) -> Any:
    """The setting of this name; a list of its distinct values where there are several."""
    for part in name.split("."):
        if isinstance(recipe, list):
            every = [entry.get(part) for entry in recipe if isinstance(entry, Mapping)]
            recipe = list(dict.fromkeys(every)) if all(isinstance(one, str | float | int | None) for one in every) else every
        else:
            recipe = recipe.get(part) if isinstance(recipe, Mapping) else None
    return recipe


def _circles(
    files: Files, raw: tuple[tuple[RawFile, ...], ...]
) -> tuple[tuple[CircleTrace, ...], float | None, tuple[str, ...]]:
    """What both tests read around their circles, the radius of these, and the axes of their plane."""
    tests = [read_of(files, one) for one in raw]
    if any(one is None or one.setup.pose_quantity != "angle" for one in tests):
        return (), None, ()
    circles = [one for one in tests if one is not None]
    traces = tuple(trace for later, one in zip((False, True), circles, strict=True) for trace in _traces(one, later))
    plane = next((fact.value for fact in circles[0].setup.facts() if fact.name == "plane"), None)
    return traces, circles[0].setup.nominal_radius, tuple(plane) if isinstance(plane, str) and len(plane) == 2 else ()


def read_of(files: Files, raw: tuple[RawFile, ...]) -> MachineTest | None:
    """A test from its raw files; None of what is none with observations, as drives are."""
    if TEST not in {file.path for file in raw}:
        return None
    with laid_out(files, raw) as folder:
        return read_test(folder / TEST)


def _traces(of: MachineTest, later: bool) -> Iterator[CircleTrace]:
    """The first run of each level in each direction."""
    senses = {run.name: run.sense for run in of.runs}
    seen: set[tuple[float, int]] = set()
    for run in of.observations():
        sense = senses.get(run.run, 1)
        if (run.force, sense) not in seen and not run.direction[:, 3:].any():
            seen.add((run.force, sense))
            yield CircleTrace(later, run.run, run.force, sense, np.asarray(run.pose), _plain(run.reading))


def _plain(values: Array) -> Array:
    return np.array(values, dtype=float)

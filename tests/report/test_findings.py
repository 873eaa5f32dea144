"""Rows for the command line: formatted, in order, and naming no cause that is none."""

from __future__ import annotations

from dataclasses import replace

import pytest

from elastogeo.identification import compare, diagnose, what_if
from elastogeo.report.faults.rows import comparison_rows, diagnosis_rows, what_if_rows
from elastogeo.report.text import UNTOLD, parameter_rows


def test_a_sum_goes_under_no_single_name(mixed) -> None:
    rows = parameter_rows(mixed)
    for row, parameter in zip(rows, mixed.parameters, strict=True):
        if parameter.separated:
            assert row.name == parameter.name
        else:
            assert row.name == row.stands_for != parameter.name
            assert row.meaning == UNTOLD
    assert sum(row.meaning == UNTOLD for row in rows) == 5


def test_diagnosis_rows_are_ranked(separated) -> None:
    rows = diagnosis_rows(diagnose(separated))
    ranks = [row.rank for row in rows]
    assert ranks == [*(str(k + 1) for k in range(len(rows) - 2)), "", ""]
    assert rows[0].axis in {"X", "Y"}
    assert " ± " in rows[0].distortion_um
    assert {row.significant for row in rows} == {"yes", "no"}
    assert sum(float(row.share_percent) for row in rows if row.share_percent) == pytest.approx(100, abs=1)
    assert next(row for row in rows if row.name.startswith("P_")).name == "P_XXc1, P_XXs1"


def test_diagnosis_rows_of_what_is_not_told_apart_carry_sums(mixed) -> None:
    names = {row.name for row in diagnosis_rows(diagnose(mixed))}
    assert {row.name for row in parameter_rows(mixed)} == names


def test_comparison_rows_say_what_changed(separated) -> None:
    first = separated.parameters[0]
    step = 40 * first.standard_uncertainty
    moved = replace(
        first,
        estimate=replace(first.estimate, value=first.value + step),
        interval=(first.interval[0] + step, first.interval[1] + step),
    )
    values = separated.solution.values.copy()
    values[0] += step
    after = replace(
        separated,
        parameters=(moved, *separated.parameters[1:]),
        solution=replace(separated.solution, values=values),
    )
    rows = comparison_rows(compare(separated, after))
    assert [row.name for row in rows if row.changed == "yes"] == ["C_XXX"]
    assert rows[0].name == "C_XXX"
    assert rows[0].unit == "nm/N"
    assert rows[0].before == parameter_rows(separated)[0].value
    assert rows[0].p_value != "1.00"
    assert {row.changed for row in rows[1:]} == {"no"}


def test_what_if_rows_give_circular_deviations_by_level(separated) -> None:
    told = what_if(separated, ["*"])
    rows = what_if_rows(told)
    assert [row.force for row in rows] == [f"{level.force:g}" for level in separated.levels]
    assert {row.what for row in rows} == {"G, CCW"}
    assert all(float(row.after_um) < float(row.before_um) for row in rows)
    assert all(row.change_percent.startswith("-") for row in rows)
    without = what_if_rows(replace(told, before={}, after={}))
    assert [row.what for row in without] == [f"peak to peak, {trace.run}" for trace in separated.traces]

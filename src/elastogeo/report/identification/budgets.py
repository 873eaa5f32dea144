"""Uncertainty budgets, ready to print."""

from __future__ import annotations

from math import isfinite

from elastogeo.estimate import Estimate
from elastogeo.identification import BudgetLine, Identification
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import display_units, label
from elastogeo.report.view import Table

NONE = "–"
"""In place of a number that there is not."""

_MANY = 1000.0
"""Degrees of freedom above this are as good as infinite."""
_NOTHING = 0.001
"""Shares of the variance below this are not printed in numbers."""


def uncertainty_table(result: Identification) -> Table:
    """For each parameter its standard uncertainty, degrees of freedom, and the uncertainty if readings were independent."""
    units = display_units(result)
    rows = [
        (
            pretty(label(p)),
            NONE if p.estimate is None else pretty(significant(p.estimate.standard_uncertainty * units[p.name].factor, 2)),
            units[p.name].name,
            NONE if p.estimate is None else degrees(p.estimate.degrees_of_freedom),
            pretty(significant(float(result.naive.standard_uncertainty[k]) * units[p.name].factor, 2)),
        )
        for k, p in enumerate(result.parameters)
    ]
    return Table(("parameter", "u", "unit", "ν", "u if readings were independent"), tuple(rows), words=(0, 2))


def budget_tables(result: Identification) -> tuple[Table, ...]:
    """The sorted budget of each parameter that has an uncertainty."""
    estimates = [p.estimate for p in result.parameters]
    return tuple(_budget(result, k, estimate) for k, estimate in enumerate(estimates) if estimate is not None)


def _budget(result: Identification, k: int, estimate: Estimate) -> Table:
    parameter, lines = result.parameters[k], result.budget.lines[k]
    unit, whole = display_units(result)[parameter.name], estimate.standard_uncertainty
    rows = [
        (
            line.label,
            f"{'B' if line.type_b else 'A'}, {line.distribution}",
            degrees(line.degrees_of_freedom),
            pretty(significant(line.contribution * unit.factor, 2)),
            f"{100 * _share(line, whole):.1f}",
        )
        for line in lines
        if _share(line, whole) >= _NOTHING
    ]
    rest = [line.label for line in lines if _share(line, whole) < _NOTHING]
    freedom = degrees(estimate.degrees_of_freedom)
    return Table(
        headings=("influence", "type", "ν", f"u [{unit.name}]", "share [%]"),
        rows=tuple(rows),
        words=(0, 1),
        title=f"{pretty(label(parameter))}: u = {pretty(significant(whole * unit.factor, 2))} {unit.name}, ν = {freedom}",
        note=f"below {100 * _NOTHING:g} % each: {', '.join(rest)}" if rest else "",
    )


def _share(line: BudgetLine, whole: float) -> float:
    """Of an influence in the variance of a parameter, 0 to 1."""
    return (line.contribution / whole) ** 2 if whole else 0.0


def degrees(freedom: float) -> str:
    """Degrees of freedom as they are printed."""
    return "∞" if not isfinite(freedom) or freedom > _MANY else significant(freedom, 2)

"""Uncertainty budgets, ready to print."""

from __future__ import annotations

from math import isfinite
from typing import Any

from elastogeo.identification import BudgetLine, Identification
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import display_units, label

_MANY = 1000.0
"""Degrees of freedom above this are as good as infinite."""
_NOTHING = 0.001
"""Shares of the variance below this are not printed in numbers."""


def uncertainty_table(result: Identification) -> list[tuple[str, str, str, str, str]]:
    """For each parameter: name, standard uncertainty, unit, degrees of freedom, the one that counts on single readings."""
    units = display_units(result)
    return [
        (
            pretty(label(p)),
            pretty(significant(p.standard_uncertainty * units[p.name].factor, 2)),
            units[p.name].name,
            degrees(float(result.budget.degrees_of_freedom[k])),
            pretty(significant(float(result.naive.standard_uncertainty[k]) * units[p.name].factor, 2)),
        )
        for k, p in enumerate(result.parameters)
    ]


def budget_tables(result: Identification) -> list[dict[str, Any]]:
    """The sorted budget of each parameter."""
    units = display_units(result)
    budgets = []
    for k, p in enumerate(result.parameters):
        whole, factor = p.standard_uncertainty, units[p.name].factor
        lines = [
            {
                "label": line.label,
                "type": "B" if line.type_b else "A",
                "distribution": line.distribution,
                "degrees": degrees(line.degrees_of_freedom),
                "contribution": pretty(significant(line.contribution * factor, 2)),
                "share": f"{100 * _share(line, whole):.1f}",
            }
            for line in result.budget.lines[k]
            if _share(line, whole) >= _NOTHING
        ]
        rest = [line.label for line in result.budget.lines[k] if _share(line, whole) < _NOTHING]
        budgets.append(
            {
                "name": pretty(label(p)),
                "unit": units[p.name].name,
                "uncertainty": pretty(significant(whole * factor, 2)),
                "degrees": degrees(float(result.budget.degrees_of_freedom[k])),
                "lines": lines,
                "rest": f"below {100 * _NOTHING:g} % each: {', '.join(rest)}" if rest else "",
            }
        )
    return budgets


def _share(line: BudgetLine, whole: float) -> float:
    """Of an influence in the variance of a parameter, 0 to 1."""
    return (line.contribution / whole) ** 2 if whole else 0.0


def degrees(freedom: float) -> str:
    """Degrees of freedom as they are printed."""
    return "∞" if not isfinite(freedom) or freedom > _MANY else significant(freedom, 2)

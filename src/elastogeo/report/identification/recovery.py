"""What a simulation put in and the identification gave back: truth, estimate, difference (Tables 4.3, 4.5 and 5.4)."""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.identification import Identification, Parameter
from elastogeo.report.numbers import DisplayUnit, pretty, significant
from elastogeo.report.text import display_units, label, said_value, shared_units
from elastogeo.report.view import Section, Table

_MARKS = {True: "yes", False: "no", None: "–"}


def recovered_words(result: Identification) -> Iterator[str]:
    """How many intervals hold the truth of simulated readings, and what was simulated beside the model; else nothing."""
    if all(p.truth is None for p in result.parameters):
        return
    held = [p.holds_truth for p in result.parameters if p.holds_truth is not None]
    if held:
        yield f"The readings are simulated: {sum(held)} of {len(held)} intervals of 95 % hold the true value."
    else:
        yield "The readings are simulated; the estimates have no interval that could hold the true values."
    beside = _beside(result)
    if beside:
        yield f"Simulated, but not in the model: {', '.join(beside)}. What they do is left over, or biases the estimates."


def recovery_section(result: Identification) -> Section:
    """Truth, estimate and difference of every parameter; where sums stand for many, the many and their minimum norm."""
    tables = [_recovered(result)]
    if not result.campaign.several and any(len(p.stands_for) > 1 for p in result.parameters):
        tables.append(_minimum_norm(result))
    return Section("Simulated and identified", tuple(recovered_words(result)), tables=tuple(tables))


def _beside(result: Identification) -> list[str]:
    """What was simulated and is neither asked for nor each run's own set-up; not said of several tests."""
    if result.campaign.several:
        return []
    own = {name for values in result.set_up.values() for name in values}
    return [n for n, value in result.test.truth.items() if value and n not in result.confounding.labels and n not in own]


def _recovered(result: Identification) -> Table:
    units = display_units(result)
    return Table(
        ("parameter", "unit", "simulated", "estimate ± U (95 %)", "difference", "difference [%]", "truth within U"),
        tuple(_row(p, units[p.name]) for p in result.parameters),
        words=(0, 1, 6),
        note="The simulated value of a parameter is that of the whole sum that it stands for.",
    )


def _row(p: Parameter, unit: DisplayUnit) -> tuple[str, ...]:
    truth = p.truth or 0.0
    difference = p.value - truth
    percent = significant(100 * difference / truth, 2) if truth else "–"
    shown = (_said(truth * unit.factor), said_value(p, unit), significant(difference * unit.factor, 2), percent)
    return (pretty(label(p)), unit.name, *map(pretty, shown), _MARKS[p.holds_truth])


def _minimum_norm(result: Identification) -> Table:
    """Each parameter that was asked for by itself (Tables 4.2 and 4.3)."""
    truth, stands = result.test.truth, result.confounding
    unit_of = {p.name: p.unit for p in result.parameters}
    alike = {name: unit_of[p.name] for p in result.parameters for name in p.stands_for}
    values = [(name, alike.get(name, ""), max(abs(truth.get(name, 0.0)), abs(result.minimum_norm[name]))) for name in alike]
    units = shared_units(values)
    rows = tuple(
        (
            name,
            units[name].name,
            pretty(_said(truth.get(name, 0.0) * units[name].factor)),
            pretty(_said(result.minimum_norm[name] * units[name].factor)),
        )
        for name in stands.labels
        if name in units
    )
    return Table(
        ("parameter", "unit", "simulated", "minimum norm"),
        rows,
        words=(0, 1),
        title="Each by itself (Tables 4.2, 4.3)",
        note="This test does not determine them: the minimum norm predicts the same readings by other values; it is no "
        "estimate.",
    )


def _said(value: float) -> str:
    return significant(value, 4)

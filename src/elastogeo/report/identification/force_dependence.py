"""Whether anything changes with the force: local estimates, the linear model, and how well each fits (Table 5.9)."""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.identification import Fit, Identification, Parameter, VariableCompliance
from elastogeo.report.identification.pictures import picture
from elastogeo.report.identification.words import change_words
from elastogeo.report.numbers import DisplayUnit, pretty, significant, value_with_uncertainty
from elastogeo.report.text import all_separated, display_units, label, reading_unit
from elastogeo.report.view import Picture, Section, Table

NONE = "–"


def force_section(result: Identification) -> Section:
    """Local estimates beside the global one and the linear model."""
    paragraphs = (
        "Each local estimate uses two neighbouring force levels only. If they drift with the force by more than "
        "they scatter, the machine is not linear, or something that does not depend on the force counts as compliance.",
        *change_words(result),
    )
    linear = [] if result.variable is None else [linear_table(result, result.variable)]
    tables = (local_table(result), *linear, fit_table(result))
    return Section("Does anything change with the force?", tuple(map(pretty, paragraphs)), tuple(_pictures(result)), tables)


def _pictures(result: Identification) -> Iterator[Picture]:
    yield picture("local", result)
    if {p.elastic for p in result.parameters if p.axis} == {True, False} and all_separated(result):
        yield picture("local-separation", result)
    yield picture("local-traces", result)


def local_table(result: Identification) -> Table:
    """Each parameter by each pair of neighbouring levels (Tables 4.7, 5.7, 5.8)."""
    units = display_units(result)
    pairs = [f"{' and '.join(f'{force:.4g}' for force in local.forces)} N" for local in result.local]
    rows = tuple(
        (
            pretty(label(p)),
            units[p.name].name,
            *(pretty(significant(one.solution.values[k] * units[p.name].factor)) for one in result.local),
        )
        for k, p in enumerate(result.parameters)
    )
    return Table(
        ("parameter", "unit", *pairs),
        rows,
        words=(0, 1),
        title="Local estimates (Tables 4.7, 5.7, 5.8)",
        note="The figure shows their standard uncertainties; close levels make them large.",
    )


def linear_table(result: Identification, model: VariableCompliance) -> Table:
    """Each parameter by the model as asked, and by the one whose compliances change with the force (Eq. 5.39)."""
    low, high = result.levels[0].force, result.levels[-1].force
    units = display_units(result)
    rows = tuple(_linear_row(p, units[p.name], model, low, high) for p in result.parameters)
    scatter = "U holds the scatter between runs alone." if model.by_run else "The runs are too few for an uncertainty."
    return Table(
        ("parameter", "unit", "constant", f"at {low:.4g} N", f"at {high:.4g} N", "change ± U (95 %)", "change [%]"),
        rows,
        words=(0, 1),
        title="Compliances that change linearly with the force (Eq. 5.39)",
        note=f"{scatter} More parameters always fit better: which model the data support is said by the comparison of "
        "models.",
    )


def _linear_row(p: Parameter, unit: DisplayUnit, model: VariableCompliance, low: float, high: float) -> tuple[str, ...]:
    at = [significant(model.at(p.name, force).value * unit.factor) for force in (low, high)]
    shown = (label(p), unit.name, significant(p.value * unit.factor), *at)
    if p.name not in model.elastic:
        return tuple(map(pretty, (*shown, NONE, NONE)))
    change, first = model.change(p.name, high - low), model.at(p.name, low).value
    said = significant(change.value * unit.factor)
    if model.by_run:
        said = value_with_uncertainty(change.value * unit.factor, change.expanded() * unit.factor)
    return tuple(map(pretty, (*shown, said, significant(100 * change.value / first, 2) if first else NONE)))


def fit_table(result: Identification) -> Table:
    """RMSE and fitness of each force level by the global estimate, the linear model and the local estimates (Table 5.9)."""
    unit = reading_unit(result)
    rows = [
        (f"{level.force:.4g}", *_fits(unit.factor, Fit(level.rmse, level.fitness), level.variable, level.local))
        for level in result.levels
    ]
    whole = NONE if result.variable is None else significant(result.variable.rmse * unit.factor)
    rows.append(("all", significant(result.rmse * unit.factor), whole, NONE, NONE, NONE, NONE))
    return Table(
        (
            "force [N]",
            f"RMSE, constant [{unit.name}]",
            f"linear [{unit.name}]",
            f"local [{unit.name}]",
            "fitness, constant [%]",
            "linear [%]",
            "local [%]",
        ),
        tuple(rows),
        words=(),
        title="Fit by constant, linear and local compliance (Table 5.9)",
        note="Local: both estimates that a level is part of, together. Each has as many parameters for its two levels as "
        "the constant model has for all.",
    )


def _fits(factor: float, *fits: Fit | None) -> tuple[str, ...]:
    return (
        *(NONE if fit is None else significant(fit.rmse * factor) for fit in fits),
        *(NONE if fit is None or fit.fitness is None else significant(fit.fitness, 4) for fit in fits),
    )

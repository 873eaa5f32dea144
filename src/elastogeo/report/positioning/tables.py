"""The tables of a positioning test: the values of ISO 230-2, each target, where the uncertainty comes from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from elastogeo.identification import PositioningResults, StandardValue
from elastogeo.report.numbers import pretty, said_estimate, significant
from elastogeo.report.scales import Scale
from elastogeo.report.view import Table

_ROWS = (
    ("A", "accuracy", ("A+", "A-", "A")),
    ("E", "systematic deviation", ("E+", "E-", "E")),
    ("R", "repeatability", ("R+", "R-", "R")),
    ("M", "range of the mean deviations of both sides", ("", "", "M")),
    ("B", "greatest reversal", ("", "", "B")),
    ("mean B", "mean reversal, + less −", ("", "", "mean B")),
)


def value_table(found: PositioningResults, scale: Scale) -> Table:
    """The values of ISO 230-2, by direction and for both."""
    rows = []
    for name, meaning, parts in _ROWS:
        cells = tuple(said_value(found.values[part], scale) if part in found.values else "" for part in parts)
        if any(cells):
            rows.append((name, *cells, meaning))
    u = scale.unit
    note = "± U: half the 95 % interval, of the stated influences and of what few cycles leave open of the scatter."
    return Table(("", f"+ [{u}]", f"− [{u}]", f"both [{u}]", "meaning"), tuple(rows), (0, 4), "Values of ISO 230-2", note)


def target_table(found: PositioningResults, scale: Scale) -> Table:
    """What was read at every target."""
    targets, u = found.targets, scale.unit
    rows = tuple(
        (
            pretty(f"{target * scale.place_factor:.6g}"),
            "/".join(f"{count:.0f}" for count in targets.count[k]),
            *_figures([*targets.mean[k], targets.reversal[k], *targets.deviation[k], targets.repeatability[k]], scale),
        )
        for k, target in enumerate(targets.target)
    )
    headings = (f"mean + [{u}]", f"mean − [{u}]", f"B [{u}]", f"s + [{u}]", f"s − [{u}]", f"R [{u}]")
    return Table((f"target [{scale.place_unit}]", "readings +/−", *headings), rows, (), "By target")


def budget_table(found: PositioningResults, scale: Scale) -> Table:
    """What each influence contributes to each value, as a standard uncertainty."""
    labels = list(dict.fromkeys(part.label for value in found.values.values() for part in value.contributions))
    rows = tuple(_budget_rows(found, labels, scale))
    note = (
        "Standard uncertainties. The column `measurement` combines the stated influences alone, as ISO/TR 230-9 counts; "
        "the scatter of the cycles says how well so few approaches know the machine."
    )
    u = scale.unit
    return Table(("", *(f"{label} [{u}]" for label in labels), f"measurement [{u}]"), rows, (0,), "Uncertainty", note)


def _budget_rows(found: PositioningResults, labels: list[str], scale: Scale) -> Iterator[tuple[str, ...]]:
    for name, value in found.values.items():
        sizes = {part.label: part.standard_uncertainty for part in value.contributions}
        cells = [pretty(significant(sizes[label] * scale.factor, 2)) if label in sizes else "–" for label in labels]
        yield (name.replace("-", "−"), *cells, pretty(significant(value.measurement * scale.factor, 2)))


def said_value(value: StandardValue, scale: Scale) -> str:
    """A value as `value ± U`; alone, where the cycles show no scatter."""
    if value.estimate is None:
        return pretty(significant(value.value * scale.factor))
    return pretty(said_estimate(value.estimate.scaled(scale.factor)))


def _figures(values: list[float], scale: Scale) -> tuple[str, ...]:
    return tuple("–" if np.isnan(value) else pretty(f"{value * scale.factor:.2f}") for value in values)

"""The view of a bar's calibration, and `elastogeo.bar-calibration/1`, its document.

force : {slope_N_per_bar, offset_N, residual_std_N, nonlinearity_N, correlation, points: {pressure_bar, force_N,
    standard_uncertainty_N}}, or null; slope and offset are {value, standard_uncertainty, degrees_of_freedom, interval95}
setup : {deflection_um_per_bar, zero_um, residual_std_um}, or null
verdict : as in `document`
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from elastogeo.estimate import Estimate
from elastogeo.identification import BarCalibration, ForceCalibration
from elastogeo.machine import Array
from elastogeo.report.document import UM, document, uncertainty_entries, verdict_entries
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA = "elastogeo.bar-calibration/1"
_CAPTION = "What the straight line leaves of each reading, against the pressure."


@views(BarCalibration)
def calibration_view(result: BarCalibration) -> View:
    """All that is shown of a calibration."""
    values = tuple(_values(result))
    rows = tuple((value.meaning, value.value, value.unit) for value in values)
    table = Table(("what", "value ± U (95 %)", "unit"), rows, words=(0, 2))
    points = _points(result.force)
    return View(
        kind="Calibration",
        title="loaded bar",
        subtitle=" and ".join(
            name for name, part in (("force", result.force), ("set-up", result.setup)) if part is not None
        ),
        origin="",
        head=(("Readings", ", ".join(_readings(result))),),
        sentence=f"{_answer(result)} {attention_sentence(result.verdict)}",
        values=values,
        picture=Picture("residuals", _CAPTION, _CAPTION, lambda: _residuals(result)),
        checks=said(result.verdict),
        document=_document(result),
        rows=[{"name": value.name, "value": value.value, "unit": value.unit} for value in values],
        tables=(table, *points),
        sections=(Section("The calibration as tests take it", tables=points),) if points else (),
    )


def _values(result: BarCalibration) -> Iterable[KeyValue]:
    if result.force is not None:
        yield KeyValue("force per pressure", _said(result.force.slope), "N/bar", "force per pressure")
        yield KeyValue("force at no pressure", _said(result.force.offset), "N", "force at no pressure, by the line")
    if result.setup is not None:
        post = result.setup.per_pressure.scaled(UM)
        yield KeyValue("set-up", _said(post), "µm/bar", "deflection of the set-up per pressure")


def _answer(result: BarCalibration) -> str:
    parts = []
    if result.force is not None:
        line = f"{_said(result.force.slope)} N/bar and {_said(result.force.offset)} N at no pressure"
        parts.append(
            f"The force is {line}." if result.force.is_line else f"The force bends; the straight line would be {line}."
        )
    if result.setup is not None:
        parts.append(f"The set-up gives way by {_said(result.setup.per_pressure.scaled(UM))} µm/bar.")
    return " ".join(parts)


def _readings(result: BarCalibration) -> Iterable[str]:
    for name, part in (("load cell", result.force), ("dial", result.setup)):
        if part is not None:
            low, high = part.pressure.min(), part.pressure.max()
            yield f"{len(part.pressure)} of a {name}, {low:g} to {high:g} bar"


def _points(found: ForceCalibration | None) -> tuple[Table, ...]:
    if found is None:
        return ()
    made = found.calibration
    uncertain = made.standard_uncertainty or (0.0,) * len(made.force)
    points = zip(made.pressure, made.force, uncertain, strict=True)
    rows = tuple((f"{at:g}", significant(force, 5), significant(u, 2)) for at, force, u in points)
    headings = ("pressure [bar]", "force [N]", "standard uncertainty [N]")
    return (Table(headings, rows, words=(), title="Points of the calibration, straight between them"),)


def _said(estimate: Estimate) -> str:
    return pretty(value_with_uncertainty(estimate.value, estimate.expanded()))


def _document(result: BarCalibration) -> dict[str, Any]:
    force, setup = result.force, result.setup
    return document(
        SCHEMA,
        {
            "force": None if force is None else _force_entry(force),
            "setup": None
            if setup is None
            else {
                "deflection_um_per_bar": _number(setup.per_pressure.scaled(UM)),
                "zero_um": _number(setup.zero.scaled(UM)),
                "residual_std_um": setup.residual_std * UM,
            },
            "verdict": verdict_entries(result.verdict),
        },
    )


def _force_entry(force: ForceCalibration) -> dict[str, Any]:
    made = force.calibration
    return {
        "slope_N_per_bar": _number(force.slope),
        "offset_N": _number(force.offset),
        "correlation": force.correlation,
        "residual_std_N": force.residual_std,
        "nonlinearity_N": force.nonlinearity,
        "points": {
            "pressure_bar": made.pressure,
            "force_N": made.force,
            "standard_uncertainty_N": made.standard_uncertainty,
        },
    }


def _number(estimate: Estimate) -> dict[str, Any]:
    return {"value": estimate.value, **uncertainty_entries(estimate)}


def _residuals(result: BarCalibration) -> Figure:
    with needs_report_extra():
        from elastogeo.report.drawing.style import BLUE, GREY, new_figure
    shown: list[tuple[str, Array, Array]] = []
    if result.force is not None:
        shown.append(("force, less the line [N]", result.force.pressure, result.force.residual))
    if result.setup is not None:
        shown.append(("deflection, less the line [µm]", result.setup.pressure, result.setup.residual * UM))
    figure = new_figure(2.6 * len(shown))
    for k, (label, pressure, residual) in enumerate(shown):
        axes = figure.add_subplot(len(shown), 1, k + 1)
        axes.axhline(0.0, color=GREY, linewidth=0.7)
        axes.plot(pressure, residual, "o", color=BLUE, markersize=4)
        axes.set_ylabel(label)
        axes.set_xlabel("pressure [bar]")
    return figure

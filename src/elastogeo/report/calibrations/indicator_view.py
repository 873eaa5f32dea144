"""The view of an indicator test, and `elastogeo.indicator-test/1`, its document.

readings, repeated, resolution_um : of the dials; where nothing was repeated, the standard uncertainties hold the resolution
    and the stated scales alone, and nobody should expand them
engagements : [{engagement_um, force_N, machine_share}]
springs : {ball, roller, set-up, machine: {deflection_um: [..], secants: [..], increments: [..]}}; each of these is
    {compliance_um_per_N, standard_uncertainty_um_per_N, degrees_of_freedom, stiffness_N_per_um}, its stiffness null where it
    does not give way
setup : {engagement_um, compliance_um_per_N, standard_uncertainty_um_per_N}, as `[setup.setup]` of a ball-roller test
verdict : as in `document`
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from elastogeo.estimate import Estimate
from elastogeo.identification import IndicatorTest, Spring
from elastogeo.report.document import UM, document, verdict_entries
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA = "elastogeo.indicator-test/1"
_NAMES = {"ball": "ball", "roller": "roller bearing", "set-up": "set-up", "machine": "machine"}
_CAPTION = "Above: how far each gives way. Below: stiffness of the machine, as secant and as increment, and of the set-up."


@views(IndicatorTest)
def indicator_view(result: IndicatorTest) -> View:
    """All that is shown of an indicator test."""
    found, tables = _document(result), (_deflections(result), _secants(result), _increments(result))
    return View(
        kind="Calibration",
        title="ball-roller device",
        subtitle="indicator test",
        origin="",
        head=(
            ("Readings", f"{result.readings} at {len(result.engagement)} engagements"),
            ("Resolution", f"{result.resolution * UM:g} µm" if result.resolution else "not stated"),
        ),
        sentence=f"{_answer(result)} {attention_sentence(result.verdict)}",
        values=tuple(_values(result)),
        picture=Picture("indicators", _CAPTION, _CAPTION, lambda: _figure(result)),
        checks=said(result.verdict),
        document=found,
        rows=[
            {"engagement_um": at * UM, "spring": name, "stiffness_N_per_um": _stiffness_number(spring.secants[k])}
            for k, at in enumerate(result.engagement)
            for name, spring in result.springs.items()
        ],
        tables=tables,
        sections=(
            Section("Deflections and stiffness", tables=tables),
            Section("For a ball-roller test", tables=(_table(result),)),
        ),
    )


def _answer(result: IndicatorTest) -> str:
    at, share = result.engagement[-1] * UM, 100 * float(result.share[-1])
    setup, machine = (result.springs[name].deflection[-1] * UM for name in ("set-up", "machine"))
    return (
        f"At {at:.4g} µm the machine gives way by {machine:.4g} µm ({share:.1f} %), ball and roller bearing by "
        f"{setup:.4g} µm ({100 - share:.1f} %)."
    )


def _values(result: IndicatorTest) -> Iterator[KeyValue]:
    at = f"{result.engagement[-1] * UM:.4g} µm"
    machine = result.springs["machine"]
    yield KeyValue("machine, increment", _said(result, machine.increments[-1]), "N/µm", f"up to {at}: free of an offset")
    yield KeyValue("machine, secant", _said(result, machine.secants[-1]), "N/µm", f"force over deflection at {at}")
    yield KeyValue(
        "set-up, secant", _said(result, result.springs["set-up"].secants[-1]), "N/µm", f"ball and roller bearing at {at}"
    )
    setup = result.springs["set-up"].secants[-1]
    half = setup.expanded() * UM
    shown = value_with_uncertainty(setup.value * UM, half) if result.repeated else significant(setup.value * UM, 3)
    yield KeyValue("set-up", pretty(shown), "µm/N", f"compliance at {at}, to subtract (Eq. 6.5)")


def _deflections(result: IndicatorTest) -> Table:
    rows = tuple(
        (
            f"{at * UM:.4g}",
            f"{result.force[k]:.0f}",
            *(f"{result.springs[name].deflection[k] * UM:.4g}" for name in _NAMES),
            f"{100 * result.share[k]:.1f}",
        )
        for k, at in enumerate(result.engagement)
    )
    headings = ("commanded [µm]", "force [N]", *(f"{name} [µm]" for name in _NAMES.values()), "machine's share [%]")
    return Table(headings, rows, words=(), title="Deflections (Table 6.5)")


def _secants(result: IndicatorTest) -> Table:
    rows = tuple(
        (f"{at * UM:.4g}", *(_said(result, result.springs[name].secants[k]) for name in _NAMES))
        for k, at in enumerate(result.engagement)
    )
    headings = ("commanded [µm]", *(f"{name} [N/µm]" for name in _NAMES.values()))
    return Table(headings, rows, words=(), title="Secant stiffness, force over deflection (Table 6.6)")


def _increments(result: IndicatorTest) -> Table:
    ends = result.engagement * UM
    rows = tuple(
        (f"{low:.4g} to {high:.4g}", *(_said(result, result.springs[name].increments[k]) for name in ("set-up", "machine")))
        for k, (low, high) in enumerate(pairwise(ends))
    )
    headings = ("commanded [µm]", "set-up [N/µm]", "machine [N/µm]")
    return Table(headings, rows, words=(), title="Incremental stiffness, from each engagement to the next")


def _table(result: IndicatorTest) -> Table:
    rows = tuple(
        (f"{at * UM:.4g}", significant(value * UM, 4), significant(secant.standard_uncertainty * UM, 2))
        for at, value, secant in zip(
            result.engagement, result.setup.compliance, result.springs["set-up"].secants, strict=True
        )
    )
    headings = ("engagement [µm]", "compliance [µm/N]", "standard uncertainty [µm/N]")
    note = "As a test file takes it: elastogeo calibrate READINGS -o rollers.toml. It has one uncertainty, the greatest."
    return Table(headings, rows, words=(), title="Compliance of the set-up, straight between its points", note=note)


def _said(result: IndicatorTest, compliance: Estimate) -> str:
    """A stiffness [N/um] with U to first order; without one where no repeats show the scatter, or zero is inside."""
    if compliance.value <= 0:
        return "∞"
    value = 1 / (compliance.value * UM)
    half = value * compliance.expanded() / compliance.value
    if half >= value:
        return f"{significant(value, 2)} (not resolved)"
    return pretty(value_with_uncertainty(value, half)) if result.repeated else significant(value, 3)


def _document(result: IndicatorTest) -> dict[str, Any]:
    return document(
        SCHEMA,
        {
            "readings": result.readings,
            "repeated": result.repeated,
            "resolution_um": result.resolution * UM,
            "engagements": [
                {"engagement_um": at * UM, "force_N": force, "machine_share": share}
                for at, force, share in zip(result.engagement, result.force, result.share, strict=True)
            ],
            "springs": {name: _spring(spring) for name, spring in result.springs.items()},
            "setup": {
                "engagement_um": [at * UM for at in result.setup.engagement],
                "compliance_um_per_N": [value * UM for value in result.setup.compliance],
                "standard_uncertainty_um_per_N": (result.setup.standard_uncertainty or 0.0) * UM,
            },
            "verdict": verdict_entries(result.verdict),
        },
    )


def _spring(spring: Spring) -> dict[str, Any]:
    return {
        "deflection_um": spring.deflection * UM,
        "secants": [_number(one) for one in spring.secants],
        "increments": [_number(one) for one in spring.increments],
    }


def _number(compliance: Estimate) -> dict[str, Any]:
    return {
        "compliance_um_per_N": compliance.value * UM,
        "standard_uncertainty_um_per_N": compliance.standard_uncertainty * UM,
        "degrees_of_freedom": compliance.degrees_of_freedom,
        "stiffness_N_per_um": _stiffness_number(compliance),
    }


def _stiffness_number(compliance: Estimate) -> float | None:
    return 1 / (compliance.value * UM) if compliance.value > 0 else None


def _figure(result: IndicatorTest) -> Figure:
    with needs_report_extra():
        from elastogeo.report.drawing.style import BLUE, GREEN, GREY, ORANGE, READABLE, new_figure
    colours = {"ball": GREY, "roller": GREEN, "set-up": ORANGE, "machine": BLUE}
    at = result.engagement * UM
    figure = new_figure(6.0, width=READABLE)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for name, spring in result.springs.items():
        upper.plot(at, spring.deflection * UM, "o-", markersize=4, color=colours[name], label=_NAMES[name])
    upper.set_ylabel("deflection [µm]")
    upper.legend(loc="upper left")
    for name in ("machine", "set-up"):
        secants = [_bar(result, one) for one in result.springs[name].secants]
        values, sizes = np.array(secants).T
        lower.errorbar(
            at, values, yerr=sizes, fmt="o-", markersize=4, capsize=2, color=colours[name], label=f"{name}, secant"
        )
    steps = np.array([_bar(result, one) for one in result.springs["machine"].increments])
    middle, half = (at[1:] + at[:-1]) / 2, np.diff(at) / 2
    lower.errorbar(
        middle, steps[:, 0], yerr=steps[:, 1], xerr=half, fmt="s", markersize=4, color="#56b4e9", label="machine, increment"
    )
    lower.set_ylim(bottom=0)
    lower.set_ylabel("stiffness [N/µm]")
    lower.set_xlabel("commanded engagement [µm]")
    lower.set_xticks(at)
    lower.legend(loc="lower right")
    return figure


def _bar(result: IndicatorTest, compliance: Estimate) -> tuple[float, float]:
    """Stiffness and half its interval, none without repeats; not a number where it does not give way."""
    value = _stiffness_number(compliance)
    if value is None:
        return float("nan"), float("nan")
    return value, min(value * compliance.expanded() / compliance.value, value) if result.repeated else 0.0

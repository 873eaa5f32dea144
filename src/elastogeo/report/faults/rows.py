"""The rows of a diagnosis, of a comparison of two tests, and of a what-if, formatted: for the command line and for pages."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.estimate import Estimate
from elastogeo.identification import SIGNIFICANT, BeforeAfter, Diagnosis, Difference, Fault, Identification, WhatIf
from elastogeo.report.numbers import DisplayUnit, display_unit, probability, said_estimate, significant
from elastogeo.report.signs import sign_sentence
from elastogeo.report.text import UM, UNTOLD, in_micrometres, label, said_value, shared_units

YES, NO = "yes", "no"
_DEVIATIONS = {"g_ccw": "G, CCW", "g_cw": "G, CW", "g_bidirectional": "G(b), both ways"}


@dataclass(frozen=True, slots=True)
class DiagnosisRow:
    """One fault of a ranking, formatted.

    Attributes
    ----------
    rank : str
        Empty for the set-up, which is no fault of the machine.
    name, meaning, axis : str
        The sum, and no axis, where compliance and geometry are not distinguished.
    value, unit : str
        `value ± U` with U of 95 %.
    distortion_um : str
        `value ± U`, with the sign of the value, at the highest force.
    share_percent : str
    significant : str
        `yes` if the 95 % interval excludes zero, else `no`.
    also : str
        What this test cannot tell from it; empty if nothing.
    sentence : str
        What its value means for the axis: `X falls 6.0 µm short when it reverses`; empty where there is no such sentence.
    """

    rank: str
    name: str
    meaning: str
    axis: str
    value: str
    unit: str
    distortion_um: str
    share_percent: str
    significant: str
    also: str
    sentence: str


@dataclass(frozen=True, slots=True)
class ComparisonRow:
    """How one parameter changed between two tests, formatted.

    Attributes
    ----------
    name : str
    before, after, change : str
        `value ± U` with U of 95 %, in `unit`.
    unit : str
    p_value : str
    changed : str
        `yes` if it changed by more than its uncertainty, with the number of parameters counted, else `no`.
    """

    name: str
    before: str
    after: str
    change: str
    unit: str
    p_value: str
    changed: str


@dataclass(frozen=True, slots=True)
class WhatIfRow:
    """What a correction does to one deviation at one force level, formatted.

    Attributes
    ----------
    force : str [N]
    what : str
        A circular deviation of ISO 230-4; of a path that is no circle, the peak to peak of a run.
    before_um, after_um : str
    change_percent : str
        Negative if it gets better.
    """

    force: str
    what: str
    before_um: str
    after_um: str
    change_percent: str


@dataclass(frozen=True, slots=True)
class Described:
    """What may be said of a fault: all members of a sum, where compliance and geometry are not distinguished."""

    names: tuple[str, ...]
    title: str
    meaning: str
    separated: bool
    also: tuple[str, ...]


def described(fault: Fault, result: Identification) -> Described:
    """The names and meaning under which a fault of a result may be shown."""
    members = [p for p in result.parameters if p.name in fault.names]
    if all(p.separated for p in members):
        return Described(fault.names, ", ".join(fault.names), fault.meaning, True, fault.also)
    return Described((*fault.names, *fault.also), "; ".join(label(p) for p in members), UNTOLD, False, ())


def distortion_interval(fault: Fault) -> tuple[float, float] | None:
    """The 95 % interval [mm] of how much a fault distorts the trace; None where there is none."""
    return None if fault.distortion_estimate is None else fault.distortion_estimate.interval()


def diagnosis_rows(diagnosis: Diagnosis) -> tuple[DiagnosisRow, ...]:
    """The rows of the ranked diagnosis, greatest distortion first.

    Parameters
    ----------
    diagnosis : Diagnosis
    """
    result, faults = diagnosis.identification, diagnosis.faults
    units = shared_units((f.names[0], f.unit, abs(f.value) + (f.estimate.expanded() if f.estimate else 0.0)) for f in faults)
    machine = [fault for fault in faults if fault.axis]
    rows = []
    for fault in faults:
        shown, unit = described(fault, result), units[fault.names[0]]
        rows.append(
            DiagnosisRow(
                rank=str(machine.index(fault) + 1) if fault in machine else "",
                name=shown.title,
                meaning=shown.meaning,
                axis=fault.axis if shown.separated else "",
                value=_said(fault.value, fault.estimate, unit.factor),
                unit=unit.name,
                distortion_um=_said(fault.distortion, fault.distortion_estimate, UM),
                share_percent=f"{100 * fault.share:.1f}" if fault in machine else "",
                significant=YES if fault.significant else NO,
                also=", ".join(shown.also),
                sentence=_sentence(fault, result),
            )
        )
    return tuple(rows)


def _sentence(fault: Fault, result: Identification) -> str:
    """What the value of a fault means for its axis, where it is significant."""
    signs = [p.sign for p in result.parameters if p.name in fault.names and p.separated]
    known = len(fault.names) == 1 and fault.significant and signs and signs[0] is not None
    return sign_sentence(signs[0], fault.value, fault.unit) if known and signs[0] else ""


def _said(value: float, estimate: Estimate | None, scale: float) -> str:
    return significant(value * scale) if estimate is None else said_estimate(estimate.scaled(scale))


def comparison_rows(before_after: BeforeAfter) -> tuple[ComparisonRow, ...]:
    """The rows of a comparison of two tests, the surest change first."""
    kinds: dict[str, float] = {}
    for found in before_after.differences:
        kinds[found.unit] = max(
            kinds.get(found.unit, 0.0), abs(found.before), abs(found.after), *map(abs, found.change.interval())
        )
    count = len(before_after.differences)
    return tuple(
        _comparison_row(before_after, found, display_unit(found.unit, kinds[found.unit]), count)
        for found in before_after.differences
    )


def what_if_rows(what_if: WhatIf) -> tuple[WhatIfRow, ...]:
    """The rows of a what-if: circular deviations by force level, or the runs' peak to peak where there is no circle."""
    rows = []
    for force, before in what_if.before.items():
        for key, what in _DEVIATIONS.items():
            one, other = getattr(before, key), getattr(what_if.after[force], key)
            if one is not None and other is not None:
                rows.append(_what_if_row(force, what, one, other))
    if rows:
        return tuple(rows)
    forces = {trace.run: trace.force for trace in what_if.traces}
    return tuple(
        _what_if_row(forces[run], f"peak to peak, {run}", one, other) for run, (one, other) in what_if.peak_to_peak.items()
    )


def _comparison_row(before_after: BeforeAfter, found: Difference, unit: DisplayUnit, count: int) -> ComparisonRow:
    ends = [
        next(p for p in result.parameters if p.name == found.name) for result in (before_after.before, before_after.after)
    ]
    one, other = (said_value(p, unit) for p in ends)
    return ComparisonRow(
        name=label(ends[0]),
        before=one,
        after=other,
        change=said_estimate(found.change.scaled(unit.factor)),
        unit=unit.name,
        p_value=probability(found.p_value),
        changed=YES if found.p_value < SIGNIFICANT / count else NO,
    )


def _what_if_row(force: float, what: str, before: float, after: float) -> WhatIfRow:
    return WhatIfRow(
        force=f"{force:g}",
        what=what,
        before_um=in_micrometres(before),
        after_um=in_micrometres(after),
        change_percent=significant(100 * (after / before - 1), 2) if before else "",
    )

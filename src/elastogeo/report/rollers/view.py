"""The view of a ball-roller test: the stiffness of the machine by direction, the drives, the joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

from elastogeo.identification import StiffnessMap
from elastogeo.report.head import files_section, head, origin
from elastogeo.report.identification.pictures import picture
from elastogeo.report.identification.view import parameter_table, stands_for
from elastogeo.report.numbers import pretty
from elastogeo.report.rollers.document import stiffness_json
from elastogeo.report.rollers.rows import (
    balance_rows,
    force_rows,
    level_rows,
    modelled_name,
    overall_name,
    rig_rows,
    span,
    stiffness_rows,
    torque_rows,
)
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_KINDS = (
    "Three kinds of stiffness, each at every engagement. The secant is Eq. 6.5: force over deflection, less the set-up's. "
    "It holds what the path is off and what gives way before the least engagement, so it changes with the engagement even "
    "where the machine does not stiffen. The increment is the slope from one engagement to the next, and free of that. "
    "Modelled is the slope of the law that all engagements support, where one does."
)


@views(StiffnessMap)
def stiffness_view(found: StiffnessMap) -> View:
    """All that is shown of a stiffness map."""
    test, rows = found.joints.test, stiffness_rows(found)
    ordered = sorted(zip(found.overall.stiffness, rows, strict=True), key=lambda pair: pair[0])
    softest, stiffest = ordered[0][1], ordered[-1][1]
    names = {check.name for check in found.verdict}
    checks = (*found.verdict, *(check for check in found.joints.verdict if check.name not in names))
    by_direction, by_level, balance = _by_direction(found), _by_level(found), _balance(found)
    joints = parameter_table(found.joints)
    document = stiffness_json(found)
    low, high = found.overall.stiffness_interval[[found.overall.stiffness.argmin(), found.overall.stiffness.argmax()]]
    apart = "" if low[1] < high[0] else "; their 95 % intervals overlap"
    return View(
        kind="Stiffness map",
        title=test.machine.name,
        subtitle=test.name,
        origin=origin(test),
        head=head(test),
        sentence=f"Softest at {softest.direction}°, {softest.stiffness} N/µm; stiffest at {stiffest.direction}°, "
        f"{stiffest.stiffness} N/µm{apart}. {attention_sentence(checks)}",
        values=tuple(_values(found)),
        picture=_picture(
            "stiffness",
            f"Stiffness of the machine by direction, {overall_name(found)}, with its 95 % interval; thin, the increment "
            f"from each engagement to the next.",
            "Stiffness of the machine in every direction, as a rose",
            "stiffness_figure",
            found,
        ),
        checks=said(checks),
        document=document,
        rows=document["overall"]["directions"],
        tables=(by_level, by_direction, balance, joints),
        notes=stands_for(found.joints),
        sections=(
            Section("Stiffness by engagement", (_KINDS,), (_levels(found),), (by_level,)),
            Section("Stiffness by direction", tables=(by_direction,)),
            *_rig(found),
            Section("The drives", pictures=(_torques(found),), tables=(balance, _peaks(found))),
            *_dynamometer(found),
            Section("Joint parameters", pictures=(picture("contributions", found.joints),), tables=(joints,)),
            Section("Fit", pictures=(picture("traces", found.joints), picture("residuals", found.joints))),
            *files_section(test),
        ),
    )


def _values(found: StiffnessMap) -> Iterator[KeyValue]:
    rows = stiffness_rows(found)
    for name, k in (("softest", found.overall.stiffness.argmin()), ("stiffest", found.overall.stiffness.argmax())):
        row = rows[int(k)]
        yield KeyValue(
            f"{name}, at {row.direction}°",
            row.stiffness,
            "N/µm",
            f"95 %: {row.stiffness_interval} N/µm; compliance {pretty(row.compliance)} µm/N",
        )
    yield KeyValue("increments", span(found.increments), "N/µm", "from engagement to engagement, mean around the turn")
    yield KeyValue("secants (Eq. 6.5)", span(found.secants), "N/µm", "least to greatest engagement; an offset is in them")


def _by_direction(found: StiffnessMap) -> Table:
    return Table(
        ("direction [°]", "compliance ± U [µm/N]", "stiffness [N/µm]", "95 % [N/µm]"),
        tuple((r.direction, pretty(r.compliance), r.stiffness, r.stiffness_interval) for r in stiffness_rows(found)),
        words=(),
        title=f"Stiffness by direction: {overall_name(found)}",
    )


def _by_level(found: StiffnessMap) -> Table:
    return Table(
        ("engagement [µm]", "force [N]", "secant (6.5) [N/µm]", "increment [N/µm]", f"{modelled_name(found)} [N/µm]"),
        tuple((r.engagement, r.force, r.secant, r.increment, r.modelled) for r in level_rows(found)),
        words=(),
        title="Stiffness by engagement",
        note="Least to greatest around the turn. A secant runs from zero force, an increment from the engagement before.",
    )


def _balance(found: StiffnessMap) -> Table:
    return Table(
        ("axis", "term", "value ± U (95 %)", "unit"),
        tuple((r.axis, r.parameter, pretty(r.value), r.unit) for r in balance_rows(found)),
        words=(0, 1, 3),
        title="Torque balance of the drives",
    )


def _peaks(found: StiffnessMap) -> Table:
    run = found.torques[0].run
    return Table(
        ("axis", "part", "greatest size", "unit"),
        tuple((r.axis, r.part, r.peak, r.unit) for r in torque_rows(found)),
        words=(0, 1, 3),
        title=f"Parts of the motor's effort along run {run}",
    )


def _levels(found: StiffnessMap) -> Picture:
    caption = (
        "Secant, increment and modelled stiffness by engagement with 95 % intervals; an increment stands between its two."
    )
    return _picture("levels", caption, "Stiffness against engagement, of each kind", "levels_figure", found)


def _torques(found: StiffnessMap) -> Picture:
    motor = found.torques[0]
    caption = (
        f"What each motor takes along run {motor.run}, and the parts that the torque balance makes of it (Eq. 6.6). "
        f"Gaps: the axis is too slow for its friction to have a direction."
    )
    return _picture("torques", caption, "Effort of each motor along the turn, part by part", "torques_figure", found)


def _dynamometer(found: StiffnessMap) -> Iterator[Section]:
    if found.dynamometer is None:
        return
    caption = "Force on the roller, a run of each engagement: from the currents in colour, the dynamometer's broad and grey."
    shown = _picture("dynamometer", caption, "Force from the currents against the dynamometer", "dynamometer_figure", found)
    table = Table(
        ("engagement [µm]", "runs", "dynamometer, RMS [N]", "currents, RMS [N]", "difference, RMS [N]"),
        tuple((r.engagement, r.runs, r.dynamometer, r.current, r.rms_difference) for r in force_rows(found)),
        words=(),
    )
    yield Section("Against the dynamometer", pictures=(shown,), tables=(table,))


def _rig(found: StiffnessMap) -> Iterator[Section]:
    if found.rig is None:
        return
    caption = (
        "Left: compliance by direction without the rig, with it, and predicted (Eq. 6.16), with 95 % intervals. "
        "Right: the secants by engagement."
    )
    shown = _picture("rig", caption, "Compliance with and without the rig, and predicted", "rig_figure", found)
    direction = stiffness_rows(found)[found.rig.softest].direction
    table = Table(
        ("", "without the rig [µm/N]", "predicted with it [µm/N]", "measured with it [µm/N]"),
        tuple((r.engagement, pretty(r.without), r.predicted, pretty(r.measured)) for r in rig_rows(found, found.rig)),
        title=f"Compliance at {direction}°, where the rig is softest",
        note="A secant holds what its path is off, more so where the force is smaller; the modelled row is judged.",
    )
    yield Section("With the rig", pictures=(shown,), tables=(table,))


def _picture(name: str, caption: str, alternative: str, figure: str, found: StiffnessMap) -> Picture:
    return Picture(name, caption, alternative, partial(_drawn, figure, found))


def _drawn(figure: str, found: StiffnessMap) -> Figure:
    draw: Callable[[StiffnessMap], Figure] = getattr(import_module("elastogeo.report.rollers.figures"), figure)
    return draw(found)

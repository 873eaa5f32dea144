"""The view of a positioning test: deviations as ISO 230-2 draws them, its values with U, the error motion below."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from elastogeo.identification import PositioningResults
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.head import files_section, head, origin
from elastogeo.report.identification.pictures import picture
from elastogeo.report.identification.view import parameter_table, stands_for
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.positioning.document import positioning_json
from elastogeo.report.positioning.tables import budget_table, said_value, target_table, value_table
from elastogeo.report.scales import Scale, scale_for
from elastogeo.report.view import KeyValue, Picture, Section, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MEANINGS = {
    "A": "accuracy",
    "E": "systematic deviation",
    "R": "repeatability",
    "B": "greatest reversal",
    "M": "range of the means of both sides",
}
_KEYS = (("A", "A+", "A-"), ("E", "E+", "E-"), ("R", "R+", "R-"), ("B",), ("M",))
"""Of both directions, else of the one there is."""
_NO_LEVER = 0.5
"""Distance [mm] from the frame of the axis that is no lever to speak of."""


@views(PositioningResults)
def positioning_view(found: PositioningResults) -> View:
    """All that is shown of a positioning test."""
    test, scale = found.test, scale_for(found.angular, found.rotary)
    names = [next((name for name in several if name in found.values), "") for several in _KEYS]
    values = tuple(_key(found, name, scale) for name in names if name)
    lead = ", ".join(f"{one.name} = {one.value} {one.unit} ({one.meaning})" for one in values[:3])
    document = positioning_json(found)
    tables = (value_table(found, scale), *((parameter_table(found.joints),) if found.joints else ()))
    return View(
        kind="Positioning test",
        title=test.machine.name,
        subtitle=test.name,
        origin=origin(test),
        head=(*head(test), *_head(found, scale)),
        sentence=f"{_what(found)} of {found.axis}: {lead}. {attention_sentence(found.verdict)}",
        values=values,
        picture=Picture(
            "deviations",
            "Deviations over the targets as ISO 230-2 draws them: blue where the axis comes in its positive direction, "
            "orange in its negative one; thick the means, thin two standard deviations on either side.",
            "Deviations of each approach over the targets, with means and limits by direction",
            lambda: _drawn(found),
        ),
        checks=said(found.verdict),
        document=document,
        rows=document["values"],
        tables=tables,
        notes=tuple(_notes(found, scale)),
        sections=tuple(_sections(found, scale)),
    )


def _what(found: PositioningResults) -> str:
    if found.along:
        return "Positioning"
    return "Angular error motion" if found.angular else "Radial or axial error motion" if found.rotary else "Straightness"


def _key(found: PositioningResults, name: str, scale: Scale) -> KeyValue:
    sides = {"+": "in + only", "-": "in − only"}.get(name[1:], "")
    meaning = ", ".join(filter(None, [_MEANINGS[name[0]], sides]))
    return KeyValue(name.replace("-", "−"), said_value(found.values[name], scale), scale.unit, meaning)


def _head(found: PositioningResults, scale: Scale) -> Iterator[tuple[str, str]]:
    first, last = (found.targets.target[k] * scale.place_factor for k in (0, -1))
    ends = pretty(f"{first:.6g} to {last:.6g} {scale.place_unit}")
    yield "Axis", f"{found.axis}, {len(found.targets.target)} targets from {ends}, {found.cycle.max()} cycles"


def _notes(found: PositioningResults, scale: Scale) -> Iterator[str]:
    for name, lever in found.levers.items():
        if abs(lever) > _NO_LEVER:
            yield pretty(
                f"Abbe: read {significant(abs(lever))} mm off the frame of {found.axis}; 1 µrad of {name} is "
                f"{significant(lever * 1e-6 * scale.factor)} {scale.unit} here, and part of these values."
            )
    if found.joints is None:
        yield f"No error motion was identified: {found.refusal}."
    else:
        yield from stands_for(found.joints)


def _sections(found: PositioningResults, scale: Scale) -> Iterator[Section]:
    yield Section("Values of ISO 230-2", tables=(value_table(found, scale), target_table(found, scale)))
    yield Section("Where the uncertainty comes from", tables=(budget_table(found, scale),))
    if found.joints is not None:
        words = (
            "The same readings as parameters of the machine, for use beside other tests: error motions count about the "
            "middle of the targets, each cycle has a zero of its own, and backlash is positive where the axis falls short.",
        )
        yield Section("Error motion", words, (picture("traces", found.joints),), (parameter_table(found.joints),))
    yield Section(
        "How it was computed",
        points=(
            "Formulas of ISO 230-2:2014: A from the means ± 2 s, E from the means, R from 2 s of both directions and the "
            "reversal, or 4 s of one, whichever is greater.",
            "Every stated influence is carried to every value by shifting all readings by its standard uncertainty; a value "
            "that several targets share nearly alike is a little too great, and no U says so.",
            "Deviations count along the command of the axis: positive where it goes too far in its positive direction."
            if found.along
            else "A straight line through all readings is subtracted."
            if not found.angular
            else "Deviations are those of the sensor.",
        ),
    )
    yield from files_section(found.test)


def _drawn(found: PositioningResults) -> Figure:
    with needs_report_extra():
        from elastogeo.report.positioning.figures import deviations_figure
    return deviations_figure(found)

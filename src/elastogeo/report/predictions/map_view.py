"""The view of a map: slices of the volume, the worst and the best place with U, what the tests support."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.prediction import TYPICAL_COMPLIANCE, TYPICAL_LEVER, AgainstDesign, ComplianceMap, Place
from elastogeo.report.document import UM
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.head import campaign_head, files_section, origin
from elastogeo.report.numbers import UNKNOWN, pretty, said_estimate, significant, whole_percent
from elastogeo.report.predictions.document import NM, map_json, rows_of
from elastogeo.report.predictions.volume import volume_scene
from elastogeo.report.text import combination, shared_units
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PERCENT = 100.0
_TERMS = 3


@views(ComplianceMap)
def map_view(found: ComplianceMap) -> View:
    """All that is shown of a map."""
    campaign = found.campaign
    return View(
        kind="Compliance map",
        title=campaign.machine.name,
        subtitle=campaign.name,
        origin=origin(campaign),
        head=(*campaign_head(campaign), *_head(found)),
        sentence=f"{_answer(found)} {attention_sentence(found.verdict)}",
        values=tuple(_values(found)),
        picture=_picture(
            "slices",
            "How far the tool gives way to a force, in slices of the volume; hatched where the tests do not tell.",
            "Compliance at the tool in colour over slices of the volume",
            found,
        ),
        checks=said(found.verdict),
        document=map_json(found),
        rows=rows_of(found),
        tables=tuple(_tables(found)),
        notes=tuple(_notes(found)),
        sections=tuple(_sections(found)),
        scene=volume_scene(found),
    )


def _head(found: ComplianceMap) -> Iterator[tuple[str, str]]:
    grid, machine = found.grid, found.campaign.machine
    ranges = [
        f"{axis} {one[0]:.6g} to {one[-1]:.6g} mm ({len(one)})" if len(one) > 1 else f"{axis} {one[0]:.6g} mm"
        for axis, one in zip(grid.axes, grid.along, strict=True)
    ]
    yield "Volume", pretty(f"{', '.join(ranges)}: {grid.size} places")
    stands = [_stands(found, axis) for axis in machine.axes if axis not in grid.axes]
    if stands:
        yield "Other axes", pretty(", ".join(stands))
    yield "Direction", "the softest of each place" if found.direction is None else _vector(found.direction)
    yield "Tool point", pretty(", ".join(f"{part:.6g}" for part in found.tool) + " mm in the last carriage")


def _stands(found: ComplianceMap, axis: str) -> str:
    machine = found.campaign.machine
    k = machine.index(axis)
    rotary = machine.joints[k].is_rotary
    return f"{axis} {np.degrees(found.grid.stands[k]):.6g}°" if rotary else f"{axis} {found.grid.stands[k]:.6g} mm"


def _answer(found: ComplianceMap) -> str:
    if found.softest is None or found.stiffest is None:
        return "The tests do not tell how stiff the machine is at the tool in this volume."
    way = "in its softest direction" if found.direction is None else f"along {_vector(found.direction)}"
    worst, best = found.softest, found.stiffest
    if worst.index == best.index:
        return f"The tool gives way by {_said(worst.compliance)} nm/N {way} at {_where(found, worst)}."
    return pretty(
        f"The tool gives way most, by {_said(worst.compliance)} nm/N {way}, at {_where(found, worst)}, and least, by "
        f"{_said(best.compliance)} nm/N, at {_where(found, best)}."
    )


def _values(found: ComplianceMap) -> Iterator[KeyValue]:
    for place, name in ((found.softest, "softest place"), (found.stiffest, "stiffest place")):
        if place is not None:
            yield KeyValue(name, pretty(_said(place.compliance)), "nm/N", pretty(f"{_where(found, place)}"))
    if found.softest is not None:
        yield KeyValue("least stiffness", _stiffness(found.softest.compliance), "N/µm", "at the softest place")
    if found.difference is not None and found.softest is not found.stiffest:
        yield KeyValue("difference", pretty(_said(found.difference)), "nm/N", "softest less stiffest place")
    yield KeyValue("supported", whole_percent(found.share_supported), "%", "of the places, by the tests")


def _tables(found: ComplianceMap) -> Iterator[Table]:
    places = [(name, one) for name, one in (("softest", found.softest), ("stiffest", found.stiffest)) if one is not None]
    rows = tuple(
        (name, _where(found, one), pretty(_said(one.compliance)), _stiffness(one.compliance)) for name, one in places
    )
    if rows:
        heads = ("place", "at", "compliance ± U (95 %) [nm/N]", "stiffness ± U [N/µm]")
        yield Table(heads, rows, words=(0, 1), title="The worst and the best place")
    for name, one in places:
        if one.at_tool.principal:
            yield _principal(f"Principal directions at the {name} place", one)


def _principal(title: str, place: Place) -> Table:
    rows = tuple(
        (
            _vector(one.direction),
            significant(np.degrees(one.direction_uncertainty), 2),
            pretty(_said(one.compliance)),
            _stiffness(one.compliance),
        )
        for one in place.at_tool.principal
    )
    heads = ("direction", "u of it [°]", "compliance ± U (95 %) [nm/N]", "stiffness ± U [N/µm]")
    return Table(heads, rows, words=(0,), title=title)


def _notes(found: ComplianceMap) -> Iterator[str]:
    if found.prior and not found.supported.all():
        share = _PERCENT * float(np.nanmax(found.prior_share))
        yield (
            f"Where the tests do not tell, values rest on a prior: every compliance has a standard deviation of "
            f"{significant(TYPICAL_COMPLIANCE * NM)} nm/N with a lever of {TYPICAL_LEVER:g} mm. Up to {share:.0f} % of the "
            f"variance is the prior's; no data stand behind that part."
        )


def _sections(found: ComplianceMap) -> Iterator[Section]:
    wide = sum(count > 1 for count in found.grid.shape)
    if wide > 1 and np.isfinite(found.expanded).any():
        caption = "The expanded uncertainty U in the same slices: where the tests tell most, and least."
        drawn = _picture("uncertainty", caption, "Expanded uncertainty over slices of the volume", found)
        yield Section("How sure", pictures=(drawn,))
    if _drawable(found):
        caption = (
            "How far forces of one size in every direction move the tool, at the corners of the volume and in its "
            "middle; the black axis is the softest direction. All are on one scale."
        )
        yield Section(
            "Ellipsoids", pictures=(_picture("ellipsoids", caption, "Compliance ellipsoids in the volume", found),)
        )
    if found.design is not None:
        yield _design_section(found, found.design)
    tables = tuple(_tables(found))
    if tables:
        yield Section("Worst and best place", tables=tables)
    yield Section(
        "How it was computed",
        points=(
            "The compliance at the tool adds up the compliances of all joints, carried to the tool (Eq. 4.10).",
            "A place counts as supported if what it asks lies in what the tests see: then the value and its U follow "
            "from the readings alone, by the scatter of the runs and every stated influence.",
            "The softest direction is that of the greatest principal compliance; its U is to first order.",
            "Compliances that were not asked for count as rigid.",
        ),
    )
    yield from files_section(found.campaign)


def _design_section(found: ComplianceMap, design: AgainstDesign) -> Section:
    wide = sum(count > 1 for count in found.grid.shape) > 1 and bool(design.agrees.any())
    caption = "How much softer the machine is at the tool than by design: negative where it is stiffer."
    pictures = (_picture("design", caption, "Measured less design over slices of the volume", found),) if wide else ()
    units = shared_units((one.name, one.unit, max(abs(one.measured.value), abs(one.design))) for one in design.parameters)
    rows = tuple(
        (
            combination(one.stands_for, _TERMS),
            pretty(_in_unit(one.measured, units[one.name].factor)),
            pretty(significant(one.design * units[one.name].factor)),
            units[one.name].name,
            {True: "yes", False: "no", None: "not known"}[one.agrees],
        )
        for one in design.parameters
    )
    heads = ("what the tests determine", "measured ± U (95 %)", "by design", "unit", "agree within U")
    note = "Single compliances stay in sums; what the machine does at the tool does not. Compare there."
    table = Table(heads, rows, words=(0, 3, 4), title=f"Against {design.name}", note=note)
    return Section("Against the design", pictures=pictures, tables=(table,) if rows else ())


def _in_unit(found: Estimate, factor: float) -> str:
    return said_estimate(found.scaled(factor)) if found.known else significant(found.value * factor)


def _drawable(found: ComplianceMap) -> bool:
    whole = all(
        len(place.at_tool.principal) == len("XYZ") and place.at_tool.principal[0].compliance.value > 0
        for place in found.corners
    )
    return bool(found.corners) and whole and len(found.grid.axes) > 1


def _where(found: ComplianceMap, place: Place) -> str:
    return pretty(
        " ".join(f"{axis} {one[k]:.6g}" for axis, one, k in zip(found.grid.axes, found.grid.along, place.index, strict=True))
    )


def _said(compliance: Estimate) -> str:
    return _in_unit(compliance, NM)


def _stiffness(compliance: Estimate) -> str:
    try:
        stiffness = compliance.inverse().scaled(1 / UM)
    except UnsupportedError:
        return UNKNOWN
    return pretty(said_estimate(stiffness)) if stiffness.known else significant(stiffness.value)


def _vector(direction: np.ndarray[tuple[int], np.dtype[np.float64]]) -> str:
    if np.count_nonzero(direction) == 1 and direction.max() == 1.0:
        return "XYZ"[int(np.argmax(direction))]
    return pretty("(" + ", ".join(f"{part:.3f}" for part in direction) + ")")


def _picture(name: str, caption: str, alternative: str, found: ComplianceMap) -> Picture:
    def draw() -> Figure:
        with needs_report_extra():
            from elastogeo.report.predictions import figures
        return {
            "slices": figures.slices_figure,
            "uncertainty": figures.uncertainty_figure,
            "design": figures.design_figure,
            "ellipsoids": figures.ellipsoids_figure,
        }[name](found)

    return Picture(name, caption, alternative, draw)

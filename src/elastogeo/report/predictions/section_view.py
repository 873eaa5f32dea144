"""The view of a map that is kept, and of a section through it: where the machine is softest and stiffest in a direction."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, degrees, hypot
from typing import Any

import numpy as np

from elastogeo.prediction import ElementMap, Elements, MapSection, Spot, section_of
from elastogeo.report.days import origin_said
from elastogeo.report.document import UM, document, verdict_entries
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.later import Later
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty, whole_percent
from elastogeo.report.predictions.section_plot import frame_json, section_plot
from elastogeo.report.text import listed
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, said, views

MAP_SCHEMA = "elastogeo.map/1"
_DIGITS = 6
_FEW = 4
_ALIKE = 1e-9
"""Places that differ by less, relative, are equally stiff: what is left is the arithmetic's."""


@views(ElementMap)
def element_map_view(found: ElementMap) -> View:
    """A map, by its middle section along X."""
    return section_view(section_of(found))


@views(MapSection)
def section_view(section: MapSection) -> View:
    """All that is shown of a section."""
    found = section.map
    answer = _answer(section)
    shown = document(MAP_SCHEMA, {"section": section_json(section), "verdict": verdict_entries(found.verdict)})
    return View(
        kind="Stiffness map",
        title=found.machine,
        subtitle=pretty(f"stiffness along {direction_said(section)}, {plane_said(section)}"),
        origin=origin_said("simulated", found.simulated),
        head=tuple(_head(section)),
        sentence=answer,
        values=tuple(_values(section)),
        picture=Picture(
            "section",
            "Stiffness in colour: violet where it is soft, fading to the background where it is stiff; contours in N/µm. "
            "Grey was never tested. ▼ softest, ▲ stiffest place of the section.",
            answer,
            lambda: _figure(section),
            plain=lambda: section_plot(section, answer),
        ),
        checks=said(found.verdict),
        document=Later(lambda: {**document(MAP_SCHEMA, found.document()), **shown}, shown),
        rows=_rows(section),
        advice=tuple(_advice(section)),
        tables=_table(section),
        sections=(
            Section("Along the axes", tables=_along_axes(section)),
            Section(
                "How it was computed",
                points=(
                    "The stiffness along a direction is the force over the displacement along it, of the tool relative to "
                    "the workpiece: 1 / (e·C e), with the six elements of the compliance C at each place.",
                    "An element counts as tested where what it asks lies in what the tests see, with no joint taken as "
                    "rigid; a direction where every element that it needs does.",
                    "U (95 %) is by the scatter of the runs and every stated influence; between the axes its coverage "
                    "factor is an approximation.",
                ),
            ),
        ),
    )


def section_json(section: MapSection) -> dict[str, Any]:
    """What a page needs to turn the direction by itself: six elements and their covariance for each place."""
    softest, stiffest = (None if one is None else _spot(one) for one in (section.softest, section.stiffest))
    return {
        "axes": list(section.axes),
        "along_mm": [one.tolist() for one in section.along],
        "height": {
            "axis": section.height_axis,
            "number": section.height,
            "mm": float(section.heights[section.height]) if section.height_axis else None,
            "said": [pretty(f"{one:.{_DIGITS}g}") for one in section.heights],
        },
        "direction": section.direction.tolist(),
        "told": _plain(section.told),
        "assumed": None if section.beside is None else _plain(section.beside),
        "softest": softest,
        "stiffest": stiffest,
        "known": int(section.known.sum()),
        "resting": int((section.resting & section.known).sum()),
        "places": int(section.known.size),
        "frame": frame_json(section),
    }


def direction_said(section: MapSection) -> str:
    """A direction: `X`, or its two angles."""
    x, y, z = (float(part) for part in section.direction)
    for name, part in zip("XYZ", (x, y, z), strict=True):
        if abs(part) > 1 - 1e-12:
            return name
    return f"{degrees(atan2(y, x)):.0f}° from X to Y, {degrees(atan2(z, hypot(x, y))):.0f}° up to Z"


def plane_said(section: MapSection) -> str:
    """Which section: `section XY at Z −100 mm`."""
    plane = "".join(section.axes)
    if not section.height_axis:
        return f"section {plane}"
    return f"section {plane} at {section.height_axis} {section.heights[section.height]:.6g} mm"


def _answer(section: MapSection) -> str:
    soft, stiff = section.softest, section.stiffest
    way = direction_said(section)
    if soft is None or stiff is None:
        return pretty(
            f"Nothing is known of the stiffness along {way} in this section: none of these tests tells it, and nothing "
            f"is guessed."
        )
    if soft.commands == stiff.commands:
        return pretty(f"Along {way} the stiffness is {_said(soft)} N/µm at {_where(soft)}, the only place known here.")
    if stiff.stiffness - soft.stiffness < _ALIKE * soft.stiffness:
        return pretty(f"Along {way} the stiffness is {_said(soft)} N/µm at each of the {section.known.sum()} places known.")
    return pretty(
        f"Along {way} the machine is softest, {_said(soft)} N/µm, at {_where(soft)}, and stiffest, {_said(stiff)} N/µm, at "
        f"{_where(stiff)}."
    )


def _advice(section: MapSection) -> Iterator[str]:
    known, places = int(section.known.sum()), int(section.known.size)
    resting = int((section.resting & section.known).sum())
    told = known - resting
    if told < places:
        where = f"at {told} of {places} places" if told else "at none of the places"
        yield f"The tests tell it {where} of this section; what is grey was never tested."
    if resting:
        yield (
            f"At {resting} places (white dots) the value rests on an assumption: {_rigid(section.map)} were never tested "
            f"and count as rigid."
        )


def _rigid(found: ElementMap) -> str:
    sites = {name: name.split("_", 1)[1][2:] for name in found.rigid}
    counted = {site: list(sites.values()).count(site) for site in dict.fromkeys(sites.values())}
    named = listed(tuple(f"{count} of {site}" for site, count in list(counted.items())[:_FEW]))
    more = len(counted) - _FEW
    rest = f" and {more} more" if more > 0 else ""
    return f"{len(found.rigid)} compliances of joints ({named}{rest})"


def _head(section: MapSection) -> Iterator[tuple[str, str]]:
    found = section.map
    yield "Rests on", listed(found.tests)
    yield "Tool point", pretty(", ".join(f"{part:.{_DIGITS}g}" for part in found.tool) + " mm in the last carriage")
    if found.stands:
        yield "Other axes", pretty(", ".join(_stands(axis, value) for axis, value in found.stands.items()))


def _stands(axis: str, value: float) -> str:
    return f"{axis} {degrees(value):.{_DIGITS}g}°" if axis in "ABC" else f"{axis} {value:.{_DIGITS}g}"


def _values(section: MapSection) -> Iterator[KeyValue]:
    soft, stiff = section.softest, section.stiffest
    if soft is not None and stiff is not None:
        alike = stiff.stiffness - soft.stiffness < _ALIKE * soft.stiffness
        shown = [("stiffness", soft)] if alike else [("softest", soft), ("stiffest", stiff)]
        yield from (KeyValue(name, pretty(_said(one)), "N/µm", pretty(_where(one))) for name, one in shown)
    share = float((section.known & ~section.resting).mean())
    yield KeyValue("tested", whole_percent(share), "%", "of the places of this section")


def _table(section: MapSection) -> tuple[Table, ...]:
    rows = tuple(
        (name, pretty(_where(spot)), pretty(_said(spot)))
        for name, spot in (("softest", section.softest), ("stiffest", section.stiffest))
        if spot is not None
    )
    heads = ("place", "at", "stiffness ± U (95 %) [N/µm]")
    return (Table(heads, rows, words=(0, 1), title="The softest and the stiffest place", name="extremes"),) if rows else ()


def _along_axes(section: MapSection) -> tuple[Table, ...]:
    """The same section along each of the three axes."""
    rows = []
    for k, name in enumerate("XYZ"):
        one = section_of(section.map, section.axes, section.height, np.eye(3)[k], section.beside is not None)
        soft, stiff = one.softest, one.stiffest
        cells = ("not tested", "", "not tested", "") if soft is None or stiff is None else _cells(soft, stiff)
        rows.append((name, *cells))
    heads = ("along", "softest ± U [N/µm]", "at", "stiffest ± U [N/µm]", "at")
    return (Table(heads, tuple(rows), words=(0, 2, 4), title="Softest and stiffest along the axes", name="axes"),)


def _cells(soft: Spot, stiff: Spot) -> tuple[str, str, str, str]:
    return pretty(_said(soft)), pretty(_where(soft)), pretty(_said(stiff)), pretty(_where(stiff))


def _where(spot: Spot) -> str:
    return f"{' '.join(f'{axis} {value:.{_DIGITS}g}' for axis, value in spot.commands.items())} mm"


def _said(spot: Spot) -> str:
    if not np.isfinite(spot.expanded):
        return significant(spot.stiffness / UM)
    return value_with_uncertainty(spot.stiffness / UM, spot.expanded / UM)


def _spot(spot: Spot) -> dict[str, Any]:
    return {
        "commands_mm": dict(spot.commands),
        "stiffness_N_per_um": spot.stiffness / UM,
        "expanded_N_per_um": spot.expanded / UM,
    }


def _plain(one: Elements) -> dict[str, Any]:
    return {"compliance_mm_per_N": one.compliance, "covariance": one.covariance, "coverage": one.coverage}


def _rows(section: MapSection) -> list[dict[str, Any]]:
    across, up = section.along
    rows = []
    for i, j in np.ndindex(section.compliance.shape):
        at = {section.axes[0]: float(across[i]), section.axes[1]: float(up[j])}
        if section.height_axis:
            at[section.height_axis] = float(section.heights[section.height])
        known = bool(section.known[i, j])
        stiffness = float(section.stiffness[i, j]) / UM if known else None
        half = float(section.expanded[i, j] * section.stiffness[i, j] ** 2) / UM if known else float("nan")
        rests = "" if not known else "assumption" if section.resting[i, j] else "tests"
        row: dict[str, Any] = {f"{axis}_mm": value for axis, value in at.items()}
        row |= {"stiffness_N_per_um": stiffness, "expanded_N_per_um": half if np.isfinite(half) else None}
        rows.append(row | {"rests_on": rests})
    return rows


def _figure(section: MapSection) -> Any:
    with needs_report_extra():
        from elastogeo.report.predictions.section_figure import section_figure
    return section_figure(section)

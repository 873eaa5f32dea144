"""The view of a static test: loops, straight lines, Cartesian stiffness, twist; the joints below."""

from __future__ import annotations

from typing import TYPE_CHECKING

from elastogeo.identification.static_tests import StaticResults
from elastogeo.report.head import files_section, head, origin
from elastogeo.report.identification.collinear import collinear_section
from elastogeo.report.identification.pictures import picture
from elastogeo.report.identification.view import parameter_table, stands_for
from elastogeo.report.static_tests.document import static_json
from elastogeo.report.static_tests.tables import hysteresis_figure, key_values, static_tables
from elastogeo.report.view import Picture, Section, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@views(StaticResults)
def static_view(found: StaticResults) -> View:
    """All that is shown of a static test."""
    test, joints, tables = found.joints.test, found.joints, static_tables(found)
    first = picture("traces", joints)
    if found.places:
        first = Picture(
            "hysteresis",
            "Displacement over the force, and its departure from the secant or the straight line.",
            "Loading loops of every run",
            lambda: _loops(found),
        )
    values = key_values(found)
    lead = f"{values[0].name} {values[0].value} {values[0].unit}. " if values else ""
    parameters = parameter_table(joints)
    document = static_json(found)
    return View(
        kind="Static test",
        title=test.machine.name,
        subtitle=test.name,
        origin=origin(test),
        head=head(test),
        sentence=f"{lead[:1].upper()}{lead[1:]}{attention_sentence(found.verdict)}",
        values=values,
        picture=first,
        checks=said(found.verdict),
        document=document,
        rows=document["joints"]["parameters"],
        tables=(*tables, parameters),
        notes=stands_for(joints),
        sections=(
            Section("What the instrument shows", tables=tables),
            Section("Joint parameters", pictures=(picture("contributions", joints),), tables=(parameters,)),
            *collinear_section(joints),
            Section("Fit", pictures=(picture("residuals", joints),)),
            *files_section(test),
        ),
    )


def _loops(found: StaticResults) -> Figure:
    figure = hysteresis_figure(found)
    assert figure is not None
    return figure

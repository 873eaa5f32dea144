"""The view of a ball-roller test: the stiffness of the machine by direction, the drives, the joints."""

from __future__ import annotations

from elastogeo.identification import StiffnessMap
from elastogeo.report.head import files_section, head, origin
from elastogeo.report.identification.pictures import picture
from elastogeo.report.identification.view import parameter_table, stands_for
from elastogeo.report.numbers import pretty
from elastogeo.report.rollers.document import stiffness_json
from elastogeo.report.rollers.rows import balance_rows, level_rows, overall_name, stiffness_figure, stiffness_rows
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views


@views(StiffnessMap)
def stiffness_view(found: StiffnessMap) -> View:
    """All that is shown of a stiffness map."""
    test, rows = found.joints.test, stiffness_rows(found)
    ordered = sorted(zip(found.overall.stiffness, rows, strict=True), key=lambda pair: pair[0])
    softest, stiffest = ordered[0][1], ordered[-1][1]
    names = {check.name for check in found.verdict}
    checks = (*found.verdict, *(check for check in found.joints.verdict if check.name not in names))
    by_direction = Table(
        ("direction [°]", "compliance ± U [µm/N]", "stiffness [N/µm]", "95 % [N/µm]"),
        tuple((r.direction, pretty(r.compliance), r.stiffness, r.stiffness_interval) for r in rows),
        words=(),
        title=f"Stiffness by direction: {overall_name(found)}",
    )
    by_level = Table(
        ("force [N]", "secant (6.5) [N/µm]", "increment [N/µm]", "modelled [N/µm]"),
        tuple((r.force, r.secant, r.increment, r.modelled) for r in level_rows(found)),
        words=(),
        title="Stiffness by engagement",
        note="Least to greatest around the turn. A secant runs from zero force, an increment from the engagement before.",
    )
    balance = Table(
        ("axis", "term", "value ± U (95 %)", "unit"),
        tuple((r.axis, r.parameter, pretty(r.value), r.unit) for r in balance_rows(found)),
        words=(0, 1, 3),
        title="Torque balance of the drives",
    )
    joints = parameter_table(found.joints)
    document = stiffness_json(found)
    return View(
        kind="Stiffness map",
        title=test.machine.name,
        subtitle=test.name,
        origin=origin(test),
        head=head(test),
        sentence=f"Softest at {softest.direction}°, {softest.stiffness} N/µm; stiffest at {stiffest.direction}°, "
        f"{stiffest.stiffness} N/µm. {attention_sentence(checks)}",
        values=tuple(
            KeyValue(f"{name}, {row.direction}°", row.stiffness, "N/µm", f"95 %: {row.stiffness_interval} N/µm")
            for name, row in (("softest", softest), ("stiffest", stiffest))
        ),
        picture=Picture(
            "stiffness",
            "Stiffness by direction with its 95 % interval: modelled, and as secants and increments of the engagements.",
            "Stiffness of the machine in every direction, as a rose",
            lambda: stiffness_figure(found),
        ),
        checks=said(checks),
        document=document,
        rows=document["overall"]["directions"],
        tables=(by_level, by_direction, balance, joints),
        notes=stands_for(found.joints),
        sections=(
            Section("Stiffness by direction", tables=(by_level, by_direction)),
            Section("The drives", tables=(balance,)),
            Section("Joint parameters", pictures=(picture("contributions", found.joints),), tables=(joints,)),
            Section("Fit", pictures=(picture("traces", found.joints), picture("residuals", found.joints))),
            *files_section(test),
        ),
    )

"""The view of a comparison: what changed between two tests of one machine."""

from __future__ import annotations

from elastogeo.identification import BeforeAfter
from elastogeo.report.days import origin_said
from elastogeo.report.faults.comparison_document import comparison_json
from elastogeo.report.faults.rows import YES, comparison_rows
from elastogeo.report.head import head
from elastogeo.report.identification.pictures import picture
from elastogeo.report.numbers import pretty
from elastogeo.report.view import KeyValue, Section, Table, View, attention_sentence, said, views

KEY_VALUES = 5


@views(BeforeAfter)
def comparison_view(compared: BeforeAfter) -> View:
    """All that is shown of a comparison."""
    before, after = compared.before.test, compared.after.test
    rows = comparison_rows(compared)
    changed = [row for row in rows if row.changed == YES]
    answer = (
        f"{', '.join(row.name for row in changed)} changed by more than the uncertainty of the two tests."
        if changed
        else "No parameter changed by more than the uncertainty of the two tests."
    )
    simulated = sorted({test.simulated for test in (before, after) if test.simulated})
    table = Table(
        ("parameter", "before", "after", "change ± U (95 %)", "unit", "p", "changed"),
        tuple(
            (r.name, pretty(r.before), pretty(r.after), pretty(r.change), r.unit, pretty(r.p_value), r.changed) for r in rows
        ),
        words=(0, 4, 6),
        title="What changed",
        note="p: how often such a change, or a greater one, would come about if nothing changed; the number of "
        "parameters counts.",
    )
    document = comparison_json(compared)
    return View(
        kind="Comparison",
        title=before.machine.name,
        subtitle=f"{before.name} → {after.name}",
        origin=origin_said("simulated", "; ".join(simulated)),
        head=(*(("Before: " + label, text) for label, text in head(before)), *(("After: " + a, b) for a, b in head(after))),
        sentence=f"{answer} {attention_sentence(compared.verdict)}",
        values=tuple(KeyValue(r.name, pretty(r.change), r.unit, f"change; p = {r.p_value}") for r in rows[:KEY_VALUES]),
        picture=picture("traces", compared.after),
        checks=said(compared.verdict),
        document=document,
        rows=document["differences"],
        tables=(table,),
        sections=(Section("What changed", tables=(table,)),),
    )

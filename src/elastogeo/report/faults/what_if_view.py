"""The view of a what-if: what a correction would bring."""

from __future__ import annotations

from elastogeo.identification import WhatIf
from elastogeo.report.faults.rows import what_if_rows
from elastogeo.report.faults.what_if_document import what_if_json
from elastogeo.report.head import head, origin
from elastogeo.report.identification.pictures import picture
from elastogeo.report.numbers import pretty
from elastogeo.report.view import KeyValue, Section, Table, View, attention_sentence, said, views

KEY_VALUES = 5


@views(WhatIf)
def what_if_view(predicted: WhatIf) -> View:
    """All that is shown of a what-if."""
    result, rows = predicted.identification, what_if_rows(predicted)
    names = ", ".join(predicted.corrected)
    best = rows[-1] if rows else None
    told = f"{best.what} at {best.force} N goes from {best.before_um} to {best.after_um} µm" if best else "nothing changes"
    table = Table(
        ("force [N]", "deviation", "before [µm]", "after [µm]", "change [%]"),
        tuple((row.force, row.what, row.before_um, row.after_um, pretty(row.change_percent)) for row in rows),
        words=(1,),
        title=f"With {names} corrected, predicted",
    )
    document = what_if_json(predicted)
    return View(
        kind="What if",
        title=result.test.machine.name,
        subtitle=result.test.name,
        origin=origin(result.test),
        head=head(result.test),
        sentence=f"With {names} corrected, {told} (predicted). {attention_sentence(result.verdict)}",
        values=tuple(
            KeyValue(
                f"{row.what}, {row.force} N", f"{row.before_um} → {row.after_um}", "µm", f"{pretty(row.change_percent)} %"
            )
            for row in rows[-KEY_VALUES:]
        ),
        picture=picture("traces", result),
        checks=said(result.verdict),
        document=document,
        rows=document["traces"],
        tables=(table,),
        sections=(Section("Prediction", tables=(table,)),),
    )

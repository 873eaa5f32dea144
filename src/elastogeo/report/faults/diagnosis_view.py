"""The view of a diagnosis: which fault distorts the trace by how much."""

from __future__ import annotations

from typing import TYPE_CHECKING

from elastogeo.identification import Circularity, Diagnosis
from elastogeo.report.faults.diagnosis_document import diagnosis_json
from elastogeo.report.faults.rows import diagnosis_rows
from elastogeo.report.head import files_section, head, origin
from elastogeo.report.identification.pictures import picture
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import UM
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KEY_VALUES = 5


@views(Diagnosis)
def diagnosis_view(diagnosis: Diagnosis) -> View:
    """All that is shown of a diagnosis."""
    result = diagnosis.identification
    test, rows = result.test, diagnosis_rows(diagnosis)
    ranking = Picture(
        "ranking",
        "Distortion of the trace by each fault of the machine, greatest first, with its 95 % interval. Pale: it "
        "may be none.",
        "Distortion of the trace by each fault, in micrometres, with its interval",
        lambda: _ranking(diagnosis),
    )
    top = [row for row in rows if row.rank][:KEY_VALUES]
    untold = f"This test says nothing of {', '.join(diagnosis.untold)}." if diagnosis.untold else ""
    also = tuple(f"{row.name} cannot be distinguished from {row.also}" for row in rows if row.also)
    document = diagnosis_json(diagnosis)
    return View(
        kind="Diagnosis",
        title=test.machine.name,
        subtitle=test.name,
        origin=origin(test),
        head=head(test),
        sentence=_answer(diagnosis),
        values=tuple(
            KeyValue(row.meaning, pretty(row.value), row.unit, row.sentence or f"{row.share_percent} % of all faults")
            for row in top
        ),
        picture=picture("traces", result),
        checks=said(result.verdict),
        document=document,
        rows=document["faults"],
        tables=(fault_table(diagnosis), *circular_tables(diagnosis.circularity)),
        notes=(*(f"{row.sentence}." for row in rows if row.sentence), *also, *([untold] if untold else [])),
        sections=(
            Section(
                "Faults, ranked",
                pictures=(ranking,),
                tables=(fault_table(diagnosis),),
                points=(*(f"{row.sentence}." for row in rows if row.sentence), *also),
                note=untold,
            ),
            Section("Circular deviations after ISO 230-4", tables=circular_tables(diagnosis.circularity)),
            Section("Residuals", pictures=(picture("residuals", result),)),
            *files_section(test),
        ),
    )


def fault_table(diagnosis: Diagnosis) -> Table:
    """The ranked faults; the set-up last, without rank and share."""
    return Table(
        headings=("", "fault", "name", "value ± U (95 %)", "unit", "distortion ± U [µm]", "share [%]"),
        rows=tuple(
            (row.rank, row.meaning, row.name, pretty(row.value), row.unit, pretty(row.distortion_um), row.share_percent)
            for row in diagnosis_rows(diagnosis)
        ),
        words=(0, 1, 2, 4),
        title="Faults, ranked",
        note="Distortion: peak to peak of the fault's part of the trace at the highest force. The set-up is no fault of the "
        "machine and has no share.",
    )


def circular_tables(found: dict[float, Circularity]) -> tuple[Table, ...]:
    """ISO 230-4 parameters by force level; none for what is no circle."""
    if not found:
        return ()
    headings = ("force [N]", "G, CCW", "G, CW", "G(b)", "D", "F, CCW", "F, CW")
    return (
        Table(
            headings,
            tuple(_circular_row(force, circle) for force, circle in found.items()),
            words=(),
            title="Circular deviations [µm]",
            note="Of the measured traces, first run of each direction. They describe the trace; they do not say "
            "which fault it "
            "is, and have no uncertainty. A dash: not determined by this test.",
        ),
    )


def _circular_row(force: float, found: Circularity) -> tuple[str, ...]:
    shown = (found.g_ccw, found.g_cw, found.g_bidirectional, found.mean_radial)
    spans = ((found.f_min_ccw, found.f_max_ccw), (found.f_min_cw, found.f_max_cw))
    return (
        f"{force:g}",
        *("–" if value is None else pretty(significant(value * UM)) for value in shown),
        *(
            "–" if low is None or high is None else pretty(f"{significant(low * UM)} to {significant(high * UM)}")
            for low, high in spans
        ),
    )


def _answer(diagnosis: Diagnosis) -> str:
    checks = attention_sentence(diagnosis.identification.verdict)
    ranked = [row for row in diagnosis_rows(diagnosis) if row.rank]
    if not ranked:
        return f"No fault of the machine was asked for. {checks}"
    first = ranked[0]
    meaning = first.meaning[:1].upper() + first.meaning[1:]
    size = f"{pretty(first.distortion_um)} µm, {first.share_percent} % of all faults"
    return f"{meaning} distorts the trace most: {size}. {checks}"


def _ranking(diagnosis: Diagnosis) -> Figure:
    from elastogeo.report.faults.ranking import ranking_figure

    return ranking_figure(diagnosis)

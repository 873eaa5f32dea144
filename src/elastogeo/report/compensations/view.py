"""The view of a compensation: the error before, what the control adds, what is expected after; what was left out and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.prediction.compensation import CompensatedError, Compensation, LeftOut
from elastogeo.report.compensations.document import compensation_json
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.head import campaign_head, files_section, origin
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.scales import said as said_size
from elastogeo.report.scales import said_with, scale_of
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_REASONS = {
    "uncertainty": "not greater than its uncertainty",
    "no interval": "nothing shows its uncertainty",
    "not determined": "not determined by the tests",
    "control": "the control has no table for it",
    "not linear": "no table holds it",
}
_KEYS = 3
_LINES = 60
"""Of a file that the page shows."""
_ROWS = 25
"""Of a table by point: more are thinned, the JSON has all."""
_FAR = 1e-3
"""An angle [rad] that counts as much as a millimetre."""
_ALL = "Errors before and after"


@views(Compensation)
def compensation_view(found: Compensation) -> View:
    """All that is shown of a compensation."""
    document = compensation_json(found)
    drawn = [_picture(one) for one in found.errors]
    return View(
        kind="Compensation",
        title=found.campaign.machine.name,
        subtitle=f"{found.title}, from {found.campaign.name}",
        origin=origin(found.campaign),
        head=(*campaign_head(found.campaign), *_head(found)),
        sentence=f"{_lead(found)} {attention_sentence(found.verdict)}",
        values=tuple(_values(found)),
        picture=drawn[0] if drawn else None,
        checks=said(found.verdict),
        document=document,
        rows=[{"error": error["name"], **point} for error in document["errors"] for point in error["points"]],
        tables=tuple(_tables(found)),
        notes=tuple(_notes(found)),
        sections=tuple(_sections(found, drawn)),
    )


def _lead(found: Compensation) -> str:
    if not found.errors:
        return "Nothing is written: no error was found that is certain and that this control compensates."
    one = max(found.errors, key=lambda error: error.before[0] / (_FAR if error.error.is_angular else 1.0))
    told = (
        f"{one.error.name} falls from {said_with(*one.before, one.error.is_angular)} to at most "
        f"{said_size(one.bound, one.error.is_angular)}: greatest deviation found, and the farthest end of the intervals "
        f"expected after."
    )
    if len(found.errors) == 1:
        return told
    return f"{len(found.errors)} errors are compensated. The greatest: {told}"


def _values(found: Compensation) -> Iterator[KeyValue]:
    for one in found.errors[:_KEYS]:
        scale = scale_of(one.error)
        before, after = significant(one.before[0] * scale.factor), significant(one.bound * scale.factor)
        yield KeyValue(one.error.name, pretty(f"{before} → {after}"), scale.unit, "greatest before → at most after, 95 %")
    if found.left_out:
        names = dict.fromkeys(name for out in found.left_out for name in out.names)
        yield KeyValue("Left out", str(len(names)), "", ", ".join(names))


def _head(found: Compensation) -> Iterator[tuple[str, str]]:
    yield "Control", found.title
    if found.settings:
        yield "Settings", ", ".join(f"{name} = {value}" for name, value in found.settings.items())
    if found.files:
        yield "For the control", ", ".join(found.files)


def _tables(found: Compensation) -> Iterator[Table]:
    if found.errors:
        rows = tuple(_row(one) for one in found.errors)
        headings = ("error", "before, greatest ± U", "after, greatest ± U", "after at most", "points", "zero at")
        yield Table(headings, rows, (0,), "Errors before and expected after")
    if found.left_out:
        yield Table(("left out", "of", "why"), tuple(map(_left, found.left_out)), (0, 1, 2), "Not written")


def _row(one: CompensatedError) -> tuple[str, ...]:
    scale, angular = scale_of(one.error), one.error.is_angular
    return (
        one.error.name,
        said_with(*one.before, angular),
        said_with(*one.after, angular),
        said_size(one.bound, angular),
        str(len(one.written.position)),
        pretty(f"{one.found.zero_at * scale.place_factor:.6g} {scale.place_unit}"),
    )


def _left(out: LeftOut) -> tuple[str, str, str]:
    why = out.why or _REASONS[out.reason]
    return ", ".join(out.names), out.table, why


def _notes(found: Compensation) -> Iterator[str]:
    if found.volume is not None:
        whole = found.volume
        before, bound = (said_size(size, False) for size in (whole.before, whole.bound))
        yield (
            f"At {whole.poses} poses within the travel of the tests ({', '.join(whole.axes)} together) the deviation along "
            f"{', '.join(whole.components)} falls from {before} to at most {bound}: what two axes cause together is in no "
            f"table and stays."
        )
    yield (
        "Deviations are actual less nominal. What is expected after is what was found less what the control makes of these "
        "files; its interval is that of what was found, so a test after is to lie in it."
    )
    if found.errors:
        yield f"Read were {'; '.join(dict.fromkeys(map(_span, found.errors)))}. Beyond that nothing is predicted."


def _span(one: CompensatedError) -> str:
    scale = scale_of(one.error)
    low, high = (pretty(f"{end * scale.place_factor:.6g}") for end in one.error.span)
    return f"{one.error.axis} from {low} to {high} {scale.place_unit}"


def _sections(found: Compensation, drawn: list[Picture]) -> Iterator[Section]:
    yield Section(_ALL, paragraphs=tuple(_notes(found)), tables=tuple(_tables(found)))
    for k, one in enumerate(found.errors):
        yield Section(one.error.name, pictures=tuple(drawn[k : k + 1]) if k else (), tables=(_points(one),))
    for name, data in found.files.items():
        lines = data.decode("utf-8").splitlines()
        more = f"{len(lines) - _LINES} more lines" if len(lines) > _LINES else ""
        rows = tuple((line,) for line in lines[:_LINES] if line)
        yield Section(f"File {name}", tables=(Table((name,), rows, (0,), note=more),))
    yield from files_section(found.campaign)


def _points(one: CompensatedError) -> Table:
    scale, before, after, correction = scale_of(one.error), one.error, one.residual, one.correction
    u = scale.factor
    rows = []
    shown = np.unique(np.linspace(0, len(before.position) - 1, min(len(before.position), _ROWS)).round().astype(int))
    for k in shown:
        cells = [f"{before.position[k] * scale.place_factor:.6g}"]
        for side in (0, 1):
            numbers = before.value[k, side], before.uncertainty[k, side], correction[k, side], after.value[k, side]
            cells += [f"{round(number * u, 2) + 0.0:.2f}" for number in numbers]
        rows.append(tuple(map(pretty, cells)))
    headings = [f"{before.axis} [{scale.place_unit}]"]
    headings += [f"{what} {side} [{scale.unit}]" for side in "+−" for what in ("before", "U", "correction", "after")]
    note = f"Of {len(before.position)} points; the JSON has all." if len(shown) < len(before.position) else ""
    return Table(tuple(headings), tuple(rows), (), "By point and direction", note)


def _picture(one: CompensatedError) -> Picture:
    return Picture(
        f"compensation-{one.error.name}",
        f"{one.error.name}: above as it was found, with its 95 % interval; in the middle what the control adds to the "
        f"command; below what is expected after, as uncertain as what was found.",
        f"Error of {one.error.axis} before compensation, the correction, and the error expected after",
        lambda: _drawn(one),
    )


def _drawn(one: CompensatedError) -> Figure:
    with needs_report_extra():
        from elastogeo.report.compensations.figures import compensation_figure
    return compensation_figure(one)

"""The view of a compensated path: the contour before and after, the deviation along it, what was left out and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.prediction.compensation import PathCompensation
from elastogeo.report.compensations.path_document import path_compensation_json
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.head import campaign_head, files_section, origin
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.scales import said as said_size
from elastogeo.report.text import UM
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, attention_sentence, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_REASONS = {
    "uncertainty": "not greater than its uncertainty",
    "no interval": "nothing shows its uncertainty",
    "not determined": "not determined by the tests",
    "not asked": "no parameter was asked for that moves it",
}
_NAMES = ("x", "y", "z", "normal")


@views(PathCompensation)
def path_compensation_view(found: PathCompensation) -> View:
    """All that is shown of a compensated path."""
    document = path_compensation_json(found)
    drawn = bool(found.components)
    return View(
        kind="Compensated path",
        title=found.campaign.machine.name,
        subtitle=f"{found.program.name}, from {found.campaign.name}",
        origin=origin(found.campaign),
        head=(*campaign_head(found.campaign), *_head(found)),
        sentence=f"{_lead(found)} {attention_sentence(found.verdict)}",
        values=tuple(_values(found)),
        picture=_picture(found, "along-the-path") if drawn else None,
        checks=said(found.verdict),
        document=document,
        rows=document["points"],
        tables=(_table(found), *_left(found)),
        notes=(
            "What is expected after is the deviation at the new commands, and what these differ from the meant ones; its "
            "interval is that of the prediction.",
        ),
        sections=(*([Section("From above", pictures=(_picture(found, "from-above"),))] if drawn else []), *_files(found)),
    )


def _files(found: PathCompensation) -> tuple[Section, ...]:
    return files_section(found.campaign)


def _lead(found: PathCompensation) -> str:
    if not found.components:
        return "The program is as it was: nothing of the deviation is certain and determined by the tests."
    columns = [_NAMES.index(name) for name in found.components]
    before = float(np.nanmax(np.abs(found.before.value[:, columns])))
    after = float(np.nanmax(np.abs(found.value[:, columns]) + found.expanded[:, columns]))
    return (
        f"The deviation along {' and '.join(found.components)} falls from {said_size(before, False)} to at most "
        f"{said_size(after, False)}, in {len(found.program.blocks)} blocks."
    )


def _values(found: PathCompensation) -> Iterator[KeyValue]:
    for name in (*found.components, "normal"):
        k = _NAMES.index(name)
        if np.isnan(found.value[:, k]).all():
            continue
        before = float(np.nanmax(np.abs(found.before.value[:, k])))
        after = float(np.nanmax(np.abs(found.value[:, k]) + found.expanded[:, k]))
        shown = pretty(f"{significant(before * UM)} → {significant(after * UM)}")
        meaning = "normal to the path: greatest before → at most after" if name == "normal" else "greatest → at most"
        yield KeyValue(name, shown, "µm", f"{meaning}, 95 %")


def _head(found: PathCompensation) -> Iterator[tuple[str, str]]:
    path = found.before.path
    yield "Path", f"{path.name}, {path.travelled[-1]:.6g} mm, {len(path)} points"
    yield "Force", found.before.force or "none"
    yield "Tolerance", pretty(f"lines within {significant(found.tolerance * UM)} µm of the corrected path")


def _table(found: PathCompensation) -> Table:
    rows = []
    for k, name in enumerate(_NAMES):
        if np.isnan(found.before.value[:, k]).all():
            continue
        columns = found.before.value[:, k], found.before.expanded[:, k], found.value[:, k], found.expanded[:, k]
        sizes = [float(np.nanmax(np.abs(column))) for column in columns]
        worst = float(np.nanmax(np.abs(columns[2]) + columns[3]))
        rows.append((name, *(pretty(significant(size * UM)) for size in (*sizes, worst))))
    headings = ("along", "before [µm]", "U before [µm]", "after [µm]", "U after [µm]", "after at most [µm]")
    return Table(headings, tuple(rows), (0,), "Greatest along the path")


def _left(found: PathCompensation) -> tuple[Table, ...]:
    rows = tuple((", ".join(out.names), _REASONS[out.reason]) for out in found.left_out)
    return (Table(("left out", "why"), rows, (0, 1), "Not compensated"),) if rows else ()


def _picture(found: PathCompensation, name: str) -> Picture:
    if name == "from-above":
        caption = "The path from above: grey as it is meant, orange what the tool would do, blue what it does after."
        return Picture(name, caption, "The path with its deviations before and after", lambda: _drawn(found, name))
    caption = (
        "Along the path: above the deviation that is predicted with its 95 % interval; in the middle by how much the "
        "program is moved; below what is expected after."
    )
    return Picture(name, caption, "Deviation along the path before and after", lambda: _drawn(found, name))


def _drawn(found: PathCompensation, name: str) -> Figure:
    with needs_report_extra():
        from elastogeo.report.compensations.path_figures import along_path_figure, contour_figure
    return contour_figure(found) if name == "from-above" else along_path_figure(found)

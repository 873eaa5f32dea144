"""How a result shows itself: `print(result)`, its `repr`, a notebook, its rows, its document, its report.

The methods of `elastogeo.result.Result` end here: this file registers itself as their renderer. It renders views.
"""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Any

from elastogeo.identification import Check, Parameter
from elastogeo.report.numbers import display_unit
from elastogeo.report.page import save_report
from elastogeo.report.sentences import sentence_of
from elastogeo.report.text import label, said_value
from elastogeo.report.view import Table, View, line_of, view_of
from elastogeo.result import register

_MARKS = {True: "  ok", False: "look", None: " n/t"}


class _Renderer:
    """What `elastogeo.result.Renderer` asks for."""

    def line(self, shown: object) -> str:
        if isinstance(shown, Check):
            return f"{_MARKS[shown.passed]}  {shown.name}: {sentence_of(shown)}"
        if not isinstance(shown, Parameter):
            return line_of(shown)
        unit = display_unit(shown.unit, shown.reach)
        level = "without an interval" if shown.interval is None else "95 %"
        return f"{label(shown)} = {said_value(shown, unit)} {unit.name} ({level})"

    def summary(self, result: Any) -> str:
        view = view_of(result)
        return "\n".join([_title(view), view.sentence, *_attention(view)])

    def text(self, result: Any) -> str:
        view = view_of(result)
        tables = [line for table in view.tables[:1] for line in ("", *_columns(table))]
        return "\n".join([_title(view), view.sentence, *tables, "", *_attention(view)]).rstrip()

    def html(self, result: Any) -> str:
        view = view_of(result)
        lead = f"<p><b>{escape(_title(view))}</b><br>{escape(view.sentence)}</p>"
        judged = "<br>".join(map(escape, _attention(view)))
        return f"{lead}{''.join(map(_html_table, view.tables[:1]))}<p>{judged}</p>"

    def document(self, result: Any) -> dict[str, Any]:
        return dict(view_of(result).document)

    def rows(self, result: Any) -> list[dict[str, Any]]:
        return [dict(row) for row in view_of(result).rows]

    def write(self, result: Any, folder: Path) -> Path:
        return save_report(view_of(result), folder)


def _title(view: View) -> str:
    origin = " (simulated)" if view.origin else ""
    state = f"\n{view.badge.mark} {view.badge.text}" if view.badge is not None else ""
    return f"{view.kind}: {view.title}, {view.subtitle}{origin}{state}"


def _attention(view: View) -> list[str]:
    """The names of the checks that failed or were not tested, in as few lines as it takes."""
    states = {False: "needs attention", None: "not tested"}
    named = {state: [check.name for check in view.checks if check.passed is state] for state in states}
    return [f"{words}: {', '.join(named[state])}" for state, words in states.items() if named[state]]


def _columns(table: Table) -> Iterable[str]:
    """A table as lines of text, each column as wide as its widest cell."""
    lines = [table.headings, *table.rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        cells = (
            cell.ljust(width) if k in table.words else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(line, widths, strict=True))
        )
        yield "  ".join(cells).rstrip()


def _html_table(table: Table) -> str:
    head = "".join(f"<th>{escape(heading)}</th>" for heading in table.headings)
    rows = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in table.rows)
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


register(_Renderer())

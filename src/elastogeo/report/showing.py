"""How a result shows itself: `print(result)`, its `repr`, a notebook, its table, its document, its report.

The methods of `elastogeo.result.Result` end here: this file registers itself as their renderer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from elastogeo.errors import InputError
from elastogeo.identification import (
    BeforeAfter,
    Check,
    Diagnosis,
    DriveIdentification,
    Explanation,
    Identification,
    Parameter,
    StaticResults,
    StiffnessMap,
    WhatIf,
)
from elastogeo.report.as_json import (
    comparison_json,
    confounding_json,
    diagnosis_json,
    identification_json,
    stiffness_json,
    what_if_json,
)
from elastogeo.report.as_json.drive import drive_json
from elastogeo.report.as_json.static import static_json
from elastogeo.report.drive_figures import save_drive_figures
from elastogeo.report.figures import save_figures
from elastogeo.report.html import save_html
from elastogeo.report.numbers import display_unit, value_with_uncertainty
from elastogeo.report.pdf import save_pdf
from elastogeo.report.sentences import sentence_of
from elastogeo.report.static import save_static
from elastogeo.report.stiffness import save_stiffness
from elastogeo.report.text import combination, label, parameter_rows
from elastogeo.result import register

_DOCUMENTS: Mapping[type, Callable[[Any], dict[str, Any]]] = {
    Identification: identification_json,
    Explanation: lambda found: confounding_json(found.confounding, found.test),
    Diagnosis: lambda found: diagnosis_json(found, found.identification),
    WhatIf: lambda found: what_if_json(found, found.identification),
    BeforeAfter: comparison_json,
    StaticResults: static_json,
    StiffnessMap: stiffness_json,
    DriveIdentification: drive_json,
}

_ROWS: Mapping[type, Callable[[dict[str, Any]], list[dict[str, Any]]]] = {
    Identification: lambda found: found["parameters"],
    Explanation: lambda found: found["retained"],
    Diagnosis: lambda found: found["faults"],
    WhatIf: lambda found: found["traces"],
    BeforeAfter: lambda found: found["differences"],
    StaticResults: lambda found: found["joints"]["parameters"],
    StiffnessMap: lambda found: found["overall"]["directions"],
    DriveIdentification: lambda found: [
        {"axis": axis["axis"], **parameter} for axis in found["axes"] for parameter in axis["parameters"]
    ],
}


_MARKS = {True: "  ok", False: "look", None: "   ?"}


class _Renderer:
    """What `elastogeo.result.Renderer` asks for."""

    def line(self, shown: Parameter | Check) -> str:
        if isinstance(shown, Check):
            return f"{_MARKS[shown.passed]}  {shown.name}: {sentence_of(shown)}"
        unit = display_unit(shown.unit, max(map(abs, shown.interval)))
        half = (shown.interval[1] - shown.interval[0]) / 2
        value = value_with_uncertainty(shown.value * unit.factor, half * unit.factor)
        return f"{label(shown)} = {value} {unit.name} (95 %)"

    def summary(self, result: Any) -> str:
        return "\n".join([_title(result), *_judged(_verdict(result))])

    def text(self, result: Any) -> str:
        return "\n".join([_title(result), "", *_columns(_table(result)), "", *_judged(_verdict(result))])

    def html(self, result: Any) -> str:
        headings, *rows = _table(result)
        head = "".join(f"<th>{escape(cell)}</th>" for cell in headings)
        body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
        judged = "<br>".join(map(escape, _judged(_verdict(result))))
        return (
            f"<p><b>{escape(_title(result))}</b></p>"
            f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table><p>{judged}</p>"
        )

    def document(self, result: Any) -> dict[str, Any]:
        return _DOCUMENTS[type(result)](result)

    def rows(self, result: Any) -> list[dict[str, Any]]:
        return _ROWS[type(result)](self.document(result))

    def write(self, result: Any, folder: Path) -> Path:
        if isinstance(result, DriveIdentification):
            save_drive_figures(result, folder)
            return folder
        if isinstance(result, StaticResults):
            save_static(result, folder)
        if isinstance(result, StiffnessMap):
            save_stiffness(result, folder)
        joints = _identification_of(result)
        if joints is None:
            raise InputError(f"there is no report of {type(result).__name__} yet; write its to_json() to a file")
        save_figures(joints, folder)
        save_pdf(joints, folder / "report.pdf")
        return save_html(joints, folder / "report.html")


def _identification_of(result: Any) -> Identification | None:
    if isinstance(result, Identification):
        return result
    found = getattr(result, "joints", None) or getattr(result, "identification", None)
    return found if isinstance(found, Identification) else None


def _title(result: Any) -> str:
    if isinstance(result, BeforeAfter):
        return f"{result.before.test.name} -> {result.after.test.name}"
    if isinstance(result, DriveIdentification):
        return f"{result.test.name}, axes {', '.join(result.test.axes)}, {len(result.test.runs)} runs"
    joints = _identification_of(result)
    test = result.test if joints is None else joints.test
    simulated = "simulated, " if test.simulated else ""
    return f"{test.name}, {simulated}on {test.machine.name} ({test.machine.topology.compact}), {len(test.runs)} runs"


def _verdict(result: Any) -> tuple[Check, ...]:
    if hasattr(result, "verdict"):
        return tuple(result.verdict)
    joints = _identification_of(result)
    return () if joints is None else joints.verdict


def _judged(verdict: Sequence[Check]) -> Iterable[str]:
    """The verdict in as few lines as it takes: how many checks passed, and the names of the others."""
    if not verdict:
        return
    passed = [check for check in verdict if check.passed]
    yield f"{len(passed)} of {len(verdict)} checks passed"
    open_ = {False: "needs attention", None: "not tested"}
    for state, words in open_.items():
        names = [check.name for check in verdict if check.passed is state]
        if names:
            yield f"{words}: {', '.join(names)}"


def _table(result: Any) -> list[tuple[str, ...]]:
    """Headings and rows of the main table, in words and figures."""
    if isinstance(result, Explanation):
        found = result.confounding
        sums = [(name, combination(found.stands_for(name))) for name in found.retained]
        return [("determined", "what it stands for"), *sums, *((name, "changes no reading") for name in found.null)]
    joints = _identification_of(result)
    if joints is not None:
        rows = [(row.name, row.value, row.unit, row.share_percent) for row in parameter_rows(joints)]
        return [("parameter", "value ± U (95 %)", "unit", "share [%]"), *rows]
    entries = _Renderer().rows(result)
    headings = [key for key, value in entries[0].items() if not isinstance(value, dict | list)] if entries else []
    return [tuple(headings), *(tuple(_cell(entry[key]) for key in headings) for entry in entries)]


def _cell(value: Any) -> str:
    return "" if value is None else f"{value:.5g}" if isinstance(value, float) else str(value)


def _columns(table: list[tuple[str, ...]]) -> Iterable[str]:
    """A table as lines of text, each column as wide as its widest cell."""
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()


register(_Renderer())

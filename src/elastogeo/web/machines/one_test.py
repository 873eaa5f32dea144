"""One test: what it says, what causes it, what it cannot tell, and where everything comes from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

from fastapi import Form, Query, Response

from elastogeo.changes import KeptJob, KeptTest
from elastogeo.report import KeptView, Plot, Section, html_page, pdf_page, plot_of, view_kept, view_of
from elastogeo.web.answering import Done, Shown, download, json_response
from elastogeo.web.asking import ENGINEER, Ask, Asked, NotFound, or_not_found
from elastogeo.web.fields import Why
from elastogeo.web.pages import Pages
from elastogeo.web.templating import page

pages = Pages()


@dataclass(frozen=True, slots=True)
class Drawn:
    """What is drawn of a test: view, rows, its causes if it is a circle, whether the raw files said the same again."""

    kept: KeptView
    causes: Mapping[str, Any] | None
    rows: Sequence[Mapping[str, Any]]
    same_bits: bool
    differing: int


@dataclass(frozen=True, slots=True)
class Circle:
    """The trace at one force level, as it is drawn."""

    chosen: Mapping[str, Any]
    plot: Plot
    forces: tuple[tuple[str, str], ...]


@pages.shows("/tests/{key:int}")
def one_test(
    asked: Ask, key: int, force: float | None = None, part: Annotated[int | None, Query(ge=0, le=99)] = None
) -> Shown:
    """A test: the conclusion, what failed, the trace with its ranked causes, and all else folded.

    `force` chooses the force level whose trace is drawn, `part` opens a folded part.
    """
    kept = _kept(asked, key)
    found = _drawn(asked, kept)
    view, causes = view_of(kept), None if found is None else found.causes
    if asked.by_htmx and part is not None:
        inside = {"section": _section(found, part), "kept": None if found is None else found.kept}
        return Shown("machines/test_section.html.j2", context=inside)
    template = "machines/test_trace.html.j2" if asked.by_htmx and causes is not None else "machines/test.html.j2"
    more = {} if causes is None else {"causes": causes["causes"], "columns": causes["columns"]["runs"]}
    context = _context(asked, kept, found, force) | {"part": part}
    return Shown(
        template, view, document={**view.document, **more}, rows=() if found is None else found.rows, context=context
    )


@pages.gives("/tests/{key:int}/drawn", media="text/html")
def drawn(asked: Ask, key: int) -> Response:
    """Whether what takes long to draw is there: a part of the page, which asks again until it is."""
    kept = _kept(asked, key)
    context = _context(asked, kept, _drawn(asked, kept), None) | {"part": None}
    text = page("machines/test_body.html.j2", asked, view=view_of(kept), **context)
    return Response(text, media_type="text/html; charset=utf-8", headers={"Cache-Control": "no-store"})


@pages.gives("/tests/{key:int}/columns", media="application/json")
def columns(asked: Ask, key: int, force: float | None = None) -> Response:
    """What the sliders compute with: the columns of the runs at one force level, by default the highest."""
    tag = asked.tag()
    if tag in asked.request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers={"ETag": tag})
    found = _drawn(asked, _kept(asked, key))
    causes = None if found is None else found.causes
    if causes is None:
        raise NotFound("This test has no circle, or it is not drawn yet.")
    chosen = _level(causes, force)
    runs = {name: run for name, run in causes["columns"]["runs"].items() if run["force_N"] == chosen["force_N"]}
    about = {name: chosen[name] for name in ("force_N", "centre", "radius", "per_um")}
    document = {**causes["columns"], "schema": "elastogeo.columns/1", "drawing": about, "runs": runs}
    return json_response(document, headers={"ETag": tag, "Cache-Control": "private, no-cache"})


@pages.gives("/tests/{key:int}/files/{number:int}")
def raw_file(asked: Ask, key: int, number: int) -> Response:
    """A raw file of a test, as it came in."""
    with or_not_found():
        path, content = asked.history.raw_file(key, number)
    return download(content, path.rpartition("/")[2], "application/octet-stream")


@pages.gives("/tests/{key:int}/report.html", media="text/html")
def report_page(asked: Ask, key: int) -> Response:
    """The report of a test as one page that opens offline."""
    kept = _report(asked, key)
    return download(html_page(kept.view, kept.figures), f"test-{key}.html", "text/html; charset=utf-8")


@pages.gives("/tests/{key:int}/report.pdf", media="application/pdf")
def report_pdf(asked: Ask, key: int) -> Response:
    """The report of a test for the machine's file."""
    kept = _report(asked, key)
    return download(pdf_page(kept.view, kept.figures), f"test-{key}.pdf", "application/pdf")


@pages.acts("/tests/{key:int}/aside", role=ENGINEER)
def set_aside(
    asked: Ask,
    key: int,
    why: Why,
    back: Annotated[bool, Form()] = False,
) -> Done:
    """Set a test aside so that it counts in no chart, or take it back."""
    _kept(asked, key)
    found = asked.history.set_aside(key, why, back=back)
    told = "counts again" if back else "is set aside and counts in no chart"
    return Done(f"/tests/{key}", f"The test {told}; {found.machine} was judged again.")


@pages.acts("/tests/{key:int}/draw", role=ENGINEER)
def draw_again(asked: Ask, key: int) -> Done:
    """Ask for a test to be evaluated and drawn anew from its raw files."""
    _kept(asked, key)
    job = asked.history.put_job("draw", {"test": key, "again": True})
    return Done(f"/tests/{key}", "The test is being evaluated and drawn again.", {"job": job})


@pages.acts("/tests/{key:int}/recompute", role=ENGINEER)
def recompute(asked: Ask, key: int) -> Done:
    """Ask for the whole series of a test to be computed again from its raw files, and compared with what is kept."""
    job = asked.history.put_job("recompute", {"series": _kept(asked, key).series_key, "test": key})
    return Done(f"/jobs/{job}", "The series is being computed again from its raw files.", {"job": job})


def _kept(asked: Asked, key: int) -> KeptTest:
    with or_not_found("There is no such test."):
        return asked.history.test(key)


def _drawn(asked: Asked, kept: KeptTest) -> Drawn | None:
    """What this version has drawn of a test; None if nothing is yet."""
    if kept.analysis is None:
        return None
    found = asked.history.drawing(kept.analysis.key)
    if found is None:
        return None
    view = view_kept(found["view"], kept.analysis.document)
    return Drawn(view, found["causes"], found["rows"], found["same_bits"], found["differing"])


def _drawing_job(asked: Asked, kept: KeptTest) -> KeptJob | None:
    """The job that draws a test: asked for by the first who looks; none of what could not be evaluated."""
    if kept.analysis is not None and kept.analysis.error:
        return None
    done = (one for one in asked.history.jobs(kind="draw").jobs if one.asked.get("test") == kept.key)
    last = next(done, None)
    if last is not None and last.state in ("failed", "cancelled"):
        return last
    return asked.history.job(asked.history.put_job("draw", {"test": kept.key}))


def _context(asked: Asked, kept: KeptTest, found: Drawn | None, force: float | None) -> dict[str, Any]:
    """What the templates of a test need."""
    causes = None if found is None else found.causes
    return {
        "key": kept.key,
        "test": kept,
        "kept": None if found is None else found.kept,
        "drawn": found,
        "causes": causes,
        "circle": None if causes is None else _circle(causes, force),
        "job": None if found is not None else _drawing_job(asked, kept),
    }


def _level(causes: Mapping[str, Any], force: float | None) -> Mapping[str, Any]:
    """The drawing at a force level, the nearest one; by default the highest."""
    polars: list[Mapping[str, Any]] = causes["polars"]
    return polars[0] if force is None else min(polars, key=lambda polar: abs(polar["force_N"] - force))


def _circle(causes: Mapping[str, Any], force: float | None) -> Circle:
    chosen = _level(causes, force)
    forces = tuple((f"{polar['force_N']:g}", polar["title"]) for polar in causes["polars"])
    return Circle(chosen, plot_of(chosen["plot"]), forces)


def _section(found: Drawn | None, part: int) -> Section:
    sections = () if found is None else found.kept.view.sections
    if part >= len(sections):
        raise NotFound("There is no such part of this test.")
    return sections[part]


def _report(asked: Asked, key: int) -> KeptView:
    """What is drawn of a test, under the name of this very machine, with the date, the instrument and the operator."""
    test = _kept(asked, key)
    found = _drawn(asked, test)
    if found is None:
        raise NotFound("The report is not drawn yet; open the page of the test, wait until it is drawn, and come back.")
    known, drawn = view_of(test), found.kept.view
    said = {name for name, _ in known.head}
    about = (*known.head, *(one for one in drawn.head if one[0] not in said))
    return replace(found.kept, view=replace(drawn, subtitle=f"{known.subtitle}, {drawn.subtitle}", head=about))

"""The PDF: the same twice, of a few pages, standing by itself, and reading no text as markup."""

from __future__ import annotations

import json
import re
import socket
import sys
from dataclasses import replace
from importlib.resources import files

import pytest
import typst

from elastogeo.report import MissingExtraError, parameter_rows, pdf_report, save_pdf, sentence_of
from elastogeo.report.drawing.svg import ALTERNATIVES, figure_bytes, figures
from elastogeo.report.identification.view import report_context
from elastogeo.report.numbers import pretty

HOSTILE = r'#panic("run") *bold* _it_ $x$ <label> @cite \ [x] ] " #import "@preview/x:1.0.0" // /* = head'


def pages(pdf: bytes) -> int:
    return int(re.search(rb"/Type\s*/Pages\b[^>]*?/Count\s+(\d+)|/Count\s+(\d+)[^>]*?/Type\s*/Pages\b", pdf).group(1) or 0)


@pytest.fixture
def told(monkeypatch):
    """What the template is told of a result."""

    def data_of(result) -> dict:
        asked: dict = {}
        monkeypatch.setattr(typst, "compile", lambda _, **kwargs: asked.update(kwargs) or b"")
        pdf_report(result)
        return json.loads(asked["sys_inputs"]["data"])

    return data_of


@pytest.mark.parametrize(("name", "most"), [("rich", 4), ("poor", 4), ("geometric", 5), ("separated", 6), ("mixed", 4)])
def test_a_few_pages_of_a_sound_file(name, most, request, tmp_path) -> None:
    path = save_pdf(request.getfixturevalue(name), tmp_path / "new" / "report.pdf")
    data = path.read_bytes()
    assert data.startswith(b"%PDF-1.7")
    assert data.rstrip().endswith(b"%%EOF")
    assert 2 <= pages(data) <= most
    assert 40_000 < len(data) < 1_000_000


def test_the_same_result_gives_the_same_bytes_without_a_date(rich) -> None:
    one, two = pdf_report(rich), pdf_report(rich)
    assert one == two
    assert b"CreationDate" not in one
    assert b"ModDate" not in one


def test_it_asks_for_no_network_and_no_font_of_the_system(poor, monkeypatch) -> None:
    def refused(*_: object) -> None:
        raise AssertionError("the network was asked")

    monkeypatch.setattr(socket.socket, "connect", refused)
    asked = []
    real = typst.compile
    monkeypatch.setattr(typst, "compile", lambda *args, **kwargs: asked.append(kwargs) or real(*args, **kwargs))
    data = pdf_report(poor)
    assert [kwargs["ignore_system_fonts"] for kwargs in asked] == [True]
    fonts = set(re.findall(rb"/FontName\s*/[A-Z]+\+([A-Za-z]+)", data))
    assert fonts
    assert all(font.startswith(b"Libertinus") for font in fonts)
    template = files("elastogeo.report").joinpath("templates", "report.typ").read_text(encoding="utf-8")
    assert "@preview" not in template
    assert "://" not in template


def test_names_from_files_are_text(poor) -> None:
    machine = replace(poor.test.machine, name=f"{HOSTILE}machine", assumed=(HOSTILE,))
    test = replace(poor.test, name=f"{HOSTILE}test", machine=machine, simulated=HOSTILE)
    checks = tuple(replace(check, facts={"said": f"{HOSTILE}{sentence_of(check)}"}) for check in poor.verdict)
    hostile = replace(poor, test=test, verdict=checks)
    assert pdf_report(hostile).startswith(b"%PDF")
    template = files("elastogeo.report").joinpath("templates", "report.typ").read_bytes()
    drawn = {name: figure_bytes(figure, "svg", outlines=True).decode() for name, figure in figures(hostile).items()}
    data = json.dumps({**report_context(hostile), "alternatives": ALTERNATIVES, "figures": list(drawn)})
    found = json.loads(typst.query(template, "heading.where(level: 1)", field="body", sys_inputs={"data": data, **drawn}))
    assert found == [{"func": "text", "text": f"{HOSTILE}machine"}]


def test_a_script_that_the_embedded_fonts_lack_is_no_error(poor) -> None:
    test = replace(poor.test, machine=replace(poor.test.machine, name="五轴加工中心"))
    assert pdf_report(replace(poor, test=test)).startswith(b"%PDF")


def test_it_says_what_the_page_says(separated, mixed, told) -> None:
    data = told(separated)
    assert [row["value"] for row in data["rows"]] == [pretty(row.value) for row in parameter_rows(separated)]
    assert len(data["budgets"]) == len(separated.parameters)
    assert data["banner"] == []
    untold = told(mixed)
    assert untold["banner"][0].startswith("Compliance and geometry are not told apart")
    assert len(untold["sums"]) == 5
    assert untold["diagnosis"] is None


def test_without_typst_it_says_what_to_install(poor, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "typst", None)
    with pytest.raises(MissingExtraError, match=r"needs typst.*pip install 'elastogeo\[report\]'"):
        pdf_report(poor)

"""Drawings of plain shapes: kept as JSON without loss, written as SVG that holds nothing but what it should."""

import json
import sys
from subprocess import run
from xml.etree import ElementTree

import pytest

from elastogeo.report import Plot, plot_of, plot_svg
from elastogeo.report.drawing.plots import SHAPES, Band, Circle, Entry, Line, Mark, Text

EVIL = "</title><script>alert(1)</script>\" onload='x' &"
EVERY = Plot(
    120,
    80.5,
    (
        Band(((0, 0), (10, 0), (10, 10.25))),
        Line(((1, 2), (3, 4.56)), "blue", 1.6, (7, 4)),
        Circle(60, 40, 12.34, "line"),
        Circle(60, 40, 9, "soft", filled=True),
        *(Mark(10 * k, 20, "bad", shape, title=f"{EVIL} {k}", low=1.0, high=2.0, link=k) for k, shape in enumerate(SHAPES)),
        Mark(5, 5),
        Text(5, 9, EVIL, "end", strong=True, size=11),
    ),
    EVIL,
    (Entry("line", "blue", "running mean"),),
)


def test_a_plot_comes_back_from_json():
    assert plot_of(json.loads(json.dumps(EVERY.to_dict()))) == EVERY


def test_the_element_holds_every_shape_its_texts_escaped_and_no_style_script_or_address():
    svg = plot_svg(EVERY, "trend")
    root = ElementTree.fromstring(svg)
    assert root.get("viewBox") == "0 0 120 80.5"
    assert root.get("class") == "plot trend"
    assert root.get("aria-label") == EVIL
    kinds = [element.tag for element in root.iter()]
    assert set(kinds) == {"svg", "g", "path", "circle", "text", "title"}
    assert [title.text for title in root.iter("title")] == [f"{EVIL} {k}" for k in range(len(SHAPES))]
    assert [text.text for text in root.iter("text")] == [EVIL]
    names = {name for element in root.iter() for name in element.attrib}
    assert not {name for name in names if name.startswith("on") or name in ("style", "href")}
    assert [g.get("data-key") for g in root.iter("g")] == [str(k) for k in range(len(SHAPES))]


def test_shapes_lie_where_they_were_put():
    root = ElementTree.fromstring(
        plot_svg(Plot(10, 10, (Line(((1, 2), (3, 4.56)), "blue", 1.6, (7, 4)), Mark(5, 6, size=2.0))))
    )
    line, mark = root
    assert (line.get("d"), line.get("class"), line.get("stroke-width"), line.get("stroke-dasharray")) == (
        "M1 2L3 4.6",
        "p-blue",
        "1.6",
        "7 4",
    )
    assert (mark.tag, mark.get("cx"), mark.get("cy"), mark.get("r")) == ("circle", "5", "6", "2")
    assert root.get("aria-hidden") == "true"


def test_what_is_no_shape_is_refused():
    with pytest.raises(TypeError, match="a str is no shape of a plot"):
        plot_svg(Plot(10, 10, ("line",)))


def test_a_plot_is_drawn_without_matplotlib():
    code = (
        "import sys\nfrom elastogeo.report import Plot, plot_svg\nplot_svg(Plot(1, 1, ()))\nprint("
        + "'matplotlib' in sys.modules)"
    )
    assert run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"

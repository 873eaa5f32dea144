"""The volume of a map, to turn: every place with its value or none, nothing asked of another host, nothing sent."""

from __future__ import annotations

import json
import re
import sys
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from plotly.offline import get_plotlyjs

from elastogeo.identification import Identification, identify
from elastogeo.prediction import ComplianceMap, map_compliance
from elastogeo.report import save_report, view_of
from elastogeo.report.page.scene import PLOTLY_CONFIG, scene_page
from elastogeo.report.view import View
from tests.prediction.circles import circles

VOLUME = {"X": (-200.0, 200.0, 3), "Y": (-150.0, 150.0, 4), "Z": (-100.0, 50.0, 3)}
ATTACK = "</script><script>alert('x')</script><img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def identified() -> Identification:
    return identify(circles(reciprocal=True))


@pytest.fixture(scope="module")
def whole(identified: Identification) -> ComplianceMap:
    return map_compliance(identified, VOLUME)


@pytest.fixture(scope="module")
def partly(whole: ComplianceMap) -> ComplianceMap:
    """The same, where the tests do not tell what is above Z 0 and give no U at one place."""
    supported, compliance, expanded = whole.supported.copy(), whole.compliance.copy(), whole.expanded.copy()
    supported[:, :, 2] = False
    compliance[:, :, 2] = expanded[:, :, 2] = np.nan
    expanded[0, 0, 0] = np.nan
    return replace(whole, supported=supported, compliance=compliance, expanded=expanded, softest=None, stiffest=None)


class Page(HTMLParser):
    """Attributes and the text of each script and of all else."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.attributes: list[tuple[str, str, str]] = []
        self.scripts: list[str] = []
        self.words, self.tags, self.within = "", [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs) -> None:
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attrs]
        self.within = tag == "script"
        if self.within:
            self.scripts.append("")

    def handle_endtag(self, tag) -> None:
        self.within = self.within and tag != "script"

    def handle_data(self, data) -> None:
        if self.within:
            self.scripts[-1] += data
        else:
            self.words += data


def drawing(found: ComplianceMap) -> dict:
    scene = view_of(found).scene
    assert scene is not None
    return scene.draw()


def traces(found: ComplianceMap, choice: int) -> dict[str, dict]:
    return {one["name"]: one for one in drawing(found)["data"] if one["choice"] == choice}


@pytest.fixture(scope="module")
def page(whole: ComplianceMap) -> str:
    text = scene_page(view_of(whole))
    assert text is not None
    return text


def test_the_page_asks_nothing_of_another_host(page: str) -> None:
    read = Page(page)
    assert [(key, value) for _, key, value in read.attributes if key == "src" or key.startswith("on")] == []
    assert [value for _, key, value in read.attributes if key in {"href", "xlink:href", "action"}] == ["report.html"]
    assert {"link", "iframe", "img", "object", "form", "base"}.isdisjoint(read.tags)
    (policy,) = [value for _, key, value in read.attributes if key == "content" and "default-src" in value]
    assert policy.startswith("default-src 'none';")
    assert not re.search(r"https?:|connect-src|unsafe-eval|\*", policy)
    library, data, own = read.scripts
    assert library == get_plotlyjs()
    assert "://" not in data + own + read.words


def test_the_button_that_sends_the_data_is_gone(page: str) -> None:
    """By the name that this plotly gives it, by its own switch, and by its address."""
    named = set(re.findall(r"\bsend\w*ToCloud\b", " ".join(re.findall(r'name:"(\w+)"', get_plotlyjs()))))
    assert named
    config = json.loads(Page(page).scripts[1])["config"]
    assert config == PLOTLY_CONFIG
    assert named <= set(config["modeBarButtonsToRemove"])
    assert config["plotlyServerURL"] == ""
    assert config["showSendToCloud"] is False
    assert config["displaylogo"] is False


def test_it_says_that_the_data_are_simulated(page: str, whole: ComplianceMap) -> None:
    origin = view_of(whole).origin
    assert origin.startswith("Simulated")
    assert origin in Page(page).words


def test_every_place_has_its_value_and_u(whole: ComplianceMap) -> None:
    for choice, values in enumerate((whole.compliance, whole.expanded)):
        points = traces(whole, choice)["told by the tests"]
        index = [
            tuple(int(np.abs(along - one).argmin()) for along, one in zip(whole.grid.along, place, strict=True))
            for place in zip(points["x"], points["y"], points["z"], strict=True)
        ]
        assert sorted(index) == sorted(np.ndindex(whole.grid.shape))
        assert points["marker"]["color"] == pytest.approx([values[k] * 1e6 for k in index])
        for k, words in zip(index, points["hovertext"], strict=True):
            value, spread = map(float, re.search(r"<br>([\d.]+) ± ([\d.]+) nm/N<br>", words).groups())
            assert spread == pytest.approx(whole.expanded[k] * 1e6, rel=0.05)
            assert value == pytest.approx(whole.compliance[k] * 1e6, abs=0.051 * spread)
            assert words.endswith("told by the tests")
        assert "surfaces of one value" in traces(whole, choice)


def test_what_the_tests_do_not_tell_is_hollow_and_has_no_number(partly: ComplianceMap) -> None:
    for choice in (0, 1):
        found = traces(partly, choice)
        hollow = found["not told by the tests"]
        assert set(hollow["z"]) == {50.0}
        assert len(hollow["x"]) == 12
        assert hollow["marker"]["symbol"] == "circle-open"
        assert isinstance(hollow["marker"]["color"], str)
        assert all(
            re.search(r" mm<br>not told by the tests$", words) and "nm/N" not in words for words in hollow["hovertext"]
        )
        assert "surfaces of one value" not in found
    assert len(traces(partly, 0)["told by the tests"]["x"]) == 24
    assert len(traces(partly, 1)["told by the tests"]["x"]) == 23
    (words,) = traces(partly, 1)["no uncertainty: the runs are too few"]["hovertext"]
    assert "± not known nm/N" in words


def test_what_rests_on_a_prior_is_hollow_too(whole: ComplianceMap) -> None:
    found = traces(replace(whole, supported=np.zeros_like(whole.supported), prior=True), 0)
    assert set(found) == {"not told by the tests"}
    assert all("nm/N" not in words and "prior" in words for words in found["not told by the tests"]["hovertext"])


def test_the_softest_and_the_stiffest_place_are_marked(whole: ComplianceMap) -> None:
    marked = {
        one["name"]: (one["x"][0], one["y"][0], one["z"][0]) for one in drawing(whole)["data"] if one["choice"] is None
    }
    ends = {"the softest": whole.compliance.argmax(), "the stiffest": whole.compliance.argmin()}
    assert marked == {
        name: tuple(whole.grid.commands(np.array([k]))[0][list(whole.grid.columns)]) for name, k in ends.items()
    }
    hollow = replace(whole, supported=np.zeros_like(whole.supported), prior=True)
    assert [one for one in drawing(hollow)["data"] if one["choice"] is None] == []


def test_a_constant_compliance_has_one_number_on_its_scale(whole: ComplianceMap) -> None:
    same = 6e-5 * (1 + 1e-14 * np.arange(whole.compliance.size).reshape(whole.compliance.shape))
    found = traces(replace(whole, compliance=same), 0)
    assert found["told by the tests"]["marker"]["colorbar"]["ticktext"] == ["60.0"]
    assert "surfaces of one value" not in found


def test_a_large_map_is_thinned_and_says_so(whole: ComplianceMap) -> None:
    shape = (30, 30, 30)
    along = tuple(np.linspace(-100.0, 100.0, count) for count in shape)
    grown = replace(
        whole,
        grid=replace(whole.grid, along=along),
        compliance=np.full(shape, 6e-5),
        expanded=np.full(shape, 1e-6),
        supported=np.ones(shape, dtype=bool),
        directions=np.broadcast_to([1.0, 0.0, 0.0], (*shape, 3)),
        softest=None,
        stiffest=None,
    )
    found = drawing(grown)
    assert 1000 < len(found["data"][0]["x"]) <= 6000
    assert "a part" in found["note"]
    assert drawing(whole)["note"] == ""


@pytest.mark.parametrize(("shape", "drawn"), [((3, 4, 1), True), ((1, 4, 1), False)])
def test_a_plane_has_the_page_and_a_line_has_none(identified: Identification, shape: tuple[int, ...], drawn: bool) -> None:
    asked = {axis: (*VOLUME[axis][:2], count) for axis, count in zip("XYZ", shape, strict=True) if count > 1}
    held = {axis: 0.0 for axis, count in zip("XYZ", shape, strict=True) if count == 1}
    view = view_of(map_compliance(identified, asked, held))
    assert (view.scene is not None) == drawn
    if view.scene:
        assert len(view.scene.draw()["data"][0]["x"]) == 12


def test_names_from_files_do_not_end_the_script(whole: ComplianceMap) -> None:
    view = replace(view_of(whole), title=ATTACK, subtitle=ATTACK, origin=ATTACK)
    assert view.scene is not None
    found = view.scene.draw()
    scene = replace(view.scene, draw=lambda: {**found, "note": ATTACK})
    text = scene_page(replace(view, scene=scene))
    assert text is not None
    assert "img" not in Page(text).tags
    assert len(Page(text).scripts) == 3


def saved(view: View, folder: Path) -> tuple[set[str], str]:
    save_report(view, folder)
    return {path.name for path in folder.iterdir()}, (folder / "report.html").read_text(encoding="utf-8")


def test_the_report_leads_to_it_and_stays_without_scripts(whole: ComplianceMap, tmp_path: Path) -> None:
    files, text = saved(view_of(whole), tmp_path)
    assert "volume.html" in files
    assert '<a href="volume.html">' in text
    assert "<script" not in text
    assert "://" not in text


def test_without_plotly_the_report_is_written_and_says_so(whole: ComplianceMap, tmp_path: Path, monkeypatch) -> None:
    for name in [name for name in sys.modules if name.partition(".")[0] == "plotly"]:
        monkeypatch.delitem(sys.modules, name)

    class Absent:
        @staticmethod
        def find_spec(name: str, *_: object) -> None:
            if name.partition(".")[0] == "plotly":
                raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr(sys, "meta_path", [Absent, *sys.meta_path])
    files, text = saved(view_of(whole), tmp_path)
    assert "volume.html" not in files
    assert "this page was not written, because plotly is not installed" in text
    assert "volume.html" not in text

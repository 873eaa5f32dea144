"""The page of a test in a browser: drawn by the worker while one looks, sliders that find what a what-if says."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import elastogeo as eg
from elastogeo.report import significant
from tests.web.browsing import Site, Watched
from tests.web.fleets import ALARMED

DRAWN = 90_000
"""Milliseconds in which the worker must have drawn a test, on a computer that does much else."""
SET = "(one, value) => { one.value = value; one.dispatchEvent(new Event('input', {bubbles: true})); }"
SETTLED = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


@pytest.fixture(scope="module")
def drawn(site: Site, tmp_path_factory: pytest.TempPathFactory) -> tuple[int, Any]:
    """The last test of a machine, and what it says; the worker draws it when it is looked at first."""
    folder = tmp_path_factory.mktemp("raw")
    with eg.History(site.database) as history:
        key = _last(history)
        for number, file in enumerate(history.test(key).files, 1):
            place: Path = folder / file.path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(history.raw_file(key, number)[1])
    return key, eg.identify(eg.read_test(folder))


def _last(history: eg.History) -> int:
    """The key of the last test of the machine in alarm."""
    key = 1
    while (kept := history.test(key)).machine != ALARMED.name:
        key += 1
    while kept.following is not None:
        kept = history.test(kept.following)
    return kept.key


def shown(screen: Watched, key: int) -> Any:
    """The page of a test, with its sliders at work."""
    screen.go(f"/tests/{key}")
    screen.page.locator("#deviations").wait_for(timeout=DRAWN)
    return screen.page


def test_the_rest_comes_by_itself_and_sliders_find_what_a_what_if_says(screen: Watched, drawn: tuple[int, Any]) -> None:
    key, result = drawn
    page = shown(screen, key)
    diagnosis = eg.diagnose(result)
    force = max(diagnosis.circularity, key=abs)
    faults = [fault for fault in diagnosis.faults if fault.axis]

    def read(name: str) -> str:
        return str(page.locator(f"#{name}").inner_text())

    def said(found: Any) -> list[str]:
        spans = [(found.f_min_ccw, found.f_max_ccw), (found.f_min_cw, found.f_max_cw)]
        radial = [" … ".join(f"{'+' if end > 0 else ''}{significant(1000 * end)}" for end in span) for span in spans]
        return [f"{value} µm".replace("-", "−") for value in (*map(micro, (found.g_ccw, found.g_cw)), *radial)]

    def micro(value: float) -> str:
        return significant(1000 * value)

    places = ["g-ccw", "g-cw", "f-ccw", "f-cw"]
    as_is = said(diagnosis.circularity[force])
    assert [read(place) for place in places] == as_is
    assert page.locator(".what-if").first.get_attribute("d") == ""
    page.evaluate(f"[...document.querySelectorAll('.cause input')].slice(0, 2).forEach(one => ({SET})(one, 0))")
    page.evaluate(SETTLED)
    names = [name for fault in faults[:2] for name in fault.names]
    assert [read(place) for place in places] == said(eg.what_if(result, names).after[force])
    assert read("g-ccw-was") == f"was {as_is[0]}"
    assert page.locator(".what-if").first.get_attribute("d").startswith("M")
    page.locator("#reset").click()
    page.evaluate(SETTLED)
    assert [read(place) for place in places] == as_is


def test_a_slider_is_moved_by_the_keyboard_and_named_by_its_cause(screen: Watched, drawn: tuple[int, Any]) -> None:
    page = shown(screen, drawn[0])
    slider = page.get_by_role("slider").first
    assert page.locator("label[for=cause-0]").inner_text() == slider.evaluate("one => one.labels[0].innerText")
    slider.focus()
    for _ in range(4):
        page.keyboard.press("ArrowLeft")
    page.evaluate(SETTLED)
    assert page.locator("output[for=cause-0]").inner_text() == "80 %"
    assert slider.get_attribute("aria-valuetext") == "80 % of what it is"
    page.locator("#heard", has_text="circular deviation").wait_for(state="attached")


def test_another_force_is_drawn_with_the_sliders_as_they_are(screen: Watched, drawn: tuple[int, Any]) -> None:
    key, result = drawn
    page = shown(screen, key)
    page.evaluate(f"({SET})(document.getElementById('cause-0'), 0)")
    force = min(level.force for level in result.levels)
    page.locator("#force").focus()
    with page.expect_response(lambda answer: f"columns?force={force:g}" in answer.url):
        page.locator("#force").select_option(f"{force:g}")
    page.locator(".what-if[d^=M]").first.wait_for(state="attached")
    assert page.locator("#trace-title").inner_text() == f"Trace at {force:g} N"
    assert page.url.endswith(f"/tests/{key}?force={force:g}")
    assert page.evaluate("document.activeElement.id") == "force"
    wanted = eg.what_if(result, page_first_cause(page)).after[force]
    assert page.locator("#g-ccw").inner_text() == f"{significant(1000 * wanted.g_ccw)} µm"


def page_first_cause(page: Any) -> str:
    """The parameter of the first cause."""
    return str(page.locator(".cause small").first.inner_text()).split(" = ")[0]


def test_folded_figures_come_when_their_part_is_opened(screen: Watched, drawn: tuple[int, Any]) -> None:
    page = shown(screen, drawn[0])
    part = page.locator("details.section[hx-get]").first
    assert part.locator("figure").count() == 0
    part.locator("summary").click()
    part.locator("figure svg").first.wait_for()


def test_on_a_phone_the_trace_stays_while_the_causes_scroll(screens: Any, site: Site, drawn: tuple[int, Any]) -> None:
    screen = screens(site.url, viewport={"width": 390, "height": 844}, has_touch=True)
    page = shown(screen, drawn[0])
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    page.locator("#cause-2").scroll_into_view_if_needed()
    page.evaluate("window.scrollBy(0, 250)")
    assert page.locator(".polar").evaluate("one => one.getBoundingClientRect().bottom") > 150
    assert page.locator(".polar").evaluate("one => one.getBoundingClientRect().top") >= 0


def test_without_scripts_the_page_shows_all_but_the_sliders(screens: Any, site: Site, drawn: tuple[int, Any]) -> None:
    shown(screens(site.url), drawn[0])
    page = screens(site.url, java_script_enabled=False)
    page.go(f"/tests/{drawn[0]}")
    assert page.page.locator(".polar svg path").count() > 3
    assert page.page.locator(".cause").count() > 3
    assert not page.page.get_by_role("slider").first.is_visible()
    page.page.locator("#force").select_option(index=1)
    page.page.get_by_role("button", name="Show").click()
    assert "force=" in page.page.url

"""What every page holds: nobody is shut out, it fits the phone, its console is silent, it asks no other host."""

from __future__ import annotations

from typing import Any

import pytest

from tests.web.addresses import addresses
from tests.web.browsing import Watched
from tests.web.conftest import PHONE
from tests.web.keyboard import not_reached

SERIOUS = ("serious", "critical")
SMALLEST_TEXT = 12
SMALLEST_TARGET = 44

TEXTS = """() => {
  const small = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const text = walker.currentNode.textContent.trim(), of = walker.currentNode.parentElement;
    if (!text || !of.checkVisibility() || of.closest("script, style, title, desc, option")) continue;
    const svg = of.closest("svg"), matrix = svg && of.getScreenCTM && of.getScreenCTM();
    const size = parseFloat(getComputedStyle(of).fontSize) * (matrix ? Math.hypot(matrix.a, matrix.b) : 1);
    if (size < %g - 0.01) small.push(`${size.toFixed(1)} px: ${text.slice(0, 40)}`);
  }
  return [...new Set(small)];
}"""
TARGETS = """() => {
  const small = [];
  for (const one of document.querySelectorAll("a[href], button, input, select, textarea, summary")) {
    const box = one.getBoundingClientRect();
    if (!one.checkVisibility() || one.type === "hidden" || one.closest("svg, .skip") || box.width <= 1) continue;
    const block = one.closest("p, li, td, th, dd, dt, figcaption, caption, label, h1, h2, h3, footer, div");
    const alone = !block || block.textContent.trim() === one.textContent.trim();
    if (one.tagName === "A" && !alone && !one.closest("nav")) continue;  // in the line of a sentence
    const label = one.closest("label");
    const height = Math.max(box.height, label ? label.getBoundingClientRect().height : 0);
    if (height < %g - 0.5) small.push(`${height.toFixed(0)} px: ${one.outerHTML.slice(0, 90)}`);
  }
  return small;
}"""
WIDE = """() => document.scrollingElement.scrollWidth <= %d ? [] : [...document.querySelectorAll("body *")]
  .filter((one) => one.getBoundingClientRect().right > %d + 0.5 && !one.closest(".scroll *, svg *"))
  .map((one) => `too wide: ${one.outerHTML.slice(0, 120)}`)"""


SOON = 90_000
"""Milliseconds in which the worker must have drawn all tests that are looked at, on a computer that does much else."""
UNDRAWN = "#says[hx-get], #making"
"""Where the page waits for what a worker draws: what is judged is the page that people read."""


@pytest.fixture(scope="module")
def axe() -> Any:
    found = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-core, for its package is not there")
    return found.Axe()


def found_by(axe: Any, page: Any) -> list[str]:
    """Serious and critical findings: which rule, where."""
    found = axe.run(page, options={"resultTypes": ["violations"]}).response["violations"]
    return [
        f"{one['id']} ({one['impact']}): {node['target']} {node.get('failureSummary', '')[:200]}"
        for one in found
        if one["impact"] in SERIOUS
        for node in one["nodes"]
    ]


def faults_on_a_phone(page: Any) -> list[str]:
    """What is wider than the screen, smaller than can be read, smaller than a finger."""
    found = page.evaluate(WIDE % (PHONE["width"], PHONE["width"]))
    found += page.evaluate(TEXTS % SMALLEST_TEXT) + page.evaluate(TARGETS % SMALLEST_TARGET)
    wide = page.evaluate("document.scrollingElement.scrollWidth")
    return [*found, *([f"{wide} px wide"] if wide > PHONE["width"] else [])]


@pytest.mark.parametrize("path", addresses())
def test_a_page_shuts_nobody_out_and_fits_the_phone(path: str, screen: Watched, axe: Any) -> None:
    page = screen.page
    assert screen.go(path).status == 200
    page.locator(UNDRAWN).first.wait_for(state="detached", timeout=SOON)
    assert [page.locator(one).count() for one in ("h1", "main", "nav")] >= [1, 1, 1]
    faults = {"light": found_by(axe, page), "desktop": page.evaluate(TEXTS % SMALLEST_TEXT)}
    page.emulate_media(color_scheme="dark")
    faults["dark"] = found_by(axe, page)
    page.set_viewport_size(PHONE)
    faults["phone"] = faults_on_a_phone(page)
    assert not any(faults.values()), "\n".join(f"{where}: {one}" for where, found in faults.items() for one in found)


@pytest.mark.parametrize("path", addresses())
def test_every_control_is_reached_by_tab(path: str, screen: Watched) -> None:
    screen.go(path)
    screen.page.locator(UNDRAWN).first.wait_for(state="detached", timeout=SOON)
    faults = not_reached(screen.page)
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize("path", ["/", "/machines/1"])
def test_what_is_simulated_says_so(path: str, screen: Watched) -> None:
    screen.go(path)
    assert "simulated" in screen.page.locator("body").inner_text().lower()


def test_without_scripts_every_page_is_there(screens: Any, site: Any) -> None:
    plain = screens(site.url, java_script_enabled=False)
    for path in addresses():
        assert plain.go(path).status == 200
        assert plain.page.locator("main h1").inner_text().strip()

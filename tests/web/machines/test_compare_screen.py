"""Compare and explore in a browser: circles are switched on and off, plotly draws, and nothing leads to its cloud."""

from __future__ import annotations

from tests.web.browsing import Watched

PATIENCE = 30_000
"""Milliseconds until plotly, 5 MB of it, must have drawn on a computer that does much else."""


def test_each_circle_is_switched_off_and_on(screen: Watched) -> None:
    screen.go("/compare?a=7&b=8")
    page = screen.page
    drawn = ".overlay .at-desk svg"
    dashed, through = page.locator(f"{drawn} path[stroke-dasharray]"), page.locator(f'{drawn} path[stroke-width="2"]')
    assert dashed.count() >= 1
    assert through.count() >= 1
    page.get_by_label("(dashed)").uncheck()
    assert not dashed.first.is_visible()
    assert through.first.is_visible()
    page.get_by_label("(dashed)").check()
    page.locator('input[name="later"]').uncheck()
    assert dashed.first.is_visible()
    assert not through.first.is_visible()


def test_another_pair_is_chosen_by_keyboard(screen: Watched) -> None:
    screen.go("/compare?a=7&b=8")
    page = screen.page
    first = page.get_by_label("First test")
    first.focus()
    first.select_option(index=3)
    page.get_by_role("button", name="Compare", exact=True).press("Enter")
    page.wait_for_url("**/compare?a=*")
    assert page.locator("h1").inner_text().endswith("two tests compared")


def test_runs_are_switched_and_the_residual_is_drawn(screen: Watched) -> None:
    screen.go("/explore?test=8")
    page = screen.page
    lines = page.locator("#drawing .scatterlayer .trace")
    lines.first.wait_for(timeout=PATIENCE)
    runs = page.locator('input[name="run"]').count()
    assert lines.count() == 2 * runs
    page.get_by_label("residual").check()
    lines.nth(runs).wait_for(state="detached")
    assert lines.count() == runs
    assert "measured − model" in (page.locator("#drawing .gtitle").text_content() or "")
    page.get_by_role("button", name="None").click()
    lines.first.wait_for(state="detached")
    page.locator('input[name="run"]').first.check()
    lines.first.wait_for()
    assert lines.count() == 1


def test_no_button_leads_to_a_cloud(screen: Watched) -> None:
    screen.go("/explore?test=8")
    page = screen.page
    page.locator("#drawing .modebar-btn").first.wait_for(state="attached", timeout=PATIENCE)
    titles = page.locator("#drawing .modebar-btn").evaluate_all("all => all.map(one => one.dataset.title || '')")
    assert len(titles) >= 4
    assert not [title for title in titles if any(word in title.lower() for word in ("cloud", "plotly", "chart studio"))]
    assert page.locator("#drawing a[href*='plot']").count() == 0

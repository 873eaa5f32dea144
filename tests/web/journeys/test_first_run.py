"""In a browser, by the keyboard: an empty history leads to a result in three clicks."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from tests.web.browsing import Watched
from tests.web.journeys.conftest import SOON
from tests.web.keyboard import send


def test_a_first_run_leads_to_a_result_in_three_clicks(serve: Any, screens: Any, tmp_path: Path) -> None:
    """Begin, the demo fleet, the fleet: it fills while one looks, and says of a machine how it is."""
    screen: Watched = screens(serve(tmp_path / "new.db").url)
    page = screen.page
    screen.go("/")
    send(page, page.get_by_role("link", name="Begin"))
    send(page, page.get_by_role("button", name="Try the demo fleet"))
    page.locator("#job progress[value]:not([value='0'])").wait_for(timeout=SOON)
    send(page, page.get_by_role("link", name="Look at the fleet"))
    first = page.locator(".cards tbody tr").filter(has_not_text="no data").first
    assert first.locator(".badge").inner_text().strip()
    assert "simulated" in page.locator("body").inner_text().lower()
    send(page, first.get_by_role("link"))
    assert re.search(r"/machines/\d+$", page.url)
    assert "simulated" in page.locator("body").inner_text().lower()

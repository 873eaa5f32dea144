"""That all was simulated is said on every page, of those too that show of everything, and of no one thing."""

from __future__ import annotations

from pathlib import Path

import pytest

import elastogeo as eg
from elastogeo.web.asking import ADMINISTRATOR
from tests.web.care.conftest import Visit

PAGES = (
    "/",
    "/alarms",
    "/events",
    "/search?q=x",
    "/audit",
    "/jobs",
    "/plans",
    "/settings",
    "/machines/1/events",
    "/machines/1/map",
)


@pytest.mark.parametrize("path", PAGES)
def test_a_page_of_a_simulated_history_says_so_once(visit: Visit, path: str) -> None:
    page = visit(ADMINISTRATOR).get(path).text
    assert page.count("Simulated: numbers") == 1


@pytest.mark.parametrize("path", ["/upload", "/first", "/tokens", "/docs"])
def test_a_page_that_shows_no_data_does_not(visit: Visit, path: str) -> None:
    assert "Simulated" not in visit(ADMINISTRATOR).get(path).text


def test_a_history_without_a_test_is_not_called_simulated(tmp_path: Path) -> None:
    with eg.History(tmp_path / "h.db", create=True) as history:
        assert history.simulated() == ""

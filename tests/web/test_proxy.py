"""Behind a proxy with a prefix, stripped or not: addresses, static files, forms and redirects stay below the prefix."""

from __future__ import annotations

from typing import Any

import pytest

from tests.web.addresses import addresses
from tests.web.browsing import free_port
from tests.web.proxies import proxied

PREFIX = "/shop/elastogeo"


@pytest.mark.parametrize("strips", [True, False], ids=["stripped", "passed on"])
def test_the_pages_work_behind_a_proxy(strips: bool, fleet: Any, serve: Any, screens: Any) -> None:
    """A request that is not below the prefix is one elsewhere, so that it fails the test."""
    port = free_port()
    site = serve(fleet, "--prefix", PREFIX)
    with proxied(port, site.url, PREFIX, strips) as outside:
        screen = screens(outside)
        page = screen.page
        assert screen.go("/").status == 200
        assert page.evaluate("getComputedStyle(document.querySelector('.top')).display") == "flex"
        screen.go("/machines/1")
        page.locator(".menu summary").click()
        page.get_by_role("button", name="dark").click()
        page.wait_for_load_state()
        assert page.url.startswith(f"{outside}/machines/")
        assert page.locator("html").get_attribute("data-theme") == "dark"
        for path in addresses():
            screen.go(path)
            links = page.eval_on_selector_all("[href], [src], [action]", LINKS)
            assert [link for link in links if not link.startswith((f"{outside}/", "data:", "#"))] == []


LINKS = """all => all.map((one) => one.href?.baseVal ?? one.href ?? one.src ?? one.action)
  .filter((one) => typeof one === "string")"""

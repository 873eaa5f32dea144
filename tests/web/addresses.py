"""Every page that there is, at an address of the small fleet that shows something: found in the routes, none forgotten."""

from __future__ import annotations

import re

from elastogeo.web.app import every

KEYS = {"tests": "8"}
"""Of each kind of thing the first: the machine in alarm; of tests its last."""
ASKED = {"/compare": "?a=7&b=8", "/explore": "?test=8", "/search": "?q=Hermle"}
"""What a page is asked with that shows nothing without it."""
ALSO = ("/machines/2", "/machines/3", "/machines/4", "/machines/4/map", "/tests/24", "/tests/25", "/tests/26", "/tests/27")
"""Other states and other instruments than that of the first."""


def addresses() -> list[str]:
    """All pages; those of tests first, since each makes the job that draws it."""
    routes = [route for pages in every() for route in pages.routes]
    paths = {route.path for route in routes if "GET" in route.methods}  # type: ignore[attr-defined]
    pages = {path.removesuffix(".json") for path in paths if path.endswith(".json")} - {"/fleet"} | {"/"}
    found = {_filled(path) for path in pages}
    found |= {path for path in ALSO if re.sub(r"/(\w+)/\d+", _keyed, path) in found}
    return sorted(found, key=lambda path: (not path.startswith("/tests/"), path))


def _filled(path: str) -> str:
    return re.sub(r"/(\w+)/\{[^}]*\}", _keyed, path) + ASKED.get(path, "")


def _keyed(found: re.Match[str]) -> str:
    return f"/{found[1]}/{KEYS.get(found[1], '1')}"

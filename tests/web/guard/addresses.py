"""Every address of the pages, with something in the place of what it asks for."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from elastogeo.web.app import every
from elastogeo.web.asking import ANYBODY

KINDS = {"int": "1", "path": "a", "str": "a", "float": "1.5", "uuid": "0" * 32}


@dataclass(frozen=True)
class Address:
    """One address.

    Attributes
    ----------
    method, path : str
        As it is asked, every parameter filled.
    template : str
        As it is registered.
    role : str
        That it needs.
    """

    method: str
    path: str
    template: str
    role: str


def addresses() -> list[Address]:
    """All that the pages register."""
    routes: list[Any] = [route for pages in every() for route in pages.routes]
    return [
        Address(method, filled(route.path), route.path, route.openapi_extra["x-role"])
        for route in routes
        for method in sorted(route.methods)
    ]


def filled(template: str, **by_name: str) -> str:
    """An address with every parameter filled: those given by name, the others with something of their kind."""
    return re.sub(r"\{(\w+)(?::(\w+))?\}", lambda found: by_name.get(found[1], KINDS[found[2] or "str"]), template)


def shut() -> list[Address]:
    """Those that nobody may ask without an account, and what the frame registers by itself."""
    own = [Address("GET", path, path, "reader") for path in ("/openapi.json", "/docs/oauth2-redirect", "/redoc", "/nothing")]
    return [one for one in addresses() if one.role != ANYBODY] + own

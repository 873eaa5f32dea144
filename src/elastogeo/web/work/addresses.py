"""The addresses for programs: what `/openapi.json` says, to be read by a person."""

from __future__ import annotations

from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/docs")
def addresses(asked: Ask) -> Shown:
    """Every address that gives JSON, CSV or a file, or that takes a form: its path, what it is, and who may use it."""
    found = asked.request.app.openapi()["paths"]
    entries = [
        {"method": method.upper(), "path": path, "what": said.get("description", ""), "role": said.get("x-role", "")}
        for path, methods in sorted(found.items())
        for method, said in methods.items()
    ]
    return Shown(
        "work/addresses.html.j2",
        document={"schema": "elastogeo.addresses/1", "addresses": entries},
        rows=entries,
        context={"entries": entries},
    )

"""The icon, where a browser looks for it when it shows a document that is no page: the JSON of one."""

from __future__ import annotations

from fastapi import Response

from elastogeo.web.asking import ANYBODY, Ask
from elastogeo.web.pages import Pages
from elastogeo.web.templating import STATIC

pages = Pages()


@pages.gives("/favicon.ico", role=ANYBODY, media="image/svg+xml")
def icon(asked: Ask) -> Response:  # noqa: ARG001
    """The icon of the pages."""
    kept = {"Cache-Control": "private, max-age=86400"}
    return Response((STATIC / "icon.svg").read_bytes(), media_type="image/svg+xml", headers=kept)

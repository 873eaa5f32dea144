"""Whether the pages and their history answer: for who watches the server."""

from __future__ import annotations

from fastapi import Response

from elastogeo.web.answering import json_response
from elastogeo.web.asking import ANYBODY, Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.gives("/health", role=ANYBODY, media="application/json")
def health(asked: Ask) -> Response:
    """`{"well": true}`, if the history can be read."""
    asked.history.edition()
    return json_response({"well": True})

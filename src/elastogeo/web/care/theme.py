"""Light, dark, or as the browser prefers."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form, Response

from elastogeo.web.asking import READER, THEME, THEMES, Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.makes("/theme", role=READER)
def theme(asked: Ask, theme: Annotated[str, Form(max_length=10)]) -> Response:
    """Keep the theme in a cookie of this browser, and show the page again from which it was chosen."""
    answer = Response(status_code=303, headers={"Location": asked.came_from()})
    if theme in THEMES:
        answer.set_cookie(THEME, theme, max_age=31_536_000, path=asked.url("/"), httponly=True, samesite="strict")
    return answer

"""What a page function answers, and how it is rendered: HTML, JSON or CSV of the same view."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import quote

from fastapi import Response

from elastogeo.report import View, csv_of
from elastogeo.web.asking import SAID, Asked
from elastogeo.web.templating import page

HTML, JSON, CSV = "", ".json", ".csv"
"""What is appended to the path for each rendering."""


@dataclass(frozen=True)
class Shown:
    """A page.

    Attributes
    ----------
    template : str
        Its file, below `templates`: `machines/fleet.html.j2`.
    view : View or None
        What it shows.
    document : mapping or None
        Its JSON, if it is not that of the view.
    rows : sequence of mapping or None
        Its CSV, if it is not that of the view.
    part : str
        Template of what is swapped in when htmx asks; empty: the whole page.
    context : mapping
        What else the template needs.
    """

    template: str
    view: View | None = None
    document: Mapping[str, Any] | None = None
    rows: Sequence[Mapping[str, Any]] | None = None
    part: str = ""
    context: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Done:
    """Something was done: where to go on, and what to say there.

    Attributes
    ----------
    to : str
        A path within the pages.
    said : str
        One sentence.
    document : mapping
        For a program that asked.
    """

    to: str
    said: str = ""
    document: Mapping[str, Any] = field(default_factory=dict)


def rendered(shown: Shown, asked: Asked, twin: str, tag: str) -> Response:
    """A page in the rendering that was asked for."""
    headers = {"Cache-Control": "private, no-cache", **({"ETag": tag} if tag else {})}
    view = shown.view
    if twin == JSON:
        document = shown.document if shown.document is not None else {} if view is None else view.document
        return json_response(document, headers=headers)
    if twin == CSV:
        rows = shown.rows if shown.rows is not None else () if view is None else view.rows
        return Response(csv_of(rows), media_type="text/csv; charset=utf-8", headers=headers)
    name = shown.part if asked.by_htmx and shown.part else shown.template
    text = page(name, asked, view=view, **shown.context)
    answer = Response(text, media_type="text/html; charset=utf-8", headers=headers | {"Vary": "Cookie, HX-Request"})
    if asked.says_something and not asked.by_htmx:
        answer.delete_cookie(SAID, path=asked.url("/"))
    return answer


def json_response(document: Mapping[str, Any], status: int = 200, headers: Mapping[str, str] | None = None) -> Response:
    """A JSON document, numbers as they are."""
    text = json.dumps(document, allow_nan=False, ensure_ascii=False, default=dict)
    return Response(text, status, dict(headers or {}), media_type="application/json")


def in_ascii(address: str) -> str:
    """An address as a header holds it: what is no plain letter is encoded, what is encoded already stays."""
    return quote(address, safe="/?#[]@!$&'()*+,;=:%~")


def download(content: str | bytes, name: str, media: str) -> Response:
    """A file to keep, under a name of plain letters."""
    safe = "".join(letter if letter.isalnum() or letter in "-_." else "_" for letter in name if letter.isascii())
    headers = {"Content-Disposition": f'attachment; filename="{safe}"', "Cache-Control": "private, no-cache"}
    return Response(content, media_type=media, headers=headers)


def last_page(count: int, on_a_page: int) -> int:
    """The number of the last page of a long table, from 1."""
    return max(-(-count // on_a_page), 1)


def gone_on(done: Done, asked: Asked) -> Response:
    """What follows an act: the next page, or a document for a program."""
    if asked.by_program:
        return json_response({"done": done.said, "at": asked.url(done.to), **done.document})
    answer = Response(status_code=303, headers={"Location": in_ascii(asked.url(done.to))})
    if done.said:
        secure = asked.settings.behind_https
        answer.set_cookie(
            SAID, quote(done.said), max_age=60, path=asked.url("/"), httponly=True, samesite="strict", secure=secure
        )
    return answer

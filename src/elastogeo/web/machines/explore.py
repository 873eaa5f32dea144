"""The readings of a test to look into: the one page with plotly, which comes from the installed package alone."""

from __future__ import annotations

import gzip
import json
from functools import cache

from fastapi import Response

from elastogeo.report import PLOTLY_CONFIG, plotly_library, view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import ANYBODY, Ask, or_not_found
from elastogeo.web.fields import Key
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/explore")
def explore(asked: Ask, test: Key = 0) -> Shown:
    """Measured, model and residual of every run of a test."""
    if not test:
        return Shown("machines/explore.html.j2", None, document={}, context={"key": 0, "config": "{}", "plotly": ""})
    with or_not_found():
        view = view_of(asked.history.explore(test))
    context = {"key": test, "config": json.dumps(PLOTLY_CONFIG), "plotly": _version()}
    return Shown("machines/explore.html.j2", view, context=context)


@pages.gives("/static/plotly.min.js", role=ANYBODY, media="text/javascript")
def library(asked: Ask) -> Response:
    """plotly.js as the installed package holds it."""
    plain, packed = _library()
    headers = {"Vary": "Accept-Encoding"}
    if "gzip" in asked.request.headers.get("accept-encoding", ""):
        return Response(packed, media_type="text/javascript; charset=utf-8", headers=headers | {"Content-Encoding": "gzip"})
    return Response(plain, media_type="text/javascript; charset=utf-8", headers=headers)


@cache
def _library() -> tuple[bytes, bytes]:
    """The file, and the same packed."""
    plain = plotly_library()
    return plain, gzip.compress(plain, 6, mtime=0)


@cache
def _version() -> str:
    """Which plotly is installed: another one has another address."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("plotly")
    except PackageNotFoundError:
        return ""

"""How the guard says no: one sentence, as a page or as a document, without anything that was sent."""

from __future__ import annotations

import json
from collections.abc import Mapping
from html import escape

from starlette.types import Receive, Scope, Send

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Refused · elastogeo</title><link rel="stylesheet" href="{prefix}/static/app.css"></head>
<body><main id="main"><section class="card verdict care"><h1>This was refused</h1><p class="sentence">{sentence}</p>
</section></main></body></html>
"""


def header(scope: Scope, name: str) -> str | None:
    """A header of a request; None without it. Of several, all of them, so that no check passes by the first."""
    found = [value for key, value in scope["headers"] if key == name.encode()]
    return b", ".join(found).decode("latin-1") if found else None


def wants_document(scope: Scope) -> bool:
    """Whether a program asks, which reads no page."""
    accepted = header(scope, "accept") or ""
    return scope["path"].endswith((".json", ".csv")) or "application/json" in accepted or "text/html" not in accepted


async def refuse(
    scope: Scope,
    receive: Receive,  # noqa: ARG001
    send: Send,
    status: int,
    sentence: str,
    prefix: str = "",
    headers: Mapping[str, str] | None = None,
) -> None:
    """Answer with one sentence; the body of the request, if there is one, is not read."""
    if wants_document(scope):
        kind, text = "application/json", json.dumps({"schema": "elastogeo.error/1", "error": sentence})
    else:
        kind, text = "text/html; charset=utf-8", PAGE.format(prefix=escape(prefix), sentence=escape(sentence))
    body = text.encode()
    said = {"content-type": kind, "content-length": str(len(body)), "cache-control": "no-store", **(headers or {})}
    lines = [(name.encode(), value.encode("latin-1")) for name, value in said.items()]
    await send({"type": "http.response.start", "status": status, "headers": lines})
    await send({"type": "http.response.body", "body": b"" if scope["method"] == "HEAD" else body})


def has_body(scope: Scope) -> bool:
    """Whether a body follows the headers."""
    return header(scope, "transfer-encoding") is not None or header(scope, "content-length") not in (None, "0")

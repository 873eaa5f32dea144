"""What every answer carries: headers that bind the browser; and of a fault its number, nothing else."""

from __future__ import annotations

import logging
import secrets

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from elastogeo.web.guard.refusing import refuse
from elastogeo.web.settings import Settings

LOG = logging.getLogger("elastogeo.web")
POLICY = (
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
"""No script but from our own files. Styles in line: those of inline SVG."""
CONFINED = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox"
"""Of what is downloaded: should a browser show it, nothing in it runs."""
ALWAYS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=(), usb=(), payment=(), browsing-topics=()",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_YEAR = 31_536_000


def faults(app: ASGIApp, settings: Settings) -> ASGIApp:
    """Give each answer its headers, and a fault its number."""

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        begun = ended = False

        async def told(message: Message) -> None:
            nonlocal begun, ended
            begun, ended = True, message["type"] == "http.response.body" and not message.get("more_body", False)
            if message["type"] == "http.response.start":
                message.setdefault("headers", [])
                _add_headers(MutableHeaders(scope=message), scope, settings)
            await send(message)

        try:
            await app(scope, receive, told)
        except Exception as error:
            if ended:  # the application has answered, and logged it
                return
            number = secrets.token_hex(4)
            LOG.error("fault %s while answering", number, exc_info=error)
            if begun:
                return
            await refuse(
                scope, receive, told, 500, f"A fault of elastogeo, number {number}; the log of the server says more."
            )

    return guard


def _add_headers(headers: MutableHeaders, scope: Scope, settings: Settings) -> None:
    for name, value in ALWAYS.items():
        headers[name] = value
    downloaded = headers.get("content-disposition", "").startswith("attachment")
    headers["Content-Security-Policy"] = CONFINED if downloaded else POLICY
    if "cache-control" not in headers:
        headers["Cache-Control"] = _kept_for(scope, settings)
    if settings.behind_https:
        headers["Strict-Transport-Security"] = f"max-age={_YEAR}"


def _kept_for(scope: Scope, settings: Settings) -> str:
    """Files of ours change their address with their content; all else is for this visitor."""
    ours = scope["path"].removeprefix(settings.prefix).startswith("/static/")
    if not ours:
        return "private, no-store"
    return f"public, max-age={_YEAR}, immutable" if scope["query_string"].startswith(b"v=") else "no-cache"

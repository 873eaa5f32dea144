"""No other site acts, or looks, in a visitor's name.

A browser says of each request from which site it comes: `Sec-Fetch-Site`, to addresses that it trusts, and `Origin`, with
everything that acts. Neither can be forged by a page. A program says neither, and carries no cookie of a browser.
"""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.types import ASGIApp, Receive, Scope, Send

from elastogeo.web.guard.cookies import session_of
from elastogeo.web.guard.hosts import bracketed, name_of
from elastogeo.web.guard.refusing import header, refuse
from elastogeo.web.settings import LOOPBACK, Settings

SAFE = ("GET", "HEAD", "OPTIONS", "TRACE")
PORTS = {"http": 80, "https": 443}
ITSELF = (None, "", "document")
"""What a page is fetched for that is shown by itself, and in no frame."""


def origins(app: ASGIApp, settings: Settings) -> ASGIApp:
    """Let pass only what our own pages, a person, or a program asks."""

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        if is_ours(scope, settings):
            await app(scope, receive, send)
            return
        said = (
            "This came from another site than these pages, which nobody may do in your name. Open the page and do it there."
        )
        await refuse(scope, receive, send, 403, said, settings.prefix)

    return guard


def is_ours(scope: Scope, settings: Settings) -> bool:
    """Whether a request comes from our own pages, a person's address bar, or a program."""
    site, origin = header(scope, "sec-fetch-site"), header(scope, "origin")
    cookie = session_of(scope, settings)
    if scope["method"] in SAFE:
        followed = header(scope, "sec-fetch-mode") == "navigate" and header(scope, "sec-fetch-dest") in ITSELF
        return site in (None, "same-origin", "none") or followed
    if header(scope, "authorization") is not None and not cookie:
        return True  # no page of another site can add that header
    if site is not None and site != "same-origin":
        return False
    if origin is not None:
        return is_own_origin(origin, header(scope, "host") or "", settings)
    return site == "same-origin" or not cookie


def is_own_origin(origin: str, host: str, settings: Settings) -> bool:
    """Whether `https://shop.example` is where a browser finds us: as it called us, or as the proxy in front is called."""
    try:
        said = urlsplit(origin)
        port = said.port or PORTS.get(said.scheme, 0)
    except ValueError:
        return False
    if said.scheme not in PORTS or not said.hostname or said.path or said.query or "@" in said.netloc:
        return False
    if settings.behind_https and said.scheme != "https" and said.hostname not in LOOPBACK:
        return False  # whoever writes into a page that came without https would act by it
    found = (bracketed(said.hostname), port)
    known = [_parted(host, said.scheme), *(_parted(bracketed(name), said.scheme) for name in settings.hosts)]
    return found in known


def _parted(authority: str, scheme: str) -> tuple[str, int]:
    port = authority.rpartition(":")[2]
    return name_of(authority), int(port) if port.isascii() and port.isdigit() and not authority.endswith("]") else PORTS[
        scheme
    ]

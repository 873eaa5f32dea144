"""By which names the pages may be called.

A page of another site can let its own name point to this computer (DNS rebinding): the browser takes the answer for its
own. So a name that is not ours is refused, whatever is asked.
"""

from __future__ import annotations

from starlette.types import ASGIApp, Receive, Scope, Send

from elastogeo.web.guard.refusing import header, refuse
from elastogeo.web.settings import LOOPBACK, Settings

EVERYWHERE = ("0.0.0.0", "::", "")
"""Where one listens, but by which nobody is called."""


def hosts(app: ASGIApp, settings: Settings) -> ASGIApp:
    """Let pass only what calls us by our name."""
    ours = names(settings)

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        if name_of(header(scope, "host") or "") in ours:
            await app(scope, receive, send)
            return
        said = "The pages do not answer to the name by which they were called; start them with --allow-host and that name."
        await refuse(scope, receive, send, 421, said, settings.prefix)

    return guard


def names(settings: Settings) -> frozenset[str]:
    """All names by which we may be called, without ports."""
    own = () if settings.host in EVERYWHERE else (settings.host,)
    return frozenset(name_of(bracketed(name)) for name in (*LOOPBACK, *own, *settings.hosts))


def bracketed(name: str) -> str:
    """A name as it stands in an address: IPv6 in brackets."""
    return f"[{name}]" if name.count(":") > 1 and not name.startswith("[") else name


def name_of(authority: str) -> str:
    """The name in `name:port`, in small letters; empty where it is none."""
    said = authority.strip().lower()
    name, colon, port = said.rpartition(":")
    if not colon or said.endswith("]"):
        name, port = said, "0"
    if (
        not (port.isascii() and port.isdigit())
        or (":" in name and not name.startswith("["))
        or set(name) & set("@/\\?#, \t")
    ):
        return ""
    return name.removesuffix(".")

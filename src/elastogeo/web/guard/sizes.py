"""No address and no headers too long, and none that says two things."""

from __future__ import annotations

from starlette.types import ASGIApp, Receive, Scope, Send

from elastogeo.web.guard.limits import Limits
from elastogeo.web.guard.refusing import refuse

ONCE = (b"host", b"origin", b"authorization", b"content-length", b"content-type", b"sec-fetch-site")
"""Headers that a request has once or not at all."""


def sizes(app: ASGIApp, limits: Limits, prefix: str) -> ASGIApp:
    """Let pass addresses and headers of a reasonable size."""

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        names = [name for name, _ in scope["headers"]]
        address = len(scope["path"]) + len(scope["query_string"])
        if address > limits.address:
            await refuse(scope, receive, send, 414, f"The address is longer than {limits.address} characters.", prefix)
        elif sum(len(name) + len(value) for name, value in scope["headers"]) > limits.headers:
            said = f"The headers are longer than {limits.headers} characters; clear the cookies of this address."
            await refuse(scope, receive, send, 431, said, prefix)
        elif any(names.count(name) > 1 for name in ONCE) or "\0" in scope["path"]:
            await refuse(scope, receive, send, 400, "The request contradicts itself.", prefix)
        else:
            await app(scope, receive, send)

    return guard

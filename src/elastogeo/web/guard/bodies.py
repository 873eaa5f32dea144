"""No body too large, counted as it is read and whatever it declares, and none that drips.

Whoever reads it is told by an error that it ended early, which becomes the answer; nothing is done with the part that came.
"""

from __future__ import annotations

import asyncio
from time import monotonic

from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from elastogeo.web.asking import ENGINEER, Visitor
from elastogeo.web.guard.limits import Limits
from elastogeo.web.guard.refusing import has_body, header, refuse

MALFORMED, TOO_SLOW, TOO_MUCH = 400, 408, 413


def bodies(app: ASGIApp, limits: Limits, prefix: str) -> ASGIApp:
    """Let pass what is neither too large nor too slow."""

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        if not has_body(scope):
            await app(scope, receive, send)
            return
        visitor: Visitor = scope["state"]["visitor"]
        most = limits.of_body(scope["method"], scope["path"]) if visitor.may(ENGINEER) else limits.body
        declared = header(scope, "content-length")
        if declared is not None and not (declared.isascii() and declared.isdigit()):
            await refuse(scope, receive, send, MALFORMED, "The length of what was sent is no number.", prefix)
        elif declared is not None and int(declared) > most:
            await refuse(scope, receive, send, TOO_MUCH, _told(most), prefix)
        else:
            await app(scope, _Body(receive, most, limits).receive, send)

    return guard


class _Body:
    """The body of one request, as it is read."""

    def __init__(self, receive: Receive, most: int, limits: Limits) -> None:
        self._receive, self._most, self._limits = receive, most, limits
        self._begun, self._read, self._ended = monotonic(), 0, False

    async def receive(self) -> Message:
        if self._ended:  # who reads on waits for the end of the connection
            return await self._receive()
        message = await self._next()
        self._read += len(message.get("body", b""))
        self._ended = message["type"] != "http.request" or not message.get("more_body", False)
        if self._read > self._most:
            raise HTTPException(TOO_MUCH, _told(self._most))
        return message

    async def _next(self) -> Message:
        left = self._begun + self._limits.patience + self._read / self._limits.rate - monotonic()
        try:
            return await asyncio.wait_for(self._receive(), max(0.0, min(left, self._limits.patience)))
        except TimeoutError:
            raise HTTPException(TOO_SLOW, "What was sent came too slowly, and was thrown away; send it again.") from None


def _told(most: int) -> str:
    size = f"{most / 1_000_000:.0f} MB" if most >= 1_000_000 else f"{most // 1024} kB"
    return f"What was sent is larger than {size}, and was thrown away; send less at once."

"""What is still on its way when the answer is ready is thrown away for a moment, and the connection closes.

Closed at once, with bytes that nobody read, it would be broken off, and the sender would not see why.
"""

from __future__ import annotations

import asyncio
from time import monotonic

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from elastogeo.web.guard.refusing import has_body, header

SECONDS, BYTES = 2.0, 8_000_000
"""How long, and how much, is read after the answer."""


def lingering(app: ASGIApp) -> ASGIApp:
    """Let the sender of a body that was not read to its end see the answer."""

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        if not has_body(scope):
            await app(scope, receive, send)
            return
        rest = _Rest(receive, send, waits=header(scope, "expect") is not None)
        await app(scope, rest.receive, rest.send)

    return guard


class _Rest:
    """What has not been read of a body. A sender that waits to be told to go on (`Expect`) is not."""

    def __init__(self, receive: Receive, send: Send, waits: bool) -> None:
        self._receive, self._send, self._waits = receive, send, waits
        self._read, self._ended = 0, False

    async def receive(self) -> Message:
        message = await self._receive()
        self._read += len(message.get("body", b""))
        self._waits = False
        self._ended = self._ended or message["type"] != "http.request" or not message.get("more_body", False)
        return message

    async def send(self, message: Message) -> None:
        if self._ended:
            await self._send(message)
        elif message["type"] == "http.response.start":
            await self._send({**message, "headers": [*message.get("headers", ()), (b"connection", b"close")]})
        elif message.get("more_body", False) or self._waits:
            await self._send(message)
        else:
            await self._send({**message, "more_body": True})
            await self._throw_away()
            await self._send({"type": "http.response.body", "body": b""})

    async def _throw_away(self) -> None:
        until, most = monotonic() + SECONDS, self._read + BYTES
        while not self._ended and self._read < most and (left := until - monotonic()) > 0:
            try:
                await asyncio.wait_for(self.receive(), left)
            except TimeoutError:
                return

"""A client of the pages in this process that costs little a request: thousands of them are sent each day."""

from __future__ import annotations

import asyncio
import threading
from functools import cache
from typing import Any

import httpx2

PATIENCE = 120.0
"""Seconds in which an answer must come, on a computer that does much else."""


class Quick(httpx2.BaseTransport):
    """Calls an application in one loop that runs beside all tests: no thread and no loop is made for a request."""

    def __init__(self, app: Any) -> None:
        self._called = httpx2.ASGITransport(app=app, raise_app_exceptions=False)

    def handle_request(self, request: httpx2.Request) -> httpx2.Response:
        """The whole answer."""
        body = request.read()
        return asyncio.run_coroutine_threadsafe(self._answer(request, body), _loop()).result(PATIENCE)

    async def _answer(self, request: httpx2.Request, body: bytes) -> httpx2.Response:
        whole = httpx2.Request(request.method, request.url, headers=request.headers, stream=httpx2.ByteStream(body))
        found = await self._called.handle_async_request(whole)
        content = b"".join([block async for block in found.aiter_raw()])
        return httpx2.Response(found.status_code, headers=found.headers.raw, stream=httpx2.ByteStream(content))


@cache
def _loop() -> asyncio.AbstractEventLoop:
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, name="quick", daemon=True).start()
    return loop

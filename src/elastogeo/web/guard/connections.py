"""A connection that says nothing, or drips its headers, is closed."""

from __future__ import annotations

import asyncio
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from elastogeo.web.guard.faults import ALWAYS, CONFINED
from elastogeo.web.guard.limits import Limits

_PATIENCE = Limits().patience


class Connection(H11Protocol):
    """uvicorn's connection, which waits for the headers of its first request as long as for those of the others."""

    def connection_made(self, transport: Any) -> None:
        """Begin to wait."""
        super().connection_made(transport)
        self._late: asyncio.TimerHandle | None = self.loop.call_later(_PATIENCE, self._close)

    def data_received(self, data: bytes) -> None:
        """Wait on until a request is whole, and from its end for the next."""
        waited_for = self.cycle
        super().data_received(data)
        if self.cycle is not waited_for:
            self._stop()
        elif self._late is None and self.cycle.response_complete:  # the first bytes of a further request
            self._late = self.loop.call_later(_PATIENCE, self._close)

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing."""
        self._stop()
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        """Refuse what is no request, with the headers that every answer has."""
        said = {"content-type": "text/plain; charset=utf-8", "content-security-policy": CONFINED, **ALWAYS}
        lines = [(name.lower().encode(), value.encode()) for name, value in said.items()]
        lines += [(b"cache-control", b"no-store"), (b"connection", b"close")]
        begun = h11.Response(status_code=400, headers=lines, reason=b"Bad Request")
        for event in (begun, h11.Data(data=msg.encode("ascii")), h11.EndOfMessage()):
            self.transport.write(self.conn.send(event) or b"")
        self.transport.close()

    def _stop(self) -> None:
        if self._late is not None:
            self._late.cancel()
            self._late = None

    def _close(self) -> None:
        self.transport.close()

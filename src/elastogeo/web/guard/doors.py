"""The guard: its layers around the application, the outermost first."""

from __future__ import annotations

from starlette.types import ASGIApp, Receive, Scope, Send

from elastogeo.history import Store
from elastogeo.web.guard.bodies import bodies
from elastogeo.web.guard.faults import faults
from elastogeo.web.guard.hosts import hosts
from elastogeo.web.guard.limits import Limits
from elastogeo.web.guard.lingering import lingering
from elastogeo.web.guard.origins import origins
from elastogeo.web.guard.sizes import sizes
from elastogeo.web.guard.visitors import visitors
from elastogeo.web.settings import Settings


def guarded(app: ASGIApp, settings: Settings, store: Store, limits: Limits | None = None) -> ASGIApp:
    """The application behind its guard, which sets `scope["state"]["visitor"]`.

    Parameters
    ----------
    app : ASGI application
    settings : Settings
    store : Store
    limits : Limits, optional
    """
    limits = limits or Limits()
    inner = bodies(app, limits, settings.prefix)
    inner = visitors(inner, settings, store)
    inner = origins(_without_prefix(inner, settings.prefix), settings)
    inner = sizes(inner, limits, settings.prefix)
    inner = faults(lingering(hosts(inner, settings)), settings)

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":
            await inner(scope, receive, send)
        elif scope["type"] == "lifespan":
            await app(scope, receive, send)
        else:
            await send({"type": "websocket.close", "code": 1008})

    return guard


def _without_prefix(app: ASGIApp, prefix: str) -> ASGIApp:
    """The request as if there were no proxy before it, whether that proxy strips the prefix or not."""

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        path = scope["path"]
        if prefix and (path == prefix or path.startswith(f"{prefix}/")):
            scope = {**scope, "path": path[len(prefix) :] or "/", "raw_path": None}
        await app(scope, receive, send)

    return guard

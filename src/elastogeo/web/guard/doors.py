"""The guard: layers around the application, the outermost first."""

from __future__ import annotations

from starlette.types import ASGIApp, Receive, Scope, Send

from elastogeo.history import Store
from elastogeo.history.store import audit
from elastogeo.web.asking import ADMINISTRATOR, Visitor
from elastogeo.web.settings import Settings


def guarded(app: ASGIApp, settings: Settings, store: Store) -> ASGIApp:  # noqa: ARG001
    """The application behind its guard: it sets `scope["state"]["visitor"]`."""
    name = settings.who or audit.login()

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":
            scope.setdefault("state", {})["visitor"] = Visitor(name, ADMINISTRATOR)
            scope = _without_prefix(scope, settings.prefix)
        await app(scope, receive, send)

    return guard


def _without_prefix(scope: Scope, prefix: str) -> Scope:
    """The request as if there were no proxy before it, whether that proxy strips the prefix or not."""
    path = scope["path"]
    if prefix and (path == prefix or path.startswith(f"{prefix}/")):
        return {**scope, "path": path[len(prefix) :] or "/", "raw_path": None}
    return scope

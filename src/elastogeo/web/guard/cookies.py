"""The cookie of a session: which browser holds it, and where it sends it."""

from __future__ import annotations

from typing import Any

from starlette.requests import cookie_parser
from starlette.types import Scope

from elastogeo.web.guard.refusing import header
from elastogeo.web.settings import Settings

_NAME = "elastogeo_session"


def session_cookie(settings: Settings) -> dict[str, Any]:
    """What `set_cookie` and `delete_cookie` are to be told of the session's cookie, but for what it holds.

    With https its name begins so that a browser takes it only from this very host (`__Host-`), where no prefix forbids
    that. `Lax`: whoever follows a link in a message stays logged in; what acts is guarded by its origin.
    """
    return {
        "key": _name(settings),
        "path": f"{settings.prefix}/" if settings.prefix else "/",
        "httponly": True,
        "samesite": "lax",
        "secure": settings.behind_https,
    }


def session_of(scope: Scope, settings: Settings) -> str:
    """What the session's cookie of a request holds; empty without one."""
    return cookie_parser(header(scope, "cookie") or "").get(_name(settings), "")


def _name(settings: Settings) -> str:
    if not settings.behind_https:
        return _NAME
    return f"__Secure-{_NAME}" if settings.prefix else f"__Host-{_NAME}"

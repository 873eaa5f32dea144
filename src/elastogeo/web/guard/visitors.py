"""Who asks: by the session in a cookie, by a token, or as whoever started the pages on this computer.

It is found out before a byte of the body is read. Nobody sees whether an address exists before logging in.
"""

from __future__ import annotations

from collections.abc import Callable
from urllib.parse import quote

from anyio.to_thread import run_sync
from starlette.types import ASGIApp, Receive, Scope, Send

from elastogeo.errors import StoreError
from elastogeo.history import Store
from elastogeo.history.people import Person, check_reachable, has_accounts, person_of_session, person_of_token
from elastogeo.history.store import audit
from elastogeo.web.asking import ADMINISTRATOR, NOBODY, Visitor
from elastogeo.web.guard.cookies import session_of
from elastogeo.web.guard.refusing import header, refuse, wants_document
from elastogeo.web.settings import Settings

OPEN = ("/login", "/health", "/favicon.ico")
"""What anybody may ask, beside our files."""
UNREADABLE = "The history cannot be read just now; try again."
_LONGEST = 200
"""Characters of a token or a session: what is longer is none."""


def check_reach(settings: Settings, store: Store) -> None:
    """Refuse to serve other computers, or all who must log in, if nobody could.

    Raises
    ------
    StoreError
        If no administrator has a password.
    """
    if settings.accounts or settings.is_reachable:
        check_reachable(store)


def visitors(app: ASGIApp, settings: Settings, store: Store) -> ASGIApp:
    """Let pass whoever is known, and nobody else but to log in."""
    door = _Door(settings, store)

    async def guard(scope: Scope, receive: Receive, send: Send) -> None:
        try:
            visitor = await door.visitor(scope)
        except StoreError:
            await refuse(scope, receive, send, 503, UNREADABLE, settings.prefix)
            return
        scope.setdefault("state", {}).update(visitor=visitor, still=lambda: door.visitor(scope))
        if visitor.is_known or scope["path"] in OPEN or scope["path"].startswith("/static/"):
            await app(scope, receive, send)
        elif header(scope, "authorization") is not None:
            said = "The token opens nothing: it was ended, or never was. Make another one."
            await refuse(scope, receive, send, 401, said, settings.prefix, {"www-authenticate": "Bearer"})
        elif wants_document(scope) or scope["method"] not in ("GET", "HEAD"):
            said = "Log in first; a program sends a token: Authorization: Bearer."
            await refuse(scope, receive, send, 401, said, settings.prefix, {"www-authenticate": "Bearer"})
        else:
            await refuse(scope, receive, send, 303, "Log in first.", settings.prefix, {"location": _login(scope, settings)})

    return guard


class _Door:
    """Finds out who asks."""

    def __init__(self, settings: Settings, store: Store) -> None:
        self._settings, self._store = settings, store
        self._alone = Visitor(settings.who or audit.login(), ADMINISTRATOR)
        self._shut = settings.accounts or settings.is_reachable

    async def visitor(self, scope: Scope) -> Visitor:
        """Who asks; with a token only the token counts."""
        if scope["path"].startswith("/static/"):
            return NOBODY
        said, secret = header(scope, "authorization"), session_of(scope, self._settings)
        if said is not None:
            scheme, _, token = said.partition(" ")
            found = await self._found(person_of_token, token.strip()) if scheme.lower() == "bearer" else None
        else:
            found = await self._found(person_of_session, secret) if secret else None
        if found is not None:
            return Visitor(found.name, found.role, found.key)
        return NOBODY if said is not None or await self._is_shut() else self._alone

    async def _found(self, how: Callable[[Store, str], Person | None], secret: str) -> Person | None:
        return await run_sync(how, self._store, secret) if secret and len(secret) <= _LONGEST else None

    async def _is_shut(self) -> bool:
        """Whether one must log in: from the first account on for good."""
        self._shut = self._shut or await run_sync(has_accounts, self._store)
        return self._shut


def _login(scope: Scope, settings: Settings) -> str:
    asked = scope["path"] + (f"?{scope['query_string'].decode('latin-1')}" if scope["query_string"] else "")
    return f"{settings.prefix}/login" + (f"?to={quote(asked, safe='')}" if asked != "/" else "")

"""What a page is asked with: the history in the visitor's name, who asks, and what may be refused."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated
from urllib.parse import quote, urlsplit

from fastapi import Depends, Request

from elastogeo.errors import InputError, StoreError
from elastogeo.history import History, KnownMachine
from elastogeo.report import simulated_said
from elastogeo.version import VERSION
from elastogeo.web.settings import Settings

ANYBODY, READER, ENGINEER, ADMINISTRATOR = "anybody", "reader", "engineer", "administrator"
ROLES = (ANYBODY, READER, ENGINEER, ADMINISTRATOR)
"""What a person may do, each what the one before may and more: log in; look; test, judge and plan; decide who comes in."""
THEMES = ("auto", "light", "dark")
SAID, THEME = "elastogeo_said", "elastogeo_theme"
"""Cookies: the sentence that the next page says of what was done; the theme of a browser."""


class NotFound(InputError):  # noqa: N818
    """There is nothing at this address; the sentence says what is missing."""


class Refused(InputError):  # noqa: N818
    """The visitor's role does not allow this."""


@contextmanager
def or_not_found(sentence: str = "") -> Iterator[None]:
    """Do something with what an address names: what the history does not find is a page that is not there.

    Parameters
    ----------
    sentence : str
        That the page says; empty: what the history says.

    Raises
    ------
    NotFound
    """
    try:
        yield
    except InputError as error:
        raise NotFound(sentence or str(error)) from None


@dataclass(frozen=True, slots=True)
class Visitor:
    """Who asks.

    Attributes
    ----------
    name : str
        For the audit trail.
    role : str
        One of ROLES.
    account : int or None
        Key of the person; None where there are no accounts.
    """

    name: str
    role: str
    account: int | None = None

    @property
    def is_known(self) -> bool:
        """Whether it is somebody, not just anybody."""
        return self.role != ANYBODY

    def may(self, role: str) -> bool:
        """Whether the visitor's role allows what this one may."""
        return ROLES.index(self.role) >= ROLES.index(role)


NOBODY = Visitor("", ANYBODY)
"""Who has not logged in."""


@dataclass(frozen=True)
class Asked:
    """A request, as a page function sees it.

    Attributes
    ----------
    request : Request
    settings : Settings
    visitor : Visitor
    history : History
        In the visitor's name.
    """

    request: Request
    settings: Settings
    visitor: Visitor
    history: History

    @cached_property
    def theme(self) -> str:
        """`light`, `dark`, or `auto`: as the browser prefers."""
        asked = self.request.cookies.get(THEME, "auto")
        return asked if asked in THEMES else "auto"

    @cached_property
    def unknown_alarms(self) -> int:
        """How many alarms nobody has acknowledged; none where the history cannot be read, which the page says itself."""
        try:
            return self.history.unknown_alarms()
        except StoreError:
            return 0

    @cached_property
    def origin(self) -> str:
        """That all there is was simulated, if so: for pages that show of everything, and of no one thing."""
        try:
            return simulated_said(self.history.simulated())
        except StoreError:
            return ""

    @property
    def says_something(self) -> bool:
        """Whether the page also says what was done just before."""
        return SAID in self.request.cookies

    @property
    def by_htmx(self) -> bool:
        """Whether a part of a page is asked for, to be put into the page that is there."""
        return self.request.headers.get("hx-request") == "true"

    @property
    def by_program(self) -> bool:
        """Whether a document is wanted where a person gets a page."""
        return "application/json" in self.request.headers.get("accept", "")

    def tag(self) -> str:
        """The ETag of what is shown: another one as soon as something that a page shows has changed."""
        asked = self.request
        parts = (
            VERSION,
            self.history.edition(),
            str(asked.url.path),
            str(asked.url.query),
            self.visitor.name,
            self.visitor.role,
            self.theme,
            str(self.by_htmx),
        )
        return f'"{hashlib.sha256(chr(0).join(parts).encode()).hexdigest()[:32]}"'

    def url(self, path: str, **query: object) -> str:
        """An address within the pages, with the prefix of a proxy and what is asked there."""
        said = "&".join(
            f"{quote(name)}={quote(str(value), safe='')}" for name, value in query.items() if value not in ("", None)
        )
        return f"{self.settings.prefix}{path}{'?' if said else ''}{said}"

    def came_from(self) -> str:
        """The page from which this was asked, if it is one of ours; else the fleet."""
        try:
            said = urlsplit(self.request.headers.get("referer", ""))
        except ValueError:
            return self.url("/")
        ours = said.netloc == self.request.headers.get("host") and said.path.startswith(self.url("/"))
        path = f"/{said.path.lstrip('/')}"
        ours = ours and "\\" not in path
        return (f"{path}?{said.query}" if said.query else path) if ours else self.url("/")

    def machine(self, key: int) -> KnownMachine:
        """The machine of a key.

        Raises
        ------
        NotFound
        """
        found = self.history.known_machine(key)
        if found is None:
            raise NotFound("There is no such machine.")
        return found

    def needs(self, role: str) -> None:
        """Refuse who may not do this.

        Raises
        ------
        Refused
        """
        if not self.visitor.may(role):
            raise Refused(f"this needs the role {role}; {self.visitor.name} is {self.visitor.role}: ask an administrator")

    async def still_needs(self, role: str) -> None:
        """Refuse who may not do this any more: the session or the token has ended, or the role is another one, while much
        was sent.

        Raises
        ------
        Refused
        """
        now: Visitor = await self.request.state.still()
        if not now.may(role):
            raise Refused("your account may not do this any more; nothing was kept of what was sent")


def asked_of(request: Request) -> Asked:
    """A request as a page function sees it."""
    visitor: Visitor = request.state.visitor
    return Asked(request, request.app.state.settings, visitor, History.of(request.app.state.store, visitor.name))


Ask = Annotated[Asked, Depends(asked_of)]
"""The type of the first parameter of a page function: `asked: Ask`."""

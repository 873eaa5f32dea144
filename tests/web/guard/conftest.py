"""A shop with a person of each role, behind its guard: asked in this process, as a browser or as a program."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest
from httpx2 import Client

import elastogeo as eg
from elastogeo.history.people import log_in
from elastogeo.web import Settings, application
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER, READER
from tests.web.guard.quick import Quick

NAME = "shop.example"
HOST = f"http://{NAME}"
PASSWORD = "correct horse battery"
PERSONS = {ADMINISTRATOR: "A. Miller", ENGINEER: "B. Smith", READER: "C. Jones"}
OURS = {"Origin": HOST, "Sec-Fetch-Site": "same-origin", "Sec-Fetch-Mode": "navigate", "Accept": "text/html"}
"""What a browser says of a request from our own pages."""


@dataclass
class Shop:
    """A history with accounts, and its pages.

    Attributes
    ----------
    history : History
    app : ASGI application
        Behind its guard.
    tokens, sessions : dict of str to str
        By role.
    """

    history: eg.History
    app: Any
    tokens: dict[str, str] = field(default_factory=dict)
    sessions: dict[str, str] = field(default_factory=dict)

    def browser(self, role: str | None = None, **how: Any) -> Client:
        """A browser in which a person of this role has logged in; without a role, nobody."""
        found = Client(transport=Quick(self.app), base_url=HOST, headers=OURS, **how)
        if role is not None:
            found.cookies.set("elastogeo_session", self.sessions[role], domain=NAME)
        return found

    def program(self, token: str | None = None) -> Client:
        """A program, with a token if it has one."""
        headers = {"Authorization": f"Bearer {token}"} if token is not None else {}
        return Client(transport=Quick(self.app), base_url=HOST, headers=headers)

    def head(self) -> tuple[int, str]:
        """The number and seal of the last row of the audit trail: what anybody writes changes it."""
        trail = self.history.audit(1)
        return trail.count, trail.head


@pytest.fixture(scope="module")
def quick_passwords() -> Iterator[None]:
    """Passwords that are kept in a millisecond: what Argon2id costs is tested elsewhere."""
    from argon2 import PasswordHasher

    from elastogeo.history.people import passwords

    quick = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(passwords, "_hasher", lambda: quick)
        passwords._nobodys.cache_clear()
        yield
    passwords._nobodys.cache_clear()


@pytest.fixture(scope="module")
def make_shop(quick_passwords: None, tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Shop]:  # noqa: ARG001
    """`make_shop(prefix="/x")`: a shop with settings of its own."""

    def made(**settings: Any) -> Shop:
        history = eg.History(tmp_path_factory.mktemp("shop") / "h.db", create=True, who="the tests")
        for role, name in PERSONS.items():
            history.add_account(name, role, PASSWORD)
        history.add_machine("Mill 3", place="hall 1", serial="4711")
        app = application(Settings(history.store.url, **{"hosts": (NAME,), "worker": False, **settings}), history.store)
        tokens = {role: history.make_token(name, "tests").secret for role, name in PERSONS.items()}
        sessions = {role: log_in(history.store, name, PASSWORD) or "" for role, name in PERSONS.items()}
        return Shop(history, app, tokens, sessions)

    return made


@pytest.fixture(scope="module")
def shop(make_shop: Callable[..., Shop]) -> Iterator[Shop]:
    found = make_shop()
    yield found
    found.history.close()


@pytest.fixture
def nothing_written(shop: Shop) -> Iterator[None]:
    """What a test asks must write nothing."""
    before = shop.head()
    yield
    assert shop.head() == before

"""Log in and out."""

from __future__ import annotations

import logging
from ipaddress import IPv6Address, ip_address, ip_network
from typing import Annotated
from urllib.parse import unquote

from fastapi import Form, Request, Response

from elastogeo.history.people import ABSOLUTE, end_session, log_in
from elastogeo.web.answering import in_ascii
from elastogeo.web.asking import ANYBODY, READER, Ask, Asked
from elastogeo.web.guard import session_cookie
from elastogeo.web.pages import Pages
from elastogeo.web.people.throttle import Throttle, TooOften
from elastogeo.web.templating import page

pages = Pages()
LOG = logging.getLogger("elastogeo.web")
WRONG = "Name or password is wrong, or the account is switched off."


@pages.gives("/login", role=ANYBODY, media="text/html")
def login_form(asked: Ask, to: str = "/") -> Response:
    """Where a person logs in. It shows nothing of the shop."""
    if asked.visitor.is_known:
        return Response(status_code=303, headers={"Location": asked.url("/")})
    return _form(asked, 200, "", _ours(to))


@pages.makes("/login", role=ANYBODY)
def login(
    asked: Ask,
    name: Annotated[str, Form(max_length=200)],
    password: Annotated[str, Form(max_length=1000)],
    to: Annotated[str, Form(max_length=2000)] = "/",
) -> Response:
    """Begin a session. Which of name and password was wrong is not said, nor kept in a log."""
    address = address_of(asked.request)
    try:
        secret = tried(asked, name, password)
    except TooOften as error:
        LOG.warning("log-in from %s refused: too often", address)
        return _form(asked, 429, str(error), _ours(to), {"Retry-After": str(error.seconds)})
    if secret is None:
        LOG.warning("log-in from %s refused", address)
        return _form(asked, 403, WRONG, _ours(to))
    cookie = session_cookie(asked.settings)
    if before := asked.request.cookies.get(cookie["key"]):
        end_session(asked.history.store, before)
    answer = Response(status_code=303, headers={"Location": in_ascii(asked.url(_ours(to)))})
    answer.set_cookie(value=secret, max_age=int(ABSOLUTE.total_seconds()), **cookie)
    return answer


@pages.makes("/logout", role=READER)
def logout(asked: Ask) -> Response:
    """End the session: its cookie opens nothing any more, wherever it is."""
    cookie = session_cookie(asked.settings)
    if secret := asked.request.cookies.get(cookie["key"]):
        end_session(asked.history.store, secret)
    answer = Response(status_code=303, headers={"Location": asked.url("/login"), "Clear-Site-Data": '"cache"'})
    answer.delete_cookie(**cookie)
    return answer


def tried(asked: Asked, name: str, password: str) -> str | None:
    """Try a password, as often as one may: what the cookie of a new session holds, None if it is wrong.

    Raises
    ------
    TooOften
    """
    throttle, address = throttle_of(asked.request), address_of(asked.request)
    with throttle.attempt():
        throttle.check(name, address)
        with throttle.comparing:
            secret = log_in(asked.history.store, name, password)
    if secret is not None:
        throttle.succeeded(name, address)
    return secret


def address_of(request: Request) -> str:
    """From where one comes, as far as one can be told from a neighbour: IPv6 gives a house 2^64 addresses.

    Behind a proxy it is what the proxy says, which nobody else may choose; what is no address is none.
    """
    try:
        found = ip_address(request.client.host if request.client else "")
    except ValueError:
        return "an unknown address"
    if isinstance(found, IPv6Address):
        return str(found.ipv4_mapped or ip_network((int(found), 64), strict=False))
    return str(found)


def throttle_of(request: Request) -> Throttle:
    """The throttle of this application."""
    state = request.app.state
    if not hasattr(state, "throttle"):
        state.throttle = Throttle()
    found: Throttle = state.throttle
    return found


def _form(asked: Asked, status: int, error: str, to: str, headers: dict[str, str] | None = None) -> Response:
    text = page("people/login.html.j2", asked, error=error, to=to)
    said = {"Cache-Control": "no-store", **(headers or {})}
    return Response(text, status, said, media_type="text/html; charset=utf-8")


def _ours(to: str) -> str:
    """Where to go on: an address of ours, whatever was asked."""
    safe = to.startswith("/") and not to.startswith(("//", "/log")) and "\\" not in to and to.isprintable()
    parts = unquote(to.partition("?")[0].partition("#")[0]).removesuffix("/").split("/")[1:]
    return to if safe and not {"", ".", ".."} & set(parts) else "/"

"""What one's own account has: tokens for programs, and its password."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form, Response

from elastogeo.errors import InputError
from elastogeo.history.people import end_session
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown, json_response
from elastogeo.web.asking import READER, Ask, Asked
from elastogeo.web.pages import Pages
from elastogeo.web.people.login import tried
from elastogeo.web.templating import page

pages = Pages()
Password = Annotated[str, Form(max_length=1000)]


@pages.shows("/tokens")
def tokens(asked: Ask) -> Shown:
    """One's own tokens: with what programs come in, not the tokens themselves."""
    return Shown("people/tokens.html.j2", view_of(asked.history.tokens(asked.visitor.name)), context={"made": ""})


@pages.makes("/tokens", role=READER)
def make_token(asked: Ask, purpose: Annotated[str, Form(max_length=200)]) -> Response:
    """Make a token of one's own account. It is in this answer, and nowhere else ever again."""
    _check_account(asked)
    made = asked.history.make_token(asked.visitor.name, purpose)
    if asked.by_program:
        return json_response({"schema": "elastogeo.token/1", "number": made.number, "token": made.secret})
    view = view_of(asked.history.tokens(asked.visitor.name))
    text = page("people/tokens.html.j2", asked, view=view, made=made.secret)
    return Response(text, headers={"Cache-Control": "no-store"}, media_type="text/html; charset=utf-8")


@pages.acts("/tokens/{number:int}/end", role=READER)
def end_token(asked: Ask, number: int) -> Done:
    """End one of one's own tokens: it opens nothing any more."""
    asked.history.end_token(number, asked.visitor.name)
    return Done("/tokens", f"Token {number} opens nothing any more.")


@pages.acts("/password", role=READER)
def set_own_password(asked: Ask, present: Password, password: Password, again: Password) -> Done:
    """Give oneself another password. All one's sessions end."""
    _check_account(asked)
    if password != again:
        raise InputError("The two new passwords differ.")
    secret = tried(asked, asked.visitor.name, present)
    if secret is None:
        raise InputError("The present password is wrong.")
    end_session(asked.history.store, secret)  # it was begun only to try the password
    asked.history.set_password(asked.visitor.name, password)
    return Done("/login", "Your password is another one; log in with it.")


def _check_account(asked: Asked) -> None:
    if asked.visitor.account is None:
        raise InputError("You work without an account, as whoever sits at this computer; an administrator makes one first.")

'''A page: a function, the address at which it shows, and the role that it needs.

To add a page, write one file in a wing of pages beside this one (`machines`, `work`, `care`, `people`), and its template in
the folder of that name below `templates`. It is found by itself: in the addresses, in the OpenAPI, in the tests that every
page must pass. A complete one, `care/notes.py`::

    """The notes on a machine."""

    from elastogeo.report import view_of
    from elastogeo.web.answering import Done, Shown
    from elastogeo.web.asking import ENGINEER, Ask
    from elastogeo.web.fields import Why
    from elastogeo.web.pages import Pages

    pages = Pages()


    @pages.shows("/machines/{key:int}/notes")
    def notes(asked: Ask, key: int) -> Shown:
        """What was noted of a machine."""
        found = asked.history.events(asked.machine(key).name, "note")
        return Shown("care/notes.html.j2", view_of(found), context={"key": key})


    @pages.acts("/machines/{key:int}/notes", role=ENGINEER)
    def add_note(asked: Ask, key: int, note: Why) -> Done:
        """Note something of a machine."""
        asked.history.add_event("note", note, machine=asked.machine(key).name)
        return Done(f"/machines/{key}/notes", "The note is kept.")

and its template, `templates/care/notes.html.j2`::

    {% extends "base.html.j2" %}
    {% import "parts.html.j2" as parts %}
    {% block title %}Notes · elastogeo{% endblock %}
    {% block main %}
    <h1>Notes of {{ view.title }}</h1>
    {{ parts.answer(view) }}
    {% for table in view.tables %}{{ parts.table(table) }}{% endfor %}
    {% if visitor.may("engineer") %}
    <form method="post" action="{{ url("/machines/%d/notes" % key) }}">
    <label>Note <textarea name="note" required></textarea></label> <button>Keep it</button>
    </form>
    {% endif %}
    {% endblock %}

What the contract asks:

* `shows` registers the page and its twins, `.json` and `.csv` at the same path; what is asked is in the query, so that every
  filter can be kept as a bookmark. The view says all: a page computes nothing and formats no number;
* `acts` registers a form. It works without JavaScript: the browser is sent on to the next page, which says what was done;
* `gives` registers a file, `makes` an act that makes its own response;
* none is registered without a role, and the guard asks for it before the function runs;
* what is not there raises `NotFound`; any other error of elastogeo becomes one sentence on a page of its own. Nothing that
  was sent is echoed but what that sentence says.
'''

from __future__ import annotations

from collections.abc import Callable, Coroutine
from functools import wraps
from inspect import iscoroutinefunction
from typing import Any, TypeVar, get_args

from fastapi import APIRouter, Request, Response
from fastapi.routing import APIRoute
from starlette.routing import Match
from starlette.types import Scope

from elastogeo.web.answering import CSV, HTML, JSON, Done, Shown, gone_on, rendered
from elastogeo.web.asking import READER, Asked, NotFound, asked_of

Function = TypeVar("Function", bound=Callable[..., Any])
LARGEST = 2**63
"""The first number that is no key of a database."""
MEDIA = {HTML: "text/html", JSON: "application/json", CSV: "text/csv"}


class Page(APIRoute):
    """The address of a page: who may not see it is refused before a byte of what was sent is read."""

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        """Whether an address is this one; one with a number of thousands of digits is none."""
        try:
            return super().matches(scope)
        except ValueError:
            return Match.NONE, {}

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """What answers a request."""
        answer, role = super().get_route_handler(), (self.openapi_extra or {})["x-role"]
        kinds = {one.name: one.field_info.annotation for one in self.dependant.query_params}
        numbers = {name for name, kind in kinds.items() if int in (kind, *get_args(kind))}

        async def handler(request: Request) -> Response:
            asked_of(request).needs(role)
            asked_for = ((name, said) for name, said in request.query_params.items() if name in numbers)
            for name, said in (*request.path_params.items(), *asked_for):
                if is_too_large(str(said)):
                    raise NotFound(f"There is nothing of this number: {name}.")
            return await answer(request)

        return handler


def is_too_large(said: str) -> bool:
    """Whether this is a whole number that no key reaches; of thousands of digits Python makes none."""
    digits = said.lstrip("-").lstrip("0")
    return digits.isdecimal() and (len(digits) > len(str(LARGEST)) or int(digits) >= LARGEST)


class Pages(APIRouter):
    """The pages of one file. Its name is `pages`: that is how it is found."""

    def __init__(self) -> None:
        super().__init__(route_class=Page)

    def shows(self, path: str, *, role: str = READER, fresh: bool = False) -> Callable[[Function], Function]:
        """Register a page and its twins.

        Parameters
        ----------
        path : str
            `/machines/{key:int}`.
        role : str
            That a visitor needs.
        fresh : bool
            Whether it shows what the history's edition does not tell: what is going on just now.
        """

        def register(function: Function) -> Function:
            for twin, media in MEDIA.items():
                at = f"{'/fleet' if path == '/' and twin else path}{twin}"
                self._add(at, _shown(function, twin, fresh), "GET", function, role, media if twin else "")
            return function

        return register

    def acts(self, path: str, *, role: str) -> Callable[[Function], Function]:
        """Register what a person or a program does: a form that is posted."""

        def register(function: Function) -> Function:
            self._add(path, _acted(function), "POST", function, role, "application/json")
            return function

        return register

    def gives(
        self, path: str, *, role: str = READER, media: str = "application/octet-stream"
    ) -> Callable[[Function], Function]:
        """Register a file to download, or anything else of one form only: the function makes the response."""

        def register(function: Function) -> Function:
            self._add(path, _given(function), "GET", function, role, media)
            return function

        return register

    def makes(self, path: str, *, role: str) -> Callable[[Function], Function]:
        """Register an act that makes its own response: one that sets a cookie, or reads the body as it comes."""

        def register(function: Function) -> Function:
            self._add(path, _given(function), "POST", function, role, "application/json")
            return function

        return register

    def _add(self, path: str, endpoint: Callable[..., Any], method: str, function: Function, role: str, media: str) -> None:
        said: dict[int | str, dict[str, Any]] = {200: {"content": {media: {}}}} if media else {}
        self.add_api_route(
            path,
            endpoint,
            methods=[method],
            name=f"{function.__name__}{path}",
            include_in_schema=bool(media),
            response_class=Response,
            response_model=None,
            responses=said,
            tags=[role],
            openapi_extra={"x-role": role},
        )


def _shown(function: Callable[..., Shown], twin: str, fresh: bool) -> Callable[..., Response]:
    @wraps(function)
    def endpoint(asked: Asked, **given: Any) -> Response:
        tag = "" if fresh or asked.says_something else asked.tag()
        if tag and tag in asked.request.headers.get("if-none-match", ""):
            return Response(status_code=304, headers={"ETag": tag, "Cache-Control": "private, no-cache"})
        return rendered(function(asked=asked, **given), asked, twin, tag)

    return endpoint


def _acted(function: Callable[..., Done]) -> Callable[..., Response]:
    @wraps(function)
    def endpoint(asked: Asked, **given: Any) -> Response:
        return gone_on(function(asked=asked, **given), asked)

    return endpoint


def _given(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def endpoint(asked: Asked, **given: Any) -> Response:
        answer: Response = function(asked=asked, **given)
        return answer

    @wraps(function)
    async def waiting(asked: Asked, **given: Any) -> Response:
        answer: Response = await function(asked=asked, **given)
        return answer

    return waiting if iscoroutinefunction(function) else endpoint

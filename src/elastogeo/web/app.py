"""The application: its pages, found by themselves, and what becomes of an error."""

from __future__ import annotations

import logging
import secrets
from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp

from elastogeo.errors import ElastogeoError, StoreError
from elastogeo.history import Store
from elastogeo.version import VERSION
from elastogeo.web.answering import json_response
from elastogeo.web.asking import Asked, NotFound, Refused, asked_of
from elastogeo.web.guard import UNREADABLE, guarded
from elastogeo.web.pages import Pages
from elastogeo.web.settings import Settings
from elastogeo.web.templating import STATIC, page

LOG = logging.getLogger("elastogeo.web")
WINGS = ("machines", "work", "care", "people")


def application(settings: Settings, store: Store) -> ASGIApp:
    """The pages of a history, behind the guard.

    Parameters
    ----------
    settings : Settings
    store : Store
        The history, open.

    Returns
    -------
    ASGI application
    """
    app = FastAPI(
        title="elastogeo",
        version=VERSION,
        docs_url=None,
        redoc_url=None,
        openapi_url="/openapi.json",
        redirect_slashes=False,
    )
    app.state.settings, app.state.store = settings, store
    for pages in every():
        app.include_router(pages)
    app.mount("/static", StaticFiles(directory=str(STATIC)), name="static")
    with_errors(app)
    return guarded(app, settings, store)


def with_errors(app: FastAPI) -> None:
    """Let an application tell each error in one sentence."""
    app.add_exception_handler(ElastogeoError, _refused)
    app.add_exception_handler(RequestValidationError, _misasked)
    app.add_exception_handler(HTTPException, _answered)
    app.add_exception_handler(Exception, _failed)


def every() -> Iterator[Pages]:
    """The pages of all files of the wings."""
    package = __name__.rpartition(".")[0]
    for wing in WINGS:
        for file in iter_modules(import_module(f"{package}.{wing}").__path__, f"{package}.{wing}."):
            found = getattr(import_module(file.name), "pages", None)
            if isinstance(found, Pages):
                yield found


def _refused(request: Request, error: Exception) -> Response:
    asked = asked_of(request)
    if isinstance(error, StoreError):
        LOG.warning("%s", error)  # it names places of the server: not for who has not logged in
        return told(asked, 503, str(error) if asked.visitor.is_known else UNREADABLE)
    status = 404 if isinstance(error, NotFound) else 403 if isinstance(error, Refused) else 400
    return told(asked, status, str(error))


def _misasked(request: Request, error: Exception) -> Response:
    """What was given does not fit: which entries, never what they were."""
    assert isinstance(error, RequestValidationError)
    names = ", ".join(dict.fromkeys(str(one["loc"][-1]) for one in error.errors() if one["loc"]))
    return told(asked_of(request), 422, f"What was sent does not fit: {names}." if names else "What was sent does not fit.")


def _answered(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    words = {404: "There is no such page.", 405: "This address takes no such request."}
    ours = error.detail if error.status_code in (408, 413) else "This cannot be done."
    return told(asked_of(request), error.status_code, words.get(error.status_code, ours))


def _failed(request: Request, error: Exception) -> Response:
    number = secrets.token_hex(4)
    LOG.error("fault %s at %r", number, request.url.path, exc_info=error)
    return told(asked_of(request), 500, f"A fault of elastogeo, number {number}; the log of the server says more.")


def told(asked: Asked, status: int, sentence: str) -> Response:
    """An error in one sentence, as a page or as a document."""
    if asked.by_program or asked.request.url.path.endswith((".json", ".csv")):
        return json_response({"schema": "elastogeo.error/1", "error": sentence}, status)
    return Response(
        page("error.html.j2", asked, sentence=sentence, status=status), status, media_type="text/html; charset=utf-8"
    )

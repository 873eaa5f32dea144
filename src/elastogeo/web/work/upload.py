"""Uploads: files are sent, what they are is found and shown, a person confirms, they are imported."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form, Response
from starlette.requests import ClientDisconnect

from elastogeo.history.parcels import LARGEST
from elastogeo.web.answering import Done, Shown, gone_on
from elastogeo.web.asking import ENGINEER, Ask
from elastogeo.web.pages import Pages
from elastogeo.web.work.receiving import received

pages = Pages()


@pages.shows("/upload", role=ENGINEER)
def upload(asked: Ask) -> Shown:  # noqa: ARG001
    """Where files are sent: tests as folders, single files or zip archives."""
    document = {
        "schema": "elastogeo.upload/1",
        "largest_bytes": LARGEST,
        "takes": "multipart/form-data, or one file as it is",
    }
    return Shown("work/upload.html.j2", document=document, context={"megabytes": LARGEST // 1_000_000})


@pages.makes("/upload", role=ENGINEER)
async def send(asked: Ask, name: str = "") -> Response:
    """Send files: a form (`multipart/form-data`), or one file as it is, its name in the query. What they are is found."""
    request = asked.request
    try:
        parcel = await received(
            asked.history.store, request.stream(), request.headers, name, lambda: asked.still_needs(ENGINEER)
        )
    except ClientDisconnect:
        return Response(status_code=400)  # nobody reads it
    job = asked.history.put_job("look", {"parcel": parcel})
    return gone_on(Done(f"/jobs/{job}", document={"job": job}), asked)


@pages.acts("/jobs/{key:int}/import", role=ENGINEER)
def confirm(
    asked: Ask,
    key: int,
    serial: Annotated[list[str], Form(max_length=100)] = [],  # noqa: B006
    machine: Annotated[list[str], Form(max_length=100)] = [],  # noqa: B006
    named: Annotated[list[str], Form(max_length=100)] = [],  # noqa: B006
    date: Annotated[str, Form(max_length=40)] = "",
) -> Done:
    """Import the tests that a look has found. `serial`, `machine`, `named` go together: of the tests that say this serial
    number (empty: none), the machine of the history, or the name of a new one."""
    job = asked.history.put_import(key, list(zip(serial, machine, named, strict=False)), date)
    return Done(f"/jobs/{job}", document={"job": job})

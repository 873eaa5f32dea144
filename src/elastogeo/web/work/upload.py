"""Uploads: files are sent, what they are is found and shown, a person confirms, they are imported."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Form, Response
from starlette.requests import ClientDisconnect

from elastogeo.changes import KeptJob
from elastogeo.errors import InputError
from elastogeo.history.parcels import LARGEST
from elastogeo.web.answering import Done, Shown, gone_on
from elastogeo.web.asking import ENGINEER, Ask, Asked
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
    looked = asked.history.job(key)
    if looked.kind != "look" or looked.result is None:
        raise InputError(f"job {key} has found no tests; upload them, and wait until they were looked at")
    again = _imported(asked, looked)
    if again is not None:
        return Done(f"/jobs/{again}")
    wanted = {"parcel": looked.result["parcel"], "date": date}
    wanted["machines"] = _machines(asked, looked.result, list(zip(serial, machine, named, strict=False)))
    wanted["known"] = sorted({one["known"]["test"] for one in looked.result["tests"] if one["known"]})
    if not date and any(not one["date"] and not one["known"] for one in looked.result["tests"]):
        raise InputError("a test does not say when it was measured; give its date")
    job = asked.history.put_job("import", wanted)
    return Done(f"/jobs/{job}", document={"job": job})


def unplaced(result: dict[str, Any]) -> list[dict[str, Any]]:
    """The serial numbers whose machine a person must say, each with the tests that are of it; the empty one for those that
    say none.
    """
    found: dict[str, list[str]] = {}
    for one in result["tests"]:
        if not one["known"] and not one["machine"]:
            found.setdefault(one["serial"], []).append(one["path"])
    return [{"serial": serial, "tests": tests} for serial, tests in found.items()]


def _imported(asked: Asked, looked: KeptJob) -> int | None:
    """The job that imports, or imported, the same: a form may be sent twice."""
    parcel = (looked.result or {})["parcel"]
    jobs = asked.history.jobs(last=100, kind="import").jobs
    return next((one.key for one in jobs if one.asked.get("parcel") == parcel and one.state in _ON), None)


_ON = ("waiting", "running", "done")


def _machines(asked: Asked, result: dict[str, Any], said: list[tuple[str, str, str]]) -> dict[str, str]:
    """The machine of each serial number, a new one made if it was named."""
    chosen = {serial: (machine.strip(), named.strip()) for serial, machine, named in said}
    there = {one.name for one in asked.history.machines()}
    groups = [one["serial"] for one in unplaced(result)]
    for serial in groups:
        machine, named = chosen.get(serial, ("", ""))
        if not machine and not named:
            of = f"with the serial number {serial}" if serial else "that do not say their machine"
            raise InputError(f"choose the machine of the tests {of}, or name a new one")
        if machine and machine not in there:
            raise InputError(f"there is no machine {machine!r}; choose one that is there, or name a new one")
    found = {}
    for serial in groups:
        machine, named = chosen[serial]
        if named and named not in there:
            asked.history.add_machine(named, serial=serial)
        found[serial] = machine or named
    return found

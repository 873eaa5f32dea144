"""The job `look`: what a parcel holds."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from elastogeo.errors import InputError
from elastogeo.history.store import Files, read
from elastogeo.history.work import Work, job

LAID = "laid"
"""The folder of a parcel in which it is laid out."""


@job("look")
def look(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Lay out the parcel `parcel`, and say what is in it: what `recognised` gives, `parcel` and `refused` files beside."""
    from elastogeo.history.parcels.recognising import recognised
    from elastogeo.history.parcels.staging import parcel, sent
    from elastogeo.history.parcels.unpacking import lay_out

    folder = parcel(work.store.files, asked["parcel"])
    new, laid = folder / f"{LAID}.part", folder / LAID
    work.step("looking at what was sent")
    refused: list[dict[str, str]] = []
    for old in (new, laid):  # a look that was broken off begins again
        shutil.rmtree(old, ignore_errors=True)
    try:
        refused = [{"path": one.name, "error": one.error} for one in lay_out(sent(folder), new, work.step)]
        new.rename(laid)
    except OSError as error:
        raise InputError(f"what was sent cannot be laid out: {error.strerror}; send it again, its files renamed") from error
    with read(work.store) as connection:
        found = recognised(work, laid, connection)
    errors = [one["error"] for one in refused] + found["errors"]
    return {**found, "parcel": asked["parcel"], "errors": errors}


def laid_out(files: Files, name: str) -> Path:
    """Where a parcel that was looked at is laid out.

    Raises
    ------
    InputError
        If it is not there, or was not looked at.
    """
    from elastogeo.history.parcels.staging import parcel

    folder = parcel(files, name) / LAID
    if not folder.is_dir():
        raise InputError("what was sent was not looked at yet; wait until it was")
    return folder

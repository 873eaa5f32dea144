"""Backup and check as jobs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from elastogeo.history.store import read
from elastogeo.history.upkeep.backups import back_up
from elastogeo.history.upkeep.kept_copies import BACK_UP, VERIFY, is_noted, make_folder, note_check, note_copy
from elastogeo.history.upkeep.manifests import read_manifest
from elastogeo.history.upkeep.verification import verify
from elastogeo.history.work import Work, job
from elastogeo.report import view_of


@job(BACK_UP)
def back_up_job(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Copy all into the folder `place`; begun again, what is there whole stays as it is.

    Parameters
    ----------
    work : Work
    asked : dict
        `place`: by `kept_copies.place_of_copy`, never by a visitor.
    """
    place = Path(asked["place"])
    make_folder(place.parent)
    # what has the name is whole and checked: this job was killed just after it got it
    copied = read_manifest(place).copied(str(place)) if place.is_dir() else back_up(work.store, place, work.step)
    with read(work.store) as connection:
        noted = is_noted(connection, copied.place)
    if not noted:
        note_copy(work.store, copied, work.who)
    return {"place": copied.place, "files": copied.files, "size": copied.size, "wrong": list(copied.wrong)}


@job(VERIFY)
def verify_job(work: Work, asked: dict[str, Any]) -> dict[str, Any]:  # noqa: ARG001
    """Check all that is kept, and note what was found."""
    found = verify(work.store, work.step)
    note_check(work.store, found, work.who)
    view = view_of(found)
    return {"sentence": view.sentence, "supported": view.supported, "faults": len(found.faults)}

"""Backups, and checks of all that is kept: made by the worker, known by the audit trail."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ADMINISTRATOR, Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/backup", fresh=True)
def backup(asked: Ask) -> Shown:
    """When all was backed up last and checked last, and what is going on."""
    history = asked.history
    going = [one for kind in ("back up", "verify") for one in history.jobs(20, kind).jobs if not one.is_over]
    copies = history.copies()
    context = {"going": going, "can": bool(copies.folder)}
    return Shown("care/backup.html.j2", view_of(copies), context=context)


@pages.acts("/backup", role=ADMINISTRATOR)
def back_up(asked: Ask) -> Done:
    """Ask for a backup now, in the folder that is set where the pages were started."""
    return Done(f"/jobs/{asked.history.put_backup()}", "A backup is asked for.")


@pages.acts("/backup/verify", role=ADMINISTRATOR)
def verify(asked: Ask) -> Done:
    """Ask that all that is kept be checked now."""
    return Done(f"/jobs/{asked.history.put_check()}", "A check of all that is kept is asked for.")

"""Who is told of alarms; a trial message to each."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form

from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ADMINISTRATOR, Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/recipients")
def recipients(asked: Ask) -> Shown:
    """Who is told, by which channel; of a web address the host only."""
    found = asked.history.recipients()
    context = {"channels": found.channels, "active": [one.number for one in found.recipients if one.active]}
    return Shown("care/recipients.html.j2", view_of(found), context=context)


@pages.acts("/recipients", role=ADMINISTRATOR)
def add_recipient(
    asked: Ask,
    channel: Annotated[str, Form(max_length=20)],
    address: Annotated[str, Form(max_length=1000)],
    digest: Annotated[str, Form(max_length=5)] = "",
) -> Done:
    """Let somebody be told from now on; not in a file: pages write to no path that a visitor names."""
    if channel == "log" and address != "logging":
        raise InputError(
            "a file is entered on the command line of the server: elastogeo history recipient log PATH; here the address of "
            "the channel log is the word logging"
        )
    asked.history.add_recipient(channel, address.strip(), bool(digest))
    return Done("/recipients", "The recipient is kept. Send a trial message to see that it arrives.")


@pages.acts("/recipients/{key:int}/remove", role=ADMINISTRATOR)
def remove_recipient(asked: Ask, key: int) -> Done:
    """Tell somebody nothing more."""
    asked.history.remove_recipient(key)
    return Done("/recipients", "Nothing more is sent there.")


@pages.acts("/recipients/{key:int}/try", role=ADMINISTRATOR)
def try_recipient(asked: Ask, key: int) -> Done:
    """Send somebody a trial message now (half a minute at most)."""
    one = asked.history.try_recipient(key)
    return Done("/recipients", f"The trial message was taken by {one.channel}.")

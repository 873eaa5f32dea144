"""`elastogeo history recipient`: who is told of alarms."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def recipient(
    channel: Annotated[
        str, typer.Argument(metavar="[CHANNEL]", help="log, mail or webhook; without it, all are listed.")
    ] = "",
    address: Annotated[str, typer.Argument(metavar="[ADDRESS]", help="A file, a mail address, an https address.")] = "",
    digest: Annotated[bool, typer.Option("--digest/--no-digest", help="Whether the weekly digest goes there too.")] = True,
    remove: Annotated[bool, typer.Option("--remove", help="Tell nothing more there.")] = False,
    trial: Annotated[bool, typer.Option("--try", help="Send a trial message there now, and change nothing.")] = False,
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Enter who is told of alarms, or list them.

    The mail server is taken from ELASTOGEO_SMTP_HOST, ELASTOGEO_SMTP_FROM and, if it wants them, ELASTOGEO_SMTP_USER and
    ELASTOGEO_SMTP_PASSWORD; webhooks are signed with ELASTOGEO_WEBHOOK_SECRET.

    \b
    Examples:
      elastogeo history recipient mail maintenance@example.com
      elastogeo history recipient log /var/log/elastogeo-alarms.jsonl --no-digest
      elastogeo history recipient webhook https://example.com/alarms --try
      elastogeo history recipient
    """
    from elastogeo.cli import screen
    from elastogeo.history.alarms import add_recipient, recipients, remove_recipient, try_recipient

    if bool(channel) != bool(address):
        raise eg.InputError(
            "give a channel and an address, as: elastogeo history recipient mail name@example.com; or neither"
        )
    with eg.History(store, who=who) as history:
        if trial:
            try_recipient(channel, address)
            screen.say(f"A trial message was taken by {channel}.")
            return
        if not channel:
            found = recipients(history.store)
        elif remove:
            found = remove_recipient(history.store, channel, address, history.who)
        else:
            found = add_recipient(history.store, channel, address, history.who, digest)
    screen.show(found, None, as_json)

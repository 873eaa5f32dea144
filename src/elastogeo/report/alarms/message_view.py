"""Views of who is told and of what was sent, with `elastogeo.recipients/1` and `elastogeo.delivery/1`, their documents.

recipients : [{number, channel, address, digest, active, waiting}]; `waiting` counts messages that are not sent yet
channels : names of all that there are
tried : [{channel, address, subject, error, again_at}]; `error` is null where the message was taken
waiting, silenced : messages that are still to be sent, and how many of them a silence holds
judged : series judged anew because the wait for a repeat was over
"""

from __future__ import annotations

from elastogeo.changes.alarms import Delivered, Delivery, Recipients
from elastogeo.report.alarms.words import counted
from elastogeo.report.days import date_said, iso_date, moment_said
from elastogeo.report.document import document
from elastogeo.report.view import Section, Table, View, views

RECIPIENTS = "elastogeo.recipients/1"
DELIVERY = "elastogeo.delivery/1"


@views(Recipients)
def recipients_view(result: Recipients) -> View:
    """Who is told, by which channel."""
    active = [one for one in result.recipients if one.active]
    entries = [
        {
            "number": one.number,
            "channel": one.channel,
            "address": one.address,
            "digest": one.digest,
            "active": one.active,
            "waiting": one.waiting,
        }
        for one in result.recipients
    ]
    table = Table(
        ("Channel", "Address", "Digest", "Told", "Waiting"),
        tuple(
            (
                one.channel,
                one.address,
                "weekly" if one.digest else "no",
                "yes" if one.active else "no more",
                str(one.waiting),
            )
            for one in result.recipients
        ),
        words=(0, 1, 2, 3),
        name="recipients",
        keys=tuple(one.number for one in result.recipients),
    )
    return View(
        kind="Recipients",
        title="alarms",
        origin="",
        head=(("Channels", ", ".join(result.channels)),),
        sentence=f"{counted(len(active), 'recipient').capitalize()} of alarms." if active else "Nobody is told of alarms.",
        document=document(RECIPIENTS, {"recipients": entries, "channels": list(result.channels)}),
        rows=entries,
        tables=(table,) if entries else (),
        sections=(Section("Recipients", tables=(table,)),) if entries else (),
        advice=() if active else (f"Enter somebody: elastogeo history recipient {result.channels[0]} ADDRESS",),
    )


@views(Delivery)
def delivery_view(result: Delivery) -> View:
    """What one round of sending did."""
    entries = [
        {
            "channel": one.channel,
            "address": one.address,
            "subject": one.subject,
            "error": one.error or None,
            "again_at": iso_date(one.again_at),
        }
        for one in result.tried
    ]
    found = {
        "now": iso_date(result.now),
        "tried": entries,
        "waiting": result.waiting,
        "silenced": result.silenced,
        "judged": list(result.judged),
    }
    table = Table(
        ("By", "To", "Message", "What became of it"),
        tuple((one.channel, one.address, one.subject, _became(one)) for one in result.tried),
        words=(0, 1, 2, 3),
    )
    return View(
        kind="Delivery",
        title=date_said(result.now),
        origin="",
        sentence=_answer(result),
        document=document(DELIVERY, found),
        rows=entries,
        tables=(table,) if entries else (),
        sections=(Section("Messages", tables=(table,)),) if entries else (),
    )


def _became(one: Delivered) -> str:
    if not one.error:
        return "sent"
    return f"given up: {one.error}" if one.again_at is None else f"again at {moment_said(one.again_at)}: {one.error}"


def _answer(result: Delivery) -> str:
    sent = sum(not one.error for one in result.tried)
    failed = len(result.tried) - sent
    parts = [f"{counted(sent, 'message')} sent"]
    if failed:
        parts.append(f"{failed} not taken")
    if result.waiting:
        held = f", {result.silenced} of them silenced" if result.silenced else ""
        parts.append(f"{result.waiting} waiting{held}")
    if result.judged:
        parts.append(f"{len(result.judged)} series judged anew")
    text = "; ".join(parts)
    return f"{text[:1].upper()}{text[1:]}."

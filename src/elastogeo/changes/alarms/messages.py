"""Whom alarms tell, and what became of the messages."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Recipient(Part):
    """Who is told.

    Attributes
    ----------
    number : int
    channel, address : str
    digest : bool
        Whether he gets the weekly digest too.
    active : bool
    waiting : int
        Messages that are not sent yet.
    """

    number: int
    channel: str
    address: str
    digest: bool
    active: bool
    waiting: int = 0


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Recipients(Result):
    """All who are told.

    Attributes
    ----------
    recipients : tuple of Recipient
    channels : tuple of str
        That there are.
    """

    recipients: tuple[Recipient, ...]
    channels: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Delivered(Part):
    """One try to send a message.

    Attributes
    ----------
    channel, address, subject : str
    error : str
        Why it was not taken; empty if it was.
    again_at : float or None [d]
        When it is tried again; None if it was taken, or given up.
    """

    channel: str
    address: str
    subject: str
    error: str = ""
    again_at: float | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Delivery(Result):
    """What one round of sending did.

    Attributes
    ----------
    now : float [d]
    tried : tuple of Delivered
    waiting : int
        Messages that are still to be sent, silenced ones included.
    silenced : int
        Of these, how many a silence holds.
    judged : tuple of str
        Series that were judged anew because the wait for a repeat was over.
    """

    now: float
    tried: tuple[Delivered, ...]
    waiting: int
    silenced: int = 0
    judged: tuple[str, ...] = ()

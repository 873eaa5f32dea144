'''Channels: how a message reaches a person.

To add one, write one file in the folder `channels`. It is found and registered by itself, and the contract tests in
`tests/history/alarms/test_channels.py` run on it at once. A complete one, `channels/toy.py`::

    """The toy channel: a file for each message, in a folder."""

    from pathlib import Path

    from elastogeo.errors import DeliveryError, InputError
    from elastogeo.history.alarms.channels.channel import Channel, register


    def check(address, settings):
        if not Path(address).is_absolute():
            raise InputError(f"{address!r} is no folder from the root; give it in full")


    def send(message, address, settings):
        try:
            (Path(address) / f"{message.key}.txt").write_text(message.text, encoding="utf-8")
        except OSError as error:
            raise DeliveryError(f"{address}: {error.strerror}") from None


    register(Channel("toy", check, send, sample="/tmp"))

What the contract asks:

* `check` refuses with an `InputError` what is no address of the channel: a person sees it when he enters a recipient;
* `send` returns when the receiver has taken the message, within a minute, or raises a `DeliveryError`: it is tried again
  later unless the error is `lasting`. The same message may come twice (a crash between sending and noting it), so `send`
  hands on `message.key`, by which a receiver knows it again;
* passwords and secrets come from `settings`, the environment's variables, never from the address; no error shows them.
'''

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from elastogeo.discovery import import_all
from elastogeo.errors import SelectionError

Settings = Mapping[str, str]
"""The environment's variables."""


@dataclass(frozen=True, slots=True)
class Message:
    """What a recipient is told.

    Attributes
    ----------
    key : str
        The same whenever the same message is sent, and of no other: a receiver that has it already may drop it.
    subject : str
        One line.
    text : str
        For a person.
    document : mapping
        The same for a program.
    """

    key: str
    subject: str
    text: str
    document: Mapping[str, Any] = field(default_factory=dict)

    def as_json(self) -> dict[str, Any]:
        """All of it as one JSON object."""
        own = {"schema": "elastogeo.message/1", "key": self.key, "subject": self.subject, "text": self.text}
        return own | {"content": dict(self.document)}


@dataclass(frozen=True, slots=True)
class Channel:
    """A way to send messages.

    Attributes
    ----------
    name : str
    check : callable
        `check(address, settings)` raises `InputError` if a message cannot be sent there.
    send : callable
        `send(message, address, settings)` returns once it is taken, else raises `DeliveryError`.
    sample : str
        An address that `check` takes.
    """

    name: str
    check: Callable[[str, Settings], None]
    send: Callable[[Message, str, Settings], None]
    sample: str


_CHANNELS: dict[str, Channel] = {}


def register(made: Channel) -> None:
    """Add a channel."""
    _CHANNELS[made.name] = made


def channels() -> tuple[Channel, ...]:
    """All channels, by name."""
    import_all(__name__.rpartition(".")[0])
    return tuple(_CHANNELS[name] for name in sorted(_CHANNELS))


def channel(name: str) -> Channel:
    """The channel of a name.

    Raises
    ------
    SelectionError
        If there is none.
    """
    known = {made.name: made for made in channels()}
    if name not in known:
        raise SelectionError(f"there is no channel {name!r}; there are {', '.join(known)}")
    return known[name]

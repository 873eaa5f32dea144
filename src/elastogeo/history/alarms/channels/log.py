"""The channel `log`: a line of JSON a message, at the end of a file, or to the program's own log.

The address is the full path of a file, or `logging` for the logger `elastogeo.alarms` of the standard library.
"""

from __future__ import annotations

import json
import logging
import os
from pathlib import Path

from elastogeo.errors import DeliveryError, InputError
from elastogeo.history.alarms.channels.channel import Channel, Message, Settings, register

LOGGER = "elastogeo.alarms"


def check(address: str, settings: Settings) -> None:  # noqa: ARG001
    """Refuse what is neither `logging` nor the full path of a file in a folder that exists."""
    if address == "logging":
        return
    path = Path(address)
    if not path.is_absolute() or "\0" in address:
        raise InputError(f"{address!r} is no full path of a file; give one, as /var/log/alarms.jsonl, or the word logging")
    if path.is_dir() or not path.parent.is_dir():
        raise InputError(f"{address}: is a folder, or lies in none that exists; name a file in a folder that does")


def send(message: Message, address: str, settings: Settings) -> None:  # noqa: ARG001
    """Write the line and have it on the disk."""
    line = json.dumps(message.as_json(), ensure_ascii=True)
    if address == "logging":
        logging.getLogger(LOGGER).warning("%s", line)
        return
    try:
        handle = os.open(address, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o640)
        try:
            os.write(handle, f"{line}\n".encode())  # one call: lines of two processes do not mix
            os.fsync(handle)
        finally:
            os.close(handle)
    except OSError as error:
        raise DeliveryError(f"{address}: {error.strerror}") from None


register(Channel("log", check, send, sample="logging"))

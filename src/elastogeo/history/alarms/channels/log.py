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
    if not path.is_absolute() or not address.isprintable() or address.endswith(("/", os.sep)):
        raise InputError(f"{address!r} is no full path of a file; give one, as /var/log/alarms.jsonl, or the word logging")
    try:
        there = path.parent.is_dir() and (path.is_file() or not path.exists())
    except OSError as error:
        raise InputError(f"{address[:80]!r} cannot be the name of a file: {error.strerror}; give another") from None
    if not there:
        raise InputError(f"{address}: is no file, or lies in no folder that exists; name a file in a folder that does")
    if not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"{address}: this program may not write there; give another file, or the right to write it")


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

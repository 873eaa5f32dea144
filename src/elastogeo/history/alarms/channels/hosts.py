"""Names of hosts: what a name server can be asked for (RFC 1123, 2.1)."""

from __future__ import annotations

import re

_LABEL = re.compile(r"[a-z0-9_](?:[a-z0-9_-]{0,61}[a-z0-9_])?", re.IGNORECASE)
_NUMBER = re.compile(r"\d+|0x[0-9a-f]*", re.IGNORECASE)
LONGEST = 253
"""Characters of a name."""


def is_host(name: str) -> bool:
    """Whether it is a name that can be looked up; the last label of a name is no number, that of an address is."""
    if not name.isascii() or len(name) > LONGEST:
        return False
    *_, last = labels = name.split(".")
    return all(_LABEL.fullmatch(label) for label in labels) and not _NUMBER.fullmatch(last)


def is_of_this_computer(name: str) -> bool:
    """Whether a name means the computer itself, whoever asks (RFC 6761, 6.3)."""
    return name.lower() == "localhost" or name.lower().endswith(".localhost")

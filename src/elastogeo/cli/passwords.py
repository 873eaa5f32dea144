"""A password from a person, unseen, or from a program by standard input; never from an argument."""

from __future__ import annotations

import getpass
import sys

from elastogeo.errors import InputError


def asked_password(prompt: str) -> str:
    """Ask twice at a terminal; else read one line.

    Raises
    ------
    InputError
        If the two differ, or there is no line.
    """
    if not sys.stdin.isatty():
        line = sys.stdin.readline()
        if not line.strip("\r\n"):
            raise InputError("no password arrived; type it at a terminal, or send it as one line on standard input")
        return line.rstrip("\r\n")
    first = getpass.getpass(f"{prompt}: ")
    if first != getpass.getpass("Once more: "):
        raise InputError("the two passwords differ; nothing was changed")
    return first

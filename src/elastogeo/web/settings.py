"""What a person decides about the pages when they are started."""

from __future__ import annotations

import re
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path

from elastogeo.errors import InputError

_PREFIX = re.compile(r"(/[\w~-][\w.~-]*)*", re.ASCII)
"""Segments that every proxy and every cookie passes on as they are."""
LOOPBACK = ("localhost", "127.0.0.1", "::1")
"""Names of this computer, which no other can reach."""


@dataclass(frozen=True, slots=True)
class Settings:
    """Where the pages are, of which history, and who may come in.

    Attributes
    ----------
    store : str or Path
        The history: a file of SQLite, or `postgresql://user@host/database`.
    files : str or Path or None
        The folder of its raw files, where it is not beside it.
    host, port : str, int
        Where it listens. Other computers reach it only by another host than the loopback.
    prefix : str
        Of its addresses behind a proxy: `/elastogeo`; stripped by the proxy or not.
    accounts : bool
        Whether a person must log in; always so when other computers reach it.
    hosts : tuple of str
        Names beside those of this computer by which a browser may call it.
    behind_https : bool
        Whether a proxy in front speaks https.
    worker : bool
        Whether it starts the worker of long tasks, or another service does.
    demo : bool
        Whether an empty history is filled with the simulated fleet.
    who : str
        In whose name things are done without accounts.

    Raises
    ------
    InputError
        If the prefix is no path of an address.
    """

    store: str | Path
    files: str | Path | None = None
    host: str = "127.0.0.1"
    port: int = 8347
    prefix: str = ""
    accounts: bool = False
    hosts: tuple[str, ...] = ()
    behind_https: bool = False
    worker: bool = True
    demo: bool = False
    who: str = ""

    def __post_init__(self) -> None:
        if not _PREFIX.fullmatch(self.prefix):
            raise InputError(
                f"the prefix {self.prefix!r} is no beginning of an address; give letters, digits, '-', '_' and '.' "
                "between slashes, such as /elastogeo"
            )

    @property
    def is_reachable(self) -> bool:
        """Whether other computers may reach it: by its address, or by a proxy in front of it."""
        return not self.is_local or bool(self.hosts) or self.behind_https

    @property
    def is_local(self) -> bool:
        """Whether only this computer can reach it."""
        if self.host in LOOPBACK:
            return True
        try:
            return ip_address(self.host).is_loopback
        except ValueError:
            return False

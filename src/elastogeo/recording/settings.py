"""What to record: a server, its nodes, and how. From the command line or a TOML file; passwords are in neither."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import urlsplit

from elastogeo.errors import InputError
from elastogeo.formats.text import UNITS, build, read_document, spellings
from elastogeo.machine import Time

_NODE = re.compile(r"(ns=\d+;)?[isgb]=.+", re.DOTALL)
_NAMED = re.compile(r"(?P<name>[^=\[\]]+)(\[(?P<unit>[^\[\]]*)\])?\s*=\s*(?P<node>.+)", re.DOTALL)
_WAIT = 10.0
_LEAST_QUEUE, _MOST_QUEUE = 100, 10_000


@dataclass(frozen=True, slots=True)
class RecordedNode:
    """One signal to record.

    Attributes
    ----------
    name : str
        The channel's name in the recording.
    node : str
        The node's address in OPC UA's notation: `ns=2;s=Axis.X.Current`.
    unit : str
        One of `elastogeo.formats.text.units.UNITS`; empty if the signal has none.
    """

    name: str
    node: str
    unit: str = ""

    def __post_init__(self) -> None:
        """Refuse what could not be recorded."""
        if not self.name.strip():
            raise InputError(f"the channel of node {self.node!r} has no name; give it one")
        if not _NODE.fullmatch(self.node):
            raise InputError(f"channel {self.name!r}: {self.node!r} is no node; write it as ns=2;s=Axis.X.Current")
        if self.unit and self.unit not in UNITS:
            raise InputError(f"channel {self.name!r}: the unit {self.unit!r} is not known; use {spellings()}")


@dataclass(frozen=True, slots=True)
class RecordingPlan:
    """A recording as it is asked for.

    Attributes
    ----------
    server : str
        Address of the OPC UA server: `opc.tcp://host:4840`; no user or password in it.
    channel : tuple of RecordedNode
        What to record; no name and no node twice.
    sampling : float [s]
        Interval in which the server is asked to sample; 0: as fast as it can.
    publishing : float [s]
        Interval in which the server is asked to send what it sampled.
    queue : int
        Samples of each node that the server is asked to keep until they are sent; 0: those of ten seconds.
    batch : float [s]
        A part is written at least so often while samples arrive.
    backlog : int
        Samples that may wait for the disk; what arrives beyond is lost, and marked.
    timeout : float [s]
        Without an answer for so long, the server is taken for dead.
    longest_pause : float [s]
        Between two attempts to connect again.
    user : str
        Empty: anonymous.
    security : str
        `Policy,Mode,certificate,key` or `Policy,Mode,certificate,key,server_certificate`, as asyncua takes it; empty: none.
    """

    server: str
    channel: tuple[RecordedNode, ...]
    sampling: Time = 0.1
    publishing: Time = 0.25
    queue: int = 0
    batch: Time = 5.0
    backlog: int = 1_000_000
    timeout: Time = 5.0
    longest_pause: Time = 30.0
    user: str = ""
    security: str = ""

    def __post_init__(self) -> None:
        """Refuse what could not be recorded."""
        check_server(self.server)
        if not self.channel:
            raise InputError(
                "no node is named, so there is nothing to record; name one: -n 'current[A]=ns=2;s=Axis.X.Current'"
            )
        for what, spelled in (("channel", [c.name for c in self.channel]), ("node", [c.node for c in self.channel])):
            twice = sorted({one for one in spelled if spelled.count(one) > 1})
            if twice:
                raise InputError(f"{what} {twice[0]!r} is named twice; record it once")
        if not 0 <= self.sampling <= 3600:
            raise InputError(f"the sampling interval is {self.sampling:g} s; choose one from 0 to 3600 s")
        for name in ("publishing", "batch", "timeout", "longest_pause"):
            if not 0.01 <= getattr(self, name) <= 3600:
                raise InputError(f"{name} is {getattr(self, name):g} s; choose one from 0.01 to 3600 s")
        if not 0 <= self.queue <= 1_000_000 or not 1000 <= self.backlog <= 100_000_000:
            raise InputError(
                f"a queue of {self.queue} and a backlog of {self.backlog} samples does not work; choose a queue up to "
                f"1000000 and a backlog from 1000 to 100000000"
            )
        if "::" in self.security:
            raise InputError("the security string holds a password (::); put it in ELASTOGEO_OPCUA_KEY_PASSWORD instead")
        if self.security and not 4 <= len(self.security.split(",")) <= 5:
            raise InputError(
                f"the security string {self.security!r} is not Policy,Mode,certificate,key[,server_certificate]"
            )

    @property
    def queue_size(self) -> int:
        """Samples of each node that the server is asked to keep."""
        if self.queue:
            return self.queue
        return int(min(_MOST_QUEUE, max(_LEAST_QUEUE, _WAIT / self.sampling if self.sampling else _MOST_QUEUE)))


def check_server(server: str) -> None:
    """Refuse an address that is none of an OPC UA server, or holds a password.

    Raises
    ------
    InputError
    """
    try:
        parts = urlsplit(server)
        host = parts.hostname if parts.port != 0 else None
    except ValueError:
        parts, host = urlsplit(""), None
    if parts.scheme != "opc.tcp" or not host:
        raise InputError(f"{server.rpartition('@')[2]!r} is no address of an OPC UA server; write it as opc.tcp://host:4840")
    if parts.username is not None or parts.password is not None:
        raise InputError(
            "the address of the server holds a user or a password; give the user by --user, the password is asked"
        )


def read_plan(path: Path) -> RecordingPlan:
    """What a recording file asks for.

    Raises
    ------
    FormatError
        With everything that is wrong with the file.
    """
    return build(RecordingPlan, read_document(path), str(path))


def named_nodes(texts: Sequence[str]) -> tuple[RecordedNode, ...]:
    """Nodes as the command line names them: `ns=2;s=X`, `position=ns=2;s=X` or `position[mm]=ns=2;s=X`.

    Raises
    ------
    InputError
        If one cannot be understood.
    """
    nodes = []
    for text in texts:
        named = None if _NODE.fullmatch(text) else _NAMED.fullmatch(text)
        if named:
            nodes.append(RecordedNode(named["name"].strip(), named["node"].strip(), (named["unit"] or "").strip()))
        else:
            nodes.append(RecordedNode(text, text))
    return tuple(nodes)


def planned(server: str, nodes: Sequence[str] = (), **changes: object) -> RecordingPlan:
    """What a command line asks for.

    Parameters
    ----------
    server : str
        Address of a server, or the path of a recording file.
    nodes : sequence of str
        As `named_nodes`; with a recording file, in place of those that it names.
    **changes
        Fields of `RecordingPlan` that are given; None: not given.

    Raises
    ------
    InputError
        If a setting is not valid.
    """
    given = {name: value for name, value in changes.items() if value is not None}
    if nodes:
        given["channel"] = named_nodes(nodes)
    if "://" in server:
        return RecordingPlan(server, **{"channel": (), **given})  # type: ignore[arg-type]
    return replace(read_plan(Path(server)), **given)  # type: ignore[arg-type]

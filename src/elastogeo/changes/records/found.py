"""What a search of a history found."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part, Result

FOUND_KINDS = ("machines", "series", "tests", "instruments", "events")
"""Kinds of what is found, in the order in which they are shown."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FoundEntry(Part):
    """One thing that was found.

    Attributes
    ----------
    kind : str
        One of `FOUND_KINDS`.
    key : int
    name, about : str
        What it is called, and what else is said of it.
    machine : int or None
        Key of the machine it belongs to; None if it belongs to none.
    date : float or None [d]
    """

    kind: str
    key: int
    name: str
    about: str = ""
    machine: int | None = None
    date: float | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Found(Result):
    """What has some words in what is said of it.

    Attributes
    ----------
    words : str
    entries : tuple of FoundEntry
        By kind, in the order of `FOUND_KINDS`; tests and events the newest first.
    more : tuple of str
        Kinds of which there are more than are in `entries`.
    """

    words: str
    entries: tuple[FoundEntry, ...]
    more: tuple[str, ...] = ()

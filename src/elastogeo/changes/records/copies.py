"""Copies of a history, and checks of it, as its audit trail knows them."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptCopy(Part):
    """A backup that was made.

    Attributes
    ----------
    at : float [d]
    who : str
    place : str
        The folder, where it was then.
    rows, files, size : int
        Of the database; raw files, and their size [bytes].
    wrong : tuple of str
        Checks that the history did not pass then.
    """

    at: float
    who: str
    place: str
    rows: int
    files: int
    size: int
    wrong: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptCheck(Part):
    """A check of all that a history keeps.

    Attributes
    ----------
    at : float [d]
    who : str
    rows, files : int
        That were read.
    faults : int
    first : tuple of str
        The first of them, by name.
    """

    at: float
    who: str
    rows: int
    files: int
    faults: int
    first: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptCopies(Result):
    """The backups of a history, and when it was checked.

    Attributes
    ----------
    store : str
    now : float [d]
    folder : str
        In which the pages make backups; empty if none is set.
    copies : tuple of KeptCopy
        The last ones, the last first.
    checks : tuple of KeptCheck
        The last ones, the last first.
    """

    store: str
    now: float
    folder: str
    copies: tuple[KeptCopy, ...]
    checks: tuple[KeptCheck, ...]

"""What lets somebody in stays where it is.

No copy holds sessions. An export, which any program reads and which may go to others, holds neither tokens nor what is kept
of passwords: where it is restored, each password is set anew. A backup has those, so that a shop works on after it.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Omitted:
    """What a copy leaves out.

    Attributes
    ----------
    tables : frozenset of str
        Of which it has no row.
    columns : dict of str to frozenset of str
        By table, what is empty in every row.
    """

    tables: frozenset[str]
    columns: dict[str, frozenset[str]]


BACKUP = Omitted(frozenset({"session"}), {})
EXPORT = Omitted(frozenset({"session", "token"}), {"account": frozenset({"password"})})

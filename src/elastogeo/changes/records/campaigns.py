"""Campaigns that a history keeps: which tests were asked together, and what they said."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from elastogeo.changes.records.recomputed import Differing
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptCampaign(Result):
    """Tests of one machine that are kept as a set, and what they say together.

    Attributes
    ----------
    key : int
    machine, name : str
    made_at : float [d]
    software : str
        Version that identified them.
    tests : dict of str to int
        Keys of the tests by their names in the campaign.
    supported : bool
        Whether the data support what was asked.
    error : str
        Why there is no document; empty if there is one.
    document : dict or None
        Of the view of what they say together: `elastogeo.identification/1`.
    same_bits : bool or None
        Whether computing it again gave the same document to the last bit; None if it was not computed again, or by another
        version.
    differing : tuple of Differing
        What differed beyond the tolerance.
    """

    key: int
    machine: str
    name: str
    made_at: float
    software: str
    tests: dict[str, int]
    supported: bool
    error: str
    document: dict[str, Any] | None
    same_bits: bool | None = None
    differing: tuple[Differing, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptCampaigns(Result):
    """The campaigns that a history keeps, of one machine or of all, in the order in which they were kept.

    Attributes
    ----------
    store : str
    machine : str
        Empty: of all.
    campaigns : tuple of KeptCampaign
    """

    store: str
    machine: str
    campaigns: tuple[KeptCampaign, ...]

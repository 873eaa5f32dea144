"""A check: one named point of a verdict."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Check:
    """One check of the verdict; if a decisive one fails, the data do not support what was asked."""

    name: str
    passed: bool
    sentence: str
    decisive: bool = False

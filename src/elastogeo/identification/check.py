"""A check: one named point of a verdict, with its facts as numbers. `report` makes the sentence of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from elastogeo.result import Part


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Check(Part):
    """One check of a verdict.

    Attributes
    ----------
    name : str
        A constant that reads right with either mark: `model adequate`, not `model is adequate` or `bad model`.
    passed : bool or None
        None if it was not tested; the facts then say why.
    facts : mapping of str to number, str, None, or tuple or mapping of these
        What was found, in mm, N, rad, s; names of parameters, runs and instruments. No sentence, no unit, nothing rounded.
    decisive : bool
        Whether the data do not support what was asked if it fails.
    """

    name: str
    passed: bool | None
    facts: Mapping[str, Any] = field(default_factory=dict)
    decisive: bool = False

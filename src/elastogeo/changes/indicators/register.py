'''The register of what is watched of each kind of result: found and registered by themselves, in every file of this wing.

To watch another kind of result, write one file with a function that registers itself. Nothing else changes: `history` keeps
what it gives, the charts judge it. A complete one, `dial_gauge.py`::

    """Of a dial gauge: how far the spindle runs out."""

    from dataclasses import dataclass

    from elastogeo.changes import KINDS, Indicator
    from elastogeo.changes.indicators import indicates
    from elastogeo.result import Result


    @dataclass(frozen=True)
    class RunOut(Result):
        value: float
        scatter: float


    @indicates(RunOut)
    def of_a_run_out(result):
        return (Indicator("run-out of the spindle", KINDS["straightness"], result.value, result.scatter),)

What the contract asks: at most `MOST` indicators, the most important first, in an order that never depends on the values;
each by itself determined by the test, so **never a parameter that is one of a sum**; a name that a metrologist says. What a
test does not determine is left out, not guessed.
'''

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from elastogeo.changes.series import MOST, Indicator
from elastogeo.discovery import import_all
from elastogeo.errors import UnsupportedError
from elastogeo.result import Result

R = TypeVar("R", bound=Result)
Indicating = Callable[[R], tuple[Indicator, ...]]

_REGISTER: dict[type[Result], Indicating[Any]] = {}


def indicates(kind: type[R]) -> Callable[[Indicating[R]], Indicating[R]]:
    """Register what is watched of one kind of result."""

    def registered(indicating: Indicating[R]) -> Indicating[R]:
        _REGISTER[kind] = indicating
        return indicating

    return registered


def watched() -> dict[type[Result], Indicating[Any]]:
    """What is watched, by kind of result; every file of this wing is looked at."""
    import_all(__name__.rpartition(".")[0])
    return dict(_REGISTER)


def indicators_of(result: Result) -> tuple[Indicator, ...]:
    """What a result says of a few named indicators, at most eight, the most important first.

    Raises
    ------
    UnsupportedError
        If nothing is watched of such a result.
    """
    of = watched()
    if type(result) not in of:
        known = ", ".join(sorted(kind.__name__ for kind in of))
        raise UnsupportedError(
            f"nothing is watched of {type(result).__name__}; a history takes {known}. "
            f"To watch another kind of result, write a file in changes/indicators"
        )
    return of[type(result)](result)[:MOST]

"""The life of an alarm: what the charts say and what has happened so far -> the steps that it takes now. Pure.

quiet -> (suspect: only the tester knows) -> open -> worse, acknowledged -> closed by a person, as repaired or as false. A
series has one open alarm; further indicators join it. Charts that turn quiet again close nothing: a person does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any

from elastogeo.changes.alarms import ACKNOWLEDGED, CLOSED, HELD, OPEN, RELEASED, WORSE

WORSE_BY = 0.5
"""Limits by which an indicator must grow beyond what was last recorded of it, for the alarm to be worse."""


@dataclass(frozen=True, slots=True)
class Step:
    """A step that an alarm takes or has taken.

    Attributes
    ----------
    state : str
        `OPEN`, `WORSE`, `HELD`, `RELEASED`, `ACKNOWLEDGED`, `REPAIRED` or `FALSE`.
    facts : mapping
        `over` and `size`: by indicator, how many limits it was away at this step, as in `Found`.
    test : int or None
        Key of the test that caused it; None for a person's step.
    at : datetime or None
        When it was taken; None while it is only proposed.
    who, why : str
        Of a person's step.
    """

    state: str
    facts: Mapping[str, Any] = field(default_factory=dict)
    test: int | None = None
    at: datetime | None = None
    who: str = ""
    why: str = ""


@dataclass(frozen=True, slots=True)
class Found:
    """What the charts of a series say at their last test.

    Attributes
    ----------
    alarming : bool
        Whether its state is an alarm: confirmed, or not confirmed within the wait.
    over : mapping of str to float
        By indicator that is part of the alarm, how many limits it is away at the last test, in either chart.
    size : mapping of str to float
        The same in the chart of single tests: the running mean of a change that stays grows more certain, not larger.
    sure : mapping of str to float
        As `size`, without what one test alone says: the last test or the one before, whichever is nearer to the baseline;
        once the wait for a repeat is over, the last test.
    test : int or None
        Key of the last judged test.
    measured : datetime or None
        When that was made.
    confirmed : bool
        Whether a second test shows the change as well.
    """

    alarming: bool
    over: Mapping[str, float] = field(default_factory=dict)
    size: Mapping[str, float] = field(default_factory=dict)
    sure: Mapping[str, float] = field(default_factory=dict)
    test: int | None = None
    measured: datetime | None = None
    confirmed: bool = False

    @property
    def shown(self) -> bool:
        """Whether the last test itself still shows the change; a state stays an alarm until a person closes it."""
        return any(ratio >= 1 for ratio in self.over.values())


def is_open(steps: Sequence[Step]) -> bool:
    """Whether an alarm with these steps still waits for a person to close it."""
    return bool(steps) and steps[-1].state not in CLOSED


def is_held(steps: Sequence[Step]) -> bool:
    """Whether the alarm of an instrument holds it back."""
    last = [step.state for step in steps if step.state in (HELD, RELEASED)]
    return last[-1:] == [HELD]


def is_acknowledged(steps: Sequence[Step]) -> bool:
    """Whether a person knows of it as it is now: it has not become worse since."""
    told = [step.state for step in steps if step.state in (OPEN, WORSE, ACKNOWLEDGED)]
    return is_open(steps) and told[-1:] == [ACKNOWLEDGED]


def recorded(steps: Iterable[Step], what: str = "over") -> dict[str, float]:
    """The most that the steps say of each indicator, in limits; `what`: `over` or `size`."""
    most: dict[str, float] = {}
    for step in steps:
        for name, ratio in step.facts.get(what, {}).items():
            most[name] = max(most.get(name, 0.0), float(ratio))
    return most


def steps_of(found: Found, alarm: Sequence[Step] = (), cleared: datetime | None = None) -> tuple[Step, ...]:
    """The steps that a verdict adds to the alarm of its series: none, one that opens it, or one that makes it worse.

    Parameters
    ----------
    found : Found
        What the charts say now.
    alarm : sequence of Step
        Of the alarm that is open, oldest first; empty if none is.
    cleared : datetime or None
        When the last of the tests that the series had when its last alarm was closed was measured: these open no other.

    Returns
    -------
    tuple of Step
        The same verdict again gives none: what is recorded is not told twice.
    """
    if not found.alarming:
        return ()
    facts = {"over": dict(found.over), "size": dict(found.size), "confirmed": found.confirmed}
    if not is_open(alarm):
        if cleared is not None and (found.measured is None or found.measured <= cleared):
            return ()
        return (Step(OPEN, facts, found.test),)
    before = recorded(alarm, "size")
    grown = sorted(name for name, ratio in found.sure.items() if ratio >= max(before.get(name, 1.0), 1.0) + WORSE_BY)
    return (Step(WORSE, facts | {"grown": grown}, found.test),) if grown else ()

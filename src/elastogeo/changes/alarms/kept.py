"""One alarm with all that happened to it: its steps, and what became of its messages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from elastogeo.changes.alarms.standing import AlarmRow
from elastogeo.changes.alarms.steps import CLOSED
from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AlarmStep(Part):
    """One thing that happened to an alarm.

    Attributes
    ----------
    state : str
        `OPEN`, `WORSE`, `HELD`, `RELEASED`, `ACKNOWLEDGED` or one of `CLOSED`.
    at : float [d]
    who, why : str
        Of a person's step.
    test : int or None
        Key of the test that caused it.
    over : mapping of str to float
        By indicator, how many limits it was away from the baseline then.
    """

    state: str
    at: float
    who: str = ""
    why: str = ""
    test: int | None = None
    over: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AlarmMessage(Part):
    """What one recipient was told of an alarm.

    Attributes
    ----------
    step : str
        That it told of.
    channel, address : str
        Without what may be a secret in it.
    state : str
        `waiting`, `sent` or `given up`.
    made : float [d]
    sent : float or None [d]
    tries : int
    error : str
        Of the last try; or why it was given up.
    """

    step: str
    channel: str
    address: str
    state: str
    made: float
    sent: float | None
    tries: int
    error: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptAlarm(Result):
    """One alarm.

    Attributes
    ----------
    now : float [d]
    row : AlarmRow
        How it stands.
    steps : tuple of AlarmStep
        Oldest first.
    messages : tuple of AlarmMessage
        Oldest first.
    """

    now: float
    row: AlarmRow
    steps: tuple[AlarmStep, ...]
    messages: tuple[AlarmMessage, ...]

    @property
    def is_open(self) -> bool:
        """Whether it waits for a person to close it."""
        return self.row.state not in CLOSED

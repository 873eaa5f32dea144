"""What is told, and when: which tests are news, and which step of an alarm makes a message. Pure.

`docs/decisions` says why. Opening, becoming worse and being released are told once, if a live test or a person caused
them, and the end to whoever was told of the beginning. Imports of old tests and re-analysis tell nobody.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta

from elastogeo.changes.alarms import OPEN, RELEASED, WORSE
from elastogeo.history.alarms.life import Found, Step, is_acknowledged, is_held, is_open

FRESH = timedelta(days=7)
"""A test that was measured longer before its import is an old one."""
AHEAD = timedelta(days=1)
"""A test that is dated further after its import has a wrong clock: zones and a slow clock explain less than a day."""


def is_live(measured: datetime, imported: datetime, fresh: timedelta = FRESH) -> bool:
    """Whether a test is news when it is imported: neither from the archive nor from the future.

    Both times are of the test's own row, so that the answer is the same whenever it is asked. The order of the tests does
    not count: of two tests of one day the earlier may come later, and both are news.
    """
    return -AHEAD <= imported - measured <= fresh


def news(before: Sequence[Step], taken: Sequence[Step], found: Found, live: bool, told: bool) -> int | None:
    """The step of an alarm that is told now that its series was assessed: its place among all; None if none is.

    Parameters
    ----------
    before, taken : sequence of Step
        Of the open alarm: those that it had, and those that it takes now.
    found : Found
        What the charts say now.
    live : bool
        Whether a live test, or the end of the wait for its repeat, is the cause; not for old tests and re-analysis.
    told : bool
        Whether a message of this alarm was ever made.

    Notes
    -----
    An alarm that old tests or a re-analysis opened is told with the first live test that still shows it.
    """
    steps = (*before, *taken)
    if not live or not found.alarming or not is_open(steps) or is_held(steps):
        return None
    if taken:
        return len(steps) - 1
    if told or is_acknowledged(steps) or not found.shown:
        return None
    return max(place for place, step in enumerate(steps) if step.state in (OPEN, WORSE, RELEASED))

"""Due dates: a pure function of dates, right at its edges."""

from math import inf, nan

import pytest

from elastogeo.changes import DUE, NEVER_TESTED, NOT_ASKED, NOT_DUE, OVERDUE, due_after, due_on
from elastogeo.errors import InputError

DAY = 20_000.0
SECOND = 1 / 86_400


@pytest.mark.parametrize(
    ("now", "state", "overdue"),
    [
        (DAY, NOT_DUE, 0.0),
        (DAY + 28 - SECOND, NOT_DUE, 0.0),
        (DAY + 28, DUE, 0.0),
        (DAY + 35, DUE, 0.0),
        (DAY + 35 + SECOND, OVERDUE, SECOND),
        (DAY + 47, OVERDUE, 12.0),
    ],
)
def test_a_series_is_due_then_overdue(now: float, state: str, overdue: float) -> None:
    found = due_after(last=DAY, interval=28.0, grace=7.0, now=now)
    assert (found.at, found.state, found.is_late) == (DAY + 28, state, state == OVERDUE)
    assert found.overdue == pytest.approx(overdue, abs=1e-9)


def test_without_an_interval_nothing_is_ever_due() -> None:
    assert due_after(DAY, None, 7.0, DAY + 10_000).state == NOT_ASKED
    assert due_after(None, None, 7.0, DAY).at is None


def test_a_machine_that_was_never_tested_is_told_from_one_that_is_late() -> None:
    found = due_after(None, 28.0, 7.0, DAY + 10_000)
    assert (found.at, found.state, found.overdue) == (None, NEVER_TESTED, 0.0)


def test_a_test_dated_after_now_makes_nothing_due() -> None:
    """A clock that went back, or a control in another zone."""
    assert due_after(last=DAY + 1, interval=28.0, grace=0.0, now=DAY).state == NOT_DUE


def test_without_grace_the_due_day_itself_is_in_time() -> None:
    assert due_on(DAY, 0.0, DAY).state == DUE
    assert due_on(DAY, 0.0, DAY + SECOND).state == OVERDUE


@pytest.mark.parametrize("interval", [0.0, -28.0, nan, inf])
def test_an_interval_that_is_none_is_refused(interval: float) -> None:
    with pytest.raises(InputError, match="give a positive number, or none"):
        due_after(DAY, interval, 7.0, DAY)


@pytest.mark.parametrize("grace", [-1.0, nan, inf])
def test_a_grace_that_is_none_is_refused(grace: float) -> None:
    with pytest.raises(InputError, match="give zero or more"):
        due_after(None, 28.0, grace, DAY)


@pytest.mark.parametrize(("at", "now"), [(nan, DAY), (DAY, nan), (inf, DAY)])
def test_what_is_no_date_is_refused(at: float, now: float) -> None:
    with pytest.raises(InputError, match="are no dates"):
        due_on(at, 7.0, now)

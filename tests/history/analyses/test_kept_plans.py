"""Plans of a history: kept with a date, overdue after its grace, done when a person says so."""

from datetime import datetime, timedelta, timezone
from typing import Any

import pytest
from sqlalchemy import select

from elastogeo.changes import DUE, NOT_ASKED, NOT_DUE, OVERDUE
from elastogeo.errors import InputError
from elastogeo.history.analyses import finish_plan, keep_plan, plans
from elastogeo.history.store import Store, audit, read, schema
from tests.history.analyses.kept import BEGAN, keep_series
from tests.history.conftest import Clock

DOCUMENT: dict[str, Any] = {"schema": "elastogeo.plan/1", "tests": [{"name": "xy"}, {"name": "yz tilted"}], "minutes": 24.5}


def states(store: Store, day: float) -> dict[str, str]:
    with read(store) as connection:
        return {one.name: one.due.state for one in plans(connection, BEGAN + timedelta(days=day))}


def test_a_plan_is_due_then_overdue_then_done(store: Store, standing_clock: Clock) -> None:
    keep_series(store)
    key = keep_plan(store, 1, "spring", DOCUMENT, BEGAN + timedelta(days=30), 7.0, "A. Miller")
    assert [states(store, day)["spring"] for day in (0, 30, 37, 37.5)] == [NOT_DUE, DUE, DUE, OVERDUE]
    with read(store) as connection:
        (found,) = plans(connection, BEGAN + timedelta(days=40))
    assert (found.key, found.machine, found.tests, found.minutes) == (key, "Mill 3", ("xy", "yz tilted"), 24.5)
    assert found.document == DOCUMENT
    assert found.due.overdue == pytest.approx(3.0)
    standing_clock.advance(days=50)
    finish_plan(store, key, "B. Moore", "measured on Sunday")
    assert states(store, 90)["spring"] == NOT_ASKED
    with read(store) as connection:
        (found,) = plans(connection, BEGAN + timedelta(days=90))
        trail = connection.execute(select(schema.audit).order_by(schema.audit.c.number)).mappings().all()
        assert [(row["who"], row["what"]) for row in trail][-2:] == [("A. Miller", "keep plan"), ("B. Moore", "finish plan")]
        assert audit.verify(connection) == ()
    assert found.done_at == pytest.approx((standing_clock.time - BEGAN).total_seconds() / 86400 + found_day(BEGAN))
    with pytest.raises(InputError, match="plan 'spring' was done on 2026-04-21 already"):
        finish_plan(store, key, "B. Moore")


def found_day(at: Any) -> float:
    return float(at.timestamp() / 86400)


def test_the_most_urgent_comes_first_the_done_last(store: Store) -> None:
    keep_series(store)
    for name, day in (("some day", None), ("late", 60), ("soon", 10)):
        keep_plan(store, 1, name, DOCUMENT, None if day is None else BEGAN + timedelta(days=day))
    finish_plan(store, keep_plan(store, 1, "done", DOCUMENT, BEGAN), "A. Miller")
    assert list(states(store, 20)) == ["soon", "late", "some day", "done"]


def test_plans_are_asked_of_one_machine_or_all(store: Store) -> None:
    keep_series(store, "Mill 3")
    keep_series(store, "Mill 4")
    for owner in (1, 2):
        keep_plan(store, owner, "spring", DOCUMENT)
    with read(store) as connection:
        assert [one.machine for one in plans(connection, BEGAN)] == ["Mill 3", "Mill 4"]
        assert [one.machine for one in plans(connection, BEGAN, of=2)] == ["Mill 4"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"document": {"schema": "elastogeo.static/1", "tests": []}}, "this is elastogeo.static/1, not a plan"),
        ({"document": {}}, "this is a document without a schema, not a plan"),
        ({"name": " "}, "the plan has no name"),
        ({"document": DOCUMENT | {"tests": [{}]}}, "test 1 of the plan has no name"),
        ({"document": DOCUMENT | {"tests": [{"name": "a"}, "b"]}}, "test 2 of the plan has no name"),
        ({"document": DOCUMENT | {"minutes": "long"}}, "the plan takes 'long' minutes; give a number"),
        ({"due": datetime(9999, 12, 31, 23, tzinfo=timezone(timedelta(hours=-5)))}, "more than 100 years from now"),
        ({"grace": 1e7}, "the grace is 1e[+]07 days; give at most 36500"),
        ({"grace": -1.0}, "the grace is -1 days; give zero or more"),
        ({"owner": 7}, "there is no machine 7"),
        ({"name": "spring"}, "Mill 3 has a plan 'spring' already; give this one another name"),
    ],
)
def test_what_is_no_plan_is_refused(store: Store, given: dict[str, Any], message: str) -> None:
    keep_series(store)
    keep_plan(store, 1, "spring", DOCUMENT)
    with pytest.raises(InputError, match=message):
        keep_plan(store, **{"owner": 1, "name": "summer", "document": DOCUMENT, **given})
    assert list(states(store, 0)) == ["spring"]


def test_a_date_without_a_zone_is_refused(store: Store) -> None:
    keep_series(store)
    with pytest.raises(InputError, match="has no time zone"):
        keep_plan(store, 1, "spring", DOCUMENT, BEGAN.replace(tzinfo=None))


def test_a_plan_that_is_not_there_is_refused(store: Store) -> None:
    with pytest.raises(InputError, match="there is no plan 7"):
        finish_plan(store, 7, "A. Miller")

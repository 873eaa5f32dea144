"""What a person wants of a series is kept with who and why, once, and refused where it would judge by nothing."""

from datetime import timedelta

import pytest
from sqlalchemy import func, insert, select

from elastogeo.changes import Tolerance
from elastogeo.errors import InputError
from elastogeo.history.names import machine_key, series_named, series_of_machine
from elastogeo.history.requirements.baselines import choose, set_baseline
from elastogeo.history.requirements.intervals import set_interval
from elastogeo.history.requirements.tolerances import set_tolerance, tolerance_of
from elastogeo.history.store import now, read, write
from elastogeo.history.store.schema import audit, baseline, machine, series, set_aside, tolerance
from tests.history.alarms.shop import DAY, START, key_of, make_series, make_test

WHO = {"who": "A. Miller", "why": "after the guideway was replaced"}


@pytest.fixture
def tests(store):
    """A series of eight tests, a week apart; the third is set aside."""
    of = make_series(store)
    keys = [make_test(store, of, START + 7 * k * DAY, {"stiffness X": ("stiffness", 16_000.0 + k)}) for k in range(8)]
    with write(store) as connection:
        connection.execute(insert(set_aside).values(test=keys[2], aside=True, at=now(), who="A. Miller", why="loose ball"))
    return of, keys


def rows(store, table):
    with read(store) as connection:
        return connection.scalar(select(func.count()).select_from(table))


def test_a_baseline_is_the_first_or_last_tests_that_stand(store, tests):
    of, keys = tests
    with read(store) as connection:
        assert choose(connection, of, first=3) == (keys[0], keys[1], keys[3])
        assert choose(connection, of, last=2) == (keys[6], keys[7])
        assert choose(connection, of, begin=START + 21 * DAY, end=START + 35 * DAY) == tuple(keys[3:6])
        with pytest.raises(InputError, match="8 tests were asked for as a baseline, and 7 are there"):
            choose(connection, of, first=8)
        with pytest.raises(InputError, match="one of both counts"):
            choose(connection, of, first=3, last=3)
        with pytest.raises(InputError, match=r"1 tests were asked for.*take 2 or more"):
            choose(connection, of, first=1)
        with pytest.raises(InputError, match="0 are there"):
            choose(connection, of, begin=START + 400 * DAY)


def test_a_baseline_is_kept_once_with_its_reason(store, tests):
    of, keys = tests
    before = rows(store, audit)
    first = set_baseline(store, of, [keys[1], keys[0]], **WHO)
    assert first.tests == (keys[0], keys[1])
    assert first.since == START + 7 * DAY
    assert first.new
    again = set_baseline(store, of, keys[:2], who="somebody else", why="the same")
    assert not again.new
    assert rows(store, baseline) == 1
    later = set_baseline(store, of, keys[:2], since=START + 14 * DAY, **WHO)
    assert later.new
    assert rows(store, baseline) == 2
    assert rows(store, audit) - before == 2


@pytest.mark.parametrize(
    ("chosen", "message"),
    [([0], "a baseline of 1 tests shows no scatter"), ([0, 2], "is set aside"), ([0, 0], "a baseline of 1 tests")],
)
def test_a_baseline_that_shows_nothing_is_refused(store, tests, chosen, message):
    of, keys = tests
    with pytest.raises(InputError, match=message):
        set_baseline(store, of, [keys[k] for k in chosen], **WHO)
    assert rows(store, baseline) == 0


def test_a_baseline_takes_no_test_of_another_series_and_wants_a_reason(store, tests):
    of, keys = tests
    other = make_series(store, "Mill 4")
    foreign = make_test(store, other, START, {"stiffness X": ("stiffness", 1.0)})
    with pytest.raises(InputError, match=f"test {foreign} is no test of this series"):
        set_baseline(store, of, [*keys[:2], foreign], **WHO)
    with pytest.raises(InputError, match="give one with --why"):
        set_baseline(store, of, keys[:2], who="A. Miller", why=" ")
    with pytest.raises(InputError, match="there is no series 999"):
        set_baseline(store, 999, keys[:2], **WHO)


def test_a_tolerance_follows_another_and_is_taken_back(store, tests):
    of, _ = tests
    wanted = Tolerance(lower=13_000.0)
    set_tolerance(store, of, "stiffness X", wanted, **WHO)
    set_tolerance(store, of, "stiffness X", wanted, **WHO)
    assert rows(store, tolerance) == 1
    set_tolerance(store, of, "stiffness X", Tolerance(), **WHO)
    with read(store) as connection:
        assert tolerance_of(connection, of, "stiffness X") == Tolerance()
        assert tolerance_of(connection, of, "backlash X") == Tolerance()
    assert rows(store, tolerance) == 2


@pytest.mark.parametrize(
    ("name", "wanted", "message"),
    [
        ("stiffness Q", Tolerance(lower=1.0), "no indicator 'stiffness Q'; it has: stiffness X"),
        ("stiffness X", Tolerance(lower=2.0, upper=1.0), "no value does; exchange them"),
        ("stiffness X", Tolerance(upper=float("nan")), "the upper of stiffness X is nan"),
        ("stiffness X", Tolerance(relevance=-1.0), "give zero or more"),
    ],
)
def test_a_tolerance_that_nothing_can_keep_is_refused(store, tests, name, wanted, message):
    of, _ = tests
    with pytest.raises(InputError, match=message):
        set_tolerance(store, of, name, wanted, **WHO)
    assert rows(store, tolerance) == 0


def test_an_interval_is_set_and_taken_back(store, tests):
    of, _ = tests
    before = rows(store, audit)
    set_interval(store, of, 30.0, 5.0, who="A. Miller")
    set_interval(store, of, 30.0, 5.0, who="A. Miller")
    with read(store) as connection:
        found = connection.execute(select(series.c.interval_days, series.c.grace_days)).one()
    assert tuple(found) == (30.0, 5.0)
    assert rows(store, audit) - before == 1
    set_interval(store, of, None, who="A. Miller")
    for days, grace, message in (
        (0.0, 7.0, "0 days; give a positive"),
        (30.0, -1.0, "grace is -1 days"),
        (1e7, 7.0, r"is 1e\+07 days; give at most 36500"),
        (30.0, 1e7, r"grace is 1e\+07 days; give at most 36500"),
    ):
        with pytest.raises(InputError, match=message):
            set_interval(store, of, days, grace, who="A. Miller")


def test_machines_and_series_are_found_by_what_a_person_says(store):
    of = make_series(store)
    with write(store) as connection:
        own = connection.scalar(select(machine.c.id))
        values = {"machine": own, "name": "YZ 150", "recipe": {}, "recipe_sha256": "b", "software": "1"}
        other = key_of(connection, series, **values)
        bare = key_of(connection, machine, name="Mill 4", serial="4711", made_at=START + timedelta(days=1))
    with read(store) as connection:
        assert [one.key for one in series_of_machine(connection, "C50 no. 3")] == [of, other]
        assert series_named(connection, "C50 no. 3", "yz").key == other
        assert series_named(connection, "C50 no. 3", "XY 200").key == of
        assert machine_key(connection, "4711") == bare
        with pytest.raises(InputError, match="has 2 series; say which: 'XY 200'; 'YZ 150'"):
            series_named(connection, "C50 no. 3")
        with pytest.raises(InputError, match=r"2 series of C50 no\. 3 have '0' in their names"):
            series_named(connection, "C50 no. 3", "0")
        with pytest.raises(InputError, match="no series 'ZX'; it has: 'XY 200'; 'YZ 150'"):
            series_named(connection, "C50 no. 3", "ZX")
        with pytest.raises(InputError, match=r"has no test yet; import one"):
            series_named(connection, "Mill 4")
        with pytest.raises(InputError, match=r"no machine .C50 no 3.; did you mean .C50 no\. 3."):
            machine_key(connection, "C50 no 3")

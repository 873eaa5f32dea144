"""The life of an alarm, and what of it is told: pure decisions."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from elastogeo.changes.alarms import ACKNOWLEDGED, CLOSED, FALSE, HELD, OPEN, RELEASED, REPAIRED, WORSE
from elastogeo.history.alarms.life import WORSE_BY, Found, Step, is_acknowledged, is_held, is_open, recorded, steps_of
from elastogeo.history.alarms.telling import is_live, news

DAY = timedelta(days=1)
MONDAY = datetime(2026, 3, 2, 8, tzinfo=UTC)
QUIET = Found(False, {}, {}, {}, 1, MONDAY)


def alarming(test: int = 1, measured: datetime = MONDAY, **ratios: float) -> Found:
    return Found(True, ratios, ratios, ratios, test, measured)


def opened(**ratios: float) -> Step:
    return Step(OPEN, {"over": ratios, "size": ratios}, 1, MONDAY)


# which steps


def test_nothing_comes_of_charts_that_are_quiet() -> None:
    assert steps_of(QUIET) == ()
    assert steps_of(QUIET, [opened(x=1.4)]) == (), "only a person closes an alarm"


def test_an_alarm_opens_once() -> None:
    (step,) = steps_of(alarming(x=1.4))
    assert (step.state, step.facts["over"], step.test) == (OPEN, {"x": 1.4}, 1)
    assert steps_of(alarming(x=1.4), [step]) == ()


@pytest.mark.parametrize(("now", "is_worse"), [(1.4, False), (1.8, False), (1.9, True), (3.0, True)])
def test_worse_is_half_a_limit_more(now: float, is_worse: bool) -> None:
    found = steps_of(alarming(x=now), [opened(x=1.4)])
    assert [step.state for step in found] == ([WORSE] if is_worse else [])


def test_worse_is_counted_from_what_was_told_last_not_from_the_last_test() -> None:
    """Growth in small steps is told, and a fall in between does not let it be told twice."""
    steps = [opened(x=1.0)]
    for ratio in (1.2, 1.4, 1.1, 1.49, 1.5, 1.3, 1.6, 1.99, 2.0):
        steps += steps_of(alarming(x=ratio), steps)
    assert [step.facts["over"]["x"] for step in steps] == [1.0, 1.5, 2.0]


def test_a_change_that_only_grows_more_certain_is_not_worse() -> None:
    """The running mean of a change that stays goes on growing; single tests say how large it is."""
    certain = Found(True, {"x": 9.0}, {"x": 1.5}, {"x": 1.4}, 4, MONDAY)
    assert steps_of(certain, [opened(x=1.4)]) == ()


def test_a_further_indicator_joins_and_counts_from_its_own_limit() -> None:
    assert steps_of(alarming(x=5.0, y=1.4), [opened(x=5.0)]) == ()
    (step,) = steps_of(alarming(x=5.0, y=1.6), [opened(x=5.0)])
    assert (step.state, step.facts["grown"]) == (WORSE, ["y"])


def test_one_badly_seated_ball_makes_no_alarm_worse() -> None:
    blunder = Found(True, {"x": 6.0}, {"x": 6.0}, {"x": 1.4}, 2, MONDAY)
    assert steps_of(blunder, [opened(x=1.4)]) == ()
    answered = alarming(3, x=5.8)
    assert [step.state for step in steps_of(answered, [opened(x=1.4)])] == [WORSE]


def test_what_was_measured_before_an_alarm_was_closed_opens_no_other() -> None:
    closed = [opened(x=1.4), Step(FALSE, {}, None, MONDAY + DAY, "A. Miller", "ball")]
    assert steps_of(alarming(x=1.4), closed, cleared=MONDAY + DAY) == ()
    again = steps_of(alarming(2, MONDAY + 2 * DAY, x=1.4), closed, cleared=MONDAY + DAY)
    assert [step.state for step in again] == [OPEN]


# what is told


@pytest.mark.parametrize(
    ("age", "live"),
    [(0.0, True), (6.9, True), (7.1, False), (1000.0, False), (-0.9, True), (-1.1, False), (-400.0, False)],
)
def test_old_tests_and_tests_of_the_future_are_no_news(age: float, live: bool) -> None:
    assert is_live(MONDAY - age * DAY, MONDAY) is live


def test_a_time_zone_changes_no_age() -> None:
    from datetime import timezone

    east = datetime(2026, 3, 2, 20, tzinfo=timezone(timedelta(hours=12)))
    assert east == MONDAY
    assert is_live(east - 7 * DAY, MONDAY)
    assert not is_live(east - 7 * DAY - timedelta(seconds=1), MONDAY)


def test_only_a_live_test_makes_news() -> None:
    found = alarming(x=1.4)
    taken = steps_of(found)
    assert news([], taken, found, live=True, told=False) == 0
    assert news([], taken, found, live=False, told=False) is None


def test_an_alarm_that_old_tests_opened_is_told_once_by_the_first_live_test_that_shows_it() -> None:
    before = [opened(x=1.4)]
    assert news(before, (), alarming(x=1.3), live=True, told=False) == 0
    assert news(before, (), alarming(x=1.3), live=True, told=True) is None
    assert news(before, (), alarming(x=0.4), live=True, told=False) is None, "quiet again: the digest tells it"
    known = [*before, Step(ACKNOWLEDGED, {}, None, MONDAY, "A. Miller", "seen")]
    assert news(known, (), alarming(x=1.3), live=True, told=False) is None


def test_what_is_held_back_is_not_told() -> None:
    held = [opened(x=1.4), Step(HELD)]
    worse = steps_of(alarming(x=4.0), held)
    assert [step.state for step in worse] == [WORSE]
    assert news(held, worse, alarming(x=4.0), live=True, told=False) is None
    assert news([*held, Step(RELEASED)], worse, alarming(x=4.0), live=True, told=False) == 3


# any life

ACTS = st.one_of(
    st.tuples(st.just("test"), st.floats(0.2, 4.0), st.booleans()),
    st.tuples(st.just("again"), st.just(0.0), st.booleans()),
    st.tuples(st.sampled_from(["acknowledge", "false", "repaired", "hold", "release"]), st.just(0.0), st.just(True)),
)


@given(st.lists(ACTS, max_size=40))
def test_any_life_has_one_open_alarm_and_tells_each_change_once(acts: list[tuple[str, float, bool]]) -> None:
    alarms: list[list[Step]] = []
    sent: list[tuple[int, int]] = []
    found, at, cleared = QUIET, MONDAY, None
    for what, ratio, live in acts:
        at += DAY
        current = alarms[-1] if alarms and is_open(alarms[-1]) else []
        if what == "test":
            over = ratio >= 1 or (found.alarming and bool(current))  # a state stays an alarm until it is closed
            found = alarming(len(sent), at, x=ratio) if over else Found(False, measured=at)
        if what in ("test", "again"):
            taken = steps_of(found, current, cleared)
            told = any(number == len(alarms) - 1 for number, _ in sent) if current else False
            place = news(current, taken, found, live, told)
            if not current and taken:
                alarms.append([])
            if alarms:
                alarms[-1] += taken
            assert steps_of(found, alarms[-1] if alarms else (), cleared) == (), "the same again adds nothing"
            if place is not None:
                sent.append((len(alarms) - 1, place))
                assert live
                assert not is_held(alarms[-1])
        elif current:
            state = {"acknowledge": ACKNOWLEDGED, "false": FALSE, "repaired": REPAIRED, "hold": HELD, "release": RELEASED}
            current.append(Step(state[what], {}, None, at, "A. Miller", "because"))
            assert is_acknowledged(current) or what != "acknowledge"
            if what in ("false", "repaired"):
                cleared, found = at, QUIET
    assert len(sent) == len(set(sent)), "no step is told twice"
    assert sum(is_open(steps) for steps in alarms) <= 1
    for steps in alarms:
        assert [step.state for step in steps].count(OPEN) == 1
        assert steps[0].state == OPEN
        assert all(step.state not in CLOSED for step in steps[:-1]), "nothing follows a close"
        most = [
            recorded(steps[: k + 1], "size").get("x", 0.0) for k, step in enumerate(steps) if step.state in (OPEN, WORSE)
        ]
        assert all(later >= max(earlier, 1.0) + WORSE_BY for earlier, later in pairwise(most))

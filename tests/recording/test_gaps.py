import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.formats.recording_files import Gap
from elastogeo.recording.gaps import RESTARTED, TAKEN, THIN, WITNESSES, Follower, is_settled, plan_fill, with_restart


def follower(*times, cause=""):
    made = Follower("x")
    for time in times:
        assert made.take(time) is None
    if cause:
        assert made.lose(cause) == Gap("x", times[-1], None, cause)
    return made


def test_a_gap_lasts_from_the_sample_before_the_loss_to_the_one_after_it():
    followed = follower(10, 20, cause="cut")
    assert followed.lose("another") is None, "the first cause stands"
    assert followed.pending == Gap("x", 20, None, "cut")
    assert followed.take(50) == Gap("x", 20, 50, "cut")
    assert followed.pending is None
    assert followed.take(60) is None


def test_nothing_is_lost_before_the_first_sample():
    followed = Follower("x")
    assert followed.lose("cut") is None
    assert followed.take(5) is None


def test_the_newest_sample_again_means_that_nothing_is_missing():
    followed = follower(10, 20, cause="cut")
    assert followed.is_known(20)
    assert not followed.is_known(10)
    followed.again()
    assert followed.take(30) is None


def test_a_recording_that_is_gone_on_with_has_a_gap():
    followed = Follower("x", (1, 2, 3), "pause")
    assert followed.witnesses == (1, 2, 3)
    assert followed.take(9) == Gap("x", 3, 9, "pause")
    assert Follower("x", (), "pause").take(9) is None


def test_witnesses_are_the_newest_samples():
    assert follower(*range(100)).witnesses == tuple(range(100 - WITNESSES, 100))


GAP = Gap("x", 30, 60, "cut")


@pytest.mark.parametrize(
    ("history", "inside", "rest"),
    [
        ([20, 30, 40, 50, 60], [40, 50], []),
        ([30, 60], [], []),
        ([], [], [(30, 60)]),
        ([10, 20, 30], [], [(30, 60)]),
        ([40, 50, 60], [40, 50], [(30, 40)]),
        ([20, 30, 40, 50], [40, 50], [(50, 60)]),
        ([40, 50], [40, 50], [(30, 40), (50, 60)]),
        ([60], [], [(30, 60)]),
        ([60, 50, 40, 30], [50, 40], []),
    ],
)
def test_a_gap_is_closed_as_far_as_the_history_reaches(history, inside, rest):
    plan = plan_fill(GAP, (), np.array(history, dtype=np.int64))
    assert [history[k] for k in np.flatnonzero(plan.inside)] == inside
    assert list(plan.rest) == [Gap("x", a, b, "cut") for a, b in rest]


def test_a_history_that_leaves_out_received_samples_gives_what_it_has_and_closes_nothing():
    times = np.array([10, 30, 45, 60])
    plan = plan_fill(GAP, (10, 20, 30), times)
    assert times[plan.inside].tolist() == [45]
    assert plan.rest == (Gap("x", 30, 60, "cut" + THIN + TAKEN),)
    assert is_settled(plan.rest[0])
    assert plan_fill(GAP, (5, 10, 30), times).rest == (), "what is older than the history is no witness"
    late = plan_fill(GAP, (10, 20, 30), np.array([10]))
    assert (late.inside.any(), late.rest) == (False, (GAP,)), "a history that has not come so far yet is not thin"
    late = plan_fill(GAP, (10, 20, 30), np.array([10, 30, 45]))
    assert (late.inside.any(), late.rest) == (False, (GAP,)), "it is asked again when it has"


def test_a_server_that_was_restarted_in_a_gap_may_have_lost_something():
    assert with_restart(GAP, None) == with_restart(GAP, 30) == with_restart(GAP, 60) == GAP
    doubted = with_restart(GAP, 45)
    assert doubted == Gap("x", 30, 60, "cut" + RESTARTED)
    times = np.array([30, 40, 50, 60])
    plan = plan_fill(doubted, (), times)
    assert times[plan.inside].tolist() == [40, 50]
    assert plan.rest == (Gap("x", 30, 60, "cut" + RESTARTED + TAKEN),)
    page = plan_fill(doubted, (), times[:2], complete=False)
    assert page.rest == (Gap("x", 30, 40, "cut" + RESTARTED + TAKEN), Gap("x", 40, 60, "cut" + RESTARTED))
    assert [is_settled(gap) for gap in page.rest] == [True, False]


def test_a_page_is_gone_on_with_from_its_last_sample():
    plan = plan_fill(GAP, (20, 30), np.array([20, 30, 40]), complete=False)
    assert plan.rest == (Gap("x", 40, 60, "cut"),)
    full = plan_fill(plan.rest[0], (), np.array([40, 50, 60]), complete=False)
    assert full.rest == (Gap("x", 50, 60, "cut"),)
    assert plan_fill(full.rest[0], (), np.array([50, 60])).rest == ()


@pytest.mark.parametrize("gap", [Gap("x", 30, None, ""), Gap("x", 30, 30, ""), Gap("x", 30, 20, "")])
def test_a_gap_without_an_end_or_against_time_is_not_filled(gap):
    with pytest.raises(ValueError, match="cannot be filled"):
        plan_fill(gap, (), np.array([30]))


@settings(derandomize=True, deadline=None)
@given(
    st.lists(st.integers(0, 200), min_size=5, max_size=60, unique=True).map(sorted),
    st.data(),
)
def test_whatever_the_history_keeps_from_some_moment_on_no_sample_is_missing_unmarked(sent, data):
    """The source sent `sent`; the gap is between two of them; the history holds a stretch of it, of any kind."""
    a = data.draw(st.integers(1, len(sent) - 3))
    b = data.draw(st.integers(a + 1, len(sent) - 1))
    begin, end = sorted(data.draw(st.tuples(st.integers(0, len(sent)), st.integers(0, len(sent)))))
    gap = Gap("x", sent[a], sent[b], "cut")
    held = [time for time in sent[begin:end] if time <= sent[b]]
    plan = plan_fill(gap, tuple(sent[max(0, a - 3) : a + 1]), np.array(held, dtype=np.int64))
    kept = set(sent[: a + 1]) | set(sent[b:]) | {held[k] for k in np.flatnonzero(plan.inside)}
    for time in set(sent) - kept:
        assert any(rest.start < time < rest.end for rest in plan.rest)
    for rest in plan.rest:
        assert gap.start <= rest.start < rest.end <= gap.end

"""Channels of a log on one clock: what is passed on, interpolated, left out, and told."""

from itertools import pairwise

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import channel_clock
from elastogeo.formats.channel_uses import ChannelUse, Clock
from elastogeo.formats.channels import OnOneClock, on_one_clock
from elastogeo.formats.log import Channel, Log


def log_of(*channels: Channel, notes: tuple[str, ...] = ()) -> Log:
    return Log({channel.name: channel for channel in channels}, {"machine": "A"}, "f", notes)


def channel(name: str, unit: str, values, time=None) -> Channel:
    return Channel(name, unit, np.asarray(values, float), None if time is None else np.asarray(time, float))


def told(result: OnOneClock, words: str) -> list[str]:
    return [sentence for sentence in result.report if words in sentence]


TIME = 5.0 + 0.002 * np.arange(500)
NOISE = np.random.default_rng(8).normal(size=(2, 500))


def test_channels_of_one_regular_clock_are_passed_on_bit_for_bit() -> None:
    log = log_of(channel("current_x_A", "A", NOISE[0], TIME), channel("force_x_N", "N", NOISE[1], TIME), notes=("read.",))
    result = on_one_clock(log)
    assert list(result.table.columns) == ["time", "current_x", "force_x"]
    assert result.table.column("current_x").tobytes() == NOISE[0].tobytes()
    assert result.table.column("force_x").tobytes() == NOISE[1].tobytes()
    assert result.table.column("time").tobytes() == (TIME - TIME[0]).tobytes()
    assert result.step == pytest.approx(0.002, rel=1e-9)
    assert result.report == (
        "read.",
        "current_x, force_x: 500 samples, one every 0.002 s (500 Hz), without jitter",
        "every value stands as it was recorded: nothing is interpolated",
        "the time of the table begins at zero, which is 5 s on the clock of the file",
    )
    assert result.table.metadata == {"machine": "A", "clock": "\n".join(result.report)}


def test_a_clock_written_with_few_digits_is_regular_all_the_same() -> None:
    time = np.round(np.arange(500) / 600, 6)
    result = on_one_clock(log_of(channel("current_x_A", "A", NOISE[0], time)))
    assert result.table.column("current_x").tobytes() == NOISE[0].tobytes()
    assert result.table.column("time").tobytes() == time.tobytes()


def test_values_and_times_are_in_the_units_of_the_house() -> None:
    log = log_of(channel("position_x_um", "um", [1000, 2000], [0, 1]), channel("position_c", "", [90, 180], [0, 1]))
    table = on_one_clock(log, (ChannelUse("position_x"), ChannelUse("position_c", unit="deg"))).table
    assert table.column("position_x").tolist() == [1.0, 2.0]
    np.testing.assert_allclose(table.column("position_c"), [np.pi / 2, np.pi], rtol=1e-15)


def test_the_slowest_channel_sets_the_clock_and_straight_lines_are_kept() -> None:
    slow, fast = 0.0105 + 0.01 * np.arange(60), 0.002 * np.arange(400)
    log = log_of(channel("position_x_mm", "mm", 3 * slow - 1, slow), channel("current_x_A", "A", 2 - 5 * fast, fast))
    result = on_one_clock(log)
    time = result.table.column("time") + slow[0]
    np.testing.assert_allclose(time, slow, rtol=1e-12)
    np.testing.assert_allclose(result.table.column("position_x"), 3 * time - 1, rtol=1e-12)
    np.testing.assert_allclose(result.table.column("current_x"), 2 - 5 * time, rtol=1e-12)
    assert result.step == pytest.approx(0.01)
    assert told(result, "current_x: taken every 0.01 s of one every 0.002 s, without a filter")
    assert told(result, "current_x: 60 of 60 values are interpolated")
    assert result.table.column("position_x").tobytes() == (3 * slow - 1).tobytes()


def test_a_fast_channel_that_begins_later_leaves_the_slow_one_as_it_was_recorded() -> None:
    slow, fast = TIME, 5.1234 + 0.0005 * np.arange(1500)
    log = log_of(channel("current_x_A", "A", 2 - 5 * fast, fast), channel("force_x_N", "N", NOISE[0], slow))
    result = on_one_clock(log)
    there = (slow > fast[0]) & (slow < fast[-1])
    assert result.table.column("force_x").tobytes() == NOISE[0][there].tobytes()
    np.testing.assert_allclose(result.table.column("current_x"), 2 - 5 * slow[there], rtol=1e-12)
    assert told(result, f"{500 - there.sum()} of 500 common samples lie in a gap or beyond a channel: left out")


def test_a_straight_line_is_off_by_an_eighth_of_the_acceleration_times_the_gap_squared() -> None:
    time = np.delete(0.01 * np.arange(9), [4, 5])
    result = on_one_clock(log_of(channel("position_x_mm", "mm", 50 * time**2, time)))
    there = result.table.column("time")
    error = np.abs(result.table.column("position_x") - 50 * there**2)
    assert len(there) == 9
    gap = 0.03
    assert 100 * gap**2 / 8 * 0.8 < error.max() <= 100 * gap**2 / 8
    np.testing.assert_allclose(error[[4, 5]], 50 * 0.01 * 0.02, rtol=1e-9)


def test_a_gap_is_bridged_up_to_three_sample_times_and_left_open_beyond() -> None:
    whole = 0.01 * np.arange(20)
    time = np.delete(whole, [4, 5, 10, 11, 12])
    result = on_one_clock(log_of(channel("position_x_mm", "mm", 7 * time, time)))
    there = np.delete(whole, [10, 11, 12])
    np.testing.assert_allclose(result.table.column("time"), there, rtol=1e-12)
    np.testing.assert_allclose(result.table.column("position_x"), 7 * there, rtol=1e-12, atol=1e-15)
    assert told(
        result,
        "position_x: no sample for 0.03 s after 0.03 s (bridged), 0.04 s after 0.09 s (left open); bridged is up to 0.03 s",
    )
    assert told(result, "position_x: 2 of 17 values are interpolated")
    assert not told(result, "common samples")
    closed = on_one_clock(log_of(channel("position_x_mm", "mm", 7 * time, time)), clock=Clock(longest_gap=0.05))
    np.testing.assert_allclose(closed.table.column("time"), whole, atol=1e-15)
    opened = on_one_clock(log_of(channel("position_x_mm", "mm", 7 * time, time)), clock=Clock(longest_gap=0.01))
    np.testing.assert_allclose(opened.table.column("time"), time, atol=1e-15)
    assert told(opened, "nothing is interpolated")


def test_a_long_break_need_not_be_a_whole_number_of_samples() -> None:
    time = np.concatenate((TIME, TIME[-1] + 0.0111 + TIME - TIME[0]))
    result = on_one_clock(log_of(channel("current_x_A", "A", NOISE.ravel(), time)))
    assert result.table.column("current_x").tobytes() == NOISE.tobytes()
    np.testing.assert_allclose(np.diff(result.table.column("time")).max(), 0.0111)


def test_every_sample_that_was_recorded_is_kept_where_others_are_bridged() -> None:
    time = np.delete(TIME, [7, 200, 201])
    values = np.delete(NOISE[0], [7, 200, 201])
    result = on_one_clock(log_of(channel("current_x_A", "A", values, time)))
    assert result.table.rows == 500
    assert np.delete(result.table.column("current_x"), [7, 200, 201]).tobytes() == values.tobytes()
    assert result.table.column("current_x")[7] == pytest.approx((NOISE[0][6] + NOISE[0][8]) / 2)


def test_missing_numbers_are_gaps_of_their_own_channel() -> None:
    time = 0.01 * np.arange(20)
    values = 7 * time
    values[[4, 10, 11, 12, 19]] = np.nan
    log = log_of(channel("position_x_mm", "mm", values, time), channel("current_x_A", "A", 3 * time, time))
    result = on_one_clock(log)
    there = np.delete(time, [10, 11, 12, 19])
    np.testing.assert_allclose(result.table.column("time"), there)
    np.testing.assert_allclose(result.table.column("position_x"), 7 * there)
    assert result.table.column("current_x").tobytes() == np.delete(3 * time, [10, 11, 12, 19]).tobytes()
    assert told(result, "position_x: 5 of 20 samples have no number or no time")
    assert told(result, "4 of 20 common samples lie in a gap or beyond a channel: left out")
    assert told(result, "position_x: 1 of 16 values are interpolated")


def test_jitter_is_told_and_put_on_a_regular_clock() -> None:
    late = np.where(np.arange(101) % 2, 0.001, 0.0)
    time = 0.01 * np.arange(101) + late
    result = on_one_clock(log_of(channel("position_x_mm", "mm", 4 * time, time)))
    steps = np.diff(time)
    median = np.median(steps)
    rms, worst = np.sqrt(np.mean((steps - median) ** 2)), np.abs(steps - median).max()
    assert told(result, f"jitter {rms:.3g} s rms, {worst:.3g} s at worst")
    np.testing.assert_allclose(np.diff(result.table.column("time")), median, rtol=1e-9)
    np.testing.assert_allclose(result.table.column("position_x"), 4 * result.table.column("time"), atol=1e-12)


def test_a_delay_is_taken_off_the_clock_of_its_channel() -> None:
    log = log_of(channel("position_x_mm", "mm", NOISE[0], TIME), channel("current_x_A", "A", NOISE[1], TIME))
    result = on_one_clock(log, (ChannelUse("position_x"), ChannelUse("current_x", delay=0.006)))
    np.testing.assert_array_equal(result.table.column("position_x"), NOISE[0][:-3])
    np.testing.assert_array_equal(result.table.column("current_x"), NOISE[1][3:])
    assert told(result, "current_x: its clock is set back by its delay of 0.006 s")
    swapped = on_one_clock(log, (ChannelUse("current_x", delay=0.006), ChannelUse("position_x")))
    np.testing.assert_array_equal(swapped.table.column("current_x"), NOISE[1][3:])
    np.testing.assert_array_equal(swapped.table.column("position_x"), NOISE[0][:-3])
    alone = on_one_clock(log, (ChannelUse("current_x", delay=-0.5007),))
    assert alone.table.column("current_x").tobytes() == NOISE[1].tobytes()
    assert told(alone, "which is 5.5007 s on the clock of the file")


def test_a_file_without_a_clock_needs_a_sample_time() -> None:
    log = log_of(channel("X1_CurrentFeedback", "", NOISE[0]), channel("X1_ActualPosition", "", NOISE[1]))
    uses = (ChannelUse("current_x", "X1_CurrentFeedback", "A"), ChannelUse("position_x", "X1_ActualPosition", "mm"))
    with pytest.raises(
        FormatError, match=r"channel 'X1_CurrentFeedback': the file keeps no clock; .*\[clock\] sample_time_ms"
    ):
        on_one_clock(log, uses)
    result = on_one_clock(log, uses, Clock(sample_time=0.1))
    np.testing.assert_allclose(result.table.column("time"), 0.1 * np.arange(500))
    assert result.table.column("current_x").tobytes() == NOISE[0].tobytes()
    assert result.step == 0.1
    short = log_of(channel("i1_A", "A", [1, 2, 3]), channel("i2_A", "A", [1, 2]))
    with pytest.raises(FormatError, match=r"channels without a clock have \[2, 3\] samples, so they cannot be aligned"):
        on_one_clock(short, clock=Clock(0.1))


def test_a_channel_may_be_the_clock_of_the_others() -> None:
    log = log_of(channel("t", "", [100, 102, np.nan, 106, 108]), channel("x_mm", "mm", [1, 2, 99, 4, 5]))
    result = on_one_clock(log, (ChannelUse("time", "t", "ms"), ChannelUse("x")))
    np.testing.assert_allclose(result.table.column("time"), [0, 0.002, 0.004, 0.006, 0.008], atol=1e-15)
    np.testing.assert_allclose(result.table.column("x"), [1, 2, 3, 4, 5])
    with pytest.raises(FormatError, match="channel 'x_mm': its time does not go forward at sample 3; put it in order"):
        on_one_clock(
            log_of(channel("t", "", [1, 2, 2]), channel("x_mm", "mm", [1, 2, 3])),
            (ChannelUse("time", "t", "s"), ChannelUse("x")),
        )
    with pytest.raises(FormatError, match="has 3 samples, the channel of the time 2"):
        on_one_clock(
            log_of(channel("t", "", [1, 2]), channel("x_mm", "mm", [1, 2, 3])),
            (ChannelUse("time", "t", "s"), ChannelUse("x")),
        )
    with pytest.raises(FormatError, match="only its time is asked for"):
        on_one_clock(log, (ChannelUse("time", "t", "ms"),))


@pytest.mark.parametrize("end", [360.0, 180.0])
def test_no_line_is_drawn_across_the_end_of_a_turn(end: float) -> None:
    time = 0.01 * np.arange(300)
    turned = 20 + 350 * time
    wrapped = (turned - end) % 360 + end - 360
    shifted = time + 0.003
    log = log_of(channel("current_c_A", "A", shifted, shifted), channel("position_c_deg", "deg", wrapped, time))
    result = on_one_clock(log)
    at = result.table.column("time") + shifted[0]
    off = np.rad2deg(result.table.column("position_c")) - (20 + 350 * at)
    np.testing.assert_allclose(off, np.round(off[0] / 360) * 360, atol=1e-9)
    assert told(result, f"position_c: passes the end of its turn {int((np.diff(wrapped) < 0).sum())} times")


def test_an_angle_that_runs_on_is_left_as_it_is() -> None:
    fast = np.array([0.0, 300.0, 600.0, 900.0])
    result = on_one_clock(log_of(channel("position_c_deg", "deg", fast, np.arange(4.0))))
    np.testing.assert_allclose(np.rad2deg(result.table.column("position_c")), fast)
    assert not told(result, "turn")


def test_a_part_is_taken_on_the_clock_of_the_file() -> None:
    log = log_of(channel("current_x_A", "A", NOISE[0], TIME))
    result = on_one_clock(log, start=TIME[100], end=TIME[199])
    assert result.table.column("current_x").tobytes() == NOISE[0][100:200].tobytes()
    assert result.table.column("time")[0] == 0
    assert told(result, "which is 5.2 s on the clock of the file")
    assert on_one_clock(log, start=5.9).table.rows == 50
    assert on_one_clock(log, end=5.1).table.rows == 51
    for start, end in ((6.5, None), (None, 1.0), (5.5, 5.5), (5.5, 5.4)):
        with pytest.raises(
            FormatError, match=r"current_x has \d samples from .* it is recorded from 5 s to 5\.998 s: correct"
        ):
            on_one_clock(log, start=start, end=end)


def test_another_sample_time_may_be_asked_for() -> None:
    line = log_of(channel("position_x_mm", "mm", 3 * TIME, TIME))
    for step, rows in ((0.004, 250), (0.001, 999), (0.003, 333)):
        result = on_one_clock(line, clock=Clock(sample_time=step))
        assert (result.step, result.table.rows) == (step, rows)
        np.testing.assert_allclose(np.diff(result.table.column("time")), step, rtol=1e-6)
        np.testing.assert_allclose(result.table.column("position_x"), 3 * (5 + result.table.column("time")), rtol=1e-12)
    thinned = on_one_clock(log_of(channel("current_x_A", "A", NOISE[0], TIME)), clock=Clock(sample_time=0.004))
    np.testing.assert_array_equal(thinned.table.column("current_x"), NOISE[0][::2])


def test_a_clock_without_end_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    log = log_of(channel("x_mm", "mm", [0, 1], [0, 1e9]))
    with pytest.raises(FormatError, match=r"every 1e-06 s makes 1e\+15 samples, at most 20000000 are made"):
        on_one_clock(log, clock=Clock(sample_time=1e-6, longest_gap=1e10))
    monkeypatch.setattr(channel_clock, "MAX_SAMPLES", 100)
    with pytest.raises(FormatError, match=r"every 0\.01 s makes 501 samples, at most 100 are made"):
        on_one_clock(log_of(channel("x_mm", "mm", [0, 1, 2], [0, 0.01, 5])), clock=Clock(0.01, 10.0))


USES = log_of(
    channel("Position X [mm]", "mm", [1, 2], [0, 1]),
    channel("ENC_POS|1", "", [1, 2], [0, 1]),
    channel("nothing_N", "N", [np.nan, 1], [0, 1]),
    channel("late_N", "N", [1, 2], [7, 8]),
    channel("x_mm", "mm", [1, 2], [0, 1]),
    channel("X [mm]", "mm", [3, 4], [0, 1]),
    notes=("columns of numbers with something else among them, left out: broken_A",),
)


def test_a_channel_is_found_by_its_name_or_by_the_quantity_that_it_says() -> None:
    for use in (
        ChannelUse("position_x"),
        ChannelUse("q", "Position X [mm]"),
        ChannelUse("q", "position_x"),
        ChannelUse("q", "position x [MM]"),
    ):
        assert on_one_clock(USES, (use,)).table.columns[use.quantity].tolist() == [1, 2]
    assert on_one_clock(USES, (ChannelUse("q", "x_mm"),)).table.columns["q"].tolist() == [1, 2]
    assert on_one_clock(USES, (ChannelUse("factor", "ENC_POS|1", "1"),)).table.columns["factor"].tolist() == [1, 2]


@pytest.mark.parametrize(
    ("uses", "message"),
    [
        ([ChannelUse("q", "Posit X [mm]")], "has no channel 'Posit X [mm]'; did you mean 'Position X [mm]'?"),
        ([ChannelUse("q", "zzzz")], "has no channel 'zzzz'; it has Position X [mm], ENC_POS|1,"),
        ([ChannelUse("broken")], "x_mm, X [mm] (columns of numbers with something else among them, left out: broken_A)"),
        ([ChannelUse("x")], "'x' may be x_mm or X [mm]; write the channel's whole name"),
        ([ChannelUse("position_x", "ENC_POS|1")], "channel 'ENC_POS|1': the file gives no unit; add unit = \"mm\""),
        ([ChannelUse("position_x", unit="um")], "the file says mm, its [[channels]] says um; leave the unit out"),
        ([ChannelUse("position_x", unit="1")], "the file says mm, its [[channels]] says 1; leave the unit out"),
        ([ChannelUse("current_x", "ENC_POS|1", "mm")], "column 'current_x' has the unit mm (length): write current_x_A"),
        ([ChannelUse("force_x", "ENC_POS|1", "1")], "column 'force_x' has no unit: write force_x_N"),
        ([ChannelUse("q", "x_mm"), ChannelUse("q", "X [mm]")], "'q' is taken from two channels"),
        ([ChannelUse("nothing")], "channel 'nothing_N': 1 of its 2 samples are numbers with a time; two are needed"),
        ([ChannelUse("late"), ChannelUse("x", "x_mm")], "not recorded at the same time (late 7 to 8 s, x 0 to 1 s)"),
        ([], "'x' is taken from two channels"),
    ],
)  # fmt: skip
def test_what_will_not_do_is_told(uses: list[ChannelUse], message: str) -> None:
    with pytest.raises(FormatError) as caught:
        on_one_clock(USES, uses)
    assert str(caught.value).startswith("f")
    assert message in str(caught.value)


def test_a_log_that_says_nothing_of_itself_needs_the_test_to() -> None:
    with pytest.raises(FormatError, match=r'no channel says what it is .*channel = "ENC_POS\|1"'):
        on_one_clock(log_of(channel("ENC_POS|1", "", [1, 2], [0, 1])))


def test_channels_that_never_meet_are_told() -> None:
    a, b = np.array([0.0, 1, 2, 3, 20, 21]), np.array([8.2, 9.2, 10.2, 11.2])
    with pytest.raises(FormatError, match=r"at no moment do all of pull, push have a sample within 3 s; .*longest_gap_s"):
        on_one_clock(log_of(channel("pull_N", "N", a, a), channel("push_N", "N", b, b)))


def test_a_spelling_of_the_same_unit_is_no_contradiction() -> None:
    log = log_of(channel("position_x", "µm", [1000, 2000], [0, 1]))
    assert on_one_clock(log, (ChannelUse("position_x", unit="um"),)).table.column("position_x").tolist() == [1, 2]


WRONG = [
    (lambda: ChannelUse(""), "the quantity '' is no name"),
    (lambda: ChannelUse("current_x", unit="Ampere"), "the unit 'Ampere' of current_x is not known: use "),
    (lambda: ChannelUse("current_x", delay=float("nan")), "the delay of current_x is nan"),
    (lambda: Clock(sample_time=0.0), "sample_time is 0.0 s; it must be above zero"),
    (lambda: Clock(longest_gap=-1.0), "longest_gap is -1.0 s; it must be above zero"),
    (lambda: Clock(longest_gap=float("inf")), "longest_gap is inf s"),
]


@pytest.mark.parametrize(("make", "message"), WRONG)
def test_settings_that_cannot_be_are_refused(make, message: str) -> None:
    with pytest.raises(InputError) as caught:
        make()
    assert message in str(caught.value)


@pytest.mark.parametrize("seed", range(40))
def test_whatever_the_clocks_the_table_keeps_its_promises(seed: int) -> None:
    """A straight line in, the same line out; time increases; no sample inside a gap that is too long."""
    rng = np.random.default_rng(seed)
    channels = []
    for name in ("pull_N", "push_N"):
        step = rng.choice([0.002, 0.005, 0.01])
        time = rng.uniform(-1, 1) * step + step * np.arange(400) + rng.choice([0, 0.2]) * step * rng.uniform(-1, 1, 400)
        time = time[rng.random(400) > rng.choice([0, 0.05, 0.6])]
        values = 3 * time + 1
        values[rng.random(len(time)) < 0.1] = np.nan
        channels.append(channel(name, "N", values, time))
    result = on_one_clock(log_of(*channels))
    first = max(c.time[np.isfinite(c.values)][0] for c in channels)
    zero = told(result, "on the clock of the file")
    start = float(zero[0].split("which is ")[1].split()[0]) if zero else 0.0
    assert start >= first - 1e-9
    time = result.table.column("time")
    assert (np.diff(time) > 0.5 * result.step).all()
    for name in ("pull", "push"):
        np.testing.assert_allclose(result.table.column(name), 3 * (time + start) + 1, atol=1e-7)
    longest = 3 * max(np.median(np.diff(c.time)) for c in channels)
    for c in channels:
        finite = c.time[np.isfinite(c.values)]
        for left, right in pairwise(finite.tolist()):
            if right - left > longest * 1.001:
                assert not ((time + start > left + 1e-7) & (time + start < right - 1e-7)).any()


def test_without_uses_what_is_no_quantity_with_its_unit_is_not_taken() -> None:
    log = log_of(
        channel("force_x_N", "N", [1, 2], [0, 1]),
        channel("a_N", "N", [1, 2], [0, 1]),
        channel("CURRENT|1", "", [1, 2], [0, 1]),
        channel("State", "", [9, 9, 9], [7, 8, 9]),
    )
    result = on_one_clock(log)
    assert list(result.table.columns) == ["time", "force_x"]
    assert told(result, "channels that do not say a quantity and its unit, not taken: a_N, CURRENT|1, State")


@pytest.mark.parametrize(
    ("quantity", "unit", "wanted"),
    [
        ("position_x", "deg", r"has the unit deg \(angle\): write position_x_mm or"),
        ("position_c", "mm", r"has the unit mm \(length\): write position_c_rad or"),
        ("velocity_z", "rpm", r"has the unit rpm \(angular rate\): write velocity_z_mm_s or"),
        ("acceleration_a", "mm_s2", r"has the unit mm_s2 \(acceleration\): write acceleration_a_rad_s2 or"),
    ],
)
def test_an_axis_takes_units_of_its_own_kind_only(quantity: str, unit: str, wanted: str) -> None:
    with pytest.raises(FormatError, match=f"column '{quantity}' {wanted}"):
        on_one_clock(log_of(channel(quantity, unit, NOISE[0], TIME)), (ChannelUse(quantity),))
    named = log_of(channel(f"{quantity}_{unit}", unit, NOISE[0], TIME), channel("current_x_A", "A", NOISE[1], TIME))
    assert told(on_one_clock(named), f"channels that do not say a quantity and its unit, not taken: {quantity}_{unit}")


def test_percent_of_a_rated_value_becomes_that_value_or_stays_percent() -> None:
    log = log_of(channel("LOAD", "", [50.0, -100.0], [0, 1]), channel("current_y_%", "%", [10.0, 20.0], [0, 1]))
    uses = (ChannelUse("torque_x", "LOAD", "%", rated_torque=8000.0), ChannelUse("current_y"))
    result = on_one_clock(log, uses)
    assert result.table.column("torque_x").tolist() == [4000.0, -8000.0]
    assert result.table.column("current_y").tolist() == [10.0, 20.0]
    assert result.percent == ("current_y",)


def test_a_rated_value_that_does_not_fit_is_refused() -> None:
    with pytest.raises(InputError, match="torque_x has a rated current; give rated_torque"):
        ChannelUse("torque_x", unit="%", rated_current=1.0)
    with pytest.raises(InputError, match="rated_force of force_x is 0"):
        ChannelUse("force_x", unit="%", rated_force=0.0)
    log = log_of(channel("current_x_A", "A", [1.0, 2.0], [0, 1]))
    with pytest.raises(FormatError, match="has a rated value, but is in A, not in %"):
        on_one_clock(log, (ChannelUse("current_x", rated_current=5.0),))
    with pytest.raises(FormatError, match=r"'position_x' has the unit % \(percent\)"):
        on_one_clock(log_of(channel("a", "%", [1.0, 2.0], [0, 1])), (ChannelUse("position_x", "a"),))


@pytest.mark.parametrize("code", [999999.0, -32768.0, 1e30, -9999.0])
def test_a_code_for_a_missing_value_is_no_measurement(code: float) -> None:
    values = NOISE[0].copy()
    values[[100, *range(250, 350)]] = code
    result = on_one_clock(log_of(channel("current_x_A", "A", values, TIME)))
    assert np.abs(result.table.column("current_x")).max() < 10
    assert told(result, f"current_x: {code:.9g} stands 101 times (first at sample 101): a code for a missing value")
    assert told(result, "0.202 s after 5.498 s (left open)")


def test_another_value_far_beyond_all_others_is_named_and_kept() -> None:
    values = NOISE[0].copy()
    values[100] = 4321.5
    result = on_one_clock(log_of(channel("current_x_A", "A", values, TIME)))
    assert result.table.column("current_x")[100] == 4321.5
    assert told(result, "current_x: 4321.5 stands once (first at sample 101): far beyond all others, kept")


@pytest.mark.parametrize("values", [NOISE[0] * 1e5, np.arange(500) * 9999.0, np.where(NOISE[0] > 2, 40.0, NOISE[0])])
def test_values_that_belong_together_are_no_codes(values: np.ndarray) -> None:
    result = on_one_clock(log_of(channel("current_x_A", "A", values, TIME)))
    assert result.table.column("current_x").tobytes() == values.tobytes()
    assert not told(result, "stands once") + told(result, " times (first")

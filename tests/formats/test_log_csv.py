"""Delimited text of logs: spellings, clocks, missing numbers, order, truncation, and a real record."""

import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.channel_uses import ChannelUse, Clock
from elastogeo.formats.channels import on_one_clock
from elastogeo.formats.log import Log
from elastogeo.formats.logs.csv import can_read, read_csv_log

MILL = Path(__file__).parents[3] / "shared" / "data" / "umich-cnc-mill"
GOOD = "time_ms,position_x_mm,current_x_A\n0,1.5,0.25\n2,-2.5,0.5\n"


def read(text: str | bytes) -> Log:
    data = text.encode() if isinstance(text, str) else text
    assert can_read(data)
    return read_csv_log(data, "f")


def refused(text: str) -> str:
    with pytest.raises(FormatError) as caught:
        read_csv_log(text.encode(), "f")
    return str(caught.value)


SPELLINGS = {
    "comma": GOOD,
    "semicolon": GOOD.replace(",", ";"),
    "tab": GOOD.replace(",", "\t"),
    "blanks": GOOD.replace(",", "   "),
    "decimal comma": GOOD.replace(",", ";").replace(".", ","),
    "decimal comma, tab": GOOD.replace(",", "\t").replace(".", ","),
    "decimal comma, quoted": 'time_ms,position_x_mm,current_x_A\n"0","1,5","0,25"\n"2","-2,5","0,5"\n',
    "CRLF": GOOD.replace("\n", "\r\n"),
    "blank lines and comments": "# a log\n" + GOOD.replace("\n", "\n\n# five\n"),
    "header in a comment": "# saved\n# time_ms position_x_mm current_x_A\n0 1.5 0.25\n2 -2.5 0.5\n",
}


@pytest.mark.parametrize("text", SPELLINGS.values(), ids=SPELLINGS.keys())
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_every_spelling_reads_the_same(text: str, encoding: str) -> None:
    log = read(text.encode(encoding))
    assert [(c.name, c.unit, c.values.tolist()) for c in log.channels.values()] == [
        ("position_x_mm", "mm", [1.5, -2.5]),
        ("current_x_A", "A", [0.25, 0.5]),
    ]
    for channel in log.channels.values():
        assert channel.time is not None
        assert channel.time.tolist() == [0.0, 0.002]
    assert log.notes == ()


UNIT_LINES = {
    "plain": "time,position_x,current_x\nms,mm,A\n0,1.5,0.25\n2,-2.5,0.5\n",
    "brackets": "time;position_x;current_x\n[ms];[mm];[A]\n0;1.5;0.25\n2;-2.5;0.5\n",
    "one unknown, a blank line": "time|position_x|current_x|load\n\nms|mm|A|gal\n0|1.5|0.25|3\n2|-2.5|0.5|3\n",
}


@pytest.mark.parametrize("text", UNIT_LINES.values(), ids=UNIT_LINES.keys())
def test_units_may_stand_in_a_line_of_their_own(text: str) -> None:
    log = read(text)
    channels = list(log.channels.values())[:2]
    assert [(c.name, c.unit, c.values.tolist()) for c in channels] == [
        ("position_x", "mm", [1.5, -2.5]),
        ("current_x", "A", [0.25, 0.5]),
    ]
    assert channels[0].time is not None
    assert channels[0].time.tolist() == [0.0, 0.002]
    assert log.notes == (("the unit 'gal' of column load is not known: its channel has none",) if "load" in text else ())


def test_a_line_of_text_is_no_line_of_units() -> None:
    text = "time_s,x,state\n0,1,A\n1,2,N\n"
    assert read(text).channels["x"].values.tolist() == [1, 2]
    assert not can_read(b"name,state\nJohn,idle\nJane,m\n")
    assert "column x_mm is empty" in refused("x_mm,y_mm\n,\n,\n")


CLOCKS = {
    "time_s": ("1.5", "1.75", 1.5, 1.75),
    "Time [ms]": ("1500", "1750", 1.5, 1.75),
    "Time (us)": ("1500000", "1750000", 1.5, 1.75),
    "timestamp_ns": ("1500000000", "1750000000", 1.5, 1.75),
    "T [s]": ("1.5", "1.75", 1.5, 1.75),
    "t_ms": ("1500", "1750", 1.5, 1.75),
    "Zeit [min]": ("0.5", "1.5", 30.0, 90.0),
    "timestamp": ("2024-02-29T23:59:59.999999999Z", "2024-03-01T00:00:00.25Z", 0.0, 0.250000001),
    "Timestamp": ("2024-02-29 23:59:59,5", "2024-03-01 00:00:01,5", 0.0, 2.0),
    "date_time": ("2024-03-01T01:00:00+01:00", "2024-03-01T00:00:01Z", 0.0, 1.0),
}


@pytest.mark.parametrize("header", CLOCKS)
def test_a_clock_is_found_by_its_name_and_unit(header: str) -> None:
    first, second, start, end = CLOCKS[header]
    channel = read(f"x_mm|{header}\n1|{first}\n2|{second}\n").channels["x_mm"]
    assert channel.time is not None
    np.testing.assert_allclose(channel.time, [start, end], rtol=1e-15, atol=1e-15)


@pytest.mark.parametrize("header", ["time", "t", "timestamp", "Time"])
def test_a_time_without_a_unit_is_a_channel_and_no_clock(header: str) -> None:
    log = read(f"{header},x_mm\n0,1\n1,2\n")
    assert log.channels[header].values.tolist() == [0.0, 1.0]
    assert log.channels["x_mm"].time is None
    assert log.notes == (f"column {header} says no unit, so it is no clock but a channel; write {header}_s or {header}_ms",)


@pytest.mark.parametrize("header", ["Times", "T", "tool", "time_constant_s", "overtime_s", "lifetime_s", "downtime", "T_C"])
def test_other_columns_are_no_clock(header: str) -> None:
    assert read(f"{header},x_mm\n0,1\n0,2\n").channels["x_mm"].time is None


def test_units_are_those_of_the_headers() -> None:
    headers = [
        "X1_ActualVelocity",
        "Position X [mm]",
        "load (%)",
        "current_y_%",
        "oil (gal)",
        "position_A",
        "S1_OutputPower [kW]",
        "Moment [N m]",
        "n_rpm",
    ]
    log = read(",".join(headers) + "\n" + ",".join("123456789") + "\n")
    assert [c.unit for c in log.channels.values()] == ["", "mm", "%", "%", "", "", "", "N m", "rpm"]
    assert list(log.channels) == headers
    assert log.notes == (
        "the unit 'gal' of column oil (gal) is not known: its channel has none",
        "the unit 'kW' of column S1_OutputPower [kW] is not known: its channel has none",
    )


def test_what_is_no_number_is_kept_as_such_or_left_out_and_told() -> None:
    log = read(
        ",a,b,c,State,e,f\n"
        "7,1,,nan,Prep,,1\n"
        "9,NaN,2,null,Layer 1,,x\n"
        "8,3,inf,0.5,end,,2\n"
    )  # fmt: skip
    np.testing.assert_array_equal(log.channels["a"].values, [1, np.nan, 3])
    np.testing.assert_array_equal(log.channels["b"].values, [np.nan, 2, np.nan])
    np.testing.assert_array_equal(log.channels["c"].values, [np.nan, np.nan, 0.5])
    np.testing.assert_array_equal(log.channels["f"].values, [1, np.nan, 2])
    assert list(log.channels) == ["a", "b", "c", "f"]
    assert log.notes == (
        "column 1 has no name: left out",
        "column e is empty: left out",
        "column f: 1 of 3 cells is no number ('x' on line 3): kept as samples without a number",
        "columns of text, left out: State",
        "samples without a number, kept as such: a (1 of 3), b (2 of 3), c (2 of 3)",
    )


def test_what_is_too_large_is_no_number() -> None:
    log = read("x_mm,y_mm\n1,1\n-inf,2\n1e999,3\n")
    np.testing.assert_array_equal(log.channels["x_mm"].values, [1, np.nan, np.nan])
    assert log.notes == ("samples without a number, kept as such: x_mm (2 of 3)",)


def test_rows_out_of_order_are_sorted_and_doubled_ones_taken_once() -> None:
    log = read("time_s,x_mm\n3,30\n1,10\n2,20\n2,20\n4,nan\n4,nan\n")
    channel = log.channels["x_mm"]
    assert channel.time is not None
    assert channel.time.tolist() == [1, 2, 3, 4]
    np.testing.assert_array_equal(channel.values, [10, 20, 30, np.nan])
    assert log.notes[1:] == (
        "the clock goes back once: the samples were put in its order",
        "2 samples stand in the file twice: taken once",
    )


def test_two_rows_of_one_time_are_an_error() -> None:
    assert refused("time_s,x_mm\n1,10\n2,20\n2,21\n").startswith(
        "f, clock 'time_s': samples 2 and 3 are both of 2 and differ"
    )


def test_rows_without_a_time_are_left_out_and_told() -> None:
    log = read("time_s,x_mm\n1,10\n,20\nnan,25\n3,30\n")
    assert log.channels["x_mm"].values.tolist() == [10, 30]
    assert "2 samples have no time: left out" in log.notes
    assert "holds no time" in refused("time_s,x_mm\nnan,10\n,20\n")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time_s,x_mm\n1,10\nsoon,20\n", "f: the clock 'time_s' holds 'soon' on line 3; correct it"),
        ("timestamp,x_mm\n2024-01-01T00:00:00,1\n12:00,2\n", "'12:00' of sample 2 is no ISO 8601 time with its date"),
        ("timestamp,x_mm\n2024-01-01T00:00:00,1\n2024-13-01T00:00:00,2\n", "of sample 2 is no ISO 8601 time with its date"),
        (
            "timestamp,x_mm\n2024-01-01T00:00:00,1\n2024-01-01T00:00:01Z,2\n",
            "of sample 2 has a zone or has none, unlike the first; use one kind",
        ),
        ("time_s,x_mm\n1,10\n2\n3,30\n", "f: line 3 has 1 cells, the header has 2; complete it or take it out"),
        ("time_s,x_mm\n1,10\n2,2,0\n3,3,0\n", "f: 2 lines cannot be read"),
        ("time_s,x_mm,x_mm\n1,10,2\n", "f, line 1: several columns are named 'x_mm'"),
        ("time_s,x_mm\n", "no complete sample follows the column headers on line 1"),
        ("time_s,State\n1,a\n2,b\n", "no column but the clock holds numbers; columns of text, left out: State"),
        ("1,2\n3,4\n", "there is no line of column headers"),
        ("", "there is no line of column headers"),
        ("time_s;x_mm\n1;1,250\n2;1,500\n", "may be decimal marks or marks for thousands"),
        ("time_s,x_mm\n1," + "1" * 100_001 + "\n", "line 2 is longer than"),
    ],
)
def test_what_will_not_do_is_told(text: str, message: str) -> None:
    assert message in refused(text)


def test_marks_of_two_kinds_are_never_mixed() -> None:
    log = read("time_s;x_mm;y_mm;z_mm\n1;1,5;1.234;1\n2;2,5;1.235;2.000\n")
    assert list(log.channels) == ["x_mm", "z_mm"]
    np.testing.assert_array_equal(log.channels["z_mm"].values, [1, np.nan])
    said = "column z_mm: 1 of 2 cells is no number of the decimal mark ',' ('2.000' on line 3)"
    assert log.notes[0] == f"{said}: kept as samples without a number"
    assert log.notes[1] == "columns of text, left out: y_mm"


PREAMBLES = {
    "trace": "Trace export;v1.2\nMachine;DMU 50\n\nPosition X;Strom X\nmm;A\n1,5;0,25\n-2,5;0,5\n",
    "addresses": "[Header]\nServo guide\nDate, 2026-01-31\n[Data]\nDB1.0,DB2.0\nPosition X,Strom X\n1.5,0.25\n-2.5,0.5\n",
    "prose": "Recorded by two people on a rainy day\n\nNo of channels: 2\nPosition X\tStrom X\n1.5\t0.25\n-2.5\t0.5\n",
}


@pytest.mark.parametrize("text", PREAMBLES.values(), ids=PREAMBLES.keys())
def test_a_preamble_above_the_headers_is_passed_over_and_told(text: str) -> None:
    log = read(text)
    assert [(c.name, c.values.tolist()) for c in log.channels.values()] == [
        ("Position X", [1.5, -2.5]),
        ("Strom X", [0.25, 0.5]),
    ]
    line = text[: text.index("Position")].count("\n") + 1
    assert f"lines above the column headers on line {line} were not understood: left out" in log.notes
    assert [c.unit for c in log.channels.values()] == (["mm", "A"] if "mm;A" in text else ["", ""])


def test_a_bad_cell_is_no_sample_and_says_column_count_and_line() -> None:
    text = "time_ms,current_x_A\n" + "".join(f"{k},{'Err' if k == 7 else '---' if k == 9 else k / 8}\n" for k in range(40))
    log = read(text)
    expected = np.arange(40) / 8
    expected[[7, 9]] = np.nan
    np.testing.assert_array_equal(log.channels["current_x_A"].values, expected)
    said = "column current_x_A: 2 of 40 cells are no numbers ('Err' on line 9, '---' on line 11)"
    assert log.notes == (f"{said}: kept as samples without a number",)


def test_a_column_that_is_mostly_text_is_left_out_with_its_reason() -> None:
    log = read("time_s,x_mm,tool\n0,1,T1\n1,2,T2\n2,3,5\n")
    assert list(log.channels) == ["x_mm"]
    assert log.notes == (
        "column tool: 2 of 3 cells are no numbers ('T1' on line 2, 'T2' on line 3): the column is left out",
    )


COUNTS = [101, 102, 103, 3953, 3954]


def test_a_counter_that_leaves_samples_out_is_the_clock_of_the_samples() -> None:
    log = read("CYCLE,X\n" + "".join(f"{n},{n / 2}\n" for n in COUNTS))
    assert log.counter == "CYCLE"
    assert log.notes == ("column CYCLE counts samples and leaves out 3849 in one place, after sample 3",)
    told = on_one_clock(log, (ChannelUse("position_x", "X", "mm"),), Clock(sample_time=0.002))
    assert told.table.column("time") == pytest.approx([0, 0.002, 0.004, 7.704, 7.706])
    assert any("no sample for 7.7 s after 0.004 s (left open)" in sentence for sentence in told.report)


def test_a_counter_may_begin_again_but_never_go_back() -> None:
    log = read("sample_no,X\n" + "".join(f"{n % 256},{n}\n" for n in range(250, 262)))
    told = on_one_clock(log, (ChannelUse("position_x", "X", "mm"),), Clock(sample_time=0.5))
    assert told.table.column("time") == pytest.approx(np.arange(12) / 2)
    assert log.notes == ("column sample_no: the counter began again 1 times: counted on",)
    message = refused("CYCLE,X\n101,1\n103,3\n102,2\n104,4\n")
    assert message == (
        "f, column CYCLE: counts samples, but does not go forward at sample 3 (103, then 102; 1 such places); put the rows "
        "in the order in which they were recorded"
    )


@pytest.mark.parametrize("column", ["cycle,1,1,1,2,2,2", "count,0.5,1,1.5,2,2.5,3", "level,3,1,2,5,4,6"])
def test_other_columns_count_no_samples(column: str) -> None:
    name, *values = column.split(",")
    log = read(f"{name},X\n" + "".join(f"{value},{k}\n" for k, value in enumerate(values)))
    assert (log.counter, log.notes) == ("", ())


def test_a_last_line_that_may_be_cut_is_never_half_read() -> None:
    text = "time_s,x_mm\n1,10\n2,200\n3,300\n"
    for end in range(len(text)):
        complete = text[:end].count("\n") - 1
        if complete < 1:
            assert "f" in refused(text[:end])
            continue
        log = read(text[:end])
        assert log.channels["x_mm"].values.tolist() == [10, 200, 300][:complete]
        cut = not text[:end].endswith("\n")
        assert log.notes == (("the last line has no line end, so it may be cut off: left out",) if cut else ())


def test_what_a_file_promises_is_compared() -> None:
    assert read("# rows: 3\n" + GOOD).notes == ("the file promises 3 samples, 2 complete ones arrived",)
    assert read("# rows: 2\n# machine: A\n" + GOOD).metadata == {"machine": "A"}
    assert read("# rows: 2\n" + GOOD).notes == ()


FOREIGN = {
    "numbers only": b"0 1.5\n1 2.5\n",
    "one column without a unit": b"CURRENT\n0.5\n0.25\n",
    "SHDR": b"2012-02-21T23:59:33.460470Z|Xact|1.0|Yact|2.0\n2012-02-21T23:59:34.460470Z|Xact|1.5|Yact|2.5\n",
    "prose": b"Dear reader, how are you,\nall is, well,\n",
    "TOML": b"name = 'x'\n[a]\nb = 1\n",
    "a header only": b"time_s,x_mm\n",
    "more cells than headers": b"x,y\n1,2,3\n",
    "zero bytes": b"x,y\n1,\0\n",
}


@pytest.mark.parametrize("data", FOREIGN.values(), ids=FOREIGN.keys())
def test_the_detector_is_strict(data: bytes) -> None:
    assert not can_read(data)


def test_blocks_do_not_show() -> None:
    rows = 30_000
    x = np.random.default_rng(1).normal(size=rows)
    lines = "".join(f"{k},{v!r},{'run' if k % 7 else ''}\n" for k, v in enumerate(x.tolist()))
    text = f"time_ms,x_mm,State\n{lines}"
    assert len(text) > 3 * (1 << 18)
    channel = read(text).channels["x_mm"]
    assert channel.values.tobytes() == x.tobytes()
    assert channel.time is not None
    np.testing.assert_array_equal(channel.time, np.arange(rows) / 1000)


def test_a_bad_line_far_down_is_named_by_its_number() -> None:
    text = "time_ms,x_mm\n" + "".join(f"{k},1.000000000\n" for k in range(60_000))
    bad = 50_000
    lines = text.splitlines()
    lines[bad - 1] += ",7"
    assert len(text) > 3 * (1 << 18)
    assert f"f: line {bad} has 3 cells, the header has 2" in refused("\n".join(lines) + "\n")


def test_memory_stays_within_ten_times_the_file() -> None:
    data = ("time_ms,x_mm,y_mm\n" + "".join(f"{k},{k / 7:.6f},{-k / 3:.6f}\n" for k in range(60_000))).encode()
    tracemalloc.start()
    read_csv_log(data, "f")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 10 * len(data)


def test_a_recorded_run_of_a_real_mill() -> None:
    file = MILL / "experiment_01.csv"
    if not file.is_file():
        pytest.skip("the recorded data of the University of Michigan are not here; see docs for where they come from")
    log = read(file.read_bytes())
    assert log.notes == (
        "column 1 counts the rows: left out",
        "columns of text, left out: Machining_Process, tool_condition",
    )
    assert len(log.channels) == 47
    current = log.channels["X1_CurrentFeedback"]
    assert (current.unit, current.time, len(current.values)) == ("", None, 1055)
    assert current.values[:2].tolist() == [0.18, -10.9]
    by_hand = np.genfromtxt(file, delimiter=",", skip_header=1, usecols=range(1, 48))
    for column, channel in enumerate(log.channels.values()):
        np.testing.assert_array_equal(channel.values, by_hand[:, column])

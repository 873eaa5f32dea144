import datetime
import io

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.logs.parquet import _sample, can_read, read_parquet_log, read_recording
from elastogeo.formats.recording_files import (
    Gap,
    PartHead,
    RecordedChannel,
    Samples,
    encode_part,
    part_name,
    read_table,
    said_time,
    standing_gaps,
)

MS = 10**6


def packed(columns, metadata=None):
    sink = io.BytesIO()
    pq.write_table(pa.table(columns).replace_schema_metadata(metadata or {}), sink)
    return sink.getvalue()


def samples(*rows):
    """Rows of channel number, time [ns], value, status, filled."""
    channel, time, value, status, filled = zip(*rows, strict=True) if rows else ((),) * 5
    return Samples(
        np.array(channel, dtype=np.int32),
        np.array(time, dtype=np.int64),
        np.array(value, dtype=np.float64),
        np.array(status, dtype=np.uint32),
        np.array(filled, dtype=np.bool_),
    )


def head(*gaps, filled=(), unit="mm"):
    channels = (RecordedChannel("x", unit, "i=1", 0, None), RecordedChannel("current", "A", "i=2", 0, None))
    return PartHead("opc.tcp://m:4840", channels, gaps, filled)


def folder_of(path, *parts):
    for number, (said, rows) in enumerate(parts, 1):
        (path / part_name(number)).write_bytes(encode_part(said, samples(*rows)))
    return path


def test_a_part_is_read_with_its_own_clock_for_each_channel():
    zero = 1_763_726_060_123_456_000
    rows = [(0, zero + 5 * MS, 1.5, 0, False), (1, zero, -2.0, 0, False), (0, zero + 25 * MS, 1e-300, 0, False)]
    log = read_parquet_log(encode_part(head(), samples(*rows)), "f")
    assert log.channels["x"].values.tolist() == [1.5, 1e-300]
    assert log.channels["x"].time.tolist() == [0.005, 0.025]
    assert (log.channels["x"].unit, log.channels["current"].unit) == ("mm", "A")
    assert log.channels["current"].time.tolist() == [0.0]
    assert log.metadata == {"server": "opc.tcp://m:4840", "start": "2025-11-21T11:54:20.123456Z"}
    assert log.notes == ()


@settings(derandomize=True, deadline=None)
@given(st.dictionaries(st.integers(-(2**62), 2**62), st.floats(allow_infinity=False), min_size=1, max_size=30))
def test_numbers_survive_bit_for_bit(sent):
    rows = [(0, time, value, 0, False) for time, value in sent.items()]
    table = read_table(encode_part(head(), samples(*rows)), "f")
    assert table.column("time").cast("int64").to_pylist() == list(sent)
    assert table.column("value").to_numpy().tobytes() == np.array(list(sent.values())).tobytes()


@settings(derandomize=True, deadline=None)
@given(st.dictionaries(st.integers(0, 2**52), st.floats(allow_infinity=False, allow_nan=False), min_size=1, max_size=30))
def test_a_log_has_the_numbers_of_its_file_in_their_order(sent):
    rows = [(0, time, value, 0, False) for time, value in sent.items()]
    wide = {"t_ns": pa.array(list(sent), pa.int64()), "x": list(sent.values())}
    for data, zero in ((encode_part(head(), samples(*rows)), min(sent)), (packed(wide), 0)):
        channel = read_parquet_log(data, "f").channels["x"]
        assert channel.values.tobytes() == np.array([sent[time] for time in sorted(sent)]).tobytes()
        assert channel.time.tolist() == [(time - zero) / 1e9 for time in sorted(sent)]


def test_a_bad_sample_is_a_sample_without_a_number():
    rows = [(0, 1, 5.0, 0, False), (0, 2, 7.0, 0x80050000, False), (0, 3, 8.0, 0x40000000, False)]
    log = read_parquet_log(encode_part(head(), samples(*rows)), "f")
    np.testing.assert_array_equal(log.channels["x"].values, [5.0, np.nan, 8.0])
    assert log.notes == ("1 samples are bad, says their source: given without a number",)


def test_a_folder_is_one_log_in_the_order_of_time_with_its_gaps(tmp_path):
    gap, other = Gap("x", 20, 50, "cut"), Gap("current", 10, None, "the end")
    folder = folder_of(
        tmp_path,
        (head(), [(0, 10, 1.0, 0, False), (0, 20, 2.0, 0, False), (1, 10, 9.0, 0, False)]),
        (head(gap, other), [(0, 50, 5.0, 0, False)]),
        (head(Gap("x", 30, 50, "cut"), filled=(gap,)), [(0, 30, 3.0, 0, True), (0, 20, 2.0, 0, True)]),
    )
    log = read_recording(folder)
    assert log.channels["x"].values.tolist() == [1.0, 2.0, 3.0, 5.0]
    assert log.channels["x"].time.tolist() == [0.0, 1e-8, 2e-8, 4e-8]
    assert log.notes == (
        "samples may be missing: current from 1970-01-01T00:00:00.00000001Z to the end of the recording (the end)",
        "samples may be missing: x from 1970-01-01T00:00:00.00000003Z to 1970-01-01T00:00:00.00000005Z (cut)",
        "2 samples were fetched afterwards, from the source's history",
        "x: 1 samples arrived twice: taken once",
    )


def test_what_is_not_in_order_is_told(tmp_path):
    rows = [(0, 30, 3.0, 0, False), (0, 10, 1.0, 0, False), (0, 10, 1.5, 0, False)]
    log = read_recording(folder_of(tmp_path, (head(), rows)))
    assert log.channels["x"].values.tolist() == [1.0, 3.0]
    assert log.notes == (
        "x: the clock goes back 1 times: the samples were put in its order",
        "x: 1 samples have another value at a time that has one: the first is taken",
    )


def test_many_gaps_are_counted(tmp_path):
    gaps = [Gap("x", k, k + 1, "cut") for k in range(30)]
    notes = read_recording(folder_of(tmp_path, (head(*gaps), [(0, 1, 1.0, 0, False)]))).notes
    assert len(notes) == 21
    assert notes[-1] == "samples may be missing in 10 more gaps"


def test_folders_that_will_not_do(tmp_path):
    with pytest.raises(FormatError, match="holds no part of a recording"):
        read_recording(tmp_path)
    with pytest.raises(FormatError, match="nowhere: cannot be opened"):
        read_recording(tmp_path / "nowhere")
    folder_of(tmp_path, (head(), [(0, 1, 1.0, 0, False)]), (head(unit="um"), [(0, 2, 1.0, 0, False)]))
    with pytest.raises(FormatError, match="channel 'x' is in 'mm' and in 'um'; move the parts of one unit"):
        read_recording(tmp_path)
    (tmp_path / part_name(2)).rename(tmp_path / part_name(4))
    (tmp_path / part_name(4)).write_bytes(encode_part(head(), samples((0, 2, 1.0, 0, False))))
    assert read_recording(tmp_path).notes == ("2 parts are not there any more (the first: 2); their samples are missing",)
    (tmp_path / part_name(4)).write_bytes(packed({"channel": ["x"], "value": [1.0], "time_s": [1.0]}))
    with pytest.raises(FormatError, match=r"part-000004\.parquet: is no part of a recording"):
        read_recording(tmp_path)
    (tmp_path / part_name(4)).write_bytes(b"PAR1")
    with pytest.raises(FormatError, match=r"part-000004\.parquet: the Parquet file is cut off"):
        read_recording(tmp_path)


def test_gaps_stand_until_they_are_filled():
    one, two = Gap("x", 1, 5, "a"), Gap("x", 5, 9, "b")
    assert standing_gaps([head(two), head(one)]) == (one, two)
    assert standing_gaps([head(one, two), head(filled=(one,))]) == (two,)
    assert standing_gaps([head(Gap("x", 1, None, "a")), head(one)]) == (one,)
    assert standing_gaps([head(one, filled=(one,))]) == ()


def test_a_column_for_each_channel():
    stamps = pa.array(
        [datetime.datetime(2026, 1, 2, tzinfo=datetime.UTC) + datetime.timedelta(milliseconds=k) for k in (0, 4)]
    )
    data = packed({"when": stamps, "current_x_A": [1, 2], "X1_C": [0.5, None], "ok": [True, False], "program": ["a", "b"]})
    log = read_parquet_log(data, "f")
    assert list(log.channels) == ["current_x_A", "X1_C", "ok"]
    assert log.channels["current_x_A"].unit == "A"
    assert log.channels["ok"].values.tolist() == [1.0, 0.0]
    np.testing.assert_array_equal(log.channels["X1_C"].values, [0.5, np.nan])
    assert log.channels["X1_C"].time.tolist() == [0.0, 0.004]
    assert log.metadata == {"start": "2026-01-02T00:00:00Z"}
    assert log.notes == (
        "column X1_C: 1 of 2 samples have no number, kept as such",
        "columns of no numbers, left out: program",
    )


@pytest.mark.parametrize(
    ("clock", "values", "time"),
    [
        ("time_s", [0.5, 0.1 + 0.2], [0.1 + 0.2, 0.5]),
        ("Time [ms]", [1.0, 5.0], [0.001, 0.005]),
        ("timestamp_us", pa.array([7, 9], pa.int32()), [7e-6, 9e-6]),
    ],
)
def test_clocks_of_numbers_are_taken_as_they_are(clock, values, time):
    log = read_parquet_log(packed({clock: values, "force_N": [1.0, 2.0]}), "f")
    assert log.channels["force_N"].time.tolist() == time
    assert "start" not in log.metadata


def test_a_file_without_a_clock_is_read_without_one():
    assert read_parquet_log(packed({"force_N": [1.0, 2.0]}, {"machine": "A"}), "f").channels["force_N"].time is None


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"channel": ["x"], "value": [1.0]}, "a log needs channel, value and time_s"),
        ({"channel": ["x", None], "value": [1.0, 2.0], "time_s": [1.0, 2.0]}, "a sample has no channel"),
        ({"channel": ["x", "y"], "value": [1.0, 2.0], "time_s": [1.0, None]}, "1 samples have no time in column time_s"),
        ({"channel": ["x"], "value": ["a"], "time_s": [1.0]}, "column value does not hold numbers"),
        ({"channel": ["x"], "value": [1.0], "time_s": [1e300]}, "holds times that are no times"),
        ({"time_s": [1.0, 1.0], "x": [1.0, 2.0]}, "samples 1 and 2 are both of 1 and differ"),
        ({"time_s": [1.0, None], "x": [1.0, 2.0]}, "1 samples have no time in column time_s"),
        ({"a": ["x"]}, "holds no channel of numbers"),
        ({"x": pa.array([], pa.float64())}, "holds no channel of numbers"),
        ({"x": [2**53 + 1]}, "column x does not hold numbers that fit a float64"),
        ({f"c{k}": [1.0] for k in range(1001)}, "1001 columns arrived"),
        ({"x": np.zeros(10_000_001)}, "claim to hold 10000001 values, at most"),
    ],
)
def test_files_that_will_not_do(columns, message):
    with pytest.raises(FormatError, match=f"^f: .*{message}|^f, clock 'time_s': {message}"):
        read_parquet_log(packed(columns), "f")


@pytest.mark.parametrize(
    "said",
    [
        b"no json",
        b"{}",
        b"[]",
        b'{"channels": [], "gaps": [], "filled": [], "server": 1}',
        b'{"channels": [{"name": "x"}], "gaps": [], "filled": [], "server": ""}',
        b'{"channels": [], "gaps": [{"channel": "x", "start": "a", "end": 1, "cause": ""}], "filled": [], "server": ""}',
        b'{"channels": [], "gaps": [{"channel": "x", "start": 1e400, "end": 1, "cause": ""}], "filled": [], "server": ""}',
    ],
)
def test_a_damaged_head_is_told(said):
    with pytest.raises(FormatError, match="f: the head of the part is damaged"):
        read_parquet_log(packed({"channel": ["x"], "value": [1.0], "time_s": [1.0]}, {"elastogeo.recording/1": said}), "f")


def test_every_changed_bit_of_a_sample_gives_the_same_log_or_a_format_error():
    data = _sample()
    assert can_read(data)
    whole = read_parquet_log(data, "f")
    values = {name: channel.values.tobytes() for name, channel in whole.channels.items()}
    body = int(data.rindex(b"PAR1")) - int.from_bytes(data[-8:-4], "little") - 4
    for place in range(4, body):
        damaged = bytearray(data)
        damaged[place] ^= 1 << place % 8
        try:
            log = read_parquet_log(bytes(damaged), "f")
        except FormatError:
            continue
        assert {name: channel.values.tobytes() for name, channel in log.channels.items()} == values


@pytest.mark.parametrize(
    ("time", "said"),
    [(0, "1970-01-01T00:00:00Z"), (1_500_000_000, "1970-01-01T00:00:01.5Z"), (-1, "1969-12-31T23:59:59.999999999Z")],
)
def test_times_are_said_with_all_their_digits(time, said):
    assert said_time(time) == said
    assert said_time(2**63 - 1) == "2262-04-11T23:47:16.854775807Z"

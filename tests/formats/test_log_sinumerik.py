"""SINUMERIK high-frequency data: layout, clock, order, and what is refused."""

import json
from typing import Any

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.log import Log
from elastogeo.formats.logs.sinumerik import can_read, read_sinumerik

SIGNALS = (("CYCLE", "Cycle"), ("ENC_POS|1", "X1"), ("CURRENT|1", "X1"))


def document(rows: list[Any], signals: Any = SIGNALS, **header: Any) -> dict[str, Any]:
    listed = [{"Name": name, "Type": "DOUBLE", "Axis": axis, "Address": name} for name, axis in signals]
    return {
        "Header": {"SignalListHFData": listed, "CycleTimeMs": 2, **header},
        "Payload": [{"HFData": rows[:2]}, {"HFData": rows[2:]}],
        "Footer": {},
    }


def read(content: Any) -> Log:
    data = content if isinstance(content, bytes) else json.dumps(content).encode()
    return read_sinumerik(data, "f")


def refused(content: Any) -> str:
    with pytest.raises(FormatError) as caught:
        read(content)
    return str(caught.value)


ROWS = [[11, 1.5, 0.25], [12, 2.5, 0.5], [13, 3.5, 0.75]]


def test_the_layout_of_a_recording() -> None:
    """The order of the entries and the keys are those of the public recording that the module names."""
    content = document(
        ROWS, MachineInfo={"MachineName": "M"}, Initial={"Time": "2023-12-22T14:25:56.836Z", "HFProbeCounter": 11}
    )
    content["Payload"].insert(1, {"HFBlockEvent": {"HFProbeCounter": 12, "GCode": "M17"}})
    content["Payload"].append({"HFTimestamp": {"HFProbeCounter": 13, "Time": "2023-12-22T14:25:56.840Z"}})
    content["Payload"].append({"LFData": [{"address": "/Channel/State/actTNumber", "value": "6"}]})
    data = json.dumps(content, indent=2).encode()
    assert can_read(data)
    log = read(data)
    assert list(log.channels) == ["ENC_POS|1", "CURRENT|1"]
    current = log.channels["CURRENT|1"]
    assert (current.values.tolist(), current.unit) == ([0.25, 0.5, 0.75], "")
    assert current.time is not None
    assert current.time.tolist() == [0, 0.002, 0.004]
    assert log.metadata["axis of CURRENT|1"] == "X1"
    assert log.metadata["MachineInfo.MachineName"] == "M"
    assert log.notes == ("not of the high-frequency clock, left out: HFBlockEvent (1), HFTimestamp (1), LFData (1)",)


def test_cycles_left_out_are_a_gap_of_the_clock() -> None:
    time = read(document([[11, 0, 0], [12, 0, 0], [112, 0, 0]])).channels["CURRENT|1"].time
    assert time is not None
    assert time.tolist() == [0, 0.002, 0.202]


def test_the_counter_begins_again_after_31_bits() -> None:
    log = read(document([[2**31 - 2, 1, 0], [2**31 - 1, 2, 0], [0, 3, 0], [1, 4, 0]]))
    channel = log.channels["ENC_POS|1"]
    assert channel.time is not None
    assert channel.time.tolist() == [0, 0.002, 0.004, 0.006]
    assert channel.values.tolist() == [1, 2, 3, 4]
    assert log.notes == ("the cycle counter began again at zero 1 time(s): counted on",)


def test_rows_out_of_order_are_sorted_and_doubled_ones_taken_once() -> None:
    log = read(document([ROWS[2], ROWS[0], ROWS[1], ROWS[1]]))
    assert log.channels["CURRENT|1"].values.tolist() == [0.25, 0.5, 0.75]
    assert log.notes == (
        "the clock goes back once: the samples were put in its order",
        "1 samples stand in the file twice: taken once",
    )
    assert "samples 2 and 3 are both of 12 and differ" in refused(document([[11, 1, 1], [12, 2, 2], [12, 3, 3]]))


def test_what_is_no_number_is_kept_as_such() -> None:
    data = json.dumps(document([[11, None, 0.25], [12, float("nan"), float("inf")], ROWS[2]])).encode()
    assert b"NaN" in data
    log = read(data)
    np.testing.assert_array_equal(log.channels["ENC_POS|1"].values, [np.nan, np.nan, 3.5])
    np.testing.assert_array_equal(log.channels["CURRENT|1"].values, [0.25, np.nan, 0.75])
    assert log.notes == ("samples without a number, kept as such: ENC_POS|1 (2 of 3), CURRENT|1 (1 of 3)",)


def test_a_row_without_its_cycle_is_left_out_and_told() -> None:
    log = read(document([ROWS[0], [None, 2, 2], ROWS[2]]))
    assert log.channels["CURRENT|1"].values.tolist() == [0.25, 0.75]
    assert "1 rows have no cycle: left out" in log.notes


def test_a_file_without_a_counter_or_a_cycle_time_keeps_no_clock() -> None:
    log = read(document([[1, 2], [3, 4]], SIGNALS[1:]))
    assert log.channels["CURRENT|1"].time is None
    assert log.notes == ("the signal CYCLE was not recorded, so the file keeps no clock",)
    for cycle in (None, 0, -1, "2", True, False, float("nan")):
        log = read(document(ROWS, CycleTimeMs=cycle))
        assert log.channels["CURRENT|1"].time is None
        assert log.channels["CYCLE"].values.tolist() == [11, 12, 13]
        assert "keeps no clock; no cycle is left out" in log.notes[-1]
        gap = document([[11, 0, 0], [13, 0, 0]], CycleTimeMs=cycle)
        assert "CYCLE leaves cycles out and Header.CycleTimeMs is" in refused(gap)


WRONG: dict[str, tuple[Any, str]] = {
    "no header": ({"Payload": []}, "has no object 'Header' or no list 'Payload'"),
    "no payload": ({"Header": {}}, "has no object 'Header' or no list 'Payload'"),
    "a list": ([1], "is a JSON list, not an object"),
    "no signals": (document(ROWS, SignalListHFData=[]), "lists no signal"),
    "signals that are none": (
        document(ROWS, SignalListHFData=[{"Axis": "X1"}]),
        "signal 1 of Header.SignalListHFData has no 'Name'",
    ),
    "one signal twice": (document(ROWS, (*SIGNALS[:2], SIGNALS[1])), "lists 'ENC_POS|1' twice"),
    "too many signals": (document(ROWS, [(str(k), "") for k in range(1001)]), "1001 signals arrived, at most 1000"),
    "no rows": (document([]), "holds no row of HFData"),
    "a short row": (document([ROWS[0], ROWS[1], [13, 1]]), "f, Payload entry 2, row 1: 2 numbers arrived for 3 signals"),
    "a long row": (document([ROWS[0], [12, 1, 2, 3]]), "f, Payload entry 1, row 2: 4 numbers arrived for 3 signals"),
    "text": (document([[11, "1.5", 0]]), "f, Payload entry 1, row 1: '1.5' is no number"),
    "truth": (document([[11, True, 0]]), "True is no number"),
    "a list in a row": (document([[11, [1], 0]]), "[1] is no number"),
    "no row": (document([7]), "row 1: 7 arrived for 3 signals"),
    "no cycle": (document([[None, 1, 2]]), "no row has a cycle"),
    "a number beyond floats": (document([[11, 10**400, 0]]), "holds a number that is too large"),
    "entries that are none": ({**document(ROWS), "Payload": [1]}, "entry 1 of Payload is not laid out"),
    "data that are none": ({**document(ROWS), "Payload": [{"HFData": 1}]}, "entry 1 of Payload is not laid out"),
    "too deep": (b'{"Header": ' + b"[" * 200_000, "nested deeper than any recording"),
    "too deep, closed": (b'{"Header": ' + b"[" * 200_000 + b"]" * 200_000 + b"}", "nested deeper than any recording"),
    "thousands of digits": (b'{"Header": ' + b"1" * 10_000 + b"}", "a number of thousands of digits"),
    "no UTF-8": (b'{"Header": "\xff"}', "byte 12 is no UTF-8"),
}


@pytest.mark.parametrize(("content", "message"), WRONG.values(), ids=WRONG.keys())
def test_what_will_not_do_is_told(content: Any, message: str) -> None:
    assert message in refused(content)


@pytest.mark.parametrize("bom", [b"", b"\xef\xbb\xbf"])
def test_a_file_that_is_cut_off_says_at_which_byte(bom: bytes) -> None:
    data = bom + json.dumps(document(ROWS, Description="µ"), ensure_ascii=False).encode()
    read(data)
    for end in (100, len(data) // 2, len(data) - 1):
        assert f"f: the JSON is cut off: it ends at byte {end};" in refused(data[:end])


@pytest.mark.parametrize("bom", [b"", b"\xef\xbb\xbf"])
def test_damage_says_at_which_byte(bom: bytes) -> None:
    data = bom + json.dumps(document(ROWS, Description="µ"), ensure_ascii=False).encode()
    at = data.index(b"2.5")
    assert f"the JSON is damaged at byte {at} (Expecting value)" in refused(data.replace(b"2.5", b"x.5"))


@pytest.mark.parametrize("data", [b'{"a_mm": 1}', b'{"Header": {}}', b'["Header", "SignalListHFData"]', b"\xff\xfe{", b"{"])
def test_other_files_of_that_kind_are_not_claimed(data: bytes) -> None:
    assert not can_read(data)

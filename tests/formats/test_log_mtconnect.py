import random
import tracemalloc
from collections.abc import Iterable

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import read_log_bytes
from elastogeo.formats.logs.mtconnect import can_read, read_mtconnect
from elastogeo.formats.logs.mtconnect_observations import MAX_ITEMS
from elastogeo.formats.text.xml_elements import MAX_ELEMENTS


def observation(
    second: object, sequence: object, value: object, item: str = "x1", tag: str = "Position", more: str = 'name="Xact"'
) -> str:
    at = f'timestamp="2026-01-31T12:00:{second}Z" sequence="{sequence}"'
    return f'<{tag} dataItemId="{item}" {at} {more}>{value}</{tag}>'


def series(second: object, sequence: int, values: str, rate: str = "100", count: int | None = None, item: str = "x2") -> str:
    count = len(values.split()) if count is None else count
    more = f'name="I" sampleCount="{count}"' + (f' sampleRate="{rate}"' if rate else "")
    return observation(second, sequence, values, item, "AmperageTimeSeries", more)


def stream(samples: Iterable[str] = (), events: Iterable[str] = (), conditions: Iterable[str] = ()) -> bytes:
    parts = f"<Samples>{''.join(samples)}</Samples><Events>{''.join(events)}</Events>"
    parts += f"<Condition>{''.join(conditions)}</Condition>"
    return (
        '<?xml version="1.0" encoding="UTF-8"?><MTConnectStreams xmlns="urn:mtconnect.org:MTConnectStreams:1.7">'
        '<Header creationTime="2026-01-31T12:01:00Z" sender="a test" instanceId="7" version="1.7.0"/><Streams>'
        f'<DeviceStream name="mill" uuid="u"><ComponentStream component="Linear" componentId="x">{parts}</ComponentStream>'
        "</DeviceStream></Streams></MTConnectStreams>"
    ).encode()


FOUR = [observation(f"0{k}.5", k + 1, k * 0.25) for k in range(4)]


def values_of(data: bytes, name: str = "Xact") -> tuple[list[float], list[float], tuple[str, ...]]:
    log = read_mtconnect(data, "f")
    channel = log.channels[name]
    assert channel.time is not None
    return channel.values.tolist(), channel.time.tolist(), log.notes


def test_known_numbers_times_and_header() -> None:
    log = read_log_bytes(stream(FOUR), "f")
    assert values_of(stream(FOUR)) == ([0.0, 0.25, 0.5, 0.75], [0.0, 1.0, 2.0, 3.0], ())
    assert log.channels["Xact"].unit == ""
    assert log.metadata == {
        "creationTime": "2026-01-31T12:01:00Z",
        "sender": "a test",
        "instanceId": "7",
        "version": "1.7.0",
        "device": "mill",
        "start": "2026-01-31T12:00:00.500000000Z",
    }


def test_the_time_of_a_series_is_that_of_its_last_value() -> None:
    data = stream([*FOUR, series("02.5", 9, "1 2 3"), series("02.53", 10, "4 UNAVAILABLE 6")])
    values, time, _ = values_of(data, "I")
    assert values[:4] == [1.0, 2.0, 3.0, 4.0]
    assert np.isnan(values[4])
    assert time == pytest.approx([1.98, 1.99, 2.0, 2.01, 2.02, 2.03], abs=1e-12)


def test_all_channels_share_the_zero_of_the_earliest() -> None:
    data = stream([observation("10", 1, 1), observation("09.75", 2, 5, "x3", more='name="Yact"')])
    log = read_mtconnect(data, "f")
    assert {name: c.time.tolist() for name, c in log.channels.items() if c.time is not None} == {
        "Xact": [0.25],
        "Yact": [0.0],
    }


def test_order_and_repetition_are_put_right_with_a_note() -> None:
    expected = ([0.0, 0.25, 0.5, 0.75], [0.0, 1.0, 2.0, 3.0])
    mixed = values_of(stream([FOUR[2], FOUR[0], FOUR[3], FOUR[1]]))
    assert mixed == (*expected, ("Xact: at 2 places time went back; the observations are put in its order",))
    doubled = values_of(stream(FOUR + FOUR))
    assert doubled[:2] == expected
    assert doubled[2] == (
        "Xact: at 1 places time went back; the observations are put in its order",
        "Xact: 4 repeated observations are left out",
    )
    twice = [series("01", 5, "1 2"), series("01", 5, "1 2")]
    assert values_of(stream([*FOUR, *twice]), "I")[0] == [1.0, 2.0]


def test_of_two_values_at_one_time_the_later_sequence_is_kept() -> None:
    many = [observation(f"{k:02d}", k, k) for k in range(10, 31)]
    values, time, notes = values_of(stream([observation("20", 99, -1), *many]))
    assert (len(time), values[time.index(10.0)]) == (21, -1.0)
    assert "Xact: of different values at one time the last is kept (1 left out)" in notes


def test_nanoseconds_zones_and_their_lack() -> None:
    one = '<P dataItemId="a" timestamp="2026-01-31T13:00:00.000000001+01:00" sequence="1">1</P>'
    two = '<P dataItemId="a" timestamp="2026-01-31T12:00:00.000000004" sequence="2">2</P>'
    values, time, notes = values_of(stream([one, two]), "a")
    assert (values, notes) == ([1.0, 2.0], ("times without a zone are taken as UTC",))
    assert time == pytest.approx([0.0, 3e-9], abs=1e-20)


def test_what_is_left_out_is_noted() -> None:
    events = [observation("00", 20, "ACTIVE", "e1", "Execution", 'name="mode"')]
    events += [observation("01", 21, "3", "e2", "PartCount", 'name="parts"')]
    events += [observation("01", 22, '<Entry key="a">1</Entry>', "e3", "VariableDataSet", 'name="vars" count="1"')]
    samples = [*FOUR, observation("04", 30, "UNAVAILABLE", "x8", more='name="never"'), series("05", 31, "1 2", rate="")]
    samples += [observation("05", 32, "1 2 3", "x9", "PathPosition", 'name="path"')]
    log = read_mtconnect(stream(samples, events, ["<Normal/>", "<Fault/>"]), "f")
    assert list(log.channels) == ["Xact", "parts"]
    assert log.notes == (
        "3 items of text are left out: path ('1 2 3'), mode ('ACTIVE'), vars ('a set')",
        "1 items that were never available are left out: never",
        "time series without a sample rate are left out: I",
        "2 conditions are left out",
        "1 entries of data sets and tables are left out",
    )


def test_an_unavailable_value_is_nan() -> None:
    values = values_of(stream([*FOUR, observation("09", 9, "UNAVAILABLE")]))[0]
    assert np.isnan(values).tolist() == [False] * 4 + [True]


def test_units_only_where_the_observation_gives_a_known_one() -> None:
    known = stream([observation("00", 1, 1, more='name="a" units="mm"'), observation("00", 2, 1, "y", more='units="BARN"')])
    assert {name: c.unit for name, c in read_mtconnect(known, "f").channels.items()} == {"a": "mm", "y": ""}


def test_items_of_one_name_are_told_apart_by_their_id() -> None:
    data = stream([observation("00", 1, 1, "x"), observation("00", 2, 2, "y")])
    assert {n: c.values.tolist() for n, c in read_mtconnect(data, "f").channels.items()} == {
        "Xact (x)": [1.0],
        "Xact (y)": [2.0],
    }


BAD = {
    "sequence 3 and 3 are of one time with different values, as 1 and 2": stream(
        [observation("00", 3, 1), observation("00", 3, 2), *FOUR]
    ),
    "Xact: 5 of 10 observations have the time of another": stream([observation(f"0{k // 2}", k, k) for k in range(10)]),
    "'Xact', sequence 5: the sample '1,5' is not a finite number": stream([observation("00", 5, "1,5")]),
    "the sample '' is not a finite number": stream([observation("00", 5, "")]),
    "the sample 'NaN' is not a finite number": stream([observation("00", 5, "NaN")]),
    "the sample '1e999' is not a finite": stream([observation("00", 5, "1e999")]),
    "sequence none: has no sequence number": stream([observation("00", "", 1)]),
    "has no dataItemId": stream([observation("00", 1, 1, "")]),
    "the time '2026-01-31T12:00:61Z' is no date|the time '2026-01-31T12:00:61' is no": stream([observation("61", 1, 1)]),
    "the time '2026-01-31T12:00:noonZ' is not one as": stream([observation("noon", 1, 1)]),
    "finer than a nanosecond": stream([observation("00.0000000001", 1, 1)]),
    "promises 4 samples, 3 arrived": stream([series("01", 1, "1 2 3", count=4)]),
    "'x' in the time series is not a finite number": stream([series("01", 1, "1 x")]),
    "the sample rate '0' is not one in Hz": stream([series("01", 1, "1 2", rate="0")]),
    "the time series of sequence 2 begins before the one before it ends": stream(
        [series("01", 1, "1 2 3"), series("01.01", 2, "4 5 6")]
    ),
    "holds no data item of numbers that was ever available": stream(events=[observation("00", 1, "ACTIVE")]),
    "is <MTConnectDevices>, not <MTConnectStreams>": b"<MTConnectDevices/>",
    "the XML is damaged, cut off or not allowed": stream(FOUR)[:-30],
    "DTDForbidden": b"<!DOCTYPE a [<!ENTITY b 'c'>]><MTConnectStreams>&b;</MTConnectStreams>",
    "has too many elements": b"<MTConnectStreams>" + b"<a/>" * (2 * MAX_ELEMENTS) + b"</MTConnectStreams>",
    "more than 2000 data items": stream(observation("00", k, 1, f"x{k}") for k in range(MAX_ITEMS + 1)),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*({message})"):
        read_mtconnect(BAD[message], "f")


def test_a_stream_may_hold_more_elements_than_a_tree() -> None:
    many = [observation(f"{k // 1000:02d}.{k % 1000:03d}", k + 1, k) for k in range(MAX_ELEMENTS + 5000)]
    data = stream(many)
    assert values_of(data)[0] == list(range(MAX_ELEMENTS + 5000))


def test_observations_take_little_memory() -> None:
    data = stream(observation(f"{k // 1000:02d}.{k % 1000:03d}", k + 1, k) for k in range(3000))
    tracemalloc.start()
    try:
        read_mtconnect(data, "f")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 10 * len(data)


def test_a_series_takes_little_memory() -> None:
    data = stream([series(f"{k:02d}", k + 1, "0.125 " * 5000, rate="5000") for k in range(20)])
    tracemalloc.start()
    try:
        read_mtconnect(data, "f")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 10 * len(data)


def test_xml_of_other_kinds_is_not_claimed() -> None:
    for data in (b"<a/>", b"<MTConnectDevices/>", b"MTConnectStreams", b"a <MTConnectStreams>", b""):
        assert not can_read(data)
    assert can_read(b"\xef\xbb\xbf\n<!-- made by a test --><m:MTConnectStreams>")


def test_changed_bytes_give_a_log_or_a_format_error() -> None:
    data, rng = stream([*FOUR, series("09", 9, "1 2 3"), FOUR[0]]), random.Random(2)
    for _ in range(2000):
        changed = bytearray(data)
        for _ in range(rng.randint(1, 3)):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        message = "f"
        try:
            read_mtconnect(bytes(changed), "f")
        except FormatError as error:
            message = str(error)
        assert message.startswith("f")

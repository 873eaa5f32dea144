import random

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import read_log_bytes
from elastogeo.formats.logs.shdr import can_read, read_shdr

DAY = "2026-01-31T12:00:"


def lines(*texts: str) -> bytes:
    """Lines of an adapter; `00.5|...` stands for a time of that second."""
    return "".join((f"{DAY}{text}" if text[:2].isdigit() else text) + "\n" for text in texts).encode()


FOUR = [f"0{k}.5Z|Xact|{k * 0.25}|Xload|{10 + k}" for k in range(4)]


def of(data: bytes, name: str) -> tuple[list[float], list[float]]:
    channel = read_shdr(data, "f").channels[name]
    assert channel.time is not None
    return channel.values.tolist(), channel.time.tolist()


def test_known_numbers_and_times() -> None:
    log = read_log_bytes(lines("* device: mill", *FOUR), "f")
    assert of(lines(*FOUR), "Xact") == ([0.0, 0.25, 0.5, 0.75], [0.0, 1.0, 2.0, 3.0])
    assert of(lines(*FOUR), "Xload")[0] == [10.0, 11.0, 12.0, 13.0]
    assert {c.unit for c in log.channels.values()} == {""}
    assert log.metadata == {"device": "mill", "start": "2026-01-31T12:00:00.500000000Z"}
    assert log.notes == ()


def test_the_time_series_of_the_agents_readme() -> None:
    data = b"2014-09-29T23:59:33.460470Z|current|10|100|1 2 3 4 5 6 7 8 9 10\n"
    values, time = of(data, "current")
    assert values == list(range(1, 11))
    assert time == pytest.approx([0.01 * k for k in range(10)], abs=1e-12)
    assert read_shdr(data, "f").metadata == {"start": "2014-09-29T23:59:33.370470000Z"}


def test_other_lines_of_the_agents_readme_are_left_out_with_notes() -> None:
    log = read_shdr(
        lines(
            "* PONG 10000",
            "* manufacturer: XXX",
            "00Z|power|ON|execution|ACTIVE|line|412|Xact|-1.1761875153|Yact|1766618937",
            "01Z|htemp|WARNING|HTEMP|1|HIGH|Oil Temperature High",
            "01Z|htemp|UNAVAILABLE||||",
            "02Z|message|CHG_INSRT|Change Inserts",
            '02Z|description|"Text with \\| (pipe) character."',
            "03Z@100.0|pcount|0:DAY",
            "03Z|vars|v1=10 v2=20 v3=30",
            "04Z|device1:current|12|device2:current|11|device3:current|10",
            "05Z|@ASSET@|KSSP300R.1|CuttingTool|--multiline--0FED07ACED",
            "<CuttingTool>|",
            "--multiline--0FED07ACED",
            "06Z|@REMOVE_ASSET@|KSSP300R.1",
        ),
        "f",
    )
    assert {name: c.values.tolist() for name, c in log.channels.items()} == {
        "line": [412.0],
        "Xact": [-1.1761875153],
        "Yact": [1766618937.0],
        "pcount": [0.0],
        "device1:current": [12.0],
        "device2:current": [11.0],
        "device3:current": [10.0],
    }
    assert log.metadata["manufacturer"] == "XXX"
    assert log.notes == (
        "4 items of text are left out: power ('ON'), execution ('ACTIVE'), description ('Text with | (pipe) character.'), "
        "vars ('v1=10 v2=20 v3=30')",
        "2 conditions are left out",
        "1 messages are left out",
        "1 durations of statistics are left out",
        "2 assets are left out",
        "counters were reset: pcount 1 times",
    )


def test_relative_times_are_milliseconds() -> None:
    log = read_shdr(b"* relativeTime: yes\n100|Xact|1\n350.5|Xact|2\n", "f")
    time = log.channels["Xact"].time
    assert time is not None
    assert time == pytest.approx([0.0, 0.2505])
    assert log.metadata == {"relativeTime": "yes"}


def test_order_and_repetition_are_put_right_with_a_note() -> None:
    mixed = lines(FOUR[2], FOUR[0], FOUR[3], FOUR[1])
    assert of(mixed, "Xact") == of(lines(*FOUR), "Xact")
    assert read_shdr(mixed, "f").notes[0] == "Xact: at 2 places time went back; the observations are put in its order"
    doubled = lines(*(line for line in FOUR for _ in range(2)))
    assert of(doubled, "Xact") == of(lines(*FOUR), "Xact")
    assert read_shdr(doubled, "f").notes == tuple(f"{n}: 4 repeated observations are left out" for n in ("Xact", "Xload"))


def test_unavailable_is_nan_and_never_available_is_noted() -> None:
    data = lines(*FOUR, "09Z|Xact|UNAVAILABLE|never|unavailable")
    assert np.isnan(of(data, "Xact")[0]).tolist() == [False] * 4 + [True]
    assert read_shdr(data, "f").notes == ("1 items that were never available are left out: never",)


def test_an_item_with_one_text_is_no_channel() -> None:
    log = read_shdr(lines(*FOUR, "09Z|Xload|ERR", "10Z|Xload|5"), "f")
    assert list(log.channels) == ["Xact"]
    assert log.notes == ("1 items of text are left out: Xload ('ERR')",)


BAD = {
    "the last line has no end": lines(*FOUR)[:-3],
    "line 2: begins with 'Xact', which is no time": lines(FOUR[0], "Xact|1"),
    "line 1: begins with '', which is no time": b"|Xact|1\n",
    "line 2: the time '100' is not of the kind of those before": lines(FOUR[0]) + b"100|Xact|1\n",
    "line 1: '1.5' stands where a name belongs": lines("00Z|1.5|2"),
    "line 1: has 5 fields after the time": lines("00Z|a|1|b|2|c"),
    "promises '3' samples of 'a', 2 arrived": lines("00Z|a|3|100|1 2"),
    "'x' in the time series is not a finite number": lines("00Z|a|2|100|1 x"),
    "the sample rate '1e99' is not one in Hz": lines("00Z|a|2|1e99|1 2"),
    "line 2: may be a condition or hold a value of 'b'": lines("00Z|b|1", "01Z|mode|FAULT|b|2|c|3"),
    "an asset has no end '--multiline--1'": lines(FOUR[0], "01Z|@ASSET@|a|b|--multiline--1", "<a/>"),
    "Xact: 4 of 8 observations have the time of another with a different value": lines(
        *(f"0{k // 2}Z|Xact|{k}" for k in range(8))
    ),
    "is no date from 1970": b"1812-01-31T12:00:00Z|Xact|1\n",
    "holds no data item of numbers": lines("00Z|mode|AUTO"),
    "byte 5 is zero": lines(*FOUR)[:5] + b"\0" + lines(*FOUR)[6:],
    "has too many fields or too long text in quotes": lines("00Z|a" + "|" * 3000),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_shdr(BAD[message], "f")


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"* a\n",
        b"angle_deg|radial_um\n0|1\n",
        b"0.5|1|2\n1.5|2|3\n",
        b"2026-01-31T12:00:00Z,Xact,1\n",
        b"| a | b |\n|-|-|\n",
    ],
)
def test_other_text_is_not_claimed(data: bytes) -> None:
    assert not can_read(data)


def test_changed_bytes_give_a_log_or_a_format_error() -> None:
    data, rng = lines(*FOUR, "05Z|I|3|100|1 2 3", '06Z|a|"b"'), random.Random(4)
    for _ in range(2000):
        changed = bytearray(data)
        for _ in range(rng.randint(1, 3)):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        message = "f"
        try:
            read_shdr(bytes(changed), "f")
        except FormatError as error:
            message = str(error)
        assert message.startswith("f")

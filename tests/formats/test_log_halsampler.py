import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import read_log_bytes
from elastogeo.formats.logs.halsampler import can_read, read_halsampler

TAGGED = b"".join(b"%d %.6f %d \n" % (n, n / 8, n % 2) for n in range(20))
PLAIN = b"0.125000 1 -7 \n0.250000 0 -7 \n"


def test_known_numbers_with_the_number_of_each_sample() -> None:
    log = read_log_bytes(TAGGED, "f")
    assert list(log.channels) == ["sample", "0", "1"]
    assert log.channels["sample"].values.tolist() == list(range(20))
    assert log.channels["0"].values.tolist() == [n / 8 for n in range(20)]
    assert all(channel.unit == "" and channel.time is None for channel in log.channels.values())
    assert log.notes == ()


def test_known_numbers_without_sample_numbers() -> None:
    log = read_log_bytes(PLAIN, "f")
    assert {name: c.values.tolist() for name, c in log.channels.items()} == {
        "0": [0.125, 0.25],
        "1": [1.0, 0.0],
        "2": [-7.0, -7.0],
    }


def test_lost_samples_are_counted_where_the_file_numbers_them() -> None:
    data = b"3 1.000000 \n4 1.000000 \noverrun\n9 1.000000 \n10 1.000000 \noverrun\n12 1.000000 \n"
    log = read_halsampler(data, "f")
    assert log.channels["sample"].values.tolist() == [3, 4, 9, 10, 12]
    assert log.notes == ("5 samples were lost in overruns, after row 2, 4",)
    untagged = read_halsampler(b"overrun\n1.000000 \noverrun\n2.000000 \noverrun\n", "f")
    assert untagged.notes == (
        "samples were lost, not known how many, after row 1",
        "an overrun stands before the first row or after the last: samples were lost there",
    )


def test_a_counter_that_is_no_sample_number_stays_a_pin() -> None:
    log = read_halsampler(b"".join(b"%d %.6f \n" % (n * n, n / 8) for n in range(20)), "f")
    assert list(log.channels) == ["0", "1"]
    assert log.channels["0"].values.tolist() == [n * n for n in range(20)]
    assert list(read_halsampler(b"1 \n2 \n3 \n", "f").channels) == ["0"]


def test_values_that_are_no_numbers_are_nan_and_noted() -> None:
    log = read_halsampler(b"1.000000 nan \n2.000000 -inf \n3.000000 4.000000 \n", "f")
    assert np.isnan(log.channels["1"].values).tolist() == [True, True, False]
    assert log.notes == ("1: 2 of 3 samples have no finite number",)


LINES = TAGGED.splitlines(keepends=True)
BAD = {
    "the sample number 3 of row 6 follows 9 without an overrun": b"".join(LINES[5:10] + LINES[3:5] + LINES[5:]),
    "the sample number 8 of row 10 follows 8 without": b"".join(LINES[:9] + LINES[8:]),
    "the sample number 10 of row 10 follows 8 without": b"".join(LINES[:9] + LINES[10:]),
    "the last line has no end, so it may be cut off": TAGGED[:-4],
    "line 2: has 1 values, the first line has 2": b"0 0.500000 \n1 \n",
    "line 2: b'x' is not a line of numbers": b"1 \nx\n",
    "line 1: b'1 2' is not a line of numbers": b"1 2\n",
    "line 1: b'1.5 ' is not a line": b"1.5 \n",
    "has no line of numbers": b"overrun\n",
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_halsampler(BAD[message], "f")


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"overrun\n",
        b"1.0 2.0\n",
        b"1,2\n3,4\n",
        b"1.5 2.5 \n",
        b"time x\n0 1 \n",
        b"0.125000",
        b"1  2 \n",
        b"\n",
        b"1 \n\n",
    ],
)
def test_other_numbers_are_not_claimed(data: bytes) -> None:
    assert not can_read(data)


def test_the_head_of_a_file_may_end_anywhere() -> None:
    assert all(can_read(TAGGED[:end]) for end in range(len(LINES[0]), len(TAGGED)))
    assert can_read(b"overrun\r\n1 -2.000000 \r\n")

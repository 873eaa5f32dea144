import random

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import read_log_bytes
from elastogeo.formats.logs.tncscope import can_read, read_tncscope

KNOWN = ("i ist", "X", "A", 4, 600)


def recording(*rows: str, curves: tuple[tuple[object, ...], ...] = (KNOWN,), more: str = "") -> bytes:
    """A file in the layout that the module's docstring describes."""
    lines = ["%[GLOBAL]", "%NAME=a test", "%"]
    for kind, axis, unit, count, cycle in curves:
        lines += ["%[CURVE]", f"%CHANNELTYPE={kind}", f"%AXISTYPE={axis}", f"%DIMENSION={unit}", f"%COUNT={count}"]
        lines += [f"%CYCLETIME={cycle}", "%"]
    return "\r\n".join([*lines, more, "%[DATA]", *rows, ""]).encode("latin-1")


ROWS = ("0;0.5;", "600;-1.25;", "1200;2e-3;", "1800;1e-17;")


def test_known_numbers_names_units_and_times() -> None:
    log = read_log_bytes(recording(*ROWS), "f")
    channel = log.channels["i ist X"]
    assert channel.values.tolist() == [0.5, -1.25, 0.002, 1e-17]
    assert channel.unit == "A"
    assert channel.time is not None
    assert channel.time == pytest.approx([0.0, 600e-6, 1200e-6, 1800e-6], abs=1e-15)
    assert (log.metadata["NAME"], log.notes) == ("a test", ())


def test_a_slow_channel_has_its_own_clock_and_count() -> None:
    curves = (KNOWN, ("s actual", "Y", "mm", 2, 1800))
    log = read_tncscope(recording("0;1;7;", "600;2;8;", "1200;3;;", "1800;4;;", curves=curves), "f")
    slow = log.channels["s actual Y"]
    assert slow.values.tolist() == [7.0, 8.0]
    assert slow.time is not None
    assert slow.time == pytest.approx([0.0, 0.0018])
    assert log.notes == ()
    padded = read_tncscope(recording("0;1;7;", "600;2;8;", "1200;3;0;", "1800;4;0;", curves=curves), "f")
    assert padded.channels["s actual Y"].values.tolist() == [7.0, 8.0]
    assert padded.notes == ("s actual Y: 2 numbers after its 2 samples are left out",)


def test_what_the_file_does_not_say_is_noted() -> None:
    unknown = read_tncscope(recording(*ROWS, curves=(("DSP-Debug", "X", "id(10)", 4, 600),)), "f")
    assert unknown.channels["DSP-Debug X"].unit == ""
    assert unknown.notes == ("DSP-Debug X: its unit 'id(10)' is not known, so it has none",)
    assert read_tncscope(recording(*ROWS, curves=(("i", "X", "", 4, 600),)), "f").notes == ("i X: the file gives no unit",)
    holes = read_tncscope(recording("0;0.5;", "600;;", "1200;nan;", "1800;4;"), "f")
    assert np.isnan(holes.channels["i ist X"].values).tolist() == [False, True, True, False]
    assert holes.notes == ("i ist X: 2 of 4 samples have no number",)
    steps = read_tncscope(recording("0;1", "1;2", "2;3", "3;4"), "f")
    assert "goes in steps of 1, of no stated unit; the clock is made of the shortest cycle time, 600 us" in steps.notes[0]


def test_two_curves_of_one_name_stay_two() -> None:
    log = read_tncscope(recording("0;1;2;", curves=(("i", "X", "A", 1, 600), ("i", "X", "A", 1, 600))), "f")
    assert {name: c.values.tolist() for name, c in log.channels.items()} == {"i X": [1.0], "i X (2)": [2.0]}


def test_latin_1_and_utf_8_units() -> None:
    curves = (("s", "X", "µm", 4, 600),)
    for data in (recording(*ROWS, curves=curves), recording(*ROWS, curves=curves).decode("latin-1").encode("utf-8-sig")):
        assert can_read(data)
        assert read_tncscope(data, "f").channels["s X"].unit == "µm"


BAD = {
    r"row 3 after .*its time 600 follows 600, .*missing, doubled or out of order": recording(*ROWS[:2], *ROWS[1:3]),
    r"row 2 after .*its time 1200 follows 0": recording(ROWS[0], ROWS[2], ROWS[1], ROWS[3], "2400;1;", "3000;1;"),
    r"row 3 after .*its time 5400 follows 600": recording(*ROWS[:2], "5400;1;", "6000;1;"),
    "COUNT promises 4 samples, 3 rows arrived": recording(*ROWS[:3]),
    r"line 14: has 1 cells, expected are 2": recording("0;1;", "600"),
    "'0,5' is not a finite number; write it with a decimal point": recording("0;0,5;"),
    "'abc' is not a finite number; correct it": recording("0;abc;"),
    "'1e999' is not a finite number": recording("0;1e999;"),
    "no row follows %.DATA": recording(),
    "has no line %.DATA., so it is cut off": recording(*ROWS).split(b"%[DATA]")[0],
    "no %.CURVE. stands before the data": b"%[GLOBAL]\n%\n%[DATA]\n0;1;\n",
    "%CYCLETIME is '0'; a time in microseconds": recording(*ROWS, curves=(("i", "X", "A", 4, 0),)),
    "%COUNT is 'many'": recording(*ROWS, curves=(("i", "X", "A", "many", 600),)),
    "of its first 2 cells 1 are empty, and 1 numbers stand after": recording(
        "0;1;", "600;;", "1200;3;", curves=(("i", "X", "A", 2, 600),)
    ),
    "before %.DATA. each line begins with '%'": b"%[CURVE]\n%CHANNELTYPE=i\nhello\n",
    "the last row has no end": recording(*ROWS).rstrip(b";\r\n"),
    "byte 20 is zero": recording(*ROWS)[:20] + b"\0" + recording(*ROWS)[21:],
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_tncscope(BAD[message], "f")


def test_other_text_with_percent_signs_is_not_claimed() -> None:
    for data in (b"%\nO1000\nN10 G0 X5\n", b"% a comment\n% [CURVE]\n", b"[CURVE]\n%CHANNELTYPE=i\n", b""):
        assert not can_read(data)


def test_changed_bytes_give_samples_or_a_format_error() -> None:
    data, rng = recording(*ROWS), random.Random(5)
    for _ in range(2000):
        changed = bytearray(data)
        for _ in range(rng.randint(1, 3)):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        message, counts = "f", []
        try:
            counts = [len(channel.values) for channel in read_tncscope(bytes(changed), "f").channels.values()]
        except FormatError as error:
            message = str(error)
        assert message.startswith("f")
        assert all(count <= 4 for count in counts)

import re
import time
import tracemalloc
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.runs.csv import can_read, read_csv, write_csv
from elastogeo.formats.text.units import to_internal

FINITE = st.floats(allow_nan=False, allow_infinity=False, width=64)
GOOD = "angle_deg,radial_um\n0,1.5\n90,-2.5\n"


def read(text: str, encoding: str = "utf-8") -> dict[str, list[float]]:
    data = text.encode(encoding)
    assert can_read(data)
    return {name: values.tolist() for name, values in read_csv(data, "run.csv").columns.items()}


SPELLINGS = {
    "comma": GOOD,
    "semicolon": GOOD.replace(",", ";"),
    "tab": GOOD.replace(",", "\t"),
    "bar": GOOD.replace(",", " | "),
    "blanks": GOOD.replace(",", "   "),
    "decimal comma": GOOD.replace(",", ";").replace(".", ","),
    "decimal comma, tab": GOOD.replace(",", "\t").replace(".", ","),
    "decimal comma, blanks": GOOD.replace(",", " ").replace(".", ","),
    "decimal comma, quoted": 'angle_deg,radial_um\n"0","1,5"\n"90","-2,5"\n',
    "brackets": GOOD.replace("angle_deg", "Angle [deg]").replace("radial_um", "Radial (µm)"),
    "brackets and blanks": "angle [deg]  radial [um]\n 0  1.5\n90 -2.5\n",
    "quoted header": GOOD.replace("angle_deg", '"angle_deg"'),
    "CRLF": GOOD.replace("\n", "\r\n"),
    "CR": GOOD.replace("\n", "\r"),
    "no last line end": GOOD.rstrip(),
    "blank lines": "\n" + GOOD.replace("\n", "\n \n\n"),
    "comments": "# one\n% two\n// three\n; four\n" + GOOD + "# five\n",
    "comment between": GOOD.replace("90", "# lunch, 1.5\n; more\n90"),
    "header in a comment": "# made by savetxt\n# angle_deg radial_um\n0 1.5\n90 -2.5\n",
    "exponents": "angle_deg,radial_um\n0e0,+15E-1\n 9e+1 ,-2.5\n",
}


@pytest.mark.parametrize("text", SPELLINGS.values(), ids=SPELLINGS.keys())
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_every_spelling_reads_the_same(text: str, encoding: str) -> None:
    assert read(text, encoding) == {"angle": [0.0, pi / 2], "radial": [1.5 / 1000, -2.5 / 1000]}


def test_metadata_above_the_header() -> None:
    text = "# machine: C 50\ndate = 2024-05-01 12:00\nnote: a, b\n# note: second: line\n# only talk\n" + GOOD
    assert read_csv(text.encode(), "f").metadata == {
        "machine": "C 50",
        "date": "2024-05-01 12:00",
        "note": "a, b\nsecond: line",
    }


BAD = {
    "angle_deg,radial_um\n0,1\n1,x2\n": r"^run.csv: line 3, column radial_um: 'x2' is not a number; correct it",
    "angle_deg,radial_um\n0,\n": "line 2, column radial_um: the cell is empty; fill it in",
    "angle_deg,radial_um\n0,nan\n": "line 2, column radial_um: 'nan' is no reading; take the whole line out",
    "angle_deg,radial_um\n-inf,0\n": "line 2, column angle_deg: '-inf' is no reading",
    "angle_deg,radial_um\n0,1e999\n": "'1e999' is too large for a number",
    "angle_deg,radial_um\n0,1_000\n": "'1_000' seems to have marks for thousands",
    "angle_deg;radial_um\n0;1.234,5\n": "'1.234,5' seems to have marks for thousands",
    "angle_deg;radial_um\n0;1,234,567\n": "'1,234,567' seems to have marks for thousands",
    "angle_deg,radial_um\n0,١\n": "'١' is not a number",
    "angle_deg,radial_um\n0,0x10\n": "'0x10' is not a number",
    "angle_deg,radial_um\n0,1,2\n": "line 2, '0,1,2' has 3 cells, expected are 2 .*separate the columns by semicolons",
    "angle_deg,radial_um\n0\n1,2\n": "line 2, '0' has 1 cell, expected are 2 .*complete the line",
    "angle_deg,radial_um\n0,1\n1": "line 3, '1' has 1 cell.*the file may be cut off here",
    "angle_deg;radial_um\n0;1.5\n1;2,5\n": "line 3, .*'2,5' has the decimal mark ',', but the file uses '.'",
    "angle_deg;radial_um\n0;1,234\n1;12,500\n": "commas, as in '1,234', may be decimal marks or marks for thousands",
    "angle,radial_um\n0,1\n": r"^run.csv, line 1: column 'angle' has no unit: write angle_rad or .*angle_deg",
    "angle [gon],radial_um\n0,1\n": "unit 'gon' of column .* is not known: use length: mm",
    "angle_deg,angle_rad\n0,1\n": "'angle_rad' and 'angle_deg' name the same quantity",
    "angle_deg,radial_um\n# nothing\n": "no reading follows the column header on line 1",
    "0,1\n1,2\n": "^run.csv, line 1: numbers begin without a column header",
    "# only: this\n": "there is no column header; write one",
    "# rows: 3\n" + GOOD: "promises 3 complete lines of readings, 2 arrived; copy it again",
    "# rows: 2\n" + GOOD[:-1]: "promises 2 complete lines of readings, 2 arrived and the last has no end",
    "radial_um\n1e308\n".replace("um", "m"): "reading 1 of column radial is not a finite number",
    "radial_um\n" + "1" * 100_001 + "\n": "line 2 is longer than 100000 characters",
    "radial_um\n1\n" + "1" * 100_001 + "\n": "line 3, is longer than 100000 characters",
    ",".join(f"c{n}_mm" for n in range(1001)) + "\n1\n": "1001 columns arrived, at most 1000 are read",
}


@pytest.mark.parametrize("text", BAD, ids=range(len(BAD)))
def test_bad_file_gets_one_clear_error(text: str) -> None:
    with pytest.raises(FormatError, match=BAD[text]):
        read_csv(text.encode(), "run.csv")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"radial_um\n1\n\0\n", "zero bytes, so it is not text"),
        (GOOD.encode("utf-16")[:-1], "cut off or damaged at byte"),
        (b"# \xc2\xb5m\nradial_um\n1\xff\n", "byte 17 is not UTF-8, but the rest is"),
    ],
)
def test_bytes_that_are_no_text_are_refused(data: bytes, message: str) -> None:
    with pytest.raises(FormatError, match=f"^f: .*{message}"):
        read_csv(data, "f")


def test_all_bad_lines_are_counted_and_five_shown() -> None:
    text = "angle_deg,radial_um\n" + "".join(f"{n},{'x' if n % 3 else n}\n" for n in range(30_000))
    with pytest.raises(FormatError, match=r"^f: 20000 lines cannot be read") as caught:
        read_csv(text.encode(), "f")
    assert re.findall(r"^  line (\d+),", str(caught.value), flags=re.MULTILINE) == ["3", "4", "6", "7", "9"]
    assert str(caught.value).endswith("... and 19995 more")


def test_all_header_problems_are_told_at_once() -> None:
    with pytest.raises(FormatError, match=r"2 column headers cannot be read:\n  column 'angle'.*\n  column 'radial'"):
        read_csv(b"angle,radial\n0,1\n", "f")


@pytest.mark.parametrize("proof", ["0,5", "10,25", "1234,5", ",250", "1,5000", "0,001"])
def test_a_comma_that_cannot_mark_thousands_settles_the_file(proof: str) -> None:
    assert read(f"radial_um;force_N\n1,234;{proof}\n")["radial"] == [1.234 / 1000]


def test_a_line_can_settle_the_decimal_mark() -> None:
    assert read("# decimal: comma\nforce_N;time_s\n1,234;12,500\n") == {"force": [1.234], "time": [12.5]}


@settings(derandomize=True)
@given(st.lists(st.tuples(FINITE, FINITE), min_size=1, max_size=20))
def test_numbers_survive_bit_for_bit(rows: list[tuple[float, float]]) -> None:
    force, radial = np.array(rows).T
    table = read_csv(write_csv({"force_N": force, "radial_um": radial}, {}), "f")
    assert table.column("force").tobytes() == force.tobytes()
    assert table.column("radial").tobytes() == to_internal(radial, "um").tobytes()


TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=20)


@settings(derandomize=True)
@given(st.lists(TEXT, min_size=1, max_size=3), st.sampled_from(["", "=", "+", "-", "@", "'=", "-5", "a,=b;@c"]))
def test_metadata_survives_and_is_no_formula(lines: list[str], start: str) -> None:
    value = "\n".join(" ".join((start + line).split()) for line in lines).strip("\n")
    data = write_csv({"force_N": [1.0]}, {"note": value})
    assert read_csv(data, "f").metadata["note"].strip("\n") == value
    for line in data.decode().split("\n"):
        assert not line.startswith(("=", "+", "-", "@"))
        assert line.startswith('"') or not re.search("[,;\t|]", line)


def test_formula_gets_an_apostrophe_and_numbers_stay_numbers() -> None:
    data = write_csv({"radial_um": [-1.5]}, {"a": "=1+1", "b": "-5", "c": "@x"})
    assert data == b"# rows: 1\n# a: '=1+1\n# b: -5\n# c: '@x\nradial_um\n-1.5\n"


@pytest.mark.parametrize(
    ("columns", "metadata", "message"),
    [
        ({"radial_um": [float("nan")]}, {}, "reading 1 of column radial_um is not a finite number"),
        ({"radial_um": []}, {}, "has the shape"),
        ({"radial_um": [1], "force_N": [1, 2]}, {}, "must exist and have the same length"),
        ({}, {}, "there is no column"),
        ({"radial": [1]}, {}, "column 'radial' has no unit"),
        ({"=cmd()_um": [1]}, {}, "cannot be understood"),
        ({"=cmd_um": [1]}, {}, "'=cmd_um' cannot be written"),
        ({"radial_um": [1]}, {"rows": "7"}, "key 'rows' cannot be written"),
        ({"radial_um": [1]}, {"a: b": "7"}, "key 'a: b' cannot be written"),
    ],
)
def test_what_could_not_be_read_back_is_not_written(
    columns: dict[str, list[float]], metadata: dict[str, str], message: str
) -> None:
    with pytest.raises(FormatError, match=message):
        write_csv(columns, metadata)


PIECES = st.sampled_from(
    [
        "\n",
        "\r",
        ",",
        ";",
        "\t",
        "|",
        '"',
        "#",
        "//",
        "angle_deg",
        "radial [um]",
        "x (mm)",
        "1",
        "1.5",
        "1,234",
        "nan",
        "\0",
        ": ",
        "=",
        "rows: 1",
        "[",
        "(",
        " ",
        "_",
        "µm",
        "\x1c",
        "\N{NO-BREAK SPACE}",
        "😀",
        "force_N;time_s\n1;2\n",
    ]
)


@settings(derandomize=True, max_examples=500)
@given(st.lists(PIECES, max_size=30), st.sampled_from(["utf-8", "utf-16", "utf-8-sig"]))
def test_any_text_gives_a_table_or_a_format_error(pieces: list[str], encoding: str) -> None:
    data = "".join(pieces).encode(encoding)
    can_read(data)
    try:
        message, columns = "", read_csv(data, "f").columns
    except FormatError as error:
        message, columns = str(error), {}
    assert message.startswith("f") == (not columns)
    assert all(np.isfinite(values).all() for values in columns.values())


HEAVY = {
    "one digit": b"level\n" + b"1\n" * 125_000,
    "all bad": b"level\n" + b"x\n" * 125_000,
    "all short": b"x_mm,y_mm\n" + b"1\n" * 125_000,
    "all quoted": b"level\n" + b'"1"\n' * 125_000,
    "all blank": b"level\n1" + b"\n" * 250_000,
    "all comments": b"#a:b\n" * 50_000,
    "all cells": b"level\n" + (b"1," * 49_000 + b"\n") * 10,
    "all headers": b"x_mm," * 19_900 + b"\n1" * 450_000,
    "open brackets": b"x[a(" * 24_900 + b"\n1" * 450_000,
    "quotes": b"x_mm,y_mm\n" + (b'"' * 99_000 + b"\n") * 10,
    "digits": b"x_mm y_mm\n" + (b"0" * 99_000 + b",1 2\n") * 10,
    "wide characters": "level\n# \N{GRINNING FACE}\n".encode() + b"1\n" * 125_000,
}


@pytest.mark.parametrize("data", HEAVY.values(), ids=HEAVY.keys())
def test_a_large_text_of_anything_takes_little_memory(data: bytes) -> None:
    message = ""
    tracemalloc.start()
    try:
        read_csv(data, "f")
    except FormatError as error:
        message = str(error)
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert len(message) < 5000
    assert peak < 10 * len(data)


def test_a_million_values_take_about_a_second_at_most() -> None:
    values = np.linspace(-1, 1, 1_000_000).reshape(4, -1)
    data = write_csv(dict(zip(["x_mm", "y_mm", "z_mm", "force_N"], values, strict=True)), {})
    start = time.process_time()
    table = read_csv(data, "f")
    assert time.process_time() - start < 1
    assert table.column("z").tobytes() == values[2].tobytes()

"""CSV for spreadsheets: numbers stay numbers, and no text becomes a formula."""

import csv
import io
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.report import csv_of

SIGNS = "=+-@"
EVIL = [
    "=1+1",
    "+1+1",
    "-1+1",
    "@SUM(A1)",
    " =1+1",
    "\t=1+1",
    "\r\n=1+1",
    "=cmd|' /C calc'!A0",
    '"=1+1',
    "\uff1d1+1",
    "\ufeff=1+1",
    "harmless;=1+1",
    "harmless\n=1+1",
    "-1e400",
    "-nan",
]


def cells(text, separator=","):
    return list(csv.reader(io.StringIO(text, newline=""), delimiter=separator))


@pytest.mark.parametrize("text", EVIL)
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_no_text_begins_a_formula_whatever_separates_the_cells(text, separator):
    for line in cells(csv_of([{"machine": text}]), separator)[1:]:
        for cell in line:
            assert not cell.strip().strip('"').startswith((*SIGNS, "\uff1d")), cell


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=30))
def test_a_text_comes_back_with_nothing_but_apostrophes_added(text):
    head, *rest = cells(csv_of([{"note": text, "end": "x"}]))
    assert head == ["note", "end"]
    (cell, end) = rest[0]
    assert end == "x"
    assert cell.replace("'", "") == text.replace("'", "")
    if cell and cell.lstrip().startswith(tuple(SIGNS)):
        float(cell)


@settings(max_examples=200, deadline=None)
@given(st.floats(allow_nan=False, allow_infinity=False), st.integers(-(10**12), 10**12))
def test_numbers_come_back_bit_for_bit(number, count):
    for value in (number, np.float64(number)):
        row = cells(csv_of([{"value": value, "tests": count}]))[1]
        assert float(row[0]) == number
        assert math.copysign(1.0, float(row[0])) == math.copysign(1.0, number)
        assert int(row[1]) == count


def test_a_text_that_is_a_number_stays_one_and_one_that_is_not_does_not():
    assert cells(csv_of([{"a": "-12.5", "b": "+3e-7", "c": "-1_000", "d": "- 5", "e": "-inf"}]))[1] == [
        "-12.5",
        "+3e-7",
        "'-1_000",
        "'- 5",
        "'-inf",
    ]


def test_what_is_no_number_is_an_empty_cell_and_lists_are_json():
    row = {
        "none": None,
        "nan": math.nan,
        "inf": math.inf,
        "yes": True,
        "list": np.array([1.0, math.nan]),
        "map": {"a": (1, "=")},
    }
    assert cells(csv_of([row]))[1] == ["", "", "", "true", "[1.0, null]", '{"a": [1, "="]}']


def test_every_name_that_a_row_brings_is_a_column_and_a_name_is_no_formula_either():
    text = csv_of([{"a": 1}, {"=b": 2, "a": 3}])
    assert text == "a,'=b\r\n1,\r\n3,2\r\n"
    assert csv_of([]) == ""

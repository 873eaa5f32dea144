import io

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.runs.parquet import can_read, read_parquet, write_parquet
from elastogeo.formats.text.units import to_internal

FINITE = st.floats(allow_nan=False, allow_infinity=False, width=64)


def packed(columns: dict[str, object]) -> bytes:
    sink = io.BytesIO()
    pq.write_table(pa.table(columns), sink)
    return sink.getvalue()


@settings(derandomize=True, deadline=None)
@given(st.lists(st.tuples(FINITE, FINITE), min_size=1, max_size=20))
def test_numbers_survive_bit_for_bit(rows: list[tuple[float, float]]) -> None:
    force, radial = np.array(rows).T
    data = write_parquet({"force_N": force, "radial [um]": radial}, {"note": "=µ"})
    assert can_read(data)
    table = read_parquet(data, "f")
    assert table.column("force").tobytes() == force.tobytes()
    assert table.column("radial").tobytes() == to_internal(radial, "um").tobytes()
    assert table.metadata == {"note": "=µ"}


@pytest.mark.parametrize("kind", [pa.int8(), pa.uint64(), pa.float32(), pa.float64()])
def test_every_type_of_number_is_read(kind: pa.DataType) -> None:
    table = read_parquet(packed({"force_N": pa.array([1, 2], kind)}), "f")
    assert table.column("force").tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"force_N": [1.0, None]}, "^f: row 2, column force_N: None is no reading; correct it"),
        ({"force_N": pa.array([1, None])}, "row 2, column force_N: None is no reading"),
        ({"force_N": [float("nan")], "time_s": [float("inf")]}, "2 cells cannot be read.*\n.*force_N: nan.*\n.*time_s: inf"),
        ({"force_N": [None] * 7 + [1.0]}, "7 cells cannot be read(.*\n){6}.*and 2 more"),
        ({"force_N": ["a"]}, "column force_N is of type string; store it as numbers"),
        ({"force_N": [[1.0]]}, "column force_N is of type list.*; store it as numbers"),
        ({"force_N": [2**53 + 1]}, "column force_N has integers that a float64 would round"),
        ({"force": [1.0]}, "column 'force' has no unit"),
        ({"force_N": [1.0], "force_kN": [1.0]}, "name the same quantity"),
        ({"force_N": pa.array([], pa.float64())}, "no row of readings"),
        ({"force_N": np.zeros(10_000_001)}, "claim to hold 10000001 readings, at most"),
    ],
)
def test_bad_file_gets_one_clear_error(columns: dict[str, object], message: str) -> None:
    with pytest.raises(FormatError, match=message):
        read_parquet(packed(columns), "f")


def test_cut_file_is_told() -> None:
    data = packed({"force_N": np.arange(1000.0)})
    for end in range(len(data)):
        with pytest.raises(FormatError, match=r"the Parquet file is (cut off|damaged)"):
            read_parquet(data[:end], "f")


def test_one_changed_bit_of_the_readings_is_found() -> None:
    values = np.random.default_rng(1).normal(size=500)
    data = write_parquet({"force_N": values}, {})
    where = data.index(values[250].tobytes())
    for bit in range(64):
        damaged = bytearray(data)
        damaged[where + bit // 8] ^= 1 << bit % 8
        with pytest.raises(FormatError, match="the Parquet file is damaged"):
            read_parquet(bytes(damaged), "f")


def test_what_could_not_be_read_back_is_not_written() -> None:
    with pytest.raises(FormatError, match="reading 1 of column force_N is not a finite number"):
        write_parquet({"force_N": [float("inf")]}, {})

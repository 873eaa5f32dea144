"""Large texts: pyarrow and our own parser read the same, and refuse the same."""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.logs.csv import read_csv_log
from elastogeo.formats.runs.csv import read_csv
from elastogeo.formats.text import rows

CELLS = ["1", "-2.5", "+3e-2", " 4 ", "1e999", "nan", "NaN", "", "Err", "---", "1,5", "2.000", "0x10", "1_000", "7."]
CELLS += ["+-1", "1 2", "-.5", "inf", "null", "99999999999999999999", "1.7976931348623159e308", "2.2250738585072011e-308"]
LINES = st.lists(
    st.tuples(st.sampled_from(CELLS), st.sampled_from(CELLS), st.sampled_from(["run", "5", "a,b", "1.5"])), max_size=12
)


def outcome(data: bytes, large: int) -> object:
    """What both readers make of a text, if texts of this size and more are large."""
    found = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rows, "_LARGE", large)
        for read in (read_csv, read_csv_log):
            try:
                table = read(data, "f")
            except FormatError as error:
                found.append(str(error))
                continue
            columns = table.channels if hasattr(table, "channels") else table.columns
            values = {name: np.asarray(getattr(c, "values", c), dtype=np.float64).tobytes() for name, c in columns.items()}
            found.append((values, getattr(table, "notes", ())))
    return found


@settings(derandomize=True, deadline=None, max_examples=150)
@given(LINES, st.sampled_from([";", ",", "\t", "   "]), st.sampled_from(["", "# five\n", "\n", " "]))
def test_both_parsers_give_the_same_numbers_notes_and_refusals(
    lines: list[tuple[str, ...]], separator: str, between: str
) -> None:
    text = f"x_mm{separator}y_A{separator}State_mm\n" + "".join(separator.join(line) + "\n" + between for line in lines)
    assert outcome(text.encode(), 0) == outcome(text.encode(), 1 << 40)


@settings(derandomize=True, deadline=None, max_examples=60)
@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=40))
def test_both_parsers_read_every_double_bit_for_bit(values: list[float]) -> None:
    data = ("level\n" + "".join(f"{value!r}\n" for value in values)).encode()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rows, "_LARGE", 0)
        assert read_csv(data, "f").column("level").tobytes() == np.array(values).tobytes()


BAD = {"Err": "is not a number", "": "the cell is empty", "nan": "is no reading", "1,5,7": "has 4 cells, expected are 2"}


@pytest.fixture(scope="module")
def large() -> list[bytes]:
    """The lines of a run of 3 MB."""
    values = np.random.default_rng(2).normal(size=(120_000, 2)).round(6)
    return [b"angle_deg,radial_um", *(f"{a},{r}".encode() for a, r in values.tolist())]


@pytest.mark.parametrize("cell", BAD)
def test_a_bad_cell_far_down_a_large_file_is_named_by_line_and_column(cell: str, large: list[bytes]) -> None:
    lines = list(large)
    lines[99_998] = f"1.5,{cell}".encode()
    with pytest.raises(FormatError, match=f"^f: line 99999, .*{BAD[cell]}"):
        read_csv(b"\n".join(lines) + b"\n", "f")


def test_a_large_log_with_an_error_cell_keeps_its_column(large: list[bytes]) -> None:
    lines = [b"time_ms,current_x_A", *(b"%d,%s" % (k, line.split(b",")[1]) for k, line in enumerate(large[1:]))]
    lines[99_998] = b"99997,Err"
    log = read_csv_log(b"\n".join(lines) + b"\n", "f")
    current = log.channels["current_x_A"].values
    assert np.flatnonzero(np.isnan(current)).tolist() == [99_997]
    assert log.notes == (
        "column current_x_A: 1 of 120000 cells is no number ('Err' on line 99999): kept as samples without a number",
    )


def test_a_large_text_is_read_in_little_time_and_memory(large: list[bytes]) -> None:
    """12 MB; 46 MB take a second and 220 MiB by the same code (`make bench`)."""
    resource = pytest.importorskip("resource")
    data = b"\n".join([large[0], *large[1:] * 4]) + b"\n"
    read_csv(data, "f")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    assert read_csv(data, "f").rows == 480_000
    assert time.process_time() - start < 2
    assert (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 < 10 * len(data)


def test_a_small_text_does_not_load_pyarrow(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("angle_deg,radial_um\n0,1\n90,2\n", encoding="utf-8")
    code = f"import sys; from elastogeo.formats import read_run; read_run({str(path)!r}); print('pyarrow' in sys.modules)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout == "False\n"

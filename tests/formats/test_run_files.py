import inspect
import random
import re
import textwrap
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats import run_files
from elastogeo.formats.run_files import RunFormat, read_run, read_run_bytes, register, run_formats
from elastogeo.formats.text import by_content
from elastogeo.formats.text.by_content import HEAD
from elastogeo.formats.text.table import Table


def _registered_toy() -> None:
    """The recipe as it stands in the docstring, registered like any format."""
    found = re.search(r"`runs/toy\.py`::\n\n(.*?)\n\nWhat the contract asks", inspect.getdoc(run_files) or "", re.DOTALL)
    assert found
    exec(compile(textwrap.dedent(found[1]), "runs/toy.py", "exec"), {})


_registered_toy()
FORMATS = list(run_formats().values())
each_format = pytest.mark.parametrize("run_format", FORMATS, ids=lambda f: f.name)


def outcome(run_format: RunFormat, data: bytes) -> Table | None:
    """Read as any input may be read: a table, or None for a format error."""
    assert run_format.can_read(data[:HEAD]) in (True, False)
    message = "f"
    try:
        return run_format.read(data, "f")
    except FormatError as error:
        message = str(error)
    assert message.startswith("f")
    return None


def test_formats_are_found() -> None:
    assert {f.name for f in FORMATS} >= {"delimited text", "Parquet"}


@each_format
def test_only_its_own_detector_knows_a_sample(run_format: RunFormat) -> None:
    head = run_format.sample()[:HEAD]
    assert [f.name for f in FORMATS if f.can_read(head)] == [run_format.name]


@each_format
def test_a_sample_is_read_whatever_its_name(run_format: RunFormat, tmp_path: Path) -> None:
    path = tmp_path / "run.of-no-known-suffix"
    path.write_bytes(run_format.sample())
    table = read_run(path)
    assert table.source == str(path)
    assert table.rows > 1


@each_format
def test_no_prefix_is_taken_for_other_rows(run_format: RunFormat) -> None:
    data = run_format.sample()
    full = run_format.read(data, "f")
    for end in range(len(data)):
        table = outcome(run_format, data[:end])
        assert table is None or table.rows == full.rows


def test_prefixes_of_plain_text_have_the_rows_of_their_lines() -> None:
    data = b"angle_deg,radial_um\n0.5,1.25\n90.5,-2.5e-3\n180.5,7.75\n"
    for end in range(len(data)):
        table = outcome(run_formats()["delimited text"], data[:end])
        lines = data[:end].decode().split("\n")[1:]
        started = len([line for line in lines if line])
        assert table is None or table.rows == started


@each_format
def test_changed_bytes_give_a_table_or_a_format_error(run_format: RunFormat) -> None:
    data, rng = run_format.sample(), random.Random(3)
    for _ in range(500):
        changed = bytearray(data)
        for _ in range(rng.randint(1, 4)):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        outcome(run_format, bytes(changed))


@each_format
@settings(derandomize=True, deadline=None)
@given(tail=st.binary(max_size=300), start=st.integers(0, 40))
def test_any_bytes_give_a_table_or_a_format_error(run_format: RunFormat, tail: bytes, start: int) -> None:
    outcome(run_format, tail)
    outcome(run_format, run_format.sample()[:start] + tail)


@each_format
def test_written_runs_are_read_back(run_format: RunFormat) -> None:
    if run_format.write is not None:
        force = np.random.default_rng(5).normal(size=1000)
        table = read_run_bytes(run_format.write({"force_N": force}, {"machine": "A"}), "f")
        assert table.column("force").tobytes() == force.tobytes()
        assert table.metadata == {"machine": "A"}


OTHERS = [b"[machine]\nname = 'x'\n", b'schema = 1\n[test]\nfiles = ["a"]\n', b"<?xml version='1.0'?><a/>", b'{"a_mm": 1}']
OTHERS += [b"%\nO1000\nN10 G0 X5 Y7\n", b"Dear reader,\nall is well.\n", b"\x89PNG\r\n\x1a\n\0\0", b"Sirs,\n1.5\n"]


@pytest.mark.parametrize("data", OTHERS)
def test_other_files_are_refused_with_the_known_formats(data: bytes) -> None:
    with pytest.raises(FormatError, match=r"^f: begins with b.* known are .*delimited text \(\.csv\)"):
        read_run_bytes(data, "f")


def test_two_claims_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    run_format = FORMATS[0]
    monkeypatch.setattr(run_files, "_FORMATS", {**run_formats(), "twin": replace(run_format, name="twin")})
    with pytest.raises(FormatError, match=f"could be {run_format.name} and twin, so it is not read"):
        read_run_bytes(run_format.sample(), "f")


def test_one_name_is_registered_once() -> None:
    with pytest.raises(FormatError, match="is registered already"):
        register(FORMATS[0])


def test_large_and_empty_and_missing_files_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run.csv"
    with pytest.raises(FormatError, match=r"run\.csv: cannot be opened \(No such file"):
        read_run(path)
    with pytest.raises(FormatError, match="cannot be opened"):
        read_run(tmp_path)
    with pytest.raises(FormatError, match=r"cannot be opened \(embedded null byte\)"):
        read_run("a\0b")
    path.touch()
    with pytest.raises(FormatError, match="the file is empty"):
        read_run(path)
    monkeypatch.setattr(by_content, "MAX_BYTES", 10)
    path.write_bytes(b"force_N\n1.25\n")
    with pytest.raises(FormatError, match="is larger than"):
        read_run(path)


def test_the_toy_of_the_recipe_is_held_to_the_contract() -> None:
    toy = run_formats()["toy"]
    assert toy in FORMATS
    assert read_run_bytes(toy.sample(), "f").column("force").tolist() == [36.0, 742.0]
    with pytest.raises(FormatError, match="f, line 2: b'x' is not a force; correct it"):
        read_run_bytes(b"TOY 1\nx\n", "f")
    with pytest.raises(FormatError, match="the file may be cut off, copy it again"):
        read_run_bytes(toy.sample()[:-3], "f")


def test_a_table_is_read_only_and_names_what_it_has() -> None:
    table = Table({"force": np.array([1.0])}, {}, "f")
    with pytest.raises(ValueError, match="read-only"):
        table.column("force")[0] = 2.0
    with pytest.raises(FormatError, match="f: has no column 'radial'; it has force"):
        table.column("radial")

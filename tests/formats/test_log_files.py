"""The contract of the formats of logs, over all of them."""

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
from elastogeo.formats import log_files
from elastogeo.formats.log import Channel, Log, in_time_order
from elastogeo.formats.log_files import LogFormat, log_formats, read_log, read_log_bytes, register
from elastogeo.formats.run_files import run_formats
from elastogeo.formats.text import by_content
from elastogeo.formats.text.by_content import HEAD
from elastogeo.formats.text.units import UNITS


def _registered_toy() -> None:
    """The recipe as it stands in the docstring, registered like any format."""
    found = re.search(r"`logs/toy\.py`::\n\n(.*?)\n\nWhat the contract asks", inspect.getdoc(log_files) or "", re.DOTALL)
    assert found
    exec(compile(textwrap.dedent(found[1]), "logs/toy.py", "exec"), {})


_registered_toy()
FORMATS = list(log_formats().values())
each_format = pytest.mark.parametrize("log_format", FORMATS, ids=lambda f: f.name)

BOTH = {"delimited text", "Parquet"}
"""Containers that hold runs as well as logs, and whose run format also claims bare numbers to say what they lack. The two
registries answer different questions, what the readings of a run are, and what a controller recorded; which of them is asked
is decided by the test file (`trial_files`), not by these bytes."""


def outcome(log_format: LogFormat, data: bytes) -> Log | None:
    """Read as any input may be read: a log, or None for a format error."""
    assert log_format.can_read(data[:HEAD]) in (True, False)
    message = "f"
    try:
        return log_format.read(data, "f")
    except FormatError as error:
        message = str(error)
    assert message.startswith(("f", "channel ")), message
    return None


def test_formats_are_found() -> None:
    assert {f.name for f in FORMATS} >= {"delimited text", "SINUMERIK high-frequency data"}


@each_format
def test_only_its_own_detector_knows_a_sample(log_format: LogFormat) -> None:
    head = log_format.sample()[:HEAD]
    assert [f.name for f in FORMATS if f.can_read(head)] == [log_format.name]


@each_format
def test_no_detector_of_runs_knows_a_sample_and_none_of_logs_a_run(log_format: LogFormat) -> None:
    runs = [f for f in run_formats().values() if f.name not in BOTH]
    if log_format.name not in BOTH:
        assert not [f.name for f in run_formats().values() if log_format.can_read(f.sample()[:HEAD])]
    assert runs
    assert not [f.name for f in runs if f.can_read(log_format.sample()[:HEAD]) or log_format.can_read(f.sample()[:HEAD])]


@each_format
def test_a_sample_is_read_whatever_its_name(log_format: LogFormat, tmp_path: Path) -> None:
    path = tmp_path / "log.of-no-known-suffix"
    path.write_bytes(log_format.sample())
    log = read_log(path)
    assert log.source == str(path)
    for name, channel in log.channels.items():
        assert channel.name == name
        assert channel.unit in ("", *UNITS)
        assert channel.values.dtype == np.float64
        assert channel.time is None or channel.time.dtype == np.float64
    assert max(len(channel.values) for channel in log.channels.values()) > 1


@each_format
def test_a_prefix_gives_the_first_samples_of_the_whole_or_a_format_error(log_format: LogFormat) -> None:
    data = log_format.sample()
    whole = log_format.read(data, "f")
    for end in range(0, len(data), 1 + len(data) // 2000):
        log = outcome(log_format, data[:end])
        for name, channel in log.channels.items() if log else ():
            known = whole.channels.get(name)
            if known is not None and len(channel.values) > 1:  # one sample of a file without names does not tell a counter
                np.testing.assert_array_equal(channel.values, known.values[: len(channel.values)], err_msg=f"{end} {name}")


@each_format
def test_changed_bytes_give_a_log_or_a_format_error(log_format: LogFormat) -> None:
    data, rng = log_format.sample(), random.Random(3)
    for _ in range(400):
        changed = bytearray(data)
        for _ in range(rng.randint(1, 4)):
            changed[rng.randrange(len(changed))] = rng.randrange(256)
        outcome(log_format, bytes(changed))


@each_format
@settings(derandomize=True, deadline=None)
@given(tail=st.binary(max_size=300), start=st.integers(0, 400))
def test_any_bytes_give_a_log_or_a_format_error(log_format: LogFormat, tail: bytes, start: int) -> None:
    outcome(log_format, tail)
    outcome(log_format, log_format.sample()[:start] + tail)


@each_format
def test_two_readings_share_nothing(log_format: LogFormat) -> None:
    first, second = (log_format.read(log_format.sample(), "f") for _ in range(2))
    name = next(iter(first.channels))
    assert not np.shares_memory(first.channels[name].values, second.channels[name].values)


OTHERS = [b"[machine]\nname = 'x'\n", b'schema = 1\n[test]\nfiles = ["a"]\n', b"<?xml version='1.0'?><a/>", b'{"a_mm": 1}']
OTHERS += [b"%\nO1000\nN10 G0 X5 Y7\n", b"Dear reader,\nall is well.\n", b"\x89PNG\r\n\x1a\n\0\0", b"Sirs,\n1.5\n"]


@pytest.mark.parametrize("data", OTHERS)
def test_other_files_are_refused_with_the_known_formats(data: bytes) -> None:
    with pytest.raises(FormatError, match=r"^f: begins with b.*no known format does; known are .*delimited text \(\.csv\)"):
        read_log_bytes(data, "f")


def test_two_claims_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    log_format = log_formats()["delimited text"]
    monkeypatch.setattr(log_files, "_FORMATS", {**log_formats(), "twin": replace(log_format, name="twin")})
    with pytest.raises(FormatError, match="could be delimited text and twin, so it is not read"):
        read_log_bytes(log_format.sample(), "f")


def test_one_name_is_registered_once() -> None:
    with pytest.raises(FormatError, match="is registered already"):
        register(FORMATS[0])


def test_large_and_empty_and_missing_files_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "log.csv"
    with pytest.raises(FormatError, match=r"log\.csv: cannot be opened \(No such file"):
        read_log(path)
    with pytest.raises(FormatError, match="holds no part of a recording"):
        read_log(tmp_path)
    with pytest.raises(FormatError, match=r"cannot be opened \(embedded null byte\)"):
        read_log("a\0b")
    path.touch()
    with pytest.raises(FormatError, match="the file is empty"):
        read_log(path)
    monkeypatch.setattr(by_content, "MAX_BYTES", 10)
    path.write_bytes(b"time_s,force_N\n0,1.25\n")
    with pytest.raises(FormatError, match="is larger than"):
        read_log(path)


def test_the_toy_of_the_recipe_is_held_to_the_contract() -> None:
    toy = log_formats()["toy"]
    assert toy in FORMATS
    current = read_log_bytes(toy.sample(), "f").channels["current"]
    assert (current.values.tolist(), current.unit) == ([0.5, 0.25], "A")
    assert current.time is not None
    assert current.time.tolist() == [0.0, 0.001]
    cut = read_log_bytes(toy.sample()[:-2], "f")
    assert cut.channels["current"].values.tolist() == [0.5]
    assert cut.notes == ("the last line has no end, so it may be cut off: left out",)
    with pytest.raises(FormatError, match="f, line 2: b'x' is not a current; correct it"):
        read_log_bytes(b"TOYLOG\nx\n", "f")


@pytest.mark.parametrize(
    ("time", "message"),
    [
        ([0.0, 1.0, 1.0], "the time of sample 3 is not after the one before it"),
        ([0.0, -1.0, 1.0], "the time of sample 2 is not after the one before it"),
        ([0.0, np.nan, 1.0], "the time of sample 2 is not"),
        ([np.inf, 1.0, 2.0], "the time of sample 2 is not"),
        ([0.0, 1.0], "has 3 samples at 2 times"),
    ],
)
def test_a_channel_whose_clock_does_not_go_forward_is_refused(time: list[float], message: str) -> None:
    with pytest.raises(FormatError, match=f"channel 'a'.*{message}"):
        Channel("a", "", np.zeros(3), np.array(time))


def test_a_single_sample_without_a_time_is_named() -> None:
    with pytest.raises(FormatError, match="the time of sample 1 is not"):
        Channel("a", "", np.zeros(1), np.array([np.nan]))


def test_an_empty_channel_and_an_empty_log_are_refused() -> None:
    with pytest.raises(FormatError, match="channel 'a' has no sample"):
        Channel("a", "", np.empty(0))
    with pytest.raises(FormatError, match="f: holds no channel of numbers"):
        Log({}, {}, "f")


def test_samples_are_put_in_the_order_of_their_clock() -> None:
    keep, notes = in_time_order(np.array([3.0, 1.0, 2.0, 1.0]), [np.array([3.0, np.nan, 2.0, np.nan])], "f")
    assert keep.tolist() == [1, 2, 0]
    assert notes == (
        "the clock goes back 2 times: the samples were put in its order",
        "1 samples stand in the file twice: taken once",
    )
    keep, notes = in_time_order(np.arange(3.0), [np.zeros(3)], "f")
    assert (keep.tolist(), notes) == ([0, 1, 2], ())


def test_two_samples_of_one_moment_are_an_error() -> None:
    with pytest.raises(FormatError, match=r"^f: samples 1 and 3 are both of 5 and differ \(1 such pairs\)"):
        in_time_order(np.array([5.0, 4.0, 5.0]), [np.array([1.0, 2.0, 3.0])], "f")
    with pytest.raises(FormatError, match="samples 1 and 2 are both of 5 and differ"):
        in_time_order(np.array([5.0, 5.0]), [np.array([1.0, np.nan])], "f")

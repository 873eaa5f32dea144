import contextlib
import inspect
import io
import logging
import random
import struct
import sys
import tracemalloc
from pathlib import Path
from typing import Any

import nptdms
import numpy as np
import pytest
from nptdms.test import test_daqmx
from nptdms.test.test_daqmx import daqmx_channel_metadata, daqmx_scaler_metadata, segment_toc
from nptdms.test.util import GeneratedFile, root_metadata, segment_objects_metadata

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import log_formats, read_log_bytes
from elastogeo.formats.logs.tdms import can_read, read_tdms

CLOCK = {"wf_increment": 0.002, "wf_start_offset": 0.5}


def channel(name: str, data: Any, **properties: Any) -> nptdms.ChannelObject:
    return nptdms.ChannelObject("drive", name, np.asarray(data) if not isinstance(data, list) else data, properties)


def file(*segments: list[Any]) -> bytes:
    buffer = io.BytesIO()
    with nptdms.TdmsWriter(buffer) as writer:
        for segment in segments:
            writer.write_segment(segment)
    return buffer.getvalue()


GOOD = file(
    [nptdms.RootObject({"operator": "nobody"}), channel("I", np.array([0.5, -0.25, 1e-17]), unit_string="A", **CLOCK)]
)


def test_known_numbers_names_units_and_times() -> None:
    log = read_log_bytes(GOOD, "f")
    current = log.channels["drive/I"]
    assert (current.values.tolist(), current.unit) == ([0.5, -0.25, 1e-17], "A")
    assert current.time is not None
    assert current.time == pytest.approx([0.5, 0.502, 0.504])
    assert (dict(log.metadata), log.notes) == ({"operator": "nobody"}, ())


@pytest.mark.parametrize("kind", ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8", "?"])
def test_every_type_of_number_is_read_exactly(kind: str) -> None:
    values = np.array([0, 1, 1], kind)
    assert read_tdms(file([channel("a", values, **CLOCK)]), "f").channels["drive/a"].values.tolist() == [0.0, 1.0, 1.0]


def test_segments_are_joined() -> None:
    data = file(*([channel("a", np.array([k, k + 0.5]), **CLOCK)] for k in range(3)))
    log = read_tdms(data, "f")
    assert log.channels["drive/a"].values.tolist() == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]
    time = log.channels["drive/a"].time
    assert time is not None
    assert np.diff(time) == pytest.approx([0.002] * 5)


def test_start_times_put_clocks_side_by_side() -> None:
    day = np.datetime64("2026-01-31T12:00:00.000000")
    later = day + np.timedelta64(250, "ms")
    log = read_tdms(
        file(
            [
                channel("a", np.zeros(2), wf_increment=1.0, wf_start_time=later),
                channel("b", np.zeros(3), wf_increment=0.5, wf_start_time=day),
                channel("c", np.zeros(3), wf_increment=0.5),
            ]
        ),
        "f",
    )
    assert {name: None if c.time is None else c.time.tolist() for name, c in log.channels.items()} == {
        "drive/a": [0.25, 1.25],
        "drive/b": [0.0, 0.5, 1.0],
        "drive/c": None,
    }
    assert log.notes == ("drive/c: keeps no clock, because it has no start time, and others have one",)


def test_what_a_channel_does_not_have_is_noted() -> None:
    log = read_tdms(
        file(
            [
                channel("a", np.array([1.0, np.nan, np.inf]), unit_string="Furlongs", **CLOCK),
                channel("b", np.array([1.0, 2.0])),
                channel("c", np.array([1.0, 2.0]), wf_increment=5.0, wf_xunit_string="Hz"),
                channel("t", ["x", "y"]),
                channel("when", np.array(["2026-01-31", "2026-02-01"], "M8[us]")),
                channel("z", np.array([1j, 2j], np.complex64)),
            ]
        ),
        "f",
    )
    assert np.isnan(log.channels["drive/a"].values).tolist() == [False, True, True]
    assert [c.unit for c in log.channels.values()] == ["", "", ""]
    assert log.channels["drive/b"].time is None
    assert log.notes == (
        "drive/t: left out, because it holds text",
        "drive/when: left out, because it holds time stamps",
        "drive/z: left out, because it holds complex numbers",
        "drive/b: keeps no clock, because it has no sample time (wf_increment)",
        "drive/c: keeps no clock, because its steps are in 'Hz', not in s",
        "drive/a: 1 infinite values are NaN",
        "drive/a: its unit 'Furlongs' is not known, so it has none",
    )


def test_scaled_data_are_given_in_their_unit() -> None:
    scale = {
        "NI_Number_Of_Scales": 1,
        "NI_Scale[0]_Scale_Type": "Linear",
        "NI_Scale[0]_Linear_Slope": 0.5,
        "NI_Scale[0]_Linear_Y_Intercept": 10.0,
        "NI_Scale[0]_Linear_Input_Source": 0xFFFFFFFF,
    }
    data = file([channel("a", np.array([0, 2, 4], np.int16), **CLOCK, **scale)])
    assert read_tdms(data, "f").channels["drive/a"].values.tolist() == [10.0, 11.0, 12.0]


def test_a_cut_off_file_is_refused_where_the_library_shortens_a_channel(caplog: pytest.LogCaptureFixture) -> None:
    data = file([channel("a", np.arange(1.0, 101.0), **CLOCK), channel("b", np.arange(1.0, 101.0), **CLOCK)])
    library = nptdms.TdmsFile.read(io.BytesIO(data[:-400]))
    assert (len(library["drive"]["a"]), len(library["drive"]["b"])) == (100, 50)
    caplog.clear()
    with caplog.at_level(logging.DEBUG):
        for end in range(len(data)):
            with pytest.raises(
                FormatError, match=r"^f: (no TDMS segment begins|the segment at byte 0 claims|holds no channel)"
            ):
                read_tdms(data[:end], "f")
    assert not caplog.records


def lead(offset: int, value: int) -> bytes:
    data = bytearray(GOOD)
    data[offset : offset + 8] = struct.pack("<Q", value)
    return bytes(data)


def with_count(count: int) -> bytes:
    """The file with another number of values in the index of its channel."""
    index = struct.pack("<LlLQ", 20, 10, 1, 3)
    assert GOOD.count(index) == 1
    return GOOD.replace(index, struct.pack("<LlLQ", 20, 10, 1, count))


MANY = file([channel("I", np.zeros(20_000, np.int8), **CLOCK)])
SCALED = file([channel("a", np.array([0, 2], np.int16), NI_Number_Of_Scales=2**30, **CLOCK)])
NUMBERED = file([channel("a", np.array([0, 2], np.int16), **{"NI_Scale[99999999]_Scale_Type": "Linear"}, **CLOCK)])
BAD = {
    "the number of a scale is 1073741824": SCALED,
    "the number of a scale is 99999999": NUMBERED,
    "claim 4294967295 bytes, .* are left; the file is damaged": GOOD.replace(
        struct.pack("<L", 11) + b"unit_string", struct.pack("<L", 2**32 - 1) + b"unit_string"
    ),
    "no TDMS segment begins at byte": GOOD + b"tail",
    "was never finished": lead(12, 0xFFFFFFFFFFFFFFFF),
    "the segment at byte 0 claims": lead(12, 10**12),
    "the data of the segment at byte 0 are not whole": with_count(2),
    "are not whole; the file is cut off or": with_count(2**60),
    "its data are in 20000 pieces, too many for": MANY.replace(
        struct.pack("<LlLQ", 20, 1, 1, 20_000), struct.pack("<LlLQ", 20, 1, 1, 1)
    ),
    "lists more objects than its size allows": GOOD[:28] + struct.pack("<L", 2**31) + GOOD[32:],
    "holds no channel of numbers .drive/t: left out, because it holds text": file([channel("t", ["x"])]),
    "drive/a: has integers that a float64 would round": file([channel("a", np.array([2**53 + 1, 1]))]),
    "drive/a: its sample time 1e-09 s is lost beside its start": file(
        [channel("a", np.zeros(3), wf_increment=1e-9, wf_start_offset=1e9)]
    ),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_tdms(BAD[message], "f")


def test_a_text_channel_cannot_claim_more_texts_than_bytes() -> None:
    data = file([channel("t", ["x", "y"]), channel("a", np.zeros(2), **CLOCK)])
    index = struct.pack("<LlLQ", 28, 0x20, 1, 2)
    assert data.count(index) == 1
    with pytest.raises(FormatError, match="claims more texts than it has bytes"):
        read_tdms(data.replace(index, struct.pack("<LlLQ", 28, 0x20, 1, 2**40)), "f")


def test_without_the_library_the_error_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "nptdms", None)
    with pytest.raises(FormatError, match=r"TDMS files need npTDMS: pip install 'elastogeo\[logs\]'"):
        read_tdms(GOOD, "f")


def test_the_library_keeps_quiet(capsys: pytest.CaptureFixture[str]) -> None:
    rng = random.Random(6)
    for _ in range(1500):
        data = bytearray(GOOD)
        for _ in range(rng.randint(1, 3)):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
        message = "f"
        try:
            read_tdms(bytes(data), "f")
        except FormatError as error:
            message = str(error)
        assert message.startswith("f")
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("", "")


def test_a_file_takes_little_memory() -> None:
    data = file([channel(f"c{k}", np.arange(20_000.0), **CLOCK) for k in range(6)])
    tracemalloc.start()
    try:
        read_tdms(data, "f")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 10 * len(data)


def test_only_data_files_are_claimed_and_the_sample_is_always_the_same() -> None:
    assert can_read(GOOD)
    assert not can_read(b"TDSh" + GOOD[4:])
    assert log_formats()["TDMS"].sample() == log_formats()["TDMS"].sample()


def of_the_library() -> dict[str, bytes]:
    """The files of npTDMS itself: four of LabVIEW and DAQmx, and all that its tests of DAQmx build."""
    folder = Path(nptdms.__file__).parent / "test" / "data"
    files = {path.name: path.read_bytes() for path in sorted(folder.glob("*.tdms"))}
    built: list[bytes] = []

    def kept(self: Any, *_args: Any, **_more: Any) -> None:
        file = self._get_contents() if hasattr(self, "_get_contents") else None
        if file is None:
            with self.get_tempfile() as temporary:
                file = Path(temporary.name).read_bytes()
        built.append(file)
        raise StopIteration

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(GeneratedFile, "load", kept)
        for name, function in vars(test_daqmx).items():
            if name.startswith("test_") and "large" not in name and not inspect.signature(function).parameters:
                with contextlib.suppress(StopIteration, pytest.fail.Exception):
                    function()
                files |= {f"{name} {k}": file for k, file in enumerate(built)}
                built.clear()
    return files


LIBRARY = of_the_library()
UNFIT = ("test_incomplete_segment", "test_exception_on", "test_large_daqmx", "test_multiple_scalers")
UNFIT += ("test_multiple_raw_data_buffers_with_scalers_split",)
"""Cut off, wrong on purpose, or several raw counts in a channel and no scale that makes one number of them."""


def fits(name: str) -> bool:
    return not name.startswith(UNFIT)


@pytest.mark.parametrize("name", sorted(filter(fits, LIBRARY)))
def test_the_samples_of_the_library_read_as_it_reads_them(name: str) -> None:
    library = nptdms.TdmsFile.read(io.BytesIO(LIBRARY[name]))
    log = read_tdms(LIBRARY[name], "f")
    assert len(log.channels) >= 1
    for group in library.groups():
        for channel in group.channels():
            if f"{group.name}/{channel.name}" in log.channels:
                counts = channel.raw_scaler_data
                whole = channel.raw_data if counts and len(counts) == 1 and "no scale" in str(log.notes) else channel[:]
                expected = np.asarray(whole, dtype=np.float64)
                np.testing.assert_array_equal(log.channels[f"{group.name}/{channel.name}"].values, expected)


def test_a_known_sample_of_daqmx_has_the_values_that_its_maker_states() -> None:
    channel = read_tdms(LIBRARY["raw1.tdms"], "f").channels["Layer Data/First  Channel"]
    assert channel.unit == "V"
    assert channel.values[:4] == pytest.approx([-0.18402661, 0.14801477, -0.24506363, -0.29725028], abs=1e-8)


def test_a_cut_off_file_of_daqmx_is_refused_and_never_filled_up() -> None:
    data = LIBRARY["raw1.tdms"]
    whole = read_tdms(data, "f")
    for end in range(len(data) - 1, 0, -97):
        with pytest.raises(FormatError, match=r"^f: (no TDMS segment begins|the segment at byte|the data of|holds no)"):
            read_tdms(data[:end], "f")
    assert {len(channel.values) for channel in whole.channels.values()} == {2000}


def test_changed_bits_of_daqmx_give_a_log_or_a_format_error() -> None:
    rng = random.Random(11)
    for name in (
        "test_two_channel_i16 0",
        "test_multiple_raw_data_buffers_with_different_lengths 0",
        "test_digital_line_scaler_data 0",
    ):
        for _ in range(150):
            data = bytearray(LIBRARY[name])
            for _ in range(rng.randint(1, 3)):
                data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
            try:
                said = read_tdms(bytes(data), "f").source
            except FormatError as error:
                said = str(error)
            assert said.startswith("f")


def test_many_channels_that_share_a_few_bytes_are_refused() -> None:
    width, count = 4096, 3000
    scalers = [daqmx_scaler_metadata(0, 0, 0)]
    channels = [daqmx_channel_metadata(f"c{k}", width, [1], scalers) for k in range(count)]
    made = GeneratedFile()
    made.add_segment(segment_toc(), segment_objects_metadata(root_metadata(), *channels), "00" * width)
    with made.get_tempfile() as temporary:
        data = Path(temporary.name).read_bytes()
    with pytest.raises(FormatError, match=f"its channels claim {width * count} values in {len(data)} bytes"):
        read_tdms(data, "f")

import io
import random
import struct
import tracemalloc
import zlib
from typing import Any

import numpy as np
import pytest
from asammdf import MDF, Signal

from elastogeo.errors import FormatError
from elastogeo.formats.log_files import log_formats, read_log_bytes
from elastogeo.formats.logs.mdf4 import can_read, read_mdf4

TIME = np.array([0.0, 0.001, 0.002, 0.003])


def file(*groups: list[Signal], compression: int = 0, **options: Any) -> bytes:
    """A file that asammdf writes."""
    mdf = MDF(version=options.pop("version", "4.10"))
    for group in groups:
        mdf.append(group, **options)
    buffer = io.BytesIO()
    mdf.save(buffer, compression=compression)
    mdf.close()
    return buffer.getvalue()


def current(**more: Any) -> Signal:
    return Signal(np.array([0.5, -0.25, 1e-17, 3.0]), TIME, name="I_X", unit=more.pop("unit", "A"), **more)


SAMPLE = log_formats()["MDF 4"].sample()
RAW = SAMPLE[SAMPLE.index(b"##DT") + 24 :][:57]


@pytest.mark.parametrize("compression", [0, 1, 2])
@pytest.mark.parametrize("version", ["4.00", "4.10", "4.11"])
def test_known_numbers_names_units_and_times(compression: int, version: str) -> None:
    log = read_log_bytes(file([current()], compression=compression, version=version), "f")
    channel = log.channels["I_X"]
    assert (channel.values.tolist(), channel.unit) == ([0.5, -0.25, 1e-17, 3.0], "A")
    assert channel.time is not None
    assert channel.time.tolist() == TIME.tolist()
    assert log.notes == ()
    assert log.metadata["version"] == version


def test_groups_of_unequal_rates_keep_their_clocks() -> None:
    slow = Signal(np.array([1.0, 2.0]), np.array([0.5, 1.5]), name="T", unit="Nm")
    log = read_mdf4(file([current()], [slow]), "f")
    assert {name: c.time.tolist() for name, c in log.channels.items() if c.time is not None} == {
        "I_X": TIME.tolist(),
        "T": [0.5, 1.5],
    }


@pytest.mark.parametrize("kind", ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"])
@pytest.mark.parametrize("order", ["<", ">"])
def test_every_type_of_number_is_as_the_library_reads_it(kind: str, order: str) -> None:
    values = np.array([0, 1, 100, -3 if kind[0] != "u" else 3], order + kind)
    data = file([Signal(values, TIME, name="a"), current()])
    assert read_mdf4(data, "f").channels["a"].values.tolist() == values.tolist()
    assert MDF(io.BytesIO(data)).get("a").samples.tolist() == values.tolist()


@pytest.mark.parametrize(
    "conversion",
    [{"a": 0.5, "b": 10.0}, {"P1": 0.0, "P2": 3.0, "P3": 1.0, "P4": 0.0, "P5": 0.5, "P6": 2.0}],
    ids=["linear", "rational"],
)
def test_conversions_are_as_the_library_does_them(conversion: dict[str, float]) -> None:
    data = file([Signal(np.array([0, 2, 4, 100], np.int16), TIME, name="a", conversion=conversion)])
    values = read_mdf4(data, "f").channels["a"].values
    assert values == pytest.approx(MDF(io.BytesIO(data)).get("a").samples, rel=1e-15)
    raw = np.array([0.0, 2.0, 4.0, 100.0])
    expected = 0.5 * raw + 10 if "a" in conversion else (3 * raw + 1) / (0.5 * raw + 2)
    assert values == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("byte", "bit", "bits", "code"),
    [
        (14, 3, 12, 0),
        (14, 3, 12, 2),
        (14, 0, 24, 2),
        (14, 0, 24, 3),
        (14, 0, 24, 1),
        (15, 5, 3, 0),
        (12, 1, 33, 0),
        (12, 1, 33, 2),
    ],
)
def test_numbers_of_odd_width_are_as_the_library_reads_them(byte: int, bit: int, bits: int, code: int) -> None:
    """Channel n_X of the sample is cut out of other bits of its records; it is converted by a factor of 0.5."""
    data = bytearray(SAMPLE)
    at = SAMPLE.index(struct.pack("<4B2I", 0, 0, 2, 0, 16, 16))
    data[at : at + 12] = struct.pack("<4B2I", 0, 0, code, bit, byte, bits)
    values = read_mdf4(bytes(data), "f").channels["n_X"].values[:2].tolist()
    expected = []
    for row in (RAW[:19], RAW[19:38]):
        field = row[byte : byte + -(-(bit + bits) // 8)]
        number = (int.from_bytes(field, "big" if code % 2 else "little") >> bit) % 2**bits
        expected.append(0.5 * (number - 2**bits if code > 1 and number >= 2 ** (bits - 1) else number))
    assert values == expected
    theirs = MDF(io.BytesIO(bytes(data))).get("n_X", ignore_invalidation_bits=True).samples[:2].tolist()
    assert values == theirs


def test_the_sample_is_as_the_library_reads_it() -> None:
    mdf = MDF(io.BytesIO(SAMPLE))
    log = read_mdf4(SAMPLE, "f")
    for name in ("I_X", "n_X"):
        theirs = mdf.get(name, ignore_invalidation_bits=True)
        mine = log.channels[name]
        good = ~np.isnan(mine.values)
        assert mine.values[good].tolist() == theirs.samples[good].tolist()
        assert mine.time is not None
        assert (mine.time.tolist(), mine.unit) == (theirs.timestamps.tolist(), theirs.unit)
    assert log.channels["n_X"].values[:2].tolist() == [50.0, 75.0]
    assert log.metadata["start"] == "2026-01-31T12:00:00.000000000Z"
    assert f"{mdf.header.start_time:%Y-%m-%dT%H:%M:%S}" == "2026-01-31T12:00:00"


def test_samples_marked_invalid_are_nan() -> None:
    signal = current(invalidation_bits=np.array([False, True, False, True]))
    log = read_mdf4(file([signal, Signal(TIME, TIME, name="b")]), "f")
    assert np.isnan(log.channels["I_X"].values).tolist() == [False, True, False, True]
    assert not np.isnan(log.channels["b"].values).any()
    assert log.notes == ("I_X (group 0): 2 of 4 samples are invalid or no finite number",)


def test_units_are_translated_or_noted() -> None:
    signals = [
        Signal(TIME, TIME, name=name, unit=unit)
        for name, unit in (("a", "N·m"), ("b", "U/min"), ("c", "°C"), ("d", "bananas"))
    ]
    log = read_mdf4(file(signals), "f")
    assert {name: c.unit for name, c in log.channels.items()} == {"a": "N m", "b": "1/min", "c": "°C", "d": ""}
    assert log.notes == ("d (group 0): its unit 'bananas' is not known, so it has none",)


def test_what_is_no_number_is_left_out_with_a_note() -> None:
    text = Signal(np.array([b"ab", b"cd", b"", b"x"]), TIME, name="t", encoding="utf-8")
    table = Signal(
        np.array([0, 1, 0, 1], np.uint8),
        TIME,
        name="m",
        conversion={"val_0": 0, "text_0": b"off", "val_1": 1, "text_1": b"on"},
    )
    log = read_mdf4(file([current(), text, table]), "f")
    assert list(log.channels) == ["I_X"]
    assert [note.split(",")[0] for note in log.notes] == ["t (group 0): left out", "m (group 0): left out"]


def test_channels_of_one_name_are_told_apart_by_their_group() -> None:
    assert list(read_mdf4(file([current()], [current()]), "f").channels) == ["I_X (group 0)", "I_X (group 1)"]


def test_channels_of_one_name_in_one_group_are_told_apart_by_their_place() -> None:
    data = file([current(), current(), Signal(TIME, TIME, name="b")])
    assert list(read_mdf4(data, "f").channels) == ["I_X (group 0, channel 1)", "I_X (group 0, channel 2)", "b"]


def test_no_finite_number_is_nan_and_noted() -> None:
    log = read_mdf4(file([Signal(np.array([1.0, np.nan, np.inf, 2.0]), TIME, name="a")]), "f")
    assert np.isnan(log.channels["a"].values).tolist() == [False, True, True, False]
    assert log.notes == ("a (group 0): 2 of 4 samples are invalid or no finite number",)


def changed(*pieces: tuple[bytes, bytes]) -> bytes:
    data = SAMPLE
    for old, new in pieces:
        assert data.count(old) == 1
        assert len(old) == len(new)
        data = data.replace(old, new)
    return data


def rows(*times: float) -> bytes:
    old = b"".join(struct.pack("<dd", *row) for row in ((0.001, -0.25),))
    return changed((old, struct.pack("<dd", times[0], -0.25)))


COUNT = struct.pack("<QQHHIII", 0, 3, 0, 0, 0, 18, 1)
BAD = {
    "was not finished .UnFinMF.": b"UnFinMF " + SAMPLE[8:],
    r"the time 0 of record 2 of group 0 is not after the one before it": rows(0.0),
    r"the time 0.002 of record 3 of group 0 is not after": rows(0.002),
    r"the time 0.002 of record 3 of group 0 is not": rows(0.005),
    r"the time nan of record 2 of group 0": rows(np.nan),
    "group 0 promises 4 records of 19 bytes, 57 bytes arrived": changed(
        (COUNT, struct.pack("<QQHHIII", 0, 4, 0, 0, 0, 18, 1))
    ),
    "group 0 promises 2 records": changed((COUNT, struct.pack("<QQHHIII", 0, 2, 0, 0, 0, 18, 1))),
    "channel 'n_X' lies outside its records": changed((COUNT, struct.pack("<QQHHIII", 0, 3, 0, 0, 0, 16, 3))),
    "a block ##HD is missing at byte 64": SAMPLE[:64] + b"##XX" + SAMPLE[68:],
    "block ##DT at byte .* does not lie whole": changed(
        (b"##DT\0\0\0\0" + struct.pack("<Q", 81), b"##DT\0\0\0\0" + struct.pack("<Q", 10**6))
    ),
    "no data block at byte": changed((b"##DT", b"##QQ")),
    r"is stored by columns \(LD\); save it as MDF 4.10": changed((b"##DT", b"##LD")),
    "holds no channel of numbers": file(),
    "a: has integers that a float64 would round": file([Signal(np.array([2**60 + 1] * 4), TIME, name="a")]),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_mdf4(BAD[message], "f")


def test_no_prefix_gives_other_samples() -> None:
    for data in (SAMPLE, file([current()], compression=1)):
        whole = read_mdf4(data, "f").channels["I_X"].values.tolist()
        refused = 0
        for end in range(len(data)):
            values, message = whole, "f"
            try:
                values = read_mdf4(data[:end], "f").channels["I_X"].values.tolist()
            except FormatError as error:
                message = str(error)
                refused += 1
            assert message.startswith("f")
            assert values == whole
        assert refused > 0.9 * len(data)


def test_a_circle_of_blocks_is_refused() -> None:
    address = SAMPLE.index(b"##CG")
    link = struct.pack("<Q", address)
    data = bytearray(SAMPLE)
    data[address + 24 : address + 32] = link
    with pytest.raises(FormatError, match=r"block ##CG at byte \d+ is linked to twice"):
        read_mdf4(bytes(data), "f")


def packed(raw: bytes, declared: int, how: int = 0) -> bytes:
    """The sample with its data in a packed block at its end."""
    content = zlib.compress(raw)
    body = struct.pack("<2sBxIQQ", b"DT", how, 19, declared, len(content)) + content
    address = len(SAMPLE) + -len(SAMPLE) % 8
    block = b"##DZ" + struct.pack("<IQQ", 0, 24 + len(body), 0) + body
    data = bytearray(SAMPLE.ljust(address, b"\0") + block)
    link = struct.pack("<Q", SAMPLE.index(b"##DT"))
    assert SAMPLE.count(link) == 1
    at = SAMPLE.index(link)
    data[at : at + 8] = struct.pack("<Q", address)
    return bytes(data)


def test_packed_data_are_unpacked_within_what_they_declare() -> None:
    assert read_mdf4(packed(RAW, 57), "f").channels["I_X"].values.tolist() == [0.5, -0.25, 1e-17]
    turned = np.frombuffer(RAW, np.uint8).reshape(3, 19).T.tobytes()
    assert read_mdf4(packed(turned, 57, 1), "f").channels["I_X"].values.tolist() == [0.5, -0.25, 1e-17]
    for raw, declared in ((RAW, 56), (RAW, 58), (bytes(10**6), 57)):
        with pytest.raises(FormatError, match=f"does not hold {declared} bytes"):
            read_mdf4(packed(raw, declared), "f")
    with pytest.raises(FormatError, match="bytes unpack to more than 8 times that"):
        read_mdf4(packed(bytes(11_000_000), 11_000_000), "f")


def test_a_bomb_is_not_unpacked() -> None:
    data = packed(bytes(50_000_000), 57)
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match="does not hold 57 bytes"):
            read_mdf4(data, "f")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 10 * len(data)


@pytest.mark.parametrize("data", [SAMPLE, file([current()], [current()], compression=2)], ids=["sample", "packed"])
def test_changed_bits_give_a_log_or_a_format_error(data: bytes, capsys: pytest.CaptureFixture[str]) -> None:
    rng = random.Random(8)
    for _ in range(2000):
        copy = bytearray(data)
        for _ in range(rng.randint(1, 3)):
            copy[rng.randrange(len(copy))] ^= 1 << rng.randrange(8)
        message = "f"
        try:
            read_mdf4(bytes(copy), "f")
        except FormatError as error:
            message = str(error)
        assert message.startswith("f")
    assert capsys.readouterr().out == ""


def test_other_versions_are_not_claimed() -> None:
    assert can_read(SAMPLE)
    for data in (b"", b"MDF     3.30    ", b"MDF     4.10    " + bytes(100), b"UnFinMF 3.3" + SAMPLE[11:]):
        assert not can_read(data)


def unsorted(records: bytes, width: int, groups: list[tuple[int, int]], vlsd: bool = False) -> bytes:
    """The sample's channels in groups of (record number, cycles) that share one data block."""
    data = bytearray(SAMPLE)

    def block(kind: bytes, links: tuple[int, ...], body: bytes) -> int:
        data.extend(b"\0" * (-len(data) % 8))
        address = len(data)
        data.extend(
            b"##" + kind + struct.pack(f"<IQQ{len(links)}Q", 0, 24 + 8 * len(links) + len(body), len(links), *links) + body
        )
        return address

    following = block(b"CG", (0,) * 6, struct.pack("<QQHHIII", 9, 0, 1, 0, 0, 0, 0)) if vlsd else 0
    for identity, cycles in reversed(groups):
        channel = 0
        for name in (b"n_X\0", b"I_X\0", b"time\0"):
            text = struct.pack("<Q", SAMPLE.index(name) - 24)
            at = SAMPLE.index(text) - 40  # the name is the third link of the block that begins here
            length = struct.unpack_from("<Q", SAMPLE, at + 8)[0]
            links = struct.unpack_from("<8Q", SAMPLE, at + 24)
            channel = block(b"CN", (channel, *links[1:]), SAMPLE[at + 88 : at + length])
        following = block(b"CG", (following, channel, 0, 0, 0, 0), struct.pack("<QQHHIII", identity, cycles, 0, 0, 0, 18, 1))
    content = block(b"DT", (), records)
    data[88:96] = struct.pack("<Q", block(b"DG", (0, following, content, 0), bytes([width]) + bytes(7)))
    return bytes(data)


ONE, TWO, THREE = RAW[:19], RAW[19:38], RAW[38:]


def test_unsorted_records_go_to_their_groups() -> None:
    data = unsorted(b"\1" + ONE + b"\2" + TWO + b"\1" + TWO + b"\2" + THREE, 1, [(1, 2), (2, 2)])
    log = read_mdf4(data, "f")
    assert log.channels["I_X (group 0)"].values.tolist() == [0.5, -0.25]
    assert log.channels["I_X (group 1)"].values.tolist() == [-0.25, 1e-17]
    mdf = MDF(io.BytesIO(data))
    assert mdf.get("I_X", group=0).samples.tolist() == [0.5, -0.25]
    assert mdf.get("I_X", group=1).samples.tolist() == [-0.25, 1e-17]


def test_records_of_variable_length_between_them_are_passed_over() -> None:
    text = b"\x09\5\0\0\0hello"
    data = unsorted(b"\1" + ONE + text + b"\1" + TWO, 1, [(1, 2)], vlsd=True)
    assert read_mdf4(data, "f").channels["I_X"].values.tolist() == [0.5, -0.25]


def test_one_group_may_have_record_numbers_too() -> None:
    data = unsorted(b"\1\0" + ONE + b"\1\0" + TWO, 2, [(1, 2)])
    log = read_mdf4(data, "f")
    assert log.channels["I_X"].values.tolist() == [0.5, -0.25]
    assert log.channels["n_X"].values.tolist() == [50.0, 75.0]
    assert MDF(io.BytesIO(data)).get("I_X").samples.tolist() == [0.5, -0.25]


@pytest.mark.parametrize(
    ("records", "groups", "message"),
    [
        (b"\1" + ONE + b"\3" + TWO, [(1, 1), (2, 1)], "a record of unknown group 3"),
        (b"\1" + ONE + b"\2" + TWO[:-1], [(1, 1), (2, 1)], "its last record is not whole"),
        (b"\1" + ONE + b"\1" + TWO, [(1, 1), (2, 1)], "group 0 promises 1 records of 19 bytes, 38 bytes arrived"),
    ],
)
def test_unsorted_records_that_do_not_add_up_are_refused(
    records: bytes, groups: list[tuple[int, int]], message: str
) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_mdf4(unsorted(records, 1, groups), "f")


def test_a_virtual_clock_counts_records() -> None:
    data = bytearray(SAMPLE)
    at = SAMPLE.index(struct.pack("<4B2I", 2, 1, 4, 0, 0, 64))
    data[at] = 3
    log = read_mdf4(bytes(data), "f")
    time = log.channels["I_X"].time
    assert time is not None
    assert time.tolist() == MDF(io.BytesIO(bytes(data))).get("I_X").timestamps.tolist() == [0.0, 1.0, 2.0]


def test_a_master_that_is_no_time_gives_no_clock() -> None:
    data = bytearray(SAMPLE)
    at = SAMPLE.index(struct.pack("<4B2I", 2, 1, 4, 0, 0, 64))
    data[at + 1] = 2
    log = read_mdf4(bytes(data), "f")
    assert log.channels["I_X"].time is None
    assert list(log.channels) == ["time", "I_X", "n_X"]
    assert "group 0 has no clock: its master 'time' is an angle" in log.notes

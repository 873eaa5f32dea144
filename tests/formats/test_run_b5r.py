import random
import re
import time
import tracemalloc
from math import pi, tau
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.run_files import read_run, read_run_bytes, run_formats
from elastogeo.formats.runs.b5r import can_read, read_b5r, read_b5r_runs
from elastogeo.formats.text.xml_elements import read_elements

ARC = "<START_ANGLE>0</START_ANGLE><END_ANGLE>360</END_ANGLE>"
SETUP = "<NOMINAL_LENGTH>150</NOMINAL_LENGTH><PROGRAMMED_FEEDRATE>1500</PROGRAMMED_FEEDRATE>"
FEATURE = '<FEATURE NAME="AF_CIRCULARITY" DT="UT_LENGTH_MM">0.0080</FEATURE>'
ANALYSIS = '<ANALYSIS NAME="RENISHAW_DIAGNOSTICS"><FEATURE NAME="AF_CIRCULARITY" DT="UT_LENGTH_UM">8.0</FEATURE></ANALYSIS>'
UM = ' DT="UT_LENGTH_UM"'
FIVE = "0.5 -1.5 2.25 3 0.5"


def run(readings: str = FIVE, direction: str = "CCW", more: str = "", unit: str = UM) -> str:
    said = f"<RUN_DIRECTION>{direction}</RUN_DIRECTION>"
    return f"<BALLBAR_RUN>{said}{more}<READINGS{unit}>{readings}</READINGS></BALLBAR_RUN>"


def document(*runs: str, spec: str = SETUP + ARC, after: str = ANALYSIS) -> bytes:
    plane = '<PLANE VIEW="+A+B" TEST_PLANE="XY"><A_AXIS_NAME>X</A_AXIS_NAME><B_AXIS_NAME>Y</B_AXIS_NAME></PLANE>'
    text = f"""<?xml version="1.0" encoding="utf-8" standalone="yes"?>
<TEST_DOCUMENT><TEST_SPEC NAME="XY 360deg 150mm"><INSTRUMENT MANUFACTURER="Renishaw"><DYNAMIC_BALLBAR>{spec}{plane}
</DYNAMIC_BALLBAR></INSTRUMENT></TEST_SPEC><OPERATOR>A. Nobody</OPERATOR><DATE_STARTED>20240501-120000</DATE_STARTED>
<MACHINE_TESTED NAME="C 50" /><RUN_RESULTS>{"".join(runs)}</RUN_RESULTS>{after}</TEST_DOCUMENT>"""
    return text.encode()


TWO = document(run(more=FEATURE), run("3 2 1 0", "CW"))


def test_one_run_is_read_with_its_angles_and_names() -> None:
    table = read_b5r(document(run(more=FEATURE)), "f")
    assert table.column("angle").tolist() == [0.0, pi / 2, pi, 3 * pi / 2, tau]
    assert table.column("radial").tolist() == [0.5 / 1000, -1.5 / 1000, 2.25 / 1000, 3 / 1000, 0.5 / 1000]
    assert table.metadata == {
        "test": "XY 360deg 150mm",
        "machine": "C 50",
        "plane": "XY",
        "operator": "A. Nobody",
        "date": "2024-05-01T12:00:00",
        "run": "1",
        "direction": "CCW",
        "AF_CIRCULARITY_mm": "0.0080",
        "analysis AF_CIRCULARITY_um": "8.0",
    }


def test_a_run_is_chosen_by_its_number(tmp_path: Path) -> None:
    path = tmp_path / "xy.b5r"
    path.write_bytes(TWO)
    first, second = read_run(f"{path}#1"), read_run(f"{path}#2")
    assert (first.metadata["direction"], second.metadata["direction"]) == ("CCW", "CW")
    assert second.column("angle").tolist() == pytest.approx([tau, 2 * tau / 3, tau / 3, 0.0])
    assert second.column("radial").tolist() == [0.003, 0.002, 0.001, 0.0]
    assert second.source == f"{path}#2"
    with pytest.raises(FormatError, match=r'xy.b5r: holds 2 runs \(#1 CCW, #2 CW\); choose one .*: file = "xy.b5r#1"'):
        read_run(path)
    for number in ("0", "3", "999"):
        with pytest.raises(FormatError, match=rf"there is no run {number}; the file holds 2 runs"):
            read_run(f"{path}#{number}")
    with pytest.raises(FormatError, match="cannot be opened"):
        read_run(f"{path}#x")


def test_a_file_whose_name_has_a_number_sign_is_that_file(tmp_path: Path) -> None:
    path = tmp_path / "run#2"
    path.write_bytes(b"force_N\n36.25\n")
    assert read_run(path).column("force").tolist() == [36.25]
    assert read_run(f"{path}#1").column("force").tolist() == [36.25]
    with pytest.raises(FormatError, match=r"there is no run 2; the file holds 1 run \(#1\)"):
        read_run(f"{path}#2")


def test_the_runs_of_a_partial_arc_go_there_and_back() -> None:
    spec = SETUP + "<START_ANGLE>-20</START_ANGLE><END_ANGLE>200</END_ANGLE>"
    there, back = read_b5r_runs(document(run(), run(direction="CW"), spec=spec), "f")
    assert there.column("angle").tolist() == pytest.approx(np.radians(np.linspace(-20, 200, 5)).tolist())
    assert back.column("angle").tolist() == pytest.approx(np.radians(np.linspace(200, -20, 5)).tolist())
    own = "<START_ANGLE>200</START_ANGLE><END_ANGLE>-20</END_ANGLE>"
    (alone,) = read_b5r_runs(document(run(direction="CW", more=own), spec=SETUP), "f")
    assert alone.column("angle").tolist() == back.column("angle").tolist()
    with pytest.raises(FormatError, match="f, run 1: an arc from 200 to -20 deg is not CCW; correct"):
        read_b5r(document(run(more=own), spec=SETUP), "f")


def test_runs_beside_each_other_are_told_apart() -> None:
    inner = run(more=FEATURE) + run("1 2 3 4 5", "CW", FEATURE.replace("0.0080", "0.0070"))
    both = inner.replace("</BALLBAR_RUN><BALLBAR_RUN>", "")
    first, second = read_b5r_runs(document(both), "f")
    assert (first.metadata["AF_CIRCULARITY_mm"], second.metadata["AF_CIRCULARITY_mm"]) == ("0.0080", "0.0070")
    assert (first.metadata["direction"], second.metadata["direction"]) == ("CCW", "CW")


RADIAL = 0.004 * np.cos(2 * np.linspace(0, tau, 73)) + 0.05 * np.cos(np.linspace(0, tau, 73))


@pytest.mark.parametrize(
    ("values", "unit", "more"),
    [
        (RADIAL, ' DT="UT_LENGTH_MM"', ""),
        (RADIAL * 1000, UM, ""),
        (RADIAL + 150.0, "", ""),
        (RADIAL + 150.0, ' DT="UT_LENGTH_MM"', ""),
        (RADIAL, "", FEATURE),
        (RADIAL * 1000, "", FEATURE),
        (RADIAL, "", FEATURE.replace("MM", "UM").replace("0.0080", "8.0")),
    ],
)
def test_units_are_taken_from_what_settles_them(values: np.ndarray, unit: str, more: str) -> None:
    data = document(run(" ".join(map(repr, values.tolist())), more=more, unit=unit))
    assert read_b5r(data, "f").column("radial") == pytest.approx(RADIAL, abs=1e-12)


def test_readings_over_an_overshoot_have_angles_beyond_the_arc() -> None:
    # 1500 mm/min on 150 mm: 1/6 rad/s; at 60 Hz a reading each 1/360 rad
    spec = SETUP + ARC + "<SAMPLE_RATE>60</SAMPLE_RATE><ANGULAR_OVERSHOOT>180</ANGULAR_OVERSHOOT>"
    beyond = read_b5r(document(run("0.5 " * round(2 * tau * 360)), spec=spec), "f").column("angle")
    assert (beyond[0], beyond[-1]) == pytest.approx((-pi, 3 * pi))
    within = read_b5r(document(run("0.5 " * round(tau * 360)), spec=spec), "f").column("angle")
    assert (within[0], within[-1]) == pytest.approx((0.0, tau))
    with pytest.raises(FormatError, match=r"1131 readings make 179.8 deg .* the arc is 360 deg \(and 180 deg beyond"):
        read_b5r(document(run("0.5 " * round(pi * 360)), spec=spec), "f")
    with pytest.raises(FormatError, match="states an overshoot of 180 deg, and not whether the readings include it"):
        read_b5r(document(run(), spec=spec.replace("<SAMPLE_RATE>60</SAMPLE_RATE>", "")), "f")
    onwards = spec.replace("<END_ANGLE>360</END_ANGLE>", "").replace("180<", "0<")
    assert read_b5r(document(run(), spec=onwards), "f").column("angle")[1] == pytest.approx(1 / 360)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_every_encoding_is_read_and_claimed_once(encoding: str) -> None:
    text = document(run()).decode().replace("A. Nobody", "Å. Jemand").replace("utf-8", encoding.removesuffix("-sig"))
    data = text.encode(encoding)
    assert [f.name for f in run_formats().values() if f.can_read(data)] == ["Renishaw ball bar"]
    assert read_run_bytes(data, "f").metadata["operator"] == "Å. Jemand"


def nested(depth: int) -> bytes:
    return b"<TEST_DOCUMENT>" + b"<a>" * depth + b"</a>" * depth + b"</TEST_DOCUMENT>"


BAD = {
    "no READINGS of a run; save the test with its raw data": document("<BALLBAR_RUN></BALLBAR_RUN>"),
    "is no ball-bar test, which is a <TEST_DOCUMENT>": b"<a/>",
    "the XML is damaged, cut off or not allowed .mismatched": b"<TEST_DOCUMENT><a></TEST_DOCUMENT>",
    "the XML is damaged, cut off or not allowed .no element": b"",
    "unknown encoding": b"<?xml version='1.0' encoding='klingon'?><TEST_DOCUMENT/>",
    "DTDForbidden": b"<!DOCTYPE a [<!ENTITY b 'c'>]><TEST_DOCUMENT>&b;</TEST_DOCUMENT>",
    "DTDForbidden.*passwd": b"<!DOCTYPE a SYSTEM 'file:///etc/passwd'><TEST_DOCUMENT/>",
    "undefined entity": b"<TEST_DOCUMENT>&b;</TEST_DOCUMENT>",
    "more than 100 elements inside each other": nested(100),
    r"too many elements \(<a>\)": b"<TEST_DOCUMENT>" + b"<a/>" * 20_000 + b"</TEST_DOCUMENT>",
    "a tag or comment longer than 10000 bytes": b"<TEST_DOCUMENT " + b"a" * 10_001 + b"='1'/>",
    "holds 101 runs, at most 100 are read": document(*[run()] * 101),
    "has more than 200000 readings": document(run("1 " * 200_001)),
    ", run 1: no RUN_DIRECTION stands before": document(run().replace("RUN_DIRECTION", "SIDE")),
    "the direction is 'LEFT'; write CCW": document(run(direction="LEFT")),
    "gives no angles and no start angle": document(run(), spec=SETUP),
    "no end angle; .* sample rate must be given too": document(run(), spec=SETUP + "<START_ANGLE>0</START_ANGLE>"),
    r"several values may be meant \(START_ANGLE 0, START_ANGLE 90\)": document(
        run(), spec=SETUP + ARC + "<START_ANGLE>90</START_ANGLE>"
    ),
    "START_ANGLE is 'zero' with the unit none; a number in deg": document(run(), spec=SETUP + ARC.replace(">0<", ">zero<")),
    "with the unit UT_LENGTH_MM; a number in deg": document(
        run(), spec=SETUP + ARC.replace("<START_ANGLE", '<START_ANGLE DT="UT_LENGTH_MM"')
    ),
    "its start cannot be 1.74533e": document(run(), spec=SETUP + ARC.replace(">0<", ">1e9<")),
    "start and end angle are the same": document(run(), spec=SETUP + ARC.replace("360", "0")),
    "one reading makes no arc": document(run("1")),
    "7 readings cannot be read.*\n.*reading 1 is '1,5', not a number.*\n(.*\n){4}.*and 2 more": document(run("1,5 " * 7)),
    "reading 2 is 'nan'": document(run("1 nan")),
    "reading 1 is '1e999'": document(run("1e999 1")),
    "READINGS hold <READING>, not numbers": document(run("<READING>1</READING>")),
    "READINGS are in 'UT_ANGLE'; known are": document(run(unit=' DT="UT_ANGLE"')),
    'state no unit .DT., and .* write DT="UT_LENGTH_UM"': document(run(unit="")),
    "AF_CIRCULARITY does not settle it": document(run("0.5 0.6 0.7 0.8 0.9 0.1", unit="", more=FEATURE)),
    "a reading of 20 mm is neither a change of length": document(run("1 20 3", unit=' DT="UT_LENGTH_MM"')),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_file_gets_one_clear_error(message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_b5r(BAD[message], "f")


def test_xml_of_other_kinds_is_not_claimed() -> None:
    for data in (b"<a/>", b"<html><TEST_DOCUMENTS/>", b"TEST_DOCUMENT", b"a <TEST_DOCUMENT>", b""):
        assert not can_read(data)
    assert can_read(b"\xef\xbb\xbf\n<!-- made by a test --><TEST_DOCUMENT>")


def test_a_name_space_does_not_matter() -> None:
    data = document(run()).replace(b"<TEST_DOCUMENT>", b'<TEST_DOCUMENT xmlns="http://x/y">')
    assert read_b5r(data, "f").rows == 5


def outcome(data: bytes) -> None:
    can_read(data)
    message = "f:"
    try:
        assert all(np.isfinite(c).all() for t in read_b5r_runs(data, "f") for c in t.columns.values())
    except FormatError as error:
        message = str(error)
    assert re.match("f[:,]", message)
    assert len(message) < 3000


@settings(derandomize=True, deadline=None, max_examples=300)
@given(st.binary(max_size=60), st.integers(0, len(TWO)), st.integers(0, 60))
def test_any_bytes_anywhere_give_tables_or_a_format_error(piece: bytes, at: int, cut: int) -> None:
    outcome(TWO[:at] + piece + TWO[at + cut :])


PIECES = [
    "<READINGS>",
    "</READINGS>",
    "<FEATURE NAME='AF_CIRCULARITY'>",
    "</FEATURE>",
    "1e308 ",
    "-1e308 ",
    "0 ",
    "nan",
    "<a>",
]
PIECES += [
    "</a>",
    "<END_ANGLE>",
    "</END_ANGLE>",
    "360",
    "<SAMPLE_RATE>1</SAMPLE_RATE>",
    "&#0;",
    "<![CDATA[1 2 3]]>",
    "CW",
    ";",
]


@settings(derandomize=True, deadline=None, max_examples=300)
@given(st.lists(st.sampled_from(PIECES), max_size=8), st.integers(0, len(TWO)))
def test_any_elements_anywhere_give_tables_or_a_format_error(pieces: list[str], at: int) -> None:
    outcome(TWO[:at] + "".join(pieces).encode() + TWO[at:])


def test_flipped_bits_and_prefixes_give_tables_or_a_format_error() -> None:
    rng = random.Random(7)
    for end in range(len(TWO)):
        with pytest.raises(FormatError, match="the XML is damaged, cut off"):
            read_b5r_runs(TWO[:end], "f")
    for _ in range(2000):
        data = bytearray(TWO)
        for _ in range(rng.randint(1, 3)):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
        outcome(bytes(data))


HEAVY = {
    "readings": document(run("0.12345 " * 125_000)),
    "text": document(run("x" * 1_000_000)),
    "lines": document(run("\n" * 1_000_000)),
    "elements": b"<TEST_DOCUMENT>" + b"<a/>" * 250_000 + b"</TEST_DOCUMENT>",
    "open elements": b"<TEST_DOCUMENT>" + b"<a>" * 330_000,
    "attributes": b"<TEST_DOCUMENT " + b"".join(b"a%d='' " % n for n in range(100_000)) + b"/>",
    "tags": b"<" * 1_000_000,
    "references": document(run("&#49; " * 160_000)),
    "digits": document(run("1" * 1_000_000)),
}


@pytest.mark.parametrize("data", HEAVY.values(), ids=HEAVY.keys())
def test_a_megabyte_of_anything_takes_little_memory_and_time(data: bytes) -> None:
    start = time.process_time()
    outcome(data)
    assert time.process_time() - start < 1
    tracemalloc.start()
    try:
        outcome(data)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 10 * len(data)


def test_a_tree_keeps_text_attributes_and_order() -> None:
    root = read_elements(b"<a b='1'> x <c/>y<d>2</d></a>", "f")
    assert (root.tag, root.attributes, root.text) == ("a", {"b": "1"}, "x y")
    assert [(child.tag, child.text) for child in root.walk()] == [("c", ""), ("d", "2")]
    assert [child.tag for child in root.walk("d")] == ["c"]

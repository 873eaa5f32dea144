"""Programs of controls: every flavour gives the path back that was written, and says what it does not follow."""

from __future__ import annotations

import inspect
import re
import textwrap
import tracemalloc
from collections.abc import Iterator
from math import pi
from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import FormatError, InputError
from elastogeo.formats import Reading, Writing, flavours, program_files, program_text, read_program_bytes
from elastogeo.machine import Arc, Array, Block, Comment, Dwell, Line, Program, Rapid, Stop
from tests.conftest import build_machine


def _registered_toy() -> None:
    """The recipe as it stands in the docstring, registered like any flavour."""
    found = re.search(
        r"`programs/steps\.py`::\n\n(.*?)\n\nWhat the contract asks", inspect.getdoc(program_files) or "", re.S
    )
    assert found
    exec(compile(textwrap.dedent(found[1]), "programs/steps.py", "exec"), {})


MACHINE = build_machine("wCAFYXZSt")
FLAVOURS = sorted({*flavours()} - {"steps"})
_registered_toy()
WORDS = [name for name in FLAVOURS if name != "heidenhain"]


def blocks(seed: int) -> Iterator[Block]:
    """A program of everything that the neutral blocks can say."""
    random = np.random.default_rng(seed)
    at = dict(zip("XYZAC", random.uniform(-1, 1, 5), strict=True)) | {"X": 90.0, "Y": 3.0, "Z": -20.0}
    yield Comment("Set the ball on the table (µm; 20 °C)")
    yield Rapid(dict(at))
    yield Stop("put the bar in")
    for plane, (first, second) in {"XY": "XY", "YZ": "YZ", "ZX": "ZX"}.items():
        for sense in (1, -1):
            centre = tuple(random.uniform(-40, 40, 2))
            angle = random.uniform(0.5, 6)
            a, b = at[first] - centre[0], at[second] - centre[1]
            turned = (a * np.cos(angle) - b * np.sin(angle), a * np.sin(angle) + b * np.cos(angle))
            at |= {first: centre[0] + turned[0], second: centre[1] + turned[1]}
            yield Arc(plane, {first: at[first], second: at[second]}, centre, sense, random.uniform(5, 40))
            yield Arc(plane, {first: at[first], second: at[second]}, centre, -sense, 20.0)
            at["Z" if plane == "XY" else "Y" if plane == "ZX" else "X"] += 4.0
            yield Line(dict(at), 12.5)
    yield Dwell(2.25)
    for _ in range(3):
        at |= {"X": at["X"] + 2.5, "A": at["A"] + 0.3, "C": at["C"] - 0.7}
        yield Line({axis: at[axis] for axis in "XAC"}, random.uniform(2, 30))
    at["C"] += 1.0
    yield Line({"C": at["C"]}, 0.05)
    centre = (at["X"] - 30.0, at["Y"])
    at["Z"] += 11.0
    yield Arc("XY", {"X": at["X"], "Y": at["Y"], "Z": at["Z"]}, centre, 1, 15.0, turns=3)


def evenly(commands: Array) -> Array:
    """2001 points of a path, evenly spaced along it, however it is cut into blocks."""
    moves = np.diff(commands, axis=0) * [1.0 if axis in "XYZ" else 100.0 for axis in MACHINE.axes]
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(moves, axis=1))])
    at = np.linspace(0, 1, 2001) * along[-1]
    return np.column_stack([np.interp(at, along, column) for column in commands.T])


@pytest.mark.parametrize("flavour", FLAVOURS)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_every_flavour_gives_the_path_back_that_was_written(flavour: str, seed: int) -> None:
    chord = 2e-4 if flavour == "heidenhain" else 0.0  # circles out of XY are lines there
    program = Program("Path and back", list(blocks(seed)))
    text = program_text(program, flavour, Writing(decimals=6))
    again = read_program_bytes(text.encode("ascii"), "x")
    wanted, got = (one.path(MACHINE, step=0.4, tolerance=1e-5) for one in (program, again))
    assert got.end_time == pytest.approx(wanted.end_time, rel=1e-5)
    np.testing.assert_allclose(evenly(got.commands), evenly(wanted.commands), atol=1e-2)
    assert program.extent().keys() == again.extent().keys()
    for axis, ends in program.extent().items():
        assert again.extent()[axis] == pytest.approx(ends, abs=1e-5 + chord)
    length = [one.moves().length.sum() for one in (program, again)]
    assert length[1] == pytest.approx(length[0], rel=1e-7 + 1e-2 * chord)
    said = [block for block in again.blocks if isinstance(block, Stop | Dwell)]
    assert [type(block) for block in said] == [Stop, Dwell]
    assert "PUT THE BAR IN" in said[0].message.upper()
    assert said[1].seconds == 2.25


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_the_samples_are_read_by_their_own_flavour_alone(flavour: str) -> None:
    text = flavours()[flavour].sample().encode()
    assert [name for name, one in flavours().items() if one.can_read(text)] == [flavour]
    program = read_program_bytes(text, "x")
    (arc,) = (block for block in program.blocks if isinstance(block, Arc))
    assert (arc.plane, arc.centre, arc.sense, arc.turns) == ("XY", (0.0, 0.0), 1, 1)
    assert arc.feed == pytest.approx(1000 / 60)
    assert program.moves().sweep[-1] == pytest.approx(2 * pi)
    assert next(block.seconds for block in program.blocks if isinstance(block, Dwell)) == 1.5
    for name in FLAVOURS:
        if name != flavour and {name, flavour} & {"heidenhain"}:
            with pytest.raises(FormatError, match="x, line 1"):
                read_program_bytes(text, "x", name)


BAD = {
    "an arc that does not close": ("G1 X100 Y0 F100\nG3 X80 Y0 I-100 J0", 3, "the arc does not close: its start is 100 mm"),
    "an arc without a centre": ("G1 X100 Y0 F100\nG3 X80 Y0", 3, "an arc without a centre or radius; give I or J"),
    "a radius that is too small": (
        "G1 X100 Y0 F100\nG3 X-100 R50",
        3,
        "200 mm apart, more than twice its radius",
    ),
    "a full circle by its radius": ("G1 X100 Y0 F100\nG3 X100 Y0 R50", 3, "a full circle by its radius has no centre"),
    "an unknown word": ("G1 X100 Y0 F100\nG1 X5 E7", 3, "the word E7 is not known here"),
    "an unknown function": ("G1 X100 Y0 F100\nG222 X5", 3, "G222 is not known to"),
    "inches": ("G20\nG1 X5 F5", 2, "G20 is inches; post-process the program in millimetres"),
    "no number": ("G1 XNAN F100", 2, "'XNANF100' is not understood: the number is not finite"),
    "a variable": ("#1=5\nG1 X#1 F5", 2, "'#1=5' is not understood: variables and expressions are not computed"),
    "a cutter's radius": ("G41 D1 X5", 2, "G41 corrects for the cutter's radius"),
    "a canned cycle": ("G81 X5 Y5 Z-10 R2 F100", 2, "G81 is a canned cycle; post-process plain blocks"),
    "no feed": ("G0 X0\nG1 X5", 3, "a move at a feed that was never given; write F"),
    "a feed of nothing": ("G1 X5 F0", 2, "the feed is 0; it must be positive"),
    "no motion": ("X5 Y5", 2, "a position without G0, G1, G2 or G3"),
    "steps from nowhere": ("G91\nG1 X5 F100", 3, "X goes on from a place that is not known"),
    "one word twice": ("G1 X5 X6 F100", 2, "the word X stands twice in one block"),
    "an open comment": ("G1 X5 F100 (go there", 2, "does not close; write both brackets on one line"),
    "a call": ("M98 P100", 2, "M98 calls another program"),
    "a decimal comma": ("G1 X5,5 F100", 2, "',5F100' is not understood: a decimal mark is a point"),
    "a line without end": ("G1 X1 F100 " + "Y1 " * 3000, 2, "has 9012 characters, and a block has 4000 at most"),
}


@pytest.mark.parametrize("name", BAD)
@pytest.mark.parametrize("flavour", ["iso", "linuxcnc"])
def test_what_is_not_followed_is_one_error_with_its_line(name: str, flavour: str) -> None:
    text, line, message = BAD[name]
    with pytest.raises(FormatError) as caught:
        read_program_bytes(f"G21 G17 G90 G94\n{text}\nM30\n".encode(), "bad.nc", flavour)
    said = str(caught.value)
    assert said.startswith(f"bad.nc, line {line}: ")
    assert message in said
    assert len(said) < 400


def test_a_program_that_is_cut_off_or_empty_or_huge_is_refused() -> None:
    with pytest.raises(FormatError, match=r"x, line 2: the program ends here without M2 or M30.*; it may be cut off"):
        read_program_bytes(b"G90 G1 X1 F100\nG1 X2\n", "x", "linuxcnc")
    with pytest.raises(FormatError, match="x: the file is empty"):
        read_program_bytes(b"", "x")
    with pytest.raises(FormatError, match="x: the program has no block"):
        read_program_bytes(b"G90\nM30\n", "x", "iso")
    with pytest.raises(FormatError, match="x: is larger than 100 MB"):
        read_program_bytes(b"G1 X1\n" * 17_000_000, "x")
    with pytest.raises(FormatError, match="x: is no program of a control that is known; say its flavour"):
        read_program_bytes(b"angle_deg,radial_um\n1,2\n", "x")
    with pytest.raises(FormatError, match="x: the file has zero bytes"):
        read_program_bytes(b"G1 X1\n\0\0M30\n", "x", "iso")


def test_what_moves_nothing_is_left_out_by_name() -> None:
    text = "%\nO0007 (PART)\nG90 G21 T4 M6\nN20 S12000 M3\nN30 G0 G43 H4 Z50\nX0 Y0\n/G1 X5. F100.\nM9\nG28 G91 Z0\nM30\n%\n"
    program = read_program_bytes(text.encode(), "x")
    assert program.name == "O0007"
    assert program.notes == (
        "left out: T4, M6, S12000, M3, H4, marks of blocks to skip (/), which are not skipped, M9, moves in machine "
        "coordinates (G28, G30, G53), numbers without a decimal point taken in mm",
    )
    assert program.lines is not None
    moves = [k for k, block in enumerate(program.blocks) if isinstance(block, Rapid | Line)]
    assert program.lines[moves].tolist() == [5, 6, 7]


def test_the_toy_of_the_recipe_writes_and_reads() -> None:
    text = flavours()["steps"].sample().encode()
    assert list(read_program_bytes(text, "x").blocks) == [Line({"X": 5.0}, 10.0)]
    assert program_text(read_program_bytes(text, "x"), "steps").encode() == text
    with pytest.raises(FormatError, match="x, line 2: the program does not end with END"):
        read_program_bytes(text[:-4], "x")


def test_reading_takes_what_a_text_does_not_say() -> None:
    text = b"G90 G21 G94\nG0 X0 Y0 C0\nG1 X3 Y4 C12 F600\nG4 P500\nG1 X1000 F100\nM30\n"
    program = read_program_bytes(text, "x", "iso")
    line = program.blocks[1]
    assert isinstance(line, Line)
    assert line.feed == pytest.approx(10 * 5 / 13)  # of 13, with a degree as a millimetre
    assert program.blocks[2] == Dwell(0.5)
    reading = Reading(feed_counts="linear", dwell_p="s", whole_numbers="um")
    other = read_program_bytes(text, "x", "iso", reading)
    assert other.blocks[2] == Dwell(500.0)
    assert other.blocks[3] == Line({"X": 1.0}, pytest.approx(100 / 60))
    with pytest.raises(InputError, match="feed_counts is 'some'; write one of linear, all"):
        Reading(feed_counts="some")


def test_an_arc_by_its_radius_is_the_short_way_or_the_long() -> None:
    text = b"G90 G21 G94\nG0 X10 Y0\nG3 X0 Y10 R10 F60\nG2 X10 Y0 R-10\nM30\n"
    first, second = (block for block in read_program_bytes(text, "x", "iso").blocks if isinstance(block, Arc))
    assert first.centre == pytest.approx((0.0, 0.0), abs=1e-12)
    assert second.centre == pytest.approx((10.0, 10.0), abs=1e-12)
    sweep = read_program_bytes(text, "x", "iso").moves().sweep
    assert sweep.tolist() == pytest.approx([0, pi / 2, -3 * pi / 2])


def test_the_face_writes_and_reads(tmp_path: Path) -> None:
    eg.new_test(tmp_path / "bar", instrument="ball-bar")
    eg.new_test(tmp_path / "loaded")
    tests = eg.read_campaign([tmp_path / "bar", tmp_path / "loaded"], planned=90)
    (file,) = eg.write_program(tests.tests["bar"], tmp_path / "bar.ngc", "linuxcnc", feed_in=2.0, overshoot=pi / 2)
    assert eg.read_program(file).extent()["X"] == (-150.0, 150.0)
    assert eg.read_program(file).extent()["Y"] == (-152.0, 152.0)
    files = eg.write_program(tests, tmp_path / "programs")
    assert [path.name for path in files] == ["bar.nc", "loaded.nc"]
    with pytest.raises(InputError, match="programs have no setting 'overshot'; there are: approach, between, "):
        eg.write_program(tests, tmp_path / "programs", overshot=3)
    with pytest.raises(InputError, match=r"there is no flavour 'siemens' of programs; there are: .*linuxcnc \(LinuxCNC\)"):
        eg.write_program(tests, tmp_path / "programs", "siemens")


def test_a_plan_has_a_program_for_each_of_its_tests(tmp_path: Path) -> None:
    plan = eg.plan(eg.read_machine("hermle_c50"), tests=2, count=12)
    files = eg.write_program(plan, tmp_path / "programs", "heidenhain", feed_in=3.0)
    assert len(files) == 2
    for file, planned in zip(files, plan.tests, strict=True):
        assert file.stem == planned.candidate.name
        assert eg.read_program(file).axes


def test_many_blocks_are_read_in_bounded_memory() -> None:
    def used(count: int) -> float:
        lines = "".join(f"N{k}G1X{k % 100}.{k % 1000:03d}Y{k % 77}.5F1000\n" for k in range(count))
        data = f"G21 G90 G94\n{lines}M30\n".encode()
        tracemalloc.start()
        program = read_program_bytes(data, "x", "iso")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert len(program.blocks) == count
        return peak / count

    assert used(20_000) < 160
    assert used(20_000) < 1.3 * used(5_000)


@pytest.mark.parametrize(
    ("text", "flavour"),
    [
        ("%\nO1 (SOFT START, TRANS)\nG21 G90\nG0 X1.\nM30\n%\n", "iso"),
        ("(SOFT START)\nG21 G90\nM0 (MSG, TURN=1 CR=5)\nG0 X1.\nM2\n", "linuxcnc"),
        ("g21 g64 p0.01\ng0 x1\nm2\n", "linuxcnc"),
        ("; CYCLE\nN10 G71 G90\nN20 G0 X=IC(5)\nN30 M30\n", "sinumerik"),
        ('N10 G0 X1\nN20 MSG("GO")\nN30 M30\n', "sinumerik"),
        ("\n  0  BEGIN PGM 12 MM\n1 L X+1 FMAX\n2 END PGM 12 MM\n", "heidenhain"),
        ("N1 (a part)\nN2 G0 X1. Y2. S500 M3\nM30\n", "iso"),
        ("a page of prose, which says G0 nowhere at the beginning of a line\n", ""),
        ("X,Y\n1,2\n", ""),
    ],
)
def test_the_language_is_told_from_the_words(text: str, flavour: str) -> None:
    assert [name for name, one in flavours().items() if one.can_read(text.encode())] == ([flavour] if flavour else [])


def test_a_program_as_a_system_writes_it_is_followed() -> None:
    text = """%
O1001 (POCKET)
N10 G00 G17 G21 G40 G49 G80 G90 G94
N20 T5 M06 (END MILL D10)
N30 G187 P3 E0.01
N40 G54 S8000 M03
N50 G00 X-12.5 Y0.
N60 G43 H05 Z50. M08
N70 Z2.
N80 G01 Z-3. F250.
N90 G02 X12.5 I12.5 J0. F900.
N100 X-12.5 I-12.5 J0.
N110 G03 X-12.5 Y0. I12.5
N120 G91 G01 X1. Y1.
N130 G90 G00 Z50. M09
N140 G91 G28 Z0.
N150 G28 Y0.
N160 M30
%
"""
    program = read_program_bytes(text.encode(), "x")
    moves = program.moves()
    assert program.name == "O1001"
    assert np.round(np.degrees(moves.sweep[moves.sweep != 0]), 9).tolist() == [-180.0, -180.0, 360.0]
    assert program.extent() == {"X": (-12.5, 12.5), "Y": (-12.5, 12.5), "Z": (-3.0, 50.0)}
    assert program.lines is not None
    assert program.lines[-1] == 15
    assert "moves in machine coordinates (G28, G30, G53) (2 times)" in program.notes[0]
    assert moves.feed[-2] == 15.0

"""What only SINUMERIK or Klartext can say, and what is not followed of it."""

from __future__ import annotations

from math import pi

import pytest

from elastogeo.errors import FormatError
from elastogeo.formats import read_program_bytes
from elastogeo.machine import Arc, Block, Comment, Dwell, Line, Rapid, Stop


def sinumerik(*lines: str) -> list[Block]:
    text = "\n".join(["; a part", "G710 G17 G90 G94 FFWON", *lines, "M30", ""])
    return list(read_program_bytes(text.encode(), "x", "sinumerik").blocks)[1:]


def klartext(*lines: str) -> list[Block]:
    numbered = [f"{k} {line}" for k, line in enumerate(["BEGIN PGM A MM", *lines, "END PGM A MM"])]
    return list(read_program_bytes("\n".join(numbered).encode(), "x").blocks)


def test_sinumerik_has_positions_and_centres_of_its_own() -> None:
    blocks = sinumerik(
        "N10 G0 X100 Y=0", "G1 X=IC(-10) F600", "G3 X-90 I=AC(0) J=AC(0)", "G2 X-70 Y0 CR=10", "G3 X-70 I5 TURN=2"
    )
    assert blocks[0] == Rapid({"X": 100.0, "Y": 0.0})
    assert blocks[1] == Line({"X": 90.0}, 10.0)
    assert blocks[2] == Arc("XY", {"X": -90.0}, (0.0, 0.0), 1, 10.0)
    assert blocks[3] == Arc("XY", {"X": -70.0, "Y": 0.0}, (-80.0, 0.0), -1, 10.0)
    assert blocks[4] == Arc("XY", {"X": -70.0}, (-65.0, 0.0), 1, 10.0, turns=3)


def test_sinumerik_says_and_waits() -> None:
    blocks = sinumerik('MSG("put the bar in; then go")', "M0", "MSG()", "G4 F1.5", "X5 G0 ; there", "STOPRE", "; done")
    assert blocks == [Stop("put the bar in; then go"), Dwell(1.5), Rapid({"X": 5.0}), Comment("done")]


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("TRAORI", "'TRAORI' transforms positions; post-process axis positions"),
        ("CYCLE800()", "CYCLE800 transforms positions"),
        ("R1=5", "'R1=5': variables and expressions are not computed"),
        ("G1 X=R1 F5", "'X=R1F5': variables and expressions are not computed"),
        ("G700", "G700 is inches"),
        ("L10", "L10 calls another program"),
        ("POCKET3(1,2)", "'POCKET3(1,2)' is not known to SINUMERIK here"),
        ("G1 X5", "a move at a feed that was never given"),
        ("G0 X0 Y0\nG3 X10 Y0 CR=4 F5", "its ends are 10 mm apart, more than twice its radius of 4 mm"),
        ("CIP X5 Y5", "'CIPX5Y5' is not understood"),
    ],
)
def test_what_is_not_followed_of_sinumerik_is_one_error_with_its_line(line: str, message: str) -> None:
    with pytest.raises(FormatError) as caught:
        sinumerik(line)
    said = str(caught.value)
    assert said.startswith(f"x, line {2 + len(line.splitlines())}: ")
    assert message in said
    assert len(said) < 400


def test_klartext_has_circles_about_a_pole_and_by_radius() -> None:
    blocks = klartext(
        "L X+100 Y+0 Z+5 R0 FMAX",
        "CC X+0 Y+0",
        "C X-100 Y+0 DR+ F600",
        "CP IPA-540 IZ-6 DR-",
        "CP PA+90 DR+",
        "CR X+10 Y+100 R+5 DR-",
        "CR X+0 Y+100 R-7 DR+ F300",
        "L IX+5 FMAX",
        "CC IX+10 IY+0",
        "C X+5 Y+100 DR-",
    )
    assert blocks[0] == Rapid({"X": 100.0, "Y": 0.0, "Z": 5.0})
    assert blocks[1] == Arc("XY", {"X": -100.0, "Y": 0.0}, (0.0, 0.0), 1, 10.0)
    helix, quarter, short, long, step, full = blocks[2:]
    assert isinstance(helix, Arc)
    assert (helix.to["Z"], helix.sense, helix.turns) == (-1.0, -1, 2)
    assert (helix.to["X"], helix.to["Y"]) == pytest.approx((100.0, 0.0))
    assert isinstance(quarter, Arc)
    assert quarter.to["Y"] == pytest.approx(100.0)
    assert isinstance(short, Arc)
    assert short.centre == pytest.approx((5.0, 100.0))
    assert isinstance(long, Arc)
    assert long.centre == pytest.approx((5.0, 100.0 + 24**0.5))
    assert long.feed == 5.0
    assert step == Rapid({"X": pytest.approx(5.0)})
    assert isinstance(full, Arc)
    assert full.centre == pytest.approx((15.0, 100.0))


def test_klartext_goes_the_long_way_by_a_negative_radius() -> None:
    text = b"0 BEGIN PGM A MM\n1 L X+10 Y+0 R0 FMAX\n2 CR X+0 Y+10 R+10 DR+ F60\n3 CR X+10 Y+0 R-10 DR-\n4 END PGM A MM\n"
    assert read_program_bytes(text, "x").moves().sweep.tolist() == pytest.approx([0.0, pi / 2, -3 * pi / 2])


def test_klartext_waits_and_stops() -> None:
    blocks = klartext(
        "; hello",
        "CYCL DEF 9.0 V.ZEIT",
        "CYCL DEF 9.1 V.ZEIT 1.5",
        "STOP ; look",
        "FUNCTION DWELL TIME2.5",
        "TOOL CALL 5 Z S100",
    )
    assert blocks == [Comment("hello"), Dwell(1.5), Stop("look"), Dwell(2.5)]


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("L X+Q1 R0 F100", "'X+Q1' is not understood: variables are not computed"),
        ("L X+5 RL F100", "RL and RR correct for the cutter's radius"),
        ("FN 0: Q1 = +5", "'FN 0: Q1 = +5' computes"),
        ("CALL LBL 1 REP 5", "calls another program or a part of this one"),
        ("CYCL DEF 200 BOHREN", "is a cycle; post-process plain blocks"),
        ("PLANE SPATIAL SPA+30 SPB+0 SPC+0", "transforms positions; post-process axis positions"),
        ("M128", "M128 gives tool tips for the control to transform"),
        ("C X+5 Y+5 DR+ F100", "a circle without a pole; write CC first"),
        ("L X+0 Y+0 FMAX\nCC X+5 Y+0\nC X+20 Y+0 DR+ F10", "the arc does not close"),
        ("L X+0 Y+0 FMAX\nCC X+5 Y+0\nCP IPA-90 DR+ F10", "IPA and DR have different signs"),
        ("L X+0 Y+0 FMAX\nCC X+5 Y+0\nC X+10 Y+0 F10", "a circle without its sense; write DR+ or DR-"),
        ("CC X+5 Z+0", "a pole out of the plane XY"),
        ("L X+1 X+2 F10", "the word X stands twice in one block"),
        ("L X+1,5 F10", "'X+1,5' is not understood: write words such as X+1.5"),
        ("RND R5", "is a contour that is not followed here"),
    ],
)
def test_what_is_not_followed_of_klartext_is_one_error_with_its_line(line: str, message: str) -> None:
    lines = line.splitlines()
    with pytest.raises(FormatError) as caught:
        klartext(*lines)
    said = str(caught.value)
    assert said.startswith(f"x, line {1 + len(lines)}: ")
    assert message in said
    assert len(said) < 400


def test_klartext_in_inches_or_cut_off_is_refused() -> None:
    with pytest.raises(FormatError, match="x, line 1: the program is in inches"):
        read_program_bytes(b"0 BEGIN PGM A INCH\n1 L X+5 FMAX\n2 END PGM A INCH\n", "x")
    with pytest.raises(FormatError, match="x, line 2: the program ends here without M2 or M30, or END PGM; it may"):
        read_program_bytes(b"0 BEGIN PGM A MM\n1 L X+5 FMAX\n", "x")


def test_klartext_is_judged_by_our_own_reader_alone() -> None:
    pytest.skip("Heidenhain Klartext by an interpreter that is not ours: none can be installed")

"""Radial traces as ball-bar software exports them: without angles, by index, both directions side by side."""

from math import pi, tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import FormatError
from elastogeo.formats.run_files import read_run_bytes
from elastogeo.formats.runs.csv import can_read, read_csv, read_csv_runs

FIVE = "1.5\n-2.5\n0.25\n4\n1.5\n"
RADIAL = [value / 1000 for value in (1.5, -2.5, 0.25, 4.0, 1.5)]
QUARTERS = [0.0, pi / 2, pi, 3 * pi / 2, tau]
BLOCK = "Start angle (deg): 0\nEnd angle (deg): 360\nDirection: CCW\n"


LAYOUTS = {
    "radial only": BLOCK + "radial_um\n" + FIVE,
    "index and radial": BLOCK + "Index,Radial (um)\n" + "".join(f"{n},{v}\n" for n, v in enumerate(FIVE.split())),
    "comments": "# start_angle_deg: 0\n# end_angle_deg: 360\nradial_um\n" + FIVE,
    "cells": "Start angle;0;deg;;\nEnd angle;360;deg;;\nDirection;CCW;;;\nNo.;Radial [um]\n"
    + "".join(f"{n};{v}\n" for n, v in enumerate(FIVE.replace(".", ",").split(), 1)),
    "units behind": "Start-angle = 0 deg\nEnd-angle = 6.283185307179586 rad\nRadius = 150 mm\nradial_um\n" + FIVE,
    "decimal comma": BLOCK.replace("360", "360,0")
    + "Radial [um];time_s\n"
    + "".join(f"{v};0,5\n" for v in FIVE.replace(".", ",").split()),
    "full circle, other order": BLOCK.replace("0\nEnd", "360\nEnd").replace("): 360\nDir", "): 0\nDir")
    + "radial_um\n"
    + FIVE,
    "pairs": "angle_deg,radial_um\n" + "".join(f"{90 * n},{v}\n" for n, v in enumerate(FIVE.split())),
    "pairs win": "Start angle (deg): 77\nangle_deg;radial_um\n"
    + "".join(f"{90 * n};{v}\n" for n, v in enumerate(FIVE.split())),
}


@pytest.mark.parametrize("text", LAYOUTS.values(), ids=LAYOUTS.keys())
def test_every_layout_reads_the_same(text: str) -> None:
    assert can_read(text.encode())
    table = read_csv(text.encode(), "f")
    assert table.column("angle").tolist() == pytest.approx(QUARTERS, rel=1e-15)
    assert table.column("radial").tolist() == RADIAL


def test_angles_by_feed_and_sample_rate() -> None:
    block = "Radius,150,mm\nFeed rate,1500,mm/min\nSample rate,60,Hz\nStart angle,90,deg\nDirection,CW\n"
    table = read_csv((block + "radial_um\n" + FIVE).encode(), "f")
    assert table.column("angle").tolist() == pytest.approx([pi / 2 - n / 360 for n in range(5)])
    assert table.metadata["direction"] == "CW"


def test_both_directions_side_by_side_are_two_runs() -> None:
    text = BLOCK.replace("Direction: CCW\n", "") + "No.;CCW [um];CW [um]\n1;1,5;3\n2;2,5;2\n3;0,5;1\n"
    ccw, cw = read_csv_runs(text.encode(), "f")
    assert (ccw.metadata["direction"], cw.metadata["direction"]) == ("CCW", "CW")
    assert ccw.column("radial").tolist() == [0.0015, 0.0025, 0.0005]
    assert cw.column("radial").tolist() == [0.003, 0.002, 0.001]
    assert ccw.column("angle").tolist() == [0.0, pi, tau]
    assert cw.column("angle").tolist() == [tau, pi, 0.0]
    assert read_run_bytes(text.encode(), "f", 2).column("radial").tolist() == [0.003, 0.002, 0.001]
    with pytest.raises(FormatError, match=r"f: holds 2 runs \(#1 CCW, #2 CW\); choose one"):
        read_csv(text.encode(), "f")


def test_both_directions_on_the_same_angles() -> None:
    text = "angle_deg,radial_cw_um,radial_ccw_um\n0,1,2\n90,3,4\n"
    cw, ccw = read_csv_runs(text.encode(), "f")
    assert cw.column("angle").tolist() == ccw.column("angle").tolist() == [0.0, pi / 2]
    assert (cw.metadata["direction"], ccw.metadata["direction"]) == ("CW", "CCW")
    assert cw.column("radial").tolist() == [0.001, 0.003]


def test_a_block_that_does_not_begin_to_tell_the_arc_changes_nothing() -> None:
    table = read_csv(b"radius: about 150\nmachine: C 50\nradial_um\n1\n", "f")
    assert list(table.columns) == ["radial"]


RATE = "start angle [deg]: 0\nsample rate [Hz]: 60\nfeed [mm/min]: 1500\nradius [mm]: 150\n"

BAD = {
    "end angle [deg]: 90\n": "gives no angles and no start angle; add 'start angle",
    "start angle [deg]: 0\n": "no end angle; .*, direction, radius, feed rate, sample rate must be given too",
    RATE: "to compute them without it, direction must be given too",
    RATE + "direction: CW\novershoot [deg]: 10\n": "states an overshoot but no end angle",
    RATE
    + "end angle [deg]: 90\n": "5 readings make 0.6366 deg by feed, radius and sample rate, but .* 90 deg: they contradict",
    RATE + "end angle [deg]: 0.64\novershoot [deg]: 0.001\n": "both fit; correct them",
    "start angle [deg]: 0\nend angle [deg]: 90\ndirection: CW\n": "an arc from 0 to 90 deg is not CW",
    "start angle [deg]: 0\nend angle [deg]: 0\n": "start and end angle are the same",
    "start angle [deg]: 0\nend angle [deg]: 90\ndirection: up\n": "'direction': the direction is 'up'; write CCW",
    "start angle: 0\nend angle [deg]: 90\n": r"'start angle': the unit '' is none of angle; write for example \[deg\]",
    "start angle [mm]: 0\nend angle [deg]: 90\n": "the unit 'mm' is none of angle",
    "start angle [deg]: 0\nstart_angle_rad: 0\nend angle [deg]: 90\n": "gives the start a second time",
    "start angle [deg]: 0\nend angle [deg]: 1,234\n": "'1,234' is not one number without doubt",
    "start angle [deg]: 0\nend angle [deg]: ninety\n": "'ninety' is not one number",
    "start angle [deg]: 0\nend angle [deg]: 1e999\n": "'1e999' is not valid",
    "start angle [deg]: 0\nend angle [deg]: 99999\n": "its end cannot be 1745.31",
    "start angle [deg]: 0\nsample rate [Hz]: 0\n": "it must be a finite number above zero",
}


@pytest.mark.parametrize("block", BAD, ids=range(len(BAD)))
def test_what_is_missing_or_contradicts_is_said(block: str) -> None:
    with pytest.raises(FormatError, match=f"^f[:,] ?.*{BAD[block]}"):
        read_csv((block + "radial_um\n" + FIVE).encode(), "f")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            BLOCK + "index,radial_um\n1,1\n2,1\n4,1\n",
            "column index goes from 2 to 4 at reading 3; angles can be computed only",
        ),
        (BLOCK + "radial_um\n1\n", "one reading makes no arc"),
        (BLOCK + "CCW;CW;force_N\n1;2;3\n2;3;4\n", "column 'CCW' has no unit of length; write radial_ccw_um"),
        (BLOCK + "radial_ccw_deg\n1\n2\n", "column 'radial_ccw_deg' has no unit of length"),
        (BLOCK + "ccw_um,radial_ccw_um\n1,1\n2,2\n", "two columns are of one direction"),
    ],
)
def test_columns_that_will_not_do(text: str, message: str) -> None:
    with pytest.raises(FormatError, match=f"^f.*{message}"):
        read_csv(text.encode(), "f")


PIECES = [
    "start angle",
    "end angle",
    "overshoot",
    "sample rate",
    "radius",
    "feed",
    "direction",
    " [deg]",
    " (Hz)",
    " [mm/min]",
]
PIECES += [
    ": ",
    ";",
    ",",
    "\n",
    "0",
    "360",
    "1e308",
    "1e-308",
    "-1",
    "CW",
    "nan",
    "radial_um",
    "ccw_um",
    "cw_um",
    "index",
    "deg",
]


@settings(derandomize=True, max_examples=500)
@given(st.lists(st.sampled_from(PIECES), max_size=30))
def test_any_block_gives_tables_or_a_format_error(pieces: list[str]) -> None:
    data = ("".join(pieces) + "\nradial_um\n1\n2\n").encode()
    can_read(data)
    message = "f"
    try:
        read_csv_runs(data, "f")
    except FormatError as error:
        message = str(error)
    assert message.startswith("f")

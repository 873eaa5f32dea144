"""What a new test of an instrument begins with: the texts of its files, kept beside the instrument."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Template:
    """The instrument's part of a new test folder.

    Attributes
    ----------
    title : str
        Of the test.
    setup : str
        Tables of `test.toml` from `[setup]` on. `@CENTRE@` becomes the commands of all axes at zero.
    columns : str
        Columns of a run file, for a comment.
    simulation : str
        The rest of `simulation.toml`, under schema and seed; with it the test gives a result that the data support.
    machine : str
        A shipped machine that the instrument suits.
    resolution_um : float
        Of the readings.
    level : str
        What the levels of the runs are: `force` [N], `engagement` [mm], or empty for none.
    levels : tuple of float
    both_ways : bool
        Whether each run is read counter-clockwise and clockwise.
    repeats : int
        Of each level.
    influences : str
        Tables `[[influences]]` of `test.toml`, with sizes that the user is to confirm.
    """

    title: str
    setup: str
    columns: str
    simulation: str
    machine: str = "hermle_c50"
    resolution_um: float = 0.1
    level: str = "force"
    levels: tuple[float, ...] = ()
    both_ways: bool = False
    repeats: int = 1
    influences: str = ""


FORCE = """\
[[influences]]
kind = "force-scale"
label = "calibration of the force"
relative = 0.01

"""
"""What is known of a force."""

BAR = """\
[[influences]]
kind = "bar-length"
label = "calibration of the bar"
length_um = 0.5

[[influences]]
kind = "bar-length"
label = "temperature of the bar, known to 0.5 K"
length_um = 0.9                  # 11.5 um/(m K) x 150 mm x 0.5 K

"""
"""What is known of the length of a bar of 150 mm."""

CIRCLE = """\
[setup.circle]
radius_mm = 150
plane = "XY"                     # XY, YZ, ZX, or two directions: [[1, 0, 0], [0, 0.8, 0.6]]
centre = { @CENTRE@ }            # axis commands at the centre; rotary axes are held where this says
"""
"""The circle of a bar."""

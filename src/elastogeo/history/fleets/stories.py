"""What is true of each machine of the demo fleet on each day: what a test of that day would find, were it perfect.

Between two tests of one recipe everything scatters a little, more than the readings within a test show: the force is set up
anew, the bar is clamped anew, the hall is warmer. The sizes are those of `reference/monitoring.md`, section 5, and its
section 6 for the faults.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi, sin

import numpy as np

YEAR = 365.25
EVERY = 28.0
"""Days between two tests."""

FORCE_SCATTER = 0.008
"""Relative, of all compliances of a test together: the force is set up anew."""
STIFFNESS_SCATTER = 0.004
"""Relative, of each direction by itself."""
SQUARENESS_SCATTER = 1e-6
SCALE_SCATTER = 1.5e-6
BACKLASH_SCATTER = 0.25e-3
STRAIGHTNESS_SCATTER = 0.2e-3
SEASON = 4.0
"""Amplitude [K] of the hall's temperature over the year."""
WEATHER = 1.0
"""Standard deviation [K] of one day's temperature about the season's."""
SQUARENESS_PER_KELVIN = 0.5e-6
SCALE_PER_KELVIN = 0.7e-6
"""By which the scale of X grows more than that of Y."""
SEATED_BADLY = 0.03
"""Share of tests in which a ball is not seated: the bar then gives way as it is loaded."""
GIVES_WAY = 0.08
"""Relative: by which the machine then seems softer in x."""
OF_THE_TABLE = 0.4
"""Share of the compliance of a direction that is that of the swivelling table."""


@dataclass(frozen=True, slots=True)
class Fault:
    """Something that befalls a machine.

    Attributes
    ----------
    kind : str
        `guideway`, `nut` or `collision`.
    after : float [d]
        Since the first test of the fleet.
    """

    kind: str
    after: float


@dataclass(frozen=True, slots=True)
class Story:
    """A machine of the fleet.

    Attributes
    ----------
    name, model, serial, place : str
        The model is a machine that ships.
    bar : str
        Serial number of the loaded ball bar that tests it.
    squareness : str
        The parameter that is the squareness of its X and Y.
    faults : tuple of Fault
    seated_badly : float
        Share of its tests in which a ball is not seated.
    until : float [d]
        When its tests end, if they end before the fleet's do: a machine whose next test is overdue.
    commissioned : bool
        Whether a campaign over its whole workspace was measured before its first test.
    """

    name: str
    model: str
    serial: str
    place: str
    bar: str
    squareness: str
    faults: tuple[Fault, ...] = ()
    seated_badly: float = 0.0
    until: float = field(default=float("inf"))
    commissioned: bool = False


RECALIBRATED = "B-202"
RECALIBRATED_AFTER = 2.2 * YEAR
NEW_FORCE = 0.05
"""Relative: by which the force of the bar is other than stated after it was recalibrated."""

HERMLE, HURON = "E_C(0Y)X", "E_C(0)X"
"""Squareness of X and Y where both move the tool, and where Y moves the workpiece."""

FLEET = (
    Story("Huron KX8 no. 1", "huron_kx8", "K-0801", "hall 2", RECALIBRATED, HURON),
    Story("Huron KX8 no. 2", "huron_kx8", "K-0802", "hall 2", RECALIBRATED, HURON, seated_badly=SEATED_BADLY),
    Story("Huron KX8 no. 3", "huron_kx8", "K-0803", "hall 2", RECALIBRATED, HURON, until=2.85 * YEAR),
    Story("Hermle C50 no. 1", "hermle_c50", "H-5011", "hall 1", "B-101", HERMLE, commissioned=True),
    Story("Hermle C50 no. 2", "hermle_c50", "H-5012", "hall 1", "B-101", HERMLE, (Fault("collision", 2.0 * YEAR),)),
    Story("Hermle C50 no. 3", "hermle_c50", "H-5013", "hall 1", "B-101", HERMLE, (Fault("nut", 1.6 * YEAR),)),
    Story("Hermle C50 no. 4", "hermle_c50", "H-5014", "hall 1", "B-101", HERMLE, (Fault("guideway", 1.3 * YEAR),)),
)


def softened(story: Story, day: float) -> float:
    """Relative loss of stiffness in x by a guideway that wears: an eighth in a year, evenly."""
    return sum(0.125 * max(0.0, day - fault.after) / YEAR for fault in story.faults if fault.kind == "guideway")


def worn(story: Story, day: float) -> float:
    """Backlash [mm] that a worn nut adds: a micrometre in thirty days, evenly."""
    return sum(1e-3 * max(0.0, day - fault.after) / 30.0 for fault in story.faults if fault.kind == "nut")


def struck(story: Story, day: float) -> float:
    """Squareness [rad] that a collision leaves."""
    return sum(30e-6 for fault in story.faults if fault.kind == "collision" and day >= fault.after)


def temperature(day: float, random: np.random.Generator) -> float:
    """Of the machine [degC] on one day: warmest at the end of July."""
    return 21.0 + SEASON * sin(2 * pi * (day - 110.0) / YEAR) + WEATHER * float(random.normal())


def truth(story: Story, day: float, warm: float, seated: bool, random: np.random.Generator) -> Mapping[str, float]:
    """True parameters of a machine on a day, in their own units; what scatters between tests is drawn.

    Parameters
    ----------
    story : Story
    day : float [d]
        Since the first test of the fleet.
    warm : float [degC]
        Temperature of the machine.
    seated : bool
        Whether the ball is seated.
    random : Generator

    A worn guideway of Y gives way across itself (`C_XXY`) and yaws (`C_CXY`), and Y runs less straight; a worn nut of X
    gives clearance (`B_XX`) and a little compliance along X.
    """
    own = np.random.default_rng([*story.serial.encode()])
    across, along, square, scale_x, scale_y, backlash_x, backlash_y = own.normal(1.0, 0.1, 7)
    warm -= 21.0
    gauge = 1 + FORCE_SCATTER * random.normal()
    if story.bar == RECALIBRATED and day >= RECALIBRATED_AFTER:
        gauge *= 1 + NEW_FORCE
    seat = 0.0 if seated else GIVES_WAY
    soft_x, soft_y = gauge * (1 + STIFFNESS_SCATTER * random.normal(size=2))
    loss = softened(story, day)
    compliance = 4.0e-5 * across
    guide = compliance * loss / (1 - min(loss, 0.9))  # what makes the stiffness fall by the loss
    return {
        "C_XXX": soft_x * (compliance * 0.6 + 0.5e-6 * worn(story, day) / 1e-3 + seat * compliance),
        "C_XXY": soft_x * (compliance * 0.4 + 0.9 * guide),
        "C_CXY": -2.5e-8 * gauge * (1 + 8 * loss),
        "C_YYY": soft_y * 3.2e-5 * along,
        "C_XYX": 8e-7 * gauge,
        "C_CCY": 5e-11 * gauge,
        story.squareness: 8e-6 * square
        + struck(story, day)
        + SQUARENESS_PER_KELVIN * warm
        + SQUARENESS_SCATTER * random.normal(),
        "E_XX1": -4e-5 * scale_x + SCALE_PER_KELVIN * warm + SCALE_SCATTER * random.normal(),
        "E_YY1": -3e-5 * scale_y + SCALE_SCATTER * random.normal(),
        "E_YX2": (2e-3 + STRAIGHTNESS_SCATTER * random.normal()) / 150**2,
        "E_XY2": (-3e-3 - 6e-3 * loss + STRAIGHTNESS_SCATTER * random.normal()) / 150**2,
        "B_XX": 1.5e-3 * backlash_x + worn(story, day) + BACKLASH_SCATTER * random.normal(),
        "B_YY": 1.2e-3 * backlash_y + BACKLASH_SCATTER * random.normal(),
    }


def everywhere(monthly: Mapping[str, float]) -> Mapping[str, float]:
    """True parameters where the monthly test does not go either: to that test it is the same machine.

    With the table level and unturned, what it gives way adds to what the axis below it does.
    """
    return {
        **monthly,
        "C_XXX": (1 - OF_THE_TABLE) * monthly["C_XXX"],
        "C_XXC": OF_THE_TABLE * monthly["C_XXX"],
        "C_YYY": (1 - OF_THE_TABLE) * monthly["C_YYY"],
        "C_YYA": OF_THE_TABLE * monthly["C_YYY"],
        "C_ZZZ": 3.1e-5,
        "C_AZY": 1.5e-8,
        "E_ZZ1": 1.5e-5,
    }

"""Parts milled in simulation on a machine with known faults, compensated by identified ones: `python -m studies.milled`.

The machine has compliance and geometry; a loaded circle in XY, simulated by exact products of transforms with noise, is all
that is known of it. A circular slot and a contour of lines and arcs are milled with a cylindrical mill: where the tool
really goes is found by exact products of transforms too, under a force and with a tool that are each off from what was
stated by less than their stated uncertainty. Then the program is corrected by what was identified, and milled again. The
error of a part is measured as a coordinate measuring machine would: the distance of the real path from the nominal shape.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi, radians

import numpy as np

from elastogeo.formats import example_test, read_test
from elastogeo.identification import Identification, identify
from elastogeo.machine import (
    COEFFICIENTS,
    Arc,
    Array,
    Cut,
    Engagement,
    HeldTool,
    Line,
    Mill,
    MillingForce,
    Program,
    Rapid,
    ToolPath,
    ToolSection,
    cantilever,
    path_of_program,
)
from elastogeo.observe import Imperfection
from elastogeo.prediction import simulated_points
from elastogeo.prediction.compensation import PathCompensation, compensate_path
from elastogeo.sources import simulate

FAULTS = {
    "C_XXX": 6.2e-5,
    "C_XYX": 1.1e-5,
    "C_YYY": 4.3e-5,
    "C_CXY": 4e-8,
    "C_CYY": -6e-8,
    "C_CCY": 2e-10,
    "E_XX1": -1.2e-4,
    "E_YX2": 4e-7,
    "E_XY2": -3e-7,
    "E_YY1": 1.8e-4,
    "E_C(0Y)X": 9e-5,
}
"""What the machine has, and the circle is asked for."""

HIDDEN = {"E_ZX1": 5e-5}
"""What it has besides, and nobody asks for: X climbs by 5 um in 100 mm."""

FEED = 1200 / 60
FORCE, TOOL = 0.1, 0.15
"""Stated relative standard uncertainty of the cutting force and of the tool."""

FORCE_OFF, TOOL_OFF = 1.07, 0.9
"""What they really are, of what is stated."""

RUN_IN = 2.0
"""Way [mm] at the beginning that is not measured: where the tool comes from is no part of these programs."""

CENTRE, RADIUS = (10.0, -20.0), 60.0
SECTIONS = (ToolSection(26.0, 9.6, 600e3), ToolSection(19.0, 12.0, 600e3))


@dataclass(frozen=True)
class Milled:
    """A part milled as programmed, and as corrected.

    Attributes
    ----------
    name : str
    before, after : array, shape (m,), (k,) [mm]
        Distance of the real path from the nominal shape, to the left of the travel.
    found : PathCompensation
        What was predicted of both.
    held_before, held_after : float
        Share of the points at which the predicted interval holds what was measured.
    """

    name: str
    before: Array
    after: Array
    found: PathCompensation
    held_before: float
    held_after: float


def known(seed: int = 5) -> Identification:
    """What one loaded circle says of the machine."""
    test = read_test(example_test())
    return identify(simulate(test, {**FAULTS, **HIDDEN, "E_Xt0": 0.01, "E_Yt0": -0.02}, Imperfection(noise=1e-4), seed))


def stated() -> Cut:
    """The cut as it is known beforehand."""
    force = MillingForce(
        COEFFICIENTS["Al7075-T6"], Mill(12.0, 4, radians(30)), Engagement(4.0), 2 * pi * 50, relative_uncertainty=FORCE
    )
    return Cut(force, cantilever(SECTIONS, TOOL))


def real() -> Cut:
    """The cut as it is."""
    cut = stated()
    assert isinstance(cut.force, MillingForce)
    assert cut.tool is not None
    edge = cut.force.edge
    off = {name: FORCE_OFF * value for name in edge.__slots__ if isinstance(value := getattr(edge, name), float)}
    return replace(cut, force=replace(cut.force, edge=replace(edge, **off)), tool=HeldTool(TOOL_OFF * cut.tool.matrix))


def slot() -> Program:
    """A full circle, counter-clockwise."""
    start = {"X": CENTRE[0] + RADIUS, "Y": CENTRE[1]}
    return Program("circular slot", [Rapid({**start, "Z": 0.0}), Arc("XY", start, CENTRE, 1, FEED)])


def contour() -> Program:
    """A rectangle of 160 by 100 mm with round corners of 20 mm, counter-clockwise."""
    blocks: list[Rapid | Line | Arc] = [Rapid({"X": -60.0, "Y": -50.0, "Z": 0.0})]
    for to, corner, centre in (
        ((60.0, -50.0), (80.0, -30.0), (60.0, -30.0)),
        ((80.0, 30.0), (60.0, 50.0), (60.0, 30.0)),
        ((-60.0, 50.0), (-80.0, 30.0), (-60.0, 30.0)),
        ((-80.0, -30.0), (-60.0, -50.0), (-60.0, -30.0)),
    ):
        blocks.append(Line({"X": to[0], "Y": to[1]}, FEED))
        blocks.append(Arc("XY", {"X": corner[0], "Y": corner[1]}, centre, 1, FEED))
    return Program("contour", blocks)


def off_the_slot(points: Array) -> Array:
    """Distance from the nominal circle, inward: to the left of a counter-clockwise travel."""
    return np.asarray(RADIUS - np.hypot(points[:, 0] - CENTRE[0], points[:, 1] - CENTRE[1]))


def off_the_contour(points: Array) -> Array:
    """Distance from the nominal rectangle with round corners, inward."""
    past = np.abs(points[:, :2]) - np.array([60.0, 30.0])
    outside = np.hypot(*np.maximum(past, 0.0).T) + np.minimum(past.max(axis=1), 0.0)
    return np.asarray(20.0 - outside)


PARTS: dict[str, tuple[Callable[[], Program], Callable[[Array], Array]]] = {
    "circular slot": (slot, off_the_slot),
    "contour": (contour, off_the_contour),
}


def milled(name: str, result: Identification) -> Milled:
    """One part, before and after."""
    program, off = PARTS[name][0](), PARTS[name][1]
    machine, truth = result.campaign.machine, {**FAULTS, **HIDDEN}
    found = compensate_path(result, program, stated(), step=1.0, tolerance=0.002)
    as_programmed = path_of_program(program, machine, 1.0)
    as_corrected = path_of_program(found.program, machine, 1.0)
    before, after = (
        off(went(truth, path) - origin(result))[path.travelled > RUN_IN] for path in (as_programmed, as_corrected)
    )
    sent = found.before.path
    held = []
    for commands, value, wide in (
        (sent.commands, found.before.value, found.before.expanded),
        (found.commands, found.value, found.expanded),
    ):
        measured = off(went(truth, replace(sent, commands=commands)) - origin(result))
        held.append(float(np.mean(np.abs(measured - value[:, 3]) <= wide[:, 3])))
    return Milled(name, before, after, found, *held)


def went(truth: dict[str, float], path: ToolPath) -> Array:
    """Where the tool really goes."""
    return simulated_points(truth, path, real())


def origin(result: Identification) -> Array:
    """Where the tool is at zero commands, in the frame of the workpiece: the zero of the part."""
    machine = result.campaign.machine
    still = path_of_program(Program("zero", [Rapid({"X": 1.0}), Line({"X": 0.0}, 1.0)]), machine, 10.0)
    return still.points[-1]


def main() -> None:
    """One line for each part."""
    result = known()
    print("| part | | greatest error [um] | predicted, greatest [um] | interval holds |")
    print("|---|---|---:|---:|---:|")
    for name in PARTS:
        part = milled(name, result)
        for when, measured, value, wide, held in (
            ("before", part.before, part.found.before.value, part.found.before.expanded, part.held_before),
            ("after", part.after, part.found.value, part.found.expanded, part.held_after),
        ):
            at = int(np.nanargmax(np.abs(value[:, 3])))
            greatest, told = f"{np.abs(measured).max() * 1e3:.1f}", f"{value[at, 3] * 1e3:.1f} ± {wide[at, 3] * 1e3:.1f}"
            print(f"| {name} | {when} | {greatest} | {told} | {100 * held:.0f} % |")
        left = "; ".join(f"{', '.join(one.names)}: {one.reason}" for one in part.found.left_out)
        print(f"| | made good in {', '.join(part.found.components)} | left: {left} | | |")


if __name__ == "__main__":
    main()

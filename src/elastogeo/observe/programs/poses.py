"""Going to poses: safely from anywhere, from one to the next, and standing there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import degrees

from elastogeo.errors import PathError
from elastogeo.machine import PROGRAM_AXES, Block, Comment, Dwell, Line, Machine, Rapid, Stop
from elastogeo.observe.procedure import Procedure


@dataclass(frozen=True, slots=True)
class Pose:
    """Where to stand, and what is done there.

    Attributes
    ----------
    to : mapping of str to float [mm, rad]
        Commands of every axis.
    before : str
        What the operator does before the machine goes there, in words; empty for nothing.
    there : str
        What the operator does there; empty to stand for the dwell of the procedure.
    comment : str
    """

    to: Mapping[str, float]
    before: str = ""
    there: str = ""
    comment: str = ""


def axis_words(commands: Mapping[str, float]) -> str:
    """Axis commands for people: `X100 Y0 C30`."""
    return " ".join(f"{axis}{degrees(value) if axis in 'ABC' else value:.6g}" for axis, value in commands.items())


def movable(machine: Machine) -> tuple[str, ...]:
    """The axes of a machine that a program moves: all but its spindle."""
    return tuple(axis for axis in machine.axes if axis in PROGRAM_AXES)


def approach(machine: Machine, to: Mapping[str, float], procedure: Procedure) -> Iterator[Block]:
    """From anywhere to a pose: first away from the workpiece along Z, then above the pose, then down to it at a feed."""
    _check_within(machine, to)
    above = above_of(machine, to, procedure)
    if above is None:
        yield Rapid(dict(to))
        return
    yield Rapid({"Z": above})
    rotary = {axis: value for axis, value in to.items() if axis in "ABC"}
    if rotary:
        yield Rapid(rotary)
    yield Rapid({axis: value for axis, value in to.items() if axis not in "ABCZ"})
    yield Line({"Z": to["Z"]}, procedure.approach)


def retreat(machine: Machine, at: Mapping[str, float], procedure: Procedure) -> Iterator[Block]:
    """Away from a pose along Z."""
    above = above_of(machine, at, procedure)
    if above is not None:
        yield Line({"Z": above}, procedure.approach)


def above_of(machine: Machine, to: Mapping[str, float], procedure: Procedure) -> float | None:
    """Z command [mm] above a pose: positive Z is away from the workpiece (ISO 841). None where there is no way up."""
    if "Z" not in to:
        return None
    high = machine.joints[machine.index("Z")].travel[1]
    above = min(to["Z"] + procedure.clearance, high)
    return above if above > to["Z"] else None


def pose_blocks(machine: Machine, poses: Sequence[Pose], procedure: Procedure) -> list[Block]:
    """To every pose in turn, and standing there."""
    blocks: list[Block] = []
    last: Mapping[str, float] | None = None
    for pose in poses:
        if pose.comment:
            blocks.append(Comment(pose.comment))
        if pose.before:
            blocks.append(Stop(pose.before))
        if last is None or dict(last) != dict(pose.to):
            if last is not None:
                blocks += retreat(machine, last, procedure)
            blocks += approach(machine, pose.to, procedure)
        blocks.append(Stop(pose.there) if pose.there else Dwell(procedure.dwell))
        last = pose.to
    if last is not None:
        blocks += retreat(machine, last, procedure)
    return blocks


def _check_within(machine: Machine, to: Mapping[str, float]) -> None:
    for axis, value in to.items():
        low, high = machine.joints[machine.index(axis)].travel
        if not low <= value <= high:
            unit = "rad" if axis in "ABC" else "mm"
            raise PathError(
                f"machine {machine.name!r}: the program would move {axis} to {value:g} {unit}, its travel is {low:g} to "
                f"{high:g} {unit}; move the test, or correct the machine file"
            )

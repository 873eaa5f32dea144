"""The program of a positioning test: to every target from one side and from the other, as ISO 230-2 wants it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from elastogeo.errors import PathError
from elastogeo.machine import Array, Block, Comment, Dwell, Line, Machine, Stop
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.programs import approach, axis_words, movable, retreat
from elastogeo.observe.run import Run

_SAME = 1e-9


def target_blocks(
    machine: Machine,
    axis: str,
    pose: Mapping[str, float],
    cycles: Sequence[tuple[Run, Array, Array]],
    procedure: Procedure,
) -> list[Block]:
    """The blocks of all runs.

    Parameters
    ----------
    machine : Machine
    axis : str
        That moves.
    pose : mapping of str to float [mm, rad]
        Of the other axes.
    cycles : sequence of (Run, array, array), shape (m,)
        Each run with its targets [mm or rad], and from which side each is approached (+1 from below).
    procedure : Procedure

    Raises
    ------
    PathError
        If a target cannot be approached from its side within the travel.
    """
    rotary = axis in "ABC"
    overrun = procedure.overrun_angle if rotary else procedure.overrun
    feed = procedure.rotary_feed if rotary else procedure.feed
    first = _before(machine, axis, float(cycles[0][1][0]), float(cycles[0][2][0]), overrun)
    start = {name: pose.get(name, 0.0) for name in movable(machine)} | {axis: first}
    blocks: list[Block] = [
        Comment(f"positioning test of {axis}, other axes at {axis_words({n: v for n, v in start.items() if n != axis})}"),
        Comment("work offset: every axis zero where the machine file counts from"),
        Stop("way free, sensor not yet in place"),
        *approach(machine, start, procedure),
        Stop("align the sensor, set it to zero"),
    ]
    at = first
    for run, targets, senses in cycles:
        blocks.append(Comment(f"run {run.name}"))
        for target, sense in zip(targets.tolist(), senses.tolist(), strict=True):
            if sense * (target - at) <= _SAME:
                at = _before(machine, axis, target, sense, overrun)
                blocks.append(Line({axis: at}, feed))
            blocks += [Line({axis: target}, feed), Dwell(procedure.dwell)]
            at = target
    return [*blocks, Stop("take the sensor away"), *retreat(machine, {**start, axis: at}, procedure)]


def _before(machine: Machine, axis: str, target: float, sense: float, overrun: float) -> float:
    """Where the axis goes first to come to a target from one side: by the overrun, or as far as its travel lets it.

    Raises
    ------
    PathError
        If there is no way on that side.
    """
    low, high = machine.joints[machine.index(axis)].travel
    place = min(max(target - sense * overrun, low), high)
    if not sense * (target - place) > _SAME:
        unit = "rad" if axis in "ABC" else "mm"
        side = "below" if sense > 0 else "above"
        raise PathError(
            f"machine {machine.name!r}: {axis} cannot come to the target {target:g} {unit} from {side}, its travel is "
            f"{low:g} to {high:g} {unit} and the overrun {overrun:g} {unit}; move the target inwards"
        )
    return place

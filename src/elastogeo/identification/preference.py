"""Which of several parameters that cannot be distinguished is retained, unless the user prefers another.

On-axis compliances of the moving axes come first; then, as in the thesis (4.5), translations for a force, rotations for a
force, translations for a moment, rotations for a moment; joints that move before joints that stand.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.machine import AXIS_ORDER, Array, Machine
from elastogeo.sources import Source

_LAST = 99


def retaining_order(
    sources: Sequence[Source], machine: Machine, spans: Sequence[Array], prefer: Sequence[str] = ()
) -> tuple[str, ...]:
    """Names of the sources, the one to retain first coming first.

    Parameters
    ----------
    sources : sequence of Source
    machine : Machine
    spans : sequence of array, shape (axes,)
        By how much the command of each axis changes within each run: they tell which axes move.
    prefer : sequence of str
        Names that come before all others, in this order.
    """
    moving = moving_axes(machine, spans)
    ranked = sorted(range(len(sources)), key=lambda k: (*_rank(sources[k], machine, moving), k))
    return tuple(dict.fromkeys([*prefer, *(sources[k].name for k in ranked)]))


def moving_axes(machine: Machine, spans: Sequence[Array]) -> frozenset[str]:
    """The axes whose command changes within any of the runs, by how much it does in each, shape (axes,)."""
    return frozenset(axis for axis, span in zip(machine.axes, np.max(spans, axis=0), strict=True) if span > 0)


def _rank(source: Source, machine: Machine, moving: frozenset[str]) -> tuple[int, ...]:
    axis, displacement, load = source.site[1], source.component, source.load
    if load is None or not axis:
        return (_LAST,)
    kind = (displacement >= 3) + 2 * (load >= 3)
    if source.site[0] == "place":  # rigid by default: the joint is retained
        return (True, True, kind, displacement, load, _LAST)
    joint = machine.joints[machine.index(axis)]
    on_axis = displacement == load == joint.direction + 3 * joint.is_rotary
    moves = axis in moving
    return (not (on_axis and moves), not moves, kind, displacement, load, AXIS_ORDER.index(axis))

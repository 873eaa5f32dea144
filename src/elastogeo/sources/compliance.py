"""Joint compliance C_dfj: displacement component d at joint j per load component f at joint j (Eqs. 4.6, 4.13)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.machine import COMPONENTS, Array, Joint, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source, twist_unit

_WORDS = {
    "X": "translation in x",
    "Y": "translation in y",
    "Z": "translation in z",
    "A": "rotation about x",
    "B": "rotation about y",
    "C": "rotation about z",
}


@dataclass(frozen=True, slots=True)
class JointLoad:
    """Driver: the load component f at joint j, `(J^T W)[j, f]`."""

    axis: str
    component: int

    def __call__(self, situation: Situation) -> Array:
        """Load [N or N mm] at every reading, shape (m,)."""
        return situation.load(self.axis)[:, self.component]


@family
def joint_compliance(machine: Machine) -> Iterator[Source]:
    """All 36 compliances of every compliant joint, row by row of each joint's matrix (Eq. 4.14)."""
    for joint in machine.compliant:
        yield from (_compliance(joint, d, f) for d in range(6) for f in range(6))


def _compliance(joint: Joint, d: int, f: int) -> Source:
    load = f"force in {COMPONENTS[f].lower()}" if f < 3 else f"moment about {COMPONENTS[f - 3].lower()}"
    return Source(
        name=f"C_{COMPONENTS[d]}{COMPONENTS[f]}{joint.name}",
        unit=f"{twist_unit(d)}/{'N' if f < 3 else '(N mm)'}",
        site=("motion", joint.name),
        component=d,
        driver=JointLoad(joint.name, f),
        meaning=f"{_WORDS[COMPONENTS[d]]} for a {load}, at joint {joint.name}",
        load=f,
        force_degree=1.0,
    )


def alike_at_the_tool(machine: Machine) -> tuple[tuple[str, ...], ...]:
    """Compliances that no test between tool and workpiece tells apart, whatever its poses, loads and tools.

    A linear joint that gives way along a fixed direction displaces the tool by the same vector wherever it sits in the loop,
    and carries the same force: the columns of such joints in a row, with no rotary joint between and none inclined, are
    identical. Across the foundation too: both signs turn.
    """
    rows: list[list[Joint]] = [[]]
    for name in machine.axes:
        joint = machine.joints[machine.index(name)]
        if joint.is_rotary or any(joint.tilt):
            rows.append([])
        elif joint.compliant:
            rows[-1].append(joint)
    return tuple(
        tuple(f"C_{COMPONENTS[d]}{COMPONENTS[f]}{joint.name}" for joint in row)
        for row in rows
        if len(row) > 1
        for d in range(3)
        for f in range(3)
    )

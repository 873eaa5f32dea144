"""Joint compliance C_dfj: displacement component d at joint j per load component f at joint j (Eqs. 4.6, 4.13)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.machine import COMPONENTS, Array, Machine, Site
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
    """Driver: the load component f at joint j, `(J^T W)[j, f]`, or at a place, by its name."""

    axis: str
    component: int

    def __call__(self, situation: Situation) -> Array:
        """Load [N or N mm] at every reading, shape (m,)."""
        return situation.load(self.axis)[:, self.component]


@family
def joint_compliance(machine: Machine) -> Iterator[Source]:
    """All 36 compliances of every compliant joint, row by row of each joint's matrix (Eq. 4.14)."""
    for joint in machine.compliant:
        yield from spring("C", ("motion", joint.name), f"joint {joint.name}")


def spring(letter: str, site: Site, where: str) -> Iterator[Source]:
    """The 36 compliances of one site, row by row: `letter` begins their names, `where` says it in words."""
    for d in range(6):
        for f in range(6):
            yield Source(
                name=f"{letter}_{COMPONENTS[d]}{COMPONENTS[f]}{site[1]}",
                unit=f"{twist_unit(d)}/{'N' if f < 3 else '(N mm)'}",
                site=site,
                component=d,
                driver=JointLoad(site[1], f),
                meaning=f"{_twist_words(d)} for a {_load_words(f)}, at {where}",
                load=f,
                force_degree=1.0,
            )


def load_of(source: Source) -> JointLoad:
    """The load that drives a compliance."""
    return JointLoad(source.site[1], source.load or 0)


def _twist_words(component: int) -> str:
    """A displacement component in words: `rotation about z`."""
    return _WORDS[COMPONENTS[component]]


def _load_words(component: int) -> str:
    """A load component in words: `moment about x`."""
    return f"{'moment about' if component >= 3 else 'force in'} {'xyz'[component % 3]}"

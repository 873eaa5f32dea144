"""Reciprocity of joints: a joint's compliance matrix is symmetric (Maxwell and Betti), so C_dfj and C_fdj are one number.

`reciprocal_sources` builds that into the model, and `reciprocity` says what the assumption buys.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

from elastogeo.estimate import Array, Confounding, confounding
from elastogeo.identification.preference import retaining_order
from elastogeo.identification.systems import merged, run_systems
from elastogeo.machine import Machine, Site
from elastogeo.observe import Observations
from elastogeo.sources import JointLoad, Situation, Source


@dataclass(frozen=True, slots=True)
class ReciprocalSource(Source):
    """Two compliances C_dfj and C_fdj as one parameter, the value of both: its column is the sum of theirs.

    Attributes
    ----------
    mirror : Source
        The other of the pair; name, component and driver of this source are those of the one that gave the name.
    """

    mirror: Source | None = None

    def column(self, situation: Situation) -> Array:
        """Change of every reading per unit of both, shape (m,)."""
        own = Source.column(self, situation)
        return own if self.mirror is None else own + self.mirror.column(situation)


@dataclass(frozen=True, slots=True)
class Reciprocity:
    """What assuming the symmetry of every joint buys in separation.

    Attributes
    ----------
    free, symmetric : Confounding
        Without and with the assumption; with it, a pair is one parameter.
    pairs : tuple of tuple of 2 str
        The merged pairs, the one that names both first.
    testable : int
        How many independent differences C_dfj - C_fdj, or sums of such, the observations see: so many checks of the
        assumption does the free estimate hold.
    alone_free, alone_symmetric : tuple of str
        Parameters that were asked for and are determined by themselves; with the assumption, both of a pair.
    """

    free: Confounding
    symmetric: Confounding
    pairs: tuple[tuple[str, str], ...]
    testable: int
    alone_free: tuple[str, ...]
    alone_symmetric: tuple[str, ...]


def reciprocal_sources(sources: Sequence[Source]) -> tuple[Source, ...]:
    """The same sources with each pair C_dfj, C_fdj merged into one parameter that is the value of both.

    The one with the force as load names the pair, else the one whose displacement comes first in X Y Z A B C: `C_XYX` and
    `C_CXY`, as the thesis retains. A compliance whose mirror is not among the sources stays as it is.
    """
    at: dict[tuple[Site, int | None, int | None], Source] = {
        (source.site, source.component, source.load): source for source in sources if is_compliance(source)
    }
    pairs: list[Source] = []
    for source in sources:
        mirror = at.get((source.site, source.load, source.component)) if is_compliance(source) else None
        if mirror is None or mirror is source:
            pairs.append(source)
        elif _names_pair(source):
            own = {field.name: getattr(source, field.name) for field in fields(Source)}
            own["meaning"] = f"{source.meaning}; by reciprocity also {mirror.meaning}"
            pairs.append(ReciprocalSource(**own, mirror=mirror))
    return tuple(pairs)


def reciprocity(
    sources: Sequence[Source],
    machine: Machine,
    observations: Sequence[Observations],
    reference: float | None = None,
    prefer: Sequence[str] = (),
) -> Reciprocity:
    """What the symmetry of every joint buys: the same observations with and without it.

    A force along the sensitive direction only ever shows C_dfj + C_fdj (virtual work: the reading is a quadratic form of the
    load), so there it takes away unknowns and no measured information, and nothing tests it. A force across the sensitive
    direction shows C_dfj by itself; the mirror then comes for free, or is a check.

    Parameters
    ----------
    sources : sequence of Source
    machine : Machine
    observations : sequence of Observations
        One per run.
    reference : float, optional [N]
        Force level that is subtracted, as in `run_systems`.
    prefer : sequence of str
        Parameters to retain first.
    """
    together = reciprocal_sources(sources)
    free = _found(sources, machine, observations, reference, prefer)
    symmetric = _found(together, machine, observations, reference, prefer)
    pairs = tuple((s.name, s.mirror.name) for s in together if isinstance(s, ReciprocalSource) and s.mirror is not None)
    partner = dict(pairs)
    alone_free = _alone(free)
    alone = [name for name in _alone(symmetric) for name in (name, partner.get(name, name))]
    alone_symmetric = tuple(label for label in free.labels if label in alone)
    testable = free.rank - symmetric.rank
    return Reciprocity(
        free=free,
        symmetric=symmetric,
        pairs=pairs,
        testable=testable,
        alone_free=alone_free,
        alone_symmetric=alone_symmetric,
    )


def is_compliance(source: Source) -> bool:
    """Whether a source is an entry of a joint's compliance matrix, and no law of a higher power of the load."""
    return isinstance(source.driver, JointLoad) and source.load is not None


def _names_pair(source: Source) -> bool:
    displacement, load = source.component, source.load or 0
    if (load < 3) != (displacement < 3):
        return load < 3
    return displacement < load


def _found(
    sources: Sequence[Source],
    machine: Machine,
    observations: Sequence[Observations],
    reference: float | None,
    prefer: Sequence[str],
) -> Confounding:
    systems = run_systems(sources, machine, observations, reference)
    names = {source.name for source in sources}
    order = retaining_order(
        sources, machine, [run.spans for run in systems.runs], [name for name in prefer if name in names]
    )
    return confounding(merged(systems.runs), order, systems.ceilings)


def _alone(found: Confounding) -> tuple[str, ...]:
    return tuple(name for name in found.retained if len(found.stands_for(name)) == 1)

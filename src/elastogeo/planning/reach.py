"""How far tests are from what any tests of their kind could tell of the machine: rank r of at most r_max."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.estimate import RANK_TOLERANCE, Confounding
from elastogeo.identification import Explanation
from elastogeo.planning.ceilings import ceiling
from elastogeo.planning.families import family_ceiling
from elastogeo.planning.rank import rank_of, unit_rows
from elastogeo.prediction import parameter_scales
from elastogeo.sources import Source


@dataclass(frozen=True, slots=True)
class Reach:
    """The rank of the compliances that were asked for, and what bounds it.

    Attributes
    ----------
    columns : int
        Compliances of joints and places that were asked for.
    rank : int
        How many combinations of them the tests determine.
    family : {"bar", "probes", "six"}
        What the tests load and read, all together.
    of_family : int
        The rank of all tests of this family, with the tools of these, anywhere in the travel.
    of_any : int
        The rank of any tests between tool and workpiece, with any tool.
    """

    columns: int
    rank: int
    family: str
    of_family: int
    of_any: int


def reach_of(explained: Explanation) -> Reach | None:
    """How far the explained tests reach; None where no compliance was asked for, or something else loads or reads."""
    campaign, found = explained.campaign, explained.confounding
    if explained.family is None:
        return None
    reciprocal = campaign.question.reciprocal
    bound = ceiling(campaign.machine, reciprocal)
    asked = [label for label in found.labels if label in bound.labels]
    if not asked:
        return None
    family = family_ceiling(campaign.machine, explained.family, explained.tools, reciprocal)
    sources = [bound.sources[bound.labels.index(name)] for name in asked]
    return Reach(len(asked), _rank_of(found, sources), explained.family, family.among(asked), bound.among(asked))


def _rank_of(found: Confounding, sources: list[Source]) -> int:
    """Rank of some columns of the design, which are those of the retained ones times their combinations."""
    if len(sources) == len(found.labels):
        return found.rank
    part = found.combinations[:, [found.labels.index(source.name) for source in sources]] * parameter_scales(sources)
    return rank_of(unit_rows(part), RANK_TOLERANCE)

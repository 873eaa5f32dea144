"""Which model the data support: the one as asked, unless a column is surely missing; then the simplest that lacks none.

Every model that is not refuted is named with it; those that hold another of them are not. A model that is true is refuted in
one of a hundred tests, so what is named together holds it, once something was found at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import stdtr

from elastogeo.identification.model_choice.comparison import Comparison, prepared
from elastogeo.identification.model_choice.evidence import Evidence
from elastogeo.identification.model_choice.families import Family, families, held, mixtures
from elastogeo.identification.model_choice.fits import fit
from elastogeo.identification.model_choice.following import OffLevel, off_level
from elastogeo.identification.model_choice.result import CONSTANT, Candidate, ModelChoice
from elastogeo.identification.systems import Systems
from elastogeo.machine import Machine

MISSING = 0.05
"""Probability of naming a richer model where the one that was asked is true."""

REFUTED = 0.01
"""Probability of not naming a richer model that is true, once one is named."""

BASES = 3
"""How many of the best models are tried together with others if none is sufficient by itself."""


def compare_models(machine: Machine, systems: Systems, retained: Sequence[str], angular: bool = True) -> ModelChoice:
    """Compare the model that was asked with richer ones.

    Parameters
    ----------
    machine : Machine
    systems : Systems
        No reference subtracted.
    retained : sequence of str
        Parameters of the model.
    angular : bool
        Whether the readings count along an angle.
    """
    chosen = prepared(machine, systems, retained, angular)
    first = chosen.evidence()
    tested = tuple(name for label in first.labels for name in chosen.owners[label])
    few = tuple(name for label, names in chosen.owners.items() if label not in first.labels for name in names)
    unseen = (*chosen.unseen, *few)

    def found(
        candidates: Sequence[Candidate], supported: str | None, alike: tuple[str, ...], off: OffLevel | None
    ) -> ModelChoice:
        levels, runs = len(chosen.levels), len(systems.runs)
        return ModelChoice(tuple(candidates), supported, alike, off, tested, unseen, levels, runs)

    asked = fit(chosen, Family(CONSTANT, ()), first.p_value, first.p_value >= MISSING)
    if {chosen.places[label] for label in first.labels} != {chosen.places[label] for label in chosen.owners} or not tested:
        return found([asked], None, (), None)
    off = off_level(chosen.shapes, chosen.model, chosen.levels)
    if asked.sufficient:
        return found([asked], CONSTANT, (CONSTANT,), off)
    chosen = chosen.renewed().searched()
    richer = _richer(chosen, asked, first)
    enough = [candidate for candidate in richer if candidate.sufficient]
    best = enough[0] if enough else min(richer, key=_left_out, default=asked)
    still = off_level(chosen.shapes, [*chosen.model, *best.added], chosen.levels)
    if off is not None and (still is not None or not enough) and _follows_without(chosen, off):
        return found([asked, *richer], CONSTANT, (CONSTANT,), off)
    return found([asked, *richer], best.name, _alike(richer, best), still)


def _follows_without(chosen: Comparison, off: OffLevel) -> bool:
    """Whether nothing is missing from the model once a level is left out."""
    runs = next(runs for force, runs in chosen.levels if force == off.force)
    return chosen.evidence(without=runs).p_value >= MISSING


def _richer(chosen: Comparison, asked: Candidate, first: Evidence) -> list[Candidate]:
    """The models that were tried, the sufficient ones and then the simpler ones first; refuted mixtures are not listed."""
    alone = [family for family in families(chosen, first) if family.promising(first)]
    found = [(family, _tried(chosen, family, asked)) for family in alone]
    if not any(candidate.sufficient for _, candidate in found):
        best = [family for family, _ in sorted(found, key=lambda pair: _left_out(pair[1]))[:BASES]]
        mixed = [_tried(chosen, family, asked) for family in mixtures(best, alone)]
    else:
        mixed = []
    models = [*(candidate for _, candidate in found), *(candidate for candidate in mixed if candidate.p_value >= REFUTED)]
    least = min((candidate for candidate in models if candidate.sufficient), key=_left_out, default=None)
    if least is not None:
        models = [
            replace(candidate, sufficient=candidate.sufficient and not _worse(candidate, least)) for candidate in models
        ]
    return sorted(models, key=_rank)


def _tried(chosen: Comparison, family: Family, asked: Candidate) -> Candidate:
    p_value = chosen.evidence(family.added).p_value
    return fit(chosen, family, p_value, p_value >= MISSING, asked)


def _alike(richer: Sequence[Candidate], best: Candidate) -> tuple[str, ...]:
    """The models that cannot be distinguished from the best: not refuted, and holding none that is as good with less."""
    close = [candidate for candidate in richer if candidate.p_value >= REFUTED and not _worse(candidate, best)]
    kept: list[Candidate] = []
    for candidate in sorted(close, key=_rank):
        if not any(held(other.added) <= held(candidate.added) for other in kept):
            kept.append(candidate)
    return tuple(candidate.name for candidate in kept) or (best.name,)


def _worse(one: Candidate, best: Candidate) -> bool:
    """Whether a model surely predicts left-out levels worse than another: a t-test of the logarithms of their ratios."""
    if not one.level_errors or not best.level_errors:
        return bool(best.level_errors)
    ratio = np.log(np.array(one.level_errors) / np.array(best.level_errors))
    spread = float(ratio.std(ddof=1)) / np.sqrt(len(ratio))
    return spread > 0 and float(stdtr(len(ratio) - 1, -ratio.mean() / spread)) < REFUTED


def _rank(candidate: Candidate) -> tuple[bool, int, float]:
    return not candidate.sufficient, candidate.parameters, _left_out(candidate)


def _left_out(candidate: Candidate) -> float:
    return float("inf") if candidate.left_out_level is None else candidate.left_out_level

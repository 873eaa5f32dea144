"""Which model the data support: the one as asked, unless a column is surely missing; then the simplest that lacks none.

Every model that is not refuted is named with it; those that hold another of them are not. A model that is true is refuted in
one of a hundred tests, so what is named together holds it, once something was found at all. A simpler one that predicts
left-out levels as well is named too: of few runs no more can be asked. One that predicts them far worse than others do is
none that data support, whatever it leaves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import stdtr

from elastogeo.identification.influences import Effect
from elastogeo.identification.model_choice.comparison import Comparison, prepared
from elastogeo.identification.model_choice.evidence import Evidence
from elastogeo.identification.model_choice.families import Family, families, held, mixtures
from elastogeo.identification.model_choice.fits import fit
from elastogeo.identification.model_choice.following import OffLevel
from elastogeo.identification.model_choice.result import CONSTANT, Candidate, ModelChoice
from elastogeo.identification.systems import Systems
from elastogeo.machine import Machine

MISSING = 0.05
"""Probability of naming a richer model where the one that was asked is true."""

REFUTED = 0.01
"""Probability of not naming a richer model that is true, once one is named."""

AS_WELL = 1.05
"""Ratio of left-out errors up to which the simpler model predicts as well."""

FAR_WORSE = 2.0
"""Ratio of left-out errors from which a model is none that data support."""

BASES = 3
"""How many of the best models, and the best of each place, are tried together with others if none suffices by itself."""


def compare_models(
    machine: Machine,
    systems: Systems,
    retained: Sequence[str],
    angular: bool = True,
    effects: Sequence[Effect] = (),
) -> ModelChoice:
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
    effects : sequence of Effect
        Of what is known to be uncertain: a level that is off by no more follows the others.
    """
    chosen = prepared(machine, systems, retained, angular, effects)
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
    off = chosen.off_level()
    if asked.sufficient:
        return found([asked], CONSTANT, (CONSTANT,), off)
    chosen = chosen.renewed().searched()
    richer = _richer(chosen, asked, first)
    enough = [candidate for candidate in richer if candidate.sufficient]
    best = enough[0] if enough else min(richer, key=_left_out, default=asked)
    still = chosen.off_level(best.added)
    if off is not None and (still is not None or not enough) and _follows_without(chosen, off):
        return found([asked, *richer], CONSTANT, (CONSTANT,), off)
    return found([asked, *richer], best.name, _alike(richer, best, asked), still)


def _follows_without(chosen: Comparison, off: OffLevel) -> bool:
    """Whether nothing is missing from the model once a level is left out."""
    runs = next(runs for force, runs in chosen.levels if force == off.force)
    return chosen.evidence(without=runs).p_value >= MISSING


def _richer(chosen: Comparison, asked: Candidate, first: Evidence) -> list[Candidate]:
    """The models that were tried, the sufficient ones and then the simpler ones first; refuted mixtures are not listed."""
    alone = [family for family in families(chosen, first) if family.promising(first)]
    found = [(family, _tried(chosen, family, asked)) for family in alone]
    if not any(candidate.sufficient for _, candidate in found):
        mixed = [_tried(chosen, family, asked) for family in mixtures(_bases(found), alone)]
    else:
        mixed = []
    models = [*(candidate for _, candidate in found), *mixed]
    far = FAR_WORSE * min((_left_out(one) for one in models if one.p_value >= REFUTED), default=float("inf"))
    models = [replace(one, sufficient=one.sufficient and _left_out(one) <= far) for one in models]
    least = min((candidate for candidate in models if candidate.sufficient), key=_left_out, default=None)
    if least is not None:
        models = [
            replace(candidate, sufficient=candidate.sufficient and not _worse(candidate, least)) for candidate in models
        ]
    best = min(models, key=_rank, default=asked)
    by_itself = {candidate.name for _, candidate in found}
    return sorted((one for one in models if one.name in by_itself or _close(one, best, asked)), key=_rank)


def _bases(found: Sequence[tuple[Family, Candidate]]) -> list[Family]:
    """The models that are tried together with others: what is missing may live in two places."""
    ordered = sorted(found, key=lambda pair: _left_out(pair[1]))
    of_place = {place: family for family, candidate in reversed(ordered) for place in candidate.places}
    return list(dict.fromkeys((*(family for family, _ in ordered[:BASES]), *of_place.values())))


def _tried(chosen: Comparison, family: Family, asked: Candidate) -> Candidate:
    p_value = chosen.evidence(family.added).p_value
    return fit(chosen, family, p_value, p_value >= MISSING, asked)


def _close(one: Candidate, best: Candidate, asked: Candidate) -> bool:
    """Whether a model is not refuted and predicts no worse, or predicts as well as the best with less."""
    if one.p_value >= REFUTED:
        return _left_out(one) <= FAR_WORSE * _left_out(best) and not _worse(one, best)
    return one.parameters < best.parameters and _left_out(one) <= AS_WELL * _left_out(best) < _left_out(asked)


def _alike(richer: Sequence[Candidate], best: Candidate, asked: Candidate) -> tuple[str, ...]:
    """The models that cannot be distinguished from the best, holding none that is as good with less."""
    close = [candidate for candidate in richer if _close(candidate, best, asked)]
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

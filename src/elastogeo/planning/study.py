"""What candidates tell, worked out once; the choice among them; what the chosen ones will tell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array
from elastogeo.observe import Campaign, family_of
from elastogeo.planning.choosing.choice import Budget, Progress, chosen, covariance_of, exchanged, extended, one_by_one
from elastogeo.planning.choosing.goals import Goal, Information, MeanVariance, NearlyWorst, Parameters, Worst
from elastogeo.planning.choosing.space import Space, space_of
from elastogeo.planning.expectations import data_uncertainty
from elastogeo.planning.families import family_ceiling
from elastogeo.planning.information import Unknowns, rows_of, unknowns, whitened
from elastogeo.planning.made import at_planned_poses
from elastogeo.planning.noise import ReadingNoise
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import Means
from elastogeo.planning.proposed import out_of_reach
from elastogeo.planning.rank import rank_of, row_space
from elastogeo.planning.result import ToolSupport
from elastogeo.planning.workspaces import Workspace, workspace
from elastogeo.prediction import SUPPORTED, unsupported_share

CHOOSING_POSES, JUDGING_POSES = 48, 300
"""Poses of all tools together to begin choosing with; of each tool, others, to judge what was chosen."""

ROUNDS, WORST_ADDED, NEAR = 4, 30, 1.02
"""How often a plan is held against the judging poses; how many of the worst of them are then chosen by too; the ratio of the
worst of both within which they agree."""

OF_A_KIND = 12
"""Tests of one instrument that are looked at to see what it loads and reads."""

MOST_TESTS = 60
"""Tests after which nothing more is added to support the workspace."""


@dataclass(frozen=True, eq=False)
class Study:
    """What candidates tell of one machine.

    Attributes
    ----------
    means : Means
    asked : Unknowns
        p parameters.
    offered : tuple of Candidate
    rows : tuple of array, shape (q, p)
        What each candidate tells.
    made : tuple of array, shape (q, p)
        What the tests that were made already tell.
    space : Space
        Of the candidates.
    choosing, judging : Workspace
        Poses to choose by, and others to judge by.
    """

    means: Means
    asked: Unknowns
    offered: tuple[Candidate, ...]
    rows: tuple[Array, ...]
    made: tuple[Array, ...]
    space: Space
    choosing: Workspace
    judging: Workspace

    @property
    def minutes(self) -> Array:
        """Of each candidate."""
        return np.array([one.minutes for one in self.offered])

    def told(self, taken: Sequence[int]) -> Array:
        """Rows of chosen candidates and of the tests already made, shape (m, p)."""
        return np.vstack([np.zeros((1, len(self.asked.sources))), *self.made, *(self.rows[k] for k in taken)])

    def supported(self, taken: Sequence[int]) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Whether each functional of the judging workspace is supported, shape (m,)."""
        seen = row_space(self.told(taken))
        scales = np.ones(len(self.asked.sources))
        return np.asarray(unsupported_share(self.judging.functionals, seen, scales) < SUPPORTED)

    @cached_property
    def needed(self) -> tuple[int | None, ...]:
        """How many tests support the whole workspace, then that of each tool: `needed_to_support` from nothing."""
        return needed_to_support(self, [])

    def worst_with_prior(self, taken: Sequence[int]) -> float:
        """Greatest standard uncertainty [mm/N] in the judging workspace with the stated prior."""
        inside, outside = self.space.projected(self.judging.functionals)
        variances = Worst(inside, outside).variances(covariance_of(self.space, taken))
        return float(np.sqrt(variances.max()))


def study_of(
    means: Means, asked: Unknowns, offered: Sequence[Candidate], made: Campaign | None, noise: ReadingNoise, seed: int
) -> Study:
    """What candidates tell, and what it is held against."""
    rows = whitened([one.test for one in offered], asked, noise)
    done = [] if made is None else [at_planned_poses(test, means.readings) for test in made.tests.values()]
    kept = rows_of(done, asked, noise)
    return Study(
        means=means,
        asked=asked,
        offered=tuple(offered),
        rows=tuple(rows),
        made=tuple(kept),
        space=space_of(rows, kept),
        choosing=workspace(means, asked, max(CHOOSING_POSES // len(means.tool_points), 16), seed),
        judging=workspace(means, asked, JUDGING_POSES, seed + 1),
    )


def goals_of(study: Study, goal: str, names: Sequence[str]) -> tuple[Goal, ...]:
    """The goals to improve a plan for, one after the other."""
    if goal == "information":
        return (Information(),)
    if goal == "parameters":
        at = [study.asked.names.index(name) for name in names] or list(range(len(study.asked.names)))
        return (Parameters(*study.space.projected(np.eye(len(study.asked.names))[at])),)
    inside, outside = study.space.projected(study.choosing.functionals)
    return MeanVariance(inside, outside), NearlyWorst(inside, outside), Worst(inside, outside)


def chosen_of(
    study: Study, goal: str, names: Sequence[str], tests: int | None, minutes: float | None, progress: Progress
) -> list[int]:
    """The candidates to take; with no budget, as many as support the workspace.

    Raises
    ------
    UnsupportedError
        If no candidate fits into the minutes, or all together do not support the workspace.
    """
    if tests is None and minutes is None and names:
        tests = needed_for(study, names)
    if tests is None and minutes is None:
        return _supporting(study, goal, names, progress)
    taken = _chosen(study, goal, names, Budget(tests, inf if minutes is None else minutes), progress)
    if not taken:
        raise UnsupportedError(
            f"no test fits into {minutes:g} minutes; the shortest takes {study.minutes.min():.0f}: plan more time"
        )
    return taken


def _supporting(study: Study, goal: str, names: Sequence[str], progress: Progress) -> list[int]:
    """As few candidates as support the workspace when they are chosen for the goal.

    The fewest that support it at all are another choice: those that are surer, the prior counted, may leave some of it out.
    """
    fewest = study.needed[0]
    if fewest is None:
        raise UnsupportedError(
            f"all {len(study.offered)} candidates together do not support the compliance everywhere in the volume for "
            f"the tools asked for; say how many tests, draw more candidates, or let rotary axes move"
        )
    for tests in range(fewest, min(MOST_TESTS, len(study.offered)) + 1):
        taken = _chosen(study, goal, names, Budget(tests, inf), progress)
        if study.supported(taken).all():
            break
    return taken


def _chosen(study: Study, goal: str, names: Sequence[str], budget: Budget, progress: Progress) -> list[int]:
    """The candidates to take within a budget."""
    taken = chosen(study.space, goals_of(study, goal, names), study.minutes, budget, progress=progress)
    if goal == "workspace":
        progress("looking for the worst places")
        taken = _against_the_worst(study, taken, budget)
    return taken


def _against_the_worst(study: Study, taken: list[int], budget: Budget) -> list[int]:
    """A plan improved at the worst of the judging poses too, which it was not chosen by: a worst place is soon missed."""
    inside, outside = study.space.projected(study.judging.functionals)
    chosen_by = study.space.projected(study.choosing.functionals)
    best, least = taken, np.inf
    for _ in range(ROUNDS):
        variances = Worst(inside, outside).variances(covariance_of(study.space, taken))
        if variances.max() < least:
            best, least = taken, float(variances.max())
        if variances.max() <= NEAR**2 * Worst(*chosen_by).variances(covariance_of(study.space, taken)).max():
            break
        worst = np.argsort(-variances)[:WORST_ADDED]
        chosen_by = np.vstack([chosen_by[0], inside[worst]]), np.concatenate([chosen_by[1], outside[worst]])
        for goal in (NearlyWorst(*chosen_by), Worst(*chosen_by)):
            taken = exchanged(study.space, goal, study.minutes, budget, taken)
    return best


def needed_for(study: Study, names: Sequence[str]) -> int | None:
    """How many tests make the named parameters known by themselves; None if the candidates cannot."""
    if out_of_reach(study.asked, names, row_space(study.told(range(len(study.offered))))):
        return None
    (goal,) = goals_of(study, "parameters", names)
    for so_far in one_by_one(study.space, goal, study.minutes, MOST_TESTS):
        if not out_of_reach(study.asked, names, row_space(study.told(so_far))):
            return max(len(so_far), 1)
    return None


def needed_to_support(study: Study, taken: Sequence[int]) -> tuple[int | None, ...]:
    """How many tests, the taken ones first, support the whole workspace, then that of each tool.

    None where all candidates together do not, and where `MOST_TESTS` are too few.
    """
    tool = study.judging.tool
    places = [np.full(len(tool), True), *(tool == k for k in range(len(study.means.tool_points)))]
    everything = study.supported(range(len(study.offered)))
    left = {k for k, here in enumerate(places) if everything[here].all()}
    needed: dict[int, int] = {}
    for count, so_far in enumerate(extended(study.space, taken, study.minutes, MOST_TESTS), start=len(taken)):
        supported = study.supported(so_far)
        done = {k for k in left if count and supported[places[k]].all()}
        needed |= dict.fromkeys(done, count)
        left -= done
        if not left:
            break
    return tuple(needed.get(k) for k in range(len(places)))


def highest_rank(study: Study) -> int:
    """Directions that any tests of the kinds of these candidates tell, with these tools: at least what all of them do."""
    machine = study.means.machine
    found = rank_of(study.told(range(len(study.offered))))
    kinds: dict[type, list[Candidate]] = {}
    for one in study.offered:
        kinds.setdefault(type(one.test.setup), []).append(one)
    some = [one.test for own in kinds.values() for one in own[:OF_A_KIND]]
    family = family_of(machine, [run for test in some for run in test.observations()])
    if family is None or study.made:
        return found
    held = {} if study.means.rotary else dict.fromkeys(study.means.turnable, 0.0)
    reciprocal = len(study.asked.sources) < len(unknowns(machine).sources)
    return max(found, family_ceiling(machine, family, study.means.tool_points, reciprocal, held).rank)


def support_of(study: Study, taken: Sequence[int]) -> tuple[ToolSupport, ...]:
    """What the chosen tests support, tool by tool."""
    supported, rows = study.supported(taken), study.told(taken)
    uncertainty = data_uncertainty(rows, study.judging.functionals)
    inside, outside = study.space.projected(study.judging.functionals)
    with_prior = np.sqrt(Worst(inside, outside).variances(covariance_of(study.space, taken)))
    more = [None if count is None else count - len(taken) for count in needed_to_support(study, taken)]
    found = []
    for k, tool in enumerate(study.means.tool_points):
        here = study.judging.tool == k
        known = np.flatnonzero(here & supported)
        at = int(known[np.argmax(uncertainty[known])]) if len(known) else int(np.argmax(np.where(here, with_prior, -1.0)))
        found.append(
            ToolSupport(
                tool=tool,
                share=float(supported[here].mean()),
                median=float(np.median(uncertainty[known])) if len(known) else None,
                worst=float(uncertainty[at]) if len(known) else None,
                worst_with_prior=float(with_prior[here].max()),
                worst_at=dict(zip(study.means.machine.axes, map(float, study.judging.commands[at]), strict=True)),
                tests_needed=study.needed[1 + k],
                more_needed=more[1 + k],
            )
        )
    return tuple(found)

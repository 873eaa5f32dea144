"""The choice: greedy, then exchange, from several starts; within a number of tests or minutes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from elastogeo.machine import Array
from elastogeo.planning.choosing.goals import Goal, Information
from elastogeo.planning.choosing.space import Numbers, Space

Progress = Callable[[str], None]
"""Told what is going on."""

BETTER = 1e-9
"""Relative gain below which an exchange is none."""

KEPT = 2
"""Of several starts, how many are improved for a second goal."""

LOOSE = 1e-8
"""Information of a prior that hardly tells anything."""

MOST_ROUNDS = 30
"""Rounds of exchange, should they never settle."""


@dataclass(frozen=True, slots=True)
class Budget:
    """How much may be chosen.

    Attributes
    ----------
    tests : int or None
        How many; None for as many as there is time for.
    minutes : float
        Of all together.
    """

    tests: int | None = None
    minutes: float = inf


def chosen(
    space: Space,
    goals: Sequence[Goal],
    minutes: Array,
    budget: Budget,
    starts: int = 4,
    seed: int = 1,
    progress: Progress = lambda _: None,
) -> list[int]:
    """The candidates to take, as their numbers in the order in which they were found best.

    Parameters
    ----------
    space : Space
        Of n candidates.
    goals : sequence of Goal
        Each improves what the one before has found; the last one judges between starts.
    minutes : array, shape (n,)
        That each candidate takes.
    budget : Budget
    starts : int
        Beside the greedy start, that many random ones.
    seed : int
        Of the random starts.
    progress : callable
        Told the name of each goal when the plan has been improved for it.
    """
    random = np.random.default_rng(seed)
    begun = [_greedy(space, goals[0], minutes, budget)]
    begun += [_drawn(random, minutes, budget, len(begun[0])) for _ in range(starts)]
    for k, goal in enumerate(goals):
        begun = [exchanged(space, goal, minutes, budget, one) for one in begun]
        begun.sort(key=lambda one: goals[-1].score(covariance_of(space, one)), reverse=True)
        begun = begun[: max(KEPT - k, 1)] if len(goals) > 1 else begun
        progress(goal.name)
    return _in_order(space, goals[-1], begun[0])


def one_by_one(space: Space, goal: Goal, minutes: Array, most: int) -> Iterator[list[int]]:
    """No candidate, then the best one, then the best beside it, up to `most`."""
    found: list[int] = []
    yield []
    while len(found) < min(most, len(minutes)):
        found = _greedy(space, goal, minutes, Budget(len(found) + 1), found)
        yield list(found)


def extended(space: Space, taken: Sequence[int], minutes: Array, most: int) -> Iterator[list[int]]:
    """The taken candidates, then one more at a time, each the one that adds most directions, up to `most`.

    Directions count, not how well they are known: what nothing tells yet has next to no prior.
    """
    loose = replace(space, prior_information=LOOSE)
    found = list(taken)
    yield list(found)
    while len(found) < min(most, len(minutes)):
        found = _greedy(loose, Information(), minutes, Budget(len(found) + 1), found)
        yield list(found)


def covariance_of(space: Space, taken: Sequence[int]) -> Array:
    """What these candidates leave, with the stated prior, shape (r, r)."""
    rows = np.vstack([np.zeros((1, space.rank)), *(space.rows[k] for k in taken)])
    return _inverse(space.prior + rows.T @ rows)


def scores_of(space: Space, goal: Goal, taken: Sequence[int], free: Numbers) -> Array:
    """The score of each free candidate beside the taken ones, shape (len(free),)."""
    covariance, scores = covariance_of(space, taken), np.full(len(space.rows), -inf)
    wanted = np.zeros(len(space.rows), dtype=bool)
    wanted[free] = True
    for stack in space.stacks:
        here = wanted[stack.numbers]
        if here.any():
            scores[stack.numbers[here]] = goal.scores(covariance, stack.rows[here])
    return np.asarray(scores[free])


def _inverse(information: Array) -> Array:
    root = np.linalg.inv(np.linalg.cholesky(information))
    return np.asarray(root.T @ root)


def _greedy(space: Space, goal: Goal, minutes: Array, budget: Budget, taken: Sequence[int] = ()) -> list[int]:
    """One after the other, each the best beside those before it; within a time, the best per minute."""
    found = list(taken)
    while budget.tests is None or len(found) < budget.tests:
        left = budget.minutes - minutes[found].sum()
        free = np.setdiff1d(np.flatnonzero(minutes <= left), found)
        if not len(free):
            break
        gains = scores_of(space, goal, found, free) - goal.score(covariance_of(space, found))
        if np.isfinite(budget.minutes):
            gains = gains / minutes[free]
        found.append(int(free[np.argmax(gains)]))
    return found


def _drawn(random: np.random.Generator, minutes: Array, budget: Budget, size: int) -> list[int]:
    """Random candidates within the budget, at most so many."""
    found: list[int] = []
    left = budget.minutes
    for k in random.permutation(len(minutes)):
        if len(found) < size and minutes[k] <= left:
            found.append(int(k))
            left -= minutes[k]
    return found


def exchanged(space: Space, goal: Goal, minutes: Array, budget: Budget, taken: Sequence[int]) -> list[int]:
    """Each test in turn replaced by the candidate that does best beside the others, until none does better."""
    found = list(taken)
    if not found:
        return found
    best = goal.score(covariance_of(space, found))
    for _ in range(MOST_ROUNDS):
        before = best
        for place in range(len(found)):
            others = found[:place] + found[place + 1 :]
            left = budget.minutes - minutes[others].sum()
            free = np.setdiff1d(np.flatnonzero(minutes <= left), others)
            scores = scores_of(space, goal, others, free)
            k = int(np.argmax(scores))
            if scores[k] > best + BETTER * abs(best):
                found[place], best = int(free[k]), float(scores[k])
        if best <= before + BETTER * abs(before):
            break
    return found


def _in_order(space: Space, goal: Goal, taken: Sequence[int]) -> list[int]:
    """The same, the one first that does best alone, then the best beside it."""
    left = list(taken)
    found: list[int] = []
    while left:
        scores = scores_of(space, goal, found, np.array(left))
        found.append(left.pop(int(np.argmax(scores))))
    return found

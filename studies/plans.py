"""Plans against random sets of tests, and how many circles support the compliance at the tool: `python -m studies.plans`.

Each goal is held against the best of many random sets by its own measure, with the stated prior for both; every number is
worked out by dense algebra on the candidates' rows, not by the code that chooses.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

import elastogeo as eg
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.planning import Candidate, Means, Plan, ReadingNoise, Unknowns, candidates, unknowns, whitened, workspace
from elastogeo.prediction import functionals, virtual_observations

Array = NDArray[np.float64]

KNOWN = 0.2
"""Standard uncertainty, in scales, at which a parameter counts half as known."""

POSES = 900
"""Poses at which the compliance is judged."""

WORKSPACE_POSES, SEED, FIRST = 300, 2, 240
"""Poses of the workspace goal, six directions each: those that a plan says its worst uncertainty of. How many of them are
looked at first."""

BLOCK = 500
"""Random sets that are judged at once."""


def hermle() -> Machine:
    """The shipped five-axis machine."""
    return eg.read_machine("hermle_c50")


def three_axes() -> Machine:
    """A machine of three linear axes with plausible offsets and travels."""
    joints = (
        Joint("Y", (0.0, 0.0, -250.0), travel=(-300.0, 300.0)),
        Joint("X", (0.0, 0.0, 100.0), travel=(-400.0, 400.0)),
        Joint("Z", (0.0, 150.0, 500.0), travel=(-250.0, 250.0)),
    )
    return Machine("Three axes", parse_topology("wYXFZt"), joints, tool=(0.0, -150.0, -160.0))


@dataclass(frozen=True)
class Judge:
    """Candidates of a machine as rows, and what they are judged by; all in the row space of all candidates.

    Attributes
    ----------
    means : Means
    offered : tuple of Candidate
    rows : array, shape (n, q, r)
        Of each candidate, all that it tells, in scaled parameters; short ones filled with zeros.
    poses : array, shape (m, r)
        Compliance along X, Y or Z at random poses of the travel, which no plan has seen.
    missed : array, shape (m,)
        Variance of each that no candidate takes off; so of the parameters, `unseen`, shape (p,).
    workspace : array, shape (w, r)
        What the workspace goal is about: the poses by which a plan is judged.
    outside : array, shape (w,)
        Variance of each that no candidate takes off.
    basis : array, shape (p, r)
    """

    means: Means
    offered: tuple[Candidate, ...]
    rows: Array
    poses: Array
    missed: Array
    unseen: Array
    workspace: Array
    outside: Array
    basis: Array

    def measures(self, sets: Sequence[Sequence[int]]) -> dict[str, Array]:
        """Each goal's own measure of sets of candidates, with the stated prior, greater for a better one.

        The log determinant of the information; the sum of `t^2 / (t^2 + u^2)` over the parameters; less the greatest
        standard uncertainty in the workspace [nm/N]; of a set that is no better than one before it, less a part of it.
        """
        found = []
        best = np.inf
        for first in range(0, len(sets), BLOCK):
            taken = np.array(sets[first : first + BLOCK])
            rows = self.rows[taken].reshape(len(taken), -1, self.rows.shape[2])
            precision = np.eye(rows.shape[2]) + rows.transpose(0, 2, 1) @ rows
            S = np.linalg.inv(precision)
            worst = self._worst(S, slice(None, FIRST))  # those of a part of the poses are not above those of all
            for k in np.flatnonzero(worst < best):
                worst[k] = self._worst(S[k : k + 1], slice(None))[0]
                best = min(best, worst[k])
            alone = np.sum((self.basis @ S) * self.basis, axis=2) + self.unseen
            known = np.sum(KNOWN**2 / (KNOWN**2 + alone), axis=1)
            found.append((np.linalg.slogdet(precision)[1], known, -np.sqrt(worst) * 1e6))
        columns = (np.concatenate(part) for part in zip(*found, strict=True))
        return dict(zip(("information", "parameters", "workspace"), columns, strict=True))

    def _worst(self, S: Array, part: slice) -> Array:
        """Greatest variance of part of the workspace of each covariance, shape (n,)."""
        inside, outside = self.workspace[part], self.outside[part]
        return np.asarray(np.max(np.sum((inside @ S) * inside, axis=2) + outside, axis=1))

    def number(self, plan: Plan) -> list[int]:
        """The candidates of a plan, as their numbers."""
        at = {one.name: k for k, one in enumerate(self.offered)}
        return [at[one.candidate.name] for one in plan.tests]

    def supported(self, taken: Sequence[int]) -> Array:
        """Whether each compliance is supported by a set, shape (m,)."""
        _, values, turns = np.linalg.svd(self.rows[list(taken)].reshape(-1, self.rows.shape[2]))
        seen = turns[: int(np.sum(values > 1e-9 * values[0]))]
        left = self.poses - self.poses @ seen.T @ seen
        lost = np.sqrt(np.sum(left**2, axis=1) + self.missed)
        return np.asarray(lost < 1e-6 * np.sqrt(np.sum(self.poses**2, axis=1) + self.missed))

    def data_uncertainty(self, taken: Sequence[int]) -> Array:
        """Standard uncertainty of each compliance from the readings alone, shape (m,) [nm/N]; right for supported ones."""
        rows = self.rows[list(taken)].reshape(-1, self.rows.shape[2])
        return np.asarray(np.linalg.norm(self.poses @ np.linalg.pinv(rows, rcond=1e-9), axis=1) * 1e6)


def judge(means: Means, count: int, poses: int = POSES, seed: int = 7) -> Judge:
    """Candidates, and random poses that no plan has seen."""
    asked = unknowns(means.machine)
    offered = candidates(means, count=count)
    told = whitened([one.test for one in offered], asked, ReadingNoise())
    _, values, turns = np.linalg.svd(np.vstack(told), full_matrices=False)
    basis = turns[values > 1e-9 * values[0]].T
    rows = np.zeros((len(offered), max(map(len, told)), basis.shape[1]))
    for k, own in enumerate(told):
        rows[k, : len(own)] = own @ basis
    functional = compliances(means, asked, poses, seed)
    goal = workspace(means, asked, WORKSPACE_POSES, SEED).functionals
    inside, missed, own, outside = *_split(functional, basis), *_split(goal, basis)
    return Judge(means, offered, rows, inside, missed, 1 - np.sum(basis**2, axis=1), own, outside, basis)


def _split(functional: Array, basis: Array) -> tuple[Array, Array]:
    """What of functionals lies in a space, and the variance of the rest."""
    inside = functional @ basis
    return inside, np.sum((functional - inside @ basis.T) ** 2, axis=1)


def compliances(means: Means, asked: Unknowns, poses: int, seed: int) -> Array:
    """C_ii along a random axis at random poses of each tool, in scaled parameters, shape (m, p)."""
    random = np.random.default_rng(seed)
    parts = []
    for tool in means.tool_points:
        commands = np.zeros((poses, len(means.machine.axes)))
        for joint, column in zip(means.machine.joints, commands.T, strict=True):
            ends = np.clip(joint.travel, -np.pi, np.pi) if joint.is_rotary else joint.travel
            column[:] = random.uniform(*ends, poses) if joint.compliant else 0.0
        along = np.zeros((poses, 6))
        along[np.arange(poses), random.integers(0, 3, poses)] = 1.0
        seen = virtual_observations(means.machine, commands, along, along, np.array(tool))
        parts.append(functionals(asked.sources, means.machine, seen) * asked.scales)
    return np.concatenate(parts)


def best_of_random(held: Judge, k: int, sets: int, seed: int = 3) -> dict[str, float]:
    """The best of so many random sets of k candidates by each goal's own measure."""
    random = np.random.default_rng(seed)
    drawn = [random.choice(len(held.offered), k, replace=False) for _ in range(sets)]
    return {goal: float(values.max()) for goal, values in held.measures(drawn).items()}


def exhaustive_information(held: Judge, k: int) -> float:
    """The greatest log determinant of all sets of k candidates."""
    every = np.array(list(combinations(range(len(held.offered)), k)))
    best = -np.inf
    for first in range(0, len(every), BLOCK):
        taken = every[first : first + BLOCK]
        rows = held.rows[taken].reshape(len(taken), -1, held.rows.shape[2])
        small = np.eye(rows.shape[1]) + rows @ rows.transpose(0, 2, 1)
        best = max(best, float(np.linalg.slogdet(small)[1].max()))
    return best


def main(arguments: list[str] | None = None) -> int:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sets", type=int, default=10_000, help="random sets (10000)")
    parser.add_argument("--candidates", type=int, default=500, help="tests to choose from (500)")
    parser.add_argument("--tests", type=int, nargs="*", default=[3, 5, 8], help="of a plan (3 5 8)")
    given = parser.parse_args(arguments)
    five = judge(Means(hermle()), given.candidates)
    print(f"{'k':>3}  {'goal':<12}{'best of random':>16}{'plan':>10}")
    for k in given.tests:
        random = best_of_random(five, k, given.sets)
        for goal, best in random.items():
            plan = eg.plan(five.means, tests=k, goal=goal, chosen_from=five.offered)
            own = five.measures([five.number(plan)])[goal][0]
            print(
                f"{k:>3}  {goal:<12}{abs(best):>16.3f}{abs(own):>10.3f}{'' if own > best else '   NOT BETTER'}", flush=True
            )
    few = judge(Means(hermle()), 80)
    plan = eg.plan(few.means, tests=3, goal="information", chosen_from=few.offered)
    exact = exhaustive_information(few, 3)
    print(f"D, 3 of 80: exhaustive {exact:.9f}, plan {few.measures([few.number(plan)])['information'][0]:.9f}")
    lengths = ((0.0, 0.0, -100.0), (0.0, 0.0, -160.0), (0.0, 0.0, -260.0))
    for name, means, k in (
        ("five axes, one tool", five.means, 12),
        ("five axes, three tool lengths", Means(hermle(), tools=lengths), 12),
        ("three axes", Means(three_axes()), 8),
    ):
        held = five if means is five.means else judge(means, given.candidates)
        plan = eg.plan(means, tests=k, chosen_from=held.offered)
        taken = held.number(plan)
        supported, u = held.supported(taken), held.data_uncertainty(taken)
        worst = u[supported].max() if supported.any() else np.nan
        print(
            f"{name}: {k} circles, rank {plan.rank} of {plan.highest_rank}, support {100 * supported.mean():.1f} % of "
            f"{len(u)} C_ii, u median {np.median(u):.2f}, worst {worst:.2f} nm/N; needed {plan.tools[0].tests_needed}"
        )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

"""How often the intervals that a default question prints as 95 % hold the truth: `python -m studies.coverage`.

The layouts are those of the templates and of the thesis, the question is the one that is asked where nobody asks, the
systematic influences are those that a template states, and each trial draws them anew: a force that is off by one relative
amount, a bar that is longer than its calibration says. Readings come from the independent test maker. Trials of one layout
differ in noise and influences alone, so that systems and confounding are made once; a test says that the intervals are those
of `identify`.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from zlib import crc32

import numpy as np

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate import solve_by_run
from elastogeo.identification import confounding_of, effects_of, systems_of, uncertainty_budget
from elastogeo.observe import KnownInfluence, MachineTest, Question
from studies.bar_tests import FORCE_SCALE, FORCE_SCATTER, LAYOUTS, SET_ANEW, Layout, make_test
from studies.noise import NOISES
from studies.rates import wilson
from studies.roller_coverage import ROLLER, roller_covered
from studies.static_coverage import STATIC, static_covered
from studies.truth import BALL_BAR, TABLE_5_5, Truth, with_values

BAR = (5e-4, 9e-4)
"""Standard uncertainties of the bar [mm]: its calibration and its temperature."""

CASES: dict[str, Layout] = {
    "loaded bar, new": LAYOUTS["8 runs"],
    "7 runs": LAYOUTS["7 runs"],
    "15 runs": LAYOUTS["15 runs"],
    "three pairs": LAYOUTS["three pairs"],
}
"""The layouts that print intervals."""

TOO_FEW = ("one run", "two runs")
"""Those that print none."""

POOLED = (0.93, 0.97)
EACH = (0.90, 0.99)
PAGE = Path(__file__).parent.parent / "docs" / "coverage.md"


@dataclass(frozen=True)
class Coverage:
    """What was counted of one layout under one noise.

    Attributes
    ----------
    layout, noise : str
    trials : int
    held : dict of str to int
        Of each parameter, how many intervals held the truth.
    freedom : tuple of 2 float
        Least and greatest degrees of freedom of the scatter.
    """

    layout: str
    noise: str
    trials: int
    held: dict[str, int]
    freedom: tuple[float, float]

    @property
    def pooled(self) -> float:
        """Share over all parameters."""
        return sum(self.held.values()) / self.trials / len(self.held)

    @property
    def holds(self) -> bool:
        """Whether the 95 % intervals of the pooled rate and of each reach where they are to be.

        The parameters of one trial have their readings in common: together they count as one trial.
        """
        pooled = wilson(round(self.pooled * self.trials), self.trials)
        each = (wilson(count, self.trials) for count in self.held.values())
        return _reaches(pooled, POOLED) and all(_reaches(interval, EACH) for interval in each)


def _reaches(interval: tuple[float, float], wanted: tuple[float, float]) -> bool:
    return interval[0] <= wanted[1] and interval[1] >= wanted[0]


def influences(loaded: bool) -> tuple[KnownInfluence, ...]:
    """Those that a template states."""
    force = (KnownInfluence("force-scale", "calibration of the force", relative=FORCE_SCALE),)
    return (*(force if loaded else ()), *(KnownInfluence("bar-length", f"bar {size:g}", length=size) for size in BAR))


def truth_of(layout: Layout, random: np.random.Generator, scatter: float = 0.0) -> Truth:
    """The machine, with a force and a bar that are off as much as the influences say, and forces that scatter by run."""
    off = float(random.normal(0.0, np.hypot(*BAR)))
    if not any(layout.forces):
        return Truth(with_values(BALL_BAR, E_R0=off))
    scale = float(random.normal(0.0, FORCE_SCALE))
    anew = tuple(map(float, scatter * random.standard_normal(len(layout.forces)))) if scatter else ()
    return Truth(with_values(TABLE_5_5, E_R0=off), force_scale=scale, force_scatter=anew)


def drawn(name: str, noise: str, trial: int) -> tuple[MachineTest, Truth]:
    """One trial: a test, and what is true."""
    layout, seed = CASES[name], (crc32(f"{name}, {noise}".encode()), trial)
    truth = truth_of(layout, np.random.default_rng((*seed, 1)), FORCE_SCATTER if noise == SET_ANEW else 0.0)
    test = make_test(layout, truth, "white" if noise == SET_ANEW else noise, seed, question=Question())
    return replace(test, influences=influences(any(layout.forces))), truth


def covered(name: str, noise: str, trials: range) -> Coverage:
    """Count, trial by trial, which intervals hold the truth."""
    if name in STATIC:
        return Coverage(name, noise, len(trials), *static_covered(name, noise, trials))
    if name == ROLLER:
        return Coverage(name, noise, len(trials), *roller_covered(noise, trials))
    test, _ = drawn(name, noise, 0)
    systems = systems_of(test)
    found = confounding_of(test, systems)
    held, freedom = np.zeros(found.rank, dtype=int), np.zeros(1)
    for trial in trials:
        one, truth = drawn(name, noise, trial)
        pairs = zip(systems.runs, one.observations(), strict=True)
        seen = replace(systems, runs=tuple(system.read_again(observed) for system, observed in pairs))
        solution = solve_by_run([run.factor for run in seen.runs], found.retained)
        budget = uncertainty_budget(seen, solution, effects_of(one, seen))
        true = dict(truth.parameters)
        values = [sum(c * true.get(other, 0.0) for other, c in found.stands_for(label).items()) for label in found.retained]
        held += (budget.interval[:, 0] <= values) & (values <= budget.interval[:, 1])
        freedom = solution.degrees_of_freedom
    counts = dict(zip(found.retained, map(int, held), strict=True))
    return Coverage(name, noise, len(trials), counts, (float(freedom.min()), float(freedom.max())))


def without_interval(name: str, noise: str = "white", trial: int = 0) -> bool:
    """Whether a layout of too few runs has no uncertainty by run, however it is asked."""
    test = make_test(name, None, noise, (7, trial), question=Question())
    systems = systems_of(test)
    try:
        solve_by_run([run.factor for run in systems.runs], confounding_of(test, systems).retained)
    except DegreesOfFreedomError:
        return True
    return False


def noises_of(name: str) -> tuple[str, ...]:
    """What a layout is counted under."""
    loaded = name in CASES and any(CASES[name].forces)
    return (*NOISES, SET_ANEW) if loaded else tuple(NOISES)


def row_of(one: Coverage) -> str:
    """A row of the table."""
    rates = {label: count / one.trials for label, count in one.held.items()}
    least, most = min(rates, key=rates.__getitem__), max(rates, key=rates.__getitem__)
    return (
        f"| {one.layout} | {one.noise} | {one.trials} | {one.pooled:.1%} | {least} {rates[least]:.1%} | "
        f"{most} {rates[most]:.1%} | {one.freedom[0]:.1f} to {one.freedom[1]:.1f} | {'yes' if one.holds else '**no**'} |"
    )


def rows_of(page: str) -> dict[tuple[str, str], str]:
    """The rows of a page that was made before, by layout and noise."""
    rows = [line for line in page.splitlines() if line.startswith("| ") and not line.startswith("| layout")]
    return {tuple(part.strip() for part in row.split("|")[1:3]): row for row in rows}  # type: ignore[misc]


def page_of(rows: Mapping[tuple[str, str], str]) -> str:
    """The table for the documentation, of all cells that were ever counted."""
    lines = [
        "# Coverage of the intervals",
        "",
        "Made by `python -m studies.coverage` with a test maker of its own: how often the intervals that the default",
        "question of a test gives as 95 % hold the truth. Force and bar are drawn in each trial from what the template",
        "states of them, of a ball-roller test the drives, their losses and the set-up. The noises are those of",
        "[verdicts](verdicts.md), by sensor for static tests, of the radius for the ball-roller, whose force and currents",
        "scatter beside it; under *force set anew* each run's force is off by 0.2 %. What an instrument shows by itself",
        "(`line`, `C_XY`, `twist`, `stiffness`) counts with the parameters.",
        "",
        f"Wanted: {POOLED[0]:.0%} to {POOLED[1]:.0%} over all parameters, {EACH[0]:.0%} to {EACH[1]:.0%} of each.",
        "A row holds if the 95 % intervals of its rates (Wilson) reach that.",
        "",
        "| layout | noise | trials | all parameters | least | greatest | degrees of freedom | held |",
        "|---|---|---:|---:|---|---|---|---|",
    ]
    cells = [(name, noise) for name in (*CASES, *STATIC, ROLLER) for noise in noises_of(name)]
    lines += [rows[cell] for cell in cells if cell in rows]
    few = ", ".join(TOO_FEW)
    return "\n".join([*lines, "", f"With {few} no interval is given; the verdict says how many it takes.", ""])


def main(arguments: Sequence[str] | None = None) -> int:
    """Run all cells and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=300)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--only", default="", help="a layout; the rows of the others stay")
    parser.add_argument("--noise", default="", help="one of the noises alone")
    asked = parser.parse_args(arguments)
    names = [name for name in (*CASES, *STATIC, ROLLER) if asked.only in ("", name)]
    cells = [(name, noise) for name in names for noise in noises_of(name) if asked.noise in ("", noise)]
    rows, held = rows_of(PAGE.read_text(encoding="utf-8")), True
    with ProcessPoolExecutor(asked.workers) as pool:
        for one in pool.map(covered, *zip(*cells, strict=True), [range(asked.trials)] * len(cells)):
            print(json.dumps({**vars(one), "pooled": round(one.pooled, 4), "holds": one.holds}), flush=True)
            rows[one.layout, one.noise], held = row_of(one), held and one.holds
            PAGE.write_text(page_of(rows), encoding="utf-8")
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())

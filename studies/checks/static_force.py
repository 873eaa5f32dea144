"""A force ramp with one sensor: sign, energy, straightness, cycles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.identification import evaluate_static
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import MachineTest, Question, Run, StaticForce
from studies.noise import autocorrelated
from studies.rates import Cell, Named, Study

SOFT, GREATEST = 5e-5, 400.0
NOISES = ("white", "autocorrelated", "of the run", "quantised")


@dataclass(frozen=True)
class Ramp:
    """Runs of a ramp up and down: a straight compliance, a loop, a curvature.

    Attributes
    ----------
    noise : str
        White of 0.05 um; with AR(1) 0.9 of 0.1 um; with an offset of 0.5 um a run; rounded to 0.1 um.
    soft : float [mm/N]
    loop : float [mm]
        How far the falling branch lies above the rising one at half load.
    bend : float [mm]
        Departure from the line at half load.
    cycles, runs : int
    """

    noise: str
    soft: float = SOFT
    loop: float = 0.0
    bend: float = 0.0
    cycles: int = 3
    runs: int = 3

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `evaluate_static`."""
        random = np.random.default_rng(seed)
        up = np.linspace(0, GREATEST, 21)
        force = np.concatenate([up[:1], *(np.concatenate([up[1:], up[-2::-1]]) for _ in range(self.cycles))])
        falling = np.concatenate([[0.0], *(np.repeat([0.0, 1.0], 20) for _ in range(self.cycles))])
        arch = 4 * force * (GREATEST - force) / GREATEST**2
        true = self.soft * force + self.loop * arch * falling + self.bend * arch
        runs = tuple(
            Run(f"run {k}", {"force": force, "displacement": true + self.scatter(random, len(true))})
            for k in range(self.runs)
        )
        setup = StaticForce(direction=(1.0, 0.0, 0.0))
        return evaluate_static(
            MachineTest("study", Machine("m", parse_topology("wFYXt")), setup, runs, Question(("C_XXX", "E_R0")))
        )

    def scatter(self, random: np.random.Generator, m: int) -> np.ndarray:
        added = 5e-5 * random.standard_normal(m)
        if self.noise == "autocorrelated":
            added = added + 1e-4 * autocorrelated(random, 1, m, 0.9)[0]
        if self.noise == "of the run":
            added = added + 5e-4 * random.standard_normal()
        return np.round(added / 1e-4) * 1e-4 if self.noise == "quantised" else added


def ramps(
    check: str,
    truth: str,
    noises: tuple[str, ...] = NOISES,
    short: int = 0,
    most: float = 1.0,
    least: float = 0.0,
    **of: float,
):
    layout = f"{of.get('runs', 3)} runs, {of.get('cycles', 3)} cycles"
    for noise in noises:
        few = short if noise == "white" else 0
        yield Cell(f"{check}: {truth}", layout, noise, Ramp(noise, **of), Named(check), most=most, least=least, short=few)


def every() -> Iterator[Cell]:
    sign, energy, line, cycle, run = (
        "displacement with the force",
        "energy is lost, not gained",
        "straight line enough",
        "uncertainty by cycle",
        "uncertainty of the instrument's results by run",
    )
    yield from ramps(sign, "nothing wrong", most=0.01, short=6)
    yield from ramps(sign, "the sensor's sign is turned", least=1.0, short=6, soft=-SOFT)
    yield from ramps(energy, "no loop", most=0.01)
    yield from ramps(energy, "a loop of 1 um, run the wrong way round", least=0.95, short=6, loop=-1e-3)
    yield from ramps(line, "nothing wrong", ("white", "quantised"), most=0.01)
    yield from ramps(line, "readings that are not independent", ("autocorrelated",), least=0.95)
    yield from ramps(line, "zeros differ by 0.5 um from run to run", ("of the run",), least=0.95)
    yield from ramps(line, "a loop of 1 um", least=0.95, short=6, loop=1e-3)
    yield from ramps(line, "bent by 0.5 um", least=0.95, bend=5e-4)
    yield from ramps(cycle, "three cycles", most=0.0)
    yield from ramps(cycle, "one cycle", least=1.0, short=3, cycles=1)
    yield from ramps(run, "three runs", most=0.0)
    yield from ramps(run, "two runs", least=1.0, short=3, runs=2)


STUDY = Study(
    "static force",
    "Ramps to 400 N on 50 nm/N. Noises of its own: white of 0.05 um, which is in all; AR(1) with 0.9, 0.1 um; an offset of "
    "0.5 um a run; steps of 0.1 um. The sign and the energy are decisive, nominally 1 % over all runs. The line takes its "
    "readings as independent, and the alarm says so where they are not.",
    tuple(every()),
    order=2,
)

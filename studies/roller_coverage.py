"""How often the intervals of a ball-roller test hold the truth: those of the joints, and those of the stiffness map.

The layout is that of the template; drives, losses and set-up are drawn in each trial from what the template states of them.
"""

from __future__ import annotations

from dataclasses import replace
from zlib import crc32

import numpy as np

from elastogeo.drive import SetupCompliance
from elastogeo.estimate import solve_by_run
from elastogeo.identification import confounding_of, effects_of, systems_of, uncertainty_budget
from elastogeo.identification.question import with_stated
from elastogeo.identification.rollers.curves import curves_of
from elastogeo.identification.rollers.kinds import fitted
from elastogeo.observe import MachineTest, Question, Run
from studies.ball_roller import EFFICIENCY, RollerNoise, make_roller_test
from studies.noise import NOISES, Noise
from studies.roller_samples import SETUP, SPRING

ROLLER = "ball-roller, new"
ENGAGEMENTS = np.array([0.04, 0.12, 0.2])
PER_CURRENT, SET_UP = 0.02, 2e-6
"""Standard uncertainties: relative, of the force per current; of the set-up's compliance [mm/N]."""
ASSUMED = 2.0 - 1.0 / EFFICIENCY
"""Share of the power that arrives at a motor that is driven back, where the test does not state it."""


def drawn(noise: str, trial: int) -> MachineTest:
    """One trial: a spring of `SPRING` in every direction."""
    seed = (crc32(f"{ROLLER}, {noise}".encode()), trial)
    random = np.random.default_rng(seed)
    set_up = SETUP + SET_UP * random.standard_normal()
    forces = ENGAGEMENTS / (SPRING + set_up)
    stated = SetupCompliance(constant=SETUP, standard_uncertainty=SET_UP)
    blank = make_roller_test(ENGAGEMENTS, lambda _: np.zeros_like, stated, relative_uncertainty=PER_CURRENT)
    losses = blank.setup.drives[0].back_uncertainty * ASSUMED * random.standard_normal()  # type: ignore[attr-defined]
    made = make_roller_test(
        ENGAGEMENTS,
        lambda n: lambda angle: np.full(len(angle), forces[n]),
        stated,
        back=ASSUMED + losses,
        noise=RollerNoise(encoder=0.0),
        seed=int(random.integers(2**31)),
        relative_uncertainty=PER_CURRENT,
    )
    gain = {axis: 1.0 + PER_CURRENT * random.standard_normal() for axis in "xy"}
    runs = tuple(_read(run, gain, NOISES[noise], random) for run in made.runs)
    return replace(made, runs=runs, question=Question())


def _read(run: Run, gain: dict[str, float], noise: Noise, random: np.random.Generator) -> Run:
    """With noise of the radius, and currents of motors whose constant is off."""
    columns = dict(run.columns)
    angle = np.arctan2(columns["position_y"], columns["position_x"])
    off = noise.on(np.zeros((1, len(angle))), angle[np.newaxis], random)[0]
    for axis, along in (("x", np.cos(angle)), ("y", np.sin(angle))):
        columns[f"position_{axis}"] = columns[f"position_{axis}"] + off * along
        columns[f"current_{axis}"] = columns[f"current_{axis}"] / gain[axis]
    return replace(run, columns=columns)


def roller_covered(noise: str, trials: range) -> tuple[dict[str, int], tuple[float, float]]:
    """How many intervals held the truth, by name, and the least and greatest degrees of freedom of the joints' scatter."""
    held: dict[str, int] = {}
    freedom = np.ones(1)
    for trial in trials:
        test = drawn(noise, trial)
        observed = test.observations()
        systems = systems_of(test, observed)
        found = confounding_of(test, systems)
        solution = solve_by_run([run.factor for run in systems.runs], found.retained)
        budget, freedom = uncertainty_budget(systems, solution, effects_of(test, systems)), solution.degrees_of_freedom
        for label, (low, high) in zip(found.retained, budget.interval, strict=True):
            true = SPRING * (found.stands_for(label).get("C_XXX", 0.0) + found.stands_for(label).get("C_YYY", 0.0))
            held[label] = held.get(label, 0) + bool(low <= true <= high)
        own = fitted(curves_of(with_stated(test, observed)))
        for low, high, angle in (
            (*interval, angle)
            for each in own.modelled[-1:]
            for interval, angle in zip(each.interval, each.angle, strict=True)
        ):
            name = f"stiffness {np.rad2deg(angle):.0f}°"
            held[name] = held.get(name, 0) + bool(low <= SPRING <= high)
    return held, (float(freedom.min()), float(freedom.max()))

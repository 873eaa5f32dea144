"""Displacement probes around the workpiece: reciprocity, and no force that gains energy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.identification import evaluate_static
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import DisplacementProbes, MachineTest, Question, Run
from studies.noise import autocorrelated
from studies.rates import Cell, Named, Study

SOUND = ((5e-5, 3e-6, 1e-6), (3e-6, 4e-5, -2e-6), (1e-6, -2e-6, 2e-5))
UNSYMMETRIC = ((5e-5, 13e-6, 1e-6), (-7e-6, 4e-5, -2e-6), (1e-6, -2e-6, 2e-5))
TURNED = ((5e-5, 3e-6, 1e-6), (3e-6, 4e-5, -2e-6), (-1e-6, 2e-6, -2e-5))
"""Cartesian compliance [mm/N]: sound; with a probe that is read as another; with the third probe's sign turned."""
BARS = tuple(np.array(v) / np.linalg.norm(v) for v in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (1, -1, 1), (-1, 1, 1)))


@dataclass(frozen=True)
class Probes:
    """Three probes along x, y, z; a force of 400 N by components, in six directions, twice.

    Attributes
    ----------
    noise : str
        White of 0.1 um; with AR(1) 0.9 of 0.2 um; with an offset of 0.3 um of each probe and run; rounded to 0.2 um.
    compliance : 3 x 3 [mm/N]
    """

    noise: str
    compliance: tuple[tuple[float, float, float], ...] = SOUND

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `evaluate_static`."""
        random = np.random.default_rng(seed)
        ramp = np.linspace(20, 400, 20)
        runs = []
        for k, bar in enumerate(BARS * 2):
            force = np.outer(ramp, bar)
            seen = force @ np.array(self.compliance).T + 1e-4 * random.standard_normal((len(ramp), 3))
            if self.noise == "autocorrelated":
                seen = seen + 2e-4 * autocorrelated(random, 3, len(ramp), 0.9).T
            if self.noise == "of the run":
                seen = seen + 3e-4 * random.standard_normal((1, 3))
            if self.noise == "quantised":
                seen = np.round(seen / 2e-4) * 2e-4
            columns = {"angle": np.zeros(len(ramp)), **{f"force_{letter}": force[:, j] for j, letter in enumerate("xyz")}}
            columns |= {f"displacement_{j + 1}": seen[:, j] for j in range(3)}
            runs.append(Run(f"run {k + 1}", columns))
        setup = DisplacementProbes(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
        asked = Question(("C_XXX", "C_YYY"))
        return evaluate_static(MachineTest("study", Machine("m", parse_topology("wFYXt")), setup, tuple(runs), asked))


def probed(check: str, truth: str, short: int = 0, compliance: tuple = SOUND, **wanted: float) -> Iterator[Cell]:
    for noise in ("white", "autocorrelated", "of the run", "quantised"):
        few = short if noise == "of the run" else 0
        yield Cell(f"{check}: {truth}", "12 runs", noise, Probes(noise, compliance), Named(check), short=few, **wanted)


STUDY = Study(
    "displacement probes",
    "Three probes, six directions of a force of 400 N, twice. Noises of its own: white of 0.1 um, which is in all; "
    "AR(1) with 0.9, 0.2 um; "
    "an offset of each probe and run of 0.3 um; steps of 0.2 um.",
    (
        *probed("reciprocity", "nothing wrong", short=8, most=0.05),
        *probed("reciprocity", "C_XY and C_YX differ by 20 nm/N", short=4, compliance=UNSYMMETRIC, least=0.95),
        *probed("no energy gained", "nothing wrong", short=8, most=0.05),
        *probed("no energy gained", "the sign of a probe is turned", short=4, compliance=TURNED, least=0.95),
    ),
    order=2,
)

"""A frame of displacement sensors at the tool: does one of them stand out?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.identification import evaluate_static
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import MachineTest, Question, Run, Sensor, SensorFrame
from studies.rates import Cell, Named, Study

PLACES = ((60, -40, 30), (60, 40, 30), (60, 0, -50), (-40, 60, 20), (40, 60, 30), (0, 0, 90), (50, 0, 90), (5, 40, 90))
WAYS = ((1, 0, 0),) * 3 + ((0, 1, 0),) * 2 + ((0, 0, 1),) * 3
TWIST = np.array([5e-5, 1e-6, -2e-6, 3e-9, 2e-8, -1e-8])
"""Per newton of a force along x: translation [mm] and rotation [rad] of the frame."""


@dataclass(frozen=True)
class Frame:
    """Eight sensors, dwells of five readings at 0, 300 and 600 N, two runs.

    Attributes
    ----------
    noise : str
        White of 0.05 um; with an offset of each sensor and run of 0.1 um; rounded to 0.1 um.
    slip : float [mm]
        What the second sensor is off by in the second run, under load.
    """

    noise: str
    slip: float = 0.0

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `evaluate_static`."""
        random = np.random.default_rng(seed)
        force = np.repeat([0.0, 300.0, 600.0], 5)
        runs = []
        for name in ("a", "b"):
            columns = {"force": force}
            for k, (place, way) in enumerate(zip(PLACES, WAYS, strict=True), start=1):
                moved = TWIST[:3] + np.cross(TWIST[3:], place)
                reading = force * float(moved @ np.array(way)) + 5e-5 * random.standard_normal(len(force))
                if k == 2 and name == "b":
                    reading = reading + self.slip * (force > 0)
                if self.noise == "of the run":
                    reading = reading + 1e-4 * random.standard_normal() * (force > 0)
                if self.noise == "quantised":
                    reading = np.round(reading / 1e-4) * 1e-4
                columns[f"displacement_{k}"] = reading
            runs.append(Run(name, columns))
        frame = SensorFrame(tuple(Sensor(p, w) for p, w in zip(PLACES, WAYS, strict=True)), direction=(1.0, 0.0, 0.0))
        asked = Question(("C_XXX", "C_BXX", "C_CXX"))
        return evaluate_static(MachineTest("study", Machine("m", parse_topology("wFYXt")), frame, tuple(runs), asked))


def frames(truth: str, noises: tuple[str, ...], short: int = 0, slip: float = 0.0, **wanted: float) -> Iterator[Cell]:
    for noise in noises:
        few = short if noise == "white" else 0
        yield Cell(truth, "8 sensors, 2 runs", noise, Frame(noise, slip), Named("sensors agree"), short=few, **wanted)


STUDY = Study(
    "sensors agree",
    "Eight sensors see six components, so two directions check them. Noises of its own: white of 0.05 um, which is in "
    "all; an offset of each "
    "sensor under load of 0.1 um, drawn per run, which is a fault of the sensors too and is shown as it comes; steps "
    "of 0.1 um.",
    (
        *frames("nothing wrong", ("white", "quantised"), short=10, most=0.01),
        *frames("nothing wrong", ("of the run",)),
        *frames("one sensor slips by 3 um in one run", ("white", "quantised", "of the run"), short=5, slip=3e-3, least=0.95),
    ),
    order=2,
)

"""What the studies of the ball-roller test draw: a map without the joints' own estimate, which no check of it looks at."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from elastogeo.drive import SetupCompliance
from elastogeo.identification.rollers import map_stiffness
from elastogeo.observe import MachineTest, Rig
from studies.ball_roller import ENGAGEMENT, make_roller_test, table_6_6

SPRING, SETUP, GREATEST = 7e-5, 1 / 15e3, 1300.0
"""Compliance of machine and set-up [mm/N]; force near the greatest engagement [N]."""

LOSSES, PER_CURRENT = 0.25, 0.01
"""Relative standard uncertainties: of losses that are not stated, and of the force per current as it is stated."""

RIG = Rig(1 / 2650.0, standard_uncertainty=4e-6)


@dataclass(frozen=True)
class Mapped:
    """A simulated ball-roller test and its map.

    Attributes
    ----------
    law : str
        Of the machine's deflection: `spring`, `falls` (by 20 % up to the greatest engagement), `contact` (30 %),
        `table 6.6`, that of the thesis.
    back : float
        Efficiency of the drives while they are driven back.
    stated : bool
        Whether it is stated in the test.
    engagements : tuple of int
        Which of the five.
    rig : float or None
        True compliance of a rig over that which is stated; None for no test with a rig.
    dynamometer : float or None
        Gain of the force from the currents against a dynamometer; None for none.
    path : float [mm]
        By which the radius is off.
    drives_off : bool
        Whether motor constants and the losses of drives that are driven back are off, by as much as is stated of them.
    """

    share: ClassVar[float] = 0.25
    law: str = "spring"
    back: float = 2 - 1 / 0.9
    stated: bool = False
    engagements: tuple[int, ...] = (0, 1, 2, 3, 4)
    rig: float | None = None
    dynamometer: float | None = None
    path: float = 0.0
    drives_off: bool = False

    def draw(self, seed: tuple[int, ...]) -> object:
        """The map."""
        random = np.random.default_rng(seed)
        first, second = (int(random.integers(2**31)) for _ in range(2))
        test = self._test(first, 0.0, random if self.drives_off else None)
        if self.dynamometer is not None:
            test = self._measured(test, random)
        if self.rig is None:
            return map_stiffness(test)
        loaded = self._test(second, self.rig * RIG.compliance)
        return map_stiffness(test, replace(loaded, setup=replace(loaded.setup, rig=(RIG,))))

    def deflection(self, force: float) -> float:
        """Of the machine [mm]."""
        if self.law == "falls":
            return SPRING * force * (1 - 0.1 * force / GREATEST)
        if self.law == "contact":
            return SPRING * (0.7 * force + 0.3 * GREATEST ** (1 / 3) * force ** (2 / 3))
        return SPRING * force

    def force(self, engagement: float, more: float = 0.0) -> float:
        """At which machine, set-up and a rig give way by an engagement [N], by bisection."""
        low, high = 0.0, 5000.0
        for _ in range(60):
            middle = (low + high) / 2
            yielded = self.deflection(middle) + (SETUP + more) * middle
            low, high = (middle, high) if yielded < engagement - self.path else (low, middle)
        return low

    def _test(self, seed: int, rig: float, random: np.random.Generator | None = None) -> MachineTest:
        stated = {"back_efficiency": self.back} if self.stated else {}
        if random is not None:
            back = self.back + LOSSES * (1 - self.back) * random.standard_normal()
            gains = 1 + PER_CURRENT * random.standard_normal(2)
            return _with_gains(replace(self, back=back)._test(seed, rig), gains)
        if self.law == "table 6.6":
            return table_6_6(seed=seed, back=self.back, **stated)
        chosen = ENGAGEMENT[list(self.engagements)]
        forces = [self.force(engagement, rig) for engagement in chosen]
        return make_roller_test(
            chosen,
            lambda n: lambda angle: np.full(len(angle), forces[n]),
            SetupCompliance(constant=SETUP),
            back=self.back,
            seed=seed,
            **stated,
        )

    def _measured(self, test: MachineTest, random: np.random.Generator) -> MachineTest:
        """With a dynamometer on the roller, 3 N of noise."""
        runs = []
        for run in test.runs:
            x, y = run.columns["position_x"], run.columns["position_y"]
            angle, force = np.arctan2(y, x), self.force(run.engagement) if run.engagement else 0.0
            pair = force / self.dynamometer * np.stack([np.cos(angle), np.sin(angle)]) + 3.0 * random.standard_normal(
                (2, len(x))
            )
            runs.append(replace(run, columns={**run.columns, "force_x": pair[0], "force_y": pair[1]}))
        return replace(test, runs=tuple(runs))


def _with_gains(test: MachineTest, gains: np.ndarray) -> MachineTest:
    """With motors whose constants are off by these factors."""
    off = dict(zip(("current_x", "current_y"), gains, strict=True))
    scaled = [{name: column / off.get(name, 1.0) for name, column in run.columns.items()} for run in test.runs]
    return replace(test, runs=tuple(replace(run, columns=of) for run, of in zip(test.runs, scaled, strict=True)))


@dataclass(frozen=True)
class Laws:
    """Judge: whether the supported law, or one that the engagements do not distinguish from it, is the true one."""

    wanted: str

    def __call__(self, found: Any) -> str:
        law = found.law
        return "found" if law.supported == self.wanted else "alike" if self.wanted in law.alike else "other"


@dataclass(frozen=True)
class Covers:
    """Judge: whether the intervals of the map hold the compliance of a spring in nine directions of ten."""

    def __call__(self, found: Any) -> str:
        interval = found.overall.interval
        return "held" if np.mean((interval[:, 0] <= SPRING) & (interval[:, 1] >= SPRING)) >= 0.9 else "missed"

"""The contract of an instrument: how it was set up, what it records, and what its readings amount to."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from elastogeo.machine import Array, Block, Comment, Machine, Stop
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.observations import Observations
from elastogeo.observe.procedure import Procedure, ordered
from elastogeo.observe.run import Run
from elastogeo.observe.template import Template

Respond = Callable[[Observations], Array]
"""The true readings of observations, shape (m,), on a machine whose parameters are known: to simulate with."""

FactValue = float | str | Mapping[str, float] | tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, slots=True)
class SetupFact:
    """One thing to know of a set-up, for the head of a report.

    Attributes
    ----------
    name : str
        A constant: `plane`, `radius`, `centre`, `feed`, ...
    value : float, str, mapping of str to float, or tuple of 3-vector
        In the units of the house.
    unit : str
        `mm`, `mm_s`, `N`; `mm|rad` for commands by axis; empty for what has none.
    """

    name: str
    value: FactValue
    unit: str = ""


class Setup(ABC):
    """How an instrument was set up: the contract of an instrument.

    An instrument is one file of this room: a frozen dataclass of its settings (in the units of the house) with the members
    below, registered by `instrument`. The fields are what a test file may set, under their names with a unit. What is not
    abstract has an answer that suits most instruments.

    Attributes
    ----------
    loads : bool
        Whether the instrument loads the machine.
    extra : str
        Which result it has besides parameters: `circularity`, `stiffness-map`, `loading-cycles`, `cartesian-stiffness`,
        `twist`, `ball-deviations`; empty for none.
    limits : tuple of str
        What its results rest on and cannot show themselves, as constants for which `report` has the sentences.
    of_instrument : tuple of str
        Parameters of the set-up that go with the instrument from test to test: the length of a bar.
    knowledge : tuple of str
        Fields that say what is known of instrument and day, not how the test was made: calibrations, temperatures. Tests
        that differ only there are comparable, save for `corrections`.
    corrections : tuple of str
        Those of `knowledge` that change a result by being given at all.
    warm : str
        The field with the `Expansion` of the machine, if there is one.
    template : Template or None
        What a new test begins with.
    """

    __slots__ = ()

    loads: ClassVar[bool] = True
    extra: ClassVar[str] = ""
    limits: ClassVar[tuple[str, ...]] = ()
    of_instrument: ClassVar[tuple[str, ...]] = ()
    knowledge: ClassVar[tuple[str, ...]] = ()
    corrections: ClassVar[tuple[str, ...]] = ()
    warm: ClassVar[str] = ""
    template: ClassVar[Template | None] = None

    @property
    @abstractmethod
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have."""

    @property
    @abstractmethod
    def pose_quantity(self) -> str:
        """What the readings count along: `angle` if they go around a circle."""

    @abstractmethod
    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to."""

    @abstractmethod
    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run as the instrument would record it at its poses, with its imperfections."""

    def observe_all(self, machine: Machine, runs: Sequence[Run]) -> tuple[Observations, ...]:
        """The observations of all runs of a test, where one may tell something of another; by default one `observe` each."""
        return tuple(self.observe(machine, run) for run in runs)

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:  # noqa: ARG002
        """The blocks of a program that moves the machine as the runs want it; by default it only stops for each.

        Raises
        ------
        PathError
            If the machine cannot make the path.
        """
        says = [Stop(f"this instrument needs no motion: read run {run.name}") for run in ordered(runs, procedure.order)]
        return [Comment("no axis moves"), *says]

    @classmethod
    def template_for(cls, machine: Machine) -> Template | None:  # noqa: ARG003
        """What a new test on a machine begins with, where that depends on its axes; by default the `template`."""
        return cls.template

    @property
    def reads_angles(self) -> bool:
        """Whether the readings are angles rather than lengths."""
        return False

    @property
    def file_units(self) -> Mapping[str, str]:
        """Units of columns in a run file, where the name of the column does not say its dimension; empty for a number."""
        return {}

    @property
    def nominal_radius(self) -> float | None:
        """Radius [mm] of the circle that the test was to make; None if it was to make none."""
        return None

    @property
    def own_to_run(self) -> tuple[str, ...]:
        """Parameters of the set-up, as patterns, that every run has for itself (where its circle really lies), if any."""
        return ()

    def default_parameters(self, runs: Sequence[Run]) -> tuple[str, ...]:  # noqa: ARG002
        """Names, patterns or presets to ask for where nobody asks."""
        return ("compliance",)

    def facts(self) -> tuple[SetupFact, ...]:
        """What a reader of the result wants to know of the set-up."""
        return ()

"""A test: the machine, the instrument's set-up, the runs, and what is asked of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Protocol

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import Array, Force, Forces, Length, Machine, Pressure
from elastogeo.observe.about import About
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.observations import Observations


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Run(ByValue):
    """One run: what was recorded, and what was the same for every reading.

    Attributes
    ----------
    name : str
    columns : mapping of str to array, shape (m,)
        What the instrument recorded, by quantity, in the units of the house: `angle` [rad], `radial` [mm].
    force : float or None [N]
        Force level, if it was given as such.
    pressure : float or None [bar]
        Pressure level, if the force follows from it.
    engagement : float or None [mm]
        Commanded engagement of a roller in a ball; zero or none where it only circles around it.
    sense : int
        +1 counter-clockwise, -1 clockwise.
    repeat : int
        Counts the runs of one level, from 1.
    notes : tuple of str
        What was done to its recording before it became columns: sentences for the reader of the result.
    file : str
        The file it was read from, as the test names it; empty if it was read from none.
    sha256 : str
        Of that file's bytes, in hexadecimal digits.
    simulated : str
        What the file says of the simulation that made it; empty if it was measured.
    """

    name: str
    columns: Mapping[str, Array]
    force: Force | None = None
    pressure: Pressure | None = None
    engagement: Length | None = None
    sense: int = 1
    repeat: int = 1
    notes: tuple[str, ...] = ()
    file: str = ""
    sha256: str = ""
    simulated: str = ""

    def __repr__(self) -> str:
        readings = max((len(column) for column in self.columns.values()), default=0)
        return f"<Run {self.name!r}: {readings} readings of {', '.join(self.columns)}>"


Respond = Callable[[Observations], Array]
"""The true readings of observations, shape (m,), on a machine whose parameters are known: to simulate with."""


class Setup(Protocol):
    """How an instrument was set up: the contract of an instrument.

    An instrument is one file of this room: a frozen dataclass of its settings (in the units of the house) with the members
    below, registered by `instrument`. The fields are what a test file may set, under their names with a unit.
    """

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have."""

    @property
    def pose_quantity(self) -> str:
        """What the readings count along: `angle` if they go around a circle."""

    @property
    def own_to_run(self) -> tuple[str, ...]:
        """Parameters of the set-up, as patterns, that every run has for itself (where its circle really lies), if any."""

    def default_parameters(self, runs: Sequence[Run]) -> tuple[str, ...]:
        """Names, patterns or presets to ask for where nobody asks."""

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to."""

    def observe_all(self, machine: Machine, runs: Sequence[Run]) -> tuple[Observations, ...]:
        """The observations of all runs of a test, where one may tell something of another; else one `observe` each."""

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run as the instrument would record it at its poses, with its imperfections."""


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked of a test.

    Attributes
    ----------
    parameters : tuple of str
        Names, patterns or presets of the parameters to identify; empty for those that the instrument asks for by default.
    reference_force : float or None [N]
        Force level that is subtracted from all others (Eqs. 4.26, 4.27), if any.
    prefer : tuple of str
        Parameters to retain before others that cannot be told from them.
    levels, without_levels : tuple of float [N]
        Force levels to use alone, and to leave out; empty for all, and for none.
    reciprocal : bool
        Whether each joint's compliance is taken as symmetric: C_dfj and C_fdj are then one parameter.
    robust : bool
        Whether outlying readings count less (Huber).
    """

    parameters: tuple[str, ...] = ()
    reference_force: Force | None = None
    prefer: tuple[str, ...] = ()
    levels: Forces = ()
    without_levels: Forces = ()
    reciprocal: bool = False
    robust: bool = False


@dataclass(frozen=True, slots=True)
class KnownInfluence:
    """What is known of a systematic influence on a test.

    Attributes
    ----------
    kind : str
        `force-scale`, `bar-length`, `ball-form`, ...: see `elastogeo.identification.influences`.
    label : str
        Where the knowledge comes from, in words.
    relative : float or None
        Its size, for a kind that has a relative one.
    length : float or None [mm]
    force : float or None [N]
    distribution : str
        `normal` (the size is a standard uncertainty), `rectangular`, `triangular` or `arcsine` (it is the half-width).
    degrees_of_freedom : float
        Of the size.
    """

    kind: str
    label: str = ""
    relative: float | None = None
    length: Length | None = None
    force: Force | None = None
    distribution: str = "normal"
    degrees_of_freedom: float = inf


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class MachineTest(ByValue):
    """A test as a whole.

    Attributes
    ----------
    name : str
    machine : Machine
    setup : Setup
        Of the instrument.
    runs : tuple of Run
    question : Question
    resolution : float or None [mm]
        Of the readings.
    influences : tuple of KnownInfluence
        Systematic influences on the readings.
    simulated : str
        From what the readings are simulated, in words; empty if they were measured.
    about : About
        Who, when, with what.
    """

    name: str
    machine: Machine
    setup: Setup
    runs: tuple[Run, ...]
    question: Question = field(default_factory=Question)
    resolution: float | None = None
    influences: tuple[KnownInfluence, ...] = ()
    simulated: str = ""
    about: About = field(default_factory=About)

    def __post_init__(self) -> None:
        """Refuse a test without runs, or with two runs of one name."""
        names = [run.name for run in self.runs]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise InputError(f"test {self.name!r} names the run {twice[0]!r} twice; every run needs a name of its own")
        if not names:
            raise InputError(f"test {self.name!r} has no run")

    def __repr__(self) -> str:
        machine = f"{self.machine.name} ({self.machine.topology.compact})"
        return f"<MachineTest {self.name!r}: {type(self.setup).__name__} on {machine}, {len(self.runs)} runs>"

    @property
    def asked(self) -> tuple[str, ...]:
        """Names, patterns or presets of the parameters that are asked for: the question's, else the instrument's own."""
        return self.question.parameters or self.setup.default_parameters(self.runs)

    def observations(self) -> tuple[Observations, ...]:
        """The observations of every run that holds readings, in order."""
        return self.setup.observe_all(self.machine, self.runs)

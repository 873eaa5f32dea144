"""A test: the machine, the instrument's set-up, the runs, and what is asked of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import (
    About,
    Force,
    Forces,
    Length,
    Machine,
    Program,
    ProgramLimits,
    Resolution,
    Workpiece,
    check_limits,
    check_tool,
    only_moving,
)
from elastogeo.observe.covariance import with_covariance
from elastogeo.observe.instruments import instrument_of
from elastogeo.observe.observations import Observations
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Setup


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
    set_up_per_run : bool
        Whether every run has its own set-up (`Setup.own_to_run`), where none of it is among the parameters and no reference
        is subtracted. If not, a set-up that is not asked for counts as right.
    by_date : tuple of str
        In a campaign, names or patterns of what is one parameter for each date; all others are one for all dates.
    """

    parameters: tuple[str, ...] = ()
    reference_force: Force | None = None
    prefer: tuple[str, ...] = ()
    levels: Forces = ()
    without_levels: Forces = ()
    reciprocal: bool = False
    robust: bool = False
    set_up_per_run: bool = True
    by_date: tuple[str, ...] = ()


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
    resolution : float or None [mm, or rad of angles]
        Of the readings.
    influences : tuple of KnownInfluence
        Systematic influences on the readings.
    simulated : str
        From what the readings are simulated, in words; empty if they were not.
    reconstructed : str
        From what the readings are reconstructed, in words; empty if they were not.
    workpiece : Workpiece or None
        What lay on the table while it was made, if its weight is known.
    about : About
        Who, when, with what.
    """

    name: str
    machine: Machine
    setup: Setup
    runs: tuple[Run, ...]
    question: Question = field(default_factory=Question)
    resolution: Resolution | None = None
    influences: tuple[KnownInfluence, ...] = ()
    simulated: str = ""
    reconstructed: str = ""
    workpiece: Workpiece | None = None
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

    @property
    def instrument(self) -> str:
        """The name under which test files know the instrument."""
        return instrument_of(self.setup)

    @property
    def truth(self) -> Mapping[str, float]:
        """True parameters by name, if the readings of all runs are simulated from the same; empty if not, or not known."""
        first = self.runs[0].truth
        return first if self.simulated and all(run.truth == first for run in self.runs) else {}

    def program(self, procedure: Procedure | None = None, limits: ProgramLimits | None = None) -> Program:
        """The program that moves the machine as this test wants it: the instrument's own hook, checked.

        Parameters
        ----------
        procedure : Procedure, optional
            What it does around the readings.
        limits : ProgramLimits, optional
            Of feed, radius and tool; the travel of the axes is the machine's and always kept.

        Raises
        ------
        PathError
            If the machine cannot make it: with the axis, the value and the limit.
        """
        limits = limits or ProgramLimits()
        check_tool(getattr(self.setup, "tool", None) or self.machine.tool, limits)
        blocks = self.setup.program(self.machine, self.runs, procedure or Procedure())
        return check_limits(Program(self.name, list(only_moving(blocks))), self.machine, limits)

    def observations(self) -> tuple[Observations, ...]:
        """The observations of every run that holds readings, in order."""
        seen = with_covariance(self.setup.observe_all(self.machine, self.runs), self.runs)
        return seen if self.workpiece is None else tuple(replace(run, weight=self.workpiece) for run in seen)

"""A campaign: many tests of one machine that are asked together. One test is a campaign of one."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import Array, Machine
from elastogeo.observe.measurement import MachineTest, Question
from elastogeo.observe.observations import Observations

_NAME = re.compile(r"[\w.+-]+")
"""What a test is called in a campaign: it becomes a part of the names of parameters and runs."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Campaign(ByValue):
    """Tests of one machine that are asked together.

    Attributes
    ----------
    name : str
    tests : mapping of str to MachineTest
        Each under a short name of its own, without blanks: `xy`, `yz`.
    """

    name: str
    tests: Mapping[str, MachineTest]

    def __post_init__(self) -> None:
        """Refuse a campaign without tests, or of several machines."""
        if not self.tests:
            raise InputError(f"campaign {self.name!r} has no test")
        if len(self.tests) > 1:
            _check_names(self.tests)
            _check_machines(self.tests)

    def __repr__(self) -> str:
        machine = f"{self.machine.name} ({self.machine.topology.compact})"
        return f"<Campaign {self.name!r}: {', '.join(self.tests)} on {machine}>"

    @property
    def machine(self) -> Machine:
        """The machine that all tests are of."""
        return next(iter(self.tests.values())).machine

    @property
    def several(self) -> bool:
        """Whether there is more than one test."""
        return len(self.tests) > 1

    @property
    def only(self) -> MachineTest:
        """The test of a campaign of one.

        Raises
        ------
        InputError
            If there are several.
        """
        if self.several:
            raise InputError(
                f"campaign {self.name!r} has {len(self.tests)} tests ({', '.join(self.tests)}), and this is asked of one "
                f"test; ask one of them"
            )
        return next(iter(self.tests.values()))

    @property
    def question(self) -> Question:
        """What is asked of the tests together: of one test its own question.

        What one test asks is asked of all: its parameters, those it prefers, symmetric joints, a robust estimate.
        """
        questions = [test.question for test in self.tests.values()]
        if not self.several:
            return questions[0]
        return Question(
            parameters=_each_once(name for question in questions for name in question.parameters),
            prefer=_each_once(name for question in questions for name in question.prefer),
            reciprocal=any(question.reciprocal for question in questions),
            robust=any(question.robust for question in questions),
        )

    @property
    def asked(self) -> tuple[str, ...]:
        """Names, patterns or presets of the parameters that any of the tests asks for."""
        return _each_once(name for test in self.tests.values() for name in test.asked)

    @property
    def runs(self) -> int:
        """How many runs all tests have."""
        return sum(len(test.runs) for test in self.tests.values())

    @property
    def simulated(self) -> str:
        """From what readings are simulated, in words; empty if all were measured."""
        return "; ".join(_each_once(test.simulated for test in self.tests.values() if test.simulated))

    def observations(self) -> dict[str, tuple[Observations, ...]]:
        """The observations of every test, as `MachineTest.observations`, about one centre."""
        centre = self.centre()
        return {name: self.observed(name, centre) for name in self.tests}

    def observed(self, name: str, centre: Array | None) -> tuple[Observations, ...]:
        """The observations of one test about the centre of all."""
        found = self.tests[name].observations()
        return found if centre is None else tuple(replace(run, centre=centre) for run in found)

    def centre(self) -> Array | None:
        """Axis commands from which polynomials of the commands count, shape (axes,); None if each test's own will do.

        Of several tests it is the middle of theirs: else `E_XX1` beside `E_XX2` would be another number in each.
        """
        if not self.several:
            return None
        centres = np.array([test.observations()[0].centre for test in self.tests.values()])
        return np.asarray((centres.min(axis=0) + centres.max(axis=0)) / 2) if np.ptp(centres, axis=0).any() else None


Askable = MachineTest | Campaign | Sequence[MachineTest] | Mapping[str, MachineTest]
"""What may be asked: a test, a campaign, or tests, with names or without."""


def campaign_of(one: Askable) -> Campaign:
    """The campaign that a test, or several, are; of a campaign, itself.

    Parameters
    ----------
    one : MachineTest, Campaign, sequence of MachineTest, or mapping of str to MachineTest
        Tests without names of their own are called after what they say: `Loaded circle, XY` becomes `loaded-circle-xy`.

    Raises
    ------
    InputError
        If there is no test, two have the same name, or they are of different machines.
    """
    if isinstance(one, Campaign):
        return one
    if isinstance(one, MachineTest):
        return Campaign(one.name, {short_name(one.name): one})
    if isinstance(one, Mapping):
        return Campaign(_joined_name(list(one)), dict(one))
    names = [short_name(test.name) for test in one]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(
            f"two tests are called {twice[0]!r}; give every test a name of its own, as in {{'xy': one, 'yz': other}}"
        )
    return Campaign(_joined_name(names), dict(zip(names, one, strict=True)))


def short_name(name: str) -> str:
    """A name without blanks and commas, in small letters."""
    return "-".join(re.findall(r"[a-z0-9.]+", name.lower())) or "test"


def _joined_name(names: Sequence[str]) -> str:
    return " + ".join(names)


def _each_once(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))


def _check_names(tests: Mapping[str, MachineTest]) -> None:
    wrong = next((name for name in tests if not _NAME.fullmatch(name)), None)
    if wrong is not None:
        raise InputError(f"a test is called {wrong!r}; use letters, digits, '-', '_', '.' and '+' only, as in 'xy-tilted'")


def _check_machines(tests: Mapping[str, MachineTest]) -> None:
    (first, test), *others = tests.items()
    for name, other in others:
        apart = [
            field.name
            for field in fields(Machine)
            if getattr(test.machine, field.name) != getattr(other.machine, field.name)
        ]
        if apart:
            raise InputError(
                f"tests {first!r} and {name!r} are not of one machine: {' and '.join(apart)} differ "
                f"({_said(test.machine, apart[0])}, {_said(other.machine, apart[0])}); a campaign is of one machine, "
                f"described by one machine file"
            )


def _said(machine: Machine, field: str) -> str:
    value = getattr(machine, field)
    return f"{value.compact}" if field == "topology" else f"{value!r}" if len(repr(value)) < 60 else machine.name


def with_questions(campaign: Campaign, question: Question) -> Campaign:
    """The campaign with one question asked of all its tests."""
    return replace(campaign, tests={name: replace(test, question=question) for name, test in campaign.tests.items()})

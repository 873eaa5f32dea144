"""Whether the test of a campaign that is wrong is named, and none where all are sound."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.identification import TestsAgreement
from studies.campaign_tests import FAULTS, LEVEL_FAULT, TESTS, agreement_of, campaign
from studies.rates import Cell, Study

CHECK = "tests agree"
AND_MORE = "this one, and the rest disagrees"


@dataclass(frozen=True)
class FiveTests:
    """Five loaded circles of one machine, of which one may be wrong.

    Attributes
    ----------
    fault : str
        One of `FAULTS`; empty for none.
    wrong : str
        The test that has it.
    noise : str
        `wandering centre`, or a name of `NOISES`.
    """

    fault: str = ""
    wrong: str = ""
    noise: str = "wandering centre"

    def draw(self, seed: tuple[int, ...]) -> object:
        """What is found of the agreement."""
        return agreement_of(campaign(self.fault, self.wrong, seed, self.noise))


@dataclass(frozen=True)
class Names:
    """Judge: whether this test, and no other, is named, with this level if it is one."""

    test: str = ""
    level: float | None = None

    def __call__(self, found: object) -> str:
        """`none`, `this one`, `another`, `one of several`, `another level`, or `AND_MORE`."""
        assert isinstance(found, TestsAgreement)
        if not found.named:
            return "none"
        if len(found.named) > 1:
            return "one of several"
        if found.named != (self.test,):
            return "another"
        if not found.rest_agrees:
            return AND_MORE
        return "this one" if found.level == self.level else "another level"


def every() -> Iterator[Cell]:
    some = (AND_MORE, "another", "one of several", "this one", "another level")
    for noise in ("wandering centre", "autocorrelated", "of the run", "harmonic", "quantised"):
        short = 3 if noise == "wandering centre" else 0
        yield Cell(
            "all tests are sound", "five circles", noise, FiveTests(noise=noise), Names(), some, most=0.05, short=short
        )
    for fault in FAULTS:
        for test in TESTS:
            judge = Names(test, LEVEL_FAULT if fault.startswith("a level") else None)
            short = 1 if test == "zx" else 0
            sample = FiveTests(fault, test)
            yield Cell(
                f"{fault}: {test}",
                "five circles",
                "wandering centre",
                sample,
                judge,
                ("this one", AND_MORE),
                least=0.95,
                short=short,
            )


STUDY = Study(
    CHECK,
    "Five circles of 150 mm at 100, 300 and 500 N, one run each, 90 readings: XY, YZ, ZX, XY with A at 0.5 rad and C at "
    "0.7 rad, XY again, on a machine `wCAFYXZSt` whose rotary axes are stiff, with 0.1 um white and a centre that wanders "
    "by 0.2 um (*wandering centre*). Each test in turn is wrong; it alone has to be named. A fault that the question "
    "explains cannot be seen: with the compliance of the rotary axes asked for, too much force in the tilted test alone "
    "looks just like it.",
    tuple(every()),
    order=1,
)

"""Whether the data confirm that the joints are symmetric and never gain energy, contradict it, or cannot tell."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from math import sqrt
from typing import Any

from elastogeo.estimate import merge, solve, solve_by_run
from elastogeo.identification import Consistency, confounding_of, consistency, systems_of
from studies.bar_tests import LOADED, QUESTION, make_test
from studies.noise import NOISES, Noise
from studies.rates import ALARM, NOT_TESTED, SILENT, Cell, Study
from studies.truth import TABLE_5_5, Truth, with_values

CHECK = "physically consistent"
PLANAR = ("planar-xy", "E_XX1", "E_YX2", "E_XY2", "E_YY1", "E_C(0Y)X", "E_Xt0", "E_Yt0")
"""All 18 planar compliances, so that pairs restrict each other; the 13 of Table 5.1 restrict signs alone."""

SMALL = ("white", "of the run", "quantised", "eccentricity")
"""Noises under which C_CCY = -3e-11 is at least five of its standard uncertainties on 15 runs."""


def pushed(*load: float) -> Truth:
    """A joint Y that gives way to one load only: its compliance has rank one, on the boundary of what physics allows."""
    letters = "XYC"
    rank_one = {f"C_{d}{f}Y": load[i] * load[k] for i, d in enumerate(letters) for k, f in enumerate(letters)}
    geometry = {name: value for name, value in TABLE_5_5 if not name.startswith("C_")}
    return Truth(tuple((geometry | rank_one).items()))


def coupled(share: float) -> Truth:
    """Table 5.5 with a coupling of X and Y this share beyond what their compliances allow."""
    table = dict(TABLE_5_5)
    half = (1.0 + share) * sqrt(table["C_XXX"] * table["C_YYY"])
    return Truth(with_values(TABLE_5_5, C_XYX=half, C_YXX=half))


@dataclass(frozen=True)
class Judged:
    """A simulated test, its estimate by run, and what physics says: a tenth of the time of a whole identification."""

    layout: str
    noise: str | Noise
    truth: Truth | None = None
    question: tuple[str, ...] = QUESTION

    def draw(self, seed: tuple[int, ...]) -> Consistency:
        """What physics says; an estimate that is not solved is refused."""
        test = make_test(self.layout, self.truth, self.noise, seed, question=self.question)
        systems = systems_of(test)
        found = confounding_of(test, systems)
        runs = [run.factor for run in systems.runs]
        by_run, by_reading = solve_by_run(runs, found.retained), solve(merge(*runs), found.retained)
        return consistency(systems.sources, found, by_run, correlated_as=by_reading.covariance)


def marked(found: Any) -> str:
    """Judge: the mark of the check."""
    return {"contradicted": ALARM, "not tested": NOT_TESTED}.get(found.state, SILENT)


def solved(found: Any) -> str:  # noqa: ARG001
    """Judge: every draw that is not refused is solved."""
    return "solved"


def judged(
    truth: str,
    layouts: Iterable[str],
    noises: Iterable[str],
    drawn: Truth | None = None,
    question: tuple[str, ...] = QUESTION,
    short: int = 0,
    **wanted: Any,
) -> Iterator[Cell]:
    """Cells of such draws, one for each layout and noise; the first is short."""
    for k, (layout, noise) in enumerate(product(layouts, noises)):
        yield Cell(truth, layout, noise, Judged(layout, noise, drawn, question), marked, short=0 if k else short, **wanted)


def wander() -> Iterator[Cell]:
    """The centre moves from run to run: the cases of which version 0.1.0 solved as few as 12 %."""
    for size in (0.2, 0.5, 1.0, 2.0, 5.0):
        sample = Judged("7 runs", Noise(eccentricity=size * 1e-3), question=PLANAR)
        truth = f"Table 5.5, the centre wanders by {size:g} um"
        yield Cell(truth, "7 runs", "eccentricity", sample, marked, most=0.05)
        yield Cell(f"{truth}: solved", "7 runs", "eccentricity", sample, solved, SOLVED, least=0.995)


def boundary() -> Iterator[Cell]:
    """A joint of rank one: found on the boundary, where noise leads outside every other time."""
    yield from judged("a joint of rank one", LOADED, NOISES, BOUNDARY, PLANAR, short=20, most=0.05)
    for layout, noise in product(LOADED, NOISES):
        sample = Judged(layout, noise, BOUNDARY, PLANAR)
        yield Cell("a joint of rank one: solved", layout, noise, sample, solved, SOLVED, least=0.995)
        yield Cell("a joint of rank one: confirmed", layout, noise, sample, marked, (SILENT,), most=0.05)


def confirmed() -> Iterator[Cell]:
    """How often a sound machine is called sound: always where C_CCY is large, seldom where it is as small as its noise."""
    for question, asked in ((QUESTION, "13 parameters"), (PLANAR, "18 compliances")):
        yield from judged(f"Table 5.5, {asked}: confirmed", LOADED, NOISES, None, question, counted=(SILENT,), least=0.95)
    for value in (1e-10, 3e-11):
        drawn = Truth(with_values(TABLE_5_5, C_CCY=value))
        yield from judged(f"C_CCY = {value:g}: confirmed", LOADED, NOISES, drawn, counted=(SILENT,))
    drawn = Truth(with_values(TABLE_5_5, C_CCY=0.0))
    yield from judged("C_CCY = 0: confirmed", LOADED, NOISES, drawn, short=20, counted=(SILENT,), most=0.05)


REST = tuple(noise for noise in NOISES if noise not in SMALL)
NEGATIVE_C = Truth(with_values(TABLE_5_5, C_CCY=-3e-11))
AS_PRINTED = Truth(with_values(TABLE_5_5, C_CCY=-1.1e-9))
NEGATIVE_X = Truth(with_values(TABLE_5_5, C_XXX=-2e-5))
BOUNDARY = pushed(5e-3, 6e-3, 1e-5)
SOLVED = ("solved",)
SAID = {"counted": (ALARM, NOT_TESTED), "least": 0.95}
FOUND = {"least": 0.95}

STUDY = Study(
    CHECK,
    "Joints that are symmetric and never gain energy, against data that they cannot give. It passes only where the data "
    "confirm them: where no 95 % interval reaches what joints cannot have. It fails where the data contradict them, and is "
    "*not tested* in between; a machine whose C_CCY is as small as its uncertainty is not tested for the most part, and no "
    "fault is claimed. On 7 runs the uncertainty has about three degrees of freedom. Under autocorrelated noise of 0.3 um a "
    "C_CCY of -3e-11 rad/(N mm) is less than three of its standard uncertainties, under harmonics of 0.5 um less than one "
    "(order 4 is its own shape): no check can find it there, so the value of the thesis, -1.1e-9, is asked for too.",
    (
        *judged("Table 5.5, 13 parameters", LOADED, NOISES, most=0.05),
        *judged("Table 5.5, 18 compliances", LOADED, NOISES, None, PLANAR, most=0.05),
        *boundary(),
        *wander(),
        *confirmed(),
        *judged("C_CCY = -3e-11", ["15 runs"], SMALL, NEGATIVE_C, short=20, **FOUND),
        *judged("C_CCY = -3e-11", ["15 runs"], REST, NEGATIVE_C, **SAID),
        *judged("C_CCY = -3e-11", ["7 runs"], NOISES, NEGATIVE_C, short=20, **SAID),
        *judged("C_CCY = -1.1e-9", ["15 runs"], NOISES, AS_PRINTED, **FOUND),
        *judged("C_CCY = -1.1e-9", ["7 runs"], NOISES, AS_PRINTED, **SAID),
        *judged("C_XXX = -2e-5", ["15 runs"], NOISES, NEGATIVE_X, **FOUND),
        *judged("C_XXX = -2e-5", ["7 runs"], NOISES, NEGATIVE_X, **SAID),
        *judged("C_XYX 50 % too large", ["15 runs"], NOISES, coupled(0.5), PLANAR, **FOUND),
        *judged("C_XYX 50 % too large", ["7 runs"], NOISES, coupled(0.5), PLANAR, **SAID),
        *judged("C_XYX 10 % too large", LOADED, NOISES, coupled(0.1), PLANAR, short=20, **SAID),
        *judged("C_XYX 1 % too large", LOADED, NOISES, coupled(0.01), PLANAR, **SAID),
    ),
    order=1,
)

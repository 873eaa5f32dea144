"""Rates of a check: how often it alarms where nothing is wrong, and how often it finds its fault, with their intervals.

A *sample* is something that can be drawn by a seed: most often a simulated test, identified. A *cell* is a sample and what
is counted in it. Cells of different checks that look at the same sample share its draws.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from itertools import product
from math import sqrt
from typing import Any, Protocol
from zlib import crc32

from scipy import stats

from elastogeo.errors import ElastogeoError
from elastogeo.identification import identify
from elastogeo.observe import Question
from studies.bar_tests import Layout, make_test
from studies.noise import Noise
from studies.truth import Truth

ALARM, SILENT, NOT_TESTED, ABSENT, REFUSED = "alarm", "silent", "not tested", "absent", "refused"
"""What a check says in one draw: failed, passed, could not be judged, not part of the verdict; the input was refused."""

NOMINAL = 0.05
"""False alarms that a check may give, unless its study says otherwise."""

PART = 20
"""Draws that one process makes at a time."""

Judge = Callable[[Any], str]


class Sample(Protocol):
    """Something to draw: hashable, and its `repr` says all that it depends on, since its seeds come from that.

    A class whose draws take long may have a `share`: of the draws that its cells get otherwise; one that draws many at once
    a `part`: how many one process makes at a time.
    """

    def draw(self, seed: tuple[int, ...]) -> object:
        """One draw: what the judges look at. An `ElastogeoError` counts as `refused`."""


@dataclass(frozen=True)
class Identified:
    """A simulated ball bar test, identified.

    Attributes
    ----------
    layout : str or Layout
        A name of `LAYOUTS`, or one of its own.
    noise : str or Noise
        A name of `NOISES`, or any.
    truth : Truth or None
        None for the default of the layout.
    question : tuple of str, Question or None
    resolution : float or None [mm]
    topology : str
    """

    layout: str | Layout
    noise: str | Noise
    truth: Truth | None = None
    question: tuple[str, ...] | Question | None = None
    resolution: float | None = None
    topology: str = "wFYXt"

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `identify`."""
        return identify(
            make_test(
                self.layout,
                self.truth,
                self.noise,
                seed,
                topology=self.topology,
                question=self.question,
                resolution=self.resolution,
            )
        )


@dataclass(frozen=True)
class Named:
    """Judge: what the check of this name says in `result.verdict`."""

    check: str

    def __call__(self, result: Any) -> str:
        """`alarm`, `silent`, `not tested` or `absent`."""
        for check in result.verdict:
            if check.name == self.check:
                return {True: SILENT, False: ALARM, None: NOT_TESTED}[check.passed]
        return ABSENT


@dataclass(frozen=True)
class Cell:
    """A rate to be found.

    Attributes
    ----------
    truth : str
        What is really so, in words, with its size: the row of the table.
    layout, noise : str
        In words.
    sample : Sample
    judge : callable
        From a draw to one word, picklable.
    counted : tuple of str
        The words that count.
    least, most : float
        Between which the rate is to be: a false alarm has a most, a fault a least.
    short : int
        Draws with which the tests run it too; 0 for none.
    share : float
        Of the draws that a cell gets otherwise: less for what takes long.
    """

    truth: str
    layout: str
    noise: str
    sample: Sample
    judge: Judge
    counted: tuple[str, ...] = (ALARM,)
    least: float = 0.0
    most: float = 1.0
    short: int = 0
    share: float = 1.0

    @property
    def key(self) -> str:
        """By which its counts are kept."""
        return f"{self.truth} | {self.layout} | {self.noise}"


def draws(cell: Cell, sound: int, fault: int) -> int:
    """How many draws a cell gets, of as many as cells get where nothing is wrong, and where there is a fault."""
    share = cell.share * float(getattr(type(cell.sample), "share", 1.0))
    return max(1, round(share * (fault if cell.least else sound)))


@dataclass(frozen=True)
class Study:
    """The rates of one check.

    Attributes
    ----------
    check : str
        Its name.
    about : str
        What it is held to, and what it cannot see: for the reader of the page.
    cells : tuple of Cell
    order : int
        Of the page: 0 for the verdict of a ball bar test, 1 for what stands beside it, 2 for other tests, 3 for series.
    """

    check: str
    about: str
    cells: tuple[Cell, ...]
    order: int = 0


def cells(
    check: str,
    truth: str,
    layouts: Iterable[str] | Mapping[str, Layout],
    noises: Iterable[str],
    drawn: Truth | None = None,
    *,
    question: tuple[str, ...] | Question | None = None,
    resolution: float | None = None,
    judge: Judge | None = None,
    short: Mapping[tuple[str, str], int] | None = None,
    **wanted: Any,
) -> Iterator[Cell]:
    """Cells of identified ball bar tests, one for each layout and noise.

    Parameters
    ----------
    check : str
        Whose word is counted.
    truth : str
        In words.
    layouts : iterable of str, or mapping of str to Layout
        Names of `LAYOUTS`, or layouts of their own by the words for them.
    noises : iterable of str
    drawn : Truth, optional
        What is drawn.
    question, resolution
        As in `make_test`.
    judge : callable, optional
        What is counted, if it is not the check's mark.
    short : mapping of (layout, noise) to int
        Which of them the tests run too, with how many draws.
    wanted
        `most` of a false alarm, `least` of a fault, `counted`, `share`.
    """
    for layout, noise in product(layouts, noises):
        runs = layouts[layout] if isinstance(layouts, Mapping) else layout
        sample = Identified(runs, noise, drawn, question, resolution)
        yield Cell(
            truth, layout, noise, sample, judge or Named(check), short=(short or {}).get((layout, noise), 0), **wanted
        )


@dataclass(frozen=True)
class Rate:
    """What was counted in one cell."""

    words: tuple[tuple[str, int], ...]
    counted: tuple[str, ...]

    @property
    def trials(self) -> int:
        """How many draws."""
        return sum(count for _, count in self.words)

    @property
    def hits(self) -> int:
        """How many of them counted."""
        return sum(count for word, count in self.words if word in self.counted)

    @property
    def share(self) -> float:
        """Of the draws that counted."""
        return self.hits / self.trials

    @property
    def interval(self) -> tuple[float, float]:
        """Of the rate, 95 % (Wilson)."""
        return wilson(self.hits, self.trials)

    def meets(self, cell: Cell) -> bool:
        """Whether the interval reaches what is wanted."""
        low, high = self.interval
        return high >= cell.least and low <= cell.most


def wilson(hits: int, trials: int, level: float = 0.95) -> tuple[float, float]:
    """Interval of a rate from `hits` of `trials` (Wilson, 1927)."""
    z = float(stats.norm.ppf(0.5 + level / 2))
    share = hits / trials
    middle = (share + z * z / 2 / trials) / (1 + z * z / trials)
    half = z / (1 + z * z / trials) * sqrt(share * (1 - share) / trials + z * z / 4 / trials**2)
    return (middle - half if hits else 0.0), (middle + half if hits < trials else 1.0)


def seed_of(sample: Sample, trial: int) -> tuple[int, ...]:
    """The same for ever, another for each sample."""
    return crc32(repr(sample).encode()), trial


def drawn_words(sample: Sample, judges: Sequence[tuple[Judge, int]], trials: range) -> list[Counter[str]]:
    """What each judge says of the draws that it gets, counted."""
    words: list[Counter[str]] = [Counter() for _ in judges]
    for trial in trials:
        try:
            found = sample.draw(seed_of(sample, trial))
        except ElastogeoError:
            found = None
        for counter, (judge, most) in zip(words, judges, strict=True):
            if trial < most:
                counter[REFUSED if found is None else judge(found)] += 1
    return words


def rates(wanted: Sequence[Cell], trials: Callable[[Cell], int], workers: int = 1) -> dict[Cell, Rate]:
    """The rate of every cell; samples that cells share are drawn once.

    Parameters
    ----------
    wanted : sequence of Cell
    trials : callable
        How many draws a cell gets.
    workers : int
        Processes; 1 stays in this one.
    """
    by_sample: dict[Sample, list[Cell]] = {}
    for cell in wanted:
        by_sample.setdefault(cell.sample, []).append(cell)
    jobs = [
        (sample, tuple((cell.judge, trials(cell)) for cell in group), range(first, min(first + part, most)))
        for sample, group in by_sample.items()
        for most in [max(map(trials, group))]
        for part in [int(getattr(type(sample), "part", PART))]
        for first in range(0, most, part)
    ]
    counted: dict[Sample, list[Counter[str]]] = {s: [Counter() for _ in group] for s, group in by_sample.items()}
    for (sample, _, _), words in _done(jobs, workers):
        for total, more in zip(counted[sample], words, strict=True):
            total.update(more)
    return {
        cell: Rate(tuple(sorted(counter.items())), cell.counted)
        for sample, group in by_sample.items()
        for cell, counter in zip(group, counted[sample], strict=True)
    }


Job = tuple[Sample, tuple[tuple[Judge, int], ...], range]


def _done(jobs: Sequence[Job], workers: int) -> Iterator[tuple[Job, list[Counter[str]]]]:
    if workers < 2:
        yield from ((job, drawn_words(*job)) for job in jobs)
        return
    start = time.monotonic()
    with ProcessPoolExecutor(workers) as pool:
        pending = {pool.submit(drawn_words, *job): job for job in jobs}
        for k, future in enumerate(as_completed(pending), start=1):
            yield pending[future], future.result()
            if k % 20 == 0 or k == len(jobs):
                gone = time.monotonic() - start
                left = gone / k * (len(jobs) - k)
                print(f"{k} of {len(jobs)} parts, {gone:.0f} s, about {left:.0f} s left", file=sys.stderr, flush=True)

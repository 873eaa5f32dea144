"""Rates: their intervals, their seeds, the page that shows them; and every check's study with few draws."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy import stats
from statsmodels.stats.proportion import proportion_confint

from elastogeo.errors import UnsupportedError
from studies import run
from studies.checks import studies
from studies.page import page, shown
from studies.rates import ALARM, Cell, Rate, Sample, Study, rates, wilson


@dataclass(frozen=True)
class Coin:
    """Falls on its head with a known probability; some throws roll off the table."""

    head: float
    lost: float = 0.0

    def draw(self, seed: tuple[int, ...]) -> float:
        random = np.random.default_rng(seed)
        if random.random() < self.lost:
            raise UnsupportedError("the coin is lost")
        return float(random.random() < self.head)


def alarmed(found: float) -> str:
    return ALARM if found else "silent"


def cell(sample: Sample, **wanted: float) -> Cell:
    return Cell("a coin", "table", "none", sample, alarmed, **wanted)  # type: ignore[arg-type]


@pytest.mark.parametrize(("hits", "trials"), [(0, 12), (1, 30), (380, 400), (400, 400)])
def test_the_interval_is_that_of_wilson(hits: int, trials: int) -> None:
    assert wilson(hits, trials) == pytest.approx(proportion_confint(hits, trials, method="wilson"), abs=1e-12)


def test_a_known_rate_is_found_and_refusals_are_counted_apart() -> None:
    coin = cell(Coin(0.3, lost=0.2))
    rate = rates([coin], lambda _: 2000)[coin]
    words = dict(rate.words)
    low, high = stats.binom.ppf([0.0005, 0.9995], 2000, 0.24)
    assert low <= words[ALARM] <= high
    assert stats.binom.ppf(0.0005, 2000, 0.2) <= words["refused"] <= stats.binom.ppf(0.9995, 2000, 0.2)
    assert rate.trials == 2000
    assert "refused" in shown(coin, rate)


def test_processes_do_not_change_a_count_and_samples_are_shared() -> None:
    one, other = cell(Coin(0.3)), Cell("a fair coin", "table", "none", Coin(0.5), alarmed, least=0.4)
    alone = rates([one, other], lambda c: 90 if c.least else 45, workers=1)
    assert alone == rates([one, other], lambda c: 90 if c.least else 45, workers=2)
    assert alone[one].trials == 45
    assert alone[other].trials == 90


def test_studies_that_share_a_sample_are_counted_together() -> None:
    one, two, three = Coin(0.1), Coin(0.2), Coin(0.3)
    chosen = {
        "a": Study("a", "", (cell(one), cell(two))),
        "b": Study("b", "", (cell(three),)),
        "c": Study("c", "", (cell(two, most=0.1),)),
    }
    assert run.groups(chosen) == [["b"], ["a", "c"]]


def test_a_rate_is_bold_where_its_interval_does_not_reach() -> None:
    rate = Rate(((ALARM, 20), ("silent", 80)), (ALARM,))
    assert not rate.meets(cell(Coin(0.2), most=0.05))
    assert rate.meets(cell(Coin(0.2), most=0.15))
    assert not rate.meets(cell(Coin(0.2), least=0.5))
    assert shown(cell(Coin(0.2), most=0.05), rate).startswith("**20 (13 to 28.9)**")


def test_the_page_is_that_of_the_counts_that_are_kept() -> None:
    known = studies()
    found = {name: run.rates_of(study, run.read_counts(name)) for name, study in known.items()}
    assert run.PAGE.read_text(encoding="utf-8") == page(known, found)


def test_every_study_has_a_false_alarm_rate_and_a_power_and_keys_of_its_own() -> None:
    for name, study in studies().items():
        keys = [c.key for c in study.cells]
        assert len(keys) == len(set(keys)), name
        assert any(c.least > 0 for c in study.cells), name
        assert any(c.most < 1 for c in study.cells), name


SHORT = {name: replace(study, cells=tuple(c for c in study.cells if c.short)) for name, study in studies().items()}


@pytest.mark.parametrize("names", run.groups(SHORT), ids="+".join)
def test_short_studies_reach_their_rates(names: list[str]) -> None:
    """With the draws that there are: what a rate that is just good enough would show once in a thousand studies passes.

    Studies that share a sample are counted together, so that it is drawn once.
    """
    assert all(SHORT[name].cells for name in names), "no cell of a study is short; give `short` to some"
    found = rates([c for name in names for c in SHORT[name].cells], lambda c: c.short)
    for c, rate in found.items():
        assert rate.hits >= stats.binom.ppf(1e-3, rate.trials, c.least), (c.key, rate.words)
        assert rate.hits <= stats.binom.ppf(1 - 1e-3, rate.trials, c.most), (c.key, rate.words)

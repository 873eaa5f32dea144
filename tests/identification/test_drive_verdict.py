"""The verdict on a feed drive with dwells, models by axis and held-out runs: records made by hand with known truth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from elastogeo.drive import DriveRecord, DriveTest, TorqueModel
from elastogeo.errors import InputError
from elastogeo.identification.feed_drives import AxisDrive, identify_drives, models
from elastogeo.report import sentence_of
from studies.dwells import TRUTH, Dwells

FEW = tuple(c for c in models.CANDIDATES if c.name in ("plain", "smooth sign", "time shift", "averaged motion"))


@pytest.fixture(scope="module", autouse=True)
def few_candidates() -> Iterator[None]:
    """Four of the candidates: enough for what is asked here, and fast."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(models, "CANDIDATES", FEW)
        yield


def check(found: AxisDrive, name: str):
    return next(check for check in found.verdict if check.name == name)


def lagging(seed: int, delay: float = 0.0, smooth: float | None = None, axis: str = "X") -> DriveRecord:
    """Sines with a current that is recorded late; effort in A."""
    random = np.random.default_rng(seed)
    time = 0.004 * np.arange(800)
    waves = [(random.uniform(0.2, 3.0), random.uniform(0, 2 * np.pi), random.uniform(3, 10)) for _ in range(4)]

    def motion(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        v = sum(size * np.sin(2 * np.pi * f * at + phase) for f, phase, size in waves)
        a = sum(size * 2 * np.pi * f * np.cos(2 * np.pi * f * at + phase) for f, phase, size in waves)
        return v, a

    v, a = motion(time)
    late, rate = motion(time - delay)
    sense = np.sign(late) if smooth is None else np.tanh(late / smooth)
    effort = 0.01 * rate + 0.15 * late + 4 * sense + 0.5 + 0.2 * random.standard_normal(800)
    return DriveRecord(f"run {seed}", axis, time, np.cumsum(v) * 0.004, v, a, effort)


@pytest.mark.parametrize("noise", [0.0, 5e-4])
def test_a_record_with_dwells_says_what_was_left_out_and_a_hold_out_agrees(noise: float) -> None:
    (found,) = identify_drives(Dwells(noise=noise).test((1,), compare=False)).axes
    rest = check(found, "standstill left out")
    assert rest.passed
    assert 0.2 < rest.facts["share"] < 0.4
    assert rest.facts["used"] == 0.0
    assert rest.facts["left_out"] < 0.2 * rest.facts["kept"]
    assert "% of the samples are at standstill and were left out" in sentence_of(rest)
    coulomb = next(p for p in found.parameters if p.name == "coulomb")
    assert coulomb.estimate.value == pytest.approx(TRUTH["coulomb"], rel=0.02)


def test_a_least_speed_that_takes_the_dwells_is_called_so() -> None:
    (found,) = identify_drives(Dwells(noise=5e-4).test((1,), model=TorqueModel(least_speed=0.0), compare=False)).axes
    rest = check(found, "standstill left out")
    assert not rest.passed
    assert rest.facts["used"] > 0.2
    assert "Raise least_speed, or leave it out of the drive file" in sentence_of(rest)


def test_a_record_without_a_standstill_says_so() -> None:
    (found,) = identify_drives(DriveTest("sines", tuple(lagging(k) for k in range(3)), compare=False)).axes
    assert check(found, "standstill left out").passed
    assert sentence_of(check(found, "standstill left out")) == "No record shows a standstill."


def test_one_log_is_not_compared_and_the_verdict_says_so() -> None:
    (found,) = identify_drives(DriveTest("one", (lagging(1, 0.008),))).axes
    adequate = check(found, "friction model adequate")
    assert adequate.passed is None
    assert adequate.facts["runs"] == 1
    assert "one run alone cannot be left out; record another" in sentence_of(adequate)
    assert "compared with none" in sentence_of(adequate)


@pytest.fixture(scope="module")
def late() -> AxisDrive:
    test = DriveTest("late", tuple(lagging(k, 0.008) for k in range(5)), held_out=("run 4",))
    return identify_drives(test).axes[0]


def test_the_parameters_of_the_supported_model_come_first(late: AxisDrive) -> None:
    """8 ms of lag: the plain model's inertia is a quarter low."""
    assert "time shift" in late.supported
    assert late.model == late.supported
    inertia = next(p for p in late.parameters if p.name == "inertia")
    assert inertia.estimate.value == pytest.approx(0.01, rel=0.05)
    plain = next(p for p in late.models[0].parameters if p.name == "inertia")
    assert plain.estimate.value < 0.009
    assert check(late, "friction model adequate").passed
    assert check(late, "time shift distinct from averaging").passed


def test_every_model_is_scored_on_the_held_out_runs(late: AxisDrive) -> None:
    assert all([score.run for score in model.held_out] == ["run 4"] for model in late.models)
    scores = {model.name: model.held_out[0].rmse for model in late.models}
    assert scores["time shift"] < scores["plain"]


def test_every_axis_has_a_model_of_its_own_and_one_can_be_asked_for() -> None:
    records = (*(lagging(k) for k in range(4)), *(lagging(k, smooth=3.0, axis="Y") for k in range(4)))
    x, y = identify_drives(DriveTest("two", records)).axes
    assert x.model == "plain"
    assert "smooth sign" in y.model
    x, y = identify_drives(DriveTest("asked", records, models={"Y": "plain"})).axes
    assert y.model == "plain"
    adequate = check(y, "friction model adequate")
    assert not adequate.passed
    assert "smooth sign" in adequate.facts["supported"]
    assert "--model" in sentence_of(adequate)
    with pytest.raises(InputError, match="there is no model 'cubic'; there are: plain; smooth sign"):
        identify_drives(DriveTest("none", records, models={"": "cubic"}))
    with pytest.raises(InputError, match="a model of axis Z is asked for, but there are records of X, Y"):
        DriveTest("z", records, models={"Z": "plain"})


def test_a_model_that_loses_on_held_out_runs_is_not_supported() -> None:
    """Friction that sets in smoothly in all runs but the held-out one."""
    records = (*(lagging(k, smooth=3.0) for k in range(4)), replace(lagging(9), run="other"))
    (free,) = identify_drives(DriveTest("free", records[:4])).axes
    assert "smooth sign" in free.supported
    (found,) = identify_drives(DriveTest("held", records, held_out=("other",))).axes
    scores = {model.name: model.held_out[0].rmse for model in found.models}
    assert scores[free.supported] > scores["plain"], "the test has a bite"
    assert scores[found.supported] <= scores["plain"]

"""Lengths of a ball bar test referred to 20 °C (ISO 1), run by run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError
from elastogeo.identification import identify
from elastogeo.observe import BallBar, Circle, Expansion, Imperfection, LoadedBallBar, MachineTest
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
R = 150.0
STEEL, INVAR = 11.5e-6, 1.2e-6


def warm(test: MachineTest, **more: object) -> MachineTest:
    return replace(test, setup=replace(test.setup, **more))


@pytest.fixture
def test(make_test: MakeTest) -> MachineTest:
    return make_test("wFYXt", [36.0, 490.0, 742.0, 600.0], parameters=("E_XX1", "E_YY1", "C_XXX", "C_YYY"), readings=90)


def test_a_warm_machine_goes_too_far_and_a_warm_bar_reads_too_little(test: MachineTest) -> None:
    """At 24 °C steel scales make a circle of 150 mm 6.9 um larger; a bar as warm and of steel does not see it."""
    plain = test.observations()[0].reading
    machine = warm(test, machine_at=Expansion(24.0, STEEL)).observations()[0].reading
    assert_allclose(machine - plain, -R * STEEL * 4.0)
    bar = warm(test, bar_at=Expansion(24.0, STEEL)).observations()[0].reading
    assert_allclose(bar - plain, R * STEEL * 4.0)
    both = warm(test, machine_at=Expansion(24.0, STEEL), bar_at=Expansion(24.0, STEEL)).observations()[0].reading
    assert_allclose(both, plain, atol=1e-15)


def test_each_run_may_have_its_own_temperature(test: MachineTest) -> None:
    """Runs simulated warm, one after the other: with their temperatures the scale comes back, without it does not."""
    truth = {"E_XX1": 2e-5, "E_YY1": -1e-5, "C_XXX": 6e-5}
    temperatures = [20.5, 22.0, 23.5, 25.0]
    setup = replace(test.setup, machine_at=Expansion(20.0, STEEL), bar_at=Expansion(20.0, INVAR))
    runs = tuple(
        replace(run, machine_temperature=t, instrument_temperature=t) for run, t in zip(test.runs, temperatures, strict=True)
    )
    made = simulate(replace(test, setup=setup, runs=runs), truth, Imperfection(noise=1e-5), exact=False, seed=3)
    found = identify(made)
    assert found["E_XX1"].value == pytest.approx(2e-5, abs=2e-7)
    assert found["C_XXX"].value == pytest.approx(6e-5, rel=1e-3)
    cold = replace(
        made,
        setup=test.setup,
        runs=tuple(replace(run, machine_temperature=None, instrument_temperature=None) for run in made.runs),
    )
    assert abs(identify(cold)["E_XX1"].value - 2e-5) > 2e-6


def test_what_is_uncertain_in_it_is_in_the_budget(test: MachineTest) -> None:
    """0.3 K of steel on every length: 3.45 um/m on both scales, whatever the readings."""
    made = simulate(
        warm(test, machine_at=Expansion(24.0, STEEL, 0.3, 1e-6)), {"C_XXX": 6e-5}, Imperfection(noise=1e-5), seed=1
    )
    budget = identify(made).budget
    lines = {line.label: line.contribution for line in budget.lines[budget.labels.index("E_XX1")]}
    assert lines["temperature of the machine"] == pytest.approx(0.3 * STEEL, rel=1e-6)
    assert lines["expansion of the machine"] == pytest.approx(4.0 * 1e-6, rel=1e-6)


def test_an_ordinary_bar_is_corrected_alike(make_test: MakeTest) -> None:
    angle = np.linspace(0, 6, 50)
    loaded = make_test("wFYXt", [100.0], angle=angle, circle=Circle(R))
    run = replace(loaded.runs[0], force=None)
    bar = BallBar(Circle(R), 2000 / 60, machine_at=Expansion(24.0, STEEL))
    assert_allclose(bar.observe(loaded.machine, run).correction, R * STEEL * 4.0)


def test_a_temperature_without_an_expansion_is_refused(test: MachineTest) -> None:
    assert isinstance(test.setup, LoadedBallBar)
    wrong = replace(test, runs=(replace(test.runs[0], machine_temperature=24.0), *test.runs[1:]))
    with pytest.raises(InputError, match="machine_at"):
        wrong.observations()
    with pytest.raises(InputError, match="kelvin"):
        Expansion(297.0, STEEL)

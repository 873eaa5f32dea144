"""What a campaign says of functions of the parameters: as of the parameters, and nothing where no test sees them."""

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.identification import identify
from elastogeo.prediction import Knowledge, knowledge_of, parameter_scales, virtual_observations
from elastogeo.sources import catalogue
from tests.prediction.circles import MIDDLE, circles, machine


@pytest.fixture(scope="module")
def known() -> Knowledge:
    return knowledge_of(identify(circles(MIDDLE, gauge=0.01)))


def test_of_a_parameter_it_says_what_the_result_says() -> None:
    result = identify(circles(MIDDLE, gauge=0.01))
    known = knowledge_of(result)
    found = known.predict(np.array([result.confounding.combinations[k] for k in range(len(result.parameters))]))
    assert found.supported.all()
    for k, parameter in enumerate(result.parameters):
        assert found.value[k] == pytest.approx(parameter.value, rel=1e-8)
        assert found.standard_uncertainty[k] == pytest.approx(parameter.standard_uncertainty, rel=1e-6)
        assert found.degrees_of_freedom[k] == pytest.approx(parameter.degrees_of_freedom, rel=1e-6)
        assert found.interval[k] == pytest.approx(parameter.interval, rel=1e-5, abs=1e-9)


def test_of_what_no_test_sees_it_says_nothing(known: Knowledge) -> None:
    names = [source.name for source in known.sources]
    moment = np.eye(len(names))[[names.index("C_AAZ"), names.index("C_XXX")]]
    found = known.predict(moment)
    assert not found.supported.any()
    for numbers in (found.value, found.standard_uncertainty, found.degrees_of_freedom, found.expanded, found.interval):
        assert np.isnan(numbers).all()
    assert (found.unsupported > 0.05).all()
    assert (found.prior_share == 0).all()


def test_with_a_prior_it_says_how_much_is_prior(known: Knowledge) -> None:
    names = [source.name for source in known.sources]
    functional = np.zeros((3, len(names)))
    functional[0, [names.index("C_XXX"), names.index("C_XXY")]] = 1.0, -1.0
    functional[1, names.index("C_XXX")] = 1.0
    functional[2] = known.combinations[0]
    found = known.predict(functional, prior=True)
    # C_XXX and C_XXY have the same column, so that their difference is never seen: what is said of it is the prior.
    assert found.unsupported[0] == pytest.approx(1.0)
    assert found.value[0] == pytest.approx(0.0, abs=1e-16)
    assert found.standard_uncertainty[0] == pytest.approx(np.sqrt(2) * 5e-6)
    assert found.prior_share[0] == pytest.approx(1.0)
    assert found.degrees_of_freedom[0] == np.inf
    # Half of C_XXX at least is that difference.
    assert found.standard_uncertainty[1] > 5e-6 / np.sqrt(2)
    assert 0.5 < found.prior_share[1] < 1.0
    assert found.prior_share[2] == 0.0
    assert found.supported.tolist() == [False, False, True]


def test_units_do_not_decide(known: Knowledge) -> None:
    """Parameters in other units: micrometres, kilonewtons, degrees, each parameter by a factor of its own."""
    random = np.random.default_rng(3)
    factor = 10.0 ** random.integers(-6, 7, len(known.sources))
    found, solution = known.confounding, known.solution
    at = [found.labels.index(label) for label in solution.labels]
    assert solution.scatter is not None
    other = replace(
        known,
        scales=known.scales * factor,
        confounding=replace(found, combinations=found.combinations * factor[at][:, np.newaxis] / factor),
        solution=replace(
            solution,
            values=solution.values * factor[at],
            scatter=replace(solution.scatter, norms=solution.scatter.norms / factor[at]),
        ),
        budget=replace(known.budget, systematic=known.budget.systematic * factor[at]),
    )
    functional = np.vstack([found.combinations, random.normal(size=(20, len(factor))) * (1 / known.scales)])
    one, two = known.predict(functional, prior=True), other.predict(functional / factor, prior=True)
    assert (one.supported == two.supported).all()
    assert one.supported.any()
    assert not one.supported.all()
    assert two.unsupported == pytest.approx(one.unsupported, abs=1e-9)
    assert two.value == pytest.approx(one.value, rel=1e-6)
    assert two.standard_uncertainty == pytest.approx(one.standard_uncertainty, rel=1e-6)
    assert two.degrees_of_freedom == pytest.approx(one.degrees_of_freedom, rel=1e-6)


def test_too_few_runs_give_values_without_uncertainty() -> None:
    result = identify(circles(MIDDLE[:1], repeats=1))
    assert not result.by_run
    found = knowledge_of(result).predict(result.confounding.combinations)
    assert found.supported.all()
    assert np.isfinite(found.value).all()
    assert np.isnan(found.expanded).all()


def test_it_names_what_was_not_asked_for() -> None:
    one = circles(MIDDLE, reciprocal=True)
    assert knowledge_of(identify(one)).rigid == ()
    partly = knowledge_of(identify(one, parameters=["C_??X", "C_XXY"]))
    assert len(partly.rigid) == 35 + 36
    assert all(name.endswith(("Y", "Z")) for name in partly.rigid)


def test_nothing_of_a_set_up_is_asked() -> None:
    known = knowledge_of(identify(circles(MIDDLE, gauge=0.01), parameters=["C_???", "E_Xt0", "E_Yt0"]))
    rows = known.rows(virtual_observations(known.machine, np.zeros((1, 3)), np.eye(6)[0], np.zeros(6)))
    assert any(source.of_test for source in known.sources)
    assert not rows.any()


@pytest.mark.parametrize("name", ["C_XXX", "C_AXX", "C_XAX", "C_AAX", "CF1_XXX", "CF2_CCY", "E_XX1", "E_AX2", "T_X1"])
def test_scales_are_of_the_unit(name: str) -> None:
    """Each gives about 5 um: at 1000 N, at 300 mm, at 100 mm/s."""
    source = catalogue(machine())[name]
    force, lever = 1000.0, 300.0
    size = parameter_scales([source])[0]
    size *= lever if source.component >= 3 else 1.0
    size *= force * (lever if (source.load or 0) >= 3 else 1.0) if source.elastic else 1.0
    size *= force ** (source.force_degree - 1) if source.elastic else 1.0
    size *= {"E_XX1": lever, "E_AX2": lever**2, "T_X1": 100.0}.get(name, 1.0)
    assert size == pytest.approx(5e-3)


def test_every_unit_has_a_size() -> None:
    sources = catalogue(machine()).values()
    assert (parameter_scales(list(sources)) > 0).all()

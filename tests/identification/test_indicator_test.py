"""The indicator test of ball and roller: Tables 6.5 and 6.6 from dial readings, its uncertainty, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo import calibrate, read_run
from elastogeo.drive import setup_compliance, with_rig
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification import IndicatorTest
from elastogeo.report import sentence_of
from studies.indicator_samples import ENGAGEMENT, MACHINE, Dials

EXAMPLE = Path(__file__).parents[2] / "examples" / "indicator-test" / "dials.csv"
UM = 1000.0


@pytest.fixture(scope="module")
def thesis() -> IndicatorTest:
    return calibrate(read_run(EXAMPLE).columns, resolution=1e-3)


def stiffness(found: IndicatorTest, spring: str, kind: str = "secants") -> list[float]:
    """In N/um."""
    return [1 / (one.value * UM) for one in getattr(found.springs[spring], kind)]


def test_table_6_5_the_machine_is_what_the_dials_leave_of_the_command(thesis: IndicatorTest) -> None:
    assert_allclose(thesis.springs["set-up"].deflection * UM, [10, 26, 46, 66, 89])
    assert_allclose(thesis.springs["machine"].deflection * UM, [30, 54, 74, 94, 111])
    assert_allclose(100 * thesis.share[-1], 55.5)


def test_table_6_6_secant_stiffness_of_every_spring(thesis: IndicatorTest) -> None:
    """As printed; 16.3 and 15.8 at 160 um were cut off, and 2 um of the ball make 523.5 N/um from 1047 N, not 1042.8."""
    assert_allclose(stiffness(thesis, "roller"), [18.9, 17.3, 17.0, 16.3, 15.0], atol=0.05)
    assert_allclose(stiffness(thesis, "set-up"), [18.9, 17.3, 16.3, 15.8, 14.5], atol=0.05)
    assert_allclose(stiffness(thesis, "machine"), [6.3, 8.3, 10.1, 11.1, 11.6], atol=0.05)
    ball = [one.value for one in thesis.springs["ball"].secants]
    assert ball[:2] == [0, 0], "infinite: the ball does not move"
    assert_allclose(1 / (np.array(ball[2:]) * UM), [375, 523.5, 430.3], rtol=0.005)


def test_the_machine_does_not_stiffen_as_its_secants_say(thesis: IndicatorTest) -> None:
    """Audit E2: the increments of Tables 6.5 and 6.6 are 10.9, 15.0, 14.7, 14.6 N/um."""
    assert_allclose(stiffness(thesis, "machine", "increments"), [10.9, 15.0, 14.7, 14.6], atol=0.06)
    check = thesis.verdict[0]
    assert (check.name, check.passed) == ("machine's secants free of an offset", False)
    # 54, 74, 94, 111 um lie on a line of 14.7 N/um that begins at 23 um
    assert check.facts["offset_mm"] * UM == pytest.approx(23.4, abs=0.2)
    assert check.facts["straight_from_N"] == pytest.approx(449.8)
    assert "the increments (10.9, 15, 14.6, 14.6 N/µm) are free of it and show the machine" in sentence_of(check)


def test_the_set_up_softens_so_that_it_takes_a_table(thesis: IndicatorTest) -> None:
    check = thesis.verdict[1]
    assert (check.name, check.passed) == ("set-up's compliance constant", False)
    assert thesis.setup.over == "engagement"
    # Eq. 6.5: what is left of the command is the machine of Table 6.6
    for at, force, printed in zip(thesis.engagement, thesis.force, [6.3, 8.3, 10.1, 11.1, 11.6], strict=True):
        left = at / force - float(setup_compliance(thesis.setup, at, force))
        assert 1 / (left * UM) == pytest.approx(printed, abs=0.05)


def test_compliances_in_series_add_with_the_rig_too(thesis: IndicatorTest) -> None:
    """Eqs. 6.3 and 6.16; the thesis predicts 0.5325 um/N at 40 um with a rig of 2.65 N/um, from 6.4 N/um."""
    springs = thesis.springs
    setup, machine = ([one.value for one in springs[name].secants] for name in ("set-up", "machine"))
    assert_allclose(np.add(setup, machine), thesis.engagement / thesis.force)
    predicted = with_rig(machine[0] * UM, 1 / 2.65)
    assert float(predicted) == pytest.approx(0.5325, rel=0.01)


def test_dials_that_were_read_once_say_so(thesis: IndicatorTest) -> None:
    check = thesis.verdict[2]
    assert (check.name, check.passed) == ("readings repeated", None)
    assert sentence_of(check).startswith(
        "Not tested: each engagement was read once, so no interval holds what readings scatter;"
    )
    assert not thesis.repeated


def test_without_a_resolution_nothing_is_known_and_nothing_is_tested() -> None:
    found = calibrate(read_run(EXAMPLE).columns)
    assert {one.standard_uncertainty for spring in found.springs.values() for one in spring.secants} == {0.0}
    assert [check.passed for check in found.verdict] == [False, None, None]
    assert sentence_of(found.verdict[2]).endswith("what readings scatter. Press three times to each.")


@pytest.mark.parametrize(("scatter", "repeats"), [(0.0, 1), (1e-3, 3)])
def test_the_intervals_hold_the_springs(scatter: float, repeats: int) -> None:
    """Rounded to 1 um, which is an error of its own for every ball."""
    hits, trials = {"machine": 0, "ball": 0, "increment": 0}, 150
    for seed, ball in enumerate(1 / np.random.default_rng(7).uniform(300e3, 600e3, trials)):
        found = Dials(scatter=scatter, repeats=repeats, ball=float(ball)).draw((seed,))
        for name, true in (("machine", MACHINE), ("ball", ball)):
            low, high = found.springs[name].secants[-1].interval()
            hits[name] += low <= true <= high
        low, high = found.springs["machine"].increments[1].interval()
        hits["increment"] += low <= MACHINE <= high
    least = stats.binom.ppf(0.001, trials, 0.95)
    assert min(hits.values()) >= least, hits


def test_scales_of_dial_and_force_stretch_what_they_measure(thesis: IndicatorTest) -> None:
    columns = read_run(EXAMPLE).columns
    by_force = calibrate(columns, load_cell=0.02).springs["machine"].secants[-1]
    assert by_force.standard_uncertainty == pytest.approx(0.02 * by_force.value)
    # a dial that reads 1 % too much takes 1 % of the set-up's 89 um from the machine's 111 um
    by_dial = calibrate(columns, dial=0.01).springs["machine"].secants[-1]
    assert by_dial.standard_uncertainty == pytest.approx(0.01 * 0.089 / thesis.force[-1])


def test_the_order_of_the_readings_does_not_matter_and_repeats_are_means(thesis: IndicatorTest) -> None:
    columns = read_run(EXAMPLE).columns
    twice = {name: np.concatenate([values, values[::-1]]) for name, values in columns.items()}
    found = calibrate(twice, resolution=1e-3)
    assert found.readings == 10
    assert_allclose(stiffness(found, "machine"), stiffness(thesis, "machine"))
    assert found.verdict[2].passed


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        (
            {"roller": None},
            InputError,
            "hold engagement, force, ball; they need engagement_um, force_N, ball_um and",
        ),
        (
            {"force": [0.0, 450, 750, 1043, 1290]},
            InputError,
            "the force of reading 1 is 0; set the dials to zero before",
        ),
        ({"ball": [0.0, np.nan, 0, 0, 0]}, InputError, "the ball of reading 2 is nan; remove the reading"),
        ({"roller": [10.0, 26, 44, 64, 86]}, InputError, "at 200 um the dials show 86003 um of ball and roller, as much as"),
        ({"force": [1.0, 2]}, InputError, "every engagement needs one force, ball and roller"),
        ({"engagement": [0.2] * 5}, UnsupportedError, "all readings of the indicator test are at one engagement"),
    ],
)
def test_what_is_no_indicator_test_is_refused(change, error, message: str) -> None:
    columns = dict(read_run(EXAMPLE).columns)
    for name, values in change.items():
        columns.pop(name)
        if values is not None:
            columns[name] = np.array(values)
    with pytest.raises(error, match=message):
        calibrate(columns)


def test_an_indicator_test_stands_alone() -> None:
    columns = read_run(EXAMPLE).columns
    with pytest.raises(InputError, match="one of them of an indicator test, which stands alone"):
        calibrate(columns, columns)


def test_a_ball_roller_test_takes_what_was_found(thesis: IndicatorTest) -> None:
    assert_allclose(thesis.setup.engagement, ENGAGEMENT)
    worst = max(one.standard_uncertainty for one in thesis.springs["set-up"].secants)
    assert thesis.setup.standard_uncertainty == worst

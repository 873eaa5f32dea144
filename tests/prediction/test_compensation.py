"""Compensation: what is found of known errors, what of it is written, and what is left, against the truth."""

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.formats import read_back
from elastogeo.machine import parse_topology
from elastogeo.machine.machine import Machine
from elastogeo.observe import MachineTest, Positioning, Run
from tests.prediction.positioned_axes import TARGETS, axis_test

BACKLASH = 0.006


def screw(position, sense):
    """A screw that is 40 um/m long, bends by 5 um, and falls short by half of its backlash."""
    return 4e-5 * position + 0.005 * np.sin(position / 60.0) - BACKLASH / 2 * sense


def compensated(error=screw, zero_at=None, control="linuxcnc", settings=None, **given):
    return eg.compensate(
        eg.evaluate_positioning(axis_test(error, **given)), control=control, settings=settings, zero_at=zero_at
    )


def true_residual(found, error, name="E_XX"):
    """What is truly left at the targets, shape (k, 2): the true error from its zero, less what the control compensates."""
    one = found[name]
    zero = np.array([one.found.zero_at])
    at_zero = (error(zero, np.ones(1)) + error(zero, -np.ones(1)))[0] / 2
    place = one.error.position
    true = np.column_stack([error(place, np.full(len(place), sense)) for sense in (1.0, -1.0)]) - at_zero
    return true - one.written.at(place)


def checks(found):
    return {check.name: check.passed for check in found.verdict}


def test_without_noise_the_table_is_the_error_and_nothing_is_left():
    found = compensated(noise=0.0, zero_at={"X": -201.3})
    one = found["E_XX"]
    true = np.column_stack([screw(TARGETS, 1.0), screw(TARGETS, -1.0)]) - screw(TARGETS[:1], 0.0)
    assert one.error.value == pytest.approx(true, abs=1e-12)
    assert one.error.position == pytest.approx(TARGETS)
    assert true_residual(found, screw) == pytest.approx(0.0, abs=1e-6)  # the file has six decimals
    assert one.before[0] == pytest.approx(np.abs(true).max())


@pytest.mark.parametrize("zero", [0.6, -201.3, 17.0])
def test_the_table_is_zero_where_it_is_to_be(zero):
    one = compensated(zero_at={"X": zero})["E_XX"]
    assert one.found.zero_at == zero
    assert one.error.at(np.array([zero])).mean() == pytest.approx(0.0, abs=1e-12)


def test_a_zero_outside_the_targets_is_refused():
    with pytest.raises(InputError, match=r"the error of X is to be zero at 500, and was read from -201.3 to 199.5 only"):
        compensated(zero_at={"X": 500.0})


@pytest.mark.nightly
def test_what_is_left_lies_in_its_interval_as_often_as_it_says():
    """Cycles whose zero and slope wander, and a sensor whose scale is off by its uncertainty: 95 % of what is truly left
    after compensation lies within U of what is predicted (200 tests; points of one test are not independent)."""
    random = np.random.default_rng(7)
    inside = []
    for seed in range(200):
        off = random.normal(0, 1e-5)
        found = compensated(lambda p, s: screw(p, s) + off * p, seed=seed, wander=5e-6, scale=1e-5)  # noqa: B023
        one = found["E_XX"]
        left = true_residual(found, screw) - one.residual.value
        ends = np.abs(left[[0, -1]]) <= one.residual.uncertainty[[0, -1]]
        inside.append(ends.mean())
    assert 0.92 < np.mean(inside) < 0.98


def test_a_linear_error_and_a_uniform_backlash_by_hand():
    """Each cycle counts from its own reading at zero; t(0.975, 4) = 2.776 of the standard deviation of the mean."""
    test = axis_test(screw, noise=5e-4, seed=3)
    found = eg.compensate(eg.evaluate_positioning(test), zero_at={"X": 51.4})["E_XX"]
    columns = test.runs[0].columns
    read = columns["deviation"].reshape(5, 2, len(TARGETS))
    read = read - read[:, :, 5].mean(axis=1)[:, np.newaxis, np.newaxis]
    assert found.error.value == pytest.approx(read.mean(axis=0).T)
    assert found.error.uncertainty == pytest.approx(2.7764451 * read.std(axis=0, ddof=1).T / np.sqrt(5))


def test_a_stated_influence_grows_from_the_zero():
    found = compensated(noise=0.0, scale=1e-5, zero_at={"X": 0.6})["E_XX"]
    expected = 1.959964 * 1e-5 * np.abs(TARGETS - 0.6)
    assert found.error.uncertainty == pytest.approx(np.column_stack([expected, expected]), abs=3e-7)  # and of what is read


def test_what_is_not_greater_than_its_uncertainty_is_named_and_not_written():
    """A backlash of 0.1 um under 2 um of noise: both columns are the same."""
    found = compensated(lambda p, s: 4e-5 * p - 5e-5 * s, noise=2e-3)
    assert found["E_XX"].written.one_sided
    assert [(out.names, out.reason) for out in found.left_out] == [(("B_XX",), "uncertainty")]
    assert checks(found)["greater than its uncertainty"] is False


def test_backlash_alone_is_written_alone():
    found = compensated(lambda p, s: -0.005 * s + 0 * p, noise=1e-3)
    assert found["E_XX"].written.value == pytest.approx(found["E_XX"].found.parts[1].value, abs=1e-6)
    assert found["E_XX"].found.parts[1].value[:, 0] == pytest.approx(-0.005, abs=2e-3)
    assert [out.names for out in found.left_out] == [("E_XX",)]


def test_one_direction_shows_no_backlash_and_one_cycle_no_uncertainty():
    found = compensated(sides=(1.0,))
    assert found["E_XX"].written.one_sided
    assert [(out.names, out.reason) for out in found.left_out] == [(("B_XX",), "not determined")]
    once = compensated(cycles=1)
    assert once.files == {}
    assert {out.reason for out in once.left_out} == {"no interval"}
    assert checks(once)["something to compensate"] is False
    with pytest.raises(UnsupportedError, match="there is nothing to write: no error was found that is greater"):
        once.write("anywhere")


def test_a_perfect_axis_is_left_alone():
    found = compensated(lambda p, s: 0 * p * s, noise=1e-3, seed=5)
    assert found.files == {}
    assert found.errors == ()


def test_straightness_is_across_and_its_sign_follows_the_sensor():
    def bow(p, s):
        return 1e-6 * p**2 - 0.002 * s

    ahead, against = (
        eg.evaluate_positioning(axis_test(error, direction=direction))
        for error, direction in ((bow, (0, 1, 0)), (lambda p, s: -bow(p, s), (0, -1, 0)))
    )
    one, other = (eg.compensate(found, control="csv")["E_YX"] for found in (ahead, against))
    assert one.error.component == "Y"
    assert one.error.value == pytest.approx(other.error.value, abs=1e-3)
    assert one.error.value[0, 0] > 0.02
    none = eg.compensate(ahead, control="linuxcnc")
    assert none.left_out[0].why == "screw compensation corrects an axis along itself only"
    assert checks(none)["within the control's means"] is False


def test_a_skew_sensor_is_refused():
    test = axis_test(lambda p, s: 1e-6 * p**2 + 0 * s, direction=(0, 1, 1))
    with pytest.raises(InputError, match="its sensor reads askew, along"):
        eg.compensate(eg.evaluate_positioning(test), control="csv")


def test_two_axes_go_into_one_compensation_and_one_error_twice_is_refused():
    both = [eg.evaluate_positioning(axis_test(screw, axis=axis)) for axis in "XY"]
    found = eg.compensate(*both)
    assert set(found.files) == {"x.comp", "y.comp", "joints.ini"}
    with pytest.raises(InputError, match="two results are of E_XX; give the one that is to be compensated"):
        eg.compensate(both[0], both[0])
    with pytest.raises(InputError, match="there is nothing to compensate; give one result or more"):
        eg.compensate()


def test_the_files_hold_what_the_result_says(tmp_path):
    found = compensated()
    for path in found.write(tmp_path / "new"):
        assert path.read_bytes() == found.files[path.name]
    assert read_back(found.files, "linuxcnc", found.settings)[0] == found["E_XX"].written


def test_the_one_point_check_says_what_a_wrong_sign_would_show():
    found = compensated(noise=0.0)
    facts = next(check for check in found.verdict if check.name == "sign sure").facts
    assert facts["after"] == pytest.approx(0.0, abs=1e-6)
    assert facts["wrong"] == pytest.approx(2 * facts["before"], abs=1e-5)


def test_a_control_with_one_curve_leaves_the_reversal_and_says_so():
    """The volumetric file has no direction: half of the backlash stays on either side, and is not blamed on the points."""
    found = compensated(control="isg", noise=1e-5)
    assert found["E_XX"].written.one_sided
    assert [(out.names, out.reason, out.why) for out in found.left_out] == [
        (("B_XX",), "control", "it has one curve for both directions here")
    ]
    assert np.abs(true_residual(found, screw)) == pytest.approx(BACKLASH / 2, abs=2e-4)
    assert np.abs(found["E_XX"].residual.value) == pytest.approx(BACKLASH / 2, abs=2e-4)
    assert checks(found)["points close enough"]
    assert checks(found)["within the control's means"] is False


def test_a_rotary_axis_is_compensated_in_seconds_of_arc():
    """A turn of C by an angular sensor: 4 arcsec of eccentric graduation, read at nine targets."""
    random = np.random.default_rng(0)
    targets = np.deg2rad([0.0, 47, 92, 133, 181, 224, 272, 315, 358])
    columns = {name: [] for name in ("cycle", "direction", "target", "deviation")}
    for cycle in range(1, 6):
        for sense in (1.0, -1.0):
            columns["cycle"].append(np.full(9, float(cycle)))
            columns["direction"].append(np.full(9, sense))
            columns["target"].append(targets)
            columns["deviation"].append(2e-5 * np.sin(targets) - 1e-5 * sense + random.normal(0, 5e-7, 9))
    run = Run("1", {name: np.concatenate(parts) for name, parts in columns.items()})
    test = MachineTest("C", Machine("m", parse_topology("wCFXYZt")), Positioning("C"), (run,))
    found = eg.compensate(eg.evaluate_positioning(test))
    one = found["E_CC"]
    assert one.error.is_angular
    assert one.before[0] == pytest.approx(3e-5, rel=0.1)
    assert one.bound < 2e-6
    rows = found.files["c.comp"].decode().splitlines()
    place, forth, back = map(float, rows[2].split())
    assert place == pytest.approx(92.0)
    assert [forth - place, back - place] == pytest.approx(np.rad2deg([1e-5, 3e-5]), abs=1e-4)

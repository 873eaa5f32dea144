"""Error tables from identified parameters: their sign against raw readings, what is left out, what is left in the volume."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import BallBar, Circle, MachineTest, Question, Run
from elastogeo.prediction import functionals, virtual_observations
from elastogeo.sources import select_sources
from tests.prediction.positioned_axes import TARGETS, axis_test

EXAMPLES = Path(__file__).parents[2] / "examples"
GEOMETRY = {"E_XX1": 3e-5, "E_YX2": 8e-8, "E_XY2": -6e-8, "E_C(0X)Y": 4e-5, "B_XX": 0.006, "B_YX": 0.003, "E_YY1": -2e-5}


def circle_test(asked=tuple(GEOMETRY), noise=1e-4, radius=150.0, repeats=3, truth=GEOMETRY, centre=None):
    """An unloaded ball bar whose readings are the columns of the truth, forth and back."""
    random = np.random.default_rng(2)
    topology = parse_topology("wFXYZt")
    machine = Machine("machine", topology, tuple(Joint(axis) for axis in topology.axes))
    angle = np.linspace(0, 2 * np.pi, 360, endpoint=False)
    runs = tuple(
        Run(f"{sense} {k}", {"angle": angle, "radial": np.zeros(len(angle))}, sense=sense, repeat=k)
        for sense in (1, -1)
        for k in range(1, repeats + 1)
    )
    blank = MachineTest(
        "circle", machine, BallBar(Circle(radius, centre=centre or {}), feed=1000 / 60), runs, Question(tuple(asked))
    )
    sources = select_sources(machine, list(truth))
    read = []
    for run, seen in zip(runs, blank.observations(), strict=True):
        true = functionals(sources, machine, seen) @ list(truth.values())
        read.append(replace(run, columns={"angle": angle, "radial": true + random.normal(0, noise, len(angle))}))
    return replace(blank, runs=tuple(read))


@pytest.mark.parametrize("topology", ["wFXYZt", "wXFYZt"])
def test_the_sign_is_that_of_the_readings_whichever_side_the_axis_carries(topology):
    """The same positioning test by its targets and by its parameters."""
    test = axis_test(lambda p, s: 3e-5 * p + 4e-8 * p**2 - 0.003 * s, noise=1e-7, topology=topology)
    by_target = eg.compensate(eg.evaluate_positioning(test), zero_at={"X": 0.6})["E_XX"]
    by_parameter = eg.compensate(eg.identify(test), zero_at={"X": 0.6})["E_XX"]
    at = by_target.error.position
    assert by_parameter.error.at(at) == pytest.approx(by_target.error.value, abs=2e-6)  # 41 points of a parabola
    assert by_parameter.written.at(at) == pytest.approx(by_target.error.value, abs=3e-6)


def test_a_circle_gives_straightness_squareness_and_play_of_its_plane():
    found = eg.compensate(eg.identify(circle_test()), control="csv")
    one = found["E_XY"]
    y = one.error.position
    assert y[[0, -1]] == pytest.approx([-150.0, 150.0], abs=1e-6)
    expected = GEOMETRY["E_XY2"] * y**2 - GEOMETRY["E_C(0X)Y"] * y
    assert one.error.value[:, 0] == pytest.approx(expected, abs=2e-4)
    assert np.abs(one.error.value[:, 0] - expected).max() < 1.5 * one.error.uncertainty.max()
    play = found["E_YX"].error.value
    assert play[:, 0] - play[:, 1] == pytest.approx(-GEOMETRY["B_YX"], abs=1e-4)
    assert found["E_XX"].error.value[-1].mean() == pytest.approx(150 * GEOMETRY["E_XX1"], abs=2e-4)
    assert not found.left_out


def test_what_is_confounded_is_named_and_everything_else_written():
    """A bar whose length is asked for too: the scales of X and Y are known in their difference only."""
    found = eg.compensate(eg.identify(circle_test(asked=(*GEOMETRY, "E_R0"))), control="csv")
    left = {name: out.reason for out in found.left_out for name in out.names}
    assert left == {"E_XX1": "not determined", "E_YY1": "not determined"}
    assert found["E_XX"].error.value[:, 0] == pytest.approx(-GEOMETRY["B_XX"] / 2, abs=1e-4)  # its play alone
    assert found["E_YX"].error.value[-1].mean() == pytest.approx(GEOMETRY["E_YX2"] * 150**2, abs=3e-4)
    text = found.files["errors.csv"].decode()
    assert "E_YY," not in text


def test_compliance_is_in_no_table():
    test = eg.read_campaign([EXAMPLES / "hermle-c50-ldbb"])
    result = eg.identify(test)
    found = eg.compensate(result, control="csv")
    used = {name for one in found.errors for part in one.found.parts for name in part.names}
    assert used
    assert not any(name.startswith("C_") for name in used)
    assert used | {name for out in found.left_out for name in out.names} <= set(result.confounding.labels)


def test_where_targets_and_parameters_say_an_error_the_targets_count():
    """A positioning test of X beside a circle: E_XX by its targets, all else by the circle's parameters."""
    test = replace(axis_test(lambda p, s: 3e-5 * p - 0.003 * s, topology="wFXYZt"), machine=circle_test().machine)
    both = eg.compensate(eg.identify(circle_test()), eg.evaluate_positioning(test), control="csv")
    assert both["E_XX"].error.position == pytest.approx(TARGETS)
    assert both["E_YX"].error.position[[0, -1]] == pytest.approx([-150.0, 150.0], abs=1e-6)
    with pytest.raises(eg.InputError, match="two results are of E_XX; give the one"):
        eg.compensate(eg.identify(test), eg.identify(test))


def test_what_two_axes_cause_together_stays_and_is_said():
    """An angle of X turns what Y moves: with E_CX1 the deviation along x grows with x times y, which no table of X or of Y
    holds. Circles at two places tell it; it is said of the volume, and is exactly that product. One circle does not."""
    truth = {**GEOMETRY, "E_CX1": 2e-7}
    places = {"left": {"X": -100.0}, "right": {"X": 100.0, "Y": 80.0}, "near": {"Y": -90.0}}
    tests = {
        name: circle_test(truth=truth, asked=tuple(truth), noise=1e-6, centre=centre) for name, centre in places.items()
    }
    volume = eg.compensate(eg.identify(tests), control="csv").volume
    assert volume.components == ("X", "Y")
    assert volume.axes == ("X", "Y")
    assert volume.before > 0.006
    assert volume.after == pytest.approx(2e-7 * 250 * 240, rel=0.05)  # the farthest pose from the zero in x, and in y
    assert volume.bound > volume.after
    assert eg.compensate(eg.identify(tests["left"]), control="csv").volume is None
    plain = eg.compensate(eg.identify(circle_test()), control="csv").volume
    assert plain.after < 0.02 * plain.before


def test_what_the_tables_leave_over_the_plane_is_predicted_by_the_same_parameters():
    """All tables together, as a control adds them, against the deviation at poses off the axes: what is left is what no
    table of one axis holds; here, without angular errors, the intervals of the tables alone."""
    found = eg.compensate(eg.identify(circle_test()), control="csv")
    machine = circle_test().machine
    sources = select_sources(machine, [name for name in GEOMETRY if name.startswith("E")])
    values = [GEOMETRY[source.name] for source in sources]
    poses = np.random.default_rng(5).uniform(-150, 150, (50, 3)) * [1, 1, 0]
    for component in "XY":
        direction = np.zeros((1, 6))
        direction[0, "XYZ".index(component)] = 1.0
        true, at_zero = (
            functionals(sources, machine, virtual_observations(machine, at, direction, np.zeros((1, 6)))) @ values
            for at in (poses, np.zeros((1, 3)))
        )
        made_good, doubt = 0.0, 0.0
        for axis, place in (("X", poses[:, 0]), ("Y", poses[:, 1])):
            one = found[f"E_{component}{axis}"]
            made_good = made_good + one.written.deviation(place, np.zeros(50))
            doubt = doubt + one.error.uncertainty_at(place).max(axis=1)
        assert np.abs(true - at_zero - made_good).max() < 0.002 * np.abs(true).max() + doubt.max()

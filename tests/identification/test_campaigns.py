"""Many tests of one machine as one system: a joint estimate is that of all rows; one test is a campaign of one."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from elastogeo.cli.app import application
from elastogeo.errors import InputError
from elastogeo.estimate import solve
from elastogeo.formats import read_campaign, read_machine
from elastogeo.identification import (
    Identification,
    confounding_of,
    effects_of,
    explain,
    identify,
    merged,
    systems_of,
    uncertainty_budget,
)
from elastogeo.machine import About, Machine, parse_topology
from elastogeo.observe import (
    BallBar,
    Campaign,
    Circle,
    Imperfection,
    KnownInfluence,
    LoadedBallBar,
    MachineTest,
    Question,
    Run,
    campaign_of,
)
from elastogeo.sources import design_rows, simulate

TRUTH = {"C_XXX": 5e-5, "C_YYY": 4e-5, "C_ZZZ": 3e-5, "E_XX1": 2e-5, "E_YY1": -1e-5, "E_ZZ1": 1e-5}
FORCES = (100.0, 400.0, 700.0)


def machine_of(topology: str, tool: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Machine:
    return Machine(topology, parse_topology(topology), tool=tool)


def circle_test(plane: str, seed: int, noise: float = 1e-4, topology: str = "wFYXZt") -> MachineTest:
    """A loaded circle with the default question of its plane, two runs at each of three forces."""
    angle = 2 * np.pi * np.arange(60) / 60
    columns = {"angle": angle, "radial": np.zeros(60)}
    runs = tuple(Run(f"{force:g} N, {k}", columns, force=force, repeat=k) for force in FORCES for k in (1, 2))
    machine = machine_of(topology, (0.0, 0.0, -200.0))
    blank = MachineTest(plane, machine, LoadedBallBar(Circle(150.0, plane=plane), feed=2000 / 60), runs)
    return simulate(blank, TRUTH, Imperfection(noise=noise), seed)


@pytest.fixture(scope="module")
def three() -> dict[str, MachineTest]:
    return {plane.lower(): circle_test(plane, seed, 1e-4 * seed) for seed, plane in enumerate(("XY", "YZ", "ZX"), 1)}


@pytest.fixture(scope="module")
def together(three: dict[str, MachineTest]) -> Identification:
    return identify(three)


def dense(tests: dict[str, MachineTest], result: Identification) -> np.ndarray[Any, Any]:
    """The joint estimate by one dense solve of all rows, each run with columns of its own for where its circle lies."""
    scatter = {part.name: part.scatter or 1.0 for part in result.tests}
    sources = [s for s in systems_of(tests).sources if s.name in result]
    blocks, own = [], []
    for name, test in tests.items():
        offsets = systems_of(replace(test, question=Question(("E_[XYZ]t0",)))).sources
        for run in test.observations():
            blocks.append(design_rows(sources, test.machine, run) / scatter[name])
            own.append(design_rows(offsets, test.machine, run)[:, :-1] / scatter[name])
    rows = np.vstack(blocks)
    wide = np.zeros((len(rows), 3 * len(own)))
    first = 0
    for k, part in enumerate(own):
        wide[first : first + len(part), 3 * k : 3 * k + 3] = part
        first += len(part)
    whole = np.hstack([rows[:, :-1], wide])
    norms = np.linalg.norm(whole, axis=0)
    norms[norms == 0] = 1.0
    values = np.linalg.lstsq(whole / norms, rows[:, -1], rcond=1e-10)[0] / norms
    return values[: len(sources)]


def test_the_joint_estimate_is_that_of_the_stacked_system_in_any_order(three, together) -> None:
    expected = dict(
        zip([s.name for s in systems_of(three).sources if s.name in together], dense(three, together), strict=True)
    )
    scale = {p.name: abs(p.value) for p in together.parameters}
    for parameter in together.parameters:
        assert parameter.value == pytest.approx(expected[parameter.name], rel=1e-9, abs=1e-9 * scale[parameter.name])
    back = identify(dict(reversed(three.items())))
    assert set(back) == set(together)
    for parameter in together.parameters:
        assert back[parameter.name].value == pytest.approx(parameter.value, rel=1e-9)
        assert back[parameter.name].interval == pytest.approx(parameter.interval, rel=1e-6)


def test_what_each_test_counts_is_what_its_readings_scatter(together) -> None:
    for k, part in enumerate(together.tests, 1):
        assert part.scatter == pytest.approx(1e-4 * k, rel=0.15)


def test_one_test_is_a_campaign_of_one(three) -> None:
    alone, named = identify(three["xy"]), identify({"xy": three["xy"]})
    assert [p.value for p in alone.parameters] == [p.value for p in named.parameters]
    assert alone.verdict == named.verdict
    assert alone.test == three["xy"]
    assert alone.together == ()
    assert alone.information == {}
    assert alone.tests[0].rank == alone.confounding.rank == len(alone.tests[0].alone)


def test_rows_that_are_not_held_are_made_again_as_they_were(three) -> None:
    systems = systems_of(three)
    for name, test in three.items():
        own = systems_of(replace(test, question=Question(tuple(source.name for source in systems.sources))))
        for run, held in zip(systems.of(name).runs, own.runs, strict=True):
            assert run.held is None
            assert held.rows.shape == (60, 1 + len(systems.sources))
            np.testing.assert_array_equal(run.design, held.design)
            some = run.holding(["C_YYY", "E_YY1"])
            np.testing.assert_array_equal(some.design_of(["E_YY1"]), held.design_of(["E_YY1"]))
            np.testing.assert_array_equal(some.reading, held.reading)


def test_traces_of_several_tests_are_made_again_as_exact(three, together) -> None:
    systems = systems_of(three)
    values = together.solution.values
    assert len(together.traces) == len(systems.runs)
    for _ in range(2):
        for run, trace in zip(systems.runs, together.traces, strict=True):
            assert (trace.run, trace.test, trace.force) == (run.name, run.test, run.force)
            np.testing.assert_allclose(trace.measured, run.reading, rtol=0, atol=1e-17)
            np.testing.assert_allclose(trace.predicted, run.design_of(list(together)) @ values, rtol=0, atol=1e-15)
    assert [trace.run for trace in together.traces[1:3]] == [run.name for run in systems.runs[1:3]]
    assert together.traces[-1].run == systems.runs[-1].name


def test_no_rows_are_held(three) -> None:
    """Three times the tests: what memory it takes grows by far less than the rows of the others."""

    def longer(run: Run) -> Run:
        return replace(run, columns={name: np.repeat(values, 50) for name, values in run.columns.items()})

    def most(times: int) -> int:
        asked = {
            f"{name}-{k}": replace(test, runs=tuple(map(longer, test.runs)))
            for name, test in three.items()
            for k in range(times)
        }
        tracemalloc.start()
        result = identify(asked)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert len(result.tests) == 3 * times
        return peak

    readings = 6 * 6 * 60 * 50
    assert most(3) - most(1) < 8 * readings * 5


def test_simulations_about_one_centre_are_of_one_machine() -> None:
    """Bars at two places, a positioning error of the second degree: its value is about one centre, or of two machines."""
    truth, angle = {"E_XX1": 3e-5, "E_XX2": 2e-7}, 2 * np.pi * np.arange(72) / 72
    runs = tuple(Run(f"{k}", {"angle": angle, "radial": np.zeros(72)}) for k in range(3))
    machine, asked = machine_of("wFYXZt"), Question(("E_XX1", "E_XX2"))
    tests = {
        f"at-{x:g}": MachineTest("bar", machine, BallBar(Circle(100.0, centre={"X": x}), feed=20.0), runs, asked)
        for x in (-100.0, 200.0)
    }
    middle = {"X": 50.0}
    one = identify({name: simulate(test, truth, exact=False, centre=middle) for name, test in tests.items()})
    assert {name: one[name].value for name in truth} == pytest.approx(truth, rel=1e-9)
    apart = identify({name: simulate(test, truth, exact=False) for name, test in tests.items()})
    assert abs(apart["E_XX2"].value - truth["E_XX2"]) > 0.1 * truth["E_XX2"]


def test_several_tests_have_no_one_test(together) -> None:
    with pytest.raises(InputError, match="has 3 tests \\(xy, yz, zx\\), and this is asked of one test"):
        _ = together.test


def test_information_is_what_is_lost_without_a_test(three, together) -> None:
    runs, labels = systems_of(three).runs, list(together)

    def spread(chosen: Sequence[Any]) -> tuple[Any, Any]:
        """Variance of each parameter, and the share of it that no reading sees."""
        rows = np.vstack([np.sqrt(run.precision) * run.design_of(labels) for run in chosen]) * list(scale.values())
        values, vectors = np.linalg.eigh(rows.T @ rows)
        seen = values > 1e-12 * values[-1]
        return np.sum(vectors[:, seen] ** 2 / values[seen], axis=1), np.sum(vectors[:, ~seen] ** 2, axis=1)

    scale = {name: 1 / np.linalg.norm([np.linalg.norm(run.design_of([name])) for run in runs]) for name in labels}
    variance, _ = spread(runs)
    for test in three:
        without, hidden = spread([run for run in runs if run.test != test])
        for name, one, other, unseen in zip(labels, variance, without, hidden, strict=True):
            expected = 1.0 if unseen > 1e-9 else 1 - one / other
            assert together.information[name][test] == pytest.approx(expected, abs=1e-6)


def test_a_shared_gauge_is_one_quantity(three) -> None:
    def with_gauge(serials: Sequence[str]) -> Campaign:
        gauge = (KnownInfluence("force-scale", "force gauge", relative=0.03),)
        pairs = zip(three.items(), serials, strict=True)
        return Campaign("c", {n: replace(t, influences=gauge, about=About(instrument_serial=s)) for (n, t), s in pairs})

    shared, apart = with_gauge(["7", "7", "7"]), with_gauge(["7", "8", "9"])
    for campaign, count in ((shared, 1), (apart, 3)):
        systems = systems_of(campaign)
        found = effects_of(campaign, systems)
        assert len(found) == count
        assert np.sum([effect.stretch for effect in found], axis=0) == pytest.approx(np.ones(len(systems.runs)))
    systems = systems_of(shared)
    solution = solve(merged(systems.runs), confounding_of(shared, systems).retained)
    budget = uncertainty_budget(systems, solution, effects_of(shared, systems))
    for name in ("C_XXX", "C_YYY", "C_ZZZ"):
        k = solution.labels.index(name)
        (line,) = [line for line in budget.lines[k] if line.label == "force gauge"]
        assert line.contribution == pytest.approx(0.03 * abs(solution.values[k]), rel=1e-2)


def test_two_tests_of_one_gauge_cannot_state_different_things(three) -> None:
    about = About(instrument_serial="7")
    tests = {
        name: replace(three[name], about=about, influences=(KnownInfluence("force-scale", "gauge", relative=size),))
        for name, size in (("xy", 0.01), ("yz", 0.03))
    }
    with pytest.raises(InputError, match=r"'xy' and 'yz' have the same instrument 7 and state different things of 'gauge'"):
        identify(tests)


def bar_test(plane: str, seed: int, serial: str = "", **question: Any) -> MachineTest:
    angle = 2 * np.pi * np.arange(72) / 72
    runs = tuple(Run(f"{k}", {"angle": angle, "radial": np.zeros(72)}) for k in range(3))
    setup = BallBar(Circle(100.0, plane=plane), feed=20.0)
    asked = Question(("E_XX1", "E_YY1", "E_ZZ1", "E_R0", "E_[XYZ]t0"), set_up_per_run=False, **question)
    blank = MachineTest(
        plane, machine_of("wFYXZt"), setup, runs, asked, about=About(instrument_serial=serial, date=f"2026-0{seed}-01")
    )
    truth = {"E_XX1": 3e-5, "E_YY1": 1e-5, "E_ZZ1": 2e-5, "E_R0": 0.004, "E_Xt0": 0.01 * seed}
    return simulate(blank, truth, Imperfection(noise=1e-5), seed, exact=False)


def test_set_up_is_of_each_test_and_a_bar_of_its_serial_number() -> None:
    tests = {plane.lower(): bar_test(plane, k, "B7") for k, plane in enumerate(("XY", "YZ", "ZX"), 1)}
    result = identify(tests)
    assert "E_R0@B7" in result.confounding.labels
    assert "E_R0@xy" not in result.confounding.labels
    assert result["E_Xt0@xy"].value == pytest.approx(0.01, abs=1e-4)
    assert result["E_Xt0@zx"].value == pytest.approx(0.03, abs=1e-4)
    assert result["E_Xt0@xy"].share == 0.0
    apart = identify({name: replace(test, about=About()) for name, test in tests.items()})
    assert {"E_R0@xy", "E_R0@yz", "E_R0@zx"} <= set(apart.confounding.labels)


def test_a_parameter_by_date_is_one_for_each_date() -> None:
    tests = {"spring": bar_test("XY", 1, by_date=("E_XX1",)), "summer": bar_test("XY", 2, by_date=("E_XX1",))}
    labels = identify(tests).confounding.labels
    assert {"E_XX1@2026-01-01", "E_XX1@2026-02-01", "E_YY1"} <= set(labels)
    assert "E_XX1" not in labels
    undated = {name: replace(test, about=About()) for name, test in tests.items()}
    with pytest.raises(InputError, match="E_XX1 is asked by date, and test 'spring' has none"):
        identify(undated)


def test_campaigns_that_contradict_themselves_are_refused(three) -> None:
    with pytest.raises(InputError, match=r"'xy' and 'other' are not of one machine: .*topology"):
        Campaign("c", {"xy": three["xy"], "other": circle_test("XY", 1, topology="wXYFZt")})
    with pytest.raises(InputError, match="a test is called 'x y'"):
        Campaign("c", {"x y": three["xy"], "yz": three["yz"]})
    with pytest.raises(InputError, match="two tests are called 'xy'"):
        campaign_of([three["xy"], three["xy"]])
    with pytest.raises(InputError, match="campaign '' has no test"):
        identify([])
    with pytest.raises(InputError, match="test 'xy' subtracts the readings at 100 N"):
        identify(three, reference=100.0)


PLANNED = {
    "xy": 'plane = "XY"',
    "yz": 'plane = "YZ"',
    "zx": 'plane = "ZX"',
    "tilted": 'plane = "XY"\ncentre = { A_rad = 0.5, C_rad = 0.7 }',
    "table": 'plane = "XY"\nbar_turn = 0\nrotary_turn = { C = 1 }',
    "cradle": 'plane = "XY"\nrotary_turn = { A = 0.3 }',
    "corner": 'plane = "XY"\ncentre = { X_mm = 200, Y_mm = -150, Z_mm = 100 }',
}
RANKS = (6, 11, 15, 18, 20, 29, 32)


@pytest.fixture
def planned(tmp_path: Path) -> Path:
    for name, circle in PLANNED.items():
        (tmp_path / name).mkdir()
        (tmp_path / name / "test.toml").write_text(
            f'schema = "elastogeo.test/1"\nname = "{name}"\nmachine = "hermle_c50"\ninstrument = "loaded-ball-bar"\n'
            f"[setup]\nfeed_mm_min = 2000\n[setup.circle]\nradius_mm = 150\n{circle}\n"
            f'[question]\nset_up_per_run = false\n[[runs]]\nfile = "500N.csv"\nforce_N = 500\n'
        )
    (tmp_path / "campaign.toml").write_text(
        f'schema = "elastogeo.campaign/1"\nname = "all"\nmachine = "hermle_c50"\ntests = {list(PLANNED)}\n'
        f'question.parameters = ["C_*"]\nquestion.set_up_per_run = false\n'
    )
    return tmp_path


@pytest.mark.parametrize("count", range(1, 8))
def test_the_rank_grows_with_every_test_through_the_command_line(planned, count) -> None:
    folders = [str(planned / name) for name in list(PLANNED)[:count]]
    ran = CliRunner().invoke(application(), ["explain", *folders, "--planned", "120", "-p", "C_*", "--json"])
    assert ran.exit_code == 0, ran.output
    document = json.loads(ran.output)
    assert (document["rank"], document["columns"]) == (RANKS[count - 1], 180)
    if count > 1:
        assert tuple(step["rank_so_far"] for step in document["steps"]) == RANKS[:count]
        named = [name for step in document["steps"] for name in step["adds"]]
        assert sorted(named) == sorted(entry["name"] for entry in document["retained"])
        assert document["steps"][-1]["adds"]


def test_a_campaign_file_is_the_same_as_its_tests(planned) -> None:
    campaign = read_campaign(planned, planned=120)
    assert list(campaign.tests) == list(PLANNED)
    assert campaign.machine == read_machine("hermle_c50")
    assert explain(campaign).confounding.rank == RANKS[-1]


def test_every_step_names_what_it_adds(planned) -> None:
    result = identify(read_campaign(planned, planned=120))
    assert tuple(part.rank_so_far for part in result.tests) == RANKS
    named = [name for part in result.tests for name in part.adds]
    assert len(named) == len(set(named)) == RANKS[-1]
    assert set(named) == set(result)


def test_only_what_one_run_alone_knows_has_no_interval(three) -> None:
    once = replace(three["zx"], runs=three["zx"].runs[:1])
    result = identify({"xy": three["xy"], "zx": once}, parameters=["C_XXX", "C_YYY", "C_ZZZ", "C_BXX"])
    assert result.by_run
    assert "C_ZZZ" in result.unshown
    assert "C_YYY" not in result.unshown
    for parameter in result.parameters:
        assert (parameter.interval is None) == (parameter.name in result.unshown)
    check = next(check for check in result.verdict if check.name == "uncertainty by run")
    assert check.passed is False
    assert check.facts["unshown"] == result.unshown
    assert "No interval of C_" in str(check)

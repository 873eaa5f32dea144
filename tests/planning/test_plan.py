"""A plan: what it promises, that it keeps its budget, that no unit decides it, and the traps of planning.md."""

import sys
import textwrap
from dataclasses import replace

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.observe import instruments
from elastogeo.planning import Candidate, Means, Plan, ReadingNoise, candidates, proposals, proposes, unknowns, whitened
from elastogeo.report import view_of

HERMLE = eg.read_machine("hermle_c50")


@pytest.fixture(scope="module")
def some() -> tuple[Candidate, ...]:
    return candidates(Means(HERMLE, readings=18), count=80)


@pytest.fixture(scope="module")
def planned(some: tuple[Candidate, ...]) -> Plan:
    return eg.plan(Means(HERMLE, readings=18), tests=8, chosen_from=some)


def test_a_plan_of_eight_circles_supports_the_volume(planned: Plan) -> None:
    """Golden: all bar tests of five axes and one tool tell 56 combinations; eight well-chosen circles tell them all."""
    assert planned.rank == planned.highest_rank == 56
    assert planned.supported == 1.0
    assert len(planned.tests) == 8
    assert planned.minutes == sum(one.candidate.minutes for one in planned.tests)
    assert [one.rank_so_far for one in planned.tests][-1] == 56
    assert planned.next_best is not None
    assert planned.next_best.worst <= planned.tests[-1].worst_so_far


def test_one_force_level_tells_nothing(some: tuple[Candidate, ...]) -> None:
    asked, noise = unknowns(HERMLE), ReadingNoise()
    one = some[0].test
    alone = replace(one, runs=one.runs[:1])
    assert len(whitened([alone], asked, noise)[0]) == 0
    again = replace(one, runs=(one.runs[0], replace(one.runs[0], name="again")))
    assert np.abs(whitened([again], asked, noise)[0]).max(initial=0.0) < 1e-9
    with pytest.raises(InputError, match=r"force levels are 600, 600 N; it takes two different ones"):
        Means(HERMLE, forces=(600.0, 600.0))


def test_a_budget_of_minutes_is_kept(some: tuple[Candidate, ...]) -> None:
    found = eg.plan(Means(HERMLE, readings=18), minutes=50, chosen_from=some)
    assert 30 < found.minutes <= 50
    with pytest.raises(UnsupportedError, match="no test fits into 2 minutes; the shortest takes 1"):
        eg.plan(Means(HERMLE, readings=18), minutes=2, chosen_from=some)


def test_what_cannot_be_planned_is_refused() -> None:
    endless = replace(HERMLE, joints=tuple(replace(j, travel=(-np.inf, np.inf)) for j in HERMLE.joints))
    with pytest.raises(InputError, match=r"the travel of Y X Z of machine 'Hermle C50' is not known; state travel_mm"):
        eg.plan(endless, tests=3)
    with pytest.raises(InputError, match="there is no goal 'volume'; there are workspace, parameters, information"):
        eg.plan(HERMLE, tests=3, goal="volume")
    with pytest.raises(InputError, match="E_XX1 is none of them"):
        eg.plan(HERMLE, tests=3, parameters="E_XX1")
    with pytest.raises(InputError, match=r"no test of 'ball-barr' can be planned; instruments that can: ball-bar"):
        candidates(Means(HERMLE), ["ball-barr"], 4)


def test_asked_for_c_xxx_the_planner_proposes_the_probe_across_the_carriage() -> None:
    """Done-when 1 of issue 10: no test between tool and workpiece tells C_XXX from C_XXY; a probe across X does."""
    means = Means(HERMLE, readings=12)
    found = eg.plan(means, parameters="C_XXX", count=20)
    assert [one.candidate.test.instrument for one in found.tests] == ["joint-probe"]
    assert found.proposed == ("joint-probe",)
    assert found["C_XXX"].known == "alone"
    assert found["C_XXY"].known == "unseen"
    assert [why.name for why in found.reasons] == ["C_XXX"]
    assert found.reasons[0].alike == ("C_XXX", "C_XXY", "C_XXZ", "C_XXA")
    other = eg.plan(means, parameters="C_XXY", count=20)
    assert getattr(other.tests[0].candidate.setup, "across") == ("Y",)  # noqa: B009
    told = str(other)
    assert "No test between tool and workpiece tells C_XXY by itself" in "\n".join(view_of(other).notes)
    assert "C_XXY" in told


def test_a_plan_that_makes_nothing_of_what_was_asked_for_known_alone_says_so(some: tuple[Candidate, ...]) -> None:
    """Bars see C_XXX only together with what follows it in the loop: the plan is shown all the same."""
    found = eg.plan(Means(HERMLE, readings=18), tests=2, parameters="C_XXX", chosen_from=some[:20])
    assert found["C_XXX"].known != "alone"
    assert view_of(found).sentence.endswith(": none of what was asked for.")


@pytest.mark.parametrize(("name", "instrument"), [("C_XBY", "displacement-probes"), ("C_ACX", "sensor-frame")])
def test_what_bars_do_not_tell_and_others_do_is_proposed_too(name: str, instrument: str) -> None:
    """A bar sees only C_df + C_fd; forces across the reading tell them apart, and a twist tells what lever a force has."""
    found = eg.plan(Means(HERMLE, readings=12), parameters=name, tests=3, count=20)
    assert found.proposed == (instrument,)
    assert found.reasons == ()


@pytest.mark.parametrize(
    ("instrument", "tools", "rank"),
    [("static-force", (), 91), ("displacement-probes", (), 91), ("sensor-frame", (), 123), ("loaded-ball-bar", (), 56)],
)
def test_candidates_of_each_instrument_reach_its_golden_rank(instrument: str, tools: tuple[()], rank: int) -> None:
    means = Means(HERMLE, readings=12, tools=tools)
    drawn = candidates(means, [instrument], 110 if instrument == "static-force" else 30)
    rows = np.vstack(whitened([one.test for one in drawn], unknowns(HERMLE), ReadingNoise()))
    values = np.linalg.svd(rows, compute_uv=False)
    assert int((values > 1e-9 * values[0]).sum()) == rank


def test_a_probe_across_x_adds_five_then_fifteen() -> None:
    """Golden: 91 -> 96 with one direction at the carriage's origin, 106 with three; each with two force levels."""
    asked, noise = unknowns(HERMLE), ReadingNoise()
    between = whitened([one.test for one in candidates(Means(HERMLE), ["displacement-probes"], 30)], asked, noise)
    across = whitened([one.test for one in candidates(Means(HERMLE), ["joint-probe"], 3)], asked, noise)

    def rank(rows: list[np.ndarray]) -> int:  # type: ignore[type-arg]
        values = np.linalg.svd(np.vstack(rows), compute_uv=False)
        return int((values > 1e-9 * values[0]).sum())

    assert [rank(between), rank([*between, *across[:1]]), rank([*between, *across])] == [91, 96, 106]


def test_every_candidate_is_within_the_travel_and_clear(some: tuple[Candidate, ...]) -> None:
    """By its own frames: the bar stays 40 degrees from the spindle and the post, the spindle before the table."""
    for one in some:
        seen = one.test.observations()[0]
        low, high = np.array([joint.travel for joint in HERMLE.joints]).T
        assert (seen.commands >= low).all()
        assert (seen.commands <= high).all()
        tilt = seen.commands[:, HERMLE.index("A")]
        turn = seen.commands[:, HERMLE.index("C")]
        assert np.ptp(turn) <= 2 * np.pi + 1e-9
        bar, up = seen.direction[:, :3], np.array([0.0, 0.0, 1.0])
        normal = np.column_stack([np.zeros_like(tilt), np.sin(tilt), np.cos(tilt)])  # the workpiece turns by minus A
        assert (-bar @ up <= np.cos(np.deg2rad(40)) + 1e-9).all()
        assert (np.sum(-bar * normal, axis=1) <= np.cos(np.deg2rad(40)) + 1e-9).all()
        assert (normal @ up >= np.cos(np.deg2rad(95)) - 1e-9).all()


def test_tests_made_already_are_kept(some: tuple[Candidate, ...], planned: Plan) -> None:
    """A plan beside half of the tests of another one adds what is missing, and knows at least as much."""
    means = Means(HERMLE, readings=18)
    half = {one.candidate.name: one.candidate.test for one in planned.tests[:4]}
    more = eg.plan(means, tests=4, made=half, chosen_from=some)
    assert more.rank == 56
    assert more.supported == 1.0
    assert more.made is not None
    assert list(more.made.tests) == list(half)
    alone = eg.plan(means, tests=4, chosen_from=some)
    assert more.rank > alone.rank
    assert more.tools[0].worst_with_prior < alone.tools[0].worst_with_prior


def test_every_instrument_that_loads_the_machine_can_be_planned_but_the_nest() -> None:
    """A nest of sensors presses its ball with a force that serves to hold it: it tells geometry."""
    loading = {name for name, kind in instruments().items() if kind.loads and kind.__module__.startswith("elastogeo.")}
    assert loading - set(proposals()) == {"sphere-nest"}


def test_the_recipe_for_a_proposal_is_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it stands in the docstring of the contract."""
    text = str(sys.modules[proposes.__module__].__doc__)
    code = textwrap.dedent(
        "\n".join(line for line in text.split("`pushes.py`::")[1].splitlines() if line[:4].isspace() or not line)
    )
    registered = dict(proposals())
    monkeypatch.setattr(sys.modules[proposes.__module__], "_REGISTER", registered)
    exec(compile(code, "pushes.py", "exec"), {"__name__": "pushes"})
    pushed = candidates(Means(HERMLE), ["static-force"], 3)
    assert [one.name for one in pushed] == ["push_1", "push_2", "push_3"]
    rows = whitened([one.test for one in pushed], unknowns(HERMLE), ReadingNoise())
    assert [len(own) for own in rows] == [1, 1, 1]


def test_without_a_budget_as_many_tests_as_support_the_volume() -> None:
    """On this machine the fewest that support it at all are not those that are surest: more are taken until all of it is."""
    found = eg.plan(Means(eg.read_machine("huron_kx8"), readings=18), count=60)
    assert found.supported == 1.0
    assert found.fewest is not None
    assert len(found.tests) >= found.fewest

"""Looking ahead from a history: the map of what is identified, plans to choose among, their programs as `nc` writes them."""

import sys
from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.changes import NextGoal
from elastogeo.changes.records import STIFFNESS, TELL, WORKSPACE
from elastogeo.cli import main
from elastogeo.errors import InputError
from elastogeo.history.analyses import campaign_text, keep_campaign
from elastogeo.history.jobs import Worker
from elastogeo.prediction import compliance_along, knowledge_of
from elastogeo.prediction.tool_compliances import TRANSLATION
from elastogeo.report import view_of
from tests.history.analyses.kept import EXAMPLES

CAMPAIGN = EXAMPLES / "three-axis-campaign"
BAR = ["loaded-ball-bar"]
Y = np.array([0.0, 1.0, 0.0])


def done(history, number):
    Worker(history.store).run(once=True)
    return history.job(number)


@pytest.fixture(scope="module", autouse=True)
def few():
    """Few tests to choose from: what is tested here does not depend on how many."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("elastogeo.changes.next_tests.ways.CANDIDATES", 24)
        yield


@pytest.fixture(scope="module")
def shop(tmp_path_factory):
    """A history of one machine: two circles in two planes, imported and analysed."""
    with eg.History(tmp_path_factory.mktemp("ahead") / "shop.db", create=True, who="the tests") as history:
        history.add_machine("Mill 3", serial="4711")
        history.add_machine("New", kind="hermle_c50")
        for day, name in enumerate(("1-xy", "2-yz"), 1):
            history.add(CAMPAIGN / name, machine="Mill 3", date=f"2026-03-0{day}")
        yield history


@pytest.fixture(scope="module")
def mill(shop):
    return next(one.key for one in shop.machines() if one.name == "Mill 3")


@pytest.fixture(scope="module")
def planned(shop, mill):
    return done(shop, shop.put_plan(mill, NextGoal(TELL, ("drive X", "guideway Y")), 60.0, BAR))


def test_the_map_of_a_test_is_what_the_test_says(shop, mill):
    job = done(shop, shop.put_map(mill))
    assert job.state == "done", job.error
    assert job.result["basis"]["name"] == shop.map_bases(mill)[0].name
    found = shop.map_of(job)
    test = eg.read_test(CAMPAIGN / "2-yz")
    result = eg.identify(test, parameters=[*test.asked, "C_???"], reciprocal=True)
    known, along_y, told = knowledge_of(result), TRANSLATION.index((1, 1)), 0
    for place, commands in enumerate(np.array(np.meshgrid(*found.along, indexing="ij")).reshape(3, -1).T):
        one = compliance_along(known, commands[[found.axes.index(axis) for axis in result.campaign.machine.axes]], Y)
        assert one.supported[0] == found.told.told[place, along_y]
        told += one.supported[0]
        if one.supported[0]:
            assert found.told.compliance[place, along_y] == pytest.approx(one.value[0], rel=1e-3)
    assert told > 0


def test_a_campaign_tells_more_than_its_last_test_and_comes_first(shop, mill):
    tests = {name: number for number, name in enumerate(("1-xy", "2-yz"), 1)}
    keep_campaign(shop.store, campaign_text("both", tests, ["C_*", "E_[XYZ][XYZ][12]"]), tests)
    (first, *others) = shop.map_bases(mill)
    assert (first.kind, first.name, first.tests) == ("campaign", "both", 2)
    alone = shop.map_of(done(shop, shop.put_map(mill, others[0].kind, others[0].key)))
    both = shop.map_of(done(shop, shop.put_map(mill, first.kind, first.key)))
    assert both.told.told.sum() > alone.told.told.sum()
    assert shop.map_job(mill, "campaign", first.key).result["basis"]["name"] == "both"


def test_without_anything_identified_there_is_no_map(shop):
    new = next(one.key for one in shop.machines() if one.name == "New")
    assert shop.map_bases(new) == ()
    job = done(shop, shop.put_map(new))
    assert job.state == "failed"
    assert "nothing is identified of this machine yet" in job.error


def test_what_two_components_do_alike_is_said_and_what_tells_them(planned, shop):
    """C_XXX and C_XXY are columns of one kind in every test between tool and workpiece (planning.md); a probe tells them."""
    assert planned.state == "done", planned.error
    found = shop.next_tests_of(planned)
    bar = [one for one in found.alternatives if "joint-probe" not in str(one.plan["tests"])]
    assert bar
    for one in bar:
        assert not one.resolved
        alike = {way.name for way in one.ways if way.told is False}
        assert {"C_XXX", "C_XXY"} <= alike
        assert all(np.isinf(way.uncertainty) for way in one.ways if way.name == "C_XXX")
    probe = next(one for one in found.alternatives if "joint-probe" in str(one.plan["tests"]))
    assert probe.resolved
    view = view_of(found)
    cards = {section.title: section.paragraphs for section in view.sections}
    assert any(text[0] == "Resolves: the X drive from the Y guideway." for text in cards.values())
    assert any("C_XXX of the X drive looks like the Y guideway" in text[0] for text in cards.values())
    assert "joint probe" in view.sentence


def test_alternatives_come_with_time_and_expected_uncertainty(shop, mill):
    job = done(shop, shop.put_plan(mill, NextGoal(WORKSPACE), 60.0, BAR))
    found = shop.next_tests_of(job)
    minutes = [one.plan["minutes"] for one in found.alternatives]
    assert minutes == sorted(minutes)
    assert any(one.resolved for one in found.alternatives)
    for one, card in zip(found.alternatives, view_of(found).sections, strict=True):
        assert one.resolved == (one.plan["workspace"][0]["share"] == 1.0)
        assert card.paragraphs[0].startswith("Resolves" if one.resolved else "Cannot tell")
        if one.resolved:
            assert "Expected: U = " in card.paragraphs[1]


def test_a_share_of_the_stiffness_is_a_goal_only_where_the_stiffness_is_known(shop, mill):
    goal = NextGoal(STIFFNESS, share=0.9, compliance=5e-5)
    found = shop.next_tests_of(done(shop, shop.put_plan(mill, goal, 90.0, BAR)))
    for one in found.alternatives:
        worst, share = (one.plan["workspace"][0][name] for name in ("worst", "share"))
        assert one.resolved == (share == 1.0 and 2 * worst <= 0.9 * 5e-5)
    assert any(one.resolved for one in found.alternatives)
    for share in (0.0, 1.5):
        failed = done(shop, shop.put_plan(mill, NextGoal(STIFFNESS, share=share, compliance=5e-5), 60.0, BAR))
        assert "give a number above 0 and below 100" in failed.error
    failed = done(shop, shop.put_plan(mill, NextGoal(STIFFNESS), 60.0, BAR))
    assert "no test of this machine shows its stiffness yet" in failed.error


@pytest.mark.parametrize(
    ("goal", "minutes", "said"),
    [
        (NextGoal("gold"), 60.0, "there is no goal 'gold'"),
        (NextGoal(TELL, ("drive X", "drive Q")), 60.0, "no compliance is of 'drive Q'; this machine has drive"),
        (NextGoal(TELL, ("drive X", "drive X")), 60.0, "it takes two components"),
        (NextGoal(WORKSPACE), 0.0, "a plan of 0 minutes is none"),
        (NextGoal(WORKSPACE), 3.0, "no test fits into 3 minutes; the shortest takes 1"),
    ],
)
def test_a_goal_that_is_none_is_refused(shop, mill, goal, minutes, said):
    job = done(shop, shop.put_plan(mill, goal, minutes, BAR))
    assert job.state == "failed"
    assert said in job.error


@pytest.mark.parametrize("flavour", ["iso", "linuxcnc", "sinumerik", "heidenhain"])
def test_a_program_of_a_kept_plan_is_what_nc_writes(shop, planned, flavour, tmp_path, monkeypatch):
    """Byte for byte: the files of the plan as a folder, given to `elastogeo nc`."""
    name = f"tell them apart, {flavour}"
    key = shop.choose_plan(planned.key, _bar_only(shop, planned), name, "2026-12-24", 3.0)
    assert shop.choose_plan(planned.key, 0, f"{name} 2") == key + 1
    for path, text in shop.plan_files(key).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    out = tmp_path / "out"
    out.mkdir()
    monkeypatch.setattr(
        sys, "argv", ["elastogeo", "nc", str(tmp_path / "campaign"), "--flavour", flavour, "-o", str(out), "--json"]
    )
    assert main() == 0
    written = {file.name: file.read_bytes() for file in out.iterdir()}
    to_do = shop.plan_to_do(key)
    assert len(written) == len(to_do.programs) == len(to_do.plan.tests)
    for one in to_do.programs:
        assert not one.error
        file, content = shop.plan_program(key, one.test, flavour)
        assert written[file] == content


def _bar_only(shop, planned):
    ways = shop.next_tests_of(planned).alternatives
    return next(
        k for k, one in enumerate(ways) if "joint-probe" not in str(one.plan["tests"]) and len(one.plan["tests"]) > 1
    )


def test_a_chosen_plan_is_a_list_to_do(shop, planned):
    key = shop.choose_plan(planned.key, 0, "on Monday", "2026-12-24", 3.0)
    found = shop.plan_to_do(key)
    assert found.goal == NextGoal(TELL, ("drive X", "guideway Y"))
    view = view_of(found)
    assert "due 24 December 2026" in view.sentence.replace("Dec ", "December ")
    assert ("Goal", "tell the X drive from the Y guideway") in view.head
    points = view.sections[0].points
    assert any(found.plan.tests[0] in point and "100 N and 700 N" in point for point in points)
    with pytest.raises(InputError, match="has a plan 'on Monday' already"):
        shop.choose_plan(planned.key, 0, "on Monday")
    with pytest.raises(InputError, match="not one of number 9"):
        shop.choose_plan(planned.key, 9, "x")
    shop.finish_plan(key)
    assert "done" in view_of(shop.plan_to_do(key)).sentence


def test_a_program_that_is_none_is_refused(shop, planned):
    key = shop.choose_plan(planned.key, 0, "refused")
    with pytest.raises(InputError, match="the plan has no such test"):
        shop.plan_program(key, "../campaign", "iso")
    with pytest.raises(InputError, match="there is no flavour 'gcode'"):
        shop.plan_program(key, shop.plan_to_do(key).plan.tests[0], "gcode")
    with pytest.raises(InputError, match="there is no plan 4711"):
        shop.plan_to_do(4711)


def test_a_plan_of_the_command_line_has_no_programs_and_says_so(shop):
    plan = Path(shop.store.url).with_name("other.json")
    plan.write_text('{"schema": "elastogeo.plan/1", "tests": [{"name": "xy"}], "minutes": 12.0}', encoding="utf-8")
    found = shop.plan_to_do(shop.keep_plan(plan, machine="Mill 3"))
    assert found.programs == ()
    assert "elastogeo plan --write" in view_of(found).notes[0]
    with pytest.raises(InputError, match="the plan has no such test"):
        shop.plan_program(found.plan.key, "xy", "iso")


def test_a_machine_without_tests_is_planned_by_its_kind(shop):
    new = next(one.key for one in shop.machines() if one.name == "New")
    assert "rotary axis A" in shop.components(new)
    unknown = shop.add_machine("Unknown", kind="thing")
    with pytest.raises(InputError, match="it has no test yet, and its kind, thing, is none of hermle_c50, huron_kx8"):
        shop.components(unknown.key)

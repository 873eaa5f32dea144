"""The face of a history: what is imported is analysed and judged at once, what a person says is judged anew."""

import pytest
from sqlalchemy import func, select

import elastogeo as eg
from elastogeo.changes import ALARM, NO_BASELINE, STEADY
from elastogeo.errors import InputError
from elastogeo.history.intake.imports import import_test
from elastogeo.history.store import read
from elastogeo.history.store.schema import analysis, instrument, outbox, series_state
from tests.history.intake.small_tests import write_test


@pytest.fixture
def history(url, standing_clock):  # noqa: ARG001
    with eg.History(url, who="A. Nobody") as found:
        found.add_machine("Mill 3", serial="4711")
        yield found


def analyses(history) -> int:
    with read(history.store) as connection:
        return connection.execute(select(func.count()).select_from(analysis)).scalar()


def test_what_a_crash_left_between_import_and_analysis_is_made_up_for(history, tmp_path):
    folder = write_test(tmp_path / "one")
    import_test(history.store, folder, machine="Mill 3", who="A. Nobody")
    assert analyses(history) == 0
    again = history.add(folder, machine="Mill 3")
    assert (again.new, again.verdict.state, again.unanalysed, analyses(history)) == (False, NO_BASELINE, "", 1)


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_folder_comes_in_by_its_days_and_what_is_refused_is_told(history, tmp_path):
    for k, date in enumerate(["2026-02-01", "", "2026-01-01"]):
        write_test(tmp_path / f"t{k}", date=date, seed=k)
    found = list(history.add_all(tmp_path, machine="Mill 3"))
    assert [one.path.name for one in found] == ["t2", "t0", "t1"]
    assert [one.new for one in found] == [True, True, False]
    assert "does not say when it was measured" in found[2].error
    with pytest.raises(InputError, match="holds no test"):
        next(history.add_all(tmp_path / "t0" / "runs"))


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_softer_machine_alarms_and_setting_aside_quiets_it(history, tmp_path, standing_clock):
    """All of it comes in a month late, when the wait for a repeat is over: the repeat is known as one all the same."""
    standing_clock.advance(days=30)
    for k in range(6):
        history.add(write_test(tmp_path / f"{k}", date=f"2026-01-{k + 1:02d}", seed=k), machine="Mill 3")
    history.set_baseline("Mill 3", first=6, why="as delivered")
    softer = history.add(write_test(tmp_path / "a", date="2026-02-28", seed=9, softer=0.02), machine="Mill 3")
    assert softer.verdict.state == ALARM
    repeat = history.add(write_test(tmp_path / "r", date="2026-02-28", seed=10, softer=0.02), machine="Mill 3")
    assert (repeat.imported.repeats, repeat.verdict.state) == (softer.imported.test, ALARM)
    for one in (softer, repeat):
        history.set_aside(one.imported.test, "bar damaged")
    with read(history.store) as connection:
        assert connection.execute(select(series_state.c.state)).scalar() == STEADY
        assert connection.execute(select(func.count()).select_from(outbox)).scalar() == 0  # nobody is to be told


CAMPAIGN = """\
schema = "elastogeo.campaign/1"
name = "Two circles"
tests = ["xy", "again"]

[[instruments]]
serial = "B7"
tests = ["xy", "again"]
"""


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_campaign_comes_in_with_its_tests_once(history, tmp_path):
    write_test(tmp_path / "c" / "xy", date="2026-02-01")
    write_test(tmp_path / "c" / "again", date="2026-01-01", seed=1)
    (tmp_path / "c" / "campaign.toml").write_text(CAMPAIGN)
    found = list(history.add_all(tmp_path / "c", machine="Mill 3"))
    assert [one.path.name for one in found] == ["again", "xy", "campaign.toml"]
    assert found[2].error == ""
    assert found[2].campaign == "Campaign 1: Two circles, 2 tests, Mill 3"
    with read(history.store) as connection:
        assert connection.execute(select(instrument.c.serial)).scalars().all() == ["B7"]
    again = list(history.add_all(tmp_path / "c" / "campaign.toml", machine="Mill 3"))
    assert [one.new for one in again] == [False, False, False]
    assert again[2].campaign == "Campaign 1 is known, nothing was changed: Two circles"


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_campaign_that_lacks_a_test_is_not_kept(history, tmp_path):
    write_test(tmp_path / "xy")
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    found = list(history.add_all(tmp_path, machine="Mill 3"))
    assert [bool(one.error) for one in found] == [False, True, True]
    assert "is not kept, since its tests did not all come in: again" in found[2].error

"""A test comes in once, whatever it is called; what cannot be is refused by name, and leaves nothing."""

import shutil
import subprocess
import sys
from datetime import UTC, datetime

import pytest
from sqlalchemy import func, insert, select

from elastogeo.errors import ElastogeoError, InputError
from elastogeo.formats import read_with_files
from elastogeo.history.intake.imports import import_test
from elastogeo.history.intake.machines import add_machine
from elastogeo.history.store import audit, read, write
from elastogeo.history.store.schema import (
    baseline,
    blob,
    calibration,
    instrument,
    machine,
    metadata,
    series,
    series_state,
    test,
    test_file,
)
from elastogeo.version import VERSION
from tests.history.intake.small_tests import write_test

WHO = "A. Nobody"


def counts(store) -> dict[str, int]:
    with read(store) as connection:
        return {t.name: connection.execute(select(func.count()).select_from(t)).scalar() for t in metadata.sorted_tables}


def row_of(store, key: int):
    with read(store) as connection:
        return connection.execute(select(test).where(test.c.id == key)).one()


@pytest.fixture
def mill(store):
    return add_machine(store, "Mill 3", who=WHO, serial="4711")


pytestmark = pytest.mark.usefixtures("standing_clock", "mill")


def test_a_test_is_kept_with_all_that_it_says(store, tmp_path):
    folder = write_test(
        tmp_path / "t", date="2026-03-01T14:30:00+01:00", instrument_serial="B7", instrument_calibrated="2025-11-02",
        operator="B. Somebody", machine_serial="4711",
    )  # fmt: skip
    got = import_test(store, folder, who=WHO)
    assert (got.new, got.new_series, got.machine, got.name, got.notes) == (True, True, "Mill 3", "Monthly", ())
    assert got.series_name == "loaded ball bar XY R150 36 to 742 N"
    kept = row_of(store, got.test)
    assert kept.at == datetime(2026, 3, 1, 13, 30, tzinfo=UTC)
    assert (kept.zone, kept.who, kept.origin, kept.repeats) == ("+01:00", "B. Somebody", "measured", None)
    with read(store) as connection:
        files = dict(connection.execute(select(test_file.c.path, test_file.c.sha256)).all())
        assert connection.execute(select(instrument.c.serial, instrument.c.kind)).all() == [("B7", "loaded-ball-bar")]
        assert connection.execute(select(calibration.c.at)).scalar() == datetime(2025, 11, 2, 12, tzinfo=UTC)
        assert connection.execute(select(machine.c.kind)).scalar() == "Hermle C50"
        assert audit.verify(connection) == ()
    assert set(files) == {"test.toml", "runs/36N.csv", "runs/742N.csv"}
    for path, sha256 in files.items():
        assert store.files.read(sha256) == (folder / path).read_bytes()


def test_a_second_time_and_a_renamed_copy_change_nothing(store, tmp_path):
    first = import_test(store, write_test(tmp_path / "one"), machine="Mill 3", who=WHO)
    before = counts(store)
    shutil.copytree(tmp_path / "one", tmp_path / "two")
    (tmp_path / "two" / "report.html").write_text("stray")
    for folder in ("one", "two"):
        again = import_test(store, tmp_path / folder, machine="Mill 3", who=WHO)
        assert (again.test, again.new) == (first.test, False)
    assert counts(store) == before


def test_one_changed_bit_is_another_test_of_the_same_series(store, tmp_path):
    first = import_test(store, write_test(tmp_path / "one"), machine="Mill 3", who=WHO)
    run = tmp_path / "one" / "runs" / "36N.csv"
    data = bytearray(run.read_bytes())
    data[-2] ^= 1
    run.write_bytes(data)
    second = import_test(store, tmp_path / "one", machine="Mill 3", who=WHO)
    assert second.new
    assert second.test != first.test
    assert (second.series, second.new_series) == (first.series, False)


def test_what_two_tests_share_is_kept_once(store, tmp_path):
    write_test(tmp_path / "one")
    import_test(store, tmp_path / "one", machine="Mill 3", who=WHO)
    text = (tmp_path / "one" / "test.toml").read_text().replace("2026-03-01", "2026-02-01")
    (tmp_path / "one" / "test.toml").write_text(text)
    import_test(store, tmp_path / "one", machine="Mill 3", who=WHO)
    assert counts(store)["blob"] == 4  # two test files, two runs
    assert counts(store)["test_file"] == 6


def test_another_recipe_is_another_series_and_a_slip_is_said(store, tmp_path):
    first = import_test(store, write_test(tmp_path / "a"), machine="Mill 3", who=WHO)
    near = import_test(store, write_test(tmp_path / "b", forces=(36.3, 739.0)), machine="Mill 3", who=WHO)
    other = import_test(store, write_test(tmp_path / "c", feed=1000), machine="Mill 3", who=WHO)
    assert near.series == first.series
    assert other.series != first.series
    assert other.series_name == "loaded ball bar XY R150 36 to 742 N (2)"
    assert other.notes == (f"it begins a new series: it differs from {first.series_name!r} in setup.feed",)


def test_the_same_test_of_another_machine_is_refused(store, tmp_path):
    add_machine(store, "Mill 4", who=WHO)
    write_test(tmp_path / "one")
    got = import_test(store, tmp_path / "one", machine="Mill 3", who=WHO)
    with pytest.raises(InputError, match=f"is in the history as test {got.test} of 'Mill 3'.*set that one aside"):
        import_test(store, tmp_path / "one", machine="Mill 4", who=WHO)


def spoiled(folder, old: str, new: str):
    text = (folder / "test.toml").read_text()
    assert old in text
    (folder / "test.toml").write_text(text.replace(old, new))


BAD = {
    "no date": (lambda f: spoiled(f, 'date = "2026-03-01"', ""), {}, "write date = 2026-03-01 under \\[about\\]"),
    "future": (lambda f: spoiled(f, "2026-03-01", "2026-03-04"), {}, "is 2026-03-04, which is in the future"),
    "an hour or more ahead": (
        lambda f: spoiled(f, "2026-03-01", "2026-03-02T10:30+01:00"), {}, "is in the future: it is 2026-03-02 08:00 UTC",
    ),
    "another spelling": (lambda f: spoiled(f, "2026-03-01", "01.03.2026"), {}, "is '01.03.2026'; write it as 2026-03-01"),
    "a clock never set": (lambda f: spoiled(f, "2026-03-01", "1970-01-01"), {}, "nothing was measured then"),
    "two dates": (lambda _: None, {"date": "2026-02-01"}, "was measured on 2026-03-01, not on 2026-02-01"),
    "no machine": (lambda _: None, {"machine": None}, "does not say which machine it is of; give --machine NAME"),
    "unknown machine": (lambda _: None, {"machine": "Mill 33"}, "no machine 'Mill 33'; did you mean 'Mill 3'"),
    "unknown number": (
        lambda f: spoiled(f, "[about]", '[about]\nmachine_serial = "9"'), {"machine": None}, "which no machine of",
    ),
    "two machines": (
        lambda f: spoiled(f, "[about]", '[about]\nmachine_serial = "9"'), {}, "with the serial number '9', and 'Mill 3' has",
    ),
    "kelvin": (lambda f: spoiled(f, "[about]", "[about]\ntemperature_degC = 295"), {}, "is it in kelvin"),
    "a run is missing": (lambda f: (f / "runs/36N.csv").unlink(), {}, "36N.csv: cannot be opened"),
    "half a run": (lambda f: (f / "runs/36N.csv").write_bytes(b"angle_deg,radial_um\n0,1\n15"), {}, "36N.csv"),
    "no test": (lambda f: (f / "test.toml").write_text('schema = "elastogeo.machine/1"'), {}, "is no test"),
    "no folder": (shutil.rmtree, {}, "is not there"),
    "repeats nothing": (lambda _: None, {"repeats": "last"}, "has no test yet that this one could repeat"),
    "repeats a stranger": (lambda _: None, {"repeats": 99}, "test 99 is none of this series"),
    "repeats a word": (lambda _: None, {"repeats": "first"}, "give last, none, or the number of a test"),
}  # fmt: skip


@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize("fault", BAD)
def test_a_bad_test_is_refused_by_name_and_leaves_nothing(fault, store, tmp_path):
    spoil, options, message = BAD[fault]
    folder = write_test(tmp_path / "one")
    spoil(folder)
    before = counts(store)
    with pytest.raises(ElastogeoError, match=message):
        import_test(store, folder, who=WHO, **{"machine": "Mill 3", **options})
    assert counts(store) == before


def test_a_file_that_changes_meanwhile_is_refused(store, tmp_path):
    found = read_with_files(write_test(tmp_path / "one"))
    with open(tmp_path / "one" / "runs" / "36N.csv", "a") as file:
        file.write("1,2\n")
    before = counts(store)
    with pytest.raises(InputError, match="changed while it was imported; nothing was imported"):
        import_test(store, found, machine="Mill 3", who=WHO)
    assert counts(store) == before


PROGRAM = """
import sys
from elastogeo.history.intake.imports import import_test
from elastogeo.history.store import open_store
store = open_store(sys.argv[1])
print(import_test(store, sys.argv[2], machine="Mill 3", who="B").new)
"""


@pytest.mark.parametrize("kind", ["truncate", "postgresql"])
def test_two_programs_that_import_one_folder_at_once_make_one_test(store, url, tmp_path):
    folder = write_test(tmp_path / "one", date="2025-03-01")
    command = [sys.executable, "-c", PROGRAM, url, str(folder)]
    both = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    said = sorted(program.communicate(timeout=60)[0].strip() for program in both)
    assert said == ["False", "True"]
    assert counts(store)["test"] == 1


def test_days_without_a_time_keep_the_order_in_which_they_came(store, tmp_path):
    dates = ["2026-03-01T14:30:00+01:00", "2026-03-01", "2026-03-01"]
    got = [
        import_test(store, write_test(tmp_path / f"{k}", date=date, seed=k), machine="Mill 3", who=WHO)
        for k, date in enumerate(dates)
    ]
    with read(store) as connection:
        order = connection.execute(select(test.c.id).order_by(test.c.at, test.c.id)).scalars().all()
    assert order == [one.test for one in got]


def test_a_change_of_zone_keeps_the_true_order(store, tmp_path):
    """Half past two of the hour that is repeated when summer time ends: the later one is later."""
    dates = ["2025-10-26T02:30:00+02:00", "2025-10-26T02:10:00+01:00"]
    first, second = (
        import_test(store, write_test(tmp_path / f"{k}", date=date, seed=k), machine="Mill 3", who=WHO)
        for k, date in enumerate(dates)
    )
    assert second.at > first.at


def test_a_clock_that_went_back_is_said(store, standing_clock, tmp_path):
    import_test(store, write_test(tmp_path / "one"), machine="Mill 3", who=WHO)
    standing_clock.advance(days=-30)
    got = import_test(store, write_test(tmp_path / "two", date="2026-01-05", seed=1), machine="Mill 3", who=WHO)
    assert [note for note in got.notes if "stands 30 days before the last import" in note]


def test_a_test_before_the_baseline_is_kept_and_said(store, tmp_path):
    first = import_test(store, write_test(tmp_path / "one"), machine="Mill 3", who=WHO)
    with write(store) as connection:
        row = {
            "series": first.series,
            "tests": [first.test],
            "since": first.at,
            "set_at": first.at,
            "who": WHO,
            "why": "new",
        }
        connection.execute(insert(baseline).values(row))
    early = import_test(store, write_test(tmp_path / "two", date="2026-02-01", seed=1), machine="Mill 3", who=WHO)
    assert early.notes == (
        "it was measured before the baseline begins (2026-03-01), so it is kept and shown but not judged",
    )


def suspect(store, key: int) -> None:
    with write(store) as connection:
        row = {"series": key, "version": 1, "state": "suspect", "verdict": {}}
        connection.execute(insert(series_state).values(row))


@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize(
    ("date", "is_repeat"),
    [
        ("2026-02-22", True),
        ("2026-02-22T18:00+01:00", True),
        ("2026-02-28", True),
        ("2026-03-02", False),
        ("2026-02-20", False),
    ],
)
def test_the_next_test_of_a_suspect_series_is_its_repeat(date, is_repeat, store, tmp_path):
    for k, day in enumerate(("2025-12-22", "2026-01-22", "2026-02-22")):
        last = import_test(store, write_test(tmp_path / day, date=day, seed=k), machine="Mill 3", who=WHO)
    suspect(store, last.series)
    got = import_test(store, write_test(tmp_path / "again", date=date, seed=9), machine="Mill 3", who=WHO)
    assert (got.repeats == last.test) is is_repeat
    assert any("counts as its repeat" in note for note in got.notes) is is_repeat


@pytest.mark.parametrize("kind", ["truncate"])
def test_the_next_of_weekly_tests_is_no_repeat(store, tmp_path):
    for k, day in enumerate(("2026-02-01", "2026-02-08", "2026-02-15")):
        last = import_test(store, write_test(tmp_path / day, date=day, seed=k), machine="Mill 3", who=WHO)
    suspect(store, last.series)
    got = import_test(store, write_test(tmp_path / "next", date="2026-02-22", seed=9), machine="Mill 3", who=WHO)
    assert got.repeats is None


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_person_says_what_is_a_repeat(store, tmp_path):
    first = import_test(store, write_test(tmp_path / "a", date="2026-02-01"), machine="Mill 3", who=WHO)
    suspect(store, first.series)
    none, last = (
        import_test(store, write_test(tmp_path / day, date=day, seed=k), machine="Mill 3", who=WHO, repeats=repeats)
        for k, (day, repeats) in enumerate([("2026-02-02", "none"), ("2026-02-20", "last")], 1)
    )
    said = import_test(
        store, write_test(tmp_path / "d", date="2026-02-21", seed=3), machine="Mill 3", who=WHO, repeats=first.test
    )
    assert [none.repeats, last.repeats, said.repeats] == [None, none.test, first.test]
    with pytest.raises(InputError, match="after this one, which cannot repeat it"):
        import_test(
            store, write_test(tmp_path / "e", date="2026-01-21", seed=4), machine="Mill 3", who=WHO, repeats=first.test
        )


@pytest.mark.parametrize("kind", ["truncate"])
def test_temperature_is_that_of_the_test_else_of_its_set_up(store, tmp_path):
    warm = "machine_at = { temperature_degC = 22.5, expansion_um_per_m = 11.5 }"
    folders = [
        write_test(tmp_path / "a", setup=warm),
        write_test(tmp_path / "b", seed=1),
        write_test(tmp_path / "c", seed=2),
    ]
    spoiled(folders[1], "[about]", "[about]\ntemperature_degC = 0")
    kept = [row_of(store, import_test(store, one, machine="Mill 3", who=WHO).test).temperature for one in folders]
    assert kept == [22.5, 0.0, None]


def test_simulated_tests_have_a_series_of_their_own(store, tmp_path):
    first = import_test(store, write_test(tmp_path / "a"), machine="Mill 3", who=WHO)
    folder = write_test(tmp_path / "b")
    spoiled(folder, 'name = "Monthly"', 'name = "Monthly"\nsimulated = "tables of a book"')
    made = import_test(store, folder, machine="Mill 3", who=WHO)
    assert made.series != first.series
    assert (row_of(store, made.test).origin, row_of(store, made.test).from_what) == ("simulated", "tables of a book")
    assert made.series_name.endswith(", simulated")


def test_a_series_counts_with_the_version_that_made_it(store, tmp_path):
    got = import_test(store, write_test(tmp_path / "a"), machine="Mill 3", who=WHO)
    with read(store) as connection:
        assert connection.execute(select(series.c.software).where(series.c.id == got.series)).scalar() == VERSION
        assert connection.execute(select(func.count()).select_from(blob)).scalar() == 3

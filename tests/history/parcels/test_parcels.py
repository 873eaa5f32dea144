"""A parcel from its arrival to the import: found for what it is, imported once, read nowhere but inside, swept then."""

import os
import time

import pytest

import elastogeo as eg
from elastogeo.errors import FormatError, InputError
from elastogeo.formats import confined_to, read_with_files
from elastogeo.history.jobs import Worker
from elastogeo.history.parcels import arriving, staging, sweep_parcels
from tests.history.intake.small_tests import write_test
from tests.history.parcels.archives import packed


def files_of(folder):
    return [(path.relative_to(folder).as_posix(), path.read_bytes()) for path in sorted(folder.rglob("*")) if path.is_file()]


def arrived(store, *files):
    parcel = arriving(store.files)
    for name, content in files:
        parcel.begin(name)
        parcel.write(content)
    return parcel.keep()


def done(history, kind, asked):
    key = history.put_job(kind, asked)
    Worker(history.store).run(once=True)
    return history.job(key)


@pytest.fixture
def history(store):
    history = eg.History.of(store, "A. Nobody")
    history.add_machine("Mill 3", serial="4711")
    return history


def parcels(store):
    folder = store.files.folder / "parcels"
    return sorted(path.name for path in folder.iterdir()) if folder.exists() else []


def test_tests_are_found_confirmed_imported_and_the_same_again_changes_nothing(history, tmp_path):
    write_test(tmp_path / "s" / "said", seed=1, date="2026-02-01")
    write_test(tmp_path / "s" / "unsaid", seed=2)
    text = (tmp_path / "s" / "said" / "test.toml").read_text()
    (tmp_path / "s" / "said" / "test.toml").write_text(text.replace("[about]\n", '[about]\nmachine_serial = "4711"\n'))
    sent = [("all.zip", packed(files_of(tmp_path / "s"))), ("notes.txt", b"hello"), ("bad/test.toml", b'schema = "x" y\n')]
    looked = done(history, "look", {"parcel": arrived(history.store, *sent)})
    assert looked.state == "done", looked.error
    found = looked.result
    assert [(one["path"], one["machine"], one["serial"], one["known"]) for one in found["tests"]] == [
        ("said", "Mill 3", "4711", None),
        ("unsaid", "", "", None),
    ]
    assert [one["path"] for one in found["others"]] == ["notes.txt"]
    assert found["errors"] == [
        "bad/test.toml: is no TOML: Expected newline or end of document after a statement (at line 1, column 14); "
        "see https://toml.io for how it is written"
    ]
    asked = {"parcel": found["parcel"], "machines": {"": "Mill 3"}, "date": "", "known": []}
    for _ in range(2):  # killed after its last import and done again, it tells the same
        came = done(history, "import", asked).result
        assert [(one["path"], one["new"], one["machine"]) for one in came["tests"]] == [
            ("said", True, "Mill 3"),
            ("unsaid", True, "Mill 3"),
        ]
        assert came["errors"] == found["errors"]
    assert len(history.series("Mill 3")) == 1
    told = [row.new["from"] for row in history.audit(subject="test 1").rows if row.what == "import"]
    assert told == ["upload: said"]
    again = done(history, "look", {"parcel": arrived(history.store, *sent)})
    assert [one["known"]["test"] for one in again.result["tests"]] == [1, 2]
    assert "2 tests known already: nothing was changed" in str(again)
    assert all(check.passed for check in history.verify().verdict)


def test_a_test_that_says_no_machine_is_not_imported_without_one(history, tmp_path):
    write_test(tmp_path / "t", seed=1)
    looked = done(history, "look", {"parcel": arrived(history.store, *files_of(tmp_path))})
    came = done(history, "import", {"parcel": looked.result["parcel"]}).result
    assert came["tests"] == []
    assert came["errors"][0].startswith("t/test.toml: does not say which machine it is of")


def test_loose_run_files_go_where_the_test_beside_them_names_them(history, tmp_path):
    write_test(tmp_path / "t", seed=1)
    loose = [(name.rpartition("/")[2], content) for name, content in files_of(tmp_path / "t")]
    assert any("/" in name for name, _ in files_of(tmp_path / "t")), "the test has its runs in a folder"
    looked = done(history, "look", {"parcel": arrived(history.store, *loose)})
    assert [one["path"] for one in looked.result["tests"]] == ["what was sent"]
    assert looked.result["errors"] == looked.result["others"] == []


def test_a_campaign_is_kept_with_its_tests(history, tmp_path):
    for n, name in enumerate(("xy", "yz")):
        write_test(tmp_path / "c" / name, seed=n)
    text = 'schema = "elastogeo.campaign/1"\nname = "May"\ntests = ["xy", "yz"]\n'
    (tmp_path / "c" / "campaign.toml").write_text(text)
    looked = done(history, "look", {"parcel": arrived(history.store, ("c.zip", packed(files_of(tmp_path))))})
    assert looked.result["campaigns"] == [{"path": "c", "name": "May", "tests": 2}]
    came = done(history, "import", {"parcel": looked.result["parcel"], "machines": {"": "Mill 3"}}).result
    assert (len(came["tests"]), len(came["campaigns"]), came["errors"]) == (2, 1, [])
    assert [one.name for one in history.campaigns().campaigns] == ["May"]


OUTSIDE = ("/etc/passwd", "../../../../../../../../../etc/passwd", "../../names.json")


@pytest.mark.parametrize("path", OUTSIDE)
def test_no_file_outside_of_what_was_sent_is_read(history, tmp_path, path):
    place = write_test(tmp_path / "t", seed=1)
    text = place.joinpath("test.toml").read_text()
    named = next(line for line in text.splitlines() if line.startswith("file = "))
    place.joinpath("test.toml").write_text(text.replace(named, f'file = "{path}"'))
    looked = done(history, "look", {"parcel": arrived(history.store, *files_of(tmp_path))})
    assert looked.result["tests"] == []
    (error,) = looked.result["errors"]
    assert "lies outside of what was sent; send the file too" in error
    assert "root" not in error
    assert str(tmp_path) not in error


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('machine = "hermle_c50"', 'machine = "../../{name}.toml"'),
        ('instrument = "loaded-ball-bar"', 'instrument = "loaded-ball-bar"\ncalibration = "../../{name}.toml"'),
    ],
)
def test_whether_a_file_is_outside_is_not_told(tmp_path, old, new):
    """The answer is the same whether it is there or not."""
    place = write_test(tmp_path / "sent" / "t", seed=1)
    text = place.joinpath("test.toml").read_text()
    said = []
    for name in ("x1y", "x2y"):
        (tmp_path / "x1y.toml").write_text('schema = "elastogeo.machine/1"\n')
        place.joinpath("test.toml").write_text(text.replace(old, new.format(name=name)))
        with confined_to(tmp_path / "sent"), pytest.raises(eg.ElastogeoError) as refused:
            read_with_files(place)
        said.append(str(refused.value).replace(name, "NAME"))
    assert said[0] == said[1]


def test_reading_is_free_again_after_it_was_confined(tmp_path):
    place = write_test(tmp_path / "t", seed=1)
    (tmp_path / "empty").mkdir()
    with confined_to(tmp_path / "empty"), pytest.raises(FormatError, match="lies outside of what was sent"):
        read_with_files(place)
    assert read_with_files(place).test.name == "Monthly"


def test_a_parcel_is_there_when_all_of_it_is_and_not_before(store):
    half = arriving(store.files)
    half.begin("a")
    half.write(b"x")
    name = arrived(store, ("b", b"y"))
    assert parcels(store) == sorted([name, f"{half.name}.part"])
    with pytest.raises(InputError, match="what was sent is no longer there"):
        staging.parcel(store.files, half.name)
    assert [said for said, _ in staging.sent(staging.parcel(store.files, name))] == ["b"]
    half.drop()
    assert parcels(store) == [name]


@pytest.mark.parametrize("name", ["..", "../..", "", "a" * 31, "A" * 32, "0" * 32])
def test_a_parcel_has_no_other_name(store, name):
    with pytest.raises(InputError, match="what was sent is no longer there"):
        staging.parcel(store.files, name)


def test_a_parcel_is_no_larger_and_holds_no_more_files_than_it_may(store, monkeypatch):
    monkeypatch.setattr(staging, "LARGEST", 10)
    monkeypatch.setattr(staging, "MOST_FILES", 2)
    parcel = arriving(store.files)
    parcel.begin("a")
    parcel.write(b"x" * 10)
    with pytest.raises(InputError, match="were sent at once"):
        parcel.write(b"x")
    parcel.begin("b")
    with pytest.raises(InputError, match="more than 2 files were sent at once"):
        parcel.begin("c")
    parcel.drop()
    with pytest.raises(InputError, match="no file was sent"):
        arriving(store.files).keep()


def test_parcels_are_swept_when_they_are_imported_old_or_never_came_whole(history, tmp_path):
    write_test(tmp_path / "t", seed=1)
    store = history.store
    imported = arrived(store, *files_of(tmp_path))
    done(history, "look", {"parcel": imported})
    done(history, "import", {"parcel": imported, "machines": {"": "Mill 3"}})
    old, fresh, waiting = (arrived(store, ("a", b"x")) for _ in range(3))
    half, live = arriving(store.files), arriving(store.files)
    history.put_job("look", {"parcel": waiting})
    for folder, age in ((old, 90_000), (waiting, 90_000), (half.folder.name, 4000)):
        for path in (store.files.folder / "parcels" / folder).rglob("*"):
            os.utime(path, (time.time() - age,) * 2)
        os.utime(store.files.folder / "parcels" / folder, (time.time() - age,) * 2)
    assert sweep_parcels(store) == 3
    assert parcels(store) == sorted([fresh, waiting, live.folder.name])

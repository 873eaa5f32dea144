"""What persons say of machines, instruments and tests: with a reason, into the audit trail; what cannot be is refused."""

from datetime import UTC, datetime

import pytest
from sqlalchemy import func, select

from elastogeo.changes import EVENT_KINDS
from elastogeo.errors import InputError
from elastogeo.history.intake.asides import set_test_aside
from elastogeo.history.intake.happenings import record_event
from elastogeo.history.intake.imports import import_test
from elastogeo.history.intake.instruments import add_instrument, overdue
from elastogeo.history.intake.machines import add_machine, machines
from elastogeo.history.store import audit, read
from elastogeo.history.store.schema import calibration, event, metadata, set_aside
from tests.history.intake.small_tests import write_test

WHO = "A. Nobody"


@pytest.fixture
def mill(store):
    return add_machine(store, "Mill 3", who=WHO, serial="4711")


pytestmark = pytest.mark.usefixtures("standing_clock", "mill")


def brought(store, folder, *dates: str, **more):
    """The keys of tests of these days, and of their series."""
    found = [
        import_test(store, write_test(folder / f"{k}", date=date, seed=k, **more), machine="Mill 3", who=WHO)
        for k, date in enumerate(dates)
    ]
    return [one.test for one in found], found[0].series


def trail(store) -> list[tuple[str, str, str]]:
    with read(store) as connection:
        assert audit.verify(connection) == ()
        table = metadata.tables["audit"]
        return [tuple(row) for row in connection.execute(select(table.c.what, table.c.subject, table.c.why))]


def test_a_machine_whose_name_people_do_not_tell_from_another_is_refused(store):
    for alike in ("mill 3", "MILL 3", "Mill  3", "\N{FULLWIDTH LATIN CAPITAL LETTER M}ill 3"):
        with pytest.raises(InputError, match=r"is 'Mill 3' but for letters or blanks; use that name"):
            add_machine(store, alike, who=WHO)
    assert add_machine(store, "Mill 3", who=WHO, place="hall 2").place == "hall 2"
    assert add_machine(store, "Mill 33", who=WHO).name == "Mill 33"
    with read(store) as connection:
        assert [one.name for one in machines(connection)] == ["Mill 3", "Mill 33"]


def test_a_test_is_set_aside_and_taken_back(store, tmp_path):
    (one, _), _ = brought(store, tmp_path, "2026-02-01", "2026-02-02")
    assert set_test_aside(store, one, who=WHO, why="ball not seated").aside
    with pytest.raises(InputError, match=f"test {one} is set aside already"):
        set_test_aside(store, one, who=WHO, why="again")
    assert not set_test_aside(store, one, who=WHO, why="it was", back=True).aside
    with read(store) as connection:
        assert [row.why for row in connection.execute(select(set_aside).order_by(set_aside.c.id))] == [
            "ball not seated",
            "it was",
        ]
    assert trail(store)[-2:] == [
        ("set aside", f"test {one}", "ball not seated"),
        ("take back", f"test {one}", "it was"),
    ]


@pytest.mark.parametrize("kind", ["truncate"])
def test_setting_aside_needs_a_test_and_a_reason(store, tmp_path):
    (one,), _ = brought(store, tmp_path, "2026-02-01")
    with pytest.raises(InputError, match="for a reason; say it with --why"):
        set_test_aside(store, one, who=WHO, why=" ")
    with pytest.raises(InputError, match="there is no test 99"):
        set_test_aside(store, 99, who=WHO, why="x")
    with pytest.raises(InputError, match="is not set aside already"):
        set_test_aside(store, one, who=WHO, why="x", back=True)


def test_a_test_that_is_set_aside_says_so_when_it_comes_again(store, tmp_path):
    (one,), _ = brought(store, tmp_path, "2026-02-01")
    set_test_aside(store, one, who=WHO, why="ball not seated")
    again = import_test(store, tmp_path / "0", machine="Mill 3", who=WHO)
    assert (again.new, again.notes) == (False, ("it was set aside by A. Nobody",))


@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize("kind_of_event", EVENT_KINDS)
def test_an_event_stands_on_a_machine(kind_of_event, store):
    got = record_event(store, kind_of_event, "carriage 2 replaced", who=WHO, machine="Mill 3", at="2026-02-03")
    with read(store) as connection:
        row = connection.execute(select(event)).one()
    assert (row.kind, row.note, row.at) == (kind_of_event, "carriage 2 replaced", datetime(2026, 2, 3, 12, tzinfo=UTC))
    assert (row.instrument, got.of) == (None, "Mill 3")
    assert trail(store)[-1] == ("add event", f"event {got.key}", "")


def test_an_event_stands_on_an_instrument(store, standing_clock):
    add_instrument(store, "B7", who=WHO)
    got = record_event(store, "note", "dropped", who=WHO, instrument="B7")
    assert (got.of, got.at) == ("instrument B7", standing_clock.time)


@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize(
    ("kind_of_event", "note", "more", "message"),
    [
        ("explosion", "x", {"machine": "Mill 3"}, "'explosion' is no kind of event; write one of repair, parameter edit"),
        ("repair", " ", {"machine": "Mill 3"}, "an event needs a note"),
        ("repair", "x", {}, "of one machine or of one instrument; give --machine NAME or --instrument SERIAL"),
        ("repair", "x", {"machine": "Mill 3", "instrument": "B7"}, "of one machine or of one instrument"),
        ("repair", "x", {"machine": "Mill 33"}, "no machine 'Mill 33'; did you mean 'Mill 3'"),
        ("repair", "x", {"instrument": "B9"}, "no instrument 'B9'; there is none yet"),
        (
            "repair",
            "x",
            {"machine": "Mill 3", "at": "2027-01-01"},
            "the event is 2027-01-01, which is in the future",
        ),
    ],
)
def test_an_event_that_cannot_be_is_refused(kind_of_event, note, more, message, store):
    with pytest.raises(InputError, match=message):
        record_event(store, kind_of_event, note, who=WHO, **more)


def test_a_calibration_holds_until_it_is_due(store):
    known = add_instrument(store, "B7", who=WHO, kind="loaded-ball-bar", calibrated="2025-01-10", due="2026-01-10")
    again = add_instrument(store, "B7", who=WHO, calibrated="2025-01-10", due="2026-01-10")
    assert again.key == known.key
    with read(store) as connection:
        assert connection.execute(select(func.count()).select_from(calibration)).scalar() == 1
        assert overdue(connection, known.key, datetime(2026, 1, 9, tzinfo=UTC)) is None
        assert overdue(connection, known.key, datetime(2026, 1, 11, tzinfo=UTC)) == datetime(2026, 1, 10, 12, tzinfo=UTC)
        assert overdue(connection, known.key, datetime(2024, 1, 11, tzinfo=UTC)) is None


def test_a_test_made_with_an_instrument_whose_calibration_ran_out_says_so(store, tmp_path):
    add_instrument(store, "B7", who=WHO, calibrated="2025-01-10", due="2026-01-10")
    folder = write_test(tmp_path / "t", instrument_serial="B7")
    got = import_test(store, folder, machine="Mill 3", who=WHO)
    assert got.notes == ("the calibration of instrument B7 had run out on 2026-01-10",)


@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"due": "2026-01-10"}, "give its date with --calibrated"),
        ({"calibrated": "2026-01-10", "due": "2025-01-10"}, "before it was made"),
        ({"calibrated": "2026-05-10"}, "in the future"),
        ({"calibrated": "2026-01-10", "due": "9999-12-31"}, "9999-12-31, more than 100 years from now; leave --due out"),
        ({"calibrated": "in May"}, "write it as 2026-03-01"),
    ],
)
def test_a_calibration_that_cannot_be_is_refused(more, message, store):
    with pytest.raises(InputError, match=message):
        add_instrument(store, "B7", who=WHO, **more)


def test_more_is_said_of_a_machine(store):
    more = add_machine(store, "Mill 3", who=WHO, place="hall 2")
    assert (more.serial, more.place) == ("4711", "hall 2")
    with read(store) as connection:
        assert machines(connection) == (more,)
    assert trail(store)[-1][0] == "change machine"


@pytest.mark.parametrize("kind", ["truncate"])
def test_two_machines_with_one_number_and_names_that_are_none_are_refused(store):
    with pytest.raises(InputError, match="'Mill 3' has the serial number '4711' already"):
        add_machine(store, "Mill 4", who=WHO, serial="4711")
    with pytest.raises(InputError, match="is no name for a machine"):
        add_machine(store, " ", who=WHO)

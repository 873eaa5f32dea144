"""From the store to the charts: which tests, which indicators, which version."""

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
import pytest
from sqlalchemy import Connection, Table, insert

from elastogeo.changes import MOST, Signatures
from elastogeo.errors import InputError
from elastogeo.history.series_of import days, instant, series_of
from elastogeo.history.store import Store, schema, write

BEGAN = datetime(2026, 3, 1, 12, tzinfo=UTC)


@pytest.fixture
def connection(store: Store) -> Iterator[Connection]:
    """One series without tests, that counts with 1.0."""
    with write(store) as found:
        add(found, schema.machine, name="Mill 3", made_at=BEGAN)
        add(found, schema.series, machine=1, name="circle XY", recipe={}, recipe_sha256="r", software="1.0")
        add(found, schema.instrument, serial="B-7", made_at=BEGAN)
        yield found


def add(connection: Connection, table: Table, **values: Any) -> int:
    return int(connection.execute(insert(table).values(**values)).inserted_primary_key[0])  # type: ignore[index]


def add_test(connection: Connection, day: float, software: str = "1.0", **told: float) -> int:
    """A test on a day after `BEGAN`, analysed by a version; indicators with `_` for blanks, all stiffnesses."""
    name = f"on day {day:g}"
    at = BEGAN + timedelta(days=day)
    row = {"series": 1, "sha256": f"{name} {software}", "name": name, "at": at, "imported_at": at, "origin": "measured"}
    key = add(connection, schema.test, **row, about={})
    add_analysis(connection, key, software, **told)
    return key


def add_analysis(connection: Connection, test: int, software: str = "1.0", inputs: str = "i", **told: float) -> int:
    row = {"test": test, "software": software, "settings": {}, "inputs_sha256": inputs, "made_at": BEGAN, "supported": True}
    key = add(connection, schema.analysis, **row)
    for name, value in told.items():
        named = {"analysis": key, "name": name.replace("_", " "), "kind": "stiffness"}
        add(connection, schema.indicator, **named, value=value, standard_uncertainty=value / 100)
    return key


def test_tests_stand_in_the_order_of_their_dates_not_of_their_import(connection: Connection) -> None:
    late, early, between = add_test(connection, 9, X=3.0), add_test(connection, 1, X=1.0), add_test(connection, 4, X=2.0)
    found = series_of(connection, 1)
    assert found.tests == (str(early), str(between), str(late))
    assert found.value[:, 0].tolist() == [1.0, 2.0, 3.0]
    assert np.diff(found.date).tolist() == [3.0, 5.0]
    assert found.name == "Mill 3: circle XY"


def test_two_tests_of_one_instant_keep_the_order_of_import(connection: Connection) -> None:
    first, second = add_test(connection, 1, X=1.0), add_test(connection, 1, software="1.0 ", X=9.0)
    add_analysis(connection, second, X=2.0)
    found = series_of(connection, 1)
    assert found.tests == (str(first), str(second))
    assert found.value[:, 0].tolist() == [1.0, 2.0]


def test_a_chart_never_mixes_versions(connection: Connection) -> None:
    both = add_test(connection, 1, X=1.0)
    add_analysis(connection, both, "2.0", X=100.0)
    add_test(connection, 2, "2.0", X=200.0)
    found = series_of(connection, 1)
    assert found.tests == (str(both),)
    assert found.value.tolist() == [[1.0]]
    connection.execute(schema.series.update().values(software="2.0"))
    assert series_of(connection, 1).value[:, 0].tolist() == [100.0, 200.0]


def test_of_several_analyses_by_one_version_the_last_counts(connection: Connection) -> None:
    key = add_test(connection, 1, X=1.0)
    add_analysis(connection, key, inputs="second attempt", X=2.0)
    assert series_of(connection, 1).value.tolist() == [[2.0]]


def test_what_a_test_does_not_determine_is_no_number(connection: Connection) -> None:
    add_test(connection, 1, X=1.0, Y=5.0)
    add_test(connection, 2, X=2.0)
    failed = add_test(connection, 3)
    found = series_of(connection, 1)
    assert found.indicators == ("X",)
    add_test(connection, 4, X=2.0, Y=5.0)
    found = series_of(connection, 1)
    assert found.indicators == ("X", "Y")
    assert np.isnan(found.value).tolist() == [[False, False], [False, True], [True, True], [False, False]]
    assert found.standard_uncertainty[0].tolist() == [0.01, 0.05]
    assert str(failed) in found.tests


def test_a_frozen_baseline_freezes_what_is_watched(connection: Connection) -> None:
    base = [add_test(connection, day, X=1.0, Y=2.0) for day in range(3)]
    frozen = {"series": 1, "since": BEGAN, "set_at": BEGAN, "who": "A. Miller", "why": "after installation"}
    add(connection, schema.baseline, tests=base, **frozen)
    for day in range(3, 20):
        add_test(connection, day, Z=7.0, X=1.0)
    assert series_of(connection, 1).indicators == ("X", "Y")
    add(connection, schema.baseline, tests=[base[-1] + k for k in range(1, 7)], **frozen)
    assert set(series_of(connection, 1).indicators) == {"X", "Z"}


def test_tests_that_are_set_aside_do_not_decide_what_is_watched_without_a_baseline(connection: Connection) -> None:
    add_test(connection, 1, X=1.0)
    for day in (2, 3, 4):
        key = add_test(connection, day, Y=1.0)
        add(connection, schema.set_aside, test=key, aside=True, at=BEGAN, who="A. Miller", why="wrong ball")
    found = series_of(connection, 1)
    assert found.indicators == ("X",)
    assert found.aside.tolist() == [False, True, True, True]


def test_what_was_said_last_of_setting_aside_counts(connection: Connection) -> None:
    key = add_test(connection, 1, X=1.0)
    for aside in (True, False, True, False):
        add(connection, schema.set_aside, test=key, aside=aside, at=BEGAN, who="A. Miller", why="")
    assert series_of(connection, 1).aside.tolist() == [False]


def test_at_most_eight_are_watched_the_commonest_first(connection: Connection) -> None:
    add_test(connection, 1, **{f"rare {k}": 1.0 for k in range(4)}, **{f"common {k}": 1.0 for k in range(7)})
    add_test(connection, 2, **{f"common {k}": 1.0 for k in range(7)})
    found = series_of(connection, 1).indicators
    assert len(found) == MOST
    assert found == (*(f"common {k}" for k in range(7)), "rare 0")


def test_repeats_instruments_temperatures_and_what_is_simulated(connection: Connection) -> None:
    suspect = add_test(connection, 2, X=1.0)
    row = {"series": 1, "at": BEGAN + timedelta(days=2.2), "imported_at": BEGAN, "about": {}, "name": "again"}
    row |= {"sha256": "a", "origin": "simulated", "from_what": "a truth"}
    again = add(connection, schema.test, **row, temperature=21.5, repeats=suspect, instrument=1)
    add_analysis(connection, again, X=1.0)
    add_test(connection, 1, X=1.0)
    found = series_of(connection, 1)
    assert found.repeats.tolist() == [-1, -1, 1]
    assert found.instruments == ("", "", "B-7")
    assert found.temperature[2] == 21.5
    assert np.isnan(found.temperature[:2]).all()
    assert found.simulated == "a truth"


def test_a_test_that_repeats_one_outside_the_series_repeats_none(connection: Connection) -> None:
    other = add_test(connection, 1, "2.0", X=1.0)
    row = {"series": 1, "at": BEGAN + timedelta(days=2), "imported_at": BEGAN, "about": {}, "name": "again", "sha256": "a"}
    again = add(connection, schema.test, **row, origin="measured", repeats=other)
    add_analysis(connection, again, X=1.0)
    assert series_of(connection, 1).repeats.tolist() == [-1]


def test_what_faults_do_is_told_by_the_first_test_that_decides_and_knows_it(connection: Connection) -> None:
    row = {"test": add_test(connection, 1, X=1.0), "software": "1.0", "settings": {}, "made_at": BEGAN, "supported": True}
    assert series_of(connection, 1).signatures is None
    told = [Signatures((f"drive {axis}",), ("X",), np.array([[size]]), (True,)) for axis, size in (("X", 1.0), ("Y", 2.0))]
    for day, one in enumerate(told):
        add(connection, schema.analysis, **row, inputs_sha256=f"{day}", signatures=one.document())
        row["test"] = add_test(connection, 2 + day)
    assert series_of(connection, 1).signatures == told[0]


def test_a_series_without_tests_is_empty(connection: Connection) -> None:
    found = series_of(connection, 1)
    assert (len(found), found.indicators, found.value.shape) == (0, (), (0, 0))


def test_a_series_that_is_not_there_is_refused(connection: Connection) -> None:
    with pytest.raises(InputError, match="there is no series 7; `elastogeo history list` shows"):
        series_of(connection, 7)


def test_a_kind_that_this_version_does_not_know_asks_for_a_recomputation(connection: Connection) -> None:
    key = add_test(connection, 1)
    add(connection, schema.indicator, analysis=key, name="hue", kind="colour", value=1.0)
    with pytest.raises(InputError, match="no indicators of the kind 'colour'; run elastogeo history recompute"):
        series_of(connection, 1)


def test_days_and_instants_are_inverse_to_a_microsecond() -> None:
    assert days(datetime(1970, 1, 2, tzinfo=UTC)) == 1.0
    for micro in (0, 1, 999_999):
        at = BEGAN + timedelta(microseconds=micro)
        assert abs(instant(days(at)) - at) <= timedelta(microseconds=1)
    assert days(datetime.fromisoformat("2026-03-01T13:00:00+01:00")) == days(BEGAN)

"""`elastogeo history baseline`, `tolerance`, `interval`: what a person wants of a series, said and kept."""

import pytest
from sqlalchemy import select

from elastogeo.changes import Tolerance
from elastogeo.history.requirements.tolerances import tolerance_of
from elastogeo.history.store import open_store, read
from elastogeo.history.store.schema import baseline, series
from tests.history.alarms.shop import DAY, START, make_series, make_test


@pytest.fixture
def shop(tmp_path):
    """A history with one machine and eight tests of it; its path and the series."""
    path = tmp_path / "shop.db"
    store = open_store(path, create=True, who="the tests")
    of = make_series(store)
    for k in range(8):
        make_test(store, of, START + 7 * k * DAY, {"stiffness X": ("stiffness", 16_000.0), "backlash X": ("backlash", 1e-3)})
    yield path, store, of
    store.close()


def test_a_baseline_is_set_once(shop, elastogeo):
    path, store, _ = shop
    words = ("history", "baseline", "C50 no. 3", "--first", 6, "--why", "new machine", "--store", path)
    assert elastogeo(*words) == (0, "Baseline set: 6 tests, 2026-03-02 to 2026-04-06.\n", "")
    assert elastogeo(*words)[1].startswith("Baseline is as it was: 6 tests")
    with read(store) as connection:
        assert connection.execute(select(baseline.c.why)).scalars().all() == ["new machine"]


def test_a_baseline_of_days_and_one_of_nothing(shop, elastogeo):
    path, _, _ = shop
    words = ("history", "baseline", "C50 no. 3", "--why", "repaired", "--store", path)
    assert elastogeo(*words, "--from", "2026-03-16", "--to", "2026-03-31")[1] == (
        "Baseline set: 3 tests, 2026-03-16 to 2026-03-30.\n"
    )
    code, out, err = elastogeo(*words)
    assert (code, out) == (2, "")
    assert "say which tests: --first 10" in err


def test_a_tolerance_is_said_in_the_unit_that_is_shown(shop, elastogeo):
    path, store, of = shop
    words = ("history", "tolerance", "C50 no. 3", "--why", "part 4711", "--store", path)
    code, out, _ = elastogeo(*words, "stiffness X", "--lower", 13, "--matters", 5)
    assert (code, out) == (0, "Tolerance of stiffness X: at least 13 N/µm, a change matters from 5 % on.\n")
    assert elastogeo(*words, "backlash X", "--upper", 4, "--matters", 2)[1] == (
        "Tolerance of backlash X: at most 4 µm, a change matters from 2 µm on.\n"
    )
    with read(store) as connection:
        assert tolerance_of(connection, of, "stiffness X") == Tolerance(13_000.0, None, 0.05)
        assert tolerance_of(connection, of, "backlash X") == Tolerance(None, 0.004, 0.002)
    assert elastogeo(*words, "stiffness X")[1] == "Tolerance of stiffness X: none.\n"
    assert "it has: backlash X, stiffness X" in elastogeo(*words, "stiffness Z", "--lower", 1)[2]


def test_an_interval_is_set_and_taken_back(shop, elastogeo):
    path, store, _ = shop
    words = ("history", "interval", "C50 no. 3", "--store", path)
    assert elastogeo(*words, 30)[1] == "C50 no. 3 is tested every 30 days, with 7 days of grace.\n"
    with read(store) as connection:
        assert connection.scalar(select(series.c.interval_days)) == 30.0
    assert elastogeo(*words, 0)[1] == "C50 no. 3: no date.\n"
    with read(store) as connection:
        assert connection.scalar(select(series.c.interval_days)) is None

"""Computing again: the same bits by the same version; a new version takes the whole series or nothing of it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select

from elastogeo.changes import KINDS, Indicator
from elastogeo.errors import InputError
from elastogeo.history.analyses import analyse, outdated, recompute
from elastogeo.history.analyses import analysing as analysing_module
from elastogeo.history.analyses import recomputing as recomputing_module
from elastogeo.history.analyses.computation import Computed
from elastogeo.history.analyses.raw import RawFile
from elastogeo.history.analyses.recomputing import _all_computed, _Job
from elastogeo.history.records import Records
from elastogeo.history.series_of import series_of
from elastogeo.history.store import Files, Store, audit, read, schema
from elastogeo.version import VERSION
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test

OLD, NEW = "0.0.9", "99.0"


@dataclass
class StandIn:
    """What stands in for the computation: the stiffness that the file says, times what this version makes of it."""

    factor: float = 1.0
    errors: set[bytes] = field(default_factory=set)
    seen: list[bytes] = field(default_factory=list)
    before: Callable[[], None] = lambda: None

    def __call__(self, files: Any, raw: tuple[RawFile, ...], attempt: int = 1) -> Computed:
        self.before()
        content = files.read(raw[0].sha256)
        self.seen.append(content)
        settings = {"verb": "identify", **({"attempt": attempt} if attempt > 1 else {})}
        if content in self.errors:
            return Computed(settings, f"{raw[0].sha256} {attempt}", None, False, (), None, "cannot be read")
        value = float(content) * self.factor
        indicator = Indicator("stiffness X", KINDS["stiffness"], value, 0.1)
        document = {"software": {"version": recomputing_module.VERSION}, "values": [value, 1.0], "name": "circle"}
        return Computed(settings, f"{raw[0].sha256} {attempt}", document, True, (indicator,), None, None)


@pytest.fixture
def stand_in(monkeypatch: pytest.MonkeyPatch) -> StandIn:
    found = StandIn()
    for module in (analysing_module, recomputing_module):
        monkeypatch.setattr(module, "computed", found)
    return found


def use_version(monkeypatch: pytest.MonkeyPatch, version: str) -> None:
    for module in (analysing_module, recomputing_module):
        monkeypatch.setattr(module, "VERSION", version)


def keep_three(store: Store, software: str = VERSION) -> int:
    series = keep_series(store, software=software)
    for day in range(3):
        analyse(store, keep_test(store, series, {"test.toml": b"%d" % (100 + day)}, day))
    return series


def values(store: Store, series: int) -> list[float]:
    with read(store) as connection:
        return [float(value) for value in series_of(connection, series).value[:, 0]]


def software_of(store: Store, series: int) -> str:
    with read(store) as connection:
        return str(connection.execute(select(schema.series.c.software).where(schema.series.c.id == series)).scalar_one())


def analyses(store: Store) -> int:
    with read(store) as connection:
        return len(connection.execute(select(schema.analysis.c.id)).all())


def test_the_same_version_gives_the_same_bits(store: Store) -> None:
    """The real computation, from raw files to the hash of the document."""
    series = keep_series(store)
    test = keep_test(store, series, files_of(EXAMPLES / "static-rig"))
    analyse(store, test)
    found = recompute(store, [series])
    assert [(one.test, one.same_bits, one.differing, one.error) for one in found.tests] == [(test, True, (), "")]
    assert (found.switched, found.changed) == ({}, ())
    (check,) = found.verdict
    assert (check.passed, check.decisive, check.facts["compared"], check.facts["same_bits"]) == (True, True, 1, 1)
    assert analyses(store) == 1


@pytest.mark.nightly
def test_several_processes_find_the_same(tmp_path: Path) -> None:
    """In the order in which they were asked; each process imports everything, which takes seconds."""
    files = Files(tmp_path)
    raw = tuple(RawFile(path, files.put(content)) for path, content in files_of(EXAMPLES / "static-rig").items())
    todo = [_Job(1, "one", raw, None, 1), _Job(2, "two", raw[:1], None, 1), _Job(3, "three", raw, None, 1)]
    alone, together = list(_all_computed(files, todo, 1)), list(_all_computed(files, todo, 2))
    assert [one.document_sha256 for one in together] == [one.document_sha256 for one in alone]
    assert [one.error is None for one in together] == [True, False, True]


def test_what_differs_by_the_same_version_is_said_and_nothing_is_written(store: Store, stand_in: StandIn) -> None:
    series = keep_three(store)
    stand_in.factor = 1.0 + 1e-9
    found = recompute(store, [series])
    assert [one.same_bits for one in found.tests] == [False] * 3
    first = found.tests[0].differing
    assert [(entry.path, entry.old) for entry in first] == [("document.values[0]", "100.0")]
    assert first[0].relative == pytest.approx(1e-9, rel=1e-3)
    assert found.verdict[0].passed is False
    assert found.verdict[0].facts["differing"] == 3
    assert values(store, series) == [100.0, 101.0, 102.0]
    assert analyses(store) == 3


def test_last_digits_may_differ_on_another_platform(store: Store, stand_in: StandIn) -> None:
    series = keep_three(store)
    stand_in.factor = 1.0 + 4e-16
    found = recompute(store, [series])
    assert not any(one.same_bits for one in found.tests)
    assert [one.differing for one in found.tests] == [()] * 3
    assert found.verdict[0].passed is True
    assert found.verdict[0].facts["same_bits"] == 0


def test_a_new_version_switches_the_whole_series(store: Store, stand_in: StandIn, monkeypatch: pytest.MonkeyPatch) -> None:
    use_version(monkeypatch, OLD)
    series, other = keep_three(store, OLD), keep_series(store, name="another", software=OLD)
    use_version(monkeypatch, NEW)
    stand_in.factor = 2.0
    with read(store) as connection:
        assert outdated(connection) == (series, other)
    found = recompute(store, [series], "A. Miller")
    assert (found.switched, found.changed) == ({"Mill 3: circle XY": (OLD, NEW)}, (series,))
    assert values(store, series) == [200.0, 202.0, 204.0]
    assert (software_of(store, series), software_of(store, other)) == (NEW, OLD)
    assert [(one.before, one.now) for one in found.tests] == [(OLD, NEW)] * 3
    assert found.verdict[0].passed is None
    with read(store) as connection:
        assert outdated(connection) == (other,)
        said = connection.execute(select(schema.audit).order_by(schema.audit.c.number.desc())).mappings().first()
        assert said is not None
        assert (said["who"], said["what"], said["old"], said["new"]) == (
            "A. Miller", "recompute", {"software": OLD}, {"software": NEW},
        )  # fmt: skip
        assert audit.verify(connection) == ()


def test_an_interruption_leaves_no_series_unjudged(store: Store, stand_in: StandIn, monkeypatch: pytest.MonkeyPatch) -> None:
    use_version(monkeypatch, OLD)
    first, second = keep_three(store, OLD), keep_series(store, name="the other", software=OLD)
    analyse(store, keep_test(store, second, {"test.toml": b"7"}))
    use_version(monkeypatch, NEW)
    stand_in.factor = 2.0
    judged: list[int] = []

    def judge(key: int) -> None:
        if interrupted[:1] == [key]:
            raise KeyboardInterrupt
        judged.append(key)

    interrupted = [second]
    with pytest.raises(KeyboardInterrupt):
        recompute(store, judge=judge)
    assert judged == [first], "as soon as it was switched"
    assert software_of(store, second) == NEW
    interrupted.clear()
    recompute(store, judge=judge)
    assert judged == [first, first, second], "the next attempt judges what the one before left"


def test_a_history_judges_what_it_recomputed(store: Store, stand_in: StandIn) -> None:
    """Also a series that counts with this version already, and has no state: an attempt was interrupted after its switch."""
    series, records = keep_three(store), Records()
    records.store, records.who = store, "A. Miller"
    records.recompute()
    assert len(stand_in.seen) == 6, "once each to keep, once each to compare"
    with read(store) as connection:
        assert connection.scalars(select(schema.series_state.c.series)).all() == [series]


def test_until_the_last_test_is_done_the_old_version_counts(
    store: Store, stand_in: StandIn, monkeypatch: pytest.MonkeyPatch
) -> None:
    use_version(monkeypatch, OLD)
    series = keep_three(store, OLD)
    use_version(monkeypatch, NEW)
    stand_in.factor = 2.0
    stand_in.seen.clear()

    def crash_at_the_third() -> None:
        if len(stand_in.seen) == 2:
            raise KeyboardInterrupt

    stand_in.before = crash_at_the_third
    with pytest.raises(KeyboardInterrupt):
        recompute(store, [series])
    assert software_of(store, series) == OLD
    assert values(store, series) == [100.0, 101.0, 102.0]
    stand_in.before = lambda: None
    stand_in.seen.clear()
    recompute(store, [series])
    assert stand_in.seen == [b"102"]
    assert values(store, series) == [200.0, 202.0, 204.0]


def test_a_test_that_arrives_meanwhile_is_computed_before_the_switch(
    store: Store, stand_in: StandIn, monkeypatch: pytest.MonkeyPatch
) -> None:
    use_version(monkeypatch, OLD)
    series = keep_three(store, OLD)
    use_version(monkeypatch, NEW)
    late: list[int] = []

    def somebody_imports() -> None:
        if not late:
            late.append(keep_test(store, series, {"test.toml": b"200"}, 50))

    stand_in.before = somebody_imports
    recompute(store, [series])
    assert values(store, series) == [100.0, 101.0, 102.0, 200.0]
    assert software_of(store, series) == NEW


def test_an_error_stays_one_and_is_told(store: Store, stand_in: StandIn) -> None:
    stand_in.errors.add(b"101")
    series = keep_three(store)
    found = recompute(store, [series])
    assert [one.error for one in found.tests] == ["", "cannot be read", ""]
    assert [one.same_bits for one in found.tests] == [True] * 3
    assert analyses(store) == 3


def test_what_failed_before_and_works_now_is_kept(store: Store, stand_in: StandIn) -> None:
    """A package was missing: the same version reads the test now."""
    stand_in.errors.add(b"101")
    series = keep_three(store)
    assert values(store, series)[1] != values(store, series)[1]
    stand_in.errors.clear()
    found = recompute(store, [series])
    assert [one.mended for one in found.tests] == [False, True, False]
    assert found.changed == (series,)
    assert values(store, series) == [100.0, 101.0, 102.0]
    assert found.verdict[0].passed is True
    assert [one.mended for one in recompute(store, [series]).tests] == [False] * 3


def test_what_worked_before_and_fails_now_is_no_match(store: Store, stand_in: StandIn) -> None:
    series = keep_three(store)
    stand_in.errors.add(b"101")
    found = recompute(store, [series])
    assert found.verdict[0].passed is False
    assert {entry.path for entry in found.tests[1].differing} == {"document", "error"}
    assert values(store, series) == [100.0, 101.0, 102.0]


def test_an_older_program_takes_no_series_back(store: Store, stand_in: StandIn) -> None:
    series = keep_series(store, software="99.10")
    with pytest.raises(
        InputError, match=r"was computed by elastogeo 99\.10, this is .*; install that version or a later one"
    ):
        recompute(store, [series])
    assert stand_in.seen == []
    assert software_of(store, series) == "99.10"


@pytest.mark.usefixtures("stand_in")
def test_all_series_are_taken_if_none_is_named(store: Store) -> None:
    one = keep_three(store)
    two = keep_series(store, machine="Mill 4")
    analyse(store, keep_test(store, two, {"test.toml": b"300"}))
    told: list[str] = []
    found = recompute(store, progress=told.append)
    assert [test.series for test in found.tests] == ["Mill 3: circle XY"] * 3 + ["Mill 4: circle XY"]
    assert told[-1] == "Mill 4: circle XY: test 1 of 1"
    assert values(store, one) == [100.0, 101.0, 102.0]


def test_an_empty_history_has_nothing_to_compare(store: Store) -> None:
    found = recompute(store)
    assert (found.tests, found.verdict[0].passed) == ((), None)


def test_a_series_that_is_not_there_is_refused(store: Store) -> None:
    with pytest.raises(InputError, match="there is no series 7"):
        recompute(store, [7])

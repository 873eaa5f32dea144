"""The audit trail: whatever is done to its rows behind its back is named."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from datetime import timedelta
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sqlalchemy import Connection, create_engine, delete, insert, select, text, update

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, audit, clock, read, write
from elastogeo.history.store.audit import CHANGED, CUT_OFF, HEAD_MISSING, MISSING, MOVED, Finding
from elastogeo.history.store.frozen import thaw
from elastogeo.history.store.schema import audit as rows
from elastogeo.history.store.schema import audit_head, metadata
from tests.history.store.filled import AT

ROWS = 7
KEPT = ("at", "who", "what", "subject", "old", "new", "why", "previous", "sha256")


@pytest.fixture
def trail() -> Iterator[Connection]:
    """Seven rows of a trail in a database whose rows nothing freezes."""
    engine = create_engine("sqlite://")
    times = iter(range(100))
    with engine.connect() as connection, pytest.MonkeyPatch.context() as patch:
        patch.setattr(clock, "source", lambda: AT + timedelta(minutes=next(times)))
        metadata.create_all(connection, tables=[rows, audit_head])
        for k in range(1, ROWS + 1):
            audit.record(connection, "A. Miller", "set aside", f"test {k}", old={"aside": k % 2}, new=[k / 3], why="seat")
        assert audit.verify(connection) == ()
        connection.commit()
        yield connection
    engine.dispose()


def row(connection: Connection, number: int) -> dict[str, Any]:
    return dict(connection.execute(select(rows).where(rows.c.number == number)).one()._mapping)


def reseal(connection: Connection, number: int) -> None:
    """Give a row the seal that its content has: what a forger does first."""
    connection.execute(update(rows).where(rows.c.number == number).values(sha256=audit._seal(row(connection, number))))


def test_the_seal_is_what_the_page_says(trail: Connection) -> None:
    """Computed here from the rows as they lie in the database."""
    previous = "0" * 64
    for number, at, who, what, subject, old, new, why, before, seal in trail.exec_driver_sql("SELECT * FROM audit"):
        assert before == previous
        content = {
            "number": number,
            "at": (AT + timedelta(minutes=number - 1)).isoformat(),
            "who": who,
            "what": what,
            "subject": subject,
            "old": json.loads(old),
            "new": json.loads(new),
            "why": why,
            "previous": before,
        }
        assert at == (AT + timedelta(minutes=number - 1)).timestamp() * 1e6
        line = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
        assert hashlib.sha256(line.encode()).hexdigest() == seal
        previous = seal


@pytest.mark.parametrize("number", range(1, ROWS + 1))
@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("at", AT - timedelta(days=1)),
        ("who", "B. Miller"),
        ("what", "taken back"),
        ("subject", "test 99"),
        ("old", {"aside": 7}),
        ("new", None),
        ("why", ""),
        ("previous", "f" * 64),
        ("sha256", "f" * 64),
    ],
)
def test_an_edited_row_is_named(trail: Connection, number: int, column: str, value: object) -> None:
    trail.execute(update(rows).where(rows.c.number == number).values({column: value}))
    assert audit.verify(trail) == (Finding(number, CHANGED),)


@pytest.mark.parametrize("number", range(1, ROWS + 1))
def test_an_edited_row_that_was_sealed_again_is_named(trail: Connection, number: int) -> None:
    trail.execute(update(rows).where(rows.c.number == number).values(who="nobody"))
    reseal(trail, number)
    assert audit.verify(trail) == (Finding(number, CHANGED),)


@pytest.mark.parametrize("number", range(1, ROWS))
def test_a_deleted_row_is_named(trail: Connection, number: int) -> None:
    trail.execute(delete(rows).where(rows.c.number == number))
    assert audit.verify(trail) == (Finding(number, MISSING),)


@pytest.mark.parametrize("left", range(ROWS))
def test_a_tail_that_was_cut_off_is_noticed(trail: Connection, left: int) -> None:
    trail.execute(delete(rows).where(rows.c.number > left))
    assert audit.verify(trail) == (Finding(left + 1, CUT_OFF),)


@given(places=st.tuples(st.integers(1, ROWS), st.integers(1, ROWS)).filter(lambda pair: pair[0] < pair[1]))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_rows_that_changed_places_are_named_with_where_they_were(trail: Connection, places: tuple[int, int]) -> None:
    first, second = places
    trail.execute(update(rows).where(rows.c.number == first).values(number=0))
    trail.execute(update(rows).where(rows.c.number == second).values(number=first))
    trail.execute(update(rows).where(rows.c.number == 0).values(number=second))
    assert set(audit.verify(trail)) >= {Finding(first, MOVED, second), Finding(second, MOVED, first)}
    trail.rollback()


def test_a_number_that_was_raised_far_is_one_gap(trail: Connection) -> None:
    far = 5 + 2**40
    trail.execute(update(rows).where(rows.c.number == 5).values(number=far))
    assert audit.verify(trail) == (Finding(5, MISSING), Finding(ROWS + 1, MISSING), Finding(far, MOVED, 5))


def test_a_row_that_was_added_behind_the_trail_is_named(trail: Connection) -> None:
    last = row(trail, ROWS)
    forged = {**last, "number": ROWS + 1, "who": "nobody", "previous": last["sha256"]}
    trail.execute(insert(rows).values({**forged, "sha256": audit._seal(forged)}))
    assert audit.verify(trail) == (Finding(ROWS + 1, CHANGED),)


def test_a_trail_that_was_emptied_or_lost_its_head_is_noticed(trail: Connection) -> None:
    trail.execute(delete(audit_head))
    assert audit.verify(trail) == (Finding(ROWS, HEAD_MISSING),)
    trail.rollback()
    trail.execute(delete(rows))
    assert audit.verify(trail) == (Finding(1, CUT_OFF),)


CHANGES = st.one_of(
    st.tuples(st.just("edit"), st.integers(1, ROWS), st.sampled_from(["who", "what", "subject", "why", "previous"])),
    st.tuples(st.just("delete"), st.integers(1, ROWS), st.just("")),
    st.tuples(st.just("renumber"), st.integers(1, ROWS), st.integers(ROWS + 1, ROWS + 9)),
)


@given(changes=st.lists(CHANGES, min_size=1, max_size=4), sealed=st.booleans())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_change_goes_unnoticed(trail: Connection, changes: list[tuple[str, int, Any]], sealed: bool) -> None:
    """Whatever is edited, deleted or renumbered, sealed again or not: something is found."""
    before = trail.exec_driver_sql("SELECT * FROM audit").all()
    for what, number, how in changes:
        if what == "delete":
            trail.execute(delete(rows).where(rows.c.number == number))
        elif what == "renumber" and not trail.execute(select(rows).where(rows.c.number == how)).first():
            trail.execute(update(rows).where(rows.c.number == number).values(number=how))
        elif what == "edit":
            trail.execute(update(rows).where(rows.c.number == number).values({how: f"{number} {how}"}))
            if sealed and trail.execute(select(rows).where(rows.c.number == number)).first():
                reseal(trail, number)
    changed = trail.exec_driver_sql("SELECT * FROM audit").all() != before
    assert bool(audit.verify(trail)) is changed
    trail.rollback()


WORDS = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)
PLAIN = st.none() | st.booleans() | st.integers(-(2**53), 2**53) | st.floats(allow_nan=False, allow_infinity=False) | WORDS
VALUES = st.recursive(
    PLAIN, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=3), max_leaves=6
)
TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=20)


@given(old=VALUES, new=VALUES, who=TEXT, why=TEXT)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
def test_whatever_is_recorded_verifies(trail: Connection, old: Any, new: Any, who: str, why: str) -> None:
    number = audit.record(trail, who, "set", "limit", old=old, new=new, why=why)
    assert audit.verify(trail) == ()
    assert [row(trail, number)[name] for name in ("who", "old", "new", "why")] == [who, old, new, why]
    trail.rollback()


def test_keys_that_are_numbers_and_tuples_verify_too(trail: Connection) -> None:
    audit.record(trail, "me", "set", "limit", old={10: 1, 9: (1, 2)}, new={"a": (0.1,)})
    assert audit.verify(trail) == ()


@pytest.mark.parametrize(("who", "said"), [("a\0b", "has a NUL in it"), ("\udc80", "is no text that can be kept")])
def test_text_that_no_database_keeps_is_refused(trail: Connection, who: str, said: str) -> None:
    with pytest.raises(StoreError, match=said):
        audit.record(trail, who, "set", "limit")


def test_the_numbers_have_no_gap_whatever_fails(store: Store) -> None:
    for k in range(4):
        try:
            with write(store) as connection:
                audit.record(connection, "me", "try", f"{k}")
                if k % 2:
                    raise ZeroDivisionError
        except ZeroDivisionError:
            pass
    with read(store) as connection:
        assert connection.execute(select(rows.c.number, rows.c.subject)).all() == [(1, "schema"), (2, "0"), (3, "2")]
        assert audit.verify(connection) == ()


def test_a_clock_that_goes_back_does_not_change_the_order(store: Store, standing_clock: Any) -> None:
    for hours in (0, -5, 3):
        standing_clock.advance(hours=hours)
        with write(store) as connection:
            audit.record(connection, "me", "note", f"{hours}")
    with read(store) as connection:
        assert audit.verify(connection) == ()
        assert connection.execute(select(rows.c.subject).order_by(rows.c.number)).scalars().all() == [
            "schema",
            "0",
            "-5",
            "3",
        ]


def test_a_forger_of_the_database_itself_is_found(store: Store) -> None:
    """On every database: who takes the triggers away first can write, and is named."""
    with write(store) as connection:
        for k in range(3):
            audit.record(connection, "me", "note", f"{k}", new={"x": 0.1 * k})
    with write(store) as connection:
        thaw(connection)
        connection.execute(text("UPDATE audit SET who = 'nobody' WHERE number = 3"))
        connection.execute(text("DELETE FROM audit WHERE number = 2"))
    with read(store) as connection:
        assert audit.verify(connection) == (Finding(2, MISSING), Finding(3, CHANGED))

"""What a column keeps comes back as it was, on every database."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta, timezone
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sqlalchemy import insert, select
from sqlalchemy.exc import StatementError

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, read, write
from elastogeo.history.store.columns import Document, Instant, Packed, canonical
from elastogeo.history.store.schema import machine, plan

ZONES = st.integers(-14 * 60, 14 * 60).map(lambda minutes: timezone(timedelta(minutes=minutes)))
WORDS = st.text(max_size=12)
DOCUMENTS = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | WORDS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS, inner, max_size=3),
    max_leaves=5,
)
AWKWARD = {
    "numbers": [0.1, -0.0, 5e-324, 1.7976931348623157e308, 2**53 + 1, 0.30000000000000004, 123456789.12345679],
    "text": "µm, \u0000, \u2028, \U0001f600, \"quoted\", back\\slash, 'single', %s, :name, ?",
}


@given(at=st.datetimes(datetime(1900, 1, 1), datetime(2200, 1, 1), timezones=ZONES))
def test_an_instant_keeps_its_microseconds_in_any_zone(at: datetime) -> None:
    kept = Instant().process_bind_param(at, None)  # type: ignore[arg-type]
    since = at - datetime(1970, 1, 1, tzinfo=UTC)
    assert kept == (since.days * 86_400 + since.seconds) * 10**6 + since.microseconds
    again = Instant().process_result_value(kept, None)  # type: ignore[arg-type]
    assert again == at
    assert again is not None
    assert again.utcoffset() == timedelta(0)


@given(document=DOCUMENTS)
@settings(max_examples=40)
def test_a_document_comes_back_whatever_it_holds(document: Any) -> None:
    for column in (Document(), Packed()):
        kept = column.process_bind_param(document, None)  # type: ignore[attr-defined]
        assert column.process_result_value(kept, None) == document  # type: ignore[attr-defined]
    assert canonical(document) == canonical(document)


def test_equal_documents_are_the_same_text() -> None:
    assert canonical({"b": [1.0, 2], "a": None}) == canonical({"a": None, "b": [1.0, 2]}) == '{"a":null,"b":[1.0,2]}'


def test_awkward_numbers_and_text_come_back_to_the_last_bit(store: Store) -> None:
    at = datetime(2026, 3, 29, 2, 30, 0, 123457, tzinfo=timezone(timedelta(hours=1)))
    with write(store) as connection:
        connection.execute(insert(machine).values(id=1, name="Fräse Ø3 – „Halle“ 机床", made_at=at))
        connection.execute(insert(plan).values(machine=1, name="p", made_at=at, document=AWKWARD))
    with read(store) as connection:
        assert connection.execute(select(machine.c.name, machine.c.made_at)).one() == ("Fräse Ø3 – „Halle“ 机床", at)
        found = connection.execute(select(plan.c.document)).scalar_one()
    assert [number.hex() for number in map(float, found["numbers"])] == [float(n).hex() for n in AWKWARD["numbers"]]
    assert found == AWKWARD


def add_named(store: Store, name: str, at: datetime) -> None:
    with write(store) as connection:
        connection.execute(insert(machine).values(name=name, made_at=at))


def test_a_time_without_a_zone_is_refused(store: Store) -> None:
    with pytest.raises(StatementError, match="has no time zone; a point in time needs one"):
        add_named(store, "mill", datetime(2026, 3, 2))


def test_a_number_that_is_none_is_refused() -> None:
    for value in (float("nan"), float("inf")):
        with pytest.raises(ValueError, match="not JSON compliant"):
            canonical({"x": value})


def test_a_name_of_bytes_that_are_no_text_is_refused_in_words(store: Store) -> None:
    """As Linux gives the name of a folder that came from Windows in Latin-1."""
    name = b"Pr\xfcfung".decode(errors="surrogateescape")
    with pytest.raises(StoreError, match=r"'Pr\\udcfcfung' holds bytes that are no text in UTF-8; rename it, then repeat"):
        add_named(store, name, datetime(2026, 3, 2, tzinfo=UTC))

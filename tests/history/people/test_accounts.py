"""Who may come in: what an account, a session and a token open, when they end, and that no secret is kept or told."""

from __future__ import annotations

import json
import re
import threading
from pathlib import Path

import pytest
from sqlalchemy import select

from elastogeo.errors import InputError, StoreError
from elastogeo.history.people import (
    ABSOLUTE,
    IDLE,
    Person,
    add_account,
    check_reachable,
    end_session,
    end_token,
    has_accounts,
    kept_accounts,
    kept_tokens,
    log_in,
    make_token,
    person_of_session,
    person_of_token,
    set_password,
    set_role,
    switch_account,
)
from elastogeo.history.people.sessions import TOUCH, digest
from elastogeo.history.store import audit, open_store, read
from elastogeo.history.store.schema import account, metadata, session, token
from elastogeo.history.upkeep import back_up, export, restore, verify

ANNA, BEN = "A. Miller", "B. Smith"
SECRET, OTHER = "correct horse battery", "staple of another kind"
WHO = "root of the shop"

pytestmark = pytest.mark.usefixtures("quick_passwords", "standing_clock")


@pytest.fixture
def shop(store):
    """An administrator and an engineer."""
    add_account(store, ANNA, "administrator", SECRET, who=WHO)
    add_account(store, BEN, "engineer", OTHER, who=ANNA)
    return store


def trail(store):
    with read(store) as connection:
        assert audit.verify(connection) == ()
        rows = metadata.tables["audit"]
        return connection.execute(select(rows.c.who, rows.c.what, rows.c.subject, rows.c.old, rows.c.new)).all()


def everything(store) -> str:
    """All that the database holds, as text."""
    with read(store) as connection:
        return "\n".join(str(tuple(row)) for table in metadata.sorted_tables for row in connection.execute(table.select()))


def test_name_and_password_open_a_session_that_ends_at_log_out(shop):
    secret = log_in(shop, ANNA, SECRET)
    assert person_of_session(shop, secret) == Person(1, ANNA, "administrator")
    assert log_in(shop, ANNA, OTHER) is None
    assert log_in(shop, "Nobody", SECRET) is None
    assert log_in(shop, ANNA.lower(), SECRET) is None
    end_session(shop, secret)
    assert person_of_session(shop, secret) is None
    assert person_of_session(shop, digest(secret)) is None  # what is kept opens nothing


def test_a_session_ends_after_a_pause_and_after_a_week(shop, standing_clock):
    secret = log_in(shop, BEN, OTHER)
    standing_clock.advance(seconds=IDLE.total_seconds() - 1)
    assert person_of_session(shop, secret)
    standing_clock.advance(seconds=IDLE.total_seconds() - 1)
    assert person_of_session(shop, secret)  # the visit before counted
    standing_clock.advance(seconds=IDLE.total_seconds())
    assert person_of_session(shop, secret) is None
    secret = log_in(shop, BEN, OTHER)
    for _ in range(int(ABSOLUTE / (IDLE / 2)) - 1):
        standing_clock.advance(seconds=IDLE.total_seconds() / 2)
        assert person_of_session(shop, secret)
    standing_clock.advance(seconds=IDLE.total_seconds() / 2)
    assert person_of_session(shop, secret) is None


def test_a_visit_is_kept_at_most_every_few_minutes(shop, standing_clock):
    def seen():
        with read(shop) as connection:
            return connection.execute(select(session.c.seen_at)).scalar_one()

    secret, begun = log_in(shop, ANNA, SECRET), standing_clock.time
    standing_clock.advance(seconds=TOUCH.total_seconds())
    person_of_session(shop, secret)
    assert seen() == begun
    standing_clock.advance(seconds=1)
    person_of_session(shop, secret)
    assert seen() == standing_clock.time


def test_another_password_ends_every_session_and_the_old_one_opens_nothing(shop):
    mine = [log_in(shop, BEN, OTHER) for _ in range(2)]
    annas = log_in(shop, ANNA, SECRET)
    set_password(shop, BEN, "something new entirely", who=ANNA)
    assert [person_of_session(shop, one) for one in mine] == [None, None]
    assert person_of_session(shop, annas)
    assert log_in(shop, BEN, OTHER) is None
    assert log_in(shop, BEN, "something new entirely")
    assert trail(shop)[-2][1:] == ("set password", f"account {BEN}", None, {"sessions_ended": 2})


def test_switched_off_nothing_opens_and_switched_on_the_old_things_stay_shut(shop):
    mine, program = log_in(shop, BEN, OTHER), make_token(shop, BEN, "cell 4", who=BEN)
    assert person_of_token(shop, program.secret) == Person(2, BEN, "engineer")
    switch_account(shop, BEN, False, who=ANNA, why="left")
    assert log_in(shop, BEN, OTHER) is None
    with pytest.raises(InputError, match="switched off"):
        make_token(shop, BEN, "cell 5", who=ANNA)
    assert person_of_session(shop, mine) is None
    assert person_of_token(shop, program.secret) is None
    switch_account(shop, BEN, True, who=ANNA)
    assert person_of_session(shop, mine) is None
    assert person_of_token(shop, program.secret) is None
    assert log_in(shop, BEN, OTHER)


def test_a_role_counts_from_the_next_page_on(shop):
    secret = log_in(shop, BEN, OTHER)
    set_role(shop, BEN, "reader", who=ANNA)
    assert person_of_session(shop, secret) == Person(2, BEN, "reader")
    assert trail(shop)[-1][1:] == ("set role", f"account {BEN}", "engineer", "reader")


def test_the_last_administrator_who_can_log_in_stays_one(shop):
    add_account(shop, "robot", "administrator", None, who=ANNA)  # no password: cannot log in
    before = len(trail(shop))
    with pytest.raises(InputError, match=r"A\. Miller is the last administrator who can log in; make another one first"):
        set_role(shop, ANNA, "engineer", who=ANNA)
    with pytest.raises(InputError, match="is the last administrator"):
        switch_account(shop, ANNA, False, who=ANNA)
    assert len(trail(shop)) == before
    switch_account(shop, "robot", False, who=ANNA)
    set_role(shop, BEN, "administrator", who=ANNA)
    switch_account(shop, ANNA, False, who=BEN)
    with pytest.raises(InputError, match=r"B\. Smith is the last administrator"):
        set_role(shop, BEN, "reader", who=BEN)


def test_two_administrators_cannot_switch_each_other_off(shop):
    set_role(shop, BEN, "administrator", who=ANNA)
    barrier, refused = threading.Barrier(2), []

    def off(name):
        barrier.wait()
        try:
            switch_account(shop, name, False, who="the other")
        except InputError:
            refused.append(name)

    both = [threading.Thread(target=off, args=(name,)) for name in (ANNA, BEN)]
    for one in both:
        one.start()
    for one in both:
        one.join()
    assert len(refused) == 1
    assert [one.active for one in kept_accounts(shop).accounts].count(True) == 1


def test_a_token_is_shown_once_and_ends(shop):
    made = make_token(shop, BEN, "  cell   4 ", who=BEN)
    assert made.secret not in repr(made)
    assert made.secret.startswith("egt_")
    assert len(made.secret) > 40
    with pytest.raises(InputError, match=f"there is no token {made.number}"):
        end_token(shop, made.number, who=ANNA, owner=ANNA)
    assert person_of_token(shop, made.secret)
    (kept,) = kept_tokens(shop, BEN).tokens
    assert (kept.purpose, kept.owner, kept.ended_at) == ("cell 4", BEN, None)
    end_token(shop, made.number, who=BEN, owner=BEN)
    end_token(shop, made.number, who=BEN)  # once more: nothing
    assert person_of_token(shop, made.secret) is None
    assert kept_tokens(shop, ANNA).tokens == ()
    assert [row[1] for row in trail(shop)][-2:] == ["make token", "end token"]


def test_no_secret_is_in_the_database_its_trail_or_a_document(shop):
    first, program = log_in(shop, ANNA, SECRET), make_token(shop, ANNA, "cell 4", who=ANNA)
    set_password(shop, BEN, "something new entirely", who=ANNA)
    second = log_in(shop, BEN, "something new entirely")
    held = everything(shop) + json.dumps([kept_accounts(shop).to_dict(), kept_tokens(shop).to_dict()])
    for secret in (SECRET, OTHER, "something new entirely", first, second, program.secret):
        assert secret not in held
    with read(shop) as connection:
        hashes = [*connection.scalars(select(account.c.password)), *connection.scalars(select(token.c.sha256))]
    assert len(hashes) == 3
    told = json.dumps([list(row) for row in trail(shop)]) + str(kept_accounts(shop)) + str(kept_tokens(shop))
    assert [one for one in hashes if one in told] == []


@pytest.mark.parametrize(
    ("password", "said"),
    [
        ("short", "has 5 characters; take at least 12"),
        ("a" * 40, "has 1 different characters; take at least 5"),
        ("x" * 250 + "abcdefgh", "has 258 characters; take at most 256"),
        ("Maria Miller", "is the account's name"),
    ],
)
def test_what_is_soon_guessed_is_refused_and_not_repeated(store, password, said):
    with pytest.raises(InputError, match=said) as refused:
        add_account(store, "Maria Miller", "reader", password, who=WHO)
    assert password not in str(refused.value)
    assert not has_accounts(store)


@pytest.mark.parametrize(
    ("name", "role", "said"),
    [
        ("", "reader", "has no name"),
        ("x" * 81, "reader", "has 81 characters"),
        ("a\u202eb", "reader", "cannot be seen"),
        ("a\0b", "reader", "cannot be seen"),
        ("B. Smith", "root", "the role is 'root'"),
        ("a. MILLER", "reader", r"there is an account 'A. Miller' already"),
    ],
)
def test_an_account_that_is_none_is_refused(shop, name, role, said):
    before = trail(shop)
    with pytest.raises(InputError, match=said):
        add_account(shop, name, role, SECRET, who=WHO)
    assert trail(shop) == before


def test_the_same_password_counts_however_a_keyboard_composes_it(store):
    add_account(store, ANNA, "administrator", "sch\u00f6ne lange Worte", who=WHO)
    assert log_in(store, ANNA, "scho\u0308ne lange Worte")
    assert log_in(store, ANNA, "schone lange Worte") is None
    assert log_in(store, ANNA, "\ud800" * 20) is None


def test_pages_for_others_need_an_administrator_who_can_log_in(store):
    with pytest.raises(
        StoreError, match=r"no administrator can log in.*elastogeo history account NAME --role administrator"
    ):
        check_reachable(store)
    for role, password in (("administrator", None), ("engineer", OTHER)):  # the first must be able to let others in
        with pytest.raises(InputError, match="make the account of one first, with a password"):
            add_account(store, BEN, role, password, who=WHO)
    add_account(store, ANNA, "administrator", SECRET, who=WHO)
    check_reachable(store)


@pytest.mark.parametrize("kind", ["truncate", "postgresql"])
def test_a_copy_opens_nothing_that_was_open(shop, tmp_path: Path):
    mine, program = log_in(shop, ANNA, SECRET), make_token(shop, BEN, "cell 4", who=BEN)
    with read(shop) as connection:
        kept = [*connection.scalars(select(session.c.sha256)), *connection.scalars(select(token.c.sha256))]
        passwords = list(connection.scalars(select(account.c.password)))
    back_up(shop, tmp_path / "backup")
    export(shop, tmp_path / "export")
    held = {
        folder: b"".join(path.read_bytes() for path in (tmp_path / folder).rglob("*") if path.is_file())
        for folder in ("backup", "export")
    }
    assert kept[0].encode() not in held["backup"]  # not in a page that was freed either
    assert kept[1].encode() in held["backup"]
    assert [one for one in (*kept, *passwords) if one.encode() in held["export"]] == []
    assert b"argon2" not in held["export"]
    for folder in ("backup", "export"):
        restore(tmp_path / folder, tmp_path / f"{folder}.db", files=tmp_path / f"{folder}.files")
        with open_store(tmp_path / f"{folder}.db", files=tmp_path / f"{folder}.files") as restored:
            assert verify(restored).faults == ()
            assert person_of_session(restored, mine) is None
            assert [one.name for one in kept_accounts(restored).accounts] == [ANNA, BEN]
            assert bool(log_in(restored, ANNA, SECRET)) is (folder == "backup")
            assert bool(person_of_token(restored, program.secret)) is (folder == "backup")
    assert person_of_session(shop, mine)


def test_what_programs_read_of_accounts(shop, standing_clock):
    log_in(shop, ANNA, SECRET)
    found = kept_accounts(shop).to_dict()
    assert found["schema"] == "elastogeo.accounts/1"
    assert found["accounts"] == [
        {
            "name": ANNA, "role": "administrator", "active": True, "has_password": True,
            "changed_at": "2026-03-02T08:00:00Z", "seen_at": "2026-03-02T08:00:00Z", "sessions": 1, "tokens": 0,
        },
        {
            "name": BEN, "role": "engineer", "active": True, "has_password": True,
            "changed_at": "2026-03-02T08:00:00Z", "seen_at": None, "sessions": 0, "tokens": 0,
        },
    ]  # fmt: skip
    standing_clock.advance(days=8)
    assert kept_accounts(shop).accounts[0].sessions == 0
    assert re.search(r"Accounts that are on: 2 of 2; administrators: 1\.", str(kept_accounts(shop)))

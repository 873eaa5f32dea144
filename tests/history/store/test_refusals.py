"""What a database says when it cannot, in the words of this program."""

from __future__ import annotations

from pathlib import Path

import pytest
from sqlalchemy.exc import IntegrityError, ProgrammingError

from elastogeo.errors import StoreError
from elastogeo.history.store import open_store
from elastogeo.history.store.refusals import in_words
from tests.history.conftest import Server


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("permission denied for schema public", "may not make tables in this database; let its owner say: GRANT CREATE"),
        ("permission denied for table test", "may not do this in the database; let its owner grant it"),
        ("cannot execute INSERT in a read-only transaction", "may only be read here"),
        ("a word that no program foresaw", "the database says: a word that no program foresaw"),
    ],
)
def test_what_a_database_refuses_is_one_error_in_words(said: str, words: str) -> None:
    with pytest.raises(StoreError, match=f"^here: .*{words}"), in_words("here", writes=True):
        raise ProgrammingError("INSERT", {}, Exception(said))


def test_a_broken_rule_stays_what_it_is() -> None:
    with pytest.raises(IntegrityError), in_words("here", writes=True):
        raise IntegrityError("INSERT", {}, Exception("UNIQUE constraint failed"))


def test_a_role_that_may_make_no_tables_is_told_so(server: Server, tmp_path: Path) -> None:
    name = server.database()
    server._admin.execute("DROP ROLE IF EXISTS guest")
    server._admin.execute("CREATE ROLE guest LOGIN")
    url = server.url(name).replace("//postgres@", "//guest@")
    assert "guest" in url
    with pytest.raises(StoreError, match="let its owner say: GRANT CREATE"):
        open_store(url, create=True, files=tmp_path / "files", who="the tests")
    server.drop(name)

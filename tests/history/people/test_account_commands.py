"""`elastogeo history account` and `token`: nothing secret on the command line, and what is refused."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable

import pytest

from elastogeo.cli import main
from elastogeo.history.people import log_in, person_of_token
from elastogeo.history.store import open_store

Run = Callable[..., tuple[int, str, str]]
SECRET = "correct horse battery"

pytestmark = [pytest.mark.usefixtures("quick_passwords"), pytest.mark.parametrize("kind", ["truncate"])]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def elastogeo(url: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run `elastogeo history ...` with a line on standard input: exit code, standard output, standard error."""
    monkeypatch.setenv("ELASTOGEO_STORE", url)
    monkeypatch.setenv("ELASTOGEO_WHO", "root of the shop")

    def run(*arguments: str, line: str = "", typed: bool = False) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["elastogeo", "history", *arguments])
        monkeypatch.setattr(sys, "stdin", Terminal() if typed else io.StringIO(line))
        return (main(), *capsys.readouterr())

    return run


def test_an_account_is_made_with_a_line_of_standard_input(url: str, elastogeo: Run) -> None:
    code, out, err = elastogeo("account", "A. Miller", "--role", "administrator", line=f"{SECRET}\n")
    assert (code, err) == (0, "")
    assert "A. Miller" in out
    assert SECRET not in out
    with open_store(url) as store:
        assert log_in(store, "A. Miller", SECRET)
    found = json.loads(elastogeo("audit", "--json")[1])["rows"]
    assert [(row["who"], row["what"]) for row in found[:2]] == [
        ("A. Miller", "log in"),
        ("root of the shop", "add account"),
    ]


def test_a_terminal_is_asked_twice_and_shows_nothing(url: str, elastogeo: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    typed = iter([SECRET, "another one, mistyped", SECRET, SECRET])
    monkeypatch.setattr("getpass.getpass", lambda _: next(typed))
    code, _, err = elastogeo("account", "A. Miller", "--role", "administrator", typed=True)
    assert (code, err) == (2, "elastogeo: the two passwords differ; nothing was changed\n")
    assert elastogeo("account", "A. Miller", "--role", "administrator", typed=True)[0] == 0
    with open_store(url) as store:
        assert log_in(store, "A. Miller", SECRET)


@pytest.mark.parametrize(
    ("arguments", "line", "said"),
    [
        (("account", "B"), f"{SECRET}\n", "there is no account 'B'; a new one needs --role"),
        (("account", "B", "--role", "reader"), "", "no password arrived"),
        (("account", "B", "--role", "reader"), "short\n", "the password has 5 characters"),
        (("account", "B", "--role", "king"), f"{SECRET}\n", "the role is 'king'"),
        (("account", "B", "--off", "--on"), "", "--off and --on: say one of them"),
        (("token", "--for", "cell 4"), "", "a token is of an account"),
        (("token", "B", "--for", "cell 4"), "", "there is no account 'B'"),
        (("token", "--end", "4"), "", "there is no token 4"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(elastogeo: Run, arguments: tuple[str, ...], line: str, said: str) -> None:
    code, out, err = elastogeo(*arguments, line=line)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert said in err
    assert "short" not in err


def test_an_account_changes_and_a_token_comes_and_goes(url: str, elastogeo: Run) -> None:
    elastogeo("account", "A. Miller", "--role", "administrator", line=f"{SECRET}\n")
    elastogeo("account", "cell 4", "--role", "reader", "--tokens-only")
    code, _, err = elastogeo("account", "A. Miller", "--off")
    assert (code, err.startswith("elastogeo: A. Miller is the last administrator")) == (2, True)
    assert elastogeo("account", "A. Miller")[2].startswith("elastogeo: the account 'A. Miller' is there already; say what")
    assert elastogeo("account", "cell 4", "--role", "engineer")[0] == 0
    made = json.loads(elastogeo("token", "cell 4", "--for", "uploads", "--json")[1])
    shown = elastogeo("token", "cell 4", "--for", "plans")[1].splitlines()
    with open_store(url) as store:
        assert [person_of_token(store, one).role for one in (made["token"], shown[-1])] == ["engineer", "engineer"]
    assert elastogeo("token", "--end", str(made["number"]))[0] == 0
    listed = elastogeo("token", "--json")[1]
    assert [(one["number"], one["ended_at"] is None) for one in json.loads(listed)["tokens"]] == [(2, True), (1, False)]
    assert made["token"] not in listed
    assert elastogeo("account", "cell 4", "--off", "--why", "sold")[0] == 0
    with open_store(url) as store:
        assert person_of_token(store, shown[-1]) is None
    rows = json.loads(elastogeo("account", "--json")[1])["accounts"]
    assert [(one["name"], one["role"], one["active"], one["tokens"]) for one in rows] == [
        ("A. Miller", "administrator", True, 0),
        ("cell 4", "engineer", False, 0),
    ]

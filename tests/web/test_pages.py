"""What holds for every page: its twins, its edition, its role, its errors."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from textwrap import dedent
from types import ModuleType
from typing import Annotated

import pytest
from fastapi import FastAPI, Form
from fastapi.testclient import TestClient
from jinja2 import ChoiceLoader, DictLoader

import elastogeo as eg
from elastogeo.web import Settings, application
from elastogeo.web import pages as recipe
from elastogeo.web.answering import Done, Shown
from elastogeo.web.app import every, with_errors
from elastogeo.web.asking import ADMINISTRATOR, ANYBODY, ENGINEER, READER, Ask, Visitor
from elastogeo.web.pages import Pages
from elastogeo.web.templating import _environment

HOST = "http://127.0.0.1:8347"


@pytest.fixture(scope="module")
def history(tmp_path_factory: pytest.TempPathFactory) -> Iterator[eg.History]:
    with eg.History(tmp_path_factory.mktemp("pages") / "h.db", create=True, who="A. Miller") as history:
        history.add_machine("Mill <3>", place="hall 1")
        yield history


@pytest.fixture(scope="module")
def browser(history: eg.History) -> TestClient:
    app = application(Settings(history.store.url, who="A. Miller"), history.store)
    return TestClient(app, HOST, raise_server_exceptions=False)


def test_a_page_has_its_json_and_its_csv_at_the_same_path(browser: TestClient) -> None:
    page, json, csv = (browser.get(path) for path in ("/", "/fleet.json", "/fleet.csv"))
    assert "Mill &lt;3&gt;" in page.text
    assert json.json()["schema"] == "elastogeo.fleet/1"
    assert [row["name"] for row in json.json()["rows"]] == ["Mill <3>"]
    assert csv.headers["content-type"] == "text/csv; charset=utf-8"
    assert "Mill <3>" in csv.text


def test_a_page_is_not_made_again_while_the_edition_is_the_same(browser: TestClient, history: eg.History) -> None:
    tag = browser.get("/").headers["etag"]
    assert browser.get("/", headers={"If-None-Match": tag}).status_code == 304
    assert browser.get("/", headers={"If-None-Match": tag, "Cookie": "elastogeo_theme=dark"}).status_code == 200
    history.add_machine("Lathe 1")
    again = browser.get("/", headers={"If-None-Match": tag})
    assert again.status_code == 200
    assert "Lathe 1" in again.text


@pytest.mark.parametrize("path", ["/machines/99", "/machines/x", "/nothing", "/machines/99.json"])
def test_what_is_not_there_is_said_in_one_sentence(browser: TestClient, path: str) -> None:
    answer = browser.get(path)
    assert answer.status_code == 404
    assert "There is no such" in answer.text


def test_the_addresses_for_programs_show_code_as_code(browser: TestClient) -> None:
    page = browser.get("/docs").text
    assert "<code>alarm 3</code>" in page
    assert "`" not in page


def test_every_page_has_a_role_and_the_twins_are_described() -> None:
    routes = [route for pages in every() for route in pages.routes]
    assert len(routes) > 5
    assert {route.openapi_extra["x-role"] for route in routes} <= {ANYBODY, READER, ENGINEER, ADMINISTRATOR}  # type: ignore[attr-defined]


def test_the_page_of_the_recipe_works_as_it_stands(history: eg.History, monkeypatch: pytest.MonkeyPatch) -> None:
    python, template = re.findall(r"::\n\n((?:    .*\n|\n)+)", recipe.__doc__ or "")
    notes = ModuleType("elastogeo.web.care.notes")
    exec(compile(dedent(python), "care/notes.py", "exec"), notes.__dict__)
    environment = _environment()
    there = DictLoader({"care/notes.html.j2": dedent(template)})
    monkeypatch.setattr(environment, "loader", ChoiceLoader([there, environment.loader or there]))
    monkeypatch.setattr("elastogeo.web.app.every", lambda: [*every(), notes.pages])
    visit = TestClient(application(Settings(history.store.url, who="A. Miller"), history.store), HOST)
    done = visit.post("/machines/1/notes", data={"note": "oil <changed>"}, headers={"Origin": HOST})
    assert done.status_code == 200
    assert "The note is kept." in done.text
    assert "oil &lt;changed&gt;" in done.text
    assert [row["note"] for row in visit.get("/machines/1/notes.json").json()["events"]] == ["oil <changed>"]
    assert "oil <changed>" in visit.get("/machines/1/notes.csv").text
    assert "/machines/{key}/notes.csv" in visit.get("/openapi.json").json()["paths"]


@pytest.fixture
def own(history: eg.History) -> Callable[[str], TestClient]:
    """An application of two pages of this test, visited in a role."""
    pages = Pages()

    @pages.acts("/act", role=ENGINEER)
    def act(asked: Ask, note: Annotated[str, Form(max_length=5)]) -> Done:
        return Done("/", f"Noted: {note}, {asked.visitor.name}.")

    @pages.shows("/broken")
    def broken(asked: Ask) -> Shown:  # noqa: ARG001
        raise ZeroDivisionError("secret")

    def visited(role: str) -> TestClient:
        inner = FastAPI()
        inner.state.settings, inner.state.store = Settings(history.store.url), history.store
        inner.include_router(pages)
        with_errors(inner)

        async def app(scope, receive, send):  # type: ignore[no-untyped-def]
            scope.setdefault("state", {})["visitor"] = Visitor("B. Reader", role)
            await inner(scope, receive, send)

        return TestClient(app, HOST, raise_server_exceptions=False, follow_redirects=False)

    return visited


def test_an_act_goes_on_to_the_next_page_and_says_what_was_done(own: Callable[[str], TestClient]) -> None:
    done = own(ENGINEER).post("/act", data={"note": "oil"})
    assert (done.status_code, done.headers["location"]) == (303, "/")
    assert "Noted%3A%20oil" in done.headers["set-cookie"]
    assert own(ENGINEER).post("/act", data={"note": "oil"}, headers={"Accept": "application/json"}).json() == {
        "done": "Noted: oil, B. Reader.",
        "at": "/",
    }


def test_who_may_not_is_refused(own: Callable[[str], TestClient]) -> None:
    refused = own(READER).post("/act", data={"note": "oil"})
    assert refused.status_code == 403
    assert "this needs the role engineer; B. Reader is reader" in refused.text


def test_what_was_sent_is_not_echoed(own: Callable[[str], TestClient]) -> None:
    answer = own(ENGINEER).post("/act", data={"note": "<script>x</script>"})
    assert answer.status_code == 422
    assert "What was sent does not fit: note." in answer.text
    assert "script>x" not in answer.text


def test_a_fault_has_a_number_and_tells_nothing(own: Callable[[str], TestClient]) -> None:
    answer = own(READER).get("/broken")
    assert answer.status_code == 500
    assert "A fault of elastogeo, number" in answer.text
    assert "secret" not in answer.text


def test_the_theme_is_kept_and_the_page_comes_back(browser: TestClient) -> None:
    headers = {"Referer": f"{HOST}/machines/1?series=x", "Origin": HOST, "Sec-Fetch-Site": "same-origin"}
    chosen = browser.post("/theme", data={"theme": "dark"}, headers=headers, follow_redirects=False)
    assert (chosen.status_code, chosen.headers["location"]) == (303, "/machines/1?series=x")
    assert 'data-theme="dark"' in browser.get("/").text
    away = browser.post(
        "/theme", data={"theme": "light"}, headers=headers | {"Referer": "http://evil/x"}, follow_redirects=False
    )
    assert away.headers["location"] == "/"

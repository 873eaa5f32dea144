"""A shop of one's own for each test, and its pages without a server, visited in a role."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.web import Settings
from elastogeo.web.app import every, with_errors
from elastogeo.web.asking import ADMINISTRATOR, Visitor
from tests.web.care.shop import make_shop

HOST = "http://127.0.0.1:8347"
Visit = Callable[..., TestClient]


@pytest.fixture(scope="module")
def made_shop(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_shop(tmp_path_factory.mktemp("shop"))


@pytest.fixture
def history(made_shop: Path, tmp_path: Path) -> Iterator[eg.History]:
    shutil.copyfile(made_shop, tmp_path / "shop.db")
    shutil.copytree(made_shop.with_name("shop.db.files"), tmp_path / "shop.db.files")
    with eg.History(tmp_path / "shop.db", who="A. Miller") as history:
        yield history


@pytest.fixture
def visit(history: eg.History) -> Visit:
    """`visit(role)`: the pages of the shop, in that role."""

    def visited(role: str = ADMINISTRATOR) -> TestClient:
        inner = FastAPI()
        inner.state.settings, inner.state.store = Settings(history.store.url), history.store
        for pages in every():
            inner.include_router(pages)
        with_errors(inner)

        async def app(scope, receive, send):  # type: ignore[no-untyped-def]
            scope.setdefault("state", {})["visitor"] = Visitor("B. Visitor", role)
            await inner(scope, receive, send)

        return TestClient(app, HOST, raise_server_exceptions=False)

    return visited

"""A second place beside a store, on any of the three databases."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from elastogeo.history.store import Store, open_store
from tests.history.upkeep.stores import fill_all


@pytest.fixture
def full(store: Store) -> Store:
    """A history with a row in each table and three raw files."""
    fill_all(store)
    return store


@pytest.fixture
def place_for(tmp_path: Path, request: pytest.FixtureRequest) -> Callable[[str], dict[str, str]]:
    """By kind, an empty place for another history: `url` and `files`."""

    def made(kind: str) -> dict[str, str]:
        folder = tmp_path / "elsewhere"
        folder.mkdir()
        if kind == "postgresql":
            server = request.getfixturevalue("server")
            name = server.database()
            request.addfinalizer(lambda: server.drop(name))
            return {"url": server.url(name), "files": str(folder / "raw")}
        return {"url": str(folder / "history.db"), "files": str(folder / "raw")}

    return made


@pytest.fixture
def opened() -> Callable[[dict[str, str]], Store]:
    def at(place: dict[str, str]) -> Store:
        return open_store(place["url"], files=place["files"])

    return at
